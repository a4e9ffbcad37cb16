//! Vertex normals: the estimators of this folder over every ring, with their fallbacks and statuses.
//!
//! Where the weight asked for leaves nothing (all its terms drop out, or they cancel), the vertex takes the first of
//! these that has a direction, and says so in its status: Max, area, any one face. If none has, its normal is zero.

use super::Weight;
use super::adaptive_jet::adaptive_normals;
use super::conformal::Conformal;
use super::jet::jet_normals;
use super::sum::{Estimator, Sum};
use super::tilted_sections::TiltedNormals;
use super::weights::{
    Angle, AngleEdges, Area, Centroid, CentroidArea, CornerWeight, InverseRootEdges, Max, Sine, Uniform, term,
};
use crate::error::Error;
use crate::parallel::Run;
use crate::simd::{Mask, Vector, Vector3};
use crate::sweep::{Face, FaceNeeds, Quantity, Ring, RingFaces, Scratch, VertexFans, sweep, sweep_with_normals};
use crate::topology::{Topology, status};
use crate::view::{Faces, Output, Points, StatusOutput, zeroed};

/// Where the results of [`vertex_normals`] go; all are optional, and each has an element for every vertex.
#[derive(Debug, Default)]
pub struct NormalOutputs<'a> {
    /// Unit normals, `#V × 3`; zero where there is none.
    pub normal: Option<Output<'a>>,
    /// The weighted sums before normalisation, `#V × 3`, in the weight's unit: length² for areas, 1/length² for Max
    /// and so on. For [`Weight::Conformal`] the weights of each fan are divided by their total, so the length of a
    /// fan's sum is at most 1. Beyond the scalar's range its largest value stands. Where the status says fallback, it
    /// is the sum of the fallback. For jets and tilted sections, which sum nothing, it is the unit normal itself.
    pub sum: Option<Output<'a>>,
    /// [`status`] bits, `#V`.
    pub status: Option<StatusOutput<'a>>,
}

impl NormalOutputs<'_> {
    fn check_counts(&self, vertex_count: usize) -> Result<(), Error> {
        let expected = vertex_count as u64;
        let check = |what, found: Option<usize>| match found {
            Some(found) if found != vertex_count => Err(Error::Size { what, found: found as u64, expected }),
            _ => Ok(()),
        };
        check("normal.count", self.normal.as_ref().map(Output::len))?;
        check("sum.count", self.sum.as_ref().map(Output::len))?;
        check("status.count", self.status.as_ref().map(StatusOutput::len))
    }

    /// Writes one vertex. `sum` is in the mesh's units.
    pub(super) fn write(&self, vertex: usize, normal: [f64; 3], sum: [f64; 3], status: u8) {
        if let Some(output) = &self.normal {
            output.write(vertex, normal);
        }
        if let Some(output) = &self.sum {
            output.write(vertex, sum);
        }
        if let Some(output) = &self.status {
            output.write(vertex, status);
        }
    }
}

/// A `match` on a weight: `$with!(Estimator)` for a sum over one ring, and the arms that follow for the others.
macro_rules! by_weight {
    ($weight:expr, $with:ident, { $($others:tt)* }) => {
        match $weight {
            Weight::Conformal => $with!(Conformal),
            Weight::Uniform => $with!(Uniform),
            Weight::Angle => $with!(Angle),
            Weight::Area => $with!(Area),
            Weight::Max => $with!(Max),
            Weight::CentroidArea => $with!(CentroidArea),
            Weight::Centroid => $with!(Centroid),
            Weight::InverseRootEdges => $with!(InverseRootEdges),
            Weight::Sine => $with!(Sine),
            Weight::AngleEdges => $with!(AngleEdges),
            $($others)*
        }
    };
}

/// Computes the normals of all vertices, or of those in [`Run::vertices`].
///
/// Single precision is used where positions and outputs are all `f32` and faces are triangles, except by
/// [`Weight::Jet`]; a vertex whose single-precision result could be off by more than about 1e-6 is computed again in double
/// precision.
///
/// # Errors
/// [`Error::OptionOutOfRange`] for a [`Weight::Jet`] with options out of range; [`Error::Size`] where counts do not fit;
/// [`Error::NonFinitePosition`]; [`Error::IndexOutOfRange`] for a vertex to compute that is none; [`Error::Cancelled`];
/// [`Error::OutOfMemory`].
pub fn vertex_normals(
    topology: &Topology,
    points: &Points<'_>,
    weight: Weight,
    mut run: Run<'_>,
    outputs: &NormalOutputs<'_>,
) -> Result<(), Error> {
    outputs.check_counts(topology.vertex_count())?;
    let double = [&outputs.normal, &outputs.sum].into_iter().flatten().any(Output::is_double);
    macro_rules! with {
        ($estimator:ident) => {{
            let quantity =
                Normals::<$estimator> { outputs, flags: topology.flags(), estimator: std::marker::PhantomData };
            sweep(topology, points, &mut run, double, &quantity)
        }};
    }
    by_weight!(weight, with, {
        Weight::Jet(options) => jet_normals(topology, points, options, run, outputs),
        Weight::AdaptiveJet(options) => adaptive_normals(topology, points, options, run, outputs),
        Weight::TiltedSections => {
            sweep(topology, points, &mut run, true, &TiltedNormals { outputs, flags: topology.flags() })
        }
    })
}

/// Whether a weight is a sum over one ring.
pub(crate) fn is_one_ring(weight: Weight) -> bool {
    !matches!(weight, Weight::Jet(_) | Weight::AdaptiveJet(_) | Weight::TiltedSections)
}

/// Computes a quantity that takes each vertex's normal, of a weight that is a sum over one ring, from the ring that the normal
/// has just been computed from.
///
/// # Errors
/// As [`vertex_normals`].
pub(crate) fn with_vertex_normals<Q: Quantity>(
    topology: &Topology,
    points: &Points<'_>,
    weight: Weight,
    run: &mut Run<'_>,
    double: bool,
    quantity: &Q,
) -> Result<(), Error> {
    macro_rules! with {
        ($estimator:ident) => {{
            let (outputs, estimator) = (&NormalOutputs::default(), std::marker::PhantomData);
            let normals = Normals::<$estimator> { outputs, flags: topology.flags(), estimator };
            sweep_with_normals(topology, points, run, double, &normals, quantity)
        }};
    }
    by_weight!(weight, with, {
        Weight::Jet(_) | Weight::AdaptiveJet(_) | Weight::TiltedSections => unreachable!("no sum over one ring"),
    })
}

/// The area-weighted normals of the vertices that `run` asks for, by vertex, and zeros elsewhere: what estimators on
/// neighbourhoods tell the sides of a surface by.
///
/// # Errors
/// As [`vertex_normals`].
pub(crate) fn reference_normals(
    topology: &Topology,
    points: &Points<'_>,
    run: Run<'_>,
) -> Result<Vec<[f64; 3]>, Error> {
    let mut normals = zeroed(topology.vertex_count())?;
    let outputs = NormalOutputs { normal: Some(normals.as_mut_slice().into()), ..NormalOutputs::default() };
    vertex_normals(topology, points, Weight::Area, run, &outputs)?;
    Ok(normals)
}

/// Computes vertex normals once, from faces alone: builds a [`Topology`] for the call and forgets it. The results are those
/// of [`vertex_normals`], to the bit.
///
/// # Errors
/// As [`Topology::new`] and [`vertex_normals`].
pub fn vertex_normals_from_faces(
    faces: &Faces<'_>,
    points: &Points<'_>,
    weight: Weight,
    run: Run<'_>,
    outputs: &NormalOutputs<'_>,
) -> Result<(), Error> {
    let topology = Topology::with_threads(faces, points.len(), run.threads, run.level)?;
    vertex_normals(&topology, points, weight, run, outputs)
}

struct Normals<'a, E> {
    outputs: &'a NormalOutputs<'a>,
    flags: &'a [u8],
    estimator: std::marker::PhantomData<E>,
}

impl<E: Estimator> Quantity for Normals<'_, E> {
    const CENTROIDS: bool = E::CENTROIDS;
    const FACES: FaceNeeds = if E::CENTROIDS { FaceNeeds::Frames } else { FaceNeeds::Planes };
    const EDGES: bool = E::EDGES;
    const UNITS: bool = false;

    #[inline(always)]
    fn block<V: Vector, F: RingFaces<V>>(
        &self,
        vertices: &[u32],
        ring: &Ring<'_, V, F>,
        scale: V,
        scratch: &mut Scratch<'_, V>,
    ) -> u32 {
        let sum = E::sum(ring, scratch);
        let (trusted, squared) = sum.trusted();
        let normal = sum.vector.divided_by(squared.sqrt());
        let trusted = trusted.bits();
        *scratch.normal = normal;
        if let Some(output) = &self.outputs.normal {
            output.write_lanes(vertices, trusted, &[normal.x, normal.y, normal.z]);
        }
        if let Some(output) = &self.outputs.sum {
            let axes = [sum.vector.x.to_lanes(), sum.vector.y.to_lanes(), sum.vector.z.to_lanes()];
            let (total, scale) = (sum.total.to_lanes(), scale.to_lanes());
            for (lane, &vertex) in vertices.iter().enumerate() {
                if trusted & 1 << lane != 0 {
                    let vector = [axes[0][lane].into(), axes[1][lane].into(), axes[2][lane].into()];
                    output.write(vertex as usize, unscale::<E>(vector, total[lane].into(), scale[lane].into()));
                }
            }
        }
        if let Some(output) = &self.outputs.status {
            for (lane, &vertex) in vertices.iter().enumerate() {
                if trusted & 1 << lane != 0 {
                    output.write(vertex as usize, self.flags[vertex as usize]);
                }
            }
        }
        !trusted & lane_bits(vertices.len())
    }

    fn alone<F: RingFaces<f64>>(
        &self,
        vertex: usize,
        fans: &VertexFans<'_, F>,
        scale: f64,
        scratch: &mut Scratch<'_, f64>,
    ) {
        let found = with_fallback::<E, F>(fans, scale, scratch);
        let (normal, sum, fallback) = found.unwrap_or(([0.0; 3], [0.0; 3], status::DEGENERATE));
        *scratch.normal = Vector3 { x: normal[0], y: normal[1], z: normal[2] };
        self.outputs.write(vertex, normal, sum, self.flags[vertex] | fallback);
    }

    fn isolated(&self, vertex: usize) {
        self.outputs.write(vertex, [0.0; 3], [0.0; 3], status::ISOLATED);
    }
}

fn lane_bits(lanes: usize) -> u32 {
    (1u32 << lanes) - 1
}

/// A unit normal, the sum it came from in the mesh's units, and status bits.
pub(super) type Found = ([f64; 3], [f64; 3], u8);

/// The estimator's normal, or that of the first fallback that has one.
pub(super) fn with_fallback<E: Estimator, F: RingFaces<f64>>(
    fans: &VertexFans<'_, F>,
    scale: f64,
    scratch: &mut Scratch<'_, f64>,
) -> Option<Found> {
    over_fans::<E, F>(fans, scale, scratch)
        .or_else(|| over_fans::<Max, F>(fans, scale, scratch).map(as_fallback))
        .or_else(|| over_fans::<Area, F>(fans, scale, scratch).map(as_fallback))
        .or_else(|| any_face(fans, scale).map(as_fallback))
}

fn as_fallback((normal, sum, _): Found) -> Found {
    (normal, sum, status::FALLBACK)
}

fn over_fans<E: Estimator, F: RingFaces<f64>>(
    fans: &VertexFans<'_, F>,
    scale: f64,
    scratch: &mut Scratch<'_, f64>,
) -> Option<Found> {
    let mut all = Sum::<f64>::zero();
    for ring in fans.rings() {
        let mut sum = E::sum(&ring, scratch);
        if E::MEAN {
            let share = sum.total.reciprocal_or_zero();
            sum = Sum { vector: sum.vector * share, spread: sum.spread * share * share, total: sum.total * share };
        }
        all.vector = all.vector + sum.vector;
        all.spread += sum.spread;
    }
    let normal = unit(&all)?;
    let Vector3 { x, y, z } = all.vector;
    // Each fan's share has been taken already.
    Some((normal, unscale_by(E::POWER, [x, y, z], scale), 0))
}

/// The area vector of the first face that has one.
fn any_face<F: RingFaces<f64>>(fans: &VertexFans<'_, F>, scale: f64) -> Option<Found> {
    let mut corners = fans.rings().flat_map(|ring| (0..ring.corner_count()).map(move |index| ring.corner(index)));
    corners.find_map(|corner| {
        let (vector, spread) = term::<Area, f64, F::Face>(&corner);
        let vector = vector * F::Face::AREA_UNIT;
        let normal = unit(&Sum { vector, spread, total: 0.0 })?;
        Some((normal, unscale_by(Area::DIMENSION, [vector.x, vector.y, vector.z], scale), 0))
    })
}

fn unit(sum: &Sum<f64>) -> Option<[f64; 3]> {
    let (trusted, squared) = sum.trusted();
    let normal = sum.vector.divided_by(squared.sqrt());
    trusted.then_some([normal.x, normal.y, normal.z])
}

/// A fan's sum in the mesh's units.
fn unscale<E: Estimator>(vector: [f64; 3], total: f64, scale: f64) -> [f64; 3] {
    if E::MEAN {
        return vector.map(|x| x * total.reciprocal_or_zero());
    }
    unscale_by(E::POWER, vector, scale)
}

/// A length to the power `power` from the ring's units to the mesh's, in steps that do not overflow before the result.
fn unscale_by(power: i32, vector: [f64; 3], scale: f64) -> [f64; 3] {
    vector.map(|mut x| {
        for _ in 0..power.abs() {
            x = if power > 0 { x / scale } else { x * scale };
        }
        x
    })
}
