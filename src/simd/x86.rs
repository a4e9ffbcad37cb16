//! The x86-64 back-ends: AVX2 and AVX-512 rows of `f32` and `f64`.
//!
//! The types may be used only inside a function that carries the features of their level; [`super::dispatch`]
//! sees to that. `sub`, `div` … are the plain IEEE instructions: nothing here approximates or fuses.

use super::vector::{MAX_LANES, Mask, Vector, Vector3};
use super::x86_memory::*;
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

// Operations of more than one instruction come as `|operand| expression`, which is pasted and not called: a closure would lack
// the CPU features, and not be inlined everywhere.
//
// SAFETY of every `unsafe` block in this macro: the intrinsics need only the CPU features of their level, and
// these types are reached only through `super::dispatch`, which has checked them; `from_lanes` and `to_lanes`
// access arrays of MAX_LANES ≥ LANES scalars with unaligned loads and stores.
macro_rules! row {
    ($name:ident, $register:ty, $scalar:ty, $lanes:expr, $mask:ident,
     $set:ident, $add:ident, $sub:ident, $mul:ident, $div:ident, $sqrt:ident, $min:ident, $max:ident,
     $load:ident, $store:ident, |$abs_of:ident| $abs:expr, |$negated:ident| $negate:expr,
     |$less_a:ident, $less_b:ident| $less:expr, |$where:ident, $yes:ident, $no:ident| $select:expr,
     |$mirrored:ident| $mirror:expr, $gather:ident, $gather_single:ident, $scatter:ident) => {
        #[derive(Clone, Copy)]
        #[repr(transparent)]
        pub(crate) struct $name($register);

        impl Add for $name {
            type Output = Self;
            #[inline(always)]
            fn add(self, other: Self) -> Self {
                // SAFETY: see the macro.
                $name(unsafe { $add(self.0, other.0) })
            }
        }
        impl Sub for $name {
            type Output = Self;
            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                // SAFETY: see the macro.
                $name(unsafe { $sub(self.0, other.0) })
            }
        }
        impl Mul for $name {
            type Output = Self;
            #[inline(always)]
            fn mul(self, other: Self) -> Self {
                // SAFETY: see the macro.
                $name(unsafe { $mul(self.0, other.0) })
            }
        }
        impl Div for $name {
            type Output = Self;
            #[inline(always)]
            fn div(self, other: Self) -> Self {
                // SAFETY: see the macro.
                $name(unsafe { $div(self.0, other.0) })
            }
        }
        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                let $negated = self.0;
                // SAFETY: see the macro.
                $name(unsafe { $negate })
            }
        }
        impl Vector for $name {
            type Scalar = $scalar;
            type Mask = $mask;
            const LANES: usize = $lanes;

            #[inline(always)]
            fn splat(x: $scalar) -> Self {
                // SAFETY: see the macro.
                $name(unsafe { $set(x) })
            }
            #[inline(always)]
            fn from_lanes(lanes: &[$scalar; MAX_LANES]) -> Self {
                // SAFETY: see the macro.
                $name(unsafe { $load(lanes.as_ptr()) })
            }
            #[inline(always)]
            fn to_lanes(self) -> [$scalar; MAX_LANES] {
                let mut lanes = [0.0; MAX_LANES];
                // SAFETY: see the macro.
                unsafe { $store(lanes.as_mut_ptr(), self.0) };
                lanes
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                // SAFETY: see the macro.
                $name(unsafe { $sqrt(self.0) })
            }
            #[inline(always)]
            fn abs(self) -> Self {
                let $abs_of = self.0;
                // SAFETY: see the macro.
                $name(unsafe { $abs })
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                // SAFETY: see the macro.
                $name(unsafe { $min(self.0, other.0) })
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                // SAFETY: see the macro.
                $name(unsafe { $max(self.0, other.0) })
            }
            #[inline(always)]
            fn lt(self, other: Self) -> $mask {
                let ($less_a, $less_b) = (self.0, other.0);
                // SAFETY: see the macro.
                $mask(unsafe { $less })
            }
            #[inline(always)]
            fn select(mask: $mask, yes: Self, no: Self) -> Self {
                let ($where, $yes, $no) = (mask.0, yes.0, no.0);
                // SAFETY: see the macro.
                $name(unsafe { $select })
            }
            #[inline(always)]
            fn unit_scale(self) -> Self {
                let $mirrored = self.0;
                // SAFETY: see the macro.
                $name(unsafe { $mirror })
            }
            #[inline(always)]
            unsafe fn gather4<const WIDE: bool>(
                base: *const u8,
                stride: usize,
                indices: &[u32; MAX_LANES],
            ) -> [Self; 4] {
                // SAFETY: the caller vouches for the indices; for the features see the macro.
                let [a, b, c, d] = unsafe { $gather::<WIDE>(base, stride, indices) };
                [$name(a), $name(b), $name(c), $name(d)]
            }
            #[inline(always)]
            unsafe fn gather_single<const WIDE: bool>(
                base: *const u8,
                stride: usize,
                indices: &[u32; MAX_LANES],
            ) -> Vector3<Self> {
                // SAFETY: as above.
                let [x, y, z, _] = unsafe { $gather_single::<WIDE>(base, stride, indices) };
                Vector3 { x: $name(x), y: $name(y), z: $name(z) }
            }
            #[inline(always)]
            unsafe fn scatter4<const WIDE: bool>(
                rows: [Self; 4],
                base: *mut u8,
                stride: usize,
                indices: &[u32; MAX_LANES],
            ) {
                // SAFETY: the caller vouches for the indices; for the features see the macro.
                unsafe { $scatter::<WIDE>([rows[0].0, rows[1].0, rows[2].0, rows[3].0], base, stride, indices) }
            }
        }
    };
}

macro_rules! mask {
    ($name:ident, $register:ty, |$and_a:ident, $and_b:ident| $and:expr, |$or_a:ident, $or_b:ident| $or:expr,
     |$mask:ident| $bits:expr) => {
        #[derive(Clone, Copy)]
        #[repr(transparent)]
        pub(crate) struct $name($register);
        impl Mask for $name {
            #[inline(always)]
            fn and(self, other: Self) -> Self {
                let ($and_a, $and_b) = (self.0, other.0);
                // SAFETY: see `row!`.
                #[allow(unused_unsafe)]
                $name(unsafe { $and })
            }
            #[inline(always)]
            fn or(self, other: Self) -> Self {
                let ($or_a, $or_b) = (self.0, other.0);
                // SAFETY: see `row!`.
                #[allow(unused_unsafe)]
                $name(unsafe { $or })
            }
            #[inline(always)]
            fn bits(self) -> u32 {
                let $mask = self.0;
                // SAFETY: see `row!`.
                #[allow(unused_unsafe)]
                unsafe {
                    $bits as u32
                }
            }
        }
    };
}

mask!(M32x8, __m256, |a, b| _mm256_and_ps(a, b), |a, b| _mm256_or_ps(a, b), |mask| _mm256_movemask_ps(mask));
mask!(M64x4, __m256d, |a, b| _mm256_and_pd(a, b), |a, b| _mm256_or_pd(a, b), |mask| _mm256_movemask_pd(mask));
mask!(M32x16, __mmask16, |a, b| a & b, |a, b| a | b, |mask| mask);
mask!(M64x8, __mmask8, |a, b| a & b, |a, b| a | b, |mask| mask);

// The largest power of two whose reciprocal is normal, the exponent field, and its mirror: see
// `Real::inverse_power_of_two`, whose bits these reproduce.
const LARGEST_32: f32 = f32::from_bits(253 << 23);
const LARGEST_64: f64 = f64::from_bits(2045 << 52);
const EXPONENT_32: i32 = 0x7f80_0000;
const EXPONENT_64: i64 = 0x7ff0_0000_0000_0000;
const MIRROR_32: i32 = 254 << 23;
const MIRROR_64: i64 = 2046 << 52;

row!(
    F32x8,
    __m256,
    f32,
    8,
    M32x8,
    _mm256_set1_ps,
    _mm256_add_ps,
    _mm256_sub_ps,
    _mm256_mul_ps,
    _mm256_div_ps,
    _mm256_sqrt_ps,
    _mm256_min_ps,
    _mm256_max_ps,
    _mm256_loadu_ps,
    _mm256_storeu_ps,
    |a| _mm256_andnot_ps(_mm256_set1_ps(-0.0), a),
    |a| _mm256_xor_ps(_mm256_set1_ps(-0.0), a),
    |a, b| _mm256_cmp_ps::<_CMP_LT_OQ>(a, b),
    |m, yes, no| _mm256_blendv_ps(no, yes, m),
    |a| {
        let bits = _mm256_castps_si256(_mm256_min_ps(a, _mm256_set1_ps(LARGEST_32)));
        let exponent = _mm256_and_si256(bits, _mm256_set1_epi32(EXPONENT_32));
        _mm256_castsi256_ps(_mm256_sub_epi32(_mm256_set1_epi32(MIRROR_32), exponent))
    },
    gather_f32x8,
    gather_f32x8,
    scatter_f32x8
);
row!(
    F64x4,
    __m256d,
    f64,
    4,
    M64x4,
    _mm256_set1_pd,
    _mm256_add_pd,
    _mm256_sub_pd,
    _mm256_mul_pd,
    _mm256_div_pd,
    _mm256_sqrt_pd,
    _mm256_min_pd,
    _mm256_max_pd,
    _mm256_loadu_pd,
    _mm256_storeu_pd,
    |a| _mm256_andnot_pd(_mm256_set1_pd(-0.0), a),
    |a| _mm256_xor_pd(_mm256_set1_pd(-0.0), a),
    |a, b| _mm256_cmp_pd::<_CMP_LT_OQ>(a, b),
    |m, yes, no| _mm256_blendv_pd(no, yes, m),
    |a| {
        let bits = _mm256_castpd_si256(_mm256_min_pd(a, _mm256_set1_pd(LARGEST_64)));
        let exponent = _mm256_and_si256(bits, _mm256_set1_epi64x(EXPONENT_64));
        _mm256_castsi256_pd(_mm256_sub_epi64(_mm256_set1_epi64x(MIRROR_64), exponent))
    },
    gather_f64x4,
    gather_converted_f64x4,
    scatter_f64x4
);
row!(
    F32x16,
    __m512,
    f32,
    16,
    M32x16,
    _mm512_set1_ps,
    _mm512_add_ps,
    _mm512_sub_ps,
    _mm512_mul_ps,
    _mm512_div_ps,
    _mm512_sqrt_ps,
    _mm512_min_ps,
    _mm512_max_ps,
    _mm512_loadu_ps,
    _mm512_storeu_ps,
    |a| _mm512_abs_ps(a),
    |a| _mm512_xor_ps(_mm512_set1_ps(-0.0), a),
    |a, b| _mm512_cmp_ps_mask::<_CMP_LT_OQ>(a, b),
    |m, yes, no| _mm512_mask_blend_ps(m, no, yes),
    |a| {
        let bits = _mm512_castps_si512(_mm512_min_ps(a, _mm512_set1_ps(LARGEST_32)));
        let exponent = _mm512_and_si512(bits, _mm512_set1_epi32(EXPONENT_32));
        _mm512_castsi512_ps(_mm512_sub_epi32(_mm512_set1_epi32(MIRROR_32), exponent))
    },
    gather_f32x16,
    gather_f32x16,
    scatter_f32x16
);
row!(
    F64x8,
    __m512d,
    f64,
    8,
    M64x8,
    _mm512_set1_pd,
    _mm512_add_pd,
    _mm512_sub_pd,
    _mm512_mul_pd,
    _mm512_div_pd,
    _mm512_sqrt_pd,
    _mm512_min_pd,
    _mm512_max_pd,
    _mm512_loadu_pd,
    _mm512_storeu_pd,
    |a| _mm512_abs_pd(a),
    |a| _mm512_xor_pd(_mm512_set1_pd(-0.0), a),
    |a, b| _mm512_cmp_pd_mask::<_CMP_LT_OQ>(a, b),
    |m, yes, no| _mm512_mask_blend_pd(m, no, yes),
    |a| {
        let bits = _mm512_castpd_si512(_mm512_min_pd(a, _mm512_set1_pd(LARGEST_64)));
        let exponent = _mm512_and_si512(bits, _mm512_set1_epi64(EXPONENT_64));
        _mm512_castsi512_pd(_mm512_sub_epi64(_mm512_set1_epi64(MIRROR_64), exponent))
    },
    gather_f64x8,
    gather_converted_f64x8,
    scatter_f64x8
);

/// See [`super::prefetch`].
#[inline(always)]
pub(super) fn prefetch(address: *const u8) {
    // SAFETY: a prefetch reads nothing that a program could see, and never faults.
    unsafe { _mm_prefetch::<_MM_HINT_T0>(address.cast()) };
}

/// [`super::follow_chain`] for a multiple of four links, with SSE2, which every x86-64 has.
///
/// What is wanted next stays spread over a register, so that a step waits for no move between register files: the steps of
/// one chain wait for each other, and how long a step takes is all that counts.
#[inline(always)]
pub(super) fn follow_chain<const N: usize>(keys: &[u32; N], links: &[u32; N], count: usize) -> Option<[u32; N]> {
    let mut chain = [0; N];
    // SAFETY: SSE2 is part of x86-64, and each load takes four of the N elements.
    unsafe {
        let all = |x: u32| _mm_set1_epi32(x as i32);
        let load = |row: &[u32; N], start: usize| _mm_loadu_si128(row.as_ptr().add(start).cast());
        let (one, zero, length) = (all(1), _mm_setzero_si128(), all(count as u32));
        let first = all(keys[0]);
        let mut wanted = _mm_sub_epi32(all(links[0]), one);
        let (mut failed, mut end) = (zero, zero);
        chain[0] = keys[0];
        for (step, key) in chain.iter_mut().enumerate().skip(1) {
            *key = _mm_cvtsi128_si32(wanted) as u32;
            let mut found = zero;
            for start in (0..N).step_by(4) {
                let same = _mm_cmpeq_epi32(load(keys, start), wanted);
                found = _mm_or_si128(found, _mm_and_si128(load(links, start), same));
            }
            found = _mm_or_si128(found, _mm_shuffle_epi32::<0x4e>(found));
            found = _mm_or_si128(found, _mm_shuffle_epi32::<0xb1>(found));
            let at = all(step as u32);
            let early = _mm_or_si128(_mm_cmpeq_epi32(wanted, first), _mm_cmpeq_epi32(found, zero));
            failed = _mm_or_si128(failed, _mm_and_si128(early, _mm_cmpgt_epi32(length, at)));
            end = _mm_or_si128(end, _mm_and_si128(wanted, _mm_cmpeq_epi32(length, at)));
            wanted = _mm_sub_epi32(found, one);
        }
        end = _mm_or_si128(end, _mm_and_si128(wanted, _mm_cmpeq_epi32(length, all(N as u32))));
        let closed = _mm_andnot_si128(failed, _mm_cmpeq_epi32(end, first));
        (_mm_movemask_epi8(closed) == 0xffff).then_some(chain)
    }
}
