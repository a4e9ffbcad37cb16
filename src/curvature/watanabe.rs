//! Watanabe & Belyaev: curvatures from the mean and the mean square of sectional curvature.
//!
//! Over all directions, `(1/2π) ∫ κ dφ = H` and `(1/2π) ∫ κ² dφ = (3H² − K)/2`. The integrals are taken by the trapezoid rule
//! over the edges of the ring, the angle of each step being that of the face between two edges, as a part of the sum of all
//! (the ring laid flat as in N_CM). Then `k = H ± √(H² − K)`.
//!
//! Input: any ring of triangles or polygons. Reference: Watanabe & Belyaev 2001, "Detection of salient curvature features on
//! polygonal surfaces", equations 3 to 6. It gives no directions, and converges only where edges stand at
//! even angles. Boundary: the mean over the open fan stands for that
//! over the circle, which it is not unless the surface is round. Degenerate rule: a step at an edge without length or along
//! the normal is left out; a vertex with none left has no result. Cost: an angle polynomial, a root and three divisions a
//! corner.

use super::Section;
use super::outputs::Local;
use super::principal::Frame;
use super::ring::RingEstimator;
use super::section::{self, EdgeCurvature};
use crate::simd::Vector;
use crate::sweep::{FaceNeeds, Ring, RingFaces, Scratch};

/// Watanabe & Belyaev 2001.
pub(crate) struct Watanabe {
    pub section: Section,
}

/// Sums over edges of the weight, and of the weighted curvature and its square.
#[derive(Clone, Copy)]
pub(crate) struct Sums<V> {
    weight: V,
    curvature: V,
    squared: V,
}

impl RingEstimator for Watanabe {
    const FACES: FaceNeeds = FaceNeeds::Planes;
    type Sums<V: Vector> = Sums<V>;

    #[inline(always)]
    fn start<V: Vector>() -> Sums<V> {
        Sums { weight: V::zero(), curvature: V::zero(), squared: V::zero() }
    }

    #[inline(always)]
    fn add<V: Vector, F: RingFaces<V>>(
        &self,
        ring: &Ring<'_, V, F>,
        frame: &Frame<V>,
        scratch: &mut Scratch<'_, V>,
        sums: &mut Sums<V>,
    ) {
        let [angles, ..] = &mut scratch.numbers;
        ring.fill_corners(angles, |corner| corner.unit_and_angle().1 + corner.doubt());
        for index in 0..ring.edge_count() {
            let EdgeCurvature { curvature, weight: counted } =
                section::edge(ring.edges[index], ring.squared[index], frame.normal, self.section);
            let weight = (angles[index] + angles[index + 1]) * counted;
            sums.weight = sums.weight + weight;
            sums.curvature = sums.curvature + weight * curvature;
            sums.squared = sums.squared + weight * curvature * curvature;
        }
    }

    #[inline(always)]
    fn finish<V: Vector>(&self, sums: &Sums<V>, frame: &Frame<V>) -> Local<V> {
        let inverse = sums.weight.reciprocal_or_zero();
        let mean = sums.curvature * inverse;
        let mean_square = sums.squared * inverse;
        let gaussian = V::constant(3.0) * mean * mean - V::constant(2.0) * mean_square;
        Local { usable: V::zero().lt(inverse), ..Local::of_mean_and_gaussian(frame.normal, mean, gaussian) }
    }
}
