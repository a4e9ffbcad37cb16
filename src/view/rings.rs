//! The one-rings of all vertices in one flat array, sorted for the sweep.
//!
//! The table is checked when it is made and never changes: a vertex gets a [`RingClass`] for lanes only if its ring lies inside
//! the table and holds no index that a wide load could carry past the caller's buffer (that is, not the last vertex's).

use super::points::{Coordinate, StridedPoints};
use crate::simd::Vector3;

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

    pub(super) fn from_code(code: u8) -> Self {
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
    pub(super) first: u16,
    pub(super) class: u8,
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

    /// Where the rings of a window stand in the flat array.
    pub(crate) fn window_entries(&self, window: usize) -> std::ops::Range<usize> {
        let start = window * WINDOW;
        let end = self.vertex_count().min(start + WINDOW);
        self.offsets[start] as usize..self.offsets[end] as usize
    }

    /// The vertices of a window by class, counted from the window's start.
    pub(super) fn window_order(&self, window: usize) -> &[u16] {
        let start = window * WINDOW;
        &self.order[start..self.order.len().min(start + WINDOW)]
    }

    /// The classes of a window.
    pub(super) fn window_slices(&self, window: usize) -> &[Slice] {
        &self.slices[self.window_slices[window] as usize..self.window_slices[window + 1] as usize]
    }

    /// Whether the rings of vertices that follow each other start far from each other, in a sample.
    pub(super) fn is_scattered(&self, vertices: &[u32]) -> bool {
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
