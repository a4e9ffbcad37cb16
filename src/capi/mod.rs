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

mod guard;
mod status;

pub use status::*;

// The unit tests call no entry point, but whatever is exported would be compiled for them all the same, minutes of kernels.
#[cfg(not(test))]
mod adaptive;
#[cfg(not(test))]
mod affected;
#[cfg(not(test))]
mod curvature;
#[cfg(not(test))]
mod cut;
#[cfg(not(test))]
mod normals;
#[cfg(not(test))]
mod polyline;
#[cfg(not(test))]
mod sections;
#[cfg(not(test))]
mod segmentation;
#[cfg(not(test))]
mod shape;
#[cfg(not(test))]
mod topology;
#[cfg(not(test))]
mod types;
#[cfg(not(test))]
mod version;
#[cfg(not(test))]
mod versioned;

#[cfg(not(test))]
pub use adaptive::*;
#[cfg(not(test))]
pub use affected::*;
#[cfg(not(test))]
pub use curvature::*;
#[cfg(not(test))]
pub use cut::*;
#[cfg(not(test))]
pub use normals::*;
#[cfg(not(test))]
pub use polyline::*;
#[cfg(not(test))]
pub use sections::*;
#[cfg(not(test))]
pub use segmentation::*;
#[cfg(not(test))]
pub use shape::*;
#[cfg(not(test))]
pub use topology::*;
#[cfg(not(test))]
pub use types::*;
#[cfg(not(test))]
pub use version::*;
