//! The same results by every way: vectors, threads, lists of vertices, models, strides, types of indices, with a topology or
//! without; and normals against the naive oracle of the tests.
#![no_main]
// Every call keeps the contract that the header states.
#![allow(clippy::undocumented_unsafe_blocks)]

#[path = "../../tests/common/mod.rs"]
mod common;

use common::oracle::Oracle;
use libfuzzer_sys::fuzz_target;
use umbilic::Weight;
use umbilic::capi::*;
use umbilic_fuzz::coordinates::rows;
use umbilic_fuzz::curvature::{Outputs, method};
use umbilic_fuzz::weights::{small, weight};
use umbilic_fuzz::{Bytes, FaceArrays, Input, Shape, Source, Target, run, zeroed};

/// What is computed.
enum Task {
    Normals { sums: bool },
    Curvatures { outputs: Vec<u8> },
    EdgeSections,
    DirectionSections { directions: Input },
}

/// What a call wrote, array by array: the bits of its elements, none where it was not asked for one.
type Results = Vec<Vec<Option<[u64; 3]>>>;

/// A way to the results.
#[derive(Clone, Copy)]
struct Way<'a> {
    name: &'static str,
    threads: u32,
    simd: umb_simd,
    list: Option<&'a [u32]>,
    model: *const umb_adaptive_model,
}

/// A mesh, what is asked of it, and with which options.
struct Case {
    shape: Shape,
    rows: Vec<[f64; 3]>,
    double: bool,
    task: Task,
    weight: umb_weight,
    method: umb_curvature_method,
    section: umb_section,
    degree: u32,
    rings: u32,
    radius: f64,
}

/// Calls with everything packed draw their layouts from here.
fn plain() -> Source<'static> {
    Source::new(&[])
}

fuzz_target!(|data: &[u8]| {
    // Sound input only.
    let mut bytes = data.to_vec();
    if let Some(first) = bytes.first_mut() {
        *first &= 0xfe;
    }
    let source = &mut Source::new(&bytes);
    let case = case(source);
    let faces = FaceArrays::new(&mut plain(), &case.shape, false);
    let points = Input::new(&mut plain(), &case.rows, 3, case.double);
    let handle = Topology::new(&faces, case.shape.vertex_count, 1, UMB_SIMD_PORTABLE);
    let base = Way { name: "portable", threads: 1, simd: UMB_SIMD_PORTABLE, list: None, model: std::ptr::null() };
    let expected = case.run(Some(&handle), &faces, &points, base, &mut plain());

    for (name, simd) in [("SSE2", UMB_SIMD_SSE2), ("AVX2", UMB_SIMD_AVX2), ("AVX-512", UMB_SIMD_AVX512)] {
        let found = case.run(Some(&handle), &faces, &points, Way { name, simd, ..base }, &mut plain());
        compare(&found, &expected, name);
    }
    let simd = source.below(5) as umb_simd;
    let count = case.shape.vertex_count;
    let list: Vec<u32> = (0..source.below(10)).map(|_| source.below(count.max(1)) as u32).collect();
    if count > 0 {
        let way = Way { name: "a list of vertices", simd, list: Some(&list), ..base };
        compare(&case.run(Some(&handle), &faces, &points, way, &mut plain()), &expected, way.name);
    }
    if count > 2048 {
        let way = Way { name: "threads", threads: 2 + source.below(3) as u32, simd, ..base };
        compare(&case.run(Some(&handle), &faces, &points, way, &mut plain()), &expected, way.name);
    }
    // Other faces: types of indices, offsets instead of corners; another handle; other strides, in and out.
    let other_faces = FaceArrays::new(source, &case.shape, false);
    let other_points = Input::new(source, &case.rows, 3, case.double);
    let other = Topology::new(&other_faces, count, 1 + source.below(3) as u32, source.below(5) as umb_simd);
    let way = Way { name: "strides and another handle", simd, ..base };
    compare(&case.run(Some(&other), &other_faces, &other_points, way, source), &expected, way.name);
    if let Task::Normals { .. } = case.task {
        let way = Way { name: "straight from faces", simd, ..base };
        compare(&case.run(None, &other_faces, &points, way, &mut plain()), &expected, way.name);
        if source.byte() < 48 {
            against_oracle(&case, &expected);
        }
    }
    if case.is_adaptive() {
        let mut model: umb_adaptive_model = zeroed();
        let (view, none) = (points.points(), std::ptr::null());
        let status = unsafe { umb_learn_model(handle.0, &view, none, &mut model, std::ptr::null_mut()) };
        assert_eq!(status, UMB_OK);
        let way = Way { name: "a model learned before", simd, model: &model, ..base };
        compare(&case.run(Some(&handle), &faces, &points, way, &mut plain()), &expected, way.name);
    }
});

fn case(source: &mut Source<'_>) -> Case {
    let double = source.half();
    let mut shape = Shape::new(source);
    let mut rows = rows(source, &shape.positions, shape.vertex_count, double);
    if source.may_be_slow(4 * run::SLOW) && shape.vertex_count > 8 {
        repeat(&mut shape, &mut rows);
    }
    if !double {
        rows.as_flattened_mut().iter_mut().for_each(|x| *x = *x as f32 as f64);
    }
    let task = match source.below(8) {
        0..4 => Task::Normals { sums: source.half() },
        4 => Task::EdgeSections,
        5 => {
            let (count, double) = (shape.vertex_count, source.half());
            let directions: Vec<[f64; 3]> = (0..count).map(|_| [0.3, source.byte() as f64 - 99.0, 1.0]).collect();
            Task::DirectionSections { directions: Input::new(&mut plain(), &directions, 3, double) }
        }
        _ => Task::Curvatures { outputs: (0..40).map(|_| source.byte()).collect() },
    };
    let method = method(source);
    let measure = matches!(method, UMB_CURVATURE_NORMAL_CYCLE | UMB_CURVATURE_CORRECTED_MEASURE);
    let radius = if measure && source.half() { source.byte() as f64 / 64.0 } else { 0.0 };
    let several = method <= UMB_CURVATURE_GOLDFEATHER || measure && radius == 0.0;
    let curvature = matches!(task, Task::Curvatures { .. });
    Case {
        shape,
        rows,
        double,
        task,
        weight: weight(source),
        section: source.below(4) as u32,
        degree: if curvature { source.pick(&[0, 2, 3, 4]) } else { small(source, 4) },
        rings: if several || !curvature { small(source, 3) } else { 0 },
        method,
        radius,
    }
}

/// The mesh so many times that threads share the work, each time a little larger.
fn repeat(shape: &mut Shape, rows: &mut Vec<[f64; 3]>) {
    let (vertices, corners, faces) = (shape.vertex_count, shape.indices.len(), shape.face_count());
    for copy in 1..=2600 / vertices {
        for vertex in 0..vertices {
            rows.push(rows[vertex].map(|x| x * 0.9f64.powi(copy as i32 % 7)));
        }
        for corner in 0..corners {
            shape.indices.push(shape.indices[corner] + (copy * vertices) as u32);
        }
        for face in 1..=faces {
            shape.offsets.push(shape.offsets[face] + (copy * corners) as u32);
        }
    }
    shape.vertex_count = rows.len();
}

struct Topology(*mut umb_topology);

impl Topology {
    fn new(faces: &FaceArrays, vertex_count: usize, threads: u32, simd: umb_simd) -> Topology {
        let mut options: umb_topology_options = zeroed();
        (options.threads, options.simd) = (threads, simd);
        let mut handle = std::ptr::null_mut();
        let error = std::ptr::null_mut();
        let status = unsafe { umb_topology_create(&faces.view, vertex_count, &options, &mut handle, error) };
        assert_eq!(status, UMB_OK);
        Topology(handle)
    }
}

impl Drop for Topology {
    fn drop(&mut self) {
        unsafe { umb_topology_destroy(self.0) };
    }
}

impl Case {
    fn is_adaptive(&self) -> bool {
        match self.task {
            Task::Curvatures { .. } => {
                self.method == UMB_CURVATURE_ADAPTIVE_JET || self.weight == UMB_WEIGHT_ADAPTIVE_JET
            }
            _ => self.weight == UMB_WEIGHT_ADAPTIVE_JET,
        }
    }

    /// Computes it, with outputs laid out by `layout`.
    fn run(
        &self,
        handle: Option<&Topology>,
        faces: &FaceArrays,
        points: &Input,
        way: Way<'_>,
        layout: &mut Source<'_>,
    ) -> Results {
        let count = self.shape.vertex_count;
        let mut run: umb_run = zeroed();
        (run.threads, run.simd) = (way.threads, way.simd);
        if let Some(list) = way.list {
            (run.vertices, run.vertex_count) = (list.as_ptr(), list.len());
        }
        let topology = handle.map_or(std::ptr::null(), |handle| handle.0.cast_const());
        let (points, none) = (points.points(), std::ptr::null_mut());
        let asked = |vertex: usize| way.list.is_none_or(|list| list.contains(&(vertex as u32)));
        let vertices: Vec<bool> = (0..count).map(asked).collect();
        match &self.task {
            Task::Normals { sums } => {
                let normal = Target::new(layout, 3, count, self.double);
                let sum = if *sums { Target::new(layout, 3, count, self.double) } else { Target::none(layout) };
                let status_bytes = Bytes::new(layout, count, true);
                let mut options: umb_normal_options = zeroed();
                (options.weight, options.run, options.model) = (self.weight, run, way.model);
                (options.degree, options.rings) = (self.degree, self.rings);
                let mut outputs: umb_normal_outputs = zeroed();
                (outputs.normal, outputs.sum, outputs.status) = (normal.view(), sum.view(), status_bytes.view());
                let status = match handle {
                    Some(_) => unsafe { umb_vertex_normals(topology, &points, &options, &outputs, none) },
                    None => unsafe { umb_vertex_normals_from_faces(&faces.view, &points, &options, &outputs, none) },
                };
                assert_eq!(status, UMB_OK, "{}", way.name);
                vec![read(&normal, &vertices), read(&sum, &vertices), read_bytes(&status_bytes, &vertices)]
            }
            Task::Curvatures { outputs } => {
                let mut chosen = vec![0; 1];
                chosen.extend_from_slice(outputs);
                // The choice of outputs is the same by every way, where they lie is not.
                let found = Outputs::laid_out(&mut Source::new(&chosen), layout, self.method, count, self.double);
                let mut options: umb_curvature_options = zeroed();
                (options.method, options.section, options.weight) = (self.method, self.section, self.weight);
                options.degree = if self.method == UMB_CURVATURE_JET { self.degree } else { 0 };
                (options.rings, options.radius) = (self.rings, self.radius);
                (options.model, options.run) = (way.model, run);
                let status = unsafe { umb_curvatures(topology, &points, &options, &found.view(), none) };
                assert_eq!(status, UMB_OK, "{}, method {}", way.name, self.method);
                let mut results: Results = found.targets().map(|target| read(target, &vertices)).collect();
                results.push(read_bytes(found.status(), &vertices));
                results
            }
            Task::EdgeSections | Task::DirectionSections { .. } => {
                let offsets = unsafe { std::slice::from_raw_parts(umb_topology_ring_offsets(topology), count + 1) };
                let edges = matches!(self.task, Task::EdgeSections);
                let sections = if edges { offsets[count] as usize } else { count };
                let curvature = Target::new(layout, 1, sections, self.double);
                let normal = Target::new(layout, 3, count, self.double);
                let status_bytes = Bytes::new(layout, sections, true);
                let mut options: umb_section_options = zeroed();
                (options.section, options.weight, options.run) = (self.section, self.weight, run);
                (options.normal_degree, options.normal_rings) = (self.degree, self.rings);
                options.model = way.model;
                let mut outputs: umb_section_outputs = zeroed();
                (outputs.curvature, outputs.normal) = (curvature.view(), normal.view());
                outputs.status = status_bytes.view();
                let status = match &self.task {
                    Task::DirectionSections { directions } => {
                        options.directions = directions.points();
                        unsafe { umb_direction_sections(topology, &points, &options, &outputs, none) }
                    }
                    _ => unsafe { umb_edge_sections(topology, &points, &options, &outputs, none) },
                };
                assert_eq!(status, UMB_OK, "{}", way.name);
                let of_vertex =
                    |vertex: usize| if edges { (offsets[vertex + 1] - offsets[vertex]) as usize } else { 1 };
                let asked = (0..count).flat_map(|vertex| vec![vertices[vertex]; of_vertex(vertex)]);
                let asked: Vec<bool> = asked.collect();
                vec![read(&curvature, &asked), read(&normal, &vertices), read_bytes(&status_bytes, &asked)]
            }
        }
    }
}

/// The bits of the elements that were asked for; nothing else may have been written.
fn read(target: &Target, asked: &[bool]) -> Vec<Option<[u64; 3]>> {
    if !target.is_wanted() {
        return vec![];
    }
    target.check_gaps(|element| asked[element], "an output");
    let bits = |element: usize| target.element(element).map(f64::to_bits);
    asked.iter().enumerate().map(|(element, &asked)| asked.then(|| bits(element))).collect()
}

fn read_bytes(bytes: &Bytes, asked: &[bool]) -> Vec<Option<[u64; 3]>> {
    bytes.check_gaps(|element| asked[element], "statuses");
    let bits = |element: usize| [bytes.element(element).map_or(0, u64::from), 0, 0];
    asked.iter().enumerate().map(|(element, &asked)| asked.then(|| bits(element))).collect()
}

fn compare(found: &Results, expected: &Results, way: &str) {
    assert_eq!(found.len(), expected.len());
    for (array, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert_eq!(found.len(), expected.len());
        for (element, (found, expected)) in found.iter().zip(expected).enumerate() {
            if found.is_some() && found != expected {
                let numbers = |bits: &Option<[u64; 3]>| bits.unwrap_or_default().map(f64::from_bits);
                let (a, b) = (numbers(found), numbers(expected));
                panic!(
                    "by {way}, array {array}, element {element}: {a:?} ({found:x?}) instead of {b:?} ({expected:x?})"
                );
            }
        }
    }
}

/// Compares normals by averages over one ring with the oracle's, where that is well-conditioned, as `tests/oracle.rs` does.
fn against_oracle(case: &Case, found: &Results) {
    // The oracle scales nothing.
    let moderate = |x: f64| x == 0.0 || (1e-20..1e10).contains(&x.abs());
    let Some(&weight) = Weight::ALL.get(case.weight as usize).filter(|_| case.weight < 10) else { return };
    if !case.rows.as_flattened().iter().all(|&x| moderate(x)) || case.shape.vertex_count > 500 {
        return;
    }
    let Shape { offsets, indices, .. } = case.shape.clone();
    let mesh = common::mesh::Mesh { name: String::new(), positions: case.rows.clone(), offsets, indices };
    let oracle = Oracle::new(&mesh);
    let (most, tolerance) = if case.double { (1e-13 / f64::EPSILON / 8.0, 1e-13) } else { (1e9, 2e-6) };
    for (vertex, found) in found[0].iter().enumerate() {
        // The oracle has no angle beside an edge without length, for which the library makes one up.
        let edges = oracle.corners(vertex).iter().flat_map(|corner| [corner.next, corner.prev]);
        let (short, long) = edges.fold((f64::INFINITY, 0.0f64), |(short, long), other| {
            let edge = common::length(common::sub(mesh.positions[other as usize], mesh.positions[vertex]));
            (short.min(edge), long.max(edge))
        });
        if short <= 1e-12 * long || is_ambiguous(&oracle, vertex) {
            continue;
        }
        let answer = oracle.normal(vertex, weight);
        let Some(found) = found.filter(|_| answer.condition < most) else { continue };
        let found = found.map(f64::from_bits);
        let difference = common::largest_difference(found, answer.normal);
        assert!(
            difference <= tolerance,
            "weight {}, vertex {vertex}: {found:?} where the oracle has {:?}, {difference:e} off, condition {:e}",
            case.weight,
            answer.normal,
            answer.condition
        );
    }
}

/// Whether rounding says what a face counts for: two faces are opposite, so that an edge between them has no normal; or a corner of a
/// polygon stands upright on its normal, so that it is as much reflex as not.
fn is_ambiguous(oracle: &Oracle<'_>, vertex: usize) -> bool {
    let measured: Vec<_> = oracle.corners(vertex).iter().map(|corner| oracle.measure(vertex, corner)).collect();
    let upright = measured.iter().any(|(a, b, _, normal, _)| {
        let turned = common::cross(*a, *b);
        common::dot(turned, *normal).abs() <= 1e-9 * common::length(turned)
    });
    let opposite = measured.iter().enumerate().any(|(index, (.., a, _))| {
        measured[..index].iter().any(|(.., b, _)| common::length(common::add(*a, *b)) < 1e-6)
    });
    upright || opposite
}
