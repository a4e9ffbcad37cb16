//! Corner normals: a unit normal for each corner of each face, smooth within a run of faces around a vertex and split at creases.
//!
//! They are the vertex normals of the [`CutMesh`], with any weight: an open run of faces counts as one at a boundary does. Where nothing
//! is cut they are the vertex normals themselves, to the bit if all outputs are of one scalar. With [`Weight::Angle`] they are what Blender shows for marked sharp edges and what
//! tools that bake for MikkTSpace expect: MikkTSpace computes tangents, and takes normals like these as given.
//!
//! Cost: that of the vertex normals, and a copy of positions and of results; of a list, of what it needs.

use super::affected::reach;
use super::cut::CutMesh;
use super::face_graph::report_end;
use crate::error::Error;
use crate::normals::{NormalOutputs, Weight, vertex_normals};
use crate::parallel::{Run, for_each_chunk};
use crate::simd::Real;
use crate::topology::closure;
use crate::view::{Output, Points, StatusOutput, zeroed};

/// Where the results of [`corner_normals`] go; all are optional.
#[derive(Debug, Default)]
pub struct CornerOutputs<'a> {
    /// A unit normal for each corner, `#C × 3`; zero where there is none.
    pub corner: Option<Output<'a>>,
    /// Normals and statuses by cut vertex, to which [`CutMesh::corners`] are the index.
    pub vertex: NormalOutputs<'a>,
}

/// Computes corner normals, and the vertex normals of the cut mesh that they come from. `points` are those of the original vertices.
/// [`Run::vertices`] lists cut vertices, and is for their normals only.
///
/// # Errors
/// [`Error::Size`] where counts do not fit; [`Error::NotApplicable`] for corners with a list of vertices; those of
/// [`vertex_normals`], with the original vertex of a position that is not finite.
pub fn corner_normals(
    cut: &CutMesh,
    points: &Points<'_>,
    weight: Weight,
    run: Run<'_>,
    outputs: &CornerOutputs<'_>,
) -> Result<(), Error> {
    if let Some(corner) = &outputs.corner {
        if corner.len() != cut.corners().len() {
            let (found, expected) = (corner.len() as u64, cut.corners().len() as u64);
            return Err(Error::Size { what: "corner.count", found, expected });
        }
        if run.vertices.is_some() {
            return Err(Error::NotApplicable { what: "corner normals of a list of vertices" });
        }
    }
    let found = if points.is_double() {
        let mut positions: Vec<[f64; 3]> = zeroed(cut.origins().len())?;
        copy(cut, points, weight, run.vertices, &positions.as_mut_slice().into())?;
        at_cut_vertices(cut, &positions[..].into(), weight, run, outputs)
    } else {
        let mut positions: Vec<[f32; 3]> = zeroed(cut.origins().len())?;
        copy(cut, points, weight, run.vertices, &positions.as_mut_slice().into())?;
        at_cut_vertices(cut, &positions[..].into(), weight, run, outputs)
    };
    found.map_err(|error| match error {
        Error::NonFinitePosition { vertex } => {
            Error::NonFinitePosition { vertex: cut.origins()[vertex as usize].into() }
        }
        other => other,
    })
}

/// The positions that the normals of a list need, or all.
fn copy(
    cut: &CutMesh,
    points: &Points<'_>,
    weight: Weight,
    list: Option<&[u32]>,
    positions: &Output<'_>,
) -> Result<(), Error> {
    match (list, reach(weight)) {
        (Some(list), Some(rings)) => {
            cut.check_counts(points, positions)?;
            // A list with a vertex that is none is refused where the normals are computed.
            if list.iter().all(|&vertex| (vertex as usize) < positions.len()) {
                for vertex in closure(cut.topology(), list, rings)? {
                    positions.copy(vertex as usize, points.get(cut.origins()[vertex as usize] as usize).to_array());
                }
            }
            Ok(())
        }
        _ => cut.copy(points, positions),
    }
}

fn at_cut_vertices(
    cut: &CutMesh,
    positions: &Points<'_>,
    weight: Weight,
    run: Run<'_>,
    outputs: &CornerOutputs<'_>,
) -> Result<(), Error> {
    let Some(corner) = &outputs.corner else {
        return vertex_normals(cut.topology(), positions, weight, run, &outputs.vertex);
    };
    let double = [Some(corner), outputs.vertex.normal.as_ref()].into_iter().flatten().any(Output::is_double);
    if double {
        let mut normals: Vec<[f64; 3]> = zeroed(positions.len())?;
        expand(cut, positions, weight, run, outputs, corner, &mut normals)
    } else {
        let mut normals: Vec<[f32; 3]> = zeroed(positions.len())?;
        expand(cut, positions, weight, run, outputs, corner, &mut normals)
    }
}

/// The share of the work that goes into vertex normals, for progress.
const SHARE: f64 = 0.7;

/// Corners, or vertices, that a thread copies at once.
const CHUNK: usize = 1 << 14;

/// Computes into `normals`, and copies from there.
fn expand<S: Real + Send + Sync>(
    cut: &CutMesh,
    positions: &Points<'_>,
    weight: Weight,
    mut run: Run<'_>,
    outputs: &CornerOutputs<'_>,
    corner: &Output<'_>,
    normals: &mut [[S; 3]],
) -> Result<(), Error>
where
    for<'a> &'a mut [[S; 3]]: Into<Output<'a>>,
{
    let asked = &outputs.vertex;
    if let Some(found) = asked.normal.as_ref().map(Output::len).filter(|&found| found != positions.len()) {
        return Err(Error::Size { what: "normal.count", found: found as u64, expected: positions.len() as u64 });
    }
    let own = NormalOutputs {
        normal: Some((&mut *normals).into()),
        sum: asked.sum.as_ref().map(Output::again),
        status: asked.status.as_ref().map(StatusOutput::again),
    };
    run.part(0.0, SHARE, |run| vertex_normals(cut.topology(), positions, weight, run, &own))?;
    if let Some(output) = &asked.normal {
        for (vertex, normal) in normals.iter().enumerate() {
            output.write(vertex, (*normal).map(Into::into));
        }
    }
    let (normals, corners) = (&*normals, cut.corners());
    if corners.is_empty() {
        report_end(&mut run);
        return Ok(());
    }
    run.part(SHARE, 1.0, |mut run| {
        for_each_chunk(&mut run, corners.len().div_ceil(CHUNK), |claims| {
            while let Some(chunk) = claims.next() {
                let first = chunk * CHUNK;
                corner.write_rows(first, normals, &corners[first..corners.len().min(first + CHUNK)]);
            }
        })
    })
}
