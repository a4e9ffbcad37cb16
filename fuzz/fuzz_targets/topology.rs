//! Topology handles: any faces, and any sequence of calls on what was built of them.
#![no_main]
// Every call keeps the contract that the header states.
#![allow(clippy::undocumented_unsafe_blocks)]

use libfuzzer_sys::fuzz_target;
use umbilic::capi::*;
use umbilic_fuzz::{Block, FaceArrays, Outcome, Placed, Shape, Source, Struct, run, zeroed};

fuzz_target!(|data: &[u8]| {
    let source = &mut Source::new(data);
    let shape = Shape::new(source);
    let vertex_count = vertex_count(source, &shape);
    let faces = FaceArrays::new(source, &shape, true);
    let Some(handle) = create(source, &faces, vertex_count) else { return };
    let totals = (vertex_count < 1 << 13).then(|| check_rings(handle, vertex_count));
    let mut calls = 0;
    while !source.is_empty() && calls < 4 {
        call(source, handle, vertex_count, totals.as_ref());
        calls += 1;
    }
    if source.below(8) == 1 {
        check_same(source, handle, &faces, vertex_count);
    }
    unsafe { umb_topology_destroy(handle) };
});

/// As many as the faces need; some more; too few; too many for any memory.
fn vertex_count(source: &mut Source<'_>, shape: &Shape) -> usize {
    match source.byte() {
        0..224 => shape.vertex_count,
        224..240 => shape.vertex_count + source.below(40),
        // Several windows of 2048 vertices, so that threads share the work.
        _ if source.may_be_slow(run::SLOW) => shape.vertex_count + source.below(7000),
        _ if !source.is_hostile() => shape.vertex_count,
        240..250 => source.below(shape.vertex_count + 1),
        // The sanitizer says so wherever memory is refused, which takes long.
        _ if !source.may_be_slow(8) => shape.vertex_count,
        250..254 => u32::MAX as usize - source.below(1 << 20) + source.below(1 << 20),
        _ => source.number(),
    }
}

fn create(source: &mut Source<'_>, faces: &FaceArrays, vertex_count: usize) -> Option<*mut umb_topology> {
    let mut options: umb_topology_options = zeroed();
    (options.threads, options.simd) = (run::threads(source), run::simd(source));
    if source.spoils() {
        (options.simd, options.reserved) = (source.any_u32(), source.any_u32());
    }
    let is_default = options.simd == 0 && options.reserved == 0;
    let options = Struct::new(source, &mut options, is_default);
    let outcome = Outcome::new(source);
    let nowhere = source.spoils();
    let sentinel: *mut umb_topology = std::ptr::without_provenance_mut(0x5a5a);
    let place = Placed::new(source, &sentinel);
    let faces = (!source.spoils()).then(|| Placed::new(source, &faces.view));
    let faces = faces.as_ref().map_or(std::ptr::null(), |faces| faces.pointer().cast_const());
    let to = if nowhere { std::ptr::null_mut() } else { place.pointer() };
    // More vertices than memory has room for are fine as a request.
    let huge = vertex_count > 1 << 20;
    if huge && vertex_count < 1 << 28 {
        return None;
    }
    let status = unsafe { umb_topology_create(faces, vertex_count, options.pointer(), to, outcome.pointer()) };
    let success = outcome.check(
        "umb_topology_create",
        status,
        &[
            UMB_ERROR_NULL_POINTER,
            UMB_ERROR_STRUCT_SIZE,
            UMB_ERROR_UNKNOWN_FIELD,
            UMB_ERROR_UNKNOWN_CONSTANT,
            UMB_ERROR_MISALIGNED,
            UMB_ERROR_SIZE,
            UMB_ERROR_OFFSETS,
            UMB_ERROR_INDEX_OUT_OF_RANGE,
            UMB_ERROR_TOO_LARGE,
            UMB_ERROR_OUT_OF_MEMORY,
        ],
    );
    assert!(success || source.is_hostile(), "sound faces are refused with status {status}");
    assert!(huge || status != UMB_ERROR_OUT_OF_MEMORY, "no memory for {vertex_count} vertices");
    assert_eq!(success, place.read() != sentinel, "status {status}");
    success.then(|| place.read())
}

/// What the rings add up to.
#[derive(Debug, Default, PartialEq)]
struct Totals {
    corners: u64,
    isolated: u64,
    boundary: u64,
    non_manifold: u64,
    max_valence: u64,
}

/// Checks rings, fans and flags against each other.
fn check_rings(handle: *const umb_topology, vertex_count: usize) -> Totals {
    let mut totals = Totals::default();
    unsafe {
        assert_eq!(umb_topology_vertex_count(handle), vertex_count);
        let offsets = umb_topology_ring_offsets(handle);
        let neighbours = umb_topology_ring_neighbours(handle);
        let flags = umb_topology_flags(handle);
        assert_eq!(*offsets, 0);
        for vertex in 0..vertex_count {
            let (start, end) = (*offsets.add(vertex) as usize, *offsets.add(vertex + 1) as usize);
            let flag = *flags.add(vertex);
            let (mut count, mut valence) = (usize::MAX, usize::MAX);
            let none = std::ptr::null_mut();
            assert_eq!(umb_topology_fan_count(handle, vertex, &mut count, none), UMB_OK);
            assert_eq!(umb_topology_valence(handle, vertex, &mut valence, none), UMB_OK);
            let mut at = start;
            for index in 0..count {
                let mut fan: umb_fan = zeroed();
                assert_eq!(umb_topology_fan(handle, vertex, index, &mut fan, none), UMB_OK);
                assert_eq!(fan.neighbours, neighbours.add(at), "fans are parts of the ring");
                assert_eq!(fan.neighbour_count, fan.corner_count + 1 - fan.closed as usize);
                assert!(fan.closed <= 1 && fan.corner_count > 0 && fan.reserved == 0);
                for place in 0..fan.neighbour_count {
                    assert!((*fan.neighbours.add(place) as usize) < vertex_count);
                }
                at += fan.neighbour_count;
                totals.corners += fan.corner_count as u64;
            }
            assert_eq!(at, end, "the fans of vertex {vertex} are its whole ring");
            assert!(valence <= end - start && (valence > 0) == (count > 0));
            assert!(flag < 16, "flag {flag}");
            assert_eq!(flag & UMB_VERTEX_ISOLATED != 0, count == 0);
            assert_eq!(flag & UMB_VERTEX_NON_MANIFOLD != 0, count > 1);
            totals.isolated += (count == 0) as u64;
            totals.non_manifold += (count > 1) as u64;
            totals.boundary += (flag & UMB_VERTEX_BOUNDARY != 0) as u64;
            totals.max_valence = totals.max_valence.max(valence as u64);
        }
    }
    totals
}

/// One call on the handle, or on none.
fn call(source: &mut Source<'_>, handle: *mut umb_topology, vertex_count: usize, totals: Option<&Totals>) {
    let of: *const umb_topology = if source.spoils() { std::ptr::null() } else { handle };
    let vertex = match source.byte() {
        0..200 => source.below(vertex_count.max(1)),
        200..230 => vertex_count + source.below(3),
        _ => source.number(),
    };
    let outcome = Outcome::new(source);
    let error = outcome.pointer();
    let nowhere = source.spoils();
    let null_or_range = [UMB_ERROR_NULL_POINTER, UMB_ERROR_INDEX_OUT_OF_RANGE];
    let expected = of.is_null() || nowhere || vertex >= vertex_count;
    match source.below(6) {
        0 | 1 => check_stats(source, of, totals),
        2 => {
            let place = Block::new(8);
            let to = if nowhere { std::ptr::null_mut() } else { place.at(0).cast() };
            let status = unsafe { umb_topology_valence(of, vertex, to, error) };
            let success = outcome.check("umb_topology_valence", status, &null_or_range);
            assert!(success != expected && success != place.is_untouched());
        }
        3 => {
            let place = Block::new(8);
            let to = if nowhere { std::ptr::null_mut() } else { place.at(0).cast() };
            let status = unsafe { umb_topology_fan_count(of, vertex, to, error) };
            let success = outcome.check("umb_topology_fan_count", status, &null_or_range);
            assert!(success != expected && success != place.is_untouched());
        }
        4 => {
            let place = Block::new(size_of::<umb_fan>());
            let to = if nowhere { std::ptr::null_mut() } else { place.at(0).cast() };
            let index = if source.rarely() { source.number() } else { source.below(3) };
            let status = unsafe { umb_topology_fan(of, vertex, index, to, error) };
            let success = outcome.check("umb_topology_fan", status, &null_or_range);
            assert!(success != place.is_untouched() && !(success && expected));
        }
        _ => unsafe {
            assert_eq!(umb_topology_vertex_count(of), if of.is_null() { 0 } else { vertex_count });
            assert!(!of.is_null() || umb_topology_face_count(of) == 0);
            assert_eq!(umb_topology_flags(of).is_null(), of.is_null());
            assert_eq!(umb_topology_ring_offsets(of).is_null(), of.is_null());
            assert_eq!(umb_topology_ring_neighbours(of).is_null(), of.is_null());
            umb_topology_destroy(std::ptr::null_mut());
            assert!(!umb_status_string(source.number()).is_null());
        },
    }
}

fn check_stats(source: &mut Source<'_>, handle: *const umb_topology, totals: Option<&Totals>) {
    let stats = Struct::new(source, &mut zeroed::<umb_topology_stats>(), false);
    let before = stats.bytes().to_vec();
    let outcome = Outcome::new(source);
    let status = unsafe { umb_topology_get_stats(handle, stats.pointer(), outcome.pointer()) };
    let allowed = [UMB_ERROR_NULL_POINTER, UMB_ERROR_STRUCT_SIZE, UMB_ERROR_OUT_OF_MEMORY];
    if !outcome.check("umb_topology_get_stats", status, &allowed) {
        assert!(stats.bytes() == before, "stats are written on status {status}");
        assert!(source.is_hostile());
        return;
    }
    assert_eq!(stats.bytes()[..4], before[..4], "struct_size changed");
    let mut whole = [0; size_of::<umb_topology_stats>()];
    let known = whole.len().min(stats.bytes().len());
    whole[..known].copy_from_slice(&stats.bytes()[..known]);
    assert!(stats.bytes()[known..].iter().all(|&byte| byte == 0), "fields of a later version are not zero");
    // SAFETY: valid for any bytes.
    let stats: umb_topology_stats = unsafe { whole.as_ptr().cast::<umb_topology_stats>().read_unaligned() };
    assert_eq!(stats.face_count as usize, unsafe { umb_topology_face_count(handle) });
    assert!(stats.ignored_faces <= stats.degenerate_faces && stats.degenerate_faces <= stats.face_count);
    assert!(stats.duplicate_faces <= stats.face_count && stats.boundary_edges <= stats.edge_count);
    let used = stats.vertex_count - stats.isolated_vertices;
    let euler = used as i64 - stats.edge_count as i64 + (stats.face_count - stats.ignored_faces) as i64;
    assert_eq!(stats.euler_characteristic, euler);
    assert!(stats.component_count <= used && stats.boundary_loops <= stats.boundary_edges);
    if let Some(totals) = totals {
        let found = Totals {
            corners: stats.corner_count,
            isolated: stats.isolated_vertices,
            boundary: stats.boundary_vertices,
            non_manifold: stats.non_manifold_vertices,
            max_valence: stats.max_valence,
        };
        assert_eq!(found, *totals);
    }
}

/// Checks that the same faces give the same handle with any threads and vectors.
fn check_same(source: &mut Source<'_>, handle: *const umb_topology, faces: &FaceArrays, vertex_count: usize) {
    let mut options: umb_topology_options = zeroed();
    (options.threads, options.simd) = (run::threads(source), run::simd(source));
    let mut other = std::ptr::null_mut();
    unsafe {
        let status = umb_topology_create(&faces.view, vertex_count, &options, &mut other, std::ptr::null_mut());
        assert_eq!(status, UMB_OK, "the same faces are refused");
        let slice = |handle| {
            let offsets = std::slice::from_raw_parts(umb_topology_ring_offsets(handle), vertex_count + 1);
            let count = *offsets.last().expect("one more than vertices") as usize;
            let ring = std::slice::from_raw_parts(umb_topology_ring_neighbours(handle), count);
            (offsets, ring, std::slice::from_raw_parts(umb_topology_flags(handle), vertex_count))
        };
        assert!(slice(handle) == slice(other), "two handles of the same faces differ");
        umb_topology_destroy(other);
    }
}
