"""Grids over smooth surfaces: regular, irregular, stretched, mostly quads.

Numbers come from numpy's RandomState, whose sequences never change, so a mesh is the same on every machine.
"""

import numpy
from sample import Sample
from surfaces import Exact, quads_of

# How far a vertex is moved at most, in spacings of the grid; how much longer than high a cell is; how many of the quads
# are kept; whether diagonals are random.
SAMPLINGS = {
    "regular": (0.0, 1.0, 0.0, False),
    "irregular": (0.3, 1.0, 0.0, True),
    "stretched": (0.3, 5.0, 0.0, True),
    "quads": (0.2, 1.0, 0.85, False),
}


def grid(shape, sampling, rows, random):
    """A mesh of about `rows` rows, were its cells square."""
    jitter, stretch, kept, shuffled = SAMPLINGS[sampling]
    counts = [max(round(rows * part), 6) for part in (shape.aspect / stretch**0.5, stretch**0.5)]
    indices = numpy.meshgrid(*map(numpy.arange, counts), indexing="ij")
    parameters = []
    for index, count, (low, high), closed in zip(indices, counts, shape.ranges, shape.closed):
        moves = jitter * random.uniform(-1, 1, index.shape)
        if not closed:
            moves[(index == 0) | (index == count - 1)] = 0
        parameters.append((low + (high - low) * (index + moves) / (count - (not closed))).ravel())
    points = shape.place(*parameters)
    vertex = numpy.arange(len(points)).reshape(counts)
    quads = quads_of(numpy.pad(vertex, [(0, int(closed)) for closed in shape.closed], mode="wrap"))
    whole = random.uniform(size=len(quads)) < kept
    exact = Exact(shape, points)
    triangles = halves(quads[~whole], random if shuffled else None)
    return Sample(points, triangles, quads[whole], exact.normal, exact.k1, exact.k2)


def halves(quads, random=None):
    """Two triangles of each quad, cut along the diagonal from its first corner, or where a coin says so the other."""
    if random is not None:
        turned = random.randint(0, 2, len(quads)).astype(bool)
        quads = numpy.where(turned[:, None], numpy.roll(quads, -1, 1), quads)
    return quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
