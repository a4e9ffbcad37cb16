//! Scalars to read: one number an element, at any byte stride.

use super::points::StridedPoints;
use crate::error::Error;

/// Borrowed scalars, `f32` or `f64`, at any byte stride: curvatures, say.
#[derive(Clone, Copy, Debug)]
pub struct Scalars<'a>(ScalarArray<'a>);

/// Scalars by type.
#[derive(Clone, Copy, Debug)]
enum ScalarArray<'a> {
    F32(StridedPoints<'a, f32, 1>),
    F64(StridedPoints<'a, f64, 1>),
}

/// What messages call scalars and their start.
const NAMES: [&str; 2] = ["scalars", "scalars.data"];

impl<'a> Scalars<'a> {
    /// Scalars that start at `data` and lie `stride` bytes apart (0: packed), in single precision.
    ///
    /// # Errors
    /// [`Error::NullPointer`], [`Error::Stride`], [`Error::Misaligned`] or [`Error::Size`] where the description cannot be right.
    ///
    /// # Safety
    /// For the life of the view, the `count` scalars must lie in memory that may be read and that nobody writes.
    /// `data` may be null or dangling when `count` is 0.
    pub unsafe fn from_raw_f32(data: *const f32, count: usize, stride: usize) -> Result<Self, Error> {
        // SAFETY: handed on.
        unsafe { StridedPoints::new(NAMES, data, count, stride) }.map(ScalarArray::F32).map(Scalars)
    }

    /// As [`Scalars::from_raw_f32`], in double precision.
    ///
    /// # Errors
    /// As [`Scalars::from_raw_f32`].
    ///
    /// # Safety
    /// As [`Scalars::from_raw_f32`].
    pub unsafe fn from_raw_f64(data: *const f64, count: usize, stride: usize) -> Result<Self, Error> {
        // SAFETY: handed on.
        unsafe { StridedPoints::new(NAMES, data, count, stride) }.map(ScalarArray::F64).map(Scalars)
    }

    /// The number of scalars.
    pub fn len(&self) -> usize {
        match &self.0 {
            ScalarArray::F32(scalars) => scalars.len(),
            ScalarArray::F64(scalars) => scalars.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A scalar, as `f64`.
    ///
    /// # Panics
    /// Where `index` is not below [`Scalars::len`].
    #[inline(always)]
    pub fn get(&self, index: usize) -> f64 {
        match &self.0 {
            ScalarArray::F32(scalars) => scalars.coordinates(index)[0] as f64,
            ScalarArray::F64(scalars) => scalars.coordinates(index)[0],
        }
    }

    /// Refuses another number of scalars than `expected`, and the first that is NaN or infinite. Messages say `what`.
    ///
    /// # Errors
    /// [`Error::Size`] or [`Error::NonFiniteScalar`].
    pub(crate) fn check(&self, what: &'static str, expected: usize) -> Result<(), Error> {
        if self.len() != expected {
            return Err(Error::Size { what, found: self.len() as u64, expected: expected as u64 });
        }
        let checked = match &self.0 {
            ScalarArray::F32(scalars) => scalars.check_finite(),
            ScalarArray::F64(scalars) => scalars.check_finite(),
        };
        checked.map_err(|error| match error {
            Error::NonFinitePosition { vertex } => Error::NonFiniteScalar { what, index: vertex },
            other => other,
        })
    }
}

macro_rules! from_slices {
    ($variant:ident, $scalar:ty) => {
        impl<'a> From<&'a [$scalar]> for Scalars<'a> {
            fn from(scalars: &'a [$scalar]) -> Self {
                Scalars(ScalarArray::$variant(StridedPoints::of_slice(scalars.as_chunks::<1>().0)))
            }
        }
        impl<'a> From<&'a Vec<$scalar>> for Scalars<'a> {
            fn from(scalars: &'a Vec<$scalar>) -> Self {
                Scalars::from(scalars.as_slice())
            }
        }
    };
}
from_slices!(F32, f32);
from_slices!(F64, f64);
