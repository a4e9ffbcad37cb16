//! Vertex normals of sections along the edges of one ring, with a tilt of Max's normal.
//!
//! See [`TiltedSums`] for what is computed, its reference and its rules. Computed in `f64`. Where there is nothing to fit, Max's normal
//! or its fallbacks stay, and the status says fallback.

use super::sum::Estimator;
use super::vertex::{NormalOutputs, with_fallback};
use super::weights::Max;
use crate::fit::{Axes, TiltedSums};
use crate::simd::{Mask, Vector, Vector3};
use crate::sweep::{FaceNeeds, Quantity, Ring, RingFaces, Scratch, VertexFans};
use crate::topology::status;

/// Normals of tilted sections, and where they go.
pub(super) struct TiltedNormals<'a> {
    pub outputs: &'a NormalOutputs<'a>,
    /// The topology's.
    pub flags: &'a [u8],
}

impl Quantity for TiltedNormals<'_> {
    const FACES: FaceNeeds = FaceNeeds::Planes;
    const SINGLE: bool = false;

    #[inline(always)]
    fn block<V: Vector, F: RingFaces<V>>(
        &self,
        vertices: &[u32],
        ring: &Ring<'_, V, F>,
        _scale: V,
        scratch: &mut Scratch<'_, V>,
    ) -> u32 {
        let sum = Max::sum(ring, scratch);
        let (there, squared) = sum.trusted();
        let Axes { x, y, z, .. } = Axes::about(sum.vector.divided_by(squared.sqrt()));
        let mut sums = TiltedSums::new();
        sums.add(ring, x, y, z);
        let found = sums.finish(x, y, z);
        let normal = found.surface.normal;
        let trusted = there.and(found.trusted).and(normal.squared().lt(V::constant(2.0))).bits();
        let axes = [normal.x.to_lanes(), normal.y.to_lanes(), normal.z.to_lanes()];
        for (lane, &vertex) in vertices.iter().enumerate() {
            if trusted & 1 << lane != 0 {
                let normal = [axes[0][lane].into(), axes[1][lane].into(), axes[2][lane].into()];
                self.outputs.write(vertex as usize, normal, normal, self.flags[vertex as usize]);
            }
        }
        !trusted & ((1u32 << vertices.len()) - 1)
    }

    fn alone<F: RingFaces<f64>>(
        &self,
        vertex: usize,
        fans: &VertexFans<'_, F>,
        scale: f64,
        scratch: &mut Scratch<'_, f64>,
    ) {
        let Some((max, _, fallback)) = with_fallback::<Max, F>(fans, scale, scratch) else {
            return self.outputs.write(vertex, [0.0; 3], [0.0; 3], self.flags[vertex] | status::DEGENERATE);
        };
        let Axes { x, y, z, .. } = Axes::about(Vector3 { x: max[0], y: max[1], z: max[2] });
        let mut sums = TiltedSums::<f64>::new();
        for ring in fans.rings() {
            sums.add(&ring, x, y, z);
        }
        let found = sums.finish(x, y, z);
        let Vector3 { x, y, z } = found.surface.normal;
        let tilted = found.trusted && found.surface.normal.squared() < 2.0;
        let (normal, fallback) = if tilted { ([x, y, z], fallback) } else { (max, status::FALLBACK) };
        self.outputs.write(vertex, normal, normal, self.flags[vertex] | fallback);
    }

    fn isolated(&self, vertex: usize) {
        self.outputs.write(vertex, [0.0; 3], [0.0; 3], status::ISOLATED);
    }
}
