//! A ring of lanes: what an estimator sees of a vertex.
//!
//! Edges are differences from the vertex, multiplied by a power of two that brings the longest component of the ring
//! to between 1 and 2. So nothing is lost far from the origin, and no square of a length overflows or vanishes,
//! whatever the size of the mesh. A mesh of triangles and one of polygons differ only in [`RingFaces`].

use crate::simd::{MAX_LANES, Mask, Real, Vector, Vector3, atan2_and_reciprocal};
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
    /// The normals of the neighbours, one for each edge; none where no estimator asks for them.
    pub normals: &'a [Vector3<V>],
}

impl<'a, V: Vector, F: RingFaces<V>> Ring<'a, V, F> {
    /// The number of corners, one fewer than [`Ring::edges`].
    #[inline(always)]
    pub fn corner_count(&self) -> usize {
        self.edges.len() - 1
    }

    /// The ring with other faces.
    pub fn with_faces<G>(&self, faces: G) -> Ring<'a, V, G> {
        let Ring { edges, squared, closed, normals, .. } = *self;
        Ring { edges, squared, closed, faces, normals }
    }

    /// A bit for each lane in which a difference of positions has left the range: only the vertex-by-vertex path brings
    /// these closer first.
    #[inline(always)]
    pub fn overflowed(&self) -> u32 {
        let mut sum = V::zero();
        for &squared in self.squared {
            sum = sum + squared;
        }
        !sum.lt(V::splat(V::Scalar::INFINITY)).bits()
    }

    /// The number of different edges.
    #[inline(always)]
    pub fn edge_count(&self) -> usize {
        self.corner_count() + !self.closed as usize
    }

    /// Fills a row with a number for each corner: `row[j + 1]` is that of corner `j`, so edge `j` lies between `row[j]`
    /// and `row[j + 1]`. Beyond the ends of an open fan stands zero.
    #[inline(always)]
    pub fn fill_corners(&self, row: &mut [V], number: impl Fn(&Corner<V, F::Face>) -> V) {
        let corners = self.corner_count();
        let row = &mut row[..corners + 2];
        for index in 0..corners {
            row[index + 1] = number(&self.corner(index));
        }
        row[0] = if self.closed { row[corners] } else { V::zero() };
        row[corners + 1] = if self.closed { row[1] } else { V::zero() };
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
    /// Fan after fan, as `edges`, or none.
    normals: &'a [Vector3<f64>],
}

impl<'a, F: RingFaces<f64>> VertexFans<'a, F> {
    pub fn new(
        topology: &'a Topology,
        vertex: usize,
        edges: &'a [Vector3<f64>],
        squared: &'a [f64],
        faces: F,
        normals: &'a [Vector3<f64>],
    ) -> Self {
        VertexFans { topology, vertex, edges, squared, faces, normals }
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
                squared: &self.squared[edges.clone()],
                closed: fan.closed,
                faces: self.faces.part(corners),
                normals: self.normals.get(edges).unwrap_or(&[]),
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
    /// The part of the face's area that lies nearest to the vertex: Meyer's mixed area in a triangle, an equal share
    /// for each corner in a polygon.
    fn mixed_area(&self, corner: &Corner<V, Self>) -> V;
    /// An equal share of the face's area for each of its corners.
    fn area_share(&self, corner: &Corner<V, Self>) -> V;
    /// The interior angle as Gauss and Bonnet need it: those of a triangle sum up to π and those of a polygon to
    /// `(n − 2)π`, slivers, edges without length and polygons that are not flat included.
    fn flat_angle(&self, corner: &Corner<V, Self>) -> V;
    /// Where the face is not a triangle: from the vertex to the mean of its corners, the mean of their normals, and 1;
    /// elsewhere zeros. `None` in a mesh of triangles.
    fn centre(&self) -> Option<(Vector3<V>, Vector3<V>, V)>;
    /// What [`Face::area_factor`] lacks, the same for all faces.
    const AREA_UNIT: f64 = 1.0;
    /// The factor that makes its length the face's area divided by [`Face::AREA_UNIT`].
    #[inline(always)]
    fn area_factor(&self, corner: &Corner<V, Self>) -> V {
        self.area(corner)
    }
    /// As [`Corner::spread`], for a factor that stays finite however thin the corner is.
    #[inline(always)]
    fn plain_spread(&self, corner: &Corner<V, Self>, factor: V) -> V {
        corner.spread(factor)
    }
    /// As [`Corner::spread`], for a factor that is `by_sine` times [`Face::sine_product`].
    #[inline(always)]
    fn sine_spread(&self, corner: &Corner<V, Self>, factor: V, _by_sine: V) -> V {
        corner.spread(factor)
    }
    /// As [`Corner::spread`], for a factor that the angle is in.
    #[inline(always)]
    fn angle_spread(&self, corner: &Corner<V, Self>, factor: V) -> V {
        corner.spread(factor)
    }
    /// As [`Face::angle_spread`], where it also counts how much is missing to a straight angle.
    #[inline(always)]
    fn cone_spread(&self, corner: &Corner<V, Self>, factor: V) -> V {
        corner.spread(factor)
    }
    /// [`Corner::spread`]
    #[inline(always)]
    fn spread(&self, corner: &Corner<V, Self>, factor: V) -> V {
        if V::Scalar::SINGLE {
            let defined = V::splat(V::Scalar::TINY).lt(corner.cross_squared);
            V::select(defined, factor * factor * corner.product, V::splat(V::Scalar::INFINITY))
        } else {
            (self.direction(corner) * factor).squared()
        }
    }
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
    /// In single precision not a number where the edges are nearly parallel, or so short that their cross product has lost its
    /// digits, so that a sum with such a corner in it is left to
    /// double precision; 0 otherwise.
    #[inline(always)]
    pub fn doubt(&self) -> V {
        if !V::Scalar::SINGLE {
            return V::zero();
        }
        // With some room, since the cross product is compared with TINY in other places, and edges are up to 4 long.
        let least = V::splat(V::Scalar::TINY) * V::constant(64.0);
        let clear = (self.product * V::constant(1.0 / 256.0)).max(least).lt(self.cross_squared);
        V::select(clear, V::zero(), V::constant(f64::NAN))
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
    /// [`Face::area_factor`]
    #[inline(always)]
    pub fn area_factor(&self) -> V {
        self.face.area_factor(self)
    }
    /// [`Face::plain_spread`]
    #[inline(always)]
    pub fn plain_spread(&self, factor: V) -> V {
        self.face.plain_spread(self, factor)
    }
    /// [`Face::sine_spread`]
    #[inline(always)]
    pub fn sine_spread(&self, factor: V, by_sine: V) -> V {
        self.face.sine_spread(self, factor, by_sine)
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
    /// [`Face::mixed_area`]
    #[inline(always)]
    pub fn mixed_area(&self) -> V {
        self.face.mixed_area(self)
    }
    /// [`Face::area_share`]
    #[inline(always)]
    pub fn area_share(&self) -> V {
        self.face.area_share(self)
    }
    /// [`Face::flat_angle`]
    #[inline(always)]
    pub fn flat_angle(&self) -> V {
        self.face.flat_angle(self)
    }
    /// [`Face::centre`]
    #[inline(always)]
    pub fn centre(&self) -> Option<(Vector3<V>, Vector3<V>, V)> {
        self.face.centre()
    }
    /// The mixed area (Meyer et al. 2003, figure 4) of the triangle that the two edges span.
    #[inline(always)]
    fn triangle_mixed_area(&self) -> V {
        let twice_area = self.cross_length();
        let (a, b, dot) = (self.a.squared(), self.b.squared(), self.a.dot(self.b));
        // The cotangents at the far ends of a and b, times twice the area.
        let (at_a, at_b) = (a - dot, b - dot);
        let voronoi = (a * at_b + b * at_a) * twice_area.reciprocal_or_zero() * V::constant(0.125);
        let obtuse_here = dot.lt(V::zero());
        let obtuse_there = at_a.min(at_b).lt(V::zero());
        let blunt = twice_area * V::select(obtuse_here, V::constant(0.25), V::constant(0.125));
        V::select(obtuse_here.or(obtuse_there), blunt, voronoi)
    }
    /// How much a term `factor × direction` may have lost to rounding, squared and in units of its last place: the
    /// cross product of nearly parallel edges keeps only `sine` of its digits. Infinite where a face is degenerate.
    ///
    /// Only single precision asks; double precision answers with the term's square, which tells cancellation apart.
    #[inline(always)]
    pub fn spread(&self, factor: V) -> V {
        self.face.spread(self, factor)
    }
    /// [`Face::angle_spread`]
    #[inline(always)]
    pub fn angle_spread(&self, factor: V) -> V {
        self.face.angle_spread(self, factor)
    }
    /// [`Face::cone_spread`]
    #[inline(always)]
    pub fn cone_spread(&self, factor: V) -> V {
        self.face.cone_spread(self, factor)
    }
}

/// The angle between two edges of a face; beyond π where the face has a normal, may turn (1, else 0) and they run
/// around each other against it. An edge without length counts as if it stood upright on the other, and two of them as
/// if they were those of an equilateral triangle: so the angles of a triangle add up to π, whatever it is like.
#[inline(always)]
pub(crate) fn interior_angle<V: Vector>(a: Vector3<V>, b: Vector3<V>, normal: Vector3<V>, may_turn: V) -> V {
    let cross = a.cross(b);
    let squared = cross.squared();
    let kept = V::splat(V::Scalar::TINY).lt(squared);
    let (angle, _) = atan2_and_reciprocal(V::select(kept, squared, V::zero()).sqrt(), a.dot(b));
    let reflex = (cross.dot(normal) * may_turn).lt(V::zero());
    let angle = V::select(reflex, V::constant(std::f64::consts::TAU) - angle, angle);
    let (shorter, longer) = (a.squared().min(b.squared()), a.squared().max(b.squared()));
    let tiny = V::splat(V::Scalar::TINY);
    let angle = V::select(tiny.lt(shorter), angle, V::constant(std::f64::consts::FRAC_PI_2));
    V::select(tiny.lt(longer), angle, V::constant(std::f64::consts::FRAC_PI_3))
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
    const AREA_UNIT: f64 = 0.5;
    #[inline(always)]
    fn area_factor(&self, _corner: &Corner<V, Self>) -> V {
        V::one()
    }
    #[inline(always)]
    fn plain_spread(&self, corner: &Corner<V, Self>, factor: V) -> V {
        if V::Scalar::SINGLE { factor * factor * corner.product } else { corner.spread(factor) }
    }
    #[inline(always)]
    fn sine_spread(&self, corner: &Corner<V, Self>, factor: V, by_sine: V) -> V {
        if !V::Scalar::SINGLE {
            return corner.spread(factor);
        }
        // A factor that dropped out is for double precision to judge.
        let usable = V::zero().lt(by_sine);
        V::select(usable, by_sine * by_sine * corner.product, V::splat(V::Scalar::INFINITY))
    }
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
    #[inline(always)]
    fn mixed_area(&self, corner: &Corner<V, Self>) -> V {
        corner.triangle_mixed_area()
    }
    #[inline(always)]
    fn area_share(&self, corner: &Corner<V, Self>) -> V {
        corner.cross_length() * V::constant(1.0 / 6.0)
    }
    #[inline(always)]
    fn flat_angle(&self, corner: &Corner<V, Self>) -> V {
        interior_angle(corner.a, corner.b, Vector3::zero(), V::zero())
    }
    #[inline(always)]
    fn centre(&self) -> Option<(Vector3<V>, Vector3<V>, V)> {
        None
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
    /// From the vertex to the centroid, or to the mean of the corners (see [`Face::centre`]); zero where no estimator asks
    /// for it.
    pub centroid: Vector3<V>,
    /// One by the number of corners.
    pub share: V,
    /// How much each angle falls short of those of a flat polygon; zero where no estimator asks for it.
    pub bend: V,
    /// The mean of the normals of its corners; zero where no estimator asks for it.
    pub mean_normal: Vector3<V>,
    /// 1 if a corner may be reflex, 0 at a triangle, whose corners only rounding could turn.
    pub may_turn: V,
}

impl<V: Vector> Polygon<V> {
    /// The polygon `face(lane)` in each lane.
    #[inline(always)]
    pub fn from_lanes(face: impl Fn(usize) -> Polygon<f64>) -> Self {
        const NUMBERS: usize = 13;
        let mut lanes = [[V::Scalar::ZERO; MAX_LANES]; NUMBERS];
        for lane in 0..V::LANES {
            let Polygon { normal, area, centroid, share, bend, mean_normal, may_turn } = face(lane);
            let (n, c, m) = (normal, centroid, mean_normal);
            let numbers = [n.x, n.y, n.z, c.x, c.y, c.z, m.x, m.y, m.z, area, share, bend, may_turn];
            for (row, number) in lanes.iter_mut().zip(numbers) {
                row[lane] = V::Scalar::from_f64(number);
            }
        }
        let row = |index: usize| V::from_lanes(&lanes[index]);
        let vector = |first: usize| Vector3 { x: row(first), y: row(first + 1), z: row(first + 2) };
        Polygon {
            normal: vector(0),
            centroid: vector(3),
            mean_normal: vector(6),
            area: row(9),
            share: row(10),
            bend: row(11),
            may_turn: row(12),
        }
    }
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
    #[inline(always)]
    fn mixed_area(&self, corner: &Corner<V, Self>) -> V {
        V::select(V::zero().lt(self.may_turn), self.area * self.share, corner.triangle_mixed_area())
    }
    #[inline(always)]
    fn area_share(&self, _corner: &Corner<V, Self>) -> V {
        self.area * self.share
    }
    #[inline(always)]
    fn flat_angle(&self, corner: &Corner<V, Self>) -> V {
        interior_angle(corner.a, corner.b, self.normal, self.may_turn) + self.bend
    }
    #[inline(always)]
    fn centre(&self) -> Option<(Vector3<V>, Vector3<V>, V)> {
        Some((self.centroid * self.may_turn, self.mean_normal * self.may_turn, self.may_turn))
    }
}

/// Faces of any shape of which only normal and area are known, one for each corner.
#[derive(Clone, Copy)]
pub(crate) struct PlaneFaces<'a, V> {
    /// As `planes.rs` has them; in units of the mesh.
    pub rows: &'a [[V; 4]],
    /// How many of the ring's units make one of the mesh.
    pub scale: V,
}

impl<V: Vector> RingFaces<V> for PlaneFaces<'_, V> {
    type Face = Plane<V>;
    #[inline(always)]
    fn face(&self, index: usize) -> Plane<V> {
        let [x, y, z, size] = self.rows[index];
        Plane { normal: Vector3 { x, y, z }, size, scale: self.scale }
    }
    fn part(&self, corners: std::ops::Range<usize>) -> Self {
        PlaneFaces { rows: &self.rows[corners], scale: self.scale }
    }
}

/// A polygon of which only normal and area are known; its direction is its unit normal.
#[derive(Clone, Copy)]
pub(crate) struct Plane<V> {
    normal: Vector3<V>,
    size: V,
    scale: V,
}

impl<V: Vector> Face<V> for Plane<V> {
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
        let reflex = corner.cross.dot(self.normal).lt(V::zero()).and(V::zero().lt(self.size));
        (V::one(), V::select(reflex, V::constant(std::f64::consts::TAU) - angle, angle))
    }
    #[inline(always)]
    fn area(&self, _corner: &Corner<V, Self>) -> V {
        // A face may be larger than the ring by any amount.
        let size = self.size * self.scale;
        size * size
    }
    #[inline(always)]
    fn sine_product(&self, corner: &Corner<V, Self>) -> V {
        corner.cross_length()
    }
    // Who asks for these says so by `FaceNeeds::Frames`, and gets `Polygon`.
    fn centroid_squared(&self, _corner: &Corner<V, Self>) -> V {
        V::constant(f64::NAN)
    }
    fn mixed_area(&self, _corner: &Corner<V, Self>) -> V {
        V::constant(f64::NAN)
    }
    fn area_share(&self, _corner: &Corner<V, Self>) -> V {
        V::constant(f64::NAN)
    }
    fn flat_angle(&self, _corner: &Corner<V, Self>) -> V {
        V::constant(f64::NAN)
    }
    fn centre(&self) -> Option<(Vector3<V>, Vector3<V>, V)> {
        None
    }
    #[inline(always)]
    fn spread(&self, corner: &Corner<V, Self>, factor: V) -> V {
        // The normal itself is exact to the last place.
        if V::Scalar::SINGLE { factor * factor } else { (self.direction(corner) * factor).squared() }
    }
    #[inline(always)]
    fn sine_spread(&self, corner: &Corner<V, Self>, factor: V, by_sine: V) -> V {
        if V::Scalar::SINGLE { by_sine * by_sine * corner.product } else { self.spread(corner, factor) }
    }
    #[inline(always)]
    fn cone_spread(&self, corner: &Corner<V, Self>, factor: V) -> V {
        if !V::Scalar::SINGLE {
            return self.spread(corner, factor);
        }
        let clear = (corner.product * V::constant(1.0 / 64.0)).lt(corner.cross_squared);
        V::select(clear, factor * factor, V::splat(V::Scalar::INFINITY))
    }
    #[inline(always)]
    fn angle_spread(&self, corner: &Corner<V, Self>, factor: V) -> V {
        if !V::Scalar::SINGLE {
            return self.spread(corner, factor);
        }
        // Of a very sharp angle most digits are lost, and perhaps whether it is reflex.
        let sharp = corner.cross_squared.lt(corner.product * V::constant(1.0 / 4096.0));
        let needle = sharp.and(V::zero().lt(corner.a.dot(corner.b)));
        V::select(needle, V::splat(V::Scalar::INFINITY), factor * factor)
    }
}

/// Rows of numbers that an estimator may keep while it goes around a ring; long enough for every corner and two more.
pub(crate) struct Scratch<'a, V> {
    /// The normal that an estimator of normals found last: see [`sweep_with_normals`](super::sweep_with_normals).
    pub normal: &'a mut Vector3<V>,
    /// Vectors.
    pub vectors: &'a mut [Vector3<V>],
    /// Numbers.
    pub numbers: [&'a mut [V]; 3],
}
