//! Curvatures where the answer is known: spheres, cylinders, saddles, polynomials; signs, directions and identities.
//!
//! What is expected is worked out here from textbook formulas, in `f64`.

mod common;
use common::capi::{Handle, points};
use common::curvature::*;
use common::linear::{conjugated, eigenvalues, faces_of, neighbourhood, rotation, solved, times};
use common::mesh::{self, Mesh};
use common::{Random, Vector, cross, dot, largest_difference, length, scale, unit};
use umbilic::capi::*;

const CIRCLE: umb_section = UMB_SECTION_CIRCLE;

/// Unit spheres of triangles, of quads, of hexagons and pentagons, and of all kinds beside one another.
fn spheres() -> Vec<Mesh> {
    let (triangles, quads) = (mesh::tetrahedron_sphere(3), mesh::quad_sphere(6, 0.4, 1));
    vec![
        mesh::dual_sphere(&triangles),
        mesh::dual_sphere(&quads),
        mesh::dual_sphere(&mesh::ring_sphere(11, 6)),
        triangles,
        quads,
        mesh::ring_sphere(14, 9),
    ]
}

fn near(found: f64, expected: f64, tolerance: f64, what: &dyn Fn() -> String) {
    assert!((found - expected).abs() <= tolerance * expected.abs(), "{found:e} for {expected:e}: {}", what());
}

#[test]
fn spheres_with_exact_normals() {
    for unit_sphere in spheres() {
        for radius in [1.0, 0.01, 3e5, 1e-12] {
            let mesh = unit_sphere.mapped(|p| scale(p, radius));
            let normals: Vec<Vector> = mesh.positions.iter().map(|&p| unit(p)).collect();
            let find = |method, rings, ball: f64| {
                of_mesh(&mesh, method, Some(&normals), |options| {
                    (options.section, options.rings, options.radius) = (CIRCLE, rings, ball * radius);
                })
            };
            let check = |found: &Found, outputs: &[(Out, f64)]| {
                for (vertex, &normal) in normals.iter().enumerate() {
                    for &(output, tolerance) in outputs {
                        let expected = if output == Gaussian { 1.0 / radius / radius } else { 1.0 / radius };
                        let what = || format!("{output:?} of {}, method {}, {vertex}", mesh.name, found.method);
                        near(found.at(output, vertex), expected, tolerance, &what);
                    }
                    assert!(largest_difference(found.vector(Normal, vertex), normal) < 4e-16);
                }
            };
            // The edges of a jittered grid of quads hardly determine the twist of the fit.
            let fitted = [(K1, 1e-11), (K2, 1e-11), (Mean, 1e-11), (Gaussian, 1e-11), (Curvedness, 1e-11)];
            check(&find(UMB_CURVATURE_LEAST_SQUARES, 0, 0.0), &fitted);
            let exact = [(K1, 1e-12), (K2, 1e-12), (Mean, 1e-12), (Gaussian, 1e-12), (Curvedness, 1e-12)];
            check(&find(UMB_CURVATURE_RUSINKIEWICZ, 1, 0.0), &exact);
            // k = H ± √(H² − K) carries the root of what rounding leaves of H² − K.
            let roots = [(K1, 1e-6), (K2, 1e-6), (Mean, 1e-12), (Gaussian, 1e-12)];
            check(&find(UMB_CURVATURE_WATANABE, 0, 0.0), &roots);
            // Taubin's mean curvature is the mean of the sections; the difference of its k is that of the edges' directions.
            check(&find(UMB_CURVATURE_TAUBIN, 0, 0.0), &[(Mean, 1e-12)]);
            for (rings, ball) in [(0, 0.0), (1, 0.0), (2, 0.0), (3, 0.0), (0, 0.35), (0, 0.9), (0, 10.0)] {
                check(&find(UMB_CURVATURE_CORRECTED_MEASURE, rings, ball), &[(Mean, 1e-12), (Gaussian, 1e-12)]);
            }
            let handle = Handle::new(&mesh);
            let sections = edge_sections(&handle, &mesh.positions, |options| {
                (options.section, options.normals) = (CIRCLE, points(&normals));
            });
            assert!(sections.status.iter().all(|&status| status == 0));
            for curvature in sections.curvature {
                near(curvature, 1.0 / radius, 1e-12, &|| format!("a section of {}", mesh.name));
            }
        }
    }
}

/// A jittered grid of triangles or quads in the plane.
fn plane(side: usize, quads: f64, seed: u64) -> Mesh {
    mesh::height_field(side, quads, seed).mapped(|[x, y, _]| [x, y, 0.0])
}

/// `Σ c xⁱ yʲ` over `2 ≤ i + j ≤ degree`, its gradient and its second derivatives.
struct Polynomial(Vec<(i32, i32, f64)>);

impl Polynomial {
    fn random(degree: i32, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let terms = (2..=degree).flat_map(|total| (0..=total).map(move |j| (total - j, j)));
        Polynomial(terms.map(|(i, j)| (i, j, 0.3 * random.signed())).collect())
    }
    fn derivative(&self, x: f64, y: f64, dx: i32, dy: i32) -> f64 {
        let factor = |power: i32, times: i32| (0..times).fold(1.0, |f, k| f * (power - k) as f64);
        let power = |base: f64, power: i32| if power < 0 { 0.0 } else { base.powi(power) };
        let term =
            |&(i, j, c): &(i32, i32, f64)| c * factor(i, dx) * factor(j, dy) * power(x, i - dx) * power(y, j - dy);
        self.0.iter().map(term).sum()
    }
    fn gradient(&self, x: f64, y: f64) -> [f64; 2] {
        [self.derivative(x, y, 1, 0), self.derivative(x, y, 0, 1)]
    }
}

fn upward([p, q]: [f64; 2]) -> Vector {
    unit([-p, -q, 1.0])
}

/// The shape operator of `z = f(x, y)` in space: `P (−∇²f) P / √(1 + |∇f|²)` with the projection `P` along the normal.
fn shape([p, q]: [f64; 2], [xx, xy, yy]: [f64; 3]) -> [Vector; 3] {
    let (normal, w) = (upward([p, q]), (1.0 + p * p + q * q).sqrt());
    let project =
        |i: usize| -> Vector { std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 } - normal[i] * normal[j]) };
    conjugated(&[0, 1, 2].map(project), &[[-xx / w, -xy / w, 0.0], [-xy / w, -yy / w, 0.0], [0.0; 3]])
}

/// Compares curvatures, directions and normal with a shape operator, to a part of its size.
fn check_shape(found: &Found, vertex: usize, expected: &[Vector; 3], normal: Vector, tolerance: f64, what: &str) {
    let size = expected.iter().flatten().fold(0.0f64, |size, x| size.max(x.abs()));
    let tensor = tensor(found, vertex);
    for i in 0..3 {
        let difference = largest_difference(tensor[i], expected[i]) / size;
        assert!(difference <= tolerance, "{what}, vertex {vertex}: {difference:e}\n{tensor:?}\n{expected:?}");
    }
    let trace = expected[0][0] + expected[1][1] + expected[2][2];
    let squares: f64 = expected.iter().flatten().map(|x| x * x).sum();
    let radius = (squares / 2.0 - trace * trace / 4.0).max(0.0).sqrt();
    let known = [(K1, trace / 2.0 + radius), (K2, trace / 2.0 - radius), (Mean, trace / 2.0)];
    for (output, expected) in known {
        // The radius is a root: half the digits where the point is umbilic.
        let slack = if output == Mean { tolerance } else { tolerance * (size / radius.max(1e-5 * size)) };
        assert!((found.at(output, vertex) - expected).abs() <= slack * size, "{what}, {vertex}, {output:?}");
    }
    assert!(largest_difference(found.vector(Normal, vertex), normal) <= tolerance, "{what}, vertex {vertex}");
}

#[test]
fn jets_reproduce_polynomials_of_their_degree() {
    // A jet's heights are taken along the axis of least variance of its points. A slope is added to the polynomial that
    // makes this axis the polynomial's own at the vertex looked at; so each vertex has a surface of its own.
    let mut exact = 0;
    for (quads, seed) in [(0.0, 1), (1.0, 2), (0.5, 3)] {
        let flat = plane(9, quads, seed);
        let faces = faces_of(&flat);
        let turn = rotation(seed);
        for degree in 2..=4u32 {
            for vertex in 0..flat.positions.len() {
                let polynomial = Polynomial::random(degree as i32, seed + 100 * vertex as u64);
                let [cx, cy, _] = flat.positions[vertex];
                let height = |p: Vector| polynomial.derivative(p[0] - cx, p[1] - cy, 0, 0);
                let patch = neighbourhood(&flat, &faces, vertex, if degree == 4 { 3 } else { 2 });
                let mean = |f: &dyn Fn(Vector) -> f64| {
                    patch.iter().map(|&v| f(flat.positions[v])).sum::<f64>() / patch.len() as f64
                };
                let covariance = |f: &dyn Fn(Vector) -> f64, g: &dyn Fn(Vector) -> f64| {
                    mean(&|p| (f(p) - mean(f)) * (g(p) - mean(g)))
                };
                let (x, y) = (|p: Vector| p[0], |p: Vector| p[1]);
                let matrix =
                    vec![vec![covariance(&x, &x), covariance(&x, &y)], vec![covariance(&x, &y), covariance(&y, &y)]];
                let slope = solved(matrix, vec![-covariance(&x, &height), -covariance(&y, &height)]).unwrap();
                let lift = |p: Vector| [p[0], p[1], height(p) + slope[0] * (p[0] - cx) + slope[1] * (p[1] - cy)];
                let mesh = flat.mapped(|p| times(&turn, lift(p)));
                let list = [vertex as u32];
                let found = of_mesh(&mesh, UMB_CURVATURE_JET, None, |options| {
                    (options.degree, options.run.vertices, options.run.vertex_count) = (degree, list.as_ptr(), 1);
                });
                if found.status[vertex] & UMB_VERTEX_WIDENED != 0 {
                    continue; // The axis was made for fewer points.
                }
                exact += 1;
                let gradient = [slope[0], slope[1]];
                let second = [(2, 0), (1, 1), (0, 2)].map(|(i, j)| polynomial.derivative(0.0, 0.0, i, j));
                let expected = conjugated(&turn, &shape(gradient, second));
                let normal = times(&turn, upward(gradient));
                check_shape(&found, vertex, &expected, normal, 1e-9, &format!("degree {degree}, {}", mesh.name));
                assert!(found.at(Residual, vertex) < 1e-13, "{}", found.at(Residual, vertex));
            }
        }
    }
    assert!(exact >= 3 * 3 * 81 * 9 / 10, "{exact}");
}

#[test]
fn quadrics_and_cubics_with_exact_normals() {
    // Tangent to the plane at the vertex looked at; in any position.
    for (quads, seed) in [(0.0, 4), (1.0, 5), (0.5, 6)] {
        let flat = plane(7, quads, seed);
        let turn = rotation(seed);
        for (method, degree) in [(UMB_CURVATURE_QUADRIC, 2), (UMB_CURVATURE_GOLDFEATHER, 3)] {
            for rings in [0, 2] {
                for vertex in 0..flat.positions.len() {
                    let polynomial = Polynomial::random(degree, seed + vertex as u64);
                    let [cx, cy, _] = flat.positions[vertex];
                    let height = |[x, y, _]: Vector| polynomial.derivative(x - cx, y - cy, 0, 0);
                    let mesh = flat.mapped(|p| times(&turn, [p[0], p[1], height(p)]));
                    let normal = |&[x, y, _]: &Vector| times(&turn, upward(polynomial.gradient(x - cx, y - cy)));
                    let normals: Vec<Vector> = flat.positions.iter().map(normal).collect();
                    let list = [vertex as u32];
                    let found = of_mesh(&mesh, method, Some(&normals), |options| {
                        (options.rings, options.run.vertices, options.run.vertex_count) = (rings, list.as_ptr(), 1);
                    });
                    assert_eq!(found.status[vertex] & UMB_VERTEX_FALLBACK, 0);
                    let second = [(2, 0), (1, 1), (0, 2)].map(|(i, j)| polynomial.derivative(0.0, 0.0, i, j));
                    let expected = conjugated(&turn, &shape([0.0; 2], second));
                    check_shape(&found, vertex, &expected, normals[vertex], 1e-9, &format!("method {method}"));
                    assert!(found.at(Residual, vertex) < 1e-13);
                }
            }
        }
    }
}

/// A grid of the plane symmetric about its axes and its middle, by `height`; squares, or triangles that meet in eights.
fn symmetric(side: usize, quads: bool, place: impl Fn(f64, f64) -> Vector) -> Mesh {
    let step = |i: usize| 2.0 * i as f64 / (side - 1) as f64 - 1.0;
    let positions = (0..side * side).map(|index| place(step(index / side), step(index % side))).collect();
    let mut faces = vec![];
    for i in 0..side - 1 {
        for j in 0..side - 1 {
            let [a, b, c, d] = [i * side + j, (i + 1) * side + j, (i + 1) * side + j + 1, i * side + j + 1];
            let [a, b, c, d] = [a, b, c, d].map(|index| index as u32);
            match (quads, (i + j) % 2) {
                (true, _) => faces.push(vec![a, b, c, d]),
                (_, 0) => faces.extend([vec![a, b, c], vec![a, c, d]]),
                _ => faces.extend([vec![a, b, d], vec![b, c, d]]),
            }
        }
    }
    Mesh::new("symmetric", positions, faces)
}

#[test]
fn cylinders_and_saddles_have_their_signs_and_directions() {
    const SIDE: usize = 17;
    let middle = SIDE * SIDE / 2;
    // Integrals over so few directions, and measures over so small a region, are rough.
    let rough = |method| [UMB_CURVATURE_TAUBIN, UMB_CURVATURE_WATANABE, UMB_CURVATURE_NORMAL_CYCLE].contains(&method);
    for quads in [false, true] {
        // Around y, seen from outside: x to the right, y up, N towards z.
        let cylinder = symmetric(SIDE, quads, |u, v| [(0.8 * u).sin() * 3.0, 2.4 * v, (0.8 * u).cos() * 3.0]);
        let saddle = symmetric(SIDE, quads, |u, v| [u, v, u * u - v * v]);
        for method in METHODS {
            if !K1.is_of(method) {
                continue;
            }
            let (x, y) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
            let cases = [
                (cylinder.clone(), [1.0 / 3.0, 0.0], [x, y]),
                (cylinder.reversed(), [0.0, -1.0 / 3.0], [y, x]),
                (saddle.clone(), [2.0, -2.0], [y, x]),
                (saddle.reversed(), [2.0, -2.0], [x, y]),
            ];
            for (mesh, [k1, k2], [d1, d2]) in cases {
                let what = format!("method {method}, quads {quads}, k {k1} {k2}");
                let found = of_mesh(&mesh, method, None, |_| ());
                let tolerance = if rough(method) { 1.01 } else { 0.1 } * f64::max(k1, -k2);
                assert!((found.at(K1, middle) - k1).abs() < tolerance, "{what}: {}", found.at(K1, middle));
                assert!((found.at(K2, middle) - k2).abs() < tolerance, "{what}: {}", found.at(K2, middle));
                if Direction1.is_of(method) {
                    let normal = found.vector(Normal, middle);
                    assert!(largest_difference(found.vector(Direction1, middle), d1) < 1e-9, "{what}");
                    let second = scale(d2, dot(cross(normal, d1), d2).signum());
                    assert!(largest_difference(found.vector(Direction2, middle), second) < 1e-9, "{what}");
                }
            }
        }
    }
}

#[test]
fn koenderinks_indices() {
    let diagonal = 0.5f64.sqrt();
    for quads in [false, true] {
        for ([a, b], index) in
            [([1.0, 1.0], 1.0), ([1.0, 0.0], 0.5), ([1.0, -1.0], 0.0), ([0.0, -1.0], -0.5), ([-1.0, -1.0], -1.0)]
        {
            let mesh = symmetric(5, quads, |u, v| [u, v, -0.5 * (a * u * u + b * v * v)]);
            for method in [UMB_CURVATURE_JET, UMB_CURVATURE_QUADRIC] {
                let found = of_mesh(&mesh, method, None, |_| ());
                assert!((found.at(ShapeIndex, 12) - index).abs() < 1e-9, "{a} {b}: {}", found.at(ShapeIndex, 12));
                let curvedness = diagonal * (a * a + b * b).sqrt();
                assert!((found.at(Curvedness, 12) - curvedness).abs() < 1e-9);
            }
        }
        let flat = of_mesh(&symmetric(5, quads, |u, v| [u, v, 0.0]), UMB_CURVATURE_JET, None, |_| ());
        assert_eq!((flat.at(ShapeIndex, 12), flat.at(Curvedness, 12)), (0.0, 0.0));
    }
}

#[test]
fn outputs_belong_together() {
    let meshes = [
        mesh::torus(19, 11, 0.3, 0.0, 1),
        mesh::torus(17, 12, 0.3, 0.5, 2),
        mesh::height_field(9, 0.4, 3),
        mesh::letter_prism(),
        mesh::soup(40, 60, 3, 4),
        mesh::soup(40, 50, 6, 5),
    ];
    for mesh in meshes {
        for method in METHODS {
            let found = of_mesh(&mesh, method, None, |_| ());
            for vertex in (0..mesh.positions.len()).filter(|&v| found.known(v)) {
                let what = format!("{}, method {method}, vertex {vertex}", mesh.name);
                if !K1.is_of(method) {
                    continue;
                }
                let [k1, k2, h] = [K1, K2, Mean].map(|output| found.at(output, vertex));
                let normal = found.vector(Normal, vertex);
                let size = k1.abs().max(k2.abs()).max(h.abs());
                assert!(k1 >= k2 && (length(normal) - 1.0).abs() < 1e-14, "{what}");
                let curvedness = ((k1 * k1 + k2 * k2) / 2.0).sqrt();
                assert!((found.at(Curvedness, vertex) - curvedness).abs() <= 1e-14 * curvedness, "{what}");
                let index = (k1 + k2).atan2(k1 - k2) * std::f64::consts::FRAC_2_PI;
                assert!((found.at(ShapeIndex, vertex) - index).abs() < 1e-14, "{what}");
                let mean_normal = found.vector(MeanNormal, vertex);
                if method == UMB_CURVATURE_MEYER {
                    // The gradient itself, whose length is H and which lies on the side that H says.
                    assert!((length(mean_normal) - h.abs()).abs() <= 1e-14 * h.abs(), "{what}");
                    assert!(dot(mean_normal, normal) * h >= 0.0, "{what}");
                } else {
                    assert!(largest_difference(mean_normal, scale(normal, h)) <= 1e-14 * size, "{what}");
                }
                if method != UMB_CURVATURE_CORRECTED_MEASURE {
                    assert!(((k1 + k2) / 2.0 - h).abs() <= 1e-14 * size, "{what}");
                }
                if Direction1.is_of(method) {
                    let (d1, d2) = (found.vector(Direction1, vertex), found.vector(Direction2, vertex));
                    assert!((length(d1) - 1.0).abs() < 1e-14 && dot(d1, normal).abs() < 1e-14, "{what}");
                    assert!(largest_difference(d2, cross(normal, d1)) < 1e-15, "{what}");
                    let largest = d1.iter().fold(0.0f64, |largest, x| largest.max(x.abs()));
                    assert_eq!(d1.into_iter().find(|x| x.abs() == largest), Some(largest), "{what}: {d1:?}");
                    if method != UMB_CURVATURE_CORRECTED_MEASURE {
                        let gaussian = found.at(Gaussian, vertex);
                        assert!((gaussian - k1 * k2).abs() <= 1e-14 * size * size, "{what}");
                    }
                }
                // The normal cycle's integral counts what its tensor has along the normal as well.
                if IntegratedMean.is_of(method) && method != UMB_CURVATURE_NORMAL_CYCLE {
                    let integral = h * found.at(Area, vertex);
                    assert!((found.at(IntegratedMean, vertex) - integral).abs() <= 1e-13 * integral.abs(), "{what}");
                }
            }
        }
    }
}

#[test]
fn a_grid_of_quads_is_as_round_as_its_edges_allow() {
    // Two directions at right angles say the two curvatures, and nothing of the twist between them.
    let mesh = symmetric(5, true, |u, v| [u, v, -0.5 * u * u - 1.5 * v * v + 0.7 * u * v]);
    let normals = vec![[0.0, 0.0, 1.0]; 25];
    let found = of_mesh(&mesh, UMB_CURVATURE_LEAST_SQUARES, Some(&normals), |_| ());
    assert_eq!(found.status[12], UMB_VERTEX_FALLBACK);
    assert_eq!([found.at(K1, 12), found.at(K2, 12)], eigenvalues([1.0, 0.0, 3.0]));
    assert_eq!((found.vector(Direction1, 12), found.at(Residual, 12)), ([0.0, 1.0, 0.0], 0.0));
}
