//! Splits polygons into triangles for drawing.
//!
//! A polygon may be concave and need not be exactly flat. One that crosses itself is split somehow, and one with a
//! position that is not finite is left out.

use crate::mesh::PolygonMesh;
use earcut::Earcut;
use earcut::utils3d::project3d_to_2d;

/// Splits polygons into triangles, keeping its buffers from face to face.
#[derive(Default)]
pub(super) struct Triangulator {
    /// The polygon splitter with its memory.
    earcut: Earcut<f64>,
    /// The polygon in space.
    polygon: Vec<[f64; 3]>,
    /// The polygon in its own plane.
    flat: Vec<[f64; 2]>,
    /// The corners of the triangles as indices into the polygon.
    corners: Vec<u32>,
}

impl Triangulator {
    /// Splits a face into triangles of corners, by their place in the face, and their positions.
    pub(super) fn triangulate(
        &mut self,
        mesh: &PolygonMesh,
        face: &[u32],
    ) -> impl Iterator<Item = [(usize, [f64; 3]); 3]> {
        self.polygon.clear();
        self.polygon.extend(face.iter().map(|&vertex| mesh.positions[vertex as usize]));
        self.corners.clear();
        let finite = self.polygon.as_flattened().iter().all(|x| x.is_finite());
        if finite && face.len() > 3 && project3d_to_2d(&self.polygon, face.len(), &mut self.flat) {
            self.earcut.earcut_slice(&self.flat, &[], &mut self.corners);
        }
        // Polygons that are no polygons in any plane still deserve a picture.
        if finite && self.corners.is_empty() {
            let last = face.len().saturating_sub(1) as u32;
            self.corners.extend((1..last).flat_map(|corner| [0, corner, corner + 1]));
        }
        self.corners
            .as_chunks::<3>()
            .0
            .iter()
            .map(|triangle| triangle.map(|corner| (corner as usize, self.polygon[corner as usize])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The triangles of a single polygon, by its corners.
    fn split(positions: Vec<[f64; 3]>) -> Vec<[usize; 3]> {
        let face: Vec<u32> = (0..positions.len() as u32).collect();
        let mesh = PolygonMesh { positions, ..PolygonMesh::default() };
        let mut triangulator = Triangulator::default();
        let triangles = triangulator.triangulate(&mesh, &face);
        triangles.map(|corners| corners.map(|(corner, _)| corner)).collect()
    }

    #[test]
    fn concave_polygons_keep_their_area_and_sense_of_rotation() {
        let outline = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [3.0, 1.0]];
        for reversed in [false, true] {
            let mut points = outline;
            if reversed {
                points.reverse();
            }
            let triangles = split(points.iter().map(|&[x, y]| [7.0, x, y]).collect());
            let areas = triangles.iter().map(|triangle| {
                let [a, b, c] = triangle.map(|corner| points[corner]);
                (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            });
            let areas: Vec<f64> = areas.collect();
            let sign = if reversed { -1.0 } else { 1.0 };
            assert!(areas.iter().all(|area| area * sign > 0.0), "{areas:?}");
            assert!((areas.iter().sum::<f64>() * sign - 8.0).abs() < 1e-9);
        }
    }

    #[test]
    fn degenerate_polygons_are_split_or_left_out() {
        assert_eq!(split(vec![[1.0; 3]; 5]).len(), 3);
        assert_eq!(split(vec![[1.0; 3]; 2]).len(), 0);
        assert_eq!(split(Vec::new()).len(), 0);
        assert_eq!(split(vec![[f64::NAN; 3]; 4]).len(), 0);
    }
}
