//! The polygon mesh that the program reads, generates, draws and writes.
//!
//! Faces may have any number of corners and are stored one after the other in a single index array (compressed sparse
//! rows), so a mesh of a million triangles takes three allocations instead of a million. The mesh is plain data: it
//! says nothing about the topology, and a file may well hold faces with fewer than three corners, repeated corners or
//! unused vertices.

/// A mesh of polygons that share vertices.
#[derive(Debug, Clone, PartialEq)]
pub struct PolygonMesh {
    /// The position of each vertex.
    pub positions: Vec<[f64; 3]>,
    /// Where the corners of each face start in `indices`, followed by the length of `indices`: face `f` owns
    /// `offsets[f]..offsets[f + 1]`.
    pub offsets: Vec<u32>,
    /// The vertex at each corner, face after face.
    pub indices: Vec<u32>,
}

impl Default for PolygonMesh {
    /// A mesh without vertices and faces, which still needs its first offset.
    fn default() -> Self {
        Self { positions: Vec::new(), offsets: vec![0], indices: Vec::new() }
    }
}

impl PolygonMesh {
    /// Builds a mesh from faces that all have `N` corners.
    pub fn from_uniform_faces<const N: usize>(positions: Vec<[f64; 3]>, faces: &[[u32; N]]) -> Self {
        Self {
            positions,
            offsets: (0..=faces.len()).map(|face| (face * N) as u32).collect(),
            indices: faces.as_flattened().to_vec(),
        }
    }

    /// The number of vertices, used or not.
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// The number of faces.
    pub fn face_count(&self) -> usize {
        self.offsets.len().saturating_sub(1)
    }

    /// The vertices around each face, in the order of the faces.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        self.offsets.windows(2).map(|range| &self.indices[range[0] as usize..range[1] as usize])
    }

    /// The smallest and the largest coordinates over all finite vertices, or `None` when there is no finite vertex.
    pub fn bounding_box(&self) -> Option<([f64; 3], [f64; 3])> {
        self.positions.iter().filter(|position| position.iter().all(|value| value.is_finite())).fold(
            None,
            |bounds, &position| {
                let (low, high) = bounds.unwrap_or((position, position));
                Some((
                    std::array::from_fn(|axis| f64::min(low[axis], position[axis])),
                    std::array::from_fn(|axis| f64::max(high[axis], position[axis])),
                ))
            },
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_empty_mesh_has_no_faces_and_no_box() {
        let mesh = PolygonMesh::default();
        assert_eq!(mesh.vertex_count(), 0);
        assert_eq!(mesh.face_count(), 0);
        assert_eq!(mesh.faces().count(), 0);
        assert_eq!(mesh.bounding_box(), None);
    }

    #[test]
    fn faces_are_the_slices_between_offsets() {
        let mesh = PolygonMesh {
            positions: vec![[0.0; 3]; 5],
            offsets: vec![0, 3, 3, 7],
            indices: vec![0, 1, 2, 4, 3, 2, 1],
        };
        let faces: Vec<&[u32]> = mesh.faces().collect();
        assert_eq!(faces, [&[0, 1, 2][..], &[], &[4, 3, 2, 1]]);
    }

    #[test]
    fn the_box_spans_finite_vertices_only() {
        let mesh = PolygonMesh {
            positions: vec![[1.0, -2.0, 3.0], [f64::NAN, 9.0, 9.0], [-1.0, 4.0, 0.5]],
            ..PolygonMesh::default()
        };
        let expected = ([-1.0, -2.0, 0.5], [1.0, 4.0, 3.0]);
        assert_eq!(mesh.bounding_box(), Some(expected));
    }
}
