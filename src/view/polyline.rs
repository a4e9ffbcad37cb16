//! Points of polylines: `#V × 2` or `#V × 3` scalars at any byte stride.

use super::points::StridedPoints;
use crate::error::Error;

/// Borrowed points of a polyline, `#V × 2` or `#V × 3`, `f32` or `f64`, at any byte stride.
#[derive(Clone, Copy, Debug)]
pub struct PolylinePoints<'a>(PolylineArray<'a>);

/// Points by scalar type and dimension.
#[derive(Clone, Copy, Debug)]
pub(crate) enum PolylineArray<'a> {
    PlaneF32(StridedPoints<'a, f32, 2>),
    PlaneF64(StridedPoints<'a, f64, 2>),
    SpaceF32(StridedPoints<'a, f32, 3>),
    SpaceF64(StridedPoints<'a, f64, 3>),
}

/// What messages call the points and their start.
const NAMES: [&str; 2] = ["polyline", "polyline.data"];

macro_rules! each {
    ($self:ident, $points:ident => $body:expr) => {
        match &$self.0 {
            PolylineArray::PlaneF32($points) => $body,
            PolylineArray::PlaneF64($points) => $body,
            PolylineArray::SpaceF32($points) => $body,
            PolylineArray::SpaceF64($points) => $body,
        }
    };
}

impl<'a> PolylinePoints<'a> {
    /// Points of `dimension` coordinates, 2 or 3, that start at `data` and lie `stride` bytes apart (0: packed), in
    /// single precision.
    ///
    /// # Errors
    /// [`Error::UnknownConstant`] for another dimension; [`Error::NullPointer`], [`Error::Stride`],
    /// [`Error::Misaligned`] or [`Error::Size`] where the description cannot be right.
    ///
    /// # Safety
    /// For the life of the view, the `count` points must lie in memory that may be read and that nobody writes.
    /// `data` may be null or dangling when `count` is 0.
    pub unsafe fn from_raw_f32(data: *const f32, count: usize, stride: usize, dimension: u32) -> Result<Self, Error> {
        // SAFETY: handed on.
        unsafe {
            match dimension {
                2 => StridedPoints::new(NAMES, data, count, stride).map(PolylineArray::PlaneF32),
                3 => StridedPoints::new(NAMES, data, count, stride).map(PolylineArray::SpaceF32),
                other => Err(unknown(other)),
            }
        }
        .map(PolylinePoints)
    }

    /// As [`PolylinePoints::from_raw_f32`], in double precision.
    ///
    /// # Errors
    /// As [`PolylinePoints::from_raw_f32`].
    ///
    /// # Safety
    /// As [`PolylinePoints::from_raw_f32`].
    pub unsafe fn from_raw_f64(data: *const f64, count: usize, stride: usize, dimension: u32) -> Result<Self, Error> {
        // SAFETY: handed on.
        unsafe {
            match dimension {
                2 => StridedPoints::new(NAMES, data, count, stride).map(PolylineArray::PlaneF64),
                3 => StridedPoints::new(NAMES, data, count, stride).map(PolylineArray::SpaceF64),
                other => Err(unknown(other)),
            }
        }
        .map(PolylinePoints)
    }

    pub(crate) fn array(&self) -> &PolylineArray<'a> {
        &self.0
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        each!(self, points => points.len())
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number of coordinates of a point, 2 or 3.
    pub fn dimension(&self) -> u32 {
        match &self.0 {
            PolylineArray::PlaneF32(_) | PolylineArray::PlaneF64(_) => 2,
            PolylineArray::SpaceF32(_) | PolylineArray::SpaceF64(_) => 3,
        }
    }

    /// Finds the first point that is NaN or infinite.
    ///
    /// # Errors
    /// [`Error::NonFinitePosition`].
    pub(crate) fn check_finite(&self) -> Result<(), Error> {
        each!(self, points => points.check_finite())
    }
}

fn unknown(dimension: u32) -> Error {
    Error::UnknownConstant { what: "polyline.dimension", value: dimension as u64 }
}

macro_rules! from_slices {
    ($($variant:ident: $scalar:ty, $dimension:literal;)*) => {$(
        impl<'a> From<&'a [[$scalar; $dimension]]> for PolylinePoints<'a> {
            fn from(points: &'a [[$scalar; $dimension]]) -> Self {
                PolylinePoints(PolylineArray::$variant(StridedPoints::of_slice(points)))
            }
        }
    )*};
}
from_slices! { PlaneF32: f32, 2; PlaneF64: f64, 2; SpaceF32: f32, 3; SpaceF64: f64, 3; }
