//! The array back-end: lanes as a plain Rust array, for CPUs that have no back-end of their own.

use super::vector::{self, MAX_LANES, Mask, Real, Vector, Vector3};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// `N` lanes of `S`.
#[derive(Clone, Copy)]
pub(crate) struct Lanes<S, const N: usize>([S; N]);

/// `N` answers.
#[derive(Clone, Copy)]
pub(crate) struct Answers<const N: usize>([bool; N]);

/// As [`vector::each`]. Under a fuzzer, whose checks stay in every loop, a function of its own: the compiler takes half an hour for
/// kernels with thousands of them.
#[cfg_attr(not(fuzzing), inline(always))]
#[cfg_attr(fuzzing, inline(never))]
fn each<T: Copy, const N: usize>(start: T, value: impl FnMut(usize) -> T) -> [T; N] {
    vector::each(start, value)
}

impl<const N: usize> Mask for Answers<N> {
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Answers(each(false, |lane| self.0[lane] & other.0[lane]))
    }
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        Answers(each(false, |lane| self.0[lane] | other.0[lane]))
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        self.0.iter().enumerate().fold(0, |bits, (lane, yes)| bits | (*yes as u32) << lane)
    }
}

/// [`super::follow_chain`] in plain Rust.
#[cfg_attr(target_arch = "x86_64", allow(dead_code))]
pub(super) fn follow_chain<const N: usize>(keys: &[u32; N], links: &[u32; N], count: usize) -> Option<[u32; N]> {
    let mut chain = [keys[0]; N];
    let mut wanted = links[0].wrapping_sub(1);
    for place in &mut chain[1..count] {
        let found =
            keys.iter().zip(links).fold(0, |found, (key, link)| found | if *key == wanted { *link } else { 0 });
        if wanted == keys[0] || found == 0 {
            return None;
        }
        *place = std::mem::replace(&mut wanted, found - 1);
    }
    (wanted == keys[0]).then_some(chain)
}

macro_rules! binary {
    ($trait:ident, $method:ident) => {
        impl<S: Real, const N: usize> $trait for Lanes<S, N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Lanes(each(S::ZERO, |lane| $trait::$method(self.0[lane], other.0[lane])))
            }
        }
    };
}
binary!(Add, add);
binary!(Sub, sub);
binary!(Mul, mul);
binary!(Div, div);

impl<S: Real, const N: usize> Neg for Lanes<S, N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Lanes(each(S::ZERO, |lane| -self.0[lane]))
    }
}

impl<S: Real, const N: usize> Lanes<S, N> {
    #[inline(always)]
    fn pick(self, other: Self, first: impl Fn(S, S) -> bool) -> Self {
        Lanes(each(S::ZERO, |lane| {
            let (a, b) = (self.0[lane], other.0[lane]);
            if first(a, b) { a } else { b }
        }))
    }
}

impl<S: Real, const N: usize> Vector for Lanes<S, N> {
    type Scalar = S;
    type Mask = Answers<N>;
    const LANES: usize = N;

    #[inline(always)]
    fn splat(x: S) -> Self {
        Lanes([x; N])
    }
    #[inline(always)]
    fn from_lanes(lanes: &[S; MAX_LANES]) -> Self {
        Lanes(each(S::ZERO, |lane| lanes[lane]))
    }
    #[inline(always)]
    fn to_lanes(self) -> [S; MAX_LANES] {
        let mut lanes = [S::ZERO; MAX_LANES];
        lanes[..N].copy_from_slice(&self.0);
        lanes
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Lanes(each(S::ZERO, |lane| self.0[lane].root()))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Lanes(each(S::ZERO, |lane| self.0[lane].magnitude()))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.pick(other, |a, b| a < b)
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.pick(other, |a, b| a > b)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Answers<N> {
        Answers(each(false, |lane| self.0[lane] < other.0[lane]))
    }
    #[inline(always)]
    fn select(mask: Answers<N>, yes: Self, no: Self) -> Self {
        Lanes(each(S::ZERO, |lane| if mask.0[lane] { yes.0[lane] } else { no.0[lane] }))
    }
    #[inline(always)]
    fn unit_scale(self) -> Self {
        Lanes(each(S::ZERO, |lane| self.0[lane].inverse_power_of_two()))
    }
    #[inline(always)]
    unsafe fn gather<const WIDE: bool>(base: *const u8, stride: usize, indices: &[u32; MAX_LANES]) -> Vector3<Self> {
        let points: [[S; 3]; N] = each([S::ZERO; 3], |lane| {
            // SAFETY: the caller vouches for the indices, the base and the stride.
            unsafe { base.add(indices[lane] as usize * stride).cast::<[S; 3]>().read() }
        });
        Vector3 {
            x: Lanes(each(S::ZERO, |lane| points[lane][0])),
            y: Lanes(each(S::ZERO, |lane| points[lane][1])),
            z: Lanes(each(S::ZERO, |lane| points[lane][2])),
        }
    }
}
