//! Rings as an estimator sees them: edges, faces and neighbours' normals of a block of vertices as lanes, or of one vertex with
//! all its fans, in units that bring the longest component to between 1 and 2.

use super::calls::AloneCalls;
use super::frames::Frames;
use super::planes::{Nearby, Planes};
use super::ring::{Polygon, PolygonFaces, Ring, Scratch, Triangles, VertexFans};
use super::rows::{LANE_EDGES, LaneRows, Rows};
use super::{NormalRows, Sweep};
use crate::simd::{Mask, Real, Vector, Vector3};
use crate::view::{Block, Coordinate, Rings, StridedPoints};
use glam::DVec3;
use std::sync::PoisonError;

/// [`NormalRows`] to load from.
pub(super) enum NeighbourNormals<'a> {
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

/// The rings of a block.
pub(super) struct Loaded<'r, V> {
    pub ring: Ring<'r, V, Triangles>,
    /// How many of the rings' units make one of the mesh.
    pub scale: V,
    /// One for each corner, to be filled where they are not triangles.
    pub faces: &'r mut [Polygon<V>],
    /// The planes of the faces, where they are needed.
    pub planes: Option<&'r [[V; 4]]>,
    /// For the estimator.
    pub scratch: Scratch<'r, V>,
}

/// What is to be loaded.
pub(super) struct Needed<'a, S> {
    /// Whether edges are.
    pub edges: bool,
    /// Whether the units of rings are to be such that the longest component is between 1 and 2.
    pub units: bool,
    /// The planes of faces, where these are other than triangles and some quantity looks at planes.
    pub planes: Option<Planes<'a, S>>,
}

impl<S: Coordinate> Sweep<'_, S> {
    /// Fetches what the block that comes next needs, where memory would otherwise be waited for.
    #[inline(always)]
    pub(super) fn prefetch(&self, next: Option<&Block<'_, '_>>) {
        let Some(block) = next else { return };
        block.prefetch(self.points);
        match &self.normals {
            Some(NeighbourNormals::Single(normals)) => block.prefetch(normals),
            Some(NeighbourNormals::Double(normals)) => block.prefetch(normals),
            None => {}
        }
    }

    /// Loads the rings of a block, in their own units. A ring whose edges are neither very short nor very long is
    /// loaded as it is where units do not matter: a power of two would change no digit of it.
    #[inline(always)]
    pub(super) fn load<'r, V: Vector>(
        &self,
        block: &Block<'_, '_>,
        needed: &Needed<'_, S>,
        nearby: &Nearby<V::Scalar>,
        rows: &'r mut LaneRows<V>,
    ) -> Loaded<'r, V> {
        let Rows { edges, squared, normals, faces, planes, scratch } = rows.rows();
        let corners = block.corners();
        let edges = &mut edges[..corners + 1];
        let squared = &mut squared[..corners + 1];
        let lanes = block.lanes::<V>();
        let normals: &[_] = match &self.normals {
            Some(values) => {
                match values {
                    NeighbourNormals::Single(values) => {
                        lanes.load_values(values, normals);
                        normals[..corners + 1].iter_mut().for_each(|normal| *normal = lengthened(*normal));
                    }
                    NeighbourNormals::Double(values) => lanes.load_values(values, normals),
                }
                &normals[..corners + 1]
            }
            None => &[],
        };
        let planes = match needed.planes {
            Some(source) => {
                let planes = &mut planes[..corners];
                for (corner, row) in planes.iter_mut().enumerate() {
                    *row = source.load::<V>(nearby, &lanes, corner);
                }
                Some(&*planes)
            }
            None => None,
        };
        if !needed.edges {
            // The size of the ring is that of its faces.
            let mut largest = V::zero();
            for [.., size] in planes.unwrap_or(&[]) {
                largest = size.abs().max(largest);
            }
            let ordinary = V::constant(SHORT).lt(largest).and(largest.lt(V::constant(LONG)));
            let scale = match ordinary.bits() == V::ALL {
                true => V::one(),
                false => V::select(ordinary, V::one(), largest.unit_scale()),
            };
            let ring = Ring { edges, squared, closed: block.closed(), faces: Triangles, normals };
            return Loaded { ring, scale, faces: &mut faces[..corners], planes, scratch };
        }
        let (shortest, longest) = lanes.load_edges(self.points, edges, squared);
        // What is not a number or infinite is not ordinary either.
        let ordinary = V::constant(SHORT * SHORT).lt(shortest).and(longest.lt(V::constant(LONG * LONG)));
        let mut scale = V::one();
        if needed.units || ordinary.bits() != V::ALL {
            let mut extent = V::zero();
            for edge in edges.iter() {
                extent = edge.largest_component().max(extent);
            }
            scale = extent.unit_scale();
            if !needed.units {
                scale = V::select(ordinary, V::one(), scale);
            }
            scale_edges(edges, squared, scale);
        }
        let ring = Ring { edges, squared, closed: block.closed(), faces: Triangles, normals };
        Loaded { ring, scale, faces: &mut faces[..corners], planes, scratch }
    }

    /// Fills `faces` in the ring's units, the lanes beyond `block` with copies of its first.
    #[inline(always)]
    pub(super) fn load_faces<V: Vector>(
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
    pub(super) fn alone(&self, calls: &dyn AloneCalls, vertex: usize, rows: &mut LaneRows<f64>) {
        if self.topology.edges_alone(vertex) <= LANE_EDGES {
            self.alone_in(calls, vertex, rows.rows());
        } else {
            self.alone_in(calls, vertex, self.large.lock().unwrap_or_else(PoisonError::into_inner).rows());
        }
    }

    fn alone_in(&self, calls: &dyn AloneCalls, vertex: usize, rows: Rows<'_, f64>) {
        let Rows { edges, squared, normals, faces, mut scratch, .. } = rows;
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

/// Rings of edges between these lengths are not scaled. Estimators compare squares of edges and of cross products with
/// [`Real::TINY`], which in single precision is 2^-100: where that could make a difference, sines are below 2^-10, and such
/// corners are left to double precision in any units.
const SHORT: f64 = 1.0 / 1024.0;
const LONG: f64 = 1024.0;

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
