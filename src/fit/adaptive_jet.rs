//! Adaptive jets: a height polynomial of degree 4 whose weights and prior follow from what the mesh itself shows of its noise
//! and smoothness.
//!
//! **What.** The points of a neighbourhood (three to six rings by default), and the vertex itself, are heights `w(u, v)` over the
//! tangent plane. The 15 coefficients `c` of the polynomial are those of highest posterior probability:
//!
//! ```text
//! Σⱼ (wⱼ − Bⱼ c)² / (σⱼ² + τ₅² ρⱼ¹⁰)  +  |(p, q) − (p₀, q₀)|² / 0.2²  +  Σ_{d=2..4} Σᵢ c_{d,i}² / (binom(d, i) τ_d²)  →  min
//! ```
//!
//! with lengths in units of the vertex's mean edge length, `(p, q)` the slopes and `(p₀, q₀)` those of the one-ring normal, `ρ` the
//! distance, `σ` the noise and `τ_d` the sizes of [`AdaptiveModel`]. The binomials make the prior the same in all directions of the
//! tangent plane. What is small decides what counts: without noise only near points do (`τ₅² ρ¹⁰` is large elsewhere) and the fit is a plain jet; with much noise all
//! points do, and the prior holds the high degrees down. At a boundary and where points are few the prior decides what they leave
//! open, so there is no special case.
//!
//! **Coordinates.** In [`Coordinates::Circle`], monomials of degree 2 and more are those of `(u, v) ρ/√(u² + v²)`, with `ρ` the
//! distance in space: a sphere is then exactly quadratic, which is the idea of the circles of the paper's sections.
//!
//! **Frame.** The tangent plane is that of a ridge quadric over two rings around the one-ring normal (Max), unless that turns the
//! normal by more than 37°. Normal and shape operator are those of the fitted surface ([`Surface`]).
//!
//! **Outliers.** Where a point is off by more than `√20` of its standard deviation, the fit is repeated with the weights of a
//! Student distribution; and if a fifth of the points stay off, the neighbourhood is noisier than the mesh, and what the best of
//! three plain jets leaves of it is added to its noise.
//!
//! Input: neighbourhoods of any kind of mesh. Cost: 78 products and sums a point for the moments from which the 15 × 15 normal
//! equations follow, and their Cholesky factorisation; three passes over the points.
//! Reference: MacKay 1992, "Bayesian interpolation", for the principle; the estimator is this library's own.

use super::adaptive_model::{AdaptiveModel, Coordinates};
use super::heights::{Frame, Heights, plain_residuals, prepare, scratch, weigh};
use super::ridge::{Setting, TERMS, solve, squared_residual};
use super::surface::Surface;
use crate::simd::{Mask, Vector, each};
use crate::sweep::Patch;

/// A neighbourhood may extend so many mean edge lengths of its vertex.
const LARGEST_UNIT: f64 = 1e60;

/// The square of how many standard deviations a point may be off before the fit is repeated.
const OFF: f64 = 20.0;

/// The mean square of how many standard deviations a vertex and its first ring are off where the surface has a kink.
const KINKED: f64 = 20.0;

/// And of how many edge lengths they are off: that of a kink of 74° is far above this.
const KINK: f64 = 1e-4;

/// The square of the standard deviations at which weights have fallen to half.
const HALF_WEIGHT: f64 = 9.0;

/// Repetitions with weights.
const REPETITIONS: usize = 3;

/// The part of points that stay off where the neighbourhood is noisier than the mesh.
const NOISY_PART: f64 = 0.2;

/// The second derivatives of the heights, from those in the coordinates of the fit.
///
/// In [`Coordinates::Circle`] the degrees up to 2 are `w = g·t r + Q(t, t) ρ²` in a direction `t` of the plane, with slopes `g`: its
/// normal curvature there is `2 Q(t, t)/√(1 + g²)`, whatever `g·t`. The shape operator that has these is that of `R Q R`, `R` being the
/// root of the first fundamental form, exactly where all directions are alike, as on spheres, and else but for squares of the slopes.
#[inline(always)]
fn second_derivatives<V: Vector<Scalar = f64>>(coordinates: Coordinates, [p, q]: [V; 2], second: [V; 3]) -> [V; 3] {
    let [uu, uv, vv] = second;
    match coordinates {
        Coordinates::Height => second,
        Coordinates::Circle => {
            // R = 1 + g gᵀ/(1 + √(1 + g²))
            let share = V::one() / (V::one() + (V::one() + p * p + q * q).sqrt());
            let (a, b) = ((uu * p + uv * q) * share, (uv * p + vv * q) * share);
            let both = (a * p + b * q) * share;
            let two = V::constant(2.0);
            [uu + two * a * p + both * p * p, uv + a * q + b * p + both * p * q, vv + two * b * q + both * q * q]
        }
    }
}

/// The adaptive jets of a row of vertices.
pub(crate) struct AdaptiveJet<V: Vector> {
    /// In the patch's units.
    pub surface: Surface<V>,
    /// The root mean square of what the fit leaves of the heights, each as it counts, in the patch's units; 0 if it was not asked
    /// for.
    pub residual: V,
    /// How many of the 15 coefficients the data decide; 0 if it was not asked for.
    pub freedom: V,
    /// Lanes that have a result.
    pub trusted: V::Mask,
    /// Lanes in which a point is so far off that the fit should be repeated with lower weights for such.
    pub off: V::Mask,
    /// Lanes in which a smooth surface through the vertex and its first ring contradicts the model, and by no trifle.
    pub kinked: V::Mask,
}

/// How adaptive jets are fitted.
pub(crate) struct AdaptiveFit<'a> {
    pub model: AdaptiveModel,
    pub rings: usize,
    /// The mean length of each vertex's edges.
    pub edge_lengths: &'a [f64],
    /// The noise of each vertex, if it is not the same for all, in the mesh's unit.
    pub noise: Option<&'a [f64]>,
    /// Whether the number of coefficients that the data decide is asked for.
    pub freedom: bool,
    /// Whether what fits leave is asked for.
    pub residual: bool,
}

impl AdaptiveFit<'_> {
    /// What is known of a row of vertices, and one over their mean edge lengths in the patch's units. Fills in the variance of the noise.
    #[inline(always)]
    pub(super) fn setting<V: Vector<Scalar = f64>>(
        &self,
        vertices: &[u32],
        patch: &Patch<'_, V>,
        scale: V,
        heights: &mut Heights<'_, V>,
    ) -> (Setting<V>, V) {
        let model = &self.model;
        let load = |number: &dyn Fn(usize) -> f64| {
            V::from_lanes(&each(0.0, |lane| number(*vertices.get(lane).unwrap_or(&vertices[0]) as usize)))
        };
        let own = load(&|vertex| self.edge_lengths[vertex]);
        let unit = V::one() / (own * scale);
        let to_own = scale * unit;
        let noise = load(&|vertex| self.noise.map_or(model.noise, |noise| noise[vertex]));
        let squared = |noise: V| {
            let noise = (noise * to_own).max(V::constant(1e-100)).min(V::constant(1e100));
            noise * noise
        };
        let own_noise = squared(noise);
        heights.variance.fill(own_noise);
        for row in 1..=patch.len() {
            if let Some(noise) = patch.neighbour_value(row - 1) {
                heights.variance[row] = squared(noise);
            }
        }
        let graded = if model.size_exponent == 0 { own * V::constant(1.0 / model.edge_length) } else { V::one() };
        let mut factor = V::one();
        let sizes_squared = each(V::zero(), |index| {
            factor = factor * graded;
            let size = (V::constant(model.sizes[index]) * factor).max(V::constant(1e-100)).min(V::constant(1e100));
            size * size
        });
        let setting = Setting {
            sizes_squared,
            count: patch.count + V::one(),
            slopes: [V::zero(); 2],
            coordinates: model.coordinates,
        };
        (setting, unit)
    }

    /// Rows of scratch for a patch of so many points.
    pub(crate) fn scratch(&self, points: usize) -> usize {
        scratch(points)
    }

    /// The jets of a row of vertices, `robust` if points that are off are to count less.
    #[inline(always)]
    pub(crate) fn lanes<V: Vector<Scalar = f64>>(
        &self,
        vertices: &[u32],
        patch: &Patch<'_, V>,
        scale: V,
        robust: bool,
        scratch: &mut [V],
    ) -> AdaptiveJet<V> {
        let (mut heights, scratch) = Heights::new(scratch, patch.len());
        let heights = &mut heights;
        let (mut setting, unit) = self.setting(vertices, patch, scale, heights);
        let Frame { axes, slopes } = prepare(patch, unit, heights);
        setting.slopes = slopes;
        weigh(heights, &setting);
        let mut found = solve(heights, &setting, self.freedom && !robust);
        let (mut worst, mut all) = (V::zero(), V::zero());
        let (mut ring_misfit, mut ring_squares) = (V::zero(), V::zero());
        for row in 0..=patch.len() {
            let square = squared_residual(heights, &setting, &found.c, row);
            let misfit = square * heights.weight[row];
            worst = misfit.max(worst);
            all = all + misfit;
            if row <= patch.len_within(1) {
                let near = if row == 0 { V::one() } else { patch.weight_within(1, row - 1) };
                ring_misfit = ring_misfit + misfit * near;
                ring_squares = ring_squares + square * near;
            }
        }
        let typical = ((all - worst) / patch.count.max(V::one())).max(V::one());
        let ring = patch.count_within(1) + V::one();
        let kinked = (ring * V::constant(KINKED)).lt(ring_misfit).and((ring * V::constant(KINK)).lt(ring_squares));
        if robust {
            for _ in 0..REPETITIONS {
                // The weights of a Student distribution.
                for row in 0..heights.len() {
                    let square = squared_residual(heights, &setting, &found.c, row);
                    let weight = V::one() / (heights.variance[row] + square * V::constant(1.0 / HALF_WEIGHT));
                    let there = V::constant(row as f64).lt(setting.count);
                    heights.weight[row] = V::select(there, weight, V::zero());
                }
                found = solve(heights, &setting, self.freedom);
            }
            let mut off = V::zero();
            for row in 0..=patch.len() {
                let square = squared_residual(heights, &setting, &found.c, row);
                let is_off = (heights.variance[row] * V::constant(HALF_WEIGHT)).lt(square);
                off = off + V::select(is_off, V::one(), V::zero());
            }
            let noisy = (setting.count * V::constant(NOISY_PART)).lt(off);
            if noisy.bits() != 0 {
                let mut more = V::constant(f64::MAX);
                for (squares, freedom) in plain_residuals(patch, heights, scratch) {
                    let enough = V::constant(0.5).lt(freedom);
                    let variance = squares / freedom.max(V::one());
                    more = V::select(enough, variance, V::constant(f64::MAX)).min(more);
                }
                let more = V::select(more.lt(V::constant(f64::MAX)).and(noisy), more, V::zero());
                for row in 0..heights.len() {
                    heights.variance[row] = heights.variance[row] + more;
                    let there = V::constant(row as f64).lt(setting.count);
                    // Lanes that are not noisy keep their weights.
                    let weight = V::select(there, V::one() / heights.variance[row], V::zero());
                    heights.weight[row] = V::select(noisy, weight, heights.weight[row]);
                }
                let again = solve(heights, &setting, self.freedom);
                for term in 0..TERMS {
                    found.c[term] = V::select(noisy, again.c[term], found.c[term]);
                    found.variances[term] = V::select(noisy, again.variances[term], found.variances[term]);
                }
            }
        }
        let (mut squares, mut weights) = (V::zero(), V::one());
        if self.residual {
            weights = V::zero();
            for row in 0..=patch.len() {
                let square = squared_residual(heights, &setting, &found.c, row);
                squares = squares + square * heights.weight[row];
                weights = weights + heights.weight[row];
            }
        }
        let length = V::one() / unit;
        let c = &found.c;
        let two = V::constant(2.0);
        let (slopes, second) = ([c[1], c[2]], [two * c[3], c[4], two * c[5]]);
        let second = second_derivatives(setting.coordinates, slopes, second);
        let mut surface = Surface::of_derivatives(&axes, slopes, second);
        surface.shape.iter_mut().for_each(|x| *x = *x * unit);
        // Edges of no size beside that of the neighbourhood leave numbers that no unit could bring back into range.
        let inside = V::constant(1.0 / LARGEST_UNIT).lt(unit).and(unit.lt(V::constant(LARGEST_UNIT)));
        AdaptiveJet {
            surface,
            residual: (squares / weights).sqrt() * length,
            freedom: if self.freedom { found.freedom() } else { V::zero() },
            trusted: found.definite.and(inside),
            off: (typical * V::constant(OFF)).lt(worst),
            kinked,
        }
    }
}
