"""Pictures of a mesh: its raster is made once, and shaded by each estimator's values."""

import matplotlib
import numpy
from render import Picture

MAP = matplotlib.colormaps["RdBu_r"]
CLAY = numpy.array([0.78, 0.74, 0.69])


class Frame:
    """A mesh as it is seen whole, or close up; `wide` is the width of the square that it is drawn in, in pixels."""

    def __init__(self, mesh, wide, closeup=False):
        self.view = mesh.view
        flat = self.view.project(mesh.positions)
        low, high = flat.min(0), flat.max(0)
        half = (high - low).max() / 2
        middle = (low + high) / 2
        if closeup:
            middle = low + mesh.closeup.middle * (high - low)
            half *= mesh.closeup.across
        shift = middle @ numpy.stack([self.view.right, self.view.up])
        self.picture = Picture(self.view, mesh.positions - shift, mesh.faces, wide, half * (1 if closeup else 1.01), 3)
        corners = mesh.positions[mesh.faces]
        normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        self.flat = unit(normals)[self.picture.face]

    def light(self, right, up, towards):
        return unit(right * self.view.right + up * self.view.up + towards * self.view.towards)

    def curvature(self, mean, limit):
        """Colours of values from -limit to limit, on flat faces lit from the viewer."""
        value = self.picture.interpolate(mean[:, None])[..., 0]
        shade = 0.62 + 0.38 * numpy.clip(self.flat @ self.light(0.25, 0.35, 1), 0, 1)
        return self.cropped(MAP(0.5 + 0.5 * numpy.clip(value / limit, -1, 1))[..., :3] * shade[..., None])

    def lit(self, normals):
        """Phong's shading with vertex normals, lit from the side."""
        normal = unit(self.picture.interpolate(normals))
        light = self.light(-0.7, 0.75, 1)
        halfway = unit(light + self.view.towards)
        diffuse = numpy.clip(normal @ light, 0, 1)[..., None]
        shine = numpy.clip(normal @ halfway, 0, 1)[..., None] ** 60
        return self.cropped(CLAY * (0.2 + 0.8 * diffuse) + 0.35 * shine)

    def marked(self, marks):
        """Vertices that are marked, and those parts of faces that are nearest to them."""
        near = numpy.take_along_axis(
            self.picture.faces[self.picture.face], self.picture.weights.argmax(-1)[..., None], -1
        )[..., 0]
        shade = 0.62 + 0.38 * numpy.clip(self.flat @ self.light(0.25, 0.35, 1), 0, 1)
        colours = numpy.where(marks[near][..., None], [0.82, 0.33, 0.0], [0.93, 0.94, 0.95])
        return self.cropped(colours * shade[..., None])

    def cropped(self, colours):
        """Without the empty rows and columns around the mesh."""
        pixels = self.picture.finish(colours)
        seen = self.picture.finish(numpy.zeros_like(colours))[..., 0] < 1
        rows, columns = numpy.flatnonzero(seen.any(1)), numpy.flatnonzero(seen.any(0))
        return pixels[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]


def unit(vectors):
    """Zero stays zero."""
    length = numpy.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / numpy.where(length > 0, length, 1)
