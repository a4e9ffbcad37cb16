"""What is measured: every surface in every sampling, at two resolutions, with every noise."""

import zlib
from typing import NamedTuple

import numpy
from bodies import capped_cylinder, cube, hull, rounded_box
from samplings import SAMPLINGS, grid
from shapes import SHAPES

RESOLUTIONS = {"coarse": 12, "fine": 24}
NOISES = (0.0, 0.005, 0.02, 0.1)  # standard deviation, in mean edges
CREASE_NOISES = NOISES[:3]

TUNING = ("ellipsoid", "torus", "saddle", "wave", "closed sphere", "capped cylinder")
VERIFICATION = ("sphere", "height field", "cylinder", "closed ellipsoid", "cube", "rounded box")
HALVES = {"tuning": TUNING, "verification": VERIFICATION}

CLOSED = {"closed sphere": numpy.ones(3), "closed ellipsoid": numpy.array([1.0, 1.5, 2.2])}
# Of the number of rows of a grid.
CREASED = {
    "capped cylinder": lambda rows, random: capped_cylinder(2 * (rows + 1), random),
    "cube": lambda rows, random: cube(rows - 3, random),
    "rounded box": lambda rows, random: rounded_box(rows + 1, random),
}


class Case(NamedTuple):
    """A mesh, which is measured with each of its noises."""

    surface: str
    sampling: str
    resolution: str
    seed: int

    @property
    def noises(self):
        return CREASE_NOISES if self.sampling == "creased" else NOISES

    def sample(self):
        random, rows = self.random(), RESOLUTIONS[self.resolution]
        if self.surface in CLOSED:
            return hull(CLOSED[self.surface], 2 * rows * rows, random)
        if self.surface in CREASED:
            return CREASED[self.surface](rows, random)
        shape = next(shape for shape in SHAPES if shape.name == self.surface)
        return grid(shape, self.sampling, rows, random)

    def samples(self):
        """Noise and mesh; every noise moves the vertices the same way, further and further."""
        clean = self.sample()
        for noise in self.noises:
            yield noise, clean.noisy(noise, self.random("noise")) if noise else clean

    def random(self, *purpose):
        return numpy.random.RandomState(zlib.crc32(repr((*self, *purpose)).encode()))


class Row(NamedTuple):
    """What errors are averaged over: some vertices of one mesh."""

    surface: str
    sampling: str
    resolution: str
    seed: int
    noise: float
    location: str


def cases(surfaces, seeds):
    samplings = {shape.name: SAMPLINGS for shape in SHAPES}
    samplings |= dict.fromkeys(CLOSED, ("irregular",)) | dict.fromkeys(CREASED, ("creased",))
    return [
        Case(surface, sampling, resolution, seed)
        for seed in seeds
        for resolution in RESOLUTIONS
        for surface in surfaces
        for sampling in samplings[surface]
    ]
