//! Views: the caller's memory, borrowed for one call and never copied whole.
//!
//! Everything is a pointer, a count and a byte stride, so a mesh library's own arrays, an interleaved vertex buffer or
//! a numpy array are read and written in place. This module, with `simd` and `capi`, is where `unsafe` lives: what
//! leaves it is checked once (alignment, strides, index ranges) and safe from then on. What the library asks of the system
//! itself (huge pages, threads, the number of cores) is here for the same reason.

mod batch;
mod bytes;
mod cores;
mod faces;
mod memory;
mod output;
mod points;
mod polyline;
mod ring_table;
mod rings;
mod rows;
mod scalars;
mod slots;
mod threads;

pub(crate) use batch::{Batch, Block, Group, Kept, Lanes};
pub use bytes::Bytes;
pub(crate) use cores::core_count;
pub use faces::{Faces, IndexArray, Indices};
pub(crate) use faces::{Index, with_indices};
pub(crate) use memory::{Zero, boxed, filled, room, zeroed};
pub use output::{Output, ScalarOutput, StatusOutput};
pub use points::Points;
pub(crate) use points::{Coordinate, PointArray, StridedPoints};
pub(crate) use polyline::PolylineArray;
pub use polyline::PolylinePoints;
pub(crate) use ring_table::{RingPart, RingTable};
pub(crate) use rings::{MAX_LANE_CORNERS, RingClass, Rings, WINDOW};
pub(crate) use rows::{gather_rows, scatter_rows};
pub use scalars::Scalars;
pub(crate) use slots::{BLOCK, Put, SLOTS, Slots, SlotsPart};
pub(crate) use threads::{for_each_part, is_quiet, set_quiet, with_threads};

use crate::error::Error;

/// The stride in bytes of an array of `components` scalars an element; 0 stands for a packed array.
///
/// Checks that a stride is a multiple of the scalar and holds an element, that the address is aligned, and that all
/// `count` elements lie within `isize::MAX` bytes.
fn checked_stride<S>(
    what: &'static str,
    address: usize,
    count: usize,
    stride: usize,
    components: usize,
) -> Result<usize, Error> {
    let scalar = size_of::<S>();
    let element = scalar * components;
    let stride = if stride == 0 { element } else { stride };
    if stride < element || !stride.is_multiple_of(scalar) {
        return Err(Error::Stride { what, stride });
    }
    if !address.is_multiple_of(scalar) {
        return Err(Error::Misaligned { what });
    }
    let limit = isize::MAX as usize / stride;
    if count > limit {
        return Err(Error::Size { what, found: count as u64, expected: limit as u64 });
    }
    Ok(stride)
}
