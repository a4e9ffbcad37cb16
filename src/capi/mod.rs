//! The C interface, `include/umbilic.h`.
//!
//! The only door into the library from C: it turns pointers into views and errors into statuses, and holds no
//! algorithm. The header is generated from this module by cbindgen, checked in, and compared by a test.
//!
//! Every function that can fail answers with a status and leaves its outputs alone unless it succeeds (after a cancel,
//! some elements may have been written). Nothing is kept between calls but the handles that the caller holds.

#![allow(non_camel_case_types)]
// The contracts are in the header's words, on each function.
#![allow(clippy::missing_safety_doc)]

mod adaptive;
mod curvature;
mod guard;
mod normals;
mod polyline;
mod sections;
mod status;
mod topology;
mod types;
mod version;

pub use adaptive::*;
pub use curvature::*;
pub use normals::*;
pub use polyline::*;
pub use sections::*;
pub use status::*;
pub use topology::*;
pub use types::*;
pub use version::*;
