//! Interpolated corrected curvature measures.
//!
//! The positions of a triangle and unit normals `u₀ u₁ u₂` at its corners, interpolated linearly over it, give integrals of
//! area, mean and Gaussian curvature and of the curvature tensor in closed form, with `ū = (u₀ + u₁ + u₂)/3` and positions
//! relative to the first corner:
//!
//! `μ⁰ = ½ ū·(x₁ × x₂)`, `μ¹ = ½ ū·((u₀ − u₂) × x₁ + (u₁ − u₀) × x₂)`, `μ² = ½ u₀·(u₁ × u₂)`,
//! `μᵀ = ½ (x₂ × ū) (u₁ − u₀)ᵀ − ½ (x₁ × ū) (u₂ − u₀)ᵀ`
//!
//! Then `H = μ¹ / 2μ⁰`, `K = μ² / μ⁰` over a region, and the symmetric part of `μᵀ / μ⁰` in the tangent plane of the vertex
//! is the shape operator, from which `k₁`, `k₂` and the directions come (so `k₁ k₂` need not be `K` to the last digit). They
//! converge if the normals do, whatever the faces' own normals are like, and are exact where positions and normals are those
//! of a sphere. Their accuracy is that of the normals: give good ones.
//!
//! Input: any ring of triangles or polygons, with the normals of all vertices; a region of one ring, several, or a ball
//! (see [`measure`](super::measure)). A polygon counts as the fan of triangles around the mean of its corners, where the
//! normal is the mean of theirs; half of the two triangles at a corner belong to its vertex.
//! Reference: Lachaud, Romon, Thibert & Coeurjolly 2020, "Interpolated corrected curvature measures for polygonal surfaces",
//! section 3 and table 1; signs turned so that a sphere with outward normals is positive.
//! Boundary: no rule needed. Degenerate rule: a region whose corrected area is not positive (normals that face away from
//! the faces) has no result. Cost: no root and no division; about 120 products a corner.

use super::measure::{Measure, MeasureEstimator};
use super::outputs::Local;
use super::principal::{Frame, Operator};
use crate::simd::{Mask, Vector, Vector3};
use crate::sweep::{Ring, RingFaces, Scratch};

/// Lachaud, Romon, Thibert & Coeurjolly 2020.
pub(crate) struct CorrectedMeasure;

/// Adds a part of the measures of the triangle of the vertex, `a` and `b`, with normals in that order.
#[inline(always)]
fn add_triangle<V: Vector>(
    measure: &mut Measure<V>,
    (a, b): (Vector3<V>, Vector3<V>),
    [u0, u1, u2]: [Vector3<V>; 3],
    part: V,
) {
    let half = part * V::constant(0.5);
    let mean = (u0 + u1 + u2) * V::constant(1.0 / 3.0);
    let (turn1, turn2) = (u1 - u0, u2 - u0);
    measure.area = measure.area + mean.dot(a.cross(b)) * half;
    measure.mean = measure.mean + mean.dot(turn1.cross(b) - turn2.cross(a)) * half * V::constant(0.5);
    // u₀·(u₁ × u₂), from differences that have not lost digits.
    measure.gaussian = measure.gaussian + u0.dot(turn1.cross(turn2)) * half;
    measure.add_product(b.cross(mean), turn1, half);
    measure.add_product(a.cross(mean), turn2, -half);
}

impl MeasureEstimator for CorrectedMeasure {
    const NEIGHBOUR_NORMALS: bool = true;

    #[inline(always)]
    fn add<V: Vector, F: RingFaces<V>>(
        ring: &Ring<'_, V, F>,
        frame: &Frame<V>,
        _scratch: &mut Scratch<'_, V>,
        measure: &mut Measure<V>,
    ) {
        let third = V::constant(1.0 / 3.0);
        for index in 0..ring.corner_count() {
            let corner = ring.corner(index);
            let (a, b) = (corner.a, corner.b);
            let normals = [frame.normal, ring.normals[index], ring.normals[index + 1]];
            match corner.centre() {
                None => add_triangle(measure, (a, b), normals, third),
                Some((centre, mean, polygon)) => {
                    let triangle = third * (V::one() - polygon);
                    add_triangle(measure, (a, b), normals, triangle);
                    let half = polygon * V::constant(0.5);
                    add_triangle(measure, (a, centre), [frame.normal, normals[1], mean], half);
                    add_triangle(measure, (centre, b), [frame.normal, mean, normals[2]], half);
                }
            }
        }
    }

    #[inline(always)]
    fn finish<V: Vector>(measure: &Measure<V>, frame: &Frame<V>) -> Local<V> {
        let inverse = measure.area.reciprocal_or_zero();
        let tensor = measure.tangential(frame);
        let operator = Operator { a: tensor.a * inverse, b: tensor.b * inverse, d: tensor.d * inverse };
        let (mean, gaussian) = (measure.mean * inverse, measure.gaussian * inverse);
        Local {
            mean,
            gaussian,
            mean_normal: frame.normal * mean,
            area: measure.area,
            integrated_mean: measure.mean,
            integrated_gaussian: measure.gaussian,
            usable: V::zero().lt(inverse).and(V::zero().lt(measure.area)),
            ..Local::of_operator(frame, &operator)
        }
    }
}
