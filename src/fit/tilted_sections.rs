//! Sections along the edges of one ring, with a tilt of the normal: normal and shape operator from one 5 × 5 solve.
//!
//! The curvature of the circle through a neighbour and tangent to the plane of the normal `N` (the paper's C section, Table 4) is
//! right only as far as `N` is. Here `N` may tilt by the slopes `(p, q)`, to first order:
//!
//! ```text
//! 2 N·x / |x|² = a c² + 2 b c s + d s² + (2 / |x|) (|t| / |x|) (p c + q s)      (c, s) the direction of the tangential part t of x
//! ```
//!
//! for every edge `x`, in the sense of least squares. Lengths are in units of the harmonic mean `l` of the edges; an edge weighs
//! `(|x|/l)² / (1 + (|x|/l)²)`, so that very short ones, which magnify what `N` is off, count less; and a ridge of 0.1 holds the tilt
//! back, so that rings of three and four edges, which do not determine it, keep `N`; a tiny one makes points as round as the edges
//! allow where these leave that open. Normal and shape operator are those of the
//! surface with the slopes `p, q` and the second derivatives `a, b, d` over the plane of `N` ([`Surface`]).
//!
//! `N` is Max's normal: then both are exact on spheres. On irregular smooth meshes the normal is of second order where a vertex has five
//! neighbours or more. Input: any ring, of triangles or polygons; several fans are fitted together, each edge in units of its fan's
//! mean but for the curvatures, which all share.
//! Reference: the sections are those of "New Computation of Normal Vector and Curvature", section 4; the tilt is this library's own.
//! Degenerate rule: edges without length or along `N` are left out; without any edge left there is no result. Boundary: no rule
//! needed. Cost: two square roots, two divisions and some forty products an edge; 60 products for the solve.

use super::axes::Axes;
use super::cholesky::factor_and_solve;
use super::surface::Surface;
use crate::simd::{Mask, Vector, Vector3};
use crate::sweep::{Ring, RingFaces};

/// The unknowns `(a + d)/2, (a − d)/2, b, p, q`.
const K: usize = 5;

/// What is added to the diagonal for what differs from direction to direction, per weight; the mean needs nothing, so spheres are exact.
const RIDGE: f64 = 2e-6;

/// And for the tilt.
const TILT_RIDGE: f64 = 0.1;

/// What is added up over the edges of all fans of a vertex.
#[derive(Clone, Copy)]
pub(crate) struct TiltedSums<V> {
    matrix: [[V; K]; K],
    right: [V; K],
    weight: V,
    /// The sum of the weights times the squared unit of length.
    scale: V,
}

/// What follows from them.
pub(crate) struct Tilted<V: Vector> {
    /// In the ring's units.
    pub surface: Surface<V>,
    /// Lanes that have a result.
    pub trusted: V::Mask,
}

impl<V: Vector> TiltedSums<V> {
    pub fn new() -> Self {
        TiltedSums { matrix: [[V::zero(); K]; K], right: [V::zero(); K], weight: V::zero(), scale: V::zero() }
    }

    /// Adds the edges of a fan.
    #[inline(always)]
    pub fn add<F: RingFaces<V>>(&mut self, ring: &Ring<'_, V, F>, x: Vector3<V>, y: Vector3<V>, normal: Vector3<V>) {
        let (mut sum, mut count) = (V::zero(), V::zero());
        for index in 0..ring.edge_count() {
            let inverse = ring.squared[index].sqrt().reciprocal_or_zero();
            sum = sum + inverse;
            count = count + V::select(V::zero().lt(inverse), V::one(), V::zero());
        }
        let unit = count * sum.reciprocal_or_zero();
        for index in 0..ring.edge_count() {
            let edge = ring.edges[index];
            let (u, v, w) = (x.dot(edge), y.dot(edge), normal.dot(edge));
            let inverse_squared = ring.squared[index].reciprocal_or_zero();
            let flat = u * u + v * v;
            let inverse_flat = flat.reciprocal_or_zero();
            let there = V::zero().lt(inverse_squared).and(V::zero().lt(inverse_flat));
            // In units of l: 2/|x|² · l (u, v) is 2/|x| · |t|/|x| · (c, s). Only the curvatures are in units that all fans share.
            let twice = V::constant(2.0) * inverse_squared * unit;
            let relative = ring.squared[index];
            let weight = relative / (relative + unit * unit);
            let weight = V::select(there, weight, V::zero());
            let per_flat = inverse_flat * unit;
            let both = (u * v) * per_flat;
            let row = [unit, (u * u - v * v) * per_flat, both + both, twice * u, twice * v];
            let curvature = twice * w;
            for i in 0..K {
                let weighted = row[i] * weight;
                for (sum, other) in self.matrix[i][..i + 1].iter_mut().zip(row) {
                    *sum = *sum + weighted * other;
                }
                self.right[i] = self.right[i] + weighted * curvature;
            }
            self.weight = self.weight + weight;
            self.scale = self.scale + weight * (unit * unit);
        }
    }

    /// Solves.
    #[inline(always)]
    pub fn finish(mut self, x: Vector3<V>, y: Vector3<V>, normal: Vector3<V>) -> Tilted<V> {
        for k in [1, 2] {
            self.matrix[k][k] = self.matrix[k][k] + self.scale * V::constant(RIDGE);
        }
        for k in [3, 4] {
            self.matrix[k][k] = self.matrix[k][k] + self.weight * V::constant(TILT_RIDGE);
        }
        let (factored, [mean, half, mixed, p, q]) = factor_and_solve(&mut self.matrix, self.right);
        let definite = factored.definite;
        let surface = Surface::of_derivatives(&Axes::of(x, y, normal), [p, q], [mean + half, mixed, mean - half]);
        Tilted { surface, trusted: definite.and(V::zero().lt(self.weight)) }
    }
}
