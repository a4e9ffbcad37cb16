//! The faces of a mesh that has others than triangles, kept because their normals need all their corners.

use crate::error::{Error, reserved};
use crate::view::{Faces, Index, with_indices};

/// Cleaned faces, and the face of every ring entry.
#[derive(Debug)]
pub(crate) struct Polygons {
    /// Face `f` has the corners `vertices[offsets[f]..offsets[f + 1]]`; none where the face is ignored.
    offsets: Vec<u32>,
    vertices: Vec<u32>,
    /// The most corners that a face has.
    most_corners: usize,
    /// Parallel to the flat ring array: the face between this neighbour and the next; [`NO_FACE`](super::NO_FACE) at
    /// the end of an open fan.
    corner_faces: Vec<u32>,
}

impl Polygons {
    /// Copies `faces` without repetitions of a vertex in a row; also the number of faces that had some or that have
    /// fewer than three corners.
    pub(super) fn new(faces: &Faces<'_>) -> Result<(Self, usize), Error> {
        with_indices!(faces.indices(), indices => Self::clean(faces, indices))
    }

    fn clean<I: Index>(faces: &Faces<'_>, indices: &[I]) -> Result<(Self, usize), Error> {
        let mut offsets = reserved(faces.len() + 1)?;
        let mut vertices: Vec<u32> = reserved(indices.len())?;
        let (mut degenerate, mut most_corners) = (0, 0);
        offsets.push(0);
        for face in 0..faces.len() {
            let corners = &indices[faces.range(face)];
            let start = vertices.len();
            for corner in corners {
                let vertex = corner.widen() as u32;
                if vertices[start..].last() != Some(&vertex) {
                    vertices.push(vertex);
                }
            }
            while vertices.len() > start + 1 && vertices.last() == Some(&vertices[start]) {
                vertices.pop();
            }
            if vertices.len() - start < 3 {
                vertices.truncate(start);
            }
            most_corners = most_corners.max(vertices.len() - start);
            degenerate += (vertices.len() - start != corners.len() || corners.len() < 3) as usize;
            offsets.push(vertices.len() as u32);
        }
        Ok((Polygons { offsets, vertices, most_corners, corner_faces: Vec::new() }, degenerate))
    }

    pub(crate) fn face_count(&self) -> usize {
        self.offsets.len() - 1
    }

    /// The most corners that a face has.
    pub(crate) fn most_corners(&self) -> usize {
        self.most_corners
    }

    /// Where each face's corners start in [`Polygons::vertices`], and the end of the last.
    #[inline(always)]
    pub(crate) fn offsets(&self) -> &[u32] {
        &self.offsets
    }

    /// The corners of all faces.
    #[inline(always)]
    pub(crate) fn vertices(&self) -> &[u32] {
        &self.vertices
    }

    /// The corners of a face, none where it is ignored.
    pub(crate) fn face(&self, face: usize) -> &[u32] {
        &self.vertices[self.offsets[face] as usize..self.offsets[face + 1] as usize]
    }

    /// The face between an entry of the flat ring array and the next.
    #[inline(always)]
    pub(crate) fn corner_face(&self, entry: usize) -> u32 {
        self.corner_faces[entry]
    }

    /// The face of every entry of the flat ring array.
    #[inline(always)]
    pub(crate) fn all_corner_faces(&self) -> &[u32] {
        &self.corner_faces
    }

    /// The faces of a stretch of the flat ring array.
    #[inline(always)]
    pub(crate) fn corner_faces(&self, entries: std::ops::Range<usize>) -> &[u32] {
        &self.corner_faces[entries]
    }

    /// The number of faces that are not ignored.
    pub(super) fn used_faces(&self) -> usize {
        (0..self.face_count()).filter(|&face| !self.face(face).is_empty()).count()
    }

    pub(super) fn set_corner_faces(&mut self, corner_faces: Vec<u32>) {
        self.corner_faces = corner_faces;
    }

    pub(super) fn bytes(&self) -> usize {
        4 * (self.offsets.capacity() + self.vertices.capacity() + self.corner_faces.capacity())
    }
}
