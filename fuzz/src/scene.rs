//! A mesh with positions, and a topology built of it: what most calls start from.

use crate::arrays::Input;
use crate::coordinates::rows;
use crate::faces::FaceArrays;
use crate::shape::Shape;
use crate::source::Source;
use umbilic::capi::*;

/// Faces and positions as a call reads them.
pub struct Scene {
    /// What was meant; a hostile input may say something else.
    pub shape: Shape,
    pub rows: Vec<[f64; 3]>,
    pub faces: FaceArrays,
    pub vertex_count: usize,
    pub points: Input,
    /// Whether the positions are in double precision.
    pub double: bool,
}

impl Scene {
    pub fn new(source: &mut Source<'_>, too_many: bool) -> Scene {
        let shape = Shape::new(source);
        let double = source.half();
        let rows = rows(source, &shape.positions, shape.vertex_count, double);
        let faces = FaceArrays::new(source, &shape, too_many);
        let points = Input::new(source, &rows, 3, double);
        Scene { vertex_count: shape.vertex_count, shape, rows, faces, points, double }
    }

    /// A topology of the faces; none if they are refused.
    pub fn handle(&self) -> Option<Handle> {
        let mut handle = std::ptr::null_mut();
        let (options, error) = (std::ptr::null(), std::ptr::null_mut());
        let status = unsafe { umb_topology_create(&self.faces.view, self.vertex_count, options, &mut handle, error) };
        assert!(status < UMB_ERROR_INTERNAL, "umb_topology_create answers {status}");
        (status == UMB_OK).then_some(Handle { pointer: handle, vertex_count: self.vertex_count })
    }
}

/// A topology that frees itself.
pub struct Handle {
    pub pointer: *mut umb_topology,
    pub vertex_count: usize,
}

impl Handle {
    pub fn flags(&self) -> &[u8] {
        unsafe { std::slice::from_raw_parts(umb_topology_flags(self.pointer), self.vertex_count) }
    }

    /// Where each vertex's ring starts in the ring array, and the end of the last.
    pub fn ring_offsets(&self) -> &[u32] {
        unsafe { std::slice::from_raw_parts(umb_topology_ring_offsets(self.pointer), self.vertex_count + 1) }
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        unsafe { umb_topology_destroy(self.pointer) };
    }
}
