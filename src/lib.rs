//! Vertex normals of polygon meshes and curvatures of polylines, on the caller's own memory.
//!
//! ```
//! use umbilic::{Faces, NormalOutputs, Points, Run, Topology, Weight, vertex_normals};
//!
//! let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0_f32]];
//! let triangles = [0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3_u32];
//!
//! let topology = Topology::new(&Faces::triangles(&triangles[..])?, positions.len())?;
//! let mut normals = [[0.0_f32; 3]; 4];
//! let outputs = NormalOutputs { normal: Some(normals.as_mut_slice().into()), ..Default::default() };
//! vertex_normals(&topology, &Points::from(&positions[..]), Weight::Conformal, Run::default(), &outputs)?;
//! assert!(normals[0].iter().all(|x| (x + 1.0 / 3.0_f32.sqrt()).abs() < 1e-6));
//! # Ok::<(), umbilic::Error>(())
//! ```
//!
//! The [C interface](capi) is the same library behind `include/umbilic.h`. `ARCHITECTURE.md` tells how the parts hang
//! together: imports run downwards only,
//! `capi → curvature → normals → fit → sweep → topology → view, simd, parallel → error`.

#![deny(missing_docs)]

pub mod capi;
mod curvature;
mod error;
mod fit;
mod normals;
mod parallel;
mod parts;
mod simd;
mod sweep;
mod topology;
mod view;

pub use curvature::{
    CurvatureKind, CurvatureOptions, CurvatureOutputs, Directions, Method, PolylineOutputs, Section, SectionOutputs,
    VertexNormals, curvatures, direction_sections, edge_sections, polyline_curvatures, polyline_status,
    section_status,
};
pub use error::Error;
pub use fit::{AdaptiveModel, Coordinates, JetOptions};
pub use normals::{
    AdaptiveOptions, FaceOutputs, NormalOutputs, Weight, face_normals, learn_model, vertex_normals,
    vertex_normals_from_faces,
};
pub use parallel::Run;
pub use parts::{
    CURVEDNESS_DEPTH, CornerOutputs, Creases, CutMesh, DEFAULT_CREASE_ANGLE, NO_SEGMENT, REGION_TOLERANCE,
    RegionOptions, SHAPE_TOLERANCE, ScalarField, Segmentation, ShapeClass, affected_curvatures, affected_normals,
    corner_normals, curvedness_depth, feature_segmentation, fill_unknown, has_curvature, region_growing,
    region_tolerance, regions_of_shape, shape_classes, shape_tolerance, watershed, watershed_of_curvedness,
};
pub use simd::Level;
pub use topology::{Fan, Topology, TopologyStats, status};
pub use view::{
    Bytes, Faces, IndexArray, Indices, Output, Points, PolylinePoints, ScalarOutput, Scalars, StatusOutput,
};
