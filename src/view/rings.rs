//! The one-rings of all vertices in one flat array, sorted for the sweep, and the loader that turns a block of them into
//! lanes of edges.
//!
//! The table is checked when it is made and never changes. That is what lets [`Rings::load_edges`] read positions
//! without a bounds check per neighbour, and packed ones with loads that run one scalar past the third coordinate: a
//! vertex gets a [`RingClass`] for lanes only if its ring lies inside the table and holds no index that a wide load could
//! carry past the caller's buffer (that is, not the last vertex's).

use super::points::{Coordinate, StridedPoints, gather_converted};
use crate::simd::{MAX_LANES, Vector, Vector3};
use std::any::TypeId;

/// Rings of more corners than this go vertex by vertex.
pub(crate) const MAX_LANE_CORNERS: usize = 16;

/// Vertices are sorted by class inside windows of this many, so that lanes fill up while memory stays local.
pub(crate) const WINDOW: usize = 2048;

/// How the sweep treats a vertex.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum RingClass {
    /// No face: nothing to compute.
    Isolated,
    /// One fan of `corners` corners, computed in lanes with others of the same class.
    Lanes {
        /// Corners of the fan, at most [`MAX_LANE_CORNERS`].
        corners: usize,
        /// Whether the last corner meets the first.
        closed: bool,
    },
    /// Several fans, a large one, or one that touches the last vertex: computed alone.
    Alone,
}

/// Up to [`WINDOW`] vertices, sorted by class.
pub(crate) struct Batch {
    vertices: [u32; WINDOW],
    slices: [Slice; CLASSES],
    count: usize,
    slice_count: usize,
    scattered: bool,
}

impl Batch {
    pub(crate) fn new() -> Self {
        Batch {
            vertices: [0; WINDOW],
            slices: [Slice { first: 0, class: 0 }; CLASSES],
            count: 0,
            slice_count: 0,
            scattered: false,
        }
    }

    /// How many classes occur.
    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.slice_count
    }

    /// Whether the neighbours lie all over the mesh, so that each is a cache miss.
    #[inline(always)]
    pub(crate) fn is_scattered(&self) -> bool {
        self.scattered
    }

    /// A class and its vertices.
    #[inline(always)]
    pub(crate) fn get(&self, index: usize) -> (RingClass, &[u32]) {
        let slices = &self.slices[..self.slice_count];
        let end = slices.get(index + 1).map_or(self.count, |next| next.first as usize);
        (RingClass::from_code(slices[index].class), &self.vertices[slices[index].first as usize..end])
    }
}

pub(super) const CLASSES: usize = 2 * MAX_LANE_CORNERS + 2;
const ALONE: u8 = CLASSES as u8 - 1;

impl RingClass {
    #[inline(always)]
    pub(super) fn code(self) -> u8 {
        match self {
            RingClass::Isolated => 0,
            RingClass::Lanes { corners, closed } => {
                assert!((1..=MAX_LANE_CORNERS).contains(&corners));
                (2 * corners - closed as usize) as u8
            }
            RingClass::Alone => ALONE,
        }
    }

    fn from_code(code: u8) -> Self {
        match code {
            0 => RingClass::Isolated,
            ALONE => RingClass::Alone,
            code => RingClass::Lanes { corners: (code as usize).div_ceil(2), closed: code % 2 == 1 },
        }
    }
}

/// A run of vertices of one class in a window's order.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slice {
    /// The first, counted from the window's start.
    first: u16,
    class: u8,
}

/// Flat one-rings: vertex `v` has the neighbours `neighbours[offsets[v]..offsets[v + 1]]`, fan after fan, each
/// counter-clockwise. A fan of `k` corners has `k` neighbours if it is closed and `k + 1` if it is open.
#[derive(Debug)]
pub(crate) struct Rings {
    offsets: Vec<u32>,
    neighbours: Vec<u32>,
    /// [`RingClass::code`] of each vertex.
    classes: Vec<u8>,
    /// Window after window, the vertices by class, counted from the window's start.
    order: Vec<u16>,
    slices: Vec<Slice>,
    /// Where each window's slices start, and the end of the last.
    window_slices: Vec<u32>,
}

impl Rings {
    /// Takes over what a [`RingTable`](super::RingTable) has checked.
    pub(super) fn from_table(
        offsets: Vec<u32>,
        neighbours: Vec<u32>,
        classes: Vec<u8>,
        order: Vec<u16>,
        mut slices: Vec<Slice>,
        window_slices: Vec<u32>,
    ) -> Self {
        assert!(offsets.len() == classes.len() + 1 && offsets[classes.len()] as usize == neighbours.len());
        slices.shrink_to_fit();
        Rings { offsets, neighbours, classes, order, slices, window_slices }
    }

    /// The vertices of [`RingClass::Alone`], in order.
    pub(crate) fn alone(&self) -> impl Iterator<Item = usize> {
        const CHUNK: usize = 64;
        let chunks = self.classes.chunks(CHUNK).enumerate();
        let some = chunks.filter(|(_, codes)| codes.iter().fold(false, |some, &code| some | (code == ALONE)));
        some.flat_map(|(chunk, codes)| {
            let alone = codes.iter().enumerate().filter(|(_, code)| **code == ALONE);
            alone.map(move |(index, _)| chunk * CHUNK + index)
        })
    }

    pub(crate) fn vertex_count(&self) -> usize {
        self.classes.len()
    }

    /// The flat array.
    pub(crate) fn neighbours(&self) -> &[u32] {
        &self.neighbours
    }

    /// Where each ring starts in the flat array, and the end of the last.
    pub(crate) fn offsets(&self) -> &[u32] {
        &self.offsets
    }

    /// All neighbours of a vertex, fan after fan.
    #[inline(always)]
    pub(crate) fn ring(&self, vertex: usize) -> &[u32] {
        &self.neighbours[self.ring_range(vertex)]
    }

    /// Where [`Rings::ring`] stands in the flat array.
    #[inline(always)]
    pub(crate) fn ring_range(&self, vertex: usize) -> std::ops::Range<usize> {
        self.offsets[vertex] as usize..self.offsets[vertex + 1] as usize
    }

    /// The length of the flat array.
    pub(crate) fn entry_count(&self) -> usize {
        self.neighbours.len()
    }

    pub(crate) fn class(&self, vertex: usize) -> RingClass {
        RingClass::from_code(self.classes[vertex])
    }

    /// Heap memory held, in bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.offsets.capacity() * 4
            + self.neighbours.capacity() * 4
            + self.classes.capacity()
            + self.order.capacity() * 2
            + self.slices.capacity() * size_of::<Slice>()
            + self.window_slices.capacity() * 4
    }

    /// How many windows the vertices fill.
    pub(crate) fn windows(&self) -> usize {
        self.window_slices.len() - 1
    }

    /// Puts the vertices of a window into `batch`.
    pub(crate) fn fill_window(&self, window: usize, batch: &mut Batch) {
        let start = window * WINDOW;
        let codes = &self.classes[start..self.classes.len().min(start + WINDOW)];
        batch.count = codes.len();
        for (vertex, offset) in batch.vertices.iter_mut().zip(&self.order[start..][..codes.len()]) {
            *vertex = start as u32 + *offset as u32;
        }
        let slices = &self.slices[self.window_slices[window] as usize..self.window_slices[window + 1] as usize];
        batch.slice_count = slices.len();
        batch.slices[..slices.len()].copy_from_slice(slices);
        batch.scattered = self.is_scattered(&batch.vertices[..batch.count]);
    }

    /// Whether the rings of vertices that follow each other start far from each other, in a sample.
    fn is_scattered(&self, vertices: &[u32]) -> bool {
        const SAMPLE: usize = 16;
        const FAR: u32 = 4096;
        let step = vertices.len() / SAMPLE;
        if step < 2 {
            return false;
        }
        let first = |vertex: u32| self.ring(vertex as usize).first().copied().unwrap_or(vertex);
        let far = |pair: &[u32]| first(pair[0]).abs_diff(first(pair[1])) > FAR;
        vertices.chunks_exact(step).filter(|chunk| far(&chunk[..2])).count() > SAMPLE / 2
    }

    /// Fetches the points of the neighbours of some vertices of a class of `corners` corners into the cache.
    #[inline(always)]
    pub(crate) fn prefetch<S: Coordinate>(&self, points: &StridedPoints<'_, S>, vertices: &[u32], corners: usize) {
        for &vertex in vertices {
            for &neighbour in &self.ring(vertex as usize)[..corners] {
                points.prefetch(neighbour as usize);
            }
        }
    }

    /// As [`Rings::fill_window`] for at most [`WINDOW`] vertices of the caller's choice.
    ///
    /// # Panics
    /// Where one of them is no vertex, or there are more.
    pub(crate) fn fill_list(&self, list: &[u32], batch: &mut Batch) {
        let mut codes = [0u8; WINDOW];
        let codes = &mut codes[..list.len()];
        for (code, &vertex) in codes.iter_mut().zip(list) {
            *code = self.classes[vertex as usize];
        }
        let Batch { vertices, slices, count, slice_count, .. } = batch;
        (*count, *slice_count) = (list.len(), 0);
        bucket(
            codes,
            |place, index| vertices[place] = list[index],
            |slice| {
                slices[*slice_count] = slice;
                *slice_count += 1;
            },
        );
        batch.scattered = self.is_scattered(list);
    }

    /// Loads the edges from up to `V::LANES` vertices of one class to their neighbours, lane by lane.
    ///
    /// `edges[j]` becomes the vectors to the `j`-th neighbours, `j = 0 … corners`; in a closed fan the last repeats the
    /// first. The lanes beyond `vertices` repeat its first.
    ///
    /// # Panics
    /// Where a vertex is not of the class `Lanes { corners, closed }`, or `points` are fewer than the vertices.
    #[inline(always)]
    pub(crate) fn load_edges<V: Vector, S: Coordinate>(
        &self,
        points: &StridedPoints<'_, S>,
        vertices: &[u32],
        corners: usize,
        closed: bool,
        edges: &mut [Vector3<V>],
    ) {
        self.load::<true, V, S>(points, vertices, corners, closed, edges);
    }

    /// As [`Rings::load_edges`], but loads what `values` hold for the neighbours, and subtracts nothing.
    ///
    /// # Panics
    /// As [`Rings::load_edges`].
    #[inline(always)]
    pub(crate) fn load_values<V: Vector, S: Coordinate>(
        &self,
        values: &StridedPoints<'_, S>,
        vertices: &[u32],
        corners: usize,
        closed: bool,
        loaded: &mut [Vector3<V>],
    ) {
        self.load::<false, V, S>(values, vertices, corners, closed, loaded);
    }

    #[inline(always)]
    fn load<const RELATIVE: bool, V: Vector, S: Coordinate>(
        &self,
        points: &StridedPoints<'_, S>,
        vertices: &[u32],
        corners: usize,
        closed: bool,
        edges: &mut [Vector3<V>],
    ) {
        assert!(points.len() >= self.vertex_count() && !vertices.is_empty() && vertices.len() <= V::LANES);
        let class = RingClass::Lanes { corners, closed }.code();
        let edges = &mut edges[..corners + 1];
        let mut centres = [vertices[0]; MAX_LANES];
        // Lane by lane: a copy of unknown length is a call, which forgets what stands in vector registers.
        #[expect(clippy::needless_range_loop)]
        for lane in 0..V::LANES {
            if let Some(&vertex) = vertices.get(lane) {
                centres[lane] = vertex;
            }
        }
        let mut starts = [0u32; MAX_LANES];
        let mut differing = 0;
        for lane in 0..V::LANES {
            let vertex = centres[lane] as usize;
            differing |= self.classes[vertex] ^ class;
            // SAFETY: `from_table` has seen one offset more than there are classes, and this vertex has a class.
            starts[lane] = unsafe { *self.offsets.get_unchecked(vertex) };
        }
        assert_eq!(differing, 0, "a vertex of another class");
        let neighbours = &mut edges[..corners + !closed as usize];
        // SAFETY: each of these vertices was seen by `RingPart::seal` to be of this class: the vertex itself and its neighbours, as
        // many as there are edges, are inside the tables and are vertices other than the last.
        unsafe {
            if points.is_packed() {
                self.load_neighbours::<RELATIVE, true, V, S>(points, &centres, &starts, neighbours);
            } else {
                self.load_neighbours::<RELATIVE, false, V, S>(points, &centres, &starts, neighbours);
            }
        }
        if closed {
            edges[corners] = edges[0];
        }
    }

    /// # Safety
    /// In each lane, `centres` and the entries of the ring table from `starts` on, one for each edge, are points other
    /// than the last; if `WIDE`, points are packed.
    #[inline(always)]
    unsafe fn load_neighbours<const RELATIVE: bool, const WIDE: bool, V: Vector, S: Coordinate>(
        &self,
        points: &StridedPoints<'_, S>,
        centres: &[u32; MAX_LANES],
        starts: &[u32; MAX_LANES],
        edges: &mut [Vector3<V>],
    ) {
        // SAFETY: handed on.
        unsafe {
            let centre = gather::<WIDE, V, S>(points, centres);
            for (slot, edge) in edges.iter_mut().enumerate() {
                let mut indices = [0u32; MAX_LANES];
                for lane in 0..V::LANES {
                    indices[lane] = *self.neighbours.get_unchecked(starts[lane] as usize + slot);
                }
                let point = gather::<WIDE, V, S>(points, &indices);
                *edge = if RELATIVE { point - centre } else { point };
            }
        }
    }

    /// The vectors from a vertex to `ring`, each point multiplied by `factor` first, in `f64`.
    pub(crate) fn edges_of<S: Coordinate>(
        points: &StridedPoints<'_, S>,
        vertex: usize,
        ring: &[u32],
        factor: f64,
    ) -> impl Iterator<Item = Vector3<f64>> {
        let centre = points.get(vertex) * factor;
        ring.iter().map(move |&neighbour| {
            let edge = points.get(neighbour as usize) * factor - centre;
            Vector3 { x: edge.x, y: edge.y, z: edge.z }
        })
    }
}

/// # Safety
/// As [`Vector::gather`], for the points' scalar.
#[inline(always)]
unsafe fn gather<const WIDE: bool, V: Vector, S: Coordinate>(
    points: &StridedPoints<'_, S>,
    indices: &[u32; MAX_LANES],
) -> Vector3<V> {
    if TypeId::of::<V::Scalar>() == TypeId::of::<S>() {
        // SAFETY: handed on; the lanes are of the points' own scalar.
        unsafe { V::gather::<WIDE>(points.base(), points.stride(), indices) }
    } else {
        gather_converted(points, indices)
    }
}

/// Counting sort by class: `place(position, index)` for every index, and `open` for each class that occurs.
#[inline(always)]
pub(super) fn bucket(codes: &[u8], mut place: impl FnMut(usize, usize), mut open: impl FnMut(Slice)) {
    // Often all are of one class.
    if let Some(&class) = codes.first().filter(|first| codes.iter().fold(true, |same, code| same & (code == *first)))
    {
        open(Slice { first: 0, class });
        return (0..codes.len()).for_each(|index| place(index, index));
    }
    let mut starts = [0usize; CLASSES];
    for &code in codes {
        starts[code as usize] += 1;
    }
    let mut position = 0;
    for (class, start) in starts.iter_mut().enumerate() {
        let count = std::mem::replace(start, position);
        if count > 0 {
            open(Slice { first: position as u16, class: class as u8 });
        }
        position += count;
    }
    for (index, &code) in codes.iter().enumerate() {
        let start = &mut starts[code as usize];
        place(*start, index);
        *start += 1;
    }
}
