//! The cubic fit to positions and normals of Goldfeather & Interrante.
//!
//! In the frame of the vertex normal, with the vertex as origin, a neighbour at `(x, y, z)` with the normal `(n₁, n₂, n₃)`
//! gives three equations for the cubic `z = ½ (a x² + 2 b x y + d y²) + e x³ + f x² y + g x y² + h y³`: its height, and its
//! slopes `∂z/∂x = −n₁/n₃` and `∂z/∂y = −n₂/n₃`. The least-squares solution gives the shape operator `−(a b; b d)`. Slopes
//! are multiplied by the root mean square distance of the neighbours, which makes them lengths that count about as much as
//! heights, whatever the size of the mesh and however it is turned.
//!
//! Input: one ring, or more, with the normals of all vertices; in polygons all vertices that share a face. Reference:
//! Goldfeather & Interrante 2004, "A novel cubic-order algorithm for approximating principal direction vectors", section 3.
//! With exact normals it is of second order; with one-ring normals it is as good as those.
//! Numerical notes: Householder reflections. Boundary: no rule
//! needed. Degenerate rule: a neighbour whose normal is more than 87° from the vertex's gives its height only; where the
//! rest does not determine the cubic, the neighbourhood widens, and where that does not help, curvatures are zero and the
//! status says fallback. Cost: that of a least-squares problem of seven unknowns.

use super::outputs::Local;
use super::patch::PatchEstimator;
use super::principal::{Frame, Operator};
use crate::fit::{condition, solve};
use crate::simd::Vector;
use crate::sweep::Patch;

/// The number of unknowns.
const K: usize = 7;

/// The cosine between two normals below which the slope of one in the frame of the other says nothing.
const STEEP: f64 = 0.05;

/// Goldfeather & Interrante 2004.
pub(crate) struct Goldfeather {
    pub rings: usize,
    /// Whether the condition is wanted.
    pub condition: bool,
}

impl PatchEstimator for Goldfeather {
    const NEIGHBOUR_NORMALS: bool = true;

    fn rings(&self) -> usize {
        self.rings
    }
    fn least(&self) -> usize {
        3
    }
    fn scratch(&self, points: usize) -> usize {
        (K + 1) * (3 * points).max(K)
    }

    #[inline(always)]
    fn lanes<V: Vector<Scalar = f64>>(&self, patch: &Patch<'_, V>, scratch: &mut [V]) -> Local<V> {
        let frame = Frame::new(patch.normal);
        let rows = (3 * patch.len()).max(K);
        let columns = &mut scratch[..(K + 1) * rows];
        let (half, two, three) = (V::constant(0.5), V::constant(2.0), V::constant(3.0));
        for number in columns.iter_mut() {
            *number = V::zero();
        }
        let mut squares = V::zero();
        for index in 0..patch.len() {
            squares = squares + patch.point(index).squared();
        }
        let distance = (squares / patch.count.max(V::one())).sqrt();
        for index in 0..patch.len() {
            // A point that a lane does not have is the vertex itself, without a normal: its rows are zero.
            let (point, normal) = (patch.point(index), patch.neighbour_normal(index));
            let ((x, y), z) = (frame.tangential(point), point.dot(frame.normal));
            let ((nx, ny), nz) = (frame.tangential(normal), normal.dot(frame.normal));
            let known = V::constant(STEEP).lt(nz);
            let weight = V::select(known, distance, V::zero());
            let inverse = -(V::one() / V::select(known, nz, V::one())) * weight;
            let (xx, xy, yy) = (x * x, x * y, y * y);
            let height = [xx * half, xy, yy * half, xx * x, xx * y, x * yy, yy * y, z];
            let zero = V::zero();
            let along_x = [x, y, zero, three * xx, two * xy, yy, zero].map(|slope| slope * weight);
            let along_y = [zero, x, y, zero, xx, two * xy, three * yy].map(|slope| slope * weight);
            for column in 0..K {
                columns[column * rows + 3 * index] = height[column];
                columns[column * rows + 3 * index + 1] = along_x[column];
                columns[column * rows + 3 * index + 2] = along_y[column];
            }
            columns[K * rows + 3 * index] = height[K];
            columns[K * rows + 3 * index + 1] = nx * inverse;
            columns[K * rows + 3 * index + 2] = ny * inverse;
        }
        let solution = solve::<V, K>(columns, rows);
        let [a, b, d, ..] = solution.unknowns;
        Local {
            residual: (solution.residual_squared / (patch.count * three).max(V::one())).sqrt(),
            condition: if self.condition { condition(columns, rows, &solution) } else { V::zero() },
            usable: solution.trusted,
            ..Local::of_operator(&frame, &Operator { a: -a, b: -b, d: -d })
        }
    }
}
