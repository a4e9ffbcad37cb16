//! Cut meshes and corner normals, shape classes, segmentations, lists of what moved: any sequence of calls on one mesh, compared with
//! the naive segmentations of the tests and with results from scratch.
#![no_main]
// Every call keeps the contract that the header states.
#![allow(clippy::undocumented_unsafe_blocks)]

#[path = "segmentation/affected.rs"]
mod affected;
#[path = "../../tests/common/mod.rs"]
mod common;
#[path = "segmentation/cuts.rs"]
mod cuts;
#[path = "segmentation/segments.rs"]
mod segments;
#[path = "segmentation/shapes.rs"]
mod shapes;

use libfuzzer_sys::fuzz_target;
use umbilic::capi::*;
use umbilic_fuzz::{Placed, Scene, Source};

/// What a call with faces, points and options may answer.
const FROM_FACES: [umb_status; 15] = [
    UMB_ERROR_NULL_POINTER,
    UMB_ERROR_STRUCT_SIZE,
    UMB_ERROR_UNKNOWN_FIELD,
    UMB_ERROR_UNKNOWN_CONSTANT,
    UMB_ERROR_STRIDE,
    UMB_ERROR_MISALIGNED,
    UMB_ERROR_SIZE,
    UMB_ERROR_OFFSETS,
    UMB_ERROR_INDEX_OUT_OF_RANGE,
    UMB_ERROR_NON_FINITE,
    UMB_ERROR_OPTION_OUT_OF_RANGE,
    UMB_ERROR_TOO_LARGE,
    UMB_ERROR_OUT_OF_MEMORY,
    UMB_ERROR_CANCELLED,
    UMB_ERROR_NOT_APPLICABLE,
];

fuzz_target!(|data: &[u8]| {
    let source = &mut Source::new(data);
    let scene = Scene::new(source, true);
    let more = if source.rarely() { source.below(4) } else { 0 };
    for _ in 0..=more {
        match source.below(10) {
            0 | 1 => cuts::cut(source, &scene),
            2 => cuts::corners_from_faces(source, &scene),
            3 => shapes::classes(source, &scene),
            4 => segments::features(source, &scene),
            5 => segments::watershed(source, &scene),
            6 => segments::regions(source, &scene),
            7 => affected::lists(source, &scene),
            _ => affected::updates(source, &scene),
        }
    }
});

/// A value in a block of its own; none where a required pointer is to be missing.
fn placed<T: Copy>(source: &mut Source<'_>, value: &T) -> Option<Placed<T>> {
    (!source.spoils()).then(|| Placed::new(source, value))
}

fn pointer<T: Copy>(placed: &Option<Placed<T>>) -> *const T {
    placed.as_ref().map_or(std::ptr::null(), |placed| placed.pointer().cast_const())
}

/// Where a call writes a handle or a number, filled so that it can be seen whether it has.
fn receiver<T: Copy>(source: &mut Source<'_>, before: T) -> (Placed<T>, *mut T) {
    let place = Placed::new(source, &before);
    let to = if source.spoils() { std::ptr::null_mut() } else { place.pointer() };
    (place, to)
}

/// A pointer that is no handle.
fn nobody<T>() -> *mut T {
    std::ptr::without_provenance_mut(0x5a5a)
}

/// The scene's positions as calls read them that look at the faces first: rarely more than a mesh may have.
fn points(source: &mut Source<'_>, scene: &Scene) -> umb_points {
    let mut points = scene.points.points();
    if source.spoils() {
        points.count = (1 << 32) + source.any_u32() as usize;
    }
    points
}

/// The number of positions, at most so many that results fit into memory.
fn point_count(scene: &Scene) -> usize {
    if scene.points.count < 1 << 16 { scene.points.count } else { 1 }
}
