"""What the paper claims of sections, measured: principal curvatures from them, by circle and by symmetric parabola."""

import places  # noqa: F401
import umbilic
from convergence import rms
from irregular import SURFACES, Errors, cases
from pages import short

SECTIONS = {"C": "circle", "SP": "symmetric-parabola"}
NORMALS = ("N_CM", "Max", "exact")
# Earlier methods that the paper names, and others; by the normals that they take.
RIVALS = {
    "Meyer et al.": ("meyer", None),
    "quadric, N_CM": ("quadric", "conformal"),
    "Goldfeather and Interrante, N_CM": ("goldfeather", "conformal"),
    "Rusinkiewicz, N_CM": ("rusinkiewicz", "conformal"),
    "tilted sections": ("tilted-sections", None),
    "jet of degree 3": ("jet", None),
    "adaptive jet": ("adaptive-jet", None),
}


def error(topology, mesh, method, **options):
    """Of k1 and k2 together, relative to the surface's curvedness."""
    found = umbilic.curvatures(mesh.positions, topology, method=method, outputs=("k1", "k2"), **options)
    exact, counted = mesh.exact, mesh.counted
    unit = rms([exact.k1[counted], exact.k2[counted]])
    return rms([(found.k1 - exact.k1)[counted], (found.k2 - exact.k2)[counted]]) / unit


def on_surfaces(library):
    errors = Errors()
    for case in cases():
        mesh = case.mesh
        with umbilic.Topology(mesh.faces, len(mesh.positions)) as topology:
            given = {"N_CM": {"weight": "conformal"}, "Max": {"weight": "max"}, "exact": {"normals": mesh.exact.normal}}
            for letter, section in SECTIONS.items():
                for normals in NORMALS:
                    found = error(topology, mesh, "least-squares", section=section, **given[normals])
                    errors.add((letter, normals), case, found)
            for name, (method, weight) in RIVALS.items():
                options = {"weight": weight} if weight else {}
                errors.add(name, case, error(topology, mesh, method, **options))
    return errors


def name(letter, normals):
    return f"sections {letter}, least squares, {normals}"


def surface_table(errors, kind):
    keys = [(letter, normals) for normals in NORMALS for letter in SECTIONS]
    rows = [(name(*key), key) for key in keys] + [(rival, rival) for rival in RIVALS if rival in errors.found]
    return [[title, *(short(errors.finest(key, kind, surface.name)) for surface in SURFACES)] for title, key in rows]


def compared(errors, normals):
    """In how many cases the symmetric parabola is better by more than 2 %, the circle is, and neither."""
    parabola, circle = errors.found["SP", normals], errors.found["C", normals]
    pairs = [pair for key in parabola for pair in zip(parabola[key], circle[key])]
    better = [sum(a < 0.98 * b for a, b in pairs), sum(b < 0.98 * a for a, b in pairs)]
    return [*better, len(pairs) - sum(better)]
