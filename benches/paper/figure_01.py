"""Figure 1: the same corner, cut up in different ways."""

import numpy
import style
from figure_15 import degrees_off
from pages import figure, table
from render import View

SHOWN = {"N_G": "uniform", "N_C": "centroid", "N_T": "angle", "N_CM": "conformal"}
VIEW = View((1, 0.3, 0.4))
WIDTHS = {"N_T": 5.0, "N_CM": 1.4}  # which agree, or nearly: one on top of the other
# The top of the corner of a cube, as seen from above: fans around (0, 0), whose edges are 1 long.
TOPS = {
    "1 triangle": [(-1, 0), (0, -1)],
    "2 triangles": [(-1, 0), (-1, -1), (0, -1)],
    "4 triangles": [(-1, 0), (-1, -0.5), (-1, -1), (-0.5, -1), (0, -1)],
}


def corner(top):
    """The open corner: the top's fan, and one triangle of either side."""
    rim = [(x, y, 0.0) for x, y in top] + [(0.0, 0.0, -1.0)]
    count = len(rim)
    faces = [[0, 1 + i, 1 + (i + 1) % count] for i in range(count)]
    return numpy.array([(0.0, 0.0, 0.0), *rim]), numpy.array(faces)


def draw(axis, positions, faces, normals):
    flat = VIEW.project(positions)
    shades = {2: "#dde8f3", 1: "#bccfe2", 0: "#a5bcd3"}  # by the side that a face is on
    for face in faces:
        spanned = numpy.ptp(positions[face], axis=0)
        axis.fill(*flat[face].T, facecolor=shades[int(spanned.argmin())], edgecolor=style.BLACK, linewidth=1.0)
    for name, normal in normals.items():
        style.arrow(axis, flat[0], flat[0] + 1.45 * VIEW.project(normal), style.WEIGHT[name], lw=WIDTHS.get(name, 2))
    axis.plot(*flat[0], "o", color=style.BLACK, markersize=4)


def make(library, folder):
    drawing, axes = style.panels(1, 3, 9.6, 3.4, plain=True, gridspec_kw={"wspace": 0.02})
    rows = {name: [name] for name in SHOWN}
    for axis, (title, top) in zip(axes.flat, TOPS.items()):
        positions, faces = corner(top)
        normals = {name: library.normals(positions, faces, weight)[0] for name, weight in SHOWN.items()}
        draw(axis, positions, faces, normals)
        axis.set(title=f"top in {title}", xlim=(-1.05, 1.05), ylim=(-0.95, 1.3))
        for name, normal in normals.items():
            rows[name].append(f"{degrees_off(normal):.2f}")
    handles = [
        style.pyplot.Line2D([], [], color=style.WEIGHT[name], linewidth=WIDTHS.get(name, 2), label=style.name(name))
        for name in SHOWN
    ]
    drawing.legend(handles=handles, loc="lower center", ncols=len(SHOWN), bbox_to_anchor=(0.5, -0.07))
    style.save(drawing, folder, "figure01.svg")
    return figure(
        "Figure 1: the change of normal vector according to the topology",
        "figure01.svg",
        """
The corner of a cube, the same shape three times. The paper shows such a case against N_G, and names N_T as the
remedy. Degrees between the normal and the diagonal:
""",
        table(["normal", *(f"top in {title}" for title in TOPS)], list(rows.values())),
    )
