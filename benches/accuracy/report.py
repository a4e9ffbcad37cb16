"""docs/convergence.md from errors. What the text says of a method follows from its figures."""

import numpy
from estimators import AVERAGES, CURVATURES, NORMALS
from markdown import listed, paragraphs, table
from meshes import KINDS
from surfaces import SURFACES

CONVERGES = 0.3  # the order from which a method is said to converge
EXACT = 1e-11  # an error below this is rounding
TITLES = {"regular": "regular meshes", "irregular": "irregular meshes", "quads": "meshes mostly of quads"}
OTHERS = [name for name in NORMALS if name.startswith("normal of ")]


def order(errors):
    """How many times the error halves when the edges do, fitted; none if there is only rounding."""
    if max(errors) < EXACT:
        return None
    return float(-numpy.polyfit(range(len(errors)), numpy.log2(errors), 1)[0])


def number(error):
    if error < EXACT:
        return "0"
    mantissa, exponent = f"{error:.1e}".split("e")
    return f"{error:.2g}" if error >= 0.01 else f"{mantissa}e{int(exponent)}"


def decimal(value):
    return f"{value:.1f}".replace("-0.0", "0.0")


def cell(errors):
    if errors is None:
        return "–"
    fitted = order(errors)
    return " ".join(map(number, errors)) + (" · exact" if fitted is None else f" · **{decimal(fitted)}**")


def quantity_of(name):
    """What a method is judged by: both principal curvatures, or K where there is nothing else."""
    return "normal" if name in NORMALS else "gaussian" if name == "angle-defect" else "k"


class Figures:
    def __init__(self, errors):
        self.errors = errors

    def of(self, kind, name):
        """The errors of a method on each surface."""
        return [self.errors[kind, surface.name][name][quantity_of(name)] for surface in SURFACES]

    def orders(self, kind, name):
        return [fitted for fitted in map(order, self.of(kind, name)) if fitted is not None]

    def converges(self, kind, name):
        return min(self.orders(kind, name), default=numpy.inf) >= CONVERGES

    def span(self, kind, name):
        orders = [decimal(fitted) for fitted in (min(self.orders(kind, name)), max(self.orders(kind, name)))]
        return orders[0] if orders[0] == orders[1] else f"{orders[0]} to {orders[1]}"

    def finest(self, kind, name):
        errors = [errors[-1] for errors in self.of(kind, name)]
        return number(min(errors)) if min(errors) == max(errors) else f"{number(min(errors))} to {number(max(errors))}"

    def wins(self, kinds, name, other):
        """In how many of all cases (surface, kind of mesh, size) a method has the smaller error, and of how many."""
        pairs = [
            (a, b)
            for kind in kinds
            for mine, theirs in zip(self.of(kind, name), self.of(kind, other))
            for a, b in zip(mine, theirs)
        ]
        return sum(a < b for a, b in pairs), len(pairs)


def names(methods):
    """Methods in a sentence, those that differ in their normals only told together."""
    groups = {}
    for method in methods:
        stem, _, given = method.partition(", ")
        groups.setdefault(stem, []).append(given)
    told = [f"`{stem}`" + (f" ({', '.join(given)})" if given != [""] else "") for stem, given in groups.items()]
    return listed(told)


def overview(figures, methods):
    heads = ["", *(f"{kind}: order | error at the finest" for kind in KINDS)]
    rows = []
    for name in methods:
        row = [name]
        for kind in KINDS:
            exact = not figures.orders(kind, name)
            row += ["exact" if exact else figures.span(kind, name), figures.finest(kind, name)]
        rows.append(row)
    return table(" | ".join(heads).split(" | "), rows)


def verdict(cases):
    """What so many wins of so many cases make of a claim."""
    won, of = cases
    part = won / of
    if part >= 0.9:
        says = "holds"
    elif part >= 0.6:
        says = "mostly holds"
    else:
        says = "is undecided" if part > 0.4 else "does not hold"
    return f"{says} ({won} of {of})"


def count(cases):
    return "{} of {}".format(*cases)


def sum_of(cases):
    return tuple(map(sum, zip(*cases)))


def conclusions(figures):
    stalled = {kind: [name for name in CURVATURES if not figures.converges(kind, name)] for kind in KINDS}
    given = {}
    for name in CURVATURES:
        stem, _, normals = name.partition(", ")
        given.setdefault(stem, {})[normals] = figures.converges("irregular", name)
    good = [stem for stem, normals in given.items() if list(normals.values()) == [False, True, True]]
    always = [stem for stem, normals in given.items() if list(normals) == [""] and stem in CURVATURES]
    always = [name for name in always if all(figures.converges(kind, name) for kind in KINDS)]
    orders = {
        kind: [fitted for name in AVERAGES for fitted in figures.orders(kind, name)] for kind in KINDS
    }
    spans = {kind: f"{decimal(min(found))} to {decimal(max(found))}" for kind, found in orders.items()}
    best = {}
    for kind in KINDS:
        for index, surface in enumerate(SURFACES):
            winner = min(AVERAGES, key=lambda name: figures.of(kind, name)[index][-1])
            best.setdefault(winner, []).append(f"{surface.name} {kind}")

    compared = ("uniform", "angle", "area", "centroid")
    weights = "; ".join(
        f"on {TITLES[kind]} it {verdict(sum_of(figures.wins([kind], 'conformal', other) for other in compared))}"
        for kind in KINDS
    )
    others = "; ".join(
        f"than `{name}` in "
        + ", ".join(f"{count(figures.wins([kind], 'conformal', name))} on {TITLES[kind]}" for kind in KINDS)
        for name in ("max", "inverse-root-edges")
    )
    winners = "; ".join(f"`{name}` on {', '.join(cases)}" for name, cases in best.items())
    sections = ", ".join(
        verdict(figures.wins(KINDS, f"least-squares SP, {normals}", f"least-squares C, {normals}")) + f" with {normals}"
        for normals in ("N_CM", "jet", "exact")
    )
    pairs = [
        figures.of(kind, f"least-squares {section}, {normals}")
        for kind in KINDS
        for normals in ("N_CM", "jet", "exact")
        for section in ("SP", "C")
    ]
    ratios = numpy.array(pairs[::2]) / numpy.array(pairs[1::2])
    alike = f"{(abs(ratios - 1) < 0.02).sum()} of {ratios.size}"
    ours = "least-squares SP, N_CM"
    rivals = {
        "Meyer et al.": "meyer",
        "the quadric": "quadric, N_CM",
        "Goldfeather and Interrante": "goldfeather, N_CM",
    }
    duels = "; ".join(
        f"against {label} it "
        + ", ".join(f"{verdict(figures.wins([kind], ours, rival))} on {TITLES[kind]}" for kind in KINDS)
        for label, rival in rivals.items()
    )
    further = "".join(f" The {name} is of order {figures.span('irregular', name)} there." for name in OTHERS)
    return paragraphs(f"""
## What it says

- **Normals.** One-ring averages are of order {spans["irregular"]} on irregular meshes and {spans["quads"]} on quads:
the first. On regular ones symmetry makes it {spans["regular"]}. Jets of degree 1, 2, 3 and 4 are of orders
{", ".join(figures.span("irregular", f"jet {degree}") for degree in (1, 2, 3, 4))} on irregular meshes.{further}

- **Curvatures that do not converge on irregular meshes** (of order below {CONVERGES} on at least one surface):
{names(stalled["irregular"])}.

- The same on meshes mostly of quads: {names(stalled["quads"])}.

- The same even on regular meshes: {names(stalled["regular"])}. These replace the mean over all directions by one
over the neighbours, which is right only where those stand at even angles.

- **Only with good normals** (jets or exact ones, not N_CM) these converge on irregular meshes: {names(good)}. The
error of N_CM is of first order and differs from vertex to vertex, so differences of such normals over an edge have
an error that does not shrink.

- Without being given normals these converge on every kind of mesh: {names(always)}.

### The paper's claims

A case is a surface, a kind of mesh and a size; a claim holds where the error is the smaller one in nine of ten
cases, mostly holds from six of ten on, is undecided above four of ten, and does not hold below.

- *N_CM is the best of the normals.* Against the four weights that the paper compares it with (`uniform`, `angle`,
`area`, `centroid`): {weights}. Against two that it does not compare, N_CM has the smaller error: {others}. The
smallest error of all one-ring averages at the finest size is that of {winners}.

- *Symmetric parabolas are better than circles* as sections, here put together by least squares: {sections} normals.
In {alike} cases the two errors differ by less than 2 %. This is about smooth surfaces; what the paper says about
sharp corners is not measured here.

- *Curvatures from sections are better than earlier ones.* The paper's way (`{ours}`): {duels}. Its orders:
{", ".join(f"{figures.span(kind, ours)} on {TITLES[kind]}" for kind in KINDS)}.
""")


def report(errors, counts):
    figures = Figures(errors)
    sizes = "; ".join(f"{name} {', '.join(map(str, each))}" for name, each in counts.items())
    parts = [
        "# Convergence on smooth surfaces",
        paragraphs(f"""
Written by `make accuracy`, from one mesh of each kind and size. Noise, creases and boundaries are in
[accuracy.md](accuracy.md), not here.

## What was measured

A torus (radii 1 and 0.4), an ellipsoid (half axes 1, 1.5, 2.2) and the height field of a cubic polynomial, whose
normals and curvatures are known exactly at every vertex. Of the height field only the inner three quarters each way
count, so nothing here is about boundaries. Vertices: {sizes}; edges are half as long at each step.

Meshes are *regular* (a grid, all diagonals alike), *irregular* (parameters moved by up to a quarter of the grid's
spacing, diagonals at random) and mostly of *quads* (moved by up to a fifth, 85 % of the quads kept, which are then
not flat). Vertices lie on the surface. All in double precision.

- Normals: root mean square of the angle to the exact normal, in degrees.

- Curvatures: root mean square of the error, divided by the surface's root mean square curvedness √((k1² + k2²)/2),
and for K by its square.

- Directions: root mean square of the angle between the estimated line of k1 and the exact one, in degrees, where k1
− k2 is at least a fifth of that curvedness. Guessing gives 52.

- The four numbers of a cell are the errors from the coarsest to the finest mesh. The bold one is the *order*, the
slope of log2 of the error over these: 1 where the error halves with the edges, 2 where it falls to a quarter, 0
where finer meshes do not help.

`N_CM`, `jet` (degree 3, two rings) and `exact` behind a method are the vertex normals that it was given; SP and C
are sections by symmetric parabolas and by circles. The radius of `in balls` shrinks as the square root of the
edges. Everything else is the default.
"""),
        conclusions(figures),
        "## Orders and errors at a glance\n\nOver the three surfaces; of curvatures both principal ones together "
        "(`angle-defect`: K).\n\n"
        + overview(figures, NORMALS)
        + "\n\n"
        + overview(figures, CURVATURES),
    ]
    surfaces = [surface.name for surface in SURFACES]
    for kind in KINDS:
        parts.append(f"## {TITLES[kind].capitalize()}")
        rows = [[name, *map(cell, figures.of(kind, name))] for name in NORMALS]
        parts.append("### Normals, degrees\n\n" + table(["weight", *surfaces], rows))
        for surface in surfaces:
            here = errors[kind, surface]
            rows = [
                [name, *(cell(here[name].get(quantity)) for quantity in ("k1", "k2", "mean", "gaussian"))]
                for name in CURVATURES
            ]
            heads = ["method", "k1", "k2", "H", "K"]
            parts.append(f"### Curvatures of the {surface}\n\n" + table(heads, rows))
        rows = [
            [name, *(cell(errors[kind, surface][name].get("direction")) for surface in surfaces)]
            for name in CURVATURES
            if "direction" in errors[kind, surfaces[0]][name]
        ]
        parts.append("### Direction of k1, degrees\n\n" + table(["method", *surfaces], rows))
    return "\n\n".join(parts) + "\n"
