//! Which library this is.

use crate::simd::Level;
use libc::c_char;

/// The version of the library, `"0.1.0"`. Static.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub extern "C" fn umb_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// The number of the binary interface, `UMB_ABI_VERSION` of the header it was built with: a program runs with any library
/// that has the number of its header.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub extern "C" fn umb_abi_version() -> u32 {
    ABI_VERSION
}

/// Raised when, and only when, a program built against an older header would break.
pub(crate) const ABI_VERSION: u32 = 0;

macro_rules! info {
    ($level:literal) => {
        concat!("umbilic ", env!("CARGO_PKG_VERSION"), ", vectors: ", $level, "\0").as_ptr().cast()
    };
}

/// Name, version and the vectors that calls use by default, in one line for logs: the widest that the CPU has, or those that
/// the environment variable `UMBILIC_SIMD` (`portable`, `avx2`, `avx512`) names if they are narrower. Static.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub extern "C" fn umb_build_info() -> *const c_char {
    match Level::best().name() {
        "avx512" => info!("avx512"),
        "avx2" => info!("avx2"),
        _ => info!("portable"),
    }
}
