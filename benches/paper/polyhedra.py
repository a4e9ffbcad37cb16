"""Polygons and meshes that the paper names: those of its tables, its cube, and rings of one vertex."""

import numpy


def unit(vectors):
    return vectors / numpy.linalg.norm(vectors, axis=-1, keepdims=True)


def regular_polygon(count, radius=1.0, first=numpy.pi / 2):
    """Counter-clockwise, its first vertex at the angle `first`: the top, if nothing is said."""
    angles = first + 2 * numpy.pi * numpy.arange(count) / count
    return radius * numpy.stack([numpy.cos(angles), numpy.sin(angles)], 1)


def ring_sphere(segments, rings):
    """By longitude and latitude: two poles, `rings` rings of `segments` vertices at even latitudes, every quad cut from
    (ring i, segment j) to (ring i + 1, segment j + 1)."""
    polar = numpy.pi * numpy.arange(1, rings + 1)[:, None] / (rings + 1)
    around = 2 * numpy.pi * numpy.arange(segments) / segments
    grid = numpy.stack(
        numpy.broadcast_arrays(
            numpy.sin(polar) * numpy.cos(around), numpy.sin(polar) * numpy.sin(around), numpy.cos(polar)
        ),
        -1,
    )
    positions = numpy.concatenate([[[0, 0, 1]], grid.reshape(-1, 3), [[0, 0, -1]]])
    vertex = 1 + numpy.arange(rings * segments).reshape(rings, segments)
    after = numpy.roll(vertex, -1, 1)
    a, b, c, d = vertex[:-1].ravel(), vertex[1:].ravel(), after[1:].ravel(), after[:-1].ravel()
    top, bottom = numpy.zeros(segments, int), numpy.full(segments, len(positions) - 1)
    faces = ([top, vertex[0], after[0]], [a, b, c], [a, c, d], [bottom, after[-1], vertex[-1]])
    return positions, numpy.concatenate([numpy.stack(face, 1) for face in faces])


TETRAHEDRON = unit(numpy.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], float))
TETRAHEDRON_FACES = numpy.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])


def tetrahedron_sphere(levels):
    """A tetrahedron, each triangle cut in four and the midpoints of edges pushed to the unit sphere, `levels` times."""
    positions, faces = TETRAHEDRON, TETRAHEDRON_FACES
    for _ in range(levels):
        edges, faces = subdivided(faces, len(positions))
        positions = numpy.concatenate([positions, unit(positions[edges].mean(1))])
    return positions, faces


def subdivided(faces, count):
    """The edges, each of which gets a vertex, numbered from `count` on, and the four triangles of each triangle."""
    corners = numpy.stack([faces, numpy.roll(faces, -1, 1)], 2)  # (a, b), (b, c), (c, a) of each face
    edges, middle = numpy.unique(numpy.sort(corners.reshape(-1, 2), 1), axis=0, return_inverse=True)
    ab, bc, ca = count + middle.reshape(-1, 3).T
    a, b, c = faces.T
    parts = ([a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca])
    return edges, numpy.concatenate([numpy.stack(part, 1) for part in parts])


# Where the four triangles at a corner of the cube's top end: at the middles of the far edges and at the far corner; at
# the far edges under even angles; or under even angles as far away as the corner's other neighbours are.
CUTS = ("midpoints", "even angles", "even angles and lengths")


def cube(cut):
    """The cube [-1, 1]³ whose corner 0, at (1, 1, 1), is in four triangles of the top and in one of each other side."""
    corners = [[1, 1, 1], [-1, 1, 1], [1, -1, 1], [1, 1, -1], [-1, 1, -1], [1, -1, -1], [-1, -1, -1], [-1, -1, 1]]
    if cut == "even angles and lengths":
        angles = numpy.pi * numpy.array([1, 2, 3]) / 8
        inner = [[1 - 2 * numpy.cos(angle), 1 - 2 * numpy.sin(angle), 1] for angle in angles]
        top = [[0, 1, 8], [0, 8, 9], [0, 9, 10], [0, 10, 2], [1, 7, 8], [8, 7, 9], [9, 7, 10], [10, 7, 2]]
        back = [[1, 4, 7], [4, 6, 7], [2, 7, 5], [5, 7, 6]]
    else:
        along = 1 - 2 * (0.5 if cut == "midpoints" else numpy.tan(numpy.pi / 8))
        inner = [[-1, along, 1], [along, -1, 1]]
        top = [[0, 1, 8], [0, 8, 7], [0, 7, 9], [0, 9, 2]]
        back = [[1, 4, 8], [8, 4, 6], [8, 6, 7], [2, 9, 5], [9, 6, 5], [9, 7, 6]]
    sides = [[0, 3, 1], [3, 4, 1], [0, 2, 3], [2, 5, 3], [3, 5, 6], [3, 6, 4]]
    return numpy.array(corners + inner, float), numpy.array(top + sides + back)


def fans(neighbours):
    """Closed fans of triangles, apart from each other, around vertices at the origin: `neighbours` is `#fans x m x 3`.
    The centres are the first vertices."""
    count, valence, _ = neighbours.shape
    positions = numpy.concatenate([numpy.zeros((count, 3)), neighbours.reshape(-1, 3)])
    rim = count + numpy.arange(count * valence).reshape(count, valence)
    centre = numpy.repeat(numpy.arange(count)[:, None], valence, 1)
    return positions, numpy.stack([centre, rim, numpy.roll(rim, -1, 1)], -1).reshape(-1, 3)
