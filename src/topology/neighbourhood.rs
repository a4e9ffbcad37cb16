//! Neighbourhoods of several rings, gathered breadth first.
//!
//! The first ring of a vertex is every vertex that shares a face with it: in a mesh of triangles its edge neighbours, in a
//! quad the opposite corner as well. Ring `k + 1` is whatever the first rings of ring `k` add. The order is that of the
//! topology (fan after fan, counter-clockwise) and depends on nothing else.
//!
//! **Bounds.** No input makes a gather expensive. A neighbourhood holds at most [`MAX_NEIGHBOURS`] vertices; of a vertex
//! with more than [`MOST_ENTRIES`] ring entries, and of a face with more than [`MOST_CORNERS`] corners, an evenly spaced
//! subset is looked at, which depends on that vertex or face alone; and a gather looks at no more than [`MOST_LOOKS`]
//! entries. Where any of these cuts a neighbourhood short, it is what has been found so far.
//!
//! **In two steps.** The entries of many vertices are put into one row first, then those that are new are kept. The first step waits
//! for memory only, and for many vertices at a time; neither branches on what a CPU cannot guess: how long a ring is, and whether
//! a vertex is new. Which are, says the number of the gather that met a vertex last. Of a shuffled mesh these two bytes a vertex
//! stay in cache where positions do not.
//!
//! Cost: an entry a look; two bytes a vertex of the mesh, of which only pages are touched where neighbourhoods are, until they are
//! cleared after 65,535 gathers: on a mesh of 10⁸ vertices that is a fifth of the time.

use super::{NO_FACE, Polygons, Topology};
use crate::error::{Error, reserved};
use crate::view::{RingClass, zeroed};
use std::ops::Range;

/// A neighbourhood has no more vertices than this, the vertex itself not counted.
pub(crate) const MAX_NEIGHBOURS: usize = 255;

/// A neighbourhood has no more rings than this.
pub(crate) const MAX_RINGS: usize = 12;

/// Of a vertex with more ring entries than this, as many evenly spaced ones are looked at.
const MOST_ENTRIES: usize = 64;

/// Of a face with more corners than this, as many evenly spaced ones are looked at.
const MOST_CORNERS: usize = 32;

/// A gather looks at no more entries than this, give or take a row or those of a vertex.
const MOST_LOOKS: usize = 32 * MAX_NEIGHBOURS;

/// Entries are put in a row up to this many, or one vertex's more.
const ROW: usize = 512;

/// Rings of no more entries than this are copied at this length, whatever is behind them.
const COPIED: usize = 8;

/// The neighbourhood of one vertex after the other; its tables are reused.
pub(crate) struct Neighbourhood<'r> {
    /// The gather that met each vertex last.
    met: Vec<u16>,
    gather: u16,
    /// Whether it met those that are members; a neighbourhood of one ring need not know.
    marked: bool,
    /// Entries that were not looked at yet.
    row: [u32; ROW + MOST_ENTRIES + 8],
    waiting: usize,
    /// 1 for each that is met for the first time.
    new: [u8; ROW + MOST_ENTRIES + 8],
    /// The vertex itself, then ring after ring; with room for what is found before it is noticed to be too much.
    members: [u32; MAX_NEIGHBOURS + 2 + ROW + MOST_ENTRIES + 8],
    count: usize,
    /// Where each ring ends in `members`; the zeroth is the vertex itself.
    ends: [usize; MAX_RINGS + 1],
    rings: usize,
    looks: usize,
    full: bool,
    first: Option<&'r FirstRings>,
}

/// The first rings of all vertices of a mesh that has other faces than triangles, in the order in which a gather meets them: so
/// that a gather of all vertices looks at a face once for each of its corners.
///
/// Those with many entries are left out, and gathered where they are met.
pub(crate) struct FirstRings {
    offsets: Vec<u32>,
    entries: Vec<u32>,
    /// How many entries a gather looks at to find a ring: more than it has, since faces at a vertex share corners.
    looks: Vec<u16>,
}

impl FirstRings {
    /// None where all faces are triangles, or there are too many to count.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub(crate) fn new(topology: &Topology) -> Result<Option<Self>, Error> {
        if topology.polygons().is_none() {
            return Ok(None);
        }
        let count = topology.vertex_count();
        let (mut offsets, mut looks) = (reserved(count + 1)?, reserved(count)?);
        let mut entries: Vec<u32> = reserved(topology.ring_neighbours().len() * 2 + COPIED)?;
        let mut neighbourhood = Neighbourhood::new(topology)?;
        offsets.push(0);
        for vertex in 0..count as u32 {
            let found = neighbourhood.gather(topology, vertex, 1);
            if found.len() <= MOST_ENTRIES {
                entries.try_reserve(found.len() + COPIED)?;
                entries.extend_from_slice(found);
            }
            // Without a table, rings are gathered where they are met.
            let Ok(end) = u32::try_from(entries.len()) else { return Ok(None) };
            offsets.push(end);
            looks.push(neighbourhood.looks as u16);
        }
        // What is copied beyond the last ring.
        entries.extend_from_slice(&[0; COPIED]);
        Ok(Some(FirstRings { offsets, entries, looks }))
    }

    /// Copies a ring, with perhaps more behind it; answers with how long it is and how many looks it stands for, or with nothing
    /// if it is not here.
    #[inline(always)]
    fn copy(&self, vertex: u32, to: &mut [u32]) -> Option<(usize, usize)> {
        let vertex = vertex as usize;
        let (start, end) = (self.offsets[vertex] as usize, self.offsets[vertex + 1] as usize);
        if end - start <= COPIED {
            to[..COPIED].copy_from_slice(&self.entries[start..start + COPIED]);
        } else {
            to[..end - start].copy_from_slice(&self.entries[start..end]);
        }
        (end > start).then_some((end - start, self.looks[vertex] as usize))
    }
}

impl<'r> Neighbourhood<'r> {
    /// As [`Neighbourhood::new`], with the first rings of all vertices, which give the same neighbourhoods in less time.
    ///
    /// # Errors
    /// As [`Neighbourhood::new`].
    pub(crate) fn with_first_rings(topology: &Topology, first: Option<&'r FirstRings>) -> Result<Self, Error> {
        Ok(Neighbourhood { first, ..Self::new(topology)? })
    }

    /// For vertices of this topology.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub(crate) fn new(topology: &Topology) -> Result<Self, Error> {
        Ok(Neighbourhood {
            met: zeroed(topology.vertex_count())?,
            gather: 0,
            marked: false,
            row: [0; ROW + MOST_ENTRIES + 8],
            waiting: 0,
            new: [0; ROW + MOST_ENTRIES + 8],
            members: [0; MAX_NEIGHBOURS + 2 + ROW + MOST_ENTRIES + 8],
            count: 0,
            ends: [0; MAX_RINGS + 1],
            rings: 0,
            looks: 0,
            full: false,
            first: None,
        })
    }

    /// Gathers up to `rings` rings around a vertex; answers with their vertices, without the vertex itself.
    ///
    /// # Panics
    /// Where `vertex` is none.
    #[inline(always)]
    pub(crate) fn gather(&mut self, topology: &Topology, vertex: u32, rings: usize) -> &[u32] {
        self.gather = self.gather.wrapping_add(1);
        if self.gather == 0 {
            self.met.fill(0);
            self.gather = 1;
        }
        (self.count, self.rings, self.looks, self.full, self.marked) = (1, 0, 0, false, false);
        self.members[0] = vertex;
        self.ends[0] = 1;
        let closed = matches!(topology.rings().class(vertex as usize), RingClass::Lanes { closed: true, .. });
        if rings > 0 && closed && topology.polygons().is_none() {
            // The first ring of a closed fan of triangles, in which no vertex is twice.
            self.looks = copy_ring(topology, vertex, &mut self.members[1..]);
            self.count = 1 + self.looks;
            (self.rings, self.ends[1]) = (1, self.count);
        }
        while self.rings < rings && self.widen(topology) {}
        self.vertices()
    }

    /// Adds one more ring; answers whether that added a vertex.
    #[inline(always)]
    pub(crate) fn widen(&mut self, topology: &Topology) -> bool {
        if self.is_complete() {
            return false;
        }
        if !self.marked {
            self.members[..self.count].iter().for_each(|&member| self.met[member as usize] = self.gather);
            self.marked = true;
        }
        let first = if self.rings == 0 { 0 } else { self.ends[self.rings - 1] };
        let last = self.ends[self.rings];
        match topology.polygons() {
            None => self.put_triangles(topology, first..last),
            Some(polygons) => self.put_polygons(topology, polygons, first..last),
        }
        self.look();
        self.rings += 1;
        self.ends[self.rings] = self.count;
        self.count > last
    }

    /// All vertices, ring after ring, without the vertex itself.
    #[inline(always)]
    pub(crate) fn vertices(&self) -> &[u32] {
        &self.members[1..self.count]
    }

    /// How many rings were asked for so far; the last may be empty.
    pub(crate) fn rings(&self) -> usize {
        self.rings
    }

    /// How many vertices there are up to each ring, without the vertex itself; the zeroth ring has none.
    pub(crate) fn counts(&self) -> impl Iterator<Item = usize> {
        self.ends[..=self.rings].iter().map(|end| end - 1)
    }

    /// How many vertices there are within 1, 2 and 3 rings, and in all.
    #[inline(always)]
    pub(crate) fn counts_within(&self) -> [u32; 4] {
        let within = |rings: usize| self.ends[rings.min(self.rings)] as u32 - 1;
        [within(1), within(2), within(3), self.count as u32 - 1]
    }

    /// The vertices of a ring, counted from 1.
    pub(crate) fn ring(&self, ring: usize) -> &[u32] {
        &self.members[self.ends[ring - 1]..self.ends[ring]]
    }

    /// Forgets the outermost ring, and adds no more.
    pub(crate) fn drop_ring(&mut self) {
        self.rings -= 1;
        self.count = self.ends[self.rings];
        self.full = true;
    }

    /// Whether no further ring would add a vertex: the component is exhausted, or a bound is reached.
    #[inline(always)]
    pub(crate) fn is_complete(&self) -> bool {
        let exhausted = self.rings > 0 && self.ends[self.rings] == self.ends[self.rings - 1];
        self.full || exhausted || self.rings == MAX_RINGS
    }

    /// Puts the rings of some members into the row.
    #[inline(always)]
    fn put_triangles(&mut self, topology: &Topology, members: Range<usize>) {
        for member in members {
            let length = copy_ring(topology, self.members[member], &mut self.row[self.waiting..]);
            (self.waiting, self.looks) = (self.waiting + length, self.looks + length);
            if self.waiting > ROW && !self.look() {
                return;
            }
        }
    }

    /// As [`Neighbourhood::put_triangles`], with all corners of the members' faces.
    ///
    /// Looks are counted member by member, so that neighbourhoods are cut off at the same place with a table of first rings and
    /// without.
    #[inline(never)]
    fn put_polygons(&mut self, topology: &Topology, polygons: &Polygons, members: Range<usize>) {
        for member in members {
            let known = self.first.and_then(|rings| rings.copy(self.members[member], &mut self.row[self.waiting..]));
            match known {
                Some((length, looks)) => {
                    (self.waiting, self.looks) = (self.waiting + length, self.looks + looks);
                }
                None => self.put_faces(topology, polygons, self.members[member]),
            }
            if (self.waiting > ROW || self.looks > MOST_LOOKS) && !self.look() {
                return;
            }
        }
    }

    /// Puts all corners of a vertex's faces into the row.
    #[inline(never)]
    fn put_faces(&mut self, topology: &Topology, polygons: &Polygons, vertex: u32) {
        let range = topology.rings().ring_range(vertex as usize);
        let mut looks = 0;
        for entry in spaced(range.len(), MOST_ENTRIES).map(|entry| range.start + entry) {
            self.put(topology.ring_neighbours()[entry]);
            looks += 1;
            let face = polygons.corner_face(entry);
            // The corners of a triangle are neighbours along edges.
            let corners = if face == NO_FACE { &[] } else { polygons.face(face as usize) };
            if corners.len() > 3 {
                spaced(corners.len(), MOST_CORNERS).for_each(|corner| self.put(corners[corner]));
                looks += corners.len().min(MOST_CORNERS);
            }
            if self.waiting > ROW {
                self.look();
            }
        }
        self.looks += looks;
    }

    fn put(&mut self, vertex: u32) {
        self.row[self.waiting] = vertex;
        self.waiting += 1;
    }

    /// Adds what is new of the row to the members, and cuts off what is too much; answers whether it may go on.
    #[inline(always)]
    fn look(&mut self) -> bool {
        // First which are new, then where they go: in one pass each load seems to wait for where the vertex before it goes, and two
        // rings take half as long again. Eight at a time, filled up with the vertex itself, which is not new.
        let length = self.waiting.next_multiple_of(8);
        self.row[self.waiting..length].fill(self.members[0]);
        let (row, gather) = (&self.row[..length], self.gather);
        let new = &mut self.new[..length];
        for (new, row) in new.chunks_exact_mut(8).zip(row.chunks_exact(8)) {
            for (new, &vertex) in new.iter_mut().zip(row) {
                let met = &mut self.met[vertex as usize];
                *new = (*met != gather) as u8;
                *met = gather;
            }
        }
        let mut count = self.count;
        for (new, row) in new.chunks_exact(8).zip(row.chunks_exact(8)) {
            let members = &mut self.members[count..count + 8];
            let mut place = 0;
            for (&new, &vertex) in new.iter().zip(row) {
                members[place % 8] = vertex;
                place += new as usize;
            }
            count += place;
        }
        self.waiting = 0;
        self.count = count.min(MAX_NEIGHBOURS + 1);
        self.full |= count > MAX_NEIGHBOURS + 1 || self.looks > MOST_LOOKS;
        !self.full
    }
}

/// Copies what is looked at of a ring, without a loop if the ring is short; answers with how much that is.
#[inline(always)]
fn copy_ring(topology: &Topology, vertex: u32, to: &mut [u32]) -> usize {
    let (entries, range) = (topology.ring_neighbours(), topology.rings().ring_range(vertex as usize));
    let length = range.len();
    match entries.get(range.start..range.start + COPIED) {
        Some(copied) if length <= COPIED => to[..COPIED].copy_from_slice(copied),
        _ => {
            for (place, entry) in to.iter_mut().zip(spaced(length, MOST_ENTRIES)) {
                *place = entries[range.start + entry];
            }
        }
    }
    length.min(MOST_ENTRIES)
}

/// `0..count`, or `most` evenly spaced of them.
#[inline(always)]
fn spaced(count: usize, most: usize) -> impl Iterator<Item = usize> {
    let taken = count.min(most);
    (0..taken).map(move |index| (index as u64 * count as u64 / taken as u64) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::Faces;
    use std::collections::BTreeSet;

    /// A generator of numbers below a limit.
    fn random(seed: u64) -> impl FnMut(u64) -> u64 {
        let mut state = seed;
        move |limit| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) % limit
        }
    }

    /// Vertices by their distance through faces.
    fn naive(faces: &[Vec<u32>], vertex: u32, rings: usize) -> Vec<BTreeSet<u32>> {
        let mut levels = vec![BTreeSet::from([vertex])];
        let mut seen = BTreeSet::from([vertex]);
        for _ in 0..rings {
            let outer = levels.last().unwrap();
            let mut next = BTreeSet::new();
            for face in faces.iter().filter(|face| face.iter().any(|corner| outer.contains(corner))) {
                next.extend(face.iter().filter(|corner| !seen.contains(corner)));
            }
            seen.extend(&next);
            levels.push(next);
        }
        levels
    }

    fn topology(faces: &[Vec<u32>], vertex_count: usize) -> Topology {
        let indices: Vec<u32> = faces.iter().flatten().copied().collect();
        let mut offsets = vec![0u32];
        faces.iter().for_each(|face| offsets.push(offsets.last().unwrap() + face.len() as u32));
        let faces = Faces::polygons(&indices[..], &offsets[..]).unwrap();
        Topology::new(&faces, vertex_count).unwrap()
    }

    /// Rings against a search over all faces, on soups and on grids, gathered at once and ring by ring.
    #[test]
    fn rings_are_those_of_a_search_over_all_faces() {
        let mut below = random(3);
        for round in 0..60 {
            let count = 30 + below(60) as usize;
            let faces: Vec<Vec<u32>> = if round % 2 == 0 {
                // A soup, of triangles in every other case.
                (0..count)
                    .map(|_| {
                        let corners = if round % 4 == 0 { 3 } else { 3 + below(4) as usize };
                        let mut face: Vec<u32> = Vec::new();
                        while face.len() < corners {
                            let vertex = below(count as u64) as u32;
                            if !face.contains(&vertex) {
                                face.push(vertex);
                            }
                        }
                        face
                    })
                    .collect()
            } else {
                let side = 6 + below(4) as u32;
                let at = |x: u32, y: u32| y * (side + 1) + x;
                let cells = (0..side * side).map(|cell| (cell % side, cell / side));
                cells
                    .flat_map(|(x, y)| {
                        let quad = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
                        match (round / 2 + x as usize) % 3 {
                            0 => vec![quad.to_vec()],
                            _ => vec![vec![quad[0], quad[1], quad[2]], vec![quad[0], quad[2], quad[3]]],
                        }
                    })
                    .collect()
            };
            let vertex_count = faces.iter().flatten().max().unwrap() + 1;
            let topology = topology(&faces, vertex_count as usize);
            let mut shared = Neighbourhood::new(&topology).unwrap();
            let table = FirstRings::new(&topology).unwrap();
            let mut with_table = Neighbourhood::with_first_rings(&topology, table.as_ref()).unwrap();
            for vertex in 0..vertex_count {
                let expected = naive(&faces, vertex, 4);
                let found: Vec<u32> = shared.gather(&topology, vertex, 3).to_vec();
                assert!(!found.contains(&vertex));
                assert_eq!(with_table.gather(&topology, vertex, 3), found);
                let all: BTreeSet<u32> = found.iter().copied().collect();
                assert_eq!(all.len(), found.len(), "repeated");
                assert_eq!(all, expected[1..4].iter().flatten().copied().collect(), "round {round}");
                for (ring, expected) in expected.iter().enumerate().take(shared.rings() + 1).skip(1) {
                    assert_eq!(&shared.ring(ring).iter().copied().collect::<BTreeSet<u32>>(), expected);
                }
                let grew = shared.widen(&topology);
                assert_eq!(grew, !expected[4].is_empty());
                assert!(grew || shared.is_complete());
                let mut fresh = Neighbourhood::new(&topology).unwrap();
                assert_eq!(fresh.gather(&topology, vertex, 4), shared.vertices());
                shared.gather(&topology, vertex, 1);
                while shared.rings() < 4 && shared.widen(&topology) {}
                assert_eq!(fresh.vertices(), shared.vertices());
                if grew {
                    shared.drop_ring();
                    assert_eq!(shared.vertices(), found);
                    assert!(shared.is_complete() && !shared.widen(&topology));
                }
            }
        }
    }

    /// Hubs, huge polygons and dense soups: bounded, and each vertex once.
    #[test]
    fn bounds_hold() {
        const RIM: u32 = 5000;
        let fan: Vec<Vec<u32>> = (0..RIM).map(|rim| vec![RIM, rim, (rim + 1) % RIM]).collect();
        let polygon = vec![(0..RIM).collect::<Vec<u32>>()];
        let mut below = random(5);
        let mut dense = |vertices: u64| -> Vec<Vec<u32>> {
            (0..20_000).map(|_| (0..4).map(|_| below(vertices) as u32).collect()).collect()
        };
        // One that fills a neighbourhood at once, and one that has too few vertices for that but many ways to each.
        for faces in [fan, polygon, dense(400), dense(200)] {
            let vertex_count = *faces.iter().flatten().max().unwrap() as usize + 1;
            let topology = topology(&faces, vertex_count);
            let mut neighbourhood = Neighbourhood::new(&topology).unwrap();
            let table = FirstRings::new(&topology).unwrap();
            assert_eq!(table.is_some(), topology.polygons().is_some());
            let mut with_table = Neighbourhood::with_first_rings(&topology, table.as_ref()).unwrap();
            for vertex in (0..vertex_count as u32).rev().take(500) {
                for rings in [1, 2, 8] {
                    let found = neighbourhood.gather(&topology, vertex, rings).to_vec();
                    assert!((1..=MAX_NEIGHBOURS).contains(&found.len()));
                    assert_eq!(found.iter().collect::<BTreeSet<_>>().len(), found.len());
                    assert!(neighbourhood.looks <= MOST_LOOKS + ROW + MOST_ENTRIES * (1 + MOST_CORNERS));
                    // A table of first rings changes nothing, where gathers are cut off least of all.
                    assert_eq!(with_table.gather(&topology, vertex, rings), found);
                    assert_eq!(with_table.full, neighbourhood.full);
                    // The neighbours along edges are there, however large the face.
                    if topology.ring(vertex as usize).len() <= 2 {
                        assert!(topology.ring(vertex as usize).iter().all(|neighbour| found.contains(neighbour)));
                    }
                }
            }
        }
    }

    /// The number of a gather comes round without mistaking old entries for new ones.
    #[test]
    fn gathers_may_be_counted_past_the_end() {
        let topology = topology(&[vec![0, 1, 2], vec![2, 1, 3]], 4);
        let mut neighbourhood = Neighbourhood::new(&topology).unwrap();
        neighbourhood.gather(&topology, 0, 2);
        neighbourhood.gather = u16::MAX - 1;
        for _ in 0..4 {
            assert_eq!(neighbourhood.gather(&topology, 0, 1), [1, 2]);
            assert_eq!(neighbourhood.gather(&topology, 3, 2), [2, 1, 0]);
        }
        // Numbers of the first gather, then the second first gather; and none.
        for before in [Some(0), None] {
            let mut neighbourhood = Neighbourhood::new(&topology).unwrap();
            before.map(|vertex| neighbourhood.gather(&topology, vertex, 2).len());
            neighbourhood.gather = u16::MAX;
            assert_eq!(neighbourhood.gather(&topology, 3, 2), [2, 1, 0]);
        }
    }
}
