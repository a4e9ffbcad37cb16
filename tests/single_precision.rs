//! Curvatures in single precision are those of double precision, but for what single precision costs anywhere.

mod common;
use common::mesh::{self, Mesh};
use common::{dot, length, real, sub, unit};
use umbilic::*;

/// How far, in units of a power of one by the shortest edge at the vertex, a result in single precision may be off.
const TOLERANCE: f64 = 2e-6;

struct Answers<S> {
    k1: Vec<S>,
    k2: Vec<S>,
    mean: Vec<S>,
    gaussian: Vec<S>,
    mean_normal: Vec<[S; 3]>,
    direction1: Vec<[S; 3]>,
    direction2: Vec<[S; 3]>,
    area: Vec<S>,
    integrated_mean: Vec<S>,
    integrated_gaussian: Vec<S>,
    shape_index: Vec<S>,
    curvedness: Vec<S>,
    normal: Vec<[S; 3]>,
    status: Vec<u8>,
}

macro_rules! answers {
    ($name:ident, $scalar:ty) => {
        fn $name(
            topology: &Topology,
            positions: &[[f32; 3]],
            options: &CurvatureOptions<'_>,
            principal: bool,
        ) -> Answers<$scalar> {
            let count = positions.len();
            let (number, vector) = (|| vec![0.0; count], || vec![[0.0; 3]; count]);
            let mut found = Answers {
                k1: number(),
                k2: number(),
                mean: number(),
                gaussian: number(),
                mean_normal: vector(),
                direction1: vector(),
                direction2: vector(),
                area: number(),
                integrated_mean: number(),
                integrated_gaussian: number(),
                shape_index: number(),
                curvedness: number(),
                normal: vector(),
                status: vec![0; count],
            };
            let method = options.method;
            let has = |kind| method.has(kind);
            let directions = principal && has(CurvatureKind::Directions);
            let outputs = CurvatureOutputs {
                k1: (principal && has(CurvatureKind::Principal)).then(|| found.k1.as_mut_slice().into()),
                k2: (principal && has(CurvatureKind::Principal)).then(|| found.k2.as_mut_slice().into()),
                mean: has(CurvatureKind::Mean).then(|| found.mean.as_mut_slice().into()),
                gaussian: has(CurvatureKind::Gaussian).then(|| found.gaussian.as_mut_slice().into()),
                mean_normal: has(CurvatureKind::Mean).then(|| found.mean_normal.as_mut_slice().into()),
                direction1: directions.then(|| found.direction1.as_mut_slice().into()),
                direction2: directions.then(|| found.direction2.as_mut_slice().into()),
                area: has(CurvatureKind::Area).then(|| found.area.as_mut_slice().into()),
                integrated_mean: has(CurvatureKind::IntegratedMean)
                    .then(|| found.integrated_mean.as_mut_slice().into()),
                integrated_gaussian: has(CurvatureKind::IntegratedGaussian)
                    .then(|| found.integrated_gaussian.as_mut_slice().into()),
                shape_index: (principal && has(CurvatureKind::Principal))
                    .then(|| found.shape_index.as_mut_slice().into()),
                curvedness: (principal && has(CurvatureKind::Principal))
                    .then(|| found.curvedness.as_mut_slice().into()),
                normal: Some(found.normal.as_mut_slice().into()),
                status: Some(found.status.as_mut_slice().into()),
                ..CurvatureOutputs::default()
            };
            curvatures(topology, &positions.into(), options, Run::default(), &outputs).unwrap();
            found
        }
    };
}
answers!(single, f32);
answers!(double, f64);

/// The shortest and the longest edge at a vertex.
fn edges(topology: &Topology, positions: &[[f64; 3]], vertex: usize) -> (f64, f64) {
    let edge = |&other: &u32| length(sub(positions[other as usize], positions[vertex]));
    let edges = topology.ring(vertex).iter().map(edge);
    edges.fold((f64::INFINITY, 0.0), |(shortest, longest), edge| (shortest.min(edge), longest.max(edge)))
}

/// The largest errors of a method on a mesh, and how many vertices were compared.
fn compare(mesh: &Mesh, method: Method, given: bool) -> (f64, usize) {
    let positions = mesh.single();
    let wide: Vec<[f64; 3]> = positions.iter().map(|p| p.map(f64::from)).collect();
    let topology = Topology::new(&Faces::polygons(&mesh.indices, &mesh.offsets).unwrap(), positions.len()).unwrap();
    let mut normals = vec![[0f32; 3]; positions.len()];
    let outputs = NormalOutputs { normal: Some(normals.as_mut_slice().into()), ..NormalOutputs::default() };
    let weight = if given { Weight::Angle } else { Weight::Conformal };
    vertex_normals(&topology, &positions[..].into(), weight, Run::default(), &outputs).unwrap();
    if given {
        // Given normals are brought to length one, and rounded.
        normals = normals
            .iter()
            .map(|n| if *n == [0.0; 3] { *n } else { unit(n.map(f64::from)).map(|x| x as f32) })
            .collect();
    }
    let rounded: Vec<[f64; 3]> = normals.iter().map(|n| n.map(f64::from)).collect();
    let options =
        |normals| CurvatureOptions { method, section: Section::Circle, normals, ..CurvatureOptions::default() };
    let computed = VertexNormals::Computed(Weight::Conformal);
    let principal = !matches!(method, Method::Watanabe | Method::Meyer);
    let asked = options(if given { VertexNormals::Given(normals[..].into()) } else { computed });
    let found = single(&topology, &positions, &asked, principal);
    // Where normals are computed beforehand, they are in single precision as well.
    let beforehand = given || matches!(method, Method::Rusinkiewicz | Method::CorrectedMeasure);
    let asked = options(if beforehand { VertexNormals::Given(rounded[..].into()) } else { computed });
    let expected = double(&topology, &positions, &asked, principal);
    let (mut worst, mut compared) = (0.0f64, 0);
    for vertex in 0..positions.len() {
        assert_eq!(found.status[vertex], expected.status[vertex], "{}, {method:?}, vertex {vertex}", mesh.name);
        let (edge, extent) = edges(&topology, &wide, vertex);
        if topology.ring(vertex).is_empty() || edge == 0.0 {
            continue;
        }
        compared += 1;
        // Gaussian curvature has the error of one principal curvature times the other.
        let sharpest = expected.k1[vertex].abs().max(expected.k2[vertex].abs()) * edge;
        let numbers = [
            (found.k1[vertex], expected.k1[vertex], 1),
            (found.k2[vertex], expected.k2[vertex], 1),
            (found.mean[vertex], expected.mean[vertex], 1),
            (found.gaussian[vertex], expected.gaussian[vertex], 2),
        ];
        let mut errors = numbers.map(|(found, expected, power)| {
            // Beyond the range stands the largest number.
            let expected = expected.clamp(-f32::MAX as f64, f32::MAX as f64);
            // Relative where curvature is more than one by the edge.
            let size = (expected.abs() * edge.powi(power)).max(1.0).max(if power == 2 { sharpest } else { 0.0 });
            (found as f64 - expected).abs() * edge.powi(power) / size
        });
        // A mean curvature normal in the tangent plane has no sign.
        if method == Method::Meyer
            && dot(expected.mean_normal[vertex], rounded[vertex]).abs() < 1e-6 * numbers[2].1.abs()
        {
            errors[2] =
                (numbers[2].0.abs() as f64 - numbers[2].1.abs()).abs() * edge / (numbers[2].1.abs() * edge).max(1.0);
        }
        let vector = sub(found.mean_normal[vertex].map(f64::from), expected.mean_normal[vertex]);
        errors[2] = errors[2].max(length(vector) * edge / (expected.mean[vertex].abs() * edge).max(1.0));
        // What is integrated has no denominator, so the extent of the ring counts.
        let off = |found: &[f32], expected: &[f64]| (found[vertex] as f64 - expected[vertex]).abs();
        let mut others = [
            off(&found.area, &expected.area) / (extent * extent),
            off(&found.integrated_mean, &expected.integrated_mean) / extent,
            off(&found.integrated_gaussian, &expected.integrated_gaussian),
            off(&found.curvedness, &expected.curvedness) * edge / (expected.curvedness[vertex] * edge).max(1.0),
            off(&found.shape_index, &expected.shape_index) * (expected.curvedness[vertex] * edge).min(1.0),
            length(sub(found.normal[vertex].map(f64::from), expected.normal[vertex])),
        ];
        if method == Method::Meyer && errors[2] < TOLERANCE && found.mean[vertex] as f64 * expected.mean[vertex] < 0.0
        {
            others[1] = 0.0;
        }
        // Directions are of length one but for their own rounding, however the normal was.
        for direction in [found.direction1[vertex], found.direction2[vertex]] {
            let off = (length(direction.map(f64::from)) - 1.0).abs();
            assert!(direction == [0.0; 3] || off < 6e-8, "{}, {method:?}, vertex {vertex}: {off:e}", mesh.name);
        }
        // The direction is as sharp as the principal curvatures are apart.
        let apart = (expected.k1[vertex] - expected.k2[vertex]) * edge;
        if principal && apart > 1e-3 {
            let d = |v: [f32; 3]| v.map(f64::from);
            let (d1, d2) = (d(found.direction1[vertex]), d(found.direction2[vertex]));
            let (e1, e2) = (expected.direction1[vertex], expected.direction2[vertex]);
            let away = |d: [f64; 3], e: [f64; 3]| length(sub(d, e)).min(length(sub(d, e.map(|x| -x))));
            errors[0] = errors[0].max(away(d1, e1).max(away(d2, e2)) * apart.min(1.0) / 4.0);
        }
        let error = errors.into_iter().chain(others).fold(0.0, f64::max);
        if error > TOLERANCE {
            println!(
                "{}, {method:?}, given {given}, vertex {vertex}: {error:e} {errors:?} {others:?} edge {edge}",
                mesh.name
            );
        }
        worst = worst.max(error);
    }
    (worst, compared)
}

const METHODS: [Method; 8] = [
    Method::LeastSquares,
    Method::Taubin,
    Method::Watanabe,
    Method::Meyer,
    Method::AngleDefect,
    Method::Rusinkiewicz,
    Method::NormalCycle,
    Method::CorrectedMeasure,
];

/// A bent hexagon with one rim vertex `short` from the centre, as rounding leaves it at poles and seams.
fn short_edge(short: f64) -> Mesh {
    let mut positions = vec![[0.0; 3]];
    for i in 0..6 {
        let (sine, cosine) = (i as f64 * std::f64::consts::FRAC_PI_3).sin_cos();
        let length = if i == 2 { short } else { 1.0 };
        positions.push([length * cosine, length * sine, -0.2 * length * length]);
    }
    let faces = (0..6).map(|i| vec![0, 1 + i, 1 + (i + 1) % 6]).collect();
    Mesh::new(&format!("short edge {short:e}"), positions, faces)
}

#[test]
fn single_precision_is_as_good_as_it_can_be() {
    let mut meshes = vec![
        mesh::torus(90, 60, 0.1, 0.0, 1),
        mesh::torus(60, 50, 0.5, 0.0, 2),
        mesh::height_field(60, 0.0, 3),
        mesh::tetrahedron_sphere(5),
        mesh::torus(30, 20, 0.3, 0.5, 4),
    ];
    meshes.extend((3..30).map(|power| short_edge(10f64.powi(-power) * 4.0)));
    meshes.extend((0..30).map(|seed| mesh::soup(40, 60, 3, seed)));
    meshes.extend(real::meshes());
    let mut failures = vec![];
    for method in METHODS {
        for given in [false, true] {
            let mut all = 0;
            for mesh in &meshes {
                let (worst, compared) = compare(mesh, method, given);
                all += compared;
                if worst > TOLERANCE {
                    failures.push(format!("{}, {method:?}, given {given}: {worst:e}", mesh.name));
                }
            }
            assert!(all > 10_000);
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}
