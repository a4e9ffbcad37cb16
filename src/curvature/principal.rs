//! Principal curvatures and directions of a symmetric shape operator in a tangent plane, in lanes.
//!
//! The operator `(a b; b d)` says the normal curvature in the tangent direction `(c, s)`: `κ = a c² + 2 b c s + d s²`. With
//! `H = (a + d)/2`, `δ = (a − d)/2` and `r = √(δ² + b²)`, the principal curvatures are `H ± r`: nothing is subtracted that
//! could cancel, and `H² − K = r²` is never negative. The direction of the larger one is `(r + δ, b)` or `(b, r − δ)`,
//! whichever adds two numbers of one sign. Where `r` is zero every direction is principal, and the frame's first tangent
//! is taken.
//!
//! Sign of directions: the first of the largest components of direction 1 is positive; direction 2 is `N ×` direction 1.

use crate::fit::Axes;
use crate::simd::{Vector, Vector3};

/// A unit normal and two unit tangents, right-handed, in every lane.
#[derive(Clone, Copy)]
pub(crate) struct Frame<V> {
    /// The normal.
    pub normal: Vector3<V>,
    /// The first tangent.
    pub x: Vector3<V>,
    /// The second, `normal × x`.
    pub y: Vector3<V>,
}

impl<V: Vector> Frame<V> {
    /// A frame around a unit normal; of no meaning where that is zero.
    #[inline(always)]
    pub fn new(normal: Vector3<V>) -> Self {
        let Axes { x, y, .. } = Axes::about(normal);
        Frame { normal, x, y }
    }

    /// The tangential part of a vector.
    #[inline(always)]
    pub fn tangential(&self, vector: Vector3<V>) -> (V, V) {
        (self.x.dot(vector), self.y.dot(vector))
    }
}

/// A symmetric operator on the tangent plane of a [`Frame`].
#[derive(Clone, Copy)]
pub(crate) struct Operator<V> {
    /// In the direction of the first tangent.
    pub a: V,
    /// The mixed part.
    pub b: V,
    /// In the direction of the second tangent.
    pub d: V,
}

/// Eigenvalues of an [`Operator`], and the direction of the larger.
#[derive(Clone, Copy)]
pub(crate) struct Principal<V> {
    /// The larger.
    pub k1: V,
    /// The smaller.
    pub k2: V,
    /// `(k1 + k2) / 2`
    pub mean: V,
    /// `k1 k2`
    pub gaussian: V,
    /// Unit direction of `k1` in the frame's tangents.
    pub direction: (V, V),
}

impl<V: Vector> Operator<V> {
    /// The operator with mean curvature `mean` whose curvature in the direction at the angle φ is
    /// `mean + p cos 2φ + q sin 2φ`.
    #[inline(always)]
    pub fn of_harmonics(mean: V, p: V, q: V) -> Self {
        Operator { a: mean + p, b: q, d: mean - p }
    }

    /// Principal curvatures and direction.
    #[inline(always)]
    pub fn principal(&self) -> Principal<V> {
        let half = V::constant(0.5);
        let mean = (self.a + self.d) * half;
        let delta = (self.a - self.d) * half;
        // Scaled by a power of two, so that no square leaves the range.
        let scale = delta.abs().max(self.b.abs()).unit_scale();
        let (scaled_delta, scaled_b) = (delta * scale, self.b * scale);
        let scaled_radius = (scaled_delta * scaled_delta + scaled_b * scaled_b).sqrt();
        let radius = scaled_radius / scale;
        let sum = scaled_radius + scaled_delta.abs();
        let length = (sum * sum + scaled_b * scaled_b).sqrt();
        let inverse = length.reciprocal_or_zero();
        let (long, short) = (sum * inverse, scaled_b * inverse);
        let swapped = delta.lt(V::zero());
        let direction = (V::select(swapped, short, long), V::select(swapped, long, short));
        let any = V::zero().lt(inverse);
        let direction = (V::select(any, direction.0, V::one()), V::select(any, direction.1, V::zero()));
        let (k1, k2) = (mean + radius, mean - radius);
        Principal { k1, k2, mean, gaussian: k1 * k2, direction }
    }
}

/// A vector or its opposite: the one whose first largest component is positive.
#[inline(always)]
pub(crate) fn positive<V: Vector>(vector: Vector3<V>) -> Vector3<V> {
    let Vector3 { x, y, z } = vector;
    let first = V::select(x.abs().lt(y.abs()), y, x);
    let largest = V::select(first.abs().lt(z.abs()), z, first);
    let sign = V::select(largest.lt(V::zero()), -V::one(), V::one());
    vector * sign
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_orthonormal() {
        for i in 0..2000 {
            let (u, v) = (i as f64 * 0.37, i as f64 * 1.13);
            let mut normal = Vector3 { x: u.sin() * v.cos(), y: u.sin() * v.sin(), z: u.cos() };
            if i == 0 {
                normal = Vector3 { x: 0.0, y: 0.0, z: -1.0 };
            }
            let Frame { normal, x, y } = Frame::new(normal);
            let z = x.cross(y);
            assert!((z - normal).squared() < 1e-30, "{i}");
            for (a, b, expected) in [(x, x, 1.0), (y, y, 1.0), (x, y, 0.0), (x, normal, 0.0), (y, normal, 0.0)] {
                assert!((a.dot(b) - expected).abs() < 4e-16, "{i}");
            }
        }
    }

    #[test]
    fn principal_curvatures_of_a_rotated_operator() {
        for i in 0..1000 {
            let (angle, k1, k2) = (i as f64 * 0.1, 3.0 + (i as f64).sin(), -2.0 + 3.9 * (i as f64 * 0.7).cos());
            let (c, s) = (angle.cos(), angle.sin());
            for size in [1.0, 1e-200, 1e200] {
                let operator = Operator {
                    a: (k1 * c * c + k2 * s * s) * size,
                    b: (k1 - k2) * c * s * size,
                    d: (k1 * s * s + k2 * c * c) * size,
                };
                let found = operator.principal();
                assert!((found.k1 / size - k1).abs() < 1e-14 && (found.k2 / size - k2).abs() < 1e-14);
                let along = (found.direction.0 * c + found.direction.1 * s).abs();
                assert!((along - 1.0).abs() < 1e-14, "{i} {size} {along}");
            }
        }
        let round = Operator { a: 2.0, b: 0.0, d: 2.0 }.principal();
        assert_eq!((round.k1, round.k2, round.direction), (2.0, 2.0, (1.0, 0.0)));
    }
}
