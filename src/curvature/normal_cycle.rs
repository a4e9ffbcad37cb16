//! The normal cycle of Cohen-Steiner & Morvan.
//!
//! Curvature sits on the edges: an edge of length `l` in the unit direction `e`, at which the two faces meet at the signed
//! dihedral angle `β` (positive where the surface is convex), contributes `β l e eᵀ` to a tensor, and `½ β l` to the integral
//! of mean curvature. Over a region of area `A` the tensor by `A`, in the tangent plane of the vertex, has the principal
//! curvatures as eigenvalues, each in the direction that is principal for the *other*: an edge bends across itself.
//!
//! Input: any ring of triangles or polygons; a region of one ring, several, or a ball (see [`measure`](super::measure)).
//! Reference: Cohen-Steiner & Morvan 2003, "Restricted Delaunay triangulations and normal cycle", section 3; Alliez et al.
//! 2003 for the exchange of directions. Converges as a measure, over regions that shrink more slowly than the edges, not
//! over one ring. Boundary: edges with a single face have no dihedral angle and add nothing, so values there are small.
//! Degenerate rule: edges without length, and edges of a face without normal, add nothing; a region without area has no
//! result. Cost: an angle polynomial, two roots and three divisions an edge.

use super::measure::{Measure, MeasureEstimator};
use super::outputs::Local;
use super::principal::{Frame, Operator};
use crate::simd::{Vector, atan2_and_reciprocal};
use crate::sweep::{Ring, RingFaces, Scratch};

/// Cohen-Steiner & Morvan 2003.
pub(crate) struct NormalCycle;

impl MeasureEstimator for NormalCycle {
    #[inline(always)]
    fn add<V: Vector, F: RingFaces<V>>(
        ring: &Ring<'_, V, F>,
        _frame: &Frame<V>,
        scratch: &mut Scratch<'_, V>,
        measure: &mut Measure<V>,
    ) {
        let corners = ring.corner_count();
        let normals = &mut scratch.vectors[..corners + 2];
        for index in 0..corners {
            let corner = ring.corner(index);
            normals[index + 1] = corner.direction() * corner.unit();
            measure.area = measure.area + corner.area_share() + corner.doubt();
        }
        normals[0] = normals[corners];
        // An end of an open fan has a face on one side only.
        let inner = if ring.closed { 0..corners } else { 1..corners };
        for index in inner {
            let edge = ring.edges[index];
            let (before, after) = (normals[index], normals[index + 1]);
            let length = ring.squared[index].sqrt();
            let sine = after.cross(before).dot(edge) * length.reciprocal_or_zero();
            let (angle, _) = atan2_and_reciprocal(sine.abs(), before.dot(after));
            let angle = V::select(sine.lt(V::zero()), -angle, angle);
            // The nearer half of the edge.
            let half = angle * length * V::constant(0.5);
            measure.mean = measure.mean + half * V::constant(0.5);
            let direction = edge * length.reciprocal_or_zero();
            measure.add_product(direction, direction, half);
        }
    }

    #[inline(always)]
    fn finish<V: Vector>(measure: &Measure<V>, frame: &Frame<V>) -> Local<V> {
        let inverse = measure.area.reciprocal_or_zero();
        let along = measure.tangential(frame);
        let across = Operator { a: along.d * inverse, b: -along.b * inverse, d: along.a * inverse };
        Local {
            area: measure.area,
            integrated_mean: measure.mean,
            usable: V::zero().lt(inverse),
            ..Local::of_operator(frame, &across)
        }
    }
}
