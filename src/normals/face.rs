//! Face normals.
//!
//! The normal of a polygon is the direction of its area vector, `½ Σ (pₖ − p₀) × (pₖ₊₁ − p₀)` (Newell's normal, taken
//! relative to the polygon), which is right for triangles, for concave and for non-planar polygons, and for corners
//! that are collinear or repeated. Computed in `f64`.
//!
//! Degenerate rule: a face whose area vector vanishes, or cancels out to rounding error, has the normal zero.
//! Cost: linear in the number of corners.

use crate::error::Error;
use crate::parallel::{Run, for_each_chunk};
use crate::sweep::area_vector;
use crate::topology::status;
use crate::view::{Coordinate, Faces, Index, Output, PointArray, Points, StatusOutput, StridedPoints, with_indices};
use glam::DVec3;

/// Where the results of [`face_normals`] go; all are optional, and each has an element for every face.
#[derive(Debug, Default)]
pub struct FaceOutputs<'a> {
    /// Unit normals, `#F × 3`; zero where there is none.
    pub normal: Option<Output<'a>>,
    /// Area vectors, `#F × 3`: along the normal, as long as the area is large (length²). Beyond the scalar's range its
    /// largest value stands.
    pub area_vector: Option<Output<'a>>,
    /// [`status`] bits, `#F`: 0 or [`status::DEGENERATE`].
    pub status: Option<StatusOutput<'a>>,
}

/// Computes the normals of all faces. No topology is needed. [`Run::vertices`] is ignored.
///
/// # Errors
/// [`Error::IndexOutOfRange`]; [`Error::NonFinitePosition`]; [`Error::Size`] where an output does not have an element
/// for every face; [`Error::Cancelled`].
pub fn face_normals(
    faces: &Faces<'_>,
    points: &Points<'_>,
    mut run: Run<'_>,
    outputs: &FaceOutputs<'_>,
) -> Result<(), Error> {
    let expected = faces.len() as u64;
    for (what, found) in [
        ("normal.count", outputs.normal.as_ref().map(Output::len)),
        ("area_vector.count", outputs.area_vector.as_ref().map(Output::len)),
        ("status.count", outputs.status.as_ref().map(StatusOutput::len)),
    ] {
        if let Some(found) = found.filter(|&found| found != faces.len()) {
            return Err(Error::Size { what, found: found as u64, expected });
        }
    }
    faces.indices().check_range("faces.indices", points.len())?;
    points.check_finite()?;
    with_indices!(faces.indices(), indices => match points.array() {
        PointArray::F32(points) => each_face(faces, indices, points, &mut run, outputs),
        PointArray::F64(points) => each_face(faces, indices, points, &mut run, outputs),
    })
}

fn each_face<S: Coordinate, I: Index>(
    faces: &Faces<'_>,
    indices: &[I],
    points: &StridedPoints<'_, S>,
    run: &mut Run<'_>,
    outputs: &FaceOutputs<'_>,
) -> Result<(), Error> {
    const CHUNK: usize = 4096;
    for_each_chunk(run, faces.len().div_ceil(CHUNK), |claims| {
        while let Some(chunk) = claims.next() {
            for face in chunk * CHUNK..faces.len().min((chunk + 1) * CHUNK) {
                let found = area_vector(points, &indices[faces.range(face)]);
                let normal = found.as_ref().map_or(DVec3::ZERO, |found| found.normal);
                if let Some(output) = &outputs.normal {
                    output.write(face, normal.to_array());
                }
                if let Some(output) = &outputs.area_vector {
                    let vector = found.as_ref().map_or(DVec3::ZERO, |found| found.in_mesh_units());
                    output.write(face, vector.to_array());
                }
                if let Some(output) = &outputs.status {
                    output.write(face, if found.is_some() { 0 } else { status::DEGENERATE });
                }
            }
        }
    })
}
