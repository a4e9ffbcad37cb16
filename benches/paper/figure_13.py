"""Figure 13: a corner and its symmetric parabola."""

import numpy
import style
from pages import figure

A, B, C = numpy.array([(-0.75, 1.0), (0.0, 0.0), (1.25, 1.05)])


def make(library, folder):
    a, c = A - B, C - B
    normal = a / numpy.linalg.norm(a) + c / numpy.linalg.norm(c)
    normal /= numpy.linalg.norm(normal)
    across = numpy.array([normal[1], -normal[0]])
    heights = [edge @ normal for edge in (a, c)]
    widths = [abs(edge @ across) for edge in (a, c)]
    height, width = sum(heights) / 2, sum(widths) / 2
    curvature = 2 * height / width**2
    # Drawn with N upwards.
    turned = {name: numpy.array([point @ across, point @ normal]) for name, point in (("A", a), ("C", c))}
    points = turned | {"B": numpy.zeros(2), "M": numpy.array([width, height])}
    feet = {name + "'": points[name] * [0, 1] for name in ("A", "C", "M")}
    drawing, axes = style.panels(1, 1, 6.2, 4.0, plain=True)
    axis = axes[0, 0]
    axis.fill(*numpy.array([points["M"], feet["M'"], points["B"]]).T, facecolor="#cfe0ef", edgecolor=style.BLUE)
    axis.plot(*numpy.array([points["A"], points["B"], points["C"]]).T, color=style.BLACK, linewidth=2)
    for name in ("A", "C"):
        axis.plot(*numpy.array([points[name], feet[name + "'"]]).T, "--", color=style.GREY, linewidth=1)
    x = numpy.linspace(-1.22, 1.22, 101) * width
    axis.plot(x, curvature / 2 * x**2, color=style.RED)
    style.arrow(axis, (0, 0), (0, 1.9), style.GREEN)
    axis.annotate("$N$", (0.06, 1.82), color=style.GREEN, fontsize=12)
    shifts = {"A": (-15, -3), "B": (-4, -17), "C": (7, -3), "M": (8, -4), "A'": (6, 4), "C'": (-18, 4), "M'": (-20, -4)}
    for name, point in (points | feet).items():
        axis.plot(*point, "o", color=style.BLACK, markersize=4)
        axis.annotate(f"${name}$", point, xytext=shifts[name], textcoords="offset points", fontsize=12)
    labels = {"v_A": (points["A"][0] / 2, heights[0]), "v_C": (widths[1] / 2, heights[1]), "v_m": (width / 2, height)}
    for name, place in labels.items():
        axis.annotate(f"${name}$", place, xytext=(0, 4), textcoords="offset points", ha="center", color=style.BLUE)
    axis.set(xlim=(-1.25, 1.4), ylim=(-0.2, 2.0))
    style.save(drawing, folder, "figure13.svg")
    found = library.corner(A, B, C)
    return figure(
        "Figure 13: polygon and its parabola",
        "figure13.svg",
        f"""
The bisector N of the corner at B, the heights h along it and the widths v across it of both edges, their means h_m
and v_m at M, and the parabola through M that is symmetric about N. κ_SP = 2 h_m / v_m² is {curvature:.4f} in this
drawing; the library's is {found["SP"]:.4f}, its κ_P {found["P"]:.4f}.
""",
    )
