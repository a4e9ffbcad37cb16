"""A mesh whose normals and principal curvatures are known, with noise if wanted."""

import numpy

LOCATIONS = ("interior", "near", "boundary")


class Sample:
    """`scored`: the vertices that are not on a crease. `location`: the number of each vertex's location."""

    def __init__(self, positions, triangles, quads, normal, k1, k2, scored=None):
        self.positions, self.normal, self.k1, self.k2 = positions, normal, k1, k2
        self.triangles, self.quads = (
            numpy.asarray(faces, int).reshape(-1, n) for faces, n in ((triangles, 3), (quads, 4))
        )
        self.scored = numpy.ones(len(positions), bool) if scored is None else scored
        self.edge = mean_edge(positions, self.triangles, self.quads)
        self.location = locations(len(positions), self.triangles, self.quads)

    @property
    def faces(self):
        """As the library takes them: an array of triangles, or a list of polygons."""
        return self.triangles if not len(self.quads) else [*self.quads.tolist(), *self.triangles.tolist()]

    @property
    def fans(self):
        """All faces as triangles, quads cut from their first corner."""
        return numpy.concatenate([self.quads[:, [0, 1, 2]], self.quads[:, [0, 2, 3]], self.triangles])

    def noisy(self, part, random):
        """The same with positions moved along the exact normal, by `part` of the mean edge (standard deviation)."""
        moved = object.__new__(Sample)
        moved.__dict__ |= self.__dict__
        moved.positions = (
            self.positions + part * self.edge * random.normal(size=len(self.positions))[:, None] * self.normal
        )
        return moved


def half_edges(triangles, quads):
    return numpy.concatenate(
        [numpy.stack([faces, numpy.roll(faces, -1, 1)], -1).reshape(-1, 2) for faces in (triangles, quads)]
    )


def mean_edge(positions, triangles, quads):
    """Over the sides of all faces."""
    a, b = positions[half_edges(triangles, quads)].swapaxes(0, 1)
    return float(numpy.linalg.norm(a - b, axis=1).mean())


def locations(count, triangles, quads):
    """2 at the boundary, 1 at vertices that share a face with one there, 0 elsewhere."""
    edges = half_edges(triangles, quads)
    code, opposite = edges @ [count, 1], edges @ [1, count]
    result = numpy.zeros(count, int)
    at_boundary = numpy.zeros(count, bool)
    at_boundary[edges[~numpy.isin(code, opposite)]] = True
    for faces in (triangles, quads):
        result[faces[at_boundary[faces].any(1)]] = 1
    result[at_boundary] = 2
    return result
