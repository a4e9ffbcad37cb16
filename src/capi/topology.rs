//! Topology handles.

use super::guard::guard;
use super::status::{umb_error, umb_status};
use super::types::{level_of, umb_faces, umb_simd};
use super::versioned::{check_reserved, read_required, read_versioned, write_versioned};
use crate::error::Error;
use crate::simd::Level;
use crate::topology::{Topology, status};
use crate::view::boxed;
use libc::size_t;
use std::mem::offset_of;

/// Bit of a status byte, and of a vertex's flags (0 is an ordinary interior vertex): an edge at the vertex has only one
/// face.
pub const UMB_VERTEX_BOUNDARY: u8 = 1;
/// The faces at the vertex do not form a single fan.
pub const UMB_VERTEX_NON_MANIFOLD: u8 = 2;
/// The two faces of an edge at the vertex run through it in the same direction.
pub const UMB_VERTEX_WINDING: u8 = 4;
/// No face uses the vertex; its results are zero.
pub const UMB_VERTEX_ISOLATED: u8 = 8;
/// The estimator had nothing to work with at the vertex, and a simpler one took its place.
pub const UMB_VERTEX_FALLBACK: u8 = 16;
/// Nothing at all could be computed; the results are zero. Also the status of a face without area.
pub const UMB_VERTEX_DEGENERATE: u8 = 32;
/// The neighbourhood asked for had too few vertices, or too few in general position, and was widened.
pub const UMB_VERTEX_WIDENED: u8 = 64;
/// A face of the vertex is more than 37 degrees from its one-ring normal: a crease, or a very coarse or noisy place. Set by adaptive
/// jets only. Where no smooth surface goes with the faces, `UMB_VERTEX_FALLBACK` is set as well: the normal is then the mean direction
/// of the sides of the crease, and curvatures are those of sections. A vertex without a fit does not carry it.
pub const UMB_VERTEX_CREASE: u8 = 128;

const _: () = {
    assert!(UMB_VERTEX_BOUNDARY == status::BOUNDARY && UMB_VERTEX_NON_MANIFOLD == status::NON_MANIFOLD);
    assert!(UMB_VERTEX_WINDING == status::WINDING && UMB_VERTEX_ISOLATED == status::ISOLATED);
    assert!(UMB_VERTEX_FALLBACK == status::FALLBACK && UMB_VERTEX_DEGENERATE == status::DEGENERATE);
    assert!(UMB_VERTEX_WIDENED == status::WIDENED && UMB_VERTEX_CREASE == status::CREASE);
};

/// The one-rings of a mesh, built once from its faces and reused while positions move. A `const umb_topology *` may be
/// used from any number of threads at once.
// Not in documentation, and so not seen by cbindgen, to which the struct is opaque.
#[cfg_attr(not(doc), repr(transparent))]
pub struct umb_topology(pub(super) Topology);

impl umb_topology {
    /// A topology that something else holds, as a handle.
    pub(super) fn from_ref(topology: &Topology) -> *const umb_topology {
        std::ptr::from_ref(topology).cast()
    }
}

/// How a topology is built. All zero: the defaults.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_topology_options {
    /// `sizeof(umb_topology_options)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// The number of threads, the calling one among them; 0 for as many as pay, at most one a core. At most 256 are used, and
    /// they end with the call.
    pub threads: u32,
    /// The widest vectors to use: a `UMB_SIMD_` constant.
    pub simd: umb_simd,
    /// 0
    pub reserved: u32,
}

impl umb_topology_options {
    /// Threads and level.
    pub(super) fn how(&self) -> Result<(usize, Level), Error> {
        check_reserved("umb_topology_options", offset_of!(umb_topology_options, reserved), self.reserved)?;
        Ok((self.threads as usize, level_of(self.simd, "topology_options.simd")?))
    }
}

/// What a mesh is made of, and what is wrong with it.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_topology_stats {
    /// `sizeof(umb_topology_stats)`, set by the caller; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// Vertices.
    pub vertex_count: u64,
    /// Faces, ignored ones included.
    pub face_count: u64,
    /// Corners of the faces that are not ignored.
    pub corner_count: u64,
    /// Edges, each counted once however many faces it has.
    pub edge_count: u64,
    /// Edges with one face.
    pub boundary_edges: u64,
    /// Edges with more than two faces.
    pub non_manifold_edges: u64,
    /// Edges whose two faces run through them in the same direction.
    pub winding_edges: u64,
    /// Vertices without a face.
    pub isolated_vertices: u64,
    /// Vertices on an edge with one face.
    pub boundary_vertices: u64,
    /// Vertices whose faces do not form a single fan.
    pub non_manifold_vertices: u64,
    /// Faces that name a vertex twice in a row, or that have fewer than three corners.
    pub degenerate_faces: u64,
    /// Degenerate faces of which fewer than three corners remain: they are ignored.
    pub ignored_faces: u64,
    /// Faces that run through the same vertices in the same order as an earlier one. They count like any other.
    pub duplicate_faces: u64,
    /// Pieces, connected through shared vertices; isolated vertices are not counted.
    pub component_count: u64,
    /// Closed loops of edges with one face. At a vertex with several fans the loop follows the fan.
    pub boundary_loops: u64,
    /// Vertices that have faces, minus edges, plus faces that are not ignored.
    pub euler_characteristic: i64,
    /// The largest number of edges at a vertex.
    pub max_valence: u64,
    /// Heap memory that the handle holds, in bytes.
    pub bytes: u64,
}

/// One fan of a vertex: a run of faces in which each shares an edge with the next.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_fan {
    /// The neighbours in counter-clockwise order; the handle's memory, valid until it is destroyed.
    pub neighbours: *const u32,
    /// `corner_count` in a closed fan, one more in an open one.
    pub neighbour_count: size_t,
    /// The number of faces in the fan.
    pub corner_count: size_t,
    /// 1 if the last face meets the first, else 0.
    pub closed: u32,
    /// 0
    pub reserved: u32,
}

/// Builds the one-rings of a mesh.
///
/// Faces are joined across an edge only where it has exactly two and they run through it in opposite directions; every
/// other edge (one face, three or more, inconsistent winding) ends the fans on all its sides, and is counted. Faces that
/// name a vertex twice in a row lose the repetition; faces of fewer than three corners are ignored. No mesh is refused for
/// its shape.
///
/// Cost: linear in the number of corners, apart from sorting the corners of vertices with more than eight of them or with
/// several fans; every thread reads all faces. Held are about 16 bytes a triangle, or 60 a quad. While building, 65 more a vertex,
/// or 97 where there are polygons, and with several threads 12 more a triangle. The handle is the same on any number of threads, with any vectors.
///
/// @param faces the faces; read only during the call
/// @param vertex_count the number of vertices, at most 2^32 - 1, as of faces; there may be at most 2^31 - 1 corners
/// @param options may be null
/// @param topology receives the handle; destroy it with `umb_topology_destroy`
/// @param error may be null
///
/// Errors: `UMB_ERROR_NULL_POINTER`, `_STRUCT_SIZE`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT`, `_MISALIGNED`, `_SIZE`,
/// `_OFFSETS` (element: face), `_INDEX_OUT_OF_RANGE` (element: place in `indices`), `_TOO_LARGE`, `_OUT_OF_MEMORY`.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_topology_create(
    faces: *const umb_faces,
    vertex_count: size_t,
    options: *const umb_topology_options,
    topology: *mut *mut umb_topology,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let (threads, level) = read_versioned(options)?.how()?;
            let faces = read_required(faces, "faces")?.view()?;
            if topology.is_null() {
                return Err(Error::NullPointer { what: "topology" });
            }
            let built = Topology::with_threads(&faces, vertex_count, threads, level)?;
            topology.write_unaligned(Box::into_raw(boxed(umb_topology(built))?));
            Ok(())
        })
    }
}

/// Frees a topology; null is fine.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_topology_destroy(topology: *mut umb_topology) {
    if !topology.is_null() {
        // SAFETY: made by `umb_topology_create`, and the caller lets go of it.
        drop(unsafe { Box::from_raw(topology) });
    }
}

/// The number of vertices; 0 for null.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_topology_vertex_count(topology: *const umb_topology) -> size_t {
    // SAFETY: null or a handle.
    unsafe { topology.as_ref() }.map_or(0, |topology| topology.0.vertex_count())
}

/// The number of faces, ignored ones included; 0 for null.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_topology_face_count(topology: *const umb_topology) -> size_t {
    // SAFETY: null or a handle.
    unsafe { topology.as_ref() }.map_or(0, |topology| topology.0.face_count())
}

/// The `UMB_VERTEX_` bits of each vertex that follow from the faces alone, `#V` bytes in the handle's memory; null for
/// null.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_topology_flags(topology: *const umb_topology) -> *const u8 {
    // SAFETY: null or a handle.
    unsafe { topology.as_ref() }.map_or(std::ptr::null(), |topology| topology.0.flags().as_ptr())
}

/// Counts elements, defects, components and boundary loops. Linear in the size of the mesh.
///
/// @param topology the handle
/// @param stats receives the counts; set its `struct_size` (or 0) before
/// @param error may be null
///
/// Errors: `UMB_ERROR_NULL_POINTER`, `_STRUCT_SIZE`, `_OUT_OF_MEMORY`.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_topology_get_stats(
    topology: *const umb_topology,
    stats: *mut umb_topology_stats,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let topology = topology.as_ref().ok_or(Error::NullPointer { what: "topology" })?;
            write_versioned(stats, "stats", || {
                let found = topology.0.stats()?;
                Ok(umb_topology_stats {
                    struct_size: 0,
                    reserved: 0,
                    vertex_count: found.vertex_count as u64,
                    face_count: found.face_count as u64,
                    corner_count: found.corner_count as u64,
                    edge_count: found.edge_count as u64,
                    boundary_edges: found.boundary_edges as u64,
                    non_manifold_edges: found.non_manifold_edges as u64,
                    winding_edges: found.winding_edges as u64,
                    isolated_vertices: found.isolated_vertices as u64,
                    boundary_vertices: found.boundary_vertices as u64,
                    non_manifold_vertices: found.non_manifold_vertices as u64,
                    degenerate_faces: found.degenerate_faces as u64,
                    ignored_faces: found.ignored_faces as u64,
                    duplicate_faces: found.duplicate_faces as u64,
                    component_count: found.component_count as u64,
                    boundary_loops: found.boundary_loops as u64,
                    euler_characteristic: found.euler_characteristic,
                    max_valence: found.max_valence as u64,
                    bytes: found.bytes as u64,
                })
            })
        })
    }
}

/// Where each vertex's ring starts in the ring array, and the end of the last: `#V + 1` numbers, in the topology's memory;
/// null if `topology` is.
///
/// The ring of a vertex holds its neighbours fan after fan, each counter-clockwise: in a closed fan one for each of its faces,
/// in an open one one more (see `umb_topology_fan`).
///
/// @param topology the handle
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_topology_ring_offsets(topology: *const umb_topology) -> *const u32 {
    // SAFETY: null or a handle.
    unsafe { topology.as_ref() }.map_or(std::ptr::null(), |topology| topology.0.ring_offsets().as_ptr())
}

/// The ring array: the neighbours of all vertices, in the topology's memory; null if `topology` is.
///
/// @param topology the handle
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_topology_ring_neighbours(topology: *const umb_topology) -> *const u32 {
    // SAFETY: null or a handle.
    unsafe { topology.as_ref() }.map_or(std::ptr::null(), |topology| topology.0.ring_neighbours().as_ptr())
}

/// The number of edges at a vertex. Constant time at a manifold vertex; at one with several fans a copy of its ring is
/// sorted.
///
/// @param topology the handle
/// @param vertex the vertex
/// @param valence receives the number
/// @param error may be null
///
/// Errors: `UMB_ERROR_NULL_POINTER`, `_INDEX_OUT_OF_RANGE` (element: the vertex), `_OUT_OF_MEMORY`.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_topology_valence(
    topology: *const umb_topology,
    vertex: size_t,
    valence: *mut size_t,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let topology = at_vertex(topology, vertex)?;
            write_required(valence, "valence", topology.valence(vertex)?)
        })
    }
}

/// The number of fans of a vertex: 1 at a manifold vertex, 0 at an isolated one.
///
/// @param topology the handle
/// @param vertex the vertex
/// @param fan_count receives the number
/// @param error may be null
///
/// Errors: `UMB_ERROR_NULL_POINTER`, `_INDEX_OUT_OF_RANGE` (element: the vertex).
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_topology_fan_count(
    topology: *const umb_topology,
    vertex: size_t,
    fan_count: *mut size_t,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let topology = at_vertex(topology, vertex)?;
            write_required(fan_count, "fan_count", topology.fan_count(vertex))
        })
    }
}

/// A fan of a vertex: its part of the vertex's ordered one-ring.
///
/// @param topology the handle
/// @param vertex the vertex
/// @param index which of its fans, below `umb_topology_fan_count`
/// @param fan receives the fan
/// @param error may be null
///
/// Errors: `UMB_ERROR_NULL_POINTER`, `_INDEX_OUT_OF_RANGE` (element: the vertex, or the index of the fan).
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_topology_fan(
    topology: *const umb_topology,
    vertex: size_t,
    index: size_t,
    fan: *mut umb_fan,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let topology = at_vertex(topology, vertex)?;
            let count = topology.fan_count(vertex);
            if index >= count {
                return Err(Error::NoSuchElement { what: "fan", index: index as u64, count: count as u64 });
            }
            let found = topology.fan(vertex, index);
            let neighbours = found.neighbours;
            write_required(
                fan,
                "fan",
                umb_fan {
                    neighbours: neighbours.as_ptr(),
                    neighbour_count: neighbours.len(),
                    corner_count: found.corner_count,
                    closed: found.closed as u32,
                    reserved: 0,
                },
            )
        })
    }
}

/// # Safety
/// `topology` is null or a handle.
unsafe fn at_vertex<'a>(topology: *const umb_topology, vertex: usize) -> Result<&'a Topology, Error> {
    // SAFETY: handed on.
    let topology = unsafe { topology.as_ref() }.ok_or(Error::NullPointer { what: "topology" })?;
    let vertex_count = topology.0.vertex_count() as u64;
    if vertex as u64 >= vertex_count {
        return Err(Error::NoSuchElement { what: "vertex", index: vertex as u64, count: vertex_count });
    }
    Ok(&topology.0)
}

/// # Safety
/// `pointer` is null, or points to a writable `T`, aligned or not.
unsafe fn write_required<T>(pointer: *mut T, what: &'static str, value: T) -> Result<(), Error> {
    if pointer.is_null() {
        return Err(Error::NullPointer { what });
    }
    // SAFETY: not null, so writable.
    unsafe { pointer.write_unaligned(value) };
    Ok(())
}
