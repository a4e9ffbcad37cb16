//! Interleaved, padded and mixed arrays: the same bits as packed ones, and nothing written beside the elements.
// Every call keeps the contract that the header states.
#![allow(clippy::undocumented_unsafe_blocks)]

mod common;
use common::capi::{ALL, Handle, normals, zeroed};
use common::mesh::{letter_prism, torus};
use umbilic::capi::*;

const GUARD: f32 = -77.5;

/// A vertex buffer as renderers have it.
#[repr(C)]
#[derive(Clone, Copy)]
struct Vertex {
    color: f32,
    position: [f32; 3],
    normal: [f32; 3],
    uv: [f32; 2],
    status: u8,
    padding: [u8; 3],
}

#[test]
fn an_interleaved_buffer_is_read_and_written_in_place() {
    for mesh in [torus(30, 17, 0.3, 0.0, 1), torus(30, 17, 0.3, 0.5, 1), letter_prism()] {
        let handle = Handle::new(&mesh);
        for weight in ALL {
            for simd in [UMB_SIMD_PORTABLE, UMB_SIMD_SSE2, UMB_SIMD_AVX2, UMB_SIMD_AVX512] {
                let expected = normals(&handle, &mesh.single(), weight, false, |_| ());
                let vertex = |position: &[f32; 3]| Vertex {
                    color: GUARD,
                    position: *position,
                    normal: [GUARD; 3],
                    uv: [GUARD; 2],
                    status: 99,
                    padding: [0xee; 3],
                };
                // The array ends with the last vertex's last byte: a load past it would be seen by memory checkers.
                let mut buffer: Box<[Vertex]> = mesh.single().iter().map(vertex).collect();
                let (count, stride) = (buffer.len(), size_of::<Vertex>());
                let base = buffer.as_mut_ptr();
                let mut options: umb_normal_options = zeroed();
                options.weight = weight;
                options.run.simd = simd;
                options.run.threads = 2;
                let mut outputs: umb_normal_outputs = zeroed();
                unsafe {
                    let points = umb_points {
                        data: (&raw const (*base).position).cast(),
                        count,
                        stride,
                        scalar: UMB_SCALAR_F32,
                        reserved: 0,
                    };
                    outputs.normal.data = (&raw mut (*base).normal).cast();
                    outputs.normal.stride = stride;
                    outputs.status = umb_status_output { data: &raw mut (*base).status, stride };
                    let status = umb_vertex_normals(handle.0, &points, &options, &outputs, std::ptr::null_mut());
                    assert_eq!(status, UMB_OK);
                }
                for (vertex, index) in buffer.iter().zip(0..) {
                    let index: usize = index;
                    assert_eq!(vertex.normal.map(f32::to_bits), expected.normal[index].map(f32::to_bits));
                    assert_eq!(vertex.status, expected.status[index]);
                    assert_eq!((vertex.color, vertex.uv, vertex.padding), (GUARD, [GUARD; 2], [0xee; 3]));
                }
            }
        }
    }
}

#[test]
fn scalars_may_be_mixed() {
    let mesh = torus(30, 17, 0.3, 0.0, 2).rounded();
    let handle = Handle::new(&mesh);
    for weight in ALL {
        let expected = normals(&handle, &mesh.positions, weight, false, |_| ());
        // Positions in f32, normals in f64: computed in f64 from the same numbers.
        let (single, mut found) = (mesh.single(), vec![[0.0f64; 3]; mesh.positions.len()]);
        let mut options: umb_normal_options = zeroed();
        options.weight = weight;
        let mut outputs: umb_normal_outputs = zeroed();
        outputs.normal = common::capi::output(&mut found);
        let points = common::capi::points(&single);
        let status = unsafe { umb_vertex_normals(handle.0, &points, &options, &outputs, std::ptr::null_mut()) };
        assert_eq!(status, UMB_OK);
        assert_eq!(found, expected.normal, "weight {weight}");
        // Positions in f64, normals in f32: the same, rounded once.
        let mut rounded = vec![[0.0f32; 3]; mesh.positions.len()];
        outputs.normal = common::capi::output(&mut rounded);
        let points = common::capi::points(&mesh.positions);
        let status = unsafe { umb_vertex_normals(handle.0, &points, &options, &outputs, std::ptr::null_mut()) };
        assert_eq!(status, UMB_OK);
        for (rounded, expected) in rounded.iter().zip(&expected.normal) {
            assert_eq!(*rounded, expected.map(|x| x as f32));
        }
    }
}

#[test]
fn padded_doubles_are_those_of_a_packed_array() {
    let mesh = torus(30, 17, 0.3, 0.0, 3);
    let handle = Handle::new(&mesh);
    let padded: Box<[[f64; 5]]> = mesh.positions.iter().map(|[x, y, z]| [f64::NAN, *x, *y, *z, f64::NAN]).collect();
    for weight in ALL {
        for simd in [UMB_SIMD_PORTABLE, UMB_SIMD_SSE2, UMB_SIMD_AVX2, UMB_SIMD_AVX512] {
            let expected = normals(&handle, &mesh.positions, weight, false, |_| ());
            let mut found = vec![[0.0f64; 3]; mesh.positions.len()];
            let mut options: umb_normal_options = zeroed();
            (options.weight, options.run.simd) = (weight, simd);
            let mut outputs: umb_normal_outputs = zeroed();
            outputs.normal = common::capi::output(&mut found);
            let points = umb_points {
                data: padded.as_ptr().cast::<f64>().wrapping_add(1).cast(),
                count: padded.len(),
                stride: 40,
                scalar: UMB_SCALAR_F64,
                reserved: 0,
            };
            let status = unsafe { umb_vertex_normals(handle.0, &points, &options, &outputs, std::ptr::null_mut()) };
            assert_eq!(status, UMB_OK);
            assert_eq!(found, expected.normal, "weight {weight}, simd {simd}");
        }
    }
}
