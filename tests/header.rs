//! `include/umbilic.h` is what cbindgen makes of `src/capi`, and says the version of the crate.
//!
//! `UPDATE_HEADER=1 cargo test --test header` writes it anew.

use std::path::Path;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn header_is_up_to_date() {
    let config = cbindgen::Config::from_file(root().join("cbindgen.toml")).unwrap();
    // The files in the order a reader wants them.
    let mut builder = cbindgen::Builder::new().with_config(config);
    for module in [
        "status",
        "types",
        "topology",
        "adaptive",
        "normals",
        "curvature",
        "sections",
        "polyline",
        "cut",
        "affected",
        "shape",
        "segmentation",
        "version",
    ] {
        builder = builder.with_src(root().join(format!("src/capi/{module}.rs")));
    }
    let mut generated = Vec::new();
    builder.generate().unwrap().write(&mut generated);
    let path = root().join("include/umbilic.h");
    if std::env::var_os("UPDATE_HEADER").is_some() {
        std::fs::write(&path, &generated).unwrap();
    }
    let checked_in = std::fs::read_to_string(&path).unwrap();
    assert!(
        checked_in == String::from_utf8(generated).unwrap(),
        "include/umbilic.h is out of date: run UPDATE_HEADER=1 cargo test --test header"
    );
}

#[test]
fn header_has_the_crate_version() {
    let header = std::fs::read_to_string(root().join("include/umbilic.h")).unwrap();
    let define = |name: &str| {
        let line = header.lines().find_map(|line| line.strip_prefix(&format!("#define UMB_{name} "))).unwrap();
        line.trim().to_owned()
    };
    let version = ["VERSION_MAJOR", "VERSION_MINOR", "VERSION_PATCH"].map(define).join(".");
    assert_eq!(version, env!("CARGO_PKG_VERSION"));
    assert_eq!(define("ABI_VERSION"), umbilic::capi::umb_abi_version().to_string());
}

#[test]
fn every_function_of_the_library_is_declared() {
    let header = std::fs::read_to_string(root().join("include/umbilic.h")).unwrap();
    let sources = [
        "status",
        "topology",
        "adaptive",
        "normals",
        "sections",
        "curvature",
        "polyline",
        "cut",
        "affected",
        "shape",
        "segmentation",
        "version",
    ]
    .map(|module| std::fs::read_to_string(root().join(format!("src/capi/{module}.rs"))).unwrap());
    let mut functions = 0;
    for line in sources.iter().flat_map(|source| source.lines()) {
        if let Some(rest) = line.split("extern \"C\" fn ").nth(1) {
            let name = rest.split('(').next().unwrap();
            assert!(header.contains(&format!("{name}(")), "{name} is not in the header");
            functions += 1;
        }
    }
    assert!(functions >= 15);
}
