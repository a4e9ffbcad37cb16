//! The binary interface: struct layouts on this platform, and what the shared library exports.
#![cfg(target_pointer_width = "64")]

use std::mem::{offset_of, size_of};
use std::process::Command;
use umbilic::capi::*;

/// `struct: size, field offset …`
macro_rules! layout {
    ($name:ident: $size:literal, $($field:ident $offset:literal),*) => {
        assert_eq!(size_of::<$name>(), $size, stringify!($name));
        $(assert_eq!(offset_of!($name, $field), $offset, concat!(stringify!($name), ".", stringify!($field)));)*
    };
}

/// Every field of every struct; `tests/c/layout.c` holds C to the same numbers.
#[test]
fn layouts() {
    layout!(umb_adaptive_model: 88, struct_size 0, coordinates 4, edge_length 8, noise 16, sizes 24, noise_exponent 56, size_exponent 60, evidence 64, sample 80, reserved 84);
    layout!(umb_bytes: 24, data 0, count 8, stride 16);
    layout!(umb_corner_outputs: 96, struct_size 0, reserved 4, corner 8, normal 32, sum 56, status 80);
    layout!(umb_creases: 48, struct_size 0, reserved 4, angle 8, edges 16, edge_count 24, groups 32, group_count 40);
    layout!(umb_curvature_options: 120, struct_size 0, method 4, section 8, weight 12, radius 16, degree 24, rings 28, normal_degree 32, normal_rings 36, model 40, normals 48, run 80);
    layout!(umb_curvature_outputs: 408, struct_size 0, reserved 4, k1 8, k2 32, direction1 56, direction2 80, mean 104, gaussian 128, mean_normal 152, area 176, integrated_mean 200, integrated_gaussian 224, shape_index 248, curvedness 272, residual 296, condition 320, degrees_of_freedom 344, normal 368, status 392);
    layout!(umb_error: 256, struct_size 0, status 4, element 8, message 16);
    layout!(umb_face_options: 48, struct_size 0, reserved 4, run 8);
    layout!(umb_face_outputs: 72, struct_size 0, reserved 4, normal 8, area_vector 32, status 56);
    layout!(umb_faces: 40, indices 0, index_count 8, offsets 16, face_count 24, index 32, arity 36);
    layout!(umb_fan: 32, neighbours 0, neighbour_count 8, corner_count 16, closed 24, reserved 28);
    layout!(umb_feature_options: 56, struct_size 0, reserved 4, creases 8, run 16);
    layout!(umb_moved: 48, struct_size 0, reserved 4, vertices 8, vertex_count 16, status 24);
    layout!(umb_normal_options: 64, struct_size 0, weight 4, run 8, degree 48, rings 52, model 56);
    layout!(umb_normal_outputs: 72, struct_size 0, reserved 4, normal 8, sum 32, status 56);
    layout!(umb_output: 24, data 0, stride 8, scalar 16, reserved 20);
    layout!(umb_points: 32, data 0, count 8, stride 16, scalar 24, reserved 28);
    layout!(umb_polyline: 40, data 0, count 8, stride 16, scalar 24, dimension 28, closed 32, reserved 36);
    layout!(umb_polyline_options: 48, struct_size 0, reserved 4, run 8);
    layout!(umb_polyline_outputs: 120, struct_size 0, reserved 4, circle 8, parabola 32, length_parabola 56, symmetric_parabola 80, status 104);
    layout!(umb_region_options: 112, struct_size 0, reserved 4, smallest_share 8, tolerance 16, smallest_faces 24, creases 32, classes 40, curvature 64, run 72);
    layout!(umb_run: 40, threads 0, simd 4, vertices 8, vertex_count 16, progress 24, user 32);
    layout!(umb_scalars: 32, data 0, count 8, stride 16, scalar 24, location 28);
    layout!(umb_section_options: 136, struct_size 0, section 4, weight 8, shared 12, normals 16, directions 48, normal_degree 80, normal_rings 84, model 88, run 96);
    layout!(umb_section_outputs: 72, struct_size 0, reserved 4, curvature 8, status 32, normal 48);
    layout!(umb_shape_options: 88, struct_size 0, reserved 4, tolerance 8, points 16, status 24, run 48);
    layout!(umb_status_output: 16, data 0, stride 8);
    layout!(umb_topology_options: 16, struct_size 0, threads 4, simd 8, reserved 12);
    layout!(umb_topology_stats: 152, struct_size 0, reserved 4, vertex_count 8, face_count 16, corner_count 24, edge_count 32, boundary_edges 40, non_manifold_edges 48, winding_edges 56, isolated_vertices 64, boundary_vertices 72, non_manifold_vertices 80, degenerate_faces 88, ignored_faces 96, duplicate_faces 104, component_count 112, boundary_loops 120, euler_characteristic 128, max_valence 136, bytes 144);
    layout!(umb_watershed_options: 72, struct_size 0, reserved 4, depth 8, height 16, curvature 24, run 32);
}

/// The two lists name every field of every struct of the header.
#[test]
fn layouts_are_complete() {
    let read = |path: &str| std::fs::read_to_string(format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))).unwrap();
    let (header, c, rust) = (read("include/umbilic.h"), read("tests/c/layout.c"), read("tests/abi.rs"));
    let mut structs = 0;
    for definition in header.split("typedef struct ").skip(1) {
        let Some((name, body)) = definition.split_once(" {\n") else { continue };
        let Some((body, _)) = body.split_once("\n}") else { continue };
        if name.contains(';') {
            continue; // opaque
        }
        structs += 1;
        assert!(c.contains(&format!("SIZE({name}, ")), "{name} in layout.c");
        let list = rust.lines().find(|line| line.contains(&format!("layout!({name}: "))).expect(name);
        for line in body.lines().filter(|line| line.ends_with(';')) {
            let field = line.trim_end_matches(';').split('[').next().unwrap().rsplit([' ', '*']).next().unwrap();
            assert!(c.contains(&format!("OFFSET({name}, {field}, ")), "{name}.{field} in layout.c");
            assert!(list.contains(&format!(" {field} ")), "{name}.{field} in abi.rs");
        }
    }
    assert!(structs > 20, "only {structs} structs found");
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
