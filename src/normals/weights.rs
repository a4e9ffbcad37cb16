//! Vertex normals as weighted sums of face normals.
//!
//! `N = unit(Σ wᵢ Nᵢ)` over the corners of a vertex, for triangles and polygons, at interior, boundary and
//! non-manifold vertices alike: none of these weights needs to know how the corners hang together.
//!
//! | type | weight `wᵢ` | reference |
//! |---|---|---|
//! | [`Uniform`] | 1 | Gouraud 1971, `N_G` |
//! | [`Angle`] | θᵢ | Thürmer & Wüthrich 1998, `N_T` |
//! | [`Area`] | \|fᵢ\| | `N_M` of the paper, which cites it as Taubin's |
//! | [`CentroidArea`] | \|fᵢ\| / \|gᵢ − V\| | Chen & Wu 2004 as the paper prints it |
//! | [`Centroid`] | 1 / \|gᵢ − V\|² | Chen & Wu 2004, `N_C` of the paper's tables |
//! | [`Max`] | sin θᵢ / (a b) | Max 1999 |
//! | [`InverseRootEdges`] | 1 / √(a b) | Jin, Lewis & West 2005 |
//! | [`Sine`] | sin θᵢ | |
//! | [`AngleEdges`] | θᵢ a b | |
//!
//! `a`, `b` are the lengths of the two edges of the corner, `gᵢ` the centroid of the face (of its area), θᵢ its
//! interior angle: up to 2π at a reflex corner of a polygon, where `sin θᵢ` counts by its absolute value, so that no
//! face ever counts against its own normal.
//!
//! Numerical notes: for a triangle `|a × b| = a b sin θ`, so most weights are a factor of the cross product and cost
//! no square root; the angle is `atan2(|a × b|, a·b)`, accurate for slivers.
//! Degenerate rule: a face without a normal, and a weight that would divide by zero, add nothing. Where lengths around
//! a vertex differ by more than about 1e60, the shorter ones count as zero.
//! Cost: one pass over the ring; at most two square roots and two divisions a corner.

use super::sum::{Estimator, Sum};
use crate::simd::{Vector, Vector3};
use crate::sweep::{Corner, Face, Ring, RingFaces, Scratch};

/// A weight of faces at their corners.
pub(crate) trait CornerWeight: Sync {
    /// The weight's unit: a length to this power.
    const DIMENSION: i32;
    /// Whether it asks for the centroid.
    const NEEDS_CENTROID: bool = false;
    /// Whether it looks at the edges of a polygon.
    const LOOKS_AT_EDGES: bool = true;
    /// Whether factors are in units of [`Face::AREA_UNIT`], which is put in after the sum.
    const AREA: bool = false;

    /// How much of the term is in doubt, as [`Corner::spread`].
    #[inline(always)]
    fn spread<V: Vector, F: Face<V>>(corner: &Corner<V, F>, factor: V) -> V {
        corner.spread(factor)
    }

    /// The weight, as a factor of the corner's [`Corner::direction`].
    fn factor<V: Vector, F: Face<V>>(corner: &Corner<V, F>) -> V;
}

impl<W: CornerWeight> Estimator for W {
    const POWER: i32 = W::DIMENSION;
    const CENTROIDS: bool = W::NEEDS_CENTROID;
    const EDGES: bool = W::LOOKS_AT_EDGES;

    #[inline(always)]
    fn sum<V: Vector, F: RingFaces<V>>(ring: &Ring<'_, V, F>, _scratch: &mut Scratch<'_, V>) -> Sum<V> {
        let mut sum = Sum::zero();
        for index in 0..ring.corner_count() {
            let (term, spread) = term::<W, V, F::Face>(&ring.corner(index));
            sum.vector = sum.vector + term;
            sum.spread = sum.spread + spread;
        }
        if W::AREA {
            let unit = V::constant(F::Face::AREA_UNIT);
            sum.vector = sum.vector * unit;
            sum.spread = sum.spread * (unit * unit);
        }
        sum
    }
}

/// One corner's term of the sum, and its part of [`Sum::spread`].
#[inline(always)]
pub(crate) fn term<W: CornerWeight, V: Vector, F: Face<V>>(corner: &Corner<V, F>) -> (Vector3<V>, V) {
    let factor = W::factor(corner);
    (corner.direction() * factor, W::spread(corner, factor))
}

/// The weight 1.
pub(crate) struct Uniform;
impl CornerWeight for Uniform {
    const DIMENSION: i32 = 0;
    const LOOKS_AT_EDGES: bool = false;
    #[inline(always)]
    fn factor<V: Vector, F: Face<V>>(corner: &Corner<V, F>) -> V {
        corner.unit()
    }
}

/// The interior angle.
pub(crate) struct Angle;
impl CornerWeight for Angle {
    const DIMENSION: i32 = 0;
    #[inline(always)]
    fn factor<V: Vector, F: Face<V>>(corner: &Corner<V, F>) -> V {
        let (unit, angle) = corner.unit_and_angle();
        unit * angle
    }
    #[inline(always)]
    fn spread<V: Vector, F: Face<V>>(corner: &Corner<V, F>, factor: V) -> V {
        corner.angle_spread(factor)
    }
}

/// The area.
pub(crate) struct Area;
impl CornerWeight for Area {
    const DIMENSION: i32 = 2;
    const LOOKS_AT_EDGES: bool = false;
    const AREA: bool = true;
    #[inline(always)]
    fn factor<V: Vector, F: Face<V>>(corner: &Corner<V, F>) -> V {
        corner.area_factor()
    }
    #[inline(always)]
    fn spread<V: Vector, F: Face<V>>(corner: &Corner<V, F>, factor: V) -> V {
        corner.plain_spread(factor)
    }
}

/// The area by the distance to the centroid.
pub(crate) struct CentroidArea;
impl CornerWeight for CentroidArea {
    const DIMENSION: i32 = 1;
    const NEEDS_CENTROID: bool = true;
    #[inline(always)]
    fn factor<V: Vector, F: Face<V>>(corner: &Corner<V, F>) -> V {
        corner.area() * corner.centroid_squared().sqrt().reciprocal_or_zero()
    }
}

/// One by the squared distance to the centroid.
pub(crate) struct Centroid;
impl CornerWeight for Centroid {
    const DIMENSION: i32 = -2;
    const NEEDS_CENTROID: bool = true;
    #[inline(always)]
    fn factor<V: Vector, F: Face<V>>(corner: &Corner<V, F>) -> V {
        corner.unit() * corner.centroid_squared().reciprocal_or_zero()
    }
}

/// The sine of the angle by the product of the edge lengths.
pub(crate) struct Max;
impl CornerWeight for Max {
    const DIMENSION: i32 = -2;
    #[inline(always)]
    fn factor<V: Vector, F: Face<V>>(corner: &Corner<V, F>) -> V {
        corner.sine_product() * corner.product.reciprocal_or_zero()
    }
    #[inline(always)]
    fn spread<V: Vector, F: Face<V>>(corner: &Corner<V, F>, factor: V) -> V {
        corner.sine_spread(factor, corner.product.reciprocal_or_zero())
    }
}

/// One by the root of the product of the edge lengths.
pub(crate) struct InverseRootEdges;
impl CornerWeight for InverseRootEdges {
    const DIMENSION: i32 = -1;
    #[inline(always)]
    fn factor<V: Vector, F: Face<V>>(corner: &Corner<V, F>) -> V {
        corner.unit() * corner.product.sqrt().sqrt().reciprocal_or_zero()
    }
}

/// The sine of the angle.
pub(crate) struct Sine;
impl CornerWeight for Sine {
    const DIMENSION: i32 = 0;
    #[inline(always)]
    fn factor<V: Vector, F: Face<V>>(corner: &Corner<V, F>) -> V {
        corner.sine_product() * corner.product.sqrt().reciprocal_or_zero()
    }
    #[inline(always)]
    fn spread<V: Vector, F: Face<V>>(corner: &Corner<V, F>, factor: V) -> V {
        corner.sine_spread(factor, corner.product.sqrt().reciprocal_or_zero())
    }
}

/// The angle times the product of the edge lengths.
pub(crate) struct AngleEdges;
impl CornerWeight for AngleEdges {
    const DIMENSION: i32 = 2;
    #[inline(always)]
    fn factor<V: Vector, F: Face<V>>(corner: &Corner<V, F>) -> V {
        let (unit, angle) = corner.unit_and_angle();
        unit * angle * corner.product.sqrt()
    }
    #[inline(always)]
    fn spread<V: Vector, F: Face<V>>(corner: &Corner<V, F>, factor: V) -> V {
        corner.angle_spread(factor)
    }
}
