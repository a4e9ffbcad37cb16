//! What the address sanitizer is told where the environment variable `ASAN_OPTIONS` does not say otherwise.

/// An allocation of more than a gigabyte fails, as it may anywhere: the library must then answer that there is no memory.
/// Blocks that were freed are kept from reuse in less memory than by default, which is faster and still long enough here.
#[unsafe(no_mangle)]
extern "C" fn __asan_default_options() -> *const libc::c_char {
    c"allocator_may_return_null=1:max_allocation_size_mb=1024:quarantine_size_mb=16:malloc_context_size=8".as_ptr()
}
