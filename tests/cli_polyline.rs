//! `umbilic polyline`, run as its users run it.

#![cfg(feature = "cli")]

use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const SQUARE: &str = "# a square\n0 0\n1, 0\n1 1  # top\n\n0,1\n";

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
    assert_eq!(output.status.code(), Some(code), "{line}");
    assert!(output.stdout.is_empty(), "{line}");
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn a_table_a_json_object_and_a_csv_file_agree() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("square.txt"), SQUARE).unwrap();
    let text = succeed(folder, "polyline square.txt --closed");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
    assert!(rows.contains(&vec!["points", "4"]) && rows.contains(&vec!["closed", "yes"]), "{text}");
    let head = ["vertex", "circle", "parabola", "length-parabola", "symmetric-parabola", "status"];
    let start = rows.iter().position(|row| row == &head).unwrap();
    assert_eq!(rows.len(), start + 5);
    let numbers = |row: &[&str]| -> Vec<f64> { row.iter().map(|word| word.parse().unwrap()).collect() };
    let exact = [2f64.sqrt(), 8f64.sqrt(), 8f64.sqrt(), 8f64.sqrt()];
    for (vertex, row) in rows[start + 1..].iter().enumerate() {
        let row = numbers(row);
        assert_eq!((row[0], row[5]), (vertex as f64, 0.0));
        assert!(row[1..5].iter().zip(exact).all(|(found, exact)| (found - exact).abs() < 1e-5), "{row:?}");
    }
    let json: Value = serde_json::from_str(&succeed(folder, "polyline square.txt --closed --json")).unwrap();
    assert_eq!((&json["points"], &json["dimension"], &json["closed"]), (&4.into(), &2.into(), &true.into()));
    assert_eq!(json["status"], serde_json::json!([0, 0, 0, 0]));

    let summary = succeed(folder, "polyline square.txt --closed -o square.csv");
    assert!(summary.contains("points") && !summary.contains("vertex"), "{summary}");
    let csv = fs::read_to_string(folder.join("square.csv")).unwrap();
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("vertex,circle,parabola,length_parabola,symmetric_parabola,status"));
    for (vertex, line) in lines.enumerate() {
        let row = numbers(&line.split(',').collect::<Vec<_>>());
        for (name, value) in ["circle", "parabola", "length_parabola", "symmetric_parabola"].iter().zip(&row[1..]) {
            assert_eq!(json["curvature"][name][vertex].as_f64(), Some(*value), "{name}");
        }
    }
    assert_eq!(csv.lines().count(), 5);
    let json: Value = serde_json::from_str(&succeed(folder, "polyline square.txt --json -o square.csv")).unwrap();
    assert_eq!(json["status_counts"]["ends"], 2);
    assert!(json.get("curvature").is_none());
}

#[test]
fn cusps_in_space_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("fold.txt"), "0 0 0\n0 2 0\n0 0 0\n0 0 0\n1 1 1\n").unwrap();
    let json: Value = serde_json::from_str(&succeed(folder, "polyline fold.txt --json")).unwrap();
    assert_eq!(json["status"], serde_json::json!([1, 2, 4, 4, 1]));
    assert_eq!(json["dimension"], 3);
    assert_eq!(json["curvature"]["symmetric_parabola"][1], f64::MAX);
    assert_eq!(json["curvature"]["circle"][1], 1.0);
    assert!(succeed(folder, "polyline fold.txt").contains("1.79769e308"));
}

#[test]
fn bad_files_and_bad_usage_are_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (text, place, what) in [
        ("0 0\n1 zero\n", ":2", "`zero`"),
        ("0 0\n1 1\n2 2 2\n", ":3", "3 coordinates"),
        ("0\n", ":1", "found one"),
        ("0 inf\n", ":1", "finite"),
        ("# empty\n", "", "no point"),
    ] {
        fs::write(folder.join("bad.txt"), text).unwrap();
        let error = fail(folder, "polyline bad.txt -o out.csv", 1);
        assert!(error.starts_with(&format!("umbilic: bad.txt{place}: ")), "{error}");
        assert!(error.contains(what) && error.lines().count() == 1, "{error}");
        assert!(!folder.join("out.csv").exists());
    }
    assert!(fail(folder, "polyline none.txt", 1).starts_with("umbilic: none.txt: "));
    fs::write(folder.join("square.txt"), SQUARE).unwrap();
    assert!(fail(folder, "polyline square.txt -o none/out.csv", 1).starts_with("umbilic: none/out.csv: "));
    assert!(fail(folder, "polyline square.txt -o out.ply", 2).contains("must end in .csv"));
    assert!(succeed(folder, "polyline --help").contains("Example:\n  umbilic polyline "));
}
