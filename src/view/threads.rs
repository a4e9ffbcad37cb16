//! Threads that lend a hand for the length of a call.
//!
//! The threads of the standard library allocate as they start, and end the process if there is no memory. A library must
//! not; so on Unix these are the system's own, started without an allocation of ours.

use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Mutex, PoisonError};

thread_local! {
    static QUIET: Cell<bool> = const { Cell::new(false) };
}

/// Whether a panic on this thread will be caught at a door of the library, and need not be printed. Threads that a call
/// starts inherit it.
pub(crate) fn is_quiet() -> bool {
    QUIET.get()
}

/// Sets [`is_quiet`]; answers with what it was.
pub(crate) fn set_quiet(quiet: bool) -> bool {
    QUIET.replace(quiet)
}

/// Runs `other` on up to `threads - 1` threads, and `own` on this one. A panic of any of them goes on here.
pub(crate) fn with_threads(threads: usize, other: impl Fn() + Sync, own: impl FnOnce()) {
    if threads <= 1 {
        return own();
    }
    let quiet = is_quiet();
    let other = || {
        set_quiet(quiet);
        other();
    };
    // A system that has no more threads to give leaves the work to those there are.
    with_helpers(threads - 1, &other, own);
}

/// Has `work` done on each of `parts` by up to `threads` threads.
pub(crate) fn for_each_part<T: Send>(threads: usize, parts: impl Iterator<Item = T> + Send, work: impl Fn(T) + Sync) {
    let parts = Mutex::new(parts);
    let work = || {
        loop {
            let claimed = parts.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some(part) = claimed else { break };
            work(part);
        }
    };
    with_threads(threads, work, work);
}

/// What the threads do, and the first panic of any of them.
struct Job<'a> {
    work: &'a (dyn Fn() + Sync),
    panic: Mutex<Option<Box<dyn Any + Send>>>,
}

impl Job<'_> {
    fn run(&self) {
        if let Err(payload) = catch_unwind(AssertUnwindSafe(self.work)) {
            self.panic.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(payload);
        }
    }
}

/// Runs `work` on up to `count` threads besides this one, and `own` on this one; as many start as the system has to give. All
/// have ended when this returns. A panic of any of them goes on here.
fn with_helpers(count: usize, work: &(dyn Fn() + Sync), own: impl FnOnce()) {
    let job = Job { work, panic: Mutex::new(None) };
    run_beside(&job, count, own);
    if let Some(payload) = job.panic.into_inner().unwrap_or_else(PoisonError::into_inner) {
        resume_unwind(payload);
    }
}

#[cfg(not(unix))]
fn run_beside(job: &Job<'_>, count: usize, own: impl FnOnce()) {
    std::thread::scope(|scope| {
        for _ in 0..count {
            if std::thread::Builder::new().spawn_scoped(scope, || job.run()).is_err() {
                break;
            }
        }
        own();
    });
}

#[cfg(unix)]
fn run_beside(job: &Job<'_>, count: usize, own: impl FnOnce()) {
    let mut helpers = unix::Helpers::none();
    // SAFETY: `helpers` is dropped before the job is, also if `own` panics.
    unsafe { helpers.start(job, count) };
    own();
}

#[cfg(unix)]
mod unix {
    use super::Job;
    use std::mem::MaybeUninit;

    /// No call starts more.
    const MOST: usize = 255;

    /// As much stack as the standard library gives; some systems give far less by themselves.
    const STACK: usize = 2 << 20;

    /// Threads that run a job. Dropping it waits for their end.
    pub struct Helpers {
        threads: [MaybeUninit<libc::pthread_t>; MOST],
        count: usize,
    }

    extern "C" fn run(job: *mut libc::c_void) -> *mut libc::c_void {
        #[cfg(any(target_os = "linux", target_os = "android"))]
        // SAFETY: gives this very thread a name, for debuggers and profilers.
        unsafe {
            libc::prctl(libc::PR_SET_NAME, c"umbilic".as_ptr())
        };
        // SAFETY: a job that lives until this thread has ended, as `start` asks.
        unsafe { &*job.cast::<Job<'_>>().cast_const() }.run();
        std::ptr::null_mut()
    }

    impl Helpers {
        pub fn none() -> Self {
            Helpers { threads: [const { MaybeUninit::uninit() }; MOST], count: 0 }
        }

        /// Starts up to `count` threads. They take no signal that is meant for the process, but those that faults raise: a host's
        /// handlers run on the host's own threads.
        ///
        /// # Safety
        /// The job must live until `self` has been dropped.
        pub unsafe fn start(&mut self, job: &Job<'_>, count: usize) {
            let job = (&raw const *job).cast_mut().cast();
            // SAFETY: attributes and signal masks are filled before they are used; a thread counts only if it has started.
            unsafe {
                let mut attributes = MaybeUninit::uninit();
                if libc::pthread_attr_init(attributes.as_mut_ptr()) != 0 {
                    return;
                }
                libc::pthread_attr_setstacksize(attributes.as_mut_ptr(), STACK);
                let (mut blocked, mut before) = (MaybeUninit::uninit(), MaybeUninit::uninit());
                libc::sigfillset(blocked.as_mut_ptr());
                // What a thread's own instructions raise (and a sandbox, where it emulates system calls) would end the process
                // without a word if it were blocked.
                for fault in [libc::SIGSEGV, libc::SIGBUS, libc::SIGFPE, libc::SIGILL, libc::SIGTRAP, libc::SIGSYS] {
                    libc::sigdelset(blocked.as_mut_ptr(), fault);
                }
                if libc::pthread_sigmask(libc::SIG_BLOCK, blocked.as_ptr(), before.as_mut_ptr()) == 0 {
                    for thread in self.threads.iter_mut().take(count) {
                        if libc::pthread_create(thread.as_mut_ptr(), attributes.as_ptr(), run, job) != 0 {
                            break;
                        }
                        self.count += 1;
                    }
                    libc::pthread_sigmask(libc::SIG_SETMASK, before.as_ptr(), std::ptr::null_mut());
                }
                libc::pthread_attr_destroy(attributes.as_mut_ptr());
            }
        }
    }

    impl Drop for Helpers {
        fn drop(&mut self) {
            for thread in &self.threads[..self.count] {
                // SAFETY: it was started, and nobody else waits for it.
                unsafe { libc::pthread_join(thread.assume_init(), std::ptr::null_mut()) };
            }
        }
    }
}
