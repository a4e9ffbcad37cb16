//! How a call is carried out: threads, vectors, a list of vertices, progress.

use crate::block::Block;
use crate::source::Source;
use std::cell::Cell;
use std::thread::ThreadId;
use umbilic::capi::*;

/// What a progress callback sees, and when it cancels.
pub struct Watch {
    cancel_at: Option<u32>,
    /// Whether it cancels in that call only.
    once: bool,
    calls: Cell<u32>,
    cancelled: Cell<bool>,
    /// Before all was done, so that the call may not succeed.
    in_time: Cell<bool>,
    thread: ThreadId,
}

impl Watch {
    pub fn new(source: &mut Source<'_>) -> Watch {
        let cancel_at = source.rarely().then(|| source.below(6) as u32);
        let once = cancel_at.is_some() && source.half();
        let (calls, cancelled, in_time) = (Cell::new(0), Cell::new(false), Cell::new(false));
        Watch { cancel_at, once, calls, cancelled, in_time, thread: std::thread::current().id() }
    }

    pub fn has_cancelled(&self) -> bool {
        self.cancelled.get()
    }

    /// Checks that a call was cancelled if, and only if, the callback asked for it in time.
    pub fn check(&self, status: umb_status) {
        assert!(status != UMB_OK || !self.in_time.get(), "a call goes on that was cancelled");
        assert!(status != UMB_ERROR_CANCELLED || self.has_cancelled(), "cancelled by nobody");
    }
}

unsafe extern "C" fn progress(user: *mut libc::c_void, fraction: f64) -> libc::c_int {
    // SAFETY: `Run::new` hands a watch, which outlives the call.
    let watch = unsafe { &*user.cast::<Watch>() };
    assert_eq!(std::thread::current().id(), watch.thread, "progress on another thread");
    assert!((0.0..=1.0).contains(&fraction), "progress {fraction}");
    let call = watch.calls.replace(watch.calls.get() + 1);
    let cancel = watch.cancel_at.is_some_and(|at| if watch.once { call == at } else { call >= at });
    watch.in_time.set(watch.in_time.get() || cancel && fraction < 1.0);
    watch.cancelled.set(watch.cancelled.get() || cancel);
    if cancel { 1 + call as libc::c_int } else { 0 }
}

/// A `umb_run`, and the list of vertices that it names.
pub struct Run {
    _block: Option<Block>,
    /// The vertices that the library sees; none for all.
    pub list: Option<Vec<u32>>,
    pub view: umb_run,
}

impl Run {
    /// `vertex_count`: of how many vertices a list may be made; none where there must be no list.
    pub fn new(source: &mut Source<'_>, watch: &Watch, vertex_count: Option<usize>) -> Run {
        let mut view = umb_run {
            threads: threads(source),
            simd: simd(source),
            vertices: std::ptr::null(),
            vertex_count: 0,
            progress: None,
            user: std::ptr::null_mut(),
        };
        if watch.cancel_at.is_some() || source.byte() >= 192 {
            view.progress = Some(progress);
            view.user = std::ptr::from_ref(watch).cast_mut().cast();
        }
        let (mut list, mut block) = (None, None);
        let wanted = vertex_count.filter(|_| source.byte() >= 176);
        if wanted.is_some() || source.spoils() {
            let most = wanted.unwrap_or(1);
            let length = if most == 0 { 0 } else { source.below(12) };
            let mut vertices: Vec<u32> = (0..length).map(|_| source.below(most) as u32).collect();
            if !vertices.is_empty() && source.spoils() {
                let place = source.below(vertices.len());
                vertices[place] = if source.half() { most as u32 } else { source.any_u32() };
            }
            let start = if source.spoils() { 1 + source.below(7) } else { 4 * source.below(2) };
            let mut memory = Block::new(start + 4 * vertices.len());
            for (place, vertex) in memory.bytes_mut()[start..].chunks_exact_mut(4).zip(&vertices) {
                place.copy_from_slice(&vertex.to_ne_bytes());
            }
            (view.vertices, view.vertex_count) = (memory.at(start).cast_const().cast(), vertices.len());
            (list, block) = (Some(vertices), Some(memory));
        }
        if source.spoils() {
            match source.below(3) {
                0 => view.simd = source.any_u32(),
                1 => view.vertices = std::ptr::null(),
                _ => view.vertex_count = usize::MAX - source.below(8),
            }
        }
        if view.vertices.is_null() {
            list = None;
        }
        Run { _block: block, list, view }
    }

    /// Whether a vertex is to be computed.
    pub fn asks_for(&self, vertex: usize) -> bool {
        self.list.as_ref().is_none_or(|list| list.contains(&(vertex as u32)))
    }
}

/// One thread mostly, since starting others is slow.
pub fn threads(source: &mut Source<'_>) -> u32 {
    match source.byte() {
        0..224 => 1,
        224..248 => 0,
        _ if !source.may_be_slow(SLOW) => 1,
        248..252 => 2,
        252..254 => 3,
        _ => source.any_u32(),
    }
}

/// One in so many inputs may have a large mesh, and several threads.
pub const SLOW: u32 = 128;

pub fn simd(source: &mut Source<'_>) -> umb_simd {
    source.below(5) as umb_simd
}
