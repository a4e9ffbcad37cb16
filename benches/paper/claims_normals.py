"""What the paper claims of normals, measured: on irregular smooth surfaces, and on single rings as Max did it."""

import numpy
import places  # noqa: F401
import style
import umbilic
from convergence import degrees_between, rms
from irregular import SURFACES, Errors, cases
from library import PAPER
from meshes import KINDS
from pages import short
from polyhedra import fans, unit

# The paper's, those of one ring that it does not compare, and fits for a measure of what there is to gain.
OTHERS = {"N_C as printed": "centroid-area", "Max": "max", "Jin et al.": "inverse-root-edges", "sine": "sine"}
FITS = {"tilted sections": "tilted-sections", "jet of degree 3": "jet", "adaptive jet": "adaptive-jet"}
LISTED = PAPER | OTHERS | FITS

RINGS, VALENCES = 2500, range(3, 10)
PLOTTED = PAPER | {"Max": "max"}


def on_surfaces(library):
    """Root mean squares of the angle to the exact normal, in degrees."""
    errors = Errors()
    for case in cases():
        with umbilic.Topology(case.mesh.faces, len(case.mesh.positions)) as topology:
            for name, weight in LISTED.items():
                normals = umbilic.vertex_normals(case.mesh.positions, topology, weight=weight).normal
                off = degrees_between(normals, case.mesh.exact.normal)
                errors.add(name, case, rms(off[case.mesh.counted]))
    return errors


def random_angles(random, valence):
    """Sorted, with no gap of 176° or more and none below 3°."""
    found = numpy.empty((0, valence))
    while len(found) < RINGS:
        angles = numpy.sort(random.uniform(0, 2 * numpy.pi, (8 * RINGS, valence)), axis=1)
        gaps = numpy.diff(angles, axis=1, append=angles[:, :1] + 2 * numpy.pi)
        fit = (gaps.max(1) < numpy.radians(176)) & (gaps.min(1) > numpy.radians(3))
        found = numpy.concatenate([found, angles[fit]])
    return found[:RINGS]


def even_angles(random, valence):
    """Even angles, each moved by up to 30 % of their distance."""
    return 2 * numpy.pi * (numpy.arange(valence) + random.uniform(-0.3, 0.3, (RINGS, valence))) / valence


def rings(random, angles):
    """Neighbours of vertices at the origin, on random cubic surfaces that have the normal (0, 0, 1) there."""
    radius = random.uniform(0.05, 1, angles.shape)
    x, y = radius * numpy.cos(angles), radius * numpy.sin(angles)
    terms = numpy.stack([x * x, x * y, y * y, x**3, x * x * y, x * y * y, y**3], -1)
    coefficients = random.uniform(-0.1, 0.1, (len(angles), 7))
    return numpy.stack([x, y, numpy.einsum("rmt,rt->rm", terms, coefficients)], -1)


def on_rings(library):
    """Root mean square errors in degrees by kind of angles, weight and valence."""
    random = numpy.random.RandomState(1)
    found = {}
    for kind, draw in (("random angles", random_angles), ("even angles, jittered", even_angles)):
        for valence in VALENCES:
            neighbours = rings(random, draw(random, valence))
            positions, faces = fans(neighbours)
            with umbilic.Topology(faces, len(positions)) as mesh:
                for name, weight in PLOTTED.items():
                    normals = umbilic.vertex_normals(positions, mesh, weight=weight).normal
                    normals = unit(normals[: len(neighbours)])
                    off = 2 * numpy.degrees(numpy.arcsin(numpy.linalg.norm(normals - [0, 0, 1], axis=1) / 2))
                    found.setdefault(kind, {}).setdefault(name, []).append(float(numpy.sqrt((off**2).mean())))
    return found


def plot_rings(found, folder):
    drawing, axes = style.panels(1, 2, 9.4, 3.9, gridspec_kw={"wspace": 0.12}, sharey=True)
    for axis, (kind, errors) in zip(axes.flat, found.items()):
        for name, values in errors.items():
            axis.plot(VALENCES, values, "o-", markersize=4, color=style.WEIGHT[name], label=style.name(name))
        axis.set(title=kind, xlabel="neighbours")
    axes[0, 0].set_ylabel("RMS error, degrees")
    axes[0, 0].set_yscale("log")
    axes[0, 0].set_yticks([1, 2, 5, 10, 20], [1, 2, 5, 10, 20])
    axes[0, 0].minorticks_off()
    axes[0, 1].legend(ncols=2)
    style.save(drawing, folder, "rings.svg")


def surface_table(errors, kind):
    """Rows of a table: degrees on the finer meshes."""
    return [[name, *(short(errors.finest(name, kind, surface.name)) for surface in SURFACES)] for name in errors.found]


def wins_table(errors):
    """In how many cases N_CM has the smaller error."""
    return [
        [name, *("{} of {}".format(*errors.wins("N_CM", name, [kind])) for kind in KINDS)]
        for name in errors.found
        if name != "N_CM"
    ]
