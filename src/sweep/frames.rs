//! Normal, area, centroid and angles of polygons, in `f64`.
//!
//! The area vector of the polygon `p₀ … pₙ₋₁` is `½ Σ (pₖ − p₀) × (pₖ₊₁ − p₀)`: relative to the polygon, so that
//! nothing is lost far from the origin, and right for concave and for collinear corners. The centroid is that of the
//! area, each triangle `(mean, pₖ, pₖ₊₁)` counted by its signed area along the normal, so it does not move when an
//! edge is split. A polygon whose area vector cancels out has no normal. Cost: linear in the number of corners.

use super::NormalRows;
use super::ring::interior_angle;
use crate::error::{Error, filled};
use crate::parallel;
use crate::simd::Real;
use crate::topology::Polygons;
use crate::view::{Coordinate, Index, StridedPoints};
use glam::DVec3;

/// What a vertex needs to know of a polygon at one of its corners. Lengths, not areas, so that nothing overflows.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Frame {
    /// Unit normal, or zero.
    pub normal: DVec3,
    /// The square root of the area.
    pub size: f64,
    /// From the first corner to the centroid, if it was asked for; if normals are given, to the mean of the corners, which is
    /// where the normal is the mean of theirs.
    pub centroid: DVec3,
    /// One by the number of corners.
    pub share: f64,
    /// How much each of its angles falls short of those of a flat polygon, if it was asked for: an equal part of the
    /// whole.
    pub bend: f64,
    /// The mean of the normals of its corners, if they were given.
    pub mean_normal: DVec3,
    /// Whether there are more than three corners, so that one of them may be reflex.
    pub may_turn: bool,
}

/// An area vector this much shorter than the root of the sum of squares it was added up from is rounding error.
pub(crate) const CANCELLED: f64 = 1.0 / (1u64 << 44) as f64;

/// Corners relative to the first, in units of a power of two.
struct Local<'a, S, I> {
    points: &'a StridedPoints<'a, S>,
    corners: &'a [I],
    /// Applied to positions before they are subtracted; less than 1 only where differences overflow.
    factor: f64,
    /// Applied to differences.
    scale: f64,
}

impl<'a, S: Coordinate, I: Index> Local<'a, S, I> {
    /// None where there is no polygon.
    fn new(points: &'a StridedPoints<'a, S>, corners: &'a [I]) -> Option<Self> {
        if corners.len() < 3 {
            return None;
        }
        let mut local = Local { points, corners, factor: 1.0, scale: 1.0 };
        let mut extent = local.extent();
        if extent == f64::INFINITY {
            local.factor = 0.25;
            extent = local.extent();
        }
        local.scale = extent.inverse_power_of_two();
        Some(local)
    }

    fn corner(&self, index: usize) -> DVec3 {
        self.difference(index) * self.scale
    }

    fn difference(&self, index: usize) -> DVec3 {
        let point = |index: usize| self.points.get(self.corners[index].widen() as usize) * self.factor;
        point(index) - point(0)
    }

    fn extent(&self) -> f64 {
        (1..self.corners.len()).fold(0.0, |extent, index| self.difference(index).abs().max_element().max(extent))
    }

    /// Twice the area vector, its unit direction, and its length; none where it vanishes or cancels out.
    fn twice_area(&self) -> Option<(DVec3, DVec3, f64)> {
        let (mut twice_area, mut squares) = (DVec3::ZERO, 0.0);
        let mut previous = self.corner(1);
        for index in 2..self.corners.len() {
            let corner = self.corner(index);
            let term = previous.cross(corner);
            twice_area += term;
            squares += term.length_squared();
            previous = corner;
        }
        // The square of a very thin polygon's area leaves the range.
        let scale = twice_area.abs().max_element().inverse_power_of_two();
        let scaled = twice_area * scale;
        let (direction, length) = (scaled / scaled.length(), scaled.length() / scale);
        (length > CANCELLED * squares.sqrt()).then_some((twice_area, direction, length))
    }

    /// How much each angle falls short of those of a flat polygon, `((n − 2)π − Σθ) / n`, given the unit normal.
    fn bend(&self, normal: DVec3) -> f64 {
        let count = self.corners.len();
        // The very differences that a ring has, so that both see the same corners as reflex.
        let point = |index: usize| self.points.get(self.corners[index % count].widen() as usize) * self.factor;
        let angle = |index: usize| {
            let next = (point(index + 1) - point(index)) * self.scale;
            let previous = (point(index + count - 1) - point(index)) * self.scale;
            interior_angle(next.into(), previous.into(), normal.into(), 1.0)
        };
        let sum: f64 = (0..count).map(angle).sum();
        ((count - 2) as f64 * std::f64::consts::PI - sum) / count as f64
    }

    /// The mean of the corners.
    fn mean(&self) -> DVec3 {
        let count = self.corners.len();
        (1..count).map(|index| self.corner(index)).sum::<DVec3>() / count as f64
    }

    /// The centroid, given the unit normal and twice the area.
    fn centroid(&self, normal: DVec3, twice_area: f64) -> DVec3 {
        let count = self.corners.len();
        let mean = self.mean();
        if count == 3 {
            return mean;
        }
        let (mut moment, mut total) = (DVec3::ZERO, 0.0);
        let mut previous = self.corner(count - 1) - mean;
        for index in 0..count {
            let corner = self.corner(index) - mean;
            let signed = normal.dot(previous.cross(corner));
            moment += (previous + corner) * signed;
            total += signed;
            previous = corner;
        }
        // The total is the area again, unless the polygon is so thin that rounding has made up either.
        if (total - twice_area).abs() > 0.5 * twice_area {
            return mean;
        }
        mean + moment / (3.0 * total)
    }
}

/// The area vector of a polygon.
pub(crate) struct AreaVector {
    /// Its unit direction.
    pub normal: DVec3,
    /// Twice the vector, in units of which `scale` make one of the mesh.
    twice: DVec3,
    scale: f64,
}

impl AreaVector {
    /// The vector in the mesh's units; infinite beyond the range.
    pub(crate) fn in_mesh_units(&self) -> DVec3 {
        self.twice * 0.5 / self.scale / self.scale
    }

    /// The area where lengths are multiplied by `unit`, a power of two.
    pub(crate) fn area(&self, unit: f64) -> f64 {
        let steps = unit / self.scale;
        self.twice.length() * 0.5 * steps * steps
    }
}

/// The area vector of the polygon with the given corners; none where it vanishes.
pub(crate) fn area_vector<S: Coordinate, I: Index>(
    points: &StridedPoints<'_, S>,
    corners: &[I],
) -> Option<AreaVector> {
    let local = Local::new(points, corners)?;
    let (twice, normal, _) = local.twice_area()?;
    Some(AreaVector { normal, twice, scale: local.scale * local.factor })
}

/// What of a [`Frame`] an estimator asks for besides normal and area.
#[derive(Clone, Copy, Default)]
pub(crate) struct Asked<'a> {
    /// Centroids.
    pub centroids: bool,
    /// [`Frame::bend`]
    pub bends: bool,
    /// The normals of all vertices, for [`Frame::mean_normal`].
    pub normals: Option<NormalRows<'a>>,
}

/// The frame of the polygon with the given corners.
pub(super) fn frame<S: Coordinate>(points: &StridedPoints<'_, S>, corners: &[u32], asked: Asked<'_>) -> Frame {
    let may_turn = corners.len() > 3;
    let share = 1.0 / corners.len().max(1) as f64;
    let mean_normal = asked.normals.map_or(DVec3::ZERO, |normals| {
        corners.iter().map(|&vertex| DVec3::from_array(normals.get(vertex as usize))).sum::<DVec3>() * share
    });
    let local = Local::new(points, corners);
    let area = local.as_ref().and_then(Local::twice_area);
    let bend = match &local {
        Some(local) if asked.bends && may_turn => local.bend(area.map_or(DVec3::ZERO, |(_, normal, _)| normal)),
        _ => 0.0,
    };
    let (Some(local), Some((_, normal, length))) = (local, area) else {
        return Frame { may_turn, share, bend, mean_normal, ..Frame::default() };
    };
    let centroid = match asked {
        Asked { centroids: false, .. } => DVec3::ZERO,
        Asked { normals: Some(_), .. } => local.mean(),
        _ => local.centroid(normal, length),
    };
    Frame {
        share,
        bend,
        mean_normal,
        normal,
        size: ((0.5 * length).sqrt() / local.scale / local.factor).min(f64::MAX),
        centroid: (centroid / local.scale / local.factor).clamp(DVec3::splat(-f64::MAX), DVec3::splat(f64::MAX)),
        may_turn,
    }
}

/// The frames of all faces, or the means to compute each when it is met.
pub(crate) struct Frames<'a, S> {
    points: &'a StridedPoints<'a, S>,
    polygons: &'a Polygons,
    asked: Asked<'a>,
    all: Option<Vec<Frame>>,
}

impl<'a, S: Coordinate> Frames<'a, S> {
    /// Computes all frames at once, unless `few`: then the caller meets so few faces that each is better computed
    /// where it is met. The frames are the same.
    pub(crate) fn new(
        points: &'a StridedPoints<'a, S>,
        polygons: &'a Polygons,
        asked: Asked<'a>,
        few: bool,
        threads: usize,
    ) -> Result<Self, Error> {
        let mut frames = Frames { points, polygons, asked, all: None };
        if !few {
            let mut all = filled(polygons.face_count(), Frame::default())?;
            parallel::fill(threads, &mut all, |face| frame(points, polygons.face(face), asked));
            frames.all = Some(all);
        }
        Ok(frames)
    }

    /// The frame of a face.
    #[inline(always)]
    pub(crate) fn get(&self, face: usize) -> Frame {
        match &self.all {
            Some(all) => all[face],
            None => frame(self.points, self.polygons.face(face), self.asked),
        }
    }

    /// The face between a ring entry and the next.
    #[inline(always)]
    pub(crate) fn face_of(&self, entry: usize) -> usize {
        self.polygons.corner_face(entry) as usize
    }

    /// The first corner of a face.
    pub(crate) fn first_corner(&self, face: usize) -> u32 {
        self.polygons.face(face)[0]
    }
}
