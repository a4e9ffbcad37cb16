"""The paper's formulas evaluated by their definition in numpy, right ones and as they are printed, misprints included.

The library has only the right ones. These decide, by the cells of table 3, what was meant.
"""

import numpy
from polyhedra import unit


class Rings:
    """Closed one-rings of a triangle mesh: every corner knows its two edges, in order around the vertex."""

    def __init__(self, positions, faces):
        self.positions, self.faces = positions, faces
        after = [{} for _ in positions]
        for a, b, c in faces.tolist():
            after[a][b], after[b][c], after[c][a] = c, a, b
        self.rings = []
        for ring in after:
            walk = [min(ring)]
            while len(walk) < len(ring):
                walk.append(ring[walk[-1]])
            self.rings.append(numpy.array(walk))

    def normals(self, estimate):
        """`estimate` takes a `Ring`; its answer is not normalised here."""
        return numpy.array([estimate(Ring(self.positions, v, ring)) for v, ring in enumerate(self.rings)])


class Ring:
    """Corner i lies between edge i and edge i + 1; face i is its face."""

    def __init__(self, positions, vertex, ring):
        self.edges = positions[ring] - positions[vertex]
        after = numpy.roll(self.edges, -1, 0)
        self.lengths = numpy.linalg.norm(self.edges, axis=1)
        cross = numpy.cross(self.edges, after)
        double = numpy.linalg.norm(cross, axis=1)
        self.faces, self.areas = cross / double[:, None], double / 2
        self.angles = numpy.arctan2(double, (self.edges * after).sum(1))
        self.centroids = numpy.linalg.norm(self.edges + after, axis=1) / 3


def weighted(weight):
    return lambda ring: unit((weight(ring)[:, None] * ring.faces).sum(0))


def mean(ring):
    """N_G as it is printed: not normalised."""
    return ring.faces.mean(0)


def conformal(alphas=None, next_face=False, lengths=None):
    """N_CM, with other flattened angles or lengths than the right ones, or edge i between faces i and i + 1."""

    def estimate(ring):
        angles = 2 * numpy.pi * ring.angles / ring.angles.sum() if alphas is None else alphas(ring)
        half = numpy.tan(angles / 2)
        omega = (numpy.roll(half, 1) + half) / (ring.lengths if lengths is None else lengths(ring))
        other = numpy.roll(ring.faces, -1 if next_face else 1, 0)
        return unit((omega[:, None] * unit(ring.faces + other)).sum(0))

    return estimate


def cone_lengths(ring):
    """Of the conformal map of a cone onto the plane, which takes r to r^(2π/Σθ)."""
    return ring.lengths ** (2 * numpy.pi / ring.angles.sum())


# What is printed and what was meant, by the paper's names.
READINGS = {
    "N_G": {"printed: (1/n) Σ Nf": mean, "normalised": weighted(lambda ring: numpy.ones(len(ring.edges)))},
    "N_T": {
        "printed: Σ Nf, normalised": weighted(lambda ring: numpy.ones(len(ring.edges))),
        "Σ θ Nf, normalised": weighted(lambda ring: ring.angles),
    },
    "N_C": {
        "printed: weight |f| / |g − v|": weighted(lambda ring: ring.areas / ring.centroids),
        "weight 1 / |g − v|²": weighted(lambda ring: 1 / ring.centroids**2),
    },
    "N_CM": {
        "printed: α_i = 2π / Σ θ, all alike": conformal(lambda ring: numpy.full_like(ring.angles, 1.0)),
        "Ne_i between f_i and f_i+1, as printed": conformal(next_face=True),
        "‖P U_i‖ = ‖V V_i‖^(2π/Σθ), the conformal map of a cone": conformal(lengths=cone_lengths),
        "α_i = 2π θ_i / Σ θ, Ne_i between f_i−1 and f_i": conformal(),
    },
}


def error(rings, estimate):
    return float(numpy.abs(1 - (rings.normals(estimate) * rings.positions).sum(1)).mean())


def powered(power):
    return lambda ring: ring.areas**power


def area_power(positions, faces, target):
    """The power of the area, from 0 to 2, whose weight has the error `target` on a sphere; none if there is none."""
    rings = Rings(positions, faces)
    low, high = 0.0, 2.0
    if error(rings, weighted(powered(high))) < target:
        return None
    for _ in range(20):
        middle = (low + high) / 2
        low, high = (middle, high) if error(rings, weighted(powered(middle))) < target else (low, middle)
    return low
