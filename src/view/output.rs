//! Outputs: the caller's arrays, written element by element at any byte stride.

use super::checked_stride;
use crate::error::Error;
use crate::simd::{MAX_LANES, Real, Vector};
use std::marker::PhantomData;
use std::sync::atomic::{AtomicU8, Ordering::Relaxed};

/// A borrowed array to write, of `N` scalars an element, `f32` or `f64`, at any byte stride.
///
/// Stores are relaxed atomics (plain moves on every CPU), so that two threads that write the same value to the same
/// element, as a list of vertices with repetitions makes them, are no data race.
#[derive(Debug)]
pub struct Output<'a, const N: usize = 3> {
    base: *mut u8,
    count: usize,
    stride: usize,
    double: bool,
    memory: PhantomData<&'a mut [u8]>,
}

/// A borrowed array to write, of one scalar an element.
pub type ScalarOutput<'a> = Output<'a, 1>;

// SAFETY: all writes are atomic stores into memory that the view borrows exclusively.
unsafe impl<const N: usize> Send for Output<'_, N> {}
// SAFETY: as above.
unsafe impl<const N: usize> Sync for Output<'_, N> {}

impl<'a, const N: usize> Output<'a, N> {
    /// `count` elements of `N` `f32` from `data` on, `stride` bytes apart (0: packed).
    ///
    /// # Errors
    /// [`Error::NullPointer`], [`Error::Stride`], [`Error::Misaligned`] or [`Error::Size`].
    ///
    /// # Safety
    /// For the life of the view, the elements must lie in memory that may be written, and nobody else may read or
    /// write them. Bytes between the elements may belong to anything.
    pub unsafe fn from_raw_f32(data: *mut f32, count: usize, stride: usize) -> Result<Self, Error> {
        let stride = checked_stride::<f32>("output", data as usize, count, stride, N)?;
        Self::new(data.cast(), count, stride, false)
    }

    /// As [`Output::from_raw_f32`], in double precision.
    ///
    /// # Errors
    /// As [`Output::from_raw_f32`].
    ///
    /// # Safety
    /// As [`Output::from_raw_f32`].
    pub unsafe fn from_raw_f64(data: *mut f64, count: usize, stride: usize) -> Result<Self, Error> {
        let stride = checked_stride::<f64>("output", data as usize, count, stride, N)?;
        Self::new(data.cast(), count, stride, true)
    }

    fn new(base: *mut u8, count: usize, stride: usize, double: bool) -> Result<Self, Error> {
        if base.is_null() && count > 0 {
            return Err(Error::NullPointer { what: "output.data" });
        }
        Ok(Output { base, count, stride, double, memory: PhantomData })
    }

    /// Another view of the same memory, while this one is not used otherwise.
    pub(crate) fn again(&self) -> Output<'_, N> {
        let Output { base, count, stride, double, .. } = *self;
        Output { base, count, stride, double, memory: PhantomData }
    }

    /// The number of elements.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are no elements.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Whether the scalars are `f64`.
    pub fn is_double(&self) -> bool {
        self.double
    }

    /// Writes an element; values beyond the scalar's range become its largest.
    #[inline(always)]
    pub(crate) fn write(&self, index: usize, value: [f64; N]) {
        if self.double {
            self.write_double(index, value.map(|x| x.clamp(-f64::MAX, f64::MAX)));
        } else {
            self.write_single(index, value.map(|x| x.clamp(-f32::MAX as f64, f32::MAX as f64) as f32));
        }
    }

    /// As [`Output::write`], but what is not finite stays as it is.
    #[inline(always)]
    pub(crate) fn copy(&self, index: usize, value: [f64; N]) {
        if self.double {
            self.write_double(index, value);
        } else {
            let single =
                |x: f64| if x.is_finite() { x.clamp(-f32::MAX as f64, f32::MAX as f64) as f32 } else { x as f32 };
            self.write_single(index, value.map(single));
        }
    }

    /// Writes element after element, from `first` on, the rows that `index` names; none of them is beyond the scalar's range.
    pub(crate) fn write_rows<S: Real>(&self, first: usize, rows: &[[S; N]], index: &[u32]) {
        if self.double {
            for (place, &row) in index.iter().enumerate() {
                self.write_double(first + place, rows[row as usize].map(Into::into));
            }
        } else {
            for (place, &row) in index.iter().enumerate() {
                self.write_single(first + place, rows[row as usize].map(|x| x.into() as f32));
            }
        }
    }

    /// Writes the elements `vertices`, in the lanes whose bit is set in `lanes`, in whatever precision a kernel works in.
    #[inline(always)]
    pub(crate) fn write_lanes<V: Vector>(&self, vertices: &[u32], lanes: u32, values: &[V; N]) {
        if N == 3 && V::Scalar::SINGLE != self.double && vertices.len() == V::LANES && lanes == V::ALL {
            let mut indices = [0u32; MAX_LANES];
            indices[..V::LANES].copy_from_slice(&vertices[..V::LANES]);
            let most = indices[..V::LANES].iter().fold(0, |most, &index| most.max(index)) as usize;
            assert!(most < self.count, "output {most} of {}", self.count);
            let rows = [values[0], values[1], values[2], values[2]];
            // SAFETY: all are in range, so inside the borrowed memory, which is ours to write; scalars are the vector's.
            unsafe { V::scatter4::<false>(rows, self.base, self.stride, &indices) };
            return;
        }
        let mut rows = [[V::Scalar::ZERO; MAX_LANES]; N];
        for axis in 0..N {
            rows[axis] = values[axis].to_lanes();
        }
        for (lane, &vertex) in vertices.iter().enumerate().take(MAX_LANES) {
            if lanes & 1 << lane == 0 {
                continue;
            }
            if V::Scalar::SINGLE && !self.double {
                let mut element = [0.0; N];
                for axis in 0..N {
                    element[axis] = rows[axis][lane].into() as f32;
                }
                self.write_single(vertex as usize, element);
            } else {
                let mut element = [0.0; N];
                for axis in 0..N {
                    element[axis] = rows[axis][lane].into();
                }
                self.write(vertex as usize, element);
            }
        }
    }

    /// Writes the elements `vertices`, in the lanes whose bit is set in `lanes`, from rows of lanes; values beyond the scalar's
    /// range become its largest.
    #[inline(always)]
    pub(crate) fn write_block(&self, vertices: &[u32], lanes: u32, values: &[[f64; MAX_LANES]; N]) {
        // Explicit loops throughout: closures are not inlined everywhere, and this is a large part of the cheaper estimators.
        if self.double {
            for (lane, &vertex) in vertices.iter().enumerate().take(MAX_LANES) {
                if lanes & 1 << lane != 0 {
                    let mut element = [0.0; N];
                    for axis in 0..N {
                        element[axis] = values[axis][lane].clamp(-f64::MAX, f64::MAX);
                    }
                    self.write_double(vertex as usize, element);
                }
            }
            return;
        }
        let mut singles = [[0.0f32; MAX_LANES]; N];
        for axis in 0..N {
            for lane in 0..MAX_LANES {
                singles[axis][lane] = values[axis][lane].clamp(-f32::MAX as f64, f32::MAX as f64) as f32;
            }
        }
        for (lane, &vertex) in vertices.iter().enumerate().take(MAX_LANES) {
            if lanes & 1 << lane != 0 {
                let mut element = [0.0; N];
                for axis in 0..N {
                    element[axis] = singles[axis][lane];
                }
                self.write_single(vertex as usize, element);
            }
        }
    }

    #[inline(always)]
    fn element(&self, index: usize) -> *mut u8 {
        assert!(index < self.count, "output {index} of {}", self.count);
        // SAFETY: in range, so inside the borrowed memory.
        unsafe { self.base.add(index * self.stride) }
    }

    #[inline(always)]
    fn write_single(&self, index: usize, value: [f32; N]) {
        let element = self.element(index).cast::<f32>();
        for (axis, x) in value.iter().enumerate() {
            // SAFETY: `N` aligned f32 start at the element, in memory that is ours to write.
            unsafe { x.store_relaxed(element.add(axis)) };
        }
    }

    #[inline(always)]
    fn write_double(&self, index: usize, value: [f64; N]) {
        let element = self.element(index).cast::<f64>();
        for (axis, x) in value.iter().enumerate() {
            // SAFETY: `N` aligned f64 start at the element, in memory that is ours to write.
            unsafe { x.store_relaxed(element.add(axis)) };
        }
    }
}

macro_rules! from_slices {
    ($($scalar:ty, $double:literal;)*) => {$(
        impl<'a, const N: usize> From<&'a mut [[$scalar; N]]> for Output<'a, N> {
            fn from(slice: &'a mut [[$scalar; N]]) -> Self {
                let (base, count) = (slice.as_mut_ptr().cast(), slice.len());
                Output { base, count, stride: size_of::<[$scalar; N]>(), double: $double, memory: PhantomData }
            }
        }
        impl<'a> From<&'a mut [$scalar]> for Output<'a, 1> {
            fn from(slice: &'a mut [$scalar]) -> Self {
                let (base, count) = (slice.as_mut_ptr().cast(), slice.len());
                Output { base, count, stride: size_of::<$scalar>(), double: $double, memory: PhantomData }
            }
        }
    )*};
}
from_slices! { f32, false; f64, true; }

/// A borrowed array of `#V` status bytes to write, at any byte stride.
#[derive(Debug)]
pub struct StatusOutput<'a> {
    base: *mut u8,
    count: usize,
    stride: usize,
    memory: PhantomData<&'a mut [u8]>,
}

// SAFETY: all writes are atomic stores into memory that the view borrows exclusively.
unsafe impl Send for StatusOutput<'_> {}
// SAFETY: as above.
unsafe impl Sync for StatusOutput<'_> {}

impl<'a> StatusOutput<'a> {
    /// `count` bytes from `data` on, `stride` bytes apart (0: packed).
    ///
    /// # Errors
    /// [`Error::NullPointer`] or [`Error::Size`].
    ///
    /// # Safety
    /// As [`Output::from_raw_f32`].
    pub unsafe fn from_raw(data: *mut u8, count: usize, stride: usize) -> Result<Self, Error> {
        let stride = checked_stride::<u8>("status", data as usize, count, stride, 1)?;
        if data.is_null() && count > 0 {
            return Err(Error::NullPointer { what: "status.data" });
        }
        Ok(StatusOutput { base: data, count, stride, memory: PhantomData })
    }

    /// Another view of the same memory, while this one is not used otherwise.
    pub(crate) fn again(&self) -> StatusOutput<'_> {
        let StatusOutput { base, count, stride, .. } = *self;
        StatusOutput { base, count, stride, memory: PhantomData }
    }

    /// The number of bytes.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    #[inline(always)]
    pub(crate) fn write(&self, index: usize, status: u8) {
        assert!(index < self.count, "status {index} of {}", self.count);
        // SAFETY: in range, so inside the borrowed memory, which is ours to write.
        unsafe { AtomicU8::from_ptr(self.base.add(index * self.stride)) }.store(status, Relaxed);
    }
}

impl<'a> From<&'a mut [u8]> for StatusOutput<'a> {
    fn from(slice: &'a mut [u8]) -> Self {
        StatusOutput { base: slice.as_mut_ptr(), count: slice.len(), stride: 1, memory: PhantomData }
    }
}
