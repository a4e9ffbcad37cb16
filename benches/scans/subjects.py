"""The meshes, from where they are looked at, and their noisy copies."""

import numpy
from peers import read
from render import View

NOISE = 0.02  # standard deviation of each coordinate, in mean edges
SEEDS = (1, 2, 3)
Y, Z = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


class Closeup:
    """Of what is around a point, in parts of the mesh's extent, across so much of it."""

    def __init__(self, middle, across):
        self.middle, self.across = numpy.array(middle), across


SHOWN = {
    "bunny": ("bunny00.off", View((0.1, 0.12, 1), Y), Closeup((0.52, 0.36), 0.5)),
    "armadillo": ("armadillo.off", View((0.35, 0.1, -1), Y), Closeup((0.5, 0.5), 0.42)),
    "fandisk": ("fandisk.off", View((1, -0.6, 0.5), Z), Closeup((0.42, 0.62), 0.45)),
}


class Subject:
    def __init__(self, positions, faces):
        self.positions, self.faces = positions, faces
        edges = numpy.sort(numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), 1)
        self.edges = numpy.unique(edges, axis=0)
        lengths = numpy.linalg.norm(positions[self.edges[:, 0]] - positions[self.edges[:, 1]], axis=1)
        ends, both = self.edges.ravel(), numpy.repeat(lengths, 2)
        count = numpy.bincount(ends, minlength=len(positions))
        # The mean length of the edges of all, and of each vertex.
        self.edge, self.own_edge = lengths.mean(), numpy.bincount(ends, both, len(positions)) / count

    def noisy(self, seed):
        shift = numpy.random.default_rng(seed).normal(0, NOISE * self.edge, self.positions.shape)
        return Subject(self.positions + shift, self.faces)


class Mesh(Subject):
    def __init__(self, name, folder):
        file, self.view, self.closeup = SHOWN[name]
        positions, faces = read(folder / file)
        super().__init__(positions - (positions.min(0) + positions.max(0)) / 2, faces)
        self.name, self.file = name, file
