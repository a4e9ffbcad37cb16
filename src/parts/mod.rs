//! What curvature and normals are for: a mesh in parts.
//!
//! Segmentations label faces: [`feature_segmentation`] by creases, [`watershed`] by any scalar, [`region_growing`] by the
//! [`ShapeClass`]es of vertices.
//! [`CutMesh`] cuts a mesh open along its creases, for normals of corners and for estimates that stop there. [`affected_normals`] and
//! [`affected_curvatures`] list what changes as vertices move.

mod affected;
mod by_curvature;
mod corner_normals;
mod creases;
mod cut;
mod face_graph;
mod feature_segmentation;
mod region_growing;
mod scalar_field;
mod segmentation;
mod sets;
mod shape;
mod small_regions;
mod watershed;

pub use affected::{affected_curvatures, affected_normals};
pub use by_curvature::{
    CURVEDNESS_DEPTH, REGION_TOLERANCE, curvedness_depth, fill_unknown, has_curvature, region_tolerance,
    regions_of_shape, watershed_of_curvedness,
};
pub use corner_normals::{CornerOutputs, corner_normals};
pub use creases::{Creases, DEFAULT_CREASE_ANGLE};
pub use cut::CutMesh;
pub use feature_segmentation::feature_segmentation;
pub use region_growing::{RegionOptions, region_growing};
pub use scalar_field::ScalarField;
pub use segmentation::{NO_SEGMENT, Segmentation};
pub use shape::{SHAPE_TOLERANCE, ShapeClass, shape_classes, shape_tolerance};
pub use watershed::watershed;
