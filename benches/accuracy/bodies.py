"""The suite's closed bodies: random points on spheres and ellipsoids, and bodies with creases."""

import numpy
from sample import Sample
from samplings import halves
from scipy.spatial import ConvexHull
from shapes import Ellipsoid
from surfaces import Exact, quads_of


def unit(vectors):
    return vectors / numpy.linalg.norm(vectors, axis=-1, keepdims=True)


def hull(axes, count, random):
    """`count` random points on an ellipsoid, spread a little, with the triangles of their convex hull on the sphere."""
    points = unit(random.normal(size=(count, 3)))
    for _ in range(6):
        faces = ConvexHull(points).simplices
        sums = numpy.zeros_like(points)
        numpy.add.at(sums, faces, numpy.broadcast_to(points[faces].mean(1)[:, None], (len(faces), 3, 3)))
        points = unit(sums)
    faces = ConvexHull(points).simplices
    a, b, c = points[faces].swapaxes(0, 1)
    inwards = (numpy.cross(b - a, c - a) * a).sum(1) < 0
    faces[inwards] = faces[inwards][:, ::-1]
    # Qhull's order of faces is its own affair.
    faces = faces[numpy.lexsort(faces.T)]
    points = points * axes
    exact = Exact(Ellipsoid("", axes, 1), points)
    return Sample(points, faces, [], exact.normal, exact.k1, exact.k2)


def cube_grid(count, random):
    """Points and triangles of the cube [-1, 1]^3, with `count` x `count` vertices on each side and random diagonals."""
    line = numpy.linspace(-1, 1, count)
    s, t = (index.ravel() for index in numpy.meshgrid(line, line, indexing="ij"))
    vertex = numpy.arange(len(s)).reshape(count, count)
    sides, quads = [], []
    for axis in range(3):
        for sign in (-1, 1):
            side = numpy.empty((len(s), 3))
            side[:, axis], side[:, (axis + 1) % 3], side[:, (axis + 2) % 3] = sign, s, t
            quads.append(quads_of(vertex if sign > 0 else vertex.T) + len(s) * len(sides))
            sides.append(side)
    sides = numpy.concatenate(sides)
    # Vertices on the edges of the cube stand in several sides.
    _, first, same = numpy.unique(numpy.round(sides, 9), axis=0, return_index=True, return_inverse=True)
    return sides[first], halves(same.ravel()[numpy.concatenate(quads)], random)


def rounded_box(count, random, core=0.6, radius=0.4):
    """A cube whose edges and corners are cylinders and spheres: smooth normals, curvature jumps; all scored."""
    points, triangles = cube_grid(count, random)
    points *= core + radius
    inner = numpy.clip(points, -core, core)
    round_axes = (abs(points - inner) > 1e-12).sum(1)
    normal = unit(points - inner)
    k1, k2 = (numpy.where(round_axes >= axes, 1 / radius, 0.0) for axes in (2, 3))
    return Sample(inner + radius * normal, triangles, [], normal, k1, k2)


def cube(count, random):
    """Sharp edges, vertices of the faces jittered within their plane."""
    points, triangles = cube_grid(count, random)
    on_side = abs(abs(points) - 1) < 1e-9
    moves = random.uniform(-0.25, 0.25, points.shape) * 2 / (count - 1)
    normal = unit(numpy.where(on_side, numpy.sign(points), 0))
    flat = numpy.zeros(len(points))
    points = numpy.where(on_side, points, points + moves)
    return Sample(points, triangles, [], normal, flat, flat, on_side.sum(1) == 1)


def capped_cylinder(columns, random):
    """Radius 1, height 2, sharp rims; the caps are rings around their centres."""
    step = 2 * numpy.pi / columns
    rows, rings = round(2 / step) + 1, round(1 / step)
    j, i = (index.ravel() for index in numpy.meshgrid(numpy.arange(rows), numpy.arange(columns), indexing="ij"))
    inside = (j > 0) & (j < rows - 1)
    angle = (i + inside * random.uniform(-0.25, 0.25, len(i))) * step
    z = -1 + (j + inside * random.uniform(-0.25, 0.25, len(i))) * 2 / (rows - 1)
    normal = numpy.stack([numpy.cos(angle), numpy.sin(angle), 0 * z], 1)
    points, normals, k1, scored = [normal + z[:, None] * [0, 0, 1]], [normal], [numpy.ones(len(z))], [inside]
    vertex = numpy.arange(rows * columns).reshape(rows, columns)
    quads = [quads_of(numpy.pad(vertex, ((0, 0), (0, 1)), mode="wrap").T)]
    triangles, count = [], len(z)
    around = numpy.arange(columns) * step
    for side, rim in ((-1, vertex[0]), (1, vertex[-1])):
        radius = numpy.arange(rings - 1, 0, -1) / rings
        cap = numpy.zeros(((rings - 1) * columns + 1, 3))
        cap[:-1, 0] = numpy.outer(radius, numpy.cos(around)).ravel()
        cap[:-1, 1] = numpy.outer(radius, numpy.sin(around)).ravel()
        cap[:, 2] = side
        loops = numpy.concatenate([rim, count + numpy.arange(len(cap) - 1)]).reshape(rings, columns)
        loops = numpy.pad(loops, ((0, 0), (0, 1)), mode="wrap")
        centre = numpy.full(columns, count + len(cap) - 1)
        fan = numpy.stack([loops[-1, :-1], loops[-1, 1:], centre], 1)
        triangles.append(fan if side > 0 else fan[:, ::-1])
        quads.append(quads_of(loops.T if side > 0 else loops))
        points.append(cap)
        normals.append(numpy.broadcast_to([0, 0, side], cap.shape))
        k1.append(numpy.zeros(len(cap)))
        scored.append(numpy.ones(len(cap), bool))
        count += len(cap)
    points, normals, k1, scored = map(numpy.concatenate, (points, normals, k1, scored))
    triangles.append(halves(numpy.concatenate(quads), random))
    return Sample(points, numpy.concatenate(triangles), [], normals.astype(float), k1, 0 * k1, scored)
