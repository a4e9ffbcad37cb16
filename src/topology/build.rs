//! From faces to ordered one-rings in linear time, without hashing.
//!
//! 1. Every corner `prev, v, next` of a face becomes a record `(next, prev)` (and the face, where there are polygons)
//!    in one of eight slots of `v`, a cache line a vertex, which is fetched ahead: see [`super::corners`].
//! 2. The records of a vertex are chained to a ring, a block of vertices at once, and the rings are checked and sorted
//!    by class while they are in the cache: see [`super::order`] and [`RingTable`].
//!
//! Each thread has a run of vertices: it reads all faces, takes the corners at its own, and orders them. What threads
//! share is read only, so how many there are changes nothing.

use super::Topology;
use super::corners::{BARE, Corners, Triangles, WITH_FACE};
use super::fans::{FanBuilder, FanRecord};
use super::order::Order;
use super::polygons::Polygons;
use super::stats::Defects;
use crate::error::{Error, reserved};
use crate::parallel::thread_count;
use crate::simd::Level;
use crate::view::{
    BLOCK, Faces, RingPart, RingTable, Rings, SLOTS, Slots, SlotsPart, WINDOW, for_each_part, with_indices, zeroed,
};

/// Builds the topology of faces whose corners are fewer than 2³¹.
pub(super) fn build(faces: &Faces<'_>, vertex_count: usize, threads: usize, level: Level) -> Result<Topology, Error> {
    if vertex_count == 0 {
        faces.indices().check_range("faces.indices", 0)?;
    }
    if faces.all_triangles() {
        let ordered = with_indices!(faces.indices(), indices => {
            order::<BARE>(&Triangles { indices, vertex_count }, vertex_count, None, threads, level)?
        });
        let used = ordered.defects.corner_count / 3;
        finish(ordered, None, faces.len(), used, faces.len() - used)
    } else {
        faces.indices().check_range("faces.indices", vertex_count)?;
        let (mut polygons, degenerate) = Polygons::new(faces)?;
        let mut ordered = order::<WITH_FACE>(&polygons, vertex_count, Some(&polygons), threads, level)?;
        polygons.set_corner_faces(std::mem::take(&mut ordered.corner_faces));
        let used = polygons.used_faces();
        finish(ordered, Some(polygons), faces.len(), used, degenerate)
    }
}

/// Ordered rings.
struct Ordered {
    rings: Rings,
    corner_faces: Vec<u32>,
    flags: Vec<u8>,
    /// The fans of every vertex that is not one closed fan found by the scan.
    fans: Vec<FanRecord>,
    defects: Defects,
}

/// What one thread works on.
struct Part<'a, 'p, const WORDS: usize> {
    slots: SlotsPart<'a, WORDS>,
    rings: RingPart<'a>,
    flags: &'a mut [u8],
    builder: &'a mut FanBuilder<'p>,
}

fn order<const WORDS: usize>(
    corners: &impl Corners<WORDS>,
    vertex_count: usize,
    polygons: Option<&Polygons>,
    threads: usize,
    level: Level,
) -> Result<Ordered, Error> {
    let windows = vertex_count.div_ceil(WINDOW);
    let threads = thread_count(threads, windows);
    let stretch = windows.div_ceil(threads).max(1) * WINDOW;
    let mut slots = Slots::<WORDS>::new(vertex_count)?;
    let mut table = RingTable::new(vertex_count, stretch, polygons.is_some())?;
    let mut flags: Vec<u8> = zeroed(vertex_count)?;
    let mut outcomes = reserved(table.part_count())?;
    outcomes.resize_with(table.part_count(), || (FanBuilder::new(polygons), Ok(())));

    let rows = slots.parts(stretch).zip(table.parts()).zip(flags.chunks_mut(stretch)).zip(&mut outcomes);
    let parts =
        rows.map(|(((slots, rings), flags), (builder, result))| (Part { slots, rings, flags, builder }, result));
    for_each_part(threads, parts, |(mut part, result)| *result = part.order(corners, level));
    drop(slots);

    let mut builder = FanBuilder::new(polygons);
    for (other, result) in outcomes {
        result?;
        builder.append(other)?;
    }
    let (rings, corner_faces) = table.join(threads)?;
    let (fans, defects) = builder.finish();
    Ok(Ordered { rings, corner_faces, flags, fans, defects })
}

impl<const WORDS: usize> Part<'_, '_, WORDS> {
    /// Takes the corners at the vertices of the part, and orders them.
    fn order(&mut self, corners: &impl Corners<WORDS>, level: Level) -> Result<(), Error> {
        let spilt = corners.hand_out(&mut self.slots)?;
        let count = self.slots.record_count() + spilt.len();
        self.builder.count_corners(count);
        // Room for some open fans, each of which has an entry more than corners.
        self.rings.start(count + count / 64 + 2 * BLOCK * SLOTS)?;
        let Part { slots, rings, flags, builder } = self;
        Order { slots, spilt: &spilt, rings, flags, builder }.run(level)
    }
}

fn finish(
    ordered: Ordered,
    polygons: Option<Polygons>,
    face_count: usize,
    used_faces: usize,
    degenerate_faces: usize,
) -> Result<Topology, Error> {
    let Ordered { rings, flags, fans, defects, .. } = ordered;
    // Only vertices that the sweep takes one by one need their fans spelt out.
    let mut rest = fans.as_slice();
    let (mut kept, mut largest_alone) = (Vec::new(), 0);
    for vertex in rings.alone() {
        let found = fans_of(&mut rest, vertex);
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
    kept.shrink_to_fit();
    let defects = Defects { face_count, used_faces, degenerate_faces, ..defects };
    Ok(Topology { rings, flags, fans: kept, polygons, largest_alone, defects })
}

/// The fans of `vertex`, if it has any in `rest`, which loses them and those of lower vertices.
fn fans_of<'a>(rest: &mut &'a [FanRecord], vertex: usize) -> &'a [FanRecord] {
    let lower = rest.iter().take_while(|fan| (fan.vertex as usize) < vertex).count();
    let count = rest[lower..].iter().take_while(|fan| fan.vertex as usize == vertex).count();
    let found = &rest[lower..lower + count];
    *rest = &rest[lower + count..];
    found
}
