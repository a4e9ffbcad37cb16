//! Which edges of a mesh are creases: by the angle between their faces, marked by the caller, or between smoothing groups.
//!
//! Any of the three makes an edge a crease. An edge with one face, or with more than two, or whose two faces run through it in the same
//! direction, separates its faces in any case and is not asked about. A face without area has the normal of a neighbour across its longest
//! edge (`face_graph.rs`): else a sliver along a crease would join its sides.
//!
//! Numerical notes: unit normals are those of [`face_normals`](crate::face_normals), in `f64` and to its last digits; angles are compared by
//! the chord between the normals, which keeps its digits where the angle is small; equal to 1e-12 of its square is
//! not sharper. Cost: linear in the number of corners, and a bisection of the marked edges for each.

use crate::error::Error;
use crate::parallel::fill;
use crate::sweep::area_vector;
use crate::topology::{Adjacency, NO_CORNER};
use crate::view::{
    Coordinate, Faces, Index, Indices, PointArray, Points, StridedPoints, filled, room, with_indices, zeroed,
};
use glam::DVec3;

/// The largest angle between the normals of two faces that [`Creases::default`] takes for smooth: 30°.
pub const DEFAULT_CREASE_ANGLE: f64 = std::f64::consts::FRAC_PI_6;

/// Which edges are creases.
#[derive(Clone, Copy, Debug)]
pub struct Creases<'a> {
    /// An edge is a crease if the normals of its two faces differ by more than this, in radians; from π on none is.
    pub angle: f64,
    /// Pairs of vertices whose edges are creases, in any order and direction; pairs that no edge joins mean nothing.
    pub edges: &'a [[u32; 2]],
    /// A number for each face: the edge between two faces is a crease if theirs differ, or are 0 (as in OBJ files, where group 0
    /// is no group).
    pub groups: Option<&'a [u32]>,
}

impl Default for Creases<'_> {
    fn default() -> Self {
        Creases { angle: DEFAULT_CREASE_ANGLE, edges: &[], groups: None }
    }
}

impl Creases<'_> {
    /// Whether angles are compared, for which [`Creases::find`] takes normals.
    pub(crate) fn asks_for_angles(&self) -> bool {
        self.angle < std::f64::consts::PI
    }

    /// For each corner, 1 if the edge that starts there is a crease; 0 where its face meets no other across it. `normals` are those
    /// of the faces.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`] for an angle that is negative or no number; [`Error::Size`] for groups of another number
    /// than faces; [`Error::IndexOutOfRange`] for a marked edge; [`Error::OutOfMemory`].
    pub(crate) fn find(
        &self,
        faces: &Faces<'_>,
        vertex_count: usize,
        adjacency: &Adjacency,
        face_of: &[u32],
        normals: &[DVec3],
    ) -> Result<Vec<u8>, Error> {
        if self.angle.is_nan() || self.angle < 0.0 {
            return Err(Error::OptionOutOfRange { what: "creases.angle" });
        }
        if let Some(found) = self.groups.map(<[u32]>::len).filter(|&found| found != faces.len()) {
            return Err(Error::Size {
                what: "creases.group_count",
                found: found as u64,
                expected: faces.len() as u64,
            });
        }
        Indices::from(self.edges.as_flattened()).check_range("creases.edges", vertex_count)?;
        let mut creases: Vec<u8> = zeroed(face_of.len())?;
        if self.asks_for_angles() {
            let sharp = Sharp::than(self.angle);
            mark(&mut creases, adjacency, |corner, other| {
                sharp.is_between(normals[face_of[corner] as usize], normals[face_of[other] as usize])
            });
        }
        if let Some(groups) = self.groups {
            mark(&mut creases, adjacency, |corner, other| {
                let (one, two) = (groups[face_of[corner] as usize], groups[face_of[other] as usize]);
                one != two || one == 0
            });
        }
        if !self.edges.is_empty() {
            let mut marked: Vec<u64> = room(self.edges.len())?;
            marked.extend(self.edges.iter().map(|&[a, b]| key(a, b)));
            marked.sort_unstable();
            with_indices!(faces.indices(), indices => mark(&mut creases, adjacency, |corner, other| {
                // The other corner stands at the edge's other end.
                let (a, b) = (indices[corner].widen() as u32, indices[other].widen() as u32);
                marked.binary_search(&key(a, b)).is_ok()
            }));
        }
        Ok(creases)
    }
}

fn key(a: u32, b: u32) -> u64 {
    (a.min(b) as u64) << 32 | a.max(b) as u64
}

/// Marks both sides of the edges of which `is_crease(corner, opposite)` says so.
fn mark(creases: &mut [u8], adjacency: &Adjacency, is_crease: impl Fn(usize, usize) -> bool) {
    for corner in 0..creases.len() {
        let other = adjacency.opposite(corner);
        if other != NO_CORNER && corner < other as usize && is_crease(corner, other as usize) {
            (creases[corner], creases[other as usize]) = (1, 1);
        }
    }
}

/// The face of each corner.
pub(crate) fn faces_of_corners(faces: &Faces<'_>) -> Result<Vec<u32>, Error> {
    let mut face_of = filled(faces.indices().len(), 0)?;
    for face in 0..faces.len() {
        face_of[faces.range(face)].fill(face as u32);
    }
    Ok(face_of)
}

/// Unit face normals, by as many threads as `threads` asks for; zero where there is none.
pub(crate) fn unit_normals(faces: &Faces<'_>, points: &Points<'_>, threads: usize) -> Result<Vec<DVec3>, Error> {
    fn each<S: Coordinate, I: Index>(
        faces: &Faces<'_>,
        indices: &[I],
        points: &StridedPoints<'_, S>,
        threads: usize,
        normals: &mut [DVec3],
    ) {
        fill(threads, normals, |face| {
            let corners = &indices[faces.range(face)];
            let plain = match corners {
                &[a, b, c] => plain_normal([a, b, c].map(|corner| points.get(corner.widen() as usize))),
                _ => None,
            };
            plain.or_else(|| area_vector(points, corners).map(|found| found.normal)).unwrap_or(DVec3::ZERO)
        });
    }
    let mut normals = filled(faces.len(), DVec3::ZERO)?;
    with_indices!(faces.indices(), indices => match points.array() {
        PointArray::F32(points) => each(faces, indices, points, threads, &mut normals),
        PointArray::F64(points) => each(faces, indices, points, threads, &mut normals),
    });
    Ok(normals)
}

/// The unit normal of a triangle that is neither thin, large nor small, to a few units in the last place: the angle at its first
/// corner has a sine above 0.01, so its cross product keeps all but two digits.
#[inline(always)]
fn plain_normal([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    let (b, c) = (b - a, c - a);
    let cross = b.cross(c);
    let (squared, bound) = (cross.length_squared(), b.length_squared() * c.length_squared());
    (squared > 1e-4 * bound && squared > 1e-200 && bound < 1e200).then(|| cross / squared.sqrt())
}

/// Compares angles between unit vectors with a given one.
pub(crate) struct Sharp {
    /// The squared length of the difference of two unit vectors at that angle, and a little more.
    chord_squared: f64,
}

impl Sharp {
    pub fn than(angle: f64) -> Self {
        let chord = 2.0 * libm::sin(0.5 * angle.min(std::f64::consts::PI));
        // Faces of a box meet at right angles, whatever the last digit says.
        Sharp { chord_squared: chord * chord * (1.0 + 1e-12) }
    }

    /// Whether the angle between them is larger; not if one of them is zero.
    #[inline(always)]
    pub fn is_between(&self, a: DVec3, b: DVec3) -> bool {
        a != DVec3::ZERO && b != DVec3::ZERO && (a - b).length_squared() > self.chord_squared
    }
}
