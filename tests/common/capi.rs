//! The C interface in a test's words.
// Every call keeps the contract that the header states; where a test breaks it on purpose, that is the test.
#![allow(clippy::undocumented_unsafe_blocks)]

use super::mesh::Mesh;
use std::ffi::CStr;
use umbilic::capi::*;

/// The averages over a one-ring, which an oracle knows.
pub const WEIGHTS: [umb_weight; 10] = [
    UMB_WEIGHT_CONFORMAL,
    UMB_WEIGHT_UNIFORM,
    UMB_WEIGHT_ANGLE,
    UMB_WEIGHT_AREA,
    UMB_WEIGHT_MAX,
    UMB_WEIGHT_CENTROID_AREA,
    UMB_WEIGHT_CENTROID,
    UMB_WEIGHT_INVERSE_ROOT_EDGES,
    UMB_WEIGHT_SINE,
    UMB_WEIGHT_ANGLE_EDGES,
];

/// Everything that a vertex normal may be computed by.
pub const ALL: [umb_weight; 11] = {
    let mut all = [UMB_WEIGHT_JET; 11];
    let (averages, _) = all.split_at_mut(10);
    averages.copy_from_slice(&WEIGHTS);
    all
};

/// An all-zero struct: the defaults.
pub fn zeroed<T>() -> T {
    // SAFETY: every struct of the header is valid for zeros.
    unsafe { std::mem::zeroed() }
}

pub fn message(error: &umb_error) -> String {
    // SAFETY: the library closes messages with a NUL.
    unsafe { CStr::from_ptr(error.message.as_ptr()) }.to_str().unwrap().to_owned()
}

pub fn faces(mesh: &Mesh) -> umb_faces {
    let triangles = mesh.is_triangles();
    umb_faces {
        indices: mesh.indices.as_ptr().cast(),
        index_count: mesh.indices.len(),
        offsets: if triangles { std::ptr::null() } else { mesh.offsets.as_ptr().cast() },
        face_count: mesh.face_count(),
        index: UMB_INDEX_U32,
        arity: if triangles { 3 } else { 0 },
    }
}

pub fn points<T>(data: &[[T; 3]]) -> umb_points {
    umb_points {
        data: data.as_ptr().cast(),
        count: data.len(),
        stride: 0,
        scalar: if size_of::<T>() == 4 { UMB_SCALAR_F32 } else { UMB_SCALAR_F64 },
        reserved: 0,
    }
}

pub fn output<T>(data: &mut [[T; 3]]) -> umb_output {
    umb_output {
        data: data.as_mut_ptr().cast(),
        stride: 0,
        scalar: if size_of::<T>() == 4 { UMB_SCALAR_F32 } else { UMB_SCALAR_F64 },
        reserved: 0,
    }
}

/// A handle that frees itself.
pub struct Handle(pub *mut umb_topology);

impl Handle {
    pub fn new(mesh: &Mesh) -> Handle {
        Handle::of(&faces(mesh), mesh.positions.len())
    }
    pub fn of(faces: &umb_faces, vertex_count: usize) -> Handle {
        let mut handle = std::ptr::null_mut();
        let mut error: umb_error = zeroed();
        let status = unsafe { umb_topology_create(faces, vertex_count, std::ptr::null(), &mut handle, &mut error) };
        assert_eq!(status, UMB_OK, "{}", message(&error));
        Handle(handle)
    }
    pub fn stats(&self) -> umb_topology_stats {
        let mut stats: umb_topology_stats = zeroed();
        assert_eq!(unsafe { umb_topology_get_stats(self.0, &mut stats, std::ptr::null_mut()) }, UMB_OK);
        stats
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        unsafe { umb_topology_destroy(self.0) };
    }
}

/// What [`normals`] answers.
pub struct Normals<T> {
    pub normal: Vec<[T; 3]>,
    pub sum: Vec<[f64; 3]>,
    pub status: Vec<u8>,
}

/// Unit normals and statuses of all vertices; and sums, if `sums` (which makes the call double precision).
pub fn normals<T: Copy + Default>(
    handle: &Handle,
    positions: &[[T; 3]],
    weight: umb_weight,
    sums: bool,
    set: impl FnOnce(&mut umb_run),
) -> Normals<T> {
    normals_with(handle, positions, sums, |options| {
        options.weight = weight;
        set(&mut options.run);
    })
}

/// As [`normals`], with any options.
pub fn normals_with<T: Copy + Default>(
    handle: &Handle,
    positions: &[[T; 3]],
    sums: bool,
    set: impl FnOnce(&mut umb_normal_options),
) -> Normals<T> {
    let count = positions.len();
    let mut found =
        Normals { normal: vec![[T::default(); 3]; count], sum: vec![[0.0; 3]; count], status: vec![0; count] };
    let mut options: umb_normal_options = zeroed();
    options.struct_size = size_of::<umb_normal_options>() as u32;
    set(&mut options);
    let mut outputs: umb_normal_outputs = zeroed();
    outputs.struct_size = size_of::<umb_normal_outputs>() as u32;
    outputs.normal = output(&mut found.normal);
    if sums {
        outputs.sum = output(&mut found.sum);
    }
    outputs.status = umb_status_output { data: found.status.as_mut_ptr(), stride: 0 };
    let mut error: umb_error = zeroed();
    let status = unsafe { umb_vertex_normals(handle.0, &points(positions), &options, &outputs, &mut error) };
    assert_eq!(status, UMB_OK, "{}", message(&error));
    found
}

pub fn widened(normals: &[[f32; 3]]) -> Vec<[f64; 3]> {
    normals.iter().map(|normal| normal.map(f64::from)).collect()
}
