//! Structs that grow from version to version, and pointers that may not be null.

use crate::error::Error;

/// A struct that starts with its size and of which all zeros are valid, and mean the defaults.
///
/// # Safety
/// `repr(C)`, a `u32` called `struct_size` first, no padding, and valid for any bytes.
pub(super) unsafe trait Versioned: Copy {
    /// Its name.
    const NAME: &'static str;
    /// The size of its first version.
    const FIRST_SIZE: usize;
}

/// No version of any struct is larger; a size beyond it is not worth reading the tail for.
pub(super) const LARGEST_STRUCT: usize = 4096;

/// Reads a struct of any version, past or to come: fields that the caller's version lacks are zero, and fields that it
/// has and this one lacks must be. A size of 0 stands for the first version; null for all zeros.
///
/// # Errors
/// [`Error::StructSize`], [`Error::UnknownField`].
///
/// # Safety
/// `pointer` is null, or points to as many readable bytes as the size at their start says.
pub(super) unsafe fn read_versioned<T: Versioned>(pointer: *const T) -> Result<T, Error> {
    // SAFETY: `Versioned` types are valid for zeros.
    let mut value: T = unsafe { std::mem::zeroed() };
    if pointer.is_null() {
        return Ok(value);
    }
    let bytes: *const u8 = pointer.cast();
    // SAFETY: the size field is there.
    let size = match unsafe { bytes.cast::<u32>().read_unaligned() } as usize {
        0 => T::FIRST_SIZE,
        size => size,
    };
    if !(T::FIRST_SIZE..=LARGEST_STRUCT).contains(&size) {
        return Err(Error::StructSize { what: T::NAME, size });
    }
    let known = size_of::<T>();
    for byte in known..size {
        // SAFETY: below the size that the caller vouches for.
        if unsafe { bytes.add(byte).read() } != 0 {
            return Err(Error::UnknownField { what: T::NAME, byte });
        }
    }
    // SAFETY: both have that many bytes, and any bytes are a valid `T`.
    unsafe { std::ptr::copy_nonoverlapping(bytes, (&raw mut value).cast::<u8>(), size.min(known)) };
    Ok(value)
}

/// Writes a struct of any version: as many of its fields as the caller's size says, which stays as it is, and zeros for fields that
/// this version does not know. `value` is asked for
/// once the pointer and the size are good.
///
/// # Errors
/// [`Error::NullPointer`], [`Error::StructSize`], and those of `value`.
///
/// # Safety
/// `pointer` is null, or points to as many readable and writable bytes as the size at their start says.
pub(super) unsafe fn write_versioned<T: Versioned>(
    pointer: *mut T,
    what: &'static str,
    value: impl FnOnce() -> Result<T, Error>,
) -> Result<(), Error> {
    // SAFETY: the size field is there if the pointer is not null.
    let size = match unsafe { read_required(pointer.cast::<u32>().cast_const(), what) }? as usize {
        0 => T::FIRST_SIZE,
        size => size,
    };
    if !(T::FIRST_SIZE..=LARGEST_STRUCT).contains(&size) {
        return Err(Error::StructSize { what: T::NAME, size });
    }
    let value = value()?;
    let (from, to) = ((&raw const value).cast::<u8>(), pointer.cast::<u8>());
    // SAFETY: both have that many bytes, and a `T` starts with its size.
    unsafe {
        let known = size.min(size_of::<T>());
        std::ptr::copy_nonoverlapping(from.add(4), to.add(4), known - 4);
        std::ptr::write_bytes(to.add(known), 0, size - known);
    }
    Ok(())
}

/// A versioned struct that may not be null.
///
/// # Safety
/// As [`read_versioned`].
pub(super) unsafe fn required<T: Versioned>(pointer: *const T, what: &'static str) -> Result<T, Error> {
    if pointer.is_null() {
        return Err(Error::NullPointer { what });
    }
    // SAFETY: handed on.
    unsafe { read_versioned(pointer) }
}

/// Refuses a reserved field that is not zero.
pub(super) fn check_reserved(what: &'static str, offset: usize, value: u32) -> Result<(), Error> {
    if value == 0 { Ok(()) } else { Err(Error::UnknownField { what, byte: offset }) }
}

/// The value behind a pointer.
///
/// # Safety
/// `pointer` is null, or points to a readable `T`, aligned or not.
pub(super) unsafe fn read_required<T: Copy>(pointer: *const T, what: &'static str) -> Result<T, Error> {
    if pointer.is_null() {
        return Err(Error::NullPointer { what });
    }
    // SAFETY: not null, so readable.
    Ok(unsafe { pointer.read_unaligned() })
}
