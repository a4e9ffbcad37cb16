//! The library against a naive oracle in double precision, on generated, random and real meshes.
//!
//! A vertex is left out only where the oracle itself says that its sum is ill-conditioned: `condition` times the rounding
//! unit comes near the tolerance. In single precision the library must notice that by itself and work in double.
// Every call keeps the contract that the header states; where a test breaks it on purpose, that is the test.
#![allow(clippy::undocumented_unsafe_blocks)]

mod common;
use common::capi::{Handle, WEIGHTS, normals, widened};
use common::mesh::{self, Mesh};
use common::oracle::{Oracle, worst};
use common::{length, real, sub};
use umbilic::Weight;
use umbilic::capi::*;

fn meshes() -> Vec<Mesh> {
    let mut meshes = vec![
        mesh::ring_sphere(9, 5),
        mesh::ring_sphere(200, 3),
        mesh::tetrahedron_sphere(3),
        mesh::torus(40, 24, 0.3, 0.0, 1),
        mesh::torus(30, 20, 0.2, 0.7, 2),
        mesh::height_field(30, 0.0, 3),
        mesh::height_field(25, 0.5, 4),
        mesh::letter_prism(),
        mesh::fan(3, true, 5),
        mesh::fan(17, true, 6),
        mesh::fan(1000, true, 7),
        mesh::fan(1000, false, 8),
        mesh::fan(2, false, 9),
    ];
    for seed in 0..60 {
        meshes.push(mesh::soup(40, 60, 3, seed));
        meshes.push(mesh::soup(30, 40, 6, 100 + seed));
    }
    meshes.extend(real::meshes());
    meshes
}

/// Beyond this condition the oracle's own rounding comes near the tolerance.
const CONDITION_DOUBLE: f64 = 1e-13 / f64::EPSILON / 8.0;
const CONDITION_SINGLE: f64 = 1e9;

#[test]
fn double_precision_agrees_to_1e_13() {
    let (mut compared, mut skipped) = (0, 0);
    for mesh in meshes() {
        let oracle = Oracle::new(&mesh);
        let handle = Handle::new(&mesh);
        for weight in WEIGHTS {
            let found = normals(&handle, &mesh.positions, weight, false, |_| ());
            let answers: Vec<_> =
                (0..mesh.positions.len()).map(|v| oracle.normal(v, Weight::ALL[weight as usize])).collect();
            let keep = |v: usize| answers[v].condition < CONDITION_DOUBLE;
            let (difference, vertex) = worst(&found.normal, |v| answers[v].normal, keep);
            assert!(
                difference <= 1e-13,
                "{}, weight {weight}, vertex {vertex}: {difference:e}, condition {}: {:?} {:?}",
                mesh.name,
                answers[vertex].condition,
                found.normal[vertex],
                answers[vertex].normal
            );
            let kept = (0..mesh.positions.len()).filter(|&v| keep(v)).count();
            compared += kept;
            // An isolated vertex is rightly zero, not skipped.
            skipped += (0..mesh.positions.len()).filter(|&v| !keep(v) && !oracle.corners(v).is_empty()).count();
        }
    }
    println!("{compared} normals compared, {skipped} ill-conditioned ones not");
    assert!(skipped * 10 < compared, "{skipped} of {compared}");
}

#[test]
fn single_precision_agrees_to_2e_6() {
    let (mut compared, mut skipped) = (0, 0);
    for mesh in meshes() {
        let mesh = mesh.rounded();
        let oracle = Oracle::new(&mesh);
        let handle = Handle::new(&mesh);
        for weight in WEIGHTS {
            let found = normals(&handle, &mesh.single(), weight, false, |_| ());
            let answers: Vec<_> =
                (0..mesh.positions.len()).map(|v| oracle.normal(v, Weight::ALL[weight as usize])).collect();
            let keep = |v: usize| answers[v].condition < CONDITION_SINGLE;
            let (difference, vertex) = worst(&widened(&found.normal), |v| answers[v].normal, keep);
            assert!(
                difference <= 2e-6,
                "{}, weight {weight}, vertex {vertex}: {difference:e}, condition {}: {:?} {:?}",
                mesh.name,
                answers[vertex].condition,
                found.normal[vertex],
                answers[vertex].normal
            );
            compared += (0..mesh.positions.len()).filter(|&v| keep(v)).count();
            skipped += (0..mesh.positions.len()).filter(|&v| !keep(v) && !oracle.corners(v).is_empty()).count();
        }
    }
    println!("{compared} normals compared, {skipped} ill-conditioned ones not");
    assert!(skipped * 100 < compared, "{skipped} of {compared}");
}

#[test]
fn sums_are_those_of_the_definitions() {
    for mesh in [mesh::torus(20, 12, 0.3, 0.5, 1), mesh::height_field(12, 0.3, 2), mesh::soup(20, 30, 3, 3)] {
        let oracle = Oracle::new(&mesh);
        for weight in WEIGHTS {
            let found = normals(&Handle::new(&mesh), &mesh.positions, weight, true, |_| ());
            for vertex in 0..mesh.positions.len() {
                let answer = oracle.normal(vertex, Weight::ALL[weight as usize]);
                if answer.condition < CONDITION_DOUBLE && found.status[vertex] & UMB_VERTEX_FALLBACK == 0 {
                    let difference = length(sub(found.sum[vertex], answer.sum));
                    assert!(
                        difference <= 1e-12 * length(answer.sum),
                        "{}, weight {weight}, vertex {vertex}: {:?} {:?}",
                        mesh.name,
                        found.sum[vertex],
                        answer.sum
                    );
                }
            }
        }
    }
}

#[test]
fn fans_are_those_of_the_oracle() {
    for mesh in meshes() {
        let oracle = Oracle::new(&mesh);
        let faces = umbilic::Faces::polygons(&mesh.indices, &mesh.offsets).unwrap();
        let topology = umbilic::Topology::new(&faces, mesh.positions.len()).unwrap();
        for vertex in 0..mesh.positions.len() {
            let mut expected: Vec<Vec<u32>> = oracle
                .fans(vertex)
                .iter()
                .map(|(fan, closed)| {
                    let mut ring: Vec<u32> = fan.iter().map(|corner| corner.next).collect();
                    if *closed {
                        let lowest = ring.iter().enumerate().min_by_key(|(_, v)| **v).unwrap().0;
                        ring.rotate_left(lowest);
                    } else {
                        ring.push(fan.last().unwrap().prev);
                    }
                    ring
                })
                .collect();
            let mut found: Vec<Vec<u32>> = topology
                .fans(vertex)
                .map(|fan| {
                    let mut ring = fan.neighbours.to_vec();
                    assert_eq!(ring.len(), fan.corner_count + !fan.closed as usize);
                    if fan.closed {
                        let lowest = ring.iter().enumerate().min_by_key(|(_, v)| **v).unwrap().0;
                        ring.rotate_left(lowest);
                    }
                    ring
                })
                .collect();
            expected.sort();
            found.sort();
            assert_eq!(found, expected, "{}, vertex {vertex}", mesh.name);
        }
    }
}

#[test]
fn normals_from_faces_agree_with_those_of_a_topology() {
    for mesh in meshes() {
        let handle = Handle::new(&mesh);
        for weight in WEIGHTS {
            let swept = normals(&handle, &mesh.positions, weight, false, |_| ());
            let oracle = Oracle::new(&mesh);
            let mut found = vec![[0.0f64; 3]; mesh.positions.len()];
            let mut options: umb_normal_options = common::capi::zeroed();
            options.weight = weight;
            let mut outputs: umb_normal_outputs = common::capi::zeroed();
            outputs.normal = common::capi::output(&mut found);
            let status = unsafe {
                umb_vertex_normals_from_faces(
                    &common::capi::faces(&mesh),
                    &common::capi::points(&mesh.positions),
                    &options,
                    &outputs,
                    std::ptr::null_mut(),
                )
            };
            assert_eq!(status, UMB_OK);
            let conditions: Vec<f64> =
                (0..mesh.positions.len()).map(|v| oracle.normal(v, Weight::ALL[weight as usize]).condition).collect();
            let (difference, vertex) = worst(&found, |v| swept.normal[v], |v| conditions[v] < CONDITION_DOUBLE);
            assert!(difference <= 1e-13, "{}, weight {weight}, vertex {vertex}: {difference:e}", mesh.name);
        }
    }
}
