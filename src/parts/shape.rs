//! Shape classes of vertices, from the signs of mean and Gaussian curvature.
//!
//! Reference: P. J. Besl, R. C. Jain, "Invariant surface characteristics for 3D object recognition in range images", Computer Vision,
//! Graphics, and Image Processing 33 (1986). Their mean curvature has the other sign: here `H` is positive where the surface bends away
//! from its normal, as everywhere in this library.
//!
//! |         | `K > 0` | `K = 0` | `K < 0` |
//! |---------|---------|---------|---------|
//! | `H > 0` | peak    | ridge   | saddle ridge |
//! | `H = 0` |         | flat    | minimal |
//! | `H < 0` | pit     | valley  | saddle valley |
//!
//! `H = (k1 + k2) / 2` is zero where `|H| ≤ t`, and `K = k1 k2` where `|K| ≤ t²`, for a tolerance `t` in 1/length. The empty place of the
//! table cannot occur, since `K ≤ H²`.
//!
//! Numerical notes: both comparisons are made as if without rounding, the sum by its rounding error and the product in integers, so a
//! vertex is on one side of the tolerance or exactly on it, whatever the unit of length, and `K ≤ H²` holds here as well. A vertex
//! depends on nothing but itself. Cost: linear.

use crate::error::Error;
use crate::parallel::{Run, for_each_chunk};
use crate::topology::status;
use crate::view::{Bytes, Points, Scalars, StatusOutput};
use glam::DVec3;
use std::cmp::Ordering;

/// The class of a vertex, or of a face.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum ShapeClass {
    /// Nothing is known of the curvature.
    #[default]
    Undefined = 0,
    /// Convex in every direction, like a ball.
    Peak = 1,
    /// Convex in one direction and straight in the other, like a rod.
    Ridge = 2,
    /// A saddle that is more convex than concave.
    SaddleRidge = 3,
    /// Not curved.
    Flat = 4,
    /// A saddle as convex as it is concave, like a minimal surface.
    Minimal = 5,
    /// Concave in every direction, like a bowl.
    Pit = 6,
    /// Concave in one direction and straight in the other, like a gutter.
    Valley = 7,
    /// A saddle that is more concave than convex.
    SaddleValley = 8,
}

impl ShapeClass {
    /// Every class, each at the place of its number.
    pub const ALL: [ShapeClass; 9] = [
        ShapeClass::Undefined,
        ShapeClass::Peak,
        ShapeClass::Ridge,
        ShapeClass::SaddleRidge,
        ShapeClass::Flat,
        ShapeClass::Minimal,
        ShapeClass::Pit,
        ShapeClass::Valley,
        ShapeClass::SaddleValley,
    ];

    /// A name in lower case with dashes, for command lines and files.
    pub fn name(self) -> &'static str {
        match self {
            ShapeClass::Undefined => "undefined",
            ShapeClass::Peak => "peak",
            ShapeClass::Ridge => "ridge",
            ShapeClass::SaddleRidge => "saddle-ridge",
            ShapeClass::Flat => "flat",
            ShapeClass::Minimal => "minimal",
            ShapeClass::Pit => "pit",
            ShapeClass::Valley => "valley",
            ShapeClass::SaddleValley => "saddle-valley",
        }
    }

    /// The class of principal curvatures, in either order; undefined where one of them is no finite number.
    pub fn of(k1: f64, k2: f64, tolerance: f64) -> ShapeClass {
        if !k1.is_finite() || !k2.is_finite() {
            return ShapeClass::Undefined;
        }
        let curved = product_beyond(k1, k2, tolerance);
        match (mean_beyond(k1, k2, tolerance), curved && (k1 > 0.0) == (k2 > 0.0), curved) {
            (Ordering::Greater, true, _) => ShapeClass::Peak,
            (Ordering::Greater, _, false) => ShapeClass::Ridge,
            (Ordering::Greater, ..) => ShapeClass::SaddleRidge,
            (Ordering::Less, true, _) => ShapeClass::Pit,
            (Ordering::Less, _, false) => ShapeClass::Valley,
            (Ordering::Less, ..) => ShapeClass::SaddleValley,
            (Ordering::Equal, false, true) => ShapeClass::Minimal,
            (Ordering::Equal, ..) => ShapeClass::Flat,
        }
    }
}

/// What [`shape_tolerance`] multiplies one by the diagonal with: a ball counts as curved up to a radius of the diagonal, a cylinder up to half of
/// that. With 0.5 the rounding of meshes cut at random already makes saddles of cones; with 2 a cylinder as long as it is wide is flat, and
/// so are the ends of its fillets.
pub const SHAPE_TOLERANCE: f64 = 1.0;

/// A tolerance for [`shape_classes`] that goes with the size of a mesh: [`SHAPE_TOLERANCE`] by the diagonal of the bounding box of all
/// points; 0 if that is a point or empty.
///
/// # Errors
/// [`Error::NonFinitePosition`].
pub fn shape_tolerance(points: &Points<'_>) -> Result<f64, Error> {
    points.check_finite()?;
    let (mut low, mut high) = (DVec3::MAX, DVec3::MIN);
    for vertex in 0..points.len() {
        let point = points.get(vertex);
        (low, high) = (low.min(point), high.max(point));
    }
    if points.is_empty() || low == high {
        return Ok(0.0);
    }
    // In parts of the longest side, whose square can be anything.
    let sides = high * 0.5 - low * 0.5;
    let longest = sides.max_element();
    Ok((SHAPE_TOLERANCE / longest / (2.0 * (sides / longest).length())).min(f64::MAX))
}

/// Writes the number of the [`ShapeClass`] of each vertex, from its principal curvatures. Where `status` (that of
/// [`curvatures`](crate::curvatures)) says that a vertex is isolated or degenerate, it is undefined. [`Run::vertices`] is ignored.
///
/// # Errors
/// [`Error::OptionOutOfRange`] for a tolerance that is negative or not finite; [`Error::Size`] where counts are not the same;
/// [`Error::NonFiniteScalar`]; [`Error::Cancelled`].
pub fn shape_classes(
    k1: &Scalars<'_>,
    k2: &Scalars<'_>,
    status: Option<&Bytes<'_>>,
    tolerance: f64,
    mut run: Run<'_>,
    classes: &StatusOutput<'_>,
) -> Result<(), Error> {
    const CHUNK: usize = 4096;
    if !(0.0..f64::INFINITY).contains(&tolerance) {
        return Err(Error::OptionOutOfRange { what: "tolerance" });
    }
    let count = k1.len();
    for (what, found) in [("status.count", status.map(Bytes::len)), ("classes.count", Some(classes.len()))] {
        if let Some(found) = found.filter(|&found| found != count) {
            return Err(Error::Size { what, found: found as u64, expected: count as u64 });
        }
    }
    k1.check("k1", count)?;
    k2.check("k2", count)?;
    for_each_chunk(&mut run, count.div_ceil(CHUNK), |claims| {
        while let Some(chunk) = claims.next() {
            for vertex in chunk * CHUNK..count.min((chunk + 1) * CHUNK) {
                let unknown =
                    status.is_some_and(|bits| bits.get(vertex) & (status::ISOLATED | status::DEGENERATE) != 0);
                let class = match unknown {
                    true => ShapeClass::Undefined,
                    false => ShapeClass::of(k1.get(vertex), k2.get(vertex), tolerance),
                };
                classes.write(vertex, class as u8);
            }
        }
    })
}

/// Whether `(a + b) / 2` is greater than `tolerance`, less than minus that, or neither.
fn mean_beyond(a: f64, b: f64, tolerance: f64) -> Ordering {
    if !(a + b).is_finite() {
        // Both are so large that a quarter of them is exact.
        return mean_beyond(0.25 * a, 0.25 * b, 0.25 * tolerance);
    }
    let sum = a + b;
    // What rounding took from the sum, which is a number of this format as well.
    let part = sum - a;
    let rest = (a - (sum - part)) + (b - part);
    let limit = 2.0 * tolerance;
    if sum > limit || (sum == limit && rest > 0.0) {
        Ordering::Greater
    } else if sum < -limit || (sum == -limit && rest < 0.0) {
        Ordering::Less
    } else {
        Ordering::Equal
    }
}

/// Whether `|a b| > tolerance²`.
fn product_beyond(a: f64, b: f64, tolerance: f64) -> bool {
    let (found, limit) = (a.abs() * b.abs(), tolerance * tolerance);
    if found > 1e-280 && found < f64::INFINITY && limit < f64::INFINITY && (found - limit).abs() > 1e-15 * found {
        return found > limit;
    }
    let (found, found_exponent) = product(a, b);
    let (limit, limit_exponent) = product(tolerance, tolerance);
    if found == 0 || limit == 0 {
        return found > limit;
    }
    (found_exponent, found) > (limit_exponent, limit)
}

/// The product's magnitude, as an integer whose highest bit is set by a power of two.
fn product(a: f64, b: f64) -> (u128, i32) {
    let ((a, a_exponent), (b, b_exponent)) = (parts(a), parts(b));
    let product = a as u128 * b as u128;
    let shift = product.leading_zeros();
    (product.checked_shl(shift).unwrap_or(0), a_exponent + b_exponent - shift as i32)
}

/// A finite number's magnitude, as an integer by a power of two.
fn parts(x: f64) -> (u64, i32) {
    let (exponent, fraction) = ((x.to_bits() >> 52 & 0x7ff) as i32, x.to_bits() & ((1 << 52) - 1));
    if exponent == 0 { (fraction, 1) } else { (fraction | 1 << 52, exponent) }
}
