//! The curvature of the section in any tangent direction.
//!
//! The plane through the vertex `V`, its normal `N` and a tangent direction `t` cuts the polygon of the ring's neighbours in
//! a point `A` on the side of `t` and a point `C` on the other: the paper's three consecutive points of a plane curve. Their
//! curvature at `V` by any of the [`section`](super::section)s is that of the surface in the direction `t`, positive where
//! the bisector of `A` and `C` points away from `N`.
//!
//! Input: any ring of triangles or polygons; in a polygon the line between a vertex's two neighbours stands for its far
//! edges. Directions are projected onto the tangent plane. Reference: the paper, section 4, whose three points these are.
//! Boundary: where the ring is open on one side of the plane, the mirror image of the other point stands in, and the status
//! says one-sided; the parabolas are then one, with the formula of an edge.
//! Degenerate rule: a direction along the normal, a vertex without normal, and a plane that meets the ring on neither side
//! have no section: 0, and the status says so. Where a fold makes a plane meet it more than once on a side, the first crossing
//! in ring order counts. Cost: eight products a corner, and three points' worth for each direction.

use super::ring::{load_vectors, own_normals};
use super::section::ThreePoints;
use super::vertex::{NORMAL_SHARE, VertexNormals, unit_normals};
use super::{Section, SectionOutputs, section_status};
use crate::error::Error;
use crate::parallel::Run;
use crate::simd::{Mask, Real, Vector, Vector3};
use crate::sweep::{FaceNeeds, Quantity, Ring, RingFaces, Scratch, VertexFans, sweep};
use crate::topology::Topology;
use crate::view::Points;

/// Tangent directions; their lengths do not count.
#[derive(Clone, Copy, Debug)]
pub enum Directions<'a> {
    /// One for each vertex, `#V × 3`.
    PerVertex(Points<'a>),
    /// The same set for every vertex, `#D × 3`.
    Shared(Points<'a>),
}

/// Computes the sectional curvatures of all vertices, or of those in [`Run::vertices`], in given directions. `curvature` and
/// `status` have an element for each vertex; for a shared set of `#D` directions, `#V × #D`, those of a vertex together.
///
/// # Errors
/// [`Error::Size`] where counts do not fit; [`Error::NonFinitePosition`]; [`Error::NonFiniteNormal`];
/// [`Error::NonFiniteDirection`]; [`Error::IndexOutOfRange`]; [`Error::Cancelled`]; [`Error::OutOfMemory`].
pub fn direction_sections(
    topology: &Topology,
    points: &Points<'_>,
    directions: Directions<'_>,
    section: Section,
    normals: VertexNormals<'_>,
    mut run: Run<'_>,
    outputs: &SectionOutputs<'_>,
) -> Result<(), Error> {
    let vertex_count = topology.vertex_count();
    let (directions, shared) = match directions {
        Directions::PerVertex(directions) => {
            if directions.len() != vertex_count {
                let (found, expected) = (directions.len() as u64, vertex_count as u64);
                return Err(Error::Size { what: "directions.count", found, expected });
            }
            (directions, None)
        }
        Directions::Shared(directions) => (directions, Some(directions.len())),
    };
    let count = vertex_count.checked_mul(shared.unwrap_or(1)).ok_or(Error::Size {
        what: "directions.count",
        found: directions.len() as u64,
        expected: (usize::MAX / vertex_count.max(1)) as u64,
    })?;
    outputs.check(count, vertex_count)?;
    let finite = |index: usize| match directions.get(index).is_finite() {
        true => Ok(()),
        false => Err(Error::NonFiniteDirection { index: index as u64 }),
    };
    match (run.vertices, shared) {
        (Some(list), None) => {
            let in_range = list.iter().map(|&vertex| vertex as usize).filter(|&vertex| vertex < vertex_count);
            in_range.into_iter().try_for_each(finite)?;
        }
        _ => (0..directions.len()).try_for_each(finite)?,
    }
    let normals = unit_normals(topology, points, normals, &mut run)?;
    let quantity = DirectionSections { normals: &normals, directions, shared, section, outputs };
    run.part(NORMAL_SHARE, 1.0, |mut run| sweep(topology, points, &mut run, true, &quantity))?;
    outputs.write_normals(&normals, run.vertices);
    Ok(())
}

struct DirectionSections<'a> {
    normals: &'a [[f64; 3]],
    directions: Points<'a>,
    /// How many directions each vertex has, if it is not its own.
    shared: Option<usize>,
    section: Section,
    outputs: &'a SectionOutputs<'a>,
}

/// Where the normal plane meets the ring, lane by lane; a side that it does not meet is zero.
#[derive(Clone, Copy)]
struct Crossings<V> {
    front: Vector3<V>,
    back: Vector3<V>,
}

impl<V: Vector> Crossings<V> {
    fn none() -> Self {
        Crossings { front: Vector3::zero(), back: Vector3::zero() }
    }

    /// Adds those of a fan; `along` and `side` are the unit vectors in the tangent plane.
    #[inline(always)]
    fn add<F: RingFaces<V>>(&mut self, ring: &Ring<'_, V, F>, along: Vector3<V>, side: Vector3<V>) {
        let zero = V::zero();
        for index in 0..ring.corner_count() {
            let (a, b) = (ring.edges[index], ring.edges[index + 1]);
            let (left_a, left_b) = (side.dot(a), side.dot(b));
            // Each of a point on the plane belongs to both its corners; the first one that takes it has it.
            let up = left_a.lt(left_b).and(at_most(left_a, zero)).and(at_most(zero, left_b));
            let down = left_b.lt(left_a).and(at_most(left_b, zero)).and(at_most(zero, left_a));
            let crosses = up.or(down);
            let span = left_a - left_b;
            let part = left_a / V::select(crosses, span, V::one());
            let point = a + (b - a) * part;
            let ahead = along.dot(point);
            let free_front = at_most(self.front.largest_component(), zero);
            let free_back = at_most(self.back.largest_component(), zero);
            self.front = select(crosses.and(zero.lt(ahead)).and(free_front), point, self.front);
            self.back = select(crosses.and(ahead.lt(zero)).and(free_back), point, self.back);
        }
    }
}

#[inline(always)]
fn at_most<V: Vector>(a: V, b: V) -> V::Mask {
    // Inputs are finite, so this is `a ≤ b`.
    V::zero().lt(V::select(b.lt(a), V::zero(), V::one()))
}

#[inline(always)]
fn select<V: Vector>(mask: V::Mask, yes: Vector3<V>, no: Vector3<V>) -> Vector3<V> {
    Vector3 { x: V::select(mask, yes.x, no.x), y: V::select(mask, yes.y, no.y), z: V::select(mask, yes.z, no.z) }
}

/// The unit tangent nearest to a direction of any size; zero where there is none.
#[inline(always)]
fn tangent<V: Vector>(direction: Vector3<V>, normal: Vector3<V>) -> Vector3<V> {
    let direction = direction * direction.largest_component().unit_scale();
    let direction = direction * direction.largest_component().unit_scale();
    let across = normal.cross(direction);
    // What is left of a direction along the normal is rounding error.
    let known = V::constant(64.0 * f64::EPSILON * f64::EPSILON).lt(across.squared());
    let length = V::select(known, across.squared(), V::one()).sqrt();
    let unit = across.divided_by(length).cross(normal);
    select(known, unit, Vector3::zero())
}

/// The curvature of the section through two crossings, at least one of which must be there, and whether both are.
#[inline(always)]
fn curvature<V: Vector>(found: &Crossings<V>, normal: Vector3<V>, section: Section, scale: V) -> (V, V) {
    let zero = V::zero();
    let mirrored = |point: Vector3<V>| normal * (normal.dot(point) * V::constant(2.0)) - point;
    let front_there = zero.lt(found.front.largest_component());
    let back_there = zero.lt(found.back.largest_component());
    let front = select(front_there, found.front, mirrored(found.back));
    let back = select(back_there, found.back, mirrored(found.front));
    let (scale_front, scale_back) = (front.largest_component().unit_scale(), back.largest_component().unit_scale());
    let common = scale_front.min(scale_back);
    let (a, c) = (front * scale_front, back * scale_back);
    let three = ThreePoints::new(a, common / scale_front, c, common / scale_back, (back - front) * common);
    // Of the smallest meshes the product of both scales is beyond the range, and curvatures may still be 0.
    let product = common * scale;
    let fits = product.lt(V::splat(V::Scalar::INFINITY));
    let (within, after) = (V::select(fits, product, scale), V::select(fits, V::one(), common));
    let size = three.curvature(section, within) * after;
    let bisector =
        a * (V::one() / positive_or_one(a.squared().sqrt())) + c * (V::one() / positive_or_one(c.squared().sqrt()));
    let towards = zero.lt(bisector.dot(normal));
    let both = V::select(front_there.and(back_there), V::one(), zero);
    (V::select(towards, -size, size), both)
}

#[inline(always)]
fn positive_or_one<V: Vector>(x: V) -> V {
    V::select(V::zero().lt(x), x, V::one())
}

impl DirectionSections<'_> {
    /// The directions of a block's vertices, in the round `index`.
    #[inline(always)]
    fn load<V: Vector>(&self, vertices: &[u32], index: usize) -> Vector3<V> {
        let place = |vertex: usize| if self.shared.is_some() { index } else { vertex };
        load_vectors(vertices, |vertex| self.directions.get(place(vertex)).to_array())
    }

    #[inline(always)]
    fn write<V: Vector>(
        &self,
        vertices: &[u32],
        index: usize,
        along: Vector3<V>,
        normal: Vector3<V>,
        found: &Crossings<V>,
        scale: V,
    ) {
        let (curvature, both) = curvature(found, normal, self.section, scale);
        let zero = V::zero();
        let any = zero.lt(found.front.largest_component()).or(zero.lt(found.back.largest_component()));
        let known = any.and(zero.lt(along.squared())).and(zero.lt(normal.squared())).bits();
        let (curvature, both) = (curvature.to_lanes(), both.to_lanes());
        for (lane, &vertex) in vertices.iter().enumerate() {
            let element = vertex as usize * self.shared.unwrap_or(1) + index;
            if known & 1 << lane == 0 {
                self.outputs.write(element, 0.0, section_status::NONE);
            } else {
                let status = if both[lane].into() > 0.0 { 0 } else { section_status::ONE_SIDED };
                self.outputs.write(element, curvature[lane].into(), status);
            }
        }
    }
}

impl Quantity for DirectionSections<'_> {
    const FACES: FaceNeeds = FaceNeeds::Unused;
    const SINGLE: bool = false;

    #[inline(always)]
    fn block<V: Vector, F: RingFaces<V>>(
        &self,
        vertices: &[u32],
        ring: &Ring<'_, V, F>,
        scale: V,
        _scratch: &mut Scratch<'_, V>,
    ) -> u32 {
        let normal: Vector3<V> = own_normals(self.normals, vertices);
        for index in 0..self.shared.unwrap_or(1) {
            let along = tangent(self.load(vertices, index), normal);
            let mut found = Crossings::none();
            found.add(ring, along, normal.cross(along));
            self.write(vertices, index, along, normal, &found, scale);
        }
        ring.overflowed() & ((1u32 << vertices.len()) - 1)
    }

    fn alone<F: RingFaces<f64>>(
        &self,
        vertex: usize,
        fans: &VertexFans<'_, F>,
        scale: f64,
        _scratch: &mut Scratch<'_, f64>,
    ) {
        let vertices = [vertex as u32];
        let normal = own_normals::<f64>(self.normals, &vertices);
        for index in 0..self.shared.unwrap_or(1) {
            let along = tangent(self.load(&vertices, index), normal);
            let mut found = Crossings::none();
            for ring in fans.rings() {
                found.add(&ring, along, normal.cross(along));
            }
            self.write(&vertices, index, along, normal, &found, scale);
        }
    }

    fn isolated(&self, vertex: usize) {
        let count = self.shared.unwrap_or(1);
        for index in 0..count {
            self.outputs.write(vertex * count + index, 0.0, section_status::NONE);
        }
    }
}
