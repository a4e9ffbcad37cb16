//! The kernels of the built library hold the instructions of their level, no others, and no calls that should have been
//! inlined: a helper that is called lacks the level's CPU features, and makes a kernel several times slower without any
//! other sign.
//!
//! Reads the library that `UMBILIC_LIBRARY` names (`make test` sets it) with `objdump`.
#![cfg(all(target_arch = "x86_64", target_os = "linux"))]

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

/// A function of the library.
struct Function {
    name: String,
    instructions: Vec<(String, String)>,
}

/// The levels, and by what the names of their functions are known.
const LEVELS: [(&str, &str); 3] = [
    ("portable", "<umbilic::simd::Portable as umbilic::simd::Width>::call"),
    ("avx2", "umbilic::simd::widths::run_avx2"),
    ("avx512", "umbilic::simd::widths::run_avx512"),
];

fn functions(library: &str) -> Vec<Function> {
    let output = Command::new("objdump").args(["-d", "-C", "--no-show-raw-insn", library]).output();
    let output = output.expect("objdump, of the package binutils");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    let mut functions: Vec<Function> = vec![];
    for line in text.lines() {
        if let Some(name) = line.strip_suffix(">:").and_then(|line| line.split_once(" <")).map(|(_, name)| name) {
            functions.push(Function { name: name.to_owned(), instructions: vec![] });
        } else if let (Some((_, code)), Some(function)) = (line.split_once(":\t"), functions.last_mut()) {
            let (mnemonic, operands) = code.split_once(char::is_whitespace).unwrap_or((code, ""));
            function.instructions.push((mnemonic.to_owned(), operands.trim().to_owned()));
        }
    }
    functions
}

/// Arithmetic on whole registers of floats: `mulps`, `vdivpd` ….
fn is_packed_arithmetic(mnemonic: &str) -> bool {
    let name = mnemonic.strip_prefix('v').unwrap_or(mnemonic);
    ["add", "sub", "mul", "div", "sqrt"]
        .iter()
        .any(|operation| name.strip_prefix(operation).is_some_and(|rest| rest == "ps" || rest == "pd"))
}

/// What rounds once where the formula rounds twice, or only approximates.
fn changes_bits(mnemonic: &str) -> bool {
    ["vfmadd", "vfmsub", "vfnmadd", "vfnmsub", "rcp", "vrcp", "rsqrt", "vrsqrt"]
        .iter()
        .any(|start| mnemonic.starts_with(start))
}

/// Small functions that belong inlined into kernels.
fn is_stray(target: &str) -> bool {
    if target.contains("drop_in_place") || target.contains("panic") {
        return false;
    }
    let own = target.contains("umbilic::simd::") && !LEVELS.iter().any(|(_, name)| target.contains(name));
    let small =
        ["core::array::", "core::core_arch::", "core::num::", "core::cmp::", "core::f32", "core::f64", "core::ops::"];
    own || small.iter().any(|path| target.contains(path))
}

#[test]
fn kernels_hold_the_instructions_of_their_level() {
    let Ok(library) = std::env::var("UMBILIC_LIBRARY") else {
        println!("UMBILIC_LIBRARY names no library: not tested");
        return;
    };
    let functions = functions(&library);
    let mut stray: BTreeMap<String, BTreeSet<&str>> = BTreeMap::new();
    for (level, mark) in LEVELS {
        let (mut kernels, mut full, mut packed) = (0, 0, 0);
        for function in functions.iter().filter(|function| function.name.contains(mark)) {
            kernels += 1;
            for (mnemonic, operands) in &function.instructions {
                let has = |register: &str| operands.contains(register);
                assert!(!changes_bits(mnemonic), "{level}: {mnemonic} {operands} in {}", function.name);
                let above = match level {
                    "avx512" => false,
                    "avx2" => has("%zmm") || has("%k1") || has("%xmm16"),
                    _ => has("%ymm") || has("%zmm") || mnemonic.starts_with('v') && has("%xmm"),
                };
                assert!(!above, "{level}: {mnemonic} {operands} in {}", function.name);
                if is_packed_arithmetic(mnemonic) {
                    packed += 1;
                    full += match level {
                        "avx512" => has("%zmm"),
                        "avx2" => has("%ymm"),
                        _ => has("%xmm"),
                    } as usize;
                }
                if mnemonic.starts_with("call") {
                    let target = operands.split_once('<').map_or("", |(_, target)| target);
                    if is_stray(target) {
                        stray.entry(target.to_owned()).or_default().insert(level);
                    }
                }
            }
        }
        assert!(kernels >= 40, "{level}: only {kernels} kernels");
        // What is scalar or half a register wide: transpositions, tails, the odd vertex.
        assert!(packed > 10_000 && full * 10 > packed * 9, "{level}: {full} of {packed} are full registers");
        println!("{level}: {kernels} kernels, {full} of {packed} arithmetic instructions on full registers");
    }
    assert!(stray.is_empty(), "calls that should have been inlined: {stray:#?}");
}
