//! `umbilic curvature`, and pictures of curvatures, run as their users run them.

#![cfg(feature = "cli")]

use serde_json::Value;
use std::collections::HashMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use tempfile::TempDir;

/// A folder with these samples, gone at the end of the test.
fn folder(samples: &[&str]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for sample in samples {
        succeed(folder.path(), &format!("generate {sample} -o {sample}.ply --resolution 32"));
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

fn json(folder: &Path, line: &str) -> Value {
    serde_json::from_str(&succeed(folder, line)).unwrap()
}

/// The properties of the vertices of a PLY file of text, by name.
fn columns(path: &Path) -> HashMap<String, Vec<f64>> {
    let text = fs::read_to_string(path).unwrap();
    let (header, body) = text.split_once("end_header\n").unwrap();
    let count = header.lines().find_map(|line| line.strip_prefix("element vertex ")).unwrap().parse().unwrap();
    let names = header.lines().take_while(|line| !line.starts_with("element face"));
    let names = names.filter_map(|line| line.strip_prefix("property ")?.split_once(' ')).map(|(_, name)| name);
    let rows: Vec<Vec<f64>> =
        body.lines().take(count).map(|line| line.split(' ').map(|word| word.parse().unwrap()).collect()).collect();
    names.enumerate().map(|(at, name)| (name.to_owned(), rows.iter().map(|row| row[at]).collect())).collect()
}

/// A square of four quadrilaterals around a raised vertex, and a vertex of no face.
const OPEN: &str = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0.5\nv 2 1 0\nv 0 2 0\nv 1 2 0\nv 2 2 0\nv 9 9 9\n\
                    f 1 2 5 4\nf 2 3 6 5\nf 4 5 8 7\nf 5 6 9 8\n";

#[test]
fn a_sphere_has_its_curvature() {
    let folder = folder(&["sphere"]);
    let folder = folder.path();
    // The largest error of a principal curvature; edges are about a tenth of the radius long.
    for (method, bound) in [
        ("jet", 0.03),
        ("jet --degree 4", 0.003),
        ("jet --degree 2", 0.03),
        ("quadric", 0.06),
        ("goldfeather", 0.01),
        ("least-squares --section c --normal max", 1e-6),
        ("rusinkiewicz", 0.005),
        ("corrected-measure", 0.006),
        ("meyer", 0.003),
    ] {
        let found = json(folder, &format!("curvature sphere.ply --method {method} --json --threads 2"));
        for (quantity, end) in [("k1", "max"), ("k1", "min"), ("k2", "max"), ("k2", "min"), ("mean", "median")] {
            let value = found["curvature"][quantity][end].as_f64().unwrap();
            assert!((value - 1.0).abs() < bound, "{method}: {quantity} {end} {value}");
        }
    }
}

#[test]
fn a_torus_has_its_extremes_in_the_table() {
    let folder = folder(&["torus"]);
    let text = succeed(folder.path(), "curvature torus.ply");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
    assert!(rows.contains(&vec!["minimum", "5", "%", "median", "95", "%", "maximum"]), "{text}");
    // Radii 0.65 and 0.35: the tube all around, 1 outside, -1/0.3 inside.
    // The tolerance is a twentieth of the largest.
    for (name, least, most) in [
        ("k1", 1.0 / 0.35, 1.0 / 0.35),
        ("k2", -1.0 / 0.3, 1.0),
        ("mean", (1.0 / 0.35 - 1.0 / 0.3) / 2.0, (1.0 / 0.35 + 1.0) / 2.0),
        ("gaussian", -1.0 / 0.35 / 0.3, 1.0 / 0.35),
    ] {
        let row = rows.iter().find(|row| row.first() == Some(&name)).unwrap();
        let numbers: Vec<f64> = row[1..].iter().map(|word| word.parse().unwrap()).collect();
        assert!(numbers.is_sorted() && numbers.len() == 5, "{text}");
        let tolerance = if name == "gaussian" { 0.05 / 0.35 / 0.3 } else { 0.05 / 0.3 };
        assert!((numbers[0] - least).abs() < tolerance, "{name}: {numbers:?}");
        assert!((numbers[4] - most).abs() < tolerance, "{name}: {numbers:?}");
    }
}

#[test]
fn integrals_add_up() {
    let folder = folder(&["torus", "sphere"]);
    let folder = folder.path();
    let tau = std::f64::consts::TAU;
    for (sample, exact) in [("torus", 0.0), ("sphere", 2.0 * tau)] {
        let found = json(folder, &format!("curvature {sample}.ply --method angle-defect --json"));
        assert!((found["integrated_gaussian"].as_f64().unwrap() - exact).abs() < 1e-9, "{sample}");
        assert!((found["gauss_bonnet"].as_f64().unwrap() - exact).abs() < 1e-9, "{sample}");
        assert_eq!(found["curvature"]["mean"], Value::Null);
        assert_eq!(found["color"]["quantity"], "gaussian");
    }
    let text = succeed(folder, "curvature sphere.ply --method corrected-measure");
    assert!(text.contains("\narea ") && text.contains("(2πχ = 12.5664)"), "{text}");
    // Areas that overlap have no sum.
    for options in ["--ring 2", "--radius 0.2"] {
        let found = json(folder, &format!("curvature sphere.ply --method corrected-measure --json {options}"));
        assert_eq!((&found["area"], &found["gauss_bonnet"]), (&Value::Null, &Value::Null), "{options}");
    }
}

#[test]
fn the_file_has_all_properties_and_colors() {
    let folder = folder(&["bumpy"]);
    let folder = folder.path();
    let found = json(folder, "curvature bumpy.ply -o out.ply --ascii --color mean --json");
    let columns = columns(&folder.join("out.ply"));
    let at = |name: &str, vertex: usize| columns[name][vertex];
    let count = columns["x"].len();
    for vertex in 0..count {
        let [k1, k2] = [at("k1", vertex), at("k2", vertex)];
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-5 * (1.0 + a.abs().max(b.abs()));
        assert!(k1 >= k2 && near(at("mean", vertex), (k1 + k2) / 2.0) && near(at("gaussian", vertex), k1 * k2));
        assert!(near(at("curvedness", vertex), ((k1 * k1 + k2 * k2) / 2.0).sqrt()));
        assert!(at("shape_index", vertex).abs() <= 1.0);
        let vector = |names: [&str; 3]| names.map(|name| at(name, vertex));
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let frame = [["nx", "ny", "nz"], ["k1_x", "k1_y", "k1_z"], ["k2_x", "k2_y", "k2_z"]].map(vector);
        for (i, a) in frame.iter().enumerate() {
            for (j, b) in frame.iter().enumerate() {
                assert!((dot(*a, *b) - f64::from(u8::from(i == j))).abs() < 1e-5);
            }
        }
        let [red, blue] = [at("red", vertex), at("blue", vertex)];
        let mean = at("mean", vertex);
        assert!(mean.abs() < 0.1 || (red > blue) == (mean > 0.0), "{mean}: {red} {blue}");
    }
    let color = &found["color"];
    let [low, high] = [color["low"].as_f64().unwrap(), color["high"].as_f64().unwrap()];
    assert!(low == -high && high > 0.0);
    let within = columns["mean"].iter().filter(|mean| mean.abs() <= high).count();
    assert!((within as f64 / count as f64 - 0.95).abs() < 0.001, "{within} of {count}");
    // Readable again, binary as well, without colors if none are wanted.
    succeed(folder, "curvature out.ply -o binary.ply --color none");
    let header = fs::read(folder.join("binary.ply")).unwrap();
    let header = String::from_utf8_lossy(&header[..1000]).into_owned();
    assert!(header.contains("property float k1_x\n") && !header.contains("red"), "{header}");
    assert!(!folder.join("binary.colorbar.png").exists());
    // Watanabe has no directions, the angle defect Gaussian curvature only.
    for (method, has, has_not) in [("watanabe", "k1\n", "k1_x"), ("angle-defect", "gaussian\n", "k1")] {
        succeed(folder, &format!("curvature bumpy.ply -o few.ply --ascii --method {method}"));
        let text = fs::read_to_string(folder.join("few.ply")).unwrap();
        assert!(text.contains(&format!("float {has}")) && !text.contains(has_not), "{method}");
    }
}

#[test]
fn the_range_can_be_chosen() {
    let folder = folder(&["bumpy", "cube"]);
    let folder = folder.path();
    let ends = |line: &str| {
        let found = json(folder, &format!("curvature --json {line}"));
        [found["color"]["low"].as_f64().unwrap(), found["color"]["high"].as_f64().unwrap()]
    };
    assert_eq!(ends("bumpy.ply --range -1.5,4"), [-1.5, 4.0]);
    assert_eq!(ends("bumpy.ply --color shape-index"), [-1.0, 1.0]);
    let [low, high] = ends("bumpy.ply --color curvedness");
    assert!(low == 0.0 && high > 0.0);
    let reach = |percentile| ends(&format!("bumpy.ply --color k1 --percentile {percentile}"))[1];
    assert!(reach("50") < reach("95") && reach("95") < reach("100"));
    // A plane is flat but for rounding; all corners of a cube are alike.
    fs::write(folder.join("plane.off"), "OFF\n4 2 0\n0 0 0.1\n1 0 0.4\n1 1 0.6\n0 1 0.3\n3 0 1 2\n3 0 2 3\n")
        .unwrap();
    assert_eq!(ends("plane.off"), [-1.0, 1.0]);
    let [low, high] = ends("cube.ply");
    assert!(low == -high && high > 0.0);
}

#[test]
fn color_bars_show_both_ends() {
    let folder = folder(&["bumpy"]);
    let folder = folder.path();
    let text = succeed(folder, "curvature bumpy.ply -o out.ply");
    assert!(text.contains("out.colorbar.png") && text.contains(" blue, 0 white, "), "{text}");
    succeed(folder, "curvature bumpy.ply --colorbar only.png");
    succeed(folder, "render bumpy.ply -o bumpy.png --size 80x60 --color mean --colorbar drawn.png");
    let columns = {
        succeed(folder, "curvature bumpy.ply -o text.ply --ascii --percentile 10");
        columns(&folder.join("text.ply"))
    };
    // With so low a percentile, the extremes have the colors of the ends.
    let color_where = |pick: fn(f64, f64) -> bool| {
        let mean = &columns["mean"];
        let vertex = (1..mean.len()).fold(0, |best, next| if pick(mean[next], mean[best]) { next } else { best });
        ["red", "green", "blue"].map(|name| columns[name][vertex] as u8)
    };
    let ends = [color_where(|a, b| a < b), color_where(|a, b| a > b)];
    for name in ["out.colorbar.png", "only.png", "drawn.png", "text.colorbar.png"] {
        let picture = image::open(folder.join(name)).unwrap().into_rgb8();
        for end in ends {
            assert!(picture.pixels().any(|pixel| pixel.0 == end), "{name}: {end:?}");
        }
        assert!(picture.pixels().any(|pixel| pixel.0 == [0; 3]));
    }
}

#[test]
fn pictures_show_curvatures() {
    let folder = folder(&["torus"]);
    let folder = folder.path();
    let said = succeed(folder, "render torus.ply -o a.png --size 160x120 --elevation 60 --color gaussian");
    assert!(said.starts_with("gaussian: -") && said.ends_with(" red\n"), "{said}");
    let picture = image::open(folder.join("a.png")).unwrap().into_rgb8();
    assert_eq!(picture.get_pixel(0, 0).0, [255; 3]);
    let count = |hue: fn([u8; 3]) -> bool| picture.pixels().filter(|pixel| hue(pixel.0)).count();
    assert!(count(|[red, _, blue]| red > blue.saturating_add(30)) > 500);
    assert!(count(|[red, _, blue]| blue > red.saturating_add(30)) > 500);
    for color in ["k1", "k2", "mean", "shape-index", "curvedness"] {
        succeed(
            folder,
            &format!("render torus.ply -o a.png --size 40x30 --color {color} --method taubin --section c"),
        );
    }
    succeed(folder, "render torus.ply -o a.png --size 40x30 --color clay --weight jet --degree 1 --rings 2");
}

#[test]
fn options_that_a_method_does_not_have_are_refused() {
    let folder = folder(&["torus"]);
    let folder = folder.path();
    for (options, what) in [
        ("--method taubin --degree 3", "torus.ply: --degree is nothing that the method has (taubin)"),
        ("--method meyer --ring 2", "torus.ply: --ring is nothing that the method has (meyer)"),
        ("--method jet --radius 0.1", "torus.ply: --radius is nothing that the method has (jet)"),
        ("--method jet --degree 1", "torus.ply: --degree is outside its range"),
        ("--method normal-cycle --radius 1 --rings 2", "torus.ply: --ring beside --radius is nothing"),
        ("--section c", "--section is nothing that the method has (adaptive-jet)"),
        ("--normal max", "--normal is nothing that the method has (adaptive-jet)"),
        ("--method angle-defect --color mean", "--color mean is nothing that the method has (angle-defect)"),
    ] {
        for line in [format!("curvature torus.ply -o a.ply {options}"), {
            let color = if options.contains("--color") { "" } else { "--color mean" };
            format!("render torus.ply -o a.png {color} {options}")
        }] {
            let error = fail(folder, &line, 1);
            assert!(error.starts_with(&format!("umbilic: {what}")) && error.lines().count() == 1, "{line}: {error}");
        }
    }
    for line in ["render torus.ply -o a.png --method taubin", "render torus.ply -o a.png --range 0,1"] {
        assert!(fail(folder, line, 1).contains("are for colors of curvatures"), "{line}");
    }
    assert!(fail(folder, "curvature torus.ply --color none --percentile 9", 1).contains("--percentile"));
    assert!(!folder.join("a.ply").exists() && !folder.join("a.png").exists());
    for (options, what) in [
        ("--method best", "least-squares"),
        ("--section square", "circle"),
        ("--color red", "shape-index"),
        ("--range 2,1", "below the second"),
        ("--range 1", "-1.5,1.5"),
        ("--percentile 0", "above 0"),
        ("--range 0,1 --percentile 9", "cannot be used with"),
        ("--radius 0", "above 0"),
        ("--ring 9", "1..=8"),
        ("-o a.obj", "must end in .ply"),
    ] {
        let error = fail(folder, &format!("curvature torus.ply {options}"), 2);
        assert!(error.contains(what), "{options}: {error}");
    }
}

#[test]
fn statuses_are_counted() {
    let folder = folder(&[]);
    let folder = folder.path();
    fs::write(folder.join("open.obj"), OPEN).unwrap();
    let found = json(folder, "curvature open.obj --method least-squares -o out.ply --ascii --json");
    for (key, count) in [("boundary", 8), ("isolated", 1), ("non_manifold", 0), ("winding", 0), ("widened", 0)] {
        assert_eq!(found["status"][key], count, "{key}");
    }
    assert_eq!((&found["vertices"], &found["faces"]), (&10.into(), &4.into()));
    let columns = columns(&folder.join("out.ply"));
    assert_eq!(columns["status"][9], 8.0);
    let gray = ["red", "green", "blue"].map(|name| columns[name][9]);
    assert!(gray == [128.0; 3] && columns["k1"][9] == 0.0, "{gray:?}");
    let text = succeed(folder, "curvature open.obj --method least-squares");
    assert!(text.contains("\nboundary vertices                8\n"), "{text}");
    // Nothing but isolated vertices: no numbers, no failure.
    fs::write(folder.join("points.obj"), "v 0 0 0\nv 1 0 0\n").unwrap();
    let text = succeed(folder, "curvature points.obj -o a.ply");
    assert!(text.lines().any(|line| line.split_whitespace().eq("k1 - - - - -".split(' '))), "{text}");
    assert_eq!(json(folder, "curvature points.obj --json")["curvature"]["k1"]["min"], Value::Null);
    fs::write(folder.join("nan.obj"), "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    assert_eq!(fail(folder, "curvature nan.obj", 1), "umbilic: nan.obj: the position of vertex 0 is not finite\n");
}

#[test]
fn help_tells_units_and_signs() {
    let folder = folder(&[]);
    let help = succeed(folder.path(), "curvature --help");
    for what in ["1/length", "k1 = k2 = 1/r", "Example:\n  umbilic curvature ", "LOW,HIGH", "least-squares", "rings"]
    {
        assert!(help.contains(what), "{what}: {help}");
    }
    assert!(succeed(folder.path(), "render --help").contains("--colorbar"));
}
