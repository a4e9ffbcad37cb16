//! The sweep: the one loop over vertices.
//!
//! It takes vertices in batches sorted by ring class, loads their edges as lanes, hands an estimator one [`Ring`] after
//! the other, and sends what an estimator does not trust on to `f64`, and from there to the vertex-by-vertex path that
//! knows every fallback. Threads, subsets, progress and vector widths live here; an estimator sees none of them.
//!
//! | input | computed in | then, where the estimator is in doubt |
//! |---|---|---|
//! | triangles, `f32` in and out | `f32` lanes | `f64` lanes, then alone |
//! | triangles, any `f64` | `f64` lanes | alone |
//! | polygons | `f64` lanes | alone |
//! | several fans, large fans | alone, in `f64` | |
//!
//! Which way a vertex goes depends on its own ring and nothing else.

mod frames;
mod ring;

pub(crate) use frames::{CANCELLED, frame};
pub(crate) use ring::{Corner, Face, Ring, RingFaces, Scratch};

use crate::error::Error;
use crate::parallel::{Claims, Run, for_each_chunk};
use crate::simd::{MAX_LANES, Real, Task, Vector, Vector3, Width, dispatch};
use crate::topology::Topology;
use crate::view::{Batch, Coordinate, MAX_LANE_CORNERS, PointArray, Points, RingClass, Rings, StridedPoints, WINDOW};
use frames::Frames;
use glam::DVec3;
use ring::{Polygon, PolygonFaces, Triangles};

/// An estimator over one-rings, and where its results go.
pub(crate) trait Quantity: Sync {
    /// Whether polygons need their centroids.
    const CENTROIDS: bool;

    /// Computes and writes the vertices of a block; answers with a bit for each lane that it did not write, because
    /// its result cannot be trusted at this precision.
    ///
    /// `scale` is how many of the ring's units a unit of the mesh is.
    fn block<V: Vector, F: RingFaces<V>>(
        &self,
        vertices: &[u32],
        ring: &Ring<'_, V, F>,
        scale: V,
        scratch: &mut Scratch<V>,
    ) -> u32;

    /// Computes and writes one vertex with any number of fans, whatever they are like.
    fn alone<F: RingFaces<f64>>(
        &self,
        vertex: usize,
        fans: &[Ring<'_, f64, F>],
        scale: f64,
        scratch: &mut Scratch<f64>,
    );

    /// Writes a vertex that has no face.
    fn isolated(&self, vertex: usize);
}

/// Computes `quantity` at every vertex that `run` asks for. `double` asks for `f64` even where positions are `f32`.
///
/// # Errors
/// What [`check_points`] finds; [`Error::Cancelled`]; [`Error::OutOfMemory`].
pub(crate) fn sweep<Q: Quantity>(
    topology: &Topology,
    points: &Points<'_>,
    run: &mut Run<'_>,
    double: bool,
    quantity: &Q,
) -> Result<(), Error> {
    check_points(topology, points, run.vertices)?;
    match points.array() {
        PointArray::F32(points) => sweep_points(topology, points, run, double, quantity),
        PointArray::F64(points) => sweep_points(topology, points, run, true, quantity),
    }
}

/// Refuses positions that are too few, too many or not finite, and vertices that are none. With a subset, only the
/// positions that it needs are looked at.
fn check_points(topology: &Topology, points: &Points<'_>, vertices: Option<&[u32]>) -> Result<(), Error> {
    let expected = topology.vertex_count() as u64;
    if points.len() as u64 != expected {
        return Err(Error::Size { what: "points.count", found: points.len() as u64, expected });
    }
    let Some(vertices) = vertices else {
        return points.check_finite();
    };
    let check = |vertex: u32| {
        let finite = points.get(vertex as usize).is_finite();
        if finite { Ok(()) } else { Err(Error::NonFinitePosition { vertex: vertex as u64 }) }
    };
    for (position, &vertex) in vertices.iter().enumerate() {
        if vertex as u64 >= expected {
            let (position, index) = (position as u64, vertex as i128);
            return Err(Error::IndexOutOfRange { what: "run.vertices", position, index, vertex_count: expected });
        }
    }
    if corners_met(topology, vertices).is_none() {
        return points.check_finite();
    }
    for &vertex in vertices {
        check(vertex)?;
        let ring = topology.rings().ring_range(vertex as usize);
        match topology.polygons() {
            None => topology.ring(vertex as usize).iter().try_for_each(|&neighbour| check(neighbour))?,
            Some(polygons) => {
                for &face in polygons.corner_faces(ring) {
                    if face != crate::topology::NO_FACE {
                        polygons.face(face as usize).iter().try_for_each(|&corner| check(corner))?;
                    }
                }
            }
        }
    }
    Ok(())
}

/// How many corners the faces at `vertices` have, a face counted as often as it is met; `None` if more than the mesh.
fn corners_met(topology: &Topology, vertices: &[u32]) -> Option<usize> {
    let mut budget = topology.rings().entry_count();
    for &vertex in vertices {
        let ring = topology.rings().ring_range(vertex as usize);
        let met = match topology.polygons() {
            None => ring.len(),
            Some(polygons) => {
                let corners = |&face: &u32| match face {
                    crate::topology::NO_FACE => 0,
                    face => polygons.face(face as usize).len(),
                };
                polygons.corner_faces(ring).iter().map(corners).sum()
            }
        };
        budget = budget.checked_sub(met + 1)?;
    }
    Some(topology.rings().entry_count() - budget)
}

fn sweep_points<Q: Quantity, S: Coordinate>(
    topology: &Topology,
    points: &StridedPoints<'_, S>,
    run: &mut Run<'_>,
    double: bool,
    quantity: &Q,
) -> Result<(), Error> {
    let few = run.vertices.is_some_and(|vertices| corners_met(topology, vertices).is_some());
    let frames = match topology.polygons() {
        Some(polygons) => Some(Frames::new(points, polygons, Q::CENTROIDS, few, run.threads)?),
        None => None,
    };
    let (vertices, level) = (run.vertices, run.level);
    let chunks = vertices.map_or(topology.rings().windows(), |vertices| vertices.len().div_ceil(WINDOW));
    let sweep = Sweep { topology, points, frames, vertices, double, quantity };
    for_each_chunk(run, chunks, |claims| dispatch(level, Worker { sweep: &sweep, claims }))
}

struct Sweep<'a, Q, S> {
    topology: &'a Topology,
    points: &'a StridedPoints<'a, S>,
    frames: Option<Frames<'a, S>>,
    vertices: Option<&'a [u32]>,
    double: bool,
    quantity: &'a Q,
}

/// One thread's part of a sweep.
struct Worker<'a, 'c, 'p, 's, Q, S> {
    sweep: &'a Sweep<'a, Q, S>,
    claims: &'c mut Claims<'s, 'p>,
}

/// A ring's rows, reused from block to block.
struct Rows<V> {
    edges: Vec<Vector3<V>>,
    squared: Vec<V>,
    faces: Vec<Polygon<V>>,
    scratch: Scratch<V>,
}

impl<V: Vector> Rows<V> {
    fn new() -> Self {
        Rows {
            edges: vec![Vector3::zero(); MAX_LANE_CORNERS + 1],
            squared: vec![V::zero(); MAX_LANE_CORNERS + 1],
            faces: Vec::with_capacity(MAX_LANE_CORNERS),
            scratch: Scratch::new(MAX_LANE_CORNERS),
        }
    }
}

impl<Q: Quantity, S: Coordinate> Task for Worker<'_, '_, '_, '_, Q, S> {
    #[inline(always)]
    fn run<W: Width>(self) {
        let sweep = self.sweep;
        let single = !sweep.double && sweep.frames.is_none();
        let mut single_rows = Rows::<W::Single>::new();
        let mut double_rows = Rows::<W::Double>::new();
        let mut alone_rows = Rows::<f64>::new();
        let mut batch = Batch::new();
        let mut doubtful: Vec<u32> = Vec::with_capacity(WINDOW);
        while let Some(chunk) = self.claims.next() {
            match sweep.vertices {
                None => sweep.topology.rings().fill_window(chunk, &mut batch),
                Some(list) => {
                    let list = &list[chunk * WINDOW..];
                    sweep.topology.rings().fill_list(&list[..list.len().min(WINDOW)], &mut batch);
                }
            }
            for index in 0..batch.len() {
                let (class, vertices) = batch.get(index);
                let mut vertices = vertices;
                let (corners, closed) = match class {
                    RingClass::Isolated => {
                        vertices.iter().for_each(|&vertex| sweep.quantity.isolated(vertex as usize));
                        continue;
                    }
                    RingClass::Alone => {
                        vertices.iter().for_each(|&vertex| sweep.alone(vertex as usize, &mut alone_rows));
                        continue;
                    }
                    RingClass::Lanes { corners, closed } => (corners, closed),
                };
                if single {
                    doubtful.clear();
                    for block in vertices.chunks(W::Single::LANES) {
                        let bits = sweep.block(block, corners, closed, &mut single_rows);
                        if bits != 0 {
                            push_lanes(bits, block, &mut doubtful);
                        }
                    }
                    vertices = &doubtful;
                }
                for block in vertices.chunks(W::Double::LANES) {
                    let bits = sweep.block(block, corners, closed, &mut double_rows);
                    if bits != 0 {
                        for (lane, &vertex) in block.iter().enumerate() {
                            if bits & 1 << lane != 0 {
                                sweep.alone(vertex as usize, &mut alone_rows);
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Appends the vertices whose lane's bit is set.
fn push_lanes(bits: u32, block: &[u32], vertices: &mut Vec<u32>) {
    vertices.extend(block.iter().enumerate().filter(|(lane, _)| bits & 1 << lane != 0).map(|(_, vertex)| *vertex));
}

impl<Q: Quantity, S: Coordinate> Sweep<'_, Q, S> {
    #[inline(always)]
    fn block<V: Vector>(&self, block: &[u32], corners: usize, closed: bool, rows: &mut Rows<V>) -> u32 {
        let Rows { edges, squared, faces, scratch } = rows;
        let edges = &mut edges[..corners + 1];
        let squared = &mut squared[..corners + 1];
        self.topology.rings().load_edges(self.points, block, corners, closed, edges);
        let mut extent = V::zero();
        for edge in edges.iter() {
            extent = edge.largest_component().max(extent);
        }
        let scale = extent.unit_scale();
        scale_edges(edges, squared, scale);
        // Only double precision computes polygons, so single precision never compiles that path.
        if let (false, Some(frames)) = (V::Scalar::SINGLE, &self.frames) {
            self.load_faces(frames, block, corners, scale, faces);
            self.quantity.block(block, &Ring { edges, squared, closed, faces: PolygonFaces(faces) }, scale, scratch)
        } else {
            self.quantity.block(block, &Ring { edges, squared, closed, faces: Triangles }, scale, scratch)
        }
    }

    /// Fills `faces` in the ring's units, the lanes beyond `block` with copies of its first.
    #[inline(always)]
    fn load_faces<V: Vector>(
        &self,
        frames: &Frames<'_, S>,
        block: &[u32],
        corners: usize,
        scale: V,
        faces: &mut Vec<Polygon<V>>,
    ) {
        let scales = scale.to_lanes();
        faces.clear();
        for corner in 0..corners {
            let mut normal = [[V::Scalar::ZERO; MAX_LANES]; 3];
            let mut centroid = [[V::Scalar::ZERO; MAX_LANES]; 3];
            let mut area = [V::Scalar::ZERO; MAX_LANES];
            for lane in 0..V::LANES {
                let vertex = *block.get(lane).unwrap_or(&block[0]) as usize;
                let face = frames.face_of(self.topology.rings().ring_range(vertex).start + corner);
                let loaded = self.load_face(frames, face, vertex, 1.0, scales[lane].into());
                area[lane] = V::Scalar::from_f64(loaded.area);
                for axis in 0..3 {
                    normal[axis][lane] = V::Scalar::from_f64(loaded.normal[axis]);
                    centroid[axis][lane] = V::Scalar::from_f64(loaded.centroid[axis]);
                }
            }
            faces.push(Polygon {
                normal: Vector3::from_lanes(&normal),
                area: V::from_lanes(&area),
                centroid: Vector3::from_lanes(&centroid),
            });
        }
    }

    /// A face as a vertex sees it, in units of `scale` to a length of the mesh times `factor`.
    #[inline(always)]
    fn load_face(&self, frames: &Frames<'_, S>, face: usize, vertex: usize, factor: f64, scale: f64) -> LoadedFace {
        let frame = frames.get(face);
        // A face may be larger than the ring by any amount, but its square must stay in range.
        const LARGEST: f64 = (1u128 << 100) as f64;
        let size = (frame.size * factor * scale).min(LARGEST);
        let mut centroid = DVec3::ZERO;
        if Q::CENTROIDS {
            let point = |vertex: usize| self.points.get(vertex) * factor;
            let offset = frame.centroid * factor + (point(frames.first_corner(face) as usize) - point(vertex));
            centroid = offset * scale;
        }
        LoadedFace { normal: frame.normal, area: size * size, centroid }
    }

    /// The vertex-by-vertex path.
    #[inline(never)]
    fn alone(&self, vertex: usize, rows: &mut Rows<f64>) {
        let Rows { edges, squared, faces, scratch } = rows;
        // Positions so far apart that their difference overflows are brought closer first; the factor is exact
        // for them.
        let mut factor = 1.0;
        let mut extent = self.load_alone(vertex, factor, edges);
        if extent == f64::INFINITY {
            factor = 0.25;
            extent = self.load_alone(vertex, factor, edges);
        }
        let scale = extent.unit_scale();
        squared.resize(edges.len(), 0.0);
        scale_edges(edges, squared, scale);
        faces.clear();
        if let Some(frames) = &self.frames {
            let ring_start = self.topology.rings().ring_range(vertex).start;
            for fan in self.topology.fans(vertex) {
                for corner in 0..fan.corner_count {
                    let face = frames.face_of(ring_start + fan.start + corner);
                    let LoadedFace { normal, area, centroid } = self.load_face(frames, face, vertex, factor, scale);
                    faces.push(Polygon { normal: lane(normal), area, centroid: lane(centroid) });
                }
            }
        }
        let (mut edges, mut squared, mut faces) = (edges.as_slice(), squared.as_slice(), faces.as_slice());
        let rings: Vec<Ring<'_, f64, PolygonFaces<'_, f64>>> = self
            .topology
            .fans(vertex)
            .map(|fan| {
                scratch.grow(fan.corner_count);
                // Triangles have none.
                let face_count = fan.corner_count.min(faces.len());
                let own_faces = take(&mut faces, face_count);
                Ring {
                    edges: take(&mut edges, fan.corner_count + 1),
                    squared: take(&mut squared, fan.corner_count + 1),
                    closed: fan.closed,
                    faces: PolygonFaces(own_faces),
                }
            })
            .collect();
        if self.frames.is_some() {
            self.quantity.alone(vertex, &rings, scale * factor, scratch);
        } else {
            let rings: Vec<_> = rings.iter().map(|ring| ring.with_faces(Triangles)).collect();
            self.quantity.alone(vertex, &rings, scale * factor, scratch);
        }
    }

    /// Fills `edges` fan after fan, in a closed one the first again at the end; answers with their extent.
    fn load_alone(&self, vertex: usize, factor: f64, edges: &mut Vec<Vector3<f64>>) -> f64 {
        edges.clear();
        for fan in self.topology.fans(vertex) {
            let first = edges.len();
            Rings::edges_of(self.points, vertex, fan.neighbours, factor, edges);
            if fan.closed {
                edges.push(edges[first]);
            }
        }
        edges.iter().fold(0.0, |extent, edge| edge.largest_component().max(extent))
    }
}

/// Splits off the first `count` elements.
fn take<'a, T>(rest: &mut &'a [T], count: usize) -> &'a [T] {
    let (first, others) = rest.split_at(count);
    *rest = others;
    first
}

/// A polygon as a vertex sees it, in the ring's units.
struct LoadedFace {
    normal: DVec3,
    area: f64,
    centroid: DVec3,
}

fn lane(vector: DVec3) -> Vector3<f64> {
    Vector3 { x: vector.x, y: vector.y, z: vector.z }
}

#[inline(always)]
fn scale_edges<V: Vector>(edges: &mut [Vector3<V>], squared: &mut [V], scale: V) {
    for (edge, squared) in edges.iter_mut().zip(squared) {
        *edge = *edge * scale;
        *squared = edge.squared();
    }
}
