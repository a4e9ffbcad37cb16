//! Views and options as C sees them.

use super::guard::outside;
use super::versioned::{Versioned, check_reserved};
use crate::error::Error;
use crate::parallel::Run;
use crate::parts::ScalarField;
use crate::simd::Level;
use crate::view::{Bytes, Faces, Indices, Output, Points, Scalars, StatusOutput};
use libc::{c_int, c_void, size_t};
use std::mem::offset_of;

/// The scalar type of an array: `UMB_SCALAR_F32`, which is what a zeroed struct says, or `UMB_SCALAR_F64`.
pub type umb_scalar = u32;
/// 32-bit floating point; the default.
pub const UMB_SCALAR_F32: umb_scalar = 0;
/// 64-bit floating point.
pub const UMB_SCALAR_F64: umb_scalar = 1;

/// The integer type of an index array: `UMB_INDEX_U32`, `UMB_INDEX_I32` or `UMB_INDEX_U64`.
pub type umb_index = u32;
/// Unsigned, 32 bits; the default.
pub const UMB_INDEX_U32: umb_index = 0;
/// Signed, 32 bits; negative indices are refused.
pub const UMB_INDEX_I32: umb_index = 1;
/// Unsigned, 64 bits.
pub const UMB_INDEX_U64: umb_index = 2;

/// The widest vectors a call may use: a `UMB_SIMD_` constant. It never changes a bit of a result.
pub type umb_simd = u32;
/// The widest that the CPU has, or what the environment variable `UMBILIC_SIMD` names if that is narrower (`portable`, `avx2` or
/// `avx512`; read once); the default.
pub const UMB_SIMD_BEST: umb_simd = 0;
/// None: plain code that runs on any CPU.
pub const UMB_SIMD_PORTABLE: umb_simd = 1;
/// The same as [`UMB_SIMD_PORTABLE`], which uses SSE2 on every x86-64.
pub const UMB_SIMD_SSE2: umb_simd = 2;
/// At most AVX2.
pub const UMB_SIMD_AVX2: umb_simd = 3;
/// At most AVX-512.
pub const UMB_SIMD_AVX512: umb_simd = 4;

/// Vertex positions, `#V × 3`, borrowed for the call; also normals and directions, where a struct says so.
///
/// The coordinates of a vertex lie next to each other; vertices lie `stride` bytes apart, so the points of OpenMesh,
/// CGAL or MeshLab, and interleaved vertex buffers, are read where they are.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_points {
    /// The first coordinate of the first vertex, aligned to its scalar.
    pub data: *const c_void,
    /// The number of vertices.
    pub count: size_t,
    /// Bytes from one vertex to the next, a multiple of the scalar's size; 0 if packed.
    pub stride: size_t,
    /// The scalar type.
    pub scalar: umb_scalar,
    /// 0
    pub reserved: u32,
}

/// Where the numbers of a `umb_scalars` are: a `UMB_AT_` constant.
pub type umb_location = u32;
/// One for each vertex, `#V`; the default.
pub const UMB_AT_VERTICES: umb_location = 0;
/// One for each face, `#F`.
pub const UMB_AT_FACES: umb_location = 1;

/// Numbers to read, one for each vertex or for each face, borrowed for the call: curvatures, say.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_scalars {
    /// The first number, aligned to its scalar.
    pub data: *const c_void,
    /// How many there are.
    pub count: size_t,
    /// Bytes from one to the next, a multiple of the scalar's size; 0 if packed.
    pub stride: size_t,
    /// The scalar type.
    pub scalar: umb_scalar,
    /// Where they are.
    pub location: umb_location,
}

/// Faces, `#F` loops of vertex indices (counter-clockwise seen from outside), borrowed for the call.
///
/// Without offsets, every face has `arity` corners. With offsets, face `f` has the indices from `offsets[f]` up to
/// `offsets[f + 1]`: there are `face_count + 1` offsets, of the same integer type as the indices.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_faces {
    /// The corners of all faces, one face after the other, packed and aligned.
    pub indices: *const c_void,
    /// The number of indices.
    pub index_count: size_t,
    /// Where each face starts, and the end of the last; null if all faces have `arity` corners.
    pub offsets: *const c_void,
    /// The number of faces; without offsets it may be 0, and follows from `index_count`.
    pub face_count: size_t,
    /// The integer type of indices and offsets.
    pub index: umb_index,
    /// The corners of each face if `offsets` is null, 0 meaning 3; 0 if there are offsets.
    pub arity: u32,
}

/// An array to write, in the caller's memory: of vectors, `#V x 3`, or of single scalars, `#V`, as the field that holds it
/// says. Null `data`: not wanted.
///
/// It has an element for every vertex (or face) of the mesh or polyline. The bytes between elements are left alone, so an
/// output may be interleaved with the positions. Its elements must not overlap those of any other array of the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_output {
    /// The first scalar of the first element, aligned.
    pub data: *mut c_void,
    /// Bytes from one element to the next, a multiple of the scalar's size; 0 if packed.
    pub stride: size_t,
    /// The scalar type.
    pub scalar: umb_scalar,
    /// 0
    pub reserved: u32,
}

/// An array of bytes to write, in the caller's memory: `UMB_VERTEX_` or `UMB_POLYLINE_` bits. Null `data`: not wanted.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_status_output {
    /// The first byte.
    pub data: *mut u8,
    /// Bytes from one element to the next; 0 if packed.
    pub stride: size_t,
}

/// An array of bytes to read: `UMB_VERTEX_` bits or `UMB_SHAPE_` constants, as calls write them. Null `data` and no bytes: there are
/// none.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_bytes {
    /// The first byte.
    pub data: *const u8,
    /// How many there are.
    pub count: size_t,
    /// Bytes from one element to the next; 0 if packed.
    pub stride: size_t,
}

/// Called on the calling thread with the fraction done, 0 to 1; non-zero cancels. It must return (no `longjmp`, no
/// exception).
pub type umb_progress = Option<unsafe extern "C" fn(user: *mut c_void, fraction: f64) -> c_int>;

/// How a call is carried out. All zero: all cores where that pays, the widest vectors, all vertices, no progress. Its layout
/// is final, because it stands inside other structs; whatever comes later will stand in those.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_run {
    /// The number of threads, at most 256 of which are used; 0 for as many as pay, 1 for the calling thread alone. Never
    /// changes a bit of a result.
    pub threads: u32,
    /// The widest vectors to use.
    pub simd: umb_simd,
    /// The vertices to compute; null for all, so an empty list needs a pointer that is not null. Outputs stay indexed by
    /// vertex; those of other vertices are left alone, and positions that no listed vertex needs are not looked at (but by adaptive
    /// jets without a model, which learn from all). May
    /// repeat. The results are the same bits as those of a call for all vertices.
    pub vertices: *const u32,
    /// The number of `vertices`.
    pub vertex_count: size_t,
    /// Called now and then; may be null.
    pub progress: umb_progress,
    /// Handed to `progress`.
    pub user: *mut c_void,
}

macro_rules! versioned {
    ($($name:ident: $size_64:literal, $size_32:literal;)*) => {$(
        // SAFETY: repr(C), the size first, no padding, and any bytes are valid: pointers and a nullable function pointer
        // included.
        unsafe impl Versioned for super::$name {
            const NAME: &'static str = stringify!($name);
            const FIRST_SIZE: usize = if cfg!(target_pointer_width = "64") { $size_64 } else { $size_32 };
        }
        const _: () = assert!(size_of::<super::$name>() >= <super::$name as Versioned>::FIRST_SIZE);
    )*};
}
// The sizes of the first versions, which never change, with pointers of 64 and of 32 bits.
versioned! {
    umb_topology_options: 16, 16;
    umb_topology_stats: 152, 152;
    umb_adaptive_model: 88, 88;
    umb_normal_options: 64, 44;
    umb_face_options: 48, 32;
    umb_normal_outputs: 72, 48;
    umb_face_outputs: 72, 48;
    umb_creases: 48, 32;
    umb_corner_outputs: 96, 64;
    umb_moved: 48, 28;
    umb_shape_options: 88, 56;
    umb_feature_options: 56, 36;
    umb_watershed_options: 72, 48;
    umb_region_options: 112, 72;
    umb_curvature_options: 120, 88;
    umb_curvature_outputs: 408, 272;
    umb_section_options: 136, 92;
    umb_section_outputs: 72, 48;
    umb_polyline_options: 48, 32;
    umb_polyline_outputs: 120, 80;
}

impl umb_points {
    /// # Safety
    /// The fields describe memory that stays readable and unchanged for `'a`.
    pub(super) unsafe fn view<'a>(&self) -> Result<Points<'a>, Error> {
        check_reserved("umb_points", offset_of!(umb_points, reserved), self.reserved)?;
        // SAFETY: handed on.
        unsafe {
            match self.scalar {
                UMB_SCALAR_F32 => Points::from_raw_f32(self.data.cast(), self.count, self.stride),
                UMB_SCALAR_F64 => Points::from_raw_f64(self.data.cast(), self.count, self.stride),
                value => Err(Error::UnknownConstant { what: "points.scalar", value: value as u64 }),
            }
        }
    }
}

impl umb_scalars {
    /// # Safety
    /// The fields describe memory that stays readable and unchanged for `'a`.
    pub(super) unsafe fn view<'a>(&self) -> Result<Scalars<'a>, Error> {
        // SAFETY: handed on.
        match unsafe { self.field() }? {
            ScalarField::Vertices(scalars) | ScalarField::Faces(scalars) => Ok(scalars),
        }
    }

    /// As [`umb_scalars::view`], with where they are.
    ///
    /// # Safety
    /// As [`umb_scalars::view`].
    pub(super) unsafe fn field<'a>(&self) -> Result<ScalarField<'a>, Error> {
        // SAFETY: handed on.
        let scalars = unsafe {
            match self.scalar {
                UMB_SCALAR_F32 => Scalars::from_raw_f32(self.data.cast(), self.count, self.stride),
                UMB_SCALAR_F64 => Scalars::from_raw_f64(self.data.cast(), self.count, self.stride),
                value => Err(Error::UnknownConstant { what: "scalars.scalar", value: value as u64 }),
            }
        }?;
        match self.location {
            UMB_AT_VERTICES => Ok(ScalarField::Vertices(scalars)),
            UMB_AT_FACES => Ok(ScalarField::Faces(scalars)),
            value => Err(Error::UnknownConstant { what: "scalars.location", value: value as u64 }),
        }
    }
}

impl umb_faces {
    /// # Safety
    /// The fields describe memory that stays readable and unchanged for `'a`.
    pub(super) unsafe fn view<'a>(&self) -> Result<Faces<'a>, Error> {
        // SAFETY: handed on.
        let indices = unsafe { self.indices(self.indices, self.index_count, "faces.indices") }?;
        if self.offsets.is_null() {
            let arity = if self.arity == 0 { 3 } else { self.arity as usize };
            let faces = Faces::uniform(indices, arity)?;
            if self.face_count != 0 && self.face_count != faces.len() {
                let (found, expected) = (self.face_count as u64, faces.len() as u64);
                return Err(Error::Size { what: "faces.face_count", found, expected });
            }
            return Ok(faces);
        }
        if self.arity != 0 {
            return Err(Error::Size { what: "faces.arity", found: self.arity as u64, expected: 0 });
        }
        let Some(count) = self.face_count.checked_add(1) else {
            let expected = usize::MAX as u64 - 1;
            return Err(Error::Size { what: "faces.face_count", found: self.face_count as u64, expected });
        };
        // SAFETY: handed on.
        let offsets = unsafe { self.indices(self.offsets, count, "faces.offsets") }?;
        Faces::polygons(indices, offsets)
    }

    /// # Safety
    /// `data` points to `count` integers of the type that `self.index` names.
    unsafe fn indices<'a>(
        &self,
        data: *const c_void,
        count: usize,
        what: &'static str,
    ) -> Result<Indices<'a>, Error> {
        // SAFETY: handed on.
        unsafe {
            match self.index {
                UMB_INDEX_U32 => Indices::from_raw(data.cast::<u32>(), count, what),
                UMB_INDEX_I32 => Indices::from_raw(data.cast::<i32>(), count, what),
                UMB_INDEX_U64 => Indices::from_raw(data.cast::<u64>(), count, what),
                value => Err(Error::UnknownConstant { what: "faces.index", value: value as u64 }),
            }
        }
    }
}

impl umb_output {
    /// # Safety
    /// The fields describe memory of `count` elements that is ours alone for `'a`.
    pub(super) unsafe fn view<'a, const N: usize>(&self, count: usize) -> Result<Option<Output<'a, N>>, Error> {
        check_reserved("umb_output", offset_of!(umb_output, reserved), self.reserved)?;
        if !matches!(self.scalar, UMB_SCALAR_F32 | UMB_SCALAR_F64) {
            return Err(Error::UnknownConstant { what: "output.scalar", value: self.scalar as u64 });
        }
        if self.data.is_null() {
            return Ok(None);
        }
        // SAFETY: handed on.
        unsafe {
            match self.scalar {
                UMB_SCALAR_F32 => Output::from_raw_f32(self.data.cast(), count, self.stride).map(Some),
                _ => Output::from_raw_f64(self.data.cast(), count, self.stride).map(Some),
            }
        }
    }
}

impl umb_status_output {
    /// # Safety
    /// As [`umb_output::view`].
    pub(super) unsafe fn view<'a>(&self, count: usize) -> Result<Option<StatusOutput<'a>>, Error> {
        if self.data.is_null() {
            return Ok(None);
        }
        // SAFETY: handed on.
        unsafe { StatusOutput::from_raw(self.data, count, self.stride) }.map(Some)
    }
}

impl umb_bytes {
    /// The bytes, if there are any.
    ///
    /// # Safety
    /// The fields describe memory that stays readable and unchanged for `'a`.
    pub(super) unsafe fn view<'a>(&self, what: &'static str) -> Result<Option<Bytes<'a>>, Error> {
        if self.data.is_null() && self.count == 0 {
            return Ok(None);
        }
        // SAFETY: handed on.
        unsafe { Bytes::from_raw(self.data, self.count, self.stride, what) }.map(Some)
    }
}

/// `count` numbers, or none where `data` is null.
///
/// # Safety
/// `data` is null or points to `count` numbers that stay readable and unchanged for `'a`.
pub(super) unsafe fn numbers<'a>(
    data: *const u32,
    count: usize,
    what: &'static str,
) -> Result<Option<&'a [u32]>, Error> {
    if data.is_null() && count == 0 {
        return Ok(None);
    }
    // SAFETY: handed on.
    match unsafe { Indices::from_raw(data, count, what) }? {
        Indices::U32(numbers) => Ok(Some(numbers)),
        _ => Ok(None),
    }
}

/// The level that a `UMB_SIMD_` constant stands for.
pub(super) fn level_of(simd: umb_simd, what: &'static str) -> Result<Level, Error> {
    let level = match simd {
        UMB_SIMD_BEST => Some(Level::best()),
        UMB_SIMD_PORTABLE => Level::capped("portable"),
        UMB_SIMD_SSE2 => Level::capped("sse2"),
        UMB_SIMD_AVX2 => Level::capped("avx2"),
        UMB_SIMD_AVX512 => Level::capped("avx512"),
        _ => None,
    };
    level.ok_or(Error::UnknownConstant { what, value: simd as u64 })
}

impl umb_run {
    /// Refuses a list of vertices, for calls that have none; `byte` is where this stands in the struct `what`.
    pub(super) fn check_no_list(&self, what: &'static str, byte: usize) -> Result<(), Error> {
        if self.vertices.is_null() && self.vertex_count == 0 {
            return Ok(());
        }
        Err(Error::UnknownField { what, byte: byte + offset_of!(umb_run, vertices) })
    }

    /// The progress callback, as Rust calls it.
    pub(super) fn callback(&self) -> Option<impl FnMut(f64) -> bool + use<>> {
        let (progress, user) = (self.progress?, self.user);
        Some(move |fraction| {
            // Computed by now, in the library's floating-point environment.
            let fraction = std::hint::black_box(fraction);
            // SAFETY: the caller gave both for this purpose.
            outside(|| unsafe { progress(user, fraction) }) == 0
        })
    }

    /// # Safety
    /// `vertices` points to `vertex_count` readable indices, or is null.
    pub(super) unsafe fn view<'a>(&self, progress: Option<&'a mut dyn FnMut(f64) -> bool>) -> Result<Run<'a>, Error> {
        let level = level_of(self.simd, "run.simd")?;
        // SAFETY: handed on.
        let vertices = unsafe { numbers(self.vertices, self.vertex_count, "run.vertices") }?;
        Ok(Run { threads: self.threads as usize, level, vertices, progress })
    }
}
