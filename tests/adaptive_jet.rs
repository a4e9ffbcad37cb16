//! Adaptive jets against an oracle, one vertex at a time: learned models and made-up ones, both coordinates, noise and sizes that go
//! with edges in every way, three to six rings; clean, noisy, spiked, creased and tiny meshes.
//!
//! **Tolerance.** 1e-9 of the vertex's curvature (of a thousandth of the inverse of its edges where it is flatter than that), and ten
//! times what the oracle's own answer changes by when positions move by 1e-12 of the edges at them; and twenty roundings times the
//! square of the condition, which normal equations lose. Where this allows more than 1e-6 the comparison says little, and counts as
//! ill-conditioned.
//!
//! **Left out,** and counted: vertices where a decision of the oracle is within 1e-7 of going the other way.

mod common;
use common::adaptive::{Fitted, jets, learned, topology};
use common::adaptive_oracle::{AdaptiveOracle, Expected, rings_by_itself};
use common::answer::Answer;
use common::bodies;
use common::curvature_oracle::CurvatureOracle;
use common::householder::factored;
use common::mesh::{self, Mesh};
use common::{Random, Vector, add, scale};
use umbilic::capi::UMB_SECTION_CIRCLE;
use umbilic::{AdaptiveModel, Coordinates, status};

const NEAR: f64 = 1e-7;

/// Of each kind, how many vertices there were.
#[derive(Debug, Default)]
struct Count {
    compared: usize,
    ill: usize,
    left_out: usize,
    creases: usize,
    repeated: usize,
    noisier: usize,
    few: usize,
}

/// The same, moved by 1e-12 of the edges.
fn moved(mesh: &Mesh, oracle: &AdaptiveOracle<'_>, seed: u64) -> Mesh {
    let (mut random, mut copy) = (Random::new(seed), mesh.clone());
    for (position, around) in copy.positions.iter_mut().zip(&oracle.around) {
        *position = add(*position, [(); 3].map(|()| 1e-12 * around.length * random.signed()));
    }
    copy
}

/// The numbers of an answer with their units: a curvature, and that of what a fit leaves.
fn numbers(normal: &Vector, answer: &Answer, freedom: f64, [curvature, left]: [f64; 2]) -> Vec<(f64, f64)> {
    let mut numbers: Vec<(f64, f64)> = normal.iter().map(|&x| (x, 1.0)).collect();
    numbers.extend([answer.k[0], answer.k[1], answer.mean].map(|k| (k, curvature)));
    numbers.extend(answer.tensor.iter().flatten().map(|&k| (k, curvature)));
    numbers.extend([(answer.gaussian, curvature * curvature), (answer.residual, left), (freedom, 10.0)]);
    numbers
}

fn of_expected(expected: &Expected, units: [f64; 2]) -> Vec<(f64, f64)> {
    numbers(&expected.normal, &expected.answer, expected.freedom, units)
}

fn of_found(found: &Fitted, vertex: usize, units: [f64; 2]) -> Vec<(f64, f64)> {
    let answer = Answer {
        k: [found.k1[vertex], found.k2[vertex]],
        mean: found.mean[vertex],
        gaussian: found.gaussian[vertex],
        tensor: found.tensor(vertex),
        residual: found.residual[vertex],
        ..Answer::default()
    };
    numbers(&found.normal[vertex], &answer, found.freedom[vertex], units)
}

/// The oracle's answer with the sections of a crease filled in.
fn ask(
    oracle: &AdaptiveOracle<'_>,
    mesh: &Mesh,
    vertex: usize,
    model: &AdaptiveModel,
    rings: usize,
) -> Option<Expected> {
    let mut expected = oracle.expected(vertex, model, rings)?;
    if expected.crease {
        let mut normals = vec![[0.0; 3]; mesh.positions.len()];
        normals[vertex] = expected.normal;
        let answer = CurvatureOracle::new(mesh, &normals).least_squares(vertex, UMB_SECTION_CIRCLE)?;
        // Nothing is said of how well a shape operator fits the sections.
        expected.answer = Answer { residual: 0.0, ..answer };
    }
    Some(expected)
}

/// Compares a call with the oracle, on every so many vertices.
fn compare(mesh: &Mesh, model: &AdaptiveModel, rings: usize, step: usize, count: &mut Count) {
    let found = jets(mesh, Some(*model), rings);
    let flags = topology(mesh).flags().to_vec();
    let rings = if rings == 0 { rings_by_itself(model) } else { rings };
    let oracle = AdaptiveOracle::new(mesh);
    let others = [1, 2].map(|seed| moved(mesh, &oracle, seed));
    let others = others.each_ref().map(|mesh| (AdaptiveOracle::new(mesh), mesh));
    for vertex in (0..mesh.positions.len()).step_by(step) {
        let what = format!("{}, vertex {vertex}, {rings} rings, {model:?}", mesh.name);
        let Some(expected) = ask(&oracle, mesh, vertex, model, rings) else { continue };
        if expected.nearest < NEAR {
            count.left_out += 1;
            continue;
        }
        let sharp = if expected.sharp { status::CREASE } else { 0 };
        let crease = if expected.crease { status::FALLBACK } else { 0 };
        assert_eq!(found.status[vertex], flags[vertex] | sharp | crease, "{what}");
        let length = oracle.around[vertex].length;
        let curvature = expected.answer.k[0].abs().max(expected.answer.k[1].abs()) + 1e-3 / length;
        let units = [curvature, length];
        let expect = of_expected(&expected, units);
        let changed = others
            .each_ref()
            .map(|(other, mesh)| of_expected(&ask(other, mesh, vertex, model, rings).unwrap(), units));
        let mut ill = false;
        for (index, (found, unit)) in of_found(&found, vertex, units).into_iter().enumerate() {
            let wanted = expect[index].0;
            let change = changed.iter().fold(0.0f64, |change, other| change.max((other[index].0 - wanted).abs()));
            let tolerance = 1e-9 * unit + 10.0 * change + 4e-15 * expected.squared_condition * unit;
            ill |= tolerance > 1e-6 * unit;
            let difference = (found - wanted).abs();
            assert!(
                difference <= tolerance,
                "{what}, number {index}: {found:e} for {wanted:e}, tolerance {tolerance:e}: {expected:?}"
            );
        }
        count.compared += 1;
        count.ill += ill as usize;
        count.creases += expected.crease as usize;
        count.repeated += expected.repeated as usize;
        count.noisier += expected.noisier as usize;
        count.few += oracle.framed(vertex, rings).is_some_and(|framed| framed.points.len() <= 8) as usize;
    }
}

/// Models of every kind for a mesh, each with a number of rings.
fn models(mesh: &Mesh) -> Vec<(AdaptiveModel, usize)> {
    let own = learned(mesh);
    let edge = own.edge_length;
    let made_up = |noise: f64, sizes, noise_exponent, size_exponent, coordinates| AdaptiveModel {
        noise: noise * edge,
        sizes,
        noise_exponent,
        size_exponent,
        coordinates,
        ..own
    };
    let other = match own.coordinates {
        Coordinates::Height => Coordinates::Circle,
        Coordinates::Circle => Coordinates::Height,
    };
    vec![
        (own, 0),
        (AdaptiveModel { coordinates: other, noise_exponent: 1, ..own }, 4),
        (made_up(0.02, [0.5, 0.3, 0.2, 0.1], 2, 1, Coordinates::Circle), 3),
        (made_up(1e-3, [0.3, 0.1, 0.05, 0.02], 0, 0, Coordinates::Height), 5),
        (made_up(0.1, [0.2, 0.05, 0.02, 0.01], 1, 1, Coordinates::Height), 6),
        (made_up(3e-3, [0.4, 0.1, 0.06, 0.03], 1, 0, Coordinates::Circle), 4),
        // Smoother than the mesh is: many points are off.
        (made_up(1e-3, [0.1, 0.01, 1e-3, 1e-4], 0, 0, Coordinates::Height), 3),
    ]
}

/// Compares on all models, about so many vertices each.
fn compare_all(meshes: &[Mesh], vertices: usize) -> Count {
    let mut count = Count::default();
    for mesh in meshes {
        for (place, (model, rings)) in models(mesh).into_iter().enumerate() {
            compare(mesh, &model, rings, 1 + (mesh.positions.len() + place) / vertices, &mut count);
        }
    }
    println!("{count:?}");
    assert!(count.left_out * 50 < count.compared && count.ill * 10 < count.compared, "{count:?}");
    count
}

fn ellipsoid(count: usize, seed: u64) -> Mesh {
    bodies::random_sphere(count, seed).mapped(|[x, y, z]| [x, 1.5 * y, 2.2 * z])
}

#[test]
fn smooth_meshes_have_the_fits_of_the_oracle() {
    let meshes = [
        mesh::torus(24, 15, 0.3, 0.0, 1),
        mesh::torus(20, 14, 0.3, 0.6, 2),
        mesh::torus(16, 12, 0.3, 1.0, 3),
        mesh::height_field(14, 0.0, 4),
        mesh::height_field(13, 0.5, 5),
        mesh::dual_sphere(&mesh::quad_sphere(5, 0.6, 6)).mapped(|[x, y, z]| [x, 1.2 * y, 0.8 * z + 0.1 * x * y]),
        ellipsoid(150, 7),
        bodies::height_grid(&bodies::graded(14, 30.0), 8),
    ];
    let count = compare_all(&meshes, 40);
    assert!(count.compared > 1500, "{count:?}");
}

#[test]
fn noisy_and_spiked_meshes_have_the_fits_of_the_oracle() {
    let torus = mesh::torus(24, 15, 0.3, 0.3, 1);
    let normals: Vec<Vector> = torus.positions.iter().map(|&p| bodies::exact_torus(p).0).collect();
    let half: Vec<Vector> =
        normals.iter().zip(&torus.positions).map(|(&n, p)| scale(n, (p[0] > 0.0).into())).collect();
    let graded = bodies::height_grid(&bodies::graded(14, 10.0), 8);
    let up: Vec<Vector> = graded.positions.iter().map(|&p| bodies::exact_height(p).0).collect();
    let spiked = |edges: f64, seed: u64| bodies::spiked(&torus, &normals, &bodies::some(&torus, 30, seed), edges);
    let meshes = [
        bodies::noisy(&torus, &normals, 0.02, 2),
        bodies::noisy(&torus, &normals, 0.1, 3),
        bodies::noisy(&torus, &half, 0.05, 4),
        spiked(3.0, 5),
        spiked(0.5, 6),
        bodies::noisy(&spiked(0.6, 7), &normals, 0.01, 8),
        bodies::noisy(&spiked(0.7, 9), &half, 0.06, 10),
        bodies::noisy(&graded, &up, 0.05, 9),
        bodies::spiked(&graded, &up, &bodies::some(&graded, 30, 10), 3.0),
    ];
    let count = compare_all(&meshes, 50);
    assert!(count.compared > 2500 && count.repeated > 120 && count.noisier > 20, "{count:?}");
}

#[test]
fn creased_and_tiny_meshes_have_the_fits_of_the_oracle() {
    let bend = |[x, y, z]: Vector| [x + 0.1 * z * y, y - 0.2 * x * z, z + 0.05 * x * y];
    let cube = bodies::cube(6, 0.25, 1);
    let cylinder = bodies::capped_cylinder(16, 2);
    let mut random = Random::new(3);
    let mut shaken = |mesh: &Mesh| {
        let mut mesh = mesh.clone();
        mesh.positions.iter_mut().for_each(|p| *p = add(*p, [(); 3].map(|()| 0.1 * random.signed())));
        mesh
    };
    let octahedron = bodies::hull(
        (0..6).map(|i| std::array::from_fn(|k| [1.0, -1.0][i % 2] * f64::from(u8::from(i / 2 == k)))).collect(),
    );
    let meshes = [
        cube.mesh.mapped(bend),
        bodies::noisy(&cube.mesh, &cube.normals, 0.02, 4),
        cylinder.mesh.mapped(bend),
        bodies::noisy(&cylinder.mesh, &cylinder.normals, 0.03, 5),
        mesh::letter_prism().mapped(bend),
        shaken(&mesh::tetrahedron_sphere(0)),
        shaken(&mesh::tetrahedron_sphere(1)),
        shaken(&octahedron),
        shaken(&mesh::quad_sphere(1, 0.0, 1)),
        mesh::fan(3, true, 6),
        mesh::fan(4, false, 7),
        mesh::fan(6, true, 8),
        mesh::fan(9, false, 9),
        shaken(&bodies::random_sphere(12, 10)),
        shaken(&bodies::random_sphere(30, 11)),
    ];
    let count = compare_all(&meshes, 40);
    assert!(count.compared > 1000 && count.creases > 60 && count.few > 100, "{count:?}");
}

#[test]
fn reflections_solve_a_system_of_rows_of_very_different_sizes() {
    let mut random = Random::new(1);
    let solution: Vec<f64> = (0..5).map(|_| random.signed()).collect();
    let rows: Vec<Vec<f64>> = (0..30)
        .map(|index| {
            let mut row: Vec<f64> = (0..5).map(|_| random.signed() * 10f64.powi(index % 17 - 8)).collect();
            row.push(row.iter().zip(&solution).map(|(a, x)| a * x).sum());
            row
        })
        .collect();
    let found = factored(&rows);
    for (found, expected) in found.solution().iter().zip(&solution) {
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
    // The leverages of all rows add up to the number of unknowns.
    let total: f64 = rows.iter().map(|row| found.leverage(&row[..5])).sum();
    assert!((total - 5.0).abs() < 1e-12, "{total}");
    let inverse: f64 = found.variances().iter().product();
    assert!(inverse > 0.0 && found.log_determinant().is_finite() && found.left < 1e-10);
}
