//! The shape operator that fits the sections along the edges best.
//!
//! Each edge of the ring gives a curvature `κ` in its tangent direction `φ` (see [`section`](super::section)). A shape
//! operator says `κ(φ) = H + p cos 2φ + q sin 2φ`; the three numbers are the least-squares solution, every edge counted
//! once. Input: any ring, of triangles or polygons, of which only edges and the normal are used; all fans of a vertex are
//! fitted together.
//!
//! Reference: the paper's section 4 ("compute directly the sectional curvatures"); the fit is that of Hamann 1993 and
//! Goldfeather & Interrante 2004, section 2. With exact normals and circles it is exact on spheres: every `κ` is `1/r`.
//!
//! Numerical notes: `H` is eliminated first; the remaining 2 × 2 matrix is diagonalised, so that a part of `(p, q)` that the
//! edges do not determine is told apart in any frame.
//! Degenerate rule: edges without length or along the normal are left out. Where the directions leave a part of `(p, q)`
//! undetermined (all edges within about a degree of one line, or of two perpendicular ones as in a grid of quads), that part is zero, which
//! makes the point as round as the sections allow, and the status says fallback. A vertex without any edge left has no
//! result. A boundary needs no rule. Cost: two divisions and a dozen products an edge.

use super::Section;
use super::outputs::Local;
use super::principal::{Frame, Operator};
use super::ring::RingEstimator;
use super::section::{self, EdgeCurvature};
use crate::simd::{Mask, Real, Vector};
use crate::sweep::{FaceNeeds, Ring, RingFaces, Scratch};

/// A part of `(p, q)` that the edges tell apart by less than this mean square is not determined: what they say of it is the
/// error of the normal, magnified more than thirtyfold.
const UNDETERMINED: f64 = 0.001;

/// As [`UNDETERMINED`], for what is left to double precision.
const DOUBTFUL: f64 = 0.1;

/// Least squares over sections.
pub(crate) struct LeastSquares {
    pub section: Section,
}

/// Sums over edges: of 1, of cos 2φ and sin 2φ and their products, and of `κ` times each.
#[derive(Clone, Copy)]
pub(crate) struct Sums<V> {
    count: V,
    cos: V,
    sin: V,
    cos_cos: V,
    cos_sin: V,
    sin_sin: V,
    curvature: V,
    curvature_cos: V,
    curvature_sin: V,
    curvature_squared: V,
}

/// `cos 2φ` and `sin 2φ` of the tangential part of an edge, which must not be zero.
#[inline(always)]
pub(crate) fn double_angle<V: Vector>((x, y): (V, V)) -> (V, V) {
    let inverse = (x * x + y * y).reciprocal_or_zero();
    ((x * x - y * y) * inverse, (x * y + x * y) * inverse)
}

/// `value / eigenvalue`, or zero where that says nothing.
#[inline(always)]
fn determined<V: Vector>(eigenvalue: V, value: V) -> V {
    let enough = V::constant(UNDETERMINED).lt(eigenvalue);
    V::select(enough, value / V::select(enough, eigenvalue, V::one()), V::zero())
}

impl RingEstimator for LeastSquares {
    const FACES: FaceNeeds = FaceNeeds::Unused;
    const UNITS: bool = false;
    // Two pairs of edges at right angles tell the sections between them badly.
    const DOUBTS_FOUR: bool = true;
    type Sums<V: Vector> = Sums<V>;

    #[inline(always)]
    fn start<V: Vector>() -> Sums<V> {
        let zero = V::zero();
        Sums {
            count: zero,
            cos: zero,
            sin: zero,
            cos_cos: zero,
            cos_sin: zero,
            sin_sin: zero,
            curvature: zero,
            curvature_cos: zero,
            curvature_sin: zero,
            curvature_squared: zero,
        }
    }

    #[inline(always)]
    fn add<V: Vector, F: RingFaces<V>>(
        &self,
        ring: &Ring<'_, V, F>,
        frame: &Frame<V>,
        _scratch: &mut Scratch<'_, V>,
        sums: &mut Sums<V>,
    ) {
        for index in 0..ring.edge_count() {
            let edge = ring.edges[index];
            let EdgeCurvature { curvature, weight: counted } =
                section::edge(edge, ring.squared[index], frame.normal, self.section);
            let (cos, sin) = double_angle(frame.tangential(edge));
            let (cos, sin) = (cos * counted, sin * counted);
            sums.count = sums.count + counted;
            sums.cos = sums.cos + cos;
            sums.sin = sums.sin + sin;
            sums.cos_cos = sums.cos_cos + cos * cos;
            sums.cos_sin = sums.cos_sin + cos * sin;
            sums.sin_sin = sums.sin_sin + sin * sin;
            sums.curvature = sums.curvature + curvature;
            sums.curvature_cos = sums.curvature_cos + curvature * cos;
            sums.curvature_sin = sums.curvature_sin + curvature * sin;
            sums.curvature_squared = sums.curvature_squared + curvature * curvature;
        }
    }

    #[inline(always)]
    fn finish<V: Vector>(&self, sums: &Sums<V>, frame: &Frame<V>) -> Local<V> {
        let inverse = sums.count.reciprocal_or_zero();
        let (cos, sin, mean) = (sums.cos * inverse, sums.sin * inverse, sums.curvature * inverse);
        let matrix = Operator {
            a: sums.cos_cos * inverse - cos * cos,
            b: sums.cos_sin * inverse - cos * sin,
            d: sums.sin_sin * inverse - sin * sin,
        };
        let right = (sums.curvature_cos * inverse - mean * cos, sums.curvature_sin * inverse - mean * sin);
        let axes = matrix.principal();
        let (c, s) = axes.direction;
        let least = V::constant(UNDETERMINED);
        let along = determined(axes.k1, c * right.0 + s * right.1);
        let across = determined(axes.k2, c * right.1 - s * right.0);
        let (p, q) = (c * along - s * across, s * along + c * across);
        let height = mean - cos * p - sin * q;
        // What is left of the variance of the sections once the fit has taken its part.
        let variance = sums.curvature_squared * inverse - mean * mean - p * right.0 - q * right.1;
        let doubtful = if V::Scalar::SINGLE { DOUBTFUL } else { f64::NEG_INFINITY };
        Local {
            residual: variance.max(V::zero()).sqrt(),
            usable: V::zero().lt(sums.count).and(V::constant(doubtful).lt(axes.k2)),
            fallback: axes.k2.lt(least),
            ..Local::of_operator(frame, &Operator::of_harmonics(height, p, q))
        }
    }
}
