//! Region growing by shape class and normal: flat, cylindrical, spherical and saddle parts of a mesh, whether creases bound them or not.
//!
//! References: P. J. Besl, R. C. Jain, "Segmentation through variable-order surface fitting", IEEE Transactions on Pattern Analysis and
//! Machine Intelligence 10 (1988); R. Adams, L. Bischof, "Seeded region growing", the same 16 (1994).
//!
//! Input is any mesh with a [`ShapeClass`] at each vertex. A vertex on a crease ([`Creases`]) tells nothing of
//! the surface beside it. A face whose other corners are all of one class is sure of it and makes seeds: sure faces of the same class that
//! meet across an edge that is no crease are one region. The others lie between parts, where a curvature is a mixture: those are added
//! to the regions in the order of how little their normal differs from that of a neighbour that has one, over edges that are no
//! creases. Without this order a flat face with two corners on the edge of a fillet would go with the fillet.
//! What no sure face reaches makes regions of its own, of the class that most of its corners have (of several the one with the smallest number).
//! Then regions that are too small become part of a neighbour, smooth ones and those of the same class first.
//!
//! An angle between neighbours is a local bound, so a region may turn all around: a cylinder is one region. Two parts of one class that
//! join smoothly are not separated: a cylinder and a cone, or a flat part and another that is a few degrees off. A part whose vertices are all at
//! its border, such as the side of a filleted box in two triangles, has no sure face of its own class; it takes a vertex inside.
//!
//! What serves machine parts best, clean and with noise of 1 % of the edges, is [`Method::AdaptiveJet`](crate::Method::AdaptiveJet) with twice
//! [`shape_tolerance`](crate::shape_tolerance), as [`regions_of_shape`](crate::regions_of_shape) has it; on clean ones
//! [`Method::LeastSquares`](crate::Method::LeastSquares) with half of that does as well. With more noise take a larger smallest region.
//!
//! A face without area takes the normal of a neighbour. Numerical notes: angles are compared by the chord between unit normals; normals,
//! lengths and areas are in `f64`. All ties are broken by the index of the face. Cost: O(n log n) for the faces that are not sure and the regions that are too small; the rest is
//! next to linear (`sets.rs`).

use super::creases::{Creases, faces_of_corners};
use super::face_graph::{FaceGraph, deviation, edge_length, report, report_end, whole_normals};
use super::segmentation::{NO_SEGMENT, Segmentation, face_areas, unit_of};
use super::sets::Sets;
use super::shape::ShapeClass;
use super::small_regions::{Borders, Regions, Smallest, merge_small};
use crate::error::Error;
use crate::parallel::Run;
use crate::topology::Adjacency;
use crate::view::{Bytes, Faces, Index, Points, filled, with_indices, zeroed};

/// How regions grow.
#[derive(Clone, Copy, Debug)]
pub struct RegionOptions<'a> {
    /// Faces do not grow into each other across a crease.
    pub creases: Creases<'a>,
    /// Regions of fewer faces become part of a neighbour.
    pub smallest_faces: usize,
    /// Regions of less than this share of the whole area become part of a neighbour.
    pub smallest_share: f64,
}

impl Default for RegionOptions<'_> {
    /// Creases of 30°, and 0.05 % of the area.
    fn default() -> Self {
        RegionOptions { creases: Creases::default(), smallest_faces: 0, smallest_share: 0.0005 }
    }
}

/// Grows regions of faces over vertices whose [`ShapeClass`] numbers are `classes`. [`Run::vertices`] is ignored, and so are threads.
///
/// # Errors
/// [`Error::OptionOutOfRange`]; [`Error::Size`] for another number of classes than points; [`Error::UnknownConstant`] for a class
/// that is none; [`Error::IndexOutOfRange`]; [`Error::NonFinitePosition`]; [`Error::TooLarge`]; [`Error::Cancelled`];
/// [`Error::OutOfMemory`].
pub fn region_growing(
    faces: &Faces<'_>,
    points: &Points<'_>,
    classes: &Bytes<'_>,
    options: &RegionOptions<'_>,
    mut run: Run<'_>,
) -> Result<Segmentation, Error> {
    if !(0.0..=1.0).contains(&options.smallest_share) {
        return Err(Error::OptionOutOfRange { what: "smallest_share" });
    }
    if classes.len() != points.len() {
        let (found, expected) = (classes.len() as u64, points.len() as u64);
        return Err(Error::Size { what: "classes.count", found, expected });
    }
    if let Some(class) = classes.iter().find(|&class| class as usize >= CLASSES) {
        return Err(Error::UnknownConstant { what: "classes", value: class as u64 });
    }
    report(&mut run, 0.0)?;
    let adjacency = Adjacency::new(faces, points.len())?;
    points.check_finite()?;
    let face_of = faces_of_corners(faces)?;
    report(&mut run, 0.3)?;
    let normals = whole_normals(faces, points, &adjacency, &face_of, run.threads)?;
    let marked = options.creases.find(faces, points.len(), &adjacency, &face_of, &normals)?;
    let graph = FaceGraph::with(faces, &adjacency, &face_of)?;
    drop((adjacency, face_of));
    report(&mut run, 0.5)?;
    let smooth = |corner: usize| marked[corner] == 0;
    let mut known = filled(points.len(), 1u8)?;
    graph.for_each_edge(|corner, face, _| {
        if !smooth(corner) {
            for vertex in graph.ends(corner, face as usize) {
                known[vertex as usize] = 0;
            }
        }
    });
    let votes = with_indices!(faces.indices(), indices => votes(&graph, indices, classes, &known))?;
    drop(known);

    let mut sets = Sets::new(faces.len())?;
    // How far apart the faces are, and the faces, of edges at a face that is not sure.
    let mut open: Vec<(u64, u32, u32)> = Vec::new();
    let mut full = Ok(());
    graph.for_each_edge(|corner, face, other| {
        let (one, two) = (votes[face as usize], votes[other as usize]);
        if !smooth(corner) {
            return;
        }
        if one.sure && two.sure {
            if one.class == two.class {
                sets.join(face, other);
            }
        } else if full.is_ok() {
            full = open.try_reserve(1);
            if full.is_ok() {
                // Bits of numbers that are not negative compare like the numbers.
                open.push((deviation(normals[face as usize], normals[other as usize]).to_bits(), face, other));
            }
        }
    });
    full?;
    open.sort_unstable();
    report(&mut run, 0.7)?;
    let mut known: Vec<u8> = zeroed(faces.len())?;
    for face in (0..faces.len()).filter(|&face| votes[face].sure) {
        known[sets.root(face as u32) as usize] = 1;
    }
    for &(_, face, other) in &open {
        let (a, b) = (sets.root(face) as usize, sets.root(other) as usize);
        if known[a] & known[b] == 0 {
            let both = known[a] | known[b];
            known[sets.join(face, other) as usize] = both;
        }
    }
    drop((open, known));
    report(&mut run, 0.8)?;

    // Regions in the order of their smallest face, which is the root.
    let mut region_of = filled(faces.len(), NO_SEGMENT)?;
    let mut count = 0;
    for face in (0..faces.len()).filter(|&face| graph.is_used(face)) {
        let root = sets.root(face as u32) as usize;
        if root == face {
            region_of[face] = count;
            count += 1;
        } else {
            region_of[face] = region_of[root];
        }
    }
    drop(sets);
    let unit = unit_of(points);
    let areas = face_areas(faces, points, unit)?;
    let regions = regions(&region_of, count as usize, &votes, &areas)?;
    let smallest =
        Smallest { faces: options.smallest_faces, area: options.smallest_share * areas.iter().sum::<f64>() };
    drop((votes, areas));
    let mut border_edges = 0;
    graph.for_each_edge(|_, face, other| {
        border_edges += (region_of[face as usize] != region_of[other as usize]) as usize;
    });
    let mut borders = Borders::new(count as usize, border_edges)?;
    graph.for_each_edge(|corner, face, other| {
        let (a, b) = (region_of[face as usize], region_of[other as usize]);
        if a != b {
            let length = edge_length(points, graph.ends(corner, face as usize), unit);
            borders.add(a, b, length, smooth(corner));
        }
    });
    let mut merged = merge_small(regions, borders, &smallest)?;
    report(&mut run, 0.95)?;
    let found = Segmentation::new(&graph, points.len(), |face| merged.root(region_of[face]))?;
    report_end(&mut run);
    Ok(found)
}

/// The number of classes.
const CLASSES: usize = ShapeClass::ALL.len();

/// What the corners of a face say.
#[derive(Clone, Copy, Default)]
struct Vote {
    class: u8,
    /// Whether all of them say the same, and know what they say.
    sure: bool,
}

/// The class that most corners of each face have, but for those that know of none; of several the one with the smallest number. Corners on
/// creases, which are not `known`, count where there are no others.
fn votes<I: Index>(
    graph: &FaceGraph<'_>,
    indices: &[I],
    classes: &Bytes<'_>,
    known: &[u8],
) -> Result<Vec<Vote>, Error> {
    let mut votes = filled(graph.faces.len(), Vote::default())?;
    for (face, vote) in votes.iter_mut().enumerate().filter(|(face, _)| graph.is_used(*face)) {
        let corners = &indices[graph.faces.range(face)];
        let mut counts = [0u32; CLASSES];
        let mut count = 0;
        for corner in corners.iter().map(|corner| corner.widen() as usize).filter(|&corner| known[corner] != 0) {
            counts[classes.get(corner) as usize] += 1;
            count += 1;
        }
        if count == 0 {
            corners.iter().for_each(|corner| counts[classes.get(corner.widen() as usize) as usize] += 1);
        }
        let class = most(&counts);
        *vote = Vote { class, sure: class != ShapeClass::Undefined as u8 && counts[class as usize] == count };
    }
    Ok(votes)
}

/// The class of the largest number, 0 aside; of several the one with the smallest number.
fn most(counts: &[u32; CLASSES]) -> u8 {
    let mut best = ShapeClass::Undefined as usize;
    for class in 1..CLASSES {
        if counts[class] > if best == 0 { 0 } else { counts[best] } {
            best = class;
        }
    }
    best as u8
}

/// Class, number of faces and area of each region.
fn regions(region_of: &[u32], count: usize, votes: &[Vote], areas: &[f64]) -> Result<Regions, Error> {
    let mut regions = Regions { class: zeroed(count)?, faces: zeroed(count)?, area: zeroed(count)? };
    // What sure faces say outweighs the rest, which counts only where there is none.
    let mut said: Vec<[u32; CLASSES]> = zeroed(count)?;
    for (face, &region) in region_of.iter().enumerate().filter(|&(_, &region)| region != NO_SEGMENT) {
        let region = region as usize;
        regions.faces[region] += 1;
        regions.area[region] += areas[face];
        said[region][votes[face].class as usize] += 1;
        if votes[face].sure {
            regions.class[region] = votes[face].class;
        }
    }
    for (class, said) in regions.class.iter_mut().zip(&said).filter(|(class, _)| **class == 0) {
        *class = most(said);
    }
    Ok(regions)
}
