//! Sections of meshes.

use super::adaptive::umb_adaptive_model;
use super::guard::guard;
use super::normals::{AskedWeight, umb_weight};
use super::status::{umb_error, umb_status};
use super::topology::umb_topology;
use super::types::{umb_output, umb_points, umb_run, umb_status_output};
use super::versioned::{check_reserved, read_required, read_versioned, required};
use crate::curvature::{Directions, Section, SectionOutputs, VertexNormals, direction_sections, edge_sections};
use crate::error::Error;
use crate::normals::Weight;
use std::mem::offset_of;

/// The formula of a section's curvature: a `UMB_SECTION_` constant.
///
/// Of three points A, V, C with a = A - V, c = C - V, phi the angle between them and d = |C - A|, or of one edge x and a unit
/// normal N.
pub type umb_section = u32;
/// The symmetric parabola, kappa_SP: 4 cos(phi/2) / ((|a| + |c|) sin^2(phi/2)), or -2 N.x / |x - (N.x) N|^2. It grows
/// without bound as the corner sharpens. The default.
pub const UMB_SECTION_SYMMETRIC_PARABOLA: umb_section = 0;
/// The circle, kappa_C: 2 sin(phi) / d, or -2 N.x / |x|^2. At most 2 / max(|a|, |c|).
pub const UMB_SECTION_CIRCLE: umb_section = 1;
/// The parabola with the standard parameter 1/2 at V, kappa_P: 8 |a| |c| sin(phi) / d^3; of one edge as
/// `UMB_SECTION_SYMMETRIC_PARABOLA`.
pub const UMB_SECTION_PARABOLA: umb_section = 2;
/// The parabola with its parameter in proportion to |a| and |c|: 2 (|a| + |c|)^2 sin(phi) / d^3; of one edge as
/// `UMB_SECTION_SYMMETRIC_PARABOLA`.
pub const UMB_SECTION_LENGTH_PARABOLA: umb_section = 3;

/// Bit of a section's status: the plane meets the ring on one side of the vertex only; its mirror image stands in for the
/// other.
pub const UMB_SECTION_STATUS_ONE_SIDED: u8 = 1;
/// Bit of a section's status: there is no section (no length, no normal, or nothing of the ring in its plane); its curvature
/// is 0.
pub const UMB_SECTION_STATUS_NONE: u8 = 2;

const _: () = {
    use crate::curvature::section_status as status;
    assert!(UMB_SECTION_STATUS_ONE_SIDED == status::ONE_SIDED && UMB_SECTION_STATUS_NONE == status::NONE);
};

/// Which sections to compute, and how. All zero: symmetric parabolas with N_CM, at all vertices.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_section_options {
    /// `sizeof(umb_section_options)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// The formula.
    pub section: umb_section,
    /// The weight of the vertex normals, if `normals.data` is null.
    pub weight: umb_weight,
    /// `umb_direction_sections` only: 1 if `directions` is one set for every vertex, 0 if it has one for each.
    pub shared: u32,
    /// Vertex normals of the caller's, `#V x 3`, of any length; a vertex whose normal is zero has no section. Null data:
    /// computed with `weight`.
    pub normals: umb_points,
    /// `umb_direction_sections` only: directions of any length, `#V x 3`, or `#D x 3` if shared; each is projected onto the
    /// tangent plane.
    pub directions: umb_points,
    /// `UMB_WEIGHT_JET` only: see `degree` of `umb_normal_options`.
    pub normal_degree: u32,
    /// `UMB_WEIGHT_JET` and `UMB_WEIGHT_ADAPTIVE_JET` only: see `rings` of `umb_normal_options`.
    pub normal_rings: u32,
    /// `UMB_WEIGHT_ADAPTIVE_JET` only: see `model` of `umb_normal_options`.
    pub model: *const umb_adaptive_model,
    /// How to run.
    pub run: umb_run,
}

/// Where sections go; any of them may be left out.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_section_outputs {
    /// `sizeof(umb_section_outputs)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// The curvature of each section, 1/length; positive where the surface bends away from the normal.
    pub curvature: umb_output,
    /// `UMB_SECTION_STATUS_` bits, one byte for each section.
    pub status: umb_status_output,
    /// The unit vertex normals that were used, `#V x 3`.
    pub normal: umb_output,
}

/// Computes the curvature of the section along every edge of every vertex's ring, with the vertex normal.
///
/// `curvature` and `status` have an element for each entry of the ring array (`umb_topology_ring_neighbours`): the sections of
/// vertex v are those from entry v of `umb_topology_ring_offsets` on. With a list of vertices only their entries are written.
/// `directions` must be zero.
///
/// Precision, bits, threads, cost: as `umb_curvatures`.
///
/// @param topology the handle
/// @param points the positions of all its vertices; read only during the call
/// @param options may be null
/// @param outputs where results go. Written only if the call succeeds, or, after a cancel, in part
/// @param error may be null
///
/// Errors: as `umb_curvatures`.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_edge_sections(
    topology: *const umb_topology,
    points: *const umb_points,
    options: *const umb_section_options,
    outputs: *const umb_section_outputs,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let topology = &topology.as_ref().ok_or(Error::NullPointer { what: "topology" })?.0;
            let points = read_required(points, "points")?.view()?;
            let options = read_versioned(options)?;
            if options.shared != 0 {
                return Err(Error::NotApplicable { what: "options.shared" });
            }
            if !options.directions.data.is_null() || options.directions.count != 0 {
                return Err(Error::NotApplicable { what: "options.directions" });
            }
            let sections = topology.ring_neighbours().len();
            let outputs = section_outputs(outputs, sections, topology.vertex_count())?;
            let normals = normals_of(&options)?;
            let mut progress = options.run.callback();
            let run = options.run.view(progress.as_mut().map(|call| call as _))?;
            edge_sections(topology, &points, section(options.section)?, normals, run, &outputs)
        })
    }
}

/// Computes the curvatures of normal sections in given tangent directions: the plane of the vertex normal and a direction cuts
/// the polygon of the ring's neighbours in a point on either side of the vertex, and the three points give the curvature.
///
/// `curvature` and `status` have an element for each vertex; with a shared set of `#D` directions, `#V x #D`: those of vertex v
/// from v #D on. At a boundary, where the plane meets the ring on one side only, the mirror image of that point stands in
/// for the other (`UMB_SECTION_STATUS_ONE_SIDED`). The two points lie on chords between neighbours, not on the surface, so even
/// with exact normals the error need not shrink with the edges, unless the plane passes close to neighbours.
///
/// Precision, bits, threads: as `umb_curvatures`. Cost: linear in the number of corners times the number of directions.
///
/// @param topology the handle
/// @param points the positions of all its vertices; read only during the call
/// @param options the directions, and how; not null
/// @param outputs where results go. Written only if the call succeeds, or, after a cancel, in part
/// @param error may be null
///
/// Errors: as `umb_curvatures`; `UMB_ERROR_NON_FINITE` also for a direction (element: its index).
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_direction_sections(
    topology: *const umb_topology,
    points: *const umb_points,
    options: *const umb_section_options,
    outputs: *const umb_section_outputs,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let topology = &topology.as_ref().ok_or(Error::NullPointer { what: "topology" })?.0;
            let points = read_required(points, "points")?.view()?;
            let options = required(options, "options")?;
            let directions = options.directions.view()?;
            let vertex_count = topology.vertex_count();
            let (directions, count) = match options.shared {
                0 => (Directions::PerVertex(directions), Some(vertex_count)),
                1 => (Directions::Shared(directions), vertex_count.checked_mul(directions.len())),
                value => return Err(Error::UnknownConstant { what: "options.shared", value: value as u64 }),
            };
            let Some(count) = count else {
                let (found, expected) = (options.directions.count as u64, usize::MAX as u64);
                return Err(Error::Size { what: "options.directions.count", found, expected });
            };
            let outputs = section_outputs(outputs, count, vertex_count)?;
            let normals = normals_of(&options)?;
            let mut progress = options.run.callback();
            let run = options.run.view(progress.as_mut().map(|call| call as _))?;
            direction_sections(topology, &points, directions, section(options.section)?, normals, run, &outputs)
        })
    }
}

/// # Safety
/// `outputs` is null or as the header asks, its arrays with as many elements.
unsafe fn section_outputs<'a>(
    outputs: *const umb_section_outputs,
    sections: usize,
    vertices: usize,
) -> Result<SectionOutputs<'a>, Error> {
    // SAFETY: handed on.
    unsafe {
        let outputs = required(outputs, "outputs")?;
        check_reserved("umb_section_outputs", offset_of!(umb_section_outputs, reserved), outputs.reserved)?;
        Ok(SectionOutputs {
            curvature: outputs.curvature.view(sections)?,
            status: outputs.status.view(sections)?,
            normal: outputs.normal.view(vertices)?,
        })
    }
}

/// # Safety
/// As [`umb_points::view`], for the options' normals.
unsafe fn normals_of<'a>(options: &umb_section_options) -> Result<VertexNormals<'a>, Error> {
    let asked = AskedWeight {
        weight: options.weight,
        degree: (options.normal_degree, "options.normal_degree"),
        rings: (options.normal_rings, "options.normal_rings"),
        model: options.model,
    };
    // SAFETY: handed on.
    unsafe { vertex_normals_asked(&options.normals, asked.view()?) }
}

/// The normals given, or those of a weight.
///
/// # Safety
/// As [`umb_points::view`].
pub(super) unsafe fn vertex_normals_asked<'a>(
    normals: &umb_points,
    weight: Weight,
) -> Result<VertexNormals<'a>, Error> {
    if normals.data.is_null() {
        return Ok(VertexNormals::Computed(weight));
    }
    // SAFETY: handed on.
    unsafe { normals.view() }.map(VertexNormals::Given)
}

pub(super) fn section(value: umb_section) -> Result<Section, Error> {
    Ok(match value {
        UMB_SECTION_SYMMETRIC_PARABOLA => Section::SymmetricParabola,
        UMB_SECTION_CIRCLE => Section::Circle,
        UMB_SECTION_PARABOLA => Section::Parabola,
        UMB_SECTION_LENGTH_PARABOLA => Section::LengthParabola,
        value => return Err(Error::UnknownConstant { what: "options.section", value: value as u64 }),
    })
}
