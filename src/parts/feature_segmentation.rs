//! Segmentation along feature edges: faces that meet are in one segment unless the edge between them is a crease.
//!
//! Input is any mesh; which edges are creases says [`Creases`]. A segment is a connected component of the faces over all edges that are no
//! creases, found with disjoint sets (B. A. Galler, M. J. Fisher, "An improved equivalence algorithm", Communications of the ACM 7 (1964)).
//! So a crease that ends inside a smooth part separates nothing.
//!
//! Faces that do not meet (an edge with one face, with more than two, or with two of the same direction) are not joined there.
//!
//! Numerical notes: angles are those of [`Creases`], with what these say of faces without area. Cost: next to linear in the number of
//! corners (`sets.rs`).

use super::creases::{Creases, faces_of_corners};
use super::face_graph::{FaceGraph, report, report_end, whole_normals};
use super::segmentation::Segmentation;
use super::sets::Sets;
use crate::error::Error;
use crate::parallel::Run;
use crate::topology::Adjacency;
use crate::view::{Faces, Points};

/// Cuts a mesh into the parts that creases bound. [`Run::vertices`] is ignored, and so are threads.
///
/// # Errors
/// [`Error::IndexOutOfRange`]; [`Error::NonFinitePosition`]; [`Error::OptionOutOfRange`] and [`Error::Size`] for creases;
/// [`Error::TooLarge`]; [`Error::Cancelled`]; [`Error::OutOfMemory`].
pub fn feature_segmentation(
    faces: &Faces<'_>,
    points: &Points<'_>,
    creases: &Creases<'_>,
    mut run: Run<'_>,
) -> Result<Segmentation, Error> {
    report(&mut run, 0.0)?;
    let adjacency = Adjacency::new(faces, points.len())?;
    points.check_finite()?;
    let face_of = faces_of_corners(faces)?;
    report(&mut run, 0.3)?;
    let mut normals = Vec::new();
    if creases.asks_for_angles() {
        normals = whole_normals(faces, points, &adjacency, &face_of, run.threads)?;
    }
    report(&mut run, 0.6)?;
    let marked = creases.find(faces, points.len(), &adjacency, &face_of, &normals)?;
    let graph = FaceGraph::with(faces, &adjacency, &face_of)?;
    drop((adjacency, face_of, normals));
    report(&mut run, 0.8)?;
    let mut sets = Sets::new(faces.len())?;
    graph.for_each_edge(|corner, face, other| {
        if marked[corner] == 0 {
            sets.join(face, other);
        }
    });
    drop(marked);
    let found = Segmentation::new(&graph, points.len(), |face| sets.root(face as u32))?;
    report_end(&mut run);
    Ok(found)
}
