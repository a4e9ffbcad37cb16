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

mod calls;
mod frames;
mod patch;
mod patch_sweep;
mod ring;
mod rows;

pub(crate) use frames::{CANCELLED, area_vector};
pub(crate) use patch::{Counts, MOST_EXTRA_RINGS, MOST_RINGS, Patch, PatchQuantity};
pub(crate) use patch_sweep::sweep_patches;
pub(crate) use ring::{Corner, Face, Ring, RingFaces, Scratch, VertexFans};

use crate::error::{Error, filled};
use crate::parallel::{Claims, Run, for_each_chunk};
use crate::simd::{Real, Task, Vector, Vector3, Width};
use crate::topology::{NO_FACE, Polygons, Topology};
use crate::view::{Batch, Coordinate, PointArray, Points, RingClass, Rings, StridedPoints, WINDOW};
use calls::{AloneCalls, BlockCalls, Both, Calls};
use frames::{Asked, Frames};
use glam::DVec3;
use ring::{Polygon, PolygonFaces, Triangles};
use rows::{LANE_EDGES, LaneRows, LargeRows, Rows};
use std::sync::{Mutex, PoisonError};

/// An estimator over one-rings, and where its results go.
pub(crate) trait Quantity: Sync {
    /// Whether it is ever computed in single precision.
    const SINGLE: bool = true;
    /// Whether polygons need their centroids.
    const CENTROIDS: bool = false;
    /// Whether the angles of polygons that are not flat are made up to those of flat ones.
    const FLAT_ANGLES: bool = false;

    /// The normals of all vertices, where rings are to hold those of the neighbours.
    fn neighbour_normals(&self) -> Option<NormalRows<'_>> {
        None
    }

    /// Computes and writes the vertices of a block; answers with a bit for each lane that it did not write, because
    /// its result cannot be trusted at this precision.
    ///
    /// `scale` is how many of the ring's units a unit of the mesh is.
    fn block<V: Vector, F: RingFaces<V>>(
        &self,
        vertices: &[u32],
        ring: &Ring<'_, V, F>,
        scale: V,
        scratch: &mut Scratch<'_, V>,
    ) -> u32;

    /// Computes and writes one vertex with any number of fans, whatever they are like.
    fn alone<F: RingFaces<f64>>(
        &self,
        vertex: usize,
        fans: &VertexFans<'_, F>,
        scale: f64,
        scratch: &mut Scratch<'_, f64>,
    );

    /// Writes a vertex that has no face.
    fn isolated(&self, vertex: usize);
}

/// Normals of all vertices.
#[derive(Clone, Copy)]
pub(crate) enum NormalRows<'a> {
    /// In single precision, where positions are.
    Single(&'a [[f32; 3]]),
    /// In double precision.
    Double(&'a [[f64; 3]]),
}

impl NormalRows<'_> {
    /// The normal of a vertex.
    #[inline(always)]
    pub fn get(&self, vertex: usize) -> [f64; 3] {
        match self {
            NormalRows::Single(rows) => rows[vertex].map(f64::from),
            NormalRows::Double(rows) => rows[vertex],
        }
    }
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
    sweep_calls(topology, points, run, double, quantity)
}

/// As [`sweep`], for a quantity that takes its own vertex's normal from [`Scratch::normal`], where `normals` leaves it: both
/// see each ring when it has just been loaded.
///
/// # Errors
/// As [`sweep`].
pub(crate) fn sweep_with_normals<N: Quantity, Q: Quantity>(
    topology: &Topology,
    points: &Points<'_>,
    run: &mut Run<'_>,
    double: bool,
    normals: &N,
    quantity: &Q,
) -> Result<(), Error> {
    sweep_calls(topology, points, run, double, &Both { first: normals, second: quantity })
}

fn sweep_calls(
    topology: &Topology,
    points: &Points<'_>,
    run: &mut Run<'_>,
    double: bool,
    calls: &dyn Calls,
) -> Result<(), Error> {
    check_points(topology, points, run.vertices)?;
    match points.array() {
        PointArray::F32(points) => {
            sweep_points(topology, points, run, double, calls, |sweep| AnySweep::Single(sweep))
        }
        PointArray::F64(points) => sweep_points(topology, points, run, true, calls, |sweep| AnySweep::Double(sweep)),
    }
}

/// Refuses positions that are too few or too many, and vertices that are none.
pub(crate) fn check_counts(topology: &Topology, points: &Points<'_>, vertices: Option<&[u32]>) -> Result<(), Error> {
    let expected = topology.vertex_count() as u64;
    if points.len() as u64 != expected {
        return Err(Error::Size { what: "points.count", found: points.len() as u64, expected });
    }
    for (position, &vertex) in vertices.unwrap_or(&[]).iter().enumerate() {
        if vertex as u64 >= expected {
            let (position, index) = (position as u64, vertex as i128);
            return Err(Error::IndexOutOfRange { what: "run.vertices", position, index, vertex_count: expected });
        }
    }
    Ok(())
}

/// Refuses positions that are too few, too many or not finite, and vertices that are none. With a list of vertices, only
/// the positions that it needs may be to blame.
fn check_points(topology: &Topology, points: &Points<'_>, vertices: Option<&[u32]>) -> Result<(), Error> {
    check_counts(topology, points, vertices)?;
    let Some(vertices) = vertices else {
        return points.check_finite();
    };
    // For a long list it is cheaper to look at all positions; only if that finds one is the list gone through, each
    // vertex and each face once.
    let long = corners_met(topology, vertices).is_none();
    if long && points.check_finite().is_ok() {
        return Ok(());
    }
    let faces = topology.polygons().map_or(0, Polygons::face_count);
    let mut seen =
        [filled(if long { points.len() } else { 0 }, false)?, filled(if long { faces } else { 0 }, false)?];
    let mut first_time = |kind: usize, index: u32| match seen[kind].get_mut(index as usize) {
        Some(seen) => !std::mem::replace(seen, true),
        None => true,
    };
    let check = |vertex: &u32| {
        let finite = points.get(*vertex as usize).is_finite();
        if finite { Ok(()) } else { Err(Error::NonFinitePosition { vertex: *vertex as u64 }) }
    };
    for vertex in vertices {
        if !first_time(0, *vertex) {
            continue;
        }
        check(vertex)?;
        let ring = topology.rings().ring_range(*vertex as usize);
        match topology.polygons() {
            None => topology.ring(*vertex as usize).iter().try_for_each(check)?,
            Some(polygons) => {
                for &face in polygons.corner_faces(ring) {
                    if face != NO_FACE && first_time(1, face) {
                        polygons.face(face as usize).iter().try_for_each(check)?;
                    }
                }
            }
        }
    }
    Ok(())
}

/// How many corners the faces at `vertices` have, a face counted as often as it is met; `None` if that is more work than
/// the whole mesh.
fn corners_met(topology: &Topology, vertices: &[u32]) -> Option<usize> {
    let whole = topology.rings().entry_count()
        + topology.vertex_count()
        + topology.polygons().map_or(0, |polygons| polygons.face_count());
    let mut budget = whole;
    for &vertex in vertices {
        let ring = topology.rings().ring_range(vertex as usize);
        let met = match topology.polygons() {
            None => ring.len(),
            Some(polygons) => {
                let corners = |&face: &u32| match face {
                    NO_FACE => 0,
                    face => polygons.face(face as usize).len(),
                };
                polygons.corner_faces(ring).iter().map(corners).sum()
            }
        };
        budget = budget.checked_sub(met + 1)?;
    }
    Some(whole - budget)
}

fn sweep_points<S: Coordinate>(
    topology: &Topology,
    points: &StridedPoints<'_, S>,
    run: &mut Run<'_>,
    double: bool,
    calls: &dyn Calls,
    any: impl for<'a> Fn(&'a Sweep<'a, S>) -> AnySweep<'a> + Sync,
) -> Result<(), Error> {
    let few = run.vertices.is_some_and(|vertices| corners_met(topology, vertices).is_some());
    let frames = match topology.polygons() {
        Some(polygons) => {
            let normals = calls.neighbour_normals();
            let asked = Asked { centroids: calls.centroids(), bends: calls.flat_angles(), normals };
            Some(Frames::new(points, polygons, asked, few, run.threads)?)
        }
        None => None,
    };
    let normals = calls.neighbour_normals().map(NeighbourNormals::from);
    let (vertices, level) = (run.vertices, run.level);
    let chunks = vertices.map_or(topology.rings().windows(), |vertices| vertices.len().div_ceil(WINDOW));
    // The one buffer whose size depends on the mesh is there before the first result is written. Vertices that need it
    // are few and take turns.
    let large = match vertices {
        None => topology.largest_alone(),
        Some(vertices) => {
            let alone = |vertex: &u32| matches!(topology.rings().class(*vertex as usize), RingClass::Alone);
            let edges = |vertex: &u32| topology.edges_alone(*vertex as usize);
            vertices.iter().filter(|vertex| alone(vertex)).map(edges).max().unwrap_or(0)
        }
    };
    let large = Mutex::new(LargeRows::new(large)?);
    let sweep = Sweep { topology, points, frames, normals, vertices, double, large: &large };
    for_each_chunk(run, chunks, |claims| calls.work(level, Part { sweep: any(&sweep), claims }))
}

/// [`NormalRows`] to load from.
enum NeighbourNormals<'a> {
    Single(StridedPoints<'a, f32>),
    Double(StridedPoints<'a, f64>),
}

impl<'a> From<NormalRows<'a>> for NeighbourNormals<'a> {
    fn from(rows: NormalRows<'a>) -> Self {
        match rows {
            NormalRows::Single(rows) => NeighbourNormals::Single(rows.into()),
            NormalRows::Double(rows) => NeighbourNormals::Double(rows.into()),
        }
    }
}

struct Sweep<'a, S> {
    topology: &'a Topology,
    points: &'a StridedPoints<'a, S>,
    frames: Option<Frames<'a, S>>,
    normals: Option<NeighbourNormals<'a>>,
    vertices: Option<&'a [u32]>,
    double: bool,
    /// For vertices with more edges than [`LaneRows`] hold.
    large: &'a Mutex<LargeRows>,
}

/// A sweep over positions of either precision.
#[derive(Clone, Copy)]
enum AnySweep<'a> {
    Single(&'a Sweep<'a, f32>),
    Double(&'a Sweep<'a, f64>),
}

/// One thread's part of a sweep, before its width is known.
struct Part<'a, 'c, 's, 'p> {
    sweep: AnySweep<'a>,
    claims: &'c mut Claims<'s, 'p>,
}

impl Part<'_, '_, '_, '_> {
    #[inline(always)]
    fn run<W: Width>(self, calls: &dyn BlockCalls<W>) {
        let claims = self.claims;
        match self.sweep {
            AnySweep::Single(sweep) => W::call(Worker { sweep, calls, claims }),
            AnySweep::Double(sweep) => W::call(Worker { sweep, calls, claims }),
        }
    }
}

/// One thread's part of a sweep.
struct Worker<'a, 'c, 'p, 's, W, S> {
    sweep: &'a Sweep<'a, S>,
    calls: &'a dyn BlockCalls<W>,
    claims: &'c mut Claims<'s, 'p>,
}

impl<W: Width, S: Coordinate> Task for Worker<'_, '_, '_, '_, W, S> {
    /// The width is that of `calls`.
    #[inline(always)]
    fn run<Same: Width>(self) {
        let Worker { sweep, calls, claims } = self;
        let single = !sweep.double && sweep.frames.is_none() && calls.has_single();
        let mut single_rows = LaneRows::<W::Single>::new();
        let mut double_rows = LaneRows::<W::Double>::new();
        let mut alone_rows = LaneRows::<f64>::new();
        let mut batch = Batch::new();
        let mut doubtful = [0u32; WINDOW];
        while let Some(chunk) = claims.next() {
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
                        vertices.iter().for_each(|&vertex| calls.isolated(vertex as usize));
                        continue;
                    }
                    RingClass::Alone => {
                        vertices.iter().for_each(|&vertex| sweep.alone(calls, vertex as usize, &mut alone_rows));
                        continue;
                    }
                    RingClass::Lanes { corners, closed } => (corners, closed),
                };
                if single {
                    let mut count = 0;
                    let mut blocks = vertices.chunks(W::Single::LANES).peekable();
                    while let Some(block) = blocks.next() {
                        sweep.prefetch(&batch, blocks.peek(), corners);
                        let Loaded { ring, scale, mut scratch, .. } =
                            sweep.load(block, corners, closed, &mut single_rows);
                        let bits = calls.single(block, &ring, &scale, &mut scratch);
                        if bits != 0 {
                            for (_, &vertex) in block.iter().enumerate().filter(|(lane, _)| bits & 1 << lane != 0) {
                                doubtful[count] = vertex;
                                count += 1;
                            }
                        }
                    }
                    vertices = &doubtful[..count];
                }
                let mut blocks = vertices.chunks(W::Double::LANES).peekable();
                while let Some(block) = blocks.next() {
                    sweep.prefetch(&batch, blocks.peek(), corners);
                    let Loaded { ring, scale, faces, mut scratch } =
                        sweep.load(block, corners, closed, &mut double_rows);
                    let bits = if let Some(frames) = &sweep.frames {
                        sweep.load_faces(frames, calls.centroids(), block, scale, faces);
                        calls.polygons(block, &ring.with_faces(PolygonFaces(faces)), &scale, &mut scratch)
                    } else {
                        calls.triangles(block, &ring, &scale, &mut scratch)
                    };
                    if bits != 0 {
                        for (lane, &vertex) in block.iter().enumerate() {
                            if bits & 1 << lane != 0 {
                                sweep.alone(calls, vertex as usize, &mut alone_rows);
                            }
                        }
                    }
                }
            }
        }
    }
}

/// The rings of a block.
struct Loaded<'r, V> {
    ring: Ring<'r, V, Triangles>,
    /// How many of the rings' units make one of the mesh.
    scale: V,
    /// One for each corner, to be filled where they are not triangles.
    faces: &'r mut [Polygon<V>],
    /// For the estimator.
    scratch: Scratch<'r, V>,
}

impl<S: Coordinate> Sweep<'_, S> {
    /// Fetches what the block that comes next needs, where memory would otherwise be waited for.
    #[inline(always)]
    fn prefetch(&self, batch: &Batch, next: Option<&&[u32]>, corners: usize) {
        let Some(block) = next.filter(|_| batch.is_scattered()) else { return };
        let rings = self.topology.rings();
        rings.prefetch(self.points, block, corners);
        match &self.normals {
            Some(NeighbourNormals::Single(normals)) => rings.prefetch(normals, block, corners),
            Some(NeighbourNormals::Double(normals)) => rings.prefetch(normals, block, corners),
            None => {}
        }
    }

    /// Loads the rings of a block, in their own units.
    #[inline(always)]
    fn load<'r, V: Vector>(
        &self,
        block: &[u32],
        corners: usize,
        closed: bool,
        rows: &'r mut LaneRows<V>,
    ) -> Loaded<'r, V> {
        let Rows { edges, squared, normals, faces, scratch } = rows.rows();
        let edges = &mut edges[..corners + 1];
        let squared = &mut squared[..corners + 1];
        let normals: &[_] = match &self.normals {
            Some(values) => {
                let rings = self.topology.rings();
                match values {
                    NeighbourNormals::Single(values) => {
                        rings.load_values(values, block, corners, closed, normals);
                        normals[..corners + 1].iter_mut().for_each(|normal| *normal = lengthened(*normal));
                    }
                    NeighbourNormals::Double(values) => rings.load_values(values, block, corners, closed, normals),
                }
                &normals[..corners + 1]
            }
            None => &[],
        };
        self.topology.rings().load_edges(self.points, block, corners, closed, edges);
        let mut extent = V::zero();
        for edge in edges.iter() {
            extent = edge.largest_component().max(extent);
        }
        let scale = extent.unit_scale();
        scale_edges(edges, squared, scale);
        let ring = Ring { edges, squared, closed, faces: Triangles, normals };
        Loaded { ring, scale, faces: &mut faces[..corners], scratch }
    }

    /// Fills `faces` in the ring's units, the lanes beyond `block` with copies of its first.
    #[inline(always)]
    fn load_faces<V: Vector>(
        &self,
        frames: &Frames<'_, S>,
        centroids: bool,
        block: &[u32],
        scale: V,
        faces: &mut [Polygon<V>],
    ) {
        let scales = scale.to_lanes();
        for (corner, face) in faces.iter_mut().enumerate() {
            let lane = |lane: usize| {
                let vertex = *block.get(lane).unwrap_or(&block[0]) as usize;
                let index = frames.face_of(self.topology.rings().ring_range(vertex).start + corner);
                self.load_face(frames, centroids, index, vertex, 1.0, scales[lane].into())
            };
            *face = Polygon::from_lanes(lane);
        }
    }

    /// A face as a vertex sees it, in units of `scale` to a length of the mesh times `factor`.
    #[inline(always)]
    fn load_face(
        &self,
        frames: &Frames<'_, S>,
        centroids: bool,
        face: usize,
        vertex: usize,
        factor: f64,
        scale: f64,
    ) -> Polygon<f64> {
        let frame = frames.get(face);
        // A face may be larger than the ring by any amount, but its square must stay in range.
        const LARGEST: f64 = (1u128 << 100) as f64;
        let size = (frame.size * factor * scale).min(LARGEST);
        let mut centroid = DVec3::ZERO;
        if centroids {
            let point = |vertex: usize| self.points.get(vertex) * factor;
            let offset = frame.centroid * factor + (point(frames.first_corner(face) as usize) - point(vertex));
            centroid = offset * scale;
        }
        Polygon {
            normal: frame.normal.into(),
            area: size * size,
            centroid: centroid.into(),
            share: frame.share,
            bend: frame.bend,
            mean_normal: frame.mean_normal.into(),
            may_turn: if frame.may_turn { 1.0 } else { 0.0 },
        }
    }

    /// The vertex-by-vertex path.
    #[inline(never)]
    fn alone(&self, calls: &dyn AloneCalls, vertex: usize, rows: &mut LaneRows<f64>) {
        if self.topology.edges_alone(vertex) <= LANE_EDGES {
            self.alone_in(calls, vertex, rows.rows());
        } else {
            self.alone_in(calls, vertex, self.large.lock().unwrap_or_else(PoisonError::into_inner).rows());
        }
    }

    fn alone_in(&self, calls: &dyn AloneCalls, vertex: usize, rows: Rows<'_, f64>) {
        let Rows { edges, squared, normals, faces, mut scratch } = rows;
        // Positions so far apart that their difference overflows are brought closer first; the factor is exact
        // for them.
        let mut factor = 1.0;
        let (mut count, mut extent) = self.load_alone(vertex, factor, edges);
        if extent == f64::INFINITY {
            factor = 0.25;
            (count, extent) = self.load_alone(vertex, factor, edges);
        }
        let (edges, squared) = (&mut edges[..count], &mut squared[..count]);
        let scale = extent.unit_scale();
        scale_edges(edges, squared, scale);
        let normals: &[_] = match &self.normals {
            Some(values) => {
                self.load_normals_alone(vertex, values, normals);
                &normals[..count]
            }
            None => &[],
        };
        if let Some(frames) = &self.frames {
            let mut corners = 0;
            let ring_start = self.topology.rings().ring_range(vertex).start;
            for fan in self.topology.fans(vertex) {
                for corner in 0..fan.corner_count {
                    let face = frames.face_of(ring_start + fan.start + corner);
                    faces[corners] = self.load_face(frames, calls.centroids(), face, vertex, factor, scale);
                    corners += 1;
                }
            }
            let fans =
                VertexFans::new(self.topology, vertex, edges, squared, PolygonFaces(&faces[..corners]), normals);
            calls.alone_polygons(vertex, &fans, scale * factor, &mut scratch);
        } else {
            let fans = VertexFans::new(self.topology, vertex, edges, squared, Triangles, normals);
            calls.alone_triangles(vertex, &fans, scale * factor, &mut scratch);
        }
    }

    /// Fills `normals` with those of the neighbours, in the order of [`Sweep::load_alone`].
    fn load_normals_alone(&self, vertex: usize, values: &NeighbourNormals<'_>, normals: &mut [Vector3<f64>]) {
        let mut count = 0;
        for fan in self.topology.fans(vertex) {
            let around = fan.neighbours.iter().chain(fan.neighbours.first().filter(|_| fan.closed));
            for &neighbour in around {
                normals[count] = match values {
                    NeighbourNormals::Single(values) => lengthened(values.get(neighbour as usize).into()),
                    NeighbourNormals::Double(values) => values.get(neighbour as usize).into(),
                };
                count += 1;
            }
        }
    }

    /// Fills `edges` fan after fan, in a closed one the first again at the end; answers with their number and extent.
    fn load_alone(&self, vertex: usize, factor: f64, edges: &mut [Vector3<f64>]) -> (usize, f64) {
        let mut count = 0;
        for fan in self.topology.fans(vertex) {
            let first = count;
            for edge in Rings::edges_of(self.points, vertex, fan.neighbours, factor) {
                edges[count] = edge;
                count += 1;
            }
            if fan.closed {
                edges[count] = edges[first];
                count += 1;
            }
        }
        (count, edges[..count].iter().fold(0.0, |extent, edge| edge.largest_component().max(extent)))
    }
}

/// A normal from single precision at length 1, to the precision of the lanes; single precision leaves it as it is.
#[inline(always)]
pub(crate) fn lengthened<V: Vector>(normal: Vector3<V>) -> Vector3<V> {
    if V::Scalar::SINGLE {
        return normal;
    }
    normal * normal.squared().sqrt().reciprocal_or_zero()
}

#[inline(always)]
fn scale_edges<V: Vector>(edges: &mut [Vector3<V>], squared: &mut [V], scale: V) {
    for (edge, squared) in edges.iter_mut().zip(squared) {
        *edge = *edge * scale;
        *squared = edge.squared();
    }
}
