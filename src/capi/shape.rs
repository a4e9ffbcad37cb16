//! Shape classes.

use super::guard::guard;
use super::status::{umb_error, umb_status};
use super::types::{umb_bytes, umb_points, umb_run, umb_scalars, umb_status_output};
use super::versioned::{check_reserved, read_required, read_versioned};
use crate::error::Error;
use crate::parts::{ShapeClass, shape_classes, shape_tolerance};
use std::mem::offset_of;

/// Shape class: nothing is known of the curvature.
pub const UMB_SHAPE_UNDEFINED: u8 = 0;
/// Convex in every direction, like a ball: H > 0, K > 0.
pub const UMB_SHAPE_PEAK: u8 = 1;
/// Convex in one direction and straight in the other, like a rod: H > 0, K = 0.
pub const UMB_SHAPE_RIDGE: u8 = 2;
/// A saddle that is more convex than concave: H > 0, K < 0.
pub const UMB_SHAPE_SADDLE_RIDGE: u8 = 3;
/// Not curved: H = 0, K = 0.
pub const UMB_SHAPE_FLAT: u8 = 4;
/// A saddle as convex as it is concave, like a minimal surface: H = 0, K < 0.
pub const UMB_SHAPE_MINIMAL: u8 = 5;
/// Concave in every direction, like a bowl: H < 0, K > 0.
pub const UMB_SHAPE_PIT: u8 = 6;
/// Concave in one direction and straight in the other, like a gutter: H < 0, K = 0.
pub const UMB_SHAPE_VALLEY: u8 = 7;
/// A saddle that is more concave than convex: H < 0, K < 0.
pub const UMB_SHAPE_SADDLE_VALLEY: u8 = 8;

const _: () = {
    assert!(UMB_SHAPE_UNDEFINED == ShapeClass::Undefined as u8 && UMB_SHAPE_PEAK == ShapeClass::Peak as u8);
    assert!(UMB_SHAPE_RIDGE == ShapeClass::Ridge as u8 && UMB_SHAPE_SADDLE_RIDGE == ShapeClass::SaddleRidge as u8);
    assert!(UMB_SHAPE_FLAT == ShapeClass::Flat as u8 && UMB_SHAPE_MINIMAL == ShapeClass::Minimal as u8);
    assert!(UMB_SHAPE_PIT == ShapeClass::Pit as u8 && UMB_SHAPE_VALLEY == ShapeClass::Valley as u8);
    assert!(UMB_SHAPE_SADDLE_VALLEY == ShapeClass::SaddleValley as u8);
};

/// How shapes are classified. All zero: with the default tolerance.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_shape_options {
    /// `sizeof(umb_shape_options)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// H counts as 0 up to this, and K up to its square; 1/length. 0 stands for `umb_shape_tolerance` of `points`; for none take a number that is tiny.
    pub tolerance: f64,
    /// Positions of which the default tolerance is taken, read only during the call; may be null if `tolerance` is not 0.
    pub points: *const umb_points,
    /// The status bytes of the curvatures, as many: isolated and degenerate vertices are undefined. May be none. (Adaptive jets without a
    /// solution write curvatures of 0 with `UMB_VERTEX_FALLBACK` and without `UMB_VERTEX_CREASE`, which this takes for flat.)
    pub status: umb_bytes,
    /// How to run; `vertices` must be null.
    pub run: umb_run,
}

/// A tolerance for `umb_shape_classes` that goes with the size of a mesh: one by the diagonal of the bounding box of all points (those without faces as well: a stray one far off makes it small), so that a
/// ball counts as curved up to a radius of the diagonal, and a cylinder up to half of that. 0 if the points are one or none. In 1/length. For
/// meshes with noise take two to four times as much.
///
/// @param points the positions of all vertices; read only during the call
/// @param tolerance receives the number
/// @param error may be null
///
/// Errors: `UMB_ERROR_NULL_POINTER`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT`, `_STRIDE`, `_MISALIGNED`, `_SIZE`, `_NON_FINITE` (element:
/// vertex).
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_shape_tolerance(
    points: *const umb_points,
    tolerance: *mut f64,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let points = read_required(points, "points")?.view()?;
            if tolerance.is_null() {
                return Err(Error::NullPointer { what: "tolerance" });
            }
            tolerance.write_unaligned(shape_tolerance(&points)?);
            Ok(())
        })
    }
}

/// Writes the shape class of each vertex (or face), a `UMB_SHAPE_` constant, from its principal curvatures: by the signs of
/// H = (k1 + k2)/2, which is 0 up to a tolerance t, and of K = k1 k2, which is 0 up to t^2 (Besl and Jain 1986, whose H has the other sign: here
/// it is positive where the surface bends away from its normal, as on a ball with outward normals).
///
/// Both comparisons are as if without rounding. Same bits on any number of threads. Koenderink's shape index and curvedness are outputs of
/// `umb_curvatures`.
///
/// @param k1 the principal curvatures, in either order
/// @param k2 likewise, as many, at the same place
/// @param options with a tolerance, or with points for the default
/// @param classes receives a byte for each of `k1`
/// @param error may be null
///
/// Errors: `UMB_ERROR_NULL_POINTER`, `_STRUCT_SIZE`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT`, `_STRIDE`, `_MISALIGNED`, `_SIZE`,
/// `_NON_FINITE` (element: vertex), `_OPTION_OUT_OF_RANGE`, `_CANCELLED`.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_shape_classes(
    k1: *const umb_scalars,
    k2: *const umb_scalars,
    options: *const umb_shape_options,
    classes: *const umb_status_output,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let (k1, k2) = (read_required(k1, "k1")?, read_required(k2, "k2")?);
            if k1.location != k2.location {
                return Err(Error::UnknownConstant { what: "k2.location", value: k2.location as u64 });
            }
            let (k1, k2) = (k1.view()?, k2.view()?);
            let options = read_versioned(options)?;
            check_reserved("umb_shape_options", offset_of!(umb_shape_options, reserved), options.reserved)?;
            options.run.check_no_list("umb_shape_options", offset_of!(umb_shape_options, run))?;
            let status = options.status.view("options.status")?;
            let classes = read_required(classes, "classes")?.view(k1.len())?;
            let classes = classes.ok_or(Error::NullPointer { what: "classes.data" })?;
            let tolerance = match options.tolerance {
                0.0 => shape_tolerance(&read_required(options.points, "options.points")?.view()?)?,
                tolerance => tolerance,
            };
            let mut progress = options.run.callback();
            let run = options.run.view(progress.as_mut().map(|call| call as _))?;
            shape_classes(&k1, &k2, status.as_ref(), tolerance, run, &classes)
        })
    }
}
