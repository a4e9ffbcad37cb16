//! Curvatures of meshes.

use super::adaptive::{model_given, umb_adaptive_model};
use super::guard::guard;
use super::normals::{AskedWeight, umb_weight};
use super::sections::{section, umb_section, vertex_normals_asked};
use super::status::{umb_error, umb_status};
use super::topology::umb_topology;
use super::types::{umb_output, umb_points, umb_run, umb_status_output};
use super::versioned::{check_reserved, read_required, read_versioned, required};
use crate::curvature::{CurvatureOptions, CurvatureOutputs, Method, curvatures};
use crate::error::Error;
use std::mem::offset_of;

/// How curvatures are estimated: a `UMB_CURVATURE_` constant.
///
/// What each has to give; any other output is refused with `UMB_ERROR_NOT_APPLICABLE`:
///
/// | method                       | k1 k2, shape index, curvedness | directions | H, H N | K | area | integrals | residual | condition |
/// |------------------------------|---|---|---|---|---|-------|-----------|---|
/// | ADAPTIVE_JET                 | x | x | x | x |   |       | length    |   |
/// | JET, QUADRIC, GOLDFEATHER    | x | x | x | x |   |       | length    | x |
/// | LEAST_SQUARES                | x | x | x | x |   |       | 1/length  |   |
/// | TILTED_SECTIONS              | x | x | x | x |   |       |           |   |
/// | TAUBIN, RUSINKIEWICZ         | x | x | x | x |   |       |           |   |
/// | WATANABE                     | x |   | x | x |   |       |           |   |
/// | MEYER                        | x |   | x | x | x | H, K  |           |   |
/// | ANGLE_DEFECT                 |   |   |   | x | x | K     |           |   |
/// | NORMAL_CYCLE                 | x | x | x | x | x | H     |           |   |
/// | CORRECTED_MEASURE            | x | x | x | x | x | H, K  |           |   |
///
/// Every method has normal and status; `degrees_of_freedom` is `ADAPTIVE_JET`'s alone.
///
/// Every method takes triangles and polygons, and any vertex: boundary, non-manifold (all fans count together), isolated.
pub type umb_curvature_method = u32;
/// Adaptive jets: a polynomial height field of degree 4 over `rings` (at most 8; 0: 3 to 6, as many as the noise asks for), whose
/// weights and prior follow from the noise and the smoothness that the mesh itself shows (see `umb_adaptive_model` and `model`), with the curvatures of the fitted
/// surface. The most accurate of all here on clean, noisy, open, closed and creased meshes, of triangles or polygons: the default.
/// Its `normal` is the fitted surface's. Neighbours whose one-ring normals are more than 60 degrees from the vertex's do not count,
/// so nothing is smeared over creases; a vertex on a crease (`UMB_VERTEX_CREASE` and `UMB_VERTEX_FALLBACK`) has the curvatures that fit the
/// circles along its edges best, about the mean direction of its sides: large across, and small along the crease. Where a fit has no solution in range, Max's normal
/// stays, and curvatures are 0 (`UMB_VERTEX_FALLBACK` without `UMB_VERTEX_CREASE`). `normals` and `weight` are not looked at.
pub const UMB_CURVATURE_ADAPTIVE_JET: umb_curvature_method = 0;
/// Osculating jets (Cazals and Pouget 2005): a polynomial height field over several rings, over the plane of least squares of
/// its points, with the curvatures of the fitted surface. `degree` is 2 to 4 (0: 3), `rings` at most 8 (0: 2 up to degree 3,
/// 3 at degree 4). Of order degree - 1 on meshes of any kind. Where points are too few or in special position
/// the neighbourhood is widened (`UMB_VERTEX_WIDENED`), then the degree lowered, then curvatures are 0
/// (`UMB_VERTEX_FALLBACK`). Its `normal` is the fitted surface's. `normals`, if given, tell its sides apart, else area-weighted
/// ones do; `weight` is not looked at.
pub const UMB_CURVATURE_JET: umb_curvature_method = 1;
/// A quadratic height field in the frame of the vertex normal, tangent to its plane (Hamann 1993). `rings` at most 8 (0: 1);
/// widened as jets are. As good as the normals.
pub const UMB_CURVATURE_QUADRIC: umb_curvature_method = 2;
/// Goldfeather and Interrante 2004: a cubic height field fitted to positions and normals of the neighbours. `rings` at most 8
/// (0: 1); widened as jets are. As good as the normals, which it needs of up to four rings more than it was asked for.
pub const UMB_CURVATURE_GOLDFEATHER: umb_curvature_method = 3;
/// The sections (circles) along all edges of one ring, with a tilt of Max's normal (or of the given `normals`; `weight` is not looked
/// at): one 5 x 5 solve for the shape operator and the tilt, whose result is `normal`. Exact on spheres; the most accurate curvature of
/// one ring on smooth surfaces with little noise.
pub const UMB_CURVATURE_TILTED_SECTIONS: umb_curvature_method = 4;
/// The shape operator whose normal curvatures fit those of the sections along all edges best, in least squares. With
/// `UMB_SECTION_CIRCLE` and exact normals exact on spheres. Where the edges leave a part of it undetermined (within about a
/// degree of two perpendicular lines, as in a grid of quads), the point is taken to be as round as they allow
/// (`UMB_VERTEX_FALLBACK`). Does not converge with one-ring normals on irregular meshes.
pub const UMB_CURVATURE_LEAST_SQUARES: umb_curvature_method = 5;
/// Taubin 1995: k = 3 m1 - m2, 3 m2 - m1 for the eigenvalues m of the sum of w kappa T T^T over the edges, w the area of the
/// faces at an edge. Does not converge, unless the edges stand at even angles.
pub const UMB_CURVATURE_TAUBIN: umb_curvature_method = 6;
/// Watanabe and Belyaev 2001: H and (3 H^2 - K)/2 as the means of sectional curvature and of its square, by the trapezoid rule
/// over the angles of the faces. Does not converge, unless the edges stand at even angles.
pub const UMB_CURVATURE_WATANABE: umb_curvature_method = 7;
/// Meyer et al. 2003: H N by cotangents, K by the angle defect, both over the mixed Voronoi area (in polygons: by the
/// Laplacian of Alexa and Wardetzky 2011, over an equal share of the area for each corner). At a boundary the integrals
/// hold the pull and the turning of the boundary. Does not converge on irregular meshes.
pub const UMB_CURVATURE_MEYER: umb_curvature_method = 8;
/// The angle defect of Gauss and Bonnet: 2 pi less the angles of a closed fan, pi less those of an open one; fans add up.
/// The integrals over all vertices sum up to 2 pi times the Euler characteristic; where vertices have several fans or edges
/// end them, to that of the surface cut open there. Without area the pointwise K is 0 (`UMB_VERTEX_FALLBACK`) and the integral
/// stands. Takes no normals.
pub const UMB_CURVATURE_ANGLE_DEFECT: umb_curvature_method = 9;
/// Rusinkiewicz 2004: shape operators of faces from the differences of vertex normals, averaged by mixed area. Converges if
/// the normals are better than first order.
pub const UMB_CURVATURE_RUSINKIEWICZ: umb_curvature_method = 10;
/// The normal cycle (Cohen-Steiner and Morvan 2003): dihedral angles along edges, over a region of `rings` (0: 1) or of
/// `radius`. Edges of a single face have none, so values at a boundary are too small, and so are those on polygons that are
/// not flat, whose twist no edge has. Converges over balls that shrink more slowly than the edges.
pub const UMB_CURVATURE_NORMAL_CYCLE: umb_curvature_method = 11;
/// Interpolated corrected curvature measures (Lachaud, Romon, Thibert and Coeurjolly 2020), over a region of `rings` (0: 1) or
/// of `radius`. Converges if the normals do; exact on spheres with exact normals. H and K are the measures by the area; k1,
/// k2 and the directions come from the tensor, so k1 k2 is K only in the limit.
pub const UMB_CURVATURE_CORRECTED_MEASURE: umb_curvature_method = 12;

/// Which curvatures to compute, and how. All zero: adaptive jets, at all vertices.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_curvature_options {
    /// `sizeof(umb_curvature_options)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// The method.
    pub method: umb_curvature_method,
    /// The formula of sections, for `LEAST_SQUARES`, `TAUBIN` and `WATANABE`; others do not look at it. The parabolas are
    /// one here.
    pub section: umb_section,
    /// The weight of the vertex normals, if `normals.data` is null.
    pub weight: umb_weight,
    /// For measures, the radius of a ball around the vertex instead of rings (`rings` is 0 then), in the mesh's unit; 0 for
    /// none. A vertex
    /// connected to the centre inside the ball counts with its share of the surface, by the part of it inside. The cost
    /// grows with the number of vertices in each ball.
    pub radius: f64,
    /// The degree of jets, 2 to 4; 0 for 3. Other methods take 0.
    pub degree: u32,
    /// How many rings count, at most 8; 0 for the method's default. Methods of one ring take 0 and 1.
    pub rings: u32,
    /// `UMB_WEIGHT_JET` only: see `degree` of `umb_normal_options`.
    pub normal_degree: u32,
    /// `UMB_WEIGHT_JET` and `UMB_WEIGHT_ADAPTIVE_JET` only: see `rings` of `umb_normal_options`.
    pub normal_rings: u32,
    /// What adaptive jets, as method or as weight, know of the mesh, read only during the call; null to learn it from all
    /// positions.
    pub model: *const umb_adaptive_model,
    /// Vertex normals of the caller's, `#V x 3`, of any length, on the side from which the faces run counter-clockwise: those
    /// on the other change the signs of some methods and leave others without result. A vertex whose normal is zero has no
    /// curvature. Null data: computed with `weight`.
    pub normals: umb_points,
    /// How to run.
    pub run: umb_run,
}

/// Where curvatures go; any of them may be left out. All are pointwise unless the name says integrated.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_curvature_outputs {
    /// `sizeof(umb_curvature_outputs)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// The larger principal curvature, `#V`, 1/length.
    pub k1: umb_output,
    /// The smaller principal curvature, `#V`, 1/length.
    pub k2: umb_output,
    /// The unit tangent direction of k1, `#V x 3`; the first of its largest components is positive. At an umbilic, where
    /// every direction is principal, some tangent.
    pub direction1: umb_output,
    /// The unit tangent direction of k2, `#V x 3`: normal x direction1.
    pub direction2: umb_output,
    /// Mean curvature H = (k1 + k2) / 2, `#V`, 1/length.
    pub mean: umb_output,
    /// Gaussian curvature K = k1 k2, `#V`, 1/length^2.
    pub gaussian: umb_output,
    /// The mean curvature normal H N, `#V x 3`, 1/length: along the outward normals of a sphere.
    pub mean_normal: umb_output,
    /// The area that the vertex stands for, `#V`, length^2.
    pub area: umb_output,
    /// Mean curvature integrated over that area, `#V`, length. The normal cycle's is the sum over edges alone; its H is that
    /// of the tensor in the tangent plane, and differs from this by the area where the vertex normal leans.
    pub integrated_mean: umb_output,
    /// Gaussian curvature integrated over that area, `#V`, without unit.
    pub integrated_gaussian: umb_output,
    /// Koenderink's shape index (2/pi) atan((k1 + k2) / (k1 - k2)), `#V`: 1 at a cap, 0.5 on a ridge, 0 at a symmetric
    /// saddle and in a plane, -0.5 in a rut, -1 in a cup.
    pub shape_index: umb_output,
    /// Koenderink's curvedness sqrt((k1^2 + k2^2) / 2), `#V`, 1/length.
    pub curvedness: umb_output,
    /// The root mean square of what a fit left over, `#V`: length where heights were fitted, 1/length where curvatures
    /// were; for `GOLDFEATHER`, of heights, and of slopes times the root mean square distance of the neighbours.
    pub residual: umb_output,
    /// The condition number of a fit (Frobenius norm, columns of length 1, so not CGAL's), `#V`.
    pub condition: umb_output,
    /// `ADAPTIVE_JET` only: how many of the 15 coefficients the data decide, and not the prior, `#V`; 0 where nothing was fitted.
    pub degrees_of_freedom: umb_output,
    /// The unit normals that all this belongs to, `#V x 3`.
    pub normal: umb_output,
    /// `UMB_VERTEX_` bits, `#V`.
    pub status: umb_status_output,
}

/// Computes curvatures at the vertices of a mesh.
///
/// Signs: a normal section is positive where the surface bends away from the normal, so a sphere of radius r with outward
/// normals (faces counter-clockwise from outside) has k1 = k2 = H = 1/r and K = 1/r^2. k1 >= k2. Reversing all faces makes k1
/// of -k2 and the other way round, and exchanges the directions; H and its integral change sign, K, H N and areas do not.
///
/// A vertex without any face is isolated, one where the method has nothing to work with is degenerate (no normal, no area, no
/// edge with a length): all results are 0 there but the normal, if there is one. Nothing is ever NaN or infinite; beyond the scalar's range its largest value
/// stands. What each method makes of a boundary is said with its constant; the status tells boundary vertices.
///
/// Methods of one ring are computed in single precision if positions, given normals and outputs all are `f32` and faces are triangles
/// (not tilted sections; nor Watanabe's and Meyer's methods with outputs that follow from `k1` and `k2`; nor least squares with
/// residuals), and then only where that is off by less than about 2e-6 by the length of the shortest edge at the vertex; all else is
/// double precision. So asking for an output in `f64`, or for one of those named, changes the last bits of others. Computation is relative to each vertex and scaled by powers of two, so neither the distance
/// from the origin nor the size of the mesh costs accuracy. The results are the same bits for any number of threads, any
/// vectors and any choice of vertices.
///
/// Threads: any number of calls may use one topology at once. Cost: linear in the number of corners; for methods of several
/// rings, times the vertices within these. A neighbourhood of several rings ends at 255 vertices, breadth first, and takes
/// 64 evenly spaced neighbours of a vertex that has more.
///
/// @param topology the handle
/// @param points the positions of all its vertices, as many as the topology has; read only during the call
/// @param options may be null
/// @param outputs where results go; each has an element for every vertex. Written only if the call succeeds, or, after
/// a cancel, in part
/// @param error may be null
///
/// Errors: `UMB_ERROR_NULL_POINTER`, `_STRUCT_SIZE`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT`, `_STRIDE`, `_MISALIGNED`,
/// `_SIZE`, `_INDEX_OUT_OF_RANGE` (element: place in `vertices`), `_NON_FINITE` (element: vertex), `_NOT_APPLICABLE`,
/// `_OPTION_OUT_OF_RANGE`, `_OUT_OF_MEMORY`, `_CANCELLED`.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_curvatures(
    topology: *const umb_topology,
    points: *const umb_points,
    options: *const umb_curvature_options,
    outputs: *const umb_curvature_outputs,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let topology = &topology.as_ref().ok_or(Error::NullPointer { what: "topology" })?.0;
            let points = read_required(points, "points")?.view()?;
            let options = read_versioned(options)?;
            let outputs = curvature_outputs(outputs, topology.vertex_count())?;
            let asked = options.asked()?;
            let mut progress = options.run.callback();
            let run = options.run.view(progress.as_mut().map(|call| call as _))?;
            curvatures(topology, &points, &asked, run, &outputs)
        })
    }
}

impl umb_curvature_options {
    /// # Safety
    /// As the header asks.
    pub(super) unsafe fn asked<'a>(&self) -> Result<CurvatureOptions<'a>, Error> {
        let small = |what, value: u32| u8::try_from(value).map_err(|_| Error::OptionOutOfRange { what });
        let weight = AskedWeight {
            weight: self.weight,
            degree: (self.normal_degree, "options.normal_degree"),
            rings: (self.normal_rings, "options.normal_rings"),
            model: self.model,
        };
        let method = method(self.method)?;
        // SAFETY: handed on.
        unsafe {
            Ok(CurvatureOptions {
                method,
                section: section(self.section)?,
                normals: vertex_normals_asked(&self.normals, weight.view()?)?,
                model: if method == Method::AdaptiveJet { model_given(self.model)? } else { None },
                degree: small("options.degree", self.degree)?,
                rings: self.rings as usize,
                radius: self.radius,
            })
        }
    }
}

/// # Safety
/// `outputs` is null or as the header asks, its arrays with an element for each of `count` vertices.
unsafe fn curvature_outputs<'a>(
    outputs: *const umb_curvature_outputs,
    count: usize,
) -> Result<CurvatureOutputs<'a>, Error> {
    // SAFETY: handed on.
    unsafe {
        let outputs = required(outputs, "outputs")?;
        check_reserved("umb_curvature_outputs", offset_of!(umb_curvature_outputs, reserved), outputs.reserved)?;
        Ok(CurvatureOutputs {
            k1: outputs.k1.view(count)?,
            k2: outputs.k2.view(count)?,
            direction1: outputs.direction1.view(count)?,
            direction2: outputs.direction2.view(count)?,
            mean: outputs.mean.view(count)?,
            gaussian: outputs.gaussian.view(count)?,
            mean_normal: outputs.mean_normal.view(count)?,
            area: outputs.area.view(count)?,
            integrated_mean: outputs.integrated_mean.view(count)?,
            integrated_gaussian: outputs.integrated_gaussian.view(count)?,
            shape_index: outputs.shape_index.view(count)?,
            curvedness: outputs.curvedness.view(count)?,
            residual: outputs.residual.view(count)?,
            condition: outputs.condition.view(count)?,
            degrees_of_freedom: outputs.degrees_of_freedom.view(count)?,
            normal: outputs.normal.view(count)?,
            status: outputs.status.view(count)?,
        })
    }
}

fn method(value: umb_curvature_method) -> Result<Method, Error> {
    Ok(match value {
        UMB_CURVATURE_ADAPTIVE_JET => Method::AdaptiveJet,
        UMB_CURVATURE_JET => Method::Jet,
        UMB_CURVATURE_QUADRIC => Method::Quadric,
        UMB_CURVATURE_GOLDFEATHER => Method::Goldfeather,
        UMB_CURVATURE_TILTED_SECTIONS => Method::TiltedSections,
        UMB_CURVATURE_LEAST_SQUARES => Method::LeastSquares,
        UMB_CURVATURE_TAUBIN => Method::Taubin,
        UMB_CURVATURE_WATANABE => Method::Watanabe,
        UMB_CURVATURE_MEYER => Method::Meyer,
        UMB_CURVATURE_ANGLE_DEFECT => Method::AngleDefect,
        UMB_CURVATURE_RUSINKIEWICZ => Method::Rusinkiewicz,
        UMB_CURVATURE_NORMAL_CYCLE => Method::NormalCycle,
        UMB_CURVATURE_CORRECTED_MEASURE => Method::CorrectedMeasure,
        value => return Err(Error::UnknownConstant { what: "options.method", value: value as u64 }),
    })
}
