//! Lists of what changes as vertices move, and results that are kept up to date by them.

use super::{nobody, receiver};
use std::collections::HashSet;
use umbilic::capi::*;
use umbilic_fuzz::coordinates::rows;
use umbilic_fuzz::curvature::{Asked, Outputs};
use umbilic_fuzz::parts::spoil;
use umbilic_fuzz::weights::{model, small, weight};
use umbilic_fuzz::{
    Block, Bytes, FaceArrays, Handle, Input, List, Outcome, Scene, Shape, Source, Struct, Target, zeroed,
};

const ALLOWED: [umb_status; 11] = [
    UMB_ERROR_NULL_POINTER,
    UMB_ERROR_STRUCT_SIZE,
    UMB_ERROR_UNKNOWN_FIELD,
    UMB_ERROR_UNKNOWN_CONSTANT,
    UMB_ERROR_MISALIGNED,
    UMB_ERROR_SIZE,
    UMB_ERROR_INDEX_OUT_OF_RANGE,
    UMB_ERROR_NOT_APPLICABLE,
    UMB_ERROR_OPTION_OUT_OF_RANGE,
    UMB_ERROR_OUT_OF_MEMORY,
    UMB_ERROR_STRIDE,
];

/// Asks for a list by any options, moved vertices and statuses.
pub fn lists(source: &mut Source<'_>, scene: &Scene) {
    let Some(handle) = scene.handle() else { return };
    let count = handle.vertex_count;
    let length = if count == 0 { 0 } else { source.below(8) };
    let mut moved: Vec<u32> = (0..length).map(|_| source.below(count) as u32).collect();
    spoil(source, &mut moved);
    let moved = List::new(source, moved, 1);
    let known = source.half().then(|| {
        let draw: u64 = source.number();
        List::<u8>::new(source, (0..count).map(|vertex| draw.rotate_left(vertex as u32) as u8).collect(), 1)
    });
    let mut view: umb_moved = zeroed();
    if length > 0 || source.half() {
        (view.vertices, view.vertex_count) = (moved.data, moved.count);
    }
    if let Some(known) = &known {
        view.status = known.bytes();
    }
    if source.spoils() {
        view.reserved = source.any_u32();
    }
    let view = if source.spoils() { Struct::null() } else { Struct::new(source, &mut view, false) };
    let of = if source.spoils() { std::ptr::null() } else { handle.pointer.cast_const() };
    // Room for as many as there are vertices, or too little.
    let room = if source.spoils() { source.below(count + 1) } else { count };
    let block = Block::new(4 * room);
    let to: *mut u32 = if source.spoils() { std::ptr::null_mut() } else { block.at(0).cast() };
    let room = if to.is_null() && source.half() { 0 } else { room };
    let (place, number) = receiver(source, usize::MAX);
    let outcome = Outcome::new(source);
    let error = outcome.pointer();
    // Without a model adaptive jets have no list, and regions by radius have none.
    let (success, excused) = if source.half() {
        let model = model(source);
        let mut options: umb_normal_options = zeroed();
        (options.weight, options.model) = (weight(source), model.pointer());
        (options.degree, options.rings) = (small(source, 4), small(source, 3));
        // Nobody looks at these.
        (options.run.threads, options.run.simd) = (source.number(), source.number());
        (options.run.vertices, options.run.vertex_count) = (nobody(), source.number());
        let given = Struct::new(source, &mut options, false);
        let status = unsafe { umb_affected_normals(of, view.pointer(), given.pointer(), to, room, number, error) };
        let success = outcome.check("umb_affected_normals", status, &ALLOWED[..10]);
        (success, options.weight == UMB_WEIGHT_ADAPTIVE_JET && options.model.is_null())
    } else {
        let asked = Asked::new(source, count, scene.double);
        let mut options = asked.view;
        (options.run.threads, options.run.simd) = (source.number(), source.number());
        (options.run.vertices, options.run.vertex_count) = (nobody(), source.number());
        let given = Struct::new(source, &mut options, false);
        let status = unsafe { umb_affected_curvatures(of, view.pointer(), given.pointer(), to, room, number, error) };
        let success = outcome.check("umb_affected_curvatures", status, &ALLOWED);
        (success, options.radius != 0.0 || options.model.is_null())
    };
    if !success {
        assert!(block.is_untouched() && place.read() == usize::MAX, "a call that failed has written");
        assert!(source.is_hostile() || excused, "sound input is refused");
        return;
    }
    let all = known.as_ref().is_none_or(|known| known.data.is_null() || known.seen().len() == count);
    assert!(all, "statuses of other vertices");
    let found = place.read();
    assert!(found <= count, "{found} of {count} vertices");
    if to.is_null() {
        assert!(block.is_untouched(), "a number was asked for");
        return;
    }
    let (list, rest) = block.bytes().split_at(4 * found);
    assert!(rest.iter().all(|&byte| byte == umbilic_fuzz::block::CANARY), "more is written than there is");
    let list: Vec<u32> = list.chunks_exact(4).map(|bytes| u32::from_ne_bytes(bytes.try_into().unwrap())).collect();
    check_list(&list, if length > 0 { moved.seen() } else { &[] }, count);
}

fn check_list(list: &[u32], moved: &[u32], count: usize) {
    assert!(list.iter().all(|&vertex| (vertex as usize) < count), "{list:?} of {count}");
    let all: HashSet<u32> = list.iter().copied().collect();
    assert_eq!(all.len(), list.len(), "a vertex twice in {list:?}");
    let moved: HashSet<u32> = moved.iter().copied().collect();
    let first: HashSet<u32> = list.iter().take(moved.len()).copied().collect();
    assert_eq!(first, moved, "those that moved come first");
}

/// What is kept up to date.
enum Task {
    Normals(umb_normal_options),
    /// With what is drawn for the choice of outputs.
    Curvatures(umb_curvature_options, Vec<u8>),
}

/// Results in memory.
enum Results {
    Normals([Target; 2], Bytes),
    Curvatures(Box<Outputs>),
}

impl Task {
    fn room(&self, count: usize, double: bool) -> Results {
        let plain = &mut Source::new(&[]);
        match self {
            Task::Normals(_) => {
                let targets = [(); 2].map(|()| Target::new(plain, 3, count, double));
                Results::Normals(targets, Bytes::new(plain, count, true))
            }
            Task::Curvatures(options, choice) => {
                let choice = &mut Source::new(choice);
                Results::Curvatures(Box::new(Outputs::laid_out(choice, plain, options.method, count, double)))
            }
        }
    }

    /// Computes for a list of vertices, or for all.
    fn run(&self, handle: &Handle, points: &Input, list: Option<&[u32]>, simd: umb_simd, to: &Results) -> umb_status {
        let (points, none) = (points.points(), std::ptr::null_mut());
        let mut run: umb_run = zeroed();
        (run.threads, run.simd) = (1, simd);
        if let Some(list) = list {
            (run.vertices, run.vertex_count) = (list.as_ptr(), list.len());
        }
        match (self, to) {
            (Task::Normals(options), Results::Normals([normal, sum], status)) => {
                let options = umb_normal_options { run, ..*options };
                let mut outputs: umb_normal_outputs = zeroed();
                (outputs.normal, outputs.sum, outputs.status) = (normal.view(), sum.view(), status.view());
                unsafe { umb_vertex_normals(handle.pointer, &points, &options, &outputs, none) }
            }
            (Task::Curvatures(options, _), Results::Curvatures(outputs)) => {
                let options = umb_curvature_options { run, ..*options };
                unsafe { umb_curvatures(handle.pointer, &points, &options, &outputs.view(), none) }
            }
            _ => unreachable!("results of another task"),
        }
    }

    fn affected(&self, handle: &Handle, moved: &[u32], statuses: Option<&[u8]>) -> Vec<u32> {
        let mut view: umb_moved = zeroed();
        (view.vertices, view.vertex_count) = (moved.as_ptr(), moved.len());
        if let Some(statuses) = statuses {
            view.status = umb_bytes { data: statuses.as_ptr(), count: statuses.len(), stride: 0 };
        }
        let mut list = vec![0u32; handle.vertex_count];
        let (mut count, none) = (0, std::ptr::null_mut());
        let (of, to) = (handle.pointer, list.as_mut_ptr());
        let status = unsafe {
            match self {
                Task::Normals(options) => umb_affected_normals(of, &view, options, to, list.len(), &mut count, none),
                Task::Curvatures(options, _) => {
                    umb_affected_curvatures(of, &view, options, to, list.len(), &mut count, none)
                }
            }
        };
        assert_eq!(status, UMB_OK, "there is no list");
        list.truncate(count);
        list
    }
}

impl Results {
    fn targets(&self) -> Vec<&Target> {
        match self {
            Results::Normals(targets, _) => targets.iter().collect(),
            Results::Curvatures(outputs) => outputs.targets().filter(|target| target.is_wanted()).collect(),
        }
    }

    fn statuses(&self, count: usize) -> Vec<u8> {
        let bytes = match self {
            Results::Normals(_, bytes) => bytes,
            Results::Curvatures(outputs) => outputs.status(),
        };
        (0..count).map(|vertex| bytes.element(vertex).expect("a status for each vertex")).collect()
    }
}

/// Moves vertices, computes the affected ones anew, and compares with what a call for all finds.
pub fn updates(source: &mut Source<'_>, scene: &Scene) {
    let (plain, double) = (&mut Source::new(&[]), scene.double);
    let sheet = (source.byte() >= 192).then(|| Shape::sheet(source));
    let before = match &sheet {
        Some(sheet) => rows(source, &sheet.positions, sheet.vertex_count, double),
        None => scene.rows.clone(),
    };
    let shape = sheet.as_ref().unwrap_or(&scene.shape);
    let (count, mut rows) = (shape.vertex_count, before.clone());
    let most = if double { f64::MAX } else { f32::MAX.into() };
    if count == 0 || rows.as_flattened().iter().any(|x| x.is_nan() || x.abs() > most) {
        return;
    }
    let faces = FaceArrays::new(plain, shape, false);
    let mut handle = std::ptr::null_mut();
    let (none, error) = (std::ptr::null(), std::ptr::null_mut());
    let status = unsafe { umb_topology_create(&faces.view, count, none, &mut handle, error) };
    assert_eq!(status, UMB_OK, "a topology");
    let handle = Handle { pointer: handle, vertex_count: count };
    let points = Input::new(plain, &rows, 3, double);

    let asked = Asked::new(source, count, double);
    let mut learned: umb_adaptive_model = zeroed();
    let mut task = if source.half() {
        let mut options: umb_normal_options = zeroed();
        (options.weight, options.model) = (asked.view.weight, asked.view.model);
        (options.degree, options.rings) = (asked.view.normal_degree, asked.view.normal_rings);
        Task::Normals(options)
    } else {
        // A choice of outputs whose layout draws nothing.
        let choice = [vec![0], (0..24).map(|_| source.byte()).collect()].concat();
        Task::Curvatures(umb_curvature_options { radius: 0.0, ..asked.view }, choice)
    };
    let (weight, method, model) = match &mut task {
        Task::Normals(options) => (options.weight, UMB_CURVATURE_JET, &mut options.model),
        Task::Curvatures(options, _) => (options.weight, options.method, &mut options.model),
    };
    let adaptive = weight == UMB_WEIGHT_ADAPTIVE_JET || method == UMB_CURVATURE_ADAPTIVE_JET;
    if adaptive && model.is_null() {
        let status = unsafe { umb_learn_model(handle.pointer, &points.points(), none.cast(), &mut learned, error) };
        assert_eq!(status, UMB_OK, "a model");
        *model = &learned;
    }
    let results = task.room(count, double);
    let status = task.run(&handle, &points, None, UMB_SIMD_BEST, &results);
    if status != UMB_OK {
        assert!(source.is_hostile(), "sound input is refused: {status}");
        return;
    }
    drop(points);
    for _ in 0..=source.below(2) {
        let moved: Vec<u32> = (0..=source.below(3)).map(|_| source.below(count) as u32).collect();
        for &vertex in &moved {
            let row = &mut rows[vertex as usize];
            *row = match source.below(4) {
                0 => row.map(|x| x * 0.75),
                1 => before[source.below(count)],
                2 => [source.byte(), source.byte(), source.byte()].map(|byte| byte as f64 / 64.0 - 2.0),
                _ => [row[1], row[2], row[0]],
            };
        }
        let known = results.statuses(count);
        let list = task.affected(&handle, &moved, source.half().then_some(&known));
        check_list(&list, &moved, count);
        let points = Input::new(plain, &rows, 3, double);
        let status = task.run(&handle, &points, Some(&list), source.below(5) as umb_simd, &results);
        assert_eq!(status, UMB_OK, "a list");
        let whole = task.room(count, double);
        assert_eq!(task.run(&handle, &points, None, UMB_SIMD_BEST, &whole), UMB_OK);
        assert_eq!(results.statuses(count), whole.statuses(count), "after {moved:?} moved, {list:?}");
        for (array, (found, expected)) in results.targets().into_iter().zip(whole.targets()).enumerate() {
            for vertex in 0..count {
                let (one, two) = (found.element(vertex), expected.element(vertex));
                let same = one.map(f64::to_bits) == two.map(f64::to_bits);
                assert!(
                    same,
                    "{moved:?} moved, {list:?}: array {array}, vertex {vertex}: {one:?} instead of {two:?}"
                );
            }
        }
    }
}
