"""Figure 9: a polygon on two circles of the same radius."""

import numpy
import style
from figure_03 import circle
from pages import figure, under

APART = 0.8  # from the middle to either centre; the circles cross at angles of acos(±APART)
# Vertices by their angle on the circle, in degrees; the crossings are one's last and the other's first.
RIGHT = (-100, -60, -20, 20, 60, 100)
LEFT = (70, 180, 290)


def vertices():
    """Points, and which circle each is on: 0 and 1, and both, 2, for the crossings."""
    height = numpy.sqrt(1 - APART**2)
    points, circles = [(0.0, -height)], [2]
    for angles, side in ((RIGHT, 1), (LEFT, 0)):
        if side == 0:
            points.append((0.0, height))
            circles.append(2)
        for angle in numpy.radians(angles):
            points.append(((2 * side - 1) * APART + numpy.cos(angle), numpy.sin(angle)))
            circles.append(side)
    return numpy.array(points), circles


def between(circles):
    """Whether a vertex has its neighbours on different circles."""
    count = len(circles)
    return numpy.array([{circles[v - 1], circles[(v + 1) % count]} == {0, 1} for v in range(count)])


def make(library, folder):
    points, circles = vertices()
    found, green = library.polyline(points), between(circles)
    drawing, axes = style.panels(1, 1, 8.6, 4.4, plain=True)
    axis = axes[0, 0]
    for side in (-1, 1):
        circle(axis, 1, (side * APART, 0))
    axis.fill(*points.T, facecolor=style.PALE, edgecolor=style.BLACK, linewidth=1.4)
    for point, sharp, c, sp, mark in zip(points, green, found["C"], found["SP"], circles):
        axis.plot(*point, "s" if sharp else "o", color=style.GREEN if sharp else style.RED, markersize=9)
        outwards = numpy.array([0, -numpy.sign(point[1])]) if mark == 2 else point - ((2 * mark - 1) * APART, 0)
        box = {"facecolor": style.PALE if mark == 2 else "none", "edgecolor": "none", "pad": 1}
        place = point + 0.36 * outwards * (1, 0.62)
        axis.text(*place, f"{c:.2f}, {sp:.2f}", ha="center", va="center", fontsize=9.5, bbox=box)
    handles = [
        style.pyplot.Line2D([], [], color=colour, marker=marker, linestyle="", markersize=8, label=label)
        for colour, marker, label in (
            (style.RED, "o", "neighbours on the same circle"),
            (style.GREEN, "s", "neighbours on different circles"),
        )
    ]
    drawing.legend(handles=handles, loc="lower center", ncols=2, bbox_to_anchor=(0.5, -0.06))
    axis.set(xlim=(-2.35, 2.35), ylim=(-1.35, 1.35))
    style.save(drawing, folder, "figure09.svg")
    red = found["C"][~green]
    return figure(
        "Figure 9: the geometric meaning of C-discrete curvature",
        "figure09.svg",
        f"""
A polygon whose vertices lie on two circles of radius 1; behind each vertex κ_C, κ_SP. Red vertices have κ_C =
{red.mean():.2f} (within {under(numpy.ptp(red))}), whatever their angle; κ_SP tells the sharp left one,
{found["SP"][circles.index(0) + 1]:.2f}, from the others. To the left turn of the polygon belongs the positive sign:
the green corners turn right. Where the paper's vertices were is not known.
""",
    )
