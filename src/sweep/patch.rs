//! Neighbourhoods of several rings as an estimator sees them, a vertex a lane, and what an estimator on them is. `patch_sweep.rs` has
//! the loop.

use crate::simd::{Vector, Vector3};
use crate::topology::{MAX_RINGS, Neighbourhood};

/// A neighbourhood is widened by no more rings than this.
pub(crate) const MOST_EXTRA_RINGS: usize = 4;

/// An estimator may ask for no more rings than this.
pub(crate) const MOST_RINGS: usize = MAX_RINGS - MOST_EXTRA_RINGS;

/// How many neighbours a vertex has within 1, 2 and 3 rings, and in all; those not counted that the estimator left out.
pub(crate) type Counts = [u32; 4];

/// An estimator on neighbourhoods, and where its results go.
pub(crate) trait PatchQuantity: Sync {
    /// Whether it asks for [`Patch::neighbour_normal`].
    const NEIGHBOUR_NORMALS: bool = false;

    /// How often lanes are tried before a vertex goes on alone.
    const ATTEMPTS: usize = 1;

    /// How many rings it wants, at most [`MOST_RINGS`].
    fn rings(&self) -> usize;

    /// The fewest neighbours it can work with: a smaller neighbourhood is widened.
    fn least(&self) -> usize;

    /// How many rows of numbers it wants as scratch for a patch of `points` points; this must not fall where `points` grows.
    fn scratch(&self, points: usize) -> usize;

    /// Normals by vertex; of the vertices that are computed, and of their neighbours if it asks for those.
    fn normals(&self) -> &[[f64; 3]];

    /// A number by vertex, for [`Patch::neighbour_value`], if it asks for that.
    fn values(&self) -> Option<&[f64]> {
        None
    }

    /// Fills `chosen` with the neighbours that count, ring after ring.
    #[inline(always)]
    fn choose<V: Vector<Scalar = f64>, Z: Vector<Scalar = f32>>(
        &self,
        _vertex: u32,
        found: &Neighbourhood,
        chosen: &mut [u32],
    ) -> Counts {
        let vertices = found.vertices();
        chosen[..vertices.len()].copy_from_slice(vertices);
        found.counts_within()
    }

    /// Computes and writes the vertices of a block; answers with a bit for each lane that it did not write, because its
    /// result cannot be trusted.
    ///
    /// `scale` is how many of the patch's units a unit of the mesh is, and `widened` has a bit for each lane with more rings
    /// than were asked for. Lanes beyond `vertices` hold no points. `attempt` counts from 0 to [`PatchQuantity::ATTEMPTS`].
    fn block<V: Vector<Scalar = f64>>(
        &self,
        vertices: &[u32],
        patch: &Patch<'_, V>,
        scale: V,
        widened: u32,
        attempt: usize,
        scratch: &mut [V],
    ) -> u32;

    /// Computes one vertex and writes it if the result can be trusted; if not, answers with `false`, and is called again with
    /// a wider neighbourhood. `last` says that there is none: then it must write something.
    fn alone(
        &self,
        vertex: usize,
        patch: &Patch<'_, f64>,
        scale: f64,
        widened: bool,
        last: bool,
        scratch: &mut [f64],
    ) -> bool;

    /// Writes a vertex that has no face.
    fn isolated(&self, vertex: usize);
}

/// The neighbourhoods of a row of vertices: what an estimator sees.
pub(crate) struct Patch<'a, V> {
    /// Three numbers a point.
    pub(super) points: &'a [V],
    /// Likewise, if they were asked for.
    pub(super) normals: &'a [V],
    /// A number a point, likewise.
    pub(super) values: &'a [V],
    /// The normal at the vertex itself; zero where there is none.
    pub normal: Vector3<V>,
    /// How many points each lane has.
    pub count: V,
    /// Every lane has at least so many points.
    pub full: usize,
    /// How many of them are within one ring, two and three.
    pub(super) within: [V; 3],
    /// The most that a lane has there.
    pub(super) most_within: [usize; 3],
    /// How many points there are up to each ring, of a vertex alone.
    pub(super) rings: &'a [usize],
}

impl<'a, V: Vector<Scalar = f64>> Patch<'a, V> {
    /// A patch of one vertex, or of as many with the same number of points.
    #[cfg(test)]
    pub(crate) fn of_points(points: &'a [V], normal: Vector3<V>) -> Self {
        let count = points.len() / 3;
        Patch {
            points,
            normals: &[],
            values: &[],
            normal,
            count: V::constant(count as f64),
            full: count,
            within: [V::constant(count as f64); 3],
            most_within: [count; 3],
            rings: &[],
        }
    }

    /// The largest number of points of a lane; the vertex itself, which is at the origin, is not among them.
    #[inline(always)]
    pub fn len(&self) -> usize {
        self.points.len() / 3
    }

    /// A point, relative to the vertex; at the vertex in lanes that have fewer.
    #[inline(always)]
    pub fn point(&self, index: usize) -> Vector3<V> {
        row(self.points, index)
    }

    /// The normal at a point, as it was handed in; zero in lanes that have fewer points.
    #[inline(always)]
    pub fn neighbour_normal(&self, index: usize) -> Vector3<V> {
        row(self.normals, index)
    }

    /// The fewest rings that have so many points, or all there are; of a vertex alone.
    pub fn with_at_least(&self, points: usize) -> Self {
        let count = self.rings.iter().copied().find(|&count| count >= points).unwrap_or(self.len());
        let normals = if self.normals.is_empty() { self.normals } else { &self.normals[..3 * count] };
        Patch { points: &self.points[..3 * count], normals, count: V::constant(count as f64), full: count, ..*self }
    }

    /// The number at a point, if there are any; zero in lanes that have fewer points.
    #[inline(always)]
    pub fn neighbour_value(&self, index: usize) -> Option<V> {
        self.values.get(index).copied()
    }

    /// The most points that a lane has within so many rings, 1 to 3.
    #[inline(always)]
    pub fn len_within(&self, rings: usize) -> usize {
        self.most_within[rings - 1]
    }

    /// How many points each lane has within so many rings, 1 to 3.
    #[inline(always)]
    pub fn count_within(&self, rings: usize) -> V {
        self.within[rings - 1]
    }

    /// 1 in the lanes that have the point within so many rings, 1 to 3, and 0 in the others.
    #[inline(always)]
    pub fn weight_within(&self, rings: usize, index: usize) -> V {
        V::select(V::constant(index as f64).lt(self.within[rings - 1]), V::one(), V::zero())
    }

    /// 1 in the lanes that have the point, 0 in the others.
    #[inline(always)]
    pub fn weight(&self, index: usize) -> V {
        V::select(V::constant(index as f64).lt(self.count), V::one(), V::zero())
    }
}

#[inline(always)]
fn row<V: Vector>(rows: &[V], index: usize) -> Vector3<V> {
    let [x, y, z] = rows[3 * index..3 * index + 3] else { unreachable!("three numbers a point") };
    Vector3 { x, y, z }
}
