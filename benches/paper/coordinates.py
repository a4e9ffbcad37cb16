"""Generalised barycentric coordinates of points in the plane: mean value, Wachspress and discrete harmonic."""

import numpy


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


class Corners:
    """A point, or many, and the polygon's vertices as seen from there: the last axis runs over the vertices."""

    def __init__(self, polygon, points):
        self.spokes = polygon - numpy.asarray(points)[..., None, :]
        self.lengths = numpy.linalg.norm(self.spokes, axis=-1)
        after = numpy.roll(self.spokes, -1, -2)
        self.crosses = cross(self.spokes, after)  # twice the area of the triangle of the point and an edge
        self.dots = (self.spokes * after).sum(-1)


def before(values):
    return numpy.roll(values, 1, -1)


def mean_value(polygon, points):
    """Floater's. The tangents are of half the signed angles, so the point may be anywhere but on the polygon."""
    corners = Corners(polygon, points)
    half = corners.crosses / (corners.lengths * numpy.roll(corners.lengths, -1, -1) + corners.dots)
    return normalised((before(half) + half) / corners.lengths)[0]


def wachspress_weights(polygon, points):
    """The classical barycentric coordinates of a polygon: quotients of polynomials. Not normalised."""
    corners = Corners(polygon, points)
    sides = numpy.roll(polygon, -1, 0) - polygon
    return cross(numpy.roll(sides, 1, 0), sides) / (before(corners.crosses) * corners.crosses)


def harmonic_weights(polygon, points):
    """Of finite elements, by the cotangents opposite the spokes. Not normalised."""
    corners = Corners(polygon, points)
    squares = corners.lengths**2
    at_this = (squares - corners.dots) / corners.crosses  # cotangent at vertex i in the triangle of edge i
    at_next = (numpy.roll(squares, -1, -1) - corners.dots) / corners.crosses
    return at_next + before(at_this)


def normalised(weights):
    """Coordinates, and the denominator that they were divided by."""
    total = weights.sum(-1, keepdims=True)
    return weights / total, total[..., 0]
