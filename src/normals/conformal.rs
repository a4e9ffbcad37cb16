//! N_CM: the vertex normal by a conformal map and mean value coordinates.
//!
//! Reference: "New Computation of Normal Vector and Curvature", sections 2.1 and 3.2, with the misprints of its formulas
//! corrected. The ring is flattened so that edge lengths stay and the angles fill the circle, `αᵢ = 2π θᵢ / Σθ`. Mean
//! value weights of the flattened ring, `ωᵢ = (tan(αᵢ₋₁/2) + tan(αᵢ/2)) / |eᵢ|`, `λᵢ = ωᵢ / Σω`, combine *edge* normals
//! `Neᵢ = unit(Nᵢ₋₁ + Nᵢ)`: `N = unit(Σ λᵢ Neᵢ)`.
//!
//! Input: any ring of triangles or polygons. What the paper leaves open:
//! - In an open fan `αᵢ = θᵢ`; the missing corner beyond each end has tangent 0, and the end's edge normal is that of
//!   its one face.
//! - `αᵢ ≥ π` (a corner that takes half of the cone or more): `αᵢ` is held at [`WIDEST`] · π, so that no weight is
//!   negative and the limit, weights `1/|e|` on the two edges of that corner, is reached smoothly.
//! - Opposite faces (`Nᵢ₋₁ + Nᵢ` vanishes), zero-length edges and faces without a normal drop out.
//! - Of several fans, each adds its own `Σ λᵢ Neᵢ`.
//!
//! Numerical notes: `tan(πy/2) = y r(y²) / ((1 − y)(1 + y))` puts the pole in the denominator, which joins the edge's own
//! division: an edge costs one square root and one division, a corner the same.

use super::sum::{Estimator, Sum};
use crate::simd::{Real, Vector, Vector3, tangent_parts};
use crate::sweep::{Ring, RingFaces, Scratch};

/// Where `α/π` is held: at this value the two edges of a corner outweigh the others by a million to one.
const WIDEST: f64 = 1.0 - 1.0 / (1u64 << 20) as f64;

/// Unit normals whose sum is shorter than this (squared) are opposite: the direction of their sum is rounding error.
const OPPOSITE: f64 = 1.0 / (1u128 << 80) as f64;

/// N_CM
pub(crate) struct Conformal;

impl Estimator for Conformal {
    const POWER: i32 = 0;
    const MEAN: bool = true;

    #[inline(always)]
    fn sum<V: Vector, F: RingFaces<V>>(ring: &Ring<'_, V, F>, scratch: &mut Scratch<'_, V>) -> Sum<V> {
        let corners = ring.corner_count();
        // Row `j + 1` is corner `j`. Rows 0 and `corners + 1` are the corners beyond the ends: the same ring's last and
        // first if it is closed, and otherwise none, which is a zero normal and a zero tangent.
        let Scratch { vectors: normals, numbers: [tangents, denominators, spreads], .. } = scratch;
        let normals = &mut normals[..corners + 2];
        let tangents = &mut tangents[..corners + 2];
        let denominators = &mut denominators[..corners + 2];
        let spreads = &mut spreads[..corners + 2];

        let mut cone = V::zero();
        for index in 0..corners {
            let corner = ring.corner(index);
            let (unit, angle) = corner.unit_and_angle();
            normals[index + 1] = corner.direction() * unit;
            spreads[index + 1] = corner.cone_spread(unit);
            tangents[index + 1] = angle;
            cone = cone + angle;
        }
        let flatten = if ring.closed {
            V::constant(2.0) * cone.reciprocal_or_zero()
        } else {
            V::constant(std::f64::consts::FRAC_1_PI)
        };
        for index in 1..=corners {
            let half_turn = (tangents[index] * flatten).min(V::constant(WIDEST));
            (tangents[index], denominators[index]) = tangent_parts(half_turn);
        }
        for (beyond, inside) in [(0, corners), (corners + 1, 1)] {
            normals[beyond] = if ring.closed { normals[inside] } else { Vector3::zero() };
            tangents[beyond] = if ring.closed { tangents[inside] } else { V::zero() };
            denominators[beyond] = if ring.closed { denominators[inside] } else { V::one() };
            spreads[beyond] = if ring.closed { spreads[inside] } else { V::zero() };
        }

        let mut sum = Sum::zero();
        let edge_count = corners + !ring.closed as usize;
        for edge in 0..edge_count {
            let both = normals[edge] + normals[edge + 1];
            let both_squared = both.squared();
            let tangent = tangents[edge] * denominators[edge + 1] + tangents[edge + 1] * denominators[edge];
            let length = (both_squared * ring.squared[edge]).sqrt();
            let denominator = denominators[edge] * denominators[edge + 1] * length;
            let reciprocal = denominator.reciprocal_or_zero();
            let opposite = both_squared.lt(V::constant(OPPOSITE));
            let factor = V::select(opposite, V::zero(), tangent * reciprocal);
            sum.vector = sum.vector + both * factor;
            sum.total = sum.total + factor * both_squared.sqrt();
            let spread =
                factor * factor * if V::Scalar::SINGLE { spreads[edge] + spreads[edge + 1] } else { both_squared };
            // A single-precision term that dropped out is for double precision to judge.
            let counted = V::zero().lt(reciprocal);
            let doubt = if V::Scalar::SINGLE { V::splat(V::Scalar::INFINITY) } else { V::zero() };
            sum.spread = sum.spread + V::select(counted, spread, doubt);
        }
        sum
    }
}
