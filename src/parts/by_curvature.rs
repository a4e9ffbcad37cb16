//! Segmentations by curvatures that are computed for the purpose.
//!
//! Cost: that of the curvatures, and of [`watershed`] or [`region_growing`].

use super::face_graph::report;
use super::region_growing::{RegionOptions, region_growing};
use super::scalar_field::ScalarField;
use super::segmentation::Segmentation;
use super::shape::{shape_classes, shape_tolerance};
use super::watershed::watershed;
use crate::curvature::{CurvatureOptions, CurvatureOutputs, Method, curvatures};
use crate::error::Error;
use crate::parallel::Run;
use crate::topology::{Topology, status};
use crate::view::{Bytes, Faces, Points, zeroed};

/// The depth of basins of curvedness that [`watershed_of_curvedness`] merges by itself, in units of [`shape_tolerance`].
pub const CURVEDNESS_DEPTH: f64 = 4.0;

/// The tolerance of [`regions_of_shape`], in units of [`shape_tolerance`]: with adaptive jets it finds the fillets of boxes, clean or with noise
/// of 1 % of the edges; 1 makes small regions of the noise, and 4 takes the ends of fillets for flat.
pub const REGION_TOLERANCE: f64 = 2.0;

/// The share of the work that goes into curvatures, for progress.
const SHARE: f64 = 0.8;

/// [`watershed`] of the curvedness of the vertices; `depth` is in 1/length, by default [`CURVEDNESS_DEPTH`] by [`shape_tolerance`].
///
/// # Errors
/// As [`watershed`] and [`curvatures`].
pub fn watershed_of_curvedness(
    faces: &Faces<'_>,
    points: &Points<'_>,
    depth: Option<f64>,
    curvature: &CurvatureOptions<'_>,
    mut run: Run<'_>,
) -> Result<Segmentation, Error> {
    report(&mut run, 0.0)?;
    let topology = Topology::with_threads(faces, points.len(), run.threads, run.level)?;
    let depth = match depth {
        Some(depth) => depth,
        None => curvedness_depth(points)?,
    };
    let mut curvedness: Vec<f64> = zeroed(points.len())?;
    let mut statuses: Vec<u8> = zeroed(points.len())?;
    run.part_for(None, 0.0, SHARE, |run| {
        let outputs = CurvatureOutputs {
            curvedness: Some(curvedness.as_mut_slice().into()),
            status: Some(statuses.as_mut_slice().into()),
            ..CurvatureOutputs::default()
        };
        curvatures(&topology, points, curvature, run, &outputs)
    })?;
    fill_unknown(&topology, curvature.method, &statuses, &mut curvedness);
    drop((topology, statuses));
    let height = ScalarField::Vertices(curvedness.as_slice().into());
    run.part_for(None, SHARE, 1.0, |run| watershed(faces, points.len(), &height, depth, run))
}

/// [`region_growing`] by the [`shape_classes`] of the vertices; `tolerance` is in 1/length, by default [`REGION_TOLERANCE`] by
/// [`shape_tolerance`].
///
/// # Errors
/// As [`region_growing`], [`shape_classes`] and [`curvatures`].
pub fn regions_of_shape(
    faces: &Faces<'_>,
    points: &Points<'_>,
    tolerance: Option<f64>,
    curvature: &CurvatureOptions<'_>,
    options: &RegionOptions<'_>,
    mut run: Run<'_>,
) -> Result<Segmentation, Error> {
    report(&mut run, 0.0)?;
    let topology = Topology::with_threads(faces, points.len(), run.threads, run.level)?;
    let tolerance = match tolerance {
        Some(tolerance) => tolerance,
        None => region_tolerance(points)?,
    };
    let mut classes: Vec<u8> = zeroed(points.len())?;
    let mut statuses: Vec<u8> = zeroed(points.len())?;
    let [mut k1, mut k2]: [Vec<f64>; 2] = [zeroed(points.len())?, zeroed(points.len())?];
    run.part_for(None, 0.0, SHARE, |run| {
        let outputs = CurvatureOutputs {
            k1: Some(k1.as_mut_slice().into()),
            k2: Some(k2.as_mut_slice().into()),
            status: Some(statuses.as_mut_slice().into()),
            ..CurvatureOutputs::default()
        };
        curvatures(&topology, points, curvature, run, &outputs)
    })?;
    drop(topology);
    let quiet = Run { threads: run.threads, level: run.level, ..Run::default() };
    let (k1, k2) = (k1.as_slice().into(), k2.as_slice().into());
    for status in statuses.iter_mut().filter(|status| !has_curvature(curvature.method, **status)) {
        *status = status::DEGENERATE;
    }
    let statuses = Bytes::from(&statuses);
    shape_classes(&k1, &k2, Some(&statuses), tolerance, quiet, &classes.as_mut_slice().into())?;
    run.part_for(None, SHARE, 1.0, |run| region_growing(faces, points, &(&classes).into(), options, run))
}

/// The depth that [`watershed_of_curvedness`] takes by itself: [`CURVEDNESS_DEPTH`] by [`shape_tolerance`], in 1/length.
///
/// # Errors
/// [`Error::NonFinitePosition`].
pub fn curvedness_depth(points: &Points<'_>) -> Result<f64, Error> {
    Ok((CURVEDNESS_DEPTH * shape_tolerance(points)?).min(f64::MAX))
}

/// The tolerance that [`regions_of_shape`] takes by itself: [`REGION_TOLERANCE`] by [`shape_tolerance`], in 1/length.
///
/// # Errors
/// [`Error::NonFinitePosition`].
pub fn region_tolerance(points: &Points<'_>) -> Result<f64, Error> {
    Ok((REGION_TOLERANCE * shape_tolerance(points)?).min(f64::MAX))
}

/// Whether a vertex with this status has a curvature; where it has none, what a method writes are zeros that mean nothing.
pub fn has_curvature(method: Method, bits: u8) -> bool {
    let no_fit = bits & status::FALLBACK != 0 && bits & status::CREASE == 0;
    bits & (status::ISOLATED | status::DEGENERATE) == 0 && !(method == Method::AdaptiveJet && no_fit)
}

/// Gives vertices that have no curvature the largest of a neighbour's that has: zeros would be basins of a watershed. Where no neighbour
/// has one either, the largest number.
pub fn fill_unknown(topology: &Topology, method: Method, statuses: &[u8], curvedness: &mut [f64]) {
    let has = |vertex: usize| has_curvature(method, statuses[vertex]);
    for vertex in (0..statuses.len()).filter(|&vertex| !has(vertex)) {
        let ring = topology.ring(vertex).iter().map(|&neighbour| neighbour as usize);
        let known = ring.filter(|&neighbour| has(neighbour)).map(|neighbour| curvedness[neighbour]);
        curvedness[vertex] = known.reduce(f64::max).unwrap_or(f64::MAX);
    }
}
