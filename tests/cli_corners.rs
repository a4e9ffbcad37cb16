//! `umbilic corners`, and pictures with normals of corners, run as their users run them.

#![cfg(feature = "cli")]

use serde_json::Value;
use std::collections::HashSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use tempfile::TempDir;

/// A folder with these samples, gone at the end of the test.
fn folder(samples: &[&str]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for sample in samples {
        succeed(folder.path(), &format!("generate {sample} -o {sample}.ply --resolution 16"));
    }
    folder
}

fn run(folder: &Path, line: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_umbilic")).args(line.split_whitespace()).current_dir(folder).output().unwrap()
}

fn succeed(folder: &Path, line: &str) -> String {
    let output = run(folder, line);
    assert_eq!((output.status.code(), String::from_utf8_lossy(&output.stderr).as_ref()), (Some(0), ""), "{line}");
    String::from_utf8(output.stdout).unwrap()
}

fn fail(folder: &Path, line: &str, code: i32) -> String {
    let output = run(folder, line);
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{line}: {errors}");
    assert!(output.stdout.is_empty(), "{line}");
    errors
}

fn answer(folder: &Path, line: &str) -> Value {
    serde_json::from_str(&succeed(folder, &format!("{line} --json"))).unwrap()
}

/// The vertices of a PLY file of text: position, normal, color and status.
fn vertices(path: &Path) -> Vec<Vec<f64>> {
    let text = fs::read_to_string(path).unwrap();
    let (header, body) = text.split_once("end_header\n").unwrap();
    let names: Vec<&str> = header
        .lines()
        .take_while(|line| !line.starts_with("element face"))
        .filter_map(|line| line.strip_prefix("property ")?.split(' ').nth(1))
        .collect();
    assert_eq!(names, ["x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "status"]);
    let count = header.lines().find_map(|line| line.strip_prefix("element vertex ")).unwrap().parse().unwrap();
    body.lines().take(count).map(|line| line.split(' ').map(|word| word.parse().unwrap()).collect()).collect()
}

#[test]
fn a_cube_falls_into_its_sides() {
    let folder = folder(&["cube"]);
    let folder = folder.path();
    let found = answer(folder, "corners cube.ply -o out.ply --ascii");
    for (key, expected) in [("vertices", 8), ("faces", 6), ("written_vertices", 24)] {
        assert_eq!(found[key], expected, "{key}");
    }
    assert_eq!(found["crease_angle"], 30.0);
    assert_eq!(found["status"]["boundary"], 24);
    let written = vertices(&folder.join("out.ply"));
    assert_eq!(written.len(), 24);
    for vertex in &written {
        let normal = &vertex[3..6];
        // One of the axes, to the side that the corner is on, and the color that stands for it.
        let axis = (0..3).find(|&axis| normal[axis].abs() > 0.5).unwrap();
        for other in 0..3 {
            let expected = if other == axis { vertex[axis] } else { 0.0 };
            assert!((normal[other] - expected).abs() < 1e-6, "{vertex:?}");
            let color = [0.0, 128.0, 255.0][(expected + 1.0) as usize];
            assert_eq!(vertex[6 + other], color, "{vertex:?}");
        }
    }
    let info = answer(folder, "info out.ply");
    for (key, expected) in [("vertices", 24), ("faces", 6), ("quads", 6), ("components", 6), ("boundary_edges", 24)] {
        assert_eq!(info[key], expected, "{key}");
    }
    // No edge is sharper than a right angle.
    let whole = answer(folder, "corners cube.ply -o whole.ply --crease-angle 91 --weight angle");
    assert_eq!((&whole["written_vertices"], &whole["status"]["boundary"]), (&8.into(), &0.into()));
    let text = succeed(folder, "corners cube.ply -o out.ply");
    assert!(text.lines().any(|line| line.split_whitespace().eq(["vertices", "written", "24"])), "{text}");
}

#[test]
fn where_nothing_is_sharp_normals_are_those_of_vertices() {
    let folder = folder(&["bumpy"]);
    let folder = folder.path();
    let found = answer(folder, "corners bumpy.ply -o corners.ply --ascii --crease-angle 180");
    assert_eq!(found["vertices"], found["written_vertices"]);
    succeed(folder, "normals bumpy.ply -o normals.ply --ascii");
    let normals = fs::read_to_string(folder.join("normals.ply")).unwrap();
    let body = normals.split_once("end_header\n").unwrap().1;
    for (vertex, line) in vertices(&folder.join("corners.ply")).iter().zip(body.lines()) {
        let expected: Vec<f64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
        assert_eq!(vertex[..6], expected[..6]);
    }
}

/// The colors along the middle row of a picture of a cube's edge, from the left to the right.
fn across(path: &Path) -> Vec<[u8; 3]> {
    let picture = image::open(path).unwrap().into_rgb8();
    assert_eq!(picture.dimensions(), (90, 60));
    (25..65).map(|column| picture.get_pixel(column, 30).0).collect()
}

const VIEW: &str = "--size 90x60 --azimuth 45 --elevation 0 --orthographic";

#[test]
fn flat_sides_look_flat_and_edges_sharp() {
    let folder = folder(&["cube"]);
    let folder = folder.path();
    let normals = |name: &str, options: &str| {
        succeed(folder, &format!("render cube.ply -o {name} --color normals {VIEW} {options}"));
        across(&folder.join(name))
    };
    let sharp = normals("sharp.png", "--crease-angle 30");
    assert!(sharp[..19].iter().all(|&color| color == [128, 128, 255]), "{sharp:?}");
    assert!(sharp[21..].iter().all(|&color| color == [255, 128, 128]), "{sharp:?}");
    let smooth = normals("smooth.png", "");
    assert_eq!(normals("wide.png", "--crease-angle 91"), smooth);
    assert!(smooth.iter().collect::<HashSet<_>>().len() > 15, "{smooth:?}");

    let clay = |name: &str, angle: &str| {
        succeed(folder, &format!("corners cube.ply -o a.ply --picture {name} {VIEW} --crease-angle {angle}"));
        across(&folder.join(name))
    };
    let sharp = clay("sharp-clay.png", "30");
    let [left, right] = [sharp[0], sharp[39]];
    assert!(sharp[..19].iter().all(|&color| color == left) && sharp[21..].iter().all(|&color| color == right));
    assert!(left[0] > right[0].saturating_add(30), "{left:?} and {right:?}");
    assert!(clay("smooth-clay.png", "91").iter().collect::<HashSet<_>>().len() > 15);
    // The same as by the other command, with the same weight.
    succeed(folder, &format!("render cube.ply -o clay.png {VIEW} --crease-angle 30"));
    assert_eq!(fs::read(folder.join("clay.png")).unwrap(), fs::read(folder.join("sharp-clay.png")).unwrap());
}

#[test]
fn wrong_usage_is_refused() {
    let folder = folder(&["cube"]);
    let folder = folder.path();
    for (line, what) in [
        (
            "corners cube.ply -o a.ply --up z",
            "--size, --azimuth, --elevation, --up and --orthographic are for --picture",
        ),
        ("corners cube.ply -o a.ply --degree 2", "--degree and --rings are for --weight jet, not conformal"),
        ("render cube.ply -o a.png --color mean --crease-angle 30", "--crease-angle is for --color clay and normals"),
    ] {
        assert_eq!(fail(folder, line, 1), format!("umbilic: {what}\n"), "{line}");
    }
    for (line, what) in [
        ("corners cube.ply -o a.ply --crease-angle=-1", "0 or more"),
        ("corners cube.ply -o a.ply --crease-angle nan", "degrees"),
        ("corners cube.ply -o a.ply --picture a.jpg", "must end in .png"),
        ("corners cube.ply", "--output"),
    ] {
        let error = fail(folder, line, 2);
        assert!(error.contains(what), "{line}: {error}");
    }
    fs::write(folder.join("nan.obj"), "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let error = fail(folder, "corners nan.obj -o a.ply", 1);
    assert_eq!(error, "umbilic: nan.obj: the position of vertex 0 is not finite\n");
    assert!(!folder.join("a.ply").exists() && !folder.join("a.png").exists());
    assert!(succeed(folder, "corners --help").contains("Example:\n  umbilic corners "));
}
