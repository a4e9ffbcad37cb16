//! Meshes cut along creases, and corner normals.

use super::guard::guard;
use super::normals::{umb_normal_options, vertex_views};
use super::status::{umb_error, umb_status};
use super::topology::{umb_topology, umb_topology_options};
use super::types::{numbers, umb_faces, umb_output, umb_points, umb_status_output};
use super::versioned::{check_reserved, read_required, read_versioned, required};
use crate::error::Error;
use crate::parallel::Run;
use crate::parts::{CornerOutputs, Creases, CutMesh, DEFAULT_CREASE_ANGLE, corner_normals};
use crate::view::{Output, boxed};
use libc::size_t;
use std::mem::offset_of;

/// A mesh cut open along its creases: a vertex for each run of faces around a vertex that no crease divides. Whatever is computed over
/// `umb_cut_topology` stops at creases: normals become corner normals, and fits and curvatures of one side take nothing from the
/// other. A `const umb_cut *` may be used from any number of threads at once.
pub struct umb_cut(CutMesh);

/// Which edges are creases; an edge is one if any field says so. All zero: those that are sharper than 30 degrees.
///
/// An edge with one face, with more than two, or whose two faces run through it in the same direction separates its faces in any
/// case. If cutting leaves just two of the faces at such an edge, in opposite directions, these meet there in the cut mesh: a sheet on which a
/// fin stands is whole.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_creases {
    /// `sizeof(umb_creases)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// An edge is a crease if the normals of its two faces differ by more than this angle, in radians; from pi on none is one by its
    /// angle. 0 stands for pi/6 if there are neither `edges` nor `groups`, else for pi. A face without area has the normal of a neighbour, across
    /// its longest edge to one that has one: so a sliver along a crease does not join its sides.
    pub angle: f64,
    /// Vertices of edges that are creases, two for each, in any order; pairs that no edge joins mean nothing. May be null.
    pub edges: *const u32,
    /// The number of pairs.
    pub edge_count: size_t,
    /// The smoothing group of each face, `#F`, a number as in OBJ files (not a mask of bits as in 3DS files): the edge between two faces is a
    /// crease if theirs differ or are 0, which is no group.
    /// Null: there are none.
    pub groups: *const u32,
    /// The number of faces, or 0 if `groups` is null.
    pub group_count: size_t,
}

/// Where corner normals go; any of them may be left out.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_corner_outputs {
    /// `sizeof(umb_corner_outputs)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// A unit normal for each corner, `#C x 3`, in the order of the indices of the faces; (0, 0, 0) where there is none.
    pub corner: umb_output,
    /// The same normals, each once: a unit normal for each vertex of the cut mesh, to which `umb_cut_corners` are the index.
    pub normal: umb_output,
    /// By vertex of the cut mesh: see `sum` of `umb_normal_outputs`.
    pub sum: umb_output,
    /// `UMB_VERTEX_` bits by vertex of the cut mesh, on which a crease is a boundary.
    pub status: umb_status_output,
}

/// Cuts a mesh along its creases.
///
/// Corners at a vertex stay together if they can be reached from each other across edges at the vertex that two faces share (as
/// `umb_topology_create` joins them) and that are no creases. So a vertex with several fans is cut between them, and a crease that ends
/// in a smooth part does not cut the vertex at its end. Vertices of the cut mesh are numbered by the vertex they come from, those of one by
/// their first corners; a vertex without faces keeps one. So without creases on a manifold mesh, numbers stay what they are.
///
/// Positions are looked at for the angles only: as they move, the cut stays until the caller makes another.
///
/// Cost: linear in the number of corners, on one thread but for normals and topology. Held are the topology and 4 bytes a corner, a
/// vertex and a vertex of the cut mesh.
///
/// @param faces the faces; read only during the call
/// @param points the positions of all vertices; read only during the call
/// @param creases which edges to cut; may be null
/// @param options how to build the topology; may be null
/// @param cut receives the handle; destroy it with `umb_cut_destroy`
/// @param error may be null
///
/// Errors: those of `umb_topology_create`; `UMB_ERROR_STRIDE`, `_INDEX_OUT_OF_RANGE` also for `creases.edges` (element: place in it),
/// `_NON_FINITE` (element: vertex), `_OPTION_OUT_OF_RANGE` for an angle that is negative or NaN.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_cut_create(
    faces: *const umb_faces,
    points: *const umb_points,
    creases: *const umb_creases,
    options: *const umb_topology_options,
    cut: *mut *mut umb_cut,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let (threads, level) = read_versioned(options)?.how()?;
            let creases = read_versioned(creases)?.view()?;
            let faces = read_required(faces, "faces")?.view()?;
            let points = read_required(points, "points")?.view()?;
            if cut.is_null() {
                return Err(Error::NullPointer { what: "cut" });
            }
            let run = Run { threads, level, ..Run::default() };
            let made = CutMesh::new(&faces, &points, &creases, run)?;
            cut.write_unaligned(Box::into_raw(boxed(umb_cut(made))?));
            Ok(())
        })
    }
}

/// Frees a cut mesh, its topology included; null is fine.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_cut_destroy(cut: *mut umb_cut) {
    if !cut.is_null() {
        // SAFETY: made by `umb_cut_create`, and the caller lets go of it.
        drop(unsafe { Box::from_raw(cut) });
    }
}

/// The topology of the cut mesh, for every call that takes one; it lives as long as the cut mesh and must not be destroyed. Null for
/// null.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_cut_topology(cut: *const umb_cut) -> *const umb_topology {
    // SAFETY: null or a handle.
    unsafe { cut.as_ref() }.map_or(std::ptr::null(), |cut| umb_topology::from_ref(cut.0.topology()))
}

/// The number of vertices of the cut mesh; 0 for null.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_cut_vertex_count(cut: *const umb_cut) -> size_t {
    // SAFETY: null or a handle.
    unsafe { cut.as_ref() }.map_or(0, |cut| cut.0.origins().len())
}

/// The number of corners, those of ignored faces included; 0 for null.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_cut_corner_count(cut: *const umb_cut) -> size_t {
    // SAFETY: null or a handle.
    unsafe { cut.as_ref() }.map_or(0, |cut| cut.0.corners().len())
}

/// The vertex of the cut mesh at each corner, `#C` numbers in the handle's memory: the faces of the cut mesh, with the offsets or the arity
/// of the original ones. Null for null.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_cut_corners(cut: *const umb_cut) -> *const u32 {
    // SAFETY: null or a handle.
    unsafe { cut.as_ref() }.map_or(std::ptr::null(), |cut| cut.0.corners().as_ptr())
}

/// The original vertex of each vertex of the cut mesh, ascending, in the handle's memory; null for null.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_cut_origins(cut: *const umb_cut) -> *const u32 {
    // SAFETY: null or a handle.
    unsafe { cut.as_ref() }.map_or(std::ptr::null(), |cut| cut.0.origins().as_ptr())
}

/// Where the vertices of the cut mesh that come from each original vertex start, `#V + 1` numbers in the handle's memory: those of vertex `v` are
/// the numbers from `starts[v]` up to `starts[v + 1]`, so that what moves or is marked there is found here. Null for null.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_cut_starts(cut: *const umb_cut) -> *const u32 {
    // SAFETY: null or a handle.
    unsafe { cut.as_ref() }.map_or(std::ptr::null(), |cut| cut.0.starts().as_ptr())
}

/// Copies an element for each original vertex, positions for example, to each vertex of the cut mesh that comes from it: what calls
/// over `umb_cut_topology` take. A number beyond the range of the output's scalar becomes its largest; what is not finite stays so.
///
/// @param cut the handle
/// @param points an element for each original vertex
/// @param output receives an element for each vertex of the cut mesh; must not overlap `points`
/// @param error may be null
///
/// Errors: `UMB_ERROR_NULL_POINTER`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT`, `_STRIDE`, `_MISALIGNED`, `_SIZE`.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_cut_points(
    cut: *const umb_cut,
    points: *const umb_points,
    output: *const umb_output,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let cut = &cut.as_ref().ok_or(Error::NullPointer { what: "cut" })?.0;
            let points = read_required(points, "points")?.view()?;
            cut.copy(&points, &wanted(output, "output", cut.origins().len())?)
        })
    }
}

/// Computes a unit normal for each corner of each face: smooth where faces go on, split at creases.
///
/// They are the vertex normals of the cut mesh, by any weight: an open run of faces counts as one at a boundary does. Where nothing is cut, they are those of
/// `umb_vertex_normals`, to the bit if all outputs are of one scalar: one in `f64` has all computed in double precision. `UMB_WEIGHT_ANGLE` is what Blender takes for corner normals, and what those expect who bake
/// or shade with MikkTSpace: it makes tangents, and takes normals as they are given.
///
/// A renderer that has an index for each attribute takes `normal` with `umb_cut_corners`; one that has a single index
/// takes `umb_cut_corners` as that, `normal`, and positions by `umb_cut_points`; others take `corner`.
///
/// @param cut the handle
/// @param points the positions of the original vertices; read only during the call
/// @param options as for `umb_vertex_normals`; a list of vertices is one of the cut mesh, and goes without `corner`. May be null
/// @param outputs where results go
/// @param error may be null; the element of a position that is not finite is the original vertex
///
/// Errors: those of `umb_vertex_normals`; `_NOT_APPLICABLE` for `corner` with a list.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_corner_normals(
    cut: *const umb_cut,
    points: *const umb_points,
    options: *const umb_normal_options,
    outputs: *const umb_corner_outputs,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let cut = &cut.as_ref().ok_or(Error::NullPointer { what: "cut" })?.0;
            let points = read_required(points, "points")?.view()?;
            let options = read_versioned(options)?;
            let outputs = required(outputs, "outputs")?;
            check_reserved("umb_corner_outputs", offset_of!(umb_corner_outputs, reserved), outputs.reserved)?;
            let outputs = CornerOutputs {
                corner: outputs.corner.view(cut.corners().len())?,
                vertex: vertex_views(&outputs.normal, &outputs.sum, &outputs.status, cut.origins().len())?,
            };
            let mut progress = options.run.callback();
            let run = options.run.view(progress.as_mut().map(|call| call as _))?;
            corner_normals(cut, &points, options.asked()?, run, &outputs)
        })
    }
}

/// Computes corner normals once, straight from faces: cuts the mesh for the call and forgets it. The results are those of
/// `umb_corner_normals`, to the bit.
///
/// @param faces the faces; read only during the call
/// @param points the positions of all vertices; read only during the call
/// @param creases which edges to cut; may be null
/// @param options as for `umb_vertex_normals`, without a list; may be null
/// @param corner receives a unit normal for each corner, `#C x 3`, in the order of the indices of the faces
/// @param error may be null
///
/// Errors: those of `umb_cut_create` and `umb_corner_normals`.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_corner_normals_from_faces(
    faces: *const umb_faces,
    points: *const umb_points,
    creases: *const umb_creases,
    options: *const umb_normal_options,
    corner: *const umb_output,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let creases = read_versioned(creases)?.view()?;
            let faces = read_required(faces, "faces")?.view()?;
            let points = read_required(points, "points")?.view()?;
            let options = read_versioned(options)?;
            let corner = Some(wanted(corner, "corner", faces.indices().len())?);
            let mut progress = options.run.callback();
            let mut run = options.run.view(progress.as_mut().map(|call| call as _))?;
            let weight = options.asked()?;
            if run.vertices.is_some() {
                return Err(Error::NotApplicable { what: "corner normals of a list of vertices" });
            }
            let cut = run.part(0.0, CUT_SHARE, |run| CutMesh::new(&faces, &points, &creases, run))?;
            let outputs = CornerOutputs { corner, ..CornerOutputs::default() };
            run.part(CUT_SHARE, 1.0, |run| corner_normals(&cut, &points, weight, run, &outputs))
        })
    }
}

/// The part of `umb_corner_normals_from_faces` that goes into cutting, for progress.
const CUT_SHARE: f64 = 0.8;

/// An output that may not be left out.
///
/// # Safety
/// `output` is null, or as the header asks, with `count` elements.
unsafe fn wanted<'a>(output: *const umb_output, what: &'static str, count: usize) -> Result<Output<'a>, Error> {
    // SAFETY: handed on.
    unsafe { read_required(output, what)?.view(count)? }.ok_or(Error::NullPointer { what })
}

impl umb_creases {
    /// # Safety
    /// The fields describe memory that stays readable and unchanged for `'a`.
    pub(super) unsafe fn view<'a>(&self) -> Result<Creases<'a>, Error> {
        check_reserved("umb_creases", offset_of!(umb_creases, reserved), self.reserved)?;
        let Some(ends) = self.edge_count.checked_mul(2) else {
            let expected = usize::MAX as u64 / 2;
            return Err(Error::Size { what: "creases.edge_count", found: self.edge_count as u64, expected });
        };
        // SAFETY: handed on.
        let (edges, groups) = unsafe {
            (numbers(self.edges, ends, "creases.edges")?, numbers(self.groups, self.group_count, "creases.groups")?)
        };
        let (edges, _) = edges.unwrap_or_default().as_chunks();
        let marked = !edges.is_empty() || groups.is_some();
        let angle = match self.angle {
            0.0 if marked => std::f64::consts::PI,
            0.0 => DEFAULT_CREASE_ANGLE,
            angle => angle,
        };
        Ok(Creases { angle, edges, groups })
    }
}
