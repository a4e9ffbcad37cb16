"""The meshes that claims are measured on: those of benches/accuracy, a sphere, and a surface in narrow triangles."""

import numpy
import places  # noqa: F401
from meshes import KINDS, Mesh
from surfaces import Cubic, Ellipsoid, Torus

SEEDS = (1, 2, 3, 4, 5)


class Sphere(Ellipsoid):
    name = "sphere"
    axes = numpy.ones(3)


class Stretched(Cubic):
    """Over a fifth of the cubic's square: cells of the grid are 5 : 1."""

    name = "stretched cubic"

    def grid(self, n):
        parameters, quads, steps, counted = super().grid(n)
        return parameters * [1, 0.2], quads, steps * [1, 0.2], counted


SURFACES = (Torus(), Ellipsoid(), Cubic(), Sphere(), Stretched())


class Case:
    """A surface, a kind of mesh, one of two sizes (1 is the finer) and a seed."""

    def __init__(self, surface, kind, size, seed):
        self.surface, self.kind, self.size = surface.name, kind, size
        self.mesh = Mesh(surface, kind, surface.sizes[size], seed)


def cases():
    """All of them, one at a time; a regular mesh has nothing random."""
    for kind in KINDS:
        for surface in SURFACES:
            for size in (0, 1):
                for seed in SEEDS if kind != "regular" else SEEDS[:1]:
                    yield Case(surface, kind, size, seed)


class Errors:
    """Errors of several estimators, case by case."""

    def __init__(self):
        self.found = {}

    def add(self, name, case, error):
        key = (case.kind, case.surface, case.size)
        self.found.setdefault(name, {}).setdefault(key, []).append(error)

    def finest(self, name, kind, surface):
        """The mean over seeds on the finer mesh."""
        return float(numpy.mean(self.found[name][kind, surface, 1]))

    def wins(self, name, other, kinds=KINDS, surfaces=None):
        """In how many cases the first has the smaller error, by more than rounding, and of how many."""
        pairs = [
            pair
            for key, mine in self.found[name].items()
            if key[0] in kinds and (surfaces is None or key[1] in surfaces)
            for pair in zip(mine, self.found[other][key])
        ]
        return sum(a < b and b > 1e-9 for a, b in pairs), len(pairs)
