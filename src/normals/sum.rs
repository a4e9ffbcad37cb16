//! The sum over a fan from which a normal is made, and how much of it to believe.

use crate::simd::{Mask, Real, Vector, Vector3};
use crate::sweep::{CANCELLED, Ring, RingFaces, Scratch};

/// A vertex-normal estimator over one fan.
pub(crate) trait Estimator: Sync {
    /// The sum's unit: a length to this power.
    const POWER: i32;
    /// Whether a fan's sum is divided by its total weight.
    const MEAN: bool = false;
    /// Whether polygons need their centroids.
    const CENTROIDS: bool = false;
    /// As [`Quantity::EDGES`](crate::sweep::Quantity::EDGES).
    const EDGES: bool = true;

    /// The fan's weighted sum of normals, in the ring's units.
    fn sum<V: Vector, F: RingFaces<V>>(ring: &Ring<'_, V, F>, scratch: &mut Scratch<'_, V>) -> Sum<V>;
}

/// A weighted sum of normals.
#[derive(Clone, Copy)]
pub(crate) struct Sum<V> {
    /// The sum.
    pub vector: Vector3<V>,
    /// The sum of the squares of its terms; in single precision, of what they may have lost to rounding. Infinite
    /// where single precision cannot tell.
    pub spread: V,
    /// The sum of the weights, for an estimator whose [`Estimator::MEAN`] is set.
    pub total: V,
}

/// Single precision is trusted while the sum is at least `1/8` of the spread: its error is then below about 1e-6.
const TRUSTED_SINGLE: f64 = 1.0 / 64.0;

impl<V: Vector> Sum<V> {
    pub fn zero() -> Self {
        Sum { vector: Vector3::zero(), spread: V::zero(), total: V::zero() }
    }

    /// Where the sum has a direction that rounding has not made up, and its squared length.
    #[inline(always)]
    pub fn trusted(&self) -> (V::Mask, V) {
        let squared = self.vector.squared();
        let least = if V::Scalar::SINGLE { TRUSTED_SINGLE } else { CANCELLED * CANCELLED };
        let trusted = (self.spread * V::constant(least)).lt(squared);
        // Nearer the ends of the range, the square has lost digits that the root would need.
        let in_range = V::splat(V::Scalar::TINY).lt(squared).and(squared.lt(V::splat(V::Scalar::INFINITY)));
        (trusted.and(in_range), squared)
    }
}
