"""What the estimators found on a mesh, and how much of it changes under noise."""

from itertools import combinations

import numpy
from columns import Found
from rims import Rims
from subjects import SEEDS


def rms(values):
    return float(numpy.sqrt(numpy.mean(numpy.square(values))))


class Measured:
    def __init__(self, mesh, columns, found):
        self.mesh, self.columns, self.found = mesh, columns, found
        copies = [mesh.noisy(seed) for seed in SEEDS]
        self.changes = [Changes(column, each, copies) for column, each in zip(columns, found)]
        ours = columns[0]
        self.noise = ours.noise(mesh), [ours.noise(copy) for copy in copies]
        self.rims = Rims(mesh, ours.curvatures(mesh, "mean", "status"))

    def size(self, index):
        """Root mean square of H, in units of 1 / mean edge."""
        return rms(self.found[index].mean) * self.mesh.edge

    def kept(self, index):
        """The same, as a part of that of the first column."""
        return self.size(index) / self.size(0)

    def correlation(self, one, other=0):
        return float(numpy.corrcoef(self.found[one].mean, self.found[other].mean)[0, 1])

    def limit(self, count):
        """The range of colours: the median over the estimators drawn of what 95 % of |H| stay below."""
        return float(numpy.median([numpy.quantile(numpy.abs(each.mean), 0.95) for each in self.found[:count]]))


class Changes:
    """Root mean squares over vertices: how far H, as a part of that of H itself, and normals, in degrees, of noisy copies
    are from those of the mesh; and how far copies scatter: their differences from each other by the root of 2."""

    def __init__(self, column, found, copies):
        noisy = [Found(column, copy) for copy in copies]
        pairs = list(combinations(noisy, 2))
        size = rms(found.mean)
        self.mean = rms([each.mean - found.mean for each in noisy]) / size
        self.normal = rms([degrees(each.normals, found.normals) for each in noisy])
        self.mean_scatter = rms([one.mean - other.mean for one, other in pairs]) / 2**0.5 / size
        self.normal_scatter = rms([degrees(one.normals, other.normals) for one, other in pairs]) / 2**0.5


def degrees(one, other):
    return numpy.degrees(2 * numpy.arcsin(numpy.clip(numpy.linalg.norm(one - other, axis=1) / 2, 0, 1)))
