//! The points of a neighbourhood as heights over a tangent plane, for adaptive jets, and with what weight they count.
//!
//! Lengths are in units of the vertex's mean edge length. The plane is that of a ridge quadric over two rings around the one-ring
//! normal (Max), unless that turns the normal by more than 37°. [`weigh`] goes over to the coordinates of the fit and sets the variance
//! `σ² + τ₅² ρ¹⁰` with which each point counts; [`plain_residuals`] says what jets without weights leave of the heights, which is
//! how noise is measured.
//!
//! Degenerate rule: a point so far away that its powers would leave the range, and one whose coordinates have left it, counts for
//! nothing; a point right above the vertex has no direction, and stays there. Cost: two passes over the points, a root and a
//! division each.

use super::adaptive_model::Coordinates;
use super::axes::Axes;
use super::cholesky::factor_and_solve;
use super::least_squares;
use super::moments::ROWS;
use super::ridge::{Setting, TERMS};
use crate::simd::{Mask, Vector, Vector3};
use crate::sweep::Patch;

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
    pub back: &'s mut [V],
    /// The variance with which the point counts; before [`weigh`], that of its noise.
    pub variance: &'s mut [V],
    /// One over the variance, or less for a point that is off.
    pub weight: &'s mut [V],
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
    pub fn len(&self) -> usize {
        self.u.len()
    }
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
        let within = patch.weight_within(2, index);
        let Vector3 { x: u, y: v, z: w } = start.components(patch.point(index)) * unit;
        let [u, v, w] = where_counted(within, [u, v, w]);
        let weight = within / (V::one() + u * u + v * v);
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
    let (factored, [_, p, q, ..]) = factor_and_solve(&mut matrix, right);
    let normal = start.vector(-p, -q, V::one());
    let normal = normal * (V::one() / normal.squared().sqrt());
    let turned = factored.definite.and(V::constant(MOST_TURN).lt(normal.dot(patch.normal)));
    Axes::about(Vector3 {
        x: V::select(turned, normal.x, patch.normal.x),
        y: V::select(turned, normal.y, patch.normal.y),
        z: V::select(turned, normal.z, patch.normal.z),
    })
}

/// A point in the lanes where its weight is not 0, and zeros elsewhere: there a point of a further ring may stand, whose coordinates may have left the
/// range, and infinity times 0 is no number. Which lanes look at such depends on their neighbours.
#[inline(always)]
fn where_counted<V: Vector>(weight: V, point: [V; 3]) -> [V; 3] {
    let zero = V::zero();
    let counted = zero.lt(weight);
    let [u, v, w] = point;
    [V::select(counted, u, zero), V::select(counted, v, zero), V::select(counted, w, zero)]
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
        let zero = V::zero();
        let (u, v, w) = (V::select(near, u, zero), V::select(near, v, zero), V::select(near, w, zero));
        (heights.u[row], heights.v[row], heights.w[row]) = (u, v, w);
        let flat = u * u + v * v;
        let there = V::constant(row as f64).lt(setting.count).and(near);
        let noise = heights.variance[row].max(least);
        let variance = |squared: V| {
            let fourth = squared * squared;
            let variance = noise + setting.sizes_squared[3] * (fourth * fourth * squared);
            variance.min(V::constant(1e200))
        };
        match setting.coordinates {
            Coordinates::Height => {
                let variance = variance(flat);
                heights.variance[row] = variance;
                heights.weight[row] = V::select(there, V::one() / variance, V::zero());
            }
            Coordinates::Circle => {
                let squared = flat + w * w;
                let directed = V::constant(NO_DIRECTION).lt(flat);
                let variance = variance(squared);
                let (flat, squared) = (V::select(directed, flat, V::one()), V::select(directed, squared, V::one()));
                // One root and one division for both factors and the weight.
                let product = (flat * squared).sqrt();
                let inverse = V::one() / (product * variance);
                let inverse_product = inverse * variance;
                let (back, forth) = (flat * inverse_product, squared * inverse_product);
                (heights.u[row], heights.v[row], heights.back[row]) = (u * forth, v * forth, back);
                heights.variance[row] = variance;
                heights.weight[row] = V::select(there, inverse * product, V::zero());
            }
        }
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
            let point = [heights.u[row] * back, heights.v[row] * back, heights.w[row]];
            [u, v, w] = where_counted(weight, point);
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
