"""Figure 7: the neighbours of one curvature, by circle and by symmetric parabola."""

import numpy
import style
from figure_03 import circle
from pages import figure, under
from table_4 import sections

ALPHAS = (0.5, 1.0, 2.0)
COLOURS = (style.GREEN, style.BLUE, style.PURPLE)
COUNT = 6  # neighbours shown on either curve


def neighbours(alpha):
    """On the circle, by even angles, and on the parabola, by even distances; none at the vertex itself."""
    turn = numpy.linspace(0, 2 * numpy.pi, COUNT + 2)[1:-1]
    ball = numpy.stack([numpy.sin(turn), numpy.cos(turn) - 1], 1) / alpha
    across = numpy.array([-2.1, -1.4, -0.7, 0.7, 1.4, 2.1]) / numpy.sqrt(alpha)
    return ball, numpy.stack([across, -alpha / 2 * across**2], 1)


def make(library, folder):
    drawing, axes = style.panels(1, 2, 9.4, 4.6, plain=True, gridspec_kw={"wspace": 0.05})
    worst = 0.0
    for alpha, colour in zip(ALPHAS, COLOURS):
        for axis, letter, points in zip(axes.flat, ("C", "SP"), neighbours(alpha)):
            # The library computes in space: the plane of the picture is that of x and z.
            edges = numpy.insert(points, 1, 0.0, axis=1)
            found, ordered = sections(library, edges[None])
            worst = max(worst, float(numpy.abs(found[letter] - alpha).max()))
            axis.plot(*ordered[:, [0, 2]].T, "o", color=colour, markersize=5)
        circle(axes[0, 0], 1 / alpha, (0, -1 / alpha), color=colour, linestyle="-", linewidth=1.4)
        x = numpy.linspace(-2.3, 2.3, 161) / numpy.sqrt(alpha)
        axes[0, 1].plot(x, -alpha / 2 * x**2, color=colour, linewidth=1.4, label=rf"$\alpha$ = {alpha:g}")
    for axis, letter in zip(axes.flat, ("C", "SP")):
        axis.plot(0, 0, "o", color=style.RED, markersize=7, zorder=5)
        axis.annotate(
            "$p$", (0, 0), xytext=(0, 8), textcoords="offset points", ha="center", color=style.RED, fontsize=12
        )
        style.arrow(axis, (0, 0), (0, -0.62), style.RED)
        axis.annotate("$N$", (0.07, -0.5), color=style.RED, fontsize=11)
        axis.text(0, 0.62, rf"neighbours with {style.kappa(letter)} = $\alpha$", ha="center", fontsize=11)
        axis.set(xlim=(-3.1, 3.1), ylim=(-4.1, 0.9))
    axes[0, 1].legend(loc="upper left", bbox_to_anchor=(0.0, 0.85))
    style.save(drawing, folder, "figure07.svg")
    return figure(
        "Figure 7: the set of points with curvature α",
        "figure07.svg",
        f"""
Left, the paper's figure: neighbours on a circle through p give the section along the edge to them the same κ_C,
whatever the angle. Right, the same for κ_SP: parabolas. The library's curvatures at the dots are α within
{under(worst)}.
""",
    )
