//! Which faces meet across which edges: for each corner, the corner on the other side of the edge that starts there.
//!
//! The rule is that of the one-rings: two faces meet across an edge only where it has exactly two and they run through it in
//! opposite directions. Edges from a vertex to itself are none, and faces of fewer than three distinct corners in a row have none.
//!
//! Cost: linear in the number of corners, apart from sorting the edges at each vertex. Held are 4 bytes a corner; while building,
//! 8 more, and 4 a vertex.

use crate::error::Error;
use crate::view::{Faces, Index, filled, with_indices, zeroed};

/// Stands where there is no corner: at an edge with one face, with more than two, or with two of the same direction.
pub(crate) const NO_CORNER: u32 = u32::MAX;

/// Faces across edges. Corners are counted as in the caller's index array.
#[derive(Debug)]
pub(crate) struct Adjacency {
    opposite: Vec<u32>,
}

impl Adjacency {
    /// # Errors
    /// [`Error::IndexOutOfRange`]; [`Error::TooLarge`] beyond 2³¹ − 1 corners; [`Error::OutOfMemory`].
    pub fn new(faces: &Faces<'_>, vertex_count: usize) -> Result<Self, Error> {
        let limit = u32::MAX as u64 / 2;
        for (what, found) in [("corners", faces.indices().len()), ("vertices", vertex_count), ("faces", faces.len())]
        {
            if found as u64 > limit {
                return Err(Error::TooLarge { what, found: found as u64, limit });
            }
        }
        faces.indices().check_range("faces.indices", vertex_count)?;
        with_indices!(faces.indices(), indices => Self::build(faces, indices, vertex_count))
    }

    fn build<I: Index>(faces: &Faces<'_>, indices: &[I], vertex_count: usize) -> Result<Self, Error> {
        // Counting sort by the lower vertex; a key is the higher one, the corner, and whether the edge runs upwards.
        let mut ends: Vec<u32> = zeroed(vertex_count + 1)?;
        for_each_edge(faces, indices, |_, from, to| ends[from.min(to) as usize + 1] += 1);
        for vertex in 0..vertex_count {
            ends[vertex + 1] += ends[vertex];
        }
        let mut keys: Vec<u64> = zeroed(ends[vertex_count] as usize)?;
        for_each_edge(faces, indices, |corner, from, to| {
            let place = &mut ends[from.min(to) as usize];
            keys[*place as usize] = (from.max(to) as u64) << 32 | (corner as u64) << 1 | (from < to) as u64;
            *place += 1;
        });
        let mut opposite = filled(indices.len(), NO_CORNER)?;
        let mut start = 0;
        for &end in &ends[..vertex_count] {
            let edges = &mut keys[start..end as usize];
            start = end as usize;
            edges.sort_unstable();
            for sides in edges.chunk_by(|a, b| a >> 32 == b >> 32) {
                if let &[a, b] = sides
                    && (a ^ b) & 1 == 1
                {
                    let corner = |key: u64| (key as u32) >> 1;
                    opposite[corner(a) as usize] = corner(b);
                    opposite[corner(b) as usize] = corner(a);
                }
            }
        }
        Ok(Adjacency { opposite })
    }

    /// The corner of the other face at the other end of the edge that starts at `corner`; [`NO_CORNER`] if there is none.
    #[inline(always)]
    pub fn opposite(&self, corner: usize) -> u32 {
        self.opposite[corner]
    }
}

/// Whether a face has as many corners without those that repeat the one before: if not, it is ignored.
pub(crate) fn has_three_corners<I: Index>(corners: &[I]) -> bool {
    let steps = |place: usize| {
        let next = if place + 1 == corners.len() { 0 } else { place + 1 };
        corners[place].widen() != corners[next].widen()
    };
    (0..corners.len()).filter(|&place| steps(place)).take(3).count() == 3
}

/// Calls `edge(corner, from, to)` for the edge that starts at each corner, but for edges from a vertex to itself and those of faces
/// that are ignored.
fn for_each_edge<I: Index>(faces: &Faces<'_>, indices: &[I], mut edge: impl FnMut(usize, u32, u32)) {
    for face in 0..faces.len() {
        let range = faces.range(face);
        let corners = &indices[range.clone()];
        if !has_three_corners(corners) {
            continue;
        }
        let mut to = corners[0].widen() as u32;
        for place in (0..corners.len()).rev() {
            let from = corners[place].widen() as u32;
            if from != to {
                edge(range.start + place, from, to);
            }
            to = from;
        }
    }
}
