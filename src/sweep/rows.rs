//! The rows that a ring is loaded into, reused from vertex to vertex.

use super::ring::{Polygon, Scratch};
use crate::error::{Error, filled};
use crate::simd::{Vector, Vector3};
use crate::view::MAX_LANE_CORNERS;

/// The most edges of a ring that is computed in lanes; in a closed one the first counts twice.
pub(super) const LANE_EDGES: usize = MAX_LANE_CORNERS + 1;

/// Rows for the rings that are computed in lanes, and for others as small; they live on a thread's stack.
pub(super) struct LaneRows<V> {
    edges: [Vector3<V>; LANE_EDGES],
    squared: [V; LANE_EDGES],
    normals: [Vector3<V>; LANE_EDGES],
    faces: [Polygon<V>; LANE_EDGES],
    planes: [[V; 4]; LANE_EDGES],
    vectors: [Vector3<V>; LANE_EDGES + 1],
    numbers: [[V; LANE_EDGES + 1]; 3],
    normal: Vector3<V>,
}

/// Rows for rings of any size, in `f64`.
pub(super) struct LargeRows {
    edges: Vec<Vector3<f64>>,
    squared: Vec<f64>,
    normals: Vec<Vector3<f64>>,
    faces: Vec<Polygon<f64>>,
    vectors: Vec<Vector3<f64>>,
    numbers: [Vec<f64>; 3],
    normal: Vector3<f64>,
}

/// Either, as it is used.
pub(super) struct Rows<'a, V> {
    /// Edges.
    pub edges: &'a mut [Vector3<V>],
    /// Their squared lengths.
    pub squared: &'a mut [V],
    /// The normals of the neighbours, where an estimator asks for them.
    pub normals: &'a mut [Vector3<V>],
    /// Faces, where they are not triangles.
    pub faces: &'a mut [Polygon<V>],
    /// Or their planes.
    pub planes: &'a mut [[V; 4]],
    /// For the estimator.
    pub scratch: Scratch<'a, V>,
}

fn no_face<V: Vector>() -> Polygon<V> {
    Polygon {
        normal: Vector3::zero(),
        area: V::zero(),
        centroid: Vector3::zero(),
        share: V::zero(),
        bend: V::zero(),
        mean_normal: Vector3::zero(),
        may_turn: V::zero(),
    }
}

impl<V: Vector> LaneRows<V> {
    #[inline(always)]
    pub fn new() -> Self {
        LaneRows {
            edges: [Vector3::zero(); LANE_EDGES],
            squared: [V::zero(); LANE_EDGES],
            normals: [Vector3::zero(); LANE_EDGES],
            faces: [no_face(); LANE_EDGES],
            planes: [[V::zero(); 4]; LANE_EDGES],
            vectors: [Vector3::zero(); LANE_EDGES + 1],
            numbers: [[V::zero(); LANE_EDGES + 1]; 3],
            normal: Vector3::zero(),
        }
    }

    #[inline(always)]
    pub fn rows(&mut self) -> Rows<'_, V> {
        // Not by `map`, which is not inlined everywhere.
        let [a, b, c] = &mut self.numbers;
        Rows {
            edges: &mut self.edges,
            squared: &mut self.squared,
            normals: &mut self.normals,
            faces: &mut self.faces,
            planes: &mut self.planes,
            scratch: Scratch { normal: &mut self.normal, vectors: &mut self.vectors, numbers: [a, b, c] },
        }
    }
}

impl LargeRows {
    /// Room for so many edges; none for as few as lanes have.
    pub fn new(edges: usize) -> Result<Self, Error> {
        let (edges, scratch) = if edges <= LANE_EDGES { (0, 0) } else { (edges, edges + 1) };
        let numbers = || filled(scratch, 0.0);
        Ok(LargeRows {
            edges: filled(edges, Vector3::zero())?,
            squared: filled(edges, 0.0)?,
            normals: filled(edges, Vector3::zero())?,
            faces: filled(edges, no_face())?,
            vectors: filled(scratch, Vector3::zero())?,
            numbers: [numbers()?, numbers()?, numbers()?],
            normal: Vector3::zero(),
        })
    }

    pub fn rows(&mut self) -> Rows<'_, f64> {
        let [a, b, c] = &mut self.numbers;
        Rows {
            edges: &mut self.edges,
            squared: &mut self.squared,
            normals: &mut self.normals,
            faces: &mut self.faces,
            planes: &mut [],
            scratch: Scratch { normal: &mut self.normal, vectors: &mut self.vectors, numbers: [a, b, c] },
        }
    }
}
