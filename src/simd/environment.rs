//! The floating-point environment of a thread: how it rounds, what it does with subnormal numbers, which exceptions trap.
//!
//! Hosts change it. Audio and game engines flush subnormal numbers to zero, libraries for interval arithmetic leave another
//! rounding mode behind, debuggers unmask exceptions. Rust code may count on the environment that a process starts with, and so
//! do the promises of this library about bits.

/// A thread's control and status registers: MXCSR on x86 with SSE, FPCR and (in the upper half) FPSR on 64-bit ARM. On other CPUs nothing is
/// read or changed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Environment(Register);

#[cfg(target_arch = "aarch64")]
type Register = u64;
#[cfg(not(target_arch = "aarch64"))]
type Register = u32;

impl Environment {
    /// What a process starts with: to nearest, gradual underflow, no exception traps, none pending.
    pub const STANDARD: Environment =
        Environment(if cfg!(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse")) {
            0x1f80
        } else {
            0
        });

    /// The calling thread's.
    #[inline]
    pub fn current() -> Environment {
        #[cfg(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse"))]
        {
            let mut register: u32 = 0;
            // SAFETY: stores four bytes to where they are asked for, and changes no flag.
            unsafe { std::arch::asm!("stmxcsr [{}]", in(reg) &raw mut register, options(nostack, preserves_flags)) };
            Environment(register)
        }
        #[cfg(target_arch = "aarch64")]
        {
            let (control, status): (u64, u64);
            // SAFETY: reads registers that every program may read.
            unsafe {
                std::arch::asm!("mrs {}, fpcr", "mrs {}, fpsr", out(reg) control, out(reg) status, options(nostack));
            }
            Environment(control | status << 32)
        }
        #[cfg(not(any(
            all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse"),
            target_arch = "aarch64"
        )))]
        Environment(0)
    }

    /// Makes it the calling thread's.
    ///
    /// # Safety
    /// It is [`Environment::STANDARD`], or code of the host runs next. Rust code that computes with floating-point numbers may
    /// not run in any other.
    #[inline]
    pub unsafe fn establish(self) {
        #[cfg(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse"))]
        // SAFETY: the value was read from the register, or is the standard one, so it has no reserved bit.
        unsafe {
            std::arch::asm!("ldmxcsr [{}]", in(reg) &raw const self.0, options(nostack));
        }
        #[cfg(target_arch = "aarch64")]
        // SAFETY: as above.
        unsafe {
            let (control, status) = (self.0 & 0xffff_ffff, self.0 >> 32);
            std::arch::asm!("msr fpcr, {}", "msr fpsr, {}", in(reg) control, in(reg) status, options(nostack));
        }
    }
}
