//! Curvatures of polylines: at each vertex, from it and its two neighbours, by the formulas of [`super::section`].
//!
//! In the plane curvature has a sign: positive where the polyline turns left, which is all along a polygon that runs
//! counter-clockwise. In space it is at least 0. Everything is computed in `f64`.
//!
//! *Coincident points.* A neighbour is the nearest point along the polyline that differs from the vertex: points that
//! repeat the vertex are passed over, so all of a run of equal points have the curvature of the corner that they stand
//! for, and [`polyline_status::COINCIDENT`]. Long runs cost no more than others: where the runs begin is noted once for
//! each chunk of points, and a chunk takes up what its predecessors have found.
//!
//! *Ends.* The first and the last point of an open polyline, and all that repeat them, have curvature 0.
//!
//! *Range.* Each edge is scaled by a power of two of its own. So the size of a polyline costs no accuracy, nor does the
//! distance from the origin beyond what the coordinates themselves have lost, and a polyline that is a power of two as
//! large has curvatures exactly as much smaller.
//!
//! Cost: linear; two numbers of memory for 4096 points.

use super::Section;
use super::section::ThreePoints;
use crate::error::{Error, filled};
use crate::parallel::{Run, fill, for_each_chunk};
use crate::simd::{Real, Vector3};
use crate::view::{Coordinate, PolylineArray, PolylinePoints, ScalarOutput, StatusOutput, StridedPoints};

/// Bits of the status byte of a polyline's vertex. 0 is an ordinary vertex.
pub mod polyline_status {
    /// An end of an open polyline; its curvatures are 0.
    pub const END: u8 = 1;
    /// The next point lies exactly on the side of the previous one.
    pub const CUSP: u8 = 2;
    /// The point next to the vertex, before or after it, coincides with it; the next one that does not took its place. If
    /// there is none, the curvatures are 0.
    pub const COINCIDENT: u8 = 4;
}

/// Where the results of [`polyline_curvatures`] go; all are optional, and each has an element for every vertex.
///
/// Curvatures are 1/length. Beyond the scalar's range its largest value stands.
#[derive(Debug, Default)]
pub struct PolylineOutputs<'a> {
    /// [`Section::Circle`], `#V`.
    pub circle: Option<ScalarOutput<'a>>,
    /// [`Section::Parabola`], `#V`.
    pub parabola: Option<ScalarOutput<'a>>,
    /// [`Section::LengthParabola`], `#V`.
    pub length_parabola: Option<ScalarOutput<'a>>,
    /// [`Section::SymmetricParabola`], `#V`.
    pub symmetric_parabola: Option<ScalarOutput<'a>>,
    /// [`polyline_status`] bits, `#V`.
    pub status: Option<StatusOutput<'a>>,
}

impl<'a> PolylineOutputs<'a> {
    fn curvatures(&self) -> [(Section, &'static str, Option<&ScalarOutput<'a>>); 4] {
        [
            (Section::Circle, "circle.count", self.circle.as_ref()),
            (Section::Parabola, "parabola.count", self.parabola.as_ref()),
            (Section::LengthParabola, "length_parabola.count", self.length_parabola.as_ref()),
            (Section::SymmetricParabola, "symmetric_parabola.count", self.symmetric_parabola.as_ref()),
        ]
    }
}

/// Computes the curvatures at all vertices of a polyline, `closed` if its last point is joined to its first.
///
/// In the plane, positive where the polyline turns left; in space, at least 0. At a cusp, positive: κ_SP is infinite,
/// so the largest value of the output's scalar stands; so are κ_P and κ_PL if both neighbours coincide, as in a closed
/// polyline of two points, and else 0. κ_C is 0 at a cusp, or 2 by the edge's length if both neighbours coincide. For
/// finite input nothing is ever NaN or infinite. [`Run::vertices`] is ignored. The results are the same bits for any
/// number of threads.
///
/// # Errors
/// [`Error::NonFinitePosition`]; [`Error::Size`] where an output does not have an element for every vertex;
/// [`Error::OutOfMemory`]; [`Error::Cancelled`].
pub fn polyline_curvatures(
    points: &PolylinePoints<'_>,
    closed: bool,
    mut run: Run<'_>,
    outputs: &PolylineOutputs<'_>,
) -> Result<(), Error> {
    let count = points.len();
    let lengths = outputs.curvatures().map(|(_, what, output)| (what, output.map(ScalarOutput::len)));
    for (what, found) in lengths.into_iter().chain([("status.count", outputs.status.as_ref().map(StatusOutput::len))])
    {
        if let Some(found) = found.filter(|&found| found != count) {
            return Err(Error::Size { what, found: found as u64, expected: count as u64 });
        }
    }
    points.check_finite()?;
    match points.array() {
        PolylineArray::PlaneF32(points) => each_vertex(points, closed, &mut run, outputs),
        PolylineArray::PlaneF64(points) => each_vertex(points, closed, &mut run, outputs),
        PolylineArray::SpaceF32(points) => each_vertex(points, closed, &mut run, outputs),
        PolylineArray::SpaceF64(points) => each_vertex(points, closed, &mut run, outputs),
    }
}

const CHUNK: usize = 4096;

fn each_vertex<S: Coordinate, const N: usize>(
    points: &StridedPoints<'_, S, N>,
    closed: bool,
    run: &mut Run<'_>,
    outputs: &PolylineOutputs<'_>,
) -> Result<(), Error> {
    let runs = Runs::new(points, closed, run.threads)?;
    for_each_chunk(run, points.len().div_ceil(CHUNK), |claims| {
        while let Some(chunk) = claims.next() {
            runs.for_each_in(chunk, |vertex, previous, next, repeated| {
                let mut status = if repeated { polyline_status::COINCIDENT } else { 0 };
                let corner = match (previous, next) {
                    (Some(previous), Some(next)) => {
                        Some(Corner::new([previous, vertex, next].map(|index| point(points, index))))
                    }
                    _ => None,
                };
                match &corner {
                    Some(corner) if corner.points.cusp > 0.0 => status |= polyline_status::CUSP,
                    None if !closed => status |= polyline_status::END,
                    _ => (),
                }
                for (section, _, output) in outputs.curvatures() {
                    if let Some(output) = output {
                        output
                            .write(vertex, [corner.as_ref().map_or(0.0, |corner| corner.curvature(section, N == 2))]);
                    }
                }
                if let Some(output) = &outputs.status {
                    output.write(vertex, status);
                }
            });
        }
    })
}

/// A point as `f64`, in the plane z = 0 if it has two coordinates.
#[inline(always)]
fn point<S: Coordinate, const N: usize>(points: &StridedPoints<'_, S, N>, index: usize) -> Vector3<f64> {
    let mut all = [0.0; 3];
    all[..N].copy_from_slice(&points.coordinates(index).map(Into::into));
    let [x, y, z] = all;
    Vector3 { x, y, z }
}

/// A vertex between two others that differ from it.
struct Corner {
    points: ThreePoints<f64>,
    /// How many common units a unit of the polyline is.
    scale: f64,
}

impl Corner {
    fn new([before, vertex, after]: [Vector3<f64>; 3]) -> Self {
        let ((a, a_scale), (c, c_scale)) = (scaled_edge(vertex, before), scaled_edge(vertex, after));
        // The longer edge has the smaller scale. Far shorter ones may vanish in common units.
        let scale = a_scale.min(c_scale);
        let mut chord = (after - before) * scale;
        if overflows(chord) {
            chord = (after * 0.25 - before * 0.25) * (scale * 4.0);
        }
        Corner { points: ThreePoints::new(a, scale / a_scale, c, scale / c_scale, chord), scale }
    }

    fn curvature(&self, section: Section, signed: bool) -> f64 {
        let curvature = self.points.curvature(section, self.scale);
        // a × c looks up where the polyline turns right: a runs backwards.
        if signed && self.points.cross.z > 0.0 && curvature > 0.0 { -curvature } else { curvature }
    }
}

/// `to − from` times the power of two, which it answers with as well, that brings the largest component to between 1
/// and 2 (4 where the difference is subnormal or overflows).
fn scaled_edge(from: Vector3<f64>, to: Vector3<f64>) -> (Vector3<f64>, f64) {
    let edge = to - from;
    if overflows(edge) {
        // Brought closer first; the factor is exact for a component that matters here.
        let edge = to * 0.25 - from * 0.25;
        let scale = edge.largest_component().inverse_power_of_two();
        return (edge * scale, scale * 0.25);
    }
    let scale = edge.largest_component().inverse_power_of_two();
    (edge * scale, scale)
}

fn overflows(vector: Vector3<f64>) -> bool {
    vector.largest_component() == f64::INFINITY
}

/// The runs of equal points, by chunks of [`CHUNK`] points. A run starts at a point that differs from the one before
/// it, and at point 0.
struct Runs<'a, 'p, S, const N: usize> {
    points: &'a StridedPoints<'p, S, N>,
    /// Of each chunk: the first start of a run, apart from point 0, at or after its beginning, the number of points if
    /// there is none; and the last at or before its end.
    starts: Vec<[usize; 2]>,
    /// In a closed polyline: the nearest point before point 0 that differs from it, the nearest after the last point that
    /// differs from that; if there are any.
    around: [Option<usize>; 2],
    /// In a closed polyline: whether the last point repeats point 0.
    repeats: bool,
}

impl<'a, 'p, S: Coordinate, const N: usize> Runs<'a, 'p, S, N> {
    fn new(points: &'a StridedPoints<'p, S, N>, closed: bool, threads: usize) -> Result<Self, Error> {
        const NONE: usize = usize::MAX;
        let count = points.len();
        let mut runs =
            Runs { points, starts: filled(count.div_ceil(CHUNK), [NONE; 2])?, around: [None; 2], repeats: false };
        fill(threads, &mut runs.starts, |chunk| {
            let mut inside =
                (chunk * CHUNK..count.min((chunk + 1) * CHUNK)).filter(|&index| starts_at(points, index));
            let first = inside.next();
            [first.unwrap_or(NONE), inside.next_back().or(first).unwrap_or(NONE)]
        });
        let mut last = 0;
        for [_, found] in &mut runs.starts {
            last = if *found == NONE { last } else { *found };
            *found = last;
        }
        let mut first = count;
        for [found, _] in runs.starts.iter_mut().rev() {
            first = if *found == NONE { first } else { *found };
            *found = first;
        }
        if closed && count > 0 {
            runs.repeats = points.coordinates(0) == points.coordinates(count - 1);
            runs.around = match (runs.repeats, last) {
                (false, _) => [Some(count - 1), Some(0)],
                (true, 0) => [None; 2],
                (true, last) => [Some(last - 1), Some(first)],
            };
        }
        Ok(runs)
    }

    /// Calls `visit` with each vertex of a chunk, its neighbours, and whether the point before or after it repeats it.
    #[inline(always)]
    fn for_each_in(&self, chunk: usize, mut visit: impl FnMut(usize, Option<usize>, Option<usize>, bool)) {
        let count = self.points.len();
        let (begin, end) = (chunk * CHUNK, count.min((chunk + 1) * CHUNK));
        let mut start = if chunk == 0 { 0 } else { self.starts[chunk - 1][1] };
        // The start of the next run.
        let mut next = begin;
        for vertex in begin..end {
            if starts_at(self.points, vertex) {
                start = vertex;
            }
            if next <= vertex {
                let following = || self.starts.get(chunk + 1).map_or(count, |starts| starts[0]);
                next = (vertex + 1..end).find(|&index| starts_at(self.points, index)).unwrap_or_else(following);
            }
            let before = if start > 0 { Some(start - 1) } else { self.around[0] };
            let after = if next < count { Some(next) } else { self.around[1] };
            let at_seam = vertex == 0 || vertex + 1 == count;
            visit(vertex, before, after, start < vertex || vertex + 1 < next || (at_seam && self.repeats));
        }
    }
}

/// Whether a run starts at a point other than point 0.
#[inline(always)]
fn starts_at<S: Coordinate, const N: usize>(points: &StridedPoints<'_, S, N>, index: usize) -> bool {
    index > 0 && points.coordinates(index) != points.coordinates(index - 1)
}
