"""A small software renderer: triangles in an orthographic view to, at every sample, a face and barycentric coordinates.

Shading comes after, over whole pictures at once: what is behind a sample is interpolated from them.
"""

import numpy
from polyhedra import unit

UP = numpy.array([0.0, 0.0, 1.0])


class View:
    """What is seen from far away in the direction `towards`, the z axis upwards if nothing else is said."""

    def __init__(self, towards, up=UP):
        self.towards = unit(numpy.asarray(towards, float))
        self.right = unit(numpy.cross(up, self.towards))
        self.up = numpy.cross(self.towards, self.right)

    def project(self, points):
        """Coordinates to the right and upwards."""
        return numpy.asarray(points) @ numpy.stack([self.right, self.up], 1)


class Picture:
    """Of the square [-extent, extent]² of a view, `size` pixels wide, with `samples` x `samples` in a pixel.

    `face` is -1 where there is nothing; `weights` belong to the face's corners.
    """

    def __init__(self, view, positions, faces, size, extent, samples=4):
        self.positions, self.faces, self.samples = positions, faces, samples
        self.pixel = 2 * extent / size  # a pixel's width, in units of the mesh
        self.across = size * samples
        step = self.pixel / samples
        # In samples, rows downwards; sample (0, 0) is at half a sample.
        self.screen = (view.project(positions) * [1, -1] + extent) / step - 0.5
        depth = positions @ view.towards
        self.face = numpy.full((self.across, self.across), -1)
        self.weights = numpy.zeros((self.across, self.across, 3))
        nearest = numpy.full((self.across, self.across), -numpy.inf)
        for index, corners in enumerate(faces):
            self.draw(index, self.screen[corners], depth[corners], nearest)

    def draw(self, index, corners, depths, nearest):
        a, b, c = corners
        double = cross(b - a, c - a)
        if double >= 0:  # rows go downwards: what is seen from behind runs this way round
            return
        low = numpy.maximum(numpy.ceil(corners.min(0)).astype(int), 0)
        high = numpy.minimum(numpy.floor(corners.max(0)).astype(int) + 1, self.across)
        if (high <= low).any():
            return
        x, y = numpy.meshgrid(numpy.arange(low[0], high[0]), numpy.arange(low[1], high[1]))
        points = numpy.stack([x, y], -1)
        weights = numpy.stack([cross(q - p, points - p) for p, q in ((b, c), (c, a), (a, b))], -1) / double
        depth = weights @ depths
        window = (slice(low[1], high[1]), slice(low[0], high[0]))
        seen = (weights >= -1e-9).all(-1) & (depth > nearest[window])
        nearest[window][seen] = depth[seen]
        self.face[window][seen] = index
        self.weights[window][seen] = weights[seen]

    def interpolate(self, values):
        """Values of vertices, `#V x n`, at every sample."""
        return (values[self.faces[self.face]] * self.weights[..., None]).sum(-2)

    def wires(self, pixels):
        """1 on the edges of faces, 0 off them: how much of a line so many pixels wide a sample is in."""
        corners = self.screen[self.faces]
        sides = numpy.linalg.norm(numpy.roll(corners, -1, 1) - numpy.roll(corners, -2, 1), axis=2)
        double = numpy.abs(cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
        away = (self.weights * (double[:, None] / sides)[self.face]).min(-1) / self.samples
        return numpy.clip(pixels / 2 - away + 0.5, 0, 1)

    def finish(self, colours, background=(1.0, 1.0, 1.0)):
        """Samples to pixels."""
        colours = numpy.where((self.face >= 0)[..., None], numpy.clip(colours, 0, 1), background)
        size = self.across // self.samples
        return colours.reshape(size, self.samples, size, self.samples, 3).mean((1, 3))


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
