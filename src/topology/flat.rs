//! What the ring build reads and writes: corner records, and the flat ring array while it is filled.

use crate::error::Error;
use crate::view::{Zero, zeroed};

/// Stands in the table of corner faces at the end of an open fan.
pub(crate) const NO_FACE: u32 = u32::MAX;

/// Rings of up to this many corners are ordered in a window of as many records; larger ones are sorted.
pub(super) const WIDE: usize = 16;

/// A corner as its vertex sees it: the neighbour that follows in the face, the one before, and perhaps the face.
pub(super) trait Record: Zero {
    /// Whether the face is kept.
    const HAS_FACE: bool;
    /// A record, without the face if that is not kept.
    fn new(next: u32, prev: u32, face: u32) -> Self;
    /// The next corner of the face.
    fn next(self) -> u32;
    /// The previous corner of the face.
    fn prev(self) -> u32;
    /// The face, if it is kept.
    fn face(self) -> Option<u32>;
}

/// A record of a mesh of triangles, whose faces follow from their corners.
pub(super) type Bare = [u32; 2];

/// A record of a mesh of polygons.
pub(super) type WithFace = [u32; 3];

impl<const N: usize> Record for [u32; N] {
    const HAS_FACE: bool = N > 2;
    #[inline(always)]
    fn new(next: u32, prev: u32, face: u32) -> Self {
        std::array::from_fn(|place| [next, prev, face][place])
    }
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

/// The flat ring array while it is filled, and the faces beside it where they are kept.
///
/// It is zeroed ahead, so that whole windows can be written and only their count be kept.
pub(super) struct Flat {
    neighbours: Vec<u32>,
    faces: Option<Vec<u32>>,
    /// How many entries there are.
    pub length: usize,
}

impl Flat {
    pub fn new(corner_count: usize, faces: bool) -> Result<Self, Error> {
        // Room for some open fans, each of which has an entry more than corners.
        let room = corner_count + corner_count / 64 + WIDE;
        let faces = if faces { Some(zeroed(room)?) } else { None };
        Ok(Flat { neighbours: zeroed(room)?, faces, length: 0 })
    }

    /// Makes room for `count` entries.
    fn reserve(&mut self, count: usize) -> Result<(), Error> {
        let needed = self.length + count;
        if needed > self.neighbours.len() {
            for rows in std::iter::once(&mut self.neighbours).chain(&mut self.faces) {
                rows.try_reserve(needed + needed / 8 - rows.len())?;
                rows.resize(rows.capacity(), 0);
            }
        }
        Ok(())
    }

    /// Appends the first `count` of `N` entries.
    #[inline(always)]
    pub fn push_window<const N: usize>(
        &mut self,
        neighbours: &[u32; N],
        faces: &[u32; N],
        count: usize,
    ) -> Result<(), Error> {
        self.reserve(N)?;
        self.neighbours[self.length..self.length + N].copy_from_slice(neighbours);
        if let Some(rows) = &mut self.faces {
            rows[self.length..self.length + N].copy_from_slice(faces);
        }
        self.length += count;
        Ok(())
    }

    /// Appends an entry.
    pub fn push(&mut self, neighbour: u32, face: u32) -> Result<(), Error> {
        self.push_window(&[neighbour], &[face], 1)
    }

    pub fn finish(self) -> (Vec<u32>, Vec<u32>) {
        let [neighbours, faces] = [self.neighbours, self.faces.unwrap_or_default()].map(|mut rows| {
            rows.truncate(self.length);
            rows.shrink_to_fit();
            rows
        });
        (neighbours, faces)
    }
}
