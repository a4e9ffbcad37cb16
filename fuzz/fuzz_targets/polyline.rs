//! Curvatures of polylines.
#![no_main]
// Every call keeps the contract that the header states.
#![allow(clippy::undocumented_unsafe_blocks)]

use libfuzzer_sys::fuzz_target;
use umbilic::capi::*;
use umbilic_fuzz::coordinates::rows;
use umbilic_fuzz::{Bytes, Input, Outcome, Placed, Run, Source, Struct, Target, Watch, run, zeroed};

const ALLOWED: [umb_status; 10] = [
    UMB_ERROR_NULL_POINTER,
    UMB_ERROR_STRUCT_SIZE,
    UMB_ERROR_UNKNOWN_FIELD,
    UMB_ERROR_UNKNOWN_CONSTANT,
    UMB_ERROR_STRIDE,
    UMB_ERROR_MISALIGNED,
    UMB_ERROR_SIZE,
    UMB_ERROR_NON_FINITE,
    UMB_ERROR_OUT_OF_MEMORY,
    UMB_ERROR_CANCELLED,
];

fuzz_target!(|data: &[u8]| {
    let source = &mut Source::new(data);
    let count = if source.may_be_slow(run::SLOW) { source.below(9000) } else { source.below(24) };
    let natural: Vec<[f64; 3]> = natural(source, count);
    let double = source.half();
    let rows = rows(source, &natural, count, double);
    let dimension = source.pick(&[0, 2, 3]);
    let input = Input::new(source, &rows, if dimension == 2 { 2 } else { 3 }, double);
    let mut polyline = umb_polyline {
        data: input.data,
        count: input.count,
        stride: input.stride,
        scalar: input.scalar,
        dimension,
        closed: source.below(2) as u32,
        reserved: input.reserved,
    };
    if source.spoils() {
        polyline.closed = source.any_u32();
    }
    if source.spoils() {
        // The plane where the memory is of space, or what is neither.
        polyline.dimension = if source.half() { 2 } else { 4 + source.any_u32() % 1000 };
    }
    for _ in 0..=source.below(2) {
        call(source, &polyline);
    }
});

/// A spiral, or points on a line; runs of equal points.
fn natural(source: &mut Source<'_>, count: usize) -> Vec<[f64; 3]> {
    let line = source.rarely();
    let mut points: Vec<[f64; 3]> = Vec::with_capacity(count);
    for index in 0..count {
        let t = index as f64 * 0.4;
        points.push(if line { [t, 2.0 * t, 0.0] } else { [t.cos() * (1.0 + t), t.sin() * (1.0 + t), t] });
    }
    for _ in 0..source.below(5) {
        let most = if source.rarely() { 9000 } else { 8 };
        let (from, length) = (source.below(count.max(1)), source.below(most));
        if let Some(&point) = points.get(from) {
            points[from..].iter_mut().take(length).for_each(|other| *other = point);
        }
    }
    // There and back again: cusps.
    if source.rarely() {
        let back: Vec<_> = points.iter().rev().copied().collect();
        let half = count / 2;
        points[count - half..].copy_from_slice(&back[count - half..]);
    }
    points
}

fn call(source: &mut Source<'_>, polyline: &umb_polyline) {
    let count = if polyline.count < 1 << 16 { polyline.count } else { 1 };
    let watch = Watch::new(source);
    let run = Run::new(source, &watch, None);
    let mut options: umb_polyline_options = zeroed();
    options.run = run.view;
    if source.spoils() {
        options.reserved = source.any_u32();
    }
    let options = Struct::new(source, &mut options, false);
    let wanted = source.byte();
    let mut targets = [(); 4].map(|()| Target::none(source));
    for (bit, target) in targets.iter_mut().enumerate() {
        if wanted & 1 << bit == 0 {
            let double = source.half();
            *target = Target::new(source, 1, count, double);
        }
    }
    let status_bytes = Bytes::new(source, count, wanted & 16 == 0);
    let mut outputs: umb_polyline_outputs = zeroed();
    [outputs.circle, outputs.parabola, outputs.length_parabola, outputs.symmetric_parabola] =
        [0, 1, 2, 3].map(|index: usize| targets[index].view());
    outputs.status = status_bytes.view();
    if source.spoils() {
        outputs.reserved = source.any_u32();
    }
    let outputs = if source.spoils() { Struct::null() } else { Struct::new(source, &mut outputs, false) };
    let outcome = Outcome::new(source);
    let placed = (!source.spoils()).then(|| Placed::new(source, polyline));
    let pointer = placed.as_ref().map_or(std::ptr::null(), |placed| placed.pointer().cast_const());
    let status = unsafe { umb_polyline_curvatures(pointer, options.pointer(), outputs.pointer(), outcome.pointer()) };
    watch.check(status);
    if !outcome.check("umb_polyline_curvatures", status, &ALLOWED) {
        let untouched = targets.iter().all(Target::is_untouched) && status_bytes.is_untouched();
        assert!(untouched || status == UMB_ERROR_CANCELLED, "outputs are written on status {status}");
        assert!(source.is_hostile() || status == UMB_ERROR_CANCELLED, "sound input is refused: {status}");
    }
    for target in &targets {
        target.check_gaps(|_| true, "curvature");
    }
    status_bytes.check_gaps(|_| true, "status");
    if status != UMB_OK {
        return;
    }
    for index in 0..count {
        let bits = status_bytes.element(index);
        assert!(bits.is_none_or(|bits| bits < 8), "status {bits:?} of point {index}");
        for target in targets.iter().filter(|target| target.is_wanted()) {
            let [value, ..] = target.finite(index, "curvature");
            assert!(polyline.dimension == 2 || value >= 0.0, "curvature {value} in space, point {index}");
            let end = bits.is_some_and(|bits| bits & UMB_POLYLINE_END != 0);
            assert!(!end || value == 0.0, "curvature {value} at an end, point {index}");
        }
    }
}
