"""The library, through its Python package, in the paper's words."""

import places  # noqa: F401
import umbilic

# The paper's normals, in the order of its tables, and what the library calls them. N_M is the area weight that the
# paper prints, N_C the weight 1/g² with which its tables were made.
PAPER = {"N_G": "uniform", "N_T": "angle", "N_M": "area", "N_C": "centroid", "N_CM": "conformal"}
# The paper's curvatures of polygons; it names the parabola by lengths without carrying it out.
FORMULAS = {"C": "circle", "P": "parabola", "PL": "length_parabola", "SP": "symmetric_parabola"}


class Library:
    def polyline(self, points, closed=True):
        """The four curvatures at every point, `#V` each, by the letters that the paper gives them."""
        found = umbilic.polyline_curvatures(points, closed=closed)
        return {letter: getattr(found, name) for letter, name in FORMULAS.items()}

    def corner(self, a, b, c):
        """The four curvatures of one corner."""
        return {letter: float(values[1]) for letter, values in self.polyline([a, b, c], closed=False).items()}

    def normals(self, positions, faces, weight):
        """Vertex normals of a mesh of which nothing else is wanted."""
        return umbilic.vertex_normals(positions, faces, weight=weight).normal
