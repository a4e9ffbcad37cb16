//! The binary interface: struct layouts on this platform, and what the shared library exports.
#![cfg(target_pointer_width = "64")]

use std::mem::{offset_of, size_of};
use std::process::Command;
use umbilic::capi::*;

/// `struct: size, field offset …`; `tests/c/layout.c` holds C to the same numbers.
#[test]
fn layouts() {
    assert_eq!((size_of::<umb_points>(), size_of::<umb_faces>(), size_of::<umb_output>()), (32, 40, 24));
    assert_eq!((size_of::<umb_status_output>(), size_of::<umb_run>(), size_of::<umb_fan>()), (16, 40, 32));
    assert_eq!((size_of::<umb_error>(), size_of::<umb_topology_stats>()), (256, 152));
    assert_eq!((size_of::<umb_topology_options>(), size_of::<umb_normal_options>()), (8, 48));
    assert_eq!((size_of::<umb_normal_outputs>(), size_of::<umb_face_options>()), (72, 48));
    assert_eq!(size_of::<umb_face_outputs>(), 72);
    assert_eq!([offset_of!(umb_points, stride), offset_of!(umb_points, scalar)], [16, 24]);
    assert_eq!(
        [offset_of!(umb_faces, offsets), offset_of!(umb_faces, index), offset_of!(umb_faces, arity)],
        [16, 32, 36]
    );
    assert_eq!(
        [offset_of!(umb_run, vertices), offset_of!(umb_run, progress), offset_of!(umb_run, user)],
        [8, 24, 32]
    );
    assert_eq!([offset_of!(umb_error, element), offset_of!(umb_error, message)], [8, 16]);
    assert_eq!([offset_of!(umb_normal_options, weight), offset_of!(umb_normal_options, run)], [4, 8]);
    let outputs = [
        offset_of!(umb_normal_outputs, normal),
        offset_of!(umb_normal_outputs, sum),
        offset_of!(umb_normal_outputs, status),
    ];
    assert_eq!(outputs, [8, 32, 56]);
    assert_eq!([offset_of!(umb_fan, corner_count), offset_of!(umb_fan, closed)], [16, 24]);
    assert_eq!(
        [offset_of!(umb_topology_stats, euler_characteristic), offset_of!(umb_topology_stats, bytes)],
        [128, 144]
    );
}

/// Exactly the functions of the list are exported, under the shared library's own name. `UMBILIC_LIBRARY` names the
/// library, as `make test` sets it.
#[test]
fn exported_symbols() {
    let Some(library) = std::env::var_os("UMBILIC_LIBRARY") else {
        println!("UMBILIC_LIBRARY is not set: nothing checked");
        return;
    };
    let run = |tool: &str, arguments: &[&str]| {
        let output = Command::new(tool).args(arguments).arg(&library).output().unwrap();
        assert!(output.status.success(), "{tool}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    let listing = run("nm", &["--dynamic", "--defined-only", "--format=posix"]);
    let mut exported: Vec<&str> = listing.lines().filter_map(|line| line.split_whitespace().next()).collect();
    exported.sort_unstable();
    let list = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/abi/symbols.txt")).unwrap();
    assert_eq!(exported, list.lines().collect::<Vec<_>>());
    let dynamic = run("readelf", &["--dynamic", "--wide"]);
    assert!(dynamic.contains("soname: [libumbilic.so.0]"), "{dynamic}");
    assert!(dynamic.contains("NODELETE"), "{dynamic}");
}
