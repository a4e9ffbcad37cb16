//! Curvatures of polylines through the C interface: the paper's table and figures, an oracle in plain words, exact
//! integers, invariance, degenerate input, memory layouts, bad input.
// Every call keeps the contract that the header states; where a test breaks it on purpose, that is the test.
#![allow(clippy::undocumented_unsafe_blocks)]

mod common;
use common::capi::{message, zeroed};
use common::{Random, Vector, add, cross, dot, length, scale, sub, unit};
use std::f64::consts::TAU;
use umbilic::capi::*;

const C: usize = 0;
const P: usize = 1;
const PL: usize = 2;
const SP: usize = 3;

fn polyline<T, const N: usize>(points: &[[T; N]], closed: bool) -> umb_polyline {
    umb_polyline {
        data: points.as_ptr().cast(),
        count: points.len(),
        stride: 0,
        scalar: if size_of::<T>() == 4 { UMB_SCALAR_F32 } else { UMB_SCALAR_F64 },
        dimension: N as u32,
        closed: closed as u32,
        reserved: 0,
    }
}

fn scalars<T>(data: &mut [T]) -> umb_output {
    umb_output {
        data: data.as_mut_ptr().cast(),
        stride: 0,
        scalar: if size_of::<T>() == 4 { UMB_SCALAR_F32 } else { UMB_SCALAR_F64 },
        reserved: 0,
    }
}

#[derive(Clone, Debug, PartialEq)]
struct Found<T> {
    /// C, P, PL, SP.
    curvature: [Vec<T>; 4],
    status: Vec<u8>,
}

impl<T: Copy> Found<T> {
    fn at(&self, vertex: usize) -> [T; 4] {
        [C, P, PL, SP].map(|section| self.curvature[section][vertex])
    }
}

impl Found<f64> {
    fn bits(&self) -> Vec<u64> {
        self.curvature.iter().flatten().map(|x| x.to_bits()).collect()
    }
}

fn outputs_of<T>(found: &mut Found<T>) -> umb_polyline_outputs {
    let mut outputs: umb_polyline_outputs = zeroed();
    outputs.struct_size = size_of::<umb_polyline_outputs>() as u32;
    let [c, p, pl, sp] = &mut found.curvature;
    (outputs.circle, outputs.parabola) = (scalars(c), scalars(p));
    (outputs.length_parabola, outputs.symmetric_parabola) = (scalars(pl), scalars(sp));
    outputs.status = umb_status_output { data: found.status.as_mut_ptr(), stride: 0 };
    outputs
}

fn run<T: Default + Clone>(line: &umb_polyline, set: impl FnOnce(&mut umb_run)) -> Found<T> {
    let mut found =
        Found { curvature: [(); 4].map(|()| vec![T::default(); line.count]), status: vec![0; line.count] };
    let outputs = outputs_of(&mut found);
    let mut options: umb_polyline_options = zeroed();
    options.struct_size = size_of::<umb_polyline_options>() as u32;
    set(&mut options.run);
    let mut error: umb_error = zeroed();
    let status = unsafe { umb_polyline_curvatures(line, &options, &outputs, &mut error) };
    assert_eq!(status, UMB_OK, "{}", message(&error));
    found
}

fn open<const N: usize>(points: &[[f64; N]]) -> Found<f64> {
    run(&polyline(points, false), |_| ())
}

fn closed<const N: usize>(points: &[[f64; N]]) -> Found<f64> {
    run(&polyline(points, true), |_| ())
}

/// The curvatures at `b` of the polyline `a`, `b`, `c`.
fn corner<const N: usize>(a: [f64; N], b: [f64; N], c: [f64; N]) -> [f64; 4] {
    open(&[a, b, c]).at(1)
}

fn assert_close(found: f64, expected: f64, tolerance: f64, what: &str) {
    let allowed = tolerance * expected.abs();
    assert!((found - expected).abs() <= allowed, "{what}: {found:e}, expected {expected:e}");
}

fn circle_points(count: usize, radius: f64) -> Vec<[f64; 2]> {
    (0..count).map(|i| TAU * i as f64 / count as f64).map(|t| [radius * t.cos(), radius * t.sin()]).collect()
}

fn random_points(random: &mut Random, count: usize) -> Vec<Vector> {
    (0..count).map(|_| [(); 3].map(|()| random.signed())).collect()
}

// ---- the paper ----

/// Table 1 and figures 3 and 11.
#[test]
fn table_1_of_the_paper() {
    let rows =
        [(3, "4.00", "0.25"), (4, "2.00", "0.50"), (5, "1.53", "0.65"), (6, "1.33", "0.75"), (100, "1.00", "1.00")];
    for (count, curvature, radius) in rows {
        let found = closed(&circle_points(count, 1.0));
        for vertex in 0..count {
            let [c, p, pl, sp] = found.at(vertex);
            assert_close(c, 1.0, 1e-13, "a circle's own curvature, whatever the polygon");
            assert_eq!(format!("{p:.2}"), curvature, "n = {count}");
            // The paper prints 1/1.53 for n = 5.
            let printed: f64 = radius.parse().unwrap();
            assert!((1.0 / sp - printed).abs() < 0.0051, "n = {count}: {}", 1.0 / sp);
            let exact = 2.0 / (1.0 + (TAU / count as f64).cos());
            for parabola in [p, pl, sp] {
                assert_close(parabola, exact, 1e-12, "2 / (1 + cos(2 pi / n))");
            }
        }
        assert!(found.status.iter().all(|status| *status == 0));
    }
}

/// Figures 3 and 7: wherever the points lie on it, a circle has one κ_C.
#[test]
fn points_of_a_circle_have_its_curvature() {
    let mut random = Random::new(3);
    for _ in 0..2000 {
        let radius = 0.1 + 9.0 * random.unit();
        let mut angles = [(); 3].map(|()| TAU * random.unit());
        angles.sort_by(f64::total_cmp);
        let gap = |i: usize, j: usize| (angles[j] - angles[i]).abs().min(TAU - (angles[j] - angles[i]).abs());
        if gap(0, 1).min(gap(1, 2)).min(gap(0, 2)) < 0.05 {
            continue;
        }
        let [a, b, c] = angles.map(|t| [radius * t.cos(), radius * t.sin()]);
        let found = corner(a, b, c);
        assert_close(found[C], 1.0 / radius, 1e-11, "κ_C");
        let turned = corner(a.map(|x| -x), b.map(|x| -x), c.map(|x| -x));
        assert_close(turned[C], 1.0 / radius, 1e-11, "κ_C, turned by half");
    }
}

/// Figure 8, and the range in table 4.
#[test]
fn a_sharpening_corner_bounds_circles_and_nothing_else() {
    let mut last = [0.0; 4];
    for step in 1..60 {
        let half_angle = 1.5 * 0.6f64.powi(step);
        let (x, y) = half_angle.sin_cos();
        let found = corner([x, -y], [0.0, 0.0], [-x, -y]);
        assert!(found[C] <= 2.0 * (1.0 + 1e-15), "2 / |AB|");
        assert_close(found[C], 2.0 * half_angle.cos(), 1e-13, "κ_C");
        assert_close(found[SP], 2.0 * y / (x * x), 1e-13, "κ_SP");
        for section in [P, PL, SP] {
            assert!(found[section] > last[section] && found[section] >= found[C]);
        }
        last = found;
    }
    assert!(last[SP] > 1e24 && last[P] > 1e24);
    // Whatever the lengths.
    let mut random = Random::new(8);
    for _ in 0..5000 {
        let [a, c] = [(); 2].map(|()| [random.signed(), random.signed()]);
        let longest = a[0].hypot(a[1]).max(c[0].hypot(c[1]));
        assert!(corner(a, [0.0; 2], c)[C].abs() <= 2.0 / longest * (1.0 + 1e-15));
    }
}

/// Figure 9: two arcs of circles of the same radius. κ_C tells no sharp corner from a blunt one on the same circle;
/// κ_SP does.
#[test]
fn on_one_circle_only_parabolas_tell_sharp_from_blunt() {
    let at = |degrees: f64| [degrees.to_radians().cos(), degrees.to_radians().sin()];
    let sharp = corner(at(110.0), at(180.0), at(250.0));
    let blunt = corner(at(150.0), at(180.0), at(210.0));
    assert_close(sharp[C], blunt[C], 1e-13, "κ_C");
    for section in [P, PL, SP] {
        assert_close(sharp[section], 2.0 / (1.0 + 70f64.to_radians().cos()), 1e-13, "sharp");
        assert_close(blunt[section], 2.0 / (1.0 + 30f64.to_radians().cos()), 1e-13, "blunt");
    }
}

/// Figure 12: triangles of one base and height.
#[test]
fn leaning_triangles_have_one_p_and_growing_sp() {
    for height in [0.5, 1.0, 2.0] {
        let lean = |x: f64| corner([-1.0 - x, -height], [0.0, 0.0], [1.0 - x, -height]).map(f64::abs);
        let found = [0.0, 0.5, 1.0, 1.5, 2.0, 3.0].map(lean);
        for pair in found.windows(2) {
            assert_close(pair[1][P], pair[0][P], 1e-14, "κ_P");
            assert!(pair[1][SP] > pair[0][SP] * 1.05, "κ_SP");
            assert!(pair[1][PL] > pair[1][P], "κ_PL");
        }
        assert_close(found[0][P], 2.0 * height, 1e-15, "2 h / v²");
        assert_close(found[0][SP], 2.0 * height, 1e-15, "2 h / v²");
    }
}

#[test]
fn smooth_curves_are_approached_from_even_and_uneven_points() {
    // An ellipse with half axes 2 and 1, at its parameter t: κ = 2 / (4 sin² + cos²)^(3/2). Uneven points leave all
    // formulas at first order.
    let point = |t: f64| [2.0 * t.cos(), t.sin()];
    let exact = |t: f64| 2.0 / (4.0 * t.sin().powi(2) + t.cos().powi(2)).powf(1.5);
    for (uneven, order) in [(1.0, 3.5), (1.5, 1.8)] {
        let worst = |step: f64| {
            (0..50).map(|i| i as f64 * 0.126).fold([0.0f64; 4], |worst, t| {
                let found = corner(point(t - step), point(t), point(t + step * uneven));
                [C, P, PL, SP].map(|section| worst[section].max((found[section] - exact(t)).abs()))
            })
        };
        let (coarse, fine) = (worst(0.02), worst(0.01));
        for section in [C, PL, SP] {
            assert!(coarse[section] / fine[section] > order, "{section}: {coarse:?} {fine:?}");
        }
        // κ_P is right on even points only: 4 |a| |c| / (|a| + |c|)² of the curvature elsewhere.
        let limit = 4.0 * uneven / (1.0 + uneven) / (1.0 + uneven);
        for i in 0..50 {
            let t = i as f64 * 0.126;
            let found = corner(point(t - 1e-4), point(t), point(t + uneven * 1e-4));
            assert_close(found[P], limit * exact(t), 1e-3, "κ_P");
        }
    }
}

// ---- oracles ----

/// The formulas in the paper's words, in plain double precision.
fn oracle(a: Vector, b: Vector, c: Vector) -> [f64; 4] {
    // The quadratic through A at 0, B at t, C at 1, differentiated by central differences, which are exact for it.
    let quadratic = |t: f64| {
        let at = |s: f64| {
            let weights = [(s - t) * (s - 1.0) / t, s * (s - 1.0) / (t * (t - 1.0)), s * (s - t) / (1.0 - t)];
            add(add(scale(a, weights[0]), scale(b, weights[1])), scale(c, weights[2]))
        };
        const STEP: f64 = 0.125;
        let (before, here, after) = (at(t - STEP), at(t), at(t + STEP));
        let first = scale(sub(after, before), 0.5 / STEP);
        let second = scale(add(sub(after, here), sub(before, here)), 1.0 / (STEP * STEP));
        length(cross(first, second)) / length(first).powi(3)
    };
    let (x, y) = (sub(a, b), sub(c, b));
    // The centre of the circle lies at equal distances: b + u, u in the plane of both edges, u·x = x²/2, u·y = y²/2.
    let (xx, xy, yy) = (dot(x, x), dot(x, y), dot(y, y));
    let determinant = xx * yy - xy * xy;
    let (s, t) = ((xx * yy - yy * xy) / 2.0 / determinant, (yy * xx - xx * xy) / 2.0 / determinant);
    let radius = length(add(scale(x, s), scale(y, t)));
    let bisector = unit(add(unit(x), unit(y)));
    let height = |edge: Vector| dot(bisector, edge);
    let width = |edge: Vector| length(sub(edge, scale(bisector, height(edge))));
    let (h, v) = ((height(x) + height(y)) / 2.0, (width(x) + width(y)) / 2.0);
    let by_length = length(x) / (length(x) + length(y));
    [1.0 / radius, quadratic(0.5), quadratic(by_length), 2.0 * h / (v * v)]
}

#[test]
fn the_oracle_agrees_in_space_and_in_the_plane() {
    let mut random = Random::new(1);
    let mut compared = 0;
    for round in 0..40 {
        let mut points = random_points(&mut random, 50);
        if round % 2 == 1 {
            points.iter_mut().for_each(|point| point[2] = 0.0);
        }
        let count = points.len();
        let found = closed(&points);
        let plane: Vec<[f64; 2]> = points.iter().map(|p| [p[0], p[1]]).collect();
        let flat = closed(&plane);
        for vertex in 0..count {
            let [a, b, c] = [count - 1, 0, 1].map(|step| points[(vertex + step) % count]);
            let (x, y) = (sub(a, b), sub(c, b));
            let sine = length(cross(x, y)) / (length(x) * length(y));
            if sine < 0.05 || length(sub(a, c)) < 0.05 || length(x).min(length(y)) < 0.05 {
                continue;
            }
            compared += 1;
            let expected = oracle(a, b, c);
            let turn = -cross(x, y)[2].signum();
            for section in [C, P, PL, SP] {
                assert_close(found.at(vertex)[section], expected[section], 1e-9, "in space");
                if round % 2 == 1 {
                    assert_close(flat.at(vertex)[section], turn * expected[section], 1e-9, "in the plane");
                }
            }
        }
    }
    assert!(compared > 1000, "{compared}");
}

/// What exact integers say, corners nearly straight and as sharp as needles among them.
#[test]
fn exact_integers_agree_to_the_last_digits() {
    let mut random = Random::new(2);
    let mut number = |size: f64| (random.signed() * size) as i64;
    for round in 0..20_000 {
        let a = [number(1e9), number(1e9)];
        let near = [number(40.0), number(40.0)];
        let c = match round % 3 {
            0 => [a[0] + near[0], a[1] + near[1]],
            1 => [near[0] - a[0], near[1] - a[1]],
            _ => [number(1e9), number(1e9)],
        };
        let b = [number(1e9), number(1e9)];
        let wide = |v: [i64; 2]| v.map(i128::from);
        let (x, y) = (wide(a), wide(c));
        let turn = (x[1] * y[0] - x[0] * y[1]) as f64;
        let inner = (x[0] * y[0] + x[1] * y[1]) as f64;
        let squared = |v: [i128; 2]| (v[0] * v[0] + v[1] * v[1]) as f64;
        let (l, m, d) = (squared(x).sqrt(), squared(y).sqrt(), squared([y[0] - x[0], y[1] - x[1]]).sqrt());
        let double_cosine = 1.0 + (inner / (l * m)).abs();
        let sine = turn.abs() / (l * m);
        // sin² and cos² of the half angle, the smaller one by the sine.
        let (large, small) = (double_cosine / 2.0, sine * sine / (2.0 * double_cosine));
        let (s, c2) = if inner < 0.0 { (large, small) } else { (small, large) };
        let expected = [
            2.0 * sine / d,
            8.0 * turn.abs() / d / d / d,
            2.0 * (l + m) * (l + m) * sine / d / d / d,
            4.0 * c2.sqrt() / ((l + m) * s),
        ];
        let point = |v: [i64; 2]| [(v[0] + b[0]) as f64, (v[1] + b[1]) as f64];
        let found = corner(point(a), point([0, 0]), point(c));
        if turn == 0.0 {
            continue;
        }
        // Where neither the sum nor the chord is short, the cross product keeps what its angle leaves.
        let tolerance = if round % 3 == 2 { 1e-14 + 1e-15 / sine } else { 1e-14 };
        for section in [C, P, PL, SP] {
            let expected = expected[section] * turn.signum();
            assert_close(found[section], expected, tolerance, &format!("section {section}, round {round}"));
        }
    }
}

#[test]
fn needles_and_nearly_straight_corners_of_any_fineness() {
    for exponent in (1..300).step_by(7) {
        let fine = 2f64.powi(-exponent);
        let needle = corner([fine, -1.0], [0.0, 0.0], [-fine, -1.0]);
        assert_close(needle[C], 2.0 / (1.0 + fine * fine), 1e-15, "κ_C");
        for section in [P, PL, SP] {
            assert_close(needle[section], 2.0 / (fine * fine), 1e-14, "parabolas");
        }
        let flat = corner([1.0, -fine], [0.0, 0.0], [-1.0, -fine]);
        assert_close(flat[C], 2.0 * fine / (1.0 + fine * fine), 1e-15, "κ_C");
        for section in [P, PL, SP] {
            assert_close(flat[section], 2.0 * fine, 1e-14, "parabolas");
        }
    }
}

// ---- invariance ----

#[test]
fn moving_turning_and_reversing() {
    let mut random = Random::new(6);
    let points = random_points(&mut random, 200);
    let base = closed(&points);
    // Coordinates in eighths are moved exactly.
    let eighths: Vec<Vector> = points.iter().map(|p| p.map(|x| (x * 4096.0).round() / 8.0)).collect();
    let moved: Vec<Vector> = eighths.iter().map(|p| add(*p, [1e12, -3e11, 7e10])).collect();
    assert_eq!(closed(&eighths), closed(&moved));
    let axis = unit([1.0, 2.0, -0.5]);
    let (sine, cosine) = 0.7f64.sin_cos();
    let rotate = |p: Vector| {
        let along = scale(axis, dot(axis, p) * (1.0 - cosine));
        add(add(scale(p, cosine), scale(cross(axis, p), sine)), along)
    };
    let turned = closed(&points.iter().map(|p| rotate(*p)).collect::<Vec<_>>());
    for vertex in 0..points.len() {
        for section in [C, P, PL, SP] {
            assert_close(turned.at(vertex)[section], base.at(vertex)[section], 1e-11, "rotated");
        }
    }
    // Reversed: in space the same bits, in the plane the other sign.
    let reversed = |found: Found<f64>| Found {
        curvature: found.curvature.map(|values| values.into_iter().rev().collect::<Vec<_>>()),
        status: found.status.into_iter().rev().collect(),
    };
    let backwards: Vec<Vector> = points.iter().rev().copied().collect();
    assert_eq!(reversed(closed(&backwards)).bits(), base.bits());
    assert_eq!(reversed(open(&backwards)).bits(), open(&points).bits());
    for spread in [1.0, 1e-9] {
        // A regular polygon's edges are equally long, or nearly, which is where a rule could favour one of them.
        let mut plane = circle_points(64, 1.0);
        plane.iter_mut().for_each(|p| p[0] += spread * random.signed());
        plane.extend([[3.0, 4.0], [5.0, 0.0], [4.0, 3.0], [0.0, 5.0], [-3.0, 4.0]]);
        let backwards: Vec<[f64; 2]> = plane.iter().rev().copied().collect();
        let (forth, back) = (closed(&plane), reversed(closed(&backwards)));
        assert!(forth.curvature[C].iter().any(|k| *k > 0.0) && forth.curvature[C].iter().any(|k| *k < 0.0));
        for vertex in 0..plane.len() {
            assert_eq!(forth.at(vertex).map(f64::to_bits), back.at(vertex).map(|k| (-k).to_bits()));
        }
    }
}

#[test]
fn size_divides_exactly_and_extremes_are_computed() {
    let mut random = Random::new(7);
    let points = random_points(&mut random, 300);
    let base = closed(&points);
    for exponent in [-1000, -700, -3, 1, 400, 1000] {
        let size = 2f64.powi(exponent);
        let found = closed(&points.iter().map(|p| scale(*p, size)).collect::<Vec<_>>());
        for section in [C, P, PL, SP] {
            for (found, base) in found.curvature[section].iter().zip(&base.curvature[section]) {
                assert_eq!(*found, *base / size, "2^{exponent}");
            }
        }
    }
    for size in [1e-300, 1e300, 1e308, 1.7e308, 4e-308] {
        let found = closed(&circle_points(6, size));
        for vertex in 0..6 {
            assert_close(found.at(vertex)[C], 1.0 / size, 1e-11, "hexagon");
            assert_close(found.at(vertex)[SP], 4.0 / 3.0 / size, 1e-11, "hexagon");
        }
    }
    // Subnormal numbers have fewer digits; what exceeds the range is its end.
    let tiny = closed(&circle_points(4, 1e-310));
    assert!(tiny.curvature.iter().flatten().all(|k| *k == f64::MAX));
    // Differences that overflow, an edge far shorter than the other, and both at once.
    let far = corner([-1.7e308, 0.0], [1.7e308, 0.0], [-1.7e308, 5e-324]);
    assert!(far.iter().all(|k| k.is_finite()), "{far:?}");
    let square = closed(&[[-1.6e308, -1.6e308], [1.6e308, -1.6e308], [1.6e308, 1.6e308], [-1.6e308, 1.6e308]]);
    for k in square.curvature.iter().flatten() {
        assert!(*k > 3e-309 && *k < 1e-308, "{k:e}");
    }
    let uneven = corner([1e300, 0.0], [0.0, 0.0], [0.0, 1e-300]);
    // A right angle: κ_C = 2 / (hypotenuse), κ_SP = 4 √2 / (sum of the edges).
    assert_close(uneven[C].abs(), 2e-300, 1e-15, "κ_C");
    assert_close(uneven[SP].abs(), 32f64.sqrt() * 1e-300, 1e-14, "κ_SP");
    let acute = corner([1e150, 0.0], [0.0, 0.0], [1e-150, 1e-150]);
    assert_close(acute[C].abs(), 2f64.sqrt() * 1e-150, 1e-15, "κ_C");
}

#[test]
fn nothing_finite_gives_anything_else() {
    let special = [
        0.0,
        -0.0,
        5e-324,
        -1e-310,
        2.3e-308,
        1e-160,
        1e-150,
        1.0,
        -1.0,
        1.5,
        1e150,
        1e160,
        8e307,
        f64::MAX,
        f64::MIN,
    ];
    let mut random = Random::new(9);
    let points: Vec<Vector> = (0..60_000).map(|_| [(); 3].map(|()| special[random.below(special.len())])).collect();
    let plane: Vec<[f64; 2]> = points.iter().map(|p| [p[0], p[1]]).collect();
    for found in [closed(&points), open(&points), closed(&plane), open(&plane)] {
        assert!(found.curvature.iter().flatten().all(|k| k.is_finite()));
    }
    let found: Found<f32> = run(&polyline(&plane, true), |_| ());
    assert!(found.curvature.iter().flatten().all(|k| k.is_finite()));
    assert!(closed(&points).curvature.iter().flatten().all(|k| *k >= 0.0));
}

// ---- ends, cusps, coincident points ----

#[test]
fn ends_of_open_polylines() {
    for count in 0..3 {
        let points = &[[0.0, 0.0], [1.0, 2.0]][..count];
        let found = open(points);
        assert_eq!(found.status, vec![UMB_POLYLINE_END; count]);
        assert!(found.curvature.iter().flatten().all(|k| *k == 0.0));
    }
    let found = open(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
    assert_eq!(found.status, [UMB_POLYLINE_END, 0, UMB_POLYLINE_END]);
    assert!(found.at(1).iter().all(|k| *k > 0.0), "a left turn");
    assert!(corner([1.0, 1.0], [1.0, 0.0], [0.0, 0.0]).iter().all(|k| *k < 0.0), "a right turn");
    // Null data for no points.
    let mut line = polyline::<f64, 2>(&[], true);
    line.data = std::ptr::null();
    assert!(run::<f64>(&line, |_| ()).status.is_empty());
}

#[test]
fn straight_corners_are_exactly_zero() {
    let mut random = Random::new(10);
    for _ in 0..5000 {
        // Multiples of one vector, exact in double precision.
        let direction = [(); 3].map(|()| (random.signed() * 1e6).round() / 64.0);
        let [back, forth] = [(); 2].map(|()| 1.0 + (random.unit() * 1e5).round() / 8.0);
        let at = [(); 3].map(|()| (random.signed() * 1e6).round());
        let [a, c] = [-back, forth].map(|factor| add(at, scale(direction, factor)));
        let found = open(&[a, at, c]);
        assert_eq!(found.at(1).map(f64::to_bits), [0; 4]);
        assert_eq!(found.status[1], 0);
        // In the plane, 0 rather than -0 either way round.
        let plane = |p: Vector| [p[0], p[1]];
        assert_eq!(corner(plane(a), plane(at), plane(c)).map(f64::to_bits), [0; 4]);
        assert_eq!(corner(plane(c), plane(at), plane(a)).map(f64::to_bits), [0; 4]);
    }
}

#[test]
fn cusps_say_so() {
    // Back on the same way, to the same point, and beyond or short of it.
    for (c, expected) in [
        ([3.0, 4.0], [2.0 / 5.0, f64::MAX, f64::MAX, f64::MAX]),
        ([6.0, 8.0], [0.0, 0.0, 0.0, f64::MAX]),
        ([0.75, 1.0], [0.0, 0.0, 0.0, f64::MAX]),
        ([3e200, 4e200], [0.0, 0.0, 0.0, f64::MAX]),
    ] {
        for points in [[[3.0, 4.0], [0.0, 0.0], c], [c, [0.0, 0.0], [3.0, 4.0]]] {
            let found = open(&points);
            assert_eq!(found.status, [UMB_POLYLINE_END, UMB_POLYLINE_CUSP, UMB_POLYLINE_END]);
            assert_eq!(found.at(1), expected, "{c:?}");
            let single: Found<f32> = run(&polyline(&points, false), |_| ());
            assert_eq!(single.at(1)[SP], f32::MAX);
        }
    }
    let pair = closed(&[[0.0, 0.0, 0.0], [0.0, 0.5, 0.0]]);
    assert_eq!(pair.status, [UMB_POLYLINE_CUSP; 2]);
    assert_eq!(pair.at(0), [4.0, f64::MAX, f64::MAX, f64::MAX]);
    assert_eq!(pair.at(0), pair.at(1));
    // A hair's breadth beside a cusp there is none.
    let found = open(&[[3.0, 4.0], [0.0, 0.0], [3.0, 4.0 + 1e-15]]);
    assert_eq!(found.status[1], 0);
    assert!(found.at(1)[SP] < 1e33);
}

#[test]
fn coincident_points_are_passed_over() {
    // A square whose corners repeat, the first at the seam: each copy has the corner's curvature.
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let plain = closed(&square);
    let order = [0, 0, 1, 2, 2, 2, 3, 0];
    let found = closed(&order.map(|corner| square[corner]));
    let repeats = [true, true, false, true, true, true, false, true];
    for (place, corner) in order.into_iter().enumerate() {
        assert_eq!(found.at(place), plain.at(corner), "{place}");
        assert_eq!(found.status[place], if repeats[place] { UMB_POLYLINE_COINCIDENT } else { 0 });
    }
    // Zeros of both signs are one point.
    assert_eq!(closed(&[[0.0, 0.0], [-0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]).at(1), plain.at(0));
    // In an open polyline, all copies of an end are ends.
    let found = open(&order.map(|corner| square[corner]));
    let end = UMB_POLYLINE_END;
    let both = UMB_POLYLINE_END | UMB_POLYLINE_COINCIDENT;
    assert_eq!(found.status, [both, both, 0, 4, 4, 4, 0, end]);
    assert_eq!(found.at(4), plain.at(2));
    // Nothing but copies.
    for count in [1, 2, 5, 9000] {
        let points = vec![[2.0, 3.0, 4.0]; count];
        let found = closed(&points);
        assert!(found.status.iter().all(|status| *status == UMB_POLYLINE_COINCIDENT));
        assert!(found.curvature.iter().flatten().all(|k| *k == 0.0));
        let found = open(&points);
        let expected = if count == 1 { end } else { both };
        assert!(found.status.iter().all(|status| *status == expected));
        assert!(found.curvature.iter().flatten().all(|k| *k == 0.0));
    }
}

/// Runs of all lengths, across the chunks that threads take; the neighbours found one by one.
#[test]
fn long_runs_find_their_neighbours() {
    let mut random = Random::new(11);
    for longest in [3, 3000, 20_000] {
        let mut points: Vec<[f64; 2]> = vec![];
        while points.len() < 60_000 {
            let point = [random.signed(), random.signed()];
            points.extend(std::iter::repeat_n(point, 1 + random.below(longest)));
        }
        // The seam inside a run.
        let seam = random.below(points.len());
        points.rotate_left(seam);
        let count = points.len();
        for is_closed in [false, true] {
            let found: Found<f64> = run(&polyline(&points, is_closed), |run| run.threads = 3);
            for vertex in (0..count).step_by(if longest > 10 { 997 } else { 7 }) {
                let walk = |step: usize| {
                    let mut place = vertex;
                    for _ in 0..count {
                        if !is_closed && place == if step == 1 { count - 1 } else { 0 } {
                            return None;
                        }
                        place = (place + step) % count;
                        if points[place] != points[vertex] {
                            return Some(points[place]);
                        }
                    }
                    None
                };
                let expected = match (walk(count - 1), walk(1)) {
                    (Some(before), Some(after)) => corner(before, points[vertex], after),
                    _ => [0.0; 4],
                };
                assert_eq!(found.at(vertex), expected, "{vertex} of {count}, closed {is_closed}");
            }
        }
    }
}

#[test]
fn a_run_of_millions_takes_no_longer_than_other_points() {
    let count = 3_000_000;
    let mut points = vec![[1.0f32, 1.0]; count];
    points[0] = [0.0, 0.0];
    points[count - 1] = [2.0, 0.0];
    let start = std::time::Instant::now();
    let found: Found<f32> = run(&polyline(&points, false), |_| ());
    // Quadratic cost would be days; by chunks alone, minutes.
    assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
    for vertex in [1, 2, 4096, count / 2, count - 2] {
        assert_eq!(found.at(vertex), [-1.0, -2.0, -2.0, -2.0], "{vertex}");
    }
}

// ---- memory ----

#[test]
fn interleaved_and_mixed_arrays() {
    #[repr(C)]
    #[derive(Clone, Copy)]
    struct Vertex {
        guard: f32,
        point: [f32; 2],
        circle: f32,
        parabola: f32,
        status: u8,
        padding: [u8; 3],
        symmetric: f64,
    }
    let single: Vec<[f32; 2]> = circle_points(5000, 2.0).iter().map(|p| p.map(|x| x as f32)).collect();
    let double: Vec<[f64; 2]> = single.iter().map(|p| p.map(f64::from)).collect();
    let expected = open(&double);
    let mut buffer: Box<[Vertex]> = single
        .iter()
        .map(|&point| Vertex {
            guard: -7.5,
            point,
            circle: -7.5,
            parabola: -7.5,
            status: 99,
            padding: [0xee; 3],
            symmetric: -7.5,
        })
        .collect();
    let (count, stride, base) = (buffer.len(), size_of::<Vertex>(), buffer.as_mut_ptr());
    unsafe {
        let mut line = polyline(&single, false);
        line.data = (&raw const (*base).point).cast();
        line.stride = stride;
        let mut outputs: umb_polyline_outputs = zeroed();
        outputs.circle = umb_output { data: (&raw mut (*base).circle).cast(), stride, scalar: 0, reserved: 0 };
        outputs.symmetric_parabola =
            umb_output { data: (&raw mut (*base).symmetric).cast(), stride, scalar: UMB_SCALAR_F64, reserved: 0 };
        outputs.status = umb_status_output { data: &raw mut (*base).status, stride };
        assert_eq!(umb_polyline_curvatures(&line, std::ptr::null(), &outputs, std::ptr::null_mut()), UMB_OK);
    }
    for vertex in 0..count {
        let found = &buffer[vertex];
        assert_eq!(found.point, single[vertex]);
        assert_eq!(found.circle, expected.at(vertex)[C] as f32);
        assert_eq!(found.symmetric, expected.at(vertex)[SP]);
        assert_eq!(found.status, expected.status[vertex]);
        assert_eq!((found.guard, found.parabola, found.padding), (-7.5, -7.5, [0xee; 3]), "not asked for");
    }
    // All four scalar and dimension pairs, packed and padded, say the same.
    let space: Vec<[f64; 3]> = double.iter().map(|p| [p[0], p[1], 0.0]).collect();
    let space_single: Vec<[f32; 3]> = single.iter().map(|p| [p[0], p[1], 0.0]).collect();
    let padded: Vec<[f64; 5]> = space.iter().map(|p| [p[0], p[1], p[2], f64::NAN, f64::NAN]).collect();
    let mut padded_line = polyline(&padded, false);
    // 0 stands for three dimensions.
    (padded_line.stride, padded_line.dimension) = (40, 0);
    for line in [polyline(&single, false), polyline(&space, false), polyline(&space_single, false), padded_line] {
        assert_eq!(run::<f64>(&line, |_| ()), expected);
    }
}

#[test]
fn threads_and_vectors_change_no_bit() {
    let mut random = Random::new(12);
    let mut points = random_points(&mut random, 100_000);
    for _ in 0..1000 {
        let place = 1 + random.below(points.len() - 1);
        points[place] = points[place - 1];
    }
    for is_closed in [false, true] {
        let line = polyline(&points, is_closed);
        let base: Found<f64> = run(&line, |run| run.threads = 1);
        for (threads, simd) in
            [(1, UMB_SIMD_PORTABLE), (2, UMB_SIMD_SSE2), (3, UMB_SIMD_AVX2), (8, UMB_SIMD_AVX512), (0, 0)]
        {
            let found: Found<f64> = run(&line, |run| (run.threads, run.simd) = (threads, simd));
            assert_eq!(found.bits(), base.bits());
            assert_eq!(found.status, base.status);
        }
    }
}

// ---- refusals ----

#[test]
fn bad_input_is_refused_and_nothing_written() {
    let mut points = circle_points(9000, 1.0);
    fn refuses(
        points: &[[f64; 2]],
        status: umb_status,
        element: u64,
        change: impl FnOnce(&mut umb_polyline, &mut umb_polyline_options, &mut umb_polyline_outputs),
    ) {
        let mut line = polyline(points, true);
        let mut found =
            Found { curvature: [(); 4].map(|()| vec![42.0; points.len()]), status: vec![42; points.len()] };
        let mut outputs = outputs_of(&mut found);
        let mut options: umb_polyline_options = zeroed();
        options.struct_size = size_of::<umb_polyline_options>() as u32;
        change(&mut line, &mut options, &mut outputs);
        let mut error: umb_error = zeroed();
        let answer = unsafe { umb_polyline_curvatures(&line, &options, &outputs, &mut error) };
        assert_eq!((answer, error.status, error.element), (status, status, element), "{}", message(&error));
        assert!(!message(&error).is_empty());
        assert!(found.curvature.iter().flatten().all(|x| *x == 42.0), "written on status {status}");
        assert!(found.status.iter().all(|x| *x == 42), "written on status {status}");
    }
    let none = UMB_NO_ELEMENT;
    refuses(&points, UMB_ERROR_NULL_POINTER, none, |line, _, _| line.data = std::ptr::null());
    refuses(&points, UMB_ERROR_SIZE, none, |line, _, _| line.count = usize::MAX);
    refuses(&points, UMB_ERROR_STRIDE, none, |line, _, _| line.stride = 8);
    refuses(&points, UMB_ERROR_STRIDE, none, |line, _, _| line.stride = 20);
    refuses(&points, UMB_ERROR_STRIDE, none, |line, _, _| (line.stride, line.dimension) = (16, 3));
    refuses(&points, UMB_ERROR_MISALIGNED, none, |line, _, _| {
        line.data = line.data.cast::<u8>().wrapping_add(4).cast();
    });
    refuses(&points, UMB_ERROR_UNKNOWN_CONSTANT, 2, |line, _, _| line.scalar = 2);
    refuses(&points, UMB_ERROR_UNKNOWN_CONSTANT, 4, |line, _, _| line.dimension = 4);
    refuses(&points, UMB_ERROR_UNKNOWN_CONSTANT, 1, |line, _, _| line.dimension = 1);
    refuses(&points, UMB_ERROR_UNKNOWN_CONSTANT, 2, |line, _, _| line.closed = 2);
    refuses(&points, UMB_ERROR_UNKNOWN_FIELD, 36, |line, _, _| line.reserved = 1);
    refuses(&points, UMB_ERROR_UNKNOWN_FIELD, 4, |_, options, _| options.reserved = 1);
    refuses(&points, UMB_ERROR_STRUCT_SIZE, none, |_, options, _| options.struct_size = 4);
    refuses(&points, UMB_ERROR_UNKNOWN_CONSTANT, 5, |_, options, _| options.run.simd = 5);
    let vertices = [0u32];
    refuses(&points, UMB_ERROR_UNKNOWN_FIELD, 16, |_, options, _| {
        (options.run.vertices, options.run.vertex_count) = (vertices.as_ptr(), 1);
    });
    refuses(&points, UMB_ERROR_STRUCT_SIZE, none, |_, _, outputs| outputs.struct_size = 72);
    refuses(&points, UMB_ERROR_UNKNOWN_FIELD, 4, |_, _, outputs| outputs.reserved = 1);
    refuses(&points, UMB_ERROR_STRIDE, none, |_, _, outputs| outputs.length_parabola.stride = 4);
    refuses(&points, UMB_ERROR_UNKNOWN_CONSTANT, 9, |_, _, outputs| outputs.symmetric_parabola.scalar = 9);
    refuses(&points, UMB_ERROR_MISALIGNED, none, |_, _, outputs| {
        outputs.circle.data = outputs.circle.data.cast::<u8>().wrapping_add(2).cast();
    });
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (vertex, axis) in [(0, 1), (4097, 0), (8999, 1)] {
            let good = std::mem::replace(&mut points[vertex][axis], bad);
            refuses(&points, UMB_ERROR_NON_FINITE, vertex as u64, |_, _, _| ());
            points[vertex][axis] = good;
        }
    }
    let mut error: umb_error = zeroed();
    let (line, outputs) = (polyline(&points, false), zeroed());
    unsafe {
        let answer = umb_polyline_curvatures(std::ptr::null(), std::ptr::null(), &outputs, &mut error);
        assert_eq!((answer, message(&error).as_str()), (UMB_ERROR_NULL_POINTER, "polyline is null"));
        let answer = umb_polyline_curvatures(&line, std::ptr::null(), std::ptr::null(), &mut error);
        assert_eq!((answer, message(&error).as_str()), (UMB_ERROR_NULL_POINTER, "outputs is null"));
        assert_eq!(umb_polyline_curvatures(&line, std::ptr::null(), &outputs, std::ptr::null_mut()), UMB_OK);
    }
}

#[test]
fn progress_runs_upwards_and_cancels() {
    use std::ffi::{c_int, c_void};
    struct Seen {
        fractions: Vec<f64>,
        stop: bool,
    }
    unsafe extern "C" fn progress(user: *mut c_void, fraction: f64) -> c_int {
        let seen = unsafe { &mut *user.cast::<Seen>() };
        seen.fractions.push(fraction);
        seen.stop as c_int
    }
    let points = circle_points(50_000, 1.0);
    let (line, outputs): (_, umb_polyline_outputs) = (polyline(&points, true), zeroed());
    for (stop, status) in [(false, UMB_OK), (true, UMB_ERROR_CANCELLED)] {
        let mut seen = Seen { fractions: vec![], stop };
        let mut options: umb_polyline_options = zeroed();
        options.run.threads = 1;
        options.run.progress = Some(progress);
        options.run.user = (&raw mut seen).cast();
        assert_eq!(unsafe { umb_polyline_curvatures(&line, &options, &outputs, std::ptr::null_mut()) }, status);
        assert!(seen.fractions.is_sorted() && seen.fractions.len() > if stop { 0 } else { 10 });
        assert_eq!(*seen.fractions.last().unwrap() == 1.0, !stop);
    }
}
