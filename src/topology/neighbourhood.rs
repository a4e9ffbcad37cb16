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
//! Which vertices are in it already is asked of a small hash table that stays in the first-level cache. Its entries carry
//! the number of the gather that wrote them, so it is never cleared.
//!
//! Cost: an entry a look; no memory of the mesh's size, and none from the heap.

use super::{NO_FACE, Polygons, Topology};

/// A neighbourhood has no more vertices than this, the vertex itself not counted.
pub(crate) const MAX_NEIGHBOURS: usize = 255;

/// A neighbourhood has no more rings than this.
pub(crate) const MAX_RINGS: usize = 12;

/// Of a vertex with more ring entries than this, as many evenly spaced ones are looked at.
const MOST_ENTRIES: usize = 64;

/// Of a face with more corners than this, as many evenly spaced ones are looked at.
const MOST_CORNERS: usize = 32;

/// A gather looks at no more entries than this, give or take one vertex's.
const MOST_LOOKS: usize = 32 * MAX_NEIGHBOURS;

/// Slots of the hash table: a power of two, and more than twice what a gather puts into it before it notices that it is
/// full.
const SLOTS: usize = 1024;
const SHIFT: u32 = 32 - SLOTS.trailing_zeros();
const _: () = assert!(SLOTS > 2 * (MAX_NEIGHBOURS + 1 + MOST_ENTRIES));

/// The neighbourhood of one vertex after the other; its tables are reused.
pub(crate) struct Neighbourhood {
    /// The gather that wrote the entry, and the vertex.
    table: [u64; SLOTS],
    gather: u32,
    /// The vertex itself, then ring after ring; with room for what is found before it is noticed to be too much.
    members: [u32; MAX_NEIGHBOURS + 2 + MOST_ENTRIES],
    count: usize,
    /// Where each ring ends in `members`; the zeroth is the vertex itself.
    ends: [usize; MAX_RINGS + 1],
    rings: usize,
    looks: usize,
    full: bool,
}

impl Neighbourhood {
    pub(crate) fn new() -> Self {
        Neighbourhood {
            table: [0; SLOTS],
            gather: 0,
            members: [0; MAX_NEIGHBOURS + 2 + MOST_ENTRIES],
            count: 0,
            ends: [0; MAX_RINGS + 1],
            rings: 0,
            looks: 0,
            full: false,
        }
    }

    /// Gathers up to `rings` rings around a vertex; answers with their vertices, without the vertex itself.
    ///
    /// # Panics
    /// Where `vertex` is none.
    #[inline(always)]
    pub(crate) fn gather(&mut self, topology: &Topology, vertex: u32, rings: usize) -> &[u32] {
        self.gather = self.gather.wrapping_add(1);
        if self.gather == 0 {
            self.table = [0; SLOTS];
            self.gather = 1;
        }
        (self.count, self.rings, self.looks, self.full) = (0, 0, 0, false);
        self.count = self.insert(vertex, 0);
        self.ends[0] = 1;
        while self.rings < rings && self.widen(topology) {}
        self.vertices()
    }

    /// Adds one more ring; answers whether that added a vertex.
    #[inline(always)]
    pub(crate) fn widen(&mut self, topology: &Topology) -> bool {
        if self.is_complete() {
            return false;
        }
        let first = if self.rings == 0 { 0 } else { self.ends[self.rings - 1] };
        let last = self.ends[self.rings];
        for member in first..last {
            match topology.polygons() {
                None => self.expand_triangles(topology.rings().ring(self.members[member] as usize)),
                Some(polygons) => self.expand_polygons(topology, polygons, self.members[member] as usize),
            }
            if self.full {
                break;
            }
        }
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

    #[inline(always)]
    fn expand_triangles(&mut self, ring: &[u32]) {
        // In a register while it grows.
        let mut count = self.count;
        if ring.len() <= MOST_ENTRIES {
            for &neighbour in ring {
                count = self.insert(neighbour, count);
            }
        } else {
            for entry in spaced(ring.len(), MOST_ENTRIES) {
                count = self.insert(ring[entry], count);
            }
        }
        self.count = count;
        self.note(ring.len().min(MOST_ENTRIES));
    }

    fn expand_polygons(&mut self, topology: &Topology, polygons: &Polygons, vertex: usize) {
        let range = topology.rings().ring_range(vertex);
        let ring = topology.ring(vertex);
        for entry in spaced(ring.len(), MOST_ENTRIES) {
            let mut count = self.insert(ring[entry], self.count);
            let face = polygons.corner_face(range.start + entry);
            // The corners of a triangle are neighbours along edges.
            let corners = if face == NO_FACE { &[] } else { polygons.face(face as usize) };
            if corners.len() > 3 {
                for corner in spaced(corners.len(), MOST_CORNERS) {
                    count = self.insert(corners[corner], count);
                }
            }
            self.count = count;
            self.note(1 + corners.len().min(MOST_CORNERS));
            if self.full {
                break;
            }
        }
    }

    /// Counts looks, and cuts off what is too much.
    #[inline(always)]
    fn note(&mut self, looks: usize) {
        self.looks += looks;
        if self.count > MAX_NEIGHBOURS + 1 || self.looks > MOST_LOOKS {
            self.count = self.count.min(MAX_NEIGHBOURS + 1);
            self.full = true;
        }
    }

    /// Adds a vertex to `count` members, if it is not in yet; answers with their number then. Written so that nothing is branched on but collisions in the table, which are
    /// rare: whether a vertex is new is what a CPU cannot guess.
    #[inline(always)]
    fn insert(&mut self, vertex: u32, count: usize) -> usize {
        let entry = (self.gather as u64) << 32 | vertex as u64;
        let mut slot = (vertex.wrapping_mul(0x9e37_79b1) >> SHIFT) as usize;
        let mut found = self.table[slot];
        while (found >> 32) as u32 == self.gather && found != entry {
            slot = (slot + 1) % SLOTS;
            found = self.table[slot];
        }
        self.table[slot] = entry;
        self.members[count] = vertex;
        count + (found != entry) as usize
    }
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
        let mut shared = Neighbourhood::new();
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
            for vertex in 0..vertex_count {
                let expected = naive(&faces, vertex, 4);
                let found: Vec<u32> = shared.gather(&topology, vertex, 3).to_vec();
                assert!(!found.contains(&vertex));
                let all: BTreeSet<u32> = found.iter().copied().collect();
                assert_eq!(all.len(), found.len(), "repeated");
                assert_eq!(all, expected[1..4].iter().flatten().copied().collect(), "round {round}");
                for (ring, expected) in expected.iter().enumerate().take(shared.rings() + 1).skip(1) {
                    assert_eq!(&shared.ring(ring).iter().copied().collect::<BTreeSet<u32>>(), expected);
                }
                let grew = shared.widen(&topology);
                assert_eq!(grew, !expected[4].is_empty());
                assert!(grew || shared.is_complete());
                let mut fresh = Neighbourhood::new();
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
            let mut neighbourhood = Neighbourhood::new();
            for vertex in (0..vertex_count as u32).rev().take(500) {
                for rings in [1, 2, 8] {
                    let found = neighbourhood.gather(&topology, vertex, rings).to_vec();
                    assert!((1..=MAX_NEIGHBOURS).contains(&found.len()));
                    assert_eq!(found.iter().collect::<BTreeSet<_>>().len(), found.len());
                    assert!(neighbourhood.looks <= MOST_LOOKS + MOST_ENTRIES + MOST_CORNERS);
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
        let mut neighbourhood = Neighbourhood::new();
        neighbourhood.gather(&topology, 0, 2);
        neighbourhood.gather = u32::MAX - 1;
        for _ in 0..4 {
            assert_eq!(neighbourhood.gather(&topology, 0, 1), [1, 2]);
            assert_eq!(neighbourhood.gather(&topology, 3, 2), [2, 1, 0]);
        }
        // Entries of the first gather, then the second first gather; and an empty table, which must not look like vertex 0.
        for before in [Some(0), None] {
            let mut neighbourhood = Neighbourhood::new();
            before.map(|vertex| neighbourhood.gather(&topology, vertex, 2).len());
            neighbourhood.gather = u32::MAX;
            assert_eq!(neighbourhood.gather(&topology, 3, 2), [2, 1, 0]);
        }
    }
}
