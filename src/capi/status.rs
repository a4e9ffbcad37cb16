//! Statuses, and the caller's error struct.

use crate::error::Error;
use libc::c_char;
use std::ffi::CStr;
use std::fmt::{self, Write};

/// What a call came to: 0 is success, 1 to 99 a mistake of the caller, 100 to 199 the surroundings, 900 and above the
/// library itself. Numbers are never reused.
pub type umb_status = i32;

/// Success.
pub const UMB_OK: umb_status = 0;
/// A required pointer is null.
pub const UMB_ERROR_NULL_POINTER: umb_status = 1;
/// A struct's `struct_size` is smaller than the struct's first version, or beyond 4096.
pub const UMB_ERROR_STRUCT_SIZE: umb_status = 2;
/// A field that this version of the library does not know, or a reserved one, is not zero.
pub const UMB_ERROR_UNKNOWN_FIELD: umb_status = 3;
/// A constant is none of those documented for its place.
pub const UMB_ERROR_UNKNOWN_CONSTANT: umb_status = 4;
/// A stride is smaller than an element, or no multiple of its scalar.
pub const UMB_ERROR_STRIDE: umb_status = 5;
/// An array does not start at a multiple of its scalar's size.
pub const UMB_ERROR_MISALIGNED: umb_status = 6;
/// A count does not fit the others, or its bytes exceed the address space.
pub const UMB_ERROR_SIZE: umb_status = 7;
/// Face offsets do not run upwards from 0 to the number of indices.
pub const UMB_ERROR_OFFSETS: umb_status = 8;
/// An index is negative, or not below the number of what it counts.
pub const UMB_ERROR_INDEX_OUT_OF_RANGE: umb_status = 9;
/// A coordinate, or one of a normal or direction given, is NaN or infinite.
pub const UMB_ERROR_NON_FINITE: umb_status = 10;
/// More vertices, faces or corners than 32-bit tables can hold.
pub const UMB_ERROR_TOO_LARGE: umb_status = 11;
/// An output is asked for, or an option set, that the method does not have.
pub const UMB_ERROR_NOT_APPLICABLE: umb_status = 12;
/// An option is outside its range.
pub const UMB_ERROR_OPTION_OUT_OF_RANGE: umb_status = 13;
/// No memory for a buffer.
pub const UMB_ERROR_OUT_OF_MEMORY: umb_status = 100;
/// The progress callback asked to stop.
pub const UMB_ERROR_CANCELLED: umb_status = 101;
/// A defect of the library, caught before it could reach the caller.
pub const UMB_ERROR_INTERNAL: umb_status = 900;

/// `umb_error.element` where no element is to blame.
pub const UMB_NO_ELEMENT: u64 = u64::MAX;

/// What went wrong, in the caller's memory. Written only when a call fails; may be null wherever it is taken.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_error {
    /// `sizeof(umb_error)`, set by the caller; 0 stands for the size of its first version. If it is smaller than that,
    /// nothing is written here; what a longer one has beyond the library's fields is left alone.
    pub struct_size: u32,
    /// The status that the call returned.
    pub status: umb_status,
    /// The offending corner, face, vertex, byte or value, as the message says; `UMB_NO_ELEMENT` if there is none.
    pub element: u64,
    /// What, where, and what was expected: UTF-8 with a closing NUL.
    pub message: [c_char; 240],
}

/// Why a call fails: what the library says, or that it broke.
pub(super) enum Failure {
    Error(Error),
    Panic(Box<dyn std::any::Any + Send>),
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Failure::Error(error)
    }
}

impl Failure {
    pub fn status(&self) -> umb_status {
        match self {
            Failure::Panic(_) => UMB_ERROR_INTERNAL,
            Failure::Error(error) => match error {
                Error::NullPointer { .. } => UMB_ERROR_NULL_POINTER,
                Error::StructSize { .. } => UMB_ERROR_STRUCT_SIZE,
                Error::UnknownField { .. } => UMB_ERROR_UNKNOWN_FIELD,
                Error::UnknownConstant { .. } => UMB_ERROR_UNKNOWN_CONSTANT,
                Error::Stride { .. } => UMB_ERROR_STRIDE,
                Error::Misaligned { .. } => UMB_ERROR_MISALIGNED,
                Error::Size { .. } => UMB_ERROR_SIZE,
                Error::Offsets { .. } => UMB_ERROR_OFFSETS,
                Error::IndexOutOfRange { .. } | Error::NoSuchElement { .. } => UMB_ERROR_INDEX_OUT_OF_RANGE,
                Error::NonFinitePosition { .. }
                | Error::NonFiniteNormal { .. }
                | Error::NonFiniteDirection { .. }
                | Error::NonFiniteScalar { .. } => UMB_ERROR_NON_FINITE,
                Error::NotApplicable { .. } => UMB_ERROR_NOT_APPLICABLE,
                Error::OptionOutOfRange { .. } => UMB_ERROR_OPTION_OUT_OF_RANGE,
                Error::TooLarge { .. } => UMB_ERROR_TOO_LARGE,
                Error::OutOfMemory => UMB_ERROR_OUT_OF_MEMORY,
                Error::Cancelled => UMB_ERROR_CANCELLED,
            },
        }
    }

    fn element(&self) -> u64 {
        match self {
            Failure::Error(error) => error.element().unwrap_or(UMB_NO_ELEMENT),
            Failure::Panic(_) => UMB_NO_ELEMENT,
        }
    }

    /// Fills the caller's struct, as far as its version goes.
    ///
    /// # Safety
    /// `error` is null, or points to a `umb_error` of the size it claims.
    pub unsafe fn report(&self, error: *mut umb_error) {
        if error.is_null() {
            return;
        }
        // SAFETY: at least the size field is there.
        let size = unsafe { (&raw const (*error).struct_size).read_unaligned() } as usize;
        if size != 0 && size < FIRST_ERROR_SIZE {
            return;
        }
        let mut message = Message { bytes: [0; 240], length: 0 };
        // A message that does not fit is cut, which is all that can go wrong here.
        let _ = match self {
            Failure::Error(error) => write!(message, "{error}"),
            Failure::Panic(payload) => {
                write!(message, "defect in umbilic, please report: {}", panic_text(&**payload))
            }
        };
        // SAFETY: the struct has all fields of the first version.
        unsafe {
            (&raw mut (*error).status).write_unaligned(self.status());
            (&raw mut (*error).element).write_unaligned(self.element());
            (&raw mut (*error).message).write_unaligned(message.bytes);
        }
    }
}

fn panic_text(payload: &(dyn std::any::Any + Send)) -> &str {
    let text = payload.downcast_ref::<&str>().copied();
    text.or_else(|| payload.downcast_ref::<String>().map(String::as_str)).unwrap_or("no description")
}

/// The size of the first version of [`umb_error`], whose fields are those that [`Failure::report`] writes.
const FIRST_ERROR_SIZE: usize = 256;
const _: () =
    assert!(size_of::<umb_error>() == FIRST_ERROR_SIZE, "a field beyond the first version is written by size");

/// A C string of fixed size, written without allocating.
struct Message {
    bytes: [c_char; 240],
    length: usize,
}

impl Write for Message {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for character in text.chars() {
            let mut buffer = [0; 4];
            let encoded = character.encode_utf8(&mut buffer).as_bytes();
            // Whole characters only, and room for the closing NUL.
            let Some(room) = self.bytes.get_mut(self.length..self.length + encoded.len() + 1) else {
                return Err(fmt::Error);
            };
            for (place, &byte) in room.iter_mut().zip(encoded) {
                *place = byte as c_char;
            }
            self.length += encoded.len();
        }
        Ok(())
    }
}

/// A short English description of a status, for any number. Never null; static.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub extern "C" fn umb_status_string(status: umb_status) -> *const c_char {
    let text: &CStr = match status {
        UMB_OK => c"success",
        UMB_ERROR_NULL_POINTER => c"a required pointer is null",
        UMB_ERROR_STRUCT_SIZE => c"a struct_size is not one of any version",
        UMB_ERROR_UNKNOWN_FIELD => c"a field unknown to this version is not zero",
        UMB_ERROR_UNKNOWN_CONSTANT => c"a constant is not known",
        UMB_ERROR_STRIDE => c"a stride does not fit its element",
        UMB_ERROR_MISALIGNED => c"an array is not aligned",
        UMB_ERROR_SIZE => c"a count does not fit",
        UMB_ERROR_OFFSETS => c"face offsets are not ascending",
        UMB_ERROR_INDEX_OUT_OF_RANGE => c"an index is out of range",
        UMB_ERROR_NON_FINITE => c"a number is not finite",
        UMB_ERROR_TOO_LARGE => c"the mesh is too large",
        UMB_ERROR_NOT_APPLICABLE => c"the method does not have what is asked for",
        UMB_ERROR_OPTION_OUT_OF_RANGE => c"an option is out of range",
        UMB_ERROR_OUT_OF_MEMORY => c"out of memory",
        UMB_ERROR_CANCELLED => c"cancelled",
        UMB_ERROR_INTERNAL => c"internal error",
        _ => c"unknown status",
    };
    text.as_ptr()
}
