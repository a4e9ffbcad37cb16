//! Faces: an index buffer of triangles, of polygons of one size, or of polygons by offsets.

use super::checked_stride;
use crate::error::Error;

/// Borrowed vertex indices of 32 or 64 bits.
#[derive(Clone, Copy, Debug)]
pub enum Indices<'a> {
    /// Unsigned, 32 bits.
    U32(&'a [u32]),
    /// Signed, 32 bits; negative ones are refused.
    I32(&'a [i32]),
    /// Unsigned, 64 bits.
    U64(&'a [u64]),
}

/// Borrowed faces: each a closed loop of vertex indices, counter-clockwise seen from outside.
#[derive(Clone, Copy, Debug)]
pub struct Faces<'a> {
    indices: Indices<'a>,
    shape: Shape<'a>,
}

#[derive(Clone, Copy, Debug)]
enum Shape<'a> {
    Uniform { arity: usize },
    Offsets(Indices<'a>),
}

/// An integer that indices come in.
pub(crate) trait Index: Copy + Send + Sync {
    /// The value, as large as it gets where it is negative.
    fn widen(self) -> u64;
    /// Whether it is not below `limit`; a negative index reaches any.
    fn reaches(self, limit: u64) -> bool;
    /// The value as written.
    fn as_written(self) -> i128;
}
macro_rules! index {
    ($($integer:ty as $unsigned:ty),*) => {$(
        impl Index for $integer {
            #[inline(always)]
            fn widen(self) -> u64 {
                self as u64
            }
            #[inline(always)]
            fn reaches(self, limit: u64) -> bool {
                // In the integer's own width, so that a vector compares as many at once as it holds.
                match <$integer>::try_from(limit) {
                    Ok(limit) => (self as $unsigned) >= (limit as $unsigned),
                    Err(_) => (self as $unsigned) > (<$integer>::MAX as $unsigned),
                }
            }
            #[inline(always)]
            fn as_written(self) -> i128 {
                self as i128
            }
        }
    )*};
}
index!(u32 as u32, i32 as u32, u64 as u64);

/// Runs `$body` with `$slice` bound to the slice of whatever integer `$indices` holds.
macro_rules! with_indices {
    ($indices:expr, $slice:ident => $body:expr) => {
        match $indices {
            $crate::view::Indices::U32($slice) => $body,
            $crate::view::Indices::I32($slice) => $body,
            $crate::view::Indices::U64($slice) => $body,
        }
    };
}
pub(crate) use with_indices;

impl<'a> Indices<'a> {
    /// Indices that start at `data`, packed.
    ///
    /// # Errors
    /// [`Error::NullPointer`], [`Error::Misaligned`] or [`Error::Size`].
    ///
    /// # Safety
    /// For the life of the view, the `count` indices must lie in memory that may be read and that nobody writes.
    /// `data` may be null when `count` is 0.
    pub unsafe fn from_raw<I: IndexArray>(data: *const I, count: usize, what: &'static str) -> Result<Self, Error> {
        if count == 0 {
            return Ok(I::view(&[]));
        }
        if data.is_null() {
            return Err(Error::NullPointer { what });
        }
        checked_stride::<I>(what, data as usize, count, 0, 1)?;
        // SAFETY: not null, aligned, below isize::MAX bytes; the caller vouches for the memory.
        Ok(I::view(unsafe { std::slice::from_raw_parts(data, count) }))
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        with_indices!(self, slice => slice.len())
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Refuses an index that is negative or not below `vertex_count`.
    pub(crate) fn check_range(&self, what: &'static str, vertex_count: usize) -> Result<(), Error> {
        with_indices!(self, slice => check_range(slice, what, vertex_count))
    }
}

fn check_range<I: Index>(indices: &[I], what: &'static str, vertex_count: usize) -> Result<(), Error> {
    const BLOCK: usize = 4096;
    let limit = vertex_count as u64;
    for (block, chunk) in indices.chunks(BLOCK).enumerate() {
        if chunk.iter().fold(false, |beyond, index| beyond | index.reaches(limit)) {
            let found = chunk.iter().position(|index| index.widen() >= limit).unwrap_or(0);
            return Err(Error::IndexOutOfRange {
                what,
                position: (block * BLOCK + found) as u64,
                index: chunk[found].as_written(),
                vertex_count: limit,
            });
        }
    }
    Ok(())
}

/// An integer type that an index array may be made of: `u32`, `i32` or `u64`.
pub trait IndexArray: Copy + 'static {
    /// The view of a slice.
    fn view(slice: &[Self]) -> Indices<'_>;
}
impl IndexArray for u32 {
    fn view(slice: &[u32]) -> Indices<'_> {
        Indices::U32(slice)
    }
}
impl IndexArray for i32 {
    fn view(slice: &[i32]) -> Indices<'_> {
        Indices::I32(slice)
    }
}
impl IndexArray for u64 {
    fn view(slice: &[u64]) -> Indices<'_> {
        Indices::U64(slice)
    }
}

impl<'a, I: IndexArray> From<&'a [I]> for Indices<'a> {
    fn from(slice: &'a [I]) -> Self {
        I::view(slice)
    }
}
impl<'a, I: IndexArray> From<&'a Vec<I>> for Indices<'a> {
    fn from(vector: &'a Vec<I>) -> Self {
        I::view(vector)
    }
}

impl<'a> Faces<'a> {
    /// Faces of `arity` corners each, one after the other.
    ///
    /// # Errors
    /// [`Error::Size`] where `arity` is below 3 or the number of indices is no multiple of it.
    pub fn uniform(indices: impl Into<Indices<'a>>, arity: usize) -> Result<Self, Error> {
        let indices = indices.into();
        if arity < 3 {
            return Err(Error::Size { what: "faces.arity", found: arity as u64, expected: 3 });
        }
        let found = indices.len();
        if !found.is_multiple_of(arity) {
            let expected = (found / arity * arity) as u64;
            return Err(Error::Size { what: "faces.index_count", found: found as u64, expected });
        }
        Ok(Faces { indices, shape: Shape::Uniform { arity } })
    }

    /// Triangles, from a flat index buffer.
    ///
    /// # Errors
    /// [`Error::Size`] where the number of indices is no multiple of 3.
    pub fn triangles(indices: impl Into<Indices<'a>>) -> Result<Self, Error> {
        Self::uniform(indices, 3)
    }

    /// Polygons: face `f` has the indices from `offsets[f]` up to `offsets[f + 1]`, so there is one offset more than
    /// there are faces. A face of fewer than three corners is allowed, and ignored.
    ///
    /// # Errors
    /// [`Error::Offsets`] where the offsets do not run upwards from 0 to the number of indices.
    pub fn polygons(indices: impl Into<Indices<'a>>, offsets: impl Into<Indices<'a>>) -> Result<Self, Error> {
        let (indices, offsets) = (indices.into(), offsets.into());
        with_indices!(offsets, slice => check_offsets(slice, indices.len()))?;
        Ok(Faces { indices, shape: Shape::Offsets(offsets) })
    }

    /// The number of faces.
    pub fn len(&self) -> usize {
        match self.shape {
            Shape::Uniform { arity } => self.indices.len() / arity,
            Shape::Offsets(offsets) => offsets.len() - 1,
        }
    }

    /// Whether there are no faces.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All indices, face after face.
    pub fn indices(&self) -> Indices<'a> {
        self.indices
    }

    /// Faces of the same sizes, with other vertices.
    ///
    /// # Panics
    /// Where there are not as many.
    pub(crate) fn with_indices<'b>(&self, indices: &'b [u32]) -> Faces<'b>
    where
        'a: 'b,
    {
        assert_eq!(indices.len(), self.indices.len());
        Faces { indices: Indices::U32(indices), shape: self.shape }
    }

    /// Whether every face has three corners.
    pub(crate) fn all_triangles(&self) -> bool {
        match self.shape {
            Shape::Uniform { arity } => arity == 3,
            Shape::Offsets(offsets) => with_indices!(offsets, slice => {
                slice.iter().enumerate().all(|(face, offset)| offset.widen() == 3 * face as u64)
            }),
        }
    }

    /// Where face `face` starts and ends in [`Faces::indices`].
    #[inline(always)]
    pub(crate) fn range(&self, face: usize) -> std::ops::Range<usize> {
        match self.shape {
            Shape::Uniform { arity } => face * arity..(face + 1) * arity,
            Shape::Offsets(offsets) => {
                with_indices!(offsets, slice => slice[face].widen() as usize..slice[face + 1].widen() as usize)
            }
        }
    }
}

fn check_offsets<I: Index>(offsets: &[I], index_count: usize) -> Result<(), Error> {
    let Some((first, rest)) = offsets.split_first() else {
        return Err(Error::Offsets { face: 0 });
    };
    let mut last = first.widen();
    if last != 0 {
        return Err(Error::Offsets { face: 0 });
    }
    for (face, offset) in rest.iter().enumerate() {
        if offset.widen() < last || offset.widen() > index_count as u64 {
            return Err(Error::Offsets { face: face as u64 });
        }
        last = offset.widen();
    }
    if last != index_count as u64 {
        return Err(Error::Offsets { face: rest.len().saturating_sub(1) as u64 });
    }
    Ok(())
}
