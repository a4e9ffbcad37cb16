"""The experiment of Max 1999: normals at the centres of random one-rings on random cubic height fields, by valence."""

import numpy
from contestants import AVERAGES, WEIGHTS, umbilic
from scores import degrees_between, rms

COUNT = 40_000
VALENCES = range(3, 10)
SIZE = 0.1  # of the coefficients
WIDEST, NARROWEST = 0.98 * numpy.pi, 0.05  # gaps between the directions of neighbours


def random_angles(valence, random):
    """Sorted, and drawn anew until no gap is too wide or too narrow."""
    found = numpy.empty((0, valence))
    while len(found) < COUNT:
        angles = numpy.sort(random.uniform(0, 2 * numpy.pi, (COUNT, valence)), 1)
        gaps = numpy.diff(angles, axis=1, append=angles[:, :1] + 2 * numpy.pi)
        found = numpy.concatenate([found, angles[(gaps.max(1) < WIDEST) & (gaps.min(1) > NARROWEST)]])
    return found[:COUNT]


def even_angles(valence, random):
    """Evenly spaced, but for up to three tenths of a step."""
    return 2 * numpy.pi / valence * (numpy.arange(valence) + random.uniform(-0.3, 0.3, (COUNT, valence)))


ANGLES = {"random": random_angles, "even": even_angles}


def rings(valence, angles, random):
    """Positions and triangles: the centres first, then the neighbours of each, on surfaces level at the centre."""
    angle, radius = ANGLES[angles](valence, random), random.uniform(0.05, 1, (COUNT, valence))
    x, y = radius * numpy.cos(angle), radius * numpy.sin(angle)
    powers = numpy.stack([x * x, x * y, y * y, x**3, x * x * y, x * y * y, y**3])
    heights = (SIZE * random.uniform(-1, 1, (len(powers), COUNT, 1)) * powers).sum(0)
    positions = numpy.zeros((COUNT * (valence + 1), 3))
    positions[COUNT:] = numpy.stack([x, y, heights], -1).reshape(-1, 3)
    neighbour = COUNT + numpy.arange(COUNT * valence).reshape(COUNT, valence)
    centre = numpy.broadcast_to(numpy.arange(COUNT)[:, None], neighbour.shape)
    return positions, numpy.stack([centre, neighbour, numpy.roll(neighbour, -1, 1)], -1).reshape(-1, 3)


def error(normals):
    """RMS degrees from upright."""
    return rms(degrees_between(normals[:COUNT], numpy.array([[0.0, 0.0, 1.0]])))


def experiment():
    """Errors by angles, estimator and valence."""
    found = {}
    weights = AVERAGES | {name: name for name in ("tilted-sections",) if name in WEIGHTS}
    for angles in ANGLES:
        random, rows = numpy.random.RandomState(5), found.setdefault(angles, {})
        for valence in VALENCES:
            positions, triangles = rings(valence, angles, random)
            with umbilic.Topology(triangles, len(positions)) as mesh:
                for name, weight in weights.items():
                    normals, _ = umbilic.vertex_normals(positions, mesh, weight=weight, threads=1)
                    rows.setdefault(name, []).append(error(normals))
    return found
