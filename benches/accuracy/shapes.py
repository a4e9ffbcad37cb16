"""The suite's smooth surfaces: where a pair of parameters lies, and gradient and Hessian of a function that is 0 there.

`place` maps parameters to points so that du x dv points outwards; `ranges` says how far they go, `closed` in which of
them the surface closes up, `aspect` how many times more columns than rows a grid of square cells has.
"""

import numpy


class Ellipsoid:
    """A patch that leaves out the poles and a quarter of the way around."""

    ranges, closed = ((0, 4.5), (0.5, 2.4)), (False, False)

    def __init__(self, name, axes, aspect):
        self.name, self.axes, self.aspect = name, numpy.array(axes), aspect

    def place(self, u, v):
        return self.axes * numpy.stack([numpy.sin(v) * numpy.cos(u), numpy.sin(v) * numpy.sin(u), -numpy.cos(v)], 1)

    def gradient(self, points):
        return 2 * points / self.axes**2

    def hessian(self, points):
        return numpy.broadcast_to(numpy.diag(2 / self.axes**2), (len(points), 3, 3))


class Torus:
    """Radii 1 and 0.4."""

    name, aspect = "torus", 2.5
    ranges, closed = ((0, 2 * numpy.pi), (0, 2 * numpy.pi)), (True, True)

    def place(self, u, v):
        ring = 1 + 0.4 * numpy.cos(v)
        return numpy.stack([ring * numpy.cos(u), ring * numpy.sin(u), 0.4 * numpy.sin(v)], 1)

    def gradient(self, points):
        inner = 1 - 1 / numpy.hypot(points[:, 0], points[:, 1])
        return 2 * points * numpy.stack([inner, inner, numpy.ones(len(points))], 1)

    def hessian(self, points):
        x, y = points[:, 0], points[:, 1]
        axial = numpy.hypot(x, y)
        result = numpy.zeros((len(points), 3, 3))
        result[:, 0, 0] = 2 - 2 * y * y / axial**3
        result[:, 1, 1] = 2 - 2 * x * x / axial**3
        result[:, 0, 1] = result[:, 1, 0] = 2 * x * y / axial**3
        result[:, 2, 2] = 2
        return result


class Cylinder:
    """Radius 1, height 2, open at both ends."""

    name, aspect = "cylinder", 3.1
    ranges, closed = ((0, 2 * numpy.pi), (-1, 1)), (True, False)

    def place(self, u, v):
        return numpy.stack([numpy.cos(u), numpy.sin(u), v], 1)

    def gradient(self, points):
        return points * [2, 2, 0]

    def hessian(self, points):
        return numpy.broadcast_to(numpy.diag([2.0, 2.0, 0.0]), (len(points), 3, 3))


class HeightField:
    """z = height(x, y), seen from above; `slopes` are its first, `bends` its second derivatives (xx, xy, yy)."""

    closed, aspect = (False, False), 1.0

    def __init__(self, name, half, height, slopes, bends):
        self.name, self.ranges, self.height, self.slopes, self.bends = name, ((-half, half),) * 2, height, slopes, bends

    def place(self, x, y):
        return numpy.stack([x, y, self.height(x, y)], 1)

    def gradient(self, points):
        dx, dy = self.slopes(points[:, 0], points[:, 1])
        return numpy.stack([-dx, -dy, numpy.ones(len(points))], 1)

    def hessian(self, points):
        result = numpy.zeros((len(points), 3, 3))
        xx, xy, yy = self.bends(points[:, 0], points[:, 1])
        result[:, 0, 0], result[:, 1, 1] = -xx, -yy
        result[:, 0, 1] = result[:, 1, 0] = -xy
        return result


def cubic_and_sine():
    def height(x, y):
        return 0.3 * x * x - 0.2 * y * y + 0.25 * x * y + 0.15 * y**3 + 0.1 * numpy.sin(2 * x) - 0.12 * x * x * y

    def slopes(x, y):
        dx = 0.6 * x + 0.25 * y + 0.2 * numpy.cos(2 * x) - 0.24 * x * y
        return dx, -0.4 * y + 0.25 * x + 0.45 * y * y - 0.12 * x * x

    def bends(x, y):
        return 0.6 - 0.4 * numpy.sin(2 * x) - 0.24 * y, 0.25 - 0.24 * x, -0.4 + 0.9 * y

    return HeightField("height field", 1.2, height, slopes, bends)


def saddle():
    def bends(x, y):
        return numpy.ones_like(x), numpy.zeros_like(x), -numpy.ones_like(x)

    return HeightField("saddle", 1.1, lambda x, y: 0.5 * x * x - 0.5 * y * y, lambda x, y: (x, -y), bends)


def wave():
    def parts(x, y):
        s, t = 1.7 * x + 0.4, 1.4 * y
        return 0.35 * numpy.sin(s), 0.35 * numpy.cos(s), numpy.sin(t), numpy.cos(t)

    def height(x, y):
        sine, _, _, cosine = parts(x, y)
        return sine * cosine

    def slopes(x, y):
        sine_x, cosine_x, sine_y, cosine_y = parts(x, y)
        return 1.7 * cosine_x * cosine_y, -1.4 * sine_x * sine_y

    def bends(x, y):
        sine_x, cosine_x, sine_y, cosine_y = parts(x, y)
        xx, yy = -1.7 * 1.7 * sine_x * cosine_y, -1.4 * 1.4 * sine_x * cosine_y
        return xx, -1.7 * 1.4 * cosine_x * sine_y, yy

    return HeightField("wave", 2.0, height, slopes, bends)


SHAPES = (
    Ellipsoid("sphere", (1.0, 1.0, 1.0), 2.2),
    Ellipsoid("ellipsoid", (1.0, 1.5, 2.2), 2.0),
    Torus(),
    cubic_and_sine(),
    Cylinder(),
    saddle(),
    wave(),
)
