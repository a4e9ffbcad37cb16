//! Segmentations.

use super::curvature::umb_curvature_options;
use super::cut::umb_creases;
use super::guard::guard;
use super::status::{umb_error, umb_status};
use super::types::{umb_bytes, umb_faces, umb_points, umb_run, umb_scalars};
use super::versioned::{check_reserved, read_required, read_versioned};
use crate::error::Error;
use crate::parts::{
    RegionOptions, Segmentation, feature_segmentation, region_growing, regions_of_shape, watershed,
    watershed_of_curvedness,
};
use crate::view::boxed;
use libc::size_t;
use std::mem::offset_of;

/// The label of faces that are ignored: those of fewer than three distinct corners in a row.
pub const UMB_NO_SEGMENT: u32 = u32::MAX;

const _: () = assert!(UMB_NO_SEGMENT == crate::parts::NO_SEGMENT);

/// The faces of a mesh in segments: a label for each. A `const umb_segmentation *` may be used from any number of threads at once.
///
/// Labels are numbers from 0, in the order of the smallest face of each segment: they follow from which faces are together and from nothing
/// else. A segment is connected across edges that have exactly two faces, which run through it in opposite directions.
pub struct umb_segmentation(Segmentation);

/// How a mesh is cut along its creases. All zero: along edges sharper than 30 degrees.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_feature_options {
    /// `sizeof(umb_feature_options)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// Which edges are creases, read only during the call; may be null.
    pub creases: *const umb_creases,
    /// How to run; `vertices` must be null.
    pub run: umb_run,
}

/// How a mesh is cut into basins. All zero: basins of curvedness by adaptive jets, the shallow ones merged.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_watershed_options {
    /// `sizeof(umb_watershed_options)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// Basins that are less deep than this are merged with the neighbour over the lowest pass; in the unit of the height, at most infinity. 0: none
    /// of a given height; of curvedness, those of less than four times `umb_shape_tolerance`, and a tiny number for none.
    pub depth: f64,
    /// The height, at vertices or at faces: low inside segments, high between them. Null for curvedness.
    pub height: *const umb_scalars,
    /// How curvedness is computed, `run` aside; null for adaptive jets. Not looked at beside a height.
    pub curvature: *const umb_curvature_options,
    /// How to run; `vertices` must be null.
    pub run: umb_run,
}

/// How regions grow. All zero: by shape classes from adaptive jets.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct umb_region_options {
    /// `sizeof(umb_region_options)`; 0 stands for the size of its first version.
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// Regions of less than this share of the whole area become part of a neighbour, 0 to 1; 0 stands for 0.0005, and
    /// a tiny number merges none.
    pub smallest_share: f64,
    /// For classes that are not given: the tolerance of `umb_shape_classes`, in 1/length; 0 for twice `umb_shape_tolerance`, and a
    /// tiny number for none.
    pub tolerance: f64,
    /// Regions of fewer faces become part of a neighbour.
    pub smallest_faces: size_t,
    /// Where regions do not grow across, read only during the call; null for edges sharper than 30 degrees.
    pub creases: *const umb_creases,
    /// A `UMB_SHAPE_` constant for each vertex, `#V`; none to have them computed.
    pub classes: umb_bytes,
    /// For classes that are not given: how curvatures are computed, `run` aside; null for adaptive jets.
    pub curvature: *const umb_curvature_options,
    /// How to run; `vertices` must be null.
    pub run: umb_run,
}

/// Cuts a mesh into the parts that its creases bound: faces that meet are in one segment unless the edge between them is a crease. So a
/// crease that ends inside a smooth part separates nothing. A face without area has the normal of a neighbour across its longest edge, and so
/// does not join the two sides of a crease that it lies on.
///
/// Cost: linear in the number of corners, on one thread.
///
/// @param faces the faces; read only during the call
/// @param points the positions of all vertices; read only during the call
/// @param options may be null
/// @param segmentation receives the handle; destroy it with `umb_segmentation_destroy`
/// @param error may be null
///
/// Errors: those of `umb_cut_create`; `_CANCELLED`.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_segment_features(
    faces: *const umb_faces,
    points: *const umb_points,
    options: *const umb_feature_options,
    segmentation: *mut *mut umb_segmentation,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let faces = read_required(faces, "faces")?.view()?;
            let points = read_required(points, "points")?.view()?;
            let options = read_versioned(options)?;
            check_reserved("umb_feature_options", offset_of!(umb_feature_options, reserved), options.reserved)?;
            options.run.check_no_list("umb_feature_options", offset_of!(umb_feature_options, run))?;
            let creases = read_versioned(options.creases)?.view()?;
            let mut progress = options.run.callback();
            let run = options.run.view(progress.as_mut().map(|call| call as _))?;
            hand_out(segmentation, || feature_segmentation(&faces, &points, &creases, run))
        })
    }
}

/// Cuts a mesh into the basins of a height over its faces (Mangan and Whitaker 1999, here with basins that merge by depth as they meet:
/// persistence). A height at vertices becomes one at faces by the mean of the corners. Faces are flooded in ascending order: one without a lower
/// neighbour starts a basin, any other joins that of its lowest neighbour; connected faces of one height are one. Two basins merge
/// where they meet if the shallower of them is less deep than `depth`. Ties go to the face with the smaller index.
///
/// Same bits on any number of threads. Cost: O(n log n), on one thread but for the curvatures.
///
/// @param faces the faces; read only during the call
/// @param points the positions of all vertices, read only during the call; beside a height only their number counts
/// @param options may be null
/// @param segmentation receives the handle; destroy it with `umb_segmentation_destroy`
/// @param error may be null
///
/// Errors: those of `umb_topology_create` and `umb_curvatures`; `UMB_ERROR_NON_FINITE` also for a height (element: place).
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_segment_watershed(
    faces: *const umb_faces,
    points: *const umb_points,
    options: *const umb_watershed_options,
    segmentation: *mut *mut umb_segmentation,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let faces = read_required(faces, "faces")?.view()?;
            let points = read_required(points, "points")?.view()?;
            let options = read_versioned(options)?;
            check_reserved("umb_watershed_options", offset_of!(umb_watershed_options, reserved), options.reserved)?;
            options.run.check_no_list("umb_watershed_options", offset_of!(umb_watershed_options, run))?;
            let mut progress = options.run.callback();
            let run = options.run.view(progress.as_mut().map(|call| call as _))?;
            if !options.height.is_null() {
                let height = read_required(options.height, "options.height")?.field()?;
                return hand_out(segmentation, || watershed(&faces, points.len(), &height, options.depth, run));
            }
            let curvature = read_versioned(options.curvature)?.asked()?;
            let depth = (options.depth != 0.0).then_some(options.depth);
            hand_out(segmentation, || watershed_of_curvedness(&faces, &points, depth, &curvature, run))
        })
    }
}

/// Grows regions of faces by the shape classes of their vertices (see `umb_shape_classes`): flat, cylindrical, spherical and saddle parts,
/// whether creases bound them or not. Faces whose corners, those on creases aside, are all of one class make regions with neighbours of the same class
/// across edges that are no creases; the others, between parts, are added to the neighbour whose normal differs least; at last regions that are too small become
/// part of a neighbour: a smooth one if there is one, then one of the same class, then the one with the longest common border.
///
/// By default curvatures are those of adaptive jets, which serve clean meshes and such with noise; with more noise than 1 % of the edges take a
/// larger smallest region. On clean meshes of machine parts those of one ring (`UMB_CURVATURE_LEAST_SQUARES`), with half the
/// tolerance, do as well and are faster. Two
/// parts of one class that join smoothly are not separated, nor is a cone, whose curvature has no bound, from what is flat at
/// its wide end by any tolerance.
///
/// Same bits on any number of threads. Cost: O(n log n) at most, on one thread but for the curvatures.
///
/// @param faces the faces; read only during the call
/// @param points the positions of all vertices; read only during the call
/// @param options may be null
/// @param segmentation receives the handle; destroy it with `umb_segmentation_destroy`
/// @param error may be null
///
/// Errors: those of `umb_topology_create` and `umb_curvatures`; `UMB_ERROR_UNKNOWN_CONSTANT` also for a class.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_segment_regions(
    faces: *const umb_faces,
    points: *const umb_points,
    options: *const umb_region_options,
    segmentation: *mut *mut umb_segmentation,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let faces = read_required(faces, "faces")?.view()?;
            let points = read_required(points, "points")?.view()?;
            let options = read_versioned(options)?;
            check_reserved("umb_region_options", offset_of!(umb_region_options, reserved), options.reserved)?;
            options.run.check_no_list("umb_region_options", offset_of!(umb_region_options, run))?;
            let defaults = RegionOptions::default();
            let asked = RegionOptions {
                creases: read_versioned(options.creases)?.view()?,
                smallest_faces: options.smallest_faces,
                smallest_share: match options.smallest_share {
                    0.0 => defaults.smallest_share,
                    share => share,
                },
            };
            let mut progress = options.run.callback();
            let run = options.run.view(progress.as_mut().map(|call| call as _))?;
            if let Some(classes) = options.classes.view("options.classes")? {
                return hand_out(segmentation, || region_growing(&faces, &points, &classes, &asked, run));
            }
            let curvature = read_versioned(options.curvature)?.asked()?;
            let tolerance = (options.tolerance != 0.0).then_some(options.tolerance);
            hand_out(segmentation, || regions_of_shape(&faces, &points, tolerance, &curvature, &asked, run))
        })
    }
}

/// Frees a segmentation; null is fine.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_segmentation_destroy(segmentation: *mut umb_segmentation) {
    if !segmentation.is_null() {
        // SAFETY: made by `hand_out`, and the caller lets go of it.
        drop(unsafe { Box::from_raw(segmentation) });
    }
}

/// The number of segments; 0 for null.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_segmentation_count(segmentation: *const umb_segmentation) -> size_t {
    // SAFETY: null or a handle.
    unsafe { segmentation.as_ref() }.map_or(0, |found| found.0.count())
}

/// The number of faces, ignored ones included; 0 for null.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_segmentation_face_count(segmentation: *const umb_segmentation) -> size_t {
    // SAFETY: null or a handle.
    unsafe { segmentation.as_ref() }.map_or(0, |found| found.0.labels().len())
}

/// The label of each face, `#F`, in the handle's memory: below `umb_segmentation_count`, or `UMB_NO_SEGMENT`. Null for null.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_segmentation_labels(segmentation: *const umb_segmentation) -> *const u32 {
    // SAFETY: null or a handle.
    unsafe { segmentation.as_ref() }.map_or(std::ptr::null(), |found| found.0.labels().as_ptr())
}

/// The number of edges between segments; 0 for null.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_segmentation_boundary_edge_count(segmentation: *const umb_segmentation) -> size_t {
    // SAFETY: null or a handle.
    unsafe { segmentation.as_ref() }.map_or(0, |found| found.0.boundary_edges().len())
}

/// The edges between segments, each once, as its lower and its higher vertex, ascending, in the handle's memory: edges at which faces carry
/// different labels, however many faces they have. Null for null.
///
/// @since 0.1.0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn umb_segmentation_boundary_edges(segmentation: *const umb_segmentation) -> *const u32 {
    // SAFETY: null or a handle.
    unsafe { segmentation.as_ref() }
        .map_or(std::ptr::null(), |found| found.0.boundary_edges().as_flattened().as_ptr())
}

/// The area of each segment, length^2; a polygon's is the length of its area vector. What is beyond the range is its largest value.
///
/// @param segmentation the handle
/// @param faces the faces that were segmented; read only during the call
/// @param points the positions of all vertices, those of then or others; read only during the call
/// @param areas receives a number for each segment
/// @param count the number of segments
/// @param error may be null
///
/// Errors: `UMB_ERROR_NULL_POINTER`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT`, `_STRIDE`, `_MISALIGNED`, `_SIZE`, `_OFFSETS`,
/// `_INDEX_OUT_OF_RANGE`, `_NON_FINITE` (element: vertex), `_OUT_OF_MEMORY`.
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_segmentation_areas(
    segmentation: *const umb_segmentation,
    faces: *const umb_faces,
    points: *const umb_points,
    areas: *mut f64,
    count: size_t,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let segmentation = &segmentation.as_ref().ok_or(Error::NullPointer { what: "segmentation" })?.0;
            let faces = read_required(faces, "faces")?.view()?;
            let points = read_required(points, "points")?.view()?;
            write_sums(segmentation, areas, "areas", count, || segmentation.areas(&faces, &points))
        })
    }
}

/// The mean of a number over each segment, weighted by the area of the faces; over a segment without area that of its faces. A number at
/// vertices is taken as at faces, by the mean of the corners.
///
/// @param segmentation the handle
/// @param faces the faces that were segmented; read only during the call
/// @param points the positions of all vertices; read only during the call
/// @param scalars the numbers, at vertices or at faces; read only during the call
/// @param means receives a number for each segment
/// @param count the number of segments
/// @param error may be null
///
/// Errors: as `umb_segmentation_areas`; `UMB_ERROR_NON_FINITE` also for a number (element: place).
/// @since 0.1.0
#[unsafe(no_mangle)]
#[must_use]
pub unsafe extern "C" fn umb_segmentation_means(
    segmentation: *const umb_segmentation,
    faces: *const umb_faces,
    points: *const umb_points,
    scalars: *const umb_scalars,
    means: *mut f64,
    count: size_t,
    error: *mut umb_error,
) -> umb_status {
    // SAFETY: the header asks of the caller what these ask for.
    unsafe {
        guard(error, || {
            let segmentation = &segmentation.as_ref().ok_or(Error::NullPointer { what: "segmentation" })?.0;
            let faces = read_required(faces, "faces")?.view()?;
            let points = read_required(points, "points")?.view()?;
            let field = read_required(scalars, "scalars")?.field()?;
            write_sums(segmentation, means, "means", count, || segmentation.means(&faces, &points, &field))
        })
    }
}

/// Makes a segmentation, and hands it out.
///
/// # Safety
/// `handle` is null or may be written.
unsafe fn hand_out(
    handle: *mut *mut umb_segmentation,
    make: impl FnOnce() -> Result<Segmentation, Error>,
) -> Result<(), Error> {
    if handle.is_null() {
        return Err(Error::NullPointer { what: "segmentation" });
    }
    let made = Box::into_raw(boxed(umb_segmentation(make()?))?);
    // SAFETY: not null.
    unsafe { handle.write_unaligned(made) };
    Ok(())
}

/// Writes a number for each segment.
///
/// # Safety
/// `to` is null or has room for `count` numbers.
unsafe fn write_sums(
    segmentation: &Segmentation,
    to: *mut f64,
    what: &'static str,
    count: usize,
    sums: impl FnOnce() -> Result<Vec<f64>, Error>,
) -> Result<(), Error> {
    if to.is_null() && count > 0 {
        return Err(Error::NullPointer { what });
    }
    if count != segmentation.count() {
        let (found, expected) = (count as u64, segmentation.count() as u64);
        return Err(Error::Size { what: "count", found, expected });
    }
    let sums = sums()?;
    if count > 0 {
        // SAFETY: not null, and with room.
        unsafe { std::ptr::copy_nonoverlapping(sums.as_ptr().cast::<u8>(), to.cast(), size_of_val(&sums[..])) };
    }
    Ok(())
}
