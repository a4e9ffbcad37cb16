//! Meyer, Desbrun, Schröder & Barr: the mean curvature normal by cotangents, and the angle defect, over mixed areas.
//!
//! The mean curvature normal is `H N = ∇A / (2 A_mixed)`, where `∇A = ½ Σ (cot αᵢ + cot βᵢ)(V − Vᵢ)` is the gradient of the
//! surface's area as the vertex moves. Corner by corner it is `½ (a − b) × N_f` for the edges `a`, `b` and the unit normal of
//! the face, the same number without a cotangent that could overflow. `H` is its length with the sign of its product with the
//! vertex normal; `K` is the angle defect over the same area; `k = H ± √max(H² − K, 0)`.
//!
//! Polygons: `∇A` is the gradient of the length of the polygon's area vector, `½ (a − b) × N_f` again: the polygon Laplacian
//! of Alexa & Wardetzky 2011 (section 3) applied to positions, without the stabilising term that vanishes where a polygon is
//! flat; it is the cotangent formula on triangles. Their area is an equal share for each corner.
//!
//! Input: any ring of triangles or polygons. Reference: Meyer et al. 2003, equations 5, 8 and 9 and figure 4. Does not
//! converge pointwise on irregular meshes. Boundary: the open fan counts as it is; `H` then holds the pull of the boundary and
//! `K` its turning (see [`angle_defect`](super::angle_defect)): the integrals are right, the pointwise values are not those of
//! a smooth surface. Degenerate rule: faces without area add nothing; a vertex without area has no result.
//! Cost: an angle polynomial, three roots and four divisions a corner.

use super::angle_defect::{defect, large_enough};
use super::outputs::Local;
use super::principal::Frame;
use super::ring::RingEstimator;
use crate::simd::{Mask, Real, Vector, Vector3};
use crate::sweep::{Ring, RingFaces, Scratch};

/// A mean curvature normal that is nearer the tangent plane than this leaves its sign to double precision.
const SIDEWAYS: f64 = 1e-3;

/// Meyer et al. 2003.
pub(crate) struct Meyer;

/// Gradient of the area, angle defect and mixed area.
#[derive(Clone, Copy)]
pub(crate) struct Sums<V> {
    gradient: Vector3<V>,
    defect: V,
    area: V,
}

impl RingEstimator for Meyer {
    const FLAT_ANGLES: bool = true;
    type Sums<V: Vector> = Sums<V>;

    #[inline(always)]
    fn start<V: Vector>() -> Sums<V> {
        Sums { gradient: Vector3::zero(), defect: V::zero(), area: V::zero() }
    }

    #[inline(always)]
    fn add<V: Vector, F: RingFaces<V>>(
        &self,
        ring: &Ring<'_, V, F>,
        _frame: &Frame<V>,
        _scratch: &mut Scratch<'_, V>,
        sums: &mut Sums<V>,
    ) {
        sums.defect = sums.defect + defect(ring);
        for index in 0..ring.corner_count() {
            let corner = ring.corner(index);
            let normal = corner.direction() * corner.unit();
            sums.gradient = sums.gradient + (corner.a - corner.b).cross(normal) * V::constant(0.5);
            sums.area = sums.area + corner.mixed_area() + corner.doubt();
        }
    }

    #[inline(always)]
    fn finish<V: Vector>(&self, sums: &Sums<V>, frame: &Frame<V>) -> Local<V> {
        let inverse = sums.area.reciprocal_or_zero();
        let half = V::constant(0.5);
        let length = sums.gradient.squared().sqrt() * half;
        let along = sums.gradient.dot(frame.normal);
        let integrated_mean = V::select(along.lt(V::zero()), -length, length);
        // In single precision, whether the sign is known.
        let sideways = if V::Scalar::SINGLE { V::constant(SIDEWAYS) * length } else { -V::one() };
        Local {
            mean_normal: sums.gradient * half * inverse,
            area: sums.area,
            integrated_mean,
            integrated_gaussian: sums.defect,
            usable: V::zero()
                .lt(inverse)
                .and(large_enough(sums.area))
                .and(sideways.lt(along.abs() + V::splat(V::Scalar::TINY))),
            ..Local::of_mean_and_gaussian(frame.normal, integrated_mean * inverse, sums.defect * inverse)
        }
    }
}
