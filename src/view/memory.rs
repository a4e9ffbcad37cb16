//! Large blocks straight from the allocator, in huge pages where the system has them.

use crate::error::{Error, reserved};
use std::alloc::{Layout, alloc, alloc_zeroed};

/// Numbers of which all bits zero is a value.
///
/// # Safety
/// All zero bytes are a valid value.
pub(crate) unsafe trait Zero: Copy {}
// SAFETY: numbers, and arrays of them.
unsafe impl Zero for u8 {}
// SAFETY: as above.
unsafe impl Zero for u16 {}
// SAFETY: as above.
unsafe impl Zero for u32 {}
// SAFETY: as above.
unsafe impl Zero for u64 {}
// SAFETY: as above.
unsafe impl Zero for f64 {}
// SAFETY: as above.
unsafe impl Zero for f32 {}
// SAFETY: as above.
unsafe impl<T: Zero, const N: usize> Zero for [T; N] {}

/// A vector of `count` zeros, or [`Error::OutOfMemory`].
///
/// The allocator hands out large blocks that the system has zeroed already, so their pages are touched once, when they
/// are used, and not twice.
pub(crate) fn zeroed<T: Zero>(count: usize) -> Result<Vec<T>, Error> {
    let layout = Layout::array::<T>(count).map_err(|_| Error::OutOfMemory)?;
    if layout.size() == 0 {
        return Ok(Vec::new());
    }
    // SAFETY: the layout has a size; a block of it holds `count` zeroed elements, which are valid, and belongs to the
    // global allocator as `Vec` expects.
    unsafe {
        let block = alloc_zeroed(layout).cast::<T>();
        if block.is_null() {
            return Err(Error::OutOfMemory);
        }
        use_huge_pages(block.cast(), layout.size());
        Ok(Vec::from_raw_parts(block, count, count))
    }
}

/// A box with `value` in it, or [`Error::OutOfMemory`].
pub(crate) fn boxed<T>(value: T) -> Result<Box<T>, Error> {
    const { assert!(size_of::<T>() > 0) };
    // SAFETY: the layout has a size; a block of it is as good as one of `Box::new`.
    unsafe {
        let block = alloc(Layout::new::<T>()).cast::<T>();
        if block.is_null() {
            return Err(Error::OutOfMemory);
        }
        block.write(value);
        Ok(Box::from_raw(block))
    }
}

/// An empty vector with room for `count` elements, or [`Error::OutOfMemory`].
pub(crate) fn room<T>(count: usize) -> Result<Vec<T>, Error> {
    let mut rows: Vec<T> = reserved(count)?;
    let spare = rows.spare_capacity_mut();
    // SAFETY: the vector's own block, which holds nothing yet.
    unsafe { use_huge_pages(spare.as_mut_ptr().cast(), size_of_val(spare)) };
    Ok(rows)
}

/// A vector of `count` copies of `value`, or [`Error::OutOfMemory`].
pub(crate) fn filled<T: Clone>(count: usize, value: T) -> Result<Vec<T>, Error> {
    let mut rows = room(count)?;
    rows.resize(count, value);
    Ok(rows)
}

/// Asks for huge pages in a large block that has not been touched yet: first touches cost more than a topology's whole
/// algorithm, and a huge page takes one where small ones take 512.
///
/// # Safety
/// The block is the caller's.
#[cfg(target_os = "linux")]
unsafe fn use_huge_pages(block: *mut u8, size: usize) {
    const HUGE_PAGE: usize = 2 << 20;
    let start = (block as usize).next_multiple_of(HUGE_PAGE);
    let end = (block as usize + size) / HUGE_PAGE * HUGE_PAGE;
    if end >= start + 2 * HUGE_PAGE {
        // SAFETY: whole pages of the caller's block; the advice changes no contents. If the system does not take it,
        // nothing is lost.
        unsafe { libc::madvise(start as *mut libc::c_void, end - start, libc::MADV_HUGEPAGE) };
    }
}

#[cfg(not(target_os = "linux"))]
unsafe fn use_huge_pages(_block: *mut u8, _size: usize) {}
