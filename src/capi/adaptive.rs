//! What adaptive jets know of a mesh.

use super::guard::guard;
use super::normals::umb_normal_options;
use super::status::{umb_error, umb_status};
use super::topology::umb_topology;
use super::types::umb_points;
use super::versioned::{check_reserved, read_required, read_versioned, write_versioned};
use crate::error::Error;
use crate::fit::{AdaptiveModel, Coordinates};
use crate::normals::learn_model;
use std::mem::offset_of;

/// The coordinates in which an adaptive jet writes the surface near a vertex: a `UMB_COORDINATES_` constant.
pub type umb_coordinates = u32;
/// Heights over the tangent plane.
pub const UMB_COORDINATES_HEIGHT: umb_coordinates = 0;
/// Heights over the distance from the vertex, in the direction of its projection to the tangent plane: spheres are then exactly
/// quadratic.
pub const UMB_COORDINATES_CIRCLE: umb_coordinates = 1;

/// What adaptive jets know of a mesh before they look at a vertex: how noisy its positions are and how smooth its surface.
///
/// `umb_learn_model` fills it, and `model` of `umb_normal_options`, `umb_curvature_options` and `umb_section_options` hands it in.
/// A call without model learns its own from all positions of the mesh, with the same bits as result; given the same model, a list
/// of vertices, a part of the mesh or a later frame of it is fitted alike, and a list costs little more than its vertices.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_adaptive_model {
    /// `sizeof(umb_adaptive_model)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// The coordinates that describe the sample better.
    pub coordinates: umb_coordinates,
    /// The median over the vertices of the mean length of a vertex's edges, in the mesh's unit; above 0.
    pub edge_length: f64,
    /// The standard deviation of the positions along the normal that is not the surface's, in the mesh's unit; above 0, also
    /// when divided by `edge_length` (a quotient that rounds to 0 or to infinity is `UMB_ERROR_OPTION_OUT_OF_RANGE`).
    pub noise: f64,
    /// The root mean square size of the surface's Taylor coefficients of degrees 2, 3 and 4, and of what lies beyond, for
    /// lengths in units of `edge_length`; above 0.
    pub sizes: [f64; 4],
    /// A vertex's noise is `noise` times its own mean edge length, in units of `edge_length`, to this power: 0 to 2.
    pub noise_exponent: u32,
    /// 1 if `sizes` are understood in units of the vertex's own mean edge length, 0 if in those of `edge_length`.
    pub size_exponent: u32,
    /// The mean logarithm of the evidence of a sample vertex for heights and for circles, each with its own best numbers:
    /// larger is better; 0 where it was not looked at. Not read.
    pub evidence: [f64; 2],
    /// How many vertices it was learned from; 0 if there were none to learn from. Not read.
    pub sample: u32,
    /// 0
    pub reserved: u32,
}

/// Learns what adaptive jets use of a mesh, from a sample of all its vertices: declare `umb_adaptive_model model =
/// UMB_ADAPTIVE_MODEL_INIT`, learn, and point `options.model` at it.
///
/// @param topology the handle
/// @param points the positions of all its vertices; read only during the call
/// @param options of which only `run` counts, and of that not `vertices`; may be null
/// @param model receives the numbers; set its `struct_size` (or 0) before
/// @param error may be null
///
/// Errors: as `umb_vertex_normals`. Threads, bits: likewise.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_learn_model(
    topology: *const umb_topology,
    points: *const umb_points,
    options: *const umb_normal_options,
    model: *mut umb_adaptive_model,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let topology = &topology.as_ref().ok_or(Error::NullPointer { what: "topology" })?.0;
            let points = read_required(points, "points")?.view()?;
            let options = read_versioned(options)?;
            write_versioned(model, "model", || {
                let mut progress = options.run.callback();
                let run = options.run.view(progress.as_mut().map(|call| call as _))?;
                let AdaptiveModel {
                    edge_length,
                    noise,
                    sizes,
                    noise_exponent,
                    size_exponent,
                    coordinates,
                    evidence,
                    sample,
                } = learn_model(topology, &points, run)?;
                Ok(umb_adaptive_model {
                    struct_size: 0,
                    coordinates: match coordinates {
                        Coordinates::Height => UMB_COORDINATES_HEIGHT,
                        Coordinates::Circle => UMB_COORDINATES_CIRCLE,
                    },
                    edge_length,
                    noise,
                    sizes,
                    noise_exponent: noise_exponent.into(),
                    size_exponent: size_exponent.into(),
                    evidence,
                    sample,
                    reserved: 0,
                })
            })
        })
    }
}

/// A model that a caller may hand in.
///
/// # Safety
/// `model` is null or as [`read_versioned`] asks.
pub(super) unsafe fn model_given(model: *const umb_adaptive_model) -> Result<Option<AdaptiveModel>, Error> {
    if model.is_null() {
        return Ok(None);
    }
    // SAFETY: handed on.
    let model = unsafe { read_versioned(model) }?;
    check_reserved("umb_adaptive_model", offset_of!(umb_adaptive_model, reserved), model.reserved)?;
    let small = |what, value: u32| u8::try_from(value).map_err(|_| Error::OptionOutOfRange { what });
    Ok(Some(AdaptiveModel {
        edge_length: model.edge_length,
        noise: model.noise,
        sizes: model.sizes,
        noise_exponent: small("model.noise_exponent", model.noise_exponent)?,
        size_exponent: small("model.size_exponent", model.size_exponent)?,
        coordinates: match model.coordinates {
            UMB_COORDINATES_HEIGHT => Coordinates::Height,
            UMB_COORDINATES_CIRCLE => Coordinates::Circle,
            value => return Err(Error::UnknownConstant { what: "model.coordinates", value: value as u64 }),
        },
        evidence: model.evidence,
        sample: model.sample,
    }))
}
