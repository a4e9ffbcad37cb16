//! Faces as the nodes of a graph, joined where they meet across an edge, and what segmentations need to know of each.

use super::creases::{faces_of_corners, unit_normals};
use crate::error::Error;
use crate::parallel::Run;
use crate::topology::{Adjacency, NO_CORNER, has_three_corners};
use crate::view::{Faces, Index, Points, filled, with_indices, zeroed};
use glam::DVec3;

/// Stands where no face is on the other side of an edge.
pub(super) const NO_FACE: u32 = u32::MAX;

/// Which faces meet, by the rule of [`Adjacency`].
pub(super) struct FaceGraph<'a> {
    pub faces: &'a Faces<'a>,
    /// For each corner, the face across the edge that starts there, or [`NO_FACE`].
    across: Vec<u32>,
    /// By face, 1 if it is not ignored.
    used: Vec<u8>,
}

impl<'a> FaceGraph<'a> {
    /// # Errors
    /// As [`Adjacency::new`].
    pub fn new(faces: &'a Faces<'a>, vertex_count: usize) -> Result<Self, Error> {
        let adjacency = Adjacency::new(faces, vertex_count)?;
        Self::with(faces, &adjacency, &faces_of_corners(faces)?)
    }

    /// With what is known already.
    pub fn with(faces: &'a Faces<'a>, adjacency: &Adjacency, face_of: &[u32]) -> Result<Self, Error> {
        let mut across = filled(face_of.len(), NO_FACE)?;
        for (corner, across) in across.iter_mut().enumerate() {
            let other = adjacency.opposite(corner);
            if other != NO_CORNER {
                *across = face_of[other as usize];
            }
        }
        let mut used: Vec<u8> = zeroed(faces.len())?;
        with_indices!(faces.indices(), indices => for (face, used) in used.iter_mut().enumerate() {
            *used = has_three_corners(&indices[faces.range(face)]) as u8;
        });
        Ok(FaceGraph { faces, across, used })
    }

    /// Whether a face is not ignored.
    #[inline(always)]
    pub fn is_used(&self, face: usize) -> bool {
        self.used[face] != 0
    }

    /// The face across the edge that starts at a corner, or [`NO_FACE`].
    #[inline(always)]
    pub fn across(&self, corner: usize) -> u32 {
        self.across[corner]
    }

    /// The faces across the edges of a face.
    #[inline(always)]
    pub fn neighbours(&self, face: usize) -> impl Iterator<Item = u32> {
        self.across[self.faces.range(face)].iter().copied().filter(|&other| other != NO_FACE)
    }

    /// Calls `edge(corner, face, other)` once for each edge across which two faces meet, by its lower face.
    pub fn for_each_edge(&self, mut edge: impl FnMut(usize, u32, u32)) {
        for face in 0..self.faces.len() {
            for corner in self.faces.range(face) {
                let other = self.across[corner];
                if other != NO_FACE && (face as u32) < other {
                    edge(corner, face as u32, other);
                }
            }
        }
    }

    /// The two ends of the edge that starts at a corner of a face.
    pub fn ends(&self, corner: usize, face: usize) -> [u32; 2] {
        let range = self.faces.range(face);
        let next = if corner + 1 == range.end { range.start } else { corner + 1 };
        with_indices!(self.faces.indices(), indices => [indices[corner], indices[next]].map(|index| index.widen() as u32))
    }

    /// Gives faces without normal that of a neighbour, across the longest edge to one that has a normal by then, as if they were folds of
    /// it: so they separate nothing, and join nothing that their neighbours do not.
    fn complete(&self, points: &Points<'_>, normals: &mut [DVec3]) -> Result<(), Error> {
        let lacks =
            |normals: &[DVec3], face: u32| self.is_used(face as usize) && normals[face as usize] == DVec3::ZERO;
        // Faces to look at next, all at the same number of steps from those with a normal.
        let mut front: Vec<u32> = Vec::new();
        for face in (0..self.faces.len() as u32).filter(|&face| lacks(normals, face)) {
            if self.neighbours(face as usize).any(|other| normals[other as usize] != DVec3::ZERO) {
                front.try_reserve(1)?;
                front.push(face);
            }
        }
        let mut found: Vec<DVec3> = Vec::new();
        while !front.is_empty() {
            found.clear();
            found.try_reserve(front.len())?;
            found.extend(front.iter().map(|&face| self.across_longest(face as usize, points, normals)));
            for (&face, &normal) in front.iter().zip(&found) {
                normals[face as usize] = normal;
            }
            let mut next: Vec<u32> = Vec::new();
            for other in front.iter().flat_map(|&face| self.neighbours(face as usize)) {
                if lacks(normals, other) {
                    next.try_reserve(1)?;
                    next.push(other);
                }
            }
            next.sort_unstable();
            next.dedup();
            front = next;
        }
        Ok(())
    }

    /// The normal of the face across the longest edge that has one; at the same length the first.
    fn across_longest(&self, face: usize, points: &Points<'_>, normals: &[DVec3]) -> DVec3 {
        let (mut longest, mut normal) = (-1.0, DVec3::ZERO);
        for corner in self.faces.range(face) {
            let other = self.across[corner];
            if other == NO_FACE || normals[other as usize] == DVec3::ZERO {
                continue;
            }
            let length = edge_length(points, self.ends(corner, face), 1.0);
            if length > longest {
                (longest, normal) = (length, normals[other as usize]);
            }
        }
        normal
    }
}

/// Unit normals of faces; one without area has that of a neighbour, if it has any.
pub(super) fn whole_normals(
    faces: &Faces<'_>,
    points: &Points<'_>,
    adjacency: &Adjacency,
    face_of: &[u32],
    threads: usize,
) -> Result<Vec<DVec3>, Error> {
    let mut normals = unit_normals(faces, points, threads)?;
    if normals.contains(&DVec3::ZERO) {
        FaceGraph::with(faces, adjacency, face_of)?.complete(points, &mut normals)?;
    }
    Ok(normals)
}

/// The length of an edge in `unit`s; infinite beyond the range.
pub(super) fn edge_length(points: &Points<'_>, [a, b]: [u32; 2], unit: f64) -> f64 {
    (points.get(a as usize) * unit - points.get(b as usize) * unit).length()
}

/// How much the normals of two faces differ: the square of the chord. 0 if one has none.
#[inline(always)]
pub(super) fn deviation(a: DVec3, b: DVec3) -> f64 {
    if a == DVec3::ZERO || b == DVec3::ZERO { 0.0 } else { (a - b).length_squared() }
}

/// Tells the caller how far a call has come.
///
/// # Errors
/// [`Error::Cancelled`].
pub(super) fn report(run: &mut Run<'_>, fraction: f64) -> Result<(), Error> {
    if let Some(progress) = &mut run.progress
        && !progress(fraction)
    {
        return Err(Error::Cancelled);
    }
    Ok(())
}

/// Tells the caller that a call is done: a wish to cancel comes too late to matter.
pub(super) fn report_end(run: &mut Run<'_>) {
    if let Some(progress) = &mut run.progress {
        progress(1.0);
    }
}
