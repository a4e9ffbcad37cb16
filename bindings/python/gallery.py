#!/usr/bin/env python3
"""Renders curvature of meshes with pyvista, off-screen: three PNGs of each.

    python3 gallery.py FOLDER MESH...

Mean curvature, the principal directions as lines, and segments: by creases if there are any, else by watershed. Needs
umbilic and pyvista; meshes are whatever pyvista reads, and OFF.
"""

import sys
from pathlib import Path

import numpy
import pyvista

import umbilic

SIZE = (900, 800)
LINES = 6000  # vertices at which directions are drawn


def read(path):
    """A surface whose polygons share their corners."""
    if path.suffix.lower() != ".off":
        return pyvista.read(path).extract_surface().clean()
    words = [line.split("#")[0].split() for line in path.read_text(errors="replace").splitlines()]
    words = [word for line in words for word in line][1:]
    vertices, faces = int(words[0]), int(words[1])
    points = numpy.array(words[3 : 3 + 3 * vertices], float).reshape(-1, 3)
    cells, place = [], 3 + 3 * vertices
    for _ in range(faces):
        end = place + 1 + int(words[place])
        cells += [int(word) for word in words[place:end]]
        place = end
    return pyvista.PolyData(points, faces=cells)


def limit(values):
    """What all but a twentieth of the values stay below: for colours."""
    return float(numpy.quantile(numpy.abs(values), 0.95)) or 1.0


def plotter():
    made = pyvista.Plotter(off_screen=True, window_size=SIZE)
    made.set_background("white")
    return made


def mean(mesh):
    top = limit(mesh["mean"])
    made = plotter()
    made.add_mesh(mesh, scalars="mean", cmap="RdBu_r", clim=(-top, top), smooth_shading=True)
    return made


def directions(mesh):
    """A line along each direction at vertices that are curved one way more than the other."""
    apart = mesh["k1"] - mesh["k2"]
    chosen = numpy.flatnonzero(apart > 0.1 * limit(apart))
    step = max(1, len(chosen) // LINES)
    chosen = chosen[::step]
    reach = 0.5 * numpy.sqrt(step * mesh.area / mesh.n_points)
    made = plotter()
    made.add_mesh(mesh, color="white", smooth_shading=True)
    for name, colour in (("direction1", "crimson"), ("direction2", "navy")):
        along = reach * mesh[name][chosen]
        at = mesh.points[chosen] + 0.2 * reach * mesh["normal"][chosen]
        ends = numpy.stack([at - along, at + along], 1).reshape(-1, 3)
        lines = numpy.insert(numpy.arange(len(ends)).reshape(-1, 2), 0, 2, axis=1)
        made.add_mesh(pyvista.PolyData(ends, lines=lines.ravel()), color=colour, line_width=2)
    return made


def segments(mesh):
    made = plotter()
    labels = mesh.cell_data["segment"].astype(float)
    shown = mesh.copy()
    shown.cell_data["colour"] = (labels * 0.618034) % 1  # neighbours in number are far apart in colour
    made.add_mesh(shown, scalars="colour", cmap="hsv", show_scalar_bar=False)
    return made


def main(arguments):
    if len(arguments) < 2:
        sys.exit("usage: gallery.py FOLDER MESH...")
    folder = Path(arguments[0])
    folder.mkdir(parents=True, exist_ok=True)
    for path in map(Path, arguments[1:]):
        mesh = read(path)
        outputs = ("mean", "k1", "k2", "direction1", "direction2", "normal")
        umbilic.pyvista.curvatures(mesh, outputs=outputs)
        parts = umbilic.pyvista.segment(mesh)
        if len(parts) == 1:  # nothing that a machine made
            parts = umbilic.pyvista.segment(mesh, by="watershed")
        for draw in (mean, directions, segments):
            picture = folder / f"{path.stem}_{draw.__name__}.png"
            made = draw(mesh)
            made.screenshot(picture)
            made.close()
            print(f"{picture}: {mesh.n_points} vertices, {len(parts)} segments", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
