//! Rusinkiewicz: shape operators of faces, averaged at their corners.
//!
//! In the plane of a face, the shape operator `S` is the least-squares solution of `S e = Δn` over its three edges `e`, `Δn`
//! the difference of the vertex normals at an edge's ends. It is turned into the vertex's tangent plane by the shortest
//! rotation from the face's normal to the vertex's, and averaged over the faces with their mixed areas at the vertex.
//!
//! Input: any ring of triangles or polygons, with the normals of all vertices. Reference: Rusinkiewicz 2004, "Estimating
//! curvatures and their derivatives on triangle meshes", sections 3.1 and 3.2; mixed areas instead of its Voronoi areas
//! where those turn negative. At a corner of a polygon the edges are those of the triangle at the corner, and the line from
//! the vertex to the mean of the corners, where the normal is the mean of theirs; the plane is that of the whole polygon.
//! Converges where the vertex normals are better than first order. Boundary: no rule needed. Degenerate rule: faces whose
//! edges do not span a plane, that face away from the vertex normal altogether, or without area, are left out; a vertex with
//! none left has no result. Cost: two roots and seven divisions a corner.

use super::outputs::Local;
use super::principal::{Frame, Operator};
use super::ring::RingEstimator;
use crate::simd::{Mask, Real, Vector, Vector3};
use crate::sweep::{Ring, RingFaces, Scratch};

/// A face narrower than this part of its length, squared, says nothing across.
const NARROW: f64 = 1e-12;

/// The cosine between face and vertex normal below which the rotation between them is arbitrary.
const OPPOSITE: f64 = -1.0 + 1e-6;

/// As [`NARROW`] and [`OPPOSITE`], for what is left to double precision.
const DOUBTFULLY_NARROW: f64 = 1.0 / 32.0;
const DOUBTFULLY_OPPOSITE: f64 = 0.25;

/// Rusinkiewicz 2004.
pub(crate) struct Rusinkiewicz;

/// Weighted operators and weights.
#[derive(Clone, Copy)]
pub(crate) struct Sums<V> {
    weight: V,
    a: V,
    b: V,
    d: V,
}

/// The least-squares system of a face.
#[derive(Clone, Copy)]
struct System<V> {
    xx: V,
    xy: V,
    yy: V,
    right: [V; 3],
}

impl<V: Vector> System<V> {
    #[inline(always)]
    fn new() -> Self {
        let zero = V::zero();
        System { xx: zero, xy: zero, yy: zero, right: [zero; 3] }
    }

    /// Adds an edge along which the normal turns by `turn`, with a weight.
    #[inline(always)]
    fn add(&mut self, plane: &Frame<V>, edge: Vector3<V>, turn: Vector3<V>, weight: V) {
        let ((x, y), (turn_x, turn_y)) = (plane.tangential(edge), plane.tangential(turn));
        let (weighted_x, weighted_y) = (x * weight, y * weight);
        self.xx = self.xx + weighted_x * x;
        self.xy = self.xy + weighted_x * y;
        self.yy = self.yy + weighted_y * y;
        self.right[0] = self.right[0] + weighted_x * turn_x;
        self.right[1] = self.right[1] + weighted_y * turn_x + weighted_x * turn_y;
        self.right[2] = self.right[2] + weighted_y * turn_y;
    }

    /// The operator, and where there is one. In the axes of `(xx xy; xy yy)` the three equations come apart.
    #[inline(always)]
    fn solve(&self) -> (Operator<V>, V::Mask) {
        let moments = Operator { a: self.xx, b: self.xy, d: self.yy }.principal();
        let narrow = if V::Scalar::SINGLE { DOUBTFULLY_NARROW } else { NARROW };
        let usable = (moments.k1 * V::constant(narrow)).lt(moments.k2);
        let (c, s) = moments.direction;
        let (long, wide) = (V::select(usable, moments.k1, V::one()), V::select(usable, moments.k2, V::one()));
        let [r0, r1, r2] = self.right;
        // The right-hand sides in those axes; r1 holds the mixed one, counted from both sides.
        let (cc, cs, ss) = (c * c, c * s, s * s);
        let along = cc * r0 + cs * r1 + ss * r2;
        let mixed = (r2 - r0) * (cs + cs) + r1 * (cc - ss);
        let across = ss * r0 - cs * r1 + cc * r2;
        let (a, b, d) = (along / long, mixed / (long + wide), across / wide);
        let (cross, both) = (b * (cs + cs), b * (cc - ss));
        let operator = Operator { a: cc * a - cross + ss * d, b: cs * (a - d) + both, d: ss * a + cross + cc * d };
        (operator, usable)
    }
}

/// A vector after the rotation around `axis` (as long as its angle's sine) by the angle of that cosine.
#[inline(always)]
fn turned<V: Vector>(vector: Vector3<V>, cosine: V, axis: Vector3<V>, inverse: V) -> Vector3<V> {
    vector * cosine + axis.cross(vector) + axis * (axis.dot(vector) * inverse)
}

impl RingEstimator for Rusinkiewicz {
    const UNITS: bool = false;
    const NEIGHBOUR_NORMALS: bool = true;
    type Sums<V: Vector> = Sums<V>;

    #[inline(always)]
    fn start<V: Vector>() -> Sums<V> {
        let zero = V::zero();
        Sums { weight: zero, a: zero, b: zero, d: zero }
    }

    #[inline(always)]
    fn add<V: Vector, F: RingFaces<V>>(
        &self,
        ring: &Ring<'_, V, F>,
        frame: &Frame<V>,
        _scratch: &mut Scratch<'_, V>,
        sums: &mut Sums<V>,
    ) {
        for index in 0..ring.corner_count() {
            let corner = ring.corner(index);
            let plane = Frame::new(corner.direction() * corner.unit());
            let (at_a, at_b) = (ring.normals[index], ring.normals[index + 1]);
            let mut system = System::new();
            system.add(&plane, corner.a, at_a - frame.normal, V::one());
            system.add(&plane, corner.b, at_b - frame.normal, V::one());
            system.add(&plane, corner.b - corner.a, at_b - at_a, V::one());
            if let Some((centroid, normal, polygon)) = corner.centre() {
                system.add(&plane, centroid, normal - frame.normal, polygon);
            }
            let (operator, usable) = system.solve();
            // The vertex's tangents, turned into the face's plane.
            let cosine = frame.normal.dot(plane.normal);
            let axis = frame.normal.cross(plane.normal);
            let inverse = V::one() / (V::one() + cosine).max(V::constant(1e-9));
            let (xx, xy) = plane.tangential(turned(frame.x, cosine, axis, inverse));
            let (yx, yy) = plane.tangential(turned(frame.y, cosine, axis, inverse));
            let (ax, ay) = (operator.a * xx + operator.b * xy, operator.b * xx + operator.d * xy);
            let (dx, dy) = (operator.a * yx + operator.b * yy, operator.b * yx + operator.d * yy);
            let known = V::zero().lt(plane.normal.squared());
            let opposite = if V::Scalar::SINGLE { DOUBTFULLY_OPPOSITE } else { OPPOSITE };
            let counted = usable.and(known).and(V::constant(opposite).lt(cosine));
            // What single precision would leave out, double precision judges.
            let left_out = if V::Scalar::SINGLE { V::constant(f64::NAN) } else { V::zero() };
            let weight = V::select(counted, corner.mixed_area(), left_out);
            sums.weight = sums.weight + weight;
            sums.a = sums.a + (xx * ax + xy * ay) * weight;
            sums.b = sums.b + (yx * ax + yy * ay) * weight;
            sums.d = sums.d + (yx * dx + yy * dy) * weight;
        }
    }

    #[inline(always)]
    fn finish<V: Vector>(&self, sums: &Sums<V>, frame: &Frame<V>) -> Local<V> {
        let inverse = sums.weight.reciprocal_or_zero();
        let operator = Operator { a: sums.a * inverse, b: sums.b * inverse, d: sums.d * inverse };
        Local { usable: V::zero().lt(inverse), ..Local::of_operator(frame, &operator) }
    }
}
