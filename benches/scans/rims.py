"""Curvature along the creases of a mesh, whose vertices adaptive jets mark."""

import numpy
from umbilic import VertexStatus

SHARP = 30  # degrees between the faces of an edge
DROP = 3  # a neighbour so many times as small is a switch


class Rims:
    """Of edges with an angle: `value` is H times the mean length of a vertex's edges, convex and concave rims apart."""

    def __init__(self, mesh, found):
        self.marked = (found.status & VertexStatus.CREASE != 0) & (found.status & VertexStatus.FALLBACK != 0)
        self.value = found.mean * mesh.own_edge
        edges, angles = dihedrals(mesh)
        sharp = numpy.abs(angles) > SHARP
        edges, angles = edges[sharp], angles[sharp]
        self.on = numpy.zeros(len(mesh.positions), bool)
        self.on[edges] = True
        # Corners, and where a convex rim goes over into a concave one, are told apart from rims.
        count = numpy.bincount(edges.ravel(), minlength=len(self.on))
        signs = numpy.bincount(edges.ravel(), numpy.repeat(numpy.sign(angles), 2), len(self.on))
        self.plain = (count == 2) & (numpy.abs(signs) == 2)
        self.kinds = {"convex": edges[angles > 0], "concave": edges[angles < 0]}

    def of(self, kind):
        """Values of the rim's own vertices, and the differences of neighbours that are both such."""
        edges = self.inner(self.kinds[kind])
        return self.value[numpy.unique(edges)], numpy.abs(numpy.subtract(*self.value[edges].T))

    def inner(self, edges):
        return edges[self.plain[edges].all(1)]

    def switches(self, plain):
        """Pairs of neighbours of which one is DROP times the other or has another sign, and all pairs: of rims' own
        vertices, or of those that have a corner at an end."""
        edges = numpy.concatenate(list(self.kinds.values()))
        edges = edges[self.plain[edges].all(1) == plain]
        pairs = self.value[edges]
        small, large = numpy.sort(numpy.abs(pairs), 1).T
        return int(((small * DROP < large) | (pairs.prod(1) < 0)).sum()), len(edges)


def dihedrals(mesh):
    """Edges of two faces and the angle between these in degrees, positive where convex."""
    faces, positions = mesh.faces, mesh.positions
    a, b, c = positions[faces].swapaxes(0, 1)
    normals = numpy.cross(b - a, c - a)
    normals /= numpy.linalg.norm(normals, axis=1)[:, None]
    sides = numpy.concatenate([faces[:, [i, (i + 1) % 3]] for i in range(3)])
    order = numpy.lexsort(numpy.sort(sides, 1).T)
    one, other = order[:-1], order[1:]
    paired = (sides[one] == sides[other][:, ::-1]).all(1)
    one, other = one[paired], other[paired]
    n, m = normals[one % len(faces)], normals[other % len(faces)]
    along = positions[sides[one, 1]] - positions[sides[one, 0]]
    along /= numpy.linalg.norm(along, axis=1)[:, None]
    return sides[one], numpy.degrees(numpy.arctan2((numpy.cross(n, m) * along).sum(1), (n * m).sum(1)))
