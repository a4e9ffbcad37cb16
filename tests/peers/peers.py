#!/usr/bin/env python3
"""Compares the vertex normals of umbilic with those of libigl and of VCG (through PyMeshLab) on real meshes.

    pip install -r tests/peers/requirements.txt
    python3 tests/peers/peers.py "$(tests/peers/meshes.sh target/meshes)"

Arguments are mesh files (OFF, OBJ, PLY) or directories; of a directory, the meshes that meshes.txt names are
taken. All three libraries are handed the same arrays. Polygons are cut into triangles by a fan from their first corner,
because libigl and VCG know triangles only.

Both peers compute in double precision. Against them umbilic has to come out within 1e-12 in double precision, and
within 1e-6 in single precision, where the peers get the rounded coordinates. A vertex that differs by more has to have
one of these causes, each computed from the mesh, or the comparison fails:

    isolated   no face uses the vertex: umbilic says so and answers zero, VCG zero, libigl divides 0 by 0
    cancelled  the normals around the vertex add up to nothing: umbilic says so and answers with a simpler weight,
               the peers with what rounding left, zero or NaN
    rounding   the difference is within the rounding error of the peer's arithmetic: `a x b` of a sliver keeps few
               digits of its direction, and a sum much shorter than its terms loses as many
    acos       the same, with the error of taking the angle as the arc cosine of a dot product, as VCG does: near 0
               and pi it keeps half the digits
"""

import sys
from importlib.metadata import version
from pathlib import Path

import bindings  # noqa: F401
import igl
import numpy
import pymeshlab
import umbilic

DEGENERATE, FALLBACK, ISOLATED = (int(umbilic.VertexStatus[name]) for name in ("DEGENERATE", "FALLBACK", "ISOLATED"))

SCALARS = {"f32": (numpy.float32, 1e-6), "f64": (numpy.float64, 1e-12)}  # with tolerance
CAUSES = ("isolated", "cancelled", "rounding", "acos")
ROUNDING = 2 * numpy.finfo(float).eps  # what a term of a few operations may lose, relative to its operands


# The peers. Each answers with normals in double precision.


class Libigl:
    name = "libigl"
    weights = ("uniform", "angle", "area")
    takes_acos = False

    def __init__(self, positions, triangles):
        self.positions, self.triangles = positions, triangles

    def normals(self, weight):
        weighting = getattr(igl, f"PER_VERTEX_NORMALS_WEIGHTING_TYPE_{weight.upper()}")
        return igl.per_vertex_normals(self.positions, self.triangles, weighting)


class Vcg:
    name = "VCG"
    weights = ("uniform", "angle", "area", "max")
    takes_acos = True
    modes = {"uniform": "Simple Average", "angle": "By Angle", "area": "By Area", "max": "As defined by N. Max"}

    def __init__(self, positions, triangles):
        self.meshes = pymeshlab.MeshSet(verbose=False)
        self.meshes.add_mesh(pymeshlab.Mesh(positions, triangles))
        mesh = self.meshes.current_mesh()
        # Filters of MeshLab like to merge and drop elements; and a build in single precision would round here.
        kept = numpy.array_equal(mesh.vertex_matrix(), positions) and numpy.array_equal(mesh.face_matrix(), triangles)
        if not kept:
            raise RuntimeError("PyMeshLab changed the mesh")

    def normals(self, weight):
        self.meshes.compute_normal_per_vertex(weightmode=self.modes[weight])
        return self.meshes.current_mesh().vertex_normal_matrix()


# How exactly a vertex normal can be told in double precision.


class Corners:
    """The corners of all triangles, `#F x 3`, in extended precision where the machine has it."""

    def __init__(self, positions, triangles):
        at = positions.astype(numpy.longdouble)[triangles]
        a, b = numpy.roll(at, -1, 1) - at, numpy.roll(at, 1, 1) - at
        cross = numpy.cross(a, b)
        self.vertex_count, self.vertices = len(positions), triangles
        self.double_area = length(cross)
        self.product = length(a) * length(b)
        self.angle = numpy.arctan2(self.double_area, (a * b).sum(-1))
        self.normal = divide(cross, self.double_area[..., None])

    def weight(self, name):
        if name == "uniform":
            return numpy.ones_like(self.angle)
        if name == "max":
            return divide(self.double_area, self.product**2)
        return {"angle": self.angle, "area": self.double_area}[name]

    def rounding(self, name):
        """To first order, how much each term of a sum may be off: `a x b` by units in the last place of |a| |b|."""
        # A peer may compute it at any corner of the triangle.
        cross_error = ROUNDING * self.product.max(1)[:, None]
        if name in ("area", "max"):
            return cross_error * (1 if name == "area" else divide(1, self.product**2))
        # A unit vector is never off by more than 2.
        return self.weight(name) * numpy.minimum(divide(cross_error, self.double_area, numpy.inf), 2)

    def sum(self, terms):
        """Terms of corners, added up at their vertices."""
        result = numpy.zeros((self.vertex_count,) + terms.shape[2:], numpy.longdouble)
        numpy.add.at(result, self.vertices, terms)
        return result


def length(vectors):
    return numpy.sqrt((vectors * vectors).sum(-1))


def divide(a, b, otherwise=0):
    """`a / b`, and `otherwise` where b is zero."""
    return numpy.where(b == 0, otherwise, a / numpy.where(b == 0, 1, b))


def error_bounds(corners, weight):
    """For each vertex: |sum| / sum of |terms|, a bound of the error by rounding, and of that by acos."""
    weights = corners.weight(weight)
    total = length(corners.sum(weights[..., None] * corners.normal))
    remainder = divide(total, corners.sum(weights))
    rounding = divide(corners.sum(corners.rounding(weight)), total, numpy.inf)
    # An error of the cosine moves the angle by its part of the sine, at most by its root.
    angle_error = ROUNDING / numpy.maximum(numpy.sin(corners.angle), ROUNDING**0.5)
    acos = divide(corners.sum(angle_error), total, numpy.inf) if weight == "angle" else 0 * total
    return remainder, rounding, acos


# The comparison.


def explain(differences, statuses, tolerance, bounds, takes_acos):
    """How many differences above the tolerance have which cause, the largest below it, and the vertices without one."""
    remainder, rounding, acos = bounds
    conditions = {
        "isolated": statuses & ISOLATED != 0,
        "cancelled": (statuses & (FALLBACK | DEGENERATE) != 0) & (remainder < 1e-12),
        "rounding": differences <= rounding,
        "acos": differences <= rounding + acos if takes_acos else numpy.zeros(len(statuses), bool),
    }
    unexplained = ~(differences <= tolerance)  # also where the peer answers NaN
    counts = {}
    for cause in CAUSES:
        counts[cause] = int((unexplained & conditions[cause]).sum())
        unexplained = unexplained & ~conditions[cause]
    agreeing = differences[differences <= tolerance]
    return counts, agreeing.max(initial=0.0), numpy.flatnonzero(unexplained)


def compare(name, positions, triangles):
    """Prints a line for each scalar and peer; answers with the numbers of comparisons that passed and failed."""
    passed = failed = 0
    for scalar, (dtype, tolerance) in SCALARS.items():
        rounded = positions.astype(dtype).astype(float)
        corners = Corners(rounded, triangles)
        for peer in (Libigl(rounded, triangles), Vcg(rounded, triangles)):
            largest, totals, bad = 0.0, dict.fromkeys(CAUSES, 0), []
            for weight in peer.weights:
                normals, statuses = umbilic.vertex_normals(positions.astype(dtype), triangles, weight=weight)
                theirs = peer.normals(weight)
                differences = length(normals - theirs)
                bounds = error_bounds(corners, weight)
                counts, agreeing, unexplained = explain(differences, statuses, tolerance, bounds, peer.takes_acos)
                largest = max(largest, agreeing)
                totals = {cause: totals[cause] + counts[cause] for cause in CAUSES}
                bad += [(weight, vertex, normals[vertex], theirs[vertex]) for vertex in unexplained]
                passed, failed = passed + (len(unexplained) == 0), failed + (len(unexplained) != 0)
            outliers = "".join(f"{totals[cause]:10}" for cause in CAUSES)
            head = f"{name:26}{len(positions):7}{len(triangles):7}"
            print(f"{head}  {scalar} {peer.name:7}{largest:9.1e}{outliers}{len(bad):12}")
            for weight, vertex, ours, theirs in bad[:5]:
                print(f"    {weight}, vertex {vertex}: umbilic {ours}, {peer.name} {theirs}")
    return passed, failed


# Meshes.


def read_off(path):
    lines = [line.split("#")[0].split() for line in path.read_text(errors="replace").splitlines()]
    lines = [line for line in lines if line]
    if not lines[0][0].endswith("OFF"):
        raise ValueError(f"{path}: not an OFF file")
    lines[0] = lines[0][1:]  # the counts may stand behind the keyword
    lines = [line for line in lines if line]
    vertex_count, face_count = int(lines[0][0]), int(lines[0][1])
    vertices, faces = lines[1 : 1 + vertex_count], lines[1 + vertex_count :][:face_count]
    return [line[:3] for line in vertices], [[int(corner) for corner in line[1 : 1 + int(line[0])]] for line in faces]


def read_obj(path):
    vertices, faces = [], []
    for line in path.read_text().splitlines():
        kind, *rest = line.split() or [""]
        if kind == "v":
            vertices.append(rest[:3])
        elif kind == "f":
            indices = [int(corner.split("/")[0]) for corner in rest]
            faces.append([index - 1 if index > 0 else len(vertices) + index for index in indices])
    return vertices, faces


def read_ply(path):
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.load_new_mesh(str(path))
    return meshes.current_mesh().vertex_matrix(), meshes.current_mesh().polygonal_face_list()


def read(path):
    """Positions, `#V x 3`, and triangles, polygons cut into fans."""
    vertices, faces = {".off": read_off, ".obj": read_obj, ".ply": read_ply}[path.suffix.lower()](path)
    triangles = [(face[0], a, b) for face in faces for a, b in zip(face[1:], face[2:])]
    if not triangles:
        sys.exit(f"{path}: a mesh without faces")
    return numpy.array(vertices, float).reshape(-1, 3), numpy.array(triangles, int).reshape(-1, 3)


def mesh_files(argument):
    if not argument.is_dir():
        return [argument]
    lines = Path(__file__).with_name("meshes.txt").read_text().splitlines()
    return [argument / line for line in lines if line and not line.startswith("#")]


def main(arguments):
    if not arguments:
        sys.exit("usage: peers.py (MESH | DIRECTORY)...")
    versions = ", ".join(f"{package} {version(package)}" for package in ("libigl", "pymeshlab", "numpy"))
    print(f"{umbilic.build_info()}; {versions}\n")
    print(f"{'':53}{'largest':>9}  {'outliers by cause':40}")
    heads = "".join(f"{cause:>10}" for cause in CAUSES)
    print(f"{'mesh':26}{'#V':>7}{'#F':>7}  {'':3} {'peer':7}{'agreeing':>9}{heads}{'unexplained':>12}")
    passed = failed = 0
    for path in (path for argument in arguments for path in mesh_files(Path(argument))):
        good, bad = compare(path.name, *read(path))
        passed, failed = passed + good, failed + bad
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
