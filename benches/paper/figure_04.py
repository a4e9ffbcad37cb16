"""Figure 4: what mean value coordinates are made of."""

import numpy
import style
from coordinates import mean_value
from matplotlib.patches import Arc
from pages import figure, under

POLYGON = numpy.array([(1.15, 0.05), (0.75, 0.95), (-0.25, 1.1), (-1.1, 0.45), (-0.8, -0.75), (0.45, -0.85)])
INSIDE = numpy.array([0.12, 0.08])


def make(library, folder):
    weights = mean_value(POLYGON, INSIDE)
    drawing, axes = style.panels(1, 1, 4.6, 4.1, plain=True)
    axis = axes[0, 0]
    axis.fill(*POLYGON.T, facecolor=style.PALE, edgecolor=style.BLACK, linewidth=1.4)
    directions = numpy.degrees(numpy.arctan2(*(POLYGON - INSIDE).T[::-1]))
    for index, (point, value) in enumerate(zip(POLYGON, weights)):
        axis.plot(*zip(INSIDE, point), color=style.RED if index == 1 else style.GREY, linewidth=1.2)
        away = INSIDE + (point - INSIDE) * (1 + 0.17 / numpy.linalg.norm(point - INSIDE))
        name = {0: "i-1", 1: "i", 2: "i+1"}.get(index)
        label = (f"$U_{{{name}}}$\n" if name else "") + f"{value:.3f}"
        axis.text(*away, label, ha="center", va="center", color=style.BLACK)
        axis.plot(*point, "o", color=style.BLACK, markersize=4)
    for index, name in ((0, "i-1"), (1, "i")):
        after = directions[index + 1]
        axis.add_patch(Arc(INSIDE, 0.6, 0.6, theta1=directions[index], theta2=after, color=style.BLUE, linewidth=1.4))
        angle = numpy.radians((directions[index] + after) / 2)
        place = INSIDE + 0.43 * numpy.array([numpy.cos(angle), numpy.sin(angle)])
        axis.text(*place, rf"$\alpha_{{{name}}}$", ha="center", va="center", color=style.BLUE)
    axis.plot(*INSIDE, "o", color=style.RED, markersize=5)
    axis.annotate("$P$", INSIDE, xytext=(-12, -12), textcoords="offset points")
    style.save(drawing, folder, "figure04.svg")
    off = numpy.abs(weights @ POLYGON - INSIDE).max()
    return figure(
        "Figure 4: configuration of mean value coordinates",
        "figure04.svg",
        f"""
A point P in a polygon, the angles that the weight of U_i is made of, and the coordinates λ of P at every vertex: all
positive, their sum 1, and Σ λ_i U_i is P (here within {under(off)}), as equation (1) asks.
""",
    )
