//! The guard of every entry point.

use super::status::{Failure, UMB_OK, umb_error, umb_status};
use crate::error::Error;
use crate::simd::Environment;
use crate::view::{is_quiet, set_quiet};
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, PanicHookInfo, catch_unwind};
use std::sync::{Once, OnceLock};

thread_local! {
    /// The floating-point environment that the host left on this thread when it called.
    static HOSTS: Cell<Environment> = const { Cell::new(Environment::STANDARD) };
}

/// Runs an entry point: no panic leaves it, nothing is printed, and a failure is reported to `error`. The body finds the standard
/// floating-point environment; the host finds its own again.
///
/// # Safety
/// `error` is null, or points to a `umb_error` of the size it claims.
pub(super) unsafe fn guard(error: *mut umb_error, body: impl FnOnce() -> Result<(), Error>) -> umb_status {
    silence_guarded_panics();
    let outer = (HOSTS.replace(Environment::current()), set_quiet(true));
    // SAFETY: the standard environment.
    unsafe { Environment::STANDARD.establish() };
    let outcome = catch_unwind(AssertUnwindSafe(body));
    let failure = match outcome {
        Ok(Ok(())) => None,
        Ok(Err(error)) => Some(Failure::Error(error)),
        Err(payload) => Some(Failure::Panic(payload)),
    };
    let status = failure.as_ref().map_or(UMB_OK, Failure::status);
    if let Some(failure) = failure {
        // SAFETY: handed on.
        unsafe { failure.report(error) };
    }
    set_quiet(outer.1);
    let host = HOSTS.replace(outer.0);
    // SAFETY: what the host had, which runs next.
    unsafe { host.establish() };
    status
}

/// Runs a function of the host's from within a [`guard`], as if the host had called it: with its own floating-point environment, of which it
/// may leave another behind, and with its own panics printed.
pub(super) fn outside<T>(function: impl FnOnce() -> T) -> T {
    let quiet = set_quiet(false);
    // SAFETY: what the host had; its function runs next.
    unsafe { HOSTS.get().establish() };
    let answer = function();
    HOSTS.set(Environment::current());
    // SAFETY: the standard environment.
    unsafe { Environment::STANDARD.establish() };
    set_quiet(quiet);
    answer
}

/// A library must not write to its host's standard error: panics that a guard will catch, on the caller's thread or on one
/// that the call started, skip the hook that prints them. All others go where they went before.
fn silence_guarded_panics() {
    type Hook = Box<dyn Fn(&PanicHookInfo<'_>) + Send + Sync>;
    static INSTALLED: Once = Once::new();
    static PREVIOUS: OnceLock<Hook> = OnceLock::new();
    // A thread that is unwinding may not set a hook; a later call will.
    if INSTALLED.is_completed() || std::thread::panicking() {
        return;
    }
    INSTALLED.call_once(|| {
        // A hook that holds nothing takes no memory.
        let _ = PREVIOUS.set(std::panic::take_hook());
        std::panic::set_hook(Box::new(|info| {
            if let (false, Some(previous)) = (is_quiet(), PREVIOUS.get()) {
                previous(info);
            }
        }));
    });
}

#[cfg(test)]
mod tests {
    use super::super::status::{UMB_ERROR_INTERNAL, UMB_NO_ELEMENT};
    use super::*;
    use crate::parallel::{Run, for_each_chunk};
    use std::ffi::CStr;

    fn message(error: &umb_error) -> &str {
        // SAFETY: the library closes messages with a NUL.
        unsafe { CStr::from_ptr(error.message.as_ptr()) }.to_str().unwrap()
    }

    /// A call whose `fault`-th of 40 chunks panics, on whichever thread has it.
    fn faulty(threads: usize, fault: usize) -> (umb_status, umb_error) {
        // SAFETY: an error may be zero.
        let mut error: umb_error = unsafe { std::mem::zeroed() };
        let body = || {
            let mut run = Run { threads, ..Run::default() };
            for_each_chunk(&mut run, 40, |claims| {
                while let Some(chunk) = claims.next() {
                    assert_ne!(chunk, fault, "injected");
                    std::thread::yield_now();
                }
            })
        };
        // SAFETY: the error is one.
        (unsafe { guard(&mut error, body) }, error)
    }

    #[test]
    fn a_panic_becomes_a_status_on_any_thread() {
        for threads in [1, 2, 7] {
            for fault in 0..40 {
                let (status, error) = faulty(threads, fault);
                assert_eq!((status, error.status, error.element), (UMB_ERROR_INTERNAL, status, UMB_NO_ELEMENT));
                assert!(message(&error).starts_with("defect in umbilic, please report: "), "{}", message(&error));
                assert!(message(&error).contains("injected"), "{}", message(&error));
                // The next call is as good as ever.
                assert_eq!(faulty(threads, 40).0, UMB_OK);
                assert!(!is_quiet());
            }
        }
    }

    #[test]
    fn a_call_within_a_callback_of_a_call() {
        let inner = || {
            outside(|| assert_eq!(faulty(2, 3).0, UMB_ERROR_INTERNAL));
            assert!(is_quiet());
            Ok(())
        };
        // SAFETY: no error is asked for.
        assert_eq!(unsafe { guard(std::ptr::null_mut(), inner) }, UMB_OK);
    }

    /// Runs in a process of its own, whose output is looked at.
    #[test]
    fn nothing_is_printed() {
        let name = "capi::guard::tests::a_panic_becomes_a_status_on_any_thread";
        let mut command = std::process::Command::new(std::env::current_exe().unwrap());
        let output = command.args(["--exact", name, "--nocapture"]).output().unwrap();
        let printed = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success() && !printed.contains("injected"), "{printed}");
    }
}
