"""Figure 15: the corner of an irregularly triangulated cube, shaded by interpolated vertex normals."""

import numpy
import style
from pages import figure, paragraphs, table
from render import Picture, View
from polyhedra import CUTS, cube, unit

SHOWN = {"N_G": "uniform", "N_C": "centroid", "N_CM": "conformal", "N_T": "angle", "Max": "max"}
LISTED = SHOWN | {"N_C as printed": "centroid-area", "N_M": "area"}
PIXELS, EXTENT = 300, 1.72  # 1.72: the whole cube
SHININESS = 40
BASE = numpy.array([0.15, 0.30, 0.52])
DIAGONAL = unit(numpy.ones(3))  # of camera, light, and so of the normal that reflects most
VIEW = View(DIAGONAL)


def shine(picture, normals):
    """The specular part at every sample, from normals interpolated and normalised there."""
    normal = picture.interpolate(normals)
    length = numpy.linalg.norm(normal, axis=-1)
    facing = normal @ DIAGONAL / numpy.where(picture.face >= 0, length, 1)
    return facing, numpy.where(picture.face >= 0, numpy.clip(facing, 0, 1) ** SHININESS, 0)


def phong(picture, normals):
    facing, specular = shine(picture, normals)
    diffuse = numpy.clip(facing, 0, 1)[..., None]
    return picture.finish(BASE * (0.25 + 0.75 * diffuse) + 0.65 * specular[..., None])


def wireframe(picture):
    line = picture.wires(1.4)[..., None]
    return picture.finish(numpy.array([0.93, 0.95, 0.97]) * (1 - line) + numpy.array([0.1, 0.16, 0.25]) * line)


class Highlight:
    """Where the highlight is in a picture, in pixels to the right of the corner and above it: its brightest point, the
    centre of mass of all of it; and the light at the corner itself, of 1."""

    def __init__(self, picture, normals):
        facing, specular = shine(picture, normals)
        facing = numpy.where(picture.face >= 0, facing, -1)
        row, column = numpy.unravel_index(facing.argmax(), facing.shape)
        rows, columns = numpy.indices(specular.shape)
        middle = picture.screen[0]
        self.peak = (numpy.array([column, row]) - middle) * [1, -1] / picture.samples
        mean = numpy.array([(columns * specular).sum(), (rows * specular).sum()]) / specular.sum()
        self.mass = (mean - middle) * [1, -1] / picture.samples
        self.corner = float(max(normals[0] @ DIAGONAL, 0) ** SHININESS)


def degrees_off(normal):
    return float(numpy.degrees(2 * numpy.arcsin(min(numpy.linalg.norm(normal - DIAGONAL) / 2, 1))))


def shift(upwards):
    """Pixels, with a word for the direction; less than half a sample is nothing."""
    return "0" if abs(upwards) < 0.13 else f"{abs(upwards):.1f} {'up' if upwards > 0 else 'down'}"


def components(normal):
    """As ratios, the smallest 1."""
    return " : ".join(f"{value:.3f}".rstrip("0").rstrip(".") for value in normal / numpy.abs(normal).min())


def off_by_cut(library):
    """The error at the corner in degrees, and the normal there, of every weight under every cut."""
    result = {}
    for cut in CUTS:
        positions, faces = cube(cut)
        for name, weight in LISTED.items():
            normal = library.normals(positions, faces, weight)[0]
            result[name, cut] = degrees_off(normal), normal
    return result


def make(library, folder):
    positions, faces = cube(CUTS[0])
    picture = Picture(VIEW, positions, faces, PIXELS, EXTENT)
    drawing, axes = style.panels(2, 3, 10.2, 7.2, plain=True, gridspec_kw={"wspace": 0.04, "hspace": 0.1})
    axes[0, 0].imshow(wireframe(picture))
    axes[0, 0].set_title("the mesh", pad=3)
    middle = picture.screen[0] / picture.samples
    rows = []
    for axis, (name, weight) in zip(axes.flat[1:], SHOWN.items()):
        normals = library.normals(positions, faces, weight)
        found = Highlight(picture, normals)
        axis.imshow(phong(picture, normals))
        axis.plot(*middle, "+", color="black", markersize=13, markeredgewidth=1.2)
        axis.plot(*(middle + found.peak * [1, -1]), "o", color=style.RED, markersize=7, fillstyle="none")
        off = degrees_off(normals[0])
        told = "exact" if off < 1e-6 else f"{off:.1f}° off"
        axis.set_title(f"{style.name(name)}: {told}", pad=3)
        rows.append(
            [
                name,
                components(normals[0]),
                f"{off:.2f}",
                shift(found.peak[1]),
                shift(found.mass[1]),
                f"{found.corner:.2f}",
            ]
        )
    style.save(drawing, folder, "figure15.png")
    heads = [
        "normal",
        "components x : y : z",
        "off by, degrees",
        "brightest point, pixels",
        "centre of the highlight, pixels",
    ]
    off = off_by_cut(library)
    cuts = [[name, *(f"{off[name, cut][0]:.2f}" for cut in CUTS)] for name in LISTED]
    cuts += [["N_CM, x : y : z", *(components(off["N_CM", cut][1]) for cut in CUTS)]]
    x, _, z = off["N_CM", CUTS[2]][1]
    return figure(
        "Figure 15: results of rendering",
        "figure15.png",
        """
The cube's corner in the middle (+) is in four triangles of the top and in one of either side, as the paper tells of
its figure; the figure is lost, and here the four triangles end at the middles of the far edges and at the far corner.
Vertex normals by umbilic, interpolated and normalised at every pixel (Phong), camera and light both far away along
the diagonal. The normal that belongs to the corner is (1, 1, 1)/√3, and with it the highlight is brightest at the +;
where it is brightest with the weight's normal is circled. Everything is mirror symmetric, so highlights move up or
down only.
""",
        table([*heads, "highlight at the corner, of 1"], rows),
        paragraphs(f"""
Pixels of a picture {PIXELS} pixels wide, in which the cube's edges are {2 * numpy.sqrt(2 / 3) / picture.pixel:.0f}
pixels long; of a light that falls off as the cosine to the power of {SHININESS}.

How far off the corner's normal is depends on where the four triangles end. In degrees:
"""),
        table(["normal", *CUTS], cuts),
        paragraphs(f"""
With even angles and lengths N_CM is {3.86 * z / x:.2f} : 3.86 : 3.86, upwards first. N_T is exact in all three: the
angles of a flat face add up to the same, however it is cut. The paper shows N_G, N_C and N_CM only.
"""),
    )
