//! A mesh cut open along its creases: a vertex for each run of faces around a vertex that no crease divides.
//!
//! On the cut mesh everything that looks at rings stops at creases by itself: vertex normals become corner normals, and fits and curvatures of one
//! side take nothing from the other. Positions are those of the original vertices.
//!
//! Corners at a vertex belong together if they can be reached from each other through edges at the vertex that two faces share (by the
//! rule of [`Topology`]) and that are no creases. So a vertex with several fans is cut between them, creases or none; a crease that ends in the middle of
//! a smooth part does not cut the vertex at its end. Corners of faces that are ignored go with the vertex's first.
//!
//! Cut vertices are numbered by their original vertex, at each by the smallest of their corners; a vertex without faces keeps one. So
//! where nothing is cut, the numbers stay what they are.
//!
//! Cost: linear in the number of corners, apart from sorting at vertices with many. Held, besides the topology: 4 bytes a corner, a cut vertex and
//! a vertex.

use super::creases::{Creases, faces_of_corners};
use super::face_graph::{report, report_end, whole_normals};
use super::sets::Sets;
use crate::error::Error;
use crate::parallel::Run;
use crate::topology::{Adjacency, NO_CORNER, Topology, has_three_corners};
use crate::view::{Faces, Index, Output, Points, room, with_indices, zeroed};

/// A mesh cut open along its creases.
#[derive(Debug)]
pub struct CutMesh {
    topology: Topology,
    corners: Vec<u32>,
    origins: Vec<u32>,
    starts: Vec<u32>,
}

impl CutMesh {
    /// Cuts `faces` along `creases`, where `points` are. [`Run::vertices`] is ignored.
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`], also for a vertex of a marked edge; [`Error::NonFinitePosition`]; [`Error::OptionOutOfRange`];
    /// [`Error::Size`]; [`Error::TooLarge`]; [`Error::OutOfMemory`].
    pub fn new(
        faces: &Faces<'_>,
        points: &Points<'_>,
        creases: &Creases<'_>,
        mut run: Run<'_>,
    ) -> Result<Self, Error> {
        report(&mut run, 0.0)?;
        let adjacency = Adjacency::new(faces, points.len())?;
        points.check_finite()?;
        let face_of = faces_of_corners(faces)?;
        report(&mut run, 0.3)?;
        let mut normals = Vec::new();
        if creases.asks_for_angles() {
            normals = whole_normals(faces, points, &adjacency, &face_of, run.threads)?;
        }
        let marked = creases.find(faces, points.len(), &adjacency, &face_of, &normals)?;
        drop(normals);
        report(&mut run, 0.6)?;
        let Numbers { corners, origins, starts } = with_indices!(faces.indices(), indices => {
            number(faces, indices, points.len(), &adjacency, &marked, &face_of)
        })?;
        drop((adjacency, marked, face_of));
        report(&mut run, 0.9)?;
        let topology = Topology::with_threads(&faces.with_indices(&corners), origins.len(), run.threads, run.level)?;
        report_end(&mut run);
        Ok(CutMesh { topology, corners, origins, starts })
    }

    /// The one-rings of the cut mesh.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }

    /// The cut vertex of each corner, `#C`, as corners stand in the index array.
    pub fn corners(&self) -> &[u32] {
        &self.corners
    }

    /// The original vertex of each cut vertex, ascending.
    pub fn origins(&self) -> &[u32] {
        &self.origins
    }

    /// Where the cut vertices of each original vertex start, `#V + 1`: those of vertex `v` are the numbers from `starts[v]` up to
    /// `starts[v + 1]`.
    pub fn starts(&self) -> &[u32] {
        &self.starts
    }

    /// Copies an element for each original vertex to each cut vertex that comes from it. A number beyond the range of the output's scalar
    /// becomes its largest; what is not finite stays so.
    ///
    /// # Errors
    /// [`Error::Size`] where counts do not fit.
    pub fn copy(&self, points: &Points<'_>, output: &Output<'_>) -> Result<(), Error> {
        self.check_counts(points, output)?;
        for (place, &vertex) in self.origins.iter().enumerate() {
            output.copy(place, points.get(vertex as usize).to_array());
        }
        Ok(())
    }

    /// Refuses other numbers of points than original vertices, and of elements than cut vertices.
    pub(super) fn check_counts(&self, points: &Points<'_>, output: &Output<'_>) -> Result<(), Error> {
        let sizes = [
            ("points.count", points.len(), self.starts.len() - 1),
            ("output.count", output.len(), self.origins.len()),
        ];
        for (what, found, expected) in sizes {
            if found != expected {
                return Err(Error::Size { what, found: found as u64, expected: expected as u64 });
            }
        }
        Ok(())
    }
}

/// How the vertices of a cut mesh are numbered.
struct Numbers {
    /// The cut vertex of each corner.
    corners: Vec<u32>,
    /// The original of each cut vertex.
    origins: Vec<u32>,
    /// Where those of each original start, and the end of the last.
    starts: Vec<u32>,
}

fn number<I: Index>(
    faces: &Faces<'_>,
    indices: &[I],
    vertex_count: usize,
    adjacency: &Adjacency,
    creases: &[u8],
    face_of: &[u32],
) -> Result<Numbers, Error> {
    let vertex = |corner: usize| indices[corner].widen() as usize;
    let counts = |face: usize| has_three_corners(&indices[faces.range(face)]);
    let mut sets = Sets::new(indices.len())?;
    for face in (0..faces.len()).filter(|&face| counts(face)) {
        let range = faces.range(face);
        let mut corner = range.end - 1;
        for next in range {
            let other = adjacency.opposite(corner);
            if vertex(corner) == vertex(next) {
                // One corner, named twice.
                sets.join(corner as u32, next as u32);
            } else if other != NO_CORNER && (corner as u32) < other && creases[corner] == 0 {
                let across = faces.range(face_of[other as usize] as usize);
                let after = other + 1;
                let after = if after as usize == across.end { across.start as u32 } else { after };
                sets.join(corner as u32, after);
                sets.join(next as u32, other);
            }
            corner = next;
        }
    }
    // How many cut vertices each vertex has, then where its first stands.
    let mut starts: Vec<u32> = zeroed(vertex_count + 1)?;
    for corner in (0..faces.len()).filter(|&face| counts(face)).flat_map(|face| faces.range(face)) {
        starts[vertex(corner) + 1] += (sets.root(corner as u32) == corner as u32) as u32;
    }
    for vertex in 0..vertex_count {
        starts[vertex + 1] = starts[vertex] + starts[vertex + 1].max(1);
    }
    let mut origins: Vec<u32> = room(starts[vertex_count] as usize)?;
    for vertex in 0..vertex_count {
        origins.extend((starts[vertex]..starts[vertex + 1]).map(|_| vertex as u32));
    }
    let mut numbers: Vec<u32> = zeroed(indices.len())?;
    let mut used: Vec<u32> = zeroed(vertex_count)?;
    for face in 0..faces.len() {
        let counts = counts(face);
        for corner in faces.range(face) {
            let (root, start) = (sets.root(corner as u32) as usize, starts[vertex(corner)]);
            numbers[corner] = if !counts {
                start
            } else if root == corner {
                let used = &mut used[vertex(corner)];
                *used += 1;
                start + *used - 1
            } else {
                numbers[root]
            };
        }
    }
    Ok(Numbers { corners: numbers, origins, starts })
}
