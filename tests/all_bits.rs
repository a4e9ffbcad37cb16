//! Every quantity has the same bits for any number of threads, any vectors, any list of vertices, in any run; and those of a
//! fixed mesh are written down, so that a change is noticed. `UPDATE_BITS=1 cargo test --test all_bits` writes them anew; the
//! changelog then says whose bits changed and why.
//
// Every call keeps the contract that the header states.
#![allow(clippy::undocumented_unsafe_blocks)]

mod common;
use common::capi::{Handle, message, output, points, zeroed};
use common::curvature::{METHODS, OUTPUTS, options};
use common::mesh::{self, Mesh, tetrahedron_sphere};
use common::random::Random;
use common::real;
use umbilic::capi::*;

/// A scalar of positions and outputs.
trait Scalar: Copy + Default + 'static {
    const NAME: &'static str;
    const CODE: umb_scalar;
    fn of(x: f64) -> Self;
    fn bits(self) -> u64;
}
impl Scalar for f32 {
    const NAME: &'static str = "f32";
    const CODE: umb_scalar = UMB_SCALAR_F32;
    fn of(x: f64) -> f32 {
        x as f32
    }
    fn bits(self) -> u64 {
        self.to_bits().into()
    }
}
impl Scalar for f64 {
    const NAME: &'static str = "f64";
    const CODE: umb_scalar = UMB_SCALAR_F64;
    fn of(x: f64) -> f64 {
        x
    }
    fn bits(self) -> u64 {
        self.to_bits()
    }
}

/// What a call wrote, by name: so many numbers for each vertex, as bits.
type Results = Vec<(String, usize, Vec<u64>)>;

/// A run's threads, vectors and vertices.
#[derive(Clone, Copy)]
struct Setting<'a> {
    threads: u32,
    simd: umb_simd,
    vertices: Option<&'a [u32]>,
}

impl Setting<'_> {
    fn apply(&self, run: &mut umb_run) {
        (run.threads, run.simd) = (self.threads, self.simd);
        if let Some(vertices) = self.vertices {
            (run.vertices, run.vertex_count) = (vertices.as_ptr(), vertices.len());
        }
    }
}

fn ok(status: umb_status, error: &umb_error) {
    assert_eq!(status, UMB_OK, "{}", message(error));
}

fn bits<S: Scalar>(values: &[S]) -> Vec<u64> {
    values.iter().map(|x| x.bits()).collect()
}

/// Normals of every weight, curvatures of every method, sections: everything that a call writes for vertices.
fn everything<S: Scalar>(mesh: &Mesh, handle: &Handle, setting: Setting<'_>) -> Results {
    let positions: Vec<[S; 3]> = mesh.positions.iter().map(|p| p.map(S::of)).collect();
    let count = positions.len();
    let mut results = vec![];
    let mut error: umb_error = zeroed();
    let scalar = |values: &mut Vec<S>| umb_output {
        data: values.as_mut_ptr().cast(),
        stride: 0,
        scalar: S::CODE,
        reserved: 0,
    };
    let statuses = |values: &mut Vec<u8>| umb_status_output { data: values.as_mut_ptr(), stride: 0 };
    for weight in 0..=UMB_WEIGHT_TILTED_SECTIONS {
        let (mut normal, mut status) = (vec![[S::default(); 3]; count], vec![0u8; count]);
        let mut options: umb_normal_options = zeroed();
        options.struct_size = size_of::<umb_normal_options>() as u32;
        options.weight = weight;
        setting.apply(&mut options.run);
        let mut outputs: umb_normal_outputs = zeroed();
        outputs.struct_size = size_of::<umb_normal_outputs>() as u32;
        outputs.normal = output(&mut normal);
        outputs.status = statuses(&mut status);
        let done = unsafe { umb_vertex_normals(handle.0, &points(&positions), &options, &outputs, &mut error) };
        ok(done, &error);
        results.push((format!("normals of weight {weight}"), 3, bits(normal.as_flattened())));
        results.push((format!("statuses of weight {weight}"), 1, status.iter().map(|&s| s as u64).collect()));
    }
    for method in METHODS {
        let mut options = options(method);
        setting.apply(&mut options.run);
        let mut outputs: umb_curvature_outputs = zeroed();
        outputs.struct_size = size_of::<umb_curvature_outputs>() as u32;
        // The pairs whose difference is always double precision are asked for in a call of their own.
        let (all, without): (Vec<_>, Vec<_>) =
            OUTPUTS.into_iter().filter(|output| output.is_of(method)).partition(|output| {
                use common::curvature::Out::*;
                matches!(output, K1 | K2 | ShapeIndex | Curvedness | Residual)
            });
        for wanted in [all, without] {
            let mut values: Vec<Vec<S>> =
                wanted.iter().map(|output| vec![S::default(); count * output.components()]).collect();
            let mut status = vec![0u8; count];
            let mut outputs = outputs;
            for (output, values) in wanted.iter().zip(&mut values) {
                *output.field(&mut outputs) = scalar(values);
            }
            outputs.status = statuses(&mut status);
            let done = unsafe { umb_curvatures(handle.0, &points(&positions), &options, &outputs, &mut error) };
            ok(done, &error);
            for (output, values) in wanted.iter().zip(&values) {
                results.push((format!("{output:?} of method {method}"), output.components(), bits(values)));
            }
            let name = format!("statuses of method {method} beside {} outputs", wanted.len());
            results.push((name, 1, status.iter().map(|&status| status as u64).collect()));
        }
    }
    results
}

fn meshes() -> Vec<Mesh> {
    let mut meshes = vec![
        mesh::torus(90, 60, 0.3, 0.0, 1),
        mesh::torus(50, 45, 0.3, 0.6, 2),
        mesh::height_field(50, 0.0, 3),
        mesh::fan(700, true, 5),
        mesh::letter_prism(),
        flat_and_far(),
    ];
    for seed in 0..4 {
        meshes.push(mesh::soup(60, 90, 3, seed));
        meshes.push(mesh::soup(60, 90, 7, 50 + seed));
    }
    meshes.extend(real::meshes().into_iter().filter(|mesh| mesh.positions.len() < 6000));
    meshes
}

/// A height field with vertices moved onto each other, edges folded back and sizes from 1e-30 to 1e30.
fn flat_and_far() -> Mesh {
    let mut mesh = mesh::height_field(40, 0.0, 7);
    let mut random = Random::new(8);
    for _ in 0..200 {
        let (a, b) = (random.below(mesh.positions.len()), random.below(mesh.positions.len()));
        mesh.positions[a] = match random.below(4) {
            0 => mesh.positions[b],
            1 => mesh.positions[a].map(|x| x * 1e-30),
            2 => mesh.positions[a].map(|x| x * 1e30),
            _ => [mesh.positions[a][0], mesh.positions[a][1], 0.0],
        };
    }
    mesh
}

fn same(found: &Results, base: &Results, what: &str) {
    for ((name, width, found), (_, _, base)) in found.iter().zip(base) {
        if found != base {
            let place = found.iter().zip(base).position(|(a, b)| a != b).unwrap();
            panic!("{what}: {name} differs at vertex {}", place / width);
        }
    }
}

fn compare<S: Scalar>(mesh: &Mesh) {
    let handle = Handle::new(mesh);
    let base = everything::<S>(mesh, &handle, Setting { threads: 1, simd: UMB_SIMD_PORTABLE, vertices: None });
    let small = mesh.positions.len() < 3000;
    for (threads, simd) in [
        (1, UMB_SIMD_SSE2),
        (1, UMB_SIMD_AVX2),
        (1, UMB_SIMD_AVX512),
        (2, UMB_SIMD_AVX2),
        (3, UMB_SIMD_AVX512),
        (4, UMB_SIMD_SSE2),
        (5, UMB_SIMD_AVX512),
        (6, UMB_SIMD_PORTABLE),
        (7, UMB_SIMD_BEST),
        (8, UMB_SIMD_BEST),
        (0, UMB_SIMD_BEST),
        (8, UMB_SIMD_BEST),
    ] {
        if !small && matches!(simd, UMB_SIMD_PORTABLE | UMB_SIMD_SSE2) && threads > 1 {
            continue;
        }
        let found = everything::<S>(mesh, &handle, Setting { threads, simd, vertices: None });
        same(&found, &base, &format!("{}, {}, {threads} threads, simd {simd}", mesh.name, S::NAME));
    }
    let count = mesh.positions.len() as u32;
    let third: Vec<u32> = (0..count).rev().filter(|vertex| vertex % 3 == 1).collect();
    let few = [count / 2, 0, count / 2, count - 1];
    for (threads, list) in [(1, &third[..]), (3, &third[..]), (1, &few[..])] {
        let found = everything::<S>(mesh, &handle, Setting { threads, simd: 0, vertices: Some(list) });
        for ((name, width, found), (_, _, base)) in found.iter().zip(&base) {
            let mut expected = vec![0; base.len()];
            for &vertex in list {
                let place = vertex as usize * width..(vertex as usize + 1) * width;
                expected[place.clone()].copy_from_slice(&base[place]);
            }
            assert!(*found == expected, "{}, {}: {name} of {} vertices", mesh.name, S::NAME, list.len());
        }
    }
}

#[test]
fn in_single_precision() {
    meshes().iter().for_each(compare::<f32>);
}

#[test]
fn in_double_precision() {
    meshes().iter().for_each(compare::<f64>);
}

/// Made by sums, products, quotients and roots alone, so that it is the same mesh everywhere.
fn fixed(quads: bool) -> Mesh {
    let mut mesh = tetrahedron_sphere(5);
    let mut random = Random::new(1);
    for position in &mut mesh.positions {
        let factor = 1.0 + position[0] * position[1] * 0.4 + random.signed() * 0.01;
        *position = position.map(|x| x * factor);
    }
    if !quads {
        return mesh;
    }
    // Of each four triangles that one was cut into, a corner's and the middle one, across their common edge.
    let mut faces = vec![];
    for four in mesh.face_vectors().chunks_exact(4) {
        let (corner, middle) = (&four[1], &four[3]);
        faces.extend([four[0].clone(), vec![corner[0], corner[1], corner[2], middle[2]], four[2].clone()]);
    }
    mesh.with_faces(faces)
}

/// Fowler, Noll & Vo's hash, 64 bits.
fn hash(values: &[u64]) -> u64 {
    values
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ byte as u64).wrapping_mul(0x0000_0100_0000_01b3))
}

#[test]
fn the_bits_of_a_fixed_mesh_are_those_written_down() {
    let mut lines = vec![];
    for quads in [false, true] {
        let mesh = fixed(quads);
        let handle = Handle::new(&mesh);
        let setting = Setting { threads: 0, simd: 0, vertices: None };
        let faces = if quads { "quads" } else { "triangles" };
        for (scalar, results) in
            [("f32", everything::<f32>(&mesh, &handle, setting)), ("f64", everything::<f64>(&mesh, &handle, setting))]
        {
            lines.extend(
                results.iter().map(|(name, _, bits)| format!("{:016x} {faces}, {scalar}: {name}", hash(bits))),
            );
        }
    }
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/all_bits.txt");
    let text = lines.join("\n") + "\n";
    if std::env::var_os("UPDATE_BITS").is_some() {
        std::fs::write(path, &text).unwrap();
    }
    let written = std::fs::read_to_string(path).unwrap();
    let changed: Vec<_> = lines.iter().filter(|line| !written.lines().any(|other| other == **line)).collect();
    assert!(changed.is_empty() && written == text, "bits have changed:\n{changed:#?}");
}
