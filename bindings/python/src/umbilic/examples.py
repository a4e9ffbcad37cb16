"""Meshes to try things on."""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

_GOLDEN = (1 + 5**0.5) / 2


def sphere(level: int = 3, radius: float = 1.0) -> tuple[NDArray[numpy.float64], NDArray[numpy.int64]]:
    """Positions and triangles of an icosahedron, each triangle of which is cut in four `level` times.

    >>> positions, faces = sphere(1)
    >>> positions.shape, faces.shape
    ((42, 3), (80, 3))
    """
    corners = [(-1, _GOLDEN, 0), (1, _GOLDEN, 0), (-1, -_GOLDEN, 0), (1, -_GOLDEN, 0)]
    points = numpy.array([numpy.roll(corner, turn) for turn in range(3) for corner in corners], float)
    # The twenty triples of corners that are an edge, 2, apart from each other, turned outwards.
    faces = numpy.array(
        [
            (a, b, c)
            for a in range(12)
            for b in range(a + 1, 12)
            for c in range(b + 1, 12)
            if all(abs(numpy.linalg.norm(points[i] - points[j]) - 2) < 1e-9 for i, j in ((a, b), (b, c), (c, a)))
        ]
    )
    inwards = numpy.linalg.det(points[faces]) < 0
    faces[inwards] = faces[inwards][:, ::-1]
    for _ in range(level):
        sides = numpy.sort(numpy.stack([faces, numpy.roll(faces, -1, 1)], -1).reshape(-1, 2), 1)
        edges, number = numpy.unique(sides, axis=0, return_inverse=True)
        middles = number.reshape(-1, 3) + len(points)
        points = numpy.concatenate([points, points[edges].mean(1)])
        (a, b, c), (ab, bc, ca) = faces.T, middles.T
        faces = numpy.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], 1).reshape(-1, 3)
        points /= numpy.linalg.norm(points, axis=1)[:, None]
    points /= numpy.linalg.norm(points, axis=1)[:, None]
    return radius * points, faces


def cube() -> tuple[NDArray[numpy.float64], NDArray[numpy.int64]]:
    """Positions and quads of the cube from (0, 0, 0) to (1, 1, 1).

    >>> positions, faces = cube()
    >>> positions.shape, faces.shape
    ((8, 3), (6, 4))
    """
    positions = numpy.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return positions, numpy.array(faces)
