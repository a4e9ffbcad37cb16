"""Figure 6: a ring flattened."""

import numpy
import style
from pages import figure, table
from render import View

VIEW = View((0.45, -1.0, 1.15))
# A ring's neighbours: direction around the z axis, distance from it, height below the vertex.
RING = [(20, 1.0, -0.45), (85, 0.8, -0.5), (140, 1.2, -0.75), (205, 0.9, -0.35), (262, 1.1, -0.65), (318, 0.75, -0.4)]


def ring():
    degrees, distance, height = numpy.array(RING).T
    angles = numpy.radians(degrees)
    return numpy.stack([distance * numpy.cos(angles), distance * numpy.sin(angles), height], 1)


def flattened(edges):
    """The neighbours in the plane, and the angles before and after."""
    after = numpy.roll(edges, -1, 0)
    theta = numpy.arctan2(numpy.linalg.norm(numpy.cross(edges, after), axis=1), (edges * after).sum(1))
    alpha = 2 * numpy.pi * theta / theta.sum()
    directions = numpy.radians(RING[0][0]) + numpy.concatenate([[0], numpy.cumsum(alpha)[:-1]])
    lengths = numpy.linalg.norm(edges, axis=1)
    return lengths[:, None] * numpy.stack([numpy.cos(directions), numpy.sin(directions)], 1), theta, alpha


def make(library, folder):
    edges = ring()
    plane, theta, alpha = flattened(edges)
    drawing, axes = style.panels(1, 2, 8.4, 3.8, plain=True, gridspec_kw={"wspace": 0.05})
    left, right = axes.flat
    flat = VIEW.project(edges)
    order = numpy.argsort((edges + numpy.roll(edges, -1, 0)) @ VIEW.towards)  # the farthest faces first
    light = numpy.array([0.5, -0.2, 0.84])
    for index in order:
        following = (index + 1) % len(edges)
        normal = numpy.cross(edges[index], edges[following])
        shade = 0.68 + 0.3 * max(normal @ light / numpy.linalg.norm(normal), 0)
        corners = numpy.array([(0, 0), flat[index], flat[following]])
        left.fill(*corners.T, facecolor=(0.9 * shade, 0.96 * shade, shade), edgecolor=style.BLACK, linewidth=1.2)
    right.fill(*plane.T, facecolor=style.PALE, edgecolor=style.BLACK, linewidth=1.2)
    for point in plane:
        right.plot(*zip((0, 0), point), color=style.BLACK, linewidth=1.2)
    for axis, points, centre, name in ((left, flat, "V", "V"), (right, plane, "P", "U")):
        for index, point in enumerate(points):
            axis.plot(*point, "o", color=style.BLACK, markersize=4)
            axis.text(
                *(point * (1 + 0.15 / numpy.linalg.norm(point))), f"${name}_{index + 1}$", ha="center", va="center"
            )
        axis.plot(0, 0, "o", color=style.RED, markersize=6)
        axis.annotate(f"${centre}$", (0, 0), xytext=(6, 8), textcoords="offset points", color=style.RED, fontsize=12)
    for axis, title, angles in ((left, "(a) 3D mesh", theta), (right, "(b) 2D polygon", alpha)):
        axis.text(0, 1.45, f"{title}: angles {numpy.degrees(angles.sum()):.0f}°", ha="center", fontsize=10.5)
        axis.set(xlim=(-1.35, 1.35), ylim=(-1.3, 1.6))
    style.save(drawing, folder, "figure06.svg")
    rows = [
        [name, *(f"{angle:.1f}°" for angle in numpy.degrees(angles)), f"{numpy.degrees(angles.sum()):.1f}°"]
        for name, angles in (("θ_i", theta), ("α_i = 2π θ_i / Σ θ_j", alpha))
    ]
    return figure(
        "Figure 6: conformal mapping",
        "figure06.svg",
        """
A ring and its image in the plane, by which N_CM takes its weights: edges keep their lengths, and angles are scaled so
that they go around once. (The paper prints α_i without θ_i.)
""",
        table(["angle", *map(str, range(1, len(RING) + 1)), "sum"], rows),
    )
