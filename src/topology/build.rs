//! From faces to ordered one-rings in linear time, without hashing.
//!
//! 1. Every corner `prev, v, next` of a face becomes a record `(next, prev)` (and the face, where there are polygons)
//!    in `v`'s stretch of a table: count, prefix sum, scatter.
//! 2. Around `v`, the record that follows `(next, prev)` counter-clockwise is the one whose `next` is `prev`. Most
//!    rings close after exactly as many steps as there are corners, which proves them one closed manifold fan. The
//!    others go through [`FanBuilder`].
//!
//! A ring starts at the vertex's first corner in face order, so it depends on the order of faces and on nothing else.

use super::fans::{FanBuilder, FanRecord};
use super::flat::{Bare, Flat, NO_FACE, Record, WIDE, WithFace};
use super::polygons::Polygons;
use super::stats::Defects;
use super::{Topology, status};
use crate::error::{Error, filled};
use crate::simd::follow_chain;
use crate::view::{Faces, Index, MAX_LANE_CORNERS, RingClass, Rings, with_indices, zeroed};

/// Rings of up to this many corners are ordered in a window of eight records.
const NARROW: usize = 8;

/// Faces as a stream of corners.
trait Corners {
    /// Calls `emit(vertex, next, prev, face)` for each corner of each face that is not ignored.
    fn each(&self, emit: impl FnMut(u32, u32, u32, u32));
}

struct Triangles<'a, I>(&'a [I]);

impl<I: Index> Corners for Triangles<'_, I> {
    #[inline(always)]
    fn each(&self, mut emit: impl FnMut(u32, u32, u32, u32)) {
        for (face, corners) in self.0.chunks_exact(3).enumerate() {
            let [a, b, c] = [corners[0], corners[1], corners[2]].map(|corner| corner.widen() as u32);
            if a == b || b == c || c == a {
                continue;
            }
            emit(a, b, c, face as u32);
            emit(b, c, a, face as u32);
            emit(c, a, b, face as u32);
        }
    }
}

impl Corners for Polygons {
    fn each(&self, mut emit: impl FnMut(u32, u32, u32, u32)) {
        for face in 0..self.face_count() {
            let corners = self.face(face);
            let mut prev = corners.last().copied().unwrap_or(0);
            for (index, &vertex) in corners.iter().enumerate() {
                let next = corners.get(index + 1).copied().unwrap_or(corners[0]);
                emit(vertex, next, prev, face as u32);
                prev = vertex;
            }
        }
    }
}

/// Builds the topology of faces whose indices are all below `vertex_count`.
pub(super) fn build(faces: &Faces<'_>, vertex_count: usize) -> Result<Topology, Error> {
    if faces.all_triangles() {
        let ordered = with_indices!(faces.indices(), indices => {
            order::<Bare>(&Triangles(indices), indices.len(), vertex_count, None)?
        });
        let used = ordered.defects.corner_count / 3;
        finish(ordered, None, faces.len(), used, faces.len() - used)
    } else {
        let (mut polygons, degenerate) = Polygons::new(faces)?;
        let mut ordered = order::<WithFace>(&polygons, polygons.corner_count(), vertex_count, Some(&polygons))?;
        polygons.set_corner_faces(std::mem::take(&mut ordered.corner_faces));
        let used = polygons.used_faces();
        finish(ordered, Some(polygons), faces.len(), used, degenerate)
    }
}

/// Ordered rings, not yet sorted for the sweep.
struct Ordered {
    offsets: Vec<u32>,
    neighbours: Vec<u32>,
    corner_faces: Vec<u32>,
    flags: Vec<u8>,
    /// The fans of every vertex that is not one closed fan found by the scan.
    fans: Vec<FanRecord>,
    defects: Defects,
}

fn order<R: Record>(
    corners: &impl Corners,
    capacity: usize,
    vertex_count: usize,
    polygons: Option<&Polygons>,
) -> Result<Ordered, Error> {
    let (mut offsets, records) = collect::<R>(corners, capacity, vertex_count)?;
    let corner_count = offsets[vertex_count] as usize;
    let mut builder = FanBuilder::new(polygons);
    let mut flat = Flat::new(corner_count, polygons.is_some())?;
    let mut flags = filled(vertex_count, 0u8)?;
    let mut start = 0;
    for vertex in 0..vertex_count {
        // The offsets of corners become offsets of ring entries as they are used up.
        let end = offsets[vertex + 1] as usize;
        offsets[vertex] = flat.length as u32;
        let count = end - start;
        // The records are padded, so that a window of fixed length never runs over their end.
        let closed = match count {
            0 => {
                flags[vertex] = status::ISOLATED;
                continue;
            }
            1..=NARROW => close::<R, NARROW>(window(&records, start), count, &mut flat)?,
            9..=WIDE => close::<R, WIDE>(window(&records, start), count, &mut flat)?,
            _ => false,
        };
        if !closed {
            flags[vertex] = builder.add(vertex as u32, &records[start..end], &mut flat)?;
        }
        start = end;
    }
    offsets[vertex_count] = flat.length as u32;
    let (fans, mut defects) = builder.finish();
    defects.corner_count = corner_count;
    let (neighbours, corner_faces) = flat.finish();
    Ok(Ordered { offsets, neighbours, corner_faces, flags, fans, defects })
}

fn window<R, const N: usize>(records: &[R], start: usize) -> &[R; N] {
    records[start..].first_chunk().expect("records are padded by a window")
}

/// Appends the ring of the first `count` of `N` records, from the first record on, if they close to a single fan;
/// whether they do.
#[inline(always)]
fn close<R: Record, const N: usize>(records: &[R; N], count: usize, flat: &mut Flat) -> Result<bool, Error> {
    let beyond = |slot: usize| if slot < count { 0 } else { u32::MAX };
    let nexts: [u32; N] = std::array::from_fn(|slot| records[slot].next() | beyond(slot));
    let prevs: [u32; N] = std::array::from_fn(|slot| records[slot].prev() + 1);
    let Some(ring) = follow_chain(&nexts, &prevs, count) else {
        return Ok(false);
    };
    let face_of = |neighbour: u32| {
        let record = nexts.iter().position(|&next| next == neighbour).map(|slot| records[slot]);
        record.and_then(R::face).unwrap_or(NO_FACE)
    };
    let faces = if R::HAS_FACE { ring.map(face_of) } else { [NO_FACE; N] };
    flat.push_window(&ring, &faces, count)?;
    Ok(true)
}

/// The records of all corners, by vertex and in face order within a vertex.
fn collect<R: Record>(
    corners: &impl Corners,
    capacity: usize,
    vertex_count: usize,
) -> Result<(Vec<u32>, Vec<R>), Error> {
    let mut offsets = zeroed::<u32>(vertex_count + 1)?;
    let mut records = zeroed::<R>(capacity.checked_add(WIDE).ok_or(Error::OutOfMemory)?)?;
    // While scattering, `offsets[v + 1]` is where the next record of `v` goes; at the end it is where `v` ends.
    corners.each(|vertex, _, _, _| offsets[vertex as usize + 1] += 1);
    let mut start = 0;
    for offset in &mut offsets[1..] {
        start += std::mem::replace(offset, start);
    }
    corners.each(|vertex, next, prev, face| {
        let offset = &mut offsets[vertex as usize + 1];
        records[*offset as usize] = R::new(next, prev, face);
        *offset += 1;
    });
    Ok((offsets, records))
}

fn finish(
    ordered: Ordered,
    polygons: Option<Polygons>,
    face_count: usize,
    used_faces: usize,
    degenerate_faces: usize,
) -> Result<Topology, Error> {
    let Ordered { offsets, neighbours, flags, fans, defects, .. } = ordered;
    let mut rest = fans.as_slice();
    let rings = Rings::new(offsets, neighbours, |vertex, entries| match take_fans(&mut rest, vertex) {
        [] => (entries <= MAX_LANE_CORNERS).then_some((entries, true)),
        [fan] => (fan.corners as usize <= MAX_LANE_CORNERS).then_some((fan.corners as usize, fan.closed)),
        _ => None,
    })?;
    // Only vertices that the sweep takes one by one need their fans spelt out.
    let mut rest = fans.as_slice();
    let (mut kept, mut largest_alone) = (Vec::new(), 0);
    for vertex in 0..rings.vertex_count() {
        let found = take_fans(&mut rest, vertex);
        if rings.class(vertex) == RingClass::Alone {
            kept.try_reserve(found.len().max(1))?;
            largest_alone = largest_alone.max(rings.ring(vertex).len() + found.len().max(1));
            match found {
                [] => {
                    let corners = rings.ring(vertex).len() as u32;
                    kept.push(FanRecord { vertex: vertex as u32, start: 0, corners, closed: true });
                }
                found => kept.extend_from_slice(found),
            }
        }
    }
    kept.shrink_to_fit();
    let defects = Defects { face_count, used_faces, degenerate_faces, ..defects };
    Ok(Topology { rings, flags, fans: kept, polygons, largest_alone, defects })
}

/// Splits off the fans of `vertex`, which come next if it has any.
fn take_fans<'a>(rest: &mut &'a [FanRecord], vertex: usize) -> &'a [FanRecord] {
    if rest.first().is_none_or(|fan| fan.vertex as usize != vertex) {
        return &[];
    }
    let count = rest.iter().take_while(|fan| fan.vertex as usize == vertex).count();
    let (found, others) = rest.split_at(count);
    *rest = others;
    found
}
