"""Figure 3: polygons in circles of the same radius."""

import numpy
import style
from pages import figure
from polyhedra import regular_polygon

COUNTS = (3, 4, 5, 6, 8)


def circle(axis, radius=1.0, centre=(0, 0), **options):
    angles = numpy.linspace(0, 2 * numpy.pi, 181)
    options = {"color": style.GREY, "linewidth": 0.9, "linestyle": "--"} | options
    axis.plot(centre[0] + radius * numpy.cos(angles), centre[1] + radius * numpy.sin(angles), **options)


def draw(library, folder, file, letter):
    """Regular polygons with their curvatures by one formula inside."""
    drawing, axes = style.panels(1, len(COUNTS), 11.0, 2.4, plain=True, gridspec_kw={"wspace": 0.06})
    for axis, count in zip(axes.flat, COUNTS):
        points = regular_polygon(count)
        values = library.polyline(points)[letter]
        circle(axis)
        axis.fill(*points.T, facecolor=style.PALE, edgecolor=style.BLACK, linewidth=1.4)
        axis.plot(*points.T, "o", color=style.FORMULA[letter], markersize=6)
        assert numpy.ptp(values) < 1e-12
        axis.text(0, 0, f"{style.kappa(letter)} = {values[0]:.2f}", ha="center", va="center", fontsize=11)
    style.save(drawing, folder, file)


def make(library, folder):
    draw(library, folder, "figure03.svg", "C")
    return figure(
        "Figure 3: several polygons with the same discrete curvature",
        "figure03.svg",
        """
Polygons with different angles in circles of radius 1, and κ_C at their vertices: that of the circle. To the paper
this is "quite alien to universal concepts"; see also figure 11, and what [errata](errata.md) says of it.
""",
    )
