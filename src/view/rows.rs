//! Rows of four scalars, loaded and stored as lanes: a row a lane.

use crate::simd::{MAX_LANES, Vector};

/// The rows `indices[0..V::LANES]`, a row a lane.
///
/// # Panics
/// Where one of them is no row.
#[inline(always)]
pub(crate) fn gather_rows<V: Vector>(rows: &[[V::Scalar; 4]], indices: &[u32; MAX_LANES]) -> [V; 4] {
    check::<V>(rows.len(), indices);
    // SAFETY: all of them are rows, each of four scalars.
    unsafe { V::gather4::<true>(rows.as_ptr().cast(), size_of::<[V::Scalar; 4]>(), indices) }
}

/// Stores `values` to the rows `indices[0..V::LANES]`, a row a lane.
///
/// # Panics
/// As [`gather_rows`].
#[inline(always)]
pub(crate) fn scatter_rows<V: Vector>(rows: &mut [[V::Scalar; 4]], indices: &[u32; MAX_LANES], values: [V; 4]) {
    check::<V>(rows.len(), indices);
    // SAFETY: as above, and they are borrowed for writing.
    unsafe { V::scatter4::<true>(values, rows.as_mut_ptr().cast(), size_of::<[V::Scalar; 4]>(), indices) }
}

#[inline(always)]
fn check<V: Vector>(count: usize, indices: &[u32; MAX_LANES]) {
    let most = indices[..V::LANES].iter().fold(0, |most, &index| most.max(index)) as usize;
    assert!(most < count, "row {most} of {count}");
}
