//! Vertex and face normals.

use super::adaptive::{model_given, umb_adaptive_model};
use super::guard::guard;
use super::status::{umb_error, umb_status};
use super::topology::umb_topology;
use super::types::{umb_faces, umb_output, umb_points, umb_run, umb_status_output};
use super::versioned::{check_reserved, read_required, read_versioned, required};
use crate::error::Error;
use crate::fit::{JetOptions, MOST_DEGREE};
use crate::normals::{
    AdaptiveOptions, FaceOutputs, NormalOutputs, Weight, face_normals, vertex_normals, vertex_normals_from_faces,
};
use crate::sweep::MOST_RINGS;
use std::mem::offset_of;

/// How a vertex normal weighs the faces around the vertex, or what it fits: a `UMB_WEIGHT_` constant.
///
/// N_i is the unit normal of face i at the vertex, theta_i its interior angle there (up to 2 pi at a reflex corner of a
/// polygon), a and b the lengths of its two edges there, A_i its area, g_i the distance to its centroid.
pub type umb_weight = u32;
/// N_CM of "New Computation of Normal Vector and Curvature": a conformal map of the ring and mean value coordinates.
/// Edge normals unit(N_(i-1) + N_i) with weights (tan(alpha_(i-1)/2) + tan(alpha_i/2)) / (length of the edge), where alpha_i
/// is 2 pi theta_i / (sum of theta) in a closed fan and theta_i in an open one, held just below pi; beyond the ends of an open
/// fan there is no tangent, and its end edges have the normal of their one face. The default; the best one-ring average on
/// irregular smooth meshes.
pub const UMB_WEIGHT_CONFORMAL: umb_weight = 0;
/// 1 (Gouraud 1971, N_G).
pub const UMB_WEIGHT_UNIFORM: umb_weight = 1;
/// theta_i (Thuermer and Wuethrich 1998, N_T). Does not depend on how a flat face is cut up.
pub const UMB_WEIGHT_ANGLE: umb_weight = 2;
/// A_i (N_M).
pub const UMB_WEIGHT_AREA: umb_weight = 3;
/// |sin theta_i| / (a b) (Max 1999). Exact where the vertex and its neighbours lie on a sphere.
pub const UMB_WEIGHT_MAX: umb_weight = 4;
/// A_i / g_i (N_C of Chen and Wu 2004 as the paper prints it).
pub const UMB_WEIGHT_CENTROID_AREA: umb_weight = 5;
/// 1 / g_i^2 (N_C of Chen and Wu 2004 as the paper's tables use it).
pub const UMB_WEIGHT_CENTROID: umb_weight = 6;
/// 1 / sqrt(a b) (Jin, Lewis and West 2005).
pub const UMB_WEIGHT_INVERSE_ROOT_EDGES: umb_weight = 7;
/// |sin theta_i|
pub const UMB_WEIGHT_SINE: umb_weight = 8;
/// theta_i a b
pub const UMB_WEIGHT_ANGLE_EDGES: umb_weight = 9;
/// No average, but the normal of an osculating jet (Cazals and Pouget 2005): a polynomial height field, fitted by least
/// squares to the vertices within several rings, over their plane of least squares. See `degree` and `rings` of
/// `umb_normal_options`. On smooth surfaces of a higher order than any average, and twenty to forty times as expensive; on
/// creases it rounds what the averages keep. The area-weighted normal says to which side it points.
pub const UMB_WEIGHT_JET: umb_weight = 10;
/// No average, but the normal of an adaptive jet: a polynomial height field of degree 4 over three to six rings, whose weights and
/// prior follow from the noise and the smoothness that the mesh itself shows (see `umb_adaptive_model`). The most accurate normals of this
/// library on smooth surfaces, clean or noisy, of triangles or polygons; where a neighbourhood crosses a crease, only what is on the
/// vertex's side counts. A vertex on a crease (`UMB_VERTEX_CREASE` and `UMB_VERTEX_FALLBACK`) has the mean direction of its sides. Three to five times as expensive as
/// `UMB_WEIGHT_JET`. See `rings` and `model` of `umb_normal_options`.
pub const UMB_WEIGHT_ADAPTIVE_JET: umb_weight = 11;
/// Max's normal, tilted so that the sections along the edges of the ring agree best with one shape operator (one 5 x 5 solve). Exact
/// where the vertex and its neighbours lie on a sphere; the most accurate normal of one ring on smooth surfaces with little noise.
pub const UMB_WEIGHT_TILTED_SECTIONS: umb_weight = 12;

/// Which vertex normals to compute, and how. All zero: N_CM at all vertices.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_normal_options {
    /// `sizeof(umb_normal_options)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// The weight.
    pub weight: umb_weight,
    /// How to run.
    pub run: umb_run,
    /// `UMB_WEIGHT_JET` only: the degree of the polynomial, 1 to 4; 0 for 3. Other weights do not look at it.
    pub degree: u32,
    /// Jets only: the rings of neighbours that the polynomial is fitted to, at most 8. 0 stands, for `UMB_WEIGHT_ADAPTIVE_JET`, for as
    /// many as have any weight, which is 3 on clean meshes and up to 6 on noisy ones (4 are a fair choice, 3 the cheap one); for
    /// `UMB_WEIGHT_JET`, for 1 at degree 1, 2 at degrees 2 and 3, and 3 at degree 4. The first ring of a vertex is all vertices that share a face with it. No more than 255 vertices are
    /// used. Other weights do not look at it.
    pub rings: u32,
    /// `UMB_WEIGHT_ADAPTIVE_JET` only: what is known of the mesh, read only during the call; null to learn it from all positions. Other weights do not look at
    /// it.
    pub model: *const umb_adaptive_model,
}

/// Where vertex normals go; any of them may be left out.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_normal_outputs {
    /// `sizeof(umb_normal_outputs)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// Unit normals, `#V x 3`; (0, 0, 0) where the status says isolated or degenerate.
    pub normal: umb_output,
    /// The weighted sums before normalisation, `#V x 3`, in the weight's unit: length^2 for areas, 1/length^2 for Max,
    /// and so on. For N_CM each fan's weights are divided by their total, so a fan's sum is at most 1 long. Where the
    /// status says fallback, it is the sum of that other weight, in its unit. Beyond the scalar's range its largest value
    /// stands. For jets and tilted sections, which sum nothing, it is the unit normal itself.
    pub sum: umb_output,
    /// `UMB_VERTEX_` bits, `#V`.
    pub status: umb_status_output,
}

/// How face normals are computed. All zero: the defaults.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_face_options {
    /// `sizeof(umb_face_options)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// How to run; `vertices` must be null.
    pub run: umb_run,
}

/// Where face normals go; any of them may be left out.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_face_outputs {
    /// `sizeof(umb_face_outputs)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// Unit normals, `#F x 3`; (0, 0, 0) where a face has none.
    pub normal: umb_output,
    /// Area vectors, `#F x 3`: along the normal, as long as the area is large (length^2).
    pub area_vector: umb_output,
    /// 0 or `UMB_VERTEX_DEGENERATE`, `#F`.
    pub status: umb_status_output,
}

/// Computes vertex normals over the one-rings of a topology, or, for jets, over several rings.
///
/// Pointwise unit vectors; they point to the side from which faces run counter-clockwise. Polygons count by their area
/// vector, taken relative to the polygon. At a boundary vertex the open fan counts as it is; at a non-manifold vertex the
/// sums of all fans are added. Faces whose area is exactly zero, edges without length and pairs of opposite faces drop out
/// of a sum (a face that is thin to rounding counts, with the normal that its coordinates give; one thinner than 1e-135 of
/// its ring does not); if nothing is left, the vertex takes the normal by Max's weight, else by area, else of any face (status
/// `UMB_VERTEX_FALLBACK`), else (0, 0, 0) (`UMB_VERTEX_DEGENERATE`). Nothing is ever NaN or infinite.
///
/// `UMB_WEIGHT_ADAPTIVE_JET` widens nothing; where its fit has no solution in range, the vertex keeps Max's normal
/// (`UMB_VERTEX_FALLBACK` without `UMB_VERTEX_CREASE`). `UMB_WEIGHT_TILTED_SECTIONS` does likewise. `UMB_WEIGHT_JET`: a neighbourhood with
/// fewer vertices than the polynomial has coefficients, or whose vertices do not determine it, is
/// widened by up to four rings (`UMB_VERTEX_WIDENED`). Where that does not help, the vertex takes a polynomial of lower
/// degree, else the area-weighted normal (`UMB_VERTEX_FALLBACK`), else (0, 0, 0) (`UMB_VERTEX_DEGENERATE`). A jet more than 75
/// degrees from the area-weighted normal is not believed: heights are then taken along that normal instead
/// (`UMB_VERTEX_FALLBACK`).
///
/// Positions are taken relative to each vertex and scaled by powers of two, so neither the distance from the origin nor
/// the size of the mesh costs accuracy. Single precision is used if positions and outputs all are `f32` and faces are
/// triangles, not for jets and tilted sections, and then only where its error stays below about 1e-6; all else is double precision. The results are the same
/// bits for any number of threads, any vectors and any choice of vertices.
///
/// Threads: any number of calls may use one topology at once. Cost: linear in the number of corners.
///
/// @param topology the handle
/// @param points the positions of all its vertices, as many as the topology has; read only during the call
/// @param options may be null
/// @param outputs where results go; each has an element for every vertex. Written only if the call succeeds, or, after
/// a cancel, in part
/// @param error may be null
///
/// Errors: `UMB_ERROR_NULL_POINTER`, `_STRUCT_SIZE`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT`, `_STRIDE`, `_MISALIGNED`,
/// `_SIZE`, `_INDEX_OUT_OF_RANGE` (element: place in `vertices`), `_NON_FINITE` (element: vertex), `_OPTION_OUT_OF_RANGE`,
/// `_OUT_OF_MEMORY`, `_CANCELLED`.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_vertex_normals(
    topology: *const umb_topology,
    points: *const umb_points,
    options: *const umb_normal_options,
    outputs: *const umb_normal_outputs,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let topology = &topology.as_ref().ok_or(Error::NullPointer { what: "topology" })?.0;
            let points = read_required(points, "points")?.view()?;
            let options = read_versioned(options)?;
            let outputs = vertex_outputs(outputs, topology.vertex_count())?;
            let mut progress = options.run.callback();
            let run = options.run.view(progress.as_mut().map(|call| call as _))?;
            vertex_normals(topology, &points, options.asked()?, run, &outputs)
        })
    }
}

/// Computes vertex normals once, straight from faces: builds a topology for the call and forgets it. The results are those
/// of `umb_vertex_normals`, to the bit.
///
/// @param faces the faces; read only during the call
/// @param points the positions of all vertices; read only during the call
/// @param options may be null
/// @param outputs where results go, as in `umb_vertex_normals`
/// @param error may be null
///
/// Errors: as `umb_vertex_normals` and `umb_topology_create`.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_vertex_normals_from_faces(
    faces: *const umb_faces,
    points: *const umb_points,
    options: *const umb_normal_options,
    outputs: *const umb_normal_outputs,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let faces = read_required(faces, "faces")?.view()?;
            let points = read_required(points, "points")?.view()?;
            let options = read_versioned(options)?;
            let outputs = vertex_outputs(outputs, points.len())?;
            let mut progress = options.run.callback();
            let run = options.run.view(progress.as_mut().map(|call| call as _))?;
            vertex_normals_from_faces(&faces, &points, options.asked()?, run, &outputs)
        })
    }
}

/// Computes face normals: unit vectors along each face's area vector, `1/2 sum (p_k - p_0) x (p_(k+1) - p_0)`, which is
/// right for triangles, concave and non-planar polygons, collinear and repeated corners. A face whose area vector vanishes
/// has the normal (0, 0, 0) and the status `UMB_VERTEX_DEGENERATE`. Double precision; same bits on any number of threads.
///
/// @param faces the faces; read only during the call
/// @param points the positions of all vertices; read only during the call
/// @param options may be null
/// @param outputs where results go; each has an element for every face
/// @param error may be null
///
/// Errors: as `umb_vertex_normals` and `umb_topology_create`.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_face_normals(
    faces: *const umb_faces,
    points: *const umb_points,
    options: *const umb_face_options,
    outputs: *const umb_face_outputs,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let faces = read_required(faces, "faces")?.view()?;
            let points = read_required(points, "points")?.view()?;
            let options = read_versioned(options)?;
            check_reserved("umb_face_options", offset_of!(umb_face_options, reserved), options.reserved)?;
            let outputs = required(outputs, "outputs")?;
            check_reserved("umb_face_outputs", offset_of!(umb_face_outputs, reserved), outputs.reserved)?;
            let outputs = FaceOutputs {
                normal: outputs.normal.view(faces.len())?,
                area_vector: outputs.area_vector.view(faces.len())?,
                status: outputs.status.view(faces.len())?,
            };
            let mut progress = options.run.callback();
            let run = options.run.view(progress.as_mut().map(|call| call as _))?;
            if run.vertices.is_some() {
                let byte = offset_of!(umb_face_options, run) + offset_of!(umb_run, vertices);
                return Err(Error::UnknownField { what: "umb_face_options", byte });
            }
            face_normals(&faces, &points, run, &outputs)
        })
    }
}

/// # Safety
/// `outputs` is null or as the header asks, its arrays with an element for each of `vertex_count` vertices.
unsafe fn vertex_outputs<'a>(
    outputs: *const umb_normal_outputs,
    vertex_count: usize,
) -> Result<NormalOutputs<'a>, Error> {
    // SAFETY: handed on.
    unsafe {
        let outputs = required(outputs, "outputs")?;
        check_reserved("umb_normal_outputs", offset_of!(umb_normal_outputs, reserved), outputs.reserved)?;
        vertex_views(&outputs.normal, &outputs.sum, &outputs.status, vertex_count)
    }
}

/// # Safety
/// The outputs are as the header asks, with an element for each of `vertex_count` vertices.
pub(super) unsafe fn vertex_views<'a>(
    normal: &umb_output,
    sum: &umb_output,
    status: &umb_status_output,
    vertex_count: usize,
) -> Result<NormalOutputs<'a>, Error> {
    // SAFETY: handed on.
    unsafe {
        Ok(NormalOutputs {
            normal: normal.view(vertex_count)?,
            sum: sum.view(vertex_count)?,
            status: status.view(vertex_count)?,
        })
    }
}

/// What says which normals: a weight, and what only some weights look at. With the names of the last two.
pub(super) struct AskedWeight {
    pub weight: umb_weight,
    pub degree: (u32, &'static str),
    pub rings: (u32, &'static str),
    pub model: *const umb_adaptive_model,
}

impl AskedWeight {
    /// # Safety
    /// `model` is null or as the header asks.
    pub(super) unsafe fn view(&self) -> Result<Weight, Error> {
        let small = |(value, what): (u32, &'static str)| match u8::try_from(value) {
            Ok(value) if value as usize <= MOST_RINGS => Ok(value),
            _ => Err(Error::OptionOutOfRange { what }),
        };
        Ok(match self.weight {
            UMB_WEIGHT_CONFORMAL => Weight::Conformal,
            UMB_WEIGHT_UNIFORM => Weight::Uniform,
            UMB_WEIGHT_ANGLE => Weight::Angle,
            UMB_WEIGHT_AREA => Weight::Area,
            UMB_WEIGHT_MAX => Weight::Max,
            UMB_WEIGHT_CENTROID_AREA => Weight::CentroidArea,
            UMB_WEIGHT_CENTROID => Weight::Centroid,
            UMB_WEIGHT_INVERSE_ROOT_EDGES => Weight::InverseRootEdges,
            UMB_WEIGHT_SINE => Weight::Sine,
            UMB_WEIGHT_ANGLE_EDGES => Weight::AngleEdges,
            UMB_WEIGHT_JET => {
                let degree = small(self.degree)?;
                if degree > MOST_DEGREE {
                    return Err(Error::OptionOutOfRange { what: self.degree.1 });
                }
                Weight::Jet(JetOptions { degree, rings: small(self.rings)? })
            }
            UMB_WEIGHT_ADAPTIVE_JET => {
                // SAFETY: handed on.
                let model = unsafe { model_given(self.model) }?;
                Weight::AdaptiveJet(AdaptiveOptions { rings: small(self.rings)?, model })
            }
            UMB_WEIGHT_TILTED_SECTIONS => Weight::TiltedSections,
            value => return Err(Error::UnknownConstant { what: "options.weight", value: value as u64 }),
        })
    }
}

impl umb_normal_options {
    /// # Safety
    /// As the header asks.
    pub(super) unsafe fn asked(&self) -> Result<Weight, Error> {
        let (degree, rings) = ((self.degree, "options.degree"), (self.rings, "options.rings"));
        // SAFETY: handed on.
        unsafe { AskedWeight { weight: self.weight, degree, rings, model: self.model }.view() }
    }
}
