//! A ring of lanes: what an estimator sees of a vertex.
//!
//! Edges are differences from the vertex, multiplied by a power of two that brings the longest component of the ring
//! to between 1 and 2. So nothing is lost far from the origin, and no square of a length overflows or vanishes,
//! whatever the size of the mesh. A mesh of triangles and one of polygons differ only in [`RingFaces`].

use crate::simd::{Real, Vector, Vector3, atan2_and_reciprocal};
use crate::topology::Topology;

/// One fan around a vertex, in every lane.
pub(crate) struct Ring<'a, V, F> {
    /// The edges in counter-clockwise order, one more than corners; in a closed fan the last repeats the first.
    pub edges: &'a [Vector3<V>],
    /// Their squared lengths.
    pub squared: &'a [V],
    /// Whether the last corner meets the first.
    pub closed: bool,
    /// The faces at the corners.
    pub faces: F,
}

impl<V: Vector, F: RingFaces<V>> Ring<'_, V, F> {
    /// The number of corners, one fewer than [`Ring::edges`].
    #[inline(always)]
    pub fn corner_count(&self) -> usize {
        self.edges.len() - 1
    }

    /// The corner between edges `index` and `index + 1`.
    #[inline(always)]
    pub fn corner(&self, index: usize) -> Corner<V, F::Face> {
        let (a, b) = (self.edges[index], self.edges[index + 1]);
        Corner::new(a, b, self.squared[index] * self.squared[index + 1], self.faces.face(index))
    }
}

/// All fans of one vertex, whatever they are like.
pub(crate) struct VertexFans<'a, F> {
    topology: &'a Topology,
    vertex: usize,
    /// Fan after fan, as [`Ring::edges`].
    edges: &'a [Vector3<f64>],
    squared: &'a [f64],
    /// Fan after fan.
    faces: F,
}

impl<'a, F: RingFaces<f64>> VertexFans<'a, F> {
    pub fn new(
        topology: &'a Topology,
        vertex: usize,
        edges: &'a [Vector3<f64>],
        squared: &'a [f64],
        faces: F,
    ) -> Self {
        VertexFans { topology, vertex, edges, squared, faces }
    }

    /// The fans as rings of one lane, in the same units.
    pub fn rings(&self) -> impl Iterator<Item = Ring<'a, f64, F>> {
        let (mut edge, mut corner) = (0, 0);
        self.topology.fans(self.vertex).map(move |fan| {
            let edges = edge..edge + fan.corner_count + 1;
            let corners = corner..corner + fan.corner_count;
            (edge, corner) = (edges.end, corners.end);
            Ring {
                edges: &self.edges[edges.clone()],
                squared: &self.squared[edges],
                closed: fan.closed,
                faces: self.faces.part(corners),
            }
        })
    }
}

/// Where the faces of a ring come from.
pub(crate) trait RingFaces<V: Vector>: Copy {
    /// One face in every lane.
    type Face: Face<V>;
    /// The face at a corner.
    fn face(&self, index: usize) -> Self::Face;
    /// The faces at a stretch of corners.
    fn part(&self, corners: std::ops::Range<usize>) -> Self;
}

/// The face at a corner, in every lane. Answers are factors of [`Face::direction`], so that a triangle never has to
/// normalise what a weight multiplies again.
pub(crate) trait Face<V: Vector>: Copy {
    /// A vector along the face's normal.
    fn direction(&self, corner: &Corner<V, Self>) -> Vector3<V>;
    /// The factor that makes it a unit vector; 0 where the face has no normal.
    fn unit(&self, corner: &Corner<V, Self>) -> V;
    /// The factor that makes it a unit vector, and the interior angle.
    fn unit_and_angle(&self, corner: &Corner<V, Self>) -> (V, V);
    /// The factor that makes its length the face's area.
    fn area(&self, corner: &Corner<V, Self>) -> V;
    /// The factor that makes its length the product of the edge lengths with the sine of the angle between them.
    fn sine_product(&self, corner: &Corner<V, Self>) -> V;
    /// The squared distance of the face's centroid from the vertex.
    fn centroid_squared(&self, corner: &Corner<V, Self>) -> V;
}

/// Two neighbouring edges and the face between them.
#[derive(Clone, Copy)]
pub(crate) struct Corner<V, F> {
    /// The first edge.
    pub a: Vector3<V>,
    /// The second, counter-clockwise from the first.
    pub b: Vector3<V>,
    /// `a × b`
    pub cross: Vector3<V>,
    /// `|a × b|²`
    pub cross_squared: V,
    /// `|a|² |b|²`
    pub product: V,
    face: F,
}

impl<V: Vector, F: Face<V>> Corner<V, F> {
    /// The corner of `face` between `a` and `b`; `product` is `|a|² |b|²`.
    #[inline(always)]
    pub fn new(a: Vector3<V>, b: Vector3<V>, product: V, face: F) -> Self {
        let cross = a.cross(b);
        Corner { a, b, cross, cross_squared: cross.squared(), product, face }
    }
    /// `|a × b|`; 0 where its square has lost the digits of the root.
    #[inline(always)]
    fn cross_length(&self) -> V {
        let kept = V::splat(V::Scalar::TINY).lt(self.cross_squared);
        V::select(kept, self.cross_squared, V::zero()).sqrt()
    }
    /// [`Face::direction`]
    #[inline(always)]
    pub fn direction(&self) -> Vector3<V> {
        self.face.direction(self)
    }
    /// [`Face::unit`]
    #[inline(always)]
    pub fn unit(&self) -> V {
        self.face.unit(self)
    }
    /// [`Face::unit_and_angle`]
    #[inline(always)]
    pub fn unit_and_angle(&self) -> (V, V) {
        self.face.unit_and_angle(self)
    }
    /// [`Face::area`]
    #[inline(always)]
    pub fn area(&self) -> V {
        self.face.area(self)
    }
    /// [`Face::sine_product`]
    #[inline(always)]
    pub fn sine_product(&self) -> V {
        self.face.sine_product(self)
    }
    /// [`Face::centroid_squared`]
    #[inline(always)]
    pub fn centroid_squared(&self) -> V {
        self.face.centroid_squared(self)
    }
    /// How much a term `factor × direction` may have lost to rounding, squared and in units of its last place: the
    /// cross product of nearly parallel edges keeps only `sine` of its digits. Infinite where a face is degenerate.
    ///
    /// Only single precision asks; double precision answers with the term's square, which tells cancellation apart.
    #[inline(always)]
    pub fn spread(&self, factor: V) -> V {
        if V::Scalar::SINGLE {
            let defined = V::splat(V::Scalar::TINY).lt(self.cross_squared);
            V::select(defined, factor * factor * self.product, V::splat(V::Scalar::INFINITY))
        } else {
            (self.direction() * factor).squared()
        }
    }
}

/// Every face is the triangle that its corner spans.
#[derive(Clone, Copy)]
pub(crate) struct Triangles;

impl<V: Vector> RingFaces<V> for Triangles {
    type Face = Triangle;
    #[inline(always)]
    fn face(&self, _index: usize) -> Triangle {
        Triangle
    }
    fn part(&self, _corners: std::ops::Range<usize>) -> Self {
        Triangles
    }
}

/// The triangle of a corner; its direction is `a × b`.
#[derive(Clone, Copy)]
pub(crate) struct Triangle;

impl<V: Vector> Face<V> for Triangle {
    #[inline(always)]
    fn direction(&self, corner: &Corner<V, Self>) -> Vector3<V> {
        corner.cross
    }
    #[inline(always)]
    fn unit(&self, corner: &Corner<V, Self>) -> V {
        corner.cross_length().reciprocal_or_zero()
    }
    #[inline(always)]
    fn unit_and_angle(&self, corner: &Corner<V, Self>) -> (V, V) {
        let (angle, unit) = atan2_and_reciprocal(corner.cross_length(), corner.a.dot(corner.b));
        (unit, angle)
    }
    #[inline(always)]
    fn area(&self, _corner: &Corner<V, Self>) -> V {
        V::constant(0.5)
    }
    #[inline(always)]
    fn sine_product(&self, _corner: &Corner<V, Self>) -> V {
        V::one()
    }
    #[inline(always)]
    fn centroid_squared(&self, corner: &Corner<V, Self>) -> V {
        (corner.a + corner.b).squared() * V::constant(1.0 / 9.0)
    }
}

/// Faces of any shape, one for each corner.
#[derive(Clone, Copy)]
pub(crate) struct PolygonFaces<'a, V>(pub &'a [Polygon<V>]);

impl<V: Vector> RingFaces<V> for PolygonFaces<'_, V> {
    type Face = Polygon<V>;
    #[inline(always)]
    fn face(&self, index: usize) -> Polygon<V> {
        self.0[index]
    }
    fn part(&self, corners: std::ops::Range<usize>) -> Self {
        PolygonFaces(&self.0[corners])
    }
}

/// A polygon in the ring's units; its direction is its unit normal.
#[derive(Clone, Copy)]
pub(crate) struct Polygon<V> {
    /// Unit normal, zero where the polygon has none.
    pub normal: Vector3<V>,
    /// Area.
    pub area: V,
    /// From the vertex to the centroid; zero where no estimator asks for it.
    pub centroid: Vector3<V>,
    /// 1 if a corner may be reflex, 0 at a triangle, whose corners only rounding could turn.
    pub may_turn: V,
}

impl<V: Vector> Face<V> for Polygon<V> {
    #[inline(always)]
    fn direction(&self, _corner: &Corner<V, Self>) -> Vector3<V> {
        self.normal
    }
    #[inline(always)]
    fn unit(&self, _corner: &Corner<V, Self>) -> V {
        V::one()
    }
    #[inline(always)]
    fn unit_and_angle(&self, corner: &Corner<V, Self>) -> (V, V) {
        let (angle, _) = atan2_and_reciprocal(corner.cross_length(), corner.a.dot(corner.b));
        // A reflex corner turns against the normal.
        let reflex = (corner.cross.dot(self.normal) * self.may_turn).lt(V::zero());
        (V::one(), V::select(reflex, V::constant(std::f64::consts::TAU) - angle, angle))
    }
    #[inline(always)]
    fn area(&self, _corner: &Corner<V, Self>) -> V {
        self.area
    }
    #[inline(always)]
    fn sine_product(&self, corner: &Corner<V, Self>) -> V {
        corner.cross_length()
    }
    #[inline(always)]
    fn centroid_squared(&self, _corner: &Corner<V, Self>) -> V {
        self.centroid.squared()
    }
}

/// Rows of numbers that an estimator may keep while it goes around a ring; long enough for every corner and two more.
pub(crate) struct Scratch<'a, V> {
    /// Vectors.
    pub vectors: &'a mut [Vector3<V>],
    /// Numbers.
    pub numbers: [&'a mut [V]; 3],
}
