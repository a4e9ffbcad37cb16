"""Meshes over the grid of a surface: regular, irregular, and mostly quads.

Jitter is uniform, up to so many spacings of the grid in each parameter; beyond 0.25, triangles may fold. Random
numbers come from numpy's RandomState, whose sequences never change, so a mesh is the same on every machine.
"""

import numpy
from surfaces import Exact

# Jitter, the part of quads that is kept, and whether diagonals are random.
KINDS = {"regular": (0.0, 0.0, False), "irregular": (0.25, 0.0, True), "quads": (0.2, 0.85, True)}


class Mesh:
    """Positions, faces (an array of triangles, or a list of polygons), vertices that count, and what is exact there."""

    def __init__(self, surface, kind, n, seed=1):
        jitter, kept, shuffled = KINDS[kind]
        random = numpy.random.RandomState(seed)
        parameters, quads, steps, self.counted = surface.grid(n)
        noise = random.uniform(-1, 1, parameters.shape)
        self.positions = surface.place(parameters + jitter * steps * noise)
        self.exact = Exact(surface, self.positions)
        # The other diagonal where a coin says so.
        turned = random.randint(0, 2, len(quads)).astype(bool) & shuffled
        quads = numpy.where(turned[:, None], numpy.roll(quads, -1, 1), quads)
        whole = random.uniform(size=len(quads)) < kept
        triangles = quads[~whole][:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)
        self.faces = triangles if not whole.any() else [*quads[whole].tolist(), *triangles.tolist()]
