//! Curvatures of adaptive jets.
//!
//! [`fit`](crate::fit) says what is fitted, and [`adaptive_jets`] to which points, with what is learned from the mesh, and where
//! creases are. Normal and curvatures are the fitted surface's own.
//!
//! On a crease, where no surface has a curvature, the value is the one that fits the circles along all edges best ([`LeastSquares`])
//! around the mean direction of the sides: large across the crease and small along it, the same all along an edge, and inversely
//! proportional to the length of the edges.

use super::outputs::{Block, CurvatureOutputs, Local};
use super::principal::{Frame, Operator};
use super::ring::{Curvatures, OwnNormals, RingEstimator};
use super::shape_operator::LeastSquares;
use super::{CurvatureOptions, Section};
use crate::error::Error;
use crate::fit::AdaptiveJet;
use crate::normals::{AdaptiveOptions, Sink, adaptive_jets};
use crate::parallel::Run;
use crate::simd::{MAX_LANES, Vector, Vector3};
use crate::sweep::{NormalRows, Ring, RingFaces, Room, Scratch, sweep_in};
use crate::topology::{Topology, status};
use crate::view::Points;

/// [`curvatures`](super::curvatures) by adaptive jets; outputs have been checked.
pub(super) fn adaptive_curvatures(
    topology: &Topology,
    points: &Points<'_>,
    options: &CurvatureOptions<'_>,
    run: Run<'_>,
    outputs: &CurvatureOutputs<'_>,
) -> Result<(), Error> {
    let asked = AdaptiveOptions { rings: options.rings as u8, model: options.model };
    adaptive_jets(topology, points, asked, run, &Results { topology, points, outputs })
}

struct Results<'a> {
    topology: &'a Topology,
    points: &'a Points<'a>,
    outputs: &'a CurvatureOutputs<'a>,
}

/// Sections on a crease, of which nothing is said about how well a shape operator fits them.
struct CreaseSections(LeastSquares);

impl RingEstimator for CreaseSections {
    const SINGLE: bool = false;
    type Sums<V: Vector> = <LeastSquares as RingEstimator>::Sums<V>;

    #[inline(always)]
    fn start<V: Vector>() -> Self::Sums<V> {
        LeastSquares::start()
    }

    #[inline(always)]
    fn add<V: Vector, F: RingFaces<V>>(
        &self,
        ring: &Ring<'_, V, F>,
        frame: &Frame<V>,
        scratch: &mut Scratch<'_, V>,
        sums: &mut Self::Sums<V>,
    ) {
        self.0.add(ring, frame, scratch, sums);
    }

    #[inline(always)]
    fn finish<V: Vector>(&self, sums: &Self::Sums<V>, frame: &Frame<V>) -> Local<V> {
        Local { residual: V::zero(), ..self.0.finish(sums, frame) }
    }
}

impl Sink for Results<'_> {
    fn freedom(&self) -> bool {
        self.outputs.degrees_of_freedom.is_some()
    }
    fn residual(&self) -> bool {
        self.outputs.residual.is_some()
    }

    #[inline(always)]
    fn write<V: Vector<Scalar = f64>>(
        &self,
        vertices: &[u32],
        lanes: u32,
        jet: &AdaptiveJet<V>,
        scale: V,
        more: u8,
    ) -> u32 {
        let surface = &jet.surface;
        let [a, b, d] = surface.shape;
        let frame = Frame { normal: surface.normal, x: surface.x, y: surface.y };
        let found = Local {
            residual: jet.residual,
            freedom: jet.freedom,
            usable: jet.trusted,
            ..Local::of_operator(&frame, &Operator { a, b, d })
        };
        let lanes = lanes & found.trusted();
        let (flags, scales) = (self.topology.flags(), scale.to_lanes());
        let block = Block { vertices, lanes, scales, residual_power: 1, flags, more, fallbacks: 0 };
        self.outputs.write(&block, &found.rows(self.outputs.taken()));
        lanes
    }

    fn write_none(&self, vertex: usize, normal: [f64; 3], more: u8) {
        if more != status::FALLBACK {
            let flags = if more == status::ISOLATED { 0 } else { self.topology.flags()[vertex] };
            return self.outputs.write_none(vertex, normal, flags | more);
        }
        // Flat, with some tangents.
        let [x, y, z] = normal;
        let flat = Local::of_operator(&Frame::new(Vector3 { x, y, z }), &Operator { a: 0.0, b: 0.0, d: 0.0 });
        let (flags, scales) = (self.topology.flags(), [1.0; MAX_LANES]);
        let vertices = &[vertex as u32];
        let block = Block { vertices, lanes: 1, scales, residual_power: 1, flags, more, fallbacks: 0 };
        self.outputs.write(&block, &flat.rows(self.outputs.taken()));
    }

    fn write_creases(&self, room: &Room, mut run: Run<'_>, normals: &[[f64; 3]]) -> Result<(), Error> {
        let creases = Curvatures {
            outputs: self.outputs,
            flags: self.topology.flags(),
            normals: OwnNormals::Rows(NormalRows::Double(normals)),
            estimator: CreaseSections(LeastSquares { section: Section::Circle }),
            more: status::CREASE | status::FALLBACK,
        };
        sweep_in(room, self.topology, self.points, &mut run, &creases)
    }
}
