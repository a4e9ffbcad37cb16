//! Vertices of one class together, and the loader that turns their rings into lanes.
//!
//! A [`Block`] can only come from a [`Batch`], which takes its vertices from the table of rings, or checks them against it.
//! That is what lets [`Lanes`] read positions without a bounds check for each neighbour, and packed ones with loads that run
//! one scalar past the third coordinate (see [`rings`](super::rings)).

use super::points::{Coordinate, StridedPoints};
use super::rings::{CLASSES, RingClass, Rings, Slice, WINDOW, bucket};
use crate::simd::{MAX_LANES, Real, Vector, Vector3};

/// Up to [`WINDOW`] vertices, sorted by class.
pub(crate) struct Batch<'r> {
    rings: &'r Rings,
    vertices: [u32; WINDOW],
    slices: [Slice; CLASSES],
    count: usize,
    slice_count: usize,
    scattered: bool,
}

/// Vertices of one class.
pub(crate) enum Group<'r, 'v> {
    /// Without faces.
    Isolated(&'v [u32]),
    /// For the vertex-by-vertex path.
    Alone(&'v [u32]),
    /// Of one fan of equally many corners.
    Lanes(Block<'r, 'v>),
}

impl<'r> Batch<'r> {
    pub(crate) fn new(rings: &'r Rings) -> Self {
        Batch {
            rings,
            vertices: [0; WINDOW],
            slices: [Slice { first: 0, class: 0 }; CLASSES],
            count: 0,
            slice_count: 0,
            scattered: false,
        }
    }

    /// Takes the vertices of a window.
    pub(crate) fn fill_window(&mut self, window: usize) {
        let start = window * WINDOW;
        let order = self.rings.window_order(window);
        self.count = order.len();
        for (vertex, offset) in self.vertices.iter_mut().zip(order) {
            *vertex = start as u32 + *offset as u32;
        }
        let slices = self.rings.window_slices(window);
        self.slice_count = slices.len();
        self.slices[..slices.len()].copy_from_slice(slices);
        self.scattered = self.rings.is_scattered(&self.vertices[..self.count]);
    }

    /// Takes at most [`WINDOW`] vertices of the caller's choice.
    ///
    /// # Panics
    /// Where one of them is no vertex, or there are more.
    pub(crate) fn fill_list(&mut self, list: &[u32]) {
        let mut codes = [0u8; WINDOW];
        let codes = &mut codes[..list.len()];
        for (code, &vertex) in codes.iter_mut().zip(list) {
            *code = self.rings.class(vertex as usize).code();
        }
        let Batch { vertices, slices, count, slice_count, .. } = self;
        (*count, *slice_count) = (list.len(), 0);
        bucket(
            codes,
            |place, index| vertices[place] = list[index],
            |slice| {
                slices[*slice_count] = slice;
                *slice_count += 1;
            },
        );
        self.scattered = self.rings.is_scattered(list);
    }

    /// How many classes occur.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.slice_count
    }

    /// The vertices of a class.
    #[inline(always)]
    pub(crate) fn get(&self, index: usize) -> Group<'r, '_> {
        let slices = &self.slices[..self.slice_count];
        let end = slices.get(index + 1).map_or(self.count, |next| next.first as usize);
        let vertices = &self.vertices[slices[index].first as usize..end];
        match RingClass::from_code(slices[index].class) {
            RingClass::Isolated => Group::Isolated(vertices),
            RingClass::Alone => Group::Alone(vertices),
            RingClass::Lanes { corners, closed } => {
                Group::Lanes(Block { rings: self.rings, vertices, corners, closed, scattered: self.scattered })
            }
        }
    }
}

/// Vertices of a table of rings, all of one fan of equally many corners.
#[derive(Clone, Copy)]
pub(crate) struct Block<'r, 'v> {
    rings: &'r Rings,
    vertices: &'v [u32],
    corners: usize,
    closed: bool,
    scattered: bool,
}

impl<'r, 'v> Block<'r, 'v> {
    /// The vertices.
    #[inline(always)]
    pub(crate) fn vertices(&self) -> &'v [u32] {
        self.vertices
    }
    /// The corners of each.
    #[inline(always)]
    pub(crate) fn corners(&self) -> usize {
        self.corners
    }
    /// Whether the last corner of each meets the first.
    #[inline(always)]
    pub(crate) fn closed(&self) -> bool {
        self.closed
    }
    /// The same vertices, at most `count` at a time.
    #[inline(always)]
    pub(crate) fn chunks(self, count: usize) -> impl Iterator<Item = Block<'r, 'v>> {
        self.vertices.chunks(count).map(move |vertices| Block { vertices, ..self })
    }

    /// Fetches the points of the neighbours into the cache where these lie all over the mesh, so that each would be waited for.
    #[inline(always)]
    pub(crate) fn prefetch<S: Coordinate>(&self, points: &StridedPoints<'_, S>) {
        if !self.scattered {
            return;
        }
        for &vertex in self.vertices {
            for &neighbour in &self.rings.ring(vertex as usize)[..self.corners] {
                points.prefetch(neighbour as usize);
            }
        }
    }

    /// The rings of up to `V::LANES` vertices, a vertex a lane; the lanes beyond repeat the first.
    ///
    /// # Panics
    /// Where there are more.
    #[inline(always)]
    pub(crate) fn lanes<V: Vector>(&self) -> Lanes<'r> {
        let vertices = self.vertices;
        assert!(!vertices.is_empty() && vertices.len() <= V::LANES);
        let mut centres = [vertices[0]; MAX_LANES];
        if vertices.len() == V::LANES {
            centres[..V::LANES].copy_from_slice(&vertices[..V::LANES]);
        } else {
            // Lane by lane: a copy of unknown length is a call, which forgets what stands in vector registers.
            #[expect(clippy::needless_range_loop)]
            for lane in 0..V::LANES {
                if let Some(&vertex) = vertices.get(lane) {
                    centres[lane] = vertex;
                }
            }
        }
        let mut starts = [0u32; MAX_LANES];
        for lane in 0..V::LANES {
            // SAFETY: a block's vertices have a ring in its table, and there is an offset more than there are rings.
            starts[lane] = unsafe { *self.rings.offsets().get_unchecked(centres[lane] as usize) };
        }
        Lanes { rings: self.rings, centres, starts, corners: self.corners, closed: self.closed }
    }
}

/// Some vertices of a block, gathered one by one.
pub(crate) struct Kept<'r> {
    vertices: [u32; WINDOW],
    count: usize,
    /// The class of all of them, without vertices.
    class: Option<Block<'r, 'static>>,
}

impl<'r> Kept<'r> {
    pub(crate) fn new() -> Self {
        Kept { vertices: [0; WINDOW], count: 0, class: None }
    }

    /// Starts anew, for vertices of the class of `block`.
    #[inline(always)]
    pub(crate) fn start(&mut self, block: Block<'r, '_>) {
        self.count = 0;
        self.class = Some(Block { vertices: &[], ..block });
    }

    /// Keeps those vertices of a block whose bit is set in `lanes`.
    ///
    /// # Panics
    /// Where the block is of another class, or there are more than [`WINDOW`] since the start.
    #[inline(always)]
    pub(crate) fn keep(&mut self, block: Block<'r, '_>, lanes: u32) {
        if lanes != 0 {
            self.keep_some(block, lanes);
        }
    }

    #[inline(never)]
    fn keep_some(&mut self, block: Block<'r, '_>, lanes: u32) {
        let same = self.class.is_some_and(|class| {
            std::ptr::eq(class.rings, block.rings) && (class.corners, class.closed) == (block.corners, block.closed)
        });
        assert!(same, "a vertex of another class");
        for (_, &vertex) in block.vertices.iter().enumerate().filter(|(lane, _)| lanes & 1 << lane != 0) {
            self.vertices[self.count] = vertex;
            self.count += 1;
        }
    }

    /// What was kept.
    ///
    /// # Panics
    /// Before the first start.
    #[inline(always)]
    pub(crate) fn block(&self) -> Block<'r, '_> {
        let class = self.class.expect("a start");
        Block { vertices: &self.vertices[..self.count], ..class }
    }
}

/// The rings of as many vertices as a vector has lanes.
pub(crate) struct Lanes<'r> {
    rings: &'r Rings,
    centres: [u32; MAX_LANES],
    starts: [u32; MAX_LANES],
    corners: usize,
    closed: bool,
}

impl Lanes<'_> {
    /// `edges[j]` becomes the vectors to the `j`-th neighbours, `j = 0 … corners`, and `squared[j]` their squared lengths; in a
    /// closed fan the last repeats the first. Answers with the smallest and the
    /// largest of `squared`.
    ///
    /// # Panics
    /// Where `points` are fewer than the vertices.
    #[inline(always)]
    pub(crate) fn load_edges<V: Vector, S: Coordinate>(
        &self,
        points: &StridedPoints<'_, S>,
        edges: &mut [Vector3<V>],
        squared: &mut [V],
    ) -> (V, V) {
        let (edges, squared) = (&mut edges[..self.corners + 1], &mut squared[..self.corners + 1]);
        let centre = points.known_lanes::<V>(self.rings, KnownVertices(self.centres));
        let (mut shortest, mut longest) = (V::splat(V::Scalar::INFINITY), V::zero());
        for slot in 0..self.slots() {
            let point = points.known_lanes::<V>(self.rings, self.neighbours::<V>(slot));
            let edge = point - centre;
            edges[slot] = edge;
            squared[slot] = edge.squared();
            (shortest, longest) = (squared[slot].min(shortest), squared[slot].max(longest));
        }
        if self.closed {
            edges[self.corners] = edges[0];
            squared[self.corners] = squared[0];
        }
        (shortest, longest)
    }

    /// As [`Lanes::load_edges`], but loads what `values` hold for the neighbours, and subtracts nothing.
    ///
    /// # Panics
    /// As [`Lanes::load_edges`].
    #[inline(always)]
    pub(crate) fn load_values<V: Vector, S: Coordinate>(
        &self,
        values: &StridedPoints<'_, S>,
        loaded: &mut [Vector3<V>],
    ) {
        let loaded = &mut loaded[..self.corners + 1];
        for (slot, loaded) in loaded.iter_mut().enumerate().take(self.slots()) {
            *loaded = values.known_lanes::<V>(self.rings, self.neighbours::<V>(slot));
        }
        if self.closed {
            loaded[self.corners] = loaded[0];
        }
    }

    /// What `values`, which are parallel to the flat ring array, hold for a corner of each vertex.
    ///
    /// # Panics
    /// Where there are not as many of them, or no such corner.
    #[inline(always)]
    pub(crate) fn load_entries<V: Vector>(&self, values: &[u32], corner: usize) -> [u32; MAX_LANES] {
        assert!(values.len() == self.rings.entry_count() && corner < self.corners);
        let mut loaded = [0u32; MAX_LANES];
        for (loaded, start) in loaded.iter_mut().zip(self.starts).take(V::LANES) {
            // SAFETY: the ring of a block's vertex lies inside the table, and `values` are as long.
            *loaded = unsafe { *values.get_unchecked(start as usize + corner) };
        }
        loaded
    }

    #[inline(always)]
    fn slots(&self) -> usize {
        self.corners + !self.closed as usize
    }

    /// The vertices of a slot.
    #[inline(always)]
    fn neighbours<V: Vector>(&self, slot: usize) -> KnownVertices {
        let mut indices = [0u32; MAX_LANES];
        for (index, start) in indices.iter_mut().zip(self.starts).take(V::LANES) {
            // SAFETY: a block's vertex was seen by `RingPart::seal` to have as many entries as it has slots.
            *index = unsafe { *self.rings.neighbours().get_unchecked(start as usize + slot) };
        }
        KnownVertices(indices)
    }
}

/// Vertices of a table of rings, none of them the last, in as many lanes as a vector has: what `RingPart::seal` has seen of a
/// vertex that is computed in lanes and of its neighbours.
pub(super) struct KnownVertices([u32; MAX_LANES]);

impl KnownVertices {
    #[inline(always)]
    pub(super) fn indices(&self) -> &[u32; MAX_LANES] {
        &self.0
    }
}
