"""Which estimator when, as far as the verification half says."""

from contestants import AVERAGES, CANDIDATES
from figures import QUANTITIES, both, half, situation
from markdown import listed, paragraphs, percent, table

SITUATIONS = {
    "regular, clean": situation("regular", 0.0),
    "irregular, clean": situation("irregular", 0.0),
    "stretched, clean": situation("stretched", 0.0),
    "mostly quads, clean": situation("quads", 0.0),
    "noise of 0.5 % of an edge": lambda row: row.noise == 0.005
    and row.location == "interior"
    and row.sampling != "creased",
    "noise of 2 %": lambda row: row.noise == 0.02 and row.location == "interior" and row.sampling != "creased",
    "noise of 10 %": lambda row: row.noise == 0.1 and row.location == "interior",
    "beside creases, clean": situation("creased", 0.0),
    "beside creases, noise": lambda row: row.sampling == "creased" and row.noise > 0,
    "next to the boundary": lambda row: row.location == "near",
    "at the boundary, clean": situation(None, 0.0, "boundary"),
    "at the boundary, noise": lambda row: row.location == "boundary" and row.noise > 0,
}
BUDGETS = (3, 10, 30, 100)  # times the fastest
MUCH = 2


def one_ring(name):
    """Whether an estimator looks at one ring, by way of its normals too."""
    given = name.partition(", ")[2]
    return name in (*AVERAGES, "tilted-sections", "angle-defect") or given in AVERAGES and not stem(name).endswith(" 2")


def stem(name):
    """Without the normals given."""
    return name.partition(", ")[0]


class Advice:
    def __init__(self, figures):
        self.figures, self.own = figures, figures.own

    def ratio(self, quantity, name, where=lambda row: True):
        found = self.figures.summary(quantity, name, both(half("verification"), where))
        return found and found.mean

    def best(self, quantity, names, where=lambda row: True):
        ranked = [(self.ratio(quantity, name, where), name) for name in names]
        return min((ratio, name) for ratio, name in ranked if ratio is not None)

    def situations(self, quantity):
        """The best of each kind in every situation, and candidates."""
        names = self.figures.names(quantity)
        fixed = self.figures.fixed(quantity)
        candidates = [name for name in CANDIDATES if name in names]
        groups = {
            "one ring": [name for name in names if one_ring(name)],
            "fixed, of umbilic": [name for name in fixed if name in self.own],
            "fixed, of others": [name for name in fixed if name not in self.own],
        }
        rows = []
        for title, where in SITUATIONS.items():
            cells = ["{1} ({0:.2f})".format(*self.best(quantity, group, where)) for group in groups.values() if group]
            rows.append([title, *cells, *(f"{self.ratio(quantity, name, where):.2f}" for name in candidates)])
        return table([QUANTITIES[quantity], *(kind for kind, group in groups.items() if group), *candidates], rows)

    def within(self, quantity):
        """The best at most so many times as dear as the fastest."""
        costs = self.figures.costs[quantity]
        fastest, told = min(costs.values()), []
        for budget in BUDGETS:
            ratio, name = self.best(
                quantity, [name for name in costs if costs[name] <= budget * fastest and "exact" not in name]
            )
            if not told or name != told[-1][0]:
                told.append((name, ratio, budget))
        return told

    def outdone(self, quantity, name):
        """Whether another one, of the library too, is no dearer and much better, and this one nowhere near the best."""
        costs, ratio = self.figures.costs[quantity], self.ratio(quantity, name)
        cheaper = [other for other in self.figures.fixed(quantity) if other in self.own and costs[other] <= costs[name]]
        best = min(self.ratio(quantity, other) for other in cheaper)
        least = min(filter(None, (self.ratio(quantity, name, where) for where in SITUATIONS.values())))
        return MUCH * best <= ratio and least >= MUCH

    def text(self):
        """Statements, all from figures."""
        items = [self.unknown(quantity) for quantity in ("normal", "k")]
        items += [self.by_price(quantity) for quantity in ("normal", "k")]
        return paragraphs("".join([*items, self.one_ring(), self.not_for_accuracy()]))

    def unknown(self, quantity):
        _, name = self.best(quantity, self.figures.names(quantity))
        ratio, fixed = self.best(quantity, self.figures.fixed(quantity))
        found = self.figures.summary(quantity, name)
        other = f" The best single fixed one is `{fixed}`, at {ratio:.2f} times." if fixed != name else ""
        return f"""
- **If nothing is known of the mesh, {QUANTITIES[quantity]}: `{name}`.** Its error is {found.mean:.2f} times that of the
best fixed estimator of the row in the geometric mean, within 1.2 times in {percent(found.close)} of the rows and within
{found.ninetieth:.1f} times in nine of ten.{other}"""

    def by_price(self, quantity):
        steps = listed(f"`{name}` up to {budget} times ({ratio:.2f})" for name, ratio, budget in self.within(quantity))
        return f"""
- **By price, {QUANTITIES[quantity]}:** the best that costs no more than so many times the cheapest is {steps},
with its ratio in brackets."""

    def one_ring(self):
        (normal, first), (k, second) = (
            self.best(quantity, filter(one_ring, self.figures.names(quantity))) for quantity in ("normal", "k")
        )
        return f"""
- **One ring only:** `{first}` for normals ({normal:.2f}), `{second}` for k1, k2 ({k:.2f})."""

    def not_for_accuracy(self):
        """Methods that are outdone whatever they are given."""
        stays, goes = set(), {}
        for quantity in ("normal", "k"):
            for name in self.figures.fixed(quantity):
                if name in self.own:
                    outdone = self.outdone(quantity, name)
                    goes.setdefault(stem(name)) if outdone else stays.add(stem(name))
        told = [f"`{name}`" for name in goes if name not in stays]
        if not told:
            return ""
        return f"""
- **Not for accuracy:** whatever normals they are given, {listed(told)} are within twice the best in no situation below,
and something that costs no more has at most half their error over the whole half. They are there to match other
programs and papers, or for their integrals."""
