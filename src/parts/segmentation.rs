//! What all segmentations have in common: a label for each face, the edges between segments, and sums over segments.
//!
//! Labels are numbered in the order of their smallest face, so they follow from which faces are together and from nothing else. Faces that
//! are ignored (fewer than three distinct corners in a row) have [`NO_SEGMENT`]. Faces meet across an edge only where it has exactly
//! two and they run through it in opposite directions; a segment is connected in this sense.
//!
//! An edge is on the boundary between segments if faces at it carry different labels. That holds for every edge: also where more
//! than two faces meet, or two of the same direction, which separates them for an algorithm but need not separate their labels. Edges with
//! a single face are no boundary between segments.
//!
//! Numerical notes: sums are added face by face in `f64`, and lengths are taken in parts of the mesh's extent before they are
//! multiplied, so a mesh may be of any size. Cost: linear, apart from sorting the boundary edges. Held are 4 bytes a face and 8 a boundary edge.

use super::face_graph::{FaceGraph, NO_FACE};
use super::scalar_field::ScalarField;
use crate::error::Error;
use crate::simd::Real;
use crate::sweep::area_vector;
use crate::topology::has_three_corners;
use crate::view::{Coordinate, Faces, Index, PointArray, Points, StridedPoints, filled, with_indices, zeroed};

/// The label of faces that are ignored.
pub const NO_SEGMENT: u32 = u32::MAX;

/// The faces of a mesh in segments.
#[derive(Clone, Debug)]
pub struct Segmentation {
    labels: Vec<u32>,
    count: usize,
    boundary: Vec<[u32; 2]>,
    vertex_count: usize,
}

impl Segmentation {
    /// Of faces that are together if `group` says the same number, which is below the number of faces.
    pub(super) fn new(
        graph: &FaceGraph<'_>,
        vertex_count: usize,
        mut group: impl FnMut(usize) -> u32,
    ) -> Result<Self, Error> {
        let face_count = graph.faces.len();
        let mut labels = filled(face_count, NO_SEGMENT)?;
        let mut label_of = filled(face_count, NO_SEGMENT)?;
        let mut count = 0;
        for face in (0..face_count).filter(|&face| graph.is_used(face)) {
            let label = &mut label_of[group(face) as usize];
            if *label == NO_SEGMENT {
                *label = count;
                count += 1;
            }
            labels[face] = *label;
        }
        drop(label_of);
        let boundary = boundary(graph, &labels)?;
        Ok(Segmentation { labels, count: count as usize, boundary, vertex_count })
    }

    /// The label of each face, `#F`: below [`Segmentation::count`], or [`NO_SEGMENT`].
    pub fn labels(&self) -> &[u32] {
        &self.labels
    }

    /// The number of segments.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The edges between segments, each once, as its lower and its higher vertex, ascending.
    pub fn boundary_edges(&self) -> &[[u32; 2]] {
        &self.boundary
    }

    /// The area of each segment, length²; beyond the range its largest value. A polygon's area is the length of its area vector.
    ///
    /// # Errors
    /// [`Error::Size`] for other faces or points than those of the segmentation; [`Error::IndexOutOfRange`];
    /// [`Error::NonFinitePosition`]; [`Error::OutOfMemory`].
    pub fn areas(&self, faces: &Faces<'_>, points: &Points<'_>) -> Result<Vec<f64>, Error> {
        self.check(faces, points)?;
        let unit = unit_of(points);
        let mut sums: Vec<f64> = zeroed(self.count)?;
        for (&label, area) in self.labels.iter().zip(face_areas(faces, points, unit)?) {
            if label != NO_SEGMENT {
                sums[label as usize] += area;
            }
        }
        for sum in &mut sums {
            *sum = (*sum / unit / unit).min(f64::MAX);
        }
        Ok(sums)
    }

    /// The mean of a scalar over each segment, weighted by area; over a segment without area that of its faces.
    ///
    /// # Errors
    /// As [`Segmentation::areas`]; [`Error::NonFiniteScalar`].
    pub fn means(&self, faces: &Faces<'_>, points: &Points<'_>, field: &ScalarField<'_>) -> Result<Vec<f64>, Error> {
        self.check(faces, points)?;
        field.check("field", faces, self.vertex_count)?;
        let values = field.of_faces(faces, 1)?;
        let areas = face_areas(faces, points, unit_of(points))?;
        let mut weights: Vec<[f64; 2]> = zeroed(self.count)?;
        for (&label, area) in self.labels.iter().zip(&areas).filter(|&(&label, _)| label != NO_SEGMENT) {
            let [sum, count] = &mut weights[label as usize];
            (*sum, *count) = (*sum + area, *count + 1.0);
        }
        let mut means: Vec<f64> = zeroed(self.count)?;
        for (face, &label) in self.labels.iter().enumerate().filter(|&(_, &label)| label != NO_SEGMENT) {
            let [sum, count] = weights[label as usize];
            // Shares of the whole, so that numbers near the end of the range do not leave it on the way.
            let share = if sum > 0.0 { areas[face] / sum } else { 1.0 / count };
            means[label as usize] += share * values[face];
        }
        for mean in &mut means {
            *mean = mean.clamp(-f64::MAX, f64::MAX);
        }
        Ok(means)
    }

    fn check(&self, faces: &Faces<'_>, points: &Points<'_>) -> Result<(), Error> {
        for (what, found, expected) in
            [("faces.count", faces.len(), self.labels.len()), ("points.count", points.len(), self.vertex_count)]
        {
            if found != expected {
                return Err(Error::Size { what, found: found as u64, expected: expected as u64 });
            }
        }
        faces.indices().check_range("faces.indices", points.len())?;
        points.check_finite()
    }
}

/// The edges whose faces carry different labels.
fn boundary(graph: &FaceGraph<'_>, labels: &[u32]) -> Result<Vec<[u32; 2]>, Error> {
    let mut edges: Vec<[u32; 2]> = Vec::new();
    // Edges that are not those of exactly two faces, with the label of each face at them.
    let mut others: Vec<([u32; 2], u32)> = Vec::new();
    for face in (0..labels.len()).filter(|&face| graph.is_used(face)) {
        for corner in graph.faces.range(face) {
            let across = graph.across(corner);
            if across != NO_FACE && ((across as usize) < face || labels[across as usize] == labels[face]) {
                continue;
            }
            let [from, to] = graph.ends(corner, face);
            let edge = [from.min(to), from.max(to)];
            if across != NO_FACE {
                edges.try_reserve(1)?;
                edges.push(edge);
            } else if from != to {
                others.try_reserve(1)?;
                others.push((edge, labels[face]));
            }
        }
    }
    others.sort_unstable();
    for sides in others.chunk_by(|a, b| a.0 == b.0) {
        // Sorted, so the ends differ if any do.
        if sides[0].1 != sides[sides.len() - 1].1 {
            edges.try_reserve(1)?;
            edges.push(sides[0].0);
        }
    }
    edges.sort_unstable();
    Ok(edges)
}

/// A power of two by which lengths can be multiplied before they are squared.
pub(super) fn unit_of(points: &Points<'_>) -> f64 {
    let largest =
        (0..points.len()).fold(0.0, |largest: f64, vertex| largest.max(points.get(vertex).abs().max_element()));
    largest.inverse_power_of_two()
}

/// The area of each face, where lengths are multiplied by `unit`; 0 for ignored faces.
pub(super) fn face_areas(faces: &Faces<'_>, points: &Points<'_>, unit: f64) -> Result<Vec<f64>, Error> {
    fn each<S: Coordinate, I: Index>(
        faces: &Faces<'_>,
        indices: &[I],
        points: &StridedPoints<'_, S>,
        unit: f64,
        areas: &mut [f64],
    ) {
        for (face, area) in areas.iter_mut().enumerate() {
            let corners = &indices[faces.range(face)];
            if has_three_corners(corners) {
                *area = area_vector(points, corners).map_or(0.0, |vector| vector.area(unit));
            }
        }
    }
    let mut areas = zeroed(faces.len())?;
    with_indices!(faces.indices(), indices => match points.array() {
        PointArray::F32(points) => each(faces, indices, points, unit, &mut areas),
        PointArray::F64(points) => each(faces, indices, points, unit, &mut areas),
    });
    Ok(areas)
}
