//! What must not matter to curvatures does not: where a mesh stands and how large it is, how its faces are numbered, which
//! vertices are asked for, by how many threads and with which vectors, and where the arrays lie.
// Every call keeps the contract that the header states.
#![allow(clippy::undocumented_unsafe_blocks)]

mod common;
use common::capi::{Handle, points, zeroed};
use common::curvature::*;
use common::linear::{conjugated, rotation, times};
use common::mesh::{self, Mesh};
use common::{Random, Vector, add, dot, largest_difference, length, scale};
use umbilic::capi::*;

/// Every method, and those of regions also with rings and balls.
fn calls(mesh_size: f64) -> Vec<umb_curvature_options> {
    let mut calls: Vec<umb_curvature_options> = METHODS.into_iter().map(options).collect();
    for method in [UMB_CURVATURE_NORMAL_CYCLE, UMB_CURVATURE_CORRECTED_MEASURE] {
        calls.push(umb_curvature_options { rings: 2, ..options(method) });
        calls.push(umb_curvature_options { radius: 0.4 * mesh_size, ..options(method) });
    }
    calls.push(umb_curvature_options { degree: 4, ..options(UMB_CURVATURE_JET) });
    calls.push(umb_curvature_options { rings: 2, ..options(UMB_CURVATURE_GOLDFEATHER) });
    calls.push(umb_curvature_options { section: UMB_SECTION_CIRCLE, ..options(UMB_CURVATURE_TAUBIN) });
    calls.push(umb_curvature_options { weight: UMB_WEIGHT_JET, ..options(UMB_CURVATURE_RUSINKIEWICZ) });
    calls
}

/// Smooth ones, on which no answer hangs on a threshold.
fn smooth() -> Vec<Mesh> {
    vec![
        mesh::torus(17, 13, 0.25, 0.0, 1),
        mesh::torus(15, 11, 0.25, 0.5, 2),
        mesh::height_field(11, 0.0, 3),
        mesh::height_field(10, 0.5, 4),
        mesh::dual_sphere(&mesh::quad_sphere(4, 0.5, 5)).mapped(|[x, y, z]| [x, 1.2 * y, 0.8 * z + 0.1 * x * y]),
    ]
}

fn all_kinds() -> Vec<Mesh> {
    let mut meshes = smooth();
    meshes.extend([mesh::letter_prism(), mesh::fan(40, true, 6), mesh::fan(300, false, 7)]);
    for seed in 0..4 {
        meshes.push(mesh::soup(40, 60, 3, seed));
        meshes.push(mesh::soup(30, 40, 7, 10 + seed));
    }
    meshes
}

/// Compares two answers at a vertex each, the second after `turn` and `grow` times as large, to `tolerance` of the curvature.
fn alike(
    (a, v): (&Found, usize),
    (b, w): (&Found, usize),
    turn: &[Vector; 3],
    grow: f64,
    tolerance: f64,
    what: &str,
) {
    if !a.known(v) || !b.known(w) {
        assert_eq!(a.known(v), b.known(w), "{what}, vertex {v}");
        return;
    }
    assert_eq!(a.status[v], b.status[w], "{what}, vertex {v}");
    if a.method == UMB_CURVATURE_MEYER {
        // At a corner of something flat the gradient of the area lies in the tangent plane: rounding says on which side.
        let gradient = a.vector(MeanNormal, v);
        if dot(gradient, a.vector(Normal, v)).abs() <= 1e-9 * length(gradient) {
            return;
        }
    }
    // The first mesh has size 1, and a corner of one triangle no curvature but rounding.
    let curvature = if a.has(Curvedness) { 1e-3 + a.at(Curvedness, v) + a.at(Mean, v).abs() } else { 0.0 };
    let area = if a.has(Area) { a.at(Area, v) } else { 0.0 };
    let defect = [UMB_CURVATURE_MEYER, UMB_CURVATURE_ANGLE_DEFECT].contains(&a.method);
    let gaussian = if defect { 1.0 / area } else { curvature * curvature };
    for output in OUTPUTS.into_iter().filter(|&output| a.has(output)) {
        let factor = grow.powi(power(output, a.method));
        let size = match output {
            // Roots: of a variance, and of H² − K.
            Residual => continue,
            K1 | K2 | Curvedness if defect || a.method == UMB_CURVATURE_WATANABE => {
                1e4 * (curvature + gaussian.sqrt())
            }
            K1 | K2 | Mean | MeanNormal | Curvedness => curvature,
            Gaussian => gaussian,
            Area => area,
            IntegratedMean => curvature * area,
            IntegratedGaussian => gaussian * area,
            // Of a matrix whose columns are those of the frame.
            Condition if *turn != IDENTITY => continue,
            Condition => 1e3 * a.at(Condition, v),
            DegreesOfFreedom => 15.0,
            Normal => 1.0,
            // Compared as a tensor below; the shape index jumps where both curvatures are near zero.
            Direction1 | Direction2 | ShapeIndex => continue,
        };
        let difference = if output.components() == 3 {
            largest_difference(scale(times(turn, a.vector(output, v)), factor), b.vector(output, w))
        } else {
            (a.at(output, v) * factor - b.at(output, w)).abs()
        };
        assert!(
            difference <= tolerance * size * factor,
            "{what}, vertex {v}, {output:?}: {difference:e} of {:e}",
            size * factor
        );
    }
    if a.has(Direction1) {
        let (expected, found) = (conjugated(turn, &tensor(a, v)), tensor(b, w));
        for row in 0..3 {
            let difference = largest_difference(scale(expected[row], 1.0 / grow), found[row]);
            assert!(difference <= tolerance * curvature / grow, "{what}, vertex {v}: {difference:e}");
        }
    }
}

const IDENTITY: [Vector; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

fn whole(mesh: &Mesh, options: &umb_curvature_options) -> Found {
    curvatures(&Handle::new(mesh), &mesh.positions, options)
}

fn name(mesh: &Mesh, options: &umb_curvature_options) -> String {
    format!("{}, method {}, rings {}, radius {}", mesh.name, options.method, options.rings, options.radius)
}

#[test]
fn rotation_turns_directions_and_nothing_else() {
    for (seed, mesh) in smooth().into_iter().enumerate() {
        let turn = rotation(seed as u64);
        let turned = mesh.mapped(|p| times(&turn, p));
        for options in calls(1.0) {
            let (before, after) = (whole(&mesh, &options), whole(&turned, &options));
            for v in 0..mesh.positions.len() {
                alike((&before, v), (&after, v), &turn, 1.0, 1e-8, &name(&mesh, &options));
            }
        }
    }
}

#[test]
fn any_size() {
    // Powers of two scale the bits; others leave what rounding the coordinates costs.
    for mesh in all_kinds() {
        for power_of_two in [-40, 7, 120] {
            let factor = 2f64.powi(power_of_two);
            let scaled = mesh.mapped(|p| scale(p, factor));
            for (small, large) in calls(1.0).into_iter().zip(calls(factor)) {
                let (before, after) = (whole(&mesh, &small), whole(&scaled, &large));
                assert_eq!(before.status, after.status);
                for output in OUTPUTS.into_iter().filter(|&output| before.has(output)) {
                    let factor = factor.powi(power(output, before.method));
                    let expected = before.all(output).iter().map(|x| (x * factor).to_bits());
                    let same = expected.eq(after.all(output).iter().map(|x| x.to_bits()));
                    assert!(same, "{}, {output:?}, 2^{power_of_two}", name(&mesh, &small));
                }
            }
        }
    }
    for mesh in smooth() {
        for factor in [3.0, 1e-150, 1e150] {
            let scaled = mesh.mapped(|p| scale(p, factor));
            for (small, large) in calls(1.0).into_iter().zip(calls(factor)) {
                let (before, after) = (whole(&mesh, &small), whole(&scaled, &large));
                // Squares of 1e±150 are still numbers: 1e±300.
                for v in 0..mesh.positions.len() {
                    alike((&before, v), (&after, v), &IDENTITY, factor, 1e-8, &name(&mesh, &small));
                }
            }
        }
    }
}

#[test]
fn a_mesh_far_away_is_the_mesh_of_its_rounded_coordinates() {
    for mesh in all_kinds() {
        let far = mesh.mapped(|p| add(p, [1e6, -1e6, 1e6]));
        let back = far.mapped(|p| add(p, [-1e6, 1e6, -1e6]));
        for options in calls(1.0) {
            let (far, back) = (whole(&far, &options), whole(&back, &options));
            assert_eq!(far.bits(), back.bits(), "{}", name(&mesh, &options));
        }
    }
}

#[test]
fn reversed_faces_turn_signs() {
    for mesh in smooth() {
        let reversed = mesh.reversed();
        for options in calls(1.0) {
            let (before, mut after) = (whole(&mesh, &options), whole(&reversed, &options));
            // What it would be on the other side: k1 and k2 trade places, and all of the first power changes its sign.
            after.values.swap(K1 as usize, K2 as usize);
            after.values.swap(Direction1 as usize, Direction2 as usize);
            for output in [K1, K2, Mean, IntegratedMean, Normal] {
                after.values[output as usize].iter_mut().for_each(|x| *x = -*x);
            }
            for v in 0..mesh.positions.len() {
                alike((&before, v), (&after, v), &IDENTITY, 1.0, 1e-9, &name(&mesh, &options));
                if before.known(v) && before.has(Direction1) && before.at(Curvedness, v) > 1e-3 {
                    assert!((before.at(ShapeIndex, v) + after.at(ShapeIndex, v)).abs() < 1e-9);
                }
            }
        }
    }
}

#[test]
fn numbering_does_not_matter() {
    for (seed, mesh) in smooth().into_iter().enumerate() {
        let mut random = Random::new(seed as u64);
        let count = mesh.positions.len();
        let mut place: Vec<usize> = (0..count).collect();
        (1..count).rev().for_each(|i| place.swap(i, random.below(i + 1)));
        let mut positions = vec![[0.0; 3]; count];
        place.iter().enumerate().for_each(|(vertex, &new)| positions[new] = mesh.positions[vertex]);
        let mut faces = mesh.face_vectors();
        for face in &mut faces {
            face.iter_mut().for_each(|v| *v = place[*v as usize] as u32);
            let start = random.below(face.len());
            face.rotate_left(start);
        }
        (1..faces.len()).rev().for_each(|i| faces.swap(i, random.below(i + 1)));
        let other = Mesh::new("renumbered", positions, faces);
        for options in calls(1.0) {
            let (before, after) = (whole(&mesh, &options), whole(&other, &options));
            for (v, &new) in place.iter().enumerate() {
                alike((&before, v), (&after, new), &IDENTITY, 1.0, 1e-9, &name(&mesh, &options));
            }
        }
    }
}

#[test]
fn single_precision_is_double_on_the_same_numbers() {
    for mesh in all_kinds() {
        let (mesh, single) = (mesh.rounded(), mesh.single());
        let handle = Handle::new(&mesh);
        for options in calls(1.0) {
            let (expected, found) = (whole(&mesh, &options), curvatures(&handle, &single, &options));
            assert_eq!(expected.bits(), found.bits(), "{}", name(&mesh, &options));
        }
    }
}

#[test]
fn threads_and_vectors_change_no_bit() {
    let large = [mesh::torus(70, 40, 0.4, 0.0, 8), mesh::torus(60, 40, 0.4, 0.5, 9)];
    for mesh in all_kinds().into_iter().chain(large) {
        let handle = Handle::new(&mesh);
        for mut options in calls(1.0) {
            options.run.threads = 1;
            let expected = curvatures(&handle, &mesh.positions, &options);
            for (threads, simd) in (1..=8).zip([0, 1, 2, 3, 4, 1, 3, 0]).chain([(1, 1), (1, 2), (1, 3), (1, 4)]) {
                (options.run.threads, options.run.simd) = (threads, simd);
                let found = curvatures(&handle, &mesh.positions, &options);
                assert!(expected.bits() == found.bits(), "{}, {threads} {simd}", name(&mesh, &options));
            }
        }
    }
}

#[test]
fn a_subset_has_the_bits_of_the_whole() {
    for mesh in all_kinds() {
        let handle = Handle::new(&mesh);
        let count = mesh.positions.len() as u32;
        let lists = [(0..count).filter(|v| v % 7 == 3).collect::<Vec<_>>(), vec![count / 2, 0, count / 2, count - 1]];
        for mut options in calls(1.0) {
            let whole = curvatures(&handle, &mesh.positions, &options);
            for list in &lists {
                for threads in [1, 3] {
                    options.run.threads = threads;
                    (options.run.vertices, options.run.vertex_count) = (list.as_ptr(), list.len());
                    let wanted = |output: Out| output.is_of(options.method);
                    let (part, result) = call(&handle, &points(&mesh.positions), &options, wanted, -77.5);
                    assert_eq!(result, Ok(()));
                    for (output, (part, whole)) in OUTPUTS.into_iter().zip(part.values.iter().zip(&whole.values)) {
                        for (index, (part, whole)) in part.iter().zip(whole).enumerate() {
                            let listed = list.contains(&((index / output.components()) as u32));
                            let expected = if listed { *whole } else { -77.5 };
                            assert_eq!(part.to_bits(), expected.to_bits(), "{}, {output:?}", name(&mesh, &options));
                        }
                    }
                    for vertex in 0..count {
                        let expected = if list.contains(&vertex) { whole.status[vertex as usize] } else { 0xa5 };
                        assert_eq!(part.status[vertex as usize], expected);
                    }
                }
            }
        }
    }
}

#[test]
fn strided_and_single_outputs_have_the_same_numbers() {
    const GUARD: f64 = -77.5;
    for mesh in [mesh::torus(17, 13, 0.25, 0.4, 1), mesh::soup(30, 40, 6, 2)] {
        let (handle, count) = (Handle::new(&mesh), mesh.positions.len());
        for options in calls(1.0) {
            let expected = curvatures(&handle, &mesh.positions, &options);
            // All outputs in one record of doubles a vertex, with a gap after each; the status in the first of its bytes.
            const RECORD: usize = OUTPUTS.len() * 4 + 1;
            let mut records = vec![GUARD; RECORD * count];
            let mut outputs: umb_curvature_outputs = zeroed();
            for (place, output) in OUTPUTS.into_iter().enumerate().filter(|(_, output)| expected.has(*output)) {
                let data = records.as_mut_ptr().wrapping_add(4 * place).cast();
                *output.field(&mut outputs) =
                    umb_output { data, stride: 8 * RECORD, scalar: UMB_SCALAR_F64, reserved: 0 };
            }
            let data = records.as_mut_ptr().wrapping_add(RECORD - 1).cast();
            outputs.status = umb_status_output { data, stride: 8 * RECORD };
            let (points, error) = (points(&mesh.positions), std::ptr::null_mut());
            assert_eq!(unsafe { umb_curvatures(handle.0, &points, &options, &outputs, error) }, UMB_OK);
            for (vertex, record) in records.chunks(RECORD).enumerate() {
                for (place, output) in OUTPUTS.into_iter().enumerate() {
                    let n = output.components();
                    let written = if expected.has(output) { n } else { 0 };
                    for (index, x) in record[4 * place..4 * place + 4].iter().enumerate() {
                        let expected = if index < written { expected.all(output)[n * vertex + index] } else { GUARD };
                        assert_eq!(x.to_bits(), expected.to_bits(), "{output:?}");
                    }
                }
                let bytes = record[RECORD - 1].to_ne_bytes();
                assert_eq!((bytes[0], &bytes[1..]), (expected.status[vertex], &GUARD.to_ne_bytes()[1..]));
            }
            // In single precision: the same, rounded once.
            let mut single: Vec<Vec<f32>> = expected.values.iter().map(|values| vec![0.0; values.len()]).collect();
            let mut outputs: umb_curvature_outputs = zeroed();
            for (output, values) in OUTPUTS.into_iter().zip(&mut single).filter(|(_, values)| !values.is_empty()) {
                output.field(&mut outputs).data = values.as_mut_ptr().cast();
            }
            assert_eq!(unsafe { umb_curvatures(handle.0, &points, &options, &outputs, error) }, UMB_OK);
            for (single, double) in single.iter().flatten().zip(expected.values.iter().flatten()) {
                assert_eq!(*single, double.clamp(-f32::MAX as f64, f32::MAX as f64) as f32);
            }
        }
    }
}

#[test]
fn the_length_of_given_normals_does_not_matter() {
    for mesh in smooth() {
        let unit = of_mesh(&mesh, UMB_CURVATURE_TAUBIN, None, |_| ()).normals();
        assert!(unit.iter().all(|n| (length(*n) - 1.0).abs() < 1e-15 && dot(*n, *n) > 0.0));
        for factor in [2f64.powi(-1000), 0.5, 2f64.powi(1000)] {
            let scaled: Vec<Vector> = unit.iter().map(|&n| scale(n, factor)).collect();
            for method in METHODS {
                let [a, b] = [&unit, &scaled].map(|normals| of_mesh(&mesh, method, Some(normals), |_| ()));
                assert_eq!(a.bits(), b.bits(), "{}, method {method}", mesh.name);
            }
        }
    }
}
