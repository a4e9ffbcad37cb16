"""Meshes that tests share."""

from pathlib import Path

import numpy
import pytest

import umbilic

REPOSITORY = Path(__file__).resolve().parents[3]


class Torus:
    """A torus about the z axis of quads, and what is known of it."""

    def __init__(self, major: float = 2.0, minor: float = 0.7, rows: int = 48, columns: int = 96) -> None:
        u, v = numpy.meshgrid(
            2 * numpy.pi * numpy.arange(columns) / columns, 2 * numpy.pi * numpy.arange(rows) / rows, indexing="ij"
        )
        u, v = u.ravel(), v.ravel()
        outwards = numpy.stack([numpy.cos(u), numpy.sin(u), 0 * u], 1)
        self.normal = numpy.cos(v)[:, None] * outwards + numpy.sin(v)[:, None] * [0, 0, 1]
        self.positions = major * outwards + minor * self.normal
        self.k1 = numpy.full(len(u), 1 / minor)
        self.k2 = numpy.cos(v) / (major + minor * numpy.cos(v))
        self.around = numpy.stack([-numpy.sin(u), numpy.cos(u), 0 * u], 1)  # the direction of k2
        i, j = numpy.meshgrid(numpy.arange(columns), numpy.arange(rows), indexing="ij")
        i, j, right, up = i.ravel(), j.ravel(), (i.ravel() + 1) % columns, (j.ravel() + 1) % rows
        self.quads = numpy.stack([i * rows + j, right * rows + j, right * rows + up, i * rows + up], 1)
        self.triangles = numpy.concatenate([self.quads[:, :3], self.quads[:, [0, 2, 3]]])


@pytest.fixture(scope="session")
def torus() -> Torus:
    return Torus()


@pytest.fixture
def ball():
    """Positions and triangles of a unit sphere, 642 vertices."""
    return umbilic.examples.sphere(3)


@pytest.fixture
def lump():
    """An irregular closed mesh: positions and triangles."""
    positions, faces = umbilic.examples.sphere(4)
    random = numpy.random.RandomState(1)
    positions = positions * [1.0, 0.8, 1.3] + 0.01 * random.standard_normal(positions.shape)
    return positions, faces
