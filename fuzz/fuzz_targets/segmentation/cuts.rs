//! Cut meshes and corner normals.

use super::{FROM_FACES, nobody, placed, point_count, pointer, points, receiver};
use umbilic::capi::*;
use umbilic_fuzz::parts::Creases;
use umbilic_fuzz::weights::{model, small, weight};
use umbilic_fuzz::{Bytes, Outcome, Run, Scene, Source, Struct, Target, Watch, run, zeroed};

/// A cut mesh that frees itself.
struct Cut(*mut umb_cut);

impl Cut {
    fn vertex_count(&self) -> usize {
        unsafe { umb_cut_vertex_count(self.0) }
    }

    fn corners(&self) -> &[u32] {
        unsafe { std::slice::from_raw_parts(umb_cut_corners(self.0), umb_cut_corner_count(self.0)) }
    }

    fn origins(&self) -> &[u32] {
        unsafe { std::slice::from_raw_parts(umb_cut_origins(self.0), self.vertex_count()) }
    }

    fn flags(&self) -> &[u8] {
        unsafe { std::slice::from_raw_parts(umb_topology_flags(umb_cut_topology(self.0)), self.vertex_count()) }
    }
}

impl Drop for Cut {
    fn drop(&mut self) {
        unsafe { umb_cut_destroy(self.0) };
    }
}

/// Cuts the mesh, and makes calls on what comes of it.
pub fn cut(source: &mut Source<'_>, scene: &Scene) {
    let creases = Creases::new(source, scene);
    let Some(cut) = create(source, scene, &creases) else { return };
    creases.check_accepted(scene.points.count, scene.faces.face_count());
    check(scene, &cut);
    for _ in 0..=source.below(3) {
        match source.below(4) {
            0 => copy(source, scene, &cut),
            1 => same(source, scene, &creases, &cut),
            _ => corner_normals(source, scene, &cut),
        }
    }
    unsafe {
        let null = std::ptr::null();
        assert!(umb_cut_topology(null).is_null() && umb_cut_corners(null).is_null());
        assert!(umb_cut_origins(null).is_null() && umb_cut_vertex_count(null) == 0);
        assert_eq!(umb_cut_corner_count(null), 0);
        umb_cut_destroy(std::ptr::null_mut());
    }
}

fn create(source: &mut Source<'_>, scene: &Scene, creases: &Creases) -> Option<Cut> {
    let mut options: umb_topology_options = zeroed();
    (options.threads, options.simd) = (run::threads(source), run::simd(source));
    if source.spoils() {
        (options.simd, options.reserved) = (source.any_u32(), source.any_u32());
    }
    let is_default = options.simd == 0 && options.reserved == 0;
    let options = Struct::new(source, &mut options, is_default);
    let (place, to) = receiver(source, nobody::<umb_cut>());
    let view = points(source, scene);
    let (faces, points) = (placed(source, &scene.faces.view), placed(source, &view));
    let outcome = Outcome::new(source);
    let status = unsafe {
        let (faces, points, options) = (pointer(&faces), pointer(&points), options.pointer());
        umb_cut_create(faces, points, creases.pointer(), options, to, outcome.pointer())
    };
    let success = outcome.check("umb_cut_create", status, &FROM_FACES[..13]);
    assert!(success || source.is_hostile(), "sound input is refused: {status}");
    assert_eq!(success, place.read() != nobody(), "status {status}");
    success.then(|| Cut(place.read()))
}

/// Checks the numbers of a cut mesh against the faces that it came from.
fn check(scene: &Scene, cut: &Cut) {
    let (offsets, indices) = scene.faces.read();
    let (corners, origins) = (cut.corners(), cut.origins());
    assert_eq!(corners.len(), indices.len());
    assert_eq!(unsafe { umb_topology_vertex_count(umb_cut_topology(cut.0)) }, origins.len());
    assert_eq!(unsafe { umb_topology_face_count(umb_cut_topology(cut.0)) }, offsets.len() - 1);
    let (first, last) = (origins.first(), origins.last());
    assert!(
        first.is_none_or(|&first| first == 0) && last.is_none_or(|&last| last as usize + 1 == scene.points.count)
    );
    assert!(origins.windows(2).all(|pair| pair[0] <= pair[1] && pair[1] <= pair[0] + 1), "{origins:?}");
    assert!(!origins.is_empty() || scene.points.count == 0);
    for (&corner, &index) in corners.iter().zip(&indices) {
        assert_eq!(origins[corner as usize], index, "a corner at vertex {index}");
    }
    assert!(cut.flags().iter().all(|flag| flag & UMB_VERTEX_NON_MANIFOLD == 0), "several fans at one cut vertex");
}

fn copy(source: &mut Source<'_>, scene: &Scene, cut: &Cut) {
    let double = source.half();
    let target = Target::new(source, 3, cut.vertex_count(), double);
    let (view, points) = (placed(source, &target.view()), placed(source, &scene.points.points()));
    let of = if source.spoils() { std::ptr::null() } else { cut.0.cast_const() };
    let outcome = Outcome::new(source);
    let status = unsafe { umb_cut_points(of, pointer(&points), pointer(&view), outcome.pointer()) };
    let allowed = [
        UMB_ERROR_NULL_POINTER,
        UMB_ERROR_UNKNOWN_FIELD,
        UMB_ERROR_UNKNOWN_CONSTANT,
        UMB_ERROR_STRIDE,
        UMB_ERROR_MISALIGNED,
        UMB_ERROR_SIZE,
    ];
    if !outcome.check("umb_cut_points", status, &allowed) {
        assert!(source.is_hostile() && target.is_untouched(), "status {status}");
        return;
    }
    target.check_gaps(|_| true, "copies");
    if scene.points.finite && scene.double && target.is_double() {
        for (vertex, &origin) in cut.origins().iter().enumerate() {
            let expected = scene.rows.get(origin as usize).copied().unwrap_or_default();
            assert_eq!(target.element(vertex), expected, "vertex {vertex}");
        }
    }
}

/// Which normals are asked for; the vertices of a list are those of the cut mesh.
struct Request {
    _model: Struct<umb_adaptive_model>,
    view: Struct<umb_normal_options>,
    /// What the library sees.
    seen: umb_normal_options,
}

impl Request {
    fn new(source: &mut Source<'_>, run: &Run) -> Request {
        let model = model(source);
        let mut seen: umb_normal_options = zeroed();
        (seen.weight, seen.run, seen.model) = (weight(source), run.view, model.pointer());
        (seen.degree, seen.rings) = (small(source, 4), small(source, 3));
        let view = Struct::new(source, &mut seen, false);
        Request { _model: model, view, seen }
    }
}

fn corner_normals(source: &mut Source<'_>, scene: &Scene, cut: &Cut) {
    let (count, corner_count) = (cut.vertex_count(), cut.corners().len());
    let watch = Watch::new(source);
    let run = Run::new(source, &watch, Some(count));
    let request = Request::new(source, &run);
    let wanted = source.byte();
    let target = |source: &mut Source<'_>, wanted: bool, count: usize| match wanted {
        false => Target::none(source),
        true => {
            let double = if source.rarely() { !scene.double } else { scene.double };
            Target::new(source, 3, count, double)
        }
    };
    // Corners have no list.
    let tame = run.list.is_none() || source.spoils();
    let corner = target(source, wanted & 7 != 7 && tame, corner_count);
    let (normal, sum) = (target(source, wanted & 8 == 0, count), target(source, wanted & 16 != 0, count));
    let status_bytes = Bytes::new(source, count, wanted & 32 != 0);
    let mut outputs: umb_corner_outputs = zeroed();
    (outputs.corner, outputs.normal, outputs.sum) = (corner.view(), normal.view(), sum.view());
    outputs.status = status_bytes.view();
    if source.spoils() {
        outputs.reserved = source.any_u32();
    }
    let outputs = if source.spoils() { Struct::null() } else { Struct::new(source, &mut outputs, false) };
    let of = if source.spoils() { std::ptr::null() } else { cut.0.cast_const() };
    let points = placed(source, &scene.points.points());
    let outcome = Outcome::new(source);
    let status = unsafe {
        umb_corner_normals(of, pointer(&points), request.view.pointer(), outputs.pointer(), outcome.pointer())
    };
    watch.check(status);
    if !outcome.check("umb_corner_normals", status, &FROM_FACES) {
        let untouched = corner.is_untouched() && normal.is_untouched() && sum.is_untouched();
        let untouched = untouched && status_bytes.is_untouched();
        assert!(untouched || status == UMB_ERROR_CANCELLED, "outputs are written on status {status}");
        assert!(source.is_hostile() || status == UMB_ERROR_CANCELLED, "sound input is refused: {status}");
    }
    corner.check_gaps(|_| true, "corner");
    normal.check_gaps(|vertex| run.asks_for(vertex), "normal");
    sum.check_gaps(|vertex| run.asks_for(vertex), "sum");
    status_bytes.check_gaps(|vertex| run.asks_for(vertex), "status");
    if status != UMB_OK {
        return;
    }
    assert!(run.list.is_none() || !corner.is_wanted(), "corners of a list");
    for vertex in (0..count).filter(|&vertex| run.asks_for(vertex)) {
        let found = normal.is_wanted().then(|| normal.unit(vertex, "normal"));
        if sum.is_wanted() {
            sum.finite(vertex, "sum");
        }
        if let Some(bits) = status_bytes.element(vertex) {
            let none = bits & (UMB_VERTEX_ISOLATED | UMB_VERTEX_DEGENERATE) != 0;
            assert!(found.is_none_or(|found| found != none), "vertex {vertex} has status {bits}");
            assert_eq!(bits & 15, cut.flags()[vertex], "status {bits} of vertex {vertex}");
        }
    }
    if corner.is_wanted() {
        for (place, &vertex) in cut.corners().iter().enumerate() {
            corner.unit(place, "corner");
            if normal.is_wanted() && normal.is_double() == corner.is_double() {
                assert_eq!(corner.element(place), normal.element(vertex as usize), "corner {place}");
            }
        }
    }
}

/// Corner normals in one call; any number of corners.
pub fn corners_from_faces(source: &mut Source<'_>, scene: &Scene) {
    let creases = Creases::new(source, scene);
    let watch = Watch::new(source);
    let run = Run::new(source, &watch, None);
    let request = Request::new(source, &run);
    let double = if source.rarely() { !scene.double } else { scene.double };
    let corner = Target::new(source, 3, scene.faces.corner_count(), double);
    let view = points(source, scene);
    let (faces, points) = (placed(source, &scene.faces.view), placed(source, &view));
    let output = placed(source, &corner.view());
    let outcome = Outcome::new(source);
    let status = unsafe {
        let (faces, points, options) = (pointer(&faces), pointer(&points), request.view.pointer());
        umb_corner_normals_from_faces(faces, points, creases.pointer(), options, pointer(&output), outcome.pointer())
    };
    watch.check(status);
    if !outcome.check("umb_corner_normals_from_faces", status, &FROM_FACES) {
        assert!(corner.is_untouched() || status == UMB_ERROR_CANCELLED, "corners are written on status {status}");
        assert!(source.is_hostile() || status == UMB_ERROR_CANCELLED, "sound input is refused: {status}");
        return;
    }
    creases.check_accepted(view.count, scene.faces.face_count());
    assert!(run.list.is_none(), "corners of a list");
    corner.check_gaps(|_| true, "corner");
    for place in 0..scene.faces.corner_count() {
        corner.unit(place, "corner");
    }
}

/// Checks that corner normals have the same bits with any vectors and threads, from the handle and straight from faces.
fn same(source: &mut Source<'_>, scene: &Scene, creases: &Creases, cut: &Cut) {
    let count = cut.corners().len();
    if !scene.points.finite || point_count(scene) != scene.points.count {
        return;
    }
    let (watch, plain) = (Watch::new(&mut Source::new(&[])), &mut Source::new(&[]));
    let run = Run::new(plain, &watch, None);
    let request = Request::new(source, &run);
    let ways = [(1, UMB_SIMD_PORTABLE), (1, UMB_SIMD_BEST), (1, source.below(5) as u32), (3, UMB_SIMD_BEST)];
    let ways = if source.may_be_slow(8) { &ways[..] } else { &ways[..3] };
    let mut expected: Option<Target> = None;
    for (number, &(threads, simd)) in ways.iter().enumerate() {
        let mut options = request.seen;
        options.struct_size = 0;
        (options.run.threads, options.run.simd) = (threads, simd);
        let corner = Target::new(plain, 3, count, scene.double);
        let (points, none) = (scene.points.points(), std::ptr::null_mut());
        let status = unsafe {
            if number == 2 {
                let (faces, view) = (&scene.faces.view, corner.view());
                umb_corner_normals_from_faces(faces, &points, creases.pointer(), &options, &view, none)
            } else {
                let mut outputs: umb_corner_outputs = zeroed();
                outputs.corner = corner.view();
                umb_corner_normals(cut.0, &points, &options, &outputs, none)
            }
        };
        // Weights and models that are refused are so by every way.
        assert!(status == UMB_OK || source.is_hostile() && number == 0, "way {number} answers {status}");
        if status != UMB_OK {
            return;
        }
        if let Some(expected) = &expected {
            for place in 0..count {
                let (one, two) = (expected.element(place), corner.element(place));
                assert_eq!(one.map(f64::to_bits), two.map(f64::to_bits), "corner {place}, way {number}");
            }
        }
        expected = expected.or(Some(corner));
    }
}
