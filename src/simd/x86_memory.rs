//! Loads and stores of points and rows for the x86-64 back-ends: lanes are elements anywhere in memory, registers their
//! components.
//!
//! A load into a quarter of a register needs no shuffle, so elements are first laid side by side and then transposed four by
//! four. Elements that need no shuffle to reach their place are what makes a gather cheap.

use super::vector::MAX_LANES;
use std::arch::x86_64::*;

// SAFETY of every `unsafe` block here: the callers of `Vector::gather` and `Vector::scatter` vouch that the elements they name
// may be read or written, and that the fourth scalar of one may be too where it is touched; for the CPU features see
// `x86::row!`. Whatever else happens are moves between registers.

/// The address of element `index`.
#[inline(always)]
unsafe fn at<S>(base: *const u8, stride: usize, index: u32) -> *const S {
    // SAFETY: inside the array.
    unsafe { base.add(index as usize * stride).cast() }
}

/// The three scalars at `element`, and a fourth: the next one if `WIDE`, else whatever.
#[inline(always)]
unsafe fn load_f32<const WIDE: bool>(element: *const f32) -> __m128 {
    // SAFETY: see above; a narrow load takes two scalars and one.
    unsafe {
        if WIDE {
            _mm_loadu_ps(element)
        } else {
            // The load of two takes any alignment; that of a double would not.
            _mm_movelh_ps(_mm_castsi128_ps(_mm_loadl_epi64(element.cast())), _mm_load_ss(element.add(2)))
        }
    }
}

/// As [`load_f32`].
#[inline(always)]
unsafe fn load_f64<const WIDE: bool>(element: *const f64) -> __m256d {
    // SAFETY: as there.
    unsafe {
        if WIDE {
            _mm256_loadu_pd(element)
        } else {
            _mm256_insertf128_pd::<1>(_mm256_castpd128_pd256(_mm_loadu_pd(element)), _mm_load_sd(element.add(2)))
        }
    }
}

/// As [`load_f64`], of scalars in single precision.
#[inline(always)]
unsafe fn load_converted<const WIDE: bool>(element: *const f32) -> __m256d {
    // SAFETY: as there.
    unsafe { _mm256_cvtps_pd(load_f32::<WIDE>(element)) }
}

/// Stores the first three scalars as relaxed atomic stores of each would, or all four as plain memory if `WIDE`.
///
/// x86 never tears an aligned scalar, and what assembly stores is no data race beyond what the hardware makes of it.
#[inline(always)]
unsafe fn store_f32<const WIDE: bool>(row: __m128, element: *mut f32) {
    // SAFETY: see above.
    unsafe {
        if WIDE {
            _mm_storeu_ps(element, row);
        } else {
            std::arch::asm!(
                "vmovlps qword ptr [{element}], {row}",
                "vextractps dword ptr [{element} + 8], {row}, 2",
                element = in(reg) element,
                row = in(xmm_reg) row,
                options(nostack, preserves_flags)
            );
        }
    }
}

/// As [`store_f32`].
#[inline(always)]
unsafe fn store_f64<const WIDE: bool>(row: __m256d, element: *mut f64) {
    // SAFETY: see above.
    unsafe {
        if WIDE {
            _mm256_storeu_pd(element, row);
        } else {
            std::arch::asm!(
                "vmovupd xmmword ptr [{element}], {low}",
                "vmovlpd qword ptr [{element} + 16], {high}",
                element = in(reg) element,
                low = in(xmm_reg) _mm256_castpd256_pd128(row),
                high = in(xmm_reg) _mm256_extractf128_pd::<1>(row),
                options(nostack, preserves_flags)
            );
        }
    }
}

/// Four by four scalars transposed within each half.
#[inline(always)]
unsafe fn transposed_f32x8([a, b, c, d]: [__m256; 4]) -> [__m256; 4] {
    // SAFETY: see above.
    unsafe {
        let (low_ab, high_ab) = (_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
        let (low_cd, high_cd) = (_mm256_unpacklo_ps(c, d), _mm256_unpackhi_ps(c, d));
        [
            _mm256_shuffle_ps::<0x44>(low_ab, low_cd),
            _mm256_shuffle_ps::<0xee>(low_ab, low_cd),
            _mm256_shuffle_ps::<0x44>(high_ab, high_cd),
            _mm256_shuffle_ps::<0xee>(high_ab, high_cd),
        ]
    }
}

/// Four by four scalars transposed within each quarter.
#[inline(always)]
unsafe fn transposed_f32x16([a, b, c, d]: [__m512; 4]) -> [__m512; 4] {
    // SAFETY: see above.
    unsafe {
        let (low_ab, high_ab) = (_mm512_unpacklo_ps(a, b), _mm512_unpackhi_ps(a, b));
        let (low_cd, high_cd) = (_mm512_unpacklo_ps(c, d), _mm512_unpackhi_ps(c, d));
        [
            _mm512_shuffle_ps::<0x44>(low_ab, low_cd),
            _mm512_shuffle_ps::<0xee>(low_ab, low_cd),
            _mm512_shuffle_ps::<0x44>(high_ab, high_cd),
            _mm512_shuffle_ps::<0xee>(high_ab, high_cd),
        ]
    }
}

/// Four by four scalars transposed.
#[inline(always)]
unsafe fn transposed_f64x4([a, b, c, d]: [__m256d; 4]) -> [__m256d; 4] {
    // SAFETY: see above.
    unsafe {
        let (even_ab, odd_ab) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
        let (even_cd, odd_cd) = (_mm256_unpacklo_pd(c, d), _mm256_unpackhi_pd(c, d));
        [
            _mm256_permute2f128_pd::<0x20>(even_ab, even_cd),
            _mm256_permute2f128_pd::<0x20>(odd_ab, odd_cd),
            _mm256_permute2f128_pd::<0x31>(even_ab, even_cd),
            _mm256_permute2f128_pd::<0x31>(odd_ab, odd_cd),
        ]
    }
}

/// Four by four scalars transposed within each half.
#[inline(always)]
unsafe fn transposed_f64x8([a, b, c, d]: [__m512d; 4]) -> [__m512d; 4] {
    // SAFETY: see above.
    unsafe {
        let first = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0);
        let second = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
        let (even_ab, odd_ab) = (_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b));
        let (even_cd, odd_cd) = (_mm512_unpacklo_pd(c, d), _mm512_unpackhi_pd(c, d));
        [
            _mm512_permutex2var_pd(even_ab, first, even_cd),
            _mm512_permutex2var_pd(odd_ab, first, odd_cd),
            _mm512_permutex2var_pd(even_ab, second, even_cd),
            _mm512_permutex2var_pd(odd_ab, second, odd_cd),
        ]
    }
}

#[inline(always)]
pub(super) unsafe fn gather_f32x8<const WIDE: bool>(
    base: *const u8,
    stride: usize,
    i: &[u32; MAX_LANES],
) -> [__m256; 4] {
    // SAFETY: see above.
    unsafe {
        macro_rules! halves {
            ($low:literal, $high:literal) => {
                _mm256_insertf128_ps::<1>(
                    _mm256_castps128_ps256(load_f32::<WIDE>(at(base, stride, i[$low]))),
                    load_f32::<WIDE>(at(base, stride, i[$high])),
                )
            };
        }
        transposed_f32x8([halves!(0, 4), halves!(1, 5), halves!(2, 6), halves!(3, 7)])
    }
}

#[inline(always)]
pub(super) unsafe fn gather_f32x16<const WIDE: bool>(
    base: *const u8,
    stride: usize,
    i: &[u32; MAX_LANES],
) -> [__m512; 4] {
    // SAFETY: see above.
    unsafe {
        macro_rules! quarters {
            ($a:literal, $b:literal, $c:literal, $d:literal) => {{
                let row = _mm512_castps128_ps512(load_f32::<WIDE>(at(base, stride, i[$a])));
                let row = _mm512_insertf32x4::<1>(row, load_f32::<WIDE>(at(base, stride, i[$b])));
                let row = _mm512_insertf32x4::<2>(row, load_f32::<WIDE>(at(base, stride, i[$c])));
                _mm512_insertf32x4::<3>(row, load_f32::<WIDE>(at(base, stride, i[$d])))
            }};
        }
        transposed_f32x16([
            quarters!(0, 4, 8, 12),
            quarters!(1, 5, 9, 13),
            quarters!(2, 6, 10, 14),
            quarters!(3, 7, 11, 15),
        ])
    }
}

#[inline(always)]
pub(super) unsafe fn gather_f64x4<const WIDE: bool>(
    base: *const u8,
    stride: usize,
    i: &[u32; MAX_LANES],
) -> [__m256d; 4] {
    // SAFETY: see above.
    unsafe {
        transposed_f64x4([
            load_f64::<WIDE>(at(base, stride, i[0])),
            load_f64::<WIDE>(at(base, stride, i[1])),
            load_f64::<WIDE>(at(base, stride, i[2])),
            load_f64::<WIDE>(at(base, stride, i[3])),
        ])
    }
}

/// As [`gather_f64x4`], from single precision.
#[inline(always)]
pub(super) unsafe fn gather_converted_f64x4<const WIDE: bool>(
    base: *const u8,
    stride: usize,
    i: &[u32; MAX_LANES],
) -> [__m256d; 4] {
    // SAFETY: see above.
    unsafe {
        transposed_f64x4([
            load_converted::<WIDE>(at(base, stride, i[0])),
            load_converted::<WIDE>(at(base, stride, i[1])),
            load_converted::<WIDE>(at(base, stride, i[2])),
            load_converted::<WIDE>(at(base, stride, i[3])),
        ])
    }
}

#[inline(always)]
pub(super) unsafe fn gather_f64x8<const WIDE: bool>(
    base: *const u8,
    stride: usize,
    i: &[u32; MAX_LANES],
) -> [__m512d; 4] {
    // SAFETY: see above.
    unsafe {
        macro_rules! halves {
            ($low:literal, $high:literal) => {
                _mm512_insertf64x4::<1>(
                    _mm512_castpd256_pd512(load_f64::<WIDE>(at(base, stride, i[$low]))),
                    load_f64::<WIDE>(at(base, stride, i[$high])),
                )
            };
        }
        transposed_f64x8([halves!(0, 4), halves!(1, 5), halves!(2, 6), halves!(3, 7)])
    }
}

/// As [`gather_f64x8`], from single precision.
#[inline(always)]
pub(super) unsafe fn gather_converted_f64x8<const WIDE: bool>(
    base: *const u8,
    stride: usize,
    i: &[u32; MAX_LANES],
) -> [__m512d; 4] {
    // SAFETY: see above.
    unsafe {
        macro_rules! halves {
            ($low:literal, $high:literal) => {
                _mm512_insertf64x4::<1>(
                    _mm512_castpd256_pd512(load_converted::<WIDE>(at(base, stride, i[$low]))),
                    load_converted::<WIDE>(at(base, stride, i[$high])),
                )
            };
        }
        transposed_f64x8([halves!(0, 4), halves!(1, 5), halves!(2, 6), halves!(3, 7)])
    }
}

#[inline(always)]
pub(super) unsafe fn scatter_f32x8<const WIDE: bool>(
    rows: [__m256; 4],
    base: *mut u8,
    stride: usize,
    i: &[u32; MAX_LANES],
) {
    // SAFETY: see above.
    unsafe {
        let rows = transposed_f32x8(rows);
        macro_rules! store {
            ($row:literal, $low:literal, $high:literal) => {
                store_f32::<WIDE>(_mm256_castps256_ps128(rows[$row]), at::<f32>(base, stride, i[$low]).cast_mut());
                let high = _mm256_extractf128_ps::<1>(rows[$row]);
                store_f32::<WIDE>(high, at::<f32>(base, stride, i[$high]).cast_mut());
            };
        }
        store!(0, 0, 4);
        store!(1, 1, 5);
        store!(2, 2, 6);
        store!(3, 3, 7);
    }
}

#[inline(always)]
pub(super) unsafe fn scatter_f32x16<const WIDE: bool>(
    rows: [__m512; 4],
    base: *mut u8,
    stride: usize,
    i: &[u32; MAX_LANES],
) {
    // SAFETY: see above.
    unsafe {
        let rows = transposed_f32x16(rows);
        macro_rules! store {
            ($row:literal, $quarter:literal, $lane:literal) => {
                let quarter = _mm512_extractf32x4_ps::<$quarter>(rows[$row]);
                store_f32::<WIDE>(quarter, at::<f32>(base, stride, i[$lane]).cast_mut());
            };
        }
        macro_rules! stores {
            ($row:literal: $a:literal $b:literal $c:literal $d:literal) => {
                store!($row, 0, $a);
                store!($row, 1, $b);
                store!($row, 2, $c);
                store!($row, 3, $d);
            };
        }
        stores!(0: 0 4 8 12);
        stores!(1: 1 5 9 13);
        stores!(2: 2 6 10 14);
        stores!(3: 3 7 11 15);
    }
}

#[inline(always)]
pub(super) unsafe fn scatter_f64x4<const WIDE: bool>(
    rows: [__m256d; 4],
    base: *mut u8,
    stride: usize,
    i: &[u32; MAX_LANES],
) {
    // SAFETY: see above.
    unsafe {
        let [a, b, c, d] = transposed_f64x4(rows);
        store_f64::<WIDE>(a, at::<f64>(base, stride, i[0]).cast_mut());
        store_f64::<WIDE>(b, at::<f64>(base, stride, i[1]).cast_mut());
        store_f64::<WIDE>(c, at::<f64>(base, stride, i[2]).cast_mut());
        store_f64::<WIDE>(d, at::<f64>(base, stride, i[3]).cast_mut());
    }
}

#[inline(always)]
pub(super) unsafe fn scatter_f64x8<const WIDE: bool>(
    rows: [__m512d; 4],
    base: *mut u8,
    stride: usize,
    i: &[u32; MAX_LANES],
) {
    // SAFETY: see above.
    unsafe {
        let rows = transposed_f64x8(rows);
        macro_rules! store {
            ($row:literal, $low:literal, $high:literal) => {
                store_f64::<WIDE>(_mm512_castpd512_pd256(rows[$row]), at::<f64>(base, stride, i[$low]).cast_mut());
                let high = _mm512_extractf64x4_pd::<1>(rows[$row]);
                store_f64::<WIDE>(high, at::<f64>(base, stride, i[$high]).cast_mut());
            };
        }
        store!(0, 0, 4);
        store!(1, 1, 5);
        store!(2, 2, 6);
        store!(3, 3, 7);
    }
}
