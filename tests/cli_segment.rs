//! `umbilic segment`, and colors of shape classes, run as their users run them.

#![cfg(feature = "cli")]

mod common;

use common::mesh::Mesh;
use common::solids;
use serde_json::{Value, json};
use std::collections::{HashMap, HashSet};
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

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

fn obj(mesh: &Mesh) -> String {
    let mut text = String::new();
    for [x, y, z] in &mesh.positions {
        writeln!(text, "v {x} {y} {z}").unwrap();
    }
    for face in mesh.faces() {
        text += "f";
        for vertex in face {
            write!(text, " {}", vertex + 1).unwrap();
        }
        text += "\n";
    }
    text
}

/// The color and the label of each face of a PLY file of text.
fn labelled(path: &Path) -> Vec<([u8; 3], i64)> {
    let text = fs::read_to_string(path).unwrap();
    let (header, body) = text.split_once("end_header\n").unwrap();
    let end = "property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
               property int label\n";
    assert!(header.ends_with(end), "{header}");
    let count = |element: &str| -> usize {
        header.lines().find_map(|line| line.strip_prefix(element)).unwrap().trim().parse().unwrap()
    };
    let faces: Vec<&str> = body.lines().skip(count("element vertex")).collect();
    assert_eq!(faces.len(), count("element face"));
    let parse = |line: &&str| {
        let words: Vec<i64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
        let rest = &words[words[0] as usize + 1..];
        assert_eq!(rest.len(), 4, "{line}");
        ([0, 1, 2].map(|channel| rest[channel] as u8), rest[3])
    };
    faces.iter().map(parse).collect()
}

/// A square of two faces, one of two corners, and one that is folded up by a right angle.
const FOLDED: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n\
                      f 1 2 3\nf 1 3 4\nf 2 1\nf 1 5 6 2\n";

#[test]
fn a_box_has_six_sides() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    succeed(folder, "generate cube -o cube.ply");
    fs::write(folder.join("fine.obj"), obj(&solids::cuboid(4).mesh)).unwrap();
    let ways = ["", "--by features --angle 89", "--by regions --method meyer"];
    for (file, faces, edges) in [("cube.ply", 1, 12), ("fine.obj", 16, 48)] {
        for way in ways {
            let found = answer(folder, &format!("segment {file} {way}"));
            let about = format!("{file} {way}: {found}");
            assert_eq!((&found["segments"], &found["boundary_edges"]), (&json!(6), &json!(edges)), "{about}");
            assert_eq!(found["ignored_faces"], 0);
            let each = found["by_label"].as_array().unwrap();
            assert_eq!(each.len(), 6);
            for segment in each {
                assert_eq!(segment["faces"], faces, "{about}");
                assert!((segment["share"].as_f64().unwrap() - 1.0 / 6.0).abs() < 1e-12, "{about}");
                assert_eq!(segment["k1"].is_f64(), way.contains("--method"), "{about}");
                assert_eq!(segment["shape"].is_string(), way.contains("regions"), "{about}");
            }
        }
        // No edge of a box is sharper than a right angle.
        assert_eq!(answer(folder, &format!("segment {file} --crease-angle 91"))["segments"], 1);
    }
    assert_eq!(answer(folder, "segment cube.ply")["by_label"][5]["area"], 4.0);
    // All corners of a cube are alike, so that water sees no edge where there is nothing between corners.
    for (file, count) in [("cube.ply", 1), ("fine.obj", 6)] {
        let found = answer(folder, &format!("segment {file} --by watershed --method least-squares"));
        assert_eq!(found["segments"], count, "{file}: {found}");
    }
}

#[test]
fn flats_and_fillets_are_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let solid = solids::filleted_box([1.0, 0.7, 0.5], 0.3, 8, 3);
    fs::write(folder.join("box.obj"), obj(&solid.mesh)).unwrap();
    assert_eq!(answer(folder, "segment box.obj")["segments"], 1);
    let tolerance = answer(folder, "segment box.obj --by regions")["options"]["tolerance"].as_f64().unwrap();
    for options in [String::new(), format!("--method least-squares --tolerance {}", tolerance / 2.0)] {
        let found = answer(folder, &format!("segment box.obj --by regions {options} -o out.ply --ascii"));
        // Six sides, twelve edges and eight corners.
        let mut shapes = HashMap::new();
        for segment in found["by_label"].as_array().unwrap() {
            *shapes.entry(segment["shape"].as_str().unwrap()).or_insert(0) += 1;
            let [k1, k2] = ["k1", "k2"].map(|name| segment[name].as_f64().unwrap());
            assert!(k1 >= k2 && k2 > -0.1, "{segment}");
        }
        assert_eq!(shapes, HashMap::from([("flat", 6), ("ridge", 12), ("peak", 8)]), "{options}");
        let labels: Vec<usize> = labelled(&folder.join("out.ply")).iter().map(|&(_, label)| label as usize).collect();
        assert!(solids::renamed(&labels) == solids::renamed(&solid.sides), "{options}");
    }
    // All fillets are less than half of the surface.
    let few = answer(folder, "segment box.obj --by regions --method least-squares --smallest-share 0.5");
    assert_eq!(few["segments"], 1);
    let count = solid.mesh.face_count();
    let all = answer(folder, &format!("segment box.obj --by regions --smallest-faces {count}"));
    assert_eq!((&all["segments"], &all["options"]["smallest_faces"]), (&json!(1), &json!(count)));
    // Everything is less curved than this.
    let flat = answer(folder, "segment box.obj --by regions --tolerance 100");
    assert_eq!((&flat["segments"], &flat["by_label"][0]["shape"]), (&json!(1), &json!("flat")));
}

#[test]
fn shallow_basins_are_merged() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    succeed(folder, "generate bumpy -o bumpy.ply --resolution 12");
    let count = |depth: &str| {
        let found = answer(folder, &format!("segment bumpy.ply --by watershed --method taubin --depth {depth}"));
        assert_eq!(found["options"]["depth"].as_f64(), depth.parse().ok().filter(|depth: &f64| depth.is_finite()));
        assert_eq!(found["options"]["method"], "taubin");
        found["segments"].as_u64().unwrap()
    };
    let counts = ["0", "0.5", "2", "1e9", "inf"].map(count);
    assert!(counts[0] > counts[1] && counts[1] > counts[2] && counts[2] > 1, "{counts:?}");
    assert_eq!(counts[3..], [1, 1]);
}

#[test]
fn the_file_has_labels_and_colors() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("folded.obj"), FOLDED).unwrap();
    let found = answer(folder, "segment folded.obj -o text.ply --ascii");
    assert_eq!((&found["segments"], &found["boundary_edges"]), (&json!(2), &json!(1)));
    assert_eq!(found["ignored_faces"], 1);
    let faces = labelled(&folder.join("text.ply"));
    let labels: Vec<i64> = faces.iter().map(|&(_, label)| label).collect();
    assert_eq!(labels, [0, 0, -1, 1]);
    assert_eq!(faces[0].0, faces[1].0);
    assert_eq!(faces[2].0, [128; 3]);
    assert_ne!(faces[0].0, faces[3].0);
    succeed(folder, "segment folded.obj -o binary.ply");
    for name in ["text.ply", "binary.ply"] {
        let info = answer(folder, &format!("info {name}"));
        for (key, expected) in [("vertices", 6), ("faces", 4), ("triangles", 2), ("quads", 1)] {
            assert_eq!(info[key], expected, "{name}: {key}");
        }
        // What was written is cut alike.
        assert_eq!(answer(folder, &format!("segment {name}"))["segments"], 2);
    }
    // Colors go by labels alone.
    succeed(folder, "generate cube -o cube.ply");
    succeed(folder, "segment cube.ply -o cube-out.ply --ascii");
    let cube = labelled(&folder.join("cube-out.ply"));
    assert_eq!((cube[0].0, cube[1].0), (faces[0].0, faces[3].0));
    assert_eq!(cube.iter().map(|face| face.0).collect::<HashSet<_>>().len(), 6);
}

#[test]
fn pictures_show_each_segment_in_its_color() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    succeed(folder, "generate cube -o cube.ply");
    let view = "--size 90x60 --azimuth 45 --elevation 0 --orthographic";
    succeed(folder, &format!("segment cube.ply -o out.ply --ascii --picture a.png {view}"));
    let colors = labelled(&folder.join("out.ply"));
    let picture = image::open(folder.join("a.png")).unwrap().into_rgb8();
    assert_eq!(picture.get_pixel(0, 0).0, [255; 3]);
    // Two sides are seen at the same angle, each flat up to the edge between them: that of z = 1 and that of x = 1.
    let drawn: HashSet<[u8; 3]> = picture.pixels().map(|pixel| pixel.0).filter(|&color| color != [255; 3]).collect();
    assert!(drawn.len() < 10, "{drawn:?}");
    for (columns, face) in [([25, 43], 5), ([46, 64], 1)] {
        let [far, near] = columns.map(|column| picture.get_pixel(column, 30).0);
        assert_eq!(far, near, "{face}");
        // Darker, and of the same hue: linear light in the same proportions.
        let linear = |color: [u8; 3]| color.map(|byte| ((f64::from(byte) / 255.0 + 0.055) / 1.055).powf(2.4));
        let parts = [0, 1, 2].map(|channel| linear(near)[channel] / linear(colors[face].0)[channel]);
        assert!(parts.iter().all(|part| *part < 1.0 && (part / parts[0] - 1.0).abs() < 0.1), "{face}: {parts:?}");
    }
    succeed(folder, "generate bumpy -o bumpy.ply --resolution 8");
    succeed(folder, "segment bumpy.ply --by watershed --method taubin --depth 1 --picture b.png --size 80x60 --up z");
    let picture = image::open(folder.join("b.png")).unwrap().into_rgb8();
    assert_eq!(picture.dimensions(), (80, 60));
    assert!(picture.pixels().collect::<HashSet<_>>().len() > 100);
}

#[test]
fn the_table_has_the_largest_first() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("shaft.obj"), obj(&solids::stepped_shaft(20).mesh)).unwrap();
    let text = succeed(folder, "segment shaft.obj --by regions --method least-squares --tolerance 1e-3");
    for row in ["by                   regions", "crease angle         30°", "tolerance            0.001"] {
        assert!(text.contains(&format!("{row}\n")), "{text}");
    }
    let (_, list) = text.split_once("\n\n").unwrap();
    let head: Vec<&str> = list.lines().next().unwrap().split_whitespace().collect();
    assert_eq!(head, ["label", "faces", "area", "share", "k1", "k2", "curvedness", "shape"]);
    let areas: Vec<f64> =
        list.lines().skip(1).filter_map(|line| line.split_whitespace().nth(2)?.parse().ok()).collect();
    assert!(areas.len() > 1 && areas.is_sorted_by(|a, b| a >= b), "{text}");
    // The table ends somewhere.
    succeed(folder, "generate bumpy -o bumpy.ply --resolution 12");
    let text = succeed(folder, "segment bumpy.ply --by watershed --method taubin --depth 0");
    assert!(text.ends_with(" smaller\n") && text.split_once("\n\n").unwrap().1.lines().count() == 12, "{text}");
    // Without any face there is no list.
    fs::write(folder.join("points.obj"), "v 0 0 0\nv 1 0 0\n").unwrap();
    for way in ["features", "watershed", "regions"] {
        let text = succeed(folder, &format!("segment points.obj --by {way} -o none.ply --picture none.png"));
        assert!(text.contains("\nsegments             0\n") && !text.contains("label"), "{text}");
    }
}

#[test]
fn meshes_of_any_size_are_cut() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let faces = "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
    for size in ["1e-310", "1e-150", "1e300"] {
        let corners: String = (0..6)
            .map(|corner| {
                let sign = if corner % 2 == 0 { "" } else { "-" };
                let axis = |axis| if corner / 2 == axis { format!("{sign}{size}") } else { "0".to_owned() };
                format!("v {} {} {}\n", axis(0), axis(1), axis(2))
            })
            .collect();
        fs::write(folder.join("octahedron.obj"), corners + faces).unwrap();
        for (way, count) in [("features", 8), ("watershed", 1), ("regions", 8)] {
            let line = format!("segment octahedron.obj --by {way} --picture a.png --size 20x20");
            let found = answer(folder, &line);
            assert_eq!(found["segments"], count, "{size}: {way}");
            if size != "1e-310" {
                let share = found["by_label"][0]["share"].as_f64().unwrap();
                assert!((share - 1.0 / f64::from(count)).abs() < 1e-6, "{size}: {way}: {share}");
            }
        }
        succeed(folder, "render octahedron.obj -o b.png --color shape --size 20x20");
    }
}

#[test]
fn what_a_way_of_cutting_does_not_have_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("folded.obj"), FOLDED).unwrap();
    for (options, what) in [
        ("--depth 1", "--depth is nothing that --by features has"),
        ("--tolerance 1", "--tolerance is nothing that --by features has"),
        ("--by watershed --angle 20", "--crease-angle is nothing that --by watershed has"),
        ("--by watershed --smallest-share 0.1", "--smallest-share is nothing that --by watershed has"),
        ("--by watershed --smallest-faces 2", "--smallest-faces is nothing that --by watershed has"),
        ("--by regions --depth 1", "--depth is nothing that --by regions has"),
        ("--method taubin", "--method is for curvatures, not for segments by features"),
        ("--rings 2", "--ring is for curvatures, not for segments by features"),
        ("--by regions --method angle-defect", "--by regions is nothing that the method has (angle-defect)"),
        ("--by watershed --section c", "--section is nothing that the method has (adaptive-jet)"),
        ("--by watershed --method meyer --degree 2", "folded.obj: --degree is nothing that the method has (meyer)"),
        ("--size 80x60", "--size, --azimuth, --elevation, --up and --orthographic are for --picture"),
    ] {
        let error = fail(folder, &format!("segment folded.obj -o a.ply {options}"), 1);
        assert_eq!(error, format!("umbilic: {what}\n"), "{options}");
    }
    for (options, what) in [
        ("--by color", "watershed"),
        ("--angle=-1", "0 or more"),
        ("--by watershed --depth nan", "0 or more, or inf"),
        ("--by watershed --depth=-1", "0 or more"),
        ("--by regions --tolerance inf", "0 or more"),
        ("--by regions --smallest-share 2", "from 0 to 1"),
        ("--by regions --smallest-faces few", "--smallest-faces"),
        ("-o a.obj", "must end in .ply"),
        ("--picture a.ply", "must end in .png"),
    ] {
        let error = fail(folder, &format!("segment folded.obj {options}"), 2);
        assert!(error.contains(what), "{options}: {error}");
    }
    fs::write(folder.join("nan.obj"), "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    for way in ["features", "watershed", "regions"] {
        let error = fail(folder, &format!("segment nan.obj -o a.ply --by {way}"), 1);
        assert_eq!(error, "umbilic: nan.obj: the position of vertex 0 is not finite\n");
    }
    assert!(!folder.join("a.ply").exists());
    assert!(succeed(folder, "segment --help").contains("Example:\n  umbilic segment "));
    assert!(succeed(folder, "--help").contains("umbilic segment "));
}

#[test]
fn classes_of_shape_have_colors() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    succeed(folder, "generate torus -o torus.ply --resolution 24");
    let found = answer(folder, "curvature torus.ply --color shape --tolerance 0.4 -o out.ply --ascii");
    assert_eq!((&found["color"]["quantity"], &found["color"]["tolerance"]), (&json!("shape"), &json!(0.4)));
    let counts = &found["color"]["vertices"];
    let count = |class: &str| counts[class].as_u64().unwrap();
    // Convex outside, a saddle inside; nothing is concave.
    assert!(count("peak") > 100 && count("saddle-ridge") + count("saddle-valley") > 100, "{counts}");
    assert_eq!((count("pit"), count("flat"), count("undefined")), (0, 0, 0));
    let text = fs::read_to_string(folder.join("out.ply")).unwrap();
    assert!(text.contains("property uchar shape\nproperty uchar status\n"), "{text}");
    assert!(!folder.join("out.colorbar.png").exists());
    let vertices = text.split_once("end_header\n").unwrap().1.lines().take(24 * 48);
    let rows: Vec<Vec<&str>> = vertices.map(|line| line.split(' ').collect()).collect();
    let with_color = |class: &str| -> HashSet<[&str; 3]> {
        rows.iter().filter(|row| row[row.len() - 2] == class).map(|row| [row[6], row[7], row[8]]).collect()
    };
    assert_eq!(with_color("1"), HashSet::from([["214", "54", "44"]]));
    assert_eq!(rows.iter().filter(|row| row[row.len() - 2] == "1").count() as u64, count("peak"));

    let text = succeed(folder, "curvature torus.ply --color shape");
    assert!(text.contains("shape: undefined gray, peak red, ridge orange, "), "{text}");
    let view = "--size 160x120 --elevation 90 --orthographic --tolerance 0.4";
    let said = succeed(folder, &format!("render torus.ply -o a.png --color shape {view}"));
    assert!(said.contains("peak red") && said.ends_with("curvatures of up to 0.4 count as none\n"), "{said}");
    let picture = image::open(folder.join("a.png")).unwrap().into_rgb8();
    let count = |hue: fn([u8; 3]) -> bool| picture.pixels().filter(|pixel| hue(pixel.0)).count();
    assert!(count(|[red, green, _]| red > green.saturating_add(80)) > 500, "peaks");
    assert!(count(|[red, green, blue]| red.min(green) > blue.saturating_add(60)) > 200, "saddle ridges");

    for (options, what) in [
        ("--color shape --range 0,1", "--range, --percentile and --colorbar are for colors of curvatures"),
        ("--color mean --tolerance 1", "--tolerance is for --color shape"),
        ("--color shape --method angle-defect", "--color shape is nothing that the method has (angle-defect)"),
    ] {
        for command in ["curvature torus.ply", "render torus.ply -o b.png"] {
            assert_eq!(fail(folder, &format!("{command} {options}"), 1), format!("umbilic: {what}\n"), "{command}");
        }
    }
    assert!(fail(folder, "curvature torus.ply --tolerance 1", 1).contains("--color shape"));
}
