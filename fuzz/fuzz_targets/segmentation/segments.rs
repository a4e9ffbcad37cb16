//! The three segmentations, and sums over segments.

use super::common::mesh::Mesh;
use super::common::segment_oracle::{Meeting, angle, area_vector, meeting};
use super::common::{length, sub};
use super::{FROM_FACES, nobody, placed, point_count, pointer, points, receiver};
use std::f64::consts::PI;
use umbilic::capi::*;
use umbilic_fuzz::curvature::Asked;
use umbilic_fuzz::parts::{Creases, located, scalars};
use umbilic_fuzz::structs::Versioned;
use umbilic_fuzz::{Block, Input, List, Outcome, Placed, Run, Scene, Source, Struct, Watch, zeroed};

const SUMS: [umb_status; 10] = [
    UMB_ERROR_NULL_POINTER,
    UMB_ERROR_UNKNOWN_FIELD,
    UMB_ERROR_UNKNOWN_CONSTANT,
    UMB_ERROR_STRIDE,
    UMB_ERROR_MISALIGNED,
    UMB_ERROR_SIZE,
    UMB_ERROR_OFFSETS,
    UMB_ERROR_INDEX_OUT_OF_RANGE,
    UMB_ERROR_NON_FINITE,
    UMB_ERROR_OUT_OF_MEMORY,
];

/// A segmentation that frees itself.
struct Segments(*mut umb_segmentation);

impl Segments {
    fn count(&self) -> usize {
        unsafe { umb_segmentation_count(self.0) }
    }

    fn labels(&self) -> &[u32] {
        unsafe { std::slice::from_raw_parts(umb_segmentation_labels(self.0), umb_segmentation_face_count(self.0)) }
    }

    fn boundary(&self) -> &[[u32; 2]] {
        unsafe {
            let count = umb_segmentation_boundary_edge_count(self.0);
            std::slice::from_raw_parts(umb_segmentation_boundary_edges(self.0).cast(), count)
        }
    }
}

impl Drop for Segments {
    fn drop(&mut self) {
        unsafe { umb_segmentation_destroy(self.0) };
    }
}

/// Options of a function that makes a segmentation.
trait Kind: Versioned {
    const NAME: &str;
    const CALL: unsafe extern "C" fn(
        *const umb_faces,
        *const umb_points,
        *const Self,
        *mut *mut umb_segmentation,
        *mut umb_error,
    ) -> umb_status;

    fn run(&mut self) -> &mut umb_run;
}

macro_rules! kinds {
    ($($options:ty: $call:ident;)*) => {$(
        impl Kind for $options {
            const NAME: &str = stringify!($call);
            const CALL: unsafe extern "C" fn(
                *const umb_faces,
                *const umb_points,
                *const Self,
                *mut *mut umb_segmentation,
                *mut umb_error,
            ) -> umb_status = $call;

            fn run(&mut self) -> &mut umb_run {
                &mut self.run
            }
        }
    )*};
}
kinds! {
    umb_feature_options: umb_segment_features;
    umb_watershed_options: umb_segment_watershed;
    umb_region_options: umb_segment_regions;
}

/// What a call found, the faces that it was told of and how they meet.
struct Found {
    segments: Segments,
    mesh: Mesh,
    meeting: Meeting,
}

/// Makes a segmentation and checks what holds of any; `options` are as the library sees them. `excused`: it must be refused.
fn segment<T: Kind>(
    source: &mut Source<'_>,
    scene: &Scene,
    mut options: T,
    given: &Struct<T>,
    view: umb_points,
    watch: &Watch,
    excused: bool,
) -> Option<Found> {
    let name = T::NAME;
    let (place, to) = receiver(source, nobody::<umb_segmentation>());
    let (faces, points) = (placed(source, &scene.faces.view), placed(source, &view));
    let outcome = Outcome::new(source);
    let status = unsafe { T::CALL(pointer(&faces), pointer(&points), given.pointer(), to, outcome.pointer()) };
    watch.check(status);
    let success = outcome.check(name, status, &FROM_FACES);
    assert_eq!(success, place.read() != nobody(), "status {status}");
    let refused = !success && !excused && status != UMB_ERROR_CANCELLED;
    assert!(!refused || source.is_hostile(), "{name} refuses sound input: {status}");
    assert!(!(success && excused), "{name} goes by what its method has not");
    let segments = success.then(|| Segments(place.read()))?;
    let listed = options.run();
    assert!(listed.vertices.is_null() && listed.vertex_count == 0, "a list of vertices is taken");
    let (offsets, indices) = scene.faces.read();
    let mesh = Mesh { name: String::new(), positions: vec![], offsets, indices };
    let meeting = meeting(&mesh);
    check(&segments, &meeting, view.count);
    if source.byte() < 64 {
        let run = options.run();
        (run.threads, run.simd) = (if source.may_be_slow(8) { 3 } else { 1 }, source.below(5) as u32);
        run.progress = None;
        let mut again = std::ptr::null_mut();
        let status =
            unsafe { T::CALL(pointer(&faces), pointer(&points), &options, &mut again, std::ptr::null_mut()) };
        assert_eq!(status, UMB_OK, "the same is refused");
        let again = Segments(again);
        assert_eq!(again.labels(), segments.labels());
        assert_eq!(again.boundary(), segments.boundary());
    }
    for _ in 0..source.below(3) {
        sums(source, scene, &segments);
    }
    Some(Found { segments, mesh, meeting })
}

/// Checks labels and boundary edges against the faces.
fn check(segments: &Segments, meeting: &Meeting, vertex_count: usize) {
    let (labels, count) = (segments.labels(), segments.count());
    assert_eq!(labels.len(), meeting.neighbours.len());
    let mut next = 0;
    for (face, (&label, neighbours)) in labels.iter().zip(&meeting.neighbours).enumerate() {
        assert_eq!(label == UMB_NO_SEGMENT, neighbours.is_none(), "face {face}");
        if label != UMB_NO_SEGMENT {
            assert!(label <= next, "face {face} has label {label}, where {next} is the next");
            next = next.max(label + 1);
        }
    }
    assert_eq!(next as usize, count);
    assert_eq!(meeting.components(|face, other, _| labels[face] == labels[other]), labels, "not connected");
    assert_eq!(segments.boundary(), meeting.boundary(labels));
    for &[low, high] in segments.boundary() {
        assert!(low < high && (high as usize) < vertex_count, "edge {low} {high}");
    }
    unsafe {
        let null = std::ptr::null();
        assert!(umb_segmentation_labels(null).is_null() && umb_segmentation_boundary_edges(null).is_null());
        assert!(umb_segmentation_count(null) == 0 && umb_segmentation_face_count(null) == 0);
        assert_eq!(umb_segmentation_boundary_edge_count(null), 0);
        umb_segmentation_destroy(std::ptr::null_mut());
    }
}

/// The mesh with the positions that a sound input has.
fn placed_mesh(source: &Source<'_>, scene: &Scene, mesh: &Mesh) -> Option<Mesh> {
    // The oracle scales nothing.
    let moderate = |x: f64| x == 0.0 || (1e-20..1e10).contains(&x.abs());
    let rounded = |x: f64| if scene.double { x } else { x as f32 as f64 };
    let positions: Vec<[f64; 3]> = scene.rows.iter().map(|row| row.map(rounded)).collect();
    let sound = !source.is_hostile() && positions.as_flattened().iter().all(|&x| moderate(x));
    sound.then(|| Mesh { positions, ..mesh.clone() })
}

/// What the area of a face is compared with: how large the products are that it is a sum of.
fn size(mesh: &Mesh, face: usize) -> f64 {
    let corners: Vec<[f64; 3]> = mesh.face(face).iter().map(|&vertex| mesh.positions[vertex as usize]).collect();
    let arms: Vec<f64> = corners.iter().map(|&corner| length(sub(corner, corners[0]))).collect();
    arms.windows(2).map(|pair| pair[0] * pair[1]).sum()
}

pub fn features(source: &mut Source<'_>, scene: &Scene) {
    let creases = Creases::new(source, scene);
    let watch = Watch::new(source);
    let run = Run::new(source, &watch, None);
    let mut options: umb_feature_options = zeroed();
    (options.creases, options.run) = (creases.pointer(), run.view);
    if source.spoils() {
        options.reserved = source.any_u32();
    }
    let view = Struct::new(source, &mut options, false);
    let points = points(source, scene);
    let found = segment(source, scene, options, &view, points, &watch, false);
    let Some(Found { segments, mesh, meeting }) = found else { return };
    creases.check_accepted(points.count, segments.labels().len());
    let most = creases.angle();
    let mesh = match placed_mesh(source, scene, &mesh) {
        Some(mesh) => mesh,
        None if most >= PI && !source.is_hostile() => mesh,
        None => return,
    };
    let (edges, groups) = (creases.edges(), creases.groups());
    // Where rounding says how sharp an edge is, or whether a face has an area, nothing is known.
    let clear = |face: usize| length(area_vector(&mesh, face)) > 1e-4 * size(&mesh, face);
    let all_clear = || {
        meeting.neighbours.iter().enumerate().all(|(face, others)| {
            others.as_ref().is_none_or(|others| {
                clear(face) && others.iter().all(|&(other, _)| (angle(&mesh, face, other) - most).abs() > 1e-5)
            })
        })
    };
    if most < PI && !all_clear() {
        return;
    }
    let expected = meeting.components(|face, other, edge| {
        (most >= PI || angle(&mesh, face, other) <= most)
            && !edges.contains(&edge)
            && groups.is_none_or(|groups| groups[face] == groups[other] && groups[face] != 0)
    });
    assert_eq!(segments.labels(), expected, "creases sharper than {most}");
}

/// Curvatures that a segmentation asks for, with a `run` that nobody may look at; or none, which are the dearest.
fn curvature(source: &mut Source<'_>, scene: &Scene) -> (Option<Asked>, Struct<umb_curvature_options>) {
    if source.may_be_slow(32) && source.half() {
        return (None, Struct::null());
    }
    let asked = Asked::new(source, point_count(scene), scene.double);
    let mut options = asked.view;
    options.run.threads = source.number();
    (options.run.simd, options.run.vertex_count) = (source.number(), source.number());
    (options.run.vertices, options.run.user) = (nobody(), nobody());
    let view = Struct::new(source, &mut options, false);
    (Some(asked), view)
}

/// Whether a method has neither curvedness nor principal curvatures.
fn has_neither(asked: &Option<Asked>) -> bool {
    asked.as_ref().is_some_and(|asked| asked.view.method == UMB_CURVATURE_ANGLE_DEFECT)
}

pub fn watershed(source: &mut Source<'_>, scene: &Scene) {
    let watch = Watch::new(source);
    let run = Run::new(source, &watch, None);
    let location = source.below(2) as u32;
    let height = (source.byte() >= 64).then(|| {
        let count = if location == UMB_AT_FACES { scene.faces.face_count() } else { point_count(scene) };
        scalars(source, count)
    });
    let placed_height = height.as_ref().map(|height| Placed::new(source, &located(height, location)));
    let (asked, curvature) =
        if height.is_none() || source.rarely() { curvature(source, scene) } else { (None, Struct::null()) };
    let mut options: umb_watershed_options = zeroed();
    options.depth = match source.byte() {
        0..96 => 0.0,
        byte @ 96..208 => (byte - 95) as f64 / 16.0,
        byte @ 208..232 => 2f64.powi(40 * (byte as i32 - 220)),
        _ => f64::INFINITY,
    };
    if source.spoils() {
        options.depth = f64::from_bits(source.number());
    }
    options.height = placed_height.as_ref().map_or(std::ptr::null(), |height| height.pointer().cast_const());
    (options.curvature, options.run) = (curvature.pointer(), run.view);
    if source.spoils() {
        options.reserved = source.any_u32();
    }
    let view = Struct::new(source, &mut options, false);
    let excused = height.is_none() && has_neither(&asked);
    let points = scene.points.points();
    let found = segment(source, scene, options, &view, points, &watch, excused);
    let Some(Found { segments, meeting, .. }) = found else { return };
    assert!(options.depth >= 0.0, "depth {}", options.depth);
    if options.depth == f64::INFINITY {
        assert_eq!(segments.labels(), meeting.components(|_, _, _| true), "all that is connected is one basin");
    } else if let Some(height) = height.filter(|_| location == UMB_AT_FACES && !source.is_hostile()) {
        let heights: Vec<f64> = (0..height.count).map(|face| number(&height, face)).collect();
        assert_eq!(segments.labels(), meeting.watershed(&heights, options.depth), "{heights:?}, {}", options.depth);
    }
}

/// A number of a sound input.
fn number(input: &Input, index: usize) -> f64 {
    let double = input.scalar == UMB_SCALAR_F64;
    let step = if input.stride == 0 { if double { 8 } else { 4 } } else { input.stride };
    // SAFETY: a call has read it.
    unsafe {
        let place = input.data.cast::<u8>().add(index * step);
        if double { place.cast::<f64>().read() } else { place.cast::<f32>().read().into() }
    }
}

pub fn regions(source: &mut Source<'_>, scene: &Scene) {
    let watch = Watch::new(source);
    let run = Run::new(source, &watch, None);
    let classes = (source.byte() >= 64).then(|| {
        let (draw, most) = (source.number::<u64>(), 1 + source.below(9) as u64);
        let mut classes: Vec<u8> =
            (0..point_count(scene) as u32).map(|vertex| (draw.rotate_left(11 * vertex) % 97 % most) as u8).collect();
        if let Some(class) = classes.last_mut().filter(|_| source.spoils()) {
            *class = source.byte();
        }
        List::new(source, classes, 1)
    });
    let (asked, curvature) =
        if classes.is_none() || source.rarely() { curvature(source, scene) } else { (None, Struct::null()) };
    let mut options: umb_region_options = zeroed();
    let creases = source.half().then(|| Creases::new(source, scene));
    options.creases = creases.as_ref().map_or(std::ptr::null(), Creases::pointer);
    options.smallest_share = match source.byte() {
        0..128 => 0.0,
        byte @ 128..248 => (byte - 127) as f64 / 512.0,
        _ => source.pick(&[1.0, 5e-324, 1e-300]),
    };
    options.smallest_faces = if source.rarely() { source.number() } else { source.below(8) };
    options.tolerance = if source.half() { 0.0 } else { source.byte() as f64 / 16.0 };
    if source.spoils() {
        let field = if source.half() { &mut options.smallest_share } else { &mut options.tolerance };
        *field = f64::from_bits(source.number());
    }
    if let Some(classes) = &classes {
        options.classes = classes.bytes();
    }
    (options.curvature, options.run) = (curvature.pointer(), run.view);
    if source.spoils() {
        options.reserved = source.any_u32();
    }
    let view = Struct::new(source, &mut options, false);
    let excused = options.classes.data.is_null() && has_neither(&asked);
    let points = scene.points.points();
    let found = segment(source, scene, options, &view, points, &watch, excused);
    let Some(Found { segments, meeting, .. }) = found else { return };
    assert!((0.0..=1.0).contains(&options.smallest_share));
    if let Some(creases) = &creases {
        creases.check_accepted(points.count, segments.labels().len());
    }
    if let Some(classes) = classes.filter(|classes| !classes.data.is_null()) {
        let known = classes.seen().iter().all(|&class| class <= UMB_SHAPE_SADDLE_VALLEY);
        assert!(known && classes.seen().len() == points.count, "{:?} of {} vertices", classes.seen(), points.count);
    }
    // Whoever has a neighbour is not too small.
    let tally = |labels: &[u32]| {
        let mut sizes = vec![0; labels.len()];
        labels.iter().filter(|&&label| label != UMB_NO_SEGMENT).for_each(|&label| sizes[label as usize] += 1);
        sizes
    };
    let pieces = meeting.components(|_, _, _| true);
    let (sizes, piece_sizes) = (tally(segments.labels()), tally(&pieces));
    for (&label, &piece) in segments.labels().iter().zip(&pieces).filter(|pair| *pair.0 != UMB_NO_SEGMENT) {
        let least = options.smallest_faces.min(piece_sizes[piece as usize]);
        assert!(sizes[label as usize] >= least, "region {label} has {} faces", sizes[label as usize]);
    }
}

/// Areas of segments, or means over them.
fn sums(source: &mut Source<'_>, scene: &Scene, segments: &Segments) {
    let mut count = segments.count();
    if source.spoils() {
        count = if source.half() { source.below(2 * count + 2) } else { source.number() };
    }
    let start = if source.rarely() { source.below(8) } else { 0 };
    // Another count is refused before anything is written.
    let block = Block::new(start + 8 * segments.count());
    let to = if source.spoils() { std::ptr::null_mut() } else { block.at(start).cast() };
    let of = if source.spoils() { std::ptr::null() } else { segments.0.cast_const() };
    let (faces, points) = (placed(source, &scene.faces.view), placed(source, &scene.points.points()));
    let location = source.below(2) as u32;
    let field = source.half().then(|| {
        let count = if location == UMB_AT_FACES { segments.labels().len() } else { point_count(scene) };
        scalars(source, count)
    });
    let view = field.as_ref().map(|field| placed(source, &located(field, location)));
    let outcome = Outcome::new(source);
    let (faces, points, error) = (pointer(&faces), pointer(&points), outcome.pointer());
    let (name, status) = unsafe {
        match &view {
            None => ("umb_segmentation_areas", umb_segmentation_areas(of, faces, points, to, count, error)),
            Some(view) => {
                let status = umb_segmentation_means(of, faces, points, pointer(view), to, count, error);
                ("umb_segmentation_means", status)
            }
        }
    };
    if !outcome.check(name, status, &SUMS) {
        assert!(source.is_hostile() && block.is_untouched(), "status {status}");
        return;
    }
    assert_eq!(count, segments.count(), "another number of segments");
    let found: Vec<f64> =
        (0..count).map(|label| unsafe { block.at(start).cast::<f64>().add(label).read_unaligned() }).collect();
    assert!(found.iter().all(|x| x.is_finite()), "{found:?}");
    match &field {
        None => check_areas(source, scene, segments, &found),
        Some(field) if !source.is_hostile() => check_means(scene, segments, field, location, &found),
        Some(_) => {}
    }
}

fn check_areas(source: &Source<'_>, scene: &Scene, segments: &Segments, found: &[f64]) {
    assert!(found.iter().all(|&area| area >= 0.0), "{found:?}");
    let (offsets, indices) = scene.faces.read();
    let mesh = Mesh { name: String::new(), positions: vec![], offsets, indices };
    let Some(mesh) = placed_mesh(source, scene, &mesh) else { return };
    let mut expected = vec![[0.0; 2]; found.len()];
    for (face, &label) in segments.labels().iter().enumerate().filter(|pair| *pair.1 != UMB_NO_SEGMENT) {
        let [area, tolerance] = &mut expected[label as usize];
        *area += length(area_vector(&mesh, face));
        *tolerance += 1e-12 * size(&mesh, face);
    }
    for (label, (found, [area, tolerance])) in found.iter().zip(expected).enumerate() {
        assert!((found - area).abs() <= tolerance, "segment {label} has {found} instead of {area}");
    }
}

/// Checks that means lie between the least and the largest number.
fn check_means(scene: &Scene, segments: &Segments, field: &Input, location: umb_location, found: &[f64]) {
    let (offsets, indices) = scene.faces.read();
    let mut bounds = vec![[f64::INFINITY, f64::NEG_INFINITY]; found.len()];
    for (face, &label) in segments.labels().iter().enumerate().filter(|pair| *pair.1 != UMB_NO_SEGMENT) {
        let [low, high] = &mut bounds[label as usize];
        let mut widen = |value: f64| (*low, *high) = (low.min(value), high.max(value));
        if location == UMB_AT_FACES {
            widen(number(field, face));
        } else {
            let corners = &indices[offsets[face] as usize..offsets[face + 1] as usize];
            corners.iter().for_each(|&vertex| widen(number(field, vertex as usize)));
        }
    }
    for (label, (&found, [low, high])) in found.iter().zip(bounds).enumerate() {
        let slack = 1e-12 * low.abs().max(high.abs()).min(1e300) + 1e-320;
        let inside = found >= low - slack && found <= high + slack;
        assert!(inside, "segment {label}: {found} is not between {low} and {high}");
    }
}
