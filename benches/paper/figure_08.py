"""Figure 8: corners that sharpen, with edges of length 1."""

import numpy
import style
from pages import figure

SHOWN = (150, 90, 45, 15)


def corner(degrees):
    """A corner at the origin, its edges upwards to both sides."""
    half = numpy.radians(degrees) / 2
    return numpy.array([(-numpy.sin(half), numpy.cos(half)), (0, 0), (numpy.sin(half), numpy.cos(half))])


def make(library, folder):
    angles = numpy.concatenate([numpy.geomspace(1, 90, 120), numpy.linspace(90.5, 179.5, 179)])
    found = [library.corner(*corner(angle)) for angle in angles]
    drawing = style.pyplot.figure(figsize=(9.2, 3.7))
    plot = drawing.add_axes((0.0, 0.0, 0.5, 1.0))
    for letter in ("C", "SP"):
        values = [each[letter] for each in found]
        plot.plot(angles, values, color=style.FORMULA[letter], label=style.kappa(letter))
    plot.axhline(2, color=style.BLUE, linestyle=":", linewidth=1.2)
    plot.annotate("2 / |AB|", (178, 2.25), color=style.BLUE, ha="right")
    plot.set(yscale="log", xlabel="angle of the corner, degrees", ylabel="curvature", xlim=(0, 180), ylim=(0.01, 3e4))
    plot.set_xticks(range(0, 181, 30))
    plot.legend(loc="upper right")
    for index, degrees in enumerate(SHOWN):
        axis = drawing.add_axes((0.54 + 0.24 * (index % 2), 0.52 * (1 - index // 2), 0.22, 0.46))
        points = corner(degrees)
        values = library.corner(*points)
        axis.plot(*points.T, color=style.BLACK, marker="o", markersize=5)
        axis.set(aspect="equal", xlim=(-1.1, 1.1), ylim=(-0.75, 1.1))
        axis.axis("off")
        told = ", ".join(f"{style.kappa(letter)} = {values[letter]:.3g}" for letter in ("C", "SP"))
        axis.text(0, -0.45, f"{degrees}°\n{told}", ha="center", va="center", fontsize=9.5)
    style.save(drawing, folder, "figure08.svg")
    return figure(
        "Figure 8: a counter-example of C-discrete curvature",
        "figure08.svg",
        f"""
Corners between two edges of length 1. However sharp they become, κ_C stays below 2/|AB|, here
{max(each["C"] for each in found):.4f} at most; κ_SP grows without bound, to {max(each["SP"] for each in found):.3g}
at 1°.
""",
    )
