//! Polynomials of heights by normal equations, one step of refinement after them: where that is as good as reflections, at half their
//! cost and less.
//!
//! Normal equations square the condition `κ`: their solution is off by `κ² ε`. What it leaves of the heights is then computed point by
//! point, and the same equations give the correction for that, which is off by as large a part: `(κ² ε)²` remains, besides what no
//! method avoids (Björck 1987, "Stability analysis of the method of seminormal equations"). So up to [`WELL_CONDITIONED`] nothing is
//! lost against Householder reflections ([`solve`](super::least_squares::solve)), which are for the rest.
//!
//! Input: heights `z(x, y)`, the vertex itself among them at the origin. Degenerate rule: lanes whose condition is larger, or not known,
//! are not [`Polynomial::well_conditioned`], and what is said of them is of no use.
//! Cost: `(2d + 1)(d + 1)` and about `4 K` products a point for degree `d` and `K` coefficients, `K³/3` products besides.

use super::cholesky::factor_and_solve;
use super::moments::{ROWS, add, add_degrees, first_of, rows};
use crate::simd::{Mask, Vector};

/// The largest condition at which what refinement leaves, `(κ² ε)²`, is far below `κ ε`.
const WELL_CONDITIONED: f64 = 1e4;

/// A fitted polynomial.
pub(super) struct Polynomial<V: Vector, const K: usize> {
    /// The coefficients.
    pub coefficients: [V; K],
    /// The sum of the squares of what is left of the heights.
    pub residual_squared: V,
    /// As [`condition`](super::least_squares::condition) has it.
    pub condition: V,
    /// Lanes that have a result.
    pub well_conditioned: V::Mask,
}

/// The degree of a polynomial of `K` coefficients.
const fn degree(coefficients: usize) -> usize {
    let mut degree = 0;
    while first_of(degree + 1) < coefficients {
        degree += 1;
    }
    degree
}

/// Adds `start` times the monomials of the degrees from 1 to 4, or to twice the degree of `K` coefficients, to `sums`, as far as these go.
macro_rules! add_monomials {
    ($start:expr, $u:expr, $v:expr, $sums:expr, $count:expr) => {
        match $count {
            3 => add_degrees!($start, $u, $v, $sums, 2),
            6 => add_degrees!($start, $u, $v, $sums, 2 3),
            10 => add_degrees!($start, $u, $v, $sums, 2 3 4),
            15 => add_degrees!($start, $u, $v, $sums, 2 3 4 5),
            28 => add_degrees!($start, $u, $v, $sums, 2 3 4 5 6 7),
            _ => add_degrees!($start, $u, $v, $sums, 2 3 4 5 6 7 8 9),
        }
    };
}

/// Fits a polynomial of `K` coefficients to the points of three columns and the vertex itself. The lanes have the first `count` of
/// them, all at least `full`; the others are at the origin.
#[inline(always)]
pub(super) fn fit_polynomial<V: Vector<Scalar = f64>, const K: usize>(
    [x, y, z]: [&[V]; 3],
    count: V,
    full: usize,
) -> Polynomial<V, K> {
    assert!(x.len() == y.len() && y.len() == z.len() && x.len().is_multiple_of(ROWS));
    let mut moments = [V::zero(); first_of(9)];
    let mut right = [V::zero(); K];
    for first in (0..x.len()).step_by(ROWS) {
        let (u, v, heights) = (&rows(x, first), &rows(y, first), [rows(z, first)]);
        add_monomials!([[V::one(); ROWS]], u, v, &mut moments, first_of(2 * degree(K) + 1));
        add(&mut right, &heights);
        add_monomials!(heights, u, v, &mut right, K);
    }
    moments[0] = count + V::one();
    let mut matrix = [[V::zero(); K]; K];
    let mut lengths = [V::zero(); K];
    for row in 0..K {
        let d = degree(row + 1);
        for column in 0..=row {
            let e = degree(column + 1);
            matrix[row][column] = moments[first_of(d + e) + (row - first_of(d)) + (column - first_of(e))];
        }
        lengths[row] = matrix[row][row];
    }
    let (factored, mut coefficients) = factor_and_solve(&mut matrix, right);
    let mut squared = V::zero();
    for (length, variance) in lengths.into_iter().zip(factored.inverse_diagonal()) {
        squared = squared + length * variance;
    }
    let condition = (squared * V::constant(K as f64)).sqrt();

    // What the vertex itself leaves.
    let mut right = [V::zero(); K];
    right[0] = -coefficients[0];
    let mut residual_squared = coefficients[0] * coefficients[0];
    for first in (0..x.len()).step_by(ROWS) {
        let (u, v, mut left) = (&rows(x, first), &rows(y, first), rows(z, first));
        for row in 0..ROWS {
            left[row] = left[row] - value(&coefficients, u[row], v[row]);
            if first + row >= full {
                let there = V::constant((first + row) as f64).lt(count);
                left[row] = V::select(there, left[row], V::zero());
            }
            residual_squared = residual_squared + left[row] * left[row];
        }
        add(&mut right, &[left]);
        add_monomials!([left], u, v, &mut right, K);
    }
    let correction = factored.solve(right);
    for term in 0..K {
        coefficients[term] = coefficients[term] + correction[term];
        residual_squared = residual_squared - correction[term] * right[term];
    }
    let well_conditioned = factored.definite.and(condition.lt(V::constant(WELL_CONDITIONED)));
    Polynomial { coefficients, residual_squared: residual_squared.max(V::zero()), condition, well_conditioned }
}

/// The polynomial at a point.
#[inline(always)]
fn value<V: Vector, const K: usize>(coefficients: &[V; K], x: V, y: V) -> V {
    let most = degree(K);
    let mut value = V::zero();
    for of_y in (0..=most).rev() {
        let mut row = coefficients[first_of(most) + of_y];
        for degree in (of_y..most).rev() {
            row = row * x + coefficients[first_of(degree) + of_y];
        }
        value = if of_y == most { row } else { value * y + row };
    }
    value
}
