//! Positions: `#V × 3` scalars at any byte stride.

use super::batch::KnownVertices;
use super::checked_stride;
use super::rings::Rings;
use crate::error::Error;
use crate::simd::{MAX_LANES, Real, Vector, Vector3, prefetch};
use glam::{DVec3, Vec3};
use std::any::TypeId;
use std::marker::PhantomData;

/// Borrowed vertex positions, `#V × 3`, `f32` or `f64`, at any byte stride.
#[derive(Clone, Copy, Debug)]
pub struct Points<'a>(PointArray<'a>);

/// Positions by scalar type.
#[derive(Clone, Copy, Debug)]
pub(crate) enum PointArray<'a> {
    F32(StridedPoints<'a, f32>),
    F64(StridedPoints<'a, f64>),
}

/// Positions of one scalar type, in `N` dimensions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StridedPoints<'a, S, const N: usize = 3> {
    base: *const u8,
    count: usize,
    stride: usize,
    memory: PhantomData<&'a [S]>,
}

// SAFETY: a shared borrow of plain numbers.
unsafe impl<S: Sync, const N: usize> Send for StridedPoints<'_, S, N> {}
// SAFETY: as above; nothing is ever written through it.
unsafe impl<S: Sync, const N: usize> Sync for StridedPoints<'_, S, N> {}

/// A scalar that positions come in.
pub(crate) trait Coordinate: Real {}
impl Coordinate for f32 {}
impl Coordinate for f64 {}

/// What messages call positions and their start.
const NAMES: [&str; 2] = ["points", "points.data"];

impl<'a> Points<'a> {
    /// Positions that start at `data` and lie `stride` bytes apart (0: packed), in single precision.
    ///
    /// # Errors
    /// [`Error::Stride`], [`Error::Misaligned`] or [`Error::Size`] where the description cannot be right.
    ///
    /// # Safety
    /// For the life of the view, the `count` points must lie in memory that may be read and that nobody writes.
    /// `data` may be null or dangling when `count` is 0.
    pub unsafe fn from_raw_f32(data: *const f32, count: usize, stride: usize) -> Result<Self, Error> {
        // SAFETY: handed on.
        unsafe { StridedPoints::new(NAMES, data, count, stride) }.map(PointArray::F32).map(Points)
    }

    /// As [`Points::from_raw_f32`], in double precision.
    ///
    /// # Errors
    /// As [`Points::from_raw_f32`].
    ///
    /// # Safety
    /// As [`Points::from_raw_f32`].
    pub unsafe fn from_raw_f64(data: *const f64, count: usize, stride: usize) -> Result<Self, Error> {
        // SAFETY: handed on.
        unsafe { StridedPoints::new(NAMES, data, count, stride) }.map(PointArray::F64).map(Points)
    }

    pub(crate) fn array(&self) -> &PointArray<'a> {
        &self.0
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        match &self.0 {
            PointArray::F32(points) => points.count,
            PointArray::F64(points) => points.count,
        }
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The position of a vertex, as `f64`.
    ///
    /// # Panics
    /// Where `vertex` is not below [`Points::len`].
    pub fn get(&self, vertex: usize) -> DVec3 {
        match &self.0 {
            PointArray::F32(points) => points.get(vertex),
            PointArray::F64(points) => points.get(vertex),
        }
    }

    /// Whether the scalars are `f64`.
    pub fn is_double(&self) -> bool {
        matches!(self.0, PointArray::F64(_))
    }

    /// Finds the first position that is NaN or infinite.
    ///
    /// # Errors
    /// [`Error::NonFinitePosition`].
    pub(crate) fn check_finite(&self) -> Result<(), Error> {
        match &self.0 {
            PointArray::F32(points) => points.check_finite(),
            PointArray::F64(points) => points.check_finite(),
        }
    }
}

impl<'a, S: Coordinate> From<&'a [[S; 3]]> for StridedPoints<'a, S> {
    fn from(points: &'a [[S; 3]]) -> Self {
        StridedPoints::of_slice(points)
    }
}

impl<'a, S: Coordinate, const N: usize> StridedPoints<'a, S, N> {
    /// Points of an array that messages call `what`, and its start `data_name`.
    ///
    /// # Safety
    /// As [`Points::from_raw_f32`].
    pub(super) unsafe fn new(
        [what, data_name]: [&'static str; 2],
        data: *const S,
        count: usize,
        stride: usize,
    ) -> Result<Self, Error> {
        let stride = checked_stride::<S>(what, data as usize, count, stride, N)?;
        if data.is_null() && count > 0 {
            return Err(Error::NullPointer { what: data_name });
        }
        Ok(StridedPoints { base: data.cast(), count, stride, memory: PhantomData })
    }

    /// The number of points.
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// Fetches a point into the cache.
    #[inline(always)]
    pub(crate) fn prefetch(&self, index: usize) {
        prefetch(self.base.wrapping_add(index * self.stride));
    }

    /// Whether a point starts where the one before it ends.
    pub(crate) fn is_packed(&self) -> bool {
        self.stride == N * size_of::<S>()
    }

    /// The coordinates of a point.
    #[inline(always)]
    pub(crate) fn coordinates(&self, index: usize) -> [S; N] {
        assert!(index < self.count, "point {index} of {}", self.count);
        // SAFETY: the index is in range, so the point lies in the borrowed memory.
        unsafe { self.base.add(index * self.stride).cast::<[S; N]>().read() }
    }

    /// Finds the first position that is NaN or infinite.
    pub(super) fn check_finite(&self) -> Result<(), Error> {
        // `0 × x` is 0 for a finite x and NaN otherwise; the sum of a block keeps that, without a branch a point.
        const BLOCK: usize = 1024;
        if self.is_packed() && self.count > 0 {
            // SAFETY: packed points are so many scalars in a row, in the borrowed memory.
            let scalars = unsafe { std::slice::from_raw_parts(self.base.cast::<S>(), self.count * N) };
            if scalars.chunks(N * BLOCK).all(all_finite) {
                return Ok(());
            }
        }
        for start in (0..self.count).step_by(BLOCK) {
            let block = start..self.count.min(start + BLOCK);
            let mut sum = [S::ZERO; N];
            for index in block.clone() {
                let point = self.coordinates(index);
                for axis in 0..N {
                    sum[axis] = sum[axis] + point[axis] * S::ZERO;
                }
            }
            if sum.iter().any(|sum| *sum != S::ZERO) {
                let finite =
                    |index: &usize| self.coordinates(*index).map(Into::into).iter().all(|x: &f64| x.is_finite());
                let vertex = block.into_iter().find(|index| !finite(index)).unwrap_or(start) as u64;
                return Err(Error::NonFinitePosition { vertex });
            }
        }
        Ok(())
    }

    /// An array of points in memory.
    pub(super) fn of_slice(points: &'a [[S; N]]) -> Self {
        let (base, count) = (points.as_ptr().cast(), points.len());
        StridedPoints { base, count, stride: size_of::<[S; N]>(), memory: PhantomData }
    }
}

impl<S: Coordinate> StridedPoints<'_, S> {
    /// A point as `f64`.
    #[inline(always)]
    pub(crate) fn get(&self, index: usize) -> DVec3 {
        let [x, y, z] = self.coordinates(index);
        DVec3::new(x.into(), y.into(), z.into())
    }
}

impl<S: Coordinate> StridedPoints<'_, S> {
    /// The points `indices[0..V::LANES]`, a point a lane.
    ///
    /// # Panics
    /// Where one of them is no point.
    #[inline(always)]
    pub(crate) fn lanes<V: Vector>(&self, indices: &[u32; MAX_LANES]) -> Vector3<V> {
        let most = indices[..V::LANES].iter().fold(0, |most, &index| most.max(index)) as usize;
        assert!(most < self.count, "point {most} of {}", self.count);
        // SAFETY: all are points; where four scalars are loaded, points are packed and none of these is the last.
        unsafe {
            if self.is_packed() && most + 1 < self.count {
                self.gather::<true, V>(indices)
            } else {
                self.gather::<false, V>(indices)
            }
        }
    }

    /// As [`StridedPoints::lanes`], of vertices that have been checked against a table of rings.
    ///
    /// # Panics
    /// Where points are fewer than the vertices of the table.
    #[inline(always)]
    pub(super) fn known_lanes<V: Vector>(&self, rings: &Rings, vertices: KnownVertices) -> Vector3<V> {
        assert!(self.count >= rings.vertex_count());
        // SAFETY: all are vertices other than the last, so there is a point for each, and one behind it.
        unsafe {
            if self.is_packed() {
                self.gather::<true, V>(vertices.indices())
            } else {
                self.gather::<false, V>(vertices.indices())
            }
        }
    }

    /// # Safety
    /// As [`Vector::gather`], for the points' own scalar.
    #[inline(always)]
    unsafe fn gather<const WIDE: bool, V: Vector>(&self, indices: &[u32; MAX_LANES]) -> Vector3<V> {
        // SAFETY: handed on; each gather is for the points' scalar.
        unsafe {
            if TypeId::of::<V::Scalar>() == TypeId::of::<S>() {
                V::gather::<WIDE>(self.base, self.stride, indices)
            } else if TypeId::of::<S>() == TypeId::of::<f32>() {
                V::gather_single::<WIDE>(self.base, self.stride, indices)
            } else {
                gather_converted(self, indices)
            }
        }
    }
}

/// Points of any scalar type, loaded as lanes of another: the mixed case, one scalar at a time.
#[inline(always)]
fn gather_converted<V: Vector, S: Coordinate>(
    points: &StridedPoints<'_, S>,
    indices: &[u32; MAX_LANES],
) -> Vector3<V> {
    let mut lanes = [[V::Scalar::ZERO; MAX_LANES]; 3];
    for lane in 0..V::LANES {
        let point = points.coordinates(indices[lane] as usize);
        for axis in 0..3 {
            lanes[axis][lane] = V::Scalar::from_f64(point[axis].into());
        }
    }
    Vector3::from_lanes(&lanes)
}

macro_rules! from_slices {
    ($variant:ident, $scalar:ty, $vector:ty) => {
        impl<'a> From<&'a [[$scalar; 3]]> for Points<'a> {
            fn from(points: &'a [[$scalar; 3]]) -> Self {
                Points(PointArray::$variant(StridedPoints::of_slice(points)))
            }
        }
        impl<'a> From<&'a [$vector]> for Points<'a> {
            fn from(points: &'a [$vector]) -> Self {
                Points(PointArray::$variant(StridedPoints {
                    base: points.as_ptr().cast(),
                    count: points.len(),
                    stride: size_of::<$vector>(),
                    memory: PhantomData,
                }))
            }
        }
        const _: () = assert!(size_of::<$vector>() == size_of::<[$scalar; 3]>());
        impl<'a> From<&'a Vec<[$scalar; 3]>> for Points<'a> {
            fn from(points: &'a Vec<[$scalar; 3]>) -> Self {
                Points::from(points.as_slice())
            }
        }
    };
}
from_slices!(F32, f32, Vec3);
from_slices!(F64, f64, DVec3);

/// Whether all are finite; in many lanes, so that no sum waits for the one before.
fn all_finite<S: Coordinate>(scalars: &[S]) -> bool {
    const LANES: usize = 32;
    let mut sums = [S::ZERO; LANES];
    let (rows, rest) = scalars.as_chunks::<LANES>();
    for row in rows {
        for (sum, &x) in sums.iter_mut().zip(row) {
            *sum = *sum + x * S::ZERO;
        }
    }
    for (sum, &x) in sums.iter_mut().zip(rest) {
        *sum = *sum + x * S::ZERO;
    }
    sums.iter().all(|sum| *sum == S::ZERO)
}
