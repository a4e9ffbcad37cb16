//! Hosts that change how the CPU computes: subnormal numbers flushed to zero, another rounding mode, exceptions that trap.
//! Results keep their bits, and the host finds its state as it left it.
#![cfg(target_arch = "x86_64")]

mod common;
use common::calls::{Call, Fixture, Prepared, Setting, all};
use common::mesh::{self, Mesh};
use std::ffi::c_void;
use umbilic::capi::*;

/// What a process starts with.
const STANDARD: u32 = 0x1f80;

fn state() -> u32 {
    let mut register = 0u32;
    // SAFETY: stores four bytes where they are wanted.
    unsafe { std::arch::asm!("stmxcsr [{}]", in(reg) &raw mut register) };
    register
}

fn set_state(register: u32) {
    // SAFETY: no reserved bit is set, and what runs before the next change computes nothing.
    unsafe { std::arch::asm!("ldmxcsr [{}]", in(reg) &raw const register) };
}

/// Flush to zero and denormals are zero; down; up; towards zero; every exception traps; all that at once, with flags pending.
const STATES: [u32; 6] = [0x9fc0, 0x3f80, 0x5f80, 0x7f80, 0x0000, 0xff40 | 0x3f];

/// Large enough for several chunks, with parts so small that squares, products and coordinates are subnormal.
fn graded(quads: f64) -> Mesh {
    let mut mesh = mesh::torus(60, 45, 0.3, quads, 3);
    let count = mesh.positions.len();
    for (vertex, position) in mesh.positions.iter_mut().enumerate() {
        let factor = match 4 * vertex / count {
            0 => 1.0,
            1 => 1e-20,
            2 => 1e-39,
            _ => 3e-310,
        };
        *position = position.map(|x| x * factor);
    }
    mesh
}

#[test]
fn results_keep_their_bits_and_the_host_its_state() {
    for quads in [0.0, 0.4] {
        let fixture = Fixture::new(graded(quads));
        for call in all() {
            for single in [false, true] {
                let standard = Setting { single, ..Setting::threads(1) };
                let mut expected = Prepared::new(call, &fixture, &standard);
                expected.succeed();
                assert!(expected.is_finite(), "{call:?}");
                // Where a mesh has polygons, the last state, which is all of them at once.
                let states = if quads == 0.0 { &STATES[..] } else { &STATES[5..] };
                for (index, &changed) in states.iter().enumerate() {
                    let setting = Setting { single, ..Setting::threads(1 + index as u32 % 3) };
                    let mut prepared = Prepared::new(call, &fixture, &setting);
                    set_state(changed);
                    let status = prepared.call();
                    let after = state();
                    set_state(STANDARD);
                    prepared.free();
                    assert_eq!((status, after), (UMB_OK, changed), "{call:?}");
                    assert!(prepared.bits() == expected.bits(), "{call:?}, state {changed:#x}, single {single}");
                }
            }
        }
    }
}

/// Notes the state that it finds, and leaves another.
unsafe extern "C" fn progress(user: *mut c_void, _fraction: f64) -> i32 {
    let found = state();
    set_state(STANDARD);
    // SAFETY: what the test handed in.
    let (seen, next) = unsafe { &mut *user.cast::<([u32; 2], u32)>() };
    if seen[0] == 0 {
        seen[0] = found;
    }
    seen[1] = found;
    set_state(*next);
    0
}

#[test]
fn a_callback_finds_the_hosts_state_and_may_change_it() {
    let fixture = Fixture::new(mesh::torus(60, 45, 0.3, 0.0, 3));
    for call in all().into_iter().filter(|call| call.runs() && *call != Call::Polyline) {
        let plain = Setting::threads(1);
        let mut expected = Prepared::new(call, &fixture, &plain);
        expected.succeed();
        for (host, next) in [(0x9fc0u32, 0x5f80u32), (0x0000, 0x0000), (0x0040, 0x9fc0)] {
            let mut user = ([0u32; 2], next);
            let setting = Setting { progress: Some(progress), user: (&raw mut user).cast(), ..Setting::threads(2) };
            let mut prepared = Prepared::new(call, &fixture, &setting);
            set_state(host);
            let status = prepared.call();
            let after = state();
            set_state(STANDARD);
            assert_eq!((status, after, user.0), (UMB_OK, next, [host, next]), "{call:?}");
            assert!(prepared.bits() == expected.bits(), "{call:?}");
        }
    }
}
