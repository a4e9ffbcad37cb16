"""docs/accuracy.md and docs/accuracy.png. What the text says of estimators follows from figures."""

import tables
from advice import Advice
from claims import claims
from figures import QUANTITIES, Figures
from markdown import listed, paragraphs
from measurements import own
from plot import draw
from suite import HALVES, TUNING, VERIFICATION


def introduction(found):
    seeds = ", ".join(map(str, found.seeds))
    return paragraphs(f"""
Written by `make accuracy` ({found.build}; seeds {seeds}). How fast errors fall with the edges is in
[convergence.md](convergence.md).

![Error against cost](accuracy.png)

Each point is an estimator: how much time it takes, and how large its error is beside that of the estimator that
happens to be best on the surface, sampling and noise at hand, in the geometric mean over many of these. Down is better,
left is cheaper; the line is what nothing is both cheaper and better than.
""")


def measured(found, figures):
    rows = {name: sum(row.surface in surfaces for row in figures.best["normal"]) for name, surfaces in HALVES.items()}
    counts = [len(figures.fixed(quantity)) for quantity in ("normal", "k")]
    return paragraphs(f"""
- **Surfaces.** Patches of a sphere, an ellipsoid (1 : 1.5 : 2.2) and a cylinder, a torus, a saddle, a cubic and a
sine as height fields; each *regular* (a grid, all diagonals alike), *irregular* (parameters moved by up to 30 %,
diagonals at random), *stretched* (as irregular, cells five times as long as high) and mostly of *quads* (moved by up
to 20 %, 85 % of the quads kept, which are then not flat). Random points on a sphere and an ellipsoid with the
triangles of their convex hull. With *creases*: a sharp cube, a sharp cylinder with caps, a box rounded by cylinders
and spheres.

- **Resolutions**: two, some 150 to 700 and 600 to 3500 vertices. **Noise** along the exact normal, of standard
deviation 0, 0.5 %, 2 % and 10 % of the mean edge (with creases, up to 2 %). **Places**: the interior, next to the
boundary, at the boundary, each scored apart. Vertices on sharp creases, where there is no normal, are not scored;
vertices beside them are.

- A **row** is a surface, a sampling, a resolution, a noise, a place and a seed: {rows["tuning"]} in the tuning half
({", ".join(TUNING)}), {rows["verification"]} in the verification half ({", ".join(VERIFICATION)}).

- **Errors.** Normals: root mean square of the angle to the exact normal, in degrees. Curvatures: root mean square of
the error, each clipped at 3, in units of the surface's root mean square curvedness √((k1² + k2²)/2), for K of its
square; k1 and k2 together. Of the cube, which has none, curvature is not scored.

- **Ratios.** The error of an estimator in a row, by that of the best *fixed* estimator in that very row ({counts[0]}
for normals, {counts[1]} for k1 and k2, those of other libraries included); errors below 0.01 degrees and 0.001 count
as these. So 1 means as good as if one had known beforehand which fixed estimator is best. Candidates, which adapt to
the mesh, are not among the fixed ones, nor are estimators that are given the exact normals.

- **Names.** `jet D-K` is a jet of degree D over K rings, `adaptive-jet` one over as many rings as the noise asks for (3 to 6), `adaptive-jet K` over K. `least-squares C`, `SP`:
sections by circles and symmetric parabolas. A 1 or 2 behind a method are its rings; behind the comma stand the vertex
normals that it is given. `N_G`, `N_T`, `N_C` are the uniform, angle and centroid weights of the paper (`N_C printed`:
as the paper prints it), `Jin` is inverse-root-edges.

- **Other libraries**: {listed(found.peers)}. Each computes its own normals and curvatures; those that take only
triangles get quads cut from their first corner. {" ".join(found.missing)} CGAL's jets look at rings along edges, as
its example does, more of them where there are fewer points than coefficients; OpenMesh's and VTK's normals take
quads; MeshLib's Gaussian curvature is divided by a third of the area of the triangles; where a library has H and K
only, k1 and k2 follow from these. Equal figures stand in one line.

- **Times** are CPU time in one thread, double precision in and out, called from Python where a library has that, on
an irregular torus of {found.cost_vertices} vertices, medians of rounds in which all take turns. That of the structure
that a library keeps for a mesh is left out (libigl builds its own in every call); that of the normals that a curvature
is given is in.
""")


def document(found):
    figures = Figures(found.scores, found.costs, {estimator.name for estimator in own()})
    sections = {
        "# Accuracy": [introduction(found)],
        "## Which estimator when": [*advice(figures)],
        "### Error and price": [PRICE, *(tables.front(figures, quantity) for quantity in ("normal", "k"))],
        "## What was measured": [measured(found, figures)],
        "## Ratios to the best of the row": [HALF_OF_WHAT],
    }
    for name in reversed(HALVES):
        ratios = [tables.ratios(figures, quantity, name) for quantity in QUANTITIES]
        sections[f"### {name.capitalize()} half"] = ratios
    sections["## The paper's claims"] = [claims(figures)]
    sections["## Max's experiment"] = [MAX]
    for name, title in ANGLES.items():
        sections["## Max's experiment"] += [title, tables.valences(found.valences[name])]
    sections["## Leaderboard"] = [LEADERBOARD]
    for quantity, title in TITLES.items():
        sections[f"### {title}"] = [tables.leaderboard(figures, quantity)]
    return "\n\n".join(part for title, parts in sections.items() for part in (title, *parts)) + "\n", figures


def advice(figures):
    found = Advice(figures)
    return [found.text(), SITUATIONS, *(found.situations(quantity) for quantity in ("normal", "k"))]


TITLES = {"normal": "Normals, degrees", "k": "k1 and k2", "mean": "H", "gaussian": "K"}
ANGLES = {
    "random": "Directions of neighbours random, gaps between them 3 to 176 degrees:",
    "even": "Directions evenly spaced, moved by up to 30 % of a step:",
}

SITUATIONS = paragraphs("""
The best of each kind, and its ratio to the best fixed estimator of each row: geometric means over the rows of the
verification half. Where that of a fixed one is above 1, no single one is the best in all rows of the situation.
""")

PRICE = paragraphs("""
From the cheapest on, every estimator that is better than all that cost less.
""")

HALF_OF_WHAT = paragraphs("""
The constants of adaptive estimators were chosen on the tuning half, whose ratios therefore flatter them. Those that
count are the verification half's, whose surfaces had no part in the choice.
""")

MAX = paragraphs("""
Max (1999) compared weights on random one-rings: 40 000 of each valence, at the origin of z = A x² + B x y + C y² +
D x³ + E x² y + F x y² + G y³ with coefficients uniform in ±0.1, neighbours at distances uniform in 0.05 to 1. Root mean
square of the angle to the exact normal, in degrees, by valence; bold is within 5 % of the best.
""")

LEADERBOARD = paragraphs("""
Mean of the errors of all rows of a column, both halves. Columns: sampling and noise in per cent of the mean edge, in
the interior; *border* is the boundary itself, all samplings. *ns* is the time a vertex, *ratio* that of the
verification half, by which lines are sorted. Bold is within 5 % of the best. Lines in italics are references that know
the exact normals.
""")


def publish(found, folder):
    text, figures = document(found)
    (folder / "accuracy.md").write_text(text)
    draw(figures, folder / "accuracy.png")
