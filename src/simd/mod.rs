//! Lanes: the vector types that every kernel is written over, and the choice of the widest one the CPU has.
//!
//! A kernel is one generic source over [`Vector`]. It is instantiated once per [`Width`] inside a function that
//! carries the CPU features of that width, and [`dispatch`] picks one of them per call. Each lane does exactly
//! the IEEE operations that a scalar would do, in the same order, so the width never changes a bit of a result.
//!
//! Everything on the way from [`Task::run`] down to an intrinsic must be `#[inline(always)]`: a call that is not
//! inlined loses the CPU features and becomes several times slower.

mod environment;
mod math;
mod portable;
mod vector;
#[cfg(target_arch = "x86_64")]
mod x86;
#[cfg(target_arch = "x86_64")]
mod x86_memory;

use std::sync::OnceLock;
#[cfg(unix)]
use std::{ffi::CStr, ptr::NonNull};

pub(crate) use environment::Environment;
pub(crate) use math::{atan2_and_reciprocal, tangent_parts};
pub(crate) use vector::{MAX_LANES, Mask, Real, Vector, Vector3, as_lanes, each};

/// The instruction sets a call may use, narrowest first.
///
/// A value above [`Level::PORTABLE`] exists only where the CPU was seen to have it, because [`Level::best`] and
/// [`Level::capped`] are the only ways to get one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Level(Kind);

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Level {
    /// Plain Rust arrays, on any CPU.
    pub const PORTABLE: Level = Level(Kind::Portable);

    /// The widest level of this CPU, or the one that the environment variable `UMBILIC_SIMD` names if that is narrower; the
    /// variable is read once in the life of a process, and any other value of it has no effect.
    pub fn best() -> Level {
        static BEST: OnceLock<Level> = OnceLock::new();
        *BEST.get_or_init(|| {
            // Not by the standard library, which allocates.
            // SAFETY: a string of the C library's that ends with a NUL; a host that changes its environment meanwhile races with every
            // reader of it, as it knows.
            #[cfg(unix)]
            let cap = unsafe {
                let name = NonNull::new(libc::getenv(c"UMBILIC_SIMD".as_ptr()));
                name.and_then(|name| Level::named(CStr::from_ptr(name.as_ptr()).to_str().ok()?))
            };
            #[cfg(not(unix))]
            let cap = std::env::var("UMBILIC_SIMD").ok().and_then(|name| Level::named(&name));
            cap.map_or(Level::detected(), |cap| cap.min(Level::detected()))
        })
    }

    fn detected() -> Level {
        #[cfg(target_arch = "x86_64")]
        {
            // Every feature that the functions of a level are compiled with: a virtual machine may mask any of them.
            let avx2 = is_x86_feature_detected!("avx2")
                && is_x86_feature_detected!("bmi1")
                && is_x86_feature_detected!("bmi2")
                && is_x86_feature_detected!("popcnt")
                && is_x86_feature_detected!("lzcnt");
            let avx512 = is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512bw")
                && is_x86_feature_detected!("avx512vl");
            Level(match (avx2, avx512) {
                (true, true) => Kind::Avx512,
                (true, false) => Kind::Avx2,
                _ => Kind::Portable,
            })
        }
        #[cfg(not(target_arch = "x86_64"))]
        Level(Kind::Portable)
    }

    /// Every level up to [`Level::best`], narrowest first.
    pub fn all() -> Vec<Level> {
        [
            Kind::Portable,
            #[cfg(target_arch = "x86_64")]
            Kind::Avx2,
            #[cfg(target_arch = "x86_64")]
            Kind::Avx512,
        ]
        .into_iter()
        .map(Level)
        .filter(|level| *level <= Level::best())
        .collect()
    }

    /// The widest of [`Level::all`] that is not above the level called `name`; `None` for an unknown name.
    pub fn capped(name: &str) -> Option<Level> {
        Level::named(name).map(|cap| cap.min(Level::best()))
    }

    /// What a name stands for, whether the CPU has it or not.
    fn named(name: &str) -> Option<Level> {
        Some(Level(match name {
            // What is portable uses SSE2 where that is part of every CPU: by hand it was no faster.
            "portable" | "sse2" => Kind::Portable,
            #[cfg(target_arch = "x86_64")]
            "avx2" => Kind::Avx2,
            #[cfg(target_arch = "x86_64")]
            "avx512" => Kind::Avx512,
            #[cfg(not(target_arch = "x86_64"))]
            "avx2" | "avx512" => Kind::Portable,
            _ => return None,
        }))
    }

    /// `"portable"`, `"avx2"` or `"avx512"`.
    pub fn name(self) -> &'static str {
        match self.0 {
            Kind::Portable => "portable",
            #[cfg(target_arch = "x86_64")]
            Kind::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            Kind::Avx512 => "avx512",
        }
    }
}

/// Follows a chain through `count` of `N` links: from each key to its link minus one, which is the next key, the first key
/// first. Answers with the keys in that order if the chain is back at the first after `count` steps and not before;
/// then it went through all of them, and no two keys are equal. Keys beyond `count` are `u32::MAX`, which is no link.
///
/// Every step looks at all keys, without a branch: a search would mispredict more than it saves.
#[inline(always)]
pub(crate) fn follow_chain<const N: usize>(keys: &[u32; N], links: &[u32; N], count: usize) -> Option<[u32; N]> {
    #[cfg(target_arch = "x86_64")]
    if N.is_multiple_of(4) {
        return x86::follow_chain(keys, links, count);
    }
    portable::follow_chain(keys, links, count)
}

/// Fetches the cache line of an address ahead of its use; any address will do.
#[inline(always)]
pub(crate) fn prefetch(address: *const u8) {
    #[cfg(target_arch = "x86_64")]
    x86::prefetch(address);
    #[cfg(not(target_arch = "x86_64"))]
    let _ = address;
}

/// The pair of vector types that a level works with.
pub(crate) trait Width {
    /// Lanes of `f32`.
    type Single: Vector<Scalar = f32>;
    /// Lanes of `f64`.
    type Double: Vector<Scalar = f64>;

    /// Runs `task`, which must be within a task of the same width, in a function of its own that has the width's
    /// features. What many callers share is so compiled once.
    fn call<T: Task>(task: T)
    where
        Self: Sized;
}

/// Work that is compiled once per [`Width`].
pub(crate) trait Task {
    /// Does the work; implementations are `#[inline(always)]`.
    fn run<W: Width>(self);
}

struct Portable;
impl Width for Portable {
    type Single = portable::Lanes<f32>;
    type Double = portable::Lanes<f64>;

    #[inline(never)]
    fn call<T: Task>(task: T) {
        task.run::<Portable>();
    }
}

#[cfg(target_arch = "x86_64")]
mod widths {
    use super::{Task, Width, x86};

    pub struct Avx2;
    impl Width for Avx2 {
        type Single = x86::F32x8;
        type Double = x86::F64x4;

        #[inline(always)]
        fn call<T: Task>(task: T) {
            // SAFETY: this width is only ever met within `run_avx2`.
            unsafe { run_avx2(task) };
        }
    }
    pub struct Avx512;
    impl Width for Avx512 {
        type Single = x86::F32x16;
        type Double = x86::F64x8;

        #[inline(always)]
        fn call<T: Task>(task: T) {
            // SAFETY: this width is only ever met within `run_avx512`.
            unsafe { run_avx512(task) };
        }
    }

    #[inline(never)]
    #[target_feature(enable = "avx2,bmi1,bmi2,popcnt,lzcnt")]
    pub fn run_avx2<T: Task>(task: T) {
        task.run::<Avx2>();
    }
    #[inline(never)]
    #[target_feature(enable = "avx512f,avx512dq,avx512bw,avx512vl,avx2,bmi1,bmi2,popcnt,lzcnt")]
    pub fn run_avx512<T: Task>(task: T) {
        task.run::<Avx512>();
    }
}

/// Runs `task` with the vectors of `level`.
pub(crate) fn dispatch<T: Task>(level: Level, task: T) {
    match level.0 {
        Kind::Portable => task.run::<Portable>(),
        // SAFETY: a `Level` of this kind exists only where the CPU was seen to have these features.
        #[cfg(target_arch = "x86_64")]
        Kind::Avx2 => unsafe { widths::run_avx2(task) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        Kind::Avx512 => unsafe { widths::run_avx512(task) },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Chains of every kind, and what the back-ends make of them.
    #[test]
    fn back_ends_follow_the_same_chains() {
        let mut state = 1u64;
        let mut below = |limit: u64| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) % limit
        };
        let mut closed = 0;
        for _ in 0..200_000 {
            let count = 1 + below(16) as usize;
            // A cycle through a few keys in random order, sometimes spoilt.
            let mut cycle: Vec<u32> = (0..count as u32).map(|key| key * 3).collect();
            for i in (1..count).rev() {
                cycle.swap(i, below(i as u64 + 1) as usize);
            }
            let (mut keys, mut links) = ([u32::MAX; 16], [7u32; 16]);
            for (slot, &key) in cycle.iter().enumerate() {
                keys[slot] = key;
                links[slot] = (cycle.iter().position(|&other| other == key).map(|at| cycle[(at + 1) % count]))
                    .map_or(0, |next| next + 1);
            }
            for i in (1..count).rev() {
                let other = 1 + below(i as u64) as usize;
                keys.swap(i, other);
                links.swap(i, other);
            }
            if below(2) == 0 {
                keys[below(count as u64) as usize] = below(48) as u32;
            }
            if below(3) == 0 {
                links[below(count as u64) as usize] = 1 + below(48) as u32;
            }
            let expected = portable::follow_chain(&keys, &links, count);
            let found = follow_chain(&keys, &links, count);
            assert_eq!(found.map(|chain| chain[..count].to_vec()), expected.map(|chain| chain[..count].to_vec()));
            closed += found.is_some() as usize;
        }
        assert!((20_000..180_000).contains(&closed), "{closed}");
    }
}
