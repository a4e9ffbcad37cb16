//! The slow path of the ring build: any set of corners around a vertex becomes fans.
//!
//! Two corners are joined across an edge exactly if the edge has two faces there and they run through it in opposite
//! directions. Whatever else an edge has (one face, two of the same direction, three or more) ends the fans on all its
//! sides. The rule does not depend on the order of faces. Cost: `m log m` for `m` corners.

use super::flat::{Flat, NO_FACE, Record};
use super::polygons::Polygons;
use super::stats::Defects;
use super::status;
use crate::error::Error;

/// A fan of a vertex that is not a lone closed one.
#[derive(Clone, Copy, Debug)]
pub(super) struct FanRecord {
    pub vertex: u32,
    pub corners: u32,
    pub closed: bool,
}

impl FanRecord {
    /// How many neighbours the fan has in the ring.
    pub fn entries(&self) -> usize {
        self.corners as usize + !self.closed as usize
    }
}

const NONE: u32 = u32::MAX;

/// Collects fans and defects, vertex after vertex; its buffers are reused.
pub(super) struct FanBuilder<'a> {
    polygons: Option<&'a Polygons>,
    by_next: Vec<u32>,
    by_prev: Vec<u32>,
    /// The corner that follows each corner counter-clockwise.
    successor: Vec<u32>,
    /// Whether a corner follows another that has not been emitted yet, or has been emitted itself.
    taken: Vec<bool>,
    fans: Vec<FanRecord>,
    defects: Defects,
}

impl<'a> FanBuilder<'a> {
    pub fn new(polygons: Option<&'a Polygons>) -> Self {
        FanBuilder {
            polygons,
            by_next: Vec::new(),
            by_prev: Vec::new(),
            successor: Vec::new(),
            taken: Vec::new(),
            fans: Vec::new(),
            defects: Defects::default(),
        }
    }

    /// Adds the fans of a vertex to the flat arrays; answers the vertex's status bits.
    pub fn add<R: Record>(&mut self, vertex: u32, records: &[R], flat: &mut Flat) -> Result<u8, Error> {
        let count = records.len();
        for buffer in [&mut self.by_next, &mut self.by_prev, &mut self.successor] {
            buffer.clear();
            buffer.try_reserve(count)?;
        }
        self.taken.clear();
        self.taken.try_reserve(count)?;
        self.taken.resize(count, false);
        self.fans.try_reserve(count)?;
        self.successor.resize(count, NONE);
        self.by_next.extend(0..count as u32);
        self.by_prev.extend(0..count as u32);
        self.by_next.sort_unstable_by_key(|&corner| (records[corner as usize].next(), corner));
        self.by_prev.sort_unstable_by_key(|&corner| (records[corner as usize].prev(), corner));

        let mut flags = self.join(vertex, records);
        let first = self.fans.len();
        // Open fans start at a corner that follows none; what is left after them are closed ones.
        for open in [true, false] {
            for corner in 0..count {
                let starts = if open { !self.taken[corner] } else { self.successor[corner] != NONE };
                if starts {
                    self.emit(vertex, records, corner, !open, flat)?;
                }
            }
        }
        if self.fans.len() - first > 1 {
            flags |= status::NON_MANIFOLD;
        }
        Ok(flags)
    }

    /// Finds each corner's successor, and counts what is wrong with the edges.
    fn join<R: Record>(&mut self, vertex: u32, records: &[R]) -> u8 {
        let mut flags = 0;
        let (mut out, mut into) = (self.by_next.as_slice(), self.by_prev.as_slice());
        let mut repeated = false;
        loop {
            let next = out.first().map(|&corner| records[corner as usize].next());
            let prev = into.first().map(|&corner| records[corner as usize].prev());
            let Some(neighbour) = next.into_iter().chain(prev).min() else { break };
            let outgoing = out.partition_point(|&corner| records[corner as usize].next() == neighbour);
            let incoming = into.partition_point(|&corner| records[corner as usize].prev() == neighbour);
            // Each edge is counted from its lower end.
            let counts = (vertex < neighbour) as usize;
            match (outgoing, incoming) {
                (1, 1) => {
                    self.successor[into[0] as usize] = out[0];
                    self.taken[out[0] as usize] = true;
                }
                (1, 0) | (0, 1) => {
                    flags |= status::BOUNDARY;
                    self.defects.boundary_edges += counts;
                }
                (2, 0) | (0, 2) => {
                    flags |= status::WINDING;
                    self.defects.winding_edges += counts;
                }
                _ => {
                    flags |= status::NON_MANIFOLD;
                    self.defects.non_manifold_edges += counts;
                }
            }
            repeated |= outgoing > 1;
            out = &out[outgoing..];
            into = &into[incoming..];
        }
        if repeated {
            self.count_duplicates(vertex, records);
        }
        flags
    }

    /// Writes the fan that starts at `corner`.
    fn emit<R: Record>(
        &mut self,
        vertex: u32,
        records: &[R],
        corner: usize,
        closed: bool,
        flat: &mut Flat,
    ) -> Result<(), Error> {
        let mut corners = 0;
        let mut current = corner;
        loop {
            let record = records[current];
            flat.push(record.next(), record.face().unwrap_or(NO_FACE))?;
            self.taken[current] = true;
            corners += 1;
            // A corner without a successor is never a start again.
            let next = std::mem::replace(&mut self.successor[current], NONE);
            if next == NONE || next == corner as u32 {
                break;
            }
            current = next as usize;
        }
        if !closed {
            flat.push(records[current].prev(), NO_FACE)?;
        }
        self.fans.push(FanRecord { vertex, corners, closed });
        Ok(())
    }

    /// Counts faces that repeat an earlier one, at their lowest vertex.
    fn count_duplicates<R: Record>(&mut self, vertex: u32, records: &[R]) {
        // A triangle is told by its two other corners; a polygon by all of them, from `vertex` on.
        let polygons = self.polygons;
        let face = |corner: u32| match (polygons, records[corner as usize].face()) {
            (Some(polygons), Some(face)) => polygons.face(face as usize),
            _ => &[],
        };
        let key = |corner: u32| {
            let record = records[corner as usize];
            let corners = face(corner);
            let start = corners.iter().position(|&other| other == vertex).unwrap_or(0);
            let around = corners[start..].iter().chain(&corners[..start]).copied();
            (record.next(), record.prev(), around)
        };
        let compare = |a: u32, b: u32| {
            let (a, b) = (key(a), key(b));
            (a.0, a.1).cmp(&(b.0, b.1)).then_with(|| a.2.cmp(b.2))
        };
        self.by_next.sort_unstable_by(|&a, &b| compare(a, b));
        let lowest = |corner: u32| {
            let record = records[corner as usize];
            vertex < record.next().min(record.prev()) && face(corner).iter().all(|&other| vertex <= other)
        };
        let repeats = self.by_next.windows(2).filter(|pair| compare(pair[0], pair[1]).is_eq() && lowest(pair[0]));
        self.defects.duplicate_faces += repeats.count();
    }

    pub fn finish(self) -> (Vec<FanRecord>, Defects) {
        (self.fans, self.defects)
    }
}
