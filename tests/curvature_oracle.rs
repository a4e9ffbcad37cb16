//! The library against a naive oracle in double precision, on generated, random and real meshes: every method but jets, whose
//! oracle is that of their normals and whose curvatures are exact where they should be.
//!
//! **Tolerance.** 1e-9 of the vertex's curvature (of a thousandth of the inverse of its longest edge where it is flatter than
//! that), and ten times what the oracle's own answer changes by when positions move by 1e-12 of the edges at them and normals by
//! 1e-12: a sliver, a nearly flat fit or a root near zero is as exact as its input lets it be, and no vertex has to be left out
//! for that. (Roots near zero, and faces whose normal equations square their condition, get what their formula loses.) Where this
//! allows more than 1e-6 of the vertex's curvature the comparison says little, and counts as
//! ill-conditioned.
//!
//! **Left out,** and counted: *simpler*, vertices for which the library says fallback or widened, since the oracle has only the
//! method itself; *without* result, for which the oracle must have none either, or an ill-conditioned one; *ambiguous*, where
//! a sign is that of rounding: Meyer's gradient of area in the tangent plane, as at the boundary of something flat, and faces
//! back to back, which the normal cycle may fold either way.

mod common;
use common::answer::Answer;
use common::curvature::*;
use common::curvature_oracle::{CurvatureOracle, Region};
use common::mesh::{self, Mesh};
use common::{Random, Vector, add, length, real, scale, sub, unit};
use umbilic::capi::*;

fn meshes() -> Vec<Mesh> {
    let mut meshes = vec![
        mesh::torus(24, 15, 0.3, 0.0, 1),
        mesh::torus(20, 14, 0.3, 0.6, 2),
        mesh::torus(16, 12, 0.3, 1.0, 3),
        mesh::height_field(14, 0.0, 4),
        mesh::height_field(13, 0.5, 5),
        mesh::dual_sphere(&mesh::quad_sphere(5, 0.6, 6)),
        mesh::letter_prism().mapped(|[x, y, z]| [x + 0.1 * z * y, y - 0.2 * x * z, z + 0.05 * x * y]),
        mesh::fan(3, true, 7),
        mesh::fan(17, true, 8),
        mesh::fan(40, false, 9),
        mesh::fan(2, false, 10),
    ];
    for seed in 0..12 {
        meshes.push(mesh::soup(40, 60, 3, seed));
        meshes.push(mesh::soup(30, 40, 6, 100 + seed));
    }
    // The large ones have nothing that the others lack.
    meshes.extend(real::meshes().into_iter().filter(|mesh| mesh.positions.len() < 15_000));
    meshes
}

#[derive(Default)]
struct Count {
    compared: usize,
    ill: usize,
    simpler: usize,
    none: usize,
    ambiguous: usize,
}

/// The longest edge at every vertex.
fn extents(mesh: &Mesh) -> Vec<f64> {
    let mut extents = vec![0.0f64; mesh.positions.len()];
    for face in mesh.faces() {
        for (place, &a) in face.iter().enumerate() {
            let b = face[(place + 1) % face.len()];
            let edge = length(sub(mesh.positions[a as usize], mesh.positions[b as usize]));
            for v in [a as usize, b as usize] {
                extents[v] = extents[v].max(edge);
            }
        }
    }
    extents
}

/// The numbers of an answer with their units, those that the method has.
fn numbers(method: umb_curvature_method, answer: &Answer, curvature: f64) -> Vec<(f64, f64, Out)> {
    let mut numbers = vec![];
    let mut push = |output: Out, values: &[f64], unit: f64| {
        if output.is_of(method) {
            numbers.extend(values.iter().map(|&value| (value, unit, output)));
        }
    };
    push(K1, &[answer.k[0]], curvature);
    push(K2, &[answer.k[1]], curvature);
    push(Mean, &[answer.mean], curvature);
    push(MeanNormal, &answer.mean_normal, curvature);
    push(Direction1, answer.tensor.as_flattened(), curvature);
    let defect = method == UMB_CURVATURE_ANGLE_DEFECT || method == UMB_CURVATURE_MEYER;
    // An angle defect is what is left of 2π.
    let gaussian = if defect { 1.0 / answer.area } else { curvature * curvature };
    push(Gaussian, &[answer.gaussian], gaussian);
    push(Area, &[answer.area], answer.area);
    push(IntegratedMean, &[answer.integrated_mean], curvature * answer.area);
    push(IntegratedGaussian, &[answer.integrated_gaussian], gaussian * answer.area);
    if method == UMB_CURVATURE_LEAST_SQUARES {
        // A residual is the root of a sum of squares whose terms lose half their digits where it is small.
        push(Residual, &[answer.residual], curvature * 1e2);
    }
    numbers
}

fn found_answer(found: &Found, vertex: usize) -> Answer {
    let method = found.method;
    let at = |output: Out| if found.has(output) { found.at(output, vertex) } else { 0.0 };
    Answer {
        k: [at(K1), at(K2)],
        mean: at(Mean),
        gaussian: at(Gaussian),
        mean_normal: if found.has(MeanNormal) { found.vector(MeanNormal, vertex) } else { [0.0; 3] },
        tensor: if Direction1.is_of(method) { tensor(found, vertex) } else { [[0.0; 3]; 3] },
        area: at(Area),
        integrated_mean: at(IntegratedMean),
        integrated_gaussian: at(IntegratedGaussian),
        residual: at(Residual),
        ..Answer::default()
    }
}

/// Compares a call with the oracle.
fn compare(
    mesh: &Mesh,
    found: &Found,
    ask: impl Fn(&CurvatureOracle<'_>, usize) -> Option<Answer>,
    count: &mut Count,
    what: &str,
) {
    let normals = found.normals();
    let oracle = CurvatureOracle::new(mesh, &normals);
    let extents = extents(mesh);
    let mut random = Random::new(1);
    let mut shake = |v: Vector, size: f64| add(v, [(); 3].map(|()| 1e-12 * size * random.signed()));
    let mut moved = vec![];
    for _ in 0..2 {
        let mut copy = mesh.clone();
        copy.positions.iter_mut().zip(&extents).for_each(|(p, &extent)| *p = shake(*p, extent));
        let size = |n: &Vector| if length(*n) > 0.0 { 1.0 } else { 0.0 };
        moved.push((copy, normals.iter().map(|n| shake(*n, size(n))).collect::<Vec<_>>()));
    }
    let moved: Vec<_> = moved.iter().map(|(mesh, normals)| CurvatureOracle::new(mesh, normals)).collect();
    let method = found.method;
    for vertex in (0..mesh.positions.len()).step_by(1 + mesh.positions.len() / 300) {
        if found.status[vertex] & UMB_VERTEX_ISOLATED != 0 {
            continue;
        }
        // Of least squares, the oracle knows what stands in as well.
        let stands_in = UMB_VERTEX_FALLBACK | UMB_VERTEX_WIDENED;
        if method != UMB_CURVATURE_LEAST_SQUARES && found.status[vertex] & stands_in != 0 {
            count.simpler += 1;
            continue;
        }
        let no_normal = method != UMB_CURVATURE_ANGLE_DEFECT && length(normals[vertex]) == 0.0;
        let expected = if no_normal { None } else { ask(&oracle, vertex) };
        let Some(expected) = expected else {
            assert!(!found.known(vertex) || method == UMB_CURVATURE_LEAST_SQUARES, "{what}, vertex {vertex}");
            count.none += 1;
            continue;
        };
        if expected.ambiguous {
            count.ambiguous += 1;
            continue;
        }
        let curvature =
            expected.k[0].abs().max(expected.k[1].abs()).max(expected.mean.abs()) + 1e-3 / extents[vertex];
        let shape = |answer: &Answer| numbers(method, answer, curvature);
        let nothing = || vec![(f64::INFINITY, 0.0, K1); shape(&expected).len()];
        let others: Vec<_> = moved.iter().map(|o| ask(o, vertex).map_or_else(nothing, |a| shape(&a))).collect();
        let answer = shape(&found_answer(found, vertex));
        // The library solves a face's system by its normal equations, which square the condition.
        let narrow = 1e-15 * expected.narrow * curvature;
        let mut ill = false;
        // k = H ± √(H² − K) has the root of what rounding leaves of the difference.
        let whole = if method == UMB_CURVATURE_MEYER { 1.0 / expected.area } else { 0.0 };
        let lost = 1e-14 * (expected.mean.powi(2) + expected.gaussian.abs() + whole);
        let is_root = method == UMB_CURVATURE_WATANABE || method == UMB_CURVATURE_MEYER;
        let rooted = if is_root { lost / lost.max(expected.mean.powi(2) - expected.gaussian).sqrt() } else { 0.0 };
        for (index, (expected, unit, output)) in shape(&expected).into_iter().enumerate() {
            let change = others.iter().fold(0.0f64, |change, other| change.max((other[index].0 - expected).abs()));
            let root = if matches!(output, K1 | K2) { rooted } else { 0.0 };
            let tolerance = 1e-9 * unit + 10.0 * change + root + narrow;
            ill |= tolerance.is_nan() || tolerance > 1e-6 * unit;
            let difference = (answer[index].0 - expected).abs();
            assert!(
                difference <= tolerance || tolerance.is_nan() || !found.known(vertex) && ill,
                "{what}, vertex {vertex}, {output:?}: {} for {expected}, tolerance {tolerance:e}, status {}",
                answer[index].0,
                found.status[vertex]
            );
        }
        count.compared += 1;
        count.ill += ill as usize;
    }
}

/// Runs a method over all meshes with several kinds of normals.
fn run(
    method: umb_curvature_method,
    set: impl Fn(&mut umb_curvature_options, &Mesh),
    ask: impl Fn(&CurvatureOracle<'_>, usize, &Mesh) -> Option<Answer>,
) {
    let mut count = Count::default();
    for mesh in meshes() {
        let mut random = Random::new(3);
        // Normals of the caller's: the average's, tilted by some degrees and of any length.
        let tilted = |n: Vector| scale(add(n, [(); 3].map(|()| 0.1 * random.signed())), 1.0 + random.unit());
        let own = of_mesh(&mesh, UMB_CURVATURE_WATANABE, None, |_| ()).normals();
        let given: Vec<Vector> = own.into_iter().map(tilted).collect();
        for (weight, normals) in [(UMB_WEIGHT_CONFORMAL, None), (UMB_WEIGHT_MAX, None), (0, Some(&given[..]))] {
            if method == UMB_CURVATURE_ANGLE_DEFECT && (weight != 0 || normals.is_some()) {
                continue;
            }
            let found = of_mesh(&mesh, method, normals, |options| {
                options.weight = weight;
                set(options, &mesh);
            });
            let what = format!("{}, method {method}, weight {weight}, given {}", mesh.name, normals.is_some());
            compare(&mesh, &found, |oracle, vertex| ask(oracle, vertex, &mesh), &mut count, &what);
        }
    }
    let Count { compared, ill, simpler, none, ambiguous } = count;
    println!(
        "method {method}: {compared} compared, {ill} of them ill-conditioned; {simpler} simpler, {none} without, {ambiguous} ambiguous"
    );
    assert!(compared > 8 * (ill + none + ambiguous) && compared > 8 * simpler);
}

const SECTIONS: [umb_section; 2] = [UMB_SECTION_CIRCLE, UMB_SECTION_SYMMETRIC_PARABOLA];

#[test]
fn least_squares() {
    for section in SECTIONS {
        run(UMB_CURVATURE_LEAST_SQUARES, |o, _| o.section = section, |o, v, _| o.least_squares(v, section));
    }
}

#[test]
fn taubin() {
    for section in SECTIONS {
        run(UMB_CURVATURE_TAUBIN, |o, _| o.section = section, |o, v, _| o.taubin(v, section));
    }
}

#[test]
fn watanabe() {
    for section in SECTIONS {
        run(UMB_CURVATURE_WATANABE, |o, _| o.section = section, |o, v, _| o.watanabe(v, section));
    }
}

#[test]
fn meyer() {
    run(UMB_CURVATURE_MEYER, |_, _| (), |o, v, _| o.meyer(v));
}

#[test]
fn angle_defect() {
    run(UMB_CURVATURE_ANGLE_DEFECT, |_, _| (), |o, v, _| o.angle_defect(v));
}

#[test]
fn rusinkiewicz() {
    run(UMB_CURVATURE_RUSINKIEWICZ, |_, _| (), |o, v, _| o.rusinkiewicz(v));
}

/// One ring, two and three, and a ball of so many times the mean edge.
fn regions(run: impl Fn(&dyn Fn(&Mesh) -> Region)) {
    for rings in [1, 2, 3] {
        run(&|_| Region::Rings(rings));
    }
    for edges in [0.4, 2.5] {
        run(&|mesh| {
            let extents = extents(mesh);
            Region::Ball(edges * extents.iter().sum::<f64>() / extents.len() as f64)
        });
    }
}

fn set_region(options: &mut umb_curvature_options, region: Region) {
    match region {
        Region::Rings(rings) => options.rings = rings as u32,
        Region::Ball(radius) => options.radius = radius,
    }
}

#[test]
fn normal_cycle() {
    regions(|region| {
        let ask = |o: &CurvatureOracle<'_>, v: usize, mesh: &Mesh| o.normal_cycle(v, region(mesh));
        run(UMB_CURVATURE_NORMAL_CYCLE, |options, mesh| set_region(options, region(mesh)), ask);
    });
}

#[test]
fn corrected_measure() {
    regions(|region| {
        let ask = |o: &CurvatureOracle<'_>, v: usize, mesh: &Mesh| o.corrected_measure(v, region(mesh));
        run(UMB_CURVATURE_CORRECTED_MEASURE, |options, mesh| set_region(options, region(mesh)), ask);
    });
}

#[test]
fn quadric_and_goldfeather() {
    for rings in [1, 2] {
        for (method, slopes) in [(UMB_CURVATURE_QUADRIC, false), (UMB_CURVATURE_GOLDFEATHER, true)] {
            run(method, |options, _| options.rings = rings as u32, |o, v, _| o.quadric(v, rings, slopes));
        }
    }
}

#[test]
fn the_oracle_knows_a_sphere() {
    // Of the oracle itself: what it should say of a mesh of a sphere with exact normals.
    let mesh = mesh::quad_sphere(6, 0.5, 1).mapped(|p| scale(p, 2.0));
    let normals: Vec<Vector> = mesh.positions.iter().map(|&p| unit(p)).collect();
    let oracle = CurvatureOracle::new(&mesh, &normals);
    for vertex in 0..normals.len() {
        let exact = [
            oracle.rusinkiewicz(vertex).unwrap().k,
            oracle.least_squares(vertex, UMB_SECTION_CIRCLE).unwrap().k,
            [oracle.corrected_measure(vertex, Region::Rings(2)).unwrap().mean; 2],
            [oracle.watanabe(vertex, UMB_SECTION_CIRCLE).unwrap().mean; 2],
        ];
        assert!(exact.iter().flatten().all(|k| (k - 0.5).abs() < 1e-9), "{exact:?}");
    }
}
