//! A quantity without its type, so that the loop and its loaders are compiled once for each vector width and precision of
//! positions, and not again for every estimator. Only blocks and lone vertices know the estimator; a virtual call leads to
//! each, which costs nothing beside what it does.

use super::ring::{PlaneFaces, Polygon, PolygonFaces, Ring, RingFaces, Scratch, Triangles, VertexFans};
use super::{FaceNeeds, NormalRows, Part, Quantity};
use crate::simd::{Level, Real, Task, Vector, Width, dispatch};

/// What a vertex-by-vertex path calls.
pub(super) trait AloneCalls {
    /// [`Quantity::CENTROIDS`]
    fn centroids(&self) -> bool;
    /// [`Quantity::alone`] in a mesh of triangles.
    fn alone_triangles(
        &self,
        vertex: usize,
        fans: &VertexFans<'_, Triangles>,
        scale: f64,
        scratch: &mut Scratch<'_, f64>,
    );
    /// [`Quantity::alone`] in a mesh that has other faces.
    fn alone_polygons(
        &self,
        vertex: usize,
        fans: &VertexFans<'_, PolygonFaces<'_, f64>>,
        scale: f64,
        scratch: &mut Scratch<'_, f64>,
    );
    /// [`Quantity::isolated`]
    fn isolated(&self, vertex: usize);
    /// [`Quantity::EDGES`], in a mesh that has other faces than triangles.
    fn needs_edges(&self) -> bool;
    /// Whether [`Quantity::FACES`] are planes.
    fn planes(&self) -> bool;
    /// Whether [`Quantity::FACES`] are frames.
    fn frames(&self) -> bool;
    /// [`Quantity::UNITS`]
    fn units(&self) -> bool;
    /// [`Quantity::DOUBTS_FOUR`]
    fn doubts_four(&self) -> bool;
}

/// What the loop of a width calls. Scales are handed by reference, since a vector cannot be handed by value to what lacks its
/// CPU features.
pub(super) trait BlockCalls<W: Width>: AloneCalls {
    /// [`Quantity::SINGLE`]
    fn has_single(&self) -> bool;
    /// [`Quantity::block`] in single precision.
    fn single(
        &self,
        vertices: &[u32],
        ring: &Ring<'_, W::Single, Triangles>,
        faces: LoadedFaces<'_, W::Single>,
        scale: &W::Single,
        scratch: &mut Scratch<'_, W::Single>,
    ) -> u32;
    /// [`Quantity::block`] in double precision.
    fn double(
        &self,
        vertices: &[u32],
        ring: &Ring<'_, W::Double, Triangles>,
        faces: LoadedFaces<'_, W::Double>,
        scale: &W::Double,
        scratch: &mut Scratch<'_, W::Double>,
    ) -> u32;
}

/// What a sweep computes, without its type: the part that is not compiled for every quantity.
pub(super) trait Calls: Sync {
    /// [`Quantity::CENTROIDS`]
    fn centroids(&self) -> bool;
    /// [`Quantity::FLAT_ANGLES`]
    fn flat_angles(&self) -> bool;
    /// [`Quantity::neighbour_normals`]
    fn neighbour_normals(&self) -> Option<NormalRows<'_>>;
    /// Whether [`Quantity::FACES`] are planes.
    fn planes(&self) -> bool;
    /// Whether [`Quantity::FACES`] are frames.
    fn frames(&self) -> bool;
    /// [`Quantity::SINGLE`]
    fn has_single(&self) -> bool;
    /// Does a thread's part of a sweep with the vectors of `level`.
    fn work(&self, level: Level, part: Part<'_, '_, '_, '_>);
}

impl<Q: Quantity> Calls for Q {
    fn centroids(&self) -> bool {
        Q::CENTROIDS
    }
    fn flat_angles(&self) -> bool {
        Q::FLAT_ANGLES
    }
    fn neighbour_normals(&self) -> Option<NormalRows<'_>> {
        Quantity::neighbour_normals(self)
    }
    fn planes(&self) -> bool {
        Q::FACES == FaceNeeds::Planes
    }
    fn frames(&self) -> bool {
        Q::FACES == FaceNeeds::Frames
    }
    fn has_single(&self) -> bool {
        Q::SINGLE
    }
    fn work(&self, level: Level, part: Part<'_, '_, '_, '_>) {
        dispatch(level, One { quantity: self, part });
    }
}

struct One<'a, 'c, 's, 'p, Q> {
    quantity: &'a Q,
    part: Part<'a, 'c, 's, 'p>,
}

impl<Q: Quantity> Task for One<'_, '_, '_, '_, Q> {
    #[inline(always)]
    fn run<W: Width>(self) {
        self.part.run::<W>(self.quantity);
    }
}

/// Two quantities of the same rings, the second of which takes the normal that the first leaves in [`Scratch::normal`].
pub(super) struct Both<'a, A, B> {
    pub first: &'a A,
    pub second: &'a B,
}

impl<A: Quantity, B: Quantity> Calls for Both<'_, A, B> {
    fn centroids(&self) -> bool {
        A::CENTROIDS || B::CENTROIDS
    }
    fn flat_angles(&self) -> bool {
        A::FLAT_ANGLES || B::FLAT_ANGLES
    }
    fn neighbour_normals(&self) -> Option<NormalRows<'_>> {
        None
    }
    fn planes(&self) -> bool {
        A::FACES == FaceNeeds::Planes || B::FACES == FaceNeeds::Planes
    }
    fn frames(&self) -> bool {
        A::FACES == FaceNeeds::Frames || B::FACES == FaceNeeds::Frames
    }
    fn has_single(&self) -> bool {
        A::SINGLE && B::SINGLE
    }
    fn work(&self, level: Level, part: Part<'_, '_, '_, '_>) {
        dispatch(level, Two { both: self, part });
    }
}

struct Two<'a, 'c, 's, 'p, A, B> {
    both: &'a Both<'a, A, B>,
    part: Part<'a, 'c, 's, 'p>,
}

impl<A: Quantity, B: Quantity> Task for Two<'_, '_, '_, '_, A, B> {
    #[inline(always)]
    fn run<W: Width>(self) {
        self.part.run::<W>(&BothCalls::<W> { first: self.both.first, second: self.both.second });
    }
}

/// [`Both`] without their types.
struct BothCalls<'a, W> {
    first: &'a dyn BlockCalls<W>,
    second: &'a dyn BlockCalls<W>,
}

impl<W: Width> AloneCalls for BothCalls<'_, W> {
    fn centroids(&self) -> bool {
        self.first.centroids() || self.second.centroids()
    }
    fn alone_triangles(
        &self,
        vertex: usize,
        fans: &VertexFans<'_, Triangles>,
        scale: f64,
        scratch: &mut Scratch<'_, f64>,
    ) {
        self.first.alone_triangles(vertex, fans, scale, scratch);
        self.second.alone_triangles(vertex, fans, scale, scratch);
    }
    fn alone_polygons(
        &self,
        vertex: usize,
        fans: &VertexFans<'_, PolygonFaces<'_, f64>>,
        scale: f64,
        scratch: &mut Scratch<'_, f64>,
    ) {
        self.first.alone_polygons(vertex, fans, scale, scratch);
        self.second.alone_polygons(vertex, fans, scale, scratch);
    }
    fn isolated(&self, vertex: usize) {
        self.first.isolated(vertex);
        self.second.isolated(vertex);
    }
    fn needs_edges(&self) -> bool {
        self.first.needs_edges() || self.second.needs_edges()
    }
    fn planes(&self) -> bool {
        self.first.planes() || self.second.planes()
    }
    fn frames(&self) -> bool {
        self.first.frames() || self.second.frames()
    }
    fn units(&self) -> bool {
        self.first.units() || self.second.units()
    }
    fn doubts_four(&self) -> bool {
        self.first.doubts_four() || self.second.doubts_four()
    }
}

impl<W: Width> BlockCalls<W> for BothCalls<'_, W> {
    fn has_single(&self) -> bool {
        self.first.has_single() && self.second.has_single()
    }
    fn single(
        &self,
        vertices: &[u32],
        ring: &Ring<'_, W::Single, Triangles>,
        faces: LoadedFaces<'_, W::Single>,
        scale: &W::Single,
        scratch: &mut Scratch<'_, W::Single>,
    ) -> u32 {
        self.first.single(vertices, ring, faces, scale, scratch)
            | self.second.single(vertices, ring, faces, scale, scratch)
    }
    fn double(
        &self,
        vertices: &[u32],
        ring: &Ring<'_, W::Double, Triangles>,
        faces: LoadedFaces<'_, W::Double>,
        scale: &W::Double,
        scratch: &mut Scratch<'_, W::Double>,
    ) -> u32 {
        self.first.double(vertices, ring, faces, scale, scratch)
            | self.second.double(vertices, ring, faces, scale, scratch)
    }
}

impl<Q: Quantity> AloneCalls for Q {
    fn centroids(&self) -> bool {
        Q::CENTROIDS
    }
    fn alone_triangles(
        &self,
        vertex: usize,
        fans: &VertexFans<'_, Triangles>,
        scale: f64,
        scratch: &mut Scratch<'_, f64>,
    ) {
        self.alone(vertex, fans, scale, scratch);
    }
    fn alone_polygons(
        &self,
        vertex: usize,
        fans: &VertexFans<'_, PolygonFaces<'_, f64>>,
        scale: f64,
        scratch: &mut Scratch<'_, f64>,
    ) {
        self.alone(vertex, fans, scale, scratch);
    }
    fn isolated(&self, vertex: usize) {
        Quantity::isolated(self, vertex);
    }
    fn needs_edges(&self) -> bool {
        Q::EDGES
    }
    fn planes(&self) -> bool {
        Q::FACES == FaceNeeds::Planes
    }
    fn frames(&self) -> bool {
        Q::FACES == FaceNeeds::Frames
    }
    fn units(&self) -> bool {
        Q::UNITS
    }
    fn doubts_four(&self) -> bool {
        Q::DOUBTS_FOUR
    }
}

impl<W: Width, Q: Quantity> BlockCalls<W> for Q {
    fn has_single(&self) -> bool {
        Q::SINGLE
    }
    fn single(
        &self,
        vertices: &[u32],
        ring: &Ring<'_, W::Single, Triangles>,
        faces: LoadedFaces<'_, W::Single>,
        scale: &W::Single,
        scratch: &mut Scratch<'_, W::Single>,
    ) -> u32 {
        // A quantity that is never computed in single precision is not compiled for it.
        if Q::SINGLE { with_faces::<W, Q, _>(self, vertices, ring, faces, scale, scratch) } else { 0 }
    }
    fn double(
        &self,
        vertices: &[u32],
        ring: &Ring<'_, W::Double, Triangles>,
        faces: LoadedFaces<'_, W::Double>,
        scale: &W::Double,
        scratch: &mut Scratch<'_, W::Double>,
    ) -> u32 {
        with_faces::<W, Q, _>(self, vertices, ring, faces, scale, scratch)
    }
}

/// What is known of a block's faces where these are other than triangles: as much as some quantity of the sweep needs.
#[derive(Clone, Copy)]
pub(super) struct LoadedFaces<'r, V> {
    pub planes: Option<&'r [[V; 4]]>,
    pub frames: Option<&'r [Polygon<V>]>,
}

/// [`Quantity::block`] with the faces that the quantity looks at.
fn with_faces<W: Width, Q: Quantity, V: Vector>(
    quantity: &Q,
    vertices: &[u32],
    ring: &Ring<'_, V, Triangles>,
    faces: LoadedFaces<'_, V>,
    scale: &V,
    scratch: &mut Scratch<'_, V>,
) -> u32 {
    match (Q::FACES, faces) {
        (FaceNeeds::Planes, LoadedFaces { planes: Some(rows), .. }) => {
            let ring = ring.with_faces(PlaneFaces { rows, scale: *scale });
            call::<W, Q, _, _>(quantity, vertices, &ring, scale, scratch)
        }
        // Frames are in double precision.
        (FaceNeeds::Frames, LoadedFaces { frames: Some(frames), .. }) if !V::Scalar::SINGLE => {
            call::<W, Q, _, _>(quantity, vertices, &ring.with_faces(PolygonFaces(frames)), scale, scratch)
        }
        _ => call::<W, Q, _, _>(quantity, vertices, ring, scale, scratch),
    }
}

/// [`Quantity::block`] in a function that has the features of the width.
fn call<W: Width, Q: Quantity, V: Vector, F: RingFaces<V>>(
    quantity: &Q,
    vertices: &[u32],
    ring: &Ring<'_, V, F>,
    scale: &V,
    scratch: &mut Scratch<'_, V>,
) -> u32 {
    let mut untrusted = 0;
    W::call(Block { quantity, vertices, ring, scale, scratch, untrusted: &mut untrusted });
    untrusted
}

struct Block<'a, 'r, 's, Q, V, F> {
    quantity: &'a Q,
    vertices: &'a [u32],
    ring: &'a Ring<'r, V, F>,
    scale: &'a V,
    scratch: &'a mut Scratch<'s, V>,
    untrusted: &'a mut u32,
}

impl<Q: Quantity, V: Vector, F: RingFaces<V>> Task for Block<'_, '_, '_, Q, V, F> {
    #[inline(always)]
    fn run<W: Width>(self) {
        *self.untrusted = self.quantity.block(self.vertices, self.ring, *self.scale, self.scratch);
    }
}
