//! Memory that runs out, calls that are cancelled, calls that fail: a status, nothing half written, nothing left behind.
//!
//! A program of its own, without the test harness, whose threads would allocate beside the library's.

mod common;
use common::calls::{Call, Fixture, Kind, Prepared, Setting, all};
use common::capi::message;
use common::mesh::{self, Mesh};
use std::alloc::{GlobalAlloc, Layout, System};
use std::ffi::c_void;
use std::sync::atomic::{AtomicI64, AtomicU64, Ordering::SeqCst};
use umbilic::capi::*;

/// The system's allocator, which can be told to fail, and counts what it has given away.
struct Allocator;

/// How many allocations still succeed; negative: all.
static LEFT: AtomicI64 = AtomicI64::new(-1);
/// Whether those after the failing one fail as well.
static FOR_GOOD: AtomicU64 = AtomicU64::new(0);
static FAILED: AtomicU64 = AtomicU64::new(0);
static LIVE: AtomicI64 = AtomicI64::new(0);

fn refuses() -> bool {
    if LEFT.load(SeqCst) < 0 {
        return false;
    }
    let left = LEFT.fetch_sub(1, SeqCst);
    if left > 0 {
        return false;
    }
    LEFT.store(if FOR_GOOD.load(SeqCst) == 0 { -1 } else { 0 }, SeqCst);
    FAILED.fetch_add(1, SeqCst);
    true
}

// SAFETY: what it does not refuse, the system's allocator does.
unsafe impl GlobalAlloc for Allocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if refuses() {
            return std::ptr::null_mut();
        }
        LIVE.fetch_add(layout.size() as i64, SeqCst);
        // SAFETY: handed on.
        unsafe { System.alloc(layout) }
    }
    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        if refuses() {
            return std::ptr::null_mut();
        }
        LIVE.fetch_add(layout.size() as i64, SeqCst);
        // SAFETY: handed on.
        unsafe { System.alloc_zeroed(layout) }
    }
    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        if size > layout.size() && refuses() {
            return std::ptr::null_mut();
        }
        LIVE.fetch_add(size as i64 - layout.size() as i64, SeqCst);
        // SAFETY: handed on.
        unsafe { System.realloc(block, layout, size) }
    }
    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        LIVE.fetch_sub(layout.size() as i64, SeqCst);
        // SAFETY: handed on.
        unsafe { System.dealloc(block, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Allocator = Allocator;

/// Calls with the allocation after the first `left` failing; answers with the status and how many failed.
fn call_with(prepared: &mut Prepared<'_>, left: i64, for_good: bool) -> (umb_status, u64) {
    FAILED.store(0, SeqCst);
    FOR_GOOD.store(for_good as u64, SeqCst);
    LEFT.store(left, SeqCst);
    let status = prepared.call();
    LEFT.store(-1, SeqCst);
    (status, FAILED.load(SeqCst))
}

/// Every allocation of a call fails once; answers with how many there are.
fn walk(call: Call, fixture: &Fixture, setting: &Setting<'_>, for_good: bool) -> u64 {
    let threads = setting.threads;
    let mut prepared = Prepared::new(call, fixture, setting);
    let live = LIVE.load(SeqCst);
    let mut step = 0;
    loop {
        let (status, failed) = call_with(&mut prepared, step, for_good);
        let place = (call, &fixture.mesh.name, threads, step);
        if failed == 0 {
            assert_eq!(status, UMB_OK, "{place:?}: {}", message(&prepared.error));
            prepared.free();
            assert_eq!(LIVE.load(SeqCst), live, "{place:?}: memory is left");
            return step as u64;
        }
        assert_eq!(status, UMB_ERROR_OUT_OF_MEMORY, "{place:?}: {}", message(&prepared.error));
        assert_eq!(message(&prepared.error), "out of memory");
        assert!(prepared.is_untouched() || call == Call::Valence, "{place:?}: something was written");
        assert_eq!(LIVE.load(SeqCst), live, "{place:?}: memory is left");
        step += 1;
    }
}

fn memory_runs_out(fixtures: &[Fixture]) {
    let mut faults = 0;
    for fixture in fixtures {
        let mut learnt = Prepared::new(Call::Learn, fixture, &Setting::threads(1));
        learnt.succeed();
        let list: Vec<u32> = (0..fixture.mesh.positions.len() as u32).rev().step_by(3).collect();
        for call in all() {
            for for_good in [false, true] {
                for threads in [1, 3] {
                    let whole = Setting::threads(threads);
                    faults += walk(call, fixture, &whole, for_good);
                    if call.takes_list() {
                        faults += walk(call, fixture, &Setting { list: Some(&list), ..whole }, for_good);
                    }
                }
                let setting = Setting { single: true, ..Setting::threads(1) };
                faults += walk(call, fixture, &setting, for_good);
                let setting = Setting { single: true, model: Some(&learnt.model), list: Some(&list), ..setting };
                faults += walk(call, fixture, &setting, for_good);
            }
        }
    }
    println!("{faults} failing allocations in {} calls on {} meshes", all().len(), fixtures.len());
    assert!(faults > 1000);
}

/// Answers 1 from the call on that the counter is at 0.
unsafe extern "C" fn cancel(user: *mut c_void, fraction: f64) -> i32 {
    // SAFETY: what the test handed in.
    let left = unsafe { &mut *user.cast::<i64>() };
    assert!((0.0..=1.0).contains(&fraction));
    *left -= 1;
    (*left < 0) as i32
}

fn calls_are_cancelled(fixtures: &[Fixture]) {
    let mut cancels = 0;
    for fixture in fixtures {
        for call in all().into_iter().filter(|call| call.runs()) {
            let whole = Setting::threads(1);
            let mut full = Prepared::new(call, fixture, &whole);
            full.succeed();
            for threads in [1, 3] {
                for step in 0.. {
                    let mut left: i64 = step;
                    let user = (&raw mut left).cast();
                    let setting = Setting { progress: Some(cancel), user, ..Setting::threads(threads) };
                    let mut prepared = Prepared::new(call, fixture, &setting);
                    let live = LIVE.load(SeqCst);
                    let status = prepared.call();
                    prepared.free();
                    let place = (call, &fixture.mesh.name, threads, step);
                    assert_eq!(LIVE.load(SeqCst), live, "{place:?}: memory is left");
                    if status == UMB_OK {
                        assert_eq!(prepared.bits(), full.bits(), "{place:?}");
                        break;
                    }
                    assert_eq!(status, UMB_ERROR_CANCELLED, "{place:?}: {}", message(&prepared.error));
                    assert!(prepared.is_part_of(&full), "{place:?}: written, but not with the result");
                    cancels += 1;
                }
            }
        }
    }
    println!("{cancels} cancels");
    assert!(cancels > 500);
}

fn failing_calls_leave_nothing() {
    let mut spoilt = mesh::torus(90, 60, 0.2, 0.3, 4);
    let last = spoilt.positions.len() - 1;
    spoilt.positions[last][1] = f64::NAN;
    let fixture = Fixture::new(spoilt);
    for call in all() {
        for threads in [1, 3] {
            let setting = Setting::threads(threads);
            let mut prepared = Prepared::new(call, &fixture, &setting);
            let live = LIVE.load(SeqCst);
            let status = prepared.call();
            prepared.free();
            // Some do not look at positions.
            let blind = matches!(call, Call::Create | Call::Stats | Call::Valence | Call::Segments(Kind::Height))
                || matches!(call, Call::AffectedNormals(_) | Call::AffectedCurvatures(_));
            let expected = if blind { UMB_OK } else { UMB_ERROR_NON_FINITE };
            assert_eq!(status, expected, "{call:?}: {}", message(&prepared.error));
            assert!(
                status == UMB_OK || (prepared.is_untouched() && prepared.error.element == last as u64),
                "{call:?}"
            );
            assert_eq!(LIVE.load(SeqCst), live, "{call:?}: memory is left");
        }
    }
}

/// A gabled roof over a grid whose ridge has a hub of forty corners; and one of quads, creased all over.
fn creased() -> [Mesh; 2] {
    let side = 15;
    let roof = |x: f64, y: f64| [x, y, 1.0 - x.abs()];
    let (mut positions, mut faces) = (vec![roof(0.0, 0.0)], vec![]);
    for ring in 1..=side {
        for step in 0..40 {
            let angle = std::f64::consts::TAU * step as f64 / 40.0;
            let radius = ring as f64 / side as f64;
            positions.push(roof(radius * angle.cos(), radius * angle.sin()));
        }
    }
    let at = |ring: usize, step: usize| (1 + ring * 40 + step % 40) as u32;
    for step in 0..40 {
        faces.push(vec![0, at(0, step), at(0, step + 1)]);
        for ring in 0..side - 1 {
            faces.push(vec![at(ring, step), at(ring + 1, step), at(ring + 1, step + 1)]);
            faces.push(vec![at(ring, step), at(ring + 1, step + 1), at(ring, step + 1)]);
        }
    }
    let hub = Mesh::new("roof with a hub", positions, faces);
    let mut pleats = mesh::torus(24, 20, 0.0, 1.0, 1);
    for (vertex, position) in pleats.positions.iter_mut().enumerate() {
        let (column, row) = (vertex / 20, vertex % 20);
        *position = [column as f64, row as f64, if column % 2 == 0 { 0.0 } else { 1.5 }];
    }
    pleats.name = "pleats".into();
    [hub, pleats]
}

fn main() {
    // Small, with every defect; with creases; and large enough for several chunks.
    let small = [
        mesh::soup(40, 90, 3, 5),
        mesh::soup(40, 60, 6, 6),
        mesh::fan(70, true, 3),
        mesh::quad_sphere(5, 0.2, 1),
        mesh::ring_sphere(9, 7),
    ];
    let small = small.map(Fixture::new);
    let large = [mesh::torus(80, 60, 0.3, 0.0, 2), mesh::torus(70, 50, 0.3, 0.5, 2)].map(Fixture::new);
    memory_runs_out(&small);
    memory_runs_out(&creased().map(Fixture::new));
    memory_runs_out(&large);
    calls_are_cancelled(&large);
    failing_calls_leave_nothing();
    println!("All passed.");
}
