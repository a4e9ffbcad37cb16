//! Normals of osculating jets: against an oracle, exact where they should be, and whole on hostile input.
// Every call keeps the contract that the header states; where a test breaks it on purpose, that is the test.
#![allow(clippy::undocumented_unsafe_blocks)]

mod common;
use common::capi::{Handle, Normals, message, normals, normals_with, zeroed};
use common::mesh::{self, Mesh};
use common::{Random, Vector, add, cross, dot, largest_difference, length, scale, sub, unit};
use std::collections::BTreeSet;
use std::ffi::{c_int, c_void};
use std::time::{Duration, Instant};
use umbilic::capi::*;

/// Degree and rings.
type Jet = (u32, u32);

const JETS: [Jet; 8] = [(1, 1), (1, 2), (2, 1), (2, 2), (3, 2), (3, 3), (4, 3), (4, 8)];

fn jets<T: Copy + Default>(
    handle: &Handle,
    positions: &[[T; 3]],
    (degree, rings): Jet,
    set: impl FnOnce(&mut umb_run),
) -> Normals<T> {
    normals_with(handle, positions, false, |options| {
        (options.weight, options.degree, options.rings) = (UMB_WEIGHT_JET, degree, rings);
        set(&mut options.run);
    })
}

fn of_mesh(mesh: &Mesh, jet: Jet) -> Normals<f64> {
    jets(&Handle::new(mesh), &mesh.positions, jet, |_| ())
}

const SIMPLER: u8 = UMB_VERTEX_FALLBACK | UMB_VERTEX_DEGENERATE | UMB_VERTEX_ISOLATED;

// ---- the oracle: from the definitions, sharing no code with the library ----

/// Solves a square system by elimination with pivoting; none if it has no solution.
fn solved(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Option<Vec<f64>> {
    let n = right.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| matrix[a][k].abs().total_cmp(&matrix[b][k].abs()))?;
        if matrix[pivot][k].abs() < 1e-13 {
            return None;
        }
        matrix.swap(k, pivot);
        right.swap(k, pivot);
        for row in k + 1..n {
            let factor = matrix[row][k] / matrix[k][k];
            let pivot = matrix[k].clone();
            matrix[row].iter_mut().zip(pivot).for_each(|(x, pivot)| *x -= factor * pivot);
            right[row] -= factor * right[k];
        }
    }
    for k in (0..n).rev() {
        for later in k + 1..n {
            right[k] -= matrix[k][later] * right[later];
        }
        right[k] /= matrix[k][k];
    }
    Some(right)
}

/// The vertices within so many rings, the vertex itself first.
fn neighbourhood(faces_of: &[Vec<usize>], mesh: &Mesh, vertex: usize, rings: u32) -> Vec<u32> {
    let mut found = vec![vertex as u32];
    let mut seen = BTreeSet::from([vertex as u32]);
    let mut first = 0;
    for _ in 0..rings {
        for index in std::mem::replace(&mut first, found.len())..found.len() {
            for &face in &faces_of[found[index] as usize] {
                found.extend(mesh.face(face).iter().filter(|&&corner| seen.insert(corner)));
            }
        }
    }
    found
}

/// The normal of a height field over the plane of least variance, by normal equations, on either side.
fn fitted(points: &[Vector], degree: u32) -> Option<Vector> {
    let extent = points.iter().flatten().fold(0.0f64, |extent, x| extent.max(x.abs()));
    let points: Vec<Vector> = points.iter().map(|&p| scale(p, 1.0 / extent)).collect();
    let mean = scale(points.iter().fold([0.0; 3], |sum, &p| add(sum, p)), 1.0 / points.len() as f64);
    let mut covariance = vec![vec![0.0; 3]; 3];
    for point in &points {
        let d = sub(*point, mean);
        for i in 0..3 {
            for j in 0..3 {
                covariance[i][j] += d[i] * d[j];
            }
        }
    }
    // Inverse iteration, just beside the smallest eigenvalue.
    let trace: f64 = (0..3).map(|i| covariance[i][i]).sum();
    (0..3).for_each(|i| covariance[i][i] += 1e-4 * trace);
    let mut axis = [0.3, -0.5, 0.8];
    for _ in 0..200 {
        axis = unit(solved(covariance.clone(), axis.to_vec())?.try_into().unwrap());
    }
    let x = unit(cross(axis, if axis[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] }));
    let y = cross(axis, x);
    let row = |point: &Vector| -> Vec<f64> {
        let (u, v) = (dot(*point, x), dot(*point, y));
        (0..=degree as i32).flat_map(|total| (0..=total).map(move |j| u.powi(total - j) * v.powi(j))).collect()
    };
    let rows: Vec<Vec<f64>> = points.iter().map(row).collect();
    let count = rows[0].len();
    let mut matrix = vec![vec![0.0; count]; count];
    let mut right = vec![0.0; count];
    for (row, point) in rows.iter().zip(&points) {
        for i in 0..count {
            right[i] += row[i] * dot(*point, axis);
            for j in 0..count {
                matrix[i][j] += row[i] * row[j];
            }
        }
    }
    let u = solved(matrix, right)?;
    Some(unit(sub(axis, add(scale(x, u[1]), scale(y, u[2])))))
}

#[test]
fn normals_are_those_of_the_oracle() {
    let meshes = [
        mesh::torus(24, 16, 0.3, 0.0, 1),
        mesh::torus(24, 16, 0.3, 0.5, 2),
        mesh::height_field(14, 0.0, 3),
        mesh::height_field(12, 0.6, 4),
        mesh::ring_sphere(30, 14),
    ];
    for mesh in &meshes {
        let mut faces_of = vec![vec![]; mesh.positions.len()];
        for face in 0..mesh.face_count() {
            mesh.face(face).iter().for_each(|&corner| faces_of[corner as usize].push(face));
        }
        let area = normals(&Handle::new(mesh), &mesh.positions, UMB_WEIGHT_AREA, false, |_| ()).normal;
        for jet in [(1, 1), (1, 2), (2, 2), (3, 2), (3, 3), (4, 3)] {
            let found = of_mesh(mesh, jet);
            let mut compared = 0;
            for (vertex, &side) in area.iter().enumerate() {
                let around = neighbourhood(&faces_of, mesh, vertex, jet.1);
                let unknowns = ((jet.0 + 1) * (jet.0 + 2) / 2) as usize;
                if found.status[vertex] & (SIMPLER | UMB_VERTEX_WIDENED) != 0 {
                    assert!(around.len() < unknowns + 4, "{}, {jet:?}, {vertex}", mesh.name);
                    continue;
                }
                let centre = mesh.positions[vertex];
                let points: Vec<Vector> = around.iter().map(|&v| sub(mesh.positions[v as usize], centre)).collect();
                if around.len() < unknowns + 3 || around.len() > 200 {
                    continue;
                }
                let expected = fitted(&points, jet.0).unwrap();
                let expected = if dot(expected, side) < 0.0 { scale(expected, -1.0) } else { expected };
                let difference = largest_difference(found.normal[vertex], expected);
                assert!(difference < 1e-8, "{}, {jet:?}, vertex {vertex}: {difference:e}", mesh.name);
                compared += 1;
            }
            assert!(compared * 3 > mesh.positions.len(), "{}, {jet:?}: {compared}", mesh.name);
        }
    }
}

/// A grid of quads or triangles over `[-1, 1]²`, jittered inside.
fn grid(side: usize, jitter: f64, triangles: bool, height: impl Fn(f64, f64) -> f64) -> Mesh {
    let mut random = Random::new(9);
    let mut positions = vec![];
    for i in 0..side {
        for j in 0..side {
            let [x, y] = [i, j].map(|k| 2.0 * (k as f64 + jitter * random.signed()) / (side - 1) as f64 - 1.0);
            positions.push([x, y, height(x, y)]);
        }
    }
    let at = |i: usize, j: usize| (i * side + j) as u32;
    let mut faces = vec![];
    for i in 0..side - 1 {
        for j in 0..side - 1 {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if triangles { faces.extend([vec![a, b, c], vec![a, c, d]]) } else { faces.push(vec![a, b, c, d]) }
        }
    }
    Mesh::new("grid", positions, faces)
}

#[test]
fn exact_on_planes_and_on_even_polynomials() {
    for jet in JETS {
        for triangles in [true, false] {
            let tilted = grid(9, 0.3, triangles, |x, y| 0.7 * x - 0.4 * y);
            let expected = unit([-0.7, 0.4, 1.0]);
            for (vertex, normal) in of_mesh(&tilted, jet).normal.into_iter().enumerate() {
                let difference = largest_difference(normal, expected);
                assert!(difference < 1e-13, "{jet:?}, {vertex}: {difference:e}");
            }
            let flat = of_mesh(&grid(9, 0.3, triangles, |_, _| 0.0), jet);
            assert!(flat.normal.iter().all(|normal| *normal == [0.0, 0.0, 1.0]), "{jet:?}");
        }
        // In the middle of an even grid of quads the plane of least variance is that of the grid, and a polynomial of the
        // jet's degree is reproduced.
        let even = grid(9, 0.0, false, |x, y| match jet.0 {
            1 => 0.0,
            2 | 3 => 0.3 * x * x - 0.2 * x * y + 0.1 * y * y,
            _ => 0.3 * x * x - 0.2 * x * y + 0.2 * x.powi(4) - 0.1 * x * x * y * y,
        });
        let difference = largest_difference(of_mesh(&even, jet).normal[40], [0.0, 0.0, 1.0]);
        assert!(difference < 1e-12, "{jet:?}: {difference:e}");
    }
}

/// The error falls with the size of the neighbourhood to the power of the degree (Cazals & Pouget 2005, Theorem 1).
#[test]
fn the_order_of_convergence_is_the_degree() {
    let error = |columns: usize, jet: Jet| {
        let mesh = mesh::torus(columns, columns / 2, 0.2, 0.0, 5);
        let found = of_mesh(&mesh, jet);
        let squares = found.normal.iter().zip(&mesh.positions).map(|(normal, &[x, y, z])| {
            let share = 1.0 - 1.0 / x.hypot(y);
            length(sub(*normal, unit([x * share, y * share, z]))).powi(2)
        });
        (squares.sum::<f64>() / mesh.positions.len() as f64).sqrt()
    };
    for (jet, least) in [((1, 1), 0.8), ((2, 2), 1.8), ((3, 2), 2.7), ((4, 3), 3.6)] {
        let order = (error(60, jet) / error(120, jet)).log2();
        assert!(order > least, "{jet:?}: {order}");
    }
}

/// Everything is finite, and unit or zero as the status says.
fn check(mesh: &Mesh, jet: Jet) {
    let handle = Handle::new(mesh);
    let single = jets(&handle, &mesh.single(), jet, |_| ());
    let double = jets(&handle, &mesh.positions, jet, |_| ());
    let single: (Vec<_>, _) = (common::capi::widened(&single.normal), single.status);
    for (normals, status, tolerance) in [(single.0, single.1, 1e-6), (double.normal, double.status, 1e-15)] {
        for (vertex, normal) in normals.iter().enumerate() {
            let zero = status[vertex] & (UMB_VERTEX_ISOLATED | UMB_VERTEX_DEGENERATE) != 0;
            let expected = if zero { 0.0 } else { 1.0 };
            assert!((length(*normal) - expected).abs() <= tolerance, "{}, {jet:?}, {vertex}: {normal:?}", mesh.name);
        }
    }
}

#[test]
fn soups_of_every_kind_stay_finite() {
    for seed in 0..60 {
        for jet in JETS {
            check(&mesh::soup(12, 20, 3, seed), jet);
            check(&mesh::soup(40, 30, 7, seed), jet);
            // Coordinates on a coarse grid: coincident points, lines, planes.
            check(&mesh::soup(30, 45, 3, seed).mapped(|p| p.map(|x| (2.0 * x).round())), jet);
            check(&mesh::soup(14, 20, 6, seed).mapped(|[x, y, z]| [x.round(), 0.0 * y, z]), jet);
            // Flat to rounding, and stretched without measure.
            check(&mesh::soup(25, 40, 4, seed).mapped(|[x, y, z]| [x, y * 1e-9, z * 1e-300]), jet);
        }
    }
}

#[test]
fn any_size() {
    let mesh = mesh::height_field(12, 0.3, 5);
    for jet in JETS {
        let expected = of_mesh(&mesh, jet);
        for power in [-1000, -300, 300, 1000] {
            let found = of_mesh(&mesh.mapped(|p| scale(p, 2f64.powi(power))), jet);
            assert!(found.normal == expected.normal && found.status == expected.status, "{jet:?}, 2^{power}");
        }
        for size in [1e-320, 1e-310, 1e-300, 1e300, 1e307, 0.9 * f64::MAX] {
            let found = of_mesh(&mesh.mapped(|p| scale(p, size)), jet).normal;
            assert!(found.iter().all(|normal| (length(*normal) - 1.0).abs() < 1e-15), "{jet:?}, {size:e}");
        }
        // The largest numbers there are: their differences overflow.
        for size in [1e300, 1e307, 0.9 * f64::MAX] {
            let large = of_mesh(&mesh.mapped(|p| scale(p, size)), jet);
            for vertex in 0..mesh.positions.len() {
                let difference = largest_difference(large.normal[vertex], expected.normal[vertex]);
                assert!(difference < 1e-10, "{jet:?}, {size:e}, {vertex}: {difference:e}");
            }
        }
        // Far from the origin only the coordinates' own rounding is lost.
        let far = mesh.mapped(|p| add(p, [1e6, -1e6, 1e6]));
        let back = far.mapped(|p| sub(p, [1e6, -1e6, 1e6]));
        assert!(of_mesh(&far, jet).normal == of_mesh(&back, jet).normal, "{jet:?}");
    }
}

#[test]
fn rotation_turns_normals_and_reversed_faces_flip_them() {
    let turn = |[x, y, z]: Vector| [0.36 * x + 0.48 * y - 0.8 * z, -0.8 * x + 0.6 * y, 0.48 * x + 0.64 * y + 0.6 * z];
    for mesh in [mesh::torus(20, 14, 0.3, 0.4, 1), mesh::height_field(12, 0.0, 3)] {
        for jet in [(1, 1), (1, 2), (2, 2), (3, 2), (4, 3)] {
            let found = of_mesh(&mesh, jet);
            let turned = of_mesh(&mesh.mapped(turn), jet);
            let reversed = of_mesh(&mesh.reversed(), jet);
            for vertex in 0..mesh.positions.len() {
                let here = found.normal[vertex];
                assert!(largest_difference(turn(here), turned.normal[vertex]) < 1e-9, "{}, {jet:?}", mesh.name);
                assert!(largest_difference(here, scale(reversed.normal[vertex], -1.0)) < 1e-9, "{jet:?}");
            }
            assert_eq!(found.status, turned.status);
            assert_eq!(found.status, reversed.status);
        }
    }
}

#[test]
fn the_same_bits_on_threads_vectors_lists_and_in_any_company() {
    let meshes = [
        mesh::torus(40, 30, 0.4, 0.0, 1),
        mesh::torus(30, 20, 0.3, 0.6, 2),
        mesh::height_field(30, 0.4, 4),
        mesh::fan(700, true, 5),
        mesh::soup(400, 500, 6, 3),
        mesh::letter_prism(),
    ];
    for mesh in &meshes {
        let handle = Handle::new(mesh);
        let single = mesh.single();
        for jet in JETS {
            let base = jets(&handle, &mesh.positions, jet, |run| run.threads = 1);
            let base_single = jets(&handle, &single, jet, |run| run.threads = 1);
            for threads in 1..=8 {
                for simd in [UMB_SIMD_PORTABLE, UMB_SIMD_SSE2, UMB_SIMD_AVX2, UMB_SIMD_AVX512] {
                    if threads > 1 && (threads + simd) % 3 != 0 {
                        continue;
                    }
                    let set = |run: &mut umb_run| (run.threads, run.simd) = (threads, simd);
                    let found = jets(&handle, &mesh.positions, jet, set);
                    let what = format!("{}, {jet:?}, {threads} threads, simd {simd}", mesh.name);
                    assert!(found.normal == base.normal && found.status == base.status, "{what}");
                    assert!(jets(&handle, &single, jet, set).normal == base_single.normal, "{what}");
                }
            }
            let mut random = Random::new(7);
            for _ in 0..4 {
                // Every other vertex, some twice, in no order.
                let list: Vec<u32> =
                    (0..mesh.positions.len() / 2).map(|_| random.below(mesh.positions.len()) as u32).collect();
                let set = |run: &mut umb_run| (run.vertices, run.vertex_count) = (list.as_ptr(), list.len());
                let found = jets(&handle, &mesh.positions, jet, set);
                for vertex in 0..mesh.positions.len() {
                    let listed = list.contains(&(vertex as u32));
                    let (normal, status) =
                        if listed { (base.normal[vertex], base.status[vertex]) } else { ([0.0; 3], 0) };
                    assert_eq!(found.normal[vertex].map(f64::to_bits), normal.map(f64::to_bits), "{}", mesh.name);
                    assert_eq!(found.status[vertex], status);
                }
            }
        }
    }
}

#[test]
fn hubs_and_huge_polygons_take_no_longer_than_their_size() {
    const COUNT: usize = 100_000;
    let polygon = {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / COUNT as f64;
        let positions = (0..COUNT).map(|i| [angle(i).cos(), angle(i).sin(), 0.0]).collect();
        Mesh::new("polygon", positions, vec![(0..COUNT as u32).collect()])
    };
    let fan = mesh::fan(COUNT, true, 1);
    for mesh in [&fan, &polygon] {
        for jet in [(1, 1), (2, 2), (4, 8)] {
            let start = Instant::now();
            let found = of_mesh(mesh, jet);
            // A walk over the hub's edges at each vertex would take minutes.
            assert!(start.elapsed() < Duration::from_secs(30), "{}, {jet:?}: {:?}", mesh.name, start.elapsed());
            assert!(found.normal.iter().all(|normal| (length(*normal) - 1.0).abs() < 1e-15 || *normal == [0.0; 3]));
            if mesh.name == "polygon" {
                assert!(found.normal.iter().all(|normal| largest_difference(*normal, [0.0, 0.0, 1.0]) < 1e-9));
            }
        }
    }
}

#[test]
fn statuses() {
    // A border has fewer neighbours: where they are too few the neighbourhood is widened, and the result is still good.
    let mesh = grid(12, 0.2, true, |x, y| 0.2 * x * x + 0.1 * x * y);
    let found = of_mesh(&mesh, (3, 2));
    let corner = found.status[0];
    assert_eq!(corner, UMB_VERTEX_BOUNDARY | UMB_VERTEX_WIDENED);
    assert_eq!(found.status[66], 0);
    let exact = |vertex: usize| {
        let [x, y, _] = mesh.positions[vertex];
        unit([-0.4 * x - 0.1 * y, -0.1 * x, 1.0])
    };
    assert!(largest_difference(found.normal[0], exact(0)) < 2e-3);
    // A lone triangle has no more points than a plane has coefficients.
    let triangle = Mesh::new("triangle", vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]], vec![vec![0, 1, 2]]);
    for degree in 1..=4 {
        let found = of_mesh(&triangle, (degree, 2));
        assert_eq!(found.status, [UMB_VERTEX_BOUNDARY | UMB_VERTEX_FALLBACK; 3]);
        assert_eq!(found.normal, [[0.0, 0.0, 1.0]; 3]);
    }
    // Small components are too little for what was asked for, and still have good normals.
    for level in 0..2 {
        let small = mesh::tetrahedron_sphere(level);
        let found = of_mesh(&small, (3, 2));
        for (vertex, position) in small.positions.iter().enumerate() {
            assert!(largest_difference(found.normal[vertex], *position) < 0.3, "{:?}", found.normal[vertex]);
        }
    }
    // Nothing but a line: nothing to fit, and no normal either.
    let line = (0..6).map(|i| [i as f64, 2.0 * i as f64, 0.0]).collect();
    let found = of_mesh(&Mesh::new("line", line, (0..4).map(|i| vec![i, i + 1, i + 2]).collect()), (2, 2));
    assert!(found.status.iter().all(|status| status & UMB_VERTEX_DEGENERATE != 0));
    // A tube so thin that the neighbourhood goes all around it has no plane of least variance to speak of.
    let (columns, rows) = (30, 5);
    let tube = |i: usize, j: usize| {
        let angle = std::f64::consts::TAU * j as f64 / rows as f64;
        [i as f64, angle.cos(), angle.sin()]
    };
    let positions = (0..columns * rows).map(|v| tube(v / rows, v % rows)).collect();
    let at = |i: usize, j: usize| (i * rows + j % rows) as u32;
    let faces = (0..(columns - 1) * rows)
        .map(|v| (v / rows, v % rows))
        .map(|(i, j)| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
        .collect();
    let mesh = Mesh::new("tube", positions, faces).reversed();
    let found = of_mesh(&mesh, (3, 3));
    for (vertex, &[_, y, z]) in mesh.positions.iter().enumerate() {
        assert!(dot(found.normal[vertex], [0.0, y, z]).abs() > 0.25, "{vertex}: {:?}", found.normal[vertex]);
    }
}

/// Calls without any helper, for what is refused.
fn call(mesh: &Mesh, set: impl FnOnce(&mut umb_normal_options)) -> (umb_status, u64, Vec<[f64; 3]>) {
    let handle = Handle::new(mesh);
    let mut found = vec![[7.0f64; 3]; mesh.positions.len()];
    let mut options: umb_normal_options = zeroed();
    options.struct_size = size_of::<umb_normal_options>() as u32;
    options.weight = UMB_WEIGHT_JET;
    set(&mut options);
    let mut outputs: umb_normal_outputs = zeroed();
    outputs.normal = common::capi::output(&mut found);
    let mut error: umb_error = zeroed();
    let points = common::capi::points(&mesh.positions);
    let status = unsafe { umb_vertex_normals(handle.0, &points, &options, &outputs, &mut error) };
    assert!(status == UMB_OK || !message(&error).is_empty());
    (status, error.element, found)
}

#[test]
fn options_out_of_range_are_refused() {
    let mesh = mesh::height_field(6, 0.0, 1);
    for (degree, rings) in [(5, 0), (0, 9), (300, 1), (256, 0), (2, 256), (0, u32::MAX)] {
        let (status, element, found) = call(&mesh, |options| (options.degree, options.rings) = (degree, rings));
        assert_eq!((status, element), (UMB_ERROR_OPTION_OUT_OF_RANGE, UMB_NO_ELEMENT));
        assert!(found.iter().flatten().all(|x| *x == 7.0));
    }
    // Zeros stand for degree 3 and two rings, and by degree for what the header says.
    for (zeros, meant) in [((0, 0), (3, 2)), ((1, 0), (1, 1)), ((2, 0), (2, 2)), ((4, 0), (4, 3)), ((0, 5), (3, 5))] {
        assert!(of_mesh(&mesh, zeros).normal == of_mesh(&mesh, meant).normal, "{zeros:?}");
    }
    assert!(of_mesh(&mesh, (3, 2)).normal != of_mesh(&mesh, (2, 2)).normal);
    assert!(of_mesh(&mesh, (3, 2)).normal != of_mesh(&mesh, (3, 3)).normal);
    // Averages do not look at them.
    assert_eq!(call(&mesh, |options| (options.weight, options.degree) = (UMB_WEIGHT_AREA, 77)).0, UMB_OK);
}

#[test]
fn only_positions_that_are_needed_can_be_to_blame() {
    for list in [vec![0u32], vec![0; 500]] {
        let set = |options: &mut umb_normal_options| {
            (options.run.vertices, options.run.vertex_count) = (list.as_ptr(), list.len());
            (options.degree, options.rings) = (2, 2);
        };
        let mut mesh = grid(9, 0.1, true, |x, y| 0.1 * x * y);
        let good = call(&mesh, set).2;
        // Two rings around corner 0 reach vertex 20, at (2, 2), but not vertex 3.
        mesh.positions[20][1] = f64::NAN;
        let (status, element, found) = call(&mesh, set);
        assert_eq!((status, element), (UMB_ERROR_NON_FINITE, 20));
        assert!(found.iter().flatten().all(|x| *x == 7.0));
        mesh.positions[20][1] = 0.0;
        mesh.positions[80][2] = f64::INFINITY;
        let status = call(&mesh, set).0;
        assert_eq!(status, UMB_OK);
        mesh = grid(9, 0.1, true, |x, y| 0.1 * x * y);
        mesh.positions[3][2] = f64::NAN;
        let (status, _, found) = call(&mesh, set);
        assert_eq!(status, UMB_OK);
        assert!(found[0] == good[0]);
        // A ring that was not asked for and would be of use is left out; what two rings have is enough for degree 2.
        let wider = |options: &mut umb_normal_options| {
            set(options);
            options.degree = 4;
        };
        let (status, _, found) = call(&mesh, wider);
        assert_eq!(status, UMB_OK);
        assert!(found[0] == good[0]);
        // Without a list everything counts.
        assert_eq!(call(&mesh, |_| ()).0, UMB_ERROR_NON_FINITE);
    }
}

#[test]
fn progress_runs_from_0_to_1_and_can_cancel() {
    struct Seen {
        last: f64,
        calls: usize,
        cancel_at: f64,
        upwards: bool,
    }
    unsafe extern "C" fn progress(user: *mut c_void, fraction: f64) -> c_int {
        let seen = unsafe { &mut *user.cast::<Seen>() };
        seen.upwards &= (seen.last..=1.0).contains(&fraction);
        (seen.last, seen.calls) = (fraction, seen.calls + 1);
        (fraction >= seen.cancel_at) as c_int
    }
    let mesh = mesh::torus(80, 60, 0.2, 0.0, 1);
    for (cancel_at, expected) in [(2.0, UMB_OK), (0.0, UMB_ERROR_CANCELLED), (0.5, UMB_ERROR_CANCELLED)] {
        let mut seen = Seen { last: 0.0, calls: 0, cancel_at, upwards: true };
        let user = (&raw mut seen).cast();
        let set = |options: &mut umb_normal_options| {
            options.run.progress = Some(progress);
            options.run.user = user;
        };
        let status = call(&mesh, set).0;
        assert_eq!(status, expected);
        assert!(seen.upwards);
        assert!(expected != UMB_OK || (seen.last == 1.0 && seen.calls > 10));
    }
}
