//! Vertex normals of a topology and straight from faces, face normals, models.
#![no_main]
// Every call keeps the contract that the header states.
#![allow(clippy::undocumented_unsafe_blocks)]

use libfuzzer_sys::fuzz_target;
use umbilic::capi::*;
use umbilic_fuzz::weights::{model, small, weight};
use umbilic_fuzz::{Bytes, Handle, Outcome, Placed, Run, Scene, Source, Struct, Target, Watch, zeroed};

const VERTEX_NORMALS: [umb_status; 12] = [
    UMB_ERROR_NULL_POINTER,
    UMB_ERROR_STRUCT_SIZE,
    UMB_ERROR_UNKNOWN_FIELD,
    UMB_ERROR_UNKNOWN_CONSTANT,
    UMB_ERROR_STRIDE,
    UMB_ERROR_MISALIGNED,
    UMB_ERROR_SIZE,
    UMB_ERROR_INDEX_OUT_OF_RANGE,
    UMB_ERROR_NON_FINITE,
    UMB_ERROR_OPTION_OUT_OF_RANGE,
    UMB_ERROR_OUT_OF_MEMORY,
    UMB_ERROR_CANCELLED,
];
const FROM_FACES: [umb_status; 14] = {
    let mut all = [UMB_ERROR_OFFSETS; 14];
    let (vertex_normals, others) = all.split_at_mut(12);
    vertex_normals.copy_from_slice(&VERTEX_NORMALS);
    others[1] = UMB_ERROR_TOO_LARGE;
    all
};

fuzz_target!(|data: &[u8]| {
    let source = &mut Source::new(data);
    let kind = source.below(8);
    let mut scene = Scene::new(source, kind == 0);
    match kind {
        0 => {
            // More vertices than a topology may have are refused before any position is looked at.
            if source.spoils() {
                scene.points.count = (1 << 32) + source.any_u32() as usize;
            }
            vertex_normals(source, &scene, None);
        }
        1 => face_normals(source, &scene),
        _ => {
            let Some(handle) = scene.handle() else { return };
            let more = if source.rarely() { source.below(4) } else { 0 };
            for _ in 0..=more {
                vertex_normals(source, &scene, Some(&handle));
            }
        }
    }
});

/// A pointer to a value in a block of its own; null where a required pointer is to be missing.
macro_rules! required {
    ($source:expr, $placed:ident, $value:expr) => {
        let $placed = (!$source.spoils()).then(|| Placed::new($source, $value));
        let $placed = $placed.as_ref().map_or(std::ptr::null(), |placed| placed.pointer().cast_const());
    };
}

/// Of a topology, or straight from faces.
fn vertex_normals(source: &mut Source<'_>, scene: &Scene, handle: Option<&Handle>) {
    let vertex_count = match handle {
        Some(handle) => handle.vertex_count,
        None if scene.points.count < 1 << 16 => scene.points.count,
        None => 1,
    };
    let watch = Watch::new(source);
    let run = Run::new(source, &watch, Some(vertex_count));
    let model = model(source);
    let mut options: umb_normal_options = zeroed();
    options.weight = weight(source);
    options.run = run.view;
    options.degree = small(source, 4);
    let most = if source.rarely() { 8 } else { 3 };
    options.rings = small(source, most);
    options.model = model.pointer();
    let options = Struct::new(source, &mut options, false);

    let wanted = source.byte();
    let target = |source: &mut Source<'_>, bit: u8| match wanted & bit {
        0 => Target::none(source),
        _ => {
            let double = if wanted & 8 == 0 { scene.double } else { source.half() };
            Target::new(source, 3, vertex_count, double)
        }
    };
    let (normal, sum) = (target(source, !4), target(source, 2));
    let status_bytes = Bytes::new(source, vertex_count, wanted & 4 == 0);
    let mut outputs: umb_normal_outputs = zeroed();
    (outputs.normal, outputs.sum, outputs.status) = (normal.view(), sum.view(), status_bytes.view());
    if source.spoils() {
        outputs.reserved = source.any_u32();
    }
    let outputs = if source.spoils() { Struct::null() } else { Struct::new(source, &mut outputs, false) };
    let outcome = Outcome::new(source);
    required!(source, points, &scene.points.points());
    let (call, status, allowed) = match handle {
        Some(handle) => {
            let of = if source.spoils() { std::ptr::null() } else { handle.pointer.cast_const() };
            let status =
                unsafe { umb_vertex_normals(of, points, options.pointer(), outputs.pointer(), outcome.pointer()) };
            ("umb_vertex_normals", status, &VERTEX_NORMALS[..])
        }
        None => {
            required!(source, faces, &scene.faces.view);
            let (options, outputs, error) = (options.pointer(), outputs.pointer(), outcome.pointer());
            let status = unsafe { umb_vertex_normals_from_faces(faces, points, options, outputs, error) };
            ("umb_vertex_normals_from_faces", status, &FROM_FACES[..])
        }
    };
    watch.check(status);
    if !outcome.check(call, status, allowed) {
        let touched = !(normal.is_untouched() && sum.is_untouched() && status_bytes.is_untouched());
        assert!(!touched || status == UMB_ERROR_CANCELLED, "outputs are written on status {status}");
        assert!(source.is_hostile() || status == UMB_ERROR_CANCELLED, "{call} refuses sound input: {status}");
    }
    normal.check_gaps(|vertex| run.asks_for(vertex), "normal");
    sum.check_gaps(|vertex| run.asks_for(vertex), "sum");
    status_bytes.check_gaps(|vertex| run.asks_for(vertex), "status");
    if status != UMB_OK {
        return;
    }
    for vertex in (0..vertex_count).filter(|&vertex| run.asks_for(vertex)) {
        let found = normal.is_wanted().then(|| normal.unit(vertex, "normal"));
        if sum.is_wanted() {
            sum.finite(vertex, "sum");
        }
        if let Some(bits) = status_bytes.element(vertex) {
            let none = bits & (UMB_VERTEX_ISOLATED | UMB_VERTEX_DEGENERATE) != 0;
            assert!(found.is_none_or(|found| found != none), "vertex {vertex} has status {bits}");
            if let Some(handle) = handle {
                assert_eq!(bits & 15, handle.flags()[vertex], "status {bits} of vertex {vertex}");
            }
        }
    }
}

fn face_normals(source: &mut Source<'_>, scene: &Scene) {
    let face_count = scene.faces.face_count();
    let watch = Watch::new(source);
    let run = Run::new(source, &watch, None);
    let mut options: umb_face_options = zeroed();
    options.run = run.view;
    if source.spoils() {
        options.reserved = source.any_u32();
    }
    let options = Struct::new(source, &mut options, false);
    let wanted = source.byte();
    let target = |source: &mut Source<'_>, bit: u8| match wanted & bit {
        0 => Target::none(source),
        _ => {
            let double = source.half();
            Target::new(source, 3, face_count, double)
        }
    };
    let (normal, area) = (target(source, !4), target(source, 2));
    let status_bytes = Bytes::new(source, face_count, wanted & 4 == 0);
    let mut outputs: umb_face_outputs = zeroed();
    (outputs.normal, outputs.area_vector, outputs.status) = (normal.view(), area.view(), status_bytes.view());
    if source.spoils() {
        outputs.reserved = source.any_u32();
    }
    let outputs = if source.spoils() { Struct::null() } else { Struct::new(source, &mut outputs, false) };
    let outcome = Outcome::new(source);
    required!(source, points, &scene.points.points());
    required!(source, faces, &scene.faces.view);
    let status = unsafe { umb_face_normals(faces, points, options.pointer(), outputs.pointer(), outcome.pointer()) };
    watch.check(status);
    if !outcome.check("umb_face_normals", status, &FROM_FACES) {
        let touched = !(normal.is_untouched() && area.is_untouched() && status_bytes.is_untouched());
        assert!(!touched || status == UMB_ERROR_CANCELLED, "outputs are written on status {status}");
        assert!(source.is_hostile() || status == UMB_ERROR_CANCELLED, "sound input is refused: {status}");
    }
    normal.check_gaps(|_| true, "normal");
    area.check_gaps(|_| true, "area_vector");
    status_bytes.check_gaps(|_| true, "status");
    if status != UMB_OK {
        return;
    }
    for face in 0..face_count {
        let found = normal.is_wanted().then(|| normal.unit(face, "normal"));
        if area.is_wanted() {
            area.finite(face, "area_vector");
        }
        if let Some(bits) = status_bytes.element(face) {
            assert!(bits == 0 || bits == UMB_VERTEX_DEGENERATE);
            assert!(found.is_none_or(|found| found == (bits == 0)), "face {face} has status {bits}");
        }
    }
}
