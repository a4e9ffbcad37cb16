"""Figure 5: mean value coordinates against barycentric ones, on a convex and a concave polygon."""

import coordinates
import numpy
import style
from pages import figure, significant, table
from polyhedra import regular_polygon

EXTENT, SAMPLES, DENSER = 1.45, 260, 3
CONVEX = regular_polygon(7)  # its first vertex is on the y axis
CONCAVE = CONVEX * numpy.array([1, 1, 0.4, 1, 1, 0.4, 1])[:, None]
POLYGONS = {"convex": CONVEX, "concave": CONCAVE}
KINDS = {
    "mean value": coordinates.mean_value,
    "Wachspress": lambda *case: coordinates.normalised(coordinates.wachspress_weights(*case))[0],
    "discrete harmonic": lambda *case: coordinates.normalised(coordinates.harmonic_weights(*case))[0],
}
SHOWN = ("mean value", "Wachspress")
LIMIT = 1.0  # of the colours
COLOURS = style.pyplot.get_cmap("RdBu_r", 40)  # two between lines


def grid(samples):
    """Points of the picture, none of them on an axis of symmetry."""
    line = EXTENT * ((2 * numpy.arange(samples) + 1.03) / samples - 1)
    return numpy.stack(numpy.meshgrid(line, line), -1)


def inside(polygon, points):
    """By the winding of the polygon around the points."""
    corners = coordinates.Corners(polygon, points)
    return numpy.abs(numpy.arctan2(corners.crosses, corners.dots).sum(-1)) > numpy.pi


def steps(values):
    """The largest difference between neighbouring samples."""
    return max(float(numpy.nanmax(numpy.abs(numpy.diff(values, axis=axis)))) for axis in (0, 1))


def draw(folder):
    points = grid(SAMPLES)
    drawing, axes = style.panels(2, 2, 6.9, 7.9, layout="constrained")
    for row, kind in zip(axes, SHOWN):
        for axis, (name, polygon) in zip(row, POLYGONS.items()):
            values = numpy.clip(KINDS[kind](polygon, points)[..., 0], -3, 3)
            image = axis.imshow(
                values, cmap=COLOURS, vmin=-LIMIT, vmax=LIMIT, origin="lower", extent=[-EXTENT, EXTENT] * 2
            )
            levels = numpy.arange(-10, 11) / 10
            axis.contour(*points.transpose(2, 0, 1), values, levels, colors="black", linewidths=0.45, linestyles="-")
            axis.plot(*numpy.concatenate([polygon, polygon[:1]]).T, color="black", linewidth=1.8)
            axis.plot(*polygon[0], "o", color=style.GREEN, markersize=8, markeredgecolor="black")
            axis.set(xticks=[], yticks=[], title=f"{kind}, {name}")
            axis.grid(False)
            axis.spines[:].set_visible(True)
    drawing.colorbar(
        image, ax=axes, location="bottom", shrink=0.5, aspect=30, extend="both", ticks=[-1, -0.5, 0, 0.5, 1]
    )
    style.save(drawing, folder, "figure05.png")


def row(name, polygon, kind):
    """What one coordinate is like inside and everywhere."""
    inner, everywhere, spans = [], [], []
    for samples in (SAMPLES, DENSER * SAMPLES):
        points = grid(samples)
        values = KINDS[kind](polygon, points)[..., 0]
        within = inside(polygon, points)
        spans.append(f"{values[within].min():.3f} to {values[within].max():.3f}")
        inner.append(steps(numpy.where(within, values, numpy.nan)))
        everywhere.append(steps(values))
    told = [
        " → ".join(map(significant, pair)) + (", a pole" if pair[1] > pair[0] else "") for pair in (inner, everywhere)
    ]
    return [name, kind, "unbounded" if inner[1] > inner[0] else spans[1], *told]


def make(library, folder):
    draw(folder)
    rows = [row(name, polygon, kind) for name, polygon in POLYGONS.items() for kind in KINDS]
    return figure(
        "Figure 5: mean value coordinates vs. barycentric coordinates",
        "figure05.png",
        f"""
The coordinate of the marked vertex of a regular 7-gon and of a concave one, over the polygon and its surroundings:
red is positive, blue negative, white 0; colours end at ±{LIMIT:.0f}, and lines are 0.1 apart. The paper does not say
which barycentric coordinates it means. Below are Wachspress's, the classical ones; the discrete harmonic ones, in the
table as well, are the same on polygons in a circle. The largest step is that between neighbouring samples, and then
the same with samples {DENSER} times as dense: it falls where the coordinate is continuous, and grows where it has a
pole.
""",
        table(["polygon", "coordinates", "range inside", "largest step inside", "largest step in the picture"], rows),
    )
