//! The shared library's name and its lifetime in a process.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let os = std::env::var("CARGO_CFG_TARGET_OS").unwrap_or_default();
    if os == "linux" {
        // The ABI number: raised when, and only when, a program built against an older header would break.
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libumbilic.so.0");
        // A host that unloads a plugin must not unmap code that the runtime's thread-exit handlers still point to.
        println!("cargo:rustc-cdylib-link-arg=-Wl,-z,nodelete");
    }
}
