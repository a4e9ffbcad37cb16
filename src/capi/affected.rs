//! What changes as vertices move.

use super::curvature::umb_curvature_options;
use super::guard::guard;
use super::normals::umb_normal_options;
use super::status::{umb_error, umb_status};
use super::topology::umb_topology;
use super::types::{numbers, umb_bytes};
use super::versioned::{check_reserved, read_versioned, required};
use crate::error::Error;
use crate::parts::{affected_curvatures, affected_normals};
use crate::view::Bytes;
use libc::size_t;
use std::mem::offset_of;

/// Vertices that have moved since normals or curvatures were computed.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_moved {
    /// `sizeof(umb_moved)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// The vertices; may repeat. May be null if there are none.
    pub vertices: *const u32,
    /// The number of `vertices`.
    pub vertex_count: size_t,
    /// The status bytes of the results as they were, `#V`, which calls for lists have kept up to date: they tell fits whose neighbourhood was
    /// widened. May be none: then it is assumed of every vertex, and lists for jets, quadrics and Goldfeather's fits are longer.
    pub status: umb_bytes,
}

/// Lists the vertices whose normals may change as others move: what `vertices` of `umb_run` has to be for a call that brings the normals up
/// to date. Such a call gives, with those it leaves alone, the same bits as a call for all.
///
/// These are the vertices within as many rings of those that moved as a normal depends on: one for averages, those of the fit for jets,
/// one more than those of the fit for adaptive jets. Adaptive jets need a model (`umb_learn_model`): without, each normal depends on all
/// positions.
///
/// Threads: any number of calls may use one topology at once. Cost: the rings of what is found, and next to nothing for the rest of
/// the mesh: a byte a vertex that is cleared.
///
/// @param topology the handle
/// @param moved the vertices that moved
/// @param options those of the call for the normals; `run` is not looked at. May be null
/// @param vertices receives the list, each vertex once, those that moved first; null, with no room, to ask for their number alone
/// @param room how many `vertices` has room for; as many as the topology has vertices are enough for any list
/// @param count receives the number of vertices in the list
/// @param error may be null
///
/// Errors: `UMB_ERROR_NULL_POINTER`, `_STRUCT_SIZE`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT`, `_MISALIGNED`, `_SIZE`,
/// `_INDEX_OUT_OF_RANGE` (element: place in `moved->vertices`), `_NOT_APPLICABLE` (no model), `_OPTION_OUT_OF_RANGE`, `_OUT_OF_MEMORY`.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_affected_normals(
    topology: *const umb_topology,
    moved: *const umb_moved,
    options: *const umb_normal_options,
    vertices: *mut u32,
    room: size_t,
    count: *mut size_t,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let topology = &topology.as_ref().ok_or(Error::NullPointer { what: "topology" })?.0;
            let moved = required(moved, "moved")?;
            let (list, statuses) = moved.view()?;
            let weight = read_versioned(options)?.asked()?;
            hand_out(vertices, room, count, || affected_normals(topology, list, weight, statuses.as_ref()))
        })
    }
}

/// Lists the vertices whose curvatures may change as others move, or as normals do that the caller gives for them. Else as
/// `umb_affected_normals`; the curvatures of regions by `radius` have no list (`UMB_ERROR_NOT_APPLICABLE`).
///
/// @param topology the handle
/// @param moved the vertices that moved, or whose given normals changed
/// @param options those of the call for the curvatures; `run` is not looked at. May be null
/// @param vertices receives the list, each vertex once, those that moved first; null, with no room, to ask for their number alone
/// @param room how many `vertices` has room for; as many as the topology has vertices are enough for any list
/// @param count receives the number of vertices in the list
/// @param error may be null
///
/// Errors: as `umb_affected_normals`; `_STRIDE` for given normals.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_affected_curvatures(
    topology: *const umb_topology,
    moved: *const umb_moved,
    options: *const umb_curvature_options,
    vertices: *mut u32,
    room: size_t,
    count: *mut size_t,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let topology = &topology.as_ref().ok_or(Error::NullPointer { what: "topology" })?.0;
            let moved = required(moved, "moved")?;
            let (list, statuses) = moved.view()?;
            let options = read_versioned(options)?.asked()?;
            hand_out(vertices, room, count, || affected_curvatures(topology, list, &options, statuses.as_ref()))
        })
    }
}

impl umb_moved {
    /// The vertices, and the statuses if there are any.
    ///
    /// # Safety
    /// The fields describe memory that stays readable and unchanged for `'a`.
    unsafe fn view<'a>(&self) -> Result<(&'a [u32], Option<Bytes<'a>>), Error> {
        check_reserved("umb_moved", offset_of!(umb_moved, reserved), self.reserved)?;
        // SAFETY: handed on.
        unsafe {
            let list = numbers(self.vertices, self.vertex_count, "moved.vertices")?;
            Ok((list.unwrap_or_default(), self.status.view("moved.status")?))
        }
    }
}

/// Writes a list and its length.
///
/// # Safety
/// `vertices` is null or has room for `room` numbers; `count` is null or may be written.
unsafe fn hand_out(
    vertices: *mut u32,
    room: usize,
    count: *mut size_t,
    list: impl FnOnce() -> Result<Vec<u32>, Error>,
) -> Result<(), Error> {
    if vertices.is_null() && room > 0 {
        return Err(Error::NullPointer { what: "vertices" });
    }
    if count.is_null() {
        return Err(Error::NullPointer { what: "count" });
    }
    let list = list()?;
    if !vertices.is_null() && room < list.len() {
        return Err(Error::Size { what: "room", found: room as u64, expected: list.len() as u64 });
    }
    // SAFETY: not null where something is written, and with room.
    unsafe {
        if !vertices.is_null() {
            std::ptr::copy_nonoverlapping(list.as_ptr().cast::<u8>(), vertices.cast(), size_of_val(&list[..]));
        }
        count.write_unaligned(list.len());
    }
    Ok(())
}
