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
//! | polygons, `f32` in and out, if planes are enough | `f32` lanes | `f64` lanes, then alone |
//! | polygons otherwise | `f64` lanes | alone |
//! | several fans, large fans | alone, in `f64` | |
//!
//! Which way a vertex goes depends on its own ring and nothing else.

mod calls;
mod check;
mod frames;
mod load;
mod patch;
mod patch_sweep;
mod planes;
mod ring;
mod rows;

pub(crate) use check::check_counts;
pub(crate) use frames::{CANCELLED, area_vector};
pub(crate) use load::lengthened;
pub(crate) use patch::{Counts, MOST_EXTRA_RINGS, MOST_RINGS, Patch, PatchQuantity};
pub(crate) use patch_sweep::sweep_patches;
pub(crate) use ring::{Corner, Face, Ring, RingFaces, Scratch, VertexFans};

use crate::error::Error;
use crate::parallel::{Claims, Run, for_each_chunk, thread_count};
use crate::simd::{Task, Vector, Width};
use crate::topology::Topology;
use crate::view::{Batch, Coordinate, Group, Kept, PointArray, Points, RingClass, StridedPoints, WINDOW};
use calls::{BlockCalls, Both, Calls, LoadedFaces};
use check::{check_points, corners_met};
use frames::{Asked, Frames};
use load::{Loaded, Needed, NeighbourNormals};
use planes::{LargeFace, Nearby, Planes, large_faces};
use rows::{LaneRows, LargeRows};
use std::sync::Mutex;

/// An estimator over one-rings, and where its results go.
pub(crate) trait Quantity: Sync {
    /// Whether it is ever computed in single precision.
    const SINGLE: bool = true;
    /// What it needs of the faces of a mesh that has others than triangles.
    const FACES: FaceNeeds = FaceNeeds::Frames;
    /// Whether it looks at edges in such a mesh.
    const EDGES: bool = true;
    /// Whether results depend on the units of a ring.
    const UNITS: bool = true;
    /// Whether four edges around a vertex mostly leave too much in doubt in single precision.
    const DOUBTS_FOUR: bool = false;
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

/// What an estimator needs to know of faces that are not triangles, from less to more.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum FaceNeeds {
    /// Nothing.
    Unused,
    /// Normals and areas.
    Planes,
    /// All that a [`Face`] tells; in double precision.
    Frames,
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
    let many = room.is_none() && run.vertices.is_none_or(|vertices| corners_met(topology, vertices).is_none());
    let all_frames = many && calls.frames();
    let large_faces = match topology.polygons() {
        Some(polygons) if many && calls.planes() => large_faces(points, polygons)?,
        _ => Vec::new(),
    };
    let frames = match topology.polygons() {
        Some(polygons) => {
            let normals = calls.neighbour_normals();
            let asked = Asked { centroids: calls.centroids(), bends: calls.flat_angles(), normals };
            Some(Frames::new(points, polygons, asked, !all_frames, run.threads)?)
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
    let mut nearby = (Vec::new(), Vec::new());
    if topology.polygons().is_some() && calls.planes() && vertices.is_none() {
        for _ in 0..thread_count(run.threads, chunks) {
            if double || !calls.has_single() || calls.frames() {
                nearby.1.try_reserve(1)?;
                nearby.1.push(Nearby::new()?);
            } else {
                nearby.0.try_reserve(1)?;
                nearby.0.push(Nearby::new()?);
            }
        }
    }
    let (single_planes, double_planes) = (Mutex::new(nearby.0), Mutex::new(nearby.1));
    let sweep = Sweep {
        topology,
        points,
        frames,
        large_faces,
        single_planes,
        double_planes,
        normals,
        vertices,
        double,
        large,
    };
    for_each_chunk(run, chunks, |claims| calls.work(level, Part { sweep: any(&sweep), claims }))
}

struct Sweep<'a, S> {
    topology: &'a Topology,
    points: &'a StridedPoints<'a, S>,
    frames: Option<Frames<'a, S>>,
    large_faces: Vec<LargeFace>,
    /// One for each thread, if vertices are computed in single precision and look at planes.
    single_planes: Mutex<Vec<Nearby<f32>>>,
    /// One for each thread, if all are computed in double precision and look at planes.
    double_planes: Mutex<Vec<Nearby<f64>>>,
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
        let polygons = sweep.topology.polygons();
        let planes = polygons.filter(|_| calls.planes()).map(|polygons| Planes {
            points: sweep.points,
            polygons,
            large: &sweep.large_faces,
        });
        let frames = sweep.frames.as_ref().filter(|_| calls.frames());
        let single = !sweep.double && frames.is_none() && calls.has_single();
        let mut single_planes = Nearby::take(&sweep.single_planes);
        let mut double_planes = Nearby::take(&sweep.double_planes);
        let needed = Needed { edges: polygons.is_none() || calls.needs_edges(), units: calls.units(), planes };
        let mut single_rows = LaneRows::<W::Single>::new();
        let mut double_rows = LaneRows::<W::Double>::new();
        let mut alone_rows = LaneRows::<f64>::new();
        let mut batch = Batch::new(sweep.topology.rings());
        let mut doubtful = Kept::new();
        while let Some(chunk) = claims.next() {
            match sweep.vertices {
                None => {
                    batch.fill_window(chunk);
                    if let Some(planes) = planes {
                        let entries = || sweep.topology.rings().window_entries(chunk);
                        single_planes.fill::<_, W::Single>(planes, entries());
                        double_planes.fill::<_, W::Double>(planes, entries());
                    }
                }
                Some(list) => {
                    let list = &list[chunk * WINDOW..];
                    batch.fill_list(&list[..list.len().min(WINDOW)]);
                }
            }
            for index in 0..batch.len() {
                let group = match batch.get(index) {
                    Group::Isolated(vertices) => {
                        vertices.iter().for_each(|&vertex| calls.isolated(vertex as usize));
                        continue;
                    }
                    Group::Alone(vertices) => {
                        vertices.iter().for_each(|&vertex| sweep.alone(calls, vertex as usize, &mut alone_rows));
                        continue;
                    }
                    Group::Lanes(group) => group,
                };
                let mut remaining = group;
                let four = polygons.is_some() && group.closed() && group.corners() == 4;
                if single && !(four && calls.doubts_four()) {
                    doubtful.start(group);
                    let mut blocks = group.chunks(W::Single::LANES).peekable();
                    while let Some(block) = blocks.next() {
                        sweep.prefetch(blocks.peek());
                        let Loaded { ring, scale, planes, mut scratch, .. } =
                            sweep.load(&block, &needed, &single_planes, &mut single_rows);
                        let faces = LoadedFaces { planes, frames: None };
                        doubtful.keep(block, calls.single(block.vertices(), &ring, faces, &scale, &mut scratch));
                    }
                    remaining = doubtful.block();
                }
                let mut blocks = remaining.chunks(W::Double::LANES).peekable();
                while let Some(block) = blocks.next() {
                    sweep.prefetch(blocks.peek());
                    let vertices = block.vertices();
                    let Loaded { ring, scale, faces, planes, mut scratch } =
                        sweep.load(&block, &needed, &double_planes, &mut double_rows);
                    if let Some(frames) = frames {
                        sweep.load_faces(frames, calls.centroids(), vertices, scale, faces);
                    }
                    let faces = LoadedFaces { planes, frames: frames.map(|_| &*faces) };
                    let bits = calls.double(vertices, &ring, faces, &scale, &mut scratch);
                    if bits != 0 {
                        for (lane, &vertex) in vertices.iter().enumerate() {
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
