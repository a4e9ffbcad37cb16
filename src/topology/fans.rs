//! The slow path of the ring build: any set of corners around a vertex becomes fans.
//!
//! Two corners are joined across an edge exactly if the edge has two faces there and they run through it in opposite
//! directions. Whatever else an edge has (one face, two of the same direction, three or more) ends the fans on all its
//! sides. The rule does not depend on the order of faces. Cost: `m log m` for `m` corners.

use super::corners::Record;
use super::polygons::Polygons;
use super::stats::Defects;
use super::{Fan, NO_FACE, status};
use crate::error::Error;
use crate::view::RingPart;

/// A fan of a vertex that is not a lone closed one.
#[derive(Clone, Copy, Debug)]
pub(super) struct FanRecord {
    pub vertex: u32,
    /// Where it starts in the ring of the vertex.
    pub start: u32,
    pub corners: u32,
    pub closed: bool,
}

impl FanRecord {
    /// How many neighbours the fan has in the ring.
    pub fn entries(&self) -> usize {
        self.corners as usize + !self.closed as usize
    }

    /// The fan in the ring of its vertex.
    pub fn fan<'a>(&self, ring: &'a [u32]) -> Fan<'a> {
        let start = self.start as usize;
        let neighbours = &ring[start..start + self.entries()];
        Fan { neighbours, corner_count: self.corners as usize, closed: self.closed, start }
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
    /// Polygons that share an edge in the same direction with another: duplicates are among them.
    suspects: Vec<u32>,
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
            suspects: Vec::new(),
            defects: Defects::default(),
        }
    }

    /// Counts corners, those of lone closed fans among them.
    pub fn count_corners(&mut self, count: usize) {
        self.defects.corner_count += count;
    }

    /// Adds the fans of a vertex to its ring; answers the vertex's status bits and the lone fan, if it is one.
    pub fn add<R: Record>(
        &mut self,
        vertex: u32,
        records: &[R],
        rings: &mut RingPart<'_>,
    ) -> Result<(u8, Option<FanRecord>), Error> {
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
        // Open fans have an entry more than corners.
        rings.reserve(2 * count)?;
        self.by_next.extend(0..count as u32);
        self.by_prev.extend(0..count as u32);
        self.by_next.sort_unstable_by_key(|&corner| (records[corner as usize].next(), corner));
        self.by_prev.sort_unstable_by_key(|&corner| (records[corner as usize].prev(), corner));

        let mut flags = self.join(vertex, records)?;
        let first = self.fans.len();
        let ring_start = rings.entry_count();
        // Open fans start at a corner that follows none; what is left after them are closed ones.
        for open in [true, false] {
            for corner in 0..count {
                let starts = if open { !self.taken[corner] } else { self.successor[corner] != NONE };
                if starts {
                    self.emit(vertex, records, corner, !open, ring_start, rings);
                }
            }
        }
        if self.fans.len() - first > 1 {
            flags |= status::NON_MANIFOLD;
        }
        let lone = if let [fan] = self.fans[first..] { Some(fan) } else { None };
        Ok((flags, lone))
    }

    /// Finds each corner's successor, and counts what is wrong with the edges.
    fn join<R: Record>(&mut self, vertex: u32, records: &[R]) -> Result<u8, Error> {
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
            self.find_duplicates(vertex, records)?;
        }
        Ok(flags)
    }

    /// Writes the fan that starts at `corner`.
    fn emit<R: Record>(
        &mut self,
        vertex: u32,
        records: &[R],
        corner: usize,
        closed: bool,
        ring_start: usize,
        rings: &mut RingPart<'_>,
    ) {
        let start = rings.entry_count() - ring_start;
        let mut corners = 0;
        let mut current = corner;
        loop {
            let record = records[current];
            rings.push(&[record.next()], &[record.face().unwrap_or(NO_FACE)], 1);
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
            rings.push(&[records[current].prev()], &[NO_FACE], 1);
        }
        self.fans.push(FanRecord { vertex, start: start as u32, corners, closed });
    }

    /// Counts triangles that repeat an earlier one, at their lowest vertex, where they are told by their two other
    /// corners; collects polygons that may.
    fn find_duplicates<R: Record>(&mut self, vertex: u32, records: &[R]) -> Result<(), Error> {
        let next = |corner: &u32| records[*corner as usize].next();
        for run in self.by_next.chunk_by_mut(|a, b| next(a) == next(b)).filter(|run| run.len() > 1) {
            if self.polygons.is_some() {
                self.suspects.try_reserve(run.len())?;
                self.suspects.extend(run.iter().filter_map(|&corner| records[corner as usize].face()));
            } else if vertex < next(&run[0]) {
                run.sort_unstable_by_key(|&corner| records[corner as usize].prev());
                let prevs = run.windows(2).map(|pair| [0, 1].map(|i| records[pair[i] as usize].prev()));
                self.defects.duplicate_faces += prevs.filter(|[a, b]| a == b && vertex < *a).count();
            }
        }
        Ok(())
    }

    /// Takes over what another found at the vertices that follow.
    pub fn append(&mut self, mut other: FanBuilder<'a>) -> Result<(), Error> {
        self.fans.try_reserve(other.fans.len())?;
        self.fans.append(&mut other.fans);
        self.suspects.try_reserve(other.suspects.len())?;
        self.suspects.append(&mut other.suspects);
        self.defects.add(&other.defects);
        Ok(())
    }

    /// Counts polygons that repeat an earlier one, among those that share an edge in the same direction with another.
    fn count_duplicate_polygons(&mut self) {
        let Some(polygons) = self.polygons else { return };
        self.suspects.sort_unstable();
        self.suspects.dedup();
        // Each starts at its least rotation, so that equal loops are equal sequences.
        let least = |face: u32| {
            let corners = polygons.face(face as usize);
            let (tail, head) = corners.split_at(least_rotation(corners));
            head.iter().chain(tail)
        };
        let starts_alike = |a: &u32, b: &u32| polygons.face(*a as usize).len().cmp(&polygons.face(*b as usize).len());
        self.suspects.sort_unstable_by(|a, b| starts_alike(a, b).then_with(|| least(*a).cmp(least(*b))));
        let repeats = self.suspects.windows(2).filter(|pair| least(pair[0]).eq(least(pair[1])));
        self.defects.duplicate_faces += repeats.count();
    }

    pub fn finish(mut self) -> (Vec<FanRecord>, Defects) {
        self.count_duplicate_polygons();
        (self.fans, self.defects)
    }
}

/// Where the lexicographically least rotation of a loop starts, in linear time: two candidates run side by side, and the
/// one that loses a comparison gives way together with all starts that it has passed.
fn least_rotation(corners: &[u32]) -> usize {
    let count = corners.len();
    let (mut best, mut other, mut length) = (0, 1, 0);
    while best < count && other < count && length < count {
        let (a, b) = (corners[(best + length) % count], corners[(other + length) % count]);
        if a == b {
            length += 1;
            continue;
        }
        if a > b {
            best += length + 1;
        } else {
            other += length + 1;
        }
        other += (best == other) as usize;
        length = 0;
    }
    best.min(other)
}
