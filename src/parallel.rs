//! Threads, progress and cancellation of one call.
//!
//! Work is cut into chunks; every thread, the caller's among them, claims the next chunk until none is left. Which
//! thread takes which chunk never changes a result, because a chunk depends on nothing but the input. Threads are
//! scoped: none outlives the call.

use crate::error::Error;
use crate::simd::Level;
use crate::view::{core_count, for_each_part, with_threads};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};

/// How a call is carried out. The default: all cores where that pays, the widest vectors, all vertices.
pub struct Run<'a> {
    /// The number of threads, at most 256; 0 for as many as pay, at most one a core.
    pub threads: usize,
    /// The vectors to use. It never changes a bit of a result.
    pub level: Level,
    /// The vertices to compute; `None` for all. Outputs stay indexed by vertex, and those of other vertices are left
    /// alone. A vertex's result does not depend on which others are computed.
    pub vertices: Option<&'a [u32]>,
    /// Called now and then, on the calling thread only, with the fraction done; `false` cancels.
    pub progress: Option<&'a mut dyn FnMut(f64) -> bool>,
}

impl Default for Run<'_> {
    fn default() -> Self {
        Run { threads: 0, level: Level::best(), vertices: None, progress: None }
    }
}

impl Run<'_> {
    /// Has `work` done by a run like this one whose progress is the part from `from` to `to` of this one's.
    ///
    /// # Errors
    /// Those of `work`; [`Error::Cancelled`] also if the caller cancels at the end of a part that others follow.
    pub(crate) fn part<T>(
        &mut self,
        from: f64,
        to: f64,
        work: impl FnOnce(Run<'_>) -> Result<T, Error>,
    ) -> Result<T, Error> {
        self.part_for(self.vertices, from, to, work)
    }

    /// As [`Run::part`], for other vertices.
    ///
    /// # Errors
    /// As [`Run::part`].
    pub(crate) fn part_for<T>(
        &mut self,
        vertices: Option<&[u32]>,
        from: f64,
        to: f64,
        work: impl FnOnce(Run<'_>) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let Run { threads, level, .. } = *self;
        let Some(whole) = &mut self.progress else {
            return work(Run { threads, level, vertices, progress: None });
        };
        let mut cancelled = false;
        let mut part = |fraction: f64| {
            let goes_on = whole(from + (to - from) * fraction);
            cancelled |= !goes_on;
            goes_on
        };
        let done = work(Run { threads, level, vertices, progress: Some(&mut part) })?;
        // What came too late for the part is in time for the next one.
        if cancelled && to < 1.0 { Err(Error::Cancelled) } else { Ok(done) }
    }
}

impl std::fmt::Debug for Run<'_> {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.debug_struct("Run")
            .field("threads", &self.threads)
            .field("level", &self.level)
            .field("vertices", &self.vertices.map(<[u32]>::len))
            .field("progress", &self.progress.is_some())
            .finish()
    }
}

/// Fewer chunks than this for each thread are not worth starting it.
const CHUNKS_A_THREAD: usize = 16;

/// No call uses more threads than this, whatever it is asked for.
const MOST_THREADS: usize = 256;

/// The chunks of a call, as one thread sees them.
pub(crate) struct Claims<'a, 'p> {
    shared: &'a Shared,
    progress: Option<&'a mut (dyn FnMut(f64) -> bool + 'p)>,
}

struct Shared {
    next: AtomicUsize,
    count: usize,
    cancelled: AtomicBool,
}

impl Claims<'_, '_> {
    /// The next chunk to do; `None` when all are claimed or the call was cancelled.
    pub(crate) fn next(&mut self) -> Option<usize> {
        if let Some(progress) = &mut self.progress {
            let done = self.shared.next.load(Relaxed).min(self.shared.count);
            if !progress(done as f64 / self.shared.count.max(1) as f64) {
                self.shared.cancelled.store(true, Relaxed);
            }
        }
        if self.shared.cancelled.load(Relaxed) {
            return None;
        }
        let chunk = self.shared.next.fetch_add(1, Relaxed);
        (chunk < self.shared.count).then_some(chunk)
    }
}

/// How many threads to use for `chunks` chunks if the caller asks for `wanted`, 0 meaning as many as pay.
pub(crate) fn thread_count(wanted: usize, chunks: usize) -> usize {
    let most = match wanted {
        0 => chunks / CHUNKS_A_THREAD,
        wanted => wanted.min(chunks),
    };
    if most <= 1 {
        return 1;
    }
    let cores = if wanted == 0 { core_count() } else { MOST_THREADS };
    most.min(cores).min(MOST_THREADS)
}

/// Has `work` done by as many threads as `run` asks for, until the `count` chunks are claimed.
///
/// # Errors
/// [`Error::Cancelled`].
pub(crate) fn for_each_chunk(
    run: &mut Run<'_>,
    count: usize,
    work: impl Fn(&mut Claims<'_, '_>) + Sync,
) -> Result<(), Error> {
    if count == 0 {
        return Ok(());
    }
    let shared = Shared { next: AtomicUsize::new(0), count, cancelled: AtomicBool::new(false) };
    let threads = thread_count(run.threads, count);
    let progress = run.progress.as_deref_mut();
    with_threads(
        threads,
        || work(&mut Claims { shared: &shared, progress: None }),
        || work(&mut Claims { shared: &shared, progress }),
    );
    if shared.cancelled.load(Relaxed) {
        return Err(Error::Cancelled);
    }
    if let Some(progress) = &mut run.progress {
        // All is written, so a wish to cancel comes too late to matter.
        progress(1.0);
    }
    Ok(())
}

/// Sets each element to `value(index)`, by as many threads as `threads` asks for (0: as many as pay).
pub(crate) fn fill<T: Send>(threads: usize, elements: &mut [T], value: impl Fn(usize) -> T + Sync) {
    const CHUNK: usize = 2048;
    let threads = thread_count(threads, elements.len().div_ceil(CHUNK));
    let length = elements.len().div_ceil(threads).max(1);
    for_each_part(threads, elements.chunks_mut(length).enumerate(), |(index, part)| {
        for (place, element) in part.iter_mut().enumerate() {
            *element = value(index * length + place);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two parts of three chunks each; which call of the callback cancels, once.
    fn in_parts(cancels: usize) -> (Result<(), Error>, usize) {
        let mut calls = 0;
        let mut progress = |_: f64| {
            calls += 1;
            calls != cancels
        };
        let mut run = Run { threads: 1, progress: Some(&mut progress), ..Run::default() };
        let work = |mut run: Run<'_>| for_each_chunk(&mut run, 3, |claims| while claims.next().is_some() {});
        let done = run.part(0.0, 0.5, work).and_then(|()| run.part(0.5, 1.0, work));
        (done, calls)
    }

    #[test]
    fn whoever_cancels_once_is_heard_until_all_is_done() {
        let (done, calls) = in_parts(usize::MAX);
        assert_eq!(done, Ok(()));
        for cancels in 1..calls {
            assert_eq!(in_parts(cancels), (Err(Error::Cancelled), cancels));
        }
        assert_eq!(in_parts(calls), (Ok(()), calls));
    }
}
