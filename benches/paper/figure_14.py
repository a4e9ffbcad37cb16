"""Figure 14: the spheres of tables 2 and 3."""

import numpy
import style
from pages import figure
from render import Picture, View
from polyhedra import tetrahedron_sphere
from table_3 import meshes

PIXELS = 230
LIGHT = numpy.array([0.35, -0.45, 0.82])


def picture(positions, faces):
    """Flat faces with their edges."""
    taken = Picture(View((1, -0.55, 0.5)), positions, faces, PIXELS, 1.03)
    corners = positions[faces]
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= numpy.linalg.norm(normals, axis=1)[:, None]
    shade = 0.45 + 0.55 * numpy.clip(normals @ LIGHT, 0, 1)
    colours = shade[taken.face][..., None] * numpy.array([0.80, 0.88, 0.96])
    line = taken.wires(1.0 if len(faces) < 3000 else 0.7)[..., None] * 0.8
    return taken.finish(colours * (1 - line) + numpy.array([0.10, 0.16, 0.25]) * line)


def make(library, folder):
    rows = [[tetrahedron_sphere(level) for level in range(1, 6)], list(meshes().values())]
    drawing, axes = style.panels(2, 5, 12.2, 5.2, plain=True, gridspec_kw={"wspace": 0.03, "hspace": 0.12})
    for row, line in zip(axes, rows):
        for axis, (positions, faces) in zip(row, line):
            axis.imshow(picture(positions, faces))
            axis.set_title(f"{len(positions)} vertices", fontsize=10, pad=3)
    style.save(drawing, folder, "figure14.png", colours=64)
    return figure(
        "Figure 14: approximated spheres",
        "figure14.png",
        """
Above: a tetrahedron subdivided 1 to 5 times, each midpoint pushed to the sphere (table 2; the paper's own rule is not
told). Below: by longitude and latitude (table 3, whose figures show that these are the paper's meshes). Not among
them: the tetrahedron itself.
""",
    )
