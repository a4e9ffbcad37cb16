//! What the fuzz targets share: structs and arrays of the C interface made of the fuzzer's bytes, and checks of what the
//! library did to them.
//!
//! Every array and every struct is a heap block of exactly the size that the call is told of, so that the address sanitizer
//! sees any access beyond. Counts and strides lie only where the contract of `include/umbilic.h` has the library refuse them
//! before it reads. An input that is not *hostile* breaks no rule at all, and every call must accept it.
// Every call keeps the contract that the header states.
#![allow(clippy::undocumented_unsafe_blocks)]

pub mod arrays;
pub mod block;
pub mod coordinates;
pub mod curvature;
pub mod faces;
pub mod outcome;
pub mod parts;
pub mod run;
pub mod scene;
pub mod shape;
pub mod source;
pub mod structs;
pub mod weights;

pub use arrays::{Bytes, Input, Target};
pub use block::{Block, Placed};
pub use faces::FaceArrays;
pub use outcome::Outcome;
pub use parts::List;
pub use run::{Run, Watch};
pub use scene::{Handle, Scene};
pub use shape::Shape;
pub use source::Source;
pub use structs::{Struct, zeroed};

/// What the address sanitizer is told where the environment variable `ASAN_OPTIONS` does not say otherwise.
///
/// An allocation of more than a gigabyte fails, as it may anywhere: the library must then answer that there is no memory.
/// Blocks that were freed are kept from reuse in less memory than by default, which is faster and still long enough here.
#[unsafe(no_mangle)]
extern "C" fn __asan_default_options() -> *const libc::c_char {
    c"allocator_may_return_null=1:max_allocation_size_mb=1024:quarantine_size_mb=4:malloc_context_size=2:detect_stack_use_after_return=0".as_ptr()
}
