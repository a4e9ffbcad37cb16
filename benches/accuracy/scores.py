"""Errors of an estimator in each row, and what they come to against the best of the row."""

import numpy
from sample import LOCATIONS
from suite import Row

CLIP = 3  # curvature errors count as at most so many times the surface's curvedness
FLOORS = {"normal": 0.01, "k": 0.001, "mean": 0.001, "gaussian": 0.001}  # below this, errors are as good as each other
CLOSE = 1.2


def rms(values):
    return float(numpy.sqrt(numpy.mean(numpy.square(values))))


def degrees_between(a, b):
    """Between vectors, of length 1 or not; right angles from one that is zero or no number."""
    sine, cosine = numpy.linalg.norm(numpy.cross(a, b), axis=1), (a * b).sum(1)
    return numpy.where((sine > 0) | (abs(cosine) > 0), numpy.degrees(numpy.arctan2(sine, cosine)), 90.0)


def errors_of(sample, found):
    """Errors in each location: degrees of normals, the others in parts of the RMS curvedness of the surface."""
    exact = {"mean": (sample.k1 + sample.k2) / 2, "gaussian": sample.k1 * sample.k2, "k1": sample.k1, "k2": sample.k2}
    inner = sample.location == 0
    unit = rms(numpy.stack([sample.k1, sample.k2])[:, inner])
    differences = {}
    if "normal" in found:
        differences["normal"] = degrees_between(found["normal"], sample.normal)
    for name in exact.keys() & found.keys() if unit else ():
        scale = unit**2 if name == "gaussian" else unit
        error = numpy.nan_to_num((found[name] - exact[name]) / scale, nan=CLIP)
        differences[name] = numpy.clip(error, -CLIP, CLIP)
    if "k1" in differences:
        differences["k"] = numpy.stack([differences.pop("k1"), differences.pop("k2")], 1)
    return {
        location: {name: rms(values[there]) for name, values in differences.items()}
        for number, location in enumerate(LOCATIONS)
        if (there := (sample.location == number) & sample.scored).any()
    }


class Scores:
    """Errors by quantity, estimator and row."""

    def __init__(self):
        self.errors, self.fixed = {}, {}

    def add(self, estimator, case, noise, locations):
        self.fixed[estimator.name] = estimator.fixed
        for location, quantities in locations.items():
            for quantity, error in quantities.items():
                rows = self.errors.setdefault(quantity, {}).setdefault(estimator.name, {})
                rows[Row(*case, noise, location)] = error

    def merge(self, other):
        self.fixed |= other.fixed
        for quantity, estimators in other.errors.items():
            for name, rows in estimators.items():
                self.errors.setdefault(quantity, {}).setdefault(name, {}).update(rows)

    def best(self, quantity):
        """Of each row, the name and error of the best fixed estimator."""
        result = {}
        for name, rows in self.errors.get(quantity, {}).items():
            if self.fixed[name]:
                for row, error in rows.items():
                    if row not in result or error < result[row][1]:
                        result[row] = name, error
        return result

    def ratios(self, quantity, name, best):
        floor = FLOORS[quantity]
        rows = self.errors.get(quantity, {}).get(name, {})
        return {row: max(error, floor) / max(best[row][1], floor) for row, error in rows.items() if row in best}


class Summary:
    """Of ratios."""

    def __init__(self, ratios):
        values = numpy.array(list(ratios))
        self.count, self.mean = len(values), float(numpy.exp(numpy.log(values).mean()))
        self.ninetieth, self.largest = float(numpy.percentile(values, 90)), float(values.max())
        self.close = float((values <= CLOSE).mean())
