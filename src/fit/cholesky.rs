//! Symmetric positive definite systems of a few unknowns, in lanes, by Cholesky's factorisation without roots.
//!
//! `A = L D Lᵀ` with ones on the diagonal of `L`, each column at once taken off all that are to its right (Golub & Van Loan, "Matrix
//! Computations", 4.1.2 and 4.2.2), and off the right-hand side: no sum waits for itself, and the columns wait for one division each.
//! Only the lower triangle is read and written. The error does not depend on how rows and columns are scaled, so nothing is scaled.
//!
//! Degenerate rule: a lane in which a pivot is not positive is not [`Factored::definite`], and nothing that follows from it is
//! of use. Cost: `K³/6` multiplications and as many subtractions, `K` divisions.

use crate::simd::{Mask, Vector};

/// The factor `L`, and one over `D`.
pub(crate) struct Factored<'a, V: Vector, const K: usize> {
    /// Below its diagonal.
    lower: &'a [[V; K]; K],
    inverse: [V; K],
    /// Lanes whose matrix is positive definite, as far as rounding tells.
    pub definite: V::Mask,
}

/// Factors the lower triangle of `matrix` in place, and solves `A x = b`.
#[inline(always)]
pub(crate) fn factor_and_solve<V: Vector, const K: usize>(
    matrix: &mut [[V; K]; K],
    mut b: [V; K],
) -> (Factored<'_, V, K>, [V; K]) {
    let mut inverse = [V::zero(); K];
    let mut definite = V::zero().lt(V::one());
    for k in 0..K {
        let pivot = matrix[k][k];
        // Not a number compares as false.
        let positive = V::zero().lt(pivot).and(pivot.lt(V::constant(f64::MAX)));
        definite = definite.and(positive);
        inverse[k] = V::one() / V::select(positive, pivot, V::one());
        let column: [V; K] = column(matrix, k);
        for row in k + 1..K {
            let factor = column[row] * inverse[k];
            matrix[row][k] = factor;
            for (x, other) in matrix[row][k + 1..row + 1].iter_mut().zip(&column[k + 1..]) {
                *x = *x - factor * *other;
            }
            b[row] = b[row] - factor * b[k];
        }
    }
    let factored = Factored { lower: matrix, inverse, definite };
    let x = factored.solve_upper(b);
    (factored, x)
}

/// A column from the diagonal on.
#[inline(always)]
fn column<V: Vector, const K: usize>(matrix: &[[V; K]; K], k: usize) -> [V; K] {
    let mut column = [V::zero(); K];
    for (x, row) in column.iter_mut().zip(matrix).skip(k) {
        *x = row[k];
    }
    column
}

impl<V: Vector, const K: usize> Factored<'_, V, K> {
    /// The solution of `A x = b`.
    #[inline(always)]
    pub fn solve(&self, mut b: [V; K]) -> [V; K] {
        for k in 0..K {
            for row in k + 1..K {
                b[row] = b[row] - self.lower[row][k] * b[k];
            }
        }
        self.solve_upper(b)
    }

    /// The solution of `D Lᵀ x = b`.
    #[inline(always)]
    fn solve_upper(&self, mut b: [V; K]) -> [V; K] {
        for (x, inverse) in b.iter_mut().zip(self.inverse) {
            *x = *x * inverse;
        }
        for k in (1..K).rev() {
            for row in 0..k {
                b[row] = b[row] - self.lower[k][row] * b[k];
            }
        }
        b
    }

    /// The diagonal of the inverse of `A`. Costs `K³/6` multiplications.
    #[inline(always)]
    pub fn inverse_diagonal(&self) -> [V; K] {
        let mut diagonal = self.inverse;
        // Row after row, the inverse of L; below the diagonal.
        let mut rows = [[V::zero(); K]; K];
        for row in 1..K {
            let (above, rest) = rows.split_at_mut(row);
            let own = &mut rest[0];
            for (k, other) in above.iter().enumerate() {
                let factor = self.lower[row][k];
                for (x, other) in own[..k].iter_mut().zip(other) {
                    *x = *x - factor * *other;
                }
                own[k] = own[k] - factor;
            }
            for (sum, x) in diagonal.iter_mut().zip(&own[..row]) {
                *sum = *sum + *x * *x * self.inverse[row];
            }
        }
        diagonal
    }

    /// One over `D`: the determinant of `A` is one over their product.
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
            let x: [f64; K] = std::array::from_fn(|k| next() / scale[k]);
            let right = std::array::from_fn(|i| (0..K).map(|j| a[i][j] * x[j]).sum());
            let (factored, found) = factor_and_solve(&mut lower, right);
            assert!(factored.definite);
            assert_eq!(factored.solve(right), found);
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
            assert!(!factor_and_solve(&mut matrix, [0.0; 2]).0.definite);
        }
    }
}
