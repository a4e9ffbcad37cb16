//! Taubin's tensor of curvature.
//!
//! `M = Σ wᵢ κᵢ Tᵢ Tᵢᵀ` over the edges, `Tᵢ` the unit tangent direction of edge `i`, `κᵢ` the curvature of its section, `wᵢ`
//! proportional to the area of the faces at the edge, `Σ wᵢ = 1`. It approximates `(1/2π) ∫ κ(φ) T Tᵀ dφ`, whose eigenvalues
//! in the tangent plane are `m₁ = 3/8 k₁ + 1/8 k₂` and `m₂ = 1/8 k₁ + 3/8 k₂`, so `k₁ = 3m₁ − m₂` and `k₂ = 3m₂ − m₁`: the
//! operator `4M − tr(M)`.
//!
//! Input: any ring of triangles or polygons. Reference: Taubin 1995, "Estimating the tensor of curvature of a surface from a
//! polyhedral approximation", section 3; there κ is the circle's, here any section's.
//! The sum is the integral only where the edges stand at even angles; elsewhere, even on a regular grid, the method does
//! not converge. Boundary: the open fan counts as it is, which is no full circle, so values there are rough. Degenerate rule:
//! edges without length, along the normal or without area are left out; a vertex with none left has no result.
//! Cost: one root and three divisions a corner.

use super::Section;
use super::outputs::Local;
use super::principal::{Frame, Operator};
use super::ring::RingEstimator;
use super::section::{self, EdgeCurvature};
use super::shape_operator::double_angle;
use crate::simd::Vector;
use crate::sweep::{FaceNeeds, Ring, RingFaces, Scratch};

/// Taubin 1995.
pub(crate) struct Taubin {
    pub section: Section,
}

/// Sums over edges of the weight, and of the weighted curvature times 1, cos 2φ and sin 2φ.
#[derive(Clone, Copy)]
pub(crate) struct Sums<V> {
    weight: V,
    curvature: V,
    cos: V,
    sin: V,
}

impl RingEstimator for Taubin {
    const FACES: FaceNeeds = FaceNeeds::Planes;
    type Sums<V: Vector> = Sums<V>;

    #[inline(always)]
    fn start<V: Vector>() -> Sums<V> {
        let zero = V::zero();
        Sums { weight: zero, curvature: zero, cos: zero, sin: zero }
    }

    #[inline(always)]
    fn add<V: Vector, F: RingFaces<V>>(
        &self,
        ring: &Ring<'_, V, F>,
        frame: &Frame<V>,
        scratch: &mut Scratch<'_, V>,
        sums: &mut Sums<V>,
    ) {
        let [areas, ..] = &mut scratch.numbers;
        ring.fill_corners(areas, |corner| {
            let direction = corner.direction() * corner.area();
            direction.squared().sqrt() + corner.doubt()
        });
        for index in 0..ring.edge_count() {
            let edge = ring.edges[index];
            let EdgeCurvature { curvature, weight: counted } =
                section::edge(edge, ring.squared[index], frame.normal, self.section);
            let weight = (areas[index] + areas[index + 1]) * counted;
            let (cos, sin) = double_angle(frame.tangential(edge));
            let weighted = curvature * weight;
            sums.weight = sums.weight + weight;
            sums.curvature = sums.curvature + weighted;
            sums.cos = sums.cos + weighted * cos;
            sums.sin = sums.sin + weighted * sin;
        }
    }

    #[inline(always)]
    fn finish<V: Vector>(&self, sums: &Sums<V>, frame: &Frame<V>) -> Local<V> {
        let inverse = sums.weight.reciprocal_or_zero();
        // With κ T Tᵀ = κ/2 (1 + cos 2φ, sin 2φ; sin 2φ, 1 − cos 2φ), the operator 4M − tr(M) is this.
        let two = V::constant(2.0);
        let operator =
            Operator::of_harmonics(sums.curvature * inverse, sums.cos * inverse * two, sums.sin * inverse * two);
        Local { usable: V::zero().lt(inverse), ..Local::of_operator(frame, &operator) }
    }
}
