//! Shape classes: the table of signs, exact limits, and surfaces whose class is known.

mod common;
use common::mesh;
use common::{Random, Vector};
use umbilic::{
    CurvatureOptions, CurvatureOutputs, Error, Faces, Method, Points, Run, SHAPE_TOLERANCE, Scalars, ShapeClass,
    StatusOutput, Topology, curvatures, shape_classes, shape_tolerance, status,
};

use ShapeClass::*;

fn classes(k1: &[f64], k2: &[f64], tolerance: f64) -> Vec<u8> {
    let mut classes = vec![255; k1.len()];
    shape_classes(&k1.into(), &k2.into(), None, tolerance, Run::default(), &classes.as_mut_slice().into()).unwrap();
    classes
}

#[test]
fn the_table() {
    for (k1, k2, class) in [
        (2.0, 1.5, Peak),
        (2.0, 0.25, Ridge),
        (2.5, 0.0, Ridge),
        (4.0, -1.5, SaddleRidge),
        (0.5, 0.0, Flat),
        (1.0, -0.5, Flat),
        (2.0, -1.0, Minimal),
        (-1.5, -2.0, Pit),
        (0.0, -2.5, Valley),
        (1.5, -4.0, SaddleValley),
        (f64::NAN, 1.0, Undefined),
        (f64::INFINITY, 1.0, Undefined),
    ] {
        assert_eq!(ShapeClass::of(k1, k2, 1.0), class, "{k1} {k2}");
        assert_eq!(ShapeClass::of(k2, k1, 1.0), class, "{k2} {k1}");
    }
    for (number, class) in ShapeClass::ALL.into_iter().enumerate() {
        assert_eq!(class as usize, number);
        assert!(ShapeClass::ALL[..number].iter().all(|other| other.name() != class.name()));
    }
    assert_eq!(ShapeClass::default() as u8, 0);
}

/// The class of `k1 = a`, `k2 = b` and a tolerance of `t`, all multiplied by the same power of two, in integers.
fn exact(a: i64, b: i64, t: i64) -> ShapeClass {
    let (sum, product) = (a as i128 + b as i128, a as i128 * b as i128);
    let h = if sum.abs() > 2 * t as i128 { sum.signum() } else { 0 };
    let k = if product.abs() > t as i128 * t as i128 { product.signum() } else { 0 };
    match (h, k) {
        (1, 1) => Peak,
        (1, 0) => Ridge,
        (1, -1) => SaddleRidge,
        (0, 0) => Flat,
        (0, -1) => Minimal,
        (-1, 1) => Pit,
        (-1, 0) => Valley,
        (-1, -1) => SaddleValley,
        _ => unreachable!("K is at most H squared"),
    }
}

#[test]
fn limits_are_exact_at_every_scale() {
    let mut random = Random::new(1);
    let mut seen = [0; 9];
    for round in 0..200_000 {
        let bits = 1 + random.below(52) as u32;
        let t = (random.bits() >> 12 >> (52 - bits)) as i64 + 1;
        let near = |random: &mut Random| random.below(5) as i64 - 2;
        let (a, b) = match round % 5 {
            // Near `H = t`.
            0 => {
                let a = (random.unit() * 2.0 * t as f64) as i64;
                (a, 2 * t - a + near(&mut random))
            }
            // Near `|K| = t²`, also where the product of two numbers of half the length differs by 1.
            1 => (t + near(&mut random), t + near(&mut random)),
            2 => {
                let factor = 1i64 << random.below(8);
                (t / factor + near(&mut random), t * factor.min(1 << (53 - bits.min(52))) + near(&mut random))
            }
            // The sum is rounded.
            3 => (near(&mut random), 2 * t + near(&mut random)),
            _ => (random.signed() as i64, (4.0 * t as f64 * random.signed()) as i64),
        };
        let sign = |random: &mut Random| if random.unit() < 0.3 { -1 } else { 1 };
        let (a, b) = (a * sign(&mut random), b * sign(&mut random));
        if [a, b].iter().any(|x| x.abs() > 1 << 53) {
            continue;
        }
        let class = exact(a, b, t);
        seen[class as usize] += 1;
        // Products leave the range on both sides; the last numbers are subnormal.
        for exponent in [0, 900, -900, 970, -1074] {
            let scale = |x: i64| x as f64 * 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2);
            assert_eq!(ShapeClass::of(scale(a), scale(b), scale(t)), class, "{a} {b} {t} {exponent}");
        }
    }
    assert!(seen[1..].iter().all(|&count| count > 500), "{seen:?}");
    assert_eq!(ShapeClass::of(f64::MAX, f64::MAX, f64::MAX), Flat);
    assert_eq!(ShapeClass::of(f64::MAX, f64::MAX, f64::MAX.next_down()), Peak);
    assert_eq!(ShapeClass::of(f64::MAX, -f64::MAX, 5e-324), Minimal);
    assert_eq!(ShapeClass::of(5e-324, 5e-324, 0.0), Peak);
    assert_eq!(ShapeClass::of(0.0, -0.0, 0.0), Flat);
}

/// Least squares on a mesh.
fn principal(mesh: &mesh::Mesh) -> [Vec<f64>; 2] {
    let count = mesh.positions.len();
    let topology = Topology::new(&Faces::polygons(&mesh.indices, &mesh.offsets).unwrap(), count).unwrap();
    let (mut k1, mut k2) = (vec![0.0; count], vec![0.0; count]);
    let outputs = CurvatureOutputs {
        k1: Some(k1.as_mut_slice().into()),
        k2: Some(k2.as_mut_slice().into()),
        ..Default::default()
    };
    let options = CurvatureOptions { method: Method::LeastSquares, ..Default::default() };
    curvatures(&topology, &Points::from(&mesh.positions), &options, Run::default(), &outputs).unwrap();
    [k1, k2]
}

#[test]
fn surfaces() {
    let of = |mesh: &mesh::Mesh| {
        let [k1, k2] = principal(mesh);
        classes(&k1, &k2, shape_tolerance(&Points::from(&mesh.positions)).unwrap())
    };
    let sphere = mesh::ring_sphere(40, 20);
    assert!(of(&sphere).iter().all(|&class| class == Peak as u8));
    assert!(of(&sphere.reversed()).iter().all(|&class| class == Pit as u8));
    // The size of the mesh does not matter.
    assert_eq!(of(&sphere.mapped(|p| p.map(|x| x * 1e-30))), of(&sphere));
    let torus = mesh::torus(60, 40, 0.0, 0.0, 1);
    for (position, class) in torus.positions.iter().zip(of(&torus)) {
        let [x, y, _]: Vector = *position;
        let cosine = (x.hypot(y) - 1.0) / 0.4;
        if cosine > 0.5 {
            assert_eq!(class, Peak as u8);
        }
        if cosine < -0.5 {
            assert!(class == SaddleRidge as u8 || class == Minimal as u8);
        }
    }
}

#[test]
fn tolerances_go_with_the_size() {
    for scale in [1.0, 1e-300, 1e300] {
        let corners = [[0.0, 0.0, 0.0], [3.0 * scale, 0.0, 4.0 * scale], [1.0 * scale, 0.0, 2.0 * scale]];
        let found = shape_tolerance(&Points::from(&corners[..])).unwrap();
        assert!((found * 5.0 * scale / SHAPE_TOLERANCE - 1.0).abs() < 1e-15);
    }
    let widest = [[-f64::MAX; 3], [f64::MAX; 3]];
    assert!(shape_tolerance(&Points::from(&widest[..])).unwrap() > 0.0);
    let thinnest = [[0.0; 3], [5e-324, 0.0, 0.0]];
    assert_eq!(shape_tolerance(&Points::from(&thinnest[..])).unwrap(), f64::MAX);
    let nowhere: [[f64; 3]; 0] = [];
    assert_eq!(shape_tolerance(&Points::from(&nowhere[..])).unwrap(), 0.0);
    assert_eq!(shape_tolerance(&Points::from(&[[1.0f32; 3]; 2][..])).unwrap(), 0.0);
    let broken = [[0.0; 3], [f64::NAN; 3]];
    assert_eq!(shape_tolerance(&Points::from(&broken[..])), Err(Error::NonFinitePosition { vertex: 1 }));
}

#[test]
fn views_statuses_and_threads() {
    let mut random = Random::new(5);
    let count = 100_000;
    let drawn: Vec<[f32; 2]> = (0..count).map(|_| [0, 1].map(|_| random.below(9) as f32 - 4.0)).collect();
    let k = [0, 1].map(|column| drawn.iter().map(|row| row[column] as f64).collect::<Vec<_>>());
    let expected = classes(&k[0], &k[1], 1.0);
    for threads in [1, 2, 3, 8, 0] {
        let mut found = vec![[255u8; 3]; count];
        // SAFETY: columns of arrays that live on and are as long.
        let (k1, k2, output) = unsafe {
            let data = drawn.as_ptr().cast::<f32>();
            let output = StatusOutput::from_raw(found.as_mut_ptr().cast::<u8>().add(1), count, 3).unwrap();
            (
                Scalars::from_raw_f32(data, count, 8).unwrap(),
                Scalars::from_raw_f32(data.add(1), count, 8).unwrap(),
                output,
            )
        };
        shape_classes(&k1, &k2, None, 1.0, Run { threads, ..Run::default() }, &output).unwrap();
        assert!(found.iter().zip(&expected).all(|(found, &class)| *found == [255, class, 255]));
    }
    let bits: Vec<u8> =
        (0..count).map(|v| [0, status::ISOLATED, status::DEGENERATE, status::BOUNDARY][v % 4]).collect();
    let mut found = vec![255; count];
    let output = found.as_mut_slice().into();
    shape_classes(&(&k[0]).into(), &(&k[1]).into(), Some(&(&bits).into()), 1.0, Run::default(), &output).unwrap();
    for v in 0..count {
        assert_eq!(found[v], if v % 4 == 1 || v % 4 == 2 { Undefined as u8 } else { expected[v] });
    }
}

#[test]
fn what_is_refused() {
    let [one, two, mut broken] = [vec![1.0; 5], vec![1.0; 4], vec![1.0; 5]];
    broken[3] = f64::NEG_INFINITY;
    let mut classes = [0u8; 5];
    let mut refused = |k1: &[f64], k2: &[f64], status: Option<&[u8]>, tolerance, count: usize| {
        let output = classes[..count].as_mut().into();
        shape_classes(&k1.into(), &k2.into(), status.map(Into::into).as_ref(), tolerance, Run::default(), &output)
            .unwrap_err()
    };
    for tolerance in [-1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(refused(&one, &one, None, tolerance, 5), Error::OptionOutOfRange { what: "tolerance" });
    }
    assert_eq!(refused(&one, &two, None, 0.0, 5), Error::Size { what: "k2", found: 4, expected: 5 });
    assert_eq!(
        refused(&one, &one, Some(&[0; 4]), 0.0, 5),
        Error::Size { what: "status.count", found: 4, expected: 5 }
    );
    assert_eq!(refused(&one, &one, None, 0.0, 4), Error::Size { what: "classes.count", found: 4, expected: 5 });
    assert_eq!(refused(&one, &broken, None, 0.0, 5), Error::NonFiniteScalar { what: "k2", index: 3 });
    assert_eq!(refused(&broken, &one, None, 0.0, 5).element(), Some(3));
    let mut progress = |_| false;
    let run = Run { progress: Some(&mut progress), ..Run::default() };
    let output = classes.as_mut_slice().into();
    assert_eq!(shape_classes(&(&one).into(), &(&one).into(), None, 0.0, run, &output), Err(Error::Cancelled));
}
