//! Vertex normals straight from an index buffer, without a topology.
//!
//! For the weights of [`weights`](super::weights), which need no ring: one pass over the faces adds each corner's term
//! to its vertex. The formulas are the very ones of the sweep; the sums run in face order and in `f64`, so results
//! agree with [`vertex_normals`](super::vertex_normals) to rounding, not to the bit. Use a topology when normals are
//! computed more than once or in several threads.
//!
//! Degenerate rule and fallbacks: as with a topology. Statuses: only isolated, fallback and degenerate are known here.
//! Cost: one pass over the faces, another for each fallback that some vertex needs; 40 bytes a vertex.

use super::Weight;
use super::sum::Sum;
use super::vertex::{NormalOutputs, unit, unscale_by, vertex_normals};
use super::weights::{
    Angle, AngleEdges, Area, Centroid, CentroidArea, CornerWeight, InverseRootEdges, Max, Sine, Uniform, term,
};
use crate::error::{Error, filled};
use crate::parallel::Run;
use crate::simd::{Real, Vector3};
use crate::sweep::{Corner, Polygon, Triangle, frame};
use crate::topology::{Topology, status};
use crate::view::{Coordinate, Faces, Index, PointArray, Points, StridedPoints, with_indices};
use glam::DVec3;

/// Computes vertex normals from faces alone.
///
/// N_CM, and a subset of vertices, build a topology for the call; every other call takes the scatter's one pass, on one
/// thread and without a progress report.
///
/// # Errors
/// [`Error::IndexOutOfRange`]; [`Error::NonFinitePosition`]; [`Error::Size`] where an output does not have an element
/// for every position; [`Error::TooLarge`] and [`Error::Cancelled`] where a topology is built; [`Error::OutOfMemory`].
pub fn vertex_normals_from_faces(
    faces: &Faces<'_>,
    points: &Points<'_>,
    weight: Weight,
    run: Run<'_>,
    outputs: &NormalOutputs<'_>,
) -> Result<(), Error> {
    if weight == Weight::Conformal || run.vertices.is_some() {
        return vertex_normals(&Topology::new(faces, points.len())?, points, weight, run, outputs);
    }
    outputs.check_counts(points.len())?;
    faces.indices().check_range("faces.indices", points.len())?;
    points.check_finite()?;
    with_indices!(faces.indices(), indices => match points.array() {
        PointArray::F32(points) => Scatter::new(faces, indices, points)?.run(weight, outputs),
        PointArray::F64(points) => Scatter::new(faces, indices, points)?.run(weight, outputs),
    });
    Ok(())
}

/// What has been added up at a vertex.
#[derive(Clone, Copy)]
struct Accumulator {
    vector: [f64; 3],
    spread: f64,
    /// Whether any face uses the vertex.
    used: bool,
    /// Whether the vertex has its result.
    done: bool,
}

struct Scatter<'a, S, I> {
    faces: &'a Faces<'a>,
    indices: &'a [I],
    points: &'a StridedPoints<'a, S>,
    accumulators: Vec<Accumulator>,
    /// Applied to positions before they are subtracted; less than 1 only where differences overflow.
    factor: f64,
    /// Applied to differences: the mesh's extent becomes about 1.
    scale: f64,
}

impl<'a, S: Coordinate, I: Index> Scatter<'a, S, I> {
    fn new(faces: &'a Faces<'a>, indices: &'a [I], points: &'a StridedPoints<'a, S>) -> Result<Self, Error> {
        let all = || (0..points.len()).map(|index| points.get(index));
        let infinite = DVec3::splat(f64::INFINITY);
        let (low, high) = all().fold((infinite, -infinite), |(low, high), point| (low.min(point), high.max(point)));
        let mut factor = 1.0;
        let mut extent = (high - low).max_element().max(0.0);
        if points.len() > 0 && extent == f64::INFINITY {
            factor = 0.25;
            extent = (high * factor - low * factor).max_element();
        }
        let nothing = Accumulator { vector: [0.0; 3], spread: 0.0, used: false, done: false };
        let accumulators = filled(points.len(), nothing)?;
        Ok(Scatter { faces, indices, points, accumulators, factor, scale: extent.inverse_power_of_two() })
    }

    fn run(mut self, weight: Weight, outputs: &NormalOutputs<'_>) {
        let pending = match weight {
            // Never sent here; the pass that needs least stands in.
            Weight::Conformal | Weight::Max => self.pass::<Max>(outputs, 0),
            Weight::Uniform => self.pass::<Uniform>(outputs, 0),
            Weight::Angle => self.pass::<Angle>(outputs, 0),
            Weight::Area => self.pass::<Area>(outputs, 0),
            Weight::CentroidArea => self.pass::<CentroidArea>(outputs, 0),
            Weight::Centroid => self.pass::<Centroid>(outputs, 0),
            Weight::InverseRootEdges => self.pass::<InverseRootEdges>(outputs, 0),
            Weight::Sine => self.pass::<Sine>(outputs, 0),
            Weight::AngleEdges => self.pass::<AngleEdges>(outputs, 0),
        };
        if pending && self.pass::<Max>(outputs, status::FALLBACK) && self.pass::<Area>(outputs, status::FALLBACK) {
            self.any_face(outputs);
        }
    }

    /// Adds up `W` and writes every vertex that has no result yet and now gets one; whether there are others left.
    fn pass<W: CornerWeight>(&mut self, outputs: &NormalOutputs<'_>, fallback: u8) -> bool {
        for accumulator in &mut self.accumulators {
            (accumulator.vector, accumulator.spread) = ([0.0; 3], 0.0);
        }
        self.each_term::<W>(|accumulator, vector, spread| {
            accumulator.used = true;
            for (total, term) in accumulator.vector.iter_mut().zip([vector.x, vector.y, vector.z]) {
                *total += term;
            }
            accumulator.spread += spread;
        });
        let scale = self.scale * self.factor;
        let mut pending = false;
        for (vertex, accumulator) in self.accumulators.iter_mut().enumerate().filter(|(_, found)| !found.done) {
            let [x, y, z] = accumulator.vector;
            let sum = Sum { vector: Vector3 { x, y, z }, spread: accumulator.spread, total: 0.0 };
            accumulator.done = true;
            match unit(&sum) {
                _ if !accumulator.used => outputs.write(vertex, [0.0; 3], [0.0; 3], status::ISOLATED),
                Some(normal) => {
                    outputs.write(vertex, normal, unscale_by(W::DIMENSION, [x, y, z], scale), fallback);
                }
                None => (accumulator.done, pending) = (false, true),
            }
        }
        pending
    }

    /// The last resort: the first face with an area, or zero.
    fn any_face(&mut self, outputs: &NormalOutputs<'_>) {
        for accumulator in &mut self.accumulators {
            accumulator.vector = [0.0; 3];
        }
        self.each_term::<Area>(|accumulator, vector, spread| {
            if accumulator.vector == [0.0; 3] && unit(&Sum { vector, spread, total: 0.0 }).is_some() {
                accumulator.vector = [vector.x, vector.y, vector.z];
            }
        });
        let scale = self.scale * self.factor;
        for (vertex, accumulator) in self.accumulators.iter().enumerate().filter(|(_, found)| !found.done) {
            let [x, y, z] = accumulator.vector;
            let vector = Vector3 { x, y, z };
            match unit(&Sum { vector, spread: vector.squared(), total: 0.0 }) {
                Some(normal) => {
                    outputs.write(vertex, normal, unscale_by(Area::DIMENSION, [x, y, z], scale), status::FALLBACK);
                }
                None => outputs.write(vertex, [0.0; 3], [0.0; 3], status::DEGENERATE),
            }
        }
    }

    /// Calls `add` with each corner's term of `W`, in face order. Faces are cleaned as a topology does it.
    fn each_term<W: CornerWeight>(&mut self, mut add: impl FnMut(&mut Accumulator, Vector3<f64>, f64)) {
        let mut cleaned: Vec<u64> = Vec::new();
        for face in 0..self.faces.len() {
            cleaned.clear();
            cleaned.extend(self.indices[self.faces.range(face)].iter().map(|index| index.widen()));
            cleaned.dedup();
            while cleaned.len() > 1 && cleaned.first() == cleaned.last() {
                cleaned.pop();
            }
            if cleaned.len() < 3 {
                continue;
            }
            let frame = (cleaned.len() > 3).then(|| frame(self.points, &cleaned, W::NEEDS_CENTROID));
            let first = self.position(cleaned[0]);
            let mut prev = cleaned[cleaned.len() - 1];
            for (index, &vertex) in cleaned.iter().enumerate() {
                let next = *cleaned.get(index + 1).unwrap_or(&cleaned[0]);
                let centre = self.position(vertex);
                let (a, b) = (self.edge(centre, next), self.edge(centre, prev));
                let product = a.squared() * b.squared();
                let (vector, spread) = match &frame {
                    None => term::<W, f64, Triangle>(&Corner::new(a, b, product, Triangle)),
                    Some(frame) => {
                        let size = frame.size * self.scale * self.factor;
                        let centroid = (frame.centroid * self.factor + (first - centre)) * self.scale;
                        let polygon =
                            Polygon { normal: lane(frame.normal), area: size * size, centroid: lane(centroid) };
                        term::<W, f64, Polygon<f64>>(&Corner::new(a, b, product, polygon))
                    }
                };
                add(&mut self.accumulators[vertex as usize], vector, spread);
                prev = vertex;
            }
        }
    }

    fn position(&self, vertex: u64) -> DVec3 {
        self.points.get(vertex as usize) * self.factor
    }

    fn edge(&self, centre: DVec3, neighbour: u64) -> Vector3<f64> {
        lane((self.position(neighbour) - centre) * self.scale)
    }
}

fn lane(vector: DVec3) -> Vector3<f64> {
    Vector3 { x: vector.x, y: vector.y, z: vector.z }
}
