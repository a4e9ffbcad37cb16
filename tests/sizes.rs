//! Counts and strides near the ends of their types: refused by arithmetic, before anything is read. The memory that the calls are
//! given may not be touched at all.
#![cfg(all(target_os = "linux", target_pointer_width = "64"))]
// Every call keeps the contract that the header states; where a test breaks it on purpose, that is the test.
#![allow(clippy::undocumented_unsafe_blocks)]

mod common;
use common::capi::{Handle, message, zeroed};
use common::mesh;
use umbilic::capi::*;

/// Address space that ends the process when it is read or written.
struct Forbidden(*mut libc::c_void);

const ROOM: usize = 1 << 30;

impl Forbidden {
    fn new() -> Self {
        let flags = libc::MAP_PRIVATE | libc::MAP_ANONYMOUS | libc::MAP_NORESERVE;
        let start = unsafe { libc::mmap(std::ptr::null_mut(), ROOM, libc::PROT_NONE, flags, -1, 0) };
        assert_ne!(start, libc::MAP_FAILED);
        Forbidden(start)
    }
}

impl Drop for Forbidden {
    fn drop(&mut self) {
        unsafe { libc::munmap(self.0, ROOM) };
    }
}

const MOST: usize = isize::MAX as usize;

#[test]
fn meshes_beyond_the_tables_are_refused() {
    let memory = Forbidden::new();
    let corners_limit = u32::MAX as usize / 2;
    for index in [UMB_INDEX_U32, UMB_INDEX_I32, UMB_INDEX_U64] {
        for (arity, count, status, text) in [
            (3, (corners_limit / 3 + 1) * 3, UMB_ERROR_TOO_LARGE, "corners: the limit is 2147483647"),
            (3, 3 << 31, UMB_ERROR_TOO_LARGE, "corners: the limit"),
            (4, 1 << 32, UMB_ERROR_TOO_LARGE, "corners: the limit"),
            (4, 1 << 36, UMB_ERROR_TOO_LARGE, "corners: the limit"),
            (3, MOST / 24 * 3, UMB_ERROR_TOO_LARGE, "corners: the limit"),
            (3, usize::MAX / 3 * 3, UMB_ERROR_SIZE, "faces.indices is 18446744073709551615"),
            (4, usize::MAX - 3, UMB_ERROR_SIZE, "faces.indices is"),
            (4, usize::MAX / 2 + 1, UMB_ERROR_SIZE, "faces.indices is"),
        ] {
            let faces = umb_faces {
                indices: memory.0,
                index_count: count,
                offsets: std::ptr::null(),
                face_count: 0,
                index,
                arity,
            };
            let (mut handle, mut error): (*mut umb_topology, umb_error) = (std::ptr::null_mut(), zeroed());
            let found = unsafe { umb_topology_create(&faces, 100, std::ptr::null(), &mut handle, &mut error) };
            assert_eq!(found, status, "{count}: {}", message(&error));
            assert!(message(&error).contains(text), "{}", message(&error));
            assert!(handle.is_null());
        }
    }
}

#[test]
fn vertices_beyond_the_tables_are_refused() {
    let triangle = [0u32, 1, 2];
    for count in [u32::MAX as usize + 1, 1 << 33, MOST, usize::MAX] {
        let faces = umb_faces {
            indices: triangle.as_ptr().cast(),
            index_count: 3,
            offsets: std::ptr::null(),
            face_count: 0,
            index: UMB_INDEX_U32,
            arity: 3,
        };
        let (mut handle, mut error): (*mut umb_topology, umb_error) = (std::ptr::null_mut(), zeroed());
        let found = unsafe { umb_topology_create(&faces, count, std::ptr::null(), &mut handle, &mut error) };
        assert_eq!(found, UMB_ERROR_TOO_LARGE, "{}", message(&error));
        assert_eq!(message(&error), format!("{count} vertices: the limit is 4294967295"));
    }
}

/// Counts with strides whose bytes go beyond the address space, or whose elements no mesh here has.
const VIEWS: [(usize, usize); 9] = [
    (usize::MAX, 0),
    (MOST, 0),
    (MOST / 12 + 1, 12),
    (1 << 32, 1 << 32),
    (26, MOST & !7),
    (26, usize::MAX & !7),
    (26, 1 << 63),
    (1 << 33, 12),
    (27, 12),
];

#[test]
fn views_beyond_the_address_space_are_refused() {
    let memory = Forbidden::new();
    let handle = Handle::new(&mesh::ring_sphere(6, 4));
    let positions = vec![[0.5f32; 3]; 26];
    let good = common::capi::points(&positions);
    let mut error: umb_error = zeroed();
    for (count, stride) in VIEWS {
        let view = umb_points { data: memory.0, count, stride, scalar: UMB_SCALAR_F32, reserved: 0 };
        let outputs: umb_normal_outputs = zeroed();
        let status = unsafe { umb_vertex_normals(handle.0, &view, std::ptr::null(), &outputs, &mut error) };
        assert!(matches!(status, UMB_ERROR_SIZE), "{count} x {stride}: {status}, {}", message(&error));
        // Given normals, and directions.
        let mut options: umb_curvature_options = zeroed();
        options.method = UMB_CURVATURE_QUADRIC;
        options.normals = view;
        let outputs: umb_curvature_outputs = zeroed();
        let status = unsafe { umb_curvatures(handle.0, &good, &options, &outputs, &mut error) };
        assert_eq!(status, UMB_ERROR_SIZE, "{count} x {stride}: {}", message(&error));
        let mut options: umb_section_options = zeroed();
        options.directions = view;
        let outputs: umb_section_outputs = zeroed();
        let status = unsafe { umb_direction_sections(handle.0, &good, &options, &outputs, &mut error) };
        assert_eq!(status, UMB_ERROR_SIZE, "{count} x {stride}: {}", message(&error));
        // A polyline may be as long as memory is.
        if !(count == 27 || count == 1 << 33) {
            let line = umb_polyline {
                data: memory.0,
                count,
                stride,
                scalar: UMB_SCALAR_F32,
                dimension: 3,
                closed: 0,
                reserved: 0,
            };
            let outputs: umb_polyline_outputs = zeroed();
            let status = unsafe { umb_polyline_curvatures(&line, std::ptr::null(), &outputs, &mut error) };
            assert_eq!(status, UMB_ERROR_SIZE, "{count} x {stride}: {}", message(&error));
        }
    }
    // So many shared directions that their sections have no count.
    let mut options: umb_section_options = zeroed();
    options.shared = 1;
    options.directions =
        umb_points { data: memory.0, count: MOST / 12, stride: 0, scalar: UMB_SCALAR_F32, reserved: 0 };
    let outputs: umb_section_outputs = zeroed();
    let status = unsafe { umb_direction_sections(handle.0, &good, &options, &outputs, &mut error) };
    assert_eq!(status, UMB_ERROR_SIZE, "{}", message(&error));
}

#[test]
fn outputs_beyond_the_address_space_are_refused() {
    let memory = Forbidden::new();
    let mesh = mesh::ring_sphere(6, 4);
    let handle = Handle::new(&mesh);
    let positions = mesh.single();
    let points = common::capi::points(&positions);
    let mut error: umb_error = zeroed();
    for stride in [MOST & !7, usize::MAX & !7, 1 << 63, (MOST / 26 + 8) & !7] {
        let output = umb_output { data: memory.0, stride, scalar: UMB_SCALAR_F32, reserved: 0 };
        let mut outputs: umb_normal_outputs = zeroed();
        outputs.normal = output;
        let status = unsafe { umb_vertex_normals(handle.0, &points, std::ptr::null(), &outputs, &mut error) };
        assert_eq!(status, UMB_ERROR_SIZE, "{stride}: {}", message(&error));
        let mut outputs: umb_normal_outputs = zeroed();
        outputs.status = umb_status_output { data: memory.0.cast(), stride };
        let status = unsafe { umb_vertex_normals(handle.0, &points, std::ptr::null(), &outputs, &mut error) };
        assert_eq!(status, UMB_ERROR_SIZE, "{stride}: {}", message(&error));
    }
    // A list longer than the address space.
    let mut options: umb_normal_options = zeroed();
    (options.run.vertices, options.run.vertex_count) = (memory.0.cast(), usize::MAX / 4);
    let outputs: umb_normal_outputs = zeroed();
    let status = unsafe { umb_vertex_normals(handle.0, &points, &options, &outputs, &mut error) };
    assert_eq!(status, UMB_ERROR_SIZE, "{}", message(&error));
}
