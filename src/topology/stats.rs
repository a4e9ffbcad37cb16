//! Counts of a mesh: elements, defects, components, boundary loops.

use super::{Topology, sorted, status};
use crate::error::{Error, filled};

/// Counted while the rings are built.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Defects {
    pub face_count: usize,
    pub used_faces: usize,
    /// Corners of the faces that are not ignored, without repetitions.
    pub corner_count: usize,
    pub degenerate_faces: usize,
    pub duplicate_faces: usize,
    pub boundary_edges: usize,
    pub winding_edges: usize,
    pub non_manifold_edges: usize,
}

impl Defects {
    /// Adds the counts of other vertices of the same faces.
    pub fn add(&mut self, other: &Defects) {
        self.corner_count += other.corner_count;
        self.duplicate_faces += other.duplicate_faces;
        self.boundary_edges += other.boundary_edges;
        self.winding_edges += other.winding_edges;
        self.non_manifold_edges += other.non_manifold_edges;
    }
}

/// What a mesh is made of, and what is wrong with it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TopologyStats {
    /// Vertices.
    pub vertex_count: usize,
    /// Faces, ignored ones included.
    pub face_count: usize,
    /// Corners of the faces that are not ignored.
    pub corner_count: usize,
    /// Edges, each counted once however many faces it has.
    pub edge_count: usize,
    /// Edges with one face.
    pub boundary_edges: usize,
    /// Edges with more than two faces.
    pub non_manifold_edges: usize,
    /// Edges whose two faces run through them in the same direction.
    pub winding_edges: usize,
    /// Vertices without a face.
    pub isolated_vertices: usize,
    /// Vertices on an edge with one face.
    pub boundary_vertices: usize,
    /// Vertices whose faces do not form a single fan.
    pub non_manifold_vertices: usize,
    /// Faces that name a vertex twice in a row, or that have fewer than three corners.
    pub degenerate_faces: usize,
    /// Degenerate faces of which fewer than three corners remain: they are ignored.
    pub ignored_faces: usize,
    /// Faces that run through the same vertices in the same order as an earlier one. They count like any other.
    pub duplicate_faces: usize,
    /// Pieces, connected through shared vertices; isolated vertices are not counted.
    pub component_count: usize,
    /// Closed loops of edges with one face. At a vertex with several fans the loop follows the fan.
    pub boundary_loops: usize,
    /// Vertices that have faces, minus edges, plus faces that are not ignored.
    pub euler_characteristic: i64,
    /// The largest number of edges at a vertex.
    pub max_valence: usize,
    /// Heap memory that the topology holds, in bytes.
    pub bytes: usize,
}

impl Topology {
    /// Counts elements, defects, components and boundary loops. Cost: linear, with temporary memory of 4 bytes a
    /// vertex.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn stats(&self) -> Result<TopologyStats, Error> {
        let defects = &self.defects;
        let mut stats = TopologyStats {
            vertex_count: self.vertex_count(),
            face_count: defects.face_count,
            corner_count: defects.corner_count,
            boundary_edges: defects.boundary_edges,
            non_manifold_edges: defects.non_manifold_edges,
            winding_edges: defects.winding_edges,
            degenerate_faces: defects.degenerate_faces,
            ignored_faces: defects.face_count - defects.used_faces,
            duplicate_faces: defects.duplicate_faces,
            bytes: self.bytes(),
            ..TopologyStats::default()
        };
        let mut ends = 0;
        for (vertex, &flags) in self.flags.iter().enumerate() {
            let valence = self.valence(vertex)?;
            ends += valence;
            stats.max_valence = stats.max_valence.max(valence);
            stats.isolated_vertices += (flags & status::ISOLATED != 0) as usize;
            stats.boundary_vertices += (flags & status::BOUNDARY != 0) as usize;
            stats.non_manifold_vertices += (flags & status::NON_MANIFOLD != 0) as usize;
        }
        // Both ends of an edge see it.
        stats.edge_count = ends / 2;
        let used = stats.vertex_count - stats.isolated_vertices;
        stats.euler_characteristic = used as i64 - stats.edge_count as i64 + defects.used_faces as i64;
        stats.component_count = self.count_components()?;
        stats.boundary_loops = self.count_boundary_loops()?;
        Ok(stats)
    }

    fn count_components(&self) -> Result<usize, Error> {
        let mut parents: Vec<u32> = filled(self.vertex_count(), 0)?;
        for (vertex, parent) in parents.iter_mut().enumerate() {
            *parent = vertex as u32;
        }
        let (mut used, mut joined) = (0, 0);
        for vertex in 0..self.vertex_count() {
            used += !self.ring(vertex).is_empty() as usize;
            for &neighbour in self.ring(vertex) {
                let (a, b) = (root(&mut parents, vertex as u32), root(&mut parents, neighbour));
                if a != b {
                    parents[a.max(b) as usize] = a.min(b);
                    joined += 1;
                }
            }
        }
        Ok(used - joined)
    }

    /// An open fan that ends at a boundary edge is followed, across that edge, by the open fan of the neighbour that
    /// starts at it; a loop is a cycle of these steps.
    fn count_boundary_loops(&self) -> Result<usize, Error> {
        /// An open fan: its vertex and the neighbours at its two ends.
        struct Open {
            vertex: u32,
            first: u32,
            last: u32,
            visited: bool,
        }
        let mut open: Vec<Open> = Vec::new();
        for (vertex, &flags) in self.flags.iter().enumerate() {
            if flags & status::BOUNDARY == 0 {
                continue;
            }
            // An edge with one face ends one fan; with more it stands in the ring as often as it has sides there.
            let ring = if self.fan_count(vertex) > 1 { sorted(self.ring(vertex))? } else { Vec::new() };
            let on_boundary = |edge: u32| {
                let first = ring.partition_point(|&other| other < edge);
                ring.get(first + 1) != Some(&edge)
            };
            for fan in self.fans(vertex) {
                if let (false, &[first, .., last]) = (fan.closed, fan.neighbours)
                    && on_boundary(last)
                {
                    open.try_reserve(1)?;
                    open.push(Open { vertex: vertex as u32, first, last, visited: false });
                }
            }
        }
        // The fans of a vertex are few, except on purpose: sorted by their start, each is found by bisection.
        open.sort_unstable_by_key(|fan| (fan.vertex, fan.first));
        let follow = |open: &[Open], fan: usize| {
            let key = (open[fan].last, open[fan].vertex);
            let found = open.partition_point(|other| (other.vertex, other.first) < key);
            let matches = open[found..].iter().take(2).filter(|other| (other.vertex, other.first) == key).count();
            (matches == 1).then_some(found)
        };
        let mut loops = 0;
        for start in 0..open.len() {
            let mut fan = start;
            while !open[fan].visited {
                open[fan].visited = true;
                match follow(&open, fan) {
                    Some(next) if next == start => {
                        loops += 1;
                        break;
                    }
                    Some(next) => fan = next,
                    None => break,
                }
            }
        }
        Ok(loops)
    }
}

fn root(parents: &mut [u32], mut vertex: u32) -> u32 {
    while parents[vertex as usize] != vertex {
        let grandparent = parents[parents[vertex as usize] as usize];
        parents[vertex as usize] = grandparent;
        vertex = grandparent;
    }
    vertex
}
