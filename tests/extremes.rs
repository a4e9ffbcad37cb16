//! Numbers at the ends of their range, through every call: subnormal, signed zeros, squares that overflow, the largest there are.
//! Nothing is refused, nothing is NaN or infinite, and the bits are the same for any vectors and threads.

mod common;
use common::Random;
use common::calls::{Call, Fixture, Prepared, Setting, all};
use common::capi::message;
use common::mesh::{self, Mesh};
use umbilic::capi::*;

fn meshes() -> Vec<Mesh> {
    vec![
        mesh::ring_sphere(9, 6),
        mesh::quad_sphere(4, 0.2, 2),
        mesh::height_field(9, 0.3, 5),
        mesh::soup(30, 60, 3, 9),
        mesh::soup(30, 40, 6, 8),
        mesh::fan(20, true, 2),
        // The largest that are computed in lanes, and the next: 16 and 17 corners.
        mesh::fan(16, true, 3),
        mesh::fan(17, false, 3),
        mesh::fan(17, true, 3),
        mesh::fan(18, false, 3),
    ]
}

fn check(mesh: Mesh, single: bool) {
    let name = mesh.name.clone();
    let fixture = Fixture::new(mesh);
    for call in all() {
        let setting = Setting { single, ..Setting::threads(1) };
        let mut prepared = Prepared::new(call, &fixture, &setting);
        let status = prepared.call();
        prepared.free();
        assert_eq!(status, UMB_OK, "{name}, {call:?}: {}", message(&prepared.error));
        assert!(prepared.is_finite(), "{name}, {call:?}, single {single}");
        let setting = Setting { single, simd: UMB_SIMD_PORTABLE, ..Setting::threads(2) };
        let mut other = Prepared::new(call, &fixture, &setting);
        other.succeed();
        assert!(other.bits() == prepared.bits(), "{name}, {call:?}, single {single}");
    }
}

/// The mesh with every coordinate changed, held to what the scalar can say.
fn changed(mesh: &Mesh, what: &str, single: bool, mut change: impl FnMut(f64) -> f64) -> Mesh {
    let mut mesh = mesh.clone();
    mesh.name = format!("{}, {what}", mesh.name);
    let most = if single { f32::MAX as f64 } else { f64::MAX };
    for x in mesh.positions.iter_mut().flatten() {
        *x = change(*x).clamp(-most, most);
    }
    mesh
}

#[test]
fn sizes_from_the_smallest_to_the_largest() {
    let double = [5e-324, 1e-320, 1e-310, 1e-300, 1e-160, 1e-80, 1e80, 1e153, 1e155, 1e300, 8e307, 1.7e308];
    let single = [1.4e-45, 1e-43, 1e-38, 1e-30, 1e-20, 1e-12, 1e12, 1e18, 2e19, 1e30, 1e38, 3.4e38];
    for mesh in meshes() {
        for (scale, small) in double.into_iter().zip(single) {
            check(changed(&mesh, &format!("times {scale:e}"), false, |x| x * scale), false);
            check(changed(&mesh, &format!("times {small:e}"), true, |x| x * small), true);
        }
    }
}

#[test]
fn every_coordinate_of_another_size() {
    for seed in 0..6 {
        for mesh in meshes() {
            for single in [false, true] {
                let mut random = Random::new(seed);
                let most = if single { 38.0 } else { 308.0 };
                let wild = changed(&mesh, &format!("wild {seed}"), single, |x| {
                    x * 10f64.powf(most * random.signed()) * 10f64.powf(most * 0.1 * random.signed())
                });
                check(wild, single);
            }
        }
    }
}

#[test]
fn far_from_the_origin_by_more_than_the_numbers_can_tell() {
    for mesh in meshes() {
        for (offset, single) in [(1e300, false), (1e17, false), (-1.7e308, false), (1e38, true), (1e9, true)] {
            check(changed(&mesh, &format!("moved by {offset:e}"), single, |x| x + offset), single);
        }
    }
}

#[test]
fn zeros_of_both_signs_and_flat_axes() {
    for mesh in meshes() {
        for single in [false, true] {
            check(changed(&mesh, "all zero", single, |_| 0.0), single);
            check(changed(&mesh, "all minus zero", single, |_| -0.0), single);
            let mut count = 0;
            let mut alternating = |_| {
                count += 1;
                if count % 3 == 0 { -0.0 } else { 0.0 }
            };
            check(changed(&mesh, "zeros of both signs", single, &mut alternating), single);
            let mut axis = 0;
            let mut line = |x| {
                axis += 1;
                if axis % 3 == 1 { x } else { -0.0 }
            };
            check(changed(&mesh, "on a line", single, &mut line), single);
        }
    }
}

#[test]
fn largest_beside_smallest() {
    for mesh in meshes() {
        for single in [false, true] {
            let (most, least) = if single { (f32::MAX as f64, f32::from_bits(1) as f64) } else { (f64::MAX, 5e-324) };
            let mut count = 0;
            let mut ends = |x: f64| {
                count += 1;
                let size = [most, least, 1.0][count % 3];
                if x < 0.0 { -size } else { size }
            };
            check(changed(&mesh, "ends of the range", single, &mut ends), single);
        }
    }
}

#[test]
fn the_list_of_calls_has_every_kind() {
    let calls = all();
    assert!(calls.len() > 40 && calls.contains(&Call::Learn) && calls.contains(&Call::Polyline));
}
