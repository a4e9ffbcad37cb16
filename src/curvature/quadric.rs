//! The quadratic height fit with a given normal.
//!
//! In the frame of the vertex normal `N`, with the vertex as origin, the neighbours have tangential coordinates `(x, y)` and
//! heights `z`. The least-squares solution of `z = ½ (a x² + 2 b x y + d y²)` gives the shape operator `−(a b; b d)`.
//!
//! Input: one ring, or more; in polygons all vertices that share a face. Reference: Hamann 1993, "Curvature approximation
//! for triangulated surfaces"; it is the "quadratic fitting" that Meyer et al. 2003 and the paper compare with. Its surface
//! goes through the vertex and is tangent to the plane of `N`, so it is as good as that normal.
//! Numerical notes: Householder reflections. Boundary: no rule needed. Degenerate rule: where the neighbours do not
//! determine the quadric, the neighbourhood widens; where that does not help, curvatures are zero and the status says
//! fallback. Cost: that of a least-squares problem of three unknowns.

use super::outputs::Local;
use super::patch::PatchEstimator;
use super::principal::{Frame, Operator};
use crate::fit::{condition, solve};
use crate::simd::Vector;
use crate::sweep::Patch;

/// The number of unknowns.
const K: usize = 3;

/// The quadratic height fit.
pub(crate) struct Quadric {
    pub rings: usize,
    /// Whether the condition is wanted.
    pub condition: bool,
}

impl PatchEstimator for Quadric {
    fn rings(&self) -> usize {
        self.rings
    }
    fn least(&self) -> usize {
        K
    }
    fn scratch(&self, points: usize) -> usize {
        (K + 1) * points.max(K)
    }

    #[inline(always)]
    fn lanes<V: Vector<Scalar = f64>>(&self, patch: &Patch<'_, V>, scratch: &mut [V]) -> Local<V> {
        let frame = Frame::new(patch.normal);
        let rows = patch.len().max(K);
        let columns = &mut scratch[..(K + 1) * rows];
        let half = V::constant(0.5);
        for row in 0..rows {
            let mut numbers = [V::zero(); K + 1];
            if row < patch.len() {
                // A point that a lane does not have is the vertex itself, and its row is zero.
                let point = patch.point(row);
                let (x, y) = frame.tangential(point);
                numbers = [x * x * half, x * y, y * y * half, point.dot(frame.normal)];
            }
            for (column, number) in numbers.into_iter().enumerate() {
                columns[column * rows + row] = number;
            }
        }
        let solution = solve::<V, K>(columns, rows);
        let [a, b, d] = solution.unknowns;
        Local {
            residual: (solution.residual_squared / patch.count.max(V::one())).sqrt(),
            condition: if self.condition { condition(columns, rows, &solution) } else { V::zero() },
            usable: solution.trusted,
            ..Local::of_operator(&frame, &Operator { a: -a, b: -b, d: -d })
        }
    }
}
