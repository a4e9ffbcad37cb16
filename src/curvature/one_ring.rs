//! The methods that look at one ring: in which precision they are computed, and whether the normals they take are computed on
//! the way, from the ring that has just been loaded, or beforehand, because neighbours' normals are needed as well.

use super::angle_defect::AngleDefect;
use super::corrected_measure::CorrectedMeasure;
use super::measure::{OneRing, Region};
use super::meyer::Meyer;
use super::normal_cycle::NormalCycle;
use super::ring::{Curvatures, OwnNormals, RingEstimator};
use super::rusinkiewicz::Rusinkiewicz;
use super::shape_operator::LeastSquares;
use super::taubin::Taubin;
use super::tilted_sections::TiltedSections;
use super::watanabe::Watanabe;
use super::{CurvatureOptions, CurvatureOutputs, Method, VertexNormals};
use crate::error::Error;
use crate::normals::{Weight, is_one_ring, with_vertex_normals};
use crate::parallel::Run;
use crate::sweep::sweep;
use crate::topology::Topology;
use crate::view::Points;

/// Whether a method looks at one ring only.
pub(super) fn looks_at_one_ring(method: Method, region: Region) -> bool {
    match method {
        Method::AdaptiveJet | Method::Jet | Method::Quadric | Method::Goldfeather => false,
        Method::NormalCycle | Method::CorrectedMeasure => matches!(region, Region::Rings(1)),
        Method::TiltedSections
        | Method::LeastSquares
        | Method::Taubin
        | Method::Watanabe
        | Method::Meyer
        | Method::AngleDefect
        | Method::Rusinkiewicz => true,
    }
}

/// Whether a method of one ring needs the normals of its neighbours.
pub(super) fn looks_at_neighbours(method: Method) -> bool {
    matches!(method, Method::Rusinkiewicz | Method::CorrectedMeasure)
}

/// Whether a method of one ring is computed in single precision: where all that comes in and goes out is.
pub(super) fn is_single(points: &Points<'_>, options: &CurvatureOptions<'_>, outputs: &CurvatureOutputs<'_>) -> bool {
    let unused = options.method == Method::AngleDefect && outputs.normal.is_none();
    let given = match options.normals {
        _ if unused => false,
        VertexNormals::Given(normals) => normals.is_double(),
        VertexNormals::Computed(weight) => !is_one_ring(weight),
    };
    // The difference of two numbers that may be nearly equal, and its root, are half as precise as what they come from.
    let principal = [&outputs.k1, &outputs.k2, &outputs.shape_index, &outputs.curvedness];
    let root = match options.method {
        Method::Watanabe | Method::Meyer => principal.into_iter().any(Option::is_some),
        Method::LeastSquares => outputs.residual.is_some(),
        Method::TiltedSections => true,
        _ => false,
    };
    !(points.is_double() || given || root || outputs.any_double())
}

/// The weight of the normals that can be computed on the way.
pub(super) fn weight_on_the_way(options: &CurvatureOptions<'_>) -> Option<Weight> {
    match (options.method, options.normals) {
        (Method::TiltedSections, VertexNormals::Computed(_)) => Some(Weight::Max),
        (method, VertexNormals::Computed(weight)) if !looks_at_neighbours(method) && is_one_ring(weight) => {
            Some(weight)
        }
        _ => None,
    }
}

/// How the rings are gone through.
pub(super) struct Way<'a, 'r> {
    pub topology: &'a Topology,
    pub points: &'a Points<'a>,
    pub run: &'a mut Run<'r>,
    pub double: bool,
    /// Where normals come from; on the way, if there is a weight.
    pub normals: Result<OwnNormals<'a>, Weight>,
}

/// Computes a method of one ring.
///
/// # Errors
/// As [`sweep`].
pub(super) fn over_one_ring(
    options: &CurvatureOptions<'_>,
    outputs: &CurvatureOutputs<'_>,
    way: Way<'_, '_>,
) -> Result<(), Error> {
    let section = options.section;
    match options.method {
        Method::TiltedSections => way.go(outputs, TiltedSections),
        Method::LeastSquares => way.go(outputs, LeastSquares { section }),
        Method::Taubin => way.go(outputs, Taubin { section }),
        Method::Watanabe => way.go(outputs, Watanabe { section }),
        Method::Meyer => way.go(outputs, Meyer),
        Method::AngleDefect => way.go(outputs, AngleDefect),
        Method::Rusinkiewicz => way.go(outputs, Rusinkiewicz),
        Method::NormalCycle => way.go(outputs, OneRing::<NormalCycle>::new()),
        Method::CorrectedMeasure => way.go(outputs, OneRing::<CorrectedMeasure>::new()),
        Method::AdaptiveJet | Method::Jet | Method::Quadric | Method::Goldfeather => {
            unreachable!("fits look at neighbourhoods")
        }
    }
}

impl Way<'_, '_> {
    fn go<E: RingEstimator>(self, outputs: &CurvatureOutputs<'_>, estimator: E) -> Result<(), Error> {
        let Way { topology, points, run, double, normals } = self;
        let flags = topology.flags();
        match normals {
            Ok(normals) => {
                sweep(topology, points, run, double, &Curvatures { outputs, flags, normals, estimator, more: 0 })
            }
            Err(weight) => {
                let normals = OwnNormals::Ring;
                let quantity = Curvatures { outputs, flags, normals, estimator, more: 0 };
                with_vertex_normals(topology, points, weight, run, double, &quantity)
            }
        }
    }
}
