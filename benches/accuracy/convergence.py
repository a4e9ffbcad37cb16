#!/usr/bin/env python3
"""Measures how fast every normal and curvature of umbilic converges on smooth surfaces, and writes docs/convergence.md.

    python3 benches/accuracy/convergence.py [FILE]

Needs numpy only. Everything is seeded: the same library writes the same file.
"""

import sys
from pathlib import Path

import numpy
from estimators import CURVATURES, NORMALS, umbilic
from meshes import KINDS, Mesh
from report import report
from surfaces import SURFACES

# Directions are compared where k1 - k2 is at least this part of the surface's RMS curvedness.
APART = 0.2


def rms(values):
    return float(numpy.sqrt(numpy.mean(numpy.square(values))))


def degrees_between(a, b):
    """Between unit vectors; exact for small angles too."""
    return numpy.degrees(2 * numpy.arcsin(numpy.minimum(numpy.linalg.norm(a - b, axis=1) / 2, 1)))


def normal_error(topology, mesh, options):
    normals, _ = umbilic.vertex_normals(mesh.positions, topology, **options)
    return {"normal": rms(degrees_between(normals, mesh.exact.normal)[mesh.counted])}


def curvature_errors(topology, mesh, estimator):
    """Relative to RMS curvedness, or for K to its square; `k` is k1 and k2 together."""
    found, exact, counted = estimator.run(topology, mesh), mesh.exact, mesh.counted
    unit = rms(numpy.stack([exact.k1, exact.k2])[:, counted])
    truth = {"k1": exact.k1, "k2": exact.k2, "mean": exact.mean, "gaussian": exact.gaussian}
    errors = {
        name: rms((found[name] - truth[name])[counted]) / unit ** (2 if name == "gaussian" else 1)
        for name in truth
        if name in found
    }
    if "k1" in errors:
        errors["k"] = rms([errors["k1"], errors["k2"]])
    if "direction1" in found:
        apart = counted & (exact.k1 - exact.k2 >= APART * unit)
        sign = numpy.sign((found["direction1"] * exact.direction).sum(1))
        sign[sign == 0] = 1
        between = degrees_between(found["direction1"] * sign[:, None], exact.direction)
        errors["direction"] = rms(between[apart])
    return errors


def measure():
    """Errors at each size: errors[kind, surface][estimator][quantity]. And the numbers of vertices."""
    errors, counts = {}, {}
    for kind in KINDS:
        for surface in SURFACES:
            here = errors[kind, surface.name] = {}
            for size in surface.sizes:
                mesh = Mesh(surface, kind, size)
                counts.setdefault(surface.name, {})[size] = len(mesh.positions)
                with umbilic.Topology(mesh.faces, len(mesh.positions)) as topology:
                    found = {name: normal_error(topology, mesh, options) for name, options in NORMALS.items()}
                    found |= {name: curvature_errors(topology, mesh, each) for name, each in CURVATURES.items()}
                for name, quantities in found.items():
                    for quantity, error in quantities.items():
                        here.setdefault(name, {}).setdefault(quantity, []).append(error)
    return errors, {name: list(sizes.values()) for name, sizes in counts.items()}


def main(arguments):
    if len(arguments) > 1:
        sys.exit("usage: convergence.py [FILE]")
    docs = Path(__file__).resolve().parents[2] / "docs"
    file = Path(arguments[0]) if arguments else docs / "convergence.md"
    file.write_text(report(*measure()))
    print(f"{umbilic.build_info()}: {file} written")


if __name__ == "__main__":
    main(sys.argv[1:])
