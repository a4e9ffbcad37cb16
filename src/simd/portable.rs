//! The array back-end: lanes as a plain Rust array, for CPUs that have no back-end of their own.

use super::vector::{MAX_LANES, Mask, Real, Vector};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Four lanes of `S`.
#[derive(Clone, Copy)]
pub(crate) struct Lanes<S>([S; LANES]);

/// Four answers.
#[derive(Clone, Copy)]
pub(crate) struct Answers([bool; LANES]);

const LANES: usize = 4;

/// `value` of each lane. Written out: a loop in every operation takes the compiler twenty times as long as the rest of a kernel,
/// since it unrolls them one by one in functions that hold thousands.
#[inline(always)]
fn each<T>(value: impl Fn(usize) -> T) -> [T; LANES] {
    [value(0), value(1), value(2), value(3)]
}

impl Mask for Answers {
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Answers(each(|lane| self.0[lane] & other.0[lane]))
    }
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        Answers(each(|lane| self.0[lane] | other.0[lane]))
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        let [a, b, c, d] = self.0;
        a as u32 | (b as u32) << 1 | (c as u32) << 2 | (d as u32) << 3
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
        impl<S: Real> $trait for Lanes<S> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Lanes(each(|lane| $trait::$method(self.0[lane], other.0[lane])))
            }
        }
    };
}
binary!(Add, add);
binary!(Sub, sub);
binary!(Mul, mul);
binary!(Div, div);

impl<S: Real> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Lanes(each(|lane| -self.0[lane]))
    }
}

impl<S: Real> Lanes<S> {
    #[inline(always)]
    fn pick(self, other: Self, first: impl Fn(S, S) -> bool) -> Self {
        Lanes(each(|lane| {
            let (a, b) = (self.0[lane], other.0[lane]);
            if first(a, b) { a } else { b }
        }))
    }
}

impl<S: Real> Vector for Lanes<S> {
    type Scalar = S;
    type Mask = Answers;
    const LANES: usize = LANES;

    #[inline(always)]
    fn splat(x: S) -> Self {
        Lanes([x; LANES])
    }
    #[inline(always)]
    fn from_lanes(lanes: &[S; MAX_LANES]) -> Self {
        Lanes(each(|lane| lanes[lane]))
    }
    #[inline(always)]
    fn to_lanes(self) -> [S; MAX_LANES] {
        let mut lanes = [S::ZERO; MAX_LANES];
        [lanes[0], lanes[1], lanes[2], lanes[3]] = self.0;
        lanes
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Lanes(each(|lane| self.0[lane].root()))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Lanes(each(|lane| self.0[lane].magnitude()))
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
    fn lt(self, other: Self) -> Answers {
        Answers(each(|lane| self.0[lane] < other.0[lane]))
    }
    #[inline(always)]
    fn select(mask: Answers, yes: Self, no: Self) -> Self {
        Lanes(each(|lane| if mask.0[lane] { yes.0[lane] } else { no.0[lane] }))
    }
    #[inline(always)]
    fn unit_scale(self) -> Self {
        Lanes(each(|lane| self.0[lane].inverse_power_of_two()))
    }
    #[inline(always)]
    unsafe fn gather4<const WIDE: bool>(base: *const u8, stride: usize, indices: &[u32; MAX_LANES]) -> [Self; 4] {
        let rows = each(|lane| {
            // SAFETY: the caller vouches for the elements, and for their fourth scalars if `WIDE`.
            unsafe {
                let element = base.add(indices[lane] as usize * stride).cast::<S>();
                let [x, y, z] = element.cast::<[S; 3]>().read();
                [x, y, z, if WIDE { element.add(3).read() } else { S::ZERO }]
            }
        });
        let word = |word: usize| Lanes(each(|lane| rows[lane][word]));
        [word(0), word(1), word(2), word(3)]
    }

    #[inline(always)]
    unsafe fn scatter4<const WIDE: bool>(
        [x, y, z, w]: [Self; 4],
        base: *mut u8,
        stride: usize,
        indices: &[u32; MAX_LANES],
    ) {
        let store = |lane: usize| {
            // SAFETY: as above.
            unsafe {
                let element = base.add(indices[lane] as usize * stride).cast::<S>();
                if WIDE {
                    element.cast::<[S; 4]>().write([x.0[lane], y.0[lane], z.0[lane], w.0[lane]]);
                } else {
                    x.0[lane].store_relaxed(element);
                    y.0[lane].store_relaxed(element.add(1));
                    z.0[lane].store_relaxed(element.add(2));
                }
            }
        };
        each(store);
    }
}
