//! Normals of polygons: single precision is as good as it says, on hostile grids too; and whether the planes of faces are kept for a
//! window of vertices or computed where they are met changes no bit.
// Every call keeps the contract that the header states.
#![allow(clippy::undocumented_unsafe_blocks)]

mod common;
use common::capi::{Handle, normals, widened};
use common::largest_difference;
use common::mesh::{self, Mesh};
use common::random::Random;
use umbilic::capi::*;

/// What the README promises of a unit normal.
const TOLERANCE: f64 = 2e-6;

/// Quadrilaterals, mixed meshes and hexagons, concave ones among them.
fn grids(seed: u64) -> Vec<Mesh> {
    vec![
        mesh::torus(30, 22, 0.3, 1.0, seed),
        mesh::torus(30, 22, 0.9, 1.0, seed + 1),
        mesh::torus(26, 18, 0.5, 0.5, seed + 2),
        mesh::height_field(20, 1.0, seed + 3),
        mesh::quad_sphere(10, 0.4, seed + 4),
        mesh::dual_sphere(&mesh::tetrahedron_sphere(3)),
    ]
}

#[test]
fn single_precision_is_that_of_double_precision() {
    let mut compared = 0;
    for seed in 0..4 {
        for grid in grids(10 * seed) {
            for (stretch, size) in
                [(1.0, 1.0), (1e-3, 1.0), (1e-6, 1.0), (30.0, 1.0), (1.0, 1e-18), (0.1, 1e14), (1.0, 1e18)]
            {
                let mesh = grid.mapped(|[x, y, z]| [x * size, y * size, z * size * stretch]).rounded();
                let handle = Handle::new(&mesh);
                for weight in UMB_WEIGHT_CONFORMAL..=UMB_WEIGHT_ANGLE_EDGES {
                    let exact = normals(&handle, &mesh.positions, weight, false, |_| ());
                    let found = normals(&handle, &mesh.single(), weight, false, |_| ());
                    for (vertex, normal) in widened(&found.normal).into_iter().enumerate() {
                        assert_eq!(found.status[vertex], exact.status[vertex]);
                        let apart = largest_difference(normal, exact.normal[vertex]);
                        let what =
                            format!("{} by {stretch:e} at {size:e}, weight {weight}, vertex {vertex}", mesh.name);
                        assert!(apart <= TOLERANCE, "{what}: {apart:e}");
                        compared += 1;
                    }
                }
            }
        }
    }
    assert!(compared > 500_000, "{compared}");
}

/// The same mesh with its vertices and faces in an order drawn at random.
fn shuffled(mesh: &Mesh, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let mut order: Vec<usize> = (0..mesh.positions.len()).collect();
    for index in (1..order.len()).rev() {
        order.swap(index, random.below(index + 1));
    }
    let mut place = vec![0u32; order.len()];
    order.iter().enumerate().for_each(|(new, &old)| place[old] = new as u32);
    let mut faces = mesh.face_vectors();
    faces.iter_mut().flatten().for_each(|corner| *corner = place[*corner as usize]);
    for index in (1..faces.len()).rev() {
        faces.swap(index, random.below(index + 1));
    }
    Mesh::new(&format!("{}, shuffled", mesh.name), order.iter().map(|&old| mesh.positions[old]).collect(), faces)
}

/// A disc of so many corners, quadrilaterals around it.
fn disc(corners: u32) -> Mesh {
    let ring = |radius: f64, height: f64| {
        (0..corners).map(move |corner| {
            let angle = std::f64::consts::TAU * corner as f64 / corners as f64;
            [radius * angle.cos(), radius * angle.sin(), height + 0.1 * (3.0 * angle).sin()]
        })
    };
    let positions = ring(1.0, 0.0).chain(ring(1.2, -0.1)).collect();
    let mut faces = vec![(0..corners).collect::<Vec<u32>>()];
    faces.extend((0..corners).map(|corner| {
        let next = (corner + 1) % corners;
        vec![corner, corner + corners, next + corners, next]
    }));
    Mesh::new(&format!("disc of {corners}"), positions, faces)
}

#[test]
fn planes_are_the_same_wherever_they_are_computed() {
    let large = mesh::torus(110, 70, 0.6, 0.8, 5);
    for mesh in [shuffled(&large, 6), large, disc(17), disc(3000), mesh::dual_sphere(&mesh::tetrahedron_sphere(5))] {
        let handle = Handle::new(&mesh);
        let (single, count) = (mesh.single(), mesh.positions.len() as u32);
        // Few enough at a time that the faces around them are computed where they are met.
        let lists: Vec<Vec<u32>> = (0..7).map(|first| (first..count).step_by(7).take(40).collect()).collect();
        for weight in UMB_WEIGHT_CONFORMAL..=UMB_WEIGHT_ANGLE_EDGES {
            let (f32s, f64s) = (
                normals(&handle, &single, weight, false, |_| ()).normal,
                normals(&handle, &mesh.positions, weight, false, |_| ()).normal,
            );
            for (threads, simd) in [(1, UMB_SIMD_PORTABLE), (3, UMB_SIMD_AVX2), (2, UMB_SIMD_AVX512)] {
                let set = |run: &mut umb_run| (run.threads, run.simd) = (threads, simd);
                assert_eq!(normals(&handle, &single, weight, false, set).normal, f32s, "{}, {weight}", mesh.name);
                assert_eq!(
                    normals(&handle, &mesh.positions, weight, false, set).normal,
                    f64s,
                    "{}, {weight}",
                    mesh.name
                );
            }
            for list in &lists {
                let set = |run: &mut umb_run| (run.vertices, run.vertex_count) = (list.as_ptr(), list.len());
                let some = normals(&handle, &single, weight, false, set).normal;
                let double = normals(&handle, &mesh.positions, weight, false, set).normal;
                for &vertex in list {
                    let vertex = vertex as usize;
                    assert_eq!(some[vertex], f32s[vertex], "{}, {weight}, {vertex}", mesh.name);
                    assert_eq!(double[vertex], f64s[vertex], "{}, {weight}, {vertex}", mesh.name);
                }
            }
        }
    }
}
