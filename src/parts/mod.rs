//! What curvature and normals are for: a mesh in parts.
//!
//! [`CutMesh`] cuts a mesh open along its creases, for normals of corners and for estimates that stop there.

mod corner_normals;
mod creases;
mod cut;

pub use corner_normals::{CornerOutputs, corner_normals};
pub use creases::{Creases, DEFAULT_CREASE_ANGLE};
pub use cut::CutMesh;
