//! Topology: the one-rings of all vertices, built once from faces alone and reused while positions move, and the
//! neighbourhoods of several rings that are gathered from them.

mod adjacency;
mod build;
mod closure;
mod corners;
mod fans;
mod neighbourhood;
mod order;
mod polygons;
mod stats;

pub use stats::TopologyStats;

pub(crate) use adjacency::{Adjacency, NO_CORNER, has_three_corners};
pub(crate) use closure::{closure, closure_by_rings};
pub(crate) use neighbourhood::{FirstRings, MAX_NEIGHBOURS, MAX_RINGS, Neighbourhood};
pub(crate) use polygons::Polygons;

use crate::error::{Error, reserved};
use crate::simd::Level;
use crate::view::{Faces, RingClass, Rings};
use fans::FanRecord;

/// Bits of a vertex's status byte. 0 is an ordinary interior vertex.
pub mod status {
    /// An edge at the vertex has only one face.
    pub const BOUNDARY: u8 = 1;
    /// The faces at the vertex do not form a single fan.
    pub const NON_MANIFOLD: u8 = 2;
    /// The two faces of an edge at the vertex run through it in the same direction.
    pub const WINDING: u8 = 4;
    /// No face uses the vertex; its results are zero.
    pub const ISOLATED: u8 = 8;
    /// The estimator had nothing to work with at the vertex, and a simpler one took its place.
    pub const FALLBACK: u8 = 16;
    /// Nothing at all could be computed; the results are zero.
    pub const DEGENERATE: u8 = 32;
    /// The neighbourhood asked for had too few vertices, or too few in general position, and was widened.
    pub const WIDENED: u8 = 64;
    /// A face of the vertex is more than 37° from its one-ring normal: a crease, or a very coarse or noisy place. Set by adaptive
    /// jets only. Where no smooth surface goes with the faces, [`FALLBACK`] is set as well: the normal is then the mean direction of the
    /// sides of the crease, and curvatures are those of sections.
    pub const CREASE: u8 = 128;
}

/// The one-rings of a mesh.
///
/// A *fan* is a run of faces around a vertex in which each shares an edge with the next, counter-clockwise. At an
/// interior vertex the fan is closed, at a boundary vertex open; at a non-manifold vertex there are several. Faces are
/// joined across an edge only where it has exactly two, and these run through it in opposite directions; every other
/// edge ends the fans on both its sides.
///
/// Faces that name a vertex twice in a row lose the repetition; faces of fewer than three corners are ignored. Both
/// are counted in [`TopologyStats`].
#[derive(Debug)]
pub struct Topology {
    rings: Rings,
    /// [`status`] bits that follow from the faces alone.
    flags: Vec<u8>,
    /// The fans of every vertex of [`RingClass::Alone`], by vertex.
    fans: Vec<FanRecord>,
    /// The faces, where there are others than triangles.
    polygons: Option<Polygons>,
    /// See [`Topology::largest_alone`].
    largest_alone: usize,
    defects: stats::Defects,
}

/// One fan of a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fan<'a> {
    /// The neighbours in counter-clockwise order: `corner_count` of them in a closed fan, one more in an open one.
    pub neighbours: &'a [u32],
    /// The number of faces in the fan.
    pub corner_count: usize,
    /// Whether the last face meets the first.
    pub closed: bool,
    /// Where `neighbours` starts in the ring of the vertex.
    pub(crate) start: usize,
}

/// Stands in the table of corner faces at the end of an open fan.
pub(crate) const NO_FACE: u32 = u32::MAX;

/// The largest number of vertices; one less than the number of 32-bit values, which serve as indices.
const MAX_VERTICES: u64 = u32::MAX as u64;

/// The largest number of faces, empty ones included.
const MAX_FACES: u64 = u32::MAX as u64;

/// A sorted copy.
fn sorted(ring: &[u32]) -> Result<Vec<u32>, Error> {
    let mut copy = reserved(ring.len())?;
    copy.extend_from_slice(ring);
    copy.sort_unstable();
    Ok(copy)
}

impl Topology {
    /// Builds the one-rings of `faces` over `vertex_count` vertices.
    ///
    /// Cost: linear in the number of corners, apart from sorting the corners of vertices with more than eight of them or
    /// with several fans. As many threads as pay.
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`]; [`Error::TooLarge`] beyond 2³² − 1 vertices or faces, or 2³¹ − 1
    /// corners;
    /// [`Error::OutOfMemory`].
    pub fn new(faces: &Faces<'_>, vertex_count: usize) -> Result<Self, Error> {
        Self::with_threads(faces, vertex_count, 0, Level::best())
    }

    /// As [`Topology::new`], with up to `threads` threads (0: as many as pay) and vectors of at most `level`. Neither
    /// changes what is built.
    ///
    /// # Errors
    /// As [`Topology::new`].
    pub fn with_threads(faces: &Faces<'_>, vertex_count: usize, threads: usize, level: Level) -> Result<Self, Error> {
        if vertex_count as u64 > MAX_VERTICES {
            return Err(Error::TooLarge { what: "vertices", found: vertex_count as u64, limit: MAX_VERTICES });
        }
        let corner_count = faces.indices().len() as u64;
        // An open fan has one entry more than corners, so there are at most twice as many entries.
        if corner_count > u32::MAX as u64 / 2 {
            return Err(Error::TooLarge { what: "corners", found: corner_count, limit: u32::MAX as u64 / 2 });
        }
        if faces.len() as u64 > MAX_FACES {
            return Err(Error::TooLarge { what: "faces", found: faces.len() as u64, limit: MAX_FACES });
        }
        build::build(faces, vertex_count, threads, level)
    }

    /// The number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.flags.len()
    }

    /// The number of faces, ignored ones included.
    pub fn face_count(&self) -> usize {
        self.defects.face_count
    }

    /// The [`status`] bits of each vertex that follow from the faces alone.
    pub fn flags(&self) -> &[u8] {
        &self.flags
    }

    /// The neighbours of a vertex, fan after fan.
    ///
    /// # Panics
    /// Where `vertex` is not below [`Topology::vertex_count`]; likewise below.
    pub fn ring(&self, vertex: usize) -> &[u32] {
        self.rings.ring(vertex)
    }

    /// The rings of all vertices one after the other, as [`Topology::ring`] has them.
    pub fn ring_neighbours(&self) -> &[u32] {
        self.rings.neighbours()
    }

    /// Where each vertex's ring starts in [`Topology::ring_neighbours`], and the end of the last.
    pub fn ring_offsets(&self) -> &[u32] {
        self.rings.offsets()
    }

    /// The number of edges at a vertex. At a vertex with several fans this sorts a copy of its ring.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`]
    pub fn valence(&self, vertex: usize) -> Result<usize, Error> {
        let ring = self.ring(vertex);
        if self.fan_count(vertex) <= 1 {
            return Ok(ring.len());
        }
        Ok(sorted(ring)?.chunk_by(|a, b| a == b).count())
    }

    /// The number of fans of a vertex: 1 at a manifold vertex, 0 at an isolated one.
    pub fn fan_count(&self, vertex: usize) -> usize {
        match self.rings.class(vertex) {
            RingClass::Isolated => 0,
            RingClass::Lanes { .. } => 1,
            RingClass::Alone => self.fan_records(vertex).len(),
        }
    }

    /// The fans of a vertex.
    pub fn fans(&self, vertex: usize) -> impl Iterator<Item = Fan<'_>> {
        let ring = self.ring(vertex);
        let (single, several) = match self.rings.class(vertex) {
            RingClass::Isolated => (None, &[][..]),
            RingClass::Lanes { corners, closed } => {
                (Some(FanRecord { vertex: vertex as u32, start: 0, corners: corners as u32, closed }), &[][..])
            }
            RingClass::Alone => (None, self.fan_records(vertex)),
        };
        single.into_iter().chain(several.iter().copied()).map(move |record| record.fan(ring))
    }

    /// A fan of a vertex.
    ///
    /// # Panics
    /// Where `index` is not below [`Topology::fan_count`].
    pub fn fan(&self, vertex: usize, index: usize) -> Fan<'_> {
        match self.rings.class(vertex) {
            RingClass::Alone => self.fan_records(vertex)[index].fan(self.ring(vertex)),
            _ => self.fans(vertex).nth(index).unwrap_or_else(|| panic!("vertex {vertex} has no fan {index}")),
        }
    }

    fn fan_records(&self, vertex: usize) -> &[FanRecord] {
        let first = self.fans.partition_point(|fan| (fan.vertex as usize) < vertex);
        let count = self.fans[first..].partition_point(|fan| fan.vertex as usize == vertex);
        &self.fans[first..first + count]
    }

    /// How many edges a vertex has, the first of a closed fan counted twice.
    pub(crate) fn edges_alone(&self, vertex: usize) -> usize {
        self.ring(vertex).len() + self.fans(vertex).filter(|fan| fan.closed).count()
    }

    /// No less than [`Topology::edges_alone`] of any vertex of [`RingClass::Alone`].
    pub(crate) fn largest_alone(&self) -> usize {
        self.largest_alone
    }

    /// Heap memory held, in bytes.
    pub fn bytes(&self) -> usize {
        self.rings.bytes()
            + self.flags.capacity()
            + self.fans.capacity() * size_of::<FanRecord>()
            + self.polygons.as_ref().map_or(0, Polygons::bytes)
    }

    pub(crate) fn rings(&self) -> &Rings {
        &self.rings
    }

    pub(crate) fn polygons(&self) -> Option<&Polygons> {
        self.polygons.as_ref()
    }
}
