//! Corners by vertex while rings are built: a cache line or so of unordered records at each vertex.
//!
//! The lines are never cleared, since that would cost as much as filling them: a count at each vertex says how many of
//! its slots hold a record. Records beyond the last slot are the caller's to keep.

use super::memory::{room, zeroed};
use crate::error::Error;
use crate::simd::prefetch;
use std::mem::MaybeUninit;

/// Records that a vertex has room for.
pub(crate) const SLOTS: usize = 8;

/// Vertices of a block, whose records are read as lanes.
pub(crate) const BLOCK: usize = 16;

/// Bytes of a cache line.
const LINE: usize = 64;

/// The records of one vertex, word by word.
type Records<const WORDS: usize> = [[MaybeUninit<u32>; SLOTS]; WORDS];

/// Slots for the records, `WORDS` numbers each, of the corners at some vertices.
pub(crate) struct Slots<const WORDS: usize> {
    words: Vec<MaybeUninit<u32>>,
    /// Words before the first cache line.
    skipped: usize,
    /// How many records came to each vertex; [`SLOTS`] + 1 stands for more than there are slots.
    counts: Vec<u8>,
}

impl<const WORDS: usize> Slots<WORDS> {
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub(crate) fn new(vertex_count: usize) -> Result<Self, Error> {
        let vertices = vertex_count.checked_next_multiple_of(BLOCK).ok_or(Error::OutOfMemory)?;
        let length = vertices.checked_mul(WORDS * SLOTS).and_then(|words| words.checked_add(LINE / 4));
        let length = length.ok_or(Error::OutOfMemory)?;
        let mut words = room(length)?;
        words.resize_with(length, MaybeUninit::uninit);
        let skipped = words.as_ptr().align_offset(LINE).min(LINE / 4);
        Ok(Slots { words, skipped, counts: zeroed(vertices)? })
    }

    /// The slots of `vertices` vertices after the other, the last perhaps of fewer; `vertices` is a multiple of [`BLOCK`].
    pub(crate) fn parts(&mut self, vertices: usize) -> impl Iterator<Item = SlotsPart<'_, WORDS>> {
        assert!(vertices.is_multiple_of(BLOCK) && vertices > 0);
        let words = &mut self.words[self.skipped..][..self.counts.len() * WORDS * SLOTS];
        let lines = words.as_chunks_mut::<SLOTS>().0.as_chunks_mut::<WORDS>().0;
        let parts = lines.chunks_mut(vertices).zip(self.counts.chunks_mut(vertices));
        parts.enumerate().map(move |(part, (lines, counts))| SlotsPart { first: part * vertices, lines, counts })
    }
}

/// What became of a record.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Put {
    /// It is in its slot.
    Stored,
    /// All slots of its vertex are taken.
    Full,
    /// Its vertex is in another part.
    Elsewhere,
}

/// The slots of a run of vertices, with `lines` and `counts` of the same length.
pub(crate) struct SlotsPart<'a, const WORDS: usize> {
    first: usize,
    lines: &'a mut [Records<WORDS>],
    counts: &'a mut [u8],
}

impl<const WORDS: usize> SlotsPart<'_, WORDS> {
    /// Fetches the slots of a vertex, if they are here, into the cache.
    #[inline(always)]
    pub(crate) fn prefetch(&self, vertex: u32) {
        let place = (vertex as usize).wrapping_sub(self.first);
        if let Some(line) = self.lines.get(place) {
            // The ends of what may be two cache lines.
            let first = std::ptr::from_ref(line).cast::<u8>();
            prefetch(first);
            if size_of::<Records<WORDS>>() > LINE {
                prefetch(first.wrapping_add(size_of::<Records<WORDS>>() - 1));
            }
        }
    }

    /// Adds a record to those of a vertex.
    #[inline(always)]
    pub(crate) fn put(&mut self, vertex: u32, record: [u32; WORDS]) -> Put {
        let place = (vertex as usize).wrapping_sub(self.first);
        let Some(count) = self.counts.get_mut(place) else { return Put::Elsewhere };
        let slot = *count as usize;
        if slot >= SLOTS {
            *count = SLOTS as u8 + 1;
            return Put::Full;
        }
        *count += 1;
        // SAFETY: there are as many lines as counts.
        let line = unsafe { self.lines.get_unchecked_mut(place) };
        for word in 0..WORDS {
            line[word][slot].write(record[word]);
        }
        Put::Stored
    }

    /// How many records are in slots.
    pub(crate) fn record_count(&self) -> usize {
        self.counts.iter().map(|&count| (count as usize).min(SLOTS)).sum()
    }

    /// How many records came to each vertex of a block; `SLOTS + 1` stands for more than there are slots.
    #[inline(always)]
    pub(crate) fn counts(&self, block: usize) -> &[u8; BLOCK] {
        self.counts[block * BLOCK..].first_chunk().expect("parts are made of whole blocks")
    }

    /// The first `M` records of each vertex of a block, by word, slot and lane; `u32::MAX` where there are fewer.
    #[inline(always)]
    pub(crate) fn rows<const M: usize>(&self, block: usize) -> [[[u32; BLOCK]; M]; WORDS] {
        let counts = self.counts(block);
        let lines: &[Records<WORDS>; BLOCK] =
            self.lines[block * BLOCK..].first_chunk().expect("parts are made of whole blocks");
        let mut rows = [[[0; BLOCK]; M]; WORDS];
        for lane in 0..BLOCK {
            for word in 0..WORDS {
                for slot in 0..M {
                    let value = lines[lane][word][slot];
                    rows[word][slot][lane] = if slot < counts[lane] as usize {
                        // SAFETY: a slot below its vertex's count has been written.
                        unsafe { value.assume_init() }
                    } else {
                        u32::MAX
                    };
                }
            }
        }
        rows
    }

    /// The records in the slots of a vertex, counted from the part's first, in the order in which they came.
    pub(crate) fn records(&self, place: usize) -> impl Iterator<Item = [u32; WORDS]> {
        let line = &self.lines[place];
        let count = (self.counts[place] as usize).min(SLOTS);
        // SAFETY: a slot below its vertex's count has been written.
        (0..count).map(move |slot| std::array::from_fn(|word| unsafe { line[word][slot].assume_init() }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_come_back_from_their_part() {
        let mut slots = Slots::<2>::new(40).unwrap();
        let mut parts: Vec<_> = slots.parts(32).collect();
        for record in 0..SLOTS as u32 {
            assert!(parts[1].put(35, [record, 100 + record]) == Put::Stored);
        }
        assert!(parts[1].put(35, [9, 9]) == Put::Full);
        assert!(parts[1].put(31, [9, 9]) == Put::Elsewhere);
        assert!(parts[0].put(32, [9, 9]) == Put::Elsewhere);
        assert!(parts[0].put(31, [5, 6]) == Put::Stored);
        assert_eq!(parts[0].records(31).collect::<Vec<_>>(), [[5, 6]]);
        assert_eq!(parts[1].records(3).collect::<Vec<_>>(), (0..8).map(|i| [i, 100 + i]).collect::<Vec<_>>());
        assert_eq!(parts[1].counts(0)[3], 9);
        let rows = parts[0].rows::<4>(1);
        assert_eq!((rows[0][0][15], rows[1][0][15], rows[0][1][15], rows[0][0][0]), (5, 6, u32::MAX, u32::MAX));
    }
}
