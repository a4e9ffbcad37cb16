"""What errors come to: means over situations, ratios to the best of each row, and costs."""

from functools import cached_property

import numpy
from scores import FLOORS, Summary
from suite import HALVES

QUANTITIES = {"normal": "normals", "k": "k1, k2", "mean": "H", "gaussian": "K"}


def situation(sampling=None, noise=None, location="interior"):
    """A test of rows."""

    def holds(row):
        return row.location == location and sampling in (None, row.sampling) and noise in (None, row.noise)

    return holds


def half(name):
    return lambda row: row.surface in HALVES[name]


def both(*tests):
    return lambda row: all(test(row) for test in tests)


# Columns of the leaderboard.
COLUMNS = {
    "regular 0": situation("regular", 0.0),
    "irreg. 0": situation("irregular", 0.0),
    "stretched 0": situation("stretched", 0.0),
    "quads 0": situation("quads", 0.0),
    "irreg. 0.5": situation("irregular", 0.005),
    "irreg. 2": situation("irregular", 0.02),
    "quads 2": situation("quads", 0.02),
    "stretched 2": situation("stretched", 0.02),
    "irreg. 10": situation("irregular", 0.1),
    "quads 10": situation("quads", 0.1),
    "creases 0": situation("creased", 0.0),
    "creases 2": situation("creased", 0.02),
    "border 0": situation(None, 0.0, "boundary"),
    "border 0.5": situation(None, 0.005, "boundary"),
    "border 2": situation(None, 0.02, "boundary"),
    "border 10": situation(None, 0.1, "boundary"),
}


class Figures:
    """`costs`: names, quantities and nanoseconds a vertex. `own`: the names of the library's estimators."""

    def __init__(self, scores, costs, own):
        self.scores, self.costs, self.own = scores, {quantity: {} for quantity in QUANTITIES}, own
        for name, quantities, cost in costs:
            for quantity in quantities:
                if name in scores.errors[quantity]:
                    self.costs[quantity][name] = cost
        self.sorted, self.best = {}, {quantity: scores.best(quantity) for quantity in QUANTITIES}

    @cached_property
    def ratios(self):
        return {
            quantity: {
                name: self.scores.ratios(quantity, name, self.best[quantity]) for name in self.scores.errors[quantity]
            }
            for quantity in QUANTITIES
        }

    def names(self, quantity):
        """Of estimators that do not know the exact normals, from the best to the worst of the verification half."""
        if quantity not in self.sorted:
            names = [name for name in self.scores.errors[quantity] if not name.endswith(", exact")]
            self.sorted[quantity] = sorted(names, key=lambda name: self.summary(quantity, name).mean)
        return self.sorted[quantity]

    def references(self, quantity):
        return [name for name in self.scores.errors[quantity] if name.endswith(", exact")]

    def fixed(self, quantity):
        return [name for name in self.names(quantity) if self.scores.fixed[name]]

    def summary(self, quantity, name, where=None):
        """Of the verification half if nothing else is said."""
        where = where or half("verification")
        ratios = [ratio for row, ratio in self.ratios[quantity].get(name, {}).items() if where(row)]
        return Summary(ratios) if ratios else None

    def error(self, quantity, name, where):
        """The mean of the errors of rows."""
        errors = [error for row, error in self.scores.errors[quantity][name].items() if where(row)]
        return float(numpy.mean(errors)) if errors else None

    def alike(self, quantity, names):
        """Names by name of the first of those whose errors are the same to a thousandth, in every row."""
        groups, floor = {}, FLOORS[quantity]
        for name in names:
            rows = self.scores.errors[quantity][name]
            for first in groups:
                others = self.scores.errors[quantity][first]
                if rows.keys() == others.keys() and all(
                    abs(rows[row] - others[row]) <= 1e-3 * max(others[row], floor) for row in rows
                ):
                    groups[first].append(name)
                    break
            else:
                groups[name] = [name]
        ordered = [sorted(group, key=lambda name: name not in self.own) for group in groups.values()]
        return {group[0]: group for group in ordered}

    def front(self, quantity):
        """The estimators than which none is both cheaper and better, from the cheapest on."""
        costs, front, least = self.costs[quantity], [], numpy.inf
        for name in sorted((name for name in self.names(quantity) if name in costs), key=costs.get):
            ratio = self.summary(quantity, name).mean
            if ratio < least:
                front.append(name)
                least = ratio
        return front

    def duel(self, quantity, name, other, where):
        """In what part of the rows the first is the better one, and the geometric mean of its error to the other's."""
        floor, pairs = FLOORS[quantity], []
        for row, error in self.scores.errors[quantity][name].items():
            if where(row):
                pairs.append((max(error, floor), max(self.scores.errors[quantity][other][row], floor)))
        mine, theirs = numpy.array(pairs).T
        return float((mine < theirs).mean()), float(numpy.exp(numpy.log(mine / theirs).mean()))
