//! What adaptive jets ask of every one-ring: Max's normal, the mean edge length, and whether a face is far from the normal.
//!
//! And the normal of a vertex on a crease. Its ring is cut where neighbouring faces differ by more than 37°; each piece has
//! the normal of its faces by Max's weights (by area if all its angles are straight, which weigh nothing), and the vertex the mean
//! direction of its pieces. So all vertices along an edge
//! between two flat faces have the bisector, however the faces are cut up; a corner has the mean of its three.
//!
//! Cost: as Max's weight, and one more pass over the faces.

use super::sum::{Estimator, Sum};
use super::vertex::with_fallback;
use super::weights::{Area, Max, term};
use crate::error::Error;
use crate::fit::Surroundings;
use crate::parallel::Run;
use crate::simd::{Mask, Vector, Vector3};
use crate::sweep::{Corner, Face, Quantity, Ring, RingFaces, Room, Scratch, VertexFans, sweep, sweep_in};
use crate::topology::Topology;
use crate::view::{Output, Points, ScalarOutput, StatusOutput, zeroed};

/// The cosine of 37°.
const NEAR: f64 = 0.8;

/// A vertex that stands out of the mean of its neighbours along its normal by more than this part of its mean edge length is a
/// spike: more than the corner of a tetrahedron (0.82).
const SPIKE: f64 = 0.85;

/// Pieces whose unit normals cancel to less than this have no mean direction.
const CANCELLED: f64 = 0.2;

/// Looks at the rings that `run` asks for; zeros stand for the others.
///
/// # Errors
/// As [`sweep`].
pub(super) fn surroundings(
    topology: &Topology,
    points: &Points<'_>,
    run: &mut Run<'_>,
) -> Result<Surroundings, Error> {
    let count = topology.vertex_count();
    let mut found = Surroundings {
        normals: zeroed(count)?,
        // For a list, what is not on it is not touched.
        singles: if run.vertices.is_some() { Vec::new() } else { zeroed(count)? },
        edge_lengths: zeroed(count)?,
        marks: zeroed(count)?,
        has_spikes: false,
    };
    let quantity = Look {
        normal: found.normals.as_mut_slice().into(),
        edge_length: found.edge_lengths.as_mut_slice().into(),
        marks: found.marks.as_mut_slice().into(),
    };
    sweep(topology, points, run, true, &quantity)?;
    for (single, normal) in found.singles.iter_mut().zip(&found.normals) {
        *single = [normal[0] as f32, normal[1] as f32, normal[2] as f32, 0.0];
    }
    let mut spread = |vertex: usize| {
        if found.marks[vertex] & Surroundings::SPIKE != 0 {
            found.has_spikes = true;
            for &neighbour in topology.ring(vertex) {
                found.marks[neighbour as usize] |= Surroundings::BESIDE_SPIKE;
            }
        }
    };
    match run.vertices {
        Some(vertices) => vertices.iter().for_each(|&vertex| spread(vertex as usize)),
        None => (0..count).for_each(spread),
    }
    Ok(found)
}

struct Look<'a> {
    normal: Output<'a>,
    edge_length: ScalarOutput<'a>,
    marks: StatusOutput<'a>,
}

/// The unit normal of a corner's face; zero where it has none.
#[inline(always)]
fn unit<V: Vector, F: Face<V>>(corner: &Corner<V, F>) -> Vector3<V> {
    corner.direction() * corner.unit()
}

/// What is added up over the corners of all fans.
#[derive(Clone, Copy)]
struct Sums<V> {
    /// The mean lengths of the two edges.
    lengths: V,
    /// Half of both edges, along the normal.
    heights: V,
    /// The smallest cosine of a face and the normal.
    least: V,
}

impl<V: Vector> Sums<V> {
    fn new() -> Self {
        Sums { lengths: V::zero(), heights: V::zero(), least: V::one() }
    }

    #[inline(always)]
    fn add<F: RingFaces<V>>(&mut self, ring: &Ring<'_, V, F>, normal: Vector3<V>) {
        let half = V::constant(0.5);
        let mut before = (ring.squared[0].sqrt(), ring.edges[0].dot(normal));
        for index in 0..ring.corner_count() {
            let after = (ring.squared[index + 1].sqrt(), ring.edges[index + 1].dot(normal));
            self.lengths = self.lengths + (before.0 + after.0) * half;
            self.heights = self.heights + (before.1 + after.1) * half;
            before = after;
            let unit = unit(&ring.corner(index));
            let there = V::zero().lt(unit.squared());
            self.least = V::select(there, unit.dot(normal), V::one()).min(self.least);
        }
    }

    /// Bits of lanes that are sharp, and of those that are spikes.
    #[inline(always)]
    fn marks(&self) -> (u32, u32) {
        let spike = (self.lengths * V::constant(SPIKE)).lt(self.heights.abs());
        (self.least.lt(V::constant(NEAR)).bits(), spike.bits())
    }
}

/// The marks of a lane.
#[inline(always)]
fn mark((sharp, spike): (u32, u32), lane: usize) -> u8 {
    let bit = |bits: u32, mark: u8| if bits & 1 << lane != 0 { mark } else { 0 };
    bit(sharp, Surroundings::SHARP) | bit(spike, Surroundings::SPIKE)
}

impl Quantity for Look<'_> {
    const SINGLE: bool = false;

    #[inline(always)]
    fn block<V: Vector, F: RingFaces<V>>(
        &self,
        vertices: &[u32],
        ring: &Ring<'_, V, F>,
        scale: V,
        scratch: &mut Scratch<'_, V>,
    ) -> u32 {
        let sum = Max::sum(ring, scratch);
        let (trusted, squared) = sum.trusted();
        let (trusted, normal) = (trusted.bits(), sum.vector.divided_by(squared.sqrt()));
        let mut sums = Sums::new();
        sums.add(ring, normal);
        let length = (sums.lengths * V::constant(1.0 / ring.corner_count() as f64) / scale).to_lanes();
        let marks = sums.marks();
        let axes = [normal.x.to_lanes(), normal.y.to_lanes(), normal.z.to_lanes()];
        for (lane, &vertex) in vertices.iter().enumerate() {
            if trusted & 1 << lane != 0 {
                self.normal
                    .write(vertex as usize, [axes[0][lane].into(), axes[1][lane].into(), axes[2][lane].into()]);
                self.edge_length.write(vertex as usize, [length[lane].into()]);
                self.marks.write(vertex as usize, mark(marks, lane));
            }
        }
        !trusted & ((1u32 << vertices.len()) - 1)
    }

    fn alone<F: RingFaces<f64>>(
        &self,
        vertex: usize,
        fans: &VertexFans<'_, F>,
        scale: f64,
        scratch: &mut Scratch<'_, f64>,
    ) {
        let Some((normal, ..)) = with_fallback::<Max, F>(fans, scale, scratch) else { return };
        let mut sums = Sums::<f64>::new();
        let mut corners = 0;
        for ring in fans.rings() {
            sums.add(&ring, Vector3 { x: normal[0], y: normal[1], z: normal[2] });
            corners += ring.corner_count();
        }
        self.normal.write(vertex, normal);
        // As in lanes, to the last bit.
        let length = sums.lengths * (1.0 / corners.max(1) as f64) / scale;
        self.edge_length.write(vertex, [length]);
        self.marks.write(vertex, mark(sums.marks(), 0));
    }

    fn isolated(&self, _vertex: usize) {}
}

/// Replaces the normals of the vertices of `run`, which must be a list, by those of vertices on a crease.
///
/// # Errors
/// As [`sweep_in`].
pub(super) fn crease_normals(
    room: &Room,
    topology: &Topology,
    points: &Points<'_>,
    run: &mut Run<'_>,
    normals: &mut [[f64; 3]],
) -> Result<(), Error> {
    sweep_in(room, topology, points, run, &Crease { normal: normals.into() })
}

struct Crease<'a> {
    normal: Output<'a>,
}

impl Quantity for Crease<'_> {
    const SINGLE: bool = false;

    /// Where rings are cut differs from lane to lane.
    #[inline(always)]
    fn block<V: Vector, F: RingFaces<V>>(
        &self,
        vertices: &[u32],
        _ring: &Ring<'_, V, F>,
        _scale: V,
        _scratch: &mut Scratch<'_, V>,
    ) -> u32 {
        (1u32 << vertices.len()) - 1
    }

    fn alone<F: RingFaces<f64>>(
        &self,
        vertex: usize,
        fans: &VertexFans<'_, F>,
        _scale: f64,
        _scratch: &mut Scratch<'_, f64>,
    ) {
        let mut pieces = Vector3::zero();
        for ring in fans.rings() {
            pieces = pieces + sum_of_pieces(&ring);
        }
        let length = pieces.squared().sqrt();
        if length > CANCELLED {
            let unit = pieces * (1.0 / length);
            self.normal.write(vertex, [unit.x, unit.y, unit.z]);
        }
    }

    fn isolated(&self, _vertex: usize) {}
}

/// The sum of the unit normals of the pieces of a ring.
fn sum_of_pieces<F: RingFaces<f64>>(ring: &Ring<'_, f64, F>) -> Vector3<f64> {
    let count = ring.corner_count();
    // Whether the ring is cut before a corner.
    let cut = |index: usize| {
        if index == 0 && !ring.closed {
            return true;
        }
        let (before, after) = (unit(&ring.corner((index + count - 1) % count)), unit(&ring.corner(index)));
        // A face without normal is on no side.
        before.dot(after) < NEAR && before.squared() > 0.0 && after.squared() > 0.0
    };
    let first = (0..count).find(|&index| cut(index)).unwrap_or(0);
    let mut pieces = Vector3::zero();
    let mut piece = [Sum::<f64>::zero(); 2];
    let mut finish = |piece: &mut [Sum<f64>; 2]| {
        let direction = piece.iter().find_map(|sum| {
            let (trusted, squared) = sum.trusted();
            trusted.then(|| sum.vector * (1.0 / squared.sqrt()))
        });
        pieces = pieces + direction.unwrap_or(Vector3::zero());
        *piece = [Sum::zero(); 2];
    };
    for step in 0..count {
        let index = (first + step) % count;
        if step > 0 && cut(index) {
            finish(&mut piece);
        }
        let corner = ring.corner(index);
        let terms = [term::<Max, f64, F::Face>(&corner), term::<Area, f64, F::Face>(&corner)];
        for (sum, (vector, spread)) in piece.iter_mut().zip(terms) {
            sum.vector = sum.vector + vector;
            sum.spread += spread;
        }
    }
    finish(&mut piece);
    pieces
}
