//! The curvatures of the C interface in a test's words.
// Every call keeps the contract that the header states; where a test breaks it on purpose, that is the test.
#![allow(clippy::undocumented_unsafe_blocks)]

use super::Vector;
use super::capi::{Handle, message, points, zeroed};
use super::mesh::Mesh;
pub use super::outputs::{OUTPUTS, Out, Out::*};
use umbilic::capi::*;

pub const METHODS: [umb_curvature_method; 13] = [
    UMB_CURVATURE_ADAPTIVE_JET,
    UMB_CURVATURE_JET,
    UMB_CURVATURE_QUADRIC,
    UMB_CURVATURE_GOLDFEATHER,
    UMB_CURVATURE_TILTED_SECTIONS,
    UMB_CURVATURE_LEAST_SQUARES,
    UMB_CURVATURE_TAUBIN,
    UMB_CURVATURE_WATANABE,
    UMB_CURVATURE_MEYER,
    UMB_CURVATURE_ANGLE_DEFECT,
    UMB_CURVATURE_RUSINKIEWICZ,
    UMB_CURVATURE_NORMAL_CYCLE,
    UMB_CURVATURE_CORRECTED_MEASURE,
];

/// By which power of the mesh's size an output grows with it.
pub fn power(output: Out, method: umb_curvature_method) -> i32 {
    match output {
        K1 | K2 | Mean | MeanNormal | Curvedness => -1,
        Gaussian => -2,
        Area => 2,
        IntegratedMean => 1,
        Residual if method == UMB_CURVATURE_LEAST_SQUARES => -1,
        Residual => 1,
        Direction1 | Direction2 | IntegratedGaussian | ShapeIndex | Condition | DegreesOfFreedom | Normal => 0,
    }
}

/// The options of a method, all else zero.
pub fn options(method: umb_curvature_method) -> umb_curvature_options {
    let mut options: umb_curvature_options = zeroed();
    options.struct_size = size_of::<umb_curvature_options>() as u32;
    options.method = method;
    options
}

/// What a call wrote: nothing where an output is not of the method.
#[derive(Clone, Debug)]
pub struct Found {
    pub method: umb_curvature_method,
    pub values: [Vec<f64>; 16],
    pub status: Vec<u8>,
}

impl Found {
    /// Arrays for the outputs that `wanted` names, filled with something that no call writes.
    pub fn new(method: umb_curvature_method, count: usize, wanted: impl Fn(Out) -> bool, fill: f64) -> Found {
        let length = |output: Out| if wanted(output) { count * output.components() } else { 0 };
        Found { method, values: OUTPUTS.map(|output| vec![fill; length(output)]), status: vec![0xa5; count] }
    }

    /// The arrays as outputs.
    pub fn outputs(&mut self) -> umb_curvature_outputs {
        let mut outputs: umb_curvature_outputs = zeroed();
        outputs.struct_size = size_of::<umb_curvature_outputs>() as u32;
        for (output, values) in OUTPUTS.into_iter().zip(&mut self.values) {
            if !values.is_empty() {
                let data = values.as_mut_ptr().cast();
                *output.field(&mut outputs) = umb_output { data, stride: 0, scalar: UMB_SCALAR_F64, reserved: 0 };
            }
        }
        outputs.status = umb_status_output { data: self.status.as_mut_ptr(), stride: 0 };
        outputs
    }

    pub fn has(&self, output: Out) -> bool {
        !self.values[output as usize].is_empty()
    }
    pub fn at(&self, output: Out, vertex: usize) -> f64 {
        assert!(output.components() == 1);
        self.values[output as usize][vertex]
    }
    pub fn vector(&self, output: Out, vertex: usize) -> Vector {
        assert!(output.components() == 3);
        std::array::from_fn(|axis| self.values[output as usize][3 * vertex + axis])
    }
    pub fn all(&self, output: Out) -> &[f64] {
        &self.values[output as usize]
    }
    pub fn normals(&self) -> Vec<Vector> {
        self.all(Normal).as_chunks::<3>().0.to_vec()
    }
    /// The bits of all of it.
    pub fn bits(&self) -> (Vec<Vec<u64>>, &[u8]) {
        (self.values.iter().map(|values| values.iter().map(|x| x.to_bits()).collect()).collect(), &self.status)
    }
    /// Whether the vertex has results at all.
    pub fn known(&self, vertex: usize) -> bool {
        self.status[vertex] & (UMB_VERTEX_ISOLATED | UMB_VERTEX_DEGENERATE) == 0
    }
}

/// Calls with these options; answers with what was written, or with the status, the element and the message.
pub fn call(
    handle: &Handle,
    points: &umb_points,
    options: &umb_curvature_options,
    wanted: impl Fn(Out) -> bool,
    fill: f64,
) -> (Found, Result<(), (umb_status, u64, String)>) {
    let mut found = Found::new(options.method, points.count, wanted, fill);
    let outputs = found.outputs();
    let mut error: umb_error = zeroed();
    let status = unsafe { umb_curvatures(handle.0, points, options, &outputs, &mut error) };
    assert!(status == UMB_OK || error.status == status);
    let result = if status == UMB_OK { Ok(()) } else { Err((status, error.element, message(&error))) };
    (found, result)
}

/// Everything that the options' method has to give.
pub fn curvatures<T>(handle: &Handle, positions: &[[T; 3]], options: &umb_curvature_options) -> Found {
    let (found, result) = call(handle, &points(positions), options, |output| output.is_of(options.method), 0.0);
    assert_eq!(result, Ok(()));
    found
}

/// As [`curvatures`], with normals given and options set.
pub fn of_mesh(
    mesh: &Mesh,
    method: umb_curvature_method,
    normals: Option<&[Vector]>,
    set: impl FnOnce(&mut umb_curvature_options),
) -> Found {
    let mut options = options(method);
    if let Some(normals) = normals {
        options.normals = points(normals);
    }
    set(&mut options);
    curvatures(&Handle::new(mesh), &mesh.positions, &options)
}

/// Curvatures and statuses of sections, and the normals used.
pub struct Sections {
    pub curvature: Vec<f64>,
    pub status: Vec<u8>,
    pub normal: Vec<Vector>,
}

type Call = unsafe extern "C" fn(
    *const umb_topology,
    *const umb_points,
    *const umb_section_options,
    *const umb_section_outputs,
    *mut umb_error,
) -> umb_status;

fn sections(
    call: Call,
    count: usize,
    handle: &Handle,
    positions: &[Vector],
    set: impl FnOnce(&mut umb_section_options),
) -> Sections {
    let vertices = positions.len();
    let (curvature, status, normal) = (vec![0.0; count], vec![0xa5; count], vec![[0.0; 3]; vertices]);
    let mut found = Sections { curvature, status, normal };
    let mut options: umb_section_options = zeroed();
    options.struct_size = size_of::<umb_section_options>() as u32;
    set(&mut options);
    let mut outputs: umb_section_outputs = zeroed();
    outputs.struct_size = size_of::<umb_section_outputs>() as u32;
    let data = found.curvature.as_mut_ptr().cast();
    outputs.curvature = umb_output { data, stride: 0, scalar: UMB_SCALAR_F64, reserved: 0 };
    outputs.status = umb_status_output { data: found.status.as_mut_ptr(), stride: 0 };
    outputs.normal = super::capi::output(&mut found.normal);
    let mut error: umb_error = zeroed();
    let status = unsafe { call(handle.0, &points(positions), &options, &outputs, &mut error) };
    assert_eq!(status, UMB_OK, "{}", message(&error));
    found
}

/// The section along every entry of the ring array.
pub fn edge_sections(handle: &Handle, positions: &[Vector], set: impl FnOnce(&mut umb_section_options)) -> Sections {
    let count = ring_offsets(handle, positions.len())[positions.len()] as usize;
    sections(umb_edge_sections, count, handle, positions, set)
}

/// The sections in the same directions at every vertex.
pub fn direction_sections(
    handle: &Handle,
    positions: &[Vector],
    directions: &[Vector],
    set: impl FnOnce(&mut umb_section_options),
) -> Sections {
    let count = positions.len() * directions.len();
    sections(umb_direction_sections, count, handle, positions, |options| {
        (options.directions, options.shared) = (points(directions), 1);
        set(options);
    })
}

/// The ring array: where each vertex's part starts, and after them the end.
pub fn ring_offsets(handle: &Handle, vertices: usize) -> &[u32] {
    unsafe { std::slice::from_raw_parts(umb_topology_ring_offsets(handle.0), vertices + 1) }
}

/// The neighbours in the ring array.
pub fn ring_neighbours(handle: &Handle, vertices: usize) -> &[u32] {
    let count = ring_offsets(handle, vertices)[vertices] as usize;
    if count == 0 {
        return &[];
    }
    unsafe { std::slice::from_raw_parts(umb_topology_ring_neighbours(handle.0), count) }
}

/// `k1 d1 d1ᵀ + k2 d2 d2ᵀ`: principal curvatures and directions in one, which do not jump where they meet.
pub fn tensor(found: &Found, vertex: usize) -> [Vector; 3] {
    let (d1, d2) = (found.vector(Direction1, vertex), found.vector(Direction2, vertex));
    let (k1, k2) = (found.at(K1, vertex), found.at(K2, vertex));
    std::array::from_fn(|i| std::array::from_fn(|j| k1 * d1[i] * d1[j] + k2 * d2[i] * d2[j]))
}
