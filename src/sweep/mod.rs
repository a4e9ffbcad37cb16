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
mod check;
mod frames;
mod load;
mod patch;
mod patch_sweep;
mod ring;
mod rows;

pub(crate) use check::check_counts;
pub(crate) use frames::{CANCELLED, area_vector};
pub(crate) use load::lengthened;
pub(crate) use patch::{Counts, MOST_EXTRA_RINGS, MOST_RINGS, Patch, PatchQuantity};
pub(crate) use patch_sweep::sweep_patches;
pub(crate) use ring::{Corner, Face, Ring, RingFaces, Scratch, VertexFans};

use crate::error::Error;
use crate::parallel::{Claims, Run, for_each_chunk};
use crate::simd::{Task, Vector, Width};
use crate::topology::Topology;
use crate::view::{Batch, Coordinate, PointArray, Points, RingClass, StridedPoints, WINDOW};
use calls::{BlockCalls, Both, Calls};
use check::{check_points, corners_met};
use frames::{Asked, Frames};
use load::{Loaded, NeighbourNormals};
use ring::PolygonFaces;
use rows::{LaneRows, LargeRows};
use std::sync::Mutex;

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
    sweep_calls(topology, points, run, double, quantity, None)
}

/// Memory for sweeps that may not fail for lack of it, because results have been written already.
pub(crate) struct Room(Mutex<LargeRows>);

impl Room {
    /// For any of these vertices.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub(crate) fn new(topology: &Topology, vertices: impl Iterator<Item = usize>) -> Result<Self, Error> {
        Ok(Room(Mutex::new(LargeRows::new(most_edges_alone(topology, vertices))?)))
    }
}

/// The most edges that one of these vertices has on the vertex-by-vertex path; 0 if all have as few as lanes.
fn most_edges_alone(topology: &Topology, vertices: impl Iterator<Item = usize>) -> usize {
    let alone = |vertex: &usize| matches!(topology.rings().class(*vertex), RingClass::Alone);
    vertices.filter(alone).map(|vertex| topology.edges_alone(vertex)).max().unwrap_or(0)
}

/// As [`sweep`] for a list of vertices that `room` was made for, but without asking for memory.
///
/// # Errors
/// As [`sweep`], without [`Error::OutOfMemory`].
pub(crate) fn sweep_in<Q: Quantity>(
    room: &Room,
    topology: &Topology,
    points: &Points<'_>,
    run: &mut Run<'_>,
    quantity: &Q,
) -> Result<(), Error> {
    sweep_calls(topology, points, run, true, quantity, Some(room))
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
    sweep_calls(topology, points, run, double, &Both { first: normals, second: quantity }, None)
}

fn sweep_calls(
    topology: &Topology,
    points: &Points<'_>,
    run: &mut Run<'_>,
    double: bool,
    calls: &dyn Calls,
    room: Option<&Room>,
) -> Result<(), Error> {
    check_points(topology, points, run.vertices)?;
    match points.array() {
        PointArray::F32(points) => {
            sweep_points(topology, points, run, double, calls, room, |sweep| AnySweep::Single(sweep))
        }
        PointArray::F64(points) => {
            sweep_points(topology, points, run, true, calls, room, |sweep| AnySweep::Double(sweep))
        }
    }
}

fn sweep_points<S: Coordinate>(
    topology: &Topology,
    points: &StridedPoints<'_, S>,
    run: &mut Run<'_>,
    double: bool,
    calls: &dyn Calls,
    room: Option<&Room>,
    any: impl for<'a> Fn(&'a Sweep<'a, S>) -> AnySweep<'a> + Sync,
) -> Result<(), Error> {
    // Without memory for all of them, polygons are computed where they are met.
    let few = room.is_some() || run.vertices.is_some_and(|vertices| corners_met(topology, vertices).is_some());
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
    let own;
    let large = match room {
        Some(room) => &room.0,
        None => {
            own = Mutex::new(LargeRows::new(match vertices {
                None => topology.largest_alone(),
                Some(vertices) => most_edges_alone(topology, vertices.iter().map(|&vertex| vertex as usize)),
            })?);
            &own
        }
    };
    let sweep = Sweep { topology, points, frames, normals, vertices, double, large };
    for_each_chunk(run, chunks, |claims| calls.work(level, Part { sweep: any(&sweep), claims }))
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
