"""Figure 10: what the curvature by a parabola measures."""

import numpy
import style
from pages import figure

A, B, C = numpy.array([(-1.5, 0.0), (-0.35, 1.25), (1.5, 0.0)])


def make(library, folder):
    middle, v = (A + C) / 2, (C - A) / 2
    d, e = B + 2 * v, middle + 2 * v  # B, D, E, F: the sides are G/2, from B to F, and 2V
    height, width = B[1], float(numpy.linalg.norm(v))
    drawing, axes = style.panels(1, 1, 7.6, 3.0, plain=True)
    axis = axes[0, 0]
    axis.fill(*numpy.array([B, d, e, middle]).T, facecolor="#f7ead2", edgecolor=style.ORANGE, linewidth=1.2)
    axis.fill(*numpy.array([B, C, middle]).T, facecolor="#cfe0ef", edgecolor=style.BLUE, linewidth=1.4)
    axis.plot(*numpy.array([A, B, C]).T, color=style.BLACK, linewidth=2)
    axis.plot(*numpy.array([A, C]).T, ":", color=style.GREY)
    t = numpy.linspace(0, 1, 81)[:, None]
    curve = (1 - t) ** 2 * A + 2 * t * (1 - t) * (4 * B - A - C) / 2 + t**2 * C
    axis.plot(*curve.T, color=style.RED, linewidth=1.6)
    axis.plot([B[0]] * 2, [0, B[1]], "--", color=style.GREY, linewidth=1)
    names = {
        "A": (A, (-10, -4)),
        "B": (B, (-4, 8)),
        "C": (C, (6, -13)),
        "D": (d, (4, 6)),
        "E": (e, (6, -8)),
        "F": (middle, (-4, -15)),
    }
    for name, (point, shift) in names.items():
        axis.plot(*point, "o", color=style.BLACK, markersize=4)
        axis.annotate(f"${name}$", point, xytext=shift, textcoords="offset points", fontsize=12)
    axis.annotate("$h$", (B[0] - 0.14, 0.42), color=style.BLACK)
    axis.annotate("$v$", (0.75, -0.16), color=style.BLACK)
    axis.set(xlim=(-1.75, 3.4), ylim=(-0.3, 1.45))
    style.save(drawing, folder, "figure10.svg")
    found = library.corner(C, B, A)["P"]
    return figure(
        "Figure 10: the geometric meaning of the P-curvature formula",
        "figure10.svg",
        f"""
With V = (C − A)/2 and G = A − 2B + C, the parallelogram BDEF has the area ‖G × V‖, four times that of the triangle
BCF of width v and height h; so F is the middle of AC, and κ_P = 2h/v². Here h = {height:.2f} and v = {width:.2f},
2h/v² = {2 * height / width**2:.4f}, and the library's κ_P is {found:.4f}. Red is the parabola, through A, B and C at
its parameters 0, 1/2 and 1.
""",
    )
