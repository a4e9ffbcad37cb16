//! Degenerate and hostile shapes: nothing is NaN or infinite, and what can be right is.
// Every call keeps the contract that the header states; where a test breaks it on purpose, that is the test.
#![allow(clippy::undocumented_unsafe_blocks)]

mod common;
use common::capi::{ALL, Handle, Normals, WEIGHTS, normals, widened};
use common::mesh::{self, Mesh, fan};
use common::{Vector, cross, largest_difference, length, scale, sub, unit};
use umbilic::capi::*;

fn double(mesh: &Mesh, weight: umb_weight) -> Normals<f64> {
    normals(&Handle::new(mesh), &mesh.positions, weight, true, |_| ())
}

/// All weights, jets too, in both precisions are finite, and unit or zero as the status says.
fn check_finite(mesh: &Mesh) {
    let handle = Handle::new(mesh);
    for weight in ALL {
        let single = normals(&handle, &mesh.single(), weight, false, |_| ());
        let double = normals(&handle, &mesh.positions, weight, true, |_| ());
        assert!(double.sum.iter().flatten().all(|x| x.is_finite()), "{}, weight {weight}", mesh.name);
        for (normals, status, tolerance) in
            [(widened(&single.normal), &single.status, 1e-6), (double.normal, &double.status, 1e-15)]
        {
            for (vertex, normal) in normals.iter().enumerate() {
                assert!(normal.iter().all(|x| x.is_finite()), "{}, weight {weight}, {vertex}", mesh.name);
                let zero = status[vertex] & (UMB_VERTEX_ISOLATED | UMB_VERTEX_DEGENERATE) != 0;
                let expected = if zero { 0.0 } else { 1.0 };
                assert!(
                    (length(*normal) - expected).abs() <= tolerance,
                    "{}, weight {weight}, vertex {vertex}: {normal:?}, status {}",
                    mesh.name,
                    status[vertex]
                );
            }
        }
    }
}

#[test]
fn a_cube_corner_cut_six_ways() {
    // The three faces at the corner of a cube, each cut into one or two triangles at the corner, or left whole: angle
    // weights do not see the cuts.
    let diagonal = [1.0 / 3.0f64.sqrt(); 3];
    let positions: Vec<Vector> = (0..8u32).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|bit| -(bit as f64))).collect();
    let squares = [[0u32, 2, 6, 4], [0, 4, 5, 1], [0, 1, 3, 2]];
    for cuts in 0..6 {
        let mut faces = vec![];
        for (index, [a, b, c, d]) in squares.into_iter().enumerate() {
            match (cuts, index) {
                (0, _) => faces.extend([vec![a, b, c], vec![a, c, d]]),
                (1, _) => faces.extend([vec![a, b, d], vec![b, c, d]]),
                (2, 0) | (3, 1) | (4, 2) => faces.extend([vec![a, b, c], vec![a, c, d]]),
                (5, 0) => faces.push(vec![a, b, c, d]),
                _ => faces.extend([vec![a, b, d], vec![b, c, d]]),
            }
        }
        let mesh = Mesh::new("cube corner", positions.clone(), faces);
        let found = double(&mesh, UMB_WEIGHT_ANGLE);
        assert!(largest_difference(found.normal[0], diagonal) < 4e-16, "cut {cuts}: {:?}", found.normal[0]);
        let single = normals(&Handle::new(&mesh), &mesh.single(), UMB_WEIGHT_ANGLE, false, |_| ());
        assert!(largest_difference(widened(&single.normal)[0], diagonal) < 2e-7, "cut {cuts}");
    }
}

#[test]
fn the_papers_figure_15() {
    // A cube corner whose top has four triangles and whose sides have one each: N_T is exact, N_G is 4 : 1 : 1, and
    // N_CM 4.44 : 3.86 : 3.86, a ratio of 1.15.
    let mut positions = vec![[0.0; 3], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]];
    for step in 1..4 {
        let angle = std::f64::consts::FRAC_PI_2 * step as f64 / 4.0;
        positions.push([-angle.cos(), -angle.sin(), 0.0]);
    }
    let faces = vec![vec![0, 1, 4], vec![0, 4, 5], vec![0, 5, 6], vec![0, 6, 2], vec![0, 2, 3], vec![0, 3, 1]];
    let mesh = Mesh::new("figure 15", positions, faces);
    let angle = double(&mesh, UMB_WEIGHT_ANGLE).normal[0];
    assert!(largest_difference(angle, [1.0 / 3.0f64.sqrt(); 3]) < 1e-15, "{angle:?}");
    let uniform = double(&mesh, UMB_WEIGHT_UNIFORM).sum[0];
    assert!(largest_difference(uniform, [1.0, 1.0, 4.0]) < 1e-15, "{uniform:?}");
    let conformal = double(&mesh, UMB_WEIGHT_CONFORMAL).normal[0];
    assert_eq!(format!("{:.2}", conformal[2] / conformal[0]), "1.15", "{conformal:?}");
    assert!((conformal[0] - conformal[1]).abs() < 1e-15);
}

#[test]
fn sliver_ladder() {
    // A fan in a tilted plane whose every other triangle gets thinner, down to nothing: whatever the weight, the
    // normal is the plane's as long as the coordinates determine it.
    let normal = unit([0.3, -0.5, 0.8]);
    let x = unit(cross(normal, [0.0, 0.0, 1.0]));
    let y = cross(normal, x);
    for power in 0..300 {
        let thin = 2f64.powi(-power);
        let outline = [[1.0, 0.0], [1.0, thin], [0.0, 1.0], [-1.0, thin], [-1.0, 0.0], [0.0, -1.0]];
        let mut positions = vec![[0.0; 3]];
        positions.extend(outline.map(|[u, v]| std::array::from_fn(|i| u * x[i] + v * y[i])));
        positions.push([9.0; 3]);
        let faces = (0..6).map(|i| vec![0, 1 + i, 1 + (i + 1) % 6]).collect();
        let mesh = Mesh::new("sliver ladder", positions, faces);
        check_finite(&mesh);
        for weight in [UMB_WEIGHT_AREA, UMB_WEIGHT_ANGLE, UMB_WEIGHT_MAX, UMB_WEIGHT_SINE, UMB_WEIGHT_ANGLE_EDGES] {
            let found = double(&mesh, weight).normal[0];
            assert!(largest_difference(found, normal) < 1e-13, "2^-{power}, weight {weight}: {found:?}");
            let single = normals(&Handle::new(&mesh), &mesh.single(), weight, false, |_| ());
            let found = single.normal[0].map(f64::from);
            assert!(largest_difference(found, normal) < 1e-6, "2^-{power}, weight {weight}: {found:?}");
        }
    }
    // In an axis plane the coordinates are exact at every step, and so is every weight.
    for power in 0..120 {
        let thin = 2f64.powi(-power);
        let outline = [[1.0, 0.0], [1.0, thin], [0.0, 1.0], [-1.0, thin], [-1.0, 0.0], [0.0, -1.0]];
        let mut positions = vec![[0.0; 3]];
        positions.extend(outline.map(|[u, v]| [u, v, 0.0]));
        positions.push([9.0; 3]);
        let mesh = Mesh::new("ladder", positions, (0..6).map(|i| vec![0, 1 + i, 1 + (i + 1) % 6]).collect());
        for weight in WEIGHTS {
            assert_eq!(double(&mesh, weight).normal[0], [0.0, 0.0, 1.0], "2^-{power}, weight {weight}");
            let single = normals(&Handle::new(&mesh), &mesh.single(), weight, false, |_| ());
            assert_eq!(single.normal[0], [0.0, 0.0, 1.0], "2^-{power}, weight {weight}");
        }
    }
}

#[test]
fn short_edges_beside_long_ones() {
    // Neighbours at distances that differ by many powers of two, in an axis plane: exact at any ratio that a double
    // can hold squared, and finite beyond.
    for power in (0..1000).step_by(7) {
        let near = 2f64.powi(-power);
        let outline = [[1.0, 0.0], [0.0, near], [-1.0, 0.0], [0.0, -near]];
        let mut positions = vec![[0.0; 3]];
        positions.extend(outline.map(|[u, v]| [u, v, 0.0]));
        positions.push([9.0; 3]);
        let mesh = Mesh::new("short edges", positions, (0..4).map(|i| vec![0, 1 + i, 1 + (i + 1) % 4]).collect());
        check_finite(&mesh);
        if power <= 200 {
            for weight in WEIGHTS {
                assert_eq!(double(&mesh, weight).normal[0], [0.0, 0.0, 1.0], "2^-{power}, weight {weight}");
            }
        }
        if power <= 120 {
            for weight in WEIGHTS {
                let single = normals(&Handle::new(&mesh), &mesh.single(), weight, false, |_| ());
                assert_eq!(single.normal[0], [0.0, 0.0, 1.0], "2^-{power}, weight {weight}");
            }
        }
    }
}

#[test]
fn coordinates_at_the_ends_of_the_range() {
    for (size, name) in [(f64::MAX, "largest"), (f64::MIN_POSITIVE, "smallest"), (5e-324, "subnormal")] {
        for mut mesh in [mesh::ring_sphere(6, 4), mesh::letter_prism(), mesh::soup(20, 30, 5, 3)] {
            let largest = mesh.positions.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
            mesh = mesh.mapped(|p| scale(p, 1.0 / largest)).mapped(|p| scale(p, size));
            mesh.name = format!("{} of {name} coordinates", mesh.name);
            let handle = Handle::new(&mesh);
            for weight in WEIGHTS {
                let found = normals(&handle, &mesh.positions, weight, true, |_| ());
                assert!(found.normal.iter().chain(&found.sum).flatten().all(|x| x.is_finite()), "{}", mesh.name);
                let mut flat = vec![[0.0f64; 3]; mesh.positions.len()];
                let mut options: umb_normal_options = common::capi::zeroed();
                options.weight = weight;
                let mut outputs: umb_normal_outputs = common::capi::zeroed();
                outputs.normal = common::capi::output(&mut flat);
                let (faces, points) = (common::capi::faces(&mesh), common::capi::points(&mesh.positions));
                let error = std::ptr::null_mut();
                let status = unsafe { umb_vertex_normals_from_faces(&faces, &points, &options, &outputs, error) };
                assert_eq!(status, UMB_OK);
                assert!(flat.iter().flatten().all(|x| x.is_finite()), "{}", mesh.name);
            }
        }
    }
    // Coordinates of opposite sign near the largest double: differences would overflow.
    let mesh = mesh::ring_sphere(12, 7);
    let huge = mesh.mapped(|p| scale(p, f64::MAX));
    for weight in WEIGHTS {
        let (expected, found) = (double(&mesh, weight), double(&huge, weight));
        for vertex in 0..mesh.positions.len() {
            assert!(largest_difference(expected.normal[vertex], found.normal[vertex]) < 1e-14, "weight {weight}");
        }
    }
    let single: Vec<[f32; 3]> = mesh.positions.iter().map(|p| p.map(|x| (x * f32::MAX as f64) as f32)).collect();
    let found = normals(&Handle::new(&mesh), &single, UMB_WEIGHT_CONFORMAL, false, |_| ());
    let expected = double(&mesh, UMB_WEIGHT_CONFORMAL);
    for vertex in 0..mesh.positions.len() {
        assert!(largest_difference(expected.normal[vertex], found.normal[vertex].map(f64::from)) < 1e-6);
    }
}

#[test]
fn opposite_faces_fall_back() {
    // Two faces back to back cancel in every weight: any one face is the answer, and the status says so.
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [9.0; 3]];
    let mesh = Mesh::new("pillow", positions, vec![vec![0, 1, 2], vec![0, 2, 1]]);
    check_finite(&mesh);
    for weight in WEIGHTS {
        let found = double(&mesh, weight);
        assert_eq!(
            found.status,
            [UMB_VERTEX_FALLBACK, UMB_VERTEX_FALLBACK, UMB_VERTEX_FALLBACK, UMB_VERTEX_ISOLATED]
        );
        assert!(found.normal[..3].iter().all(|normal| *normal == [0.0, 0.0, 1.0]));
        assert_eq!(found.normal[3], [0.0; 3]);
    }
    // A flap, both sides of it, folded onto a flat fan: its sides cancel, and the rest decides.
    let positions = vec![
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.4, 0.8, 0.0],
        [9.0; 3],
    ];
    let faces =
        vec![vec![0, 1, 5], vec![0, 5, 2], vec![0, 2, 3], vec![0, 3, 4], vec![0, 4, 1], vec![0, 1, 2], vec![0, 2, 1]];
    let flap = Mesh::new("flap", positions, faces);
    check_finite(&flap);
    for weight in WEIGHTS {
        let found = double(&flap, weight);
        assert!(
            largest_difference(found.normal[0], [0.0, 0.0, 1.0]) < 1e-15,
            "weight {weight}: {:?}",
            found.normal[0]
        );
        assert_eq!(found.status[0] & (UMB_VERTEX_FALLBACK | UMB_VERTEX_DEGENERATE), 0, "weight {weight}");
    }
}

#[test]
fn folds_that_nearly_cancel_stay_finite() {
    for power in 0..60 {
        let lift = 2f64.powi(-power);
        let positions =
            vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.1, lift], [0.2, 0.9, -lift], [9.0; 3]];
        let faces = vec![vec![0, 1, 2], vec![0, 2, 3], vec![0, 3, 4], vec![0, 4, 1]];
        check_finite(&Mesh::new("fold", positions, faces));
    }
}

#[test]
fn every_valence() {
    for count in 2..40 {
        for closed in [true, false] {
            if count > 2 || !closed {
                check_finite(&fan(count, closed, count as u64));
            }
        }
    }
    let mesh = fan(1000, true, 1);
    check_finite(&mesh);
    let handle = Handle::new(&mesh);
    let mut valence = 0;
    assert_eq!(unsafe { umb_topology_valence(handle.0, 0, &mut valence, std::ptr::null_mut()) }, UMB_OK);
    assert_eq!(valence, 1000);
    for weight in WEIGHTS {
        let normal = double(&mesh, weight).normal[0];
        assert!(normal[2] > 0.99, "weight {weight}: {normal:?}");
    }
}

#[test]
fn empty_and_tiny_meshes() {
    let empty = Mesh::new("empty", vec![], vec![]);
    let no_faces = Mesh::new("points", vec![[1.0; 3]; 5], vec![]);
    let one = Mesh::new("one face", vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]], vec![vec![0, 1, 2]]);
    for mesh in [&empty, &no_faces, &one] {
        check_finite(mesh);
    }
    // Null pointers are fine where there is nothing behind them.
    let faces: umb_faces = common::capi::zeroed();
    let handle = Handle::of(&faces, 0);
    let points: umb_points = common::capi::zeroed();
    let outputs: umb_normal_outputs = common::capi::zeroed();
    let (options, error) = (std::ptr::null(), std::ptr::null_mut());
    assert_eq!(unsafe { umb_vertex_normals(handle.0, &points, options, &outputs, error) }, UMB_OK);
    let outputs: umb_face_outputs = common::capi::zeroed();
    assert_eq!(unsafe { umb_face_normals(&faces, &points, std::ptr::null(), &outputs, error) }, UMB_OK);
    for weight in WEIGHTS {
        assert_eq!(double(&one, weight).normal, [[0.0, 0.0, 1.0]; 3], "weight {weight}");
        assert_eq!(double(&one, weight).status, [UMB_VERTEX_BOUNDARY; 3]);
    }
}

#[test]
fn all_degenerate_meshes() {
    let point = Mesh::new("one point", vec![[3.0; 3]; 6], vec![vec![0, 1, 2], vec![2, 1, 3], vec![3, 4, 5, 0]]);
    let line = Mesh::new(
        "a line",
        (0..6).map(|i| [i as f64, 2.0 * i as f64, -(i as f64)]).collect(),
        vec![vec![0, 1, 2], vec![2, 3, 4], vec![1, 3, 5], vec![0, 5, 2]],
    );
    let repeated = Mesh::new("repeated vertices", vec![[0.0; 3]; 3], vec![vec![0, 0, 1], vec![2, 2, 2], vec![1, 1]]);
    for mesh in [&point, &line, &repeated] {
        check_finite(mesh);
        for weight in ALL {
            let found = double(mesh, weight);
            assert!(found.normal.iter().all(|normal| *normal == [0.0; 3]), "{}, weight {weight}", mesh.name);
            let no_normal = UMB_VERTEX_DEGENERATE | UMB_VERTEX_ISOLATED;
            assert!(found.status.iter().all(|status| status & no_normal != 0), "{}", mesh.name);
        }
    }
}

#[test]
fn soups_of_every_kind_stay_finite() {
    for seed in 0..200 {
        check_finite(&mesh::soup(12, 20, 3, seed));
        check_finite(&mesh::soup(12, 14, 7, seed));
        // Coordinates on a coarse grid: coincident points, collinear corners, opposite faces.
        check_finite(&mesh::soup(14, 25, 3, seed).mapped(|p| p.map(|x| (2.0 * x).round())));
        check_finite(&mesh::soup(14, 20, 6, seed).mapped(|p| p.map(|x| (2.0 * x).round())));
    }
}

#[test]
fn face_normals_of_every_kind_of_face() {
    let positions =
        vec![[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [1.0, 0.5, 0.0], [0.0, 2.0, 0.0], [1.0, 0.0, 0.0]];
    let faces = vec![
        vec![0, 1, 2],          // a triangle
        vec![0, 1, 2, 3, 4],    // concave
        vec![0, 5, 1, 2, 4],    // starts with three collinear corners
        vec![4, 3, 2, 1, 0],    // the concave one turned round
        vec![0, 1, 1, 2],       // a repeated corner
        vec![0, 5, 1],          // collinear
        vec![0, 1, 2, 0, 2, 1], // there and back: cancels out
        vec![0, 1],             // no face
    ];
    let mesh = Mesh::new("faces", positions, faces);
    let mut found = vec![[7.0f64; 3]; 8];
    let mut areas = vec![[7.0f32; 3]; 8];
    let mut status = vec![9u8; 8];
    let mut outputs: umb_face_outputs = common::capi::zeroed();
    outputs.normal = common::capi::output(&mut found);
    outputs.area_vector = common::capi::output(&mut areas);
    outputs.status = umb_status_output { data: status.as_mut_ptr(), stride: 0 };
    let (faces, points) = (common::capi::faces(&mesh), common::capi::points(&mesh.positions));
    let result = unsafe { umb_face_normals(&faces, &points, std::ptr::null(), &outputs, std::ptr::null_mut()) };
    assert_eq!(result, UMB_OK);
    let (up, down, none) = ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.0; 3]);
    assert_eq!(found, [up, up, up, down, up, none, none, none]);
    let flat = UMB_VERTEX_DEGENERATE;
    assert_eq!(status, [0, 0, 0, 0, 0, flat, flat, flat]);
    let area = |z: f32| [0.0, 0.0, z];
    assert_eq!(areas, [area(2.0), area(2.5), area(4.0), area(-2.5), area(2.0), area(0.0), area(0.0), area(0.0)]);
}

#[test]
fn slivers_count_for_their_angle_and_centroid_among_polygons_too() {
    // Slivers down to collinear up to rounding. Next to an unrelated quad they take the path of polygons, which must
    // neither turn an angle of nearly 0 or π into a reflex one, nor lose the centroid.
    let mut random = common::Random::new(7);
    for height in [1.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-14, 1e-15, 1e-16, 0.0] {
        for _ in 0..300 {
            let mut point = || [random.signed(), random.signed(), random.signed()];
            let (a, b) = (point(), point());
            let along = common::add(a, scale(sub(b, a), random.unit()));
            let thin: Vector = std::array::from_fn(|i| along[i] + height * random.signed());
            let positions = vec![a, b, thin, [5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [6.0, 1.0, 0.0], [5.0, 1.0, 0.0]];
            let mesh = Mesh::new("sliver and quad", positions.clone(), vec![vec![0, 1, 2], vec![3, 4, 5, 6]]);
            for vertex in 0..3 {
                let corner = |step: usize| sub(positions[(vertex + step) % 3], positions[vertex]);
                let (next, prev) = (corner(1), corner(2));
                let angle = length(cross(next, prev)).atan2(common::dot(next, prev));
                let centroid = length(scale(common::add(next, prev), 1.0 / 3.0));
                for (weight, expected) in [(UMB_WEIGHT_ANGLE, angle), (UMB_WEIGHT_CENTROID, centroid.powi(-2))] {
                    let found = double(&mesh, weight);
                    if found.status[vertex] & (UMB_VERTEX_FALLBACK | UMB_VERTEX_DEGENERATE) == 0 {
                        let size = length(found.sum[vertex]);
                        let difference = (size - expected).abs() / expected.max(1.0);
                        assert!(difference < 1e-9, "{height:e}, weight {weight}: {size} {expected}");
                    }
                }
            }
        }
    }
}

/// The normal of a mesh's only face.
fn face_normal(mesh: &Mesh) -> Vector {
    let mut normal = [[7.0f64; 3]];
    let mut outputs: umb_face_outputs = common::capi::zeroed();
    outputs.normal = common::capi::output(&mut normal);
    let (faces, points) = (common::capi::faces(mesh), common::capi::points(&mesh.positions));
    let (options, error) = (std::ptr::null(), std::ptr::null_mut());
    assert_eq!(unsafe { umb_face_normals(&faces, &points, options, &outputs, error) }, UMB_OK);
    normal[0]
}

#[test]
fn normals_of_the_thinnest_faces_are_unit_vectors() {
    for power in 1..1020 {
        let thin = 2f64.powi(-power) * 1.37;
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, thin, 0.0], [9.0; 3]];
        for face in [vec![0, 1, 2], vec![0, 1, 2, 1]] {
            let mesh = Mesh::new("thin", positions.clone(), vec![face]);
            let normal = face_normal(&mesh);
            if mesh.is_triangles() {
                assert_eq!(normal, [0.0, 0.0, 1.0], "2^-{power}");
            }
            check_finite(&mesh);
        }
    }
}

#[test]
fn normals_of_subnormal_area_vectors_are_unit_vectors() {
    for bits in [1u64, 2, 3, 7, 1000, 1 << 40, 1 << 51, 1 << 53] {
        let t = f64::from_bits(bits);
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, t, t]];
        let mesh = Mesh::new("subnormal", positions, vec![vec![0, 1, 2]]);
        let normal = face_normal(&mesh);
        let half = 0.5f64.sqrt();
        assert!(largest_difference(normal, [0.0, -half, half]) < 1e-15, "{t:e}: {normal:?}");
    }
}

#[test]
fn a_large_hub_in_many_threads_and_short_lists() {
    // One buffer for large rings serves all threads in turn, and a list that does not name the hub needs none.
    let mesh = fan(300_000, true, 1);
    let handle = Handle::new(&mesh);
    let expected = normals(&handle, &mesh.positions, UMB_WEIGHT_CONFORMAL, false, |run| run.threads = 1).normal;
    let found = normals(&handle, &mesh.positions, UMB_WEIGHT_CONFORMAL, false, |run| run.threads = 200).normal;
    assert!(found == expected);
    for vertex in [5u32, 77, 0] {
        for _ in 0..30 {
            let mut normal = vec![[0.0f64; 3]; mesh.positions.len()];
            let mut options: umb_normal_options = common::capi::zeroed();
            (options.run.vertices, options.run.vertex_count) = (&vertex, 1);
            let mut outputs: umb_normal_outputs = common::capi::zeroed();
            outputs.normal = common::capi::output(&mut normal);
            let (points, error) = (common::capi::points(&mesh.positions), std::ptr::null_mut());
            assert_eq!(unsafe { umb_vertex_normals(handle.0, &points, &options, &outputs, error) }, UMB_OK);
            assert_eq!(normal[vertex as usize], expected[vertex as usize]);
        }
    }
}

#[test]
fn a_closed_fan_of_two() {
    // Two quads that share two edges at a vertex, folded like a tent: their common normals decide.
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, -0.5], [0.0, -1.0, -0.5]];
    let mesh = Mesh::new("tent", positions, vec![vec![0, 1, 3, 2], vec![0, 2, 4, 1]]);
    check_finite(&mesh);
    for weight in [UMB_WEIGHT_CONFORMAL, UMB_WEIGHT_UNIFORM, UMB_WEIGHT_ANGLE, UMB_WEIGHT_AREA] {
        assert!(largest_difference(double(&mesh, weight).normal[0], [0.0, 0.0, 1.0]) < 1e-15, "weight {weight}");
    }
}
