//! Symmetric positive definite systems of a few unknowns, in lanes, by Cholesky's factorisation.
//!
//! `A = L Lᵀ`, column by column, each column at once taken off all that are to its right (Golub & Van Loan, "Matrix
//! Computations", algorithm 4.2.2): no sum waits for itself. Only the lower triangle is read and written. The error does not
//! depend on how rows and columns are scaled, so nothing is scaled.
//!
//! Degenerate rule: a lane in which a pivot is not positive is not [`Factored::definite`], and nothing that follows from it is
//! of use. Cost: `K³/6` multiplications and as many subtractions, `K` roots and divisions.

use crate::simd::{Mask, Vector};

/// The factor `L`, with the reciprocals of its diagonal.
pub(crate) struct Factored<'a, V: Vector, const K: usize> {
    lower: &'a [[V; K]; K],
    inverse: [V; K],
    /// Lanes whose matrix is positive definite, as far as rounding tells.
    pub definite: V::Mask,
}

/// Factors the lower triangle of `matrix` in place.
#[inline(always)]
pub(crate) fn factor<V: Vector, const K: usize>(matrix: &mut [[V; K]; K]) -> Factored<'_, V, K> {
    let mut inverse = [V::zero(); K];
    let mut definite = V::zero().lt(V::one());
    for k in 0..K {
        let pivot = matrix[k][k];
        // Not a number compares as false.
        let positive = V::zero().lt(pivot).and(pivot.lt(V::constant(f64::MAX)));
        definite = definite.and(positive);
        inverse[k] = V::one() / V::select(positive, pivot, V::one()).sqrt();
        for row in &mut matrix[k + 1..] {
            row[k] = row[k] * inverse[k];
        }
        for column in k + 1..K {
            let factor = matrix[column][k];
            for row in &mut matrix[column..] {
                row[column] = row[column] - row[k] * factor;
            }
        }
    }
    Factored { lower: matrix, inverse, definite }
}

impl<V: Vector, const K: usize> Factored<'_, V, K> {
    /// The solution of `A x = b`.
    #[inline(always)]
    pub fn solve(&self, mut b: [V; K]) -> [V; K] {
        for k in 0..K {
            b[k] = b[k] * self.inverse[k];
            for row in k + 1..K {
                b[row] = b[row] - self.lower[row][k] * b[k];
            }
        }
        for k in (0..K).rev() {
            b[k] = b[k] * self.inverse[k];
            for row in 0..k {
                b[row] = b[row] - self.lower[k][row] * b[k];
            }
        }
        b
    }

    /// The diagonal of the inverse of `A`. Costs `K³/6` multiplications.
    #[inline(always)]
    pub fn inverse_diagonal(&self) -> [V; K] {
        let mut diagonal = [V::zero(); K];
        for first in 0..K {
            // A column of the inverse of L; its square is in the inverse of A.
            let mut column = [V::zero(); K];
            column[first] = V::one();
            for k in first..K {
                column[k] = column[k] * self.inverse[k];
                diagonal[first] = diagonal[first] + column[k] * column[k];
                for row in k + 1..K {
                    column[row] = column[row] - self.lower[row][k] * column[k];
                }
            }
        }
        diagonal
    }

    /// The reciprocals of the factor's diagonal: the determinant of `A` is one over the square of their product.
    pub fn inverse_pivots(&self) -> &[V; K] {
        &self.inverse
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Random matrices `B Bᵀ` of very different scales, against products with the solution and with the inverse.
    #[test]
    fn systems_are_solved_and_inverted() {
        const K: usize = 6;
        let mut state = 7u64;
        let mut next = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        };
        for _ in 0..500 {
            let b: [[f64; K]; K] = std::array::from_fn(|_| std::array::from_fn(|_| next()));
            let scale: [f64; K] = std::array::from_fn(|_| 10f64.powf(8.0 * next()));
            let a: [[f64; K]; K] = std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    let product: f64 = (0..K).map(|k| b[i][k] * b[j][k]).sum();
                    (product + if i == j { 0.1 } else { 0.0 }) * scale[i] * scale[j]
                })
            });
            let mut lower = a;
            // What is above the diagonal is not looked at.
            (0..K).for_each(|i| lower[i][i + 1..].fill(f64::NAN));
            let factored = factor(&mut lower);
            assert!(factored.definite);
            let x: [f64; K] = std::array::from_fn(|k| next() / scale[k]);
            let right = std::array::from_fn(|i| (0..K).map(|j| a[i][j] * x[j]).sum());
            let found = factored.solve(right);
            for k in 0..K {
                assert!((found[k] - x[k]).abs() * scale[k] < 1e-11);
                let mut unit = [0.0; K];
                unit[k] = 1.0;
                let expected = factored.solve(unit)[k];
                assert!((factored.inverse_diagonal()[k] / expected - 1.0).abs() < 1e-12);
            }
        }
        for spoilt in [-1.0, 0.0, f64::NAN, f64::INFINITY] {
            let mut matrix = [[2.0, f64::NAN], [1.0, spoilt]];
            assert!(!factor(&mut matrix).definite);
        }
    }
}
