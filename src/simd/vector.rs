//! The vector trait: what a kernel may do with a row of lanes.
//!
//! Only operations whose result IEEE 754 fixes to the bit are here: `+ − × ÷ √`, sign and exponent bits,
//! comparisons and selection. There is no fused multiply-add, no reciprocal estimate and no sum across lanes,
//! which is why one source gives the same bits at every width.

use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Relaxed};

/// The scalar of a lane: `f32` or `f64`.
pub(crate) trait Real:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Into<f64>
    + Send
    + Sync
    + 'static
{
    /// 0
    const ZERO: Self;
    /// 1
    const ONE: Self;
    /// +∞
    const INFINITY: Self;
    /// Squares of lengths at or below this (relative to a ring of extent 1) count as zero: their reciprocals,
    /// and the squares of these, would leave the range of the type.
    const TINY: Self;
    /// Whether results that rounding may have spoilt are computed again in `f64`.
    const SINGLE: bool;

    /// The nearest value of this type.
    fn from_f64(x: f64) -> Self;
    /// The square root.
    fn root(self) -> Self;
    /// The absolute value.
    fn magnitude(self) -> Self;
    /// Stores it as a relaxed atomic does.
    ///
    /// # Safety
    /// `place` is a writable scalar of this type, aligned as one.
    unsafe fn store_relaxed(self, place: *mut Self);
    /// `2^−floor(log₂ x)` for `x ≥ 0`, kept inside the normal range, so that `x` times it lies in `[1, 4)`, or
    /// below where `x` is zero or subnormal.
    fn inverse_power_of_two(self) -> Self;
}

macro_rules! real {
    ($scalar:ty, $bits:ty, $atomic:ty, $exponent_mask:expr, $mirror:expr, $largest:expr, $tiny:expr, $single:expr) => {
        impl Real for $scalar {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const INFINITY: Self = <$scalar>::INFINITY;
            const TINY: Self = $tiny;
            const SINGLE: bool = $single;

            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                x as $scalar
            }
            #[inline(always)]
            fn root(self) -> Self {
                self.sqrt()
            }
            #[inline(always)]
            fn magnitude(self) -> Self {
                self.abs()
            }
            #[inline(always)]
            unsafe fn store_relaxed(self, place: *mut Self) {
                // SAFETY: the caller's word; where the scalar is less aligned than the atomic of its size, its halves are stored.
                unsafe {
                    if align_of::<$scalar>() == align_of::<$atomic>() {
                        <$atomic>::from_ptr(place.cast()).store(self.to_bits(), Relaxed);
                    } else {
                        let halves = self.to_ne_bytes();
                        for (index, half) in halves.as_chunks::<4>().0.iter().enumerate() {
                            AtomicU32::from_ptr(place.cast::<u32>().add(index))
                                .store(u32::from_ne_bytes(*half), Relaxed);
                        }
                    }
                }
            }
            #[inline(always)]
            fn inverse_power_of_two(self) -> Self {
                let x = if self < $largest { self } else { $largest };
                <$scalar>::from_bits($mirror - (x.to_bits() & $exponent_mask))
            }
        }
    };
}
// 2^126 and 2^1022: the largest powers of two whose reciprocal is a normal number.
real!(f32, u32, AtomicU32, 0x7f80_0000, 254 << 23, f32::from_bits(253 << 23), f32::from_bits(27 << 23), true);
real!(
    f64,
    u64,
    AtomicU64,
    0x7ff0_0000_0000_0000,
    2046 << 52,
    f64::from_bits(2045 << 52),
    f64::from_bits(123 << 52),
    false
);

/// A comparison's answer, lane by lane.
pub(crate) trait Mask: Copy {
    /// Lanes where both hold.
    fn and(self, other: Self) -> Self;
    /// Lanes where one of them holds.
    fn or(self, other: Self) -> Self;
    /// Bit `l` is lane `l`.
    fn bits(self) -> u32;
}

/// `value(0)`, `value(1)` …, in place of `start`. As `std::array::from_fn`, which is not inlined everywhere, and then works without
/// the CPU features of a kernel.
#[inline(always)]
pub(crate) fn each<T: Copy, const N: usize>(start: T, mut value: impl FnMut(usize) -> T) -> [T; N] {
    let mut all = [start; N];
    for (index, place) in all.iter_mut().enumerate() {
        *place = value(index);
    }
    all
}

/// A row of lanes of one scalar type.
pub(crate) trait Vector:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// One lane's type.
    type Scalar: Real;
    /// What comparisons answer.
    type Mask: Mask;
    /// How many lanes.
    const LANES: usize;

    /// All lanes equal to `x`.
    fn splat(x: Self::Scalar) -> Self;
    /// Lane `l` from `lanes[l]`.
    fn from_lanes(lanes: &[Self::Scalar; MAX_LANES]) -> Self;
    /// The lanes, in the first [`Vector::LANES`] entries.
    fn to_lanes(self) -> [Self::Scalar; MAX_LANES];
    /// Square roots.
    fn sqrt(self) -> Self;
    /// Absolute values.
    fn abs(self) -> Self;
    /// The smaller; `other` where either is NaN.
    fn min(self, other: Self) -> Self;
    /// The larger; `other` where either is NaN.
    fn max(self, other: Self) -> Self;
    /// `self < other`
    fn lt(self, other: Self) -> Self::Mask;
    /// `yes` where `mask` holds, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// [`Real::inverse_power_of_two`] of each lane.
    fn unit_scale(self) -> Self;

    /// The first three scalars of each of the elements `indices[0..LANES]`, an element a lane, and in the fourth row the
    /// scalar that follows if `WIDE`, else whatever.
    ///
    /// # Safety
    /// Each of those indices must be that of an element of `stride` bytes from `base` on, aligned for the scalar, and if
    /// `WIDE` a fourth scalar must follow its first three in the same array.
    unsafe fn gather4<const WIDE: bool>(base: *const u8, stride: usize, indices: &[u32; MAX_LANES]) -> [Self; 4];

    /// Stores lane `l` of the first three `rows`, of all four if `WIDE`, as scalars that follow each other in element
    /// `indices[l]`, for each lane. Unless `WIDE`, stores are relaxed atomics, so that threads that store the same values to
    /// the same element are no data race.
    ///
    /// # Safety
    /// As [`Vector::gather4`], for elements that may be written, and, if `WIDE`, that nobody else reads or writes meanwhile.
    unsafe fn scatter4<const WIDE: bool>(rows: [Self; 4], base: *mut u8, stride: usize, indices: &[u32; MAX_LANES]);

    /// The points `indices[0..LANES]` of an array of points of this scalar type.
    ///
    /// # Safety
    /// As [`Vector::gather4`]: where `WIDE`, points are packed and none of these is the last.
    #[inline(always)]
    unsafe fn gather<const WIDE: bool>(base: *const u8, stride: usize, indices: &[u32; MAX_LANES]) -> Vector3<Self> {
        // SAFETY: handed on.
        let [x, y, z, _] = unsafe { Self::gather4::<WIDE>(base, stride, indices) };
        Vector3 { x, y, z }
    }

    /// [`Mask::bits`] where all lanes hold.
    const ALL: u32 = ((1u64 << Self::LANES) - 1) as u32;

    /// As [`Vector::gather`], of points in single precision.
    ///
    /// # Safety
    /// As [`Vector::gather`].
    #[inline(always)]
    unsafe fn gather_single<const WIDE: bool>(
        base: *const u8,
        stride: usize,
        indices: &[u32; MAX_LANES],
    ) -> Vector3<Self> {
        let mut lanes = [[Self::Scalar::ZERO; MAX_LANES]; 3];
        for lane in 0..Self::LANES {
            // SAFETY: the caller vouches for the index, the base and the stride.
            let point = unsafe { base.add(indices[lane] as usize * stride).cast::<[f32; 3]>().read() };
            for axis in 0..3 {
                lanes[axis][lane] = Self::Scalar::from_f64(point[axis].into());
            }
        }
        Vector3::from_lanes(&lanes)
    }

    /// All lanes 0.
    #[inline(always)]
    fn zero() -> Self {
        Self::splat(Self::Scalar::ZERO)
    }
    /// All lanes 1.
    #[inline(always)]
    fn one() -> Self {
        Self::splat(Self::Scalar::ONE)
    }
    /// All lanes the nearest value to `x`.
    #[inline(always)]
    fn constant(x: f64) -> Self {
        Self::splat(Self::Scalar::from_f64(x))
    }
    /// `1/self` where `self` is above [`Real::TINY`], else 0: how a kernel drops a term that has no value.
    #[inline(always)]
    fn reciprocal_or_zero(self) -> Self {
        let usable = Self::splat(Self::Scalar::TINY).lt(self);
        let safe = Self::select(usable, self, Self::one());
        Self::select(usable, Self::one() / safe, Self::zero())
    }
}

/// As many rows of lanes as fit into `numbers`, wherever these start in memory.
#[inline(always)]
pub(crate) fn as_lanes<V: Vector>(numbers: &mut [V::Scalar]) -> &mut [V] {
    const { assert!(size_of::<V>() == V::LANES * size_of::<V::Scalar>()) };
    // SAFETY: a vector is a row of `LANES` scalars and nothing else, as its size says, and any bits are a scalar's.
    unsafe { numbers.align_to_mut::<V>().1 }
}

/// No vector has more lanes than this.
pub(crate) const MAX_LANES: usize = 16;

/// A lone scalar is a vector of one lane: the slow path runs the very same formulas.
macro_rules! scalar_vector {
    ($scalar:ty) => {
        impl Vector for $scalar {
            type Scalar = $scalar;
            type Mask = bool;
            const LANES: usize = 1;

            #[inline(always)]
            fn splat(x: $scalar) -> Self {
                x
            }
            #[inline(always)]
            fn from_lanes(lanes: &[$scalar; MAX_LANES]) -> Self {
                lanes[0]
            }
            #[inline(always)]
            fn to_lanes(self) -> [$scalar; MAX_LANES] {
                let mut lanes = [0.0; MAX_LANES];
                lanes[0] = self;
                lanes
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                self.root()
            }
            #[inline(always)]
            fn abs(self) -> Self {
                self.magnitude()
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if self < other { self } else { other }
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if self > other { self } else { other }
            }
            #[inline(always)]
            fn lt(self, other: Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn select(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }
            #[inline(always)]
            fn unit_scale(self) -> Self {
                self.inverse_power_of_two()
            }
            #[inline(always)]
            unsafe fn gather4<const WIDE: bool>(
                base: *const u8,
                stride: usize,
                indices: &[u32; MAX_LANES],
            ) -> [Self; 4] {
                // SAFETY: the caller vouches for the element, and for its fourth scalar if `WIDE`.
                unsafe {
                    let element = base.add(indices[0] as usize * stride).cast::<$scalar>();
                    let [x, y, z] = element.cast::<[$scalar; 3]>().read();
                    [x, y, z, if WIDE { element.add(3).read() } else { 0.0 }]
                }
            }
            #[inline(always)]
            unsafe fn scatter4<const WIDE: bool>(
                [x, y, z, w]: [Self; 4],
                base: *mut u8,
                stride: usize,
                indices: &[u32; MAX_LANES],
            ) {
                // SAFETY: as above.
                unsafe {
                    let element = base.add(indices[0] as usize * stride).cast::<$scalar>();
                    if WIDE {
                        element.cast::<[$scalar; 4]>().write([x, y, z, w]);
                    } else {
                        x.store_relaxed(element);
                        y.store_relaxed(element.add(1));
                        z.store_relaxed(element.add(2));
                    }
                }
            }
        }
    };
}
scalar_vector!(f32);
scalar_vector!(f64);

impl Mask for bool {
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        self & other
    }
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        self | other
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        self as u32
    }
}

/// Three rows of lanes: one vector of space per lane.
#[derive(Clone, Copy)]
pub(crate) struct Vector3<V> {
    pub x: V,
    pub y: V,
    pub z: V,
}

impl<V: Vector> Vector3<V> {
    #[inline(always)]
    pub fn zero() -> Self {
        Vector3 { x: V::zero(), y: V::zero(), z: V::zero() }
    }
    #[inline(always)]
    pub fn dot(self, other: Self) -> V {
        self.x * other.x + self.y * other.y + self.z * other.z
    }
    #[inline(always)]
    pub fn squared(self) -> V {
        self.dot(self)
    }
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Vector3 {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }
    /// Each component by `divisor`: more exact than a product with its reciprocal, so that the normal of a plane
    /// through two axes is a unit vector to the last bit.
    #[inline(always)]
    pub fn divided_by(self, divisor: V) -> Self {
        Vector3 { x: self.x / divisor, y: self.y / divisor, z: self.z / divisor }
    }
    #[inline(always)]
    pub fn largest_component(self) -> V {
        self.x.abs().max(self.y.abs()).max(self.z.abs())
    }
    #[inline(always)]
    pub fn from_lanes(lanes: &[[V::Scalar; MAX_LANES]; 3]) -> Self {
        Vector3 { x: V::from_lanes(&lanes[0]), y: V::from_lanes(&lanes[1]), z: V::from_lanes(&lanes[2]) }
    }
}

impl From<glam::DVec3> for Vector3<f64> {
    fn from(vector: glam::DVec3) -> Self {
        Vector3 { x: vector.x, y: vector.y, z: vector.z }
    }
}

impl<V: Vector> Add for Vector3<V> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Vector3 { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}
impl<V: Vector> Sub for Vector3<V> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Vector3 { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}
impl<V: Vector> Mul<V> for Vector3<V> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: V) -> Self {
        Vector3 { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}
