//! The environment variable `UMBILIC_SIMD`, which a process reads once: the test runs itself again with each value.
// Every call keeps the contract that the header states.
#![allow(clippy::undocumented_unsafe_blocks)]

mod common;
use common::capi::{Handle, normals};
use common::mesh::torus;
use std::ffi::CStr;
use std::process::Command;
use umbilic::capi::*;

/// The names of the levels, narrowest first.
const LEVELS: [&str; 3] = ["portable", "avx2", "avx512"];

/// Set in the processes that the test starts.
const CHILD: &str = "UMBILIC_TEST_CHILD";

/// The level that `umb_build_info` names.
fn level() -> String {
    let info = unsafe { CStr::from_ptr(umb_build_info()) }.to_str().unwrap();
    info.rsplit_once("vectors: ").expect(info).1.to_owned()
}

/// One number for all bits of normals in both precisions.
fn fingerprint() -> u64 {
    let mesh = torus(40, 30, 0.2, 0.0, 1);
    let rounded: Vec<[f32; 3]> = mesh.positions.iter().map(|position| position.map(|x| x as f32)).collect();
    let handle = Handle::new(&mesh);
    let mut hash = 0u64;
    let mut add = |bits: u64| hash = (hash ^ bits).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(17);
    for weight in [UMB_WEIGHT_CONFORMAL, UMB_WEIGHT_ANGLE, UMB_WEIGHT_TILTED_SECTIONS, UMB_WEIGHT_ADAPTIVE_JET] {
        for x in normals(&handle, &mesh.positions, weight, false, |_| ()).normal.iter().flatten() {
            add(x.to_bits());
        }
        for x in normals(&handle, &rounded, weight, false, |_| ()).normal.iter().flatten() {
            add(x.to_bits().into());
        }
    }
    hash
}

/// Level and fingerprint of a process with this value of the variable.
fn run_with(value: Option<&str>) -> (String, String) {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args(["--exact", "simd_variable", "--nocapture"]).env(CHILD, "1").env_remove("UMBILIC_SIMD");
    if let Some(value) = value {
        command.env("UMBILIC_SIMD", value);
    }
    let output = command.output().unwrap();
    assert!(output.status.success(), "{value:?}: {output:?}");
    let text = String::from_utf8(output.stdout).unwrap();
    let (_, answer) = text.split_once("child: ").expect(&text);
    let mut words = answer.split_whitespace().map(str::to_owned);
    (words.next().unwrap(), words.next().unwrap())
}

#[test]
fn simd_variable() {
    if std::env::var_os(CHILD).is_some() {
        println!("child: {} {:016x}", level(), fingerprint());
        return;
    }
    let rank = |level: &str| LEVELS.iter().position(|name| *name == level).expect("no such level");
    let (widest, bits) = run_with(None);
    for (asked, name) in LEVELS.iter().enumerate() {
        let expected = LEVELS[asked.min(rank(&widest))];
        assert_eq!(run_with(Some(name)), (expected.to_owned(), bits.clone()), "UMBILIC_SIMD={name}");
    }
    // A name of before, for what is portable now.
    assert_eq!(run_with(Some("sse2")), ("portable".to_owned(), bits.clone()));
    // What is no level has no effect.
    for value in ["", "none", "AVX2", "avx2 ", "1"] {
        assert_eq!(run_with(Some(value)), (widest.clone(), bits.clone()), "UMBILIC_SIMD={value}");
    }
}
