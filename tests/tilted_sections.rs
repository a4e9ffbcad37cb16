//! Tilted sections against an oracle (one stacked problem of least squares, by reflections), exact on spheres, and the same as normals
//! and as curvatures.

mod common;
use common::adaptive::{Fitted, normals, of_method};
use common::adaptive_oracle::monge;
use common::answer::Answer;
use common::bodies;
use common::householder::factored;
use common::linear::tangents;
use common::mesh::{self, Mesh};
use common::oracle::Oracle;
use common::{Random, Vector, add, dot, largest_difference, length, scale, sub, unit};
use umbilic::{Coordinates, Method, Weight, status};

/// Normal and curvatures of the ring of a vertex, and the square of the condition of the problem that has these for solution.
fn expected(mesh: &Mesh, oracle: &Oracle<'_>, vertex: usize) -> Option<(Vector, Answer, f64)> {
    let max = oracle.normal(vertex, Weight::Max);
    if max.normal == [0.0; 3] {
        return None;
    }
    let [x, y] = tangents(max.normal);
    let mut rows = vec![];
    let (mut weights, mut sizes) = (0.0, 0.0);
    for (fan, closed) in oracle.fans(vertex) {
        let mut ends: Vec<u32> = fan.iter().map(|corner| corner.next).collect();
        if !closed {
            ends.push(fan[fan.len() - 1].prev);
        }
        let edges = ends.iter().map(|&end| sub(mesh.positions[end as usize], mesh.positions[vertex]));
        let edges: Vec<Vector> = edges.filter(|&edge| length(edge) > 0.0).collect();
        // The harmonic mean.
        let l = edges.len() as f64 / edges.iter().map(|&edge| 1.0 / length(edge)).sum::<f64>();
        for edge in edges {
            let (u, v, size) = (dot(edge, x), dot(edge, y), length(edge));
            let flat = u.hypot(v);
            if flat < 1e-100 * size {
                continue;
            }
            let (c, s) = (u / flat, v / flat);
            let weight = (size / l).powi(2) / (1.0 + (size / l).powi(2));
            let tilt = 2.0 * l / size * (flat / size);
            let row = [l * c * c, 2.0 * l * c * s, l * s * s, tilt * c, tilt * s];
            let bent = 2.0 * l * dot(max.normal, edge) / (size * size);
            rows.push(row.into_iter().chain([bent]).map(|x| x * weight.sqrt()).collect());
            weights += weight;
            sizes += weight * l * l;
        }
    }
    if rows.is_empty() {
        return None;
    }
    // What makes curvatures differ from direction to direction, (a − d)/2 and b, and the tilt.
    let (part, tilt) = (f64::sqrt(2e-6 * sizes), f64::sqrt(0.1 * weights));
    rows.push(vec![part / 2.0, 0.0, -part / 2.0, 0.0, 0.0, 0.0]);
    for (k, size) in [(1, part), (3, tilt), (4, tilt)] {
        let mut row = vec![0.0; 6];
        row[k] = size;
        rows.push(row);
    }
    let factored = factored(&rows);
    let found = factored.solution();
    let coefficients = [0.0, found[3], found[4], found[0] / 2.0, found[1], found[2] / 2.0];
    let (normal, answer) = monge(&[x, y, max.normal], &coefficients, Coordinates::Height, 1.0);
    Some((normal, answer, factored.squared_condition()))
}

fn numbers(normal: Vector, k: [f64; 2], mean: f64, tensor: &[Vector; 3], unit: f64) -> Vec<f64> {
    let curvatures = k.into_iter().chain([mean]).chain(tensor.as_flattened().iter().copied());
    normal.into_iter().chain(curvatures.map(|k| k / unit)).collect()
}

#[test]
fn meshes_of_all_kinds_have_the_sections_of_the_oracle() {
    let mut meshes = vec![
        mesh::torus(24, 15, 0.3, 0.0, 1),
        mesh::torus(20, 14, 0.3, 0.6, 2),
        mesh::height_field(14, 0.4, 4),
        mesh::dual_sphere(&mesh::quad_sphere(5, 0.6, 6)).mapped(|[x, y, z]| [x, 1.2 * y, 0.8 * z + 0.1 * x * y]),
        bodies::cube(6, 0.25, 1).mesh.mapped(|[x, y, z]| [x + 0.1 * z * y, y - 0.2 * x * z, z + 0.05 * x * y]),
        mesh::fan(3, true, 6),
        mesh::fan(40, false, 7),
    ];
    for seed in 0..8 {
        meshes.push(mesh::soup(40, 60, 3, seed));
        meshes.push(mesh::soup(30, 40, 6, 100 + seed));
    }
    let (mut compared, mut ill, mut several) = (0, 0, 0);
    for mesh in meshes {
        let found = of_method(&mesh, Method::TiltedSections);
        let fallback = normals(&mesh, Weight::TiltedSections).1;
        let mut random = Random::new(3);
        let near = mesh.positions.iter().map(|&p| add(p, [(); 3].map(|()| 1e-12 * random.signed()))).collect();
        let moved = Mesh { positions: near, ..mesh.clone() };
        let (oracle, other) = (Oracle::new(&mesh), Oracle::new(&moved));
        for (vertex, status) in fallback.into_iter().enumerate() {
            if status & status::FALLBACK != 0 {
                // Not about Max's normal.
                continue;
            }
            let Some((normal, answer, condition)) = expected(&mesh, &oracle, vertex) else {
                assert!(
                    found.status[vertex] & (status::DEGENERATE | status::ISOLATED) != 0,
                    "{}, {vertex}",
                    mesh.name
                );
                continue;
            };
            let unit = answer.k[0].abs().max(answer.k[1].abs()) + 1e-3;
            let (shaken, changed, _) = expected(&moved, &other, vertex).unwrap();
            let expected = numbers(normal, answer.k, answer.mean, &answer.tensor, unit);
            let changed = numbers(shaken, changed.k, changed.mean, &changed.tensor, unit);
            let k = [found.k1[vertex], found.k2[vertex]];
            let found = numbers(found.normal[vertex], k, found.mean[vertex], &found.tensor(vertex), unit);
            let change = changed.iter().zip(&expected).fold(0.0f64, |change, (a, b)| change.max((a - b).abs()));
            // Normal equations lose the square of the condition.
            let tolerance = 1e-9 + 10.0 * change + 4e-15 * condition;
            for (found, expected) in found.iter().zip(&expected) {
                let what = format!("{}, vertex {vertex}: {found} for {expected}, condition {condition:e}", mesh.name);
                assert!((found - expected).abs() <= tolerance, "{what}, tolerance {tolerance:e}");
            }
            compared += 1;
            ill += usize::from(tolerance > 1e-6);
            several += usize::from(oracle.fans(vertex).len() > 1);
        }
    }
    assert!(compared > 1700 && ill * 20 < compared && several > 200, "{compared}, {ill} ill, {several} several");
}

/// Points of a sphere of radius `r` through the origin whose centre is at `−r n`, around the origin.
fn on_sphere(random: &mut Random, n: Vector, r: f64, count: usize) -> Vec<Vector> {
    let [x, y] = tangents(n);
    let ring = (0..count).map(|i| {
        let around = std::f64::consts::TAU * (i as f64 + 0.35 * random.signed()) / count as f64;
        let polar = 0.05 + 0.9 * random.unit();
        let flat = add(scale(x, around.cos()), scale(y, around.sin()));
        scale(add(scale(flat, polar.sin()), scale(n, polar.cos() - 1.0)), r)
    });
    ring.collect()
}

fn check_sphere(found: &Fitted, n: Vector, r: f64, tolerance: f64, what: &str) {
    assert!(largest_difference(found.normal[0], n) < tolerance, "{what}: {:?} for {n:?}", found.normal[0]);
    for k in [found.k1[0], found.k2[0], found.mean[0]] {
        assert!((k * r - 1.0).abs() < tolerance, "{what}: {}", k * r);
    }
}

#[test]
fn rings_on_spheres_have_exact_normals_and_curvatures() {
    let mut random = Random::new(1);
    for round in 0..400 {
        let n = unit([random.signed(), random.signed(), random.signed()]);
        let r = 10f64.powf(6.0 * random.signed());
        let count = 4 + round % 9;
        // Rounding is magnified where few edges hardly tell the curvatures apart.
        let tolerance = if count < 5 { 1e-9 } else { 1e-12 };
        let ring = on_sphere(&mut random, n, r, count);
        let mut positions = vec![[0.0; 3]];
        positions.extend(&ring);
        let at = |i: usize| 1 + (i % count) as u32;
        let closed: Vec<Vec<u32>> = (0..count).map(|i| vec![0, at(i), at(i + 1)]).collect();
        let mesh = Mesh::new("closed", positions.clone(), closed.clone());
        check_sphere(
            &of_method(&mesh, Method::TiltedSections),
            n,
            r,
            tolerance,
            &format!("{count} triangles, round {round}"),
        );
        // Quads with the corner opposite anywhere, as long as they are flat: then Max's normal is that of triangles.
        let mut with_corners = positions.clone();
        let quads: Vec<Vec<u32>> = (0..count)
            .map(|i| {
                with_corners.push(scale(add(ring[i], ring[(i + 1) % count]), 0.6 + random.unit()));
                vec![0, at(i), with_corners.len() as u32 - 1, at(i + 1)]
            })
            .collect();
        let mesh = Mesh::new("quads", with_corners, quads);
        check_sphere(
            &of_method(&mesh, Method::TiltedSections),
            n,
            r,
            tolerance,
            &format!("{count} quads, round {round}"),
        );
    }
}

#[test]
fn several_fans_on_one_sphere_agree() {
    let mut random = Random::new(2);
    for round in 0..200 {
        let n = unit([random.signed(), random.signed(), random.signed()]);
        let r = 10f64.powf(3.0 * random.signed());
        // Closed fans that have only the vertex in common, each of its own size.
        let (mut positions, mut faces) = (vec![[0.0; 3]], vec![]);
        for fan in 0..2 + round % 2 {
            let (first, count) = (positions.len() as u32, 5 + random.below(4));
            let size = [1.0, 0.2, 0.04][fan];
            let ring = on_sphere(&mut random, n, r, count);
            // Towards the vertex along the sphere.
            positions.extend(ring.iter().map(|&p| {
                let (height, flat) = (dot(p, n), sub(p, scale(n, dot(p, n))));
                let polar = length(flat).atan2(r + height) * size;
                add(scale(unit(flat), r * polar.sin()), scale(n, r * (polar.cos() - 1.0)))
            }));
            let count = count as u32;
            faces.extend((0..count).map(|i| vec![0, first + i, first + (i + 1) % count]));
        }
        let mesh = Mesh::new("fans", positions, faces);
        let found = of_method(&mesh, Method::TiltedSections);
        assert_eq!(found.status[0], status::NON_MANIFOLD);
        check_sphere(&found, n, r, 1e-12, &format!("round {round}"));
    }
}

#[test]
fn at_a_boundary_the_sections_are_those_of_the_edges_there() {
    // Half a ring on a sphere, with the normal of its symmetry: Max's is exact there only along it.
    for count in [2, 3, 6] {
        let angle = |i: usize| std::f64::consts::PI * i as f64 / count as f64;
        let mut positions = vec![[0.0; 3]];
        positions.extend((0..=count).map(|i| [0.3 * angle(i).cos(), 0.3 * angle(i).sin(), -0.05]));
        let faces = (0..count as u32).map(|i| vec![0, i + 1, i + 2]).collect();
        let mesh = Mesh::new("half", positions, faces);
        let (found, oracle) = (of_method(&mesh, Method::TiltedSections), Oracle::new(&mesh));
        let (normal, answer, _) = expected(&mesh, &oracle, 0).unwrap();
        assert_eq!(found.status[0], status::BOUNDARY);
        assert!(largest_difference(found.normal[0], normal) < 1e-12 && found.normal[0][0].abs() < 1e-12);
        assert!((found.k1[0] - answer.k[0]).abs() < 1e-9 && (found.k2[0] - answer.k[1]).abs() < 1e-9);
    }
}

#[test]
fn without_an_edge_to_fit_max_stays() {
    // All neighbours at the vertex, or straight above it; one that is not is enough.
    let lone = vec![[0.0; 3], [0.0; 3], [0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let found = of_method(&Mesh::new("none", lone, vec![vec![0, 1, 2]]), Method::TiltedSections);
    assert_eq!(found.status, [33, 33, 33, 8, 8]);
    assert!(found.normal.iter().all(|n| *n == [0.0; 3]));
    let mesh = Mesh::new("triangle", vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]], vec![vec![0, 1, 2]]);
    let found = of_method(&mesh, Method::TiltedSections);
    for vertex in 0..3 {
        assert_eq!((found.status[vertex], found.normal[vertex]), (status::BOUNDARY, [0.0, 0.0, 1.0]));
        assert_eq!((found.k1[vertex], found.k2[vertex]), (0.0, 0.0));
    }
    // What is left out changes nothing: an edge without length, between two faces that have none either.
    let fan = mesh::fan(6, true, 1);
    let mut longer = fan.clone();
    longer.positions.push(fan.positions[0]);
    let extra = longer.positions.len() as u32 - 1;
    let mut faces = fan.face_vectors();
    faces[2] = vec![0, 3, extra];
    faces.push(vec![0, extra, 4]);
    let (with, without) =
        (of_method(&longer.with_faces(faces), Method::TiltedSections), expected(&fan, &Oracle::new(&fan), 0));
    let open: Vec<Vec<u32>> =
        fan.face_vectors().into_iter().enumerate().filter(|(i, _)| *i != 2).map(|(_, f)| f).collect();
    let gap = fan.with_faces(open);
    let expected = expected(&gap, &Oracle::new(&gap), 0).unwrap();
    assert!(largest_difference(with.normal[0], expected.0) < 1e-12, "{:?} {expected:?}", with.normal[0]);
    assert!((with.k1[0] - expected.1.k[0]).abs() < 1e-9 && without.is_some());
}

#[test]
fn normals_are_those_of_the_curvature_method_to_the_bit() {
    let mut meshes = vec![
        mesh::torus(40, 30, 0.4, 0.0, 1),
        mesh::torus(20, 14, 0.3, 0.6, 2),
        mesh::height_field(14, 0.4, 4),
        mesh::letter_prism(),
        mesh::fan(300, false, 7),
    ];
    for seed in 0..10 {
        meshes.push(mesh::soup(40, 60, 3, seed));
        meshes.push(mesh::soup(30, 40, 6, 100 + seed));
    }
    for mesh in meshes {
        let (normal, flags) = normals(&mesh, Weight::TiltedSections);
        let found = of_method(&mesh, Method::TiltedSections);
        for vertex in 0..mesh.positions.len() {
            assert_eq!(normal[vertex].map(f64::to_bits), found.normal[vertex].map(f64::to_bits), "{}", mesh.name);
            // Where another normal stands in for Max's, or nothing can be fitted, the normal is a fallback; curvatures are
            // those about it, or none.
            let other = flags[vertex] ^ found.status[vertex];
            let fallback = flags[vertex] & status::FALLBACK != 0;
            assert!(other == 0 || fallback && other & !(status::FALLBACK | status::DEGENERATE) == 0, "{}", mesh.name);
        }
    }
}
