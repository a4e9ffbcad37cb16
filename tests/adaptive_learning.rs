//! What adaptive jets learn from a mesh, against an oracle: sample, noise, sizes, evidence and choices.

mod common;
use common::adaptive::{jets, learned, numbers};
use common::learning_oracle::LearningOracle;
use common::mesh::{self, Mesh};
use common::{Random, Vector, add, bodies, scale};
use umbilic::{AdaptiveModel, Coordinates};

/// Compares all numbers that a mesh teaches with the oracle's.
fn compare(mesh: &Mesh) -> AdaptiveModel {
    let found = learned(mesh);
    let (choice, expected, nearest) = LearningOracle::new(mesh).model();
    let what = format!("{}: {found:?} for {expected:?}, {choice:?}", mesh.name);
    assert!(nearest > 1e-6, "no clear choice: {what}");
    assert_eq!(found.sample, expected.sample, "{what}");
    assert_eq!(found.coordinates, expected.coordinates, "{what}");
    assert_eq!(
        (found.noise_exponent, found.size_exponent),
        (expected.noise_exponent, expected.size_exponent),
        "{what}"
    );
    for (found, expected) in numbers(&found).into_iter().zip(numbers(&expected)) {
        assert!((found / expected - 1.0).abs() < 1e-6, "{found:e} for {expected:e}: {what}");
    }
    for (found, expected) in found.evidence.into_iter().zip(expected.evidence) {
        // The library has what is left as a difference of sums that weights of clean meshes make large.
        assert!((found - expected).abs() < 1e-5 * (1.0 + expected.abs()), "{found} for {expected}: {what}");
    }
    found
}

#[test]
fn meshes_of_all_kinds_teach_what_the_oracle_learns() {
    let torus = mesh::torus(24, 15, 0.3, 0.0, 1);
    let normals: Vec<Vector> = torus.positions.iter().map(|&p| bodies::exact_torus(p).0).collect();
    for mesh in [
        torus.clone(),
        mesh::torus(18, 12, 0.3, 1.0, 3),
        mesh::height_field(15, 0.4, 5),
        bodies::noisy(&torus, &normals, 0.02, 2),
        bodies::noisy(&torus, &normals, 0.2, 3),
        bodies::spiked(&torus, &normals, &bodies::some(&torus, 40, 4), 3.0),
        bodies::random_sphere(200, 6).mapped(|[x, y, z]| [x, 1.5 * y, 2.2 * z]),
        mesh::dual_sphere(&mesh::quad_sphere(5, 0.6, 6)).mapped(|[x, y, z]| [x, 1.2 * y, 0.8 * z + 0.1 * x * y]),
        bodies::cube(6, 0.25, 1).mesh.mapped(|[x, y, z]| [x + 0.1 * z * y, y - 0.2 * x * z, z + 0.05 * x * y]),
        bodies::capped_cylinder(20, 2).mesh.mapped(|[x, y, z]| [x + 0.1 * z * y, y - 0.2 * x * z, z]),
        mesh::torus(45, 24, 0.3, 0.2, 9),
    ] {
        let model = compare(&mesh);
        assert_eq!((model.noise_exponent, model.size_exponent), (0, 0), "edges are alike: {}", mesh.name);
    }
}

#[test]
fn graded_meshes_teach_how_noise_and_sizes_go_with_edges() {
    let flat = bodies::height_grid(&bodies::graded(18, 10.0), 8);
    let up: Vec<Vector> = flat.positions.iter().map(|&p| bodies::exact_height(p).0).collect();
    let clean = compare(&flat);
    // Noise in parts of the mean edge, the same everywhere, or in proportion to the edges of the vertex, or to their squares.
    let oracle = common::adaptive_oracle::AdaptiveOracle::new(&flat);
    for power in 0..3 {
        let scaled: Vec<Vector> = up
            .iter()
            .zip(&oracle.around)
            .map(|(&n, around)| scale(n, (around.length / clean.edge_length).powi(power)))
            .collect();
        let model = compare(&bodies::noisy(&flat, &scaled, 0.03, 9));
        assert_eq!(i32::from(model.noise_exponent), power);
    }
    // The same shape and the same noise in three sizes.
    let ellipsoid = bodies::random_sphere(100, 3).mapped(|[x, y, z]| [x, 1.3 * y, 0.8 * z]);
    let ellipsoid = bodies::noisy(&ellipsoid, &ellipsoid.positions, 0.02, 4);
    let (mut positions, mut faces) = (vec![], vec![]);
    for size in [1.0, 0.2, 5.0] {
        let first = positions.len() as u32;
        positions.extend(ellipsoid.positions.iter().map(|&p| add(scale(p, size), [20.0 * size, 0.0, 0.0])));
        faces.extend(ellipsoid.faces().map(|face| face.iter().map(|v| v + first).collect()));
    }
    let model = compare(&Mesh::new("three sizes", positions, faces));
    assert_eq!((model.noise_exponent, model.size_exponent), (1, 1));
}

#[test]
fn a_loud_half_is_heard_only_if_the_evidence_is_overwhelming() {
    let torus = mesh::torus(24, 15, 0.2, 0.0, 1);
    let loud = |part: f64, from: f64| {
        let toward = |p: &Vector| scale(bodies::exact_torus(*p).0, (p[0] > from).into());
        bodies::noisy(&torus, &torus.positions.iter().map(toward).collect::<Vec<_>>(), part, 2)
    };
    for (part, from) in [(0.05, 0.0), (0.2, 0.6), (0.3, 0.3)] {
        compare(&loud(part, from));
    }
}

#[test]
fn the_coordinates_with_more_evidence_are_chosen() {
    let mut chosen = vec![];
    for seed in 0..4 {
        let sphere = bodies::random_sphere(150, seed);
        let wave =
            mesh::height_field(14, 0.0, seed).mapped(|[x, y, _]| [x, y, 0.2 * (2.5 * x).sin() * (2.0 * y).cos()]);
        for mesh in [sphere.mapped(|[x, y, z]| [x, 1.2 * y, 1.1 * z]), wave, mesh::height_field(12, 0.3, seed)] {
            let AdaptiveModel { evidence: [height, circle], coordinates, .. } = learned(&mesh);
            assert!(height != 0.0 && circle != 0.0, "both were looked at");
            assert_eq!(coordinates == Coordinates::Circle, circle > height, "{}: {height} {circle}", mesh.name);
            chosen.push(coordinates);
        }
    }
    assert!(chosen.contains(&Coordinates::Height) && chosen.contains(&Coordinates::Circle), "{chosen:?}");
}

#[test]
fn few_vertices_to_learn_from_leave_nothing_to_choose() {
    let mut random = Random::new(1);
    for mesh in [mesh::tetrahedron_sphere(1), mesh::fan(7, true, 1), bodies::random_sphere(20, 3)] {
        let shaken = mesh.positions.iter().map(|&p| add(p, [(); 3].map(|()| 0.05 * random.signed()))).collect();
        let model = compare(&Mesh { positions: shaken, ..mesh });
        assert_eq!((model.coordinates, model.evidence[0]), (Coordinates::Circle, 0.0));
    }
    // And where there is no edge at all, made-up numbers that can be handed in stand for those of the mesh.
    for mesh in [Mesh::new("nothing", vec![], vec![]), Mesh::new("point", vec![[1.0; 3]; 3], vec![vec![0, 1, 2]])] {
        let model = learned(&mesh);
        assert_eq!((model.sample, model.edge_length), (0, 1.0));
        jets(&mesh, Some(model), 0);
    }
}
