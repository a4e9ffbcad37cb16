#!/usr/bin/env python3
"""Normals and mean curvature of scans by umbilic, libigl and VCG, side by side: pictures and figures.

python3 benches/scans/scans.py MESHES [FOLDER]

MESHES is where tests/peers/meshes.sh left its meshes. Writes scans.md and scans_*.png to the folder, docs if nothing
is said. Everything but times is the same in every run.
"""

import sys
from pathlib import Path

import places  # noqa: F401
import boards
import page
from columns import ROUNDS, AdaptiveJet, Found, Libigl, Vcg
from stability import Measured
from places import ROOT
from subjects import SHOWN, Mesh

QUIETER = 10  # the page says: a tenth


def main(arguments):
    if len(arguments) not in (1, 2):
        sys.exit("usage: scans.py MESHES [FOLDER]")
    folder = Path(arguments[1]) if len(arguments) == 2 else ROOT / "docs"
    drawn = [AdaptiveJet(), Libigl(), Vcg(), AdaptiveJet(QUIETER)]
    columns = [*drawn, Libigl(radius=2), Vcg(fitted=True)]
    meshes = [Mesh(name, Path(arguments[0])) for name in SHOWN]
    measured = []
    for mesh in meshes:
        found = [Found(column, mesh, ROUNDS) for column in columns]
        measured.append(Measured(mesh, columns, found))
        print(f"{mesh.name}: measured", flush=True)
    boards.draw(measured, drawn, folder)
    (folder / "scans.md").write_text(page.make(measured, drawn) + "\n")
    print(f"{folder / 'scans.md'} written")


if __name__ == "__main__":
    main(sys.argv[1:])
