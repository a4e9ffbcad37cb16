//! The vertices that adaptive jets learn from, with their points in their frames.

use super::adaptive_model::MOST_AUTOMATIC_RINGS;
use super::heights::{Frame, Heights, plain_residuals, prepare, scratch};
use super::surroundings::Surroundings;
use crate::error::{Error, reserved};
use crate::simd::{MAX_LANES, Vector, each};
use crate::sweep::{Counts, Patch, PatchQuantity};
use crate::topology::{MAX_NEIGHBOURS, Neighbourhood};
use std::sync::{Mutex, PoisonError};

/// A vertex to learn from.
pub(super) struct Sample {
    pub vertex: u32,
    /// How many points there are, itself among them.
    pub count: usize,
    /// Where its points start in [`Samples::numbers`].
    start: usize,
    /// Its mean edge length, in units of the mesh's.
    pub grade: f64,
    pub slopes: [f64; 2],
    /// What plain jets leave, and how many more points than coefficients they had.
    pub plain: [(f64, f64); 3],
}

/// What is told of a point: its coordinates in the vertex's frame, in units of the vertex's mean edge length, and its own vertex's mean
/// edge length.
pub(super) const COLUMNS: usize = 4;

/// Vertices to learn from, with their points.
pub(super) struct Samples {
    pub vertices: Vec<Sample>,
    /// Column after column, sample after sample.
    numbers: Vec<f64>,
}

impl Samples {
    /// Room for so many vertices of a mesh of `vertex_count`.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn with_room(count: usize, vertex_count: usize) -> Result<Self, Error> {
        let points = vertex_count.min(MAX_NEIGHBOURS) + 1;
        Ok(Samples { vertices: reserved(count)?, numbers: reserved(count * COLUMNS * points)? })
    }

    /// A number of a sample's point; `None` if it has fewer points.
    pub fn get(&self, sample: &Sample, column: usize, row: usize) -> Option<f64> {
        (row < sample.count).then(|| self.numbers[sample.start + column * sample.count + row])
    }

    fn add(&mut self, sample: Sample, numbers: impl Iterator<Item = f64>) {
        let start = self.numbers.len();
        // The room is there already.
        self.numbers.extend(numbers);
        if self.numbers[start..].iter().all(|x| x.is_finite()) {
            self.vertices.push(Sample { start, ..sample });
        } else {
            self.numbers.truncate(start);
        }
    }
}

/// Puts samples into their frames.
pub(super) struct Collector<'a> {
    pub around: &'a Surroundings,
    pub edge_length: f64,
    pub samples: Mutex<Samples>,
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
            let count = counts[lane] as usize + 1;
            let own = self.around.edge_lengths[vertex as usize];
            let grade = |row: usize| match row {
                0 => own,
                _ => patch.neighbour_value(row - 1).map_or(1.0, |value| value.to_lanes()[lane]),
            };
            let number = |index: usize| match (index / count, index % count) {
                (0, row) => heights.u[row].to_lanes()[lane],
                (1, row) => heights.v[row].to_lanes()[lane],
                (2, row) => heights.w[row].to_lanes()[lane],
                (_, row) => grade(row) / self.edge_length,
            };
            let sample = Sample {
                vertex,
                count,
                start: 0,
                grade: own / self.edge_length,
                slopes: [slopes[0][lane], slopes[1][lane]],
                plain: each((0.0, 0.0), |jet| (plain[jet].0[lane], plain[jet].1[lane])),
            };
            let mut samples = self.samples.lock().unwrap_or_else(PoisonError::into_inner);
            samples.add(sample, (0..COLUMNS * count).map(number));
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
    fn choose<V: Vector<Scalar = f64>, Z: Vector<Scalar = f32>>(
        &self,
        vertex: u32,
        found: &Neighbourhood,
        chosen: &mut [u32],
    ) -> Counts {
        self.around.choose::<V, Z>(vertex, found, chosen)
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
