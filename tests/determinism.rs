//! The same bits for any number of threads, any vectors, any subset, any run.

mod common;
use common::calls::{Fixture, Prepared, Setting, all};
use common::capi::{ALL, Handle, normals};
use common::mesh::{self, Mesh};
use common::real;
use umbilic::capi::*;

fn meshes() -> Vec<Mesh> {
    let mut meshes = vec![
        mesh::torus(150, 90, 0.4, 0.0, 1),
        mesh::torus(60, 50, 0.3, 0.6, 2),
        mesh::height_field(90, 0.0, 3),
        mesh::height_field(60, 0.4, 4),
        mesh::fan(1000, true, 5),
        mesh::letter_prism(),
    ];
    for seed in 0..12 {
        meshes.push(mesh::soup(60, 90, 3, seed));
        meshes.push(mesh::soup(60, 90, 7, 50 + seed));
    }
    meshes.extend(real::meshes());
    meshes
}

fn bits<const N: usize>(values: &[[f64; N]]) -> Vec<[u64; N]> {
    values.iter().map(|value| value.map(f64::to_bits)).collect()
}

#[test]
fn threads_and_vectors_change_no_bit() {
    for mesh in meshes() {
        let handle = Handle::new(&mesh);
        let single = mesh.single();
        for weight in ALL {
            let base_single = normals(&handle, &single, weight, false, |run| run.threads = 1);
            let base = normals(&handle, &mesh.positions, weight, true, |run| run.threads = 1);
            for (threads, simd) in
                [(1, UMB_SIMD_PORTABLE), (1, UMB_SIMD_SSE2), (1, UMB_SIMD_AVX2), (3, UMB_SIMD_AVX512), (8, 0), (0, 0)]
            {
                let set = |run: &mut umb_run| (run.threads, run.simd) = (threads, simd);
                let found = normals(&handle, &single, weight, false, set);
                let same = found.normal.iter().flatten().map(|x| x.to_bits()).eq(base_single
                    .normal
                    .iter()
                    .flatten()
                    .map(|x| x.to_bits()));
                assert!(same, "{}, f32, weight {weight}, {threads} threads, simd {simd}", mesh.name);
                let found = normals(&handle, &mesh.positions, weight, true, set);
                let same = bits(&found.normal) == bits(&base.normal) && bits(&found.sum) == bits(&base.sum);
                assert!(same, "{}, f64, weight {weight}, {threads} threads, simd {simd}", mesh.name);
                assert_eq!(found.status, base.status);
            }
        }
    }
}

/// Sections, face normals, polylines and models among them.
#[test]
fn every_call_with_every_level_and_up_to_eight_threads() {
    for quads in [0.0, 0.5] {
        let fixture = Fixture::new(mesh::torus(70, 45, 0.4, quads, 7));
        for call in all() {
            for single in [false, true] {
                let plain = Setting { single, simd: UMB_SIMD_PORTABLE, ..Setting::threads(1) };
                let mut expected = Prepared::new(call, &fixture, &plain);
                expected.succeed();
                // Every level, and every number of threads.
                let levels = [UMB_SIMD_SSE2, UMB_SIMD_AVX2, UMB_SIMD_AVX512].map(|simd| (simd, 1));
                for (simd, threads) in levels.into_iter().chain((2..=8).map(|threads| (threads % 5, threads))) {
                    let setting = Setting { single, simd, ..Setting::threads(threads) };
                    let mut prepared = Prepared::new(call, &fixture, &setting);
                    prepared.succeed();
                    let place = (call, single, simd, threads);
                    assert!(prepared.bits() == expected.bits(), "{}, {place:?}", fixture.mesh.name);
                }
            }
        }
    }
}

#[test]
fn a_subset_has_the_bits_of_the_whole() {
    for mesh in meshes() {
        let handle = Handle::new(&mesh);
        let single = mesh.single();
        let count = mesh.positions.len() as u32;
        let lists: [Vec<u32>; 4] = [
            (0..count).filter(|v| v % 7 == 3).collect(),
            (0..count).rev().collect(),
            vec![count / 2, 0, count / 2, count - 1, 0],
            vec![],
        ];
        for weight in ALL {
            let whole = normals(&handle, &mesh.positions, weight, true, |_| ());
            let whole_single = normals(&handle, &single, weight, false, |_| ());
            for list in &lists {
                for threads in [1, 4] {
                    let set = |run: &mut umb_run| {
                        run.vertices = if list.is_empty() { [0u32; 0].as_ptr() } else { list.as_ptr() };
                        run.vertex_count = list.len();
                        run.threads = threads;
                    };
                    let part = normals(&handle, &mesh.positions, weight, true, set);
                    let part_single = normals(&handle, &single, weight, false, set);
                    for vertex in 0..count as usize {
                        let listed = list.contains(&(vertex as u32));
                        let expected = |x: f64| if listed { x.to_bits() } else { 0 };
                        assert_eq!(part.normal[vertex].map(f64::to_bits), whole.normal[vertex].map(expected));
                        assert_eq!(part.sum[vertex].map(f64::to_bits), whole.sum[vertex].map(expected));
                        let expected = |x: f32| if listed { x.to_bits() } else { 0 };
                        assert_eq!(
                            part_single.normal[vertex].map(f32::to_bits),
                            whole_single.normal[vertex].map(expected)
                        );
                        assert_eq!(part.status[vertex], if listed { whole.status[vertex] } else { 0 });
                    }
                    if count > 3000 {
                        break;
                    }
                }
            }
        }
    }
}
