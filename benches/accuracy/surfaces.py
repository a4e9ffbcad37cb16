"""Smooth surfaces f = 0 whose normals and curvatures are known exactly, each with a grid of quads over it.

A surface has a gradient and a Hessian of f at points of it, and `grid(n)`: parameters, quads, the spacing of
parameters, and which vertices count (all of a closed surface). `place` takes parameters to points of the surface, also
those of a jittered grid.
"""

import numpy


class Torus:
    """Radii 1 and 0.4, over a periodic grid of 5n x 2n."""

    name = "torus"
    sizes = (10, 20, 40, 80)
    R, r = 1.0, 0.4

    def grid(self, n):
        columns, rows = 5 * n, 2 * n
        i, j = (index.ravel() for index in numpy.meshgrid(numpy.arange(columns), numpy.arange(rows), indexing="ij"))
        vertex = numpy.arange(columns * rows).reshape(columns, rows)
        quads = quads_of(numpy.pad(vertex, ((0, 1), (0, 1)), mode="wrap"))
        steps = numpy.array([2 * numpy.pi / columns, 2 * numpy.pi / rows])
        return numpy.stack([i, j], 1) * steps, quads, steps, numpy.ones(len(i), bool)

    def place(self, parameters):
        u, v = parameters.T
        ring = self.R + self.r * numpy.cos(v)
        return numpy.stack([ring * numpy.cos(u), ring * numpy.sin(u), self.r * numpy.sin(v)], 1)

    def gradient(self, points):
        axial = numpy.hypot(points[:, 0], points[:, 1])
        return 2 * points * numpy.stack([1 - self.R / axial, 1 - self.R / axial, numpy.ones(len(points))], 1)

    def hessian(self, points):
        x, y = points[:, 0], points[:, 1]
        axial = numpy.hypot(x, y)
        result = numpy.zeros((len(points), 3, 3))
        result[:, 0, 0] = 2 - 2 * self.R * y * y / axial**3
        result[:, 1, 1] = 2 - 2 * self.R * x * x / axial**3
        result[:, 0, 1] = result[:, 1, 0] = 2 * self.R * x * y / axial**3
        result[:, 2, 2] = 2
        return result


class Ellipsoid:
    """Half axes 1, 1.5 and 2.2, over the six sides of a cube of n x n quads each."""

    name = "ellipsoid"
    sizes = (13, 26, 52, 104)
    axes = numpy.array([1.0, 1.5, 2.2])

    def grid(self, n):
        line = numpy.tan(numpy.linspace(-1, 1, n + 1) * numpy.pi / 4)  # equal angles from the centre
        sides, quads = [], []
        for axis in range(3):
            for sign in (-1, 1):
                s, t = (index.ravel() for index in numpy.meshgrid(line, line, indexing="ij"))
                side = numpy.empty((len(s), 3))
                side[:, axis], side[:, (axis + 1) % 3], side[:, (axis + 2) % 3] = sign, s, t
                vertex = numpy.arange(len(s)).reshape(n + 1, n + 1) + len(s) * len(sides)
                quads.append(quads_of(vertex if sign > 0 else vertex.T))
                sides.append(side)
        sides = numpy.concatenate(sides)
        # Vertices on the edges of the cube stand in several sides.
        _, first, same = numpy.unique(numpy.round(sides, 9), axis=0, return_index=True, return_inverse=True)
        cube = sides[first]
        directions = cube / numpy.linalg.norm(cube, axis=1)[:, None]
        # Near the corners of the cube quads are narrow rhombs, which no jitter is to fold.
        steps = numpy.full(3, 0.6 * numpy.pi / 2 / n)
        return directions, same.ravel()[numpy.concatenate(quads)], steps, numpy.ones(len(directions), bool)

    def place(self, parameters):
        return self.axes * parameters / numpy.linalg.norm(parameters, axis=1)[:, None]

    def gradient(self, points):
        return 2 * points / self.axes**2

    def hessian(self, points):
        return numpy.broadcast_to(numpy.diag(2 / self.axes**2), (len(points), 3, 3))


class Cubic:
    """The height field of a cubic over [-1, 1] x [-1, 1], of which the inner [-0.75, 0.75] x [-0.75, 0.75] counts."""

    name = "cubic"
    sizes = (32, 64, 128, 256)

    def grid(self, n):
        i, j = (index.ravel() for index in numpy.meshgrid(numpy.arange(n + 1), numpy.arange(n + 1), indexing="ij"))
        vertex = numpy.arange((n + 1) ** 2).reshape(n + 1, n + 1)
        inner = (numpy.minimum(i, j) >= n // 8) & (numpy.maximum(i, j) <= n - n // 8)
        return numpy.stack([i, j], 1) * 2 / n - 1, quads_of(vertex), numpy.full(2, 2 / n), inner

    def place(self, parameters):
        # What is jittered off the domain stays on its border.
        x, y = numpy.clip(parameters, -1, 1).T
        z = 0.3 * x**2 - 0.2 * y**2 + 0.25 * x * y + 0.1 * x**3 - 0.12 * x**2 * y + 0.15 * y**3
        return numpy.stack([x, y, z], 1)

    def gradient(self, points):
        x, y = points[:, 0], points[:, 1]
        dx = 0.6 * x + 0.25 * y + 0.3 * x**2 - 0.24 * x * y
        dy = -0.4 * y + 0.25 * x - 0.12 * x**2 + 0.45 * y**2
        return numpy.stack([-dx, -dy, numpy.ones(len(points))], 1)

    def hessian(self, points):
        x, y = points[:, 0], points[:, 1]
        result = numpy.zeros((len(points), 3, 3))
        result[:, 0, 0] = -(0.6 + 0.6 * x - 0.24 * y)
        result[:, 0, 1] = result[:, 1, 0] = -(0.25 - 0.24 * x)
        result[:, 1, 1] = -(-0.4 + 0.9 * y)
        return result


SURFACES = (Torus(), Ellipsoid(), Cubic())


def quads_of(vertex):
    return numpy.stack([vertex[:-1, :-1], vertex[1:, :-1], vertex[1:, 1:], vertex[:-1, 1:]], -1).reshape(-1, 4)


class Exact:
    """Normals, principal curvatures k1 >= k2 and the direction of k1; positive where the surface bends away."""

    def __init__(self, surface, points):
        gradient = surface.gradient(points)
        size = numpy.linalg.norm(gradient, axis=1)
        self.normal = gradient / size[:, None]
        # Of the coordinate axes the one that is most tangent, made tangent.
        axis = numpy.eye(3)[numpy.abs(self.normal).argmin(1)]
        s = axis - (axis * self.normal).sum(1)[:, None] * self.normal
        s /= numpy.linalg.norm(s, axis=1)[:, None]
        t = numpy.cross(self.normal, s)
        hessian = surface.hessian(points) / size[:, None, None]
        a, b, d = (numpy.einsum("vi,vij,vj->v", p, hessian, q) for p, q in ((s, s), (s, t), (t, t)))
        self.mean, spread = (a + d) / 2, numpy.hypot((a - d) / 2, b)
        self.k1, self.k2 = self.mean + spread, self.mean - spread
        self.gaussian = self.k1 * self.k2
        angle = numpy.arctan2(2 * b, a - d) / 2
        self.direction = numpy.cos(angle)[:, None] * s + numpy.sin(angle)[:, None] * t
