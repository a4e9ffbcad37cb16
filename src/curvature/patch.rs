//! The driver of all methods that look at neighbourhoods of several rings.

use super::outputs::{Block, CurvatureOutputs, Local};
use super::principal::{Frame, Operator};
use crate::simd::{Mask, Vector};
use crate::sweep::{Patch, PatchQuantity};
use crate::topology::status;

/// A curvature estimator over neighbourhoods.
pub(crate) trait PatchEstimator: Sync {
    /// As [`PatchQuantity::NEIGHBOUR_NORMALS`].
    const NEIGHBOUR_NORMALS: bool = false;

    /// As [`PatchQuantity::rings`].
    fn rings(&self) -> usize;
    /// As [`PatchQuantity::least`].
    fn least(&self) -> usize;
    /// As [`PatchQuantity::scratch`].
    fn scratch(&self, points: usize) -> usize;
    /// The curvatures of a row of vertices.
    fn lanes<V: Vector<Scalar = f64>>(&self, patch: &Patch<'_, V>, scratch: &mut [V]) -> Local<V>;

    /// The curvatures of a vertex that [`PatchEstimator::lanes`] did not trust, and status bits; none if a wider
    /// neighbourhood should be tried, which is never so if this is the `last`.
    fn alone(&self, patch: &Patch<'_, f64>, last: bool, scratch: &mut [f64]) -> Option<(Local<f64>, u8)> {
        if patch.normal.squared() == 0.0 {
            return Some((Local::new(patch.normal), status::DEGENERATE));
        }
        let found = self.lanes(patch, scratch);
        match (found.trusted() != 0, last) {
            (true, _) => Some((found, 0)),
            (false, true) => {
                let zero = Operator { a: 0.0, b: 0.0, d: 0.0 };
                Some((Local::of_operator(&Frame::new(patch.normal), &zero), status::FALLBACK))
            }
            (false, false) => None,
        }
    }
}

/// An estimator with normals, and outputs for its results.
pub(crate) struct PatchCurvatures<'a, E> {
    pub outputs: &'a CurvatureOutputs<'a>,
    /// The topology's.
    pub flags: &'a [u8],
    /// Unit normals, zero where there is none.
    pub normals: &'a [[f64; 3]],
    pub estimator: E,
}

impl<E> PatchCurvatures<'_, E> {
    #[inline(always)]
    fn write<V: Vector<Scalar = f64>>(&self, vertices: &[u32], lanes: u32, found: &Local<V>, scale: V, more: u8) {
        let (flags, fallbacks) = (self.flags, found.fallbacks());
        let scales = scale.to_lanes();
        let block = Block { vertices, lanes, scales, residual_power: 1, flags, more, fallbacks };
        self.outputs.write(&block, &found.rows(self.outputs.taken()));
    }
}

impl<E: PatchEstimator> PatchQuantity for PatchCurvatures<'_, E> {
    const NEIGHBOUR_NORMALS: bool = E::NEIGHBOUR_NORMALS;

    fn rings(&self) -> usize {
        self.estimator.rings()
    }
    fn least(&self) -> usize {
        self.estimator.least()
    }
    fn scratch(&self, points: usize) -> usize {
        self.estimator.scratch(points)
    }
    fn normals(&self) -> &[[f64; 3]] {
        self.normals
    }

    #[inline(always)]
    fn block<V: Vector<Scalar = f64>>(
        &self,
        vertices: &[u32],
        patch: &Patch<'_, V>,
        scale: V,
        widened: u32,
        _attempt: usize,
        scratch: &mut [V],
    ) -> u32 {
        let found = self.estimator.lanes(patch, scratch);
        let all = (1u32 << vertices.len()) - 1;
        // A vertex without normal is none that a fit could answer for.
        let trusted = found.trusted() & V::zero().lt(patch.normal.squared()).bits() & all;
        for (lanes, more) in [(trusted & !widened, 0), (trusted & widened, status::WIDENED)] {
            if lanes != 0 {
                self.write(vertices, lanes, &found, scale, more);
            }
        }
        !trusted & all
    }

    fn alone(
        &self,
        vertex: usize,
        patch: &Patch<'_, f64>,
        scale: f64,
        widened: bool,
        last: bool,
        scratch: &mut [f64],
    ) -> bool {
        let Some((found, more)) = self.estimator.alone(patch, last, scratch) else { return false };
        let widened = if widened { status::WIDENED } else { 0 };
        if found.trusted() != 0 {
            self.write(&[vertex as u32], 1, &found, scale, more | widened);
        } else {
            self.outputs.write_none(vertex, self.normals[vertex], self.flags[vertex] | status::DEGENERATE | widened);
        }
        true
    }

    fn isolated(&self, vertex: usize) {
        self.outputs.write_none(vertex, [0.0; 3], status::ISOLATED);
    }
}
