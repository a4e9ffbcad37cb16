//! The program `umbilic`, run as its users run it.

#![cfg(feature = "cli")]

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A folder to work in, gone at the end of the test.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Folder(tempfile::tempdir().unwrap())
    }

    /// The path of a file in the folder.
    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file.
    fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    /// Runs the program in the folder.
    fn run(&self, line: &str) -> Output {
        Command::new(env!("CARGO_BIN_EXE_umbilic"))
            .args(line.split_whitespace())
            .current_dir(self.0.path())
            .output()
            .unwrap()
    }

    /// What the program prints where it succeeds.
    fn succeed(&self, line: &str) -> String {
        let output = self.run(line);
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{line}: {errors}");
        assert_eq!(errors, "", "{line}");
        String::from_utf8(output.stdout).unwrap()
    }

    /// What the program complains of where it fails with this code.
    fn fail(&self, line: &str, code: i32) -> String {
        let output = self.run(line);
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{line}: {errors}");
        assert!(output.stdout.is_empty(), "{line}");
        errors
    }

    fn json(&self, line: &str) -> Value {
        serde_json::from_str(&self.succeed(line)).unwrap()
    }
}

/// The vertices of a PLY file of text, all properties in the order of the file.
fn vertices(path: &Path) -> Vec<Vec<f64>> {
    let text = fs::read_to_string(path).unwrap();
    let (header, body) = text.split_once("end_header\n").unwrap();
    let count = header.lines().find_map(|line| line.strip_prefix("element vertex ")).unwrap().parse().unwrap();
    let numbers = |line: &str| line.split(' ').map(|word| word.parse().unwrap()).collect();
    body.lines().take(count).map(numbers).collect()
}

/// The sine of the largest angle between a vertex's normal and `normal(position)`.
fn worst_sine(vertices: &[Vec<f64>], normal: impl Fn([f64; 3]) -> [f64; 3]) -> f64 {
    let sine = |vertex: &Vec<f64>| {
        let [a, b] = [[vertex[3], vertex[4], vertex[5]], normal([vertex[0], vertex[1], vertex[2]])];
        let length = |v: [f64; 3]| (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
        assert!((length(a) - 1.0).abs() < 1e-6, "{a:?} is no unit vector");
        assert!(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > 0.0, "{a:?} points inwards");
        length([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]) / length(b)
    };
    vertices.iter().map(sine).fold(0.0, f64::max)
}

/// A tetrahedron's corners and its faces, which look outwards.
const CORNERS: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

fn binary_ply() -> Vec<u8> {
    let mut bytes = b"ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
                      property float z\nelement face 4\nproperty list uchar uint vertex_indices\nend_header\n"
        .to_vec();
    bytes.extend(CORNERS.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
    for face in FACES {
        bytes.push(3);
        bytes.extend(face.iter().flat_map(|x| x.to_le_bytes()));
    }
    bytes
}

fn binary_stl() -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend(4_u32.to_le_bytes());
    for face in FACES {
        bytes.extend([0; 12]);
        bytes.extend(face.iter().flat_map(|&v| CORNERS[v as usize]).flat_map(f32::to_le_bytes));
        bytes.extend([0; 2]);
    }
    bytes
}

fn text(format: &str) -> String {
    let lines = |rows: Vec<String>| rows.join("\n") + "\n";
    let corners = |prefix: &str| lines(CORNERS.iter().map(|[x, y, z]| format!("{prefix}{x} {y} {z}")).collect());
    let faces = |prefix: &str, first: u32| {
        lines(FACES.iter().map(|f| format!("{prefix} {} {} {}", f[0] + first, f[1] + first, f[2] + first)).collect())
    };
    match format {
        "obj" => format!("# made by hand\n{}{}", corners("v "), faces("f", 1)),
        "off" => format!("OFF\n4 4 6\n{}{}", corners(""), faces("3", 0)),
        _ => format!(
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
             element face 4\nproperty list uchar int vertex_indices\nend_header\n{}{}",
            corners(""),
            faces("3", 0)
        ),
    }
}

#[test]
fn all_formats_give_the_same_mesh_and_normals() {
    let folder = Folder::new();
    folder.write("obj.obj", text("obj"));
    folder.write("off.off", text("off"));
    folder.write("text.ply", text("ply"));
    folder.write("binary.ply", binary_ply());
    folder.write("welded.stl", binary_stl());
    for name in ["obj.obj", "off.off", "text.ply", "binary.ply", "welded.stl"] {
        let info = folder.json(&format!("info {name} --json"));
        for (key, expected) in [("vertices", 4), ("faces", 4), ("triangles", 4), ("edges", 6), ("genus", 0)] {
            assert_eq!(info[key], expected, "{name}: {key}");
        }
        assert!(info["defects"].as_object().unwrap().values().all(|count| count == 0), "{name}");
        folder.succeed(&format!("normals {name} -o out.ply --ascii --weight uniform"));
        let mut vertices = vertices(&folder.path("out.ply"));
        // STL has no order of vertices.
        vertices.sort_by(|a, b| a.partial_cmp(b).unwrap());
        let third = f64::from(-1.0 / 3.0_f32.sqrt());
        for (found, expected) in vertices[0].iter().zip([0.0, 0.0, 0.0, third, third, third, 0.0]) {
            assert!((found - expected).abs() < 1e-6, "{name}: {vertices:?}");
        }
    }
}

#[test]
fn polygons_stay_whole() {
    let folder = Folder::new();
    // A house without a floor: a pentagonal gable at each end, three walls and roofs between them.
    folder.write(
        "house.obj",
        "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 3 0\nv 0 2 0\nv 0 0 4\nv 2 0 4\nv 2 2 4\nv 1 3 4\nv 0 2 4\n\
         f 5 4 3 2 1\nf 6 7 8 9 10\nf 2 3 8 7\nf 3 4 9 8\nf 4 5 10 9\nf 5 1 6 10\nv 9 9 9\n",
    );
    let info = folder.json("info house.obj --json");
    for (key, expected) in [
        ("vertices", 11),
        ("faces", 6),
        ("triangles", 0),
        ("quads", 4),
        ("larger_faces", 2),
        ("edges", 15),
        ("components", 1),
        ("boundary_loops", 1),
        ("boundary_edges", 4),
        ("boundary_vertices", 4),
        ("euler_characteristic", 1),
        ("genus", 0),
        ("largest_valence", 3),
    ] {
        assert_eq!(info[key], expected, "{key}");
    }
    assert_eq!(info["defects"]["isolated_vertices"], 1);
    assert_eq!(info["edge_lengths"]["max"], 4.0);
    assert_eq!(info["edge_lengths"]["min"], 2.0_f64.sqrt());
    assert_eq!(info["bounding_box"]["max"], serde_json::json!([9.0, 9.0, 9.0]));

    let counts = folder.json("normals house.obj -o out.ply --ascii --json");
    assert_eq!(counts["faces"], 6);
    assert_eq!(counts["status"]["boundary"], 4);
    assert_eq!(counts["status"]["isolated"], 1);
    let written = fs::read_to_string(folder.path("out.ply")).unwrap();
    assert!(written.contains("property uchar status\n") && written.contains("\n5 4 3 2 1 0\n"), "{written}");
    assert!(written.contains("\n9 9 9 0 0 0 8\n"), "{written}");
}

#[test]
fn samples_have_their_genus() {
    let folder = Folder::new();
    for (shape, vertices, faces, genus) in
        [("torus", 2048, 2048, 1), ("sphere", 1986, 3968, 0), ("bumpy", 10242, 20480, 0), ("cube", 8, 6, 0)]
    {
        let said = folder.succeed(&format!("generate {shape} -o {shape}.ply --resolution 32"));
        assert_eq!(said, format!("{vertices} vertices, {faces} faces\n"));
        let info = folder.json(&format!("info {shape}.ply --json"));
        assert_eq!(info["vertices"], vertices);
        assert_eq!(info["faces"], faces);
        assert_eq!(info["genus"], genus);
        let text = folder.succeed(&format!("info {shape}.ply"));
        assert!(text.ends_with("\nno defects\n"), "{text}");
    }
}

#[test]
fn every_weight_finds_the_normals_of_a_sphere_and_a_torus() {
    let folder = Folder::new();
    folder.succeed("generate sphere -o sphere.ply --resolution 50");
    folder.succeed("generate torus -o torus.ply --resolution 50");
    let weights = "conformal uniform angle area max centroid-area centroid inverse-root-edges sine angle-edges jet";
    for weight in weights.split(' ') {
        let counts =
            folder.json(&format!("normals sphere.ply -o a.ply --ascii --json --threads 2 --weight {weight}"));
        assert_eq!(counts["weight"], weight);
        let on_sphere = worst_sine(&vertices(&folder.path("a.ply")), |position| position);
        // Positions are read back as written, normals are rounded to single precision.
        let limit = if weight == "max" { 1e-6 } else { 0.02 };
        assert!(on_sphere < limit, "{weight}: {on_sphere}");
        folder.succeed(&format!("normals torus.ply -o b.ply --ascii --weight {weight}"));
        let on_torus = worst_sine(&vertices(&folder.path("b.ply")), |[x, y, z]| {
            let share = 1.0 - 0.65 / x.hypot(z);
            [x * share, y, z * share]
        });
        assert!(on_torus < 0.02, "{weight}: {on_torus}");
    }
}

#[test]
fn text_and_binary_outputs_agree_and_can_be_read_again() {
    let folder = Folder::new();
    folder.succeed("generate bumpy -o a.ply --resolution 8");
    folder.succeed("normals a.ply -o text.ply --ascii");
    folder.succeed("normals a.ply -o binary.ply");
    folder.succeed("normals binary.ply -o again.ply --ascii");
    assert_eq!(fs::read(folder.path("text.ply")).unwrap(), fs::read(folder.path("again.ply")).unwrap());
}

#[test]
fn defects_are_told_in_words() {
    let folder = Folder::new();
    // Three faces on an edge, one that names a vertex twice in a row, one twice, an unused vertex, a zero edge.
    folder.write(
        "bad.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nv 5 5 5\nv 5 5 5\nv 6 5 5\nv 7 7 7\n\
         f 1 2 3\nf 1 2 4\nf 2 1 5\nf 1 1 2\nf 6 7 8\nf 6 7 8\n",
    );
    let info = folder.json("info bad.obj --json");
    assert_eq!(info["genus"], Value::Null);
    assert!(info["genus_undefined_because"].as_str().unwrap().contains("more than two faces"));
    let defects = &info["defects"];
    for (key, expected) in [
        ("non_manifold_edges", 1),
        ("degenerate_faces", 1),
        ("ignored_faces", 1),
        ("duplicate_faces", 1),
        ("isolated_vertices", 1),
        ("zero_length_edges", 1),
        ("non_finite_vertices", 0),
    ] {
        assert_eq!(defects[key], expected, "{key}");
    }
    let text = folder.succeed("info bad.obj");
    assert!(text.contains("genus                 not defined: some edges have more than two faces\n"), "{text}");
    assert!(text.contains("  1  edges with more than two faces\n"), "{text}");
    folder.write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert_eq!(folder.json("info nan.obj --json")["defects"]["non_finite_vertices"], 1);
    let error = folder.fail("normals nan.obj -o a.ply", 1);
    assert_eq!(error, "umbilic: nan.obj: the position of vertex 0 is not finite\n");
}

#[test]
fn meshes_without_faces_have_zero_normals() {
    let folder = Folder::new();
    folder.write("points.obj", "v 0 0 0\nv 1 0 0\n");
    let info = folder.json("info points.obj --json");
    assert_eq!(info["genus_undefined_because"], "there are no faces");
    assert_eq!(info["edge_lengths"], Value::Null);
    let counts = folder.json("normals points.obj -o a.ply --ascii --json");
    assert_eq!(counts["status"]["isolated"], 2);
    assert_eq!(vertices(&folder.path("a.ply"))[1], [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 8.0]);
    folder.succeed("render points.obj -o a.png --size 20x10");
}

#[test]
fn pictures_show_the_mesh() {
    let folder = Folder::new();
    folder.succeed("generate bumpy -o bumpy.ply --resolution 16");
    for options in ["", "--color normals", "--up z --orthographic", "--azimuth -120.5 --elevation -30 --weight max"] {
        assert_eq!(folder.succeed(&format!("render bumpy.ply -o a.png --size 160x120 {options}")), "");
        let picture = image::open(folder.path("a.png")).unwrap().into_rgb8();
        assert_eq!(picture.dimensions(), (160, 120));
        assert_eq!(picture.get_pixel(0, 0).0, [255; 3], "{options}");
        let drawn = picture.pixels().filter(|pixel| pixel.0 != [255; 3]).count();
        assert!((5000..15000).contains(&drawn), "{options}: {drawn} pixels");
        let shades: std::collections::HashSet<_> = picture.pixels().collect();
        assert!(shades.len() > 100, "{options}: {} colors", shades.len());
    }
}

#[test]
fn broken_files_are_blamed_by_line() {
    let folder = Folder::new();
    folder.write("word.obj", "v 0 0 0\nv 0 one 0\n");
    folder.write("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n\nf 1 2 4\n");
    folder.write("range.ply", text("ply").replace("3 2 0 3", "3 2 0 4"));
    folder.write("short.ply", &binary_ply()[..binary_ply().len() - 3]);
    folder.write("word.off", text("off").replace("1 0 0", "1 x 0"));
    folder.write("empty.obj", "");
    folder.write("empty.ply", text("ply").replace("vertex 4", "vertex 0").replace("face 4", "face 0"));
    folder.write("what.txt", "just words\n");
    for (name, place, what) in [
        ("word.obj", ":2", "`one`"),
        ("range.obj", ":5", "vertex 4"),
        ("range.ply", ":17", "vertex 4"),
        ("short.ply", "", "the file ends after 3 of 4 elements `face`"),
        ("word.off", ":4", "`x`"),
        ("empty.obj", "", "no vertex"),
        ("empty.ply", "", "no vertex"),
        ("what.txt", "", "not recognised"),
        ("missing.obj", "", "No such file"),
    ] {
        for line in [format!("info {name}"), format!("normals {name} -o a.ply"), format!("render {name} -o a.png")] {
            let error = folder.fail(&line, 1);
            assert!(error.starts_with(&format!("umbilic: {name}{place}: ")), "{line}: {error}");
            assert!(error.contains(what) && error.lines().count() == 1, "{line}: {error}");
        }
    }
    assert!(!folder.path("a.ply").exists() && !folder.path("a.png").exists());
    folder.write("good.obj", text("obj"));
    let error = folder.fail("normals good.obj -o none/a.ply", 1);
    assert!(error.starts_with("umbilic: none/a.ply: "), "{error}");
}

#[test]
fn wrong_usage_is_told_apart() {
    let folder = Folder::new();
    folder.write("good.obj", text("obj"));
    for (line, what) in [
        ("normals good.obj -o a.ply --weight heavy", "centroid-area"),
        ("normals good.obj -o a.obj", "must end in .ply"),
        ("normals good.obj", "--output"),
        ("normals good.obj -o a.ply --threads many", "threads"),
        ("render good.obj -o a.png --size 100", "1200x900"),
        ("render good.obj -o a.png --size 0x9", "between 1 and"),
        ("render good.obj -o a.png --azimuth north", "degrees"),
        ("render good.obj -o a.png --color red", "clay"),
        ("generate cone -o a.ply", "torus"),
        ("generate torus -o a.ply --resolution 0", "1.."),
        ("fly good.obj", "fly"),
        ("completions shell", "zsh"),
        ("man", "DIRECTORY"),
        ("", "Usage"),
    ] {
        let error = folder.fail(line, 2);
        assert!(error.contains(what), "{line}: {error}");
    }
}

#[test]
fn help_has_an_example_for_each_command() {
    let folder = Folder::new();
    for command in ["normals", "curvature", "info", "render", "generate", "completions", "man"] {
        let help = folder.succeed(&format!("{command} --help"));
        assert!(help.contains(&format!("Example:\n  umbilic {command} ")), "{help}");
    }
    assert!(folder.succeed("--help").contains("Exit status"));
    assert_eq!(folder.succeed("--version"), format!("umbilic {}\n", env!("CARGO_PKG_VERSION")));
}

/// The commands that the program's own help lists.
fn commands(folder: &Folder) -> Vec<String> {
    let help = folder.succeed("-h");
    let (_, list) = help.split_once("Commands:\n").unwrap();
    let names = list.lines().map_while(|line| line.strip_prefix("  ")?.split_whitespace().next());
    names.filter(|&name| name != "help").map(str::to_owned).collect()
}

#[test]
fn there_is_a_manual_page_for_each_command() {
    let folder = Folder::new();
    assert_eq!(folder.succeed("man share/man1"), "");
    let commands = commands(&folder);
    assert!(commands.len() >= 10, "{commands:?}");
    let page = |name: &str| fs::read_to_string(folder.path("share/man1").join(name)).unwrap();
    for command in &commands {
        let (page, program) = (page(&format!("umbilic-{command}.1")), page("umbilic.1"));
        assert!(page.contains(&format!("  umbilic {command} ")), "{command}: no example");
        assert!(program.contains(&format!("umbilic\\-{command}(1)")), "{command}: not in umbilic.1");
    }
    assert_eq!(fs::read_dir(folder.path("share/man1")).unwrap().count(), commands.len() + 1);

    folder.write("file", "");
    let error = folder.fail("man file", 1);
    assert!(error.starts_with("umbilic: file: "), "{error}");
}

#[test]
fn shells_complete_commands_options_and_values() {
    let folder = Folder::new();
    for shell in ["bash", "zsh", "fish"] {
        let script = folder.succeed(&format!("completions {shell}"));
        for word in commands(&folder) {
            assert!(script.contains(&word), "{shell}: {word}");
        }
        for word in ["crease-angle", "adaptive-jet"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
}

#[test]
fn a_reader_that_leaves_early_does_no_harm() {
    let folder = Folder::new();
    folder.write("good.obj", text("obj"));
    let mut program = Command::new(env!("CARGO_BIN_EXE_umbilic"))
        .args(["info", "good.obj"])
        .current_dir(folder.0.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(program.stdout.take());
    let output = program.wait_with_output().unwrap();
    assert_eq!((output.status.code(), output.stderr), (Some(0), Vec::new()));
}
