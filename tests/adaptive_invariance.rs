//! What must not matter to adaptive jets does not: threads, vectors, which vertices are asked for, precision and place of the
//! arrays; where a mesh stands, how large it is, which way its faces go round, how its vertices are numbered.

mod common;
use common::adaptive::{Fitted, fitted, jets, learned, numbers, topology};
use common::bodies;
use common::linear::{conjugated, rotation, times};
use common::mesh::{self, Mesh};
use common::{Random, Vector, add, largest_difference, scale};
use umbilic::*;

/// Smooth ones, clean and noisy.
fn smooth() -> Vec<Mesh> {
    let torus = mesh::torus(18, 11, 0.25, 0.0, 1);
    let normals: Vec<Vector> = torus.positions.iter().map(|&p| bodies::exact_torus(p).0).collect();
    let graded = bodies::height_grid(&bodies::graded(11, 8.0), 3);
    let up: Vec<Vector> = graded.positions.iter().map(|&p| bodies::exact_height(p).0).collect();
    vec![
        bodies::noisy(&torus, &normals, 0.05, 2),
        bodies::noisy(&graded, &up, 0.02, 5),
        mesh::torus(15, 10, 0.25, 0.6, 2),
        mesh::height_field(11, 0.4, 4),
        mesh::dual_sphere(&mesh::quad_sphere(4, 0.5, 5)).mapped(|[x, y, z]| [x, 1.2 * y, 0.8 * z + 0.1 * x * y]),
        torus,
        graded,
    ]
}

/// And of every other kind: creases, spikes, tiny meshes, many faces at a vertex, soups.
fn all_kinds() -> Vec<Mesh> {
    let mut meshes = smooth();
    let torus = meshes[0].clone();
    let normals: Vec<Vector> = torus.positions.iter().map(|&p| bodies::exact_torus(p).0).collect();
    let cube = bodies::cube(5, 0.25, 1);
    meshes.extend([
        bodies::spiked(&torus, &normals, &bodies::some(&torus, 30, 6), 3.0),
        bodies::spiked(&torus, &normals, &bodies::some(&torus, 20, 7), 0.6),
        bodies::noisy(&cube.mesh, &cube.normals, 0.02, 8),
        bodies::capped_cylinder(16, 9).mesh,
        mesh::letter_prism(),
        mesh::fan(40, true, 6),
        mesh::fan(300, false, 7),
        mesh::tetrahedron_sphere(1),
    ]);
    for seed in 0..3 {
        meshes.push(mesh::soup(60, 90, 3, seed));
        meshes.push(mesh::soup(30, 40, 7, 10 + seed));
    }
    meshes
}

/// No model, the one that the mesh teaches, and one that is much too sure of itself, so that fits are repeated.
fn models(mesh: &Mesh) -> [Option<AdaptiveModel>; 3] {
    let own = learned(mesh);
    let (noise, sizes) = (1e-3 * own.edge_length, [0.1, 0.01, 1e-3, 1e-4]);
    let sure = AdaptiveModel { noise, sizes, noise_exponent: 0, coordinates: Coordinates::Height, ..own };
    [None, Some(own), Some(sure)]
}

fn with(topology: &Topology, points: &Points<'_>, model: Option<AdaptiveModel>, run: Run<'_>) -> Fitted {
    fitted(topology, points, &CurvatureOptions { model, ..CurvatureOptions::default() }, run, -77.5).unwrap()
}

/// Threads and vectors of all kinds.
fn runs() -> Vec<(usize, Level)> {
    let levels = Level::all();
    levels
        .iter()
        .map(|&level| (1, level))
        .chain((2..=4).map(|threads| (threads, levels[threads % levels.len()])))
        .collect()
}

#[test]
fn threads_and_vectors_change_no_bit() {
    let large = [mesh::torus(60, 30, 0.4, 0.3, 8)];
    for mesh in all_kinds().into_iter().chain(large) {
        let (topology, points) = (topology(&mesh), Points::from(&mesh.positions));
        let own = learned(&mesh);
        for model in models(&mesh) {
            let expected = with(&topology, &points, model, Run { threads: 1, ..Run::default() }).all_bits();
            for (threads, level) in runs() {
                let run = || Run { threads, level, ..Run::default() };
                let found = with(&topology, &points, model, run()).all_bits();
                assert!(found == expected, "{}, {threads} threads, {level:?}", mesh.name);
                if model.is_none() {
                    let model = learn_model(&topology, &points, run()).unwrap();
                    assert_eq!(numbers(&model).map(f64::to_bits), numbers(&own).map(f64::to_bits), "{}", mesh.name);
                    assert_eq!(model, own);
                }
            }
            if model == Some(own) {
                // What a call learns by itself is what it would have been given.
                assert!(with(&topology, &points, None, Run::default()).all_bits() == expected, "{}", mesh.name);
            }
        }
    }
}

#[test]
fn a_list_of_vertices_has_the_bits_of_the_whole() {
    for (seed, mesh) in all_kinds().into_iter().enumerate() {
        let (topology, points) = (topology(&mesh), Points::from(&mesh.positions));
        let mut random = Random::new(seed as u64);
        let count = mesh.positions.len();
        // In no order, some twice; and one alone.
        let lists = [(0..count / 4).map(|_| random.below(count) as u32).collect(), vec![count as u32 / 3]];
        for model in models(&mesh) {
            let whole = with(&topology, &points, model, Run::default());
            for (list, (threads, level)) in
                lists.iter().flat_map(|list| runs().into_iter().map(move |run| (list, run)))
            {
                let run = Run { threads, level, vertices: Some(list), ..Run::default() };
                let part = with(&topology, &points, model, run);
                for vertex in 0..count {
                    if list.contains(&(vertex as u32)) {
                        assert_eq!(part.bits(vertex), whole.bits(vertex), "{}, vertex {vertex}", mesh.name);
                    } else {
                        let untouched = part.status[vertex] == 0xa5 && part.at(vertex).iter().all(|x| *x == -77.5);
                        assert!(untouched, "{}, vertex {vertex}", mesh.name);
                    }
                }
            }
        }
    }
}

#[test]
fn normals_and_single_outputs_have_the_bits_of_all() {
    for mesh in all_kinds() {
        let (topology, points) = (topology(&mesh), Points::from(&mesh.positions));
        for model in models(&mesh) {
            let all = with(&topology, &points, model, Run::default());
            let count = mesh.positions.len();
            let (mut normal, mut status) = (vec![[0.0; 3]; count], vec![0; count]);
            let outputs = NormalOutputs {
                normal: Some(normal.as_mut_slice().into()),
                status: Some(status.as_mut_slice().into()),
                ..NormalOutputs::default()
            };
            let weight = Weight::AdaptiveJet(AdaptiveOptions { rings: 0, model });
            vertex_normals(&topology, &points, weight, Run::default(), &outputs).unwrap();
            for vertex in 0..count {
                // Curvatures may be beyond what is computed where normals are not.
                if all.status[vertex] == status[vertex] {
                    let same = normal[vertex].map(f64::to_bits) == all.normal[vertex].map(f64::to_bits);
                    assert!(same, "{}, vertex {vertex}", mesh.name);
                } else {
                    assert!(all.status[vertex] & (status::DEGENERATE | status::FALLBACK) != 0, "{}", mesh.name);
                }
            }
            let options = CurvatureOptions { model, ..CurvatureOptions::default() };
            let mut k1 = vec![0.0f64; count];
            let outputs = CurvatureOutputs { k1: Some(k1.as_mut_slice().into()), ..CurvatureOutputs::default() };
            curvatures(&topology, &points, &options, Run::default(), &outputs).unwrap();
            assert!(k1.iter().zip(&all.k1).all(|(one, all)| one.to_bits() == all.to_bits()), "{}", mesh.name);
        }
    }
}

#[test]
fn single_precision_and_strided_positions_are_the_same_numbers() {
    for mesh in all_kinds() {
        let (topology, mesh) = (topology(&mesh), mesh.rounded());
        let single = mesh.single();
        // Records of five numbers each, the position at the second.
        let records: Vec<f64> = mesh.positions.iter().flat_map(|&[x, y, z]| [f64::NAN, x, y, z, f64::NAN]).collect();
        // SAFETY: there are as many records, each of 40 bytes.
        let strided = unsafe { Points::from_raw_f64(records[1..].as_ptr(), mesh.positions.len(), 40) }.unwrap();
        for model in models(&mesh) {
            let expected = with(&topology, &Points::from(&mesh.positions), model, Run::default()).all_bits();
            for points in [Points::from(&single), strided] {
                assert!(with(&topology, &points, model, Run::default()).all_bits() == expected, "{}", mesh.name);
            }
        }
        let count = mesh.positions.len();
        let mut records = vec![[7.0f64; 6]; count];
        // SAFETY: likewise, and nothing else looks at them.
        let output = unsafe { Output::from_raw_f64(records.as_mut_ptr().cast::<f64>().wrapping_add(2), count, 48) };
        let outputs = CurvatureOutputs { normal: Some(output.unwrap()), ..CurvatureOutputs::default() };
        curvatures(&topology, &Points::from(&single), &CurvatureOptions::default(), Run::default(), &outputs)
            .unwrap();
        for (record, normal) in records.iter().zip(&jets(&mesh, None, 0).normal) {
            let [x, y, z] = *normal;
            assert_eq!(record.map(f64::to_bits), [7.0, 7.0, x, y, z, 7.0].map(f64::to_bits), "{}", mesh.name);
        }
    }
}

const IDENTITY: [Vector; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Compares vertex `w` of `b` with vertex `v` of `a` after `turn` and growth by `grow`.
fn alike(
    (a, v): (&Fitted, usize),
    (b, w): (&Fitted, usize),
    turn: &[Vector; 3],
    grow: f64,
    tolerance: f64,
    what: &str,
) {
    assert_eq!(a.status[v], b.status[w], "{what}, vertex {v}");
    let unit = a.k1[v].abs().max(a.k2[v].abs()) + 1e-3;
    let near = |name: &str, expected: f64, found: f64, unit: f64| {
        let difference = (expected - found).abs();
        assert!(difference <= tolerance * unit, "{what}, vertex {v}, {name}: {found:e} for {expected:e}");
    };
    for (name, a, b) in [("k1", a.k1[v], b.k1[w]), ("k2", a.k2[v], b.k2[w]), ("mean", a.mean[v], b.mean[w])] {
        near(name, a, b * grow, unit);
    }
    near("gaussian", a.gaussian[v], b.gaussian[w] * grow * grow, unit * unit);
    near("residual", a.residual[v], b.residual[w] / grow, 0.1);
    near("freedom", a.freedom[v], b.freedom[w], 15.0);
    let difference = largest_difference(times(turn, a.normal[v]), b.normal[w]);
    near("normal", 0.0, difference, 1.0);
    let (expected, found) = (conjugated(turn, &a.tensor(v)), b.tensor(w).map(|row| scale(row, grow)));
    for row in 0..3 {
        near("tensor", 0.0, largest_difference(expected[row], found[row]), unit);
    }
}

/// Models of a mesh and of the same grown: learned by the call, and handed in.
fn grown(mesh: &Mesh, grow: f64) -> [(Option<AdaptiveModel>, Option<AdaptiveModel>); 2] {
    let own = learned(mesh);
    let large = AdaptiveModel { edge_length: own.edge_length * grow, noise: own.noise * grow, ..own };
    [(None, None), (Some(own), Some(large))]
}

#[test]
fn rotation_turns_normals_and_directions_and_nothing_else() {
    let tiny =
        [bodies::random_sphere(12, 1), bodies::random_sphere(6, 2), mesh::fan(5, true, 3), mesh::fan(4, false, 4)];
    for (seed, mesh) in smooth().into_iter().chain(tiny).enumerate() {
        let turn = rotation(seed as u64);
        let turned = mesh.mapped(|p| times(&turn, p));
        for (model, _) in grown(&mesh, 1.0) {
            let (before, after) = (jets(&mesh, model, 0), jets(&turned, model, 0));
            for v in 0..mesh.positions.len() {
                alike((&before, v), (&after, v), &turn, 1.0, 1e-6, &mesh.name);
            }
        }
    }
}

#[test]
fn translation_changes_no_bit_while_coordinates_have_room_for_it() {
    for mesh in all_kinds() {
        // Multiples of 2^-20, moved by powers of two: every sum is exact.
        let mesh = mesh.mapped(|p| p.map(|x| (x * 1048576.0).round() / 1048576.0));
        for offset in [[1024.0, -512.0, 2.0], [-67108864.0, 134217728.0, 268435456.0]] {
            let moved = mesh.mapped(|p| add(p, offset));
            for model in models(&mesh) {
                assert!(jets(&mesh, model, 0).all_bits() == jets(&moved, model, 0).all_bits(), "{}", mesh.name);
            }
        }
    }
}

#[test]
fn scaling_by_powers_of_two_scales_the_bits_and_others_the_numbers() {
    for mesh in all_kinds() {
        for power in [-300, -40, 121] {
            let factor = 2f64.powi(power);
            let scaled = mesh.mapped(|p| scale(p, factor));
            for (small, large) in grown(&mesh, factor) {
                let (before, mut after) = (jets(&mesh, small, 0), jets(&scaled, large, 0));
                for numbers in [&mut after.k1, &mut after.k2, &mut after.mean] {
                    numbers.iter_mut().for_each(|x| *x *= factor);
                }
                after.gaussian.iter_mut().for_each(|x| *x = *x * factor * factor);
                after.residual.iter_mut().for_each(|x| *x /= factor);
                for vertex in 0..mesh.positions.len() {
                    assert_eq!(before.bits(vertex), after.bits(vertex), "{}, 2^{power}, vertex {vertex}", mesh.name);
                }
            }
        }
    }
    for mesh in smooth() {
        for factor in [3.0, 1e-100, 1e100] {
            let scaled = mesh.mapped(|p| scale(p, factor));
            for (small, large) in grown(&mesh, factor) {
                let (before, after) = (jets(&mesh, small, 0), jets(&scaled, large, 0));
                for v in 0..mesh.positions.len() {
                    alike((&before, v), (&after, v), &IDENTITY, factor, 1e-6, &mesh.name);
                }
            }
        }
    }
}

#[test]
fn reversed_faces_turn_signs() {
    for mesh in smooth() {
        for (model, _) in grown(&mesh, 1.0) {
            let (before, mut after) = (jets(&mesh, model, 0), jets(&mesh.reversed(), model, 0));
            // What it would be on the other side.
            let Fitted { k1, k2, mean, direction1, direction2, normal, .. } = &mut after;
            std::mem::swap(k1, k2);
            std::mem::swap(direction1, direction2);
            [k1, k2, mean].into_iter().flatten().for_each(|k| *k = -*k);
            normal.iter_mut().for_each(|n| *n = scale(*n, -1.0));
            for v in 0..mesh.positions.len() {
                alike((&before, v), (&after, v), &IDENTITY, 1.0, 1e-6, &mesh.name);
            }
        }
    }
}

#[test]
fn numbering_does_not_matter() {
    for (seed, mesh) in all_kinds().into_iter().enumerate() {
        let mut random = Random::new(seed as u64);
        let count = mesh.positions.len();
        let in_sample = count <= 256;
        let mut place: Vec<usize> = (0..count).collect();
        (1..count).rev().for_each(|i| place.swap(i, random.below(i + 1)));
        let mut positions = vec![[0.0; 3]; count];
        place.iter().enumerate().for_each(|(vertex, &new)| positions[new] = mesh.positions[vertex]);
        // Faces and their first corners stay, so rings go round in the same order.
        let faces = mesh.faces().map(|face| face.iter().map(|&v| place[v as usize] as u32).collect()).collect();
        let other = Mesh::new(&mesh.name, positions, faces);
        let [_, own, sure] = models(&mesh);
        for model in [own, sure] {
            let (before, after) = (jets(&mesh, model, 0), jets(&other, model, 0));
            for (v, &new) in place.iter().enumerate() {
                assert_eq!(before.bits(v), after.bits(new), "{}, vertex {v}", mesh.name);
            }
        }
        if !in_sample {
            continue;
        }
        // What is learned is added up in another order.
        let (before, after) = (learned(&mesh), learned(&other));
        for (before, after) in numbers(&before).into_iter().zip(numbers(&after)) {
            assert!((before / after - 1.0).abs() < 1e-6, "{}: {before} {after}", mesh.name);
        }
    }
}
