#!/usr/bin/env python3
"""What umbilic costs in each host: lines of the user's code, copies, and the adapter's time beside the library's. Writes docs/hosts.md.

    make bench-hosts [MESH=file.off]    C++, OpenMesh, CGAL and Python; MeshLab and other languages if their tests have been run

A host is a program that prints lines, tab-separated (see host.hpp); its user's code stands between comments that say so. Hosts that
are not built are left out, with a line that says so.
"""

import datetime
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
    """What prints the lines of some hosts, `command` with the mesh added, and where these hosts' user's code stands."""

    command: tuple[str, ...]
    code: str
    missing: str


PROGRAMS = (
    Program(("target/hosts/structs",), "benches/hosts/structs.cpp", "it is not built"),
    Program(("target/hosts/openmesh",), "benches/hosts/openmesh.cpp", "OpenMesh is not installed (Debian: libopenmesh-dev)"),
    Program(("target/hosts/cgal",), "benches/hosts/cgal.cpp", "CGAL is not installed (Debian: libcgal-dev)"),
)


def user_code(path: Path, host: str) -> int:
    """Lines between `begin: user code` and `end: user code` that are neither empty nor comments; if the comments name hosts, of this one."""
    regions = re.findall(r"begin: user code(?:, ([^\n]*))?\n(.*?)end: user code", path.read_text(), re.DOTALL)
    named = [text for name, text in regions if name == host] or [text for name, text in regions if not name]
    if not named:
        sys.exit(f"{path.relative_to(ROOT)} has no user's code for {host}")
    lines = [line.strip() for line in named[0].splitlines()]
    return sum(1 for line in lines if line and not line.startswith(("//", "#", "--", "!", "/*", "*")))


def measure(program: Program, mesh: Path) -> dict[str, dict[str, tuple[str, float, float]]]:
    """By host and quantity: copies, milliseconds in the library, and more of them in the adapter."""
    found: dict[str, dict[str, tuple[str, float, float]]] = {}
    done = subprocess.run([*program.command, str(mesh)], cwd=ROOT, stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(program.command)} failed")
    for line in done.stdout.splitlines():
        host, quantity, copies, library, adapter = line.split("\t")
        found.setdefault(host, {})[quantity] = (copies, float(library), float(adapter))
    return found


def cell(copies: str, library: float, adapter: float) -> str:
    share = max(adapter, 0) / library
    percent = f"{100 * share:.0f} %" if share >= 0.01 else "< 1 %"
    return f"{library:.2f} ms, {percent}"


def rows(mesh: Path) -> list[list[str]]:
    lines = []
    for program in PROGRAMS:
        if not (ROOT / program.command[0]).exists():
            print(f"{program.code} is left out: {program.missing}", flush=True)
            continue
        print(" ".join(program.command), flush=True)
        for host, quantities in measure(program, mesh).items():
            copies = max((copies for copies, _, _ in quantities.values()), key=lambda text: text != "0")
            cells = [cell(*quantities[name]) if name in quantities else "—" for name in QUANTITIES]
            lines.append([host, str(user_code(ROOT / program.code, host)), copies, *cells])
    return lines


def page(mesh: Path, lines: list[list[str]]) -> str:
    table = [["host", "lines", "copies", *QUANTITIES], ["---", "---:", "---:", "---:", "---:", "---:"], *lines]
    return "\n".join(
        [
            "# What umbilic costs in each host",
            "",
            f"Written by `make bench-hosts` on {datetime.date.today()}: {mesh.name}, one thread, {machine.processor()}.",
            "",
            "*Lines* of the user's code, from a mesh in the host's terms to normals and curvatures in it. *Copies* of positions and",
            "results that the adapter makes, the topology's faces apart. Then milliseconds in the library, by the C interface alone on",
            "the same arrays, and how much longer the whole call in the host's terms takes; the shortest of many that take turns.",
            "",
            *(f"| {' | '.join(line)} |" for line in table),
            "",
        ]
    )


def main():
    mesh = Path(sys.argv[1])
    text = page(mesh, rows(mesh))
    (ROOT / "docs" / "hosts.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
