#!/usr/bin/env python3
"""Counts the instructions a triangle that umbilic takes, which do not depend on what else the machine does.

    make bench-instructions             compares with benches/speed/instructions.txt; fails if any count grew by more than 3 %
    make bench-instructions UPDATE=1    writes that file anew

valgrind's callgrind counts two runs, of one and of three calls; half of the difference is a call without what comes before
it. One thread, a sphere of 20,480 triangles and a torus of 10,240 quadrilaterals, each of which counts as two triangles.
valgrind knows no AVX-512. Counts are those of one version of the compiler: where another one builds the library, write the
file anew first.
"""

import argparse
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "target" / "bench" / "build"
MESHES = ROOT / "target" / "bench" / "meshes"
# Kinds and sizes of generate_mesh.c: 20,480 triangles, or 10,240 quadrilaterals.
SIZES = {"sphere": 5, "quads": 160}
FILE = Path(__file__).with_name("instructions.txt")
ROOM = 1.03
LEVELS = {"portable": 1, "avx2": 3}  # of umb_simd
SINGLE = ("N_CM", "uniform", "angle", "area", "Max", "least squares", "Rusinkiewicz, on given normals") + (
    "corrected measure, on given normals",
)
DOUBLE = ("N_CM", "area", "least squares", "jets 2, 2 rings", "jets 3, 2 rings", "jets 4, 3 rings") + (
    "adaptive jets, 4 rings",
)
QUADS = ("area", "angle", "N_CM", "least squares, on given normals", "Meyer, on given normals") + (
    "Rusinkiewicz, on given normals",
    "corrected measure, on given normals",
)
Kernel = tuple[str, str, str, str]  # mesh, name, scalar, level


def kernels() -> list[Kernel]:
    found = [("sphere", name, "f32", "best") for name in ("topology", "N_CM from faces")]
    for mesh, scalar, names in (("sphere", "f32", SINGLE), ("sphere", "f64", DOUBLE), ("quads", "f32", QUADS)):
        found += [(mesh, name, scalar, level) for name in names for level in LEVELS]
    return [*found, ("quads", "topology", "f32", "best")]


def file(mesh: str) -> Path:
    return MESHES / f"counted-{mesh}.mesh"


def instructions(kernel: Kernel, calls: int) -> tuple[int, int]:
    """And the number of triangles."""
    mesh, name, scalar, level = kernel
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", BUILD / "count_instructions"]
    task = [file(mesh), name, scalar, str(LEVELS.get(level, 0)), str(calls)]
    done = subprocess.run([*command, *task], capture_output=True, text=True)
    count = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode != 0 or not count:
        sys.exit(f"{kernel} could not be counted:\n{done.stderr}")
    return int(count[1]), int(done.stdout)


def count(kernel: Kernel) -> float:
    """Instructions a triangle."""
    (one, triangles), (three, _) = instructions(kernel, 1), instructions(kernel, 3)
    return (three - one) / 2 / triangles


def read() -> dict[Kernel, float]:
    if not FILE.exists():
        return {}
    lines = [line.split("\t") for line in FILE.read_text().splitlines() if not line.startswith("#")]
    return {(mesh, name, scalar, level): float(value) for mesh, name, scalar, level, value in lines}


def write(counts: dict[Kernel, float]):
    head = "# Instructions a triangle: make bench-instructions UPDATE=1\n"
    FILE.write_text(head + "".join("\t".join([*kernel, f"{value:.1f}"]) + "\n" for kernel, value in counts.items()))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--update", action="store_true")
    update = parser.parse_args().update
    MESHES.mkdir(parents=True, exist_ok=True)
    for mesh, size in SIZES.items():
        subprocess.run([BUILD / "generate_mesh", mesh, str(size), file(mesh)], check=True)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        counts = dict(zip(kernels(), pool.map(count, kernels())))
    known, grown = read(), []
    for kernel, value in counts.items():
        before = known.get(kernel)
        change = "new" if before is None else f"{100 * (value / before - 1):+.1f} %"
        if before is not None and value > before * ROOM:
            grown.append(kernel)
        print(f"{', '.join(kernel):56}{value:10.1f}{change:>10}{'   grew' if kernel in grown else ''}")
    if update:
        write(counts)
        print(f"Written: {FILE.relative_to(ROOT)}")
    elif grown:
        sys.exit(f"{len(grown)} counts grew by more than 3 %")


if __name__ == "__main__":
    main()
