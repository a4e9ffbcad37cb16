//! Linear least squares over lanes, by Householder reflections.
//!
//! Finds the `K` unknowns that minimise `|A u − b|²`, each lane its own. Reference: Golub & Van Loan, "Matrix
//! Computations", 5.2.1 and 5.3.2. Normal equations would cost half and square the condition.
//!
//! `A` and `b` stand column after column in one slice, sized by the actual number of rows. Rows of zeros change nothing: not
//! the solution, and not a bit of it, since they add exact zeros to every sum. So lanes with fewer rows are filled up with
//! them.
//!
//! **Scaling.** Reflections do not mix columns, so the result is the same whether columns are scaled to equal length first or
//! not, and so they are not. What is said about the condition is about the scaled matrix, `A D` with columns of length 1:
//! `R_kk` relative to the length of column `k`, which is that of `R`'s column.
//!
//! Degenerate rule: a lane whose matrix has not full rank, to [`DEPENDENT`], is not trusted, and its solution is of no use.
//!
//! Cost: `2 K² (m − K/3)` multiplications and as many additions for `m` rows; a root and a division a column. Dot products and
//! updates take four columns at a time, so that no sum waits for itself.

use crate::simd::{Mask, Vector};

/// A column of which no more than this part is independent of those before it counts as dependent on them: its coefficient
/// would carry the rounding of single-precision positions magnified into plain sight.
pub(crate) const DEPENDENT: f64 = 1.0 / (1 << 16) as f64;

/// What [`solve`] finds.
pub(crate) struct Solution<V: Vector, const K: usize> {
    /// The unknowns.
    pub unknowns: [V; K],
    /// `|A u − b|²`
    pub residual_squared: V,
    /// Lanes whose matrix has full rank.
    pub trusted: V::Mask,
    /// `1 / R_kk`
    inverse: [V; K],
    /// The squared lengths of the columns.
    lengths: [V; K],
}

/// Solves `A u = b` in the sense of least squares, for the `K` columns of `A` and the column `b` after them, each of `rows`
/// rows. What is left in `columns` is the factorisation that [`condition`] asks for.
///
/// # Panics
/// Where `columns` has not `(K + 1) rows` numbers, or there are fewer rows than unknowns.
#[inline(always)]
pub(crate) fn solve<V: Vector<Scalar = f64>, const K: usize>(columns: &mut [V], rows: usize) -> Solution<V, K> {
    assert!(columns.len() == (K + 1) * rows && rows >= K);
    let mut inverse = [V::zero(); K];
    let mut lengths = [V::zero(); K];
    // What is independent of the columns before it, less the least that must be; and what was divided by.
    let mut independent = V::constant(f64::INFINITY);
    let mut least_factor = V::constant(f64::INFINITY);
    let mut squared = V::zero();
    for x in &columns[..rows] {
        squared = squared + *x * *x;
    }
    for k in 0..K {
        let (head, tail) = columns.split_at_mut((k + 1) * rows);
        let (above, pivot) = head[k * rows..].split_at_mut(k);
        // The reflection takes the pivot column to (∓length, 0 … 0): to the side where nothing cancels. One division serves
        // for the reflection and for the back substitution.
        let length = squared.sqrt();
        let negative = pivot[0].lt(V::zero());
        let first = pivot[0] + V::select(negative, -length, length);
        let factor = (length * first.abs()).reciprocal_or_zero();
        inverse[k] = -(factor * first);
        least_factor = factor.min(least_factor);
        lengths[k] = squared;
        for x in above.iter() {
            lengths[k] = lengths[k] + *x * *x;
        }
        independent = (squared - lengths[k] * V::constant(DEPENDENT * DEPENDENT)).min(independent);
        pivot[0] = first;
        let pivot = &pivot[..];
        // The next pivot column is the first of the rest, and its length below the pivot is added up on the way.
        let mut rest = tail;
        let mut left = K - k;
        squared = V::zero();
        let mut is_next = true;
        while left > 0 {
            let taken = left.min(4);
            let (some, others) = rest.split_at_mut(taken * rows);
            let next = match taken {
                4 => reflect::<V, 4>(pivot, factor, some, rows, k),
                3 => reflect::<V, 3>(pivot, factor, some, rows, k),
                2 => reflect::<V, 2>(pivot, factor, some, rows, k),
                _ => reflect::<V, 1>(pivot, factor, some, rows, k),
            };
            if is_next {
                squared = next;
                is_next = false;
            }
            (rest, left) = (others, left - taken);
        }
    }

    let mut unknowns = [V::zero(); K];
    for k in (0..K).rev() {
        let mut sum = columns[K * rows + k];
        for later in k + 1..K {
            sum = sum - columns[later * rows + k] * unknowns[later];
        }
        unknowns[k] = sum * inverse[k];
    }
    // Where anything is NaN, so is a column's length, and the factor made from it is 0.
    let trusted = V::zero().lt(independent).and(V::zero().lt(least_factor));
    // The last column that was added up below its pivot is `b`.
    Solution { unknowns, residual_squared: squared, trusted, inverse, lengths }
}

/// The condition number of the scaled matrix in the Frobenius norm, `‖R D‖ ‖(R D)⁻¹‖` with `D` such that the columns of `R D`
/// have length 1; of no meaning in lanes that are not trusted. `columns` is what [`solve`] left. Costs `K³/6` multiplications.
#[inline(always)]
pub(crate) fn condition<V: Vector<Scalar = f64>, const K: usize>(
    columns: &[V],
    rows: usize,
    solution: &Solution<V, K>,
) -> V {
    let mut squared = V::zero();
    for column in 0..K {
        let mut x = [V::zero(); K];
        x[column] = solution.inverse[column];
        squared = squared + solution.lengths[column] * x[column] * x[column];
        for row in (0..column).rev() {
            let mut sum = V::zero();
            for later in row + 1..=column {
                sum = sum + columns[later * rows + row] * x[later];
            }
            x[row] = -(sum * solution.inverse[row]);
            squared = squared + solution.lengths[row] * x[row] * x[row];
        }
    }
    (squared * V::constant(K as f64)).sqrt()
}

/// The first columns of `rows` numbers from row `k` on. Called, since the library's array functions are; it does no arithmetic.
#[inline(never)]
fn tails<V, const C: usize>(columns: &mut [V], rows: usize, k: usize) -> [&mut [V]; C] {
    let mut parts = columns.chunks_exact_mut(rows);
    std::array::from_fn(|_| parts.next().map_or(&mut [][..], |column| &mut column[k..]))
}

/// Applies the reflection `I − factor v vᵀ`, of which `pivot` is `v` without its leading zeros, to `C` columns; answers with
/// the sum of squares of the first below row `k`.
#[inline(always)]
fn reflect<V: Vector<Scalar = f64>, const C: usize>(
    pivot: &[V],
    factor: V,
    columns: &mut [V],
    rows: usize,
    k: usize,
) -> V {
    let length = pivot.len();
    let columns: [&mut [V]; C] = tails(columns, rows, k);
    for column in &columns {
        // So that no access below needs to be checked.
        assert!(column.len() == length && length > 0);
    }
    let mut sums = [V::zero(); C];
    for row in 0..length {
        for c in 0..C {
            sums[c] = sums[c] + pivot[row] * columns[c][row];
        }
    }
    for c in 0..C {
        sums[c] = sums[c] * factor;
        columns[c][0] = columns[c][0] - sums[c] * pivot[0];
    }
    let mut squared = V::zero();
    for row in 1..length {
        for c in 0..C {
            columns[c][row] = columns[c][row] - sums[c] * pivot[row];
        }
        squared = squared + columns[0][row] * columns[0][row];
    }
    squared
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }
    }

    fn product(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    /// The residual of the solution is perpendicular to every column, as long as is said, and the unknowns are those that the
    /// right-hand side was made from; whatever the columns' units.
    fn check<const K: usize>(rows: usize, next: &mut impl FnMut() -> f64) {
        let units: Vec<f64> = (0..K).map(|_| 10f64.powf(30.0 * next())).collect();
        let matrix: Vec<f64> = (0..K * rows).map(|i| next() * units[i / rows]).collect();
        let known: Vec<f64> = (0..K).map(|k| next() / units[k]).collect();
        let noise: Vec<f64> = (0..rows).map(|_| 0.1 * next()).collect();
        for noisy in [false, true] {
            let right: Vec<f64> = (0..rows)
                .map(|row| {
                    let exact: f64 = (0..K).map(|k| matrix[k * rows + row] * known[k]).sum();
                    exact + if noisy { noise[row] } else { 0.0 }
                })
                .collect();
            let mut columns = [&matrix[..], &right[..]].concat();
            let found = solve::<f64, K>(&mut columns, rows);
            assert!(found.trusted);
            let condition = condition(&columns, rows, &found);
            assert!(condition >= K as f64 * 0.999, "{condition}");
            let left: Vec<f64> = (0..rows)
                .map(|row| right[row] - (0..K).map(|k| matrix[k * rows + row] * found.unknowns[k]).sum::<f64>())
                .collect();
            for k in 0..K {
                let column = &matrix[k * rows..(k + 1) * rows];
                assert!(product(column, &left).abs() <= 1e-14 * condition * units[k] * rows as f64);
                if !noisy {
                    let error = (found.unknowns[k] - known[k]) * units[k];
                    assert!(error.abs() < 1e-14 * condition, "{K} of {rows}: {error:e}, {condition}");
                }
            }
            let expected = product(&left, &left);
            assert!((found.residual_squared - expected).abs() < 1e-12 * expected + 1e-26 * condition);
            // More rows of zeros change no bit.
            let padded: Vec<f64> = [&matrix[..], &right[..]]
                .concat()
                .chunks(rows)
                .flat_map(|column| [column, &[0.0; 5][..]].concat())
                .collect();
            let mut padded = padded;
            let again = solve::<f64, K>(&mut padded, rows + 5);
            assert!(again.trusted);
            assert_eq!(again.unknowns, found.unknowns);
            assert_eq!(again.residual_squared, found.residual_squared);
        }
    }

    #[test]
    fn solutions_are_those_of_least_squares() {
        let mut next = random(1);
        for round in 0..200 {
            check::<3>(3 + round % 40 + 1, &mut next);
            check::<6>(6 + round % 40 + 2, &mut next);
            check::<10>(10 + round % 60 + 3, &mut next);
            check::<15>(15 + round % 240 + 4, &mut next);
        }
    }

    #[test]
    fn dependent_columns_are_not_trusted() {
        let mut next = random(2);
        for dependence in [0.0, 1e-300, 1e-160, 1e-16, 1e-7, 1e-6] {
            let mut columns: Vec<f64> = (0..7 * 12).map(|_| next()).collect();
            for row in 0..12 {
                columns[5 * 12 + row] = 3.0 * columns[12 + row] - columns[2 * 12 + row] + dependence * next();
            }
            assert!(!solve::<f64, 6>(&mut columns, 12).trusted, "{dependence:e}");
        }
        for scale in [0.0, f64::NAN, f64::INFINITY] {
            let mut columns: Vec<f64> = (0..7 * 12).map(|_| next()).collect();
            columns[30] *= scale;
            assert_eq!(solve::<f64, 6>(&mut columns, 12).trusted, scale == 0.0);
            columns.iter_mut().for_each(|x| *x *= scale);
            assert!(!solve::<f64, 6>(&mut columns, 12).trusted);
        }
        // Too few rows, filled up with zeros.
        let mut columns: Vec<f64> = (0..7 * 12).map(|i| if i % 12 < 5 { next() } else { 0.0 }).collect();
        assert!(!solve::<f64, 6>(&mut columns, 12).trusted);
    }
}
