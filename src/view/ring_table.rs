//! A ring table in the making: threads fill a stretch of vertices each, vertex after vertex.
//!
//! What [`Rings`] relies on is checked here, window by window while it is in the cache: every neighbour is a vertex, and
//! a vertex of a class for lanes is not the last, nor does it have it as a neighbour.

use super::memory::{room, zeroed};
use super::rings::{CLASSES, RingClass, Rings, Slice, WINDOW, bucket};
use super::threads::for_each_part;
use crate::error::{Error, reserved};

/// The table.
pub(crate) struct RingTable {
    offsets: Vec<u32>,
    classes: Vec<u8>,
    order: Vec<u16>,
    /// Vertices of a stretch; the last may have fewer.
    stretch: usize,
    stretches: Vec<Stretch>,
}

/// What a stretch of vertices has of its own until all are joined.
struct Stretch {
    entries: Vec<u32>,
    /// The faces beside the entries, where they are kept.
    faces: Option<Vec<u32>>,
    slices: Vec<Slice>,
    window_slices: Vec<u32>,
    /// How many entries have been checked.
    sealed: usize,
}

impl RingTable {
    /// A table of `vertex_count` rings in stretches of `stretch` vertices, a multiple of [`WINDOW`].
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub(crate) fn new(vertex_count: usize, stretch: usize, faces: bool) -> Result<Self, Error> {
        assert!(stretch.is_multiple_of(WINDOW) && stretch > 0);
        let count = vertex_count.div_ceil(stretch);
        let mut stretches = reserved(count)?;
        stretches.resize_with(count, || Stretch {
            entries: Vec::new(),
            faces: faces.then(Vec::new),
            slices: Vec::new(),
            window_slices: Vec::new(),
            sealed: 0,
        });
        let offsets = zeroed(vertex_count.checked_add(1).ok_or(Error::OutOfMemory)?)?;
        Ok(RingTable { offsets, classes: zeroed(vertex_count)?, order: zeroed(vertex_count)?, stretch, stretches })
    }

    /// How many stretches.
    pub(crate) fn part_count(&self) -> usize {
        self.stretches.len()
    }

    /// The stretches, to be filled.
    pub(crate) fn parts(&mut self) -> impl Iterator<Item = RingPart<'_>> {
        let (vertex_count, vertices) = (self.classes.len(), self.stretch);
        let offsets = self.offsets[1..].chunks_mut(vertices);
        let rows = offsets.zip(self.classes.chunks_mut(vertices)).zip(self.order.chunks_mut(vertices));
        let parts = rows.zip(&mut self.stretches).enumerate();
        parts.map(move |(part, (((ends, classes), order), stretch))| RingPart {
            first: part * vertices,
            vertex_count,
            ends,
            classes,
            order,
            stretch,
            filled: 0,
        })
    }

    /// The rings, and the faces beside their entries if those are kept; the stretches are joined by up to `threads`
    /// threads.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    ///
    /// # Panics
    /// Where a part has not been filled.
    pub(crate) fn join(self, threads: usize) -> Result<(Rings, Vec<u32>), Error> {
        let RingTable { mut offsets, classes, order, stretch, mut stretches } = self;
        let windows = classes.len().div_ceil(WINDOW);
        assert_eq!(stretches.iter().map(|stretch| stretch.window_slices.len()).sum::<usize>(), windows);
        for Stretch { entries, faces, sealed, .. } in &stretches {
            assert!(entries.len() == *sealed && faces.as_ref().is_none_or(|faces| faces.len() == *sealed));
        }
        let mut slices = reserved(stretches.iter().map(|stretch| stretch.slices.len()).sum())?;
        let mut window_slices = reserved(windows + 1)?;
        for stretch in &stretches {
            let base = slices.len() as u32;
            window_slices.extend(stretch.window_slices.iter().map(|start| base + start));
            slices.extend_from_slice(&stretch.slices);
        }
        window_slices.push(slices.len() as u32);

        let lengths: Vec<usize> = {
            let mut lengths = reserved(stretches.len())?;
            lengths.extend(stretches.iter().map(|stretch| stretch.entries.len()));
            lengths
        };
        let mut base = 0;
        let bases = lengths.iter().map(|length| {
            base += *length as u32;
            base - *length as u32
        });
        let moved = offsets[1..].chunks_mut(stretch).zip(bases).filter(|(_, base)| *base > 0);
        for_each_part(threads, moved, |(ends, base)| ends.iter_mut().for_each(|end| *end += base));

        let mut faces = reserved(stretches.len())?;
        faces.extend(stretches.iter_mut().filter_map(|stretch| stretch.faces.take()));
        let mut entries = reserved(stretches.len())?;
        entries.extend(stretches.into_iter().map(|stretch| stretch.entries));
        let neighbours = joined(threads, entries)?;
        Ok((Rings::from_table(offsets, neighbours, classes, order, slices, window_slices), joined(threads, faces)?))
    }
}

/// The rows one after the other.
fn joined(threads: usize, mut rows: Vec<Vec<u32>>) -> Result<Vec<u32>, Error> {
    if rows.len() <= 1 {
        let mut only = rows.pop().unwrap_or_default();
        only.shrink_to_fit();
        return Ok(only);
    }
    let total = rows.iter().map(Vec::len).sum();
    let mut all: Vec<u32> = room(total)?;
    let mut rest = &mut all.spare_capacity_mut()[..total];
    let pieces = rows.into_iter().map(|row| {
        let (piece, others) = std::mem::take(&mut rest).split_at_mut(row.len());
        rest = others;
        (piece, row)
    });
    for_each_part(threads, pieces, |(piece, row)| {
        for (place, value) in piece.iter_mut().zip(row) {
            place.write(value);
        }
    });
    // SAFETY: the pieces are all of it, and each has been written.
    unsafe { all.set_len(total) };
    Ok(all)
}

/// A stretch of vertices of a table; see [`RingPart::push`].
pub(crate) struct RingPart<'a> {
    first: usize,
    vertex_count: usize,
    /// Where each ring ends, counted from the first of the stretch.
    ends: &'a mut [u32],
    classes: &'a mut [u8],
    order: &'a mut [u16],
    stretch: &'a mut Stretch,
    /// How many vertices have their ring.
    filled: usize,
}

impl RingPart<'_> {
    /// The first vertex.
    pub(crate) fn first(&self) -> usize {
        self.first
    }

    /// How many vertices.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.classes.len()
    }

    /// How many entries there are.
    #[inline(always)]
    pub(crate) fn entry_count(&self) -> usize {
        self.stretch.entries.len()
    }

    /// Makes room for `count` entries once, before the first.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub(crate) fn start(&mut self, count: usize) -> Result<(), Error> {
        assert_eq!(self.filled, 0);
        self.stretch.entries = room(count)?;
        if let Some(faces) = &mut self.stretch.faces {
            *faces = room(count)?;
        }
        let windows = self.len().div_ceil(WINDOW);
        self.stretch.window_slices = reserved(windows)?;
        self.stretch.slices.try_reserve_exact(windows * 4)?;
        Ok(())
    }

    /// Makes room for `count` more entries.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    #[inline(always)]
    pub(crate) fn reserve(&mut self, count: usize) -> Result<(), Error> {
        let Stretch { entries, faces, .. } = &mut *self.stretch;
        for row in std::iter::once(entries).chain(faces) {
            if row.capacity() - row.len() < count {
                row.try_reserve_exact(count.max(row.len() / 8))?;
            }
        }
        Ok(())
    }

    /// Appends the first `count` of `N` entries to the ring of the vertex that is next, and their faces where these are
    /// kept; there is room for `N`.
    #[inline(always)]
    pub(crate) fn push<const N: usize>(&mut self, neighbours: &[u32; N], faces: &[u32; N], count: usize) {
        assert!(count <= N);
        // All of them, which the compiler makes a few wide stores, and then the count that is meant.
        let append = |rows: &mut Vec<u32>, values: &[u32; N]| {
            let spare = &mut rows.spare_capacity_mut()[..N];
            for place in 0..N {
                spare[place].write(values[place]);
            }
            // SAFETY: so many have just been written.
            unsafe { rows.set_len(rows.len() + count) };
        };
        append(&mut self.stretch.entries, neighbours);
        if let Some(rows) = &mut self.stretch.faces {
            append(rows, faces);
        }
    }

    /// Ends the ring of the vertex that is next. Its class is one for lanes if it has a single fan of at most
    /// [`MAX_LANE_CORNERS`](super::MAX_LANE_CORNERS) corners, or isolated if it has no face.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    ///
    /// # Panics
    /// Where the ring is not as long as its class says.
    #[inline(always)]
    pub(crate) fn end_ring(&mut self, class: RingClass) -> Result<(), Error> {
        let end = self.entry_count() as u32;
        let start = if self.filled > 0 { self.ends[self.filled - 1] } else { 0 };
        let entries = (end - start) as usize;
        match class {
            RingClass::Isolated => assert_eq!(entries, 0),
            RingClass::Lanes { corners, closed } => assert_eq!(entries, corners + !closed as usize),
            RingClass::Alone => {}
        }
        self.ends[self.filled] = end;
        self.classes[self.filled] = class.code();
        self.filled += 1;
        if self.filled.is_multiple_of(WINDOW) || self.filled == self.len() {
            self.seal()?;
        }
        Ok(())
    }

    /// Checks the entries of the window that has just been filled, and sorts its vertices by class.
    #[inline(always)]
    fn seal(&mut self) -> Result<(), Error> {
        let window = (self.filled - 1) / WINDOW * WINDOW..self.filled;
        let last = self.vertex_count - 1;
        let entries = &self.stretch.entries[self.stretch.sealed..];
        let largest = entries.iter().fold(0, |largest, &entry| entry.max(largest)) as usize;
        assert!(entries.is_empty() || largest <= last);
        if !entries.is_empty() && largest == last {
            for (index, _) in entries.iter().enumerate().filter(|(_, entry)| **entry as usize == last) {
                let place =
                    self.ends[..self.filled].partition_point(|&end| end as usize <= self.stretch.sealed + index);
                self.classes[place] = RingClass::Alone.code();
            }
        }
        self.stretch.sealed += entries.len();
        if self.first + self.filled == self.vertex_count
            && self.classes[self.filled - 1] != RingClass::Isolated.code()
        {
            self.classes[self.filled - 1] = RingClass::Alone.code();
        }
        let Stretch { slices, window_slices, .. } = &mut *self.stretch;
        window_slices.push(slices.len() as u32);
        slices.try_reserve(CLASSES)?;
        let sorted = &mut self.order[window.clone()];
        bucket(&self.classes[window], |place, index| sorted[place] = index as u16, |slice| slices.push(slice));
        Ok(())
    }
}
