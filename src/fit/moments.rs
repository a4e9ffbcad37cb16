//! Sums of monomials of points, from which normal equations follow: a product of two monomials is a monomial.
//!
//! The monomials of a degree are `u^d`, `u^(d−1) v` … `v^d`, and those of all degrees stand one degree after the other. Each is made
//! from one of the degree below by one product. All is in a row without a loop: monomials are many, and stay in registers only where
//! each has a name. [`ROWS`] points are added up before their sum is, which halves what goes through memory.

use crate::simd::Vector;

/// Points are added up so many at a time.
pub(super) const ROWS: usize = 2;

/// Where the monomials of a degree start, if all are in a row.
pub(super) const fn first_of(degree: usize) -> usize {
    degree * (degree + 1) / 2
}

/// Something of [`ROWS`] points each: weighted monomials of one degree, `u^d` first.
pub(super) type Rows<V, const N: usize> = [[V; ROWS]; N];

/// Raises monomials to each of the next degrees, given by how many monomials they have, and adds these to the sums.
macro_rules! add_degrees {
    ($monomials:expr, $u:expr, $v:expr, $sums:expr, $($count:literal)*) => {{
        let monomials = $monomials;
        $(
            let monomials: $crate::fit::moments::Rows<_, $count> = $crate::fit::moments::raised(monomials, $u, $v);
            $crate::fit::moments::add($sums, &monomials);
        )*
        let _ = monomials;
    }};
}
pub(super) use add_degrees;

/// [`ROWS`] of a column from `first` on.
#[inline(always)]
pub(super) fn rows<V: Vector>(column: &[V], first: usize) -> [V; ROWS] {
    let mut rows = [V::zero(); ROWS];
    rows.copy_from_slice(&column[first..first + ROWS]);
    rows
}

/// The monomials of the next degree: the last is a power of `v`, the others have one `u` more than those before.
#[inline(always)]
pub(super) fn raised<V: Vector, const N: usize, const M: usize>(
    monomials: Rows<V, N>,
    u: &[V; ROWS],
    v: &[V; ROWS],
) -> Rows<V, M> {
    const { assert!(M == N + 1) };
    let mut next = [[V::zero(); ROWS]; M];
    for row in 0..ROWS {
        for term in 0..N {
            next[term][row] = monomials[term][row] * u[row];
        }
        next[N][row] = monomials[N - 1][row] * v[row];
    }
    next
}

#[inline(always)]
pub(super) fn times<V: Vector, const N: usize>(mut monomials: Rows<V, N>, factor: &[V; ROWS]) -> Rows<V, N> {
    for monomial in &mut monomials {
        for row in 0..ROWS {
            monomial[row] = monomial[row] * factor[row];
        }
    }
    monomials
}

/// Adds the monomials of a degree to their sums.
#[inline(always)]
pub(super) fn add<V: Vector, const N: usize>(sums: &mut [V], monomials: &Rows<V, N>) {
    let sums = &mut sums[first_of(N - 1)..][..N];
    for term in 0..N {
        let [a, b] = monomials[term];
        sums[term] = sums[term] + (a + b);
    }
}
