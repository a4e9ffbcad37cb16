//! Watershed segmentation: the basins of a height over the faces, which shallow ones are merged into.
//!
//! Reference: A. P. Mangan, R. T. Whitaker, "Partitioning 3D surface meshes using watershed segmentation", IEEE Transactions on Visualization
//! and Computer Graphics 5 (1999). There heights are those of vertices, and basins are merged afterwards; here faces are flooded, in
//! ascending order, and basins merge as they meet, which is simplification by persistence (H. Edelsbrunner, D. Letscher, A. Zomorodian,
//! "Topological persistence and simplification", Discrete & Computational Geometry 28 (2002)).
//!
//! Input is any mesh and any scalar, at vertices or faces, that is low inside segments and high between them: curvedness, or the largest
//! absolute curvature. A scalar at vertices becomes one at faces by the mean of the corners. The mean rises towards a crease by a step a
//! face, and each face runs down its own side; the largest of the corners would make a plateau of all faces that touch the crease, which is split halfway.
//!
//! Rules. A face whose neighbours are all higher starts a basin; any other joins the basin of its lowest neighbour. Connected faces
//! of the same height count as one (a plateau): without a lower neighbour it is one basin, and else its faces join those of the lower ones
//! that are the fewest faces away. Two basins meet across an edge at the height of the higher of its faces. They merge there if the shallower
//! one's depth, from its lowest face, is below the depth asked for. A basin that was deep enough stays so.
//! All ties are broken by the index of the face, so results depend neither on threads nor on the numbers of vertices.
//!
//! Numerical notes: heights are only compared, and subtracted once for each meeting. The mean of equal numbers is that number. Faces that
//! do not meet are no neighbours, whatever their heights. Cost: O(n log n) for sorting the faces; the rest is next to linear
//! (`sets.rs`).

use super::face_graph::{FaceGraph, NO_FACE, report, report_end};
use super::scalar_field::ScalarField;
use super::segmentation::Segmentation;
use super::sets::Sets;
use crate::error::Error;
use crate::parallel::Run;
use crate::view::{Faces, filled, room, zeroed};

/// Stands for faces that the water has not reached yet.
const DRY: u32 = u32::MAX;

/// Cuts a mesh of `vertex_count` vertices into the basins of `height`. Basins less deep than `depth`, in the unit of the height, are merged;
/// with 0 none are, with infinity all that are connected. [`Run::vertices`] is ignored.
///
/// # Errors
/// [`Error::IndexOutOfRange`]; [`Error::Size`] for another number of heights; [`Error::NonFiniteScalar`];
/// [`Error::OptionOutOfRange`] for a depth that is negative or no number; [`Error::TooLarge`]; [`Error::Cancelled`];
/// [`Error::OutOfMemory`].
pub fn watershed(
    faces: &Faces<'_>,
    vertex_count: usize,
    height: &ScalarField<'_>,
    depth: f64,
    mut run: Run<'_>,
) -> Result<Segmentation, Error> {
    if !(0.0..=f64::INFINITY).contains(&depth) {
        return Err(Error::OptionOutOfRange { what: "depth" });
    }
    height.check("height", faces, vertex_count)?;
    report(&mut run, 0.0)?;
    let graph = FaceGraph::new(faces, vertex_count)?;
    report(&mut run, 0.4)?;
    let heights = height.of_faces(faces, run.threads)?;
    let mut order: Vec<(u64, u32)> = room(faces.len())?;
    let used = (0..faces.len()).filter(|&face| graph.is_used(face));
    order.extend(used.map(|face| (ordered(heights[face]), face as u32)));
    order.sort_unstable();
    report(&mut run, 0.6)?;
    let mut flood = Flood {
        graph: &graph,
        heights: &heights,
        basins: filled(faces.len(), DRY)?,
        sets: Sets::new(faces.len())?,
        lowest: zeroed(faces.len())?,
        queue: room(faces.len())?,
        depth,
    };
    let mut done = 0;
    for plateau in order.chunk_by(|a, b| a.0 == b.0) {
        flood.rise_to(plateau);
        if done / REPORT != (done + plateau.len()) / REPORT {
            report(&mut run, 0.6 + 0.3 * done as f64 / order.len() as f64)?;
        }
        done += plateau.len();
    }
    let Flood { basins, mut sets, .. } = flood;
    drop(order);
    let found = Segmentation::new(&graph, vertex_count, |face| sets.root(basins[face]))?;
    report_end(&mut run);
    Ok(found)
}

/// Faces from one report of progress to the next.
const REPORT: usize = 1 << 16;

/// Bits that compare like the number, which is not NaN.
fn ordered(x: f64) -> u64 {
    let bits = x.to_bits();
    if bits >> 63 == 0 { bits | 1 << 63 } else { !bits }
}

struct Flood<'a> {
    graph: &'a FaceGraph<'a>,
    heights: &'a [f64],
    /// The basin of each face: the number of the face that started it.
    basins: Vec<u32>,
    sets: Sets,
    /// The lowest height of a basin, by its root.
    lowest: Vec<f64>,
    /// Faces of a plateau that have a basin and may have neighbours without.
    queue: Vec<u32>,
    depth: f64,
}

impl Flood<'_> {
    /// Floods all faces of one height, given in ascending order.
    fn rise_to(&mut self, level: &[(u64, u32)]) {
        self.queue.clear();
        if let &[(_, face)] = level {
            let lower = self.lowest_neighbour(face);
            self.basins[face as usize] = if lower == NO_FACE { self.open(face) } else { self.basins[lower as usize] };
        } else {
            self.flood_plateaus(level);
        }
        for &(_, face) in level {
            for other in self.graph.neighbours(face as usize) {
                if self.basins[other as usize] != DRY {
                    self.meet(self.basins[face as usize], self.basins[other as usize], self.heights[face as usize]);
                }
            }
        }
    }

    fn flood_plateaus(&mut self, level: &[(u64, u32)]) {
        // Those at the rim first, none of which may see what another has just been given.
        for &(_, face) in level {
            if self.lowest_neighbour(face) != NO_FACE {
                self.queue.push(face);
            }
        }
        for place in 0..self.queue.len() {
            let face = self.queue[place];
            self.basins[face as usize] = self.basins[self.lowest_neighbour(face) as usize];
        }
        self.spread(0);
        for &(_, face) in level {
            if self.basins[face as usize] == DRY {
                let first = self.queue.len();
                self.basins[face as usize] = self.open(face);
                self.queue.push(face);
                self.spread(first);
            }
        }
    }

    /// Gives the basin of the faces in the queue, from a place on, to those of the same height that are connected to them and have none:
    /// first to their neighbours, then to the neighbours of these. Where two come to a face at once, the lower face has it.
    fn spread(&mut self, mut start: usize) {
        while start < self.queue.len() {
            let end = self.queue.len();
            self.queue[start..].sort_unstable();
            for place in start..end {
                let (graph, face) = (self.graph, self.queue[place]);
                for other in graph.neighbours(face as usize) {
                    let same = self.heights[other as usize] == self.heights[face as usize];
                    if same && self.basins[other as usize] == DRY {
                        self.basins[other as usize] = self.basins[face as usize];
                        self.queue.push(other);
                    }
                }
            }
            start = end;
        }
    }

    /// The lowest neighbour below a face, of several the first in the mesh; [`NO_FACE`] if there is none.
    fn lowest_neighbour(&self, face: u32) -> u32 {
        let height = |face: u32| self.heights[face as usize];
        let lower = self.graph.neighbours(face as usize).filter(|&other| height(other) < height(face));
        let lowest = lower.min_by(|&a, &b| height(a).total_cmp(&height(b)).then(a.cmp(&b)));
        lowest.unwrap_or(NO_FACE)
    }

    fn open(&mut self, face: u32) -> u32 {
        self.lowest[face as usize] = self.heights[face as usize];
        face
    }

    fn meet(&mut self, a: u32, b: u32, height: f64) {
        let (a, b) = (self.sets.root(a), self.sets.root(b));
        if a == b {
            return;
        }
        let (low, high) = (self.lowest[a as usize], self.lowest[b as usize]);
        // The difference of huge heights may be infinite as well.
        if self.depth == f64::INFINITY || height - low.max(high) < self.depth {
            let root = self.sets.join(a, b);
            self.lowest[root as usize] = low.min(high);
        }
    }
}
