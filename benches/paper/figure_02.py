"""Figure 2: two faces with the same corner, but other vertices behind it."""

import numpy
import style
from library import PAPER
from pages import figure, significant, table

# Both have a right angle with edges of length 1 at (0, 0).
FACES = {"f": [(0, 0), (1, 0), (0, 1)], "g": [(0, 0), (1, 0), (2.1, 1.2), (1.2, 2.1), (0, 1)]}
LISTED = PAPER | {"N_C as printed": "centroid-area", "Max": "max"}


def ratio(library, weight):
    """The weight of g's normal over that of f's, for the corner that they share."""
    f, g = FACES.values()
    # g lies in the plane z = 0, f stands on it, and they share an edge: the normal's components are their weights.
    positions = [(x, y, 0.0) for x, y in g] + [(0.0, 0.0, 1.0)]
    faces = [list(range(len(g))), [0, len(g), 1]]
    assert len(f) == 3
    normal = library.normals(numpy.array(positions), faces, weight)[0]
    return normal[2] / normal[1]


def make(library, folder):
    drawing, axes = style.panels(1, 2, 6.0, 3.1, plain=True, gridspec_kw={"width_ratios": [1, 1], "wspace": 0.05})
    for axis, (name, outline) in zip(axes.flat, FACES.items()):
        points = numpy.array(outline, float)
        axis.fill(*points.T, facecolor="#dde8f3", edgecolor=style.BLACK, linewidth=1.2)
        axis.plot(*points[[1, 0, -1]].T, color=style.RED, linewidth=2.4)
        x, y = points.T
        cross = x * numpy.roll(y, -1) - y * numpy.roll(x, -1)
        centre = [((p + numpy.roll(p, -1)) * cross).sum() / 3 / cross.sum() for p in (x, y)]
        axis.plot(*centre, "o", color=style.PURPLE, markersize=4)
        axis.plot([0, centre[0]], [0, centre[1]], ":", color=style.PURPLE)
        axis.annotate(f"${name}$", (0.3, 0.13) if name == "f" else (1.2, 1.45), fontsize=12)
        axis.annotate("$v$", (-0.12, -0.16), fontsize=12)
        axis.plot(0, 0, "o", color=style.BLACK, markersize=5)
        axis.set(xlim=(-0.25, 2.25), ylim=(-0.25, 2.25))
    style.save(drawing, folder, "figure02.svg")
    rows = [[name, significant(ratio(library, weight))] for name, weight in LISTED.items()]
    return figure(
        "Figure 2: two faces with the same local geometric property and different weights",
        "figure02.svg",
        """
The paper's case against N_C: at v both faces have the same angle and the same edges, but their centroids (dotted) and
areas differ. How many times the weight of f's normal the normal of g has:
""",
        table(["normal", "weight of g over weight of f"], rows),
    )
