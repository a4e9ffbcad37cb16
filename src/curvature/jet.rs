//! Curvatures of osculating jets of degree 2 to 4 (Cazals & Pouget 2005).
//!
//! [`fit`](crate::fit) says what is fitted, to which points, and what becomes of vertices where it fails: a wider
//! neighbourhood (status widened), a lower degree (status fallback), no curvature. Normal and curvatures are the fitted
//! surface's own; vertex normals only tell its sides apart. A jet of degree 1 is a plane, and has none.
//!
//! Convergence, in the size of the neighbourhood: normals of order `d`, curvatures of order `d − 1`, on meshes of any kind.
//! Boundary: no rule needed, since a neighbourhood need not surround its vertex.

use super::outputs::Local;
use super::patch::PatchEstimator;
use super::principal::{Frame, Operator};
use crate::fit::{Jet, JetFit};
use crate::simd::Vector;
use crate::sweep::Patch;

impl<V: Vector> Local<V> {
    #[inline(always)]
    fn of_jet(jet: &Jet<V>) -> Self {
        let [a, b, d] = jet.shape;
        let frame = Frame { normal: jet.normal, x: jet.x, y: jet.y };
        Local {
            residual: jet.residual,
            condition: jet.condition,
            usable: jet.trusted,
            ..Local::of_operator(&frame, &Operator { a, b, d })
        }
    }
}

impl PatchEstimator for JetFit {
    fn rings(&self) -> usize {
        self.rings()
    }
    fn least(&self) -> usize {
        self.least()
    }
    fn scratch(&self, points: usize) -> usize {
        self.scratch(points)
    }
    #[inline(always)]
    fn lanes<V: Vector<Scalar = f64>>(&self, patch: &Patch<'_, V>, scratch: &mut [V]) -> Local<V> {
        Local::of_jet(&self.lanes(patch, scratch))
    }
    fn alone(&self, patch: &Patch<'_, f64>, last: bool, scratch: &mut [f64]) -> Option<(Local<f64>, u8)> {
        let (jet, status) = self.alone(patch, last, scratch)?;
        Some((Local { usable: jet.normal.squared() > 0.0, ..Local::of_jet(&jet) }, status))
    }
}
