//! Unit normals and sizes of polygons as rows of four scalars, which a vertex loads like a position.
//!
//! A row is the unit normal and the square root of the area, negative if the face is a triangle, whose corners only rounding
//! could turn. Zeros stand for a face without normal, and in double precision NaN for one that only the vertex-by-vertex path
//! can tell.
//!
//! The area vector of a quadrilateral is `½ (ab × bc + dc × ad)`, at its second and fourth corner: the angles there are those of
//! the quadrilateral however long it is, where those at a diagonal are needles. A triangle is a quadrilateral whose first and
//! fourth corner are its last, so that its sum is that of a mesh of triangles. Polygons of more corners are fans, as in `frames.rs`.
//!
//! In single precision, a face whose sum has cancelled is computed again in double precision. Lanes are faces. Rows are made
//! for a window of vertices just before these use them, so that they stay in the cache ([`Nearby`]), or where they are met, if
//! the faces of the window lie far apart. A row depends on its face alone.

use super::frames::{Asked, CANCELLED, frame};
use crate::error::Error;
use crate::simd::{MAX_LANES, Mask, Real, Vector, Vector3};
use crate::topology::{NO_FACE, Polygons};
use crate::view::{Coordinate, Lanes, StridedPoints, Zero, gather_rows, scatter_rows, zeroed};
use std::sync::{Mutex, PoisonError};

/// Faces of more corners than this are computed alone.
const MOST_CORNERS: usize = 16;

/// How many faces [`Nearby`] holds, a power of two.
const HELD: usize = 8192;
/// So many are computed together.
const BLOCK: usize = 64;

/// The faces of a mesh.
#[derive(Clone, Copy)]
pub(super) struct Planes<'a, P> {
    pub points: &'a StridedPoints<'a, P>,
    pub polygons: &'a Polygons,
    /// What [`large_faces`] has found, or nothing.
    pub large: &'a [LargeFace],
}

/// A face that is computed alone, and its row.
pub(super) type LargeFace = (u32, [f64; 4]);

/// The faces of more than [`MOST_CORNERS`] corners, each computed once: where it is met, it would be by each of its vertices.
///
/// # Errors
/// [`Error::OutOfMemory`].
pub(super) fn large_faces<P: Coordinate>(
    points: &StridedPoints<'_, P>,
    polygons: &Polygons,
) -> Result<Vec<LargeFace>, Error> {
    let mut large = Vec::new();
    if polygons.most_corners() > MOST_CORNERS {
        let planes = Planes { points, polygons, large: &[] };
        for face in 0..polygons.face_count() {
            if polygons.face(face).len() > MOST_CORNERS {
                large.try_reserve(1)?;
                large.push((face as u32, planes.one(face as u32)));
            }
        }
    }
    Ok(large)
}

/// A thread's rows of the faces around a window of vertices: face `f` stands at `f` modulo [`HELD`].
pub(super) struct Nearby<S> {
    rows: Vec<[S; 4]>,
    /// Which block of faces stands in each place, plus one; 0 for none.
    blocks: [u32; HELD / BLOCK],
    /// Whether the faces of the window at hand are here.
    ready: bool,
}

impl<S: Zero> Nearby<S> {
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn new() -> Result<Self, Error> {
        Ok(Nearby { rows: zeroed(HELD)?, blocks: [0; HELD / BLOCK], ready: false })
    }
}

impl<S: Real> Nearby<S> {
    /// One of them; if there is none, faces are computed where they are met.
    pub fn take(all: &Mutex<Vec<Self>>) -> Self {
        let one = all.lock().unwrap_or_else(PoisonError::into_inner).pop();
        one.unwrap_or(Nearby { rows: Vec::new(), blocks: [0; HELD / BLOCK], ready: false })
    }

    /// Makes the faces at a stretch of the flat ring array ready, unless these lie far apart.
    #[inline(always)]
    pub fn fill<P: Coordinate, V: Vector<Scalar = S>>(
        &mut self,
        planes: Planes<'_, P>,
        entries: std::ops::Range<usize>,
    ) {
        self.ready = false;
        if self.rows.is_empty() {
            return;
        }
        // One more than the largest, of which `NO_FACE` is 0.
        const { assert!(NO_FACE == u32::MAX) };
        let (mut first, mut end) = (u32::MAX, 0u32);
        for &face in planes.polygons.corner_faces(entries) {
            first = first.min(face);
            end = end.max(face.wrapping_add(1));
        }
        if first >= end || (end - first) as usize > HELD - 2 * BLOCK {
            return;
        }
        let faces = planes.polygons.face_count();
        for block in first as usize / BLOCK..(end as usize).div_ceil(BLOCK) {
            let place = block % (HELD / BLOCK);
            if self.blocks[place] != block as u32 + 1 {
                self.blocks[place] = block as u32 + 1;
                let start = block * BLOCK;
                for face in (start..faces.min(start + BLOCK)).step_by(V::LANES) {
                    let mut indices = [face as u32; MAX_LANES];
                    for (lane, index) in indices.iter_mut().enumerate().take(V::LANES) {
                        *index = (face + lane).min(faces - 1) as u32;
                    }
                    let rows = planes.rows::<V>(&indices);
                    scatter_rows(&mut self.rows, &places(indices), rows);
                }
            }
        }
        self.ready = true;
    }
}

/// Where faces stand in [`Nearby::rows`].
#[inline(always)]
fn places(mut faces: [u32; MAX_LANES]) -> [u32; MAX_LANES] {
    for face in &mut faces {
        *face %= HELD as u32;
    }
    faces
}

impl<P: Coordinate> Planes<'_, P> {
    /// The rows of the faces at a corner of each vertex.
    #[inline(always)]
    pub fn load<V: Vector>(&self, nearby: &Nearby<V::Scalar>, lanes: &Lanes<'_>, corner: usize) -> [V; 4] {
        let faces = lanes.load_entries::<V>(self.polygons.all_corner_faces(), corner);
        if nearby.ready { gather_rows(&nearby.rows, &places(faces)) } else { self.rows::<V>(&faces) }
    }

    /// The rows of any faces, a face a lane.
    #[inline(always)]
    fn rows<V: Vector>(&self, faces: &[u32; MAX_LANES]) -> [V; 4] {
        let offsets = self.polygons.offsets();
        let (mut starts, mut counts) = ([0u32; MAX_LANES], [3u32; MAX_LANES]);
        let (mut small, mut special) = (true, 0);
        for lane in 0..V::LANES {
            let face = faces[lane] as usize;
            let (start, end) = (offsets[face], offsets[face + 1]);
            // A face that is none or has too many corners is computed alone; its lane has the first corners of the mesh.
            if (3..=MOST_CORNERS as u32).contains(&(end - start)) {
                (starts[lane], counts[lane]) = (start, end - start);
            } else {
                special |= 1 << lane;
            }
            small &= counts[lane] <= 4;
        }
        let corner = |corner: u32| {
            let vertices = self.polygons.vertices();
            let mut indices = [0u32; MAX_LANES];
            for lane in 0..V::LANES {
                // A triangle starts at its last corner, and ends there; another polygon's corners beyond the last are the last.
                let count = counts[lane];
                let corner = if count == 3 { (corner + 2) % 3 } else { corner.min(count - 1) };
                indices[lane] = vertices[(starts[lane] + corner) as usize];
            }
            self.points.lanes::<V>(&indices)
        };
        let (mut row, mut doubt) = quadrilateral(corner(0), corner(1), corner(2), corner(3));
        if !small {
            let most = counts[..V::LANES].iter().fold(0, |most, &count| most.max(count));
            let (others, doubtful) = fan(&corner, most);
            let mut sizes = [V::Scalar::ZERO; MAX_LANES];
            for lane in 0..V::LANES {
                sizes[lane] = V::Scalar::from_f64(counts[lane].into());
            }
            let larger = V::constant(4.0).lt(V::from_lanes(&sizes));
            for (word, other) in row.iter_mut().zip(others) {
                *word = V::select(larger, other, *word);
            }
            doubt = doubt & !larger.bits() | doubtful & larger.bits();
        }
        let alone = special | if V::Scalar::SINGLE { doubt & V::ALL } else { 0 };
        if alone != 0 {
            self.alone(faces, alone, &mut row);
        }
        row
    }

    /// Puts those faces into `row` whose bit is set in `lanes`, each in double precision, corner by corner.
    #[inline(always)]
    fn alone<V: Vector>(&self, faces: &[u32; MAX_LANES], lanes: u32, row: &mut [V; 4]) {
        let mut words = [row[0].to_lanes(), row[1].to_lanes(), row[2].to_lanes(), row[3].to_lanes()];
        for lane in 0..V::LANES {
            if lanes & 1 << lane != 0 {
                let numbers = self.one(faces[lane]);
                for (word, x) in words.iter_mut().zip(numbers) {
                    word[lane] = V::Scalar::from_f64(x);
                }
            }
        }
        for (word, lanes) in row.iter_mut().zip(&words) {
            *word = V::from_lanes(lanes);
        }
    }

    #[inline(never)]
    fn one(&self, face: u32) -> [f64; 4] {
        if let Ok(index) = self.large.binary_search_by_key(&face, |(face, _)| *face) {
            return self.large[index].1;
        }
        let found = frame(self.points, self.polygons.face(face as usize), Asked::default());
        [found.normal.x, found.normal.y, found.normal.z, if found.may_turn { found.size } else { -found.size }]
    }
}

/// The row of a quadrilateral, and a bit for each lane whose sum has cancelled. A fourth corner at the place of the first makes
/// it a triangle.
#[inline(always)]
fn quadrilateral<V: Vector>(a: Vector3<V>, b: Vector3<V>, c: Vector3<V>, d: Vector3<V>) -> ([V; 4], u32) {
    let (ab, bc, dc, ad) = (b - a, c - b, c - d, d - a);
    let last = ad.largest_component();
    let turns = V::select(V::zero().lt(last), V::one(), -V::one());
    let extent = ab.largest_component().max(bc.largest_component()).max(dc.largest_component()).max(last);
    let scale = extent.unit_scale();
    let mut sum = (Vector3::zero(), V::zero());
    add(&mut sum, ab * scale, bc * scale);
    add(&mut sum, dc * scale, ad * scale);
    finish(sum, scale, turns)
}

/// The row of polygons of at most `count` corners; `corner` repeats the last beyond it.
#[inline(always)]
fn fan<V: Vector>(corner: &impl Fn(u32) -> Vector3<V>, count: u32) -> ([V; 4], u32) {
    let mut edges = [Vector3::zero(); MOST_CORNERS];
    let (origin, mut extent) = (corner(0), V::zero());
    for index in 1..count {
        let edge = corner(index) - origin;
        extent = edge.largest_component().max(extent);
        edges[index as usize] = edge;
    }
    let scale = extent.unit_scale();
    let mut sum = (Vector3::zero(), V::zero());
    for index in 2..count as usize {
        add(&mut sum, edges[index - 1] * scale, edges[index] * scale);
    }
    finish(sum, scale, V::one())
}

/// Adds `a × b`, and the square of what rounding may take part in.
#[inline(always)]
fn add<V: Vector>((twice, squares): &mut (Vector3<V>, V), a: Vector3<V>, b: Vector3<V>) {
    let cross = a.cross(b);
    *twice = *twice + cross;
    // In single precision a cross product has lost what its edges' lengths say, however short it is itself.
    *squares = *squares + if V::Scalar::SINGLE { a.squared() * b.squared() } else { cross.squared() };
}

/// A row from twice the area vector, in units of which `scale` make one of the mesh; `turns` is −1 for a triangle.
#[inline(always)]
fn finish<V: Vector>((twice, squares): (Vector3<V>, V), scale: V, turns: V) -> ([V; 4], u32) {
    let single = V::Scalar::SINGLE;
    let squared = twice.squared();
    let least = if single { 1.0 / 64.0 } else { CANCELLED * CANCELLED };
    let clear = (squares * V::constant(least)).lt(squared);
    let defined = V::splat(V::Scalar::TINY).lt(squared);
    let length = squared.sqrt();
    let inverse = V::one() / V::select(defined, length, V::one());
    let size = (length * V::constant(0.5)).sqrt() / scale * turns;
    let normal = twice * inverse;
    if single {
        return ([normal.x, normal.y, normal.z, size], !clear.and(defined).bits());
    }
    // Not a number where the square has left the range, or an edge has; zero where the sum has cancelled or is zero.
    let known = defined.and(squared.lt(V::splat(V::Scalar::INFINITY)));
    let cancelled = V::select(known, V::zero(), V::constant(f64::NAN));
    let other = V::select(V::zero().lt(twice.largest_component()), cancelled, twice.x * V::zero());
    let word = |x: V| V::select(clear.and(known), x, other);
    ([word(normal.x), word(normal.y), word(normal.z), word(size)], 0)
}
