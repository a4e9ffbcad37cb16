//! Curvatures of meshes, sections along edges and in directions, models: any sequence of calls on a topology.
#![no_main]
// Every call keeps the contract that the header states.
#![allow(clippy::undocumented_unsafe_blocks)]

use libfuzzer_sys::fuzz_target;
use umbilic::capi::*;
use umbilic_fuzz::curvature::{Asked, Outputs, given, vectors};
use umbilic_fuzz::weights::{model, small, weight};
use umbilic_fuzz::{Bytes, Handle, Input, Outcome, Placed, Run, Scene, Source, Struct, Target, Watch, zeroed};

const ALLOWED: [umb_status; 13] = [
    UMB_ERROR_NULL_POINTER,
    UMB_ERROR_STRUCT_SIZE,
    UMB_ERROR_UNKNOWN_FIELD,
    UMB_ERROR_UNKNOWN_CONSTANT,
    UMB_ERROR_STRIDE,
    UMB_ERROR_MISALIGNED,
    UMB_ERROR_SIZE,
    UMB_ERROR_INDEX_OUT_OF_RANGE,
    UMB_ERROR_NON_FINITE,
    UMB_ERROR_NOT_APPLICABLE,
    UMB_ERROR_OPTION_OUT_OF_RANGE,
    UMB_ERROR_OUT_OF_MEMORY,
    UMB_ERROR_CANCELLED,
];

fuzz_target!(|data: &[u8]| {
    let source = &mut Source::new(data);
    let scene = Scene::new(source, false);
    let Some(handle) = scene.handle() else { return };
    let more = if source.rarely() { source.below(4) } else { 0 };
    for _ in 0..=more {
        match source.below(8) {
            0 | 1 => sections(source, &scene, &handle, false),
            2 | 3 => sections(source, &scene, &handle, true),
            4 if source.may_be_slow(4) => learn(source, &scene, &handle),
            _ => curvatures(source, &scene, &handle),
        }
    }
});

/// The handle and the positions as arguments; null where a required pointer is to be missing.
fn subject(
    source: &mut Source<'_>,
    scene: &Scene,
    handle: &Handle,
) -> (*const umb_topology, Option<Placed<umb_points>>) {
    let of = if source.spoils() { std::ptr::null() } else { handle.pointer.cast_const() };
    let points = (!source.spoils()).then(|| Placed::new(source, &scene.points.points()));
    (of, points)
}

fn pointer<T: Copy>(placed: &Option<Placed<T>>) -> *const T {
    placed.as_ref().map_or(std::ptr::null(), |placed| placed.pointer().cast_const())
}

fn curvatures(source: &mut Source<'_>, scene: &Scene, handle: &Handle) {
    let count = handle.vertex_count;
    let watch = Watch::new(source);
    let run = Run::new(source, &watch, Some(count));
    let asked = Asked::new(source, count, scene.double);
    let mut options = asked.view;
    options.run = run.view;
    let (method, radius) = (options.method, options.radius);
    let options = Struct::new(source, &mut options, false);
    let outputs = Outputs::new(source, method, count, scene.double);
    let mut view = outputs.view();
    if source.spoils() {
        view.reserved = source.any_u32();
    }
    let view = if source.spoils() { Struct::null() } else { Struct::new(source, &mut view, false) };
    let outcome = Outcome::new(source);
    let (of, points) = subject(source, scene, handle);
    let status =
        unsafe { umb_curvatures(of, pointer(&points), options.pointer(), view.pointer(), outcome.pointer()) };
    watch.check(status);
    if !outcome.check("umb_curvatures", status, &ALLOWED) {
        assert!(outputs.are_untouched() || status == UMB_ERROR_CANCELLED, "outputs are written on status {status}");
        let refused = !source.is_hostile() && status != UMB_ERROR_CANCELLED;
        assert!(!refused, "method {method} with radius {radius} refuses sound input: {status}");
    }
    outputs.check_gaps(|vertex| run.asks_for(vertex));
    if status == UMB_OK {
        for vertex in (0..count).filter(|&vertex| run.asks_for(vertex)) {
            outputs.check(vertex, handle.flags()[vertex]);
        }
    }
}

fn sections(source: &mut Source<'_>, scene: &Scene, handle: &Handle, directions: bool) {
    let vertex_count = handle.vertex_count;
    let watch = Watch::new(source);
    let run = Run::new(source, &watch, Some(vertex_count));
    let (model, normals) = (model(source), given(source, scene.vertex_count, scene.double));
    let mut options: umb_section_options = zeroed();
    options.section = if source.spoils() { source.any_u32() } else { source.below(4) as u32 };
    options.weight = weight(source);
    (options.normal_degree, options.normal_rings) = (small(source, 4), small(source, 3));
    options.model = model.pointer();
    options.normals = normals.as_ref().map_or(zeroed(), Input::points);
    options.run = run.view;
    let shared = directions && source.half();
    let ways = directions.then(|| {
        let count = if shared { source.below(5) } else { vertex_count };
        let double = source.half();
        vectors(source, count, double)
    });
    if let Some(ways) = &ways {
        (options.directions, options.shared) = (ways.points(), shared as u32);
    }
    if source.spoils() {
        options.shared = 2 + source.any_u32() % 1000;
    }
    if !directions && source.spoils() {
        options.directions.count = source.number();
    }
    // The first section of each vertex, and the end of the last.
    let each = ways.as_ref().map_or(0, |ways| ways.count);
    let starts: Vec<usize> = match (directions, shared) {
        (false, _) => handle.ring_offsets().iter().map(|&start| start as usize).collect(),
        (true, false) => (0..=vertex_count).collect(),
        (true, true) if each < 1 << 10 => (0..=vertex_count).map(|vertex| vertex * each).collect(),
        (true, true) => vec![0; vertex_count + 1],
    };
    let count = starts[vertex_count];
    let null = directions && source.spoils();
    let options = if null { Struct::null() } else { Struct::new(source, &mut options, false) };

    let wanted = source.byte();
    let double = if wanted & 8 == 0 { scene.double } else { source.half() };
    let curvature = if wanted & 1 == 0 { Target::new(source, 1, count, double) } else { Target::none(source) };
    let normal = if wanted & 2 == 0 { Target::new(source, 3, vertex_count, double) } else { Target::none(source) };
    let status_bytes = Bytes::new(source, count, wanted & 4 == 0);
    let mut view: umb_section_outputs = zeroed();
    (view.curvature, view.normal, view.status) = (curvature.view(), normal.view(), status_bytes.view());
    if source.spoils() {
        view.reserved = source.any_u32();
    }
    let view = if source.spoils() { Struct::null() } else { Struct::new(source, &mut view, false) };
    let outcome = Outcome::new(source);
    let (of, points) = subject(source, scene, handle);
    let (points, options, view, error) = (pointer(&points), options.pointer(), view.pointer(), outcome.pointer());
    let (call, status) = unsafe {
        match directions {
            false => ("umb_edge_sections", umb_edge_sections(of, points, options, view, error)),
            true => ("umb_direction_sections", umb_direction_sections(of, points, options, view, error)),
        }
    };
    watch.check(status);
    if !outcome.check(call, status, &ALLOWED) {
        let untouched = curvature.is_untouched() && normal.is_untouched() && status_bytes.is_untouched();
        assert!(untouched || status == UMB_ERROR_CANCELLED, "outputs are written on status {status}");
        assert!(source.is_hostile() || status == UMB_ERROR_CANCELLED, "{call} refuses sound input: {status}");
    }
    let vertex_of = |section: usize| starts.partition_point(|&start| start <= section) - 1;
    curvature.check_gaps(|section| run.asks_for(vertex_of(section)), "curvature");
    status_bytes.check_gaps(|section| run.asks_for(vertex_of(section)), "status");
    normal.check_gaps(|vertex| run.asks_for(vertex), "normal");
    if status != UMB_OK {
        return;
    }
    for vertex in (0..vertex_count).filter(|&vertex| run.asks_for(vertex)) {
        if normal.is_wanted() {
            normal.unit(vertex, "normal");
        }
        for section in starts[vertex]..starts[vertex + 1] {
            let bits = status_bytes.element(section);
            assert!(bits.is_none_or(|bits| bits < 4), "status {bits:?} of section {section}");
            if curvature.is_wanted() {
                let [value, ..] = curvature.finite(section, "curvature");
                let none = bits.is_some_and(|bits| bits & UMB_SECTION_STATUS_NONE != 0);
                assert!(!none || value == 0.0, "curvature {value} of section {section}, which does not exist");
            }
        }
    }
}

fn learn(source: &mut Source<'_>, scene: &Scene, handle: &Handle) {
    let watch = Watch::new(source);
    let run = Run::new(source, &watch, None);
    let mut options: umb_normal_options = zeroed();
    options.run = run.view;
    options.weight = source.any_u32();
    (options.degree, options.rings) = (source.any_u32(), source.any_u32());
    let options = Struct::new(source, &mut options, false);
    let model = Struct::new(source, &mut zeroed::<umb_adaptive_model>(), false);
    let before = model.bytes().to_vec();
    let outcome = Outcome::new(source);
    let (of, points) = subject(source, scene, handle);
    let status =
        unsafe { umb_learn_model(of, pointer(&points), options.pointer(), model.pointer(), outcome.pointer()) };
    watch.check(status);
    if !outcome.check("umb_learn_model", status, &ALLOWED) {
        assert!(model.bytes() == before, "the model is written on status {status}");
        assert!(source.is_hostile() || status == UMB_ERROR_CANCELLED, "sound input is refused: {status}");
        return;
    }
    assert_eq!(model.bytes()[..4], before[..4], "struct_size changed");
    let whole = size_of::<umb_adaptive_model>();
    if model.bytes().len() < whole {
        return;
    }
    assert!(model.bytes()[whole..].iter().all(|&byte| byte == 0), "fields of a later version are not zero");
    // SAFETY: as many bytes as the model has, and valid for any.
    let mut found = unsafe { model.bytes().as_ptr().cast::<umb_adaptive_model>().read_unaligned() };
    found.struct_size = 0;
    let numbers = [found.edge_length, found.noise, found.sizes[0], found.sizes[1], found.sizes[2], found.sizes[3]];
    assert!(numbers.iter().all(|&x| x > 0.0 && x.is_finite()), "{numbers:?}");
    assert!(found.coordinates <= 1 && found.noise_exponent <= 2 && found.size_exponent <= 1);
    assert!(found.evidence.iter().all(|x| x.is_finite()) && found.reserved == 0);
    // What was learned can be handed in.
    let mut outputs: umb_normal_outputs = zeroed();
    let normal = Target::new(&mut Source::new(&[]), 3, handle.vertex_count, true);
    outputs.normal = normal.view();
    let mut options: umb_normal_options = zeroed();
    (options.weight, options.model) = (UMB_WEIGHT_ADAPTIVE_JET, &found);
    let error = std::ptr::null_mut();
    let status = unsafe { umb_vertex_normals(of, pointer(&points), &options, &outputs, error) };
    assert_eq!(status, UMB_OK, "a learned model is refused");
    for vertex in 0..handle.vertex_count {
        normal.unit(vertex, "normal");
    }
}
