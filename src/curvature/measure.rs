//! Curvature measures: what estimators integrate over a vertex's cell, and its sum over a region around the vertex.
//!
//! The *cell* of a vertex is its barycentric share of the surface: of each face at it an equal share for each corner, of each
//! edge the nearer half. A measure over one ring is that of the vertex's own cell. Over `k` rings it is the sum over the
//! cells of the vertices at most `k − 1` rings away. Over a ball it is the sum over the cells that reach into the ball, each
//! counted by the part of it that does: for a cell of radius `h = √(area/π)` whose vertex is at the distance `d` from the
//! centre of a ball of radius `r`, that is `½ + (r − d)/2h`, held between 0 and 1. Only vertices that are connected to the
//! centre inside the ball count.
//!
//! Cells are computed once and added up as often as they are met. They are kept in the units of their own ring, together
//! with the power of two that these are, so the size of a mesh costs nothing.
//! Cost: one pass for the cells, then a few sums for each vertex of each region; 80 bytes a vertex.

use super::outputs::{Block, CurvatureOutputs, Local};
use super::principal::{Frame, Operator};
use super::ring::{RingEstimator, own_normals};
use crate::error::{Error, reserved};
use crate::parallel::{Claims, Run, for_each_chunk, thread_count};
use crate::simd::{MAX_LANES, Mask, Real, Vector, Vector3, each};
use crate::sweep::{NormalRows, Quantity, Ring, RingFaces, Scratch, VertexFans, sweep};
use crate::topology::{Neighbourhood, Topology, closure, status};
use crate::view::{Output, Points, boxed, zeroed};
use std::sync::{Mutex, PoisonError};

/// Integrals over a piece of surface.
#[derive(Clone, Copy)]
pub(crate) struct Measure<V> {
    /// Of 1.
    pub area: V,
    /// Of mean curvature.
    pub mean: V,
    /// Of Gaussian curvature.
    pub gaussian: V,
    /// Of a symmetric tensor: xx, yy, zz, xy, yz, zx.
    pub tensor: [V; 6],
}

/// An estimator that integrates over cells.
pub(crate) trait MeasureEstimator: Sync {
    /// As [`RingEstimator::NEIGHBOUR_NORMALS`].
    const NEIGHBOUR_NORMALS: bool = false;

    /// Adds what a fan has of the vertex's cell.
    fn add<V: Vector, F: RingFaces<V>>(
        ring: &Ring<'_, V, F>,
        frame: &Frame<V>,
        scratch: &mut Scratch<'_, V>,
        measure: &mut Measure<V>,
    );
    /// The curvatures that follow.
    fn finish<V: Vector>(measure: &Measure<V>, frame: &Frame<V>) -> Local<V>;
}

impl<V: Vector> Measure<V> {
    /// Of nothing.
    #[inline(always)]
    pub fn zero() -> Self {
        Measure { area: V::zero(), mean: V::zero(), gaussian: V::zero(), tensor: [V::zero(); 6] }
    }

    /// Adds `factor (a bᵀ + b aᵀ)/2` to the tensor.
    #[inline(always)]
    pub fn add_product(&mut self, a: Vector3<V>, b: Vector3<V>, factor: V) {
        let half = factor * V::constant(0.5);
        let products = [
            a.x * b.x * factor,
            a.y * b.y * factor,
            a.z * b.z * factor,
            (a.x * b.y + a.y * b.x) * half,
            (a.y * b.z + a.z * b.y) * half,
            (a.z * b.x + a.x * b.z) * half,
        ];
        for (sum, product) in self.tensor.iter_mut().zip(products) {
            *sum = *sum + product;
        }
    }

    /// The tensor in the tangent plane, `(x·Tx, x·Ty, y·Ty)`.
    #[inline(always)]
    pub fn tangential(&self, frame: &Frame<V>) -> Operator<V> {
        let image_x = self.apply(frame.x);
        let image_y = self.apply(frame.y);
        Operator { a: frame.x.dot(image_x), b: frame.y.dot(image_x), d: frame.y.dot(image_y) }
    }

    #[inline(always)]
    fn apply(&self, vector: Vector3<V>) -> Vector3<V> {
        let [xx, yy, zz, xy, yz, zx] = self.tensor;
        let Vector3 { x, y, z } = vector;
        Vector3 { x: xx * x + xy * y + zx * z, y: xy * x + yy * y + yz * z, z: zx * x + yz * y + zz * z }
    }
}

/// A [`MeasureEstimator`] over the vertex's own cell.
pub(crate) struct OneRing<E>(std::marker::PhantomData<fn(E)>);

/// A cell smaller than this, in units in which its ring is about 1 across, is not for single precision to judge.
const SMALL: f64 = 1.0 / 16.0;

impl<E> OneRing<E> {
    /// The estimator.
    pub fn new() -> Self {
        OneRing(std::marker::PhantomData)
    }
}

impl<E: MeasureEstimator> RingEstimator for OneRing<E> {
    const NEIGHBOUR_NORMALS: bool = E::NEIGHBOUR_NORMALS;
    type Sums<V: Vector> = Measure<V>;

    #[inline(always)]
    fn start<V: Vector>() -> Measure<V> {
        Measure::zero()
    }
    #[inline(always)]
    fn add<V: Vector, F: RingFaces<V>>(
        &self,
        ring: &Ring<'_, V, F>,
        frame: &Frame<V>,
        scratch: &mut Scratch<'_, V>,
        sums: &mut Measure<V>,
    ) {
        E::add(ring, frame, scratch, sums);
    }
    #[inline(always)]
    fn finish<V: Vector>(&self, sums: &Measure<V>, frame: &Frame<V>) -> Local<V> {
        let found = E::finish(sums, frame);
        if !V::Scalar::SINGLE {
            return found;
        }
        Local { usable: found.usable.and(V::constant(SMALL).lt(sums.area)), ..found }
    }
}

/// How far around a vertex a measure is taken.
#[derive(Clone, Copy)]
pub(crate) enum Region {
    /// So many rings, at least 1.
    Rings(usize),
    /// All within this distance.
    Ball(f64),
}

/// The part of the work that goes into cells, for progress.
const CELL_SHARE: f64 = 0.3;

/// A measure in numbers, and how many of its units of length make one of the mesh.
type Cell = [f64; 10];

/// Computes cells.
struct Cells<'a, E> {
    cells: Output<'a, 10>,
    normals: &'a [[f64; 3]],
    estimator: std::marker::PhantomData<fn(E)>,
}

impl<E: MeasureEstimator> Quantity for Cells<'_, E> {
    const SINGLE: bool = false;
    const CENTROIDS: bool = E::NEIGHBOUR_NORMALS;

    fn neighbour_normals(&self) -> Option<NormalRows<'_>> {
        E::NEIGHBOUR_NORMALS.then_some(NormalRows::Double(self.normals))
    }

    #[inline(always)]
    fn block<V: Vector, F: RingFaces<V>>(
        &self,
        vertices: &[u32],
        ring: &Ring<'_, V, F>,
        scale: V,
        scratch: &mut Scratch<'_, V>,
    ) -> u32 {
        let frame = Frame::new(own_normals::<V>(self.normals, vertices));
        let mut measure = Measure::zero();
        E::add(ring, &frame, scratch, &mut measure);
        let Measure { area, mean, gaussian, tensor: [xx, yy, zz, xy, yz, zx] } = measure;
        let cell = [area, mean, gaussian, xx, yy, zz, xy, yz, zx, scale];
        let rows: [_; 10] = each([V::Scalar::ZERO; MAX_LANES], |index| cell[index].to_lanes());
        for (lane, &vertex) in vertices.iter().enumerate() {
            self.cells.write(vertex as usize, each(0.0, |index| rows[index][lane].into()));
        }
        ring.overflowed() & ((1u32 << vertices.len()) - 1)
    }

    fn alone<F: RingFaces<f64>>(
        &self,
        vertex: usize,
        fans: &VertexFans<'_, F>,
        scale: f64,
        scratch: &mut Scratch<'_, f64>,
    ) {
        let frame = Frame::new(own_normals::<f64>(self.normals, &[vertex as u32]));
        let mut measure = Measure::<f64>::zero();
        for ring in fans.rings() {
            E::add(&ring, &frame, scratch, &mut measure);
        }
        let Measure { area, mean, gaussian, tensor: [xx, yy, zz, xy, yz, zx] } = measure;
        self.cells.write(vertex, [area, mean, gaussian, xx, yy, zz, xy, yz, zx, scale]);
    }

    fn isolated(&self, vertex: usize) {
        self.cells.write(vertex, [0.0; 10]);
    }
}

/// Computes `E` over `region`, more than one ring, around every vertex that `run` asks for; `listed` are the vertices whose cells that takes,
/// `None` for all.
pub(crate) fn over_region<E: MeasureEstimator>(
    topology: &Topology,
    points: &Points<'_>,
    mut run: Run<'_>,
    normals: &[[f64; 3]],
    outputs: &CurvatureOutputs<'_>,
    region: Region,
    listed: Option<&[u32]>,
) -> Result<(), Error> {
    let mut cells: Vec<Cell> = zeroed(topology.vertex_count())?;
    let estimator = std::marker::PhantomData;
    let quantity = Cells::<E> { cells: cells.as_mut_slice().into(), normals, estimator };
    run.part_for(listed, 0.0, CELL_SHARE, |mut run| sweep(topology, points, &mut run, true, &quantity))?;

    // A vertex costs as much as its region is large, so few are claimed at a time.
    const CHUNK: usize = 128;
    let list = run.vertices;
    let count = list.map_or(topology.vertex_count(), <[u32]>::len);
    let chunks = count.div_ceil(CHUNK);
    // Every thread takes one; they are there before the first result is written.
    let mut gathers = reserved(thread_count(run.threads, chunks))?;
    for _ in 0..gathers.capacity() {
        gathers.push(Gather::new(topology, region)?);
    }
    let gathers = Mutex::new(gathers);
    let sum_up = |claims: &mut Claims<'_, '_>| {
        let Some(mut gather) = gathers.lock().unwrap_or_else(PoisonError::into_inner).pop() else { return };
        while let Some(chunk) = claims.next() {
            for index in chunk * CHUNK..count.min((chunk + 1) * CHUNK) {
                let vertex = list.map_or(index, |list| list[index] as usize);
                if topology.ring(vertex).is_empty() {
                    outputs.write_none(vertex, [0.0; 3], status::ISOLATED);
                    continue;
                }
                let (measure, scale) = gather.sum(topology, points, &cells, vertex);
                let frame = Frame::new(own_normals::<f64>(normals, &[vertex as u32]));
                let found = E::finish(&measure, &frame);
                let flags = topology.flags();
                if frame.normal.squared() > 0.0 && found.trusted() != 0 {
                    let (vertices, scales, fallbacks) = ([vertex as u32], [scale; MAX_LANES], found.fallbacks());
                    let block = Block {
                        vertices: &vertices,
                        lanes: 1,
                        scales,
                        residual_power: -1,
                        flags,
                        more: 0,
                        fallbacks,
                    };
                    outputs.write(&block, &found.rows(outputs.taken()));
                } else {
                    outputs.write_none(vertex, normals[vertex], flags[vertex] | status::DEGENERATE);
                }
            }
        }
    };
    run.part(CELL_SHARE, 1.0, |mut run| for_each_chunk(&mut run, chunks, sum_up))
}

/// Adds up cells over a region.
enum Gather {
    Rings { rings: usize, neighbourhood: Box<Neighbourhood<'static>> },
    Ball(Ball),
}

/// The vertices connected to a centre inside a ball, and those next to them.
struct Ball {
    radius: f64,
    /// The visit that saw a vertex last.
    seen: Vec<u32>,
    visit: u32,
    found: Vec<u32>,
}

impl Gather {
    fn new(topology: &Topology, region: Region) -> Result<Self, Error> {
        Ok(match region {
            Region::Rings(rings) => Gather::Rings { rings, neighbourhood: boxed(Neighbourhood::new(topology)?)? },
            Region::Ball(radius) => Gather::Ball(Ball::new(topology, radius)?),
        })
    }

    /// The measure over the region around `vertex`, in the units of its own cell, and how many of them make one of the
    /// mesh.
    fn sum(
        &mut self,
        topology: &Topology,
        points: &Points<'_>,
        cells: &[Cell],
        vertex: usize,
    ) -> (Measure<f64>, f64) {
        let scale = cells[vertex][9];
        let mut measure = Measure::zero();
        match self {
            Gather::Rings { rings, neighbourhood } => {
                add_cell(&mut measure, scale, &cells[vertex], 1.0);
                for &other in neighbourhood.gather(topology, vertex as u32, *rings - 1) {
                    add_cell(&mut measure, scale, &cells[other as usize], 1.0);
                }
            }
            Gather::Ball(ball) => {
                ball.visit(topology, points, vertex as u32);
                for &other in &ball.found {
                    let cell = &cells[other as usize];
                    let part = ball.part(points, vertex, other as usize, cell);
                    add_cell(&mut measure, scale, cell, part);
                }
            }
        }
        (measure, scale)
    }
}

impl Ball {
    fn new(topology: &Topology, radius: f64) -> Result<Self, Error> {
        let seen = zeroed(topology.vertex_count())?;
        Ok(Ball { radius, seen, visit: 0, found: reserved(topology.vertex_count())? })
    }

    /// How far apart two vertices are, whatever their distance is; infinite beyond the range.
    fn distance(points: &Points<'_>, a: usize, b: usize) -> f64 {
        let half = points.get(a) * 0.5 - points.get(b) * 0.5;
        let largest = half.abs().max_element();
        if largest > 0.0 { 2.0 * largest * (half / largest).length() } else { 0.0 }
    }

    /// Fills `found`, breadth first.
    fn visit(&mut self, topology: &Topology, points: &Points<'_>, centre: u32) {
        if self.visit == u32::MAX {
            self.seen.fill(0);
            self.visit = 0;
        }
        self.visit += 1;
        self.found.clear();
        self.found.push(centre);
        self.seen[centre as usize] = self.visit;
        let mut next = 0;
        while let Some(&vertex) = self.found.get(next) {
            next += 1;
            // A position that is none, where only some vertices are computed, is not inside.
            let inside = Ball::distance(points, centre as usize, vertex as usize) < self.radius;
            if vertex != centre && !inside {
                continue;
            }
            for &neighbour in topology.ring(vertex as usize) {
                if std::mem::replace(&mut self.seen[neighbour as usize], self.visit) != self.visit {
                    self.found.push(neighbour);
                }
            }
        }
    }

    /// How much of a cell lies in the ball.
    fn part(&self, points: &Points<'_>, centre: usize, vertex: usize, cell: &Cell) -> f64 {
        let diameter = 2.0 * (cell[0].max(0.0) / std::f64::consts::PI).sqrt() / cell[9];
        let inside = self.radius - Ball::distance(points, centre, vertex);
        // A cell without area is in or out; one infinitely large and far away is out.
        let part = if diameter > 0.0 { 0.5 + inside / diameter } else { (inside > 0.0) as u8 as f64 };
        // Of sizes beyond the range nothing is known, and nothing is taken.
        if part > 0.0 { part.min(1.0) } else { 0.0 }
    }
}

/// Adds a part of a cell to a measure in units of which `scale` make one of the mesh.
fn add_cell(measure: &mut Measure<f64>, scale: f64, cell: &Cell, part: f64) {
    let &[area, mean, gaussian, xx, yy, zz, xy, yz, zx, cell_scale] = cell;
    // Vertices without faces have neither cell nor scale; of cells that are out of all proportion nothing is left.
    let ratio = scale / cell_scale;
    if !(ratio > 0.0 && ratio < f64::INFINITY) {
        return;
    }
    let length = ratio * part;
    measure.area += area * ratio * length;
    measure.mean += mean * length;
    measure.gaussian += gaussian * part;
    for (sum, value) in measure.tensor.iter_mut().zip([xx, yy, zz, xy, yz, zx]) {
        *sum += value * length;
    }
}

/// The vertices whose cells the regions around `vertices` may need.
pub(crate) fn cells_needed(
    topology: &Topology,
    points: &Points<'_>,
    vertices: &[u32],
    region: Region,
) -> Result<Vec<u32>, Error> {
    let radius = match region {
        Region::Rings(rings) => return closure(topology, vertices, rings - 1),
        Region::Ball(radius) => radius,
    };
    let mut ball = Ball::new(topology, radius)?;
    let mut needed: Vec<u8> = zeroed(topology.vertex_count())?;
    let mut list = Vec::new();
    for &vertex in vertices {
        ball.visit(topology, points, vertex);
        for &found in &ball.found {
            if std::mem::replace(&mut needed[found as usize], 1) == 0 {
                list.try_reserve(1)?;
                list.push(found);
            }
        }
    }
    Ok(list)
}
