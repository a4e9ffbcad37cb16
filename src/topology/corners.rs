//! The corners of faces, handed to their vertices as records.

use super::polygons::Polygons;
use crate::error::Error;
use crate::view::{Index, Put, SlotsPart};

/// A corner as its vertex sees it: the neighbour that follows in the face, the one before, and perhaps the face.
pub(super) trait Record: Copy {
    /// The next corner of the face.
    fn next(self) -> u32;
    /// The previous corner of the face.
    fn prev(self) -> u32;
    /// The face, if it is kept.
    fn face(self) -> Option<u32>;
}

/// Words of a record of a mesh of triangles, whose faces follow from their corners.
pub(super) const BARE: usize = 2;

/// Words of a record of a mesh of polygons.
pub(super) const WITH_FACE: usize = 3;

impl<const WORDS: usize> Record for [u32; WORDS] {
    #[inline(always)]
    fn next(self) -> u32 {
        self[0]
    }
    #[inline(always)]
    fn prev(self) -> u32 {
        self[1]
    }
    #[inline(always)]
    fn face(self) -> Option<u32> {
        self.get(2).copied()
    }
}

/// A record that found no slot.
#[derive(Clone, Copy)]
pub(super) struct Spilt<const WORDS: usize> {
    pub vertex: u32,
    pub record: [u32; WORDS],
    /// Its place among those that found none.
    place: u32,
}

/// The records that found no slot.
pub(super) struct Spill<const WORDS: usize>(Vec<Spilt<WORDS>>);

impl<const WORDS: usize> Spill<WORDS> {
    /// Adds a record to a vertex's slots, or to those that found none.
    #[inline(always)]
    fn put(&mut self, part: &mut SlotsPart<'_, WORDS>, vertex: u32, record: [u32; WORDS]) -> Result<(), Error> {
        if part.put(vertex, record) == Put::Full { self.push(vertex, record) } else { Ok(()) }
    }

    #[cold]
    #[inline(never)]
    fn push(&mut self, vertex: u32, record: [u32; WORDS]) -> Result<(), Error> {
        self.0.try_reserve(1)?;
        self.0.push(Spilt { vertex, record, place: self.0.len() as u32 });
        Ok(())
    }

    /// By vertex, at each in the order in which they came.
    fn sorted(mut self) -> Vec<Spilt<WORDS>> {
        self.0.sort_unstable_by_key(|spilt| (spilt.vertex, spilt.place));
        self.0
    }
}

/// How many faces ahead the slots of a face's vertices are fetched into the cache.
const AHEAD: usize = 24;

/// Faces, as a source of records of `WORDS` words.
pub(super) trait Corners<const WORDS: usize>: Sync {
    /// Hands the corners of all faces that are not ignored to the vertices of a part, in face order; answers with the
    /// records for which there was no slot, by vertex.
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`], [`Error::OutOfMemory`].
    fn hand_out(&self, part: &mut SlotsPart<'_, WORDS>) -> Result<Vec<Spilt<WORDS>>, Error>;
}

/// Faces of three corners.
pub(super) struct Triangles<'a, I> {
    pub indices: &'a [I],
    pub vertex_count: usize,
}

impl<I: Index> Corners<BARE> for Triangles<'_, I> {
    fn hand_out(&self, part: &mut SlotsPart<'_, BARE>) -> Result<Vec<Spilt<BARE>>, Error> {
        let mut spill = Spill(Vec::new());
        let limit = self.vertex_count as u64;
        let last = self.indices.len().saturating_sub(3);
        for (face, corners) in self.indices.chunks_exact(3).enumerate() {
            let ahead = &self.indices[(3 * (face + AHEAD)).min(last)..][..3];
            part.prefetch(ahead[0].widen() as u32);
            part.prefetch(ahead[1].widen() as u32);
            part.prefetch(ahead[2].widen() as u32);
            if corners[0].reaches(limit) | corners[1].reaches(limit) | corners[2].reaches(limit) {
                let offset = corners.iter().position(|corner| corner.reaches(limit)).unwrap_or(0);
                return Err(Error::IndexOutOfRange {
                    what: "faces.indices",
                    position: (3 * face + offset) as u64,
                    index: corners[offset].as_written(),
                    vertex_count: limit,
                });
            }
            let (a, b, c) = (corners[0].widen() as u32, corners[1].widen() as u32, corners[2].widen() as u32);
            if a == b || b == c || c == a {
                continue;
            }
            spill.put(part, a, [b, c])?;
            spill.put(part, b, [c, a])?;
            spill.put(part, c, [a, b])?;
        }
        Ok(spill.sorted())
    }
}

impl Corners<WITH_FACE> for Polygons {
    fn hand_out(&self, part: &mut SlotsPart<'_, WITH_FACE>) -> Result<Vec<Spilt<WITH_FACE>>, Error> {
        let mut spill = Spill(Vec::new());
        for face in 0..self.face_count() {
            let ahead = (face + AHEAD).min(self.face_count() - 1);
            self.face(ahead).iter().take(8).for_each(|&vertex| part.prefetch(vertex));
            let corners = self.face(face);
            let mut prev = corners.last().copied().unwrap_or(0);
            for (index, &vertex) in corners.iter().enumerate() {
                let next = corners.get(index + 1).copied().unwrap_or(corners[0]);
                spill.put(part, vertex, [next, prev, face as u32])?;
                prev = vertex;
            }
        }
        Ok(spill.sorted())
    }
}
