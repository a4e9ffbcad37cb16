//! What must not matter does not: where a mesh stands, how large it is, how its elements are numbered.

mod common;
use common::capi::{Handle, WEIGHTS, normals, widened};
use common::mesh::{self, Mesh, letter_prism};
use common::oracle::Oracle;
use common::{Random, Vector, add, cross, dot, largest_difference, scale, sub, unit};
use proptest::prelude::*;
use umbilic::Weight;
use umbilic::capi::*;

/// A mesh of a kind drawn at random.
fn drawn(kind: usize, seed: u64) -> Mesh {
    match kind {
        0 => mesh::torus(13, 9, 0.3, 0.0, seed),
        1 => mesh::torus(11, 8, 0.2, 0.5, seed),
        2 => mesh::height_field(9, 0.0, seed),
        3 => mesh::height_field(8, 0.5, seed),
        4 => mesh::soup(25, 40, 3, seed),
        5 => mesh::soup(25, 30, 6, seed),
        6 => mesh::fan(5 + seed as usize % 20, seed.is_multiple_of(2), seed),
        _ => letter_prism(),
    }
}

fn double(mesh: &Mesh, weight: umb_weight) -> Vec<Vector> {
    normals(&Handle::new(mesh), &mesh.positions, weight, false, |_| ()).normal
}

fn conditions(mesh: &Mesh, weight: umb_weight) -> Vec<f64> {
    let oracle = Oracle::new(mesh);
    (0..mesh.positions.len()).map(|vertex| oracle.normal(vertex, Weight::ALL[weight as usize]).condition).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn rotation_turns_normals(kind in 0usize..8, seed in 1u64..10_000, weight in 0u32..10) {
        let mesh = drawn(kind, seed);
        let mut random = Random::new(seed);
        let x = unit([random.signed(), random.signed(), random.signed() + 2.0]);
        let y = unit(cross(x, [random.signed(), 3.0, random.signed()]));
        let z = cross(x, y);
        let turn = |v: Vector| [dot(x, v), dot(y, v), dot(z, v)];
        let turned = mesh.mapped(turn);
        let (before, after, conditions) = (double(&mesh, weight), double(&turned, weight), conditions(&mesh, weight));
        for vertex in 0..before.len() {
            // The rotation rounds every coordinate, which a vertex feels as much as its condition says.
            let tolerance = 1e-14 * conditions[vertex].max(1.0) * 4.0;
            if tolerance < 1e-9 {
                prop_assert!(largest_difference(turn(before[vertex]), after[vertex]) <= tolerance);
            }
        }
    }

    #[test]
    fn a_power_of_two_of_the_size_changes_no_bit(kind in 0usize..8, seed in 1u64..10_000, weight in 0u32..11, power in -900i32..900) {
        let mesh = drawn(kind, seed);
        let large = mesh.mapped(|p| scale(p, 2f64.powi(power)));
        prop_assert_eq!(double(&mesh, weight), double(&large, weight));
        let power = power / 9;
        let (mesh, handle) = (mesh.rounded(), Handle::new(&mesh));
        let small = mesh.mapped(|p| scale(p, 2f64.powi(power)));
        let found = normals(&handle, &mesh.single(), weight, false, |_| ());
        let scaled = normals(&handle, &small.single(), weight, false, |_| ());
        prop_assert_eq!(found.normal, scaled.normal);
    }

    #[test]
    fn any_size_from_1e_minus_30_to_1e_30(kind in 0usize..8, seed in 1u64..10_000, weight in 0u32..10, power in -30i32..30) {
        let mesh = drawn(kind, seed).rounded();
        let resized = mesh.mapped(|p| scale(p, 10f64.powi(power))).rounded();
        let handle = Handle::new(&mesh);
        let single = normals(&handle, &resized.single(), weight, false, |_| ());
        let expected = double(&resized, weight);
        let conditions = conditions(&mesh, weight);
        for vertex in 0..expected.len() {
            prop_assert!(single.normal[vertex].iter().all(|x| x.is_finite()));
            if conditions[vertex] < 1e6 {
                prop_assert!(largest_difference(widened(&single.normal)[vertex], expected[vertex]) <= 2e-6);
            }
        }
    }

    #[test]
    fn a_mesh_far_away_is_the_mesh_of_its_rounded_coordinates(kind in 0usize..8, seed in 1u64..10_000, weight in 0u32..11) {
        // A million sizes away, then back: the differences that the coordinates still have are all that counts.
        let far = drawn(kind, seed).mapped(|p| add(p, [1e6, -1e6, 1e6])).rounded();
        let back = far.mapped(|p| sub(p, [1e6, -1e6, 1e6])).rounded();
        let handle = Handle::new(&far);
        let found = normals(&handle, &far.single(), weight, false, |_| ());
        let expected = normals(&handle, &back.single(), weight, false, |_| ());
        prop_assert_eq!(found.normal, expected.normal);
        prop_assert_eq!(found.status, expected.status);
        let far = normals(&handle, &far.positions, weight, false, |_| ());
        let back = normals(&handle, &back.positions, weight, false, |_| ());
        prop_assert_eq!(far.normal, back.normal);
    }

    #[test]
    fn numbering_does_not_matter(kind in 0usize..8, seed in 1u64..10_000, weight in 0u32..10) {
        let mesh = drawn(kind, seed);
        let mut random = Random::new(seed);
        let count = mesh.positions.len();
        let mut place: Vec<usize> = (0..count).collect();
        for i in (1..count).rev() {
            place.swap(i, random.below(i + 1));
        }
        let mut positions = vec![[0.0; 3]; count];
        for (vertex, &new) in place.iter().enumerate() {
            positions[new] = mesh.positions[vertex];
        }
        let mut faces: Vec<Vec<u32>> = mesh
            .faces()
            .map(|face| {
                let mut face: Vec<u32> = face.iter().map(|&v| place[v as usize] as u32).collect();
                let start = random.below(face.len());
                face.rotate_left(start);
                face
            })
            .collect();
        for i in (1..faces.len()).rev() {
            faces.swap(i, random.below(i + 1));
        }
        let relabelled = Mesh::new("relabelled", positions, faces);
        let (before, after, conditions) = (double(&mesh, weight), double(&relabelled, weight), conditions(&mesh, weight));
        for vertex in 0..count {
            let tolerance = 1e-15 * conditions[vertex].max(1.0) * 8.0;
            if tolerance < 1e-9 {
                prop_assert!(largest_difference(before[vertex], after[place[vertex]]) <= tolerance);
            }
        }
    }

    #[test]
    fn reversed_winding_flips_normals(kind in 0usize..8, seed in 1u64..10_000, weight in 0u32..10) {
        let mesh = drawn(kind, seed);
        let (before, after, conditions) = (double(&mesh, weight), double(&mesh.reversed(), weight), conditions(&mesh, weight));
        for vertex in 0..before.len() {
            let tolerance = 1e-15 * conditions[vertex].max(1.0) * 8.0;
            if tolerance < 1e-9 {
                prop_assert!(largest_difference(before[vertex], scale(after[vertex], -1.0)) <= tolerance);
            }
        }
    }

    #[test]
    fn signs_of_axes_change_no_bit_but_the_sign(kind in 0usize..8, seed in 1u64..10_000, weight in 0u32..10) {
        // Two axes mirrored is a rotation by half a turn, whose arithmetic is exact.
        let mesh = drawn(kind, seed);
        let turn = |v: Vector| [-v[0], -v[1], v[2]];
        let before: Vec<Vector> = double(&mesh, weight).into_iter().map(turn).collect();
        let after = double(&mesh.mapped(turn), weight);
        prop_assert_eq!(before, after);
    }
}

/// Each edge of a polygon mesh cut at a point of it, in both its faces.
fn refined(mesh: &Mesh, at: f64) -> Mesh {
    let mut positions = mesh.positions.clone();
    let mut cuts = std::collections::HashMap::new();
    let faces = mesh
        .face_vectors()
        .iter()
        .map(|face| {
            let mut fine = vec![];
            for (i, &a) in face.iter().enumerate() {
                let b = face[(i + 1) % face.len()];
                let (low, high) = (a.min(b), a.max(b));
                fine.push(a);
                fine.push(*cuts.entry((low, high)).or_insert_with(|| {
                    let (p, q) = (mesh.positions[low as usize], mesh.positions[high as usize]);
                    positions.push(add(p, scale(sub(q, p), at)));
                    positions.len() as u32 - 1
                }));
            }
            fine
        })
        .collect();
    Mesh::new("refined", positions, faces)
}

#[test]
fn a_polygon_and_its_collinear_refinement() {
    // Planar faces, so that the new corners lie on them exactly enough: the weights that know only faces and angles do
    // not see the cut.
    let prism = letter_prism();
    let turn = |v: Vector| {
        let [x, y, z] = v;
        [0.36 * x + 0.48 * y - 0.8 * z, -0.8 * x + 0.6 * y, 0.48 * x + 0.64 * y + 0.6 * z]
    };
    for mesh in [prism.clone(), prism.mapped(turn)] {
        for at in [0.5, 0.1, 0.75] {
            let fine = refined(&mesh, at);
            for weight in [
                UMB_WEIGHT_UNIFORM,
                UMB_WEIGHT_ANGLE,
                UMB_WEIGHT_AREA,
                UMB_WEIGHT_SINE,
                UMB_WEIGHT_CENTROID,
                UMB_WEIGHT_CENTROID_AREA,
            ] {
                let (coarse, fine) = (double(&mesh, weight), double(&fine, weight));
                for vertex in 0..coarse.len() {
                    assert!(
                        largest_difference(coarse[vertex], fine[vertex]) < 1e-13,
                        "weight {weight}, vertex {vertex}: {:?} {:?}",
                        coarse[vertex],
                        fine[vertex]
                    );
                }
            }
            // At the new corners, half the cone belongs to each face: every weight gives the edge's normal, but for
            // those that a straight angle (sine 0) silences, which fall back to area.
            let oracle = Oracle::new(&fine);
            for weight in [UMB_WEIGHT_CONFORMAL, UMB_WEIGHT_UNIFORM, UMB_WEIGHT_ANGLE] {
                let found = double(&fine, weight);
                for (vertex, found) in found.iter().enumerate().skip(mesh.positions.len()) {
                    let [a, b] = oracle.corners(vertex) else { panic!("two faces at an edge") };
                    let normal = |face| unit(oracle.area_vector(face));
                    let expected = unit(add(normal(a.face), normal(b.face)));
                    assert!(largest_difference(*found, expected) < 1e-12, "weight {weight}, vertex {vertex}");
                }
            }
        }
    }
}

#[test]
fn every_weight_gives_the_plane_of_a_flat_mesh() {
    for quads in [0.0, 0.5] {
        let mesh = mesh::height_field(12, quads, 3).mapped(|[x, y, _]| [x, y, 0.0]);
        for weight in WEIGHTS {
            for normal in double(&mesh, weight) {
                assert_eq!(normal, [0.0, 0.0, 1.0], "weight {weight}");
            }
        }
    }
}
