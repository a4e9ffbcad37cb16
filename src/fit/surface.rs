//! Normal and shape operator of a height field, from its derivatives.
//!
//! From the full first and second fundamental forms, so the plane below need not be tangent:
//!
//! ```text
//! g = (p, q) = ∇z   w = √(1 + p² + q²)   N = (−p, −q, 1)/w
//! I = [1 + p², pq; pq, 1 + q²]   II = H/w   with H the Hessian of z
//! e₁ = Xᵤ/√E   e₂ = (E Xᵥ − F Xᵤ)/(√E w)   S = −[II(e₁,e₁), II(e₁,e₂); II(e₁,e₂), II(e₂,e₂)]
//! ```
//!
//! The sign is such that a sphere with outward normals has positive curvatures. Reference: do Carmo, "Differential Geometry of
//! Curves and Surfaces", 3.3.

use super::axes::Axes;
use crate::simd::{Vector, Vector3};

/// A surface at a point, to second order.
#[derive(Clone, Copy)]
pub(crate) struct Surface<V> {
    /// Unit normal.
    pub normal: Vector3<V>,
    /// Unit tangent vectors; right-handed with the normal, and orthonormal.
    pub x: Vector3<V>,
    /// See `x`.
    pub y: Vector3<V>,
    /// The shape operator `a, b, d` in the axes `x`, `y`: the curvature of a section along `(c, s)` is `a c² + 2 b c s + d s²`.
    pub shape: [V; 3],
}

impl<V: Vector> Surface<V> {
    /// From the first derivatives and the second (`uu`, `uv`, `vv`) of heights over `axes`.
    #[inline(always)]
    pub fn of_derivatives(axes: &Axes<V>, [p, q]: [V; 2], [uu, uv, vv]: [V; 3]) -> Self {
        let e = V::one() + p * p;
        let inverse_w = V::one() / (e + q * q).sqrt();
        let inverse_root_e = V::one() / e.sqrt();
        let normal = axes.vector(-(p * inverse_w), -(q * inverse_w), inverse_w);
        // Unit to the last place, and not only to that of the axes.
        let normal = normal * (V::one() / normal.squared().sqrt());
        let x = axes.vector(inverse_root_e, V::zero(), p * inverse_root_e);
        // e₁ = α Xᵤ and e₂ = β Xᵤ + γ Xᵥ
        let (alpha, gamma) = (inverse_root_e, e * inverse_root_e * inverse_w);
        let beta = -(p * q * inverse_root_e * inverse_w);
        let two = V::constant(2.0);
        let (xx, xy, yy) = (-(uu * inverse_w), -(uv * inverse_w), -(vv * inverse_w));
        let shape = [
            alpha * alpha * xx,
            alpha * (beta * xx + gamma * xy),
            beta * beta * xx + two * beta * gamma * xy + gamma * gamma * yy,
        ];
        Surface { normal, x, y: normal.cross(x), shape }
    }
}
