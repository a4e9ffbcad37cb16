//! Vertex normals of osculating jets: a polynomial height field fitted to several rings.
//!
//! See [`fit`](crate::fit) for what is computed, its reference and its bounds. The area-weighted normals of the vertices tell
//! the sides of the surface apart, and stand in where no jet can be believed. Computed in `f64`.
//!
//! Cost: about twenty to forty times that of a one-ring average, most of it the least squares.

use super::vertex::{NormalOutputs, reference_normals};
use crate::error::Error;
use crate::fit::{JetFit, JetOptions};
use crate::parallel::Run;
use crate::simd::{Mask, Vector};
use crate::sweep::{Patch, PatchQuantity, sweep_patches};
use crate::topology::{Topology, status};
use crate::view::Points;

/// The part of the work that goes into the reference normals, for progress.
const REFERENCE_SHARE: f64 = 0.05;

/// [`vertex_normals`](super::vertex_normals) by jets. The counts of `outputs` have been checked.
pub(super) fn jet_normals(
    topology: &Topology,
    points: &Points<'_>,
    options: JetOptions,
    mut run: Run<'_>,
    outputs: &NormalOutputs<'_>,
) -> Result<(), Error> {
    let fit = JetFit::new(options)?;
    let references = run.part(0.0, REFERENCE_SHARE, |run| reference_normals(topology, points, run))?;
    let quantity = JetNormals { fit, outputs, flags: topology.flags(), references: &references };
    run.part(REFERENCE_SHARE, 1.0, |mut run| sweep_patches(topology, points, &mut run, &quantity))
}

struct JetNormals<'a> {
    fit: JetFit,
    outputs: &'a NormalOutputs<'a>,
    flags: &'a [u8],
    references: &'a [[f64; 3]],
}

impl JetNormals<'_> {
    fn write(&self, vertex: usize, normal: [f64; 3], widened: bool, fallback: u8) {
        let widened = if widened { status::WIDENED } else { 0 };
        self.outputs.write(vertex, normal, normal, self.flags[vertex] | widened | fallback);
    }
}

impl PatchQuantity for JetNormals<'_> {
    fn rings(&self) -> usize {
        self.fit.rings()
    }
    fn least(&self) -> usize {
        self.fit.least()
    }
    fn scratch(&self, points: usize) -> usize {
        self.fit.scratch(points)
    }
    fn normals(&self) -> &[[f64; 3]] {
        self.references
    }

    #[inline(always)]
    fn block<V: Vector<Scalar = f64>>(
        &self,
        vertices: &[u32],
        patch: &Patch<'_, V>,
        _scale: V,
        widened: u32,
        _attempt: usize,
        scratch: &mut [V],
    ) -> u32 {
        let jet = self.fit.lanes(patch, scratch);
        let trusted = jet.trusted.bits();
        let axes = [jet.normal.x.to_lanes(), jet.normal.y.to_lanes(), jet.normal.z.to_lanes()];
        let mut doubtful = 0;
        for (lane, &vertex) in vertices.iter().enumerate() {
            if trusted & 1 << lane != 0 {
                self.write(
                    vertex as usize,
                    [axes[0][lane], axes[1][lane], axes[2][lane]],
                    widened & 1 << lane != 0,
                    0,
                );
            } else {
                doubtful |= 1 << lane;
            }
        }
        doubtful
    }

    fn alone(
        &self,
        vertex: usize,
        patch: &Patch<'_, f64>,
        _scale: f64,
        widened: bool,
        last: bool,
        scratch: &mut [f64],
    ) -> bool {
        let Some((jet, fallback)) = self.fit.alone(patch, last, scratch) else { return false };
        self.write(vertex, [jet.normal.x, jet.normal.y, jet.normal.z], widened, fallback);
        true
    }

    fn isolated(&self, vertex: usize) {
        self.outputs.write(vertex, [0.0; 3], [0.0; 3], status::ISOLATED);
    }
}
