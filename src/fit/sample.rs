//! The vertices that adaptive jets learn from, with their points in their frames.

use super::adaptive_model::MOST_AUTOMATIC_RINGS;
use super::heights::{Frame, Heights, plain_residuals, prepare, scratch};
use super::surroundings::Surroundings;
use crate::simd::{MAX_LANES, Vector, each};
use crate::sweep::{Counts, Patch, PatchQuantity};
use crate::topology::Neighbourhood;
use std::sync::{Mutex, PoisonError};

/// A vertex to learn from: its points in its frame, in units of its mean edge length.
pub(super) struct Sample {
    pub vertex: u32,
    pub u: Vec<f64>,
    pub v: Vec<f64>,
    pub w: Vec<f64>,
    /// The mean edge lengths of the points' vertices.
    pub grades: Vec<f64>,
    pub slopes: [f64; 2],
    /// What plain jets leave, and how many more points than coefficients they had.
    pub plain: [(f64, f64); 3],
}

/// Puts samples into their frames.
pub(super) struct Collector<'a> {
    pub around: &'a Surroundings,
    pub edge_length: f64,
    pub samples: Mutex<Vec<Sample>>,
}

impl Collector<'_> {
    #[inline(always)]
    fn collect<V: Vector<Scalar = f64>>(&self, vertices: &[u32], patch: &Patch<'_, V>, scale: V, scratch: &mut [V]) {
        let own = vertices.iter().map(|&vertex| self.around.edge_lengths[vertex as usize]);
        let mut lanes = [1.0; MAX_LANES];
        lanes.iter_mut().zip(own).for_each(|(lane, own)| *lane = own);
        let unit = V::one() / (V::from_lanes(&lanes) * scale);
        let (mut heights, scratch) = Heights::new(scratch, patch.len());
        let heights = &mut heights;
        let Frame { slopes, .. } = prepare(patch, unit, heights);
        let residuals = plain_residuals(patch, heights, scratch);
        let plain: [_; 3] = each(([0.0; MAX_LANES], [0.0; MAX_LANES]), |jet| {
            let (squares, freedom) = residuals[jet];
            (squares.to_lanes(), freedom.to_lanes())
        });
        let (counts, slopes) = (patch.count.to_lanes(), [slopes[0].to_lanes(), slopes[1].to_lanes()]);
        for (lane, &vertex) in vertices.iter().enumerate() {
            let rows = 0..counts[lane] as usize + 1;
            let column = |numbers: &[V]| rows.clone().map(|row| numbers[row].to_lanes()[lane]).collect();
            let grade = |row: usize| match row {
                0 => self.around.edge_lengths[vertex as usize],
                _ => patch.neighbour_value(row - 1).map_or(1.0, |value| value.to_lanes()[lane]),
            };
            let sample = Sample {
                vertex,
                u: column(heights.u),
                v: column(heights.v),
                w: column(heights.w),
                grades: rows.clone().map(|row| grade(row) / self.edge_length).collect(),
                slopes: [slopes[0][lane], slopes[1][lane]],
                plain: each((0.0, 0.0), |jet| (plain[jet].0[lane], plain[jet].1[lane])),
            };
            let all_finite =
                [&sample.u, &sample.v, &sample.w, &sample.grades].into_iter().flatten().all(|x| x.is_finite());
            if all_finite {
                self.samples.lock().unwrap_or_else(PoisonError::into_inner).push(sample);
            }
        }
    }
}

impl PatchQuantity for Collector<'_> {
    fn rings(&self) -> usize {
        MOST_AUTOMATIC_RINGS
    }
    fn least(&self) -> usize {
        0
    }
    fn scratch(&self, points: usize) -> usize {
        scratch(points)
    }
    fn normals(&self) -> &[[f64; 3]] {
        &self.around.normals
    }
    fn values(&self) -> Option<&[f64]> {
        Some(&self.around.edge_lengths)
    }
    #[inline(always)]
    fn choose<V: Vector<Scalar = f64>>(&self, vertex: u32, found: &Neighbourhood, chosen: &mut [u32]) -> Counts {
        self.around.choose::<V>(vertex, found, chosen)
    }

    #[inline(always)]
    fn block<V: Vector<Scalar = f64>>(
        &self,
        vertices: &[u32],
        patch: &Patch<'_, V>,
        scale: V,
        _widened: u32,
        _attempt: usize,
        scratch: &mut [V],
    ) -> u32 {
        self.collect(vertices, patch, scale, scratch);
        0
    }

    /// No block leaves anything over.
    fn alone(
        &self,
        _vertex: usize,
        _patch: &Patch<'_, f64>,
        _scale: f64,
        _widened: bool,
        _last: bool,
        _scratch: &mut [f64],
    ) -> bool {
        true
    }
    fn isolated(&self, _vertex: usize) {}
}
