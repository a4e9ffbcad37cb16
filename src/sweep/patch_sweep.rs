//! The loop over vertices for estimators on neighbourhoods of several rings.
//!
//! Lanes are vertices, as in the sweep over one-rings, and always `f64`. Vertices are gathered in groups of [`GROUP`] and
//! sorted by the size of their neighbourhoods, so that the lanes of a block are nearly of one length. A lane with fewer
//! points than the others is filled up with points at the vertex itself that count with weight 0: they add exact zeros to
//! every sum, so a result does not depend on which vertices share a block.
//!
//! Points are differences from the vertex, multiplied by a power of two a lane that brings the largest component to between
//! 1 and 4, as in [`Ring`](super::Ring).
//!
//! A neighbourhood of fewer vertices than the estimator wants is widened ring by ring. A vertex that an estimator does not
//! trust in lanes goes on alone, through the same formulas with one lane, with ever wider neighbourhoods. Widening ends after
//! [`MOST_EXTRA_RINGS`] rings, at the bounds of [`Neighbourhood`], and where nothing is left to add.

use super::check_counts;
use super::patch::{Counts, MOST_EXTRA_RINGS, MOST_RINGS, Patch, PatchQuantity};
use crate::error::Error;
use crate::parallel::{Claims, Run, for_each_chunk, thread_count};
use crate::simd::{MAX_LANES, Task, Vector, Vector3, Width, as_lanes, dispatch, each};
use crate::topology::{FirstRings, MAX_NEIGHBOURS, MAX_RINGS, Neighbourhood, Topology};
use crate::view::{Coordinate, PointArray, Points, StridedPoints, zeroed};
use std::sync::{Mutex, PoisonError};

/// Vertices that are gathered and sorted together; also a chunk of work.
const GROUP: usize = 256;

/// The most lanes of `f64`.
const DOUBLE_LANES: usize = 8;

/// Computes `quantity` at every vertex that `run` asks for.
///
/// # Errors
/// [`Error::Size`] and [`Error::IndexOutOfRange`] as in [`sweep`](super::sweep); [`Error::NonFinitePosition`], with a list of
/// vertices only for positions in the neighbourhoods of these; [`Error::Cancelled`]; [`Error::OutOfMemory`].
pub(crate) fn sweep_patches<Q: PatchQuantity>(
    topology: &Topology,
    points: &Points<'_>,
    run: &mut Run<'_>,
    quantity: &Q,
) -> Result<(), Error> {
    check_points(topology, points, run.vertices, quantity.rings())?;
    match points.array() {
        PointArray::F32(points) => sweep_points(topology, points, run, quantity),
        PointArray::F64(points) => sweep_points(topology, points, run, quantity),
    }
}

/// As the function of this name beside it, for neighbourhoods.
fn check_points(
    topology: &Topology,
    points: &Points<'_>,
    vertices: Option<&[u32]>,
    rings: usize,
) -> Result<(), Error> {
    check_counts(topology, points, vertices)?;
    let Some(vertices) = vertices else {
        return points.check_finite();
    };
    // For a long list it is cheaper to look at all positions; only if that finds one is the list gone through.
    if vertices.len() > topology.vertex_count() / 64 && points.check_finite().is_ok() {
        return Ok(());
    }
    let mut neighbourhood = Neighbourhood::new(topology)?;
    for &vertex in vertices {
        for &needed in [vertex].iter().chain(neighbourhood.gather(topology, vertex, rings)) {
            if !points.get(needed as usize).is_finite() {
                return Err(Error::NonFinitePosition { vertex: needed as u64 });
            }
        }
    }
    Ok(())
}

fn sweep_points<Q: PatchQuantity, S: Coordinate>(
    topology: &Topology,
    points: &StridedPoints<'_, S>,
    run: &mut Run<'_>,
    quantity: &Q,
) -> Result<(), Error> {
    assert!(quantity.rings() <= MOST_RINGS && quantity.normals().len() == topology.vertex_count());
    let (vertices, level) = (run.vertices, run.level);
    let chunks = vertices.map_or(topology.vertex_count(), <[u32]>::len).div_ceil(GROUP);
    // All memory is there before the first result is written. What is not used of it is never touched.
    let first_rings = if vertices.is_none() { FirstRings::new(topology)? } else { None };
    let mut spaces = Vec::new();
    for _ in 0..thread_count(run.threads, chunks) {
        spaces.try_reserve(1)?;
        spaces.push(Space::new(topology, quantity, first_rings.as_ref())?);
    }
    let spaces = Mutex::new(spaces);
    let sweep = PatchSweep { topology, points, vertices, quantity };
    for_each_chunk(run, chunks, |claims| {
        // If there is none left, there are as many threads as were counted on without this one.
        let space = spaces.lock().unwrap_or_else(PoisonError::into_inner).pop();
        if let Some(space) = space {
            dispatch(level, Worker { sweep: &sweep, claims, space });
        }
    })
}

/// One thread's memory.
struct Space<'r> {
    /// Points, normals and scratch of a block.
    numbers: Vec<f64>,
    /// The neighbourhoods of a group.
    neighbours: Vec<u32>,
    /// Those of a block, a vertex a lane.
    rows: Vec<[u32; MAX_LANES]>,
    neighbourhood: Neighbourhood<'r>,
}

impl<'r> Space<'r> {
    fn new<Q: PatchQuantity>(
        topology: &Topology,
        quantity: &Q,
        first_rings: Option<&'r FirstRings>,
    ) -> Result<Self, Error> {
        let coordinates = if Q::NEIGHBOUR_NORMALS { 6 } else { 3 } + quantity.values().is_some() as usize;
        // One row more, since the first may not start where a vector can.
        let rows = coordinates * MAX_NEIGHBOURS + quantity.scratch(MAX_NEIGHBOURS) + 1;
        Ok(Space {
            numbers: zeroed(rows * DOUBLE_LANES)?,
            neighbours: zeroed(GROUP * MAX_NEIGHBOURS)?,
            rows: zeroed(MAX_NEIGHBOURS)?,
            neighbourhood: Neighbourhood::with_first_rings(topology, first_rings)?,
        })
    }
}

struct PatchSweep<'a, Q, S> {
    topology: &'a Topology,
    points: &'a StridedPoints<'a, S>,
    vertices: Option<&'a [u32]>,
    quantity: &'a Q,
}

/// One thread's part of a sweep.
struct Worker<'a, 'c, 'p, 's, Q, S> {
    sweep: &'a PatchSweep<'a, Q, S>,
    claims: &'c mut Claims<'s, 'p>,
    space: Space<'a>,
}

/// A vertex of a group, and where its neighbourhood stands.
#[derive(Clone, Copy)]
struct Member {
    vertex: u32,
    start: u32,
    counts: Counts,
    widened: bool,
}

impl Member {
    fn count(&self) -> usize {
        self.counts[3] as usize
    }
}

impl<Q: PatchQuantity, S: Coordinate> Task for Worker<'_, '_, '_, '_, Q, S> {
    #[inline(always)]
    fn run<W: Width>(self) {
        let Worker { sweep, claims, mut space } = self;
        let mut group = [Member { vertex: 0, start: 0, counts: [0; 4], widened: false }; GROUP];
        while let Some(chunk) = claims.next() {
            let first = chunk * GROUP;
            let length =
                sweep.vertices.map_or(sweep.topology.vertex_count(), <[u32]>::len).min(first + GROUP) - first;
            let mut count = 0;
            let mut end = 0;
            for index in first..first + length {
                let vertex = sweep.vertices.map_or(index as u32, |vertices| vertices[index]);
                if sweep.topology.ring(vertex as usize).is_empty() {
                    sweep.quantity.isolated(vertex as usize);
                    continue;
                }
                let widened = sweep.gather(vertex, &mut space.neighbourhood);
                let chosen = &mut space.neighbours[end..];
                let counts = sweep.quantity.choose::<W::Double, W::Single>(vertex, &space.neighbourhood, chosen);
                group[count] = Member { vertex, start: end as u32, counts, widened };
                (count, end) = (count + 1, end + group[count].count());
            }
            let mut sorted = by_count(&group[..count]);
            for attempt in 0..Q::ATTEMPTS {
                // Those that are left over move to the front, and stay sorted.
                let mut left = 0;
                for first in (0..count).step_by(W::Double::LANES) {
                    let block: [u8; MAX_LANES] = each(0, |lane| *sorted.get(first + lane).unwrap_or(&0));
                    let block = &block[..W::Double::LANES.min(count - first)];
                    let bits = sweep.block::<W, W::Double>(&group, block, attempt, &mut space);
                    for (lane, &member) in block.iter().enumerate() {
                        if bits & 1 << lane != 0 {
                            sorted[left] = member;
                            left += 1;
                        }
                    }
                }
                count = left;
            }
            for &member in &sorted[..count] {
                sweep.alone(group[member as usize].vertex, &mut space);
            }
        }
    }
}

/// A call of [`PatchQuantity::block`].
struct PatchBlock<'a, 'p, Q, V> {
    quantity: &'a Q,
    vertices: &'a [u32],
    patch: &'a Patch<'p, V>,
    scale: V,
    widened: u32,
    attempt: usize,
    scratch: &'a mut [V],
    untrusted: &'a mut u32,
}

impl<Q: PatchQuantity, V: Vector<Scalar = f64>> Task for PatchBlock<'_, '_, Q, V> {
    #[inline(always)]
    fn run<W: Width>(self) {
        let PatchBlock { quantity, vertices, patch, scale, widened, attempt, scratch, untrusted } = self;
        *untrusted = quantity.block(vertices, patch, scale, widened, attempt, scratch);
    }
}

/// The places of a group's members, those with fewer neighbours first.
#[inline(always)]
fn by_count(group: &[Member]) -> [u8; GROUP] {
    let mut starts = [0u16; MAX_NEIGHBOURS + 1];
    for member in group {
        starts[member.count()] += 1;
    }
    let mut place = 0;
    for start in &mut starts {
        place += std::mem::replace(start, place);
    }
    let mut sorted = [0u8; GROUP];
    for (index, member) in group.iter().enumerate() {
        let start = &mut starts[member.count()];
        sorted[*start as usize] = index as u8;
        *start += 1;
    }
    sorted
}

impl<Q: PatchQuantity, S: Coordinate> PatchSweep<'_, Q, S> {
    /// Gathers a vertex's neighbourhood, widened if it is too small; answers whether it was.
    #[inline(always)]
    fn gather(&self, vertex: u32, neighbourhood: &mut Neighbourhood) -> bool {
        let least = self.quantity.least();
        let mut widened = false;
        if neighbourhood.gather(self.topology, vertex, self.quantity.rings()).len() < least {
            while neighbourhood.vertices().len() < least && self.widen(neighbourhood) {
                widened = true;
            }
        }
        widened
    }

    /// Adds a ring, if that may be and adds a vertex. Positions beyond the neighbourhood that was asked for may be none
    /// where only some vertices are computed; they add nothing.
    #[inline(never)]
    fn widen(&self, neighbourhood: &mut Neighbourhood) -> bool {
        if neighbourhood.rings() >= self.quantity.rings() + MOST_EXTRA_RINGS || !neighbourhood.widen(self.topology) {
            return false;
        }
        let finite = |&vertex: &u32| self.points.get(vertex as usize).is_finite();
        if self.vertices.is_some() && !neighbourhood.ring(neighbourhood.rings()).iter().all(finite) {
            neighbourhood.drop_ring();
            return false;
        }
        true
    }

    #[inline(always)]
    fn block<W: Width, V: Vector<Scalar = f64>>(
        &self,
        group: &[Member; GROUP],
        block: &[u8],
        attempt: usize,
        space: &mut Space<'_>,
    ) -> u32 {
        let member = |lane: usize| &group[block[lane] as usize];
        // Sorted by count.
        let (full, length) = (member(0).count(), member(block.len() - 1).count());
        let all_values = self.quantity.values();
        let (points, rest) = as_lanes::<V>(&mut space.numbers).split_at_mut(3 * length);
        let (normals, rest) = rest.split_at_mut(if Q::NEIGHBOUR_NORMALS { 3 * length } else { 0 });
        let (values, scratch) = rest.split_at_mut(if all_values.is_some() { length } else { 0 });
        // Lanes beyond the block have its first vertex, and no points. A point that a lane does not have is the vertex itself.
        let mut vertices = [member(0).vertex; MAX_LANES];
        let mut counts = [[0.0; MAX_LANES]; 4];
        let mut widened = 0;
        let rows = &mut space.rows[..length];
        for lane in 0..V::LANES {
            let mut found = &[][..];
            if lane < block.len() {
                let &Member { vertex, start, counts: own, widened: wide } = member(lane);
                vertices[lane] = vertex;
                widened |= (wide as u32) << lane;
                for (row, count) in counts.iter_mut().zip(own) {
                    row[lane] = count as f64;
                }
                found = &space.neighbours[start as usize..][..own[3] as usize];
            }
            let (there, beyond) = rows.split_at_mut(found.len());
            there.iter_mut().zip(found).for_each(|(row, &neighbour)| row[lane] = neighbour);
            beyond.iter_mut().for_each(|row| row[lane] = vertices[lane]);
        }
        let full = if block.len() == V::LANES { full } else { 0 };
        let [within @ .., count]: [V; 4] = each(V::zero(), |index| V::from_lanes(&counts[index]));
        let most = |ring: usize| counts[ring].iter().fold(0.0f64, |most, &x| most.max(x)) as usize;
        let most_within = [most(0), most(1), most(2)];
        let all_normals = StridedPoints::from(self.quantity.normals());
        let normal = all_normals.lanes::<V>(&vertices);
        let centre = self.points.lanes::<V>(&vertices);
        let mut extent = V::zero();
        for (row, indices) in rows.iter().enumerate() {
            let point = self.points.lanes::<V>(indices) - centre;
            extent = point.largest_component().max(extent);
            (points[3 * row], points[3 * row + 1], points[3 * row + 2]) = (point.x, point.y, point.z);
            // Normals and values are zero where there is no point.
            let there = V::constant(row as f64).lt(count);
            if Q::NEIGHBOUR_NORMALS {
                let normal = all_normals.lanes::<V>(indices);
                for (axis, x) in [normal.x, normal.y, normal.z].into_iter().enumerate() {
                    normals[3 * row + axis] = V::select(there, x, V::zero());
                }
            }
            if let Some(all) = all_values {
                let value = V::from_lanes(&each(0.0, |lane| all[indices[lane] as usize]));
                values[row] = V::select(there, value, V::zero());
            }
        }
        let scale = fit_to_unit(points, extent);
        let patch = Patch { points, normals, values, normal, count, full, within, most_within, rings: &[] };
        // In a function of its own, which positions of either precision share.
        let (quantity, vertices, mut untrusted) = (self.quantity, &vertices[..block.len()], 0);
        W::call(PatchBlock {
            quantity,
            vertices,
            patch: &patch,
            scale,
            widened,
            attempt,
            scratch,
            untrusted: &mut untrusted,
        });
        untrusted
    }

    /// The vertex-by-vertex path.
    #[inline(never)]
    fn alone(&self, vertex: u32, space: &mut Space<'_>) {
        let Space { numbers, neighbourhood, .. } = space;
        let mut widened = self.gather(vertex, neighbourhood);
        loop {
            let last =
                neighbourhood.is_complete() || neighbourhood.rings() >= self.quantity.rings() + MOST_EXTRA_RINGS;
            if self.alone_in(vertex, neighbourhood, widened, last, numbers) || last {
                return;
            }
            // If nothing was added, the neighbourhood is complete and the next attempt the last.
            widened |= self.widen(neighbourhood);
        }
    }

    fn alone_in(
        &self,
        vertex: u32,
        neighbourhood: &Neighbourhood,
        widened: bool,
        last: bool,
        numbers: &mut [f64],
    ) -> bool {
        let mut chosen = [0; MAX_NEIGHBOURS];
        let counts = self.quantity.choose::<f64, f32>(vertex, neighbourhood, &mut chosen);
        let found = &chosen[..counts[3] as usize];
        let all_values = self.quantity.values();
        let (points, rest) = numbers.split_at_mut(3 * found.len());
        let (normals, rest) = rest.split_at_mut(if Q::NEIGHBOUR_NORMALS { 3 * found.len() } else { 0 });
        let (values, scratch) = rest.split_at_mut(if all_values.is_some() { found.len() } else { 0 });
        // Positions so far apart that their difference overflows are brought closer first; the factor is exact for them.
        let mut factor = 1.0;
        self.load_points(vertex, found, factor, points);
        if points.iter().any(|x| x.abs() == f64::INFINITY) {
            factor = 0.25;
            self.load_points(vertex, found, factor, points);
        }
        for (index, &neighbour) in found.iter().enumerate() {
            if Q::NEIGHBOUR_NORMALS {
                normals[3 * index..][..3].copy_from_slice(&self.quantity.normals()[neighbour as usize]);
            }
            if let Some(all) = all_values {
                values[index] = all[neighbour as usize];
            }
        }
        let extent = points.iter().fold(0.0, |extent, x| Vector::max(x.abs(), extent));
        let scale = fit_to_unit(points, extent);
        let [x, y, z] = self.quantity.normals()[vertex as usize];
        let count = found.len();
        let mut rings = [count; MAX_RINGS + 1];
        rings.iter_mut().zip(neighbourhood.counts()).for_each(|(ring, count)| *ring = count);
        let normal = Vector3 { x, y, z };
        let most_within = [counts[0] as usize, counts[1] as usize, counts[2] as usize];
        let within = most_within.map(|count| count as f64);
        let (full, count) = (count, count as f64);
        let patch = Patch { points, normals, values, normal, count, full, within, most_within, rings: &rings };
        self.quantity.alone(vertex as usize, &patch, scale * factor, widened, last, scratch)
    }

    /// Fills `points` with the vectors from a vertex to `found`, each position multiplied by `factor` first.
    fn load_points(&self, vertex: u32, found: &[u32], factor: f64, points: &mut [f64]) {
        let centre = self.points.get(vertex as usize) * factor;
        for (point, &neighbour) in points.chunks_exact_mut(3).zip(found) {
            point.copy_from_slice(&(self.points.get(neighbour as usize) * factor - centre).to_array());
        }
    }
}

/// Multiplies each lane by the power of two that brings its largest component, `extent`, to between 1 and 4; answers with it.
#[inline(always)]
fn fit_to_unit<V: Vector<Scalar = f64>>(points: &mut [V], extent: V) -> V {
    let scale = extent.unit_scale();
    points.iter_mut().for_each(|x| *x = *x * scale);
    scale
}
