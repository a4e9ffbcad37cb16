"""Figure 12: corners of the same width and height that lean."""

import numpy
import style
from pages import figure, table

WIDTH, HEIGHT, LEANS = 1.0, 1.2, (0.0, 0.7, 1.5)  # half the base, and how far the top is off its middle


def triangle(lean):
    return numpy.array([(-WIDTH, 0), (lean, HEIGHT), (WIDTH, 0)])


def make(library, folder):
    drawing, axes = style.panels(1, 3, 9.6, 2.7, plain=True, gridspec_kw={"wspace": 0.08})
    rows = []
    for axis, lean in zip(axes.flat, LEANS):
        points = triangle(lean)
        found = library.corner(*points[::-1])
        axis.plot(*points.T, color=style.BLACK, linewidth=2)
        axis.plot(*points[[0, 2]].T, ":", color=style.GREY)
        axis.plot([lean, lean], [0, HEIGHT], "--", color=style.GREY, linewidth=1)
        axis.plot(*points.T, "o", color=style.BLACK, markersize=4)
        axis.plot(*points[1], "o", color=style.RED, markersize=7)
        axis.annotate("$2v$", (0, -0.22), ha="center")
        axis.annotate("$h$", (lean - 0.14, 0.5))
        told = "   ".join(f"{style.kappa(letter)} = {found[letter]:.3f}" for letter in ("P", "SP"))
        axis.text(0.2, -0.5, told, ha="center")
        axis.set(xlim=(-1.2, 1.7), ylim=(-0.55, 1.35))
        a, c = points[0] - points[1], points[2] - points[1]
        angle = numpy.degrees(numpy.arccos(a @ c / numpy.linalg.norm(a) / numpy.linalg.norm(c)))
        rows.append([f"{lean:.1f}", f"{angle:.1f}°", *(f"{found[letter]:.3f}" for letter in ("P", "SP", "PL", "C"))])
    style.save(drawing, folder, "figure12.svg")
    return figure(
        "Figure 12: polygons with the same P-curvature",
        "figure12.svg",
        """
Three corners with the same width 2v and the same height h have the same κ_P = 2h/v², though the third is the
sharpest; κ_SP tells them apart. The parabola by lengths, which the paper names and leaves, does so too:
""",
        table(["top off the middle", "angle", "κ_P", "κ_SP", "κ_PL", "κ_C"], rows),
    )
