//! The driver of all methods that look at one-rings: frames, fans, trust, statuses, outputs.

use super::outputs::{Block, CurvatureOutputs, Local};
use super::principal::Frame;
use crate::simd::{MAX_LANES, Mask, Real, Vector, Vector3};
use crate::sweep::{Quantity, Ring, RingFaces, Scratch, VertexFans};
use crate::topology::status;

/// A curvature estimator over one-rings. What it adds up goes over all fans of a vertex.
pub(crate) trait RingEstimator: Sync {
    /// Whether rings are to hold the normals of the neighbours, and polygons their centroids.
    const NEIGHBOUR_NORMALS: bool = false;
    /// As [`Quantity::FLAT_ANGLES`].
    const FLAT_ANGLES: bool = false;
    /// Whether a vertex without normal has no result.
    const NORMAL: bool = true;
    /// The power of length in which residuals are.
    const RESIDUAL_POWER: i32 = -1;
    /// What is added up.
    type Sums<V: Vector>: Copy;

    /// Nothing added up yet.
    fn start<V: Vector>() -> Self::Sums<V>;
    /// Adds a fan.
    fn add<V: Vector, F: RingFaces<V>>(
        &self,
        ring: &Ring<'_, V, F>,
        frame: &Frame<V>,
        scratch: &mut Scratch<'_, V>,
        sums: &mut Self::Sums<V>,
    );
    /// What follows from all fans.
    fn finish<V: Vector>(&self, sums: &Self::Sums<V>, frame: &Frame<V>) -> Local<V>;
}

/// An estimator with normals, and outputs for its results.
pub(crate) struct Curvatures<'a, E> {
    pub outputs: &'a CurvatureOutputs<'a>,
    /// The topology's.
    pub flags: &'a [u8],
    /// Unit normals, zero where there is none.
    pub normals: &'a [[f64; 3]],
    pub estimator: E,
    /// Status bits for every vertex.
    pub more: u8,
}

/// A vector for each of a block's vertices; lanes beyond them repeat the first.
#[inline(always)]
pub(crate) fn load_vectors<V: Vector>(vertices: &[u32], vector: impl Fn(usize) -> [f64; 3]) -> Vector3<V> {
    let mut lanes = [[V::Scalar::ZERO; MAX_LANES]; 3];
    let [xs, ys, zs] = &mut lanes;
    for (lane, ((x, y), z)) in xs.iter_mut().zip(ys).zip(zs).enumerate().take(V::LANES) {
        let vector = vector(*vertices.get(lane).unwrap_or(&vertices[0]) as usize);
        [*x, *y, *z] = vector.map(V::Scalar::from_f64);
    }
    Vector3::from_lanes(&lanes)
}

/// The normals of a block's vertices.
#[inline(always)]
pub(crate) fn own_normals<V: Vector>(normals: &[[f64; 3]], vertices: &[u32]) -> Vector3<V> {
    load_vectors(vertices, |vertex| normals[vertex])
}

impl<E: RingEstimator> Curvatures<'_, E> {
    /// Whether a vertex whose normal this is can have a result.
    #[inline(always)]
    fn normals_there<V: Vector>(normal: Vector3<V>) -> u32 {
        if E::NORMAL { V::zero().lt(normal.squared()).bits() } else { u32::MAX }
    }

    #[inline(always)]
    fn write<V: Vector>(&self, vertices: &[u32], lanes: u32, found: &Local<V>, scale: V) {
        let block = Block {
            vertices,
            lanes,
            scales: scale.to_lanes().map(Into::into),
            residual_power: E::RESIDUAL_POWER,
            flags: self.flags,
            more: self.more,
            fallbacks: found.fallbacks(),
        };
        self.outputs.write(&block, &found.rows());
    }
}

impl<E: RingEstimator> Quantity for Curvatures<'_, E> {
    const SINGLE: bool = false;
    const CENTROIDS: bool = E::NEIGHBOUR_NORMALS;
    const FLAT_ANGLES: bool = E::FLAT_ANGLES;

    fn neighbour_normals(&self) -> Option<&[[f64; 3]]> {
        E::NEIGHBOUR_NORMALS.then_some(self.normals)
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
        let mut sums = E::start();
        self.estimator.add(ring, &frame, scratch, &mut sums);
        let found = self.estimator.finish(&sums, &frame);
        let all = (1u32 << vertices.len()) - 1;
        let trusted = found.trusted() & Self::normals_there(frame.normal) & all;
        self.write(vertices, trusted, &found, scale);
        !trusted & all
    }

    #[inline(never)]
    fn alone<F: RingFaces<f64>>(
        &self,
        vertex: usize,
        fans: &VertexFans<'_, F>,
        scale: f64,
        scratch: &mut Scratch<'_, f64>,
    ) {
        let vertices = [vertex as u32];
        let frame = Frame::new(own_normals::<f64>(self.normals, &vertices));
        let mut sums = E::start();
        for ring in fans.rings() {
            self.estimator.add(&ring, &frame, scratch, &mut sums);
        }
        let found = self.estimator.finish(&sums, &frame);
        if found.trusted() & Self::normals_there(frame.normal) & 1 != 0 {
            self.write(&vertices, 1, &found, scale);
        } else {
            self.outputs.write_none(
                vertex,
                self.normals[vertex],
                self.flags[vertex] | self.more | status::DEGENERATE,
            );
        }
    }

    fn isolated(&self, vertex: usize) {
        self.outputs.write_none(vertex, [0.0; 3], status::ISOLATED);
    }
}
