//! Bad input through the C interface: each kind has its own status and names the offending element, and nothing is
//! written.
// Every call keeps the contract that the header states; where a test breaks it on purpose, that is the test.
#![allow(clippy::undocumented_unsafe_blocks)]

mod common;
use common::capi::{Handle, faces, message, output, points, zeroed};
use common::mesh::{Mesh, letter_prism, ring_sphere};
use std::ffi::c_void;
use umbilic::capi::*;

const UNTOUCHED: f64 = 42.0;

struct Case {
    mesh: Mesh,
    handle: Handle,
    normals: Vec<[f64; 3]>,
    status: Vec<u8>,
}

impl Case {
    fn new() -> Case {
        let mesh = ring_sphere(6, 4);
        let count = mesh.positions.len();
        let handle = Handle::new(&mesh);
        Case { mesh, handle, normals: vec![[UNTOUCHED; 3]; count], status: vec![0xa5; count] }
    }

    /// Calls `umb_vertex_normals` after `change`; checks status and element, and that nothing was written.
    fn refuses(
        &mut self,
        status: umb_status,
        element: u64,
        change: impl FnOnce(&mut umb_points, &mut umb_normal_options, &mut umb_normal_outputs),
    ) {
        let mut points = points(&self.mesh.positions);
        let mut options: umb_normal_options = zeroed();
        options.struct_size = size_of::<umb_normal_options>() as u32;
        let mut outputs: umb_normal_outputs = zeroed();
        outputs.struct_size = size_of::<umb_normal_outputs>() as u32;
        outputs.normal = output(&mut self.normals);
        outputs.status = umb_status_output { data: self.status.as_mut_ptr(), stride: 0 };
        change(&mut points, &mut options, &mut outputs);
        let mut error: umb_error = zeroed();
        let found = unsafe { umb_vertex_normals(self.handle.0, &points, &options, &outputs, &mut error) };
        assert_eq!(found, status, "{}", message(&error));
        assert_eq!(error.status, status);
        assert_eq!(error.element, element, "{}", message(&error));
        assert!(!message(&error).is_empty());
        assert!(self.normals.iter().flatten().all(|x| *x == UNTOUCHED), "written on status {status}");
        assert!(self.status.iter().all(|x| *x == 0xa5), "written on status {status}");
    }
}

#[test]
fn normals_refuse_what_cannot_be_right() {
    let mut case = Case::new();
    let none = UMB_NO_ELEMENT;
    case.refuses(UMB_ERROR_NULL_POINTER, none, |points, _, _| points.data = std::ptr::null());
    case.refuses(UMB_ERROR_SIZE, none, |points, _, _| points.count -= 1);
    case.refuses(UMB_ERROR_SIZE, none, |points, _, _| points.count = usize::MAX);
    case.refuses(UMB_ERROR_STRIDE, none, |points, _, _| points.stride = 16);
    case.refuses(UMB_ERROR_STRIDE, none, |points, _, _| points.stride = 28);
    case.refuses(UMB_ERROR_MISALIGNED, none, |points, _, _| {
        points.data = points.data.cast::<u8>().wrapping_add(4).cast();
    });
    case.refuses(UMB_ERROR_UNKNOWN_CONSTANT, 2, |points, _, _| points.scalar = 2);
    case.refuses(UMB_ERROR_UNKNOWN_FIELD, std::mem::offset_of!(umb_points, reserved) as u64, |points, _, _| {
        points.reserved = 1;
    });
    case.refuses(UMB_ERROR_UNKNOWN_CONSTANT, 13, |_, options, _| options.weight = 13);
    case.refuses(UMB_ERROR_UNKNOWN_CONSTANT, u32::MAX as u64, |_, options, _| options.weight = u32::MAX);
    case.refuses(UMB_ERROR_UNKNOWN_CONSTANT, 5, |_, options, _| options.run.simd = 5);
    case.refuses(UMB_ERROR_STRUCT_SIZE, none, |_, options, _| options.struct_size = 4);
    case.refuses(UMB_ERROR_STRUCT_SIZE, none, |_, options, _| options.struct_size = u32::MAX);
    case.refuses(UMB_ERROR_NULL_POINTER, none, |_, options, _| options.run.vertex_count = 1);
    case.refuses(UMB_ERROR_STRUCT_SIZE, none, |_, _, outputs| outputs.struct_size = 8);
    case.refuses(UMB_ERROR_UNKNOWN_FIELD, 4, |_, _, outputs| outputs.reserved = 7);
    case.refuses(UMB_ERROR_STRIDE, none, |_, _, outputs| outputs.normal.stride = 8);
    case.refuses(UMB_ERROR_MISALIGNED, none, |_, _, outputs| {
        outputs.normal.data = outputs.normal.data.cast::<u8>().wrapping_add(2).cast();
    });
    case.refuses(UMB_ERROR_UNKNOWN_CONSTANT, 9, |_, _, outputs| outputs.sum.scalar = 9);
    case.refuses(UMB_ERROR_SIZE, none, |_, _, outputs| outputs.normal.stride = usize::MAX & !7);

    let vertices = [3u32, 99];
    case.refuses(UMB_ERROR_INDEX_OUT_OF_RANGE, 1, |_, options, _| {
        options.run.vertices = vertices.as_ptr();
        options.run.vertex_count = 2;
    });
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for axis in 0..3 {
            for vertex in [0, 17, case.mesh.positions.len() - 1] {
                let good = std::mem::replace(&mut case.mesh.positions[vertex][axis], bad);
                case.refuses(UMB_ERROR_NON_FINITE, vertex as u64, |_, _, _| ());
                // A subset minds the positions that it needs, and no others.
                let (near, far) = (vertex as u32, if vertex < 14 { 25 } else { 0 });
                case.refuses(UMB_ERROR_NON_FINITE, vertex as u64, |_, options, _| {
                    options.run.vertices = &near;
                    options.run.vertex_count = 1;
                });
                let mut options: umb_normal_options = zeroed();
                options.run.vertices = &far;
                options.run.vertex_count = 1;
                let outputs: umb_normal_outputs = zeroed();
                let points = points(&case.mesh.positions);
                let status =
                    unsafe { umb_vertex_normals(case.handle.0, &points, &options, &outputs, std::ptr::null_mut()) };
                assert_eq!(status, UMB_OK, "vertex {far} does not need vertex {vertex}");
                case.mesh.positions[vertex][axis] = good;
            }
        }
    }
}

#[test]
fn null_arguments_are_refused_one_by_one() {
    let case = Case::new();
    let (handle, points) = (case.handle.0, points(&case.mesh.positions));
    let (mut error, outputs): (umb_error, umb_normal_outputs) = (zeroed(), zeroed());
    let options = std::ptr::null();
    unsafe {
        let null_handle = std::ptr::null();
        assert_eq!(umb_vertex_normals(null_handle, &points, options, &outputs, &mut error), UMB_ERROR_NULL_POINTER);
        assert_eq!(message(&error), "topology is null");
        let null_points = std::ptr::null();
        assert_eq!(umb_vertex_normals(handle, null_points, options, &outputs, &mut error), UMB_ERROR_NULL_POINTER);
        assert_eq!(message(&error), "points is null");
        let null_outputs = std::ptr::null();
        assert_eq!(umb_vertex_normals(handle, &points, options, null_outputs, &mut error), UMB_ERROR_NULL_POINTER);
        assert_eq!(message(&error), "outputs is null");
        // A null error is fine, and so is a call that wants nothing.
        assert_eq!(
            umb_vertex_normals(handle, null_points, options, &outputs, std::ptr::null_mut()),
            UMB_ERROR_NULL_POINTER
        );
        assert_eq!(umb_vertex_normals(handle, &points, options, &outputs, &mut error), UMB_OK);
        umb_topology_destroy(std::ptr::null_mut());
        assert_eq!(umb_topology_vertex_count(std::ptr::null()), 0);
        assert_eq!(umb_topology_face_count(std::ptr::null()), 0);
        assert!(umb_topology_flags(std::ptr::null()).is_null());
        let (mut valence, mut stats): (usize, umb_topology_stats) = (7, zeroed());
        assert_eq!(umb_topology_valence(handle, 99, &mut valence, &mut error), UMB_ERROR_INDEX_OUT_OF_RANGE);
        assert_eq!((valence, error.element), (7, 99));
        assert_eq!(message(&error), "there is no vertex 99: there are 26, counted from 0");
        let fan = std::ptr::null_mut();
        assert_eq!(umb_topology_fan(handle, 0, 4, fan, &mut error), UMB_ERROR_INDEX_OUT_OF_RANGE);
        assert_eq!(error.element, 4);
        assert_eq!(umb_topology_fan(handle, 0, 0, std::ptr::null_mut(), &mut error), UMB_ERROR_NULL_POINTER);
        stats.struct_size = 16;
        assert_eq!(umb_topology_get_stats(handle, &mut stats, &mut error), UMB_ERROR_STRUCT_SIZE);
        assert_eq!(umb_topology_get_stats(handle, std::ptr::null_mut(), &mut error), UMB_ERROR_NULL_POINTER);
    }
}

fn refuses_faces(mesh: &Mesh, status: umb_status, element: u64, change: impl FnOnce(&mut umb_faces)) {
    let mut faces = faces(mesh);
    change(&mut faces);
    let (mut handle, mut error): (*mut umb_topology, umb_error) = (0x10 as *mut _, zeroed());
    let found =
        unsafe { umb_topology_create(&faces, mesh.positions.len(), std::ptr::null(), &mut handle, &mut error) };
    assert_eq!(found, status, "{}", message(&error));
    assert_eq!(error.element, element, "{}", message(&error));
    assert_eq!(handle, 0x10 as *mut _, "the handle was written");
    // The calls without a handle see the same.
    let (points, mut normals) = (points(&mesh.positions), vec![[UNTOUCHED; 3]; 4096]);
    let mut options: umb_normal_options = zeroed();
    options.weight = UMB_WEIGHT_AREA;
    let mut outputs: umb_normal_outputs = zeroed();
    outputs.normal = output(&mut normals);
    let found = unsafe { umb_vertex_normals_from_faces(&faces, &points, &options, &outputs, &mut error) };
    assert_eq!((found, error.element), (status, element), "{}", message(&error));
    let mut outputs: umb_face_outputs = zeroed();
    outputs.normal = output(&mut normals);
    let found = unsafe { umb_face_normals(&faces, &points, std::ptr::null(), &outputs, &mut error) };
    assert_eq!((found, error.element), (status, element), "{}", message(&error));
    assert!(normals.iter().flatten().all(|x| *x == UNTOUCHED));
}

#[test]
fn faces_that_cannot_be_right_are_refused() {
    let triangles = ring_sphere(6, 4);
    let none = UMB_NO_ELEMENT;
    refuses_faces(&triangles, UMB_ERROR_NULL_POINTER, none, |faces| faces.indices = std::ptr::null());
    refuses_faces(&triangles, UMB_ERROR_SIZE, none, |faces| faces.index_count -= 1);
    refuses_faces(&triangles, UMB_ERROR_SIZE, none, |faces| faces.face_count -= 1);
    refuses_faces(&triangles, UMB_ERROR_SIZE, none, |faces| faces.arity = 2);
    refuses_faces(&triangles, UMB_ERROR_SIZE, none, |faces| faces.index_count = usize::MAX / 3 * 3);
    refuses_faces(&triangles, UMB_ERROR_UNKNOWN_CONSTANT, 3, |faces| faces.index = 3);
    refuses_faces(&triangles, UMB_ERROR_MISALIGNED, none, |faces| {
        faces.indices = faces.indices.cast::<u8>().wrapping_add(1).cast();
    });
    let count = triangles.positions.len() as u32;
    for (place, bad) in [(0, count), (71, u32::MAX), (triangles.indices.len() - 1, count + 5)] {
        let mut broken = triangles.clone();
        broken.indices[place] = bad;
        refuses_faces(&broken, UMB_ERROR_INDEX_OUT_OF_RANGE, place as u64, |_| ());
    }
    // A negative index of a signed array.
    let mut broken = triangles.clone();
    broken.indices[5] = -3i32 as u32;
    refuses_faces(&broken, UMB_ERROR_INDEX_OUT_OF_RANGE, 5, |faces| faces.index = UMB_INDEX_I32);

    let polygons = letter_prism();
    refuses_faces(&polygons, UMB_ERROR_SIZE, none, |faces| faces.arity = 3);
    refuses_faces(&polygons, UMB_ERROR_SIZE, none, |faces| faces.face_count = usize::MAX);
    for (offset, bad, face) in [(0, 1, 0), (3, 2, 2), (4, 10_000, 3), (9, 12, 8)] {
        let mut broken = polygons.clone();
        broken.offsets[offset] = bad;
        refuses_faces(&broken, UMB_ERROR_OFFSETS, face, |_| ());
    }
    let mut error: umb_error = zeroed();
    let status =
        unsafe { umb_topology_create(std::ptr::null(), 0, std::ptr::null(), std::ptr::null_mut(), &mut error) };
    assert_eq!(status, UMB_ERROR_NULL_POINTER);
    let faces = faces(&triangles);
    let status = unsafe { umb_topology_create(&faces, 26, std::ptr::null(), std::ptr::null_mut(), &mut error) };
    assert_eq!((status, message(&error).as_str()), (UMB_ERROR_NULL_POINTER, "topology is null"));
    let mut handle = std::ptr::null_mut();
    let huge = u32::MAX as usize + 1;
    let status = unsafe { umb_topology_create(&faces, huge, std::ptr::null(), &mut handle, &mut error) };
    assert_eq!(status, UMB_ERROR_TOO_LARGE);
    assert!(handle.is_null());
    // More corners than any mesh has are refused before one is read.
    let many = umb_faces { index_count: 3 << 30, face_count: 0, ..faces };
    let (mut cut, mut segmentation, points) =
        (std::ptr::null_mut(), std::ptr::null_mut(), points(&triangles.positions));
    unsafe {
        let none = std::ptr::null();
        assert_eq!(umb_topology_create(&many, 26, none, &mut handle, &mut error), UMB_ERROR_TOO_LARGE);
        let status = umb_cut_create(&many, &points, std::ptr::null(), none, &mut cut, &mut error);
        assert_eq!(status, UMB_ERROR_TOO_LARGE);
        let none = std::ptr::null();
        let status = umb_segment_features(&many, &points, none, &mut segmentation, &mut error);
        assert_eq!(status, UMB_ERROR_TOO_LARGE);
    }
    assert!(handle.is_null() && cut.is_null() && segmentation.is_null());
}

#[test]
fn scalars_are_at_vertices_or_faces() {
    let (curvatures, mut classes) = ([1.0f64; 3], [9u8; 3]);
    let sound = umb_scalars {
        data: curvatures.as_ptr().cast(),
        count: 3,
        stride: 0,
        scalar: UMB_SCALAR_F64,
        location: UMB_AT_FACES,
    };
    let mut options: umb_shape_options = zeroed();
    options.tolerance = 0.5;
    let to = umb_status_output { data: classes.as_mut_ptr(), stride: 0 };
    let mut error: umb_error = zeroed();
    let mut classify = |k1: umb_scalars, k2: umb_scalars| {
        let status = unsafe { umb_shape_classes(&k1, &k2, &options, &to, &mut error) };
        (status, error.element)
    };
    assert_eq!(classify(sound, sound).0, UMB_OK);
    let nowhere = umb_scalars { location: 2, ..sound };
    assert_eq!(classify(nowhere, nowhere), (UMB_ERROR_UNKNOWN_CONSTANT, 2));
    // Curvatures of a vertex are not those of a face.
    let vertices = umb_scalars { location: UMB_AT_VERTICES, ..sound };
    assert_eq!(classify(vertices, sound).0, UMB_ERROR_UNKNOWN_CONSTANT);
    assert_eq!(classify(sound, umb_scalars { location: u32::MAX, ..sound }).0, UMB_ERROR_UNKNOWN_CONSTANT);
    assert_eq!(classes, [UMB_SHAPE_PEAK; 3]);
}

#[test]
fn messages_say_what_where_and_what_was_expected() {
    let mut mesh = ring_sphere(6, 4);
    mesh.indices[7] = 77;
    let (mut handle, mut error): (*mut umb_topology, umb_error) = (std::ptr::null_mut(), zeroed());
    error.struct_size = size_of::<umb_error>() as u32;
    let status = unsafe { umb_topology_create(&faces(&mesh), 26, std::ptr::null(), &mut handle, &mut error) };
    assert_eq!(status, UMB_ERROR_INDEX_OUT_OF_RANGE);
    assert_eq!(message(&error), "faces.indices[7] is 77, but there are 26 vertices");
    // An error struct too short for its first version is left alone.
    error.struct_size = 12;
    error.status = -5;
    let status = unsafe { umb_topology_create(&faces(&mesh), 26, std::ptr::null(), &mut handle, &mut error) };
    assert_eq!((status, error.status), (UMB_ERROR_INDEX_OUT_OF_RANGE, -5));
    let known = (0..=13).chain([100, 101, 900]);
    // SAFETY: strings of the library, closed with a NUL.
    let text = |status| unsafe { std::ffi::CStr::from_ptr(umb_status_string(status)) };
    let texts: std::collections::HashSet<_> = known.map(text).collect();
    assert_eq!(texts.len(), 17, "each status has a text of its own");
    assert!([-1, 14, 99, 899, i32::MAX].iter().all(|&status| text(status).to_bytes() == b"unknown status"));
}

#[test]
fn newer_structs_are_read_as_far_as_they_are_known() {
    #[repr(C)]
    struct Newer {
        options: umb_normal_options,
        tail: [u8; 24],
    }
    let case = Case::new();
    let points = points(&case.mesh.positions);
    let (outputs, mut error): (umb_normal_outputs, umb_error) = (zeroed(), zeroed());
    let mut newer: Newer = zeroed();
    newer.options.struct_size = size_of::<Newer>() as u32;
    unsafe {
        assert_eq!(
            umb_vertex_normals(case.handle.0, &points, (&raw const newer).cast(), &outputs, &mut error),
            UMB_OK
        );
        newer.tail[5] = 1;
        let status = umb_vertex_normals(case.handle.0, &points, (&raw const newer).cast(), &outputs, &mut error);
        assert_eq!(status, UMB_ERROR_UNKNOWN_FIELD);
        assert_eq!(error.element, size_of::<umb_normal_options>() as u64 + 5);
    }
}

#[test]
fn progress_is_reported_and_cancels() {
    unsafe extern "C" fn count(user: *mut c_void, fraction: f64) -> i32 {
        let (calls, limit, last) = unsafe { &mut *user.cast::<(i32, i32, f64)>() };
        assert!((0.0..=1.0).contains(&fraction) && fraction >= *last);
        *last = fraction;
        *calls += 1;
        (*calls > *limit) as i32
    }
    let mesh = common::mesh::torus(200, 120, 0.2, 0.0, 1);
    let handle = Handle::new(&mesh);
    for threads in [1, 2, 5] {
        let mut state = (0, i32::MAX, 0.0);
        common::capi::normals(&handle, &mesh.positions, UMB_WEIGHT_CONFORMAL, false, |run| {
            run.threads = threads;
            run.progress = Some(count);
            run.user = (&raw mut state).cast();
        });
        assert!(state.0 > 1 && state.2 == 1.0, "{state:?}");
    }
    // Where there is nothing to do, nothing is reported.
    let mut state = (0, i32::MAX, 0.0);
    common::capi::normals(&handle, &mesh.positions, UMB_WEIGHT_AREA, false, |run| {
        run.progress = Some(count);
        run.user = (&raw mut state).cast();
        run.vertices = &0;
    });
    assert_eq!(state.0, 0);
    let points = points(&mesh.positions);
    let mut state = (0, 0, 0.0);
    let mut options: umb_normal_options = zeroed();
    options.run.progress = Some(count);
    options.run.user = (&raw mut state).cast();
    let (outputs, mut error): (umb_normal_outputs, umb_error) = (zeroed(), zeroed());
    let status = unsafe { umb_vertex_normals(handle.0, &points, &options, &outputs, &mut error) };
    assert_eq!((status, state.0), (UMB_ERROR_CANCELLED, 1));
}

#[test]
fn a_long_list_minds_only_the_positions_that_it_needs_too() {
    for quads in [0.0, 0.6] {
        let mut mesh = common::mesh::torus(40, 30, 0.2, quads, 1);
        let handle = Handle::new(&mesh);
        // The vertices of one side, many times over; a position on the other side is broken.
        let list: Vec<u32> = (0..20_000).map(|i| i % 300).collect();
        let call = |mesh: &Mesh| {
            let mut options: umb_normal_options = zeroed();
            (options.run.vertices, options.run.vertex_count) = (list.as_ptr(), list.len());
            let (outputs, mut error): (umb_normal_outputs, umb_error) = (zeroed(), zeroed());
            let points = points(&mesh.positions);
            (unsafe { umb_vertex_normals(handle.0, &points, &options, &outputs, &mut error) }, error.element)
        };
        mesh.positions[900][1] = f64::NAN;
        assert_eq!(call(&mesh).0, UMB_OK);
        mesh.positions[150][2] = f64::INFINITY;
        assert_eq!(call(&mesh), (UMB_ERROR_NON_FINITE, 150));
    }
}

#[test]
fn outputs_stats_and_errors_of_newer_versions() {
    #[repr(C)]
    struct Newer<T> {
        known: T,
        tail: [u64; 3],
    }
    let case = Case::new();
    let points = points(&case.mesh.positions);
    let mut normals = vec![[0.0f64; 3]; case.mesh.positions.len()];
    let mut outputs: Newer<umb_normal_outputs> = zeroed();
    outputs.known.struct_size = size_of_val(&outputs) as u32;
    outputs.known.normal = output(&mut normals);
    let mut error: Newer<umb_error> = zeroed();
    error.known.struct_size = size_of_val(&error) as u32;
    error.tail = [9; 3];
    let mut stats: Newer<umb_topology_stats> = zeroed();
    stats.known.struct_size = size_of_val(&stats) as u32;
    stats.tail = [9; 3];
    unsafe {
        let (outputs, error) = (&raw mut outputs, &raw mut error);
        let handle = case.handle.0;
        let call = move || umb_vertex_normals(handle, &points, std::ptr::null(), outputs.cast(), error.cast());
        assert_eq!(call(), UMB_OK);
        assert!((normals[0][2] - 1.0).abs() < 1e-12);
        (*outputs).tail[1] = 1;
        assert_eq!(call(), UMB_ERROR_UNKNOWN_FIELD);
        assert_eq!((*error).known.element, size_of::<umb_normal_outputs>() as u64 + 8);
        assert_eq!((*error).tail, [9; 3]);
        assert_eq!(umb_topology_get_stats(case.handle.0, (&raw mut stats).cast(), error.cast()), UMB_OK);
    }
    assert_eq!((stats.known.vertex_count, stats.tail), (26, [0; 3]));
}

#[test]
fn one_topology_serves_many_threads_at_once() {
    struct Shared(*const umb_topology);
    unsafe impl Sync for Shared {}
    let mesh = common::mesh::torus(60, 40, 0.3, 0.3, 1);
    let handle = Handle::new(&mesh);
    let shared = Shared(handle.0);
    let expected: Vec<_> = common::capi::WEIGHTS
        .map(|weight| common::capi::normals(&handle, &mesh.positions, weight, false, |_| ()).normal)
        .into();
    let barrier = std::sync::Barrier::new(8);
    std::thread::scope(|scope| {
        for thread in 0..8 {
            let (shared, mesh, expected, barrier) = (&shared, &mesh, &expected, &barrier);
            scope.spawn(move || {
                barrier.wait();
                for round in 0..20 {
                    let weight = (thread + round) % 10;
                    let mut normals = vec![[0.0f64; 3]; mesh.positions.len()];
                    let mut options: umb_normal_options = zeroed();
                    (options.weight, options.run.threads) = (weight as u32, 1 + round as u32 % 3);
                    let mut outputs: umb_normal_outputs = zeroed();
                    outputs.normal = output(&mut normals);
                    let points = points(&mesh.positions);
                    let error = std::ptr::null_mut();
                    let status = unsafe { umb_vertex_normals(shared.0, &points, &options, &outputs, error) };
                    assert_eq!(status, UMB_OK);
                    assert!(normals == expected[weight]);
                }
            });
        }
    });
}
