//! Curvatures of hostile input: nothing is NaN or infinite, statuses say what happened, what is wrong is refused with the
//! element and nothing written, and no shape costs more than its size.
// Every call keeps the contract that the header states; where a test breaks it on purpose, that is the test.
#![allow(clippy::undocumented_unsafe_blocks)]

mod common;
use common::capi::{Handle, message, points, zeroed};
use common::curvature::*;
use common::linear::{faces_of, neighbourhood};
use common::mesh::{self, Mesh};
use common::{Random, Vector, length, scale};
use std::ffi::{c_int, c_void};
use std::time::{Duration, Instant};
use umbilic::capi::*;

/// Every method with its defaults, and the regions and sections that there are besides.
fn calls() -> Vec<umb_curvature_options> {
    let mut calls: Vec<umb_curvature_options> = METHODS.into_iter().map(options).collect();
    for method in [UMB_CURVATURE_NORMAL_CYCLE, UMB_CURVATURE_CORRECTED_MEASURE] {
        calls.push(umb_curvature_options { rings: 8, ..options(method) });
        for radius in [0.5, 1e-310, 1e-100, 1e100, f64::MAX] {
            calls.push(umb_curvature_options { radius, ..options(method) });
        }
    }
    for method in [UMB_CURVATURE_LEAST_SQUARES, UMB_CURVATURE_TAUBIN, UMB_CURVATURE_WATANABE] {
        calls.push(umb_curvature_options { section: UMB_SECTION_CIRCLE, ..options(method) });
    }
    calls.push(umb_curvature_options { degree: 4, rings: 8, ..options(UMB_CURVATURE_JET) });
    calls.push(umb_curvature_options { degree: 2, rings: 1, ..options(UMB_CURVATURE_JET) });
    calls.push(umb_curvature_options { rings: 8, ..options(UMB_CURVATURE_GOLDFEATHER) });
    calls.push(umb_curvature_options { weight: UMB_WEIGHT_JET, ..options(UMB_CURVATURE_CORRECTED_MEASURE) });
    calls
}

/// Everything is finite; zero where the status says that there is nothing, and as it should be elsewhere.
fn check(mesh: &Mesh, options: &umb_curvature_options) -> Found {
    let found = curvatures(&Handle::new(mesh), &mesh.positions, options);
    let degenerate = UMB_VERTEX_DEGENERATE | UMB_VERTEX_ISOLATED;
    let fits = options.method <= UMB_CURVATURE_GOLDFEATHER;
    for vertex in 0..mesh.positions.len() {
        let status = found.status[vertex];
        let what = format!("{}, method {}, vertex {vertex}, status {status}", mesh.name, options.method);
        for output in OUTPUTS.into_iter().filter(|&output| found.has(output)) {
            let n = output.components();
            let values = &found.all(output)[n * vertex..n * vertex + n];
            assert!(values.iter().all(|x| x.is_finite()), "{what}, {output:?}: {values:?}");
            if status & degenerate != 0 && (output != Normal || status & UMB_VERTEX_ISOLATED != 0) {
                assert!(values.iter().all(|x| *x == 0.0), "{what}, {output:?}: {values:?}");
            }
        }
        assert!(fits || status & UMB_VERTEX_WIDENED == 0, "{what}");
        if status & degenerate == 0 {
            if options.method != UMB_CURVATURE_ANGLE_DEFECT {
                assert!((length(found.vector(Normal, vertex)) - 1.0).abs() < 1e-15 * 8.0, "{what}");
            }
            if found.has(Direction1) {
                assert!((length(found.vector(Direction1, vertex)) - 1.0).abs() < 1e-14, "{what}");
            }
            if found.has(K1) {
                assert!(found.at(K1, vertex) >= found.at(K2, vertex), "{what}");
                assert!(found.at(ShapeIndex, vertex).abs() <= 1.0, "{what}");
            }
        }
    }
    found
}

/// Meshes with all defects, and some of them crushed, torn apart and huge.
fn hostile() -> Vec<Mesh> {
    let mut meshes =
        vec![mesh::letter_prism(), mesh::fan(3, true, 1), mesh::fan(1, false, 2), mesh::fan(300, true, 3)];
    for seed in 0..10 {
        meshes.push(mesh::soup(25, 40, 3, seed));
        meshes.push(mesh::soup(25, 30, 7, 50 + seed));
        meshes.push(mesh::soup(5, 30, 3, 90 + seed));
    }
    let mut random = Random::new(4);
    for index in 0..meshes.len() {
        let mesh = &meshes[index];
        let mut changed = match index % 6 {
            0 => mesh.mapped(|p| p.map(|x| (2.0 * x).round())),
            1 => mesh.mapped(|[x, y, _]| [x, y, 0.0]),
            2 => mesh.mapped(|[x, _, _]| [x, 2.0 * x, 0.0]),
            3 => mesh.mapped(|_| [7.0; 3]),
            4 => mesh.mapped(|p| scale(p, 1e308)),
            _ => mesh.mapped(|p| scale(p, 1e-320)),
        };
        changed.name += [", rounded", ", flat", ", line", ", point", ", huge", ", subnormal"][index % 6];
        meshes.push(changed);
        let mut torn = meshes[index].clone();
        torn.positions.iter_mut().for_each(|p| *p = scale(*p, 10f64.powf(150.0 * random.signed())));
        torn.name += ", torn";
        meshes.push(torn);
    }
    meshes
}

#[test]
fn whatever_the_mesh_all_is_finite() {
    let mut seen = 0;
    for mesh in hostile() {
        for options in calls() {
            seen |= check(&mesh, &options).status.iter().fold(0, |seen, status| seen | status);
        }
    }
    assert_eq!(seen, 255, "not every status came up: {seen}");
}

#[test]
fn whatever_the_normals_all_is_finite() {
    let mut random = Random::new(5);
    for mesh in hostile().into_iter().chain([mesh::torus(12, 9, 0.3, 0.4, 1)]) {
        let sizes = [1.0, 1e300, 1e-300, 5e-324, 0.0];
        let normals: Vec<Vector> =
            (0..mesh.positions.len()).map(|vertex| [(); 3].map(|()| sizes[vertex % 5] * random.signed())).collect();
        for mut options in calls() {
            options.normals = points(&normals);
            let found = check(&mesh, &options);
            for (vertex, normal) in normals.iter().enumerate() {
                if length(*normal) == 0.0
                    && normal.iter().all(|x| *x == 0.0)
                    && ![UMB_CURVATURE_ANGLE_DEFECT, UMB_CURVATURE_ADAPTIVE_JET].contains(&options.method)
                {
                    assert!(!found.known(vertex), "{}, method {}, {vertex}", mesh.name, options.method);
                }
            }
        }
    }
}

#[test]
fn statuses_where_nothing_is() {
    // A lone vertex; a face without area; a lone triangle, on which no quadric can stand.
    let positions =
        vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [5.0; 3], [0.0, 0.0, 9.0], [1.0, 0.0, 9.0], [0.0, 1.0, 9.0]];
    let mesh = Mesh::new("little", positions, vec![vec![0, 1, 2], vec![4, 5, 6]]);
    for options in calls() {
        let found = check(&mesh, &options);
        let (method, fit) = (options.method, options.method <= UMB_CURVATURE_GOLDFEATHER);
        assert_eq!(found.status[3], UMB_VERTEX_ISOLATED);
        // The angles of a face without area are still angles.
        let flat = if method == UMB_CURVATURE_ANGLE_DEFECT { UMB_VERTEX_FALLBACK } else { UMB_VERTEX_DEGENERATE };
        assert!(found.status[..3].iter().all(|status| status & flat != 0), "method {method}: {:?}", found.status);
        for vertex in 4..7 {
            let status = found.status[vertex];
            assert_eq!(status & (UMB_VERTEX_DEGENERATE | UMB_VERTEX_ISOLATED), 0, "method {method}: {status}");
            // Goldfeather's slopes say more than heights alone.
            // And an adaptive jet's prior decides what points do not.
            let simpler = (fit && ![UMB_CURVATURE_GOLDFEATHER, UMB_CURVATURE_ADAPTIVE_JET].contains(&method))
                || method == UMB_CURVATURE_LEAST_SQUARES;
            assert!(!simpler || status & UMB_VERTEX_FALLBACK != 0, "method {method}: {status}");
        }
    }
}

/// Calls with everything wanted that the method has, and expects a refusal that writes nothing.
fn refuses(mesh: &Mesh, set: impl Fn(&mut umb_curvature_options), status: umb_status, element: u64) {
    refuses_with(mesh, |output, method| output.is_of(method), set, status, element);
}

fn refuses_with(
    mesh: &Mesh,
    wanted: impl Fn(Out, umb_curvature_method) -> bool,
    set: impl Fn(&mut umb_curvature_options),
    status: umb_status,
    element: u64,
) {
    let mut options = options(UMB_CURVATURE_JET);
    set(&mut options);
    let method = options.method;
    let (found, result) =
        call(&Handle::new(mesh), &points(&mesh.positions), &options, |output| wanted(output, method), 7.25);
    let (got, at, text) = result.expect_err("refused");
    assert_eq!((got, at), (status, element), "method {method}: {text}");
    assert!(!text.is_empty());
    assert!(found.values.iter().flatten().all(|x| *x == 7.25) && found.status.iter().all(|x| *x == 0xa5));
}

#[test]
fn outputs_that_a_method_does_not_have_are_refused() {
    let mesh = mesh::torus(9, 7, 0.2, 0.3, 1);
    let handle = Handle::new(&mesh);
    for method in METHODS {
        for asked in OUTPUTS {
            if asked.is_of(method) {
                let (_, result) = call(&handle, &points(&mesh.positions), &options(method), |o| o == asked, 0.0);
                assert_eq!(result, Ok(()), "{asked:?} of {method}");
            } else {
                let set = |options: &mut umb_curvature_options| options.method = method;
                let (status, none) = (UMB_ERROR_NOT_APPLICABLE, UMB_NO_ELEMENT);
                refuses_with(&mesh, |output, _| output == asked, set, status, none);
                refuses_with(&mesh, |output, of| output == asked || output.is_of(of), set, status, none);
            }
        }
    }
}

#[test]
fn options_out_of_range_and_out_of_place_are_refused() {
    let mesh = mesh::torus(9, 7, 0.2, 0.3, 1);
    let (range, place, unknown) =
        (UMB_ERROR_OPTION_OUT_OF_RANGE, UMB_ERROR_NOT_APPLICABLE, UMB_ERROR_UNKNOWN_CONSTANT);
    let none = UMB_NO_ELEMENT;
    for method in METHODS {
        let fit = method <= UMB_CURVATURE_GOLDFEATHER;
        let measure = [UMB_CURVATURE_NORMAL_CYCLE, UMB_CURVATURE_CORRECTED_MEASURE].contains(&method);
        for rings in [9, 12, 255, 256, u32::MAX] {
            refuses(&mesh, |o| (o.method, o.rings) = (method, rings), range, none);
        }
        if !fit && !measure {
            refuses(&mesh, |o| (o.method, o.rings) = (method, 2), place, none);
            check(&mesh, &umb_curvature_options { rings: 1, ..options(method) });
        }
        for radius in [-1.0, f64::NAN, f64::INFINITY, -f64::MIN_POSITIVE] {
            refuses(&mesh, |o| (o.method, o.radius) = (method, radius), range, none);
        }
        if measure {
            refuses(&mesh, |o| (o.method, o.radius, o.rings) = (method, 0.1, 1), place, none);
        } else {
            refuses(&mesh, |o| (o.method, o.radius) = (method, 0.1), place, none);
        }
        if method == UMB_CURVATURE_JET {
            // A jet of degree 1 is a plane.
            for degree in [1, 5, 255, 256, u32::MAX] {
                refuses(&mesh, |o| o.degree = degree, range, none);
            }
        } else {
            refuses(&mesh, |o| (o.method, o.degree) = (method, 2), place, none);
        }
        refuses(&mesh, |o| (o.method, o.section) = (method, 4), unknown, 4);
        refuses(&mesh, |o| (o.method, o.weight) = (method, 13), unknown, 13);
    }
    refuses(&mesh, |o| o.method = 13, unknown, 13);
    refuses(&mesh, |o| o.struct_size = 4, UMB_ERROR_STRUCT_SIZE, none);
}

#[test]
fn what_is_not_a_number_is_refused_where_it_is_needed() {
    let clean = mesh::torus(40, 30, 0.2, 0.3, 1);
    let faces = faces_of(&clean);
    let count = clean.positions.len();
    let own = of_mesh(&clean, UMB_CURVATURE_TAUBIN, None, |_| ()).normals();
    let list = [17u32];
    let listed = |o: &mut umb_curvature_options| (o.run.vertices, o.run.vertex_count) = (list.as_ptr(), 1);
    // No method needs more than eight rings here, of which it may use fewer.
    let near = neighbourhood(&clean, &faces, 17, 8);
    let mut poisoned = clean.clone();
    let mut normals = own.clone();
    for v in (0..count).filter(|v| !near.contains(v)) {
        (poisoned.positions[v], normals[v]) = ([f64::NAN; 3], [f64::INFINITY; 3]);
    }
    for method in METHODS {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut mesh = clean.clone();
            mesh.positions[31][1] = bad;
            refuses(&mesh, |o| o.method = method, UMB_ERROR_NON_FINITE, 31);
            let mut normals = own.clone();
            normals[17][2] = bad;
            if ![UMB_CURVATURE_ANGLE_DEFECT, UMB_CURVATURE_ADAPTIVE_JET].contains(&method) {
                let set = |o: &mut umb_curvature_options| (o.method, o.normals) = (method, points(&normals));
                refuses(&clean, set, UMB_ERROR_NON_FINITE, 17);
            }
            let mut mesh = clean.clone();
            mesh.positions[17][0] = bad;
            refuses(&mesh, |o| (o.method, _) = (method, listed(o)), UMB_ERROR_NON_FINITE, 17);
        }
        // Adaptive jets learn from all positions, unless they are given a model: see adaptive_jet.rs.
        let mut regions = if method == UMB_CURVATURE_ADAPTIVE_JET { vec![] } else { vec![(0, 0.0)] };
        if [UMB_CURVATURE_NORMAL_CYCLE, UMB_CURVATURE_CORRECTED_MEASURE].contains(&method) {
            regions.extend([(3, 0.0), (0, 0.25)]);
        }
        for (rings, radius) in regions {
            for given in [false, true] {
                let ask = |mesh: &Mesh, normals: &[Vector]| {
                    of_mesh(mesh, method, given.then_some(normals), |o| {
                        listed(o);
                        (o.rings, o.radius) = (rings, radius);
                    })
                };
                assert_eq!(ask(&poisoned, &normals).bits(), ask(&clean, &own).bits(), "method {method}, {given}");
            }
        }
        let short = &own[1..];
        if method != UMB_CURVATURE_ADAPTIVE_JET {
            refuses(&clean, |o| (o.method, o.normals) = (method, points(short)), UMB_ERROR_SIZE, UMB_NO_ELEMENT);
        }
        let beyond = [3, count as u32];
        let set = |o: &mut umb_curvature_options| {
            o.method = method;
            (o.run.vertices, o.run.vertex_count) = (beyond.as_ptr(), 2);
        };
        refuses(&clean, set, UMB_ERROR_INDEX_OUT_OF_RANGE, 1);
    }
}

#[test]
fn sections_refuse_and_survive_likewise() {
    let mesh = mesh::torus(12, 9, 0.2, 0.3, 1);
    let (handle, count) = (Handle::new(&mesh), mesh.positions.len());
    let try_it = |directions: bool, set: &dyn Fn(&mut umb_section_options)| {
        let mut values = vec![7.25; 20 * count];
        let mut options: umb_section_options = zeroed();
        set(&mut options);
        let mut outputs: umb_section_outputs = zeroed();
        let data = values.as_mut_ptr().cast();
        outputs.curvature = umb_output { data, stride: 0, scalar: UMB_SCALAR_F64, reserved: 0 };
        let (call, mut error): (_, umb_error) =
            (if directions { umb_direction_sections } else { umb_edge_sections }, zeroed());
        let status = unsafe { call(handle.0, &points(&mesh.positions), &options, &outputs, &mut error) };
        assert!(status == UMB_OK || values.iter().all(|x| *x == 7.25) && !message(&error).is_empty());
        (status, error.element)
    };
    let mut bad = vec![[1.0, 0.0, 0.0]; count];
    assert_eq!(try_it(true, &|o| o.directions = points(&bad)).0, UMB_OK);
    bad[5][1] = f64::NAN;
    assert_eq!(try_it(true, &|o| o.directions = points(&bad)), (UMB_ERROR_NON_FINITE, 5));
    assert_eq!(try_it(true, &|o| (o.directions, o.shared) = (points(&bad[4..7]), 1)), (UMB_ERROR_NON_FINITE, 1));
    assert_eq!(try_it(true, &|o| (o.directions, o.shared) = (points(&bad[..3]), 2)).0, UMB_ERROR_UNKNOWN_CONSTANT);
    assert_eq!(try_it(true, &|o| o.directions = points(&bad[..3])).0, UMB_ERROR_SIZE);
    for directions in [false, true] {
        let good = vec![[1.0, 0.0, 0.0]; count];
        let set = |o: &mut umb_section_options| {
            if directions {
                o.directions = points(&good);
            }
        };
        let normals = |o: &mut umb_section_options| (set(o), o.normals = points(&bad)).1;
        assert_eq!(try_it(directions, &normals), (UMB_ERROR_NON_FINITE, 5));
        assert_eq!(try_it(directions, &|o| (set(o), o.section = 4).1), (UMB_ERROR_UNKNOWN_CONSTANT, 4));
    }
    assert_eq!(try_it(false, &|o| o.shared = 1).0, UMB_ERROR_NOT_APPLICABLE);
    assert_eq!(try_it(false, &|o| o.directions = points(&bad)).0, UMB_ERROR_NOT_APPLICABLE);
    let directions = [[0.0; 3], [1.0, 2.0, 3.0], [1e300, 0.0, 1e300], [5e-324, 0.0, 0.0], [0.0, 0.0, -1.0]];
    for mesh in hostile() {
        let handle = Handle::new(&mesh);
        for section in 0..4 {
            let edges = edge_sections(&handle, &mesh.positions, |o| o.section = section);
            let any = direction_sections(&handle, &mesh.positions, &directions, |o| o.section = section);
            for (curvature, status) in [edges, any].iter().flat_map(|s| s.curvature.iter().zip(&s.status)) {
                assert!(curvature.is_finite() && *status <= 2, "{}: {curvature} {status}", mesh.name);
                assert!(*status & UMB_SECTION_STATUS_NONE == 0 || *curvature == 0.0);
            }
        }
    }
}

#[test]
fn hubs_and_huge_polygons_take_no_longer_than_their_size() {
    const MANY: usize = 100_000;
    let hub = mesh::fan(MANY, true, 1);
    let ring = |z: f64| (0..MANY).map(move |i| (std::f64::consts::TAU * i as f64 / MANY as f64, z));
    let positions = ring(0.0).chain(ring(1.0)).map(|(angle, z)| [angle.cos(), angle.sin(), z]).collect();
    let (top, next) = (MANY as u32, |i: u32| (i + 1) % MANY as u32);
    let mut faces: Vec<Vec<u32>> = vec![(0..top).rev().collect(), (top..2 * top).collect()];
    faces.extend((0..top).map(|i| vec![i, next(i), top + next(i), top + i]));
    let drum = Mesh::new("drum", positions, faces);
    for mesh in [hub, drum] {
        let handle = Handle::new(&mesh);
        // Jets as normals have their own test of this.
        for mut options in calls().into_iter().filter(|options| options.weight != UMB_WEIGHT_JET) {
            // A ball around each of so many vertices that holds them all costs what the header says.
            options.radius = options.radius.min(1e-5);
            // Several rings are the same bounded work at every vertex; some will do, the hub among them.
            let some: Vec<u32> = (0..mesh.positions.len() as u32).step_by(100).collect();
            if options.method <= UMB_CURVATURE_GOLDFEATHER || options.rings > 1 {
                (options.run.vertices, options.run.vertex_count) = (some.as_ptr(), some.len());
            }
            let start = Instant::now();
            let found = curvatures(&handle, &mesh.positions, &options);
            assert!(found.values.iter().flatten().all(|x| x.is_finite()));
            let took = start.elapsed();
            let umb_curvature_options { method, rings, radius, .. } = options;
            assert!(took < Duration::from_secs(60), "{}, {method} {rings} {radius}: {took:?}", mesh.name);
        }
    }
}

#[test]
fn balls_of_any_size() {
    let mesh = mesh::torus(30, 20, 0.2, 0.3, 1);
    for method in [UMB_CURVATURE_NORMAL_CYCLE, UMB_CURVATURE_CORRECTED_MEASURE] {
        // Everything: the whole surface, at each vertex.
        let one = of_mesh(&mesh, method, None, |_| ());
        let whole: f64 = one.all(Area).iter().sum();
        for radius in [1e3, 1e200, f64::MAX] {
            let found = of_mesh(&mesh, method, None, |options| options.radius = radius);
            assert!(found.all(Area).iter().all(|area| (area - whole).abs() < 1e-11 * whole));
        }
        // Next to nothing: half of the vertex's own cell, and what reaches so far of the others.
        for radius in [1e-12, 1e-200, 5e-324] {
            let found = of_mesh(&mesh, method, None, |options| options.radius = radius);
            for vertex in 0..mesh.positions.len() {
                let (half, area) = (one.at(Area, vertex) / 2.0, found.at(Area, vertex));
                assert!(area >= half * (1.0 - 1e-9) && area < 1.5 * half, "{radius:e}, {vertex}: {area} {half}");
            }
        }
    }
}

struct Seen {
    last: f64,
    calls: usize,
    cancel_at: f64,
}

unsafe extern "C" fn progress(user: *mut c_void, fraction: f64) -> c_int {
    let seen = unsafe { &mut *user.cast::<Seen>() };
    assert!(fraction >= seen.last && fraction <= 1.0, "{fraction} after {}", seen.last);
    (seen.last, seen.calls) = (fraction, seen.calls + 1);
    (fraction >= seen.cancel_at) as c_int
}

#[test]
fn progress_runs_from_0_to_1_and_can_cancel() {
    let mesh = mesh::torus(120, 60, 0.2, 0.3, 1);
    let handle = Handle::new(&mesh);
    for mut options in calls() {
        options.radius = options.radius.min(0.1);
        for (cancel_at, expected) in [(2.0, UMB_OK), (0.0, UMB_ERROR_CANCELLED), (0.6, UMB_ERROR_CANCELLED)] {
            let mut seen = Seen { last: 0.0, calls: 0, cancel_at };
            options.run.progress = Some(progress);
            options.run.user = (&raw mut seen).cast();
            let (_, result) = call(&handle, &points(&mesh.positions), &options, |o| o.is_of(options.method), 0.0);
            assert_eq!(result.as_ref().err().map_or(UMB_OK, |error| error.0), expected, "method {}", options.method);
            let complete = seen.last == 1.0 && seen.calls > 1;
            assert!(expected != UMB_OK || complete, "method {}: {} {}", options.method, seen.last, seen.calls);
        }
    }
}
