#!/usr/bin/env python3
"""What umbilic costs in each host: lines of the user's code, copies, and the adapter's time beside the library's. Writes docs/hosts.md.

    make bench-hosts [MESH=file.off]    C++, OpenMesh, CGAL and Python; MeshLab and other languages if their tests have been run

A host is a program that prints lines, tab-separated (see host.hpp); its user's code stands between comments that say so. Hosts that
are not built are left out, with a line that says so.
"""

import datetime
import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benches" / "speed"))
import machine  # noqa: E402

QUANTITIES = ("topology", "vertex normals", "curvature")


@dataclass(frozen=True)
class Program:
    """What prints the lines of some hosts, `command` with the mesh added; what is there if it can run; where the user's code stands."""

    command: tuple[str, ...]
    needs: str
    missing: str
    code: dict[str, tuple[str, ...]]
    variables: dict[str, str] | None = None


PROGRAMS = (
    Program(("target/hosts/structs",), "target/hosts/structs", "it is not built", {"C++ structs": ("benches/hosts/structs.cpp",)}),
    Program(
        ("target/hosts/openmesh",), "target/hosts/openmesh", "it is not built", {"OpenMesh": ("benches/hosts/openmesh.cpp",)}
    ),
    Program(
        ("target/hosts/cgal",),
        "target/hosts/cgal",
        "it is not built",
        dict.fromkeys(("CGAL, EPICK", "CGAL, EPECK"), ("benches/hosts/cgal.cpp",)),
    ),
    Program(
        ("target/meshlab/build/timing", "target/meshlab/build/libfilter_umbilic.so"),
        "target/meshlab/build/timing",
        "`make test-meshlab` builds it",
        {"meshlab": ("bindings/meshlab/examples/normals.mlx", "bindings/meshlab/examples/curvature.mlx")},
        {"QT_QPA_PLATFORM": "offscreen"},
    ),
    Program(
        ("target/python/venv/bin/python", "-B", "benches/hosts/python.py"),
        "target/python/venv/done",
        "`make test-python` builds what it runs in",
        dict.fromkeys(("numpy", "trimesh", "pyvista"), ("benches/hosts/python.py",)),
        {"UMBILIC_LIBRARY": "target/release/libumbilic.so", "PYTHONPATH": "bindings/python/src"},
    ),
    Program(
        (sys.executable, "-B", "tests/ffi/test.py", "target/release/libumbilic.so", "--time"),
        "target/ffi",
        "`make test-ffi` builds them",
        {
            "node": ("bindings/node/curvature.js",),
            "go": ("bindings/go/curvature/main.go",),
            "java": ("bindings/java/Curvature.java",),
            "c#": ("bindings/csharp/Curvature.cs",),
            "luajit": ("bindings/lua/curvature.lua",),
            "fortran": ("bindings/fortran/curvature.f90",),
        },
    ),
)
TITLES = {"meshlab": "MeshLab", "node": "Node", "go": "Go", "java": "Java", "c#": "C#", "luajit": "LuaJIT", "fortran": "Fortran"}
COMMENTS = ("//", "#", "--", "!", "/*", "*", "<!--")


def user_code(files: tuple[str, ...], host: str) -> int:
    """Lines between `begin: user code` and `end: user code` that are neither empty nor comments; where the first names a host, of this one."""
    count = 0
    for file in files:
        regions = re.findall(r"begin: user code(?:, ([^\n]*))?[^\n]*\n(.*?)end: user code", (ROOT / file).read_text(), re.DOTALL)
        lines = [line.strip() for name, text in regions if name in ("", host) for line in text.splitlines()]
        count += sum(1 for line in lines if line and not line.startswith(COMMENTS))
    if count == 0:
        sys.exit(f"{', '.join(files)}: no user's code for {host}")
    return count


def measure(program: Program, mesh: Path) -> dict[str, dict[str, tuple[str, float, float]]]:
    """By host and quantity: copies, milliseconds in the library, and more of them in the adapter."""
    found: dict[str, dict[str, tuple[str, float, float]]] = {}
    variables = os.environ | (program.variables or {})
    done = subprocess.run([*program.command, str(mesh)], cwd=ROOT, capture_output=True, text=True, env=variables)
    if done.returncode != 0:
        sys.exit(f"{' '.join(program.command)} failed:\n{done.stderr}")
    for line in done.stdout.splitlines():
        host, quantity, copies, library, adapter = line.split("\t")
        found.setdefault(host, {})[quantity] = (copies, float(library), float(adapter))
    return found


def cell(_copies: str, library: float, adapter: float) -> str:
    return f"{library:.2f} + {max(adapter, 0):.2f}"


def rows(mesh: Path) -> list[list[str]]:
    lines = []
    for program in PROGRAMS:
        if not (ROOT / program.needs).exists():
            print(f"{', '.join(program.code)}: left out; {program.missing}", flush=True)
            continue
        print(", ".join(program.code), flush=True)
        for host, quantities in measure(program, mesh).items():
            faces, rest = (quantities[name][0] for name in ("topology", "vertex normals"))
            cells = [cell(*quantities[name]) for name in QUANTITIES]
            lines.append([TITLES.get(host, host), str(user_code(program.code[host], host)), faces, rest, *cells])
    return lines


def page(mesh: Path, lines: list[list[str]]) -> str:
    table = [["host", "lines", "copies of faces", "of the rest", *(f"{name}, ms" for name in QUANTITIES)], ["---"] + 6 * ["---:"], *lines]
    return "\n".join(
        [
            "# What umbilic costs in each host",
            "",
            f"Written by `make bench-hosts` on {datetime.date.today()}: {mesh.name}, one thread, {machine.processor()}.",
            "",
            "*Lines* of the user's code, from a mesh in the host's terms to normals and curvatures in it. *Copies* that the adapter makes:",
            "of faces, where a topology is built; of positions and results. Then milliseconds in the library, by the C interface alone",
            "on the same arrays, *+* those by which the whole call in the host's terms is longer; the shortest of many that take",
            "turns, so that a hundredth of the curvatures' time is noise. OpenMesh, the C++ structs, MeshLab and pyvista hold `float`, the others `double`.",
            "MeshLab's lines are those of a script that names all parameters; in its window there are none.",
            "",
            *(f"| {' | '.join(line)} |" for line in table),
            "",
        ]
    )


def main():
    mesh = Path(sys.argv[1]).resolve()
    text = page(mesh, rows(mesh))
    (ROOT / "docs" / "hosts.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
