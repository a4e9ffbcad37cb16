"""The library, through its C interface: tests/peers/umbilic.py, and the curvatures of polylines, which that lacks."""

import ctypes

import numpy
import places  # noqa: F401
from polyhedra import TETRAHEDRON, TETRAHEDRON_FACES
from umbilic import Output, Run, StatusOutput, Umbilic, address, output, pointer, size, sized, struct, u32

# The paper's normals, in the order of its tables, and what the library calls them. N_M is the area weight that the
# paper prints, N_C the weight 1/g² with which its tables were made.
PAPER = {"N_G": "uniform", "N_T": "angle", "N_M": "area", "N_C": "centroid", "N_CM": "conformal"}
# The paper's curvatures of polygons; it names the parabola by lengths without carrying it out.
FORMULAS = {"C": "circle", "P": "parabola", "PL": "length_parabola", "SP": "symmetric_parabola"}

Polyline = struct(
    "Polyline", data=pointer, count=size, stride=size, scalar=u32, dimension=u32, closed=u32, reserved=u32
)
PolylineOptions = struct("PolylineOptions", struct_size=u32, reserved=u32, run=Run)
PolylineOutputs = struct(
    "PolylineOutputs", struct_size=u32, reserved=u32, **dict.fromkeys(FORMULAS.values(), Output), status=StatusOutput
)


class Library(Umbilic):
    def polyline(self, points, closed=True):
        """The four curvatures at every point, `#V` each, by the letters that the paper gives them."""
        points = numpy.ascontiguousarray(points, float)
        view = Polyline(
            data=address(points), count=len(points), scalar=1, dimension=points.shape[1], closed=int(closed)
        )
        results = {letter: output(len(points), 1, "f64") for letter in FORMULAS}
        outputs = sized(PolylineOutputs, **{FORMULAS[letter]: field for letter, (_, field) in results.items()})
        arguments = (view, sized(PolylineOptions), outputs)
        self.call("umb_polyline_curvatures", *map(ctypes.byref, arguments))
        return {letter: values for letter, (values, _) in results.items()}

    def corner(self, a, b, c):
        """The four curvatures of one corner."""
        return {letter: float(values[1]) for letter, values in self.polyline([a, b, c], closed=False).items()}

    def knows(self, method=None, weight=None):
        """Whether this build has a method of curvature or a weight: its number may be there before it is."""
        try:
            with self.mesh(TETRAHEDRON_FACES, 4) as mesh:
                if method:
                    mesh.curvatures(TETRAHEDRON, method, ("gaussian",))
                else:
                    mesh.normals(TETRAHEDRON, weight)
        except (KeyError, RuntimeError):
            return False
        return True

    def normals(self, positions, faces, weight, **options):
        """Vertex normals of a mesh of which nothing else is wanted."""
        with self.mesh(faces, len(positions)) as mesh:
            return mesh.normals(positions, weight, **options)[0]
