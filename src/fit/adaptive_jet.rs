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
//! distance, `σ` the noise and `τ_d` the sizes of [`AdaptiveModel`]. The binomials make the prior the same in all directions of the tangent plane. What is small decides what
//! counts: without noise only near points do (`τ₅² ρ¹⁰` is large elsewhere) and the fit is a plain jet; with much noise all
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
use super::axes::Axes;
use super::cholesky::factor;
use super::least_squares;
use super::surface::Surface;
use crate::simd::{MAX_LANES, Mask, Vector, Vector3};
use crate::sweep::Patch;

/// The coefficients of a polynomial of degree 4.
const TERMS: usize = 15;

/// The degree of each coefficient. Those of degree `d` belong to `u^d`, `u^(d−1) v` … `v^d`.
const DEGREES: [usize; TERMS] = [0, 1, 1, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 4];

/// The binomial coefficients that go with them.
const BINOMIALS: [f64; TERMS] = [1.0, 1.0, 1.0, 1.0, 2.0, 1.0, 1.0, 3.0, 3.0, 1.0, 1.0, 4.0, 6.0, 4.0, 1.0];

/// `1/variance` of the slopes about those of the one-ring normal, which is hardly ever more than 20° off: nothing beside what points
/// tell, unless these lie along a line.
const SLOPE_PRIOR: f64 = 25.0;

/// Where points are this few, with the vertex, that normal is as good as they are.
const FEW: f64 = 8.0;

/// `1/variance` of the slopes there.
const FEW_SLOPE_PRIOR: f64 = 100.0;

/// Where there are no more points than coefficients, what these leave open follows from the prior, which must not drown in the rounding
/// of the points' weights: there the noise is at least this part of the size of degree 2.
const FEW_NOISE: f64 = 1e-4;

/// What is added to the diagonal of the quadric that finds the frame, relative to its mean of each degree.
const FRAME_RIDGE: f64 = 1e-6;

/// The cosine of the largest turn of the frame.
const MOST_TURN: f64 = 0.8;

/// Below this squared length, in edge lengths, the projection of a point has no direction.
const NO_DIRECTION: f64 = 1e-20;

/// The square of the distance, in edge lengths, beyond which points do not count.
const FARTHEST: f64 = 1e20;

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

/// Points are added up so many at a time.
const ROWS: usize = 4;

/// Rows of numbers a point.
const COLUMNS: usize = 6;

/// Points as heights over a tangent plane, in units of the vertex's mean edge length; the vertex itself first. Lanes that have fewer
/// points than others have zeros, and weight 0.
pub(super) struct Heights<'s, V> {
    /// The point's place in the plane; from [`weigh`] on in the coordinates of degree 2 and more.
    pub u: &'s mut [V],
    /// See `u`.
    pub v: &'s mut [V],
    /// The height.
    pub w: &'s mut [V],
    /// What `u` and `v` are to be multiplied with to be the place in the plane.
    back: &'s mut [V],
    /// The variance with which the point counts; before [`weigh`], that of its noise.
    pub variance: &'s mut [V],
    /// One over the variance, or less for a point that is off.
    weight: &'s mut [V],
}

/// The rows for so many points and the vertex, rounded up.
fn rows(points: usize) -> usize {
    (points + 1).next_multiple_of(ROWS)
}

/// Rows of scratch for so many points: for their heights, and behind these for a plain jet.
pub(super) fn scratch(points: usize) -> usize {
    COLUMNS * rows(points) + (TERMS + 1) * rows(points).max(TERMS)
}

impl<'s, V: Vector<Scalar = f64>> Heights<'s, V> {
    /// For so many points, in `scratch`; answers with the rest of that as well.
    #[inline(always)]
    pub fn new(scratch: &'s mut [V], points: usize) -> (Self, &'s mut [V]) {
        let rows = rows(points);
        let (u, rest) = scratch.split_at_mut(rows);
        let (v, rest) = rest.split_at_mut(rows);
        let (w, rest) = rest.split_at_mut(rows);
        let (back, rest) = rest.split_at_mut(rows);
        let (variance, rest) = rest.split_at_mut(rows);
        let (weight, rest) = rest.split_at_mut(rows);
        back.fill(V::one());
        (Heights { u, v, w, back, variance, weight }, rest)
    }

    /// How many rows there are.
    #[inline(always)]
    fn len(&self) -> usize {
        self.u.len()
    }
}

/// What a lane knows of its vertex and the mesh.
#[derive(Clone, Copy)]
pub(super) struct Setting<V> {
    /// The squared sizes `τ_d²` of degrees 2 to 4 and of what lies beyond, for lengths in the vertex's own units.
    pub sizes_squared: [V; 4],
    /// The number of points, the vertex among them.
    pub count: V,
    /// The slopes of the one-ring normal in the frame.
    pub slopes: [V; 2],
    pub coordinates: Coordinates,
}

/// The most probable coefficients of a row of vertices.
pub(super) struct Coefficients<V: Vector> {
    pub c: [V; TERMS],
    /// The diagonal of their covariance, if it was asked for.
    pub variances: [V; TERMS],
    /// `1/variance` of their prior.
    prior: [V; TERMS],
    /// `bᵀ c` and the reciprocals of the factor's pivots, of which the evidence is made.
    explained: V,
    inverse_pivots: [V; TERMS],
    pub definite: V::Mask,
}

/// The frame of a row of vertices, and their points in it.
pub(super) struct Frame<V: Vector> {
    pub axes: Axes<V>,
    /// The slopes of the one-ring normal.
    pub slopes: [V; 2],
}

/// Puts a patch into its frame. `unit` is one over the vertex's mean edge length in the patch's units.
#[inline(always)]
pub(super) fn prepare<V: Vector<Scalar = f64>>(
    patch: &Patch<'_, V>,
    unit: V,
    heights: &mut Heights<'_, V>,
) -> Frame<V> {
    let axes = frame(patch, unit);
    for row in 0..heights.len() {
        let point = if row == 0 || row > patch.len() {
            Vector3::zero()
        } else {
            axes.components(patch.point(row - 1)) * unit
        };
        (heights.u[row], heights.v[row], heights.w[row]) = (point.x, point.y, point.z);
    }
    let normal = axes.components(patch.normal);
    let inverse = V::one() / normal.z.max(V::constant(MOST_TURN * 0.5));
    Frame { axes, slopes: [-(normal.x * inverse), -(normal.y * inverse)] }
}

/// The tangent plane: see the top of this file.
#[inline(always)]
fn frame<V: Vector<Scalar = f64>>(patch: &Patch<'_, V>, unit: V) -> Axes<V> {
    const QUADRIC: usize = 6;
    let start = Axes::about(patch.normal);
    let mut matrix = [[V::zero(); QUADRIC]; QUADRIC];
    let mut right = [V::zero(); QUADRIC];
    // The vertex itself.
    matrix[0][0] = V::one();
    for index in 0..patch.len_within(2) {
        let Vector3 { x: u, y: v, z: w } = start.components(patch.point(index)) * unit;
        let weight = patch.weight_within(2, index) / (V::one() + u * u + v * v);
        let terms = [V::one(), u, v, u * u, u * v, v * v];
        for row in 0..QUADRIC {
            let weighted = terms[row] * weight;
            for column in 0..=row {
                matrix[row][column] = matrix[row][column] + weighted * terms[column];
            }
            right[row] = right[row] + weighted * w;
        }
    }
    // The same in all directions of the plane: `uv` counts half of `u²`.
    let half = V::constant(0.5);
    let slopes = (matrix[1][1] + matrix[2][2]) * half;
    let curvatures = (matrix[3][3] + matrix[4][4] + matrix[4][4] + matrix[5][5]) * V::constant(0.375);
    let ridge = [matrix[0][0], slopes, slopes, curvatures, curvatures * half, curvatures];
    for (k, row) in matrix.iter_mut().enumerate() {
        row[k] = row[k] + ridge[k] * V::constant(FRAME_RIDGE) + V::constant(f64::MIN_POSITIVE);
    }
    let factored = factor(&mut matrix);
    let definite = factored.definite;
    let [_, p, q, ..] = factored.solve(right);
    let normal = start.vector(-p, -q, V::one());
    let normal = normal * (V::one() / normal.squared().sqrt());
    let turned = definite.and(V::constant(MOST_TURN).lt(normal.dot(patch.normal)));
    Axes::about(Vector3 {
        x: V::select(turned, normal.x, patch.normal.x),
        y: V::select(turned, normal.y, patch.normal.y),
        z: V::select(turned, normal.z, patch.normal.z),
    })
}

/// Goes over to the coordinates of the setting, and sets the variances and weights of all points. To be called once.
#[inline(always)]
pub(super) fn weigh<V: Vector<Scalar = f64>>(heights: &mut Heights<'_, V>, setting: &Setting<V>) {
    let open = setting.count.lt(V::constant(TERMS as f64 + 0.5));
    let least = V::select(open, setting.sizes_squared[0] * V::constant(FEW_NOISE * FEW_NOISE), V::zero());
    for row in 0..heights.len() {
        let (u, v, w) = (heights.u[row], heights.v[row], heights.w[row]);
        // A point so far away that its powers would leave the range counts for nothing anyway.
        let near = (u * u + v * v + w * w).lt(V::constant(FARTHEST));
        let [u, v, w] = [u, v, w].map(|x| V::select(near, x, V::zero()));
        (heights.u[row], heights.v[row], heights.w[row]) = (u, v, w);
        let flat = u * u + v * v;
        let mut squared = flat;
        if setting.coordinates == Coordinates::Circle {
            squared = flat + w * w;
            let directed = V::constant(NO_DIRECTION).lt(flat);
            let (flat, squared) = (V::select(directed, flat, V::one()), V::select(directed, squared, V::one()));
            let inverse = V::one() / (flat * squared);
            let back = (flat * flat * inverse).sqrt();
            let forth = back * (squared * squared * inverse);
            (heights.u[row], heights.v[row], heights.back[row]) = (u * forth, v * forth, back);
        }
        let fourth = squared * squared;
        let noise = heights.variance[row].max(least);
        let variance = noise + setting.sizes_squared[3] * (fourth * fourth * squared);
        heights.variance[row] = variance.min(V::constant(1e200));
        let there = V::constant(row as f64).lt(setting.count).and(near);
        heights.weight[row] = V::select(there, V::one() / heights.variance[row], V::zero());
    }
}

/// Solves for the coefficients, with the weights that are set.
#[inline(always)]
pub(super) fn solve<V: Vector<Scalar = f64>>(
    heights: &Heights<'_, V>,
    setting: &Setting<V>,
    with_variances: bool,
) -> Coefficients<V> {
    let Moments { plain, back, back_twice, right } = moments(heights);
    // A product of two terms is a monomial of the summed degrees, with a factor `back` for each that is linear.
    let mut matrix = [[V::zero(); TERMS]; TERMS];
    for row in 0..TERMS {
        for column in 0..=row {
            let (d, e) = (DEGREES[row], DEGREES[column]);
            let at = first_of(d + e) + (row - first_of(d)) + (column - first_of(e));
            matrix[row][column] = match (d == 1, e == 1) {
                (true, true) => back_twice[at - first_of(2)],
                (true, false) | (false, true) => back[at],
                (false, false) => plain[at],
            };
        }
    }
    let few = setting.count.lt(V::constant(FEW + 0.5));
    let slope_prior = V::select(few, V::constant(FEW_SLOPE_PRIOR), V::constant(SLOPE_PRIOR));
    let mut prior = [V::zero(); TERMS];
    let mut right = right;
    for term in 1..TERMS {
        prior[term] = match DEGREES[term] {
            1 => slope_prior,
            degree => V::one() / (setting.sizes_squared[degree - 2] * V::constant(BINOMIALS[term])),
        };
        matrix[term][term] = matrix[term][term] + prior[term];
    }
    for axis in 0..2 {
        right[1 + axis] = right[1 + axis] + prior[1 + axis] * setting.slopes[axis];
    }
    let factored = factor(&mut matrix);
    let c = factored.solve(right);
    let mut explained = V::zero();
    for term in 0..TERMS {
        explained = explained + right[term] * c[term];
    }
    let variances = if with_variances { factored.inverse_diagonal() } else { [V::zero(); TERMS] };
    let (inverse_pivots, definite) = (*factored.inverse_pivots(), factored.definite);
    Coefficients { c, variances, prior, explained, inverse_pivots, definite }
}

/// Where the monomials of a degree start, if all are in a row.
const fn first_of(degree: usize) -> usize {
    degree * (degree + 1) / 2
}

/// Sums over the points of weight times monomials of `(u, v)` in the coordinates of degree 2 and more.
struct Moments<V> {
    /// Those up to degree 8 (but 1, which is not needed).
    plain: [V; first_of(9)],
    /// With a factor `back`, of degrees 1, 3, 4, 5.
    back: [V; first_of(6)],
    /// With its square, of degree 2.
    back_twice: [V; 3],
    /// Weight times height times each term.
    right: [V; TERMS],
}

#[inline(always)]
fn moments<V: Vector<Scalar = f64>>(heights: &Heights<'_, V>) -> Moments<V> {
    let mut sums = Moments {
        plain: [V::zero(); first_of(9)],
        back: [V::zero(); first_of(6)],
        back_twice: [V::zero(); 3],
        right: [V::zero(); TERMS],
    };
    for first in (0..heights.len()).step_by(ROWS) {
        let rows = first..first + ROWS;
        let (mut u, mut v, mut plain, mut back, mut twice, mut right) = (
            [V::zero(); ROWS],
            [V::zero(); ROWS],
            [V::zero(); ROWS],
            [V::zero(); ROWS],
            [V::zero(); ROWS],
            [V::zero(); ROWS],
        );
        let mut right_back = right;
        for (row, index) in rows.enumerate() {
            let (height, weight, leads_back) = (heights.w[index], heights.weight[index], heights.back[index]);
            (u[row], v[row]) = (heights.u[index], heights.v[index]);
            plain[row] = weight;
            back[row] = weight * leads_back;
            twice[row] = back[row] * leads_back;
            right[row] = weight * height;
            right_back[row] = back[row] * height;
        }
        add_series::<V, 9>(&mut sums.plain, &u, &v, plain, 0b10);
        add_series::<V, 6>(&mut sums.back, &u, &v, back, 0b101);
        let mut degree_2 = [V::zero(); first_of(3)];
        degree_2[3..].copy_from_slice(&sums.back_twice);
        add_series::<V, 3>(&mut degree_2, &u, &v, twice, 0b11);
        sums.back_twice.copy_from_slice(&degree_2[3..]);
        let mut linear = [sums.right[0], sums.right[1], sums.right[2]];
        add_series::<V, 2>(&mut linear, &u, &v, right_back, 1);
        let mut rest = sums.right;
        add_series::<V, 5>(&mut rest, &u, &v, right, 0b10);
        (rest[1], rest[2]) = (linear[1], linear[2]);
        sums.right = rest;
    }
    sums
}

/// Adds `start` times all monomials below degree `D` to `sums`, but of the degrees whose bit is set in `without`.
#[inline(always)]
fn add_series<V: Vector, const D: usize>(
    sums: &mut [V],
    u: &[V; ROWS],
    v: &[V; ROWS],
    start: [V; ROWS],
    without: u32,
) {
    let mut monomials = [[V::zero(); ROWS]; 9];
    monomials[0] = start;
    for degree in 0..D {
        if degree > 0 {
            // The last is a power of v, the others have one u more than those before.
            monomials[degree] = product(&monomials[degree - 1], v);
            for monomial in &mut monomials[..degree] {
                *monomial = product(monomial, u);
            }
        }
        if without & 1 << degree == 0 {
            for (sum, &[a, b, c, d]) in sums[first_of(degree)..].iter_mut().zip(&monomials[..=degree]) {
                *sum = *sum + ((a + b) + (c + d));
            }
        }
    }
}

#[inline(always)]
fn product<V: Vector>(a: &[V; ROWS], b: &[V; ROWS]) -> [V; ROWS] {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]]
}

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

/// The square of what the polynomial leaves of the height of a point; 0 in lanes that do not have it.
#[inline(always)]
fn squared_residual<V: Vector<Scalar = f64>>(
    heights: &Heights<'_, V>,
    setting: &Setting<V>,
    c: &[V; TERMS],
    row: usize,
) -> V {
    let (u, v) = (heights.u[row], heights.v[row]);
    let (uu, uv, vv) = (u * u, u * v, v * v);
    let second = c[3] * uu + c[4] * uv + c[5] * vv;
    let third = (c[6] * uu + c[7] * uv + c[8] * vv) * u + c[9] * vv * v;
    let fourth = (c[10] * uu + c[11] * uv + c[12] * vv) * uu + (c[13] * uv + c[14] * vv) * vv;
    let first = (c[1] * u + c[2] * v) * heights.back[row];
    let left = heights.w[row] - (c[0] + first + second + third + fourth);
    V::select(V::constant(row as f64).lt(setting.count), left * left, V::zero())
}

impl<V: Vector<Scalar = f64>> Coefficients<V> {
    /// What the data tell of each prior size: for degrees 2 to 4, `Σ c²/binom`, and how many coefficients the prior decides,
    /// in units of `τ²`.
    pub fn shares(&self) -> [(V, V); 3] {
        [2, 3, 4].map(|degree| {
            let (mut squares, mut variances) = (V::zero(), V::zero());
            let terms = first_of(degree)..first_of(degree + 1);
            for ((&c, &variance), binomial) in
                self.c[terms.clone()].iter().zip(&self.variances[terms.clone()]).zip(&BINOMIALS[terms])
            {
                let inverse = V::constant(1.0 / binomial);
                squares = squares + c * c * inverse;
                variances = variances + variance * inverse;
            }
            (squares, variances)
        })
    }

    /// How many of the coefficients the data decide.
    #[inline(always)]
    pub fn freedom(&self) -> V {
        let mut freedom = V::constant(TERMS as f64);
        for term in 1..TERMS {
            freedom = freedom - self.prior[term] * self.variances[term];
        }
        freedom
    }

    /// The logarithm of the evidence, but for constants that are the same for all models.
    pub fn log_evidence(&self, heights: &Heights<'_, V>, setting: &Setting<V>) -> [f64; MAX_LANES] {
        let mut logarithms = [0.0; MAX_LANES];
        let mut add = |x: V, factor: f64| {
            for (sum, x) in logarithms.iter_mut().zip(x.to_lanes()).take(V::LANES) {
                *sum += factor * libm::log(x);
            }
        };
        for term in 0..TERMS {
            add(self.inverse_pivots[term], 1.0);
            if term > 0 {
                add(self.prior[term], 0.5);
            }
        }
        let mut squares = V::zero();
        for row in 0..heights.len() {
            let counts = V::zero().lt(heights.weight[row]);
            add(V::select(counts, heights.weight[row], V::one()), 0.5);
            squares = squares + heights.weight[row] * heights.w[row] * heights.w[row];
        }
        let [p, q] = setting.slopes;
        squares = squares + (p * p + q * q) * self.prior[1];
        let rest = ((squares - self.explained) * V::constant(-0.5)).to_lanes();
        std::array::from_fn(|lane| logarithms[lane] + rest[lane])
    }
}

/// The sum of squares that a plain polynomial of `K` coefficients leaves of the points within so many rings, and by how many there
/// are more of these than coefficients; 0 where they do not determine it.
#[inline(always)]
fn plain_residual<V: Vector<Scalar = f64>, const K: usize>(
    patch: &Patch<'_, V>,
    heights: &Heights<'_, V>,
    rings: usize,
    scratch: &mut [V],
) -> (V, V) {
    let length = patch.len_within(rings) + 1;
    let rows = length.max(K);
    let columns = &mut scratch[..(K + 1) * rows];
    for row in 0..rows {
        // Points that a lane does not have, or not within these rings, make rows of zeros.
        let weight = match row {
            0 => V::one(),
            row if row < length => patch.weight_within(rings, row - 1),
            _ => V::zero(),
        };
        let (mut u, mut v, mut w) = (V::zero(), V::zero(), V::zero());
        if row < length {
            let back = heights.back[row];
            (u, v, w) = (heights.u[row] * back, heights.v[row] * back, heights.w[row]);
        }
        let mut terms = [weight; K];
        let (mut first, mut length) = (0, 1);
        while first + length < K {
            let next = first + length;
            for term in 0..length {
                terms[next + term] = terms[first + term] * u;
            }
            terms[next + length] = terms[next - 1] * v;
            (first, length) = (next, length + 1);
        }
        for (column, term) in terms.into_iter().enumerate() {
            columns[column * rows + row] = term;
        }
        columns[K * rows + row] = w * weight;
    }
    let solution = least_squares::solve::<V, K>(columns, rows);
    let freedom = (patch.count_within(rings) + V::constant(1.0 - K as f64)).max(V::zero());
    (solution.residual_squared, V::select(solution.trusted, freedom, V::zero()))
}

/// What three plain jets (degree 4 and 3 over two rings, 4 over three) leave of the points, each with the number of points more than
/// coefficients.
#[inline(always)]
pub(super) fn plain_residuals<V: Vector<Scalar = f64>>(
    patch: &Patch<'_, V>,
    heights: &Heights<'_, V>,
    scratch: &mut [V],
) -> [(V, V); 3] {
    [
        plain_residual::<V, 15>(patch, heights, 2, scratch),
        plain_residual::<V, 10>(patch, heights, 2, scratch),
        plain_residual::<V, 15>(patch, heights, 3, scratch),
    ]
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
            V::from_lanes(&std::array::from_fn(|lane| number(*vertices.get(lane).unwrap_or(&vertices[0]) as usize)))
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
        let sizes_squared = model.sizes.map(|size| {
            factor = factor * graded;
            let size = (V::constant(size) * factor).max(V::constant(1e-100)).min(V::constant(1e100));
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
        surface.shape = surface.shape.map(|x| x * unit);
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
