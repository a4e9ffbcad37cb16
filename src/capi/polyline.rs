//! Curvatures of polylines.

use super::guard::guard;
use super::status::{umb_error, umb_status};
use super::types::{UMB_SCALAR_F32, UMB_SCALAR_F64, umb_output, umb_run, umb_scalar, umb_status_output};
use super::versioned::{check_reserved, read_required, read_versioned, required};
use crate::curvature::{PolylineOutputs, polyline_curvatures};
use crate::error::Error;
use crate::view::PolylinePoints;
use libc::{c_void, size_t};
use std::mem::offset_of;

/// Bit of a polyline's status: an end of an open polyline; its curvatures are 0.
pub const UMB_POLYLINE_END: u8 = 1;
/// Bit of a polyline's status: a cusp, the next point lies exactly on the side of the previous one.
pub const UMB_POLYLINE_CUSP: u8 = 2;
/// Bit of a polyline's status: the point next to the vertex, before or after it, coincides with it. The nearest one
/// along the polyline that does not took its place; if there is none, the curvatures are 0.
pub const UMB_POLYLINE_COINCIDENT: u8 = 4;

const _: () = {
    use crate::curvature::polyline_status as status;
    assert!(UMB_POLYLINE_END == status::END && UMB_POLYLINE_CUSP == status::CUSP);
    assert!(UMB_POLYLINE_COINCIDENT == status::COINCIDENT);
};

/// A polyline, `#V x 2` or `#V x 3`, borrowed for the call. It joins each point to the next.
///
/// The coordinates of a point lie next to each other; points lie `stride` bytes apart.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_polyline {
    /// The first coordinate of the first point, aligned to its scalar; may be null if there is no point.
    pub data: *const c_void,
    /// The number of points, which may be 0.
    pub count: size_t,
    /// Bytes from one point to the next, a multiple of the scalar's size; 0 if packed.
    pub stride: size_t,
    /// The scalar type.
    pub scalar: umb_scalar,
    /// The number of coordinates, 2 or 3; 0 means 3.
    pub dimension: u32,
    /// 1 if the last point is joined to the first, 0 if not. The first point need not be repeated at the end; if it is,
    /// no harm is done.
    pub closed: u32,
    /// 0
    pub reserved: u32,
}

/// How the curvatures of a polyline are computed. All zero: the defaults.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_polyline_options {
    /// `sizeof(umb_polyline_options)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// How to run; `vertices` must be null.
    pub run: umb_run,
}

/// Where the curvatures of a polyline go, each `#V`, in 1/length; any of them may be left out.
///
/// a and c are the edges from a vertex to the points before and after it, phi is the angle between them, d = |c - a| the
/// distance of these points from each other.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_polyline_outputs {
    /// `sizeof(umb_polyline_outputs)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// kappa_C, of the circle through the three points: 2 sin(phi) / d. At most 2 / max(|a|, |c|), however sharp the
    /// corner. Exactly 1/r, to rounding, wherever three points lie on a circle of radius r.
    pub circle: umb_output,
    /// kappa_P, of the parabola that passes the three points at the parameters 0, 1/2 and 1: 8 |a| |c| sin(phi) / d^3.
    pub parabola: umb_output,
    /// kappa_P with the parameter in proportion to lengths, the vertex at |a| / (|a| + |c|):
    /// 2 (|a| + |c|)^2 sin(phi) / d^3.
    pub length_parabola: umb_output,
    /// kappa_SP, of a parabola symmetric about the corner's bisector: 4 cos(phi/2) / ((|a| + |c|) sin(phi/2)^2). Grows
    /// without bound as the corner sharpens.
    pub symmetric_parabola: umb_output,
    /// `UMB_POLYLINE_` bits.
    pub status: umb_status_output,
}

/// Computes the curvatures at the vertices of a polyline, each from the vertex and its two neighbours.
///
/// Pointwise, in 1/length. In the plane, positive where the polyline turns left, so all along a convex polygon that
/// runs counter-clockwise; in space, at least 0. Where the three points lie on a line in this order, exactly 0. If
/// |a| = |c|, the three parabolas agree. As the points of a smooth curve get closer, kappa_C, kappa_PL and kappa_SP tend
/// to its curvature, but kappa_P to 4 |a| |c| / (|a| + |c|)^2 times that, so only on evenly spaced points to the
/// same. Reversing a polyline in the plane changes the sign (but not of 0, nor at a cusp), and no other bit.
///
/// The ends of an open polyline have curvature 0 (`UMB_POLYLINE_END`). At a cusp (`UMB_POLYLINE_CUSP`) kappa_SP is
/// infinite, and the largest value of the output's scalar is written, positive; the others are 0, as the formulas say,
/// unless both neighbours are one point, as in a closed polyline of two points: then kappa_P and kappa_PL are infinite
/// as well, and kappa_C is 2 / |a|. Points that repeat their neighbour are passed over (`UMB_POLYLINE_COINCIDENT`): all
/// points of such a run get the curvature of the corner that they stand for. What is beyond the scalar's range is
/// written as its largest value. For finite input nothing is ever NaN or infinite.
///
/// Double precision, edges scaled by powers of two: neither the size of a polyline nor the ratio of its edges costs
/// accuracy. The results are the same bits for any number of threads and any vectors.
///
/// Threads: any number of calls at once. Cost: linear in the number of points.
///
/// @param polyline the points; read only during the call
/// @param options may be null
/// @param outputs where results go; each has an element for every point. Written only if the call succeeds, or, after a
/// cancel, in part
/// @param error may be null
///
/// Errors: `UMB_ERROR_NULL_POINTER`, `_STRUCT_SIZE`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT` (scalars, `dimension`,
/// `closed`), `_STRIDE`, `_MISALIGNED`, `_SIZE`, `_NON_FINITE` (element: point), `_OUT_OF_MEMORY`, `_CANCELLED`.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_polyline_curvatures(
    polyline: *const umb_polyline,
    options: *const umb_polyline_options,
    outputs: *const umb_polyline_outputs,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let polyline = read_required(polyline, "polyline")?;
            let points = polyline.view()?;
            let closed = match polyline.closed {
                0 => false,
                1 => true,
                value => return Err(Error::UnknownConstant { what: "polyline.closed", value: value as u64 }),
            };
            let options = read_versioned(options)?;
            check_reserved("umb_polyline_options", offset_of!(umb_polyline_options, reserved), options.reserved)?;
            let outputs = required(outputs, "outputs")?;
            check_reserved("umb_polyline_outputs", offset_of!(umb_polyline_outputs, reserved), outputs.reserved)?;
            let outputs = PolylineOutputs {
                circle: outputs.circle.view(points.len())?,
                parabola: outputs.parabola.view(points.len())?,
                length_parabola: outputs.length_parabola.view(points.len())?,
                symmetric_parabola: outputs.symmetric_parabola.view(points.len())?,
                status: outputs.status.view(points.len())?,
            };
            options.run.check_no_list("umb_polyline_options", offset_of!(umb_polyline_options, run))?;
            let mut progress = options.run.callback();
            let run = options.run.view(progress.as_mut().map(|call| call as _))?;
            polyline_curvatures(&points, closed, run, &outputs)
        })
    }
}

impl umb_polyline {
    /// # Safety
    /// The fields describe memory that stays readable and unchanged for `'a`.
    unsafe fn view<'a>(&self) -> Result<PolylinePoints<'a>, Error> {
        check_reserved("umb_polyline", offset_of!(umb_polyline, reserved), self.reserved)?;
        let dimension = if self.dimension == 0 { 3 } else { self.dimension };
        // SAFETY: handed on.
        unsafe {
            match self.scalar {
                UMB_SCALAR_F32 => PolylinePoints::from_raw_f32(self.data.cast(), self.count, self.stride, dimension),
                UMB_SCALAR_F64 => PolylinePoints::from_raw_f64(self.data.cast(), self.count, self.stride, dimension),
                value => Err(Error::UnknownConstant { what: "polyline.scalar", value: value as u64 }),
            }
        }
    }
}
