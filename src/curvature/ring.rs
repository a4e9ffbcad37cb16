//! The driver of all methods that look at one-rings: frames, fans, trust, statuses, outputs.

use super::outputs::{Block, CurvatureOutputs, Local};
use super::principal::Frame;
use crate::simd::{MAX_LANES, Mask, Real, Vector, Vector3};
use crate::sweep::{FaceNeeds, NormalRows, Quantity, Ring, RingFaces, Scratch, VertexFans, lengthened};
use crate::topology::status;

/// A curvature estimator over one-rings. What it adds up goes over all fans of a vertex.
pub(crate) trait RingEstimator: Sync {
    /// Whether rings are to hold the normals of the neighbours, and polygons their centroids.
    const NEIGHBOUR_NORMALS: bool = false;
    /// As [`Quantity::FLAT_ANGLES`].
    const FLAT_ANGLES: bool = false;
    /// As [`Quantity::FACES`].
    const FACES: FaceNeeds = FaceNeeds::Frames;
    /// As [`Quantity::UNITS`].
    const UNITS: bool = true;
    /// As [`Quantity::DOUBTS_FOUR`].
    const DOUBTS_FOUR: bool = false;
    /// Whether a vertex without normal has no result.
    const NORMAL: bool = true;
    /// Whether it is ever computed in single precision. Then [`RingEstimator::finish`] calls results unusable that rounding may
    /// have spoilt, by more than [`DOUBT`] says; they are computed again in double precision.
    const SINGLE: bool = true;
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
    pub normals: OwnNormals<'a>,
    pub estimator: E,
    /// Status bits for every vertex.
    pub more: u8,
}

/// Where unit normals come from; zero where there is none.
#[derive(Clone, Copy)]
pub(crate) enum OwnNormals<'a> {
    /// The normals of all vertices.
    Rows(NormalRows<'a>),
    /// What has been computed from the same ring just before.
    Ring,
    /// No vertex has one.
    None,
}

impl OwnNormals<'_> {
    /// Those of a block's vertices.
    #[inline(always)]
    fn load<V: Vector>(&self, vertices: &[u32], scratch: &Scratch<'_, V>) -> Vector3<V> {
        match *self {
            OwnNormals::None => Vector3::zero(),
            OwnNormals::Ring => *scratch.normal,
            OwnNormals::Rows(NormalRows::Double(rows)) => own_normals(rows, vertices),
            OwnNormals::Rows(NormalRows::Single(rows)) => {
                let row = |vertex: usize| [rows[vertex][0].into(), rows[vertex][1].into(), rows[vertex][2].into()];
                lengthened(load_vectors(vertices, row))
            }
        }
    }
}

/// A vector for each of a block's vertices; lanes beyond them repeat the first.
#[inline(always)]
pub(crate) fn load_vectors<V: Vector>(vertices: &[u32], vector: impl Fn(usize) -> [f64; 3]) -> Vector3<V> {
    let mut lanes = [[V::Scalar::ZERO; MAX_LANES]; 3];
    #[expect(clippy::needless_range_loop, reason = "a lane is a column of every row")]
    for lane in 0..V::LANES {
        let vector = vector(*vertices.get(lane).unwrap_or(&vertices[0]) as usize);
        for axis in 0..3 {
            lanes[axis][lane] = V::Scalar::from_f64(vector[axis]);
        }
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
        if V::Scalar::SINGLE && self.outputs.in_lanes() {
            self.outputs.write_lanes(vertices, lanes, found, scale);
            return;
        }
        let (mut scales, scale) = ([0.0; MAX_LANES], scale.to_lanes());
        for lane in 0..V::LANES {
            scales[lane] = scale[lane].into();
        }
        let block = Block {
            vertices,
            lanes,
            scales,
            residual_power: E::RESIDUAL_POWER,
            flags: self.flags,
            more: self.more,
            fallbacks: found.fallbacks(),
        };
        self.outputs.write(&block, &found.rows(self.outputs.taken()));
    }
}

impl<E: RingEstimator> Quantity for Curvatures<'_, E> {
    const SINGLE: bool = E::SINGLE;
    const CENTROIDS: bool = E::NEIGHBOUR_NORMALS;
    const FLAT_ANGLES: bool = E::FLAT_ANGLES;
    const FACES: FaceNeeds = E::FACES;
    const UNITS: bool = E::UNITS;
    const DOUBTS_FOUR: bool = E::DOUBTS_FOUR;

    fn neighbour_normals(&self) -> Option<NormalRows<'_>> {
        match self.normals {
            OwnNormals::Rows(rows) if E::NEIGHBOUR_NORMALS => Some(rows),
            _ => None,
        }
    }

    #[inline(always)]
    fn block<V: Vector, F: RingFaces<V>>(
        &self,
        vertices: &[u32],
        ring: &Ring<'_, V, F>,
        scale: V,
        scratch: &mut Scratch<'_, V>,
    ) -> u32 {
        let frame = Frame::new(self.normals.load(vertices, scratch));
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
        let frame = Frame::new(self.normals.load::<f64>(&vertices, scratch));
        let mut sums = E::start();
        for ring in fans.rings() {
            self.estimator.add(&ring, &frame, scratch, &mut sums);
        }
        let found = self.estimator.finish(&sums, &frame);
        if found.trusted() & Self::normals_there(frame.normal) & 1 != 0 {
            self.write(&vertices, 1, &found, scale);
        } else {
            let Vector3 { x, y, z } = frame.normal;
            self.outputs.write_none(vertex, [x, y, z], self.flags[vertex] | self.more | status::DEGENERATE);
        }
    }

    fn isolated(&self, vertex: usize) {
        self.outputs.write_none(vertex, [0.0; 3], status::ISOLATED);
    }
}
