#!/usr/bin/env python3
"""Checks the suite: exact normals and curvatures against differences of sixth order, faces' orientation, creases.

python3 benches/accuracy/check.py
"""

import numpy
from scores import degrees_between
from shapes import SHAPES
from suite import HALVES, cases
from surfaces import Exact

STEP = 2e-3
FIRST = numpy.array([-1, 9, -45, 0, 45, -9, 1]) / 60
SECOND = numpy.array([2, -27, 270, -490, 270, -27, 2]) / 180
OFFSETS = numpy.arange(-3, 4) * STEP


def by_differences(place, u, v):
    """Normals, k1 and k2 of a parametric surface."""
    du = sum(c * place(u + h, v) for c, h in zip(FIRST, OFFSETS)) / STEP
    dv = sum(c * place(u, v + h) for c, h in zip(FIRST, OFFSETS)) / STEP
    duu = sum(c * place(u + h, v) for c, h in zip(SECOND, OFFSETS)) / STEP**2
    dvv = sum(c * place(u, v + h) for c, h in zip(SECOND, OFFSETS)) / STEP**2
    duv = sum(c * d * place(u + h, v + g) for c, h in zip(FIRST, OFFSETS) for d, g in zip(FIRST, OFFSETS)) / STEP**2
    normal = numpy.cross(du, dv)
    normal /= numpy.linalg.norm(normal, axis=1)[:, None]
    e, f, g = ((a * b).sum(1) for a, b in ((du, du), (du, dv), (dv, dv)))
    x, y, z = (-(a * normal).sum(1) for a in (duu, duv, dvv))
    gaussian, mean = (x * z - y * y) / (e * g - f * f), (e * z - 2 * f * y + g * x) / (2 * (e * g - f * f))
    root = numpy.sqrt(numpy.maximum(mean**2 - gaussian, 0))
    return normal, mean + root, mean - root


def check_shapes():
    random = numpy.random.RandomState(1)
    for shape in SHAPES:
        u, v = (random.uniform(*ends, 500) for ends in shape.ranges)
        exact = Exact(shape, shape.place(u, v))
        normal, k1, k2 = by_differences(shape.place, u, v)
        assert abs(normal - exact.normal).max() < 1e-9, shape.name
        # Where k1 = k2, as all over a sphere, a square root takes half the digits.
        assert abs(k1 + k2 - exact.k1 - exact.k2).max() < 1e-7, shape.name
        assert abs(k1 * k2 - exact.k1 * exact.k2).max() < 1e-7, shape.name
        assert max(abs(k1 - exact.k1).max(), abs(k2 - exact.k2).max()) < 2e-4, shape.name


def check_samples():
    for case in cases([name for half in HALVES.values() for name in half], [1]):
        sample = case.sample()
        a, b, c = sample.positions[sample.fans].swapaxes(0, 1)
        faces = numpy.repeat(numpy.cross(b - a, c - a)[:, None], 3, 1).reshape(-1, 3)
        corners = sample.fans.ravel()
        scored = sample.scored[corners]
        between = degrees_between(faces[scored], sample.normal[corners][scored])
        assert between.max() < 90 or case.sampling in ("stretched", "irregular"), (case, between.max())
        assert (between > 90).mean() < 0.01, (case, (between > 90).mean())
        assert abs(numpy.linalg.norm(sample.normal[sample.scored], axis=1) - 1).max() < 1e-12, case
        assert (sample.k1 >= sample.k2).all(), case
        assert set(corners) == set(range(len(sample.positions))), case
        open_ends = not (case.surface == "torus" or case.surface.startswith("closed") or case.sampling == "creased")
        assert (sample.location == 2).any() == open_ends, case


def main():
    check_shapes()
    check_samples()
    print("the suite's exact values, faces and boundaries are as they should be")


if __name__ == "__main__":
    main()
