//! What can go wrong, with the element that did.

use std::fmt;

/// Why a call was refused or given up. Nothing has been written, except after [`Error::Cancelled`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A required pointer is null.
    NullPointer {
        /// The argument or field.
        what: &'static str,
    },
    /// A struct's `struct_size` is smaller than the first published version of the struct, or beyond 4096.
    StructSize {
        /// The struct.
        what: &'static str,
        /// The size it claims.
        size: usize,
    },
    /// A field that is reserved, or that this version of the library does not know, is not zero.
    UnknownField {
        /// The struct.
        what: &'static str,
        /// The byte, counted from the start of the struct, that is not zero.
        byte: usize,
    },
    /// A constant that is none of those documented for its place.
    UnknownConstant {
        /// The field.
        what: &'static str,
        /// Its value.
        value: u64,
    },
    /// A byte stride that is smaller than one element, or no multiple of the scalar's size.
    Stride {
        /// The array.
        what: &'static str,
        /// The stride.
        stride: usize,
    },
    /// An array that does not start at a multiple of its scalar's size.
    Misaligned {
        /// The array.
        what: &'static str,
    },
    /// A count that does not fit the others, or whose bytes exceed the address space.
    Size {
        /// The count.
        what: &'static str,
        /// Its value.
        found: u64,
        /// What was expected.
        expected: u64,
    },
    /// Face offsets that do not start at 0, decrease, or end elsewhere than at the number of indices.
    Offsets {
        /// The first offending face.
        face: u64,
    },
    /// A vertex index that is negative or not below the number of vertices.
    IndexOutOfRange {
        /// Which array it stands in.
        what: &'static str,
        /// Its place in that array.
        position: u64,
        /// The index.
        index: i128,
        /// The number of vertices.
        vertex_count: u64,
    },
    /// An element that was asked for and does not exist.
    NoSuchElement {
        /// What kind of element.
        what: &'static str,
        /// Its index.
        index: u64,
        /// How many there are.
        count: u64,
    },
    /// A coordinate that is NaN or infinite.
    NonFinitePosition {
        /// The vertex.
        vertex: u64,
    },
    /// A given normal that is NaN or infinite.
    NonFiniteNormal {
        /// The vertex.
        vertex: u64,
    },
    /// A given direction that is NaN or infinite.
    NonFiniteDirection {
        /// Its index.
        index: u64,
    },
    /// A given scalar that is NaN or infinite.
    NonFiniteScalar {
        /// The array.
        what: &'static str,
        /// Its index.
        index: u64,
    },
    /// An output or an option that the method asked for does not have.
    NotApplicable {
        /// The output or option.
        what: &'static str,
    },
    /// An option outside its range.
    OptionOutOfRange {
        /// The option.
        what: &'static str,
    },
    /// More vertices, faces or corners than the topology's 32-bit tables can hold.
    TooLarge {
        /// What there is too much of.
        what: &'static str,
        /// How much there is.
        found: u64,
        /// The most there may be.
        limit: u64,
    },
    /// No memory for a buffer.
    OutOfMemory,
    /// The progress callback asked to stop; some outputs may have been written.
    Cancelled,
}

impl Error {
    /// The offending element: corner, face, vertex, byte or value, as the variant says.
    pub fn element(&self) -> Option<u64> {
        match *self {
            Error::UnknownField { byte, .. } => Some(byte as u64),
            Error::UnknownConstant { value, .. } => Some(value),
            Error::Offsets { face } => Some(face),
            Error::IndexOutOfRange { position, .. } => Some(position),
            Error::NoSuchElement { index, .. } => Some(index),
            Error::NonFinitePosition { vertex } | Error::NonFiniteNormal { vertex } => Some(vertex),
            Error::NonFiniteDirection { index } | Error::NonFiniteScalar { index, .. } => Some(index),
            _ => None,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Error::NullPointer { what } => write!(out, "{what} is null"),
            Error::StructSize { what, size } => {
                write!(out, "{what}.struct_size is {size}, less than the struct's first version or beyond 4096")
            }
            Error::UnknownField { what, byte } => {
                write!(
                    out,
                    "byte {byte} of {what}, reserved or unknown to this version, is not zero: is the struct initialised?"
                )
            }
            Error::UnknownConstant { what, value } => write!(out, "{what} is {value}, which is no known constant"),
            Error::Stride { what, stride } => {
                write!(
                    out,
                    "{what}: a stride of {stride} bytes is smaller than an element or no multiple of its scalar"
                )
            }
            Error::Misaligned { what } => write!(out, "{what} is not aligned to its scalar"),
            Error::Size { what, found, expected } => write!(out, "{what} is {found}, expected {expected}"),
            Error::Offsets { face } => {
                write!(out, "the offsets of face {face} do not run upwards from 0 to the number of indices")
            }
            Error::IndexOutOfRange { what, position, index, vertex_count } => {
                write!(out, "{what}[{position}] is {index}, but there are {vertex_count} vertices")
            }
            Error::NoSuchElement { what, index, count } => {
                write!(out, "there is no {what} {index}: there are {count}, counted from 0")
            }
            Error::NonFinitePosition { vertex } => write!(out, "the position of vertex {vertex} is not finite"),
            Error::NonFiniteNormal { vertex } => write!(out, "the normal given for vertex {vertex} is not finite"),
            Error::NonFiniteDirection { index } => write!(out, "direction {index} is not finite"),
            Error::NonFiniteScalar { what, index } => write!(out, "{what}[{index}] is not finite"),
            Error::NotApplicable { what } => write!(out, "{what} is nothing that the method has"),
            Error::OptionOutOfRange { what } => write!(out, "{what} is outside its range"),
            Error::TooLarge { what, found, limit } => write!(out, "{found} {what}: the limit is {limit}"),
            Error::OutOfMemory => write!(out, "out of memory"),
            Error::Cancelled => write!(out, "cancelled by the progress callback"),
        }
    }
}

impl std::error::Error for Error {}

impl From<std::collections::TryReserveError> for Error {
    fn from(_: std::collections::TryReserveError) -> Self {
        Error::OutOfMemory
    }
}

/// A vector of `count` copies of `value`, or [`Error::OutOfMemory`].
pub(crate) fn filled<T: Clone>(count: usize, value: T) -> Result<Vec<T>, Error> {
    let mut vector = Vec::new();
    vector.try_reserve_exact(count)?;
    vector.resize(count, value);
    Ok(vector)
}

/// An empty vector with room for `count` elements, or [`Error::OutOfMemory`].
pub(crate) fn reserved<T>(count: usize) -> Result<Vec<T>, Error> {
    let mut vector = Vec::new();
    vector.try_reserve_exact(count)?;
    Ok(vector)
}
