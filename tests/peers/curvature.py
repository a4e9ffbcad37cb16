#!/usr/bin/env python3
"""Compares the curvatures of umbilic with those of libigl and of VCG (through PyMeshLab).

    pip install -r tests/peers/requirements.txt
    python3 tests/peers/curvature.py "$(tests/peers/meshes.sh target/meshes)"

Meshes are given as to peers.py, and cut into triangles as there. All is in double precision.

First, on these meshes, what is defined alike:

    angle      libigl gaussian_curvature, an integral, against that of angle-defect; in units of 2 pi
    area       libigl massmatrix (Voronoi, hybrid) against the mixed area of meyer, as a part of it
    cotangent  libigl cotmatrix, -L V / 2, against the mean normal times the area of meyer; in units of the sum of
               lengths that it is made of, half of half the edges opposite the vertex
    K          VCG discrete Gaussian curvature against that of meyer, in units of 2 pi by the area
    |H|        VCG discrete mean curvature against that of meyer, in units of the sum of lengths by the area. VCG takes
               the sign from normals of its own, so signs are not compared

The tolerance is 1e-9 for libigl. VCG keeps angles and areas in single precision whatever it was built for: 1e-6. A
vertex that differs by more has to have one of these causes, each computed from the mesh, or the comparison fails:

    turning    the difference is what the definitions differ by. umbilic's angle defect is 2 pi for each closed and pi
               for each open fan less the angles, and 0 where no face is; libigl's is 2 pi less the angles at any
               vertex. VCG's is 2 pi less the angles less the angle between the two border edges of each open fan,
               where winding does not end a fan as it does in umbilic
    rounding   the difference is within the rounding error of the peer's arithmetic, which takes cotangents from
               squared edge lengths and Heron's formula (libigl), or from angles in single precision (VCG)
    sliver     a triangle at the vertex is so thin that this arithmetic keeps no digit of what it adds; VCG leaves
               such triangles out, libigl divides by their area

VCG refuses meshes with an edge of three faces: these are told as refused.

Then, on an irregular ellipsoid of two sizes whose curvatures are known, estimators that differ by definition. Errors
and differences are root mean squares, divided by that of k1 and k2.

    quadrics      libigl principal_curvature over two rings and VCG's quadric fitting are height fields of degree 2 with
                  a free tangent plane: so is umbilic's jet of degree 2, in other frames. Each has to come within 3 % of
                  the exact values on the finer mesh and be at least 1.5 times as far off on the coarser, and the peers
                  within 3 % of umbilic
    Taubin        VCG's weights, in single precision, are not quite umbilic's, nor is its split into k1 and k2. Their
                  mean, the trace of the tensor, is compared and only reported
    normal cycle  VCG adds up whole edges and does not divide by an area: twice the integral that umbilic gives, up to
                  what asin and a normal part make. The median ratio has to be within 2 % of 2
"""

import sys
from importlib.metadata import version
from pathlib import Path

import bindings  # noqa: F401
import igl
import numpy
import pymeshlab
import umbilic
from peers import Corners, divide, length, mesh_files, read
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

sys.path.insert(1, str(Path(__file__).resolve().parents[2] / "benches" / "accuracy"))
from meshes import Mesh  # noqa: E402
from surfaces import Ellipsoid  # noqa: E402

CAUSES = ("turning", "rounding", "sliver")
IGL_TOLERANCE, VCG_TOLERANCE = 1e-9, 1e-6
EPS = numpy.finfo(float).eps
SINGLE = 4 * numpy.finfo(numpy.float32).eps  # what an angle of VCG may be off: pi less two angles rounds three times


# How the corners at a vertex are joined.


class Fans:
    """For each vertex the turns of its fans, as umbilic joins them and as VCG does, in radians."""

    def __init__(self, positions, triangles):
        count = len(positions)
        self.positions, self.triangles = positions, triangles
        start, end = triangles.ravel(), numpy.roll(triangles, -1, 1).ravel()
        # The halfedge from each corner, and the other one of its edge if there are exactly two.
        key = numpy.minimum(start, end) * count + numpy.maximum(start, end)
        order = numpy.argsort(key, kind="stable")
        first = numpy.flatnonzero(numpy.r_[True, numpy.diff(key[order]) != 0])
        size = numpy.diff(numpy.r_[first, len(key)])
        pairs = order[first[size == 2]], order[first[size == 2] + 1]
        opposite = start[pairs[0]] != start[pairs[1]]
        self.border = order[first[size == 1]]
        labels = self.join(pairs[0][opposite], pairs[1][opposite])
        corners = numpy.bincount(start, minlength=count)
        # Every join makes one corner of each of the edge's two vertices the next of another.
        joins = numpy.bincount(start[pairs[0][opposite]], minlength=count)
        joins += numpy.bincount(end[pairs[0][opposite]], minlength=count)
        fans = numpy.bincount(start[numpy.unique(labels, return_index=True)[1]], minlength=count)
        self.umbilic = 2 * numpy.pi * fans - numpy.pi * (corners - joins)
        self.vcg = 2 * numpy.pi - self.border_angles(self.join(*pairs))

    def join(self, a, b):
        """Labels of corners joined across the edges whose halfedges start at the corners `a` and `b`."""
        start = self.triangles.ravel()

        def following(corner):
            return corner - corner % 3 + (corner + 1) % 3

        same = start[a] == start[b]
        # The corners of the same vertex on either side, at both ends of the edge.
        joined = numpy.r_[a, following(a)], numpy.r_[
            numpy.where(same, b, following(b)), numpy.where(same, following(b), b)
        ]
        graph = coo_array((numpy.ones(len(joined[0])), joined), (start.size, start.size))
        return connected_components(graph, directed=False)[1]

    def border_angles(self, labels):
        """The angles between the two border edges of fans, summed over the border halfedges from the vertex."""
        start, end = self.triangles.ravel(), numpy.roll(self.triangles, -1, 1).ravel()
        total, directions = numpy.zeros(len(self.positions)), {}
        for corner in self.border:
            following = corner - corner % 3 + (corner + 1) % 3
            for label, at, to in (
                (labels[corner], start[corner], end[corner]),
                (labels[following], end[corner], start[corner]),
            ):
                directions.setdefault((label, at), []).append(self.positions[to] - self.positions[at])
        for corner in self.border:
            edges = directions[labels[corner], start[corner]]
            if len(edges) == 2:
                a, b = edges
                total[start[corner]] += numpy.arctan2(length(numpy.cross(a, b)), a @ b)
        return total


# What the peers compute, and how exactly.


def libigl(positions, triangles):
    """Integrated Gaussian curvature, area, and integrated mean normal, of which libigl cuts off unused vertices."""
    used = triangles.max() + 1
    area, normal = numpy.zeros(len(positions)), numpy.zeros_like(positions)
    area[:used] = igl.massmatrix(positions, triangles, igl.MASSMATRIX_TYPE_VORONOI).diagonal()[:used]
    laplacian = igl.cotmatrix(positions, triangles)
    normal[: laplacian.shape[0]] = -(laplacian @ positions[: laplacian.shape[1]]) / 2
    return igl.gaussian_curvature(positions, triangles), area, normal


def vcg(positions, triangles, kind):
    """A curvature at each vertex, zero at those that VCG drops; none if it refuses the mesh."""
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.add_mesh(pymeshlab.Mesh(positions, triangles))
    try:
        meshes.compute_scalar_by_discrete_curvature_per_vertex(curvaturetype=kind)
    except pymeshlab.PyMeshLabException:
        return None
    kept = numpy.arange(len(positions))
    if meshes.current_mesh().vertex_number() != len(positions):
        kept = numpy.unique(triangles)
    if not numpy.array_equal(meshes.current_mesh().vertex_matrix(), positions[kept]):
        raise RuntimeError("PyMeshLab changed the mesh")
    result = numpy.zeros(len(positions))
    result[kept] = meshes.current_mesh().vertex_scalar_array()
    return result


class Bounds:
    """To first order, how much the peers' cotangents, areas and sums of them may be off at each vertex."""

    def __init__(self, corners, positions):
        at = positions.astype(numpy.longdouble)[corners.vertices]
        self.corners = corners
        sides = numpy.stack([length(at[:, (i + 2) % 3] - at[:, (i + 1) % 3]) for i in range(3)], 1)  # opposite i
        longest = sides.max(1)[:, None]
        self.perimeter = corners.sum(sides) / 4
        sine, cosine = numpy.sin(corners.angle), numpy.abs(numpy.cos(corners.angle))
        cotangent = divide(cosine, sine, numpy.inf)
        # Heron's formula in squared lengths: the area is off by units of the longest side squared, squared.
        thin = divide(longest**2, corners.double_area)
        heron = 8 * EPS * divide(longest**2, corners.double_area, numpy.inf) ** 2
        heron = numpy.where(heron < 0.1, 8 * EPS * thin + cotangent * heron, numpy.inf)
        # An angle of VCG is off by SINGLE and by what acos loses; a cotangent by that over the sine squared.
        angle = SINGLE + EPS / numpy.maximum(sine, EPS**0.5)
        single = numpy.where(sine > 10 * angle, divide(angle, sine**2), numpy.inf)
        lost = numpy.isinf(single).any(1)[:, None]
        single, angle = numpy.where(lost, numpy.inf, single), numpy.where(lost, numpy.inf, angle)
        self.angle = corners.sum(angle + 0 * sides)
        self.cotangent = {"libigl": self.vectors(heron, sides), "VCG": self.vectors(single, sides)}
        self.area = {"libigl": self.areas(heron, sides, 8 * EPS), "VCG": self.areas(single, sides, SINGLE)}

    def vectors(self, cotangent, sides):
        """Of sums of (cot b * c + cot c * b) / 4 for the corners b and c beside each corner."""
        terms = times(cotangent, sides)
        return self.corners.sum((numpy.roll(terms, 1, 1) + numpy.roll(terms, -1, 1)) / 4)

    def areas(self, cotangent, sides, rounding):
        terms = times(cotangent, sides**2)
        obtuse = (self.corners.angle > numpy.pi / 2 + 1e-3).any(1)[:, None]
        terms = numpy.where(obtuse, 0, (numpy.roll(terms, 1, 1) + numpy.roll(terms, -1, 1)) / 8)
        return self.corners.sum(terms + rounding * (sides.max(1) ** 2)[:, None])


def times(a, b):
    """`a * b`, and zero where b is zero."""
    return numpy.where(b == 0, 0, a * numpy.where(b == 0, 1, b))


# The comparison.


def explain(difference, tolerance, causes):
    """How many differences above the tolerance have which cause, the largest below it, and the vertices without one."""
    unexplained = ~(difference <= tolerance)  # also where the peer answers NaN
    counts = dict.fromkeys(CAUSES, 0)
    for cause, holds in causes.items():
        counts[cause] = int((unexplained & holds).sum())
        unexplained = unexplained & ~holds
    agreeing = difference[difference <= tolerance]
    return counts, agreeing.max(initial=0.0), numpy.flatnonzero(unexplained)


def within(difference, bound, tolerance):
    """The causes that lie in arithmetic, for a difference and a bound in the units of the tolerance."""
    return {"rounding": (difference <= bound + tolerance) & (bound < 0.1), "sliver": ~(bound < 0.1)}


def compare(name, positions, triangles):
    """Prints a line for each quantity; answers with the numbers of comparisons that passed and failed."""
    topology = umbilic.Topology(triangles, len(positions))
    ours = vars(
        umbilic.curvatures(positions, topology, method="meyer", outputs=("mean", "gaussian", "mean_normal", "area"))
    )
    defect = umbilic.curvatures(positions, topology, method="angle-defect").integrated_gaussian
    fans, corners = Fans(positions, triangles), Corners(positions, triangles)
    bounds = Bounds(corners, positions)
    area, perimeter = ours["area"], bounds.perimeter
    defect_igl, area_igl, normal_igl = libigl(positions, triangles)
    lines = []

    full = 2 * numpy.pi
    difference = (defect - defect_igl) / full
    turning = numpy.abs(difference - (fans.umbilic - full) / full) <= IGL_TOLERANCE
    lines.append(("libigl", "angle", numpy.abs(difference), IGL_TOLERANCE, {"turning": turning}))

    difference = divide(numpy.abs(area - area_igl), area)
    bound = divide(bounds.area["libigl"], area, numpy.inf)
    lines.append(("libigl", "area", difference, IGL_TOLERANCE, within(difference, bound, IGL_TOLERANCE)))

    difference = divide(length(ours["mean_normal"] * area[:, None] - normal_igl), perimeter)
    bound = divide(bounds.cotangent["libigl"], perimeter, numpy.inf)
    causes = within(difference, bound, IGL_TOLERANCE)
    lines.append(("libigl", "cotangent", difference, IGL_TOLERANCE, causes))

    gaussian, mean = vcg(positions, triangles, "Gaussian Curvature"), vcg(positions, triangles, "Mean Curvature")
    area_bound = divide(bounds.area["VCG"], area, numpy.inf)
    if gaussian is not None:
        difference = (ours["gaussian"] - gaussian) * area / full
        bound = bounds.angle / full + times(area_bound, numpy.abs(gaussian) * area / full)
        expected = (fans.umbilic - fans.vcg) / full
        turning = (expected != 0) & (numpy.abs(difference - expected) <= VCG_TOLERANCE + bound) & (bound < 0.1)
        difference = numpy.abs(difference)
        causes = {"turning": turning} | within(difference, bound, VCG_TOLERANCE)
        lines.append(("VCG", "K", difference, VCG_TOLERANCE, causes))
    if mean is not None:
        difference = divide(numpy.abs(numpy.abs(ours["mean"]) - numpy.abs(mean)) * area, perimeter)
        bound = divide(bounds.cotangent["VCG"] + times(area_bound, numpy.abs(mean) * area), perimeter, numpy.inf)
        causes = within(difference, bound, VCG_TOLERANCE)
        lines.append(("VCG", "|H|", difference, VCG_TOLERANCE, causes))

    passed = failed = 0
    for peer, quantity, difference, tolerance, causes in lines:
        counts, largest, unexplained = explain(difference, tolerance, causes)
        outliers = "".join(f"{counts[cause]:10}" for cause in CAUSES)
        head = f"{name:26}{len(positions):7}{len(triangles):7}"
        print(f"{head}  {peer:7}{quantity:10}{largest:9.1e}{outliers}{len(unexplained):12}")
        for vertex in unexplained[:5]:
            print(f"    vertex {vertex}: off by {difference[vertex]:.3g}")
        passed, failed = passed + (len(unexplained) == 0), failed + (len(unexplained) != 0)
    if gaussian is None or mean is None:
        print(f"{name:26}{len(positions):7}{len(triangles):7}  VCG    refused")
    return passed, failed


# Where the definitions differ.


def rms(values):
    return float(numpy.sqrt(numpy.mean(numpy.square(values))))


def vcg_principal(mesh, method, quantity):
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.add_mesh(pymeshlab.Mesh(mesh.positions, mesh.faces))
    meshes.compute_curvature_principal_directions_per_vertex(
        method=method, curvcolormethod=quantity, autoclean=False
    )
    return meshes.current_mesh().vertex_scalar_array()


def judge(text, holds):
    print(f"  {text}{'' if holds else '   FAILED'}")
    return bool(holds)


def compare_smooth():
    """Prints errors and agreements; answers with the numbers of judgements that passed and failed."""
    errors, differences, judgements = {}, {}, []
    for size in (26, 52):
        mesh = Mesh(Ellipsoid(), "irregular", size)
        exact = mesh.exact
        unit = rms(numpy.stack([exact.k1, exact.k2]))
        topology = umbilic.Topology(mesh.faces, len(mesh.positions))
        jet = umbilic.curvatures(mesh.positions, topology, method="jet", degree=2)
        options = {"section": "circle", "weight": "area", "outputs": ("mean",)}
        taubin = umbilic.curvatures(mesh.positions, topology, method="taubin", **options).mean
        cycle = umbilic.curvatures(
            mesh.positions, topology, method="normal-cycle", outputs=("integrated_mean",)
        ).integrated_mean
        _, _, k1, k2, _ = igl.principal_curvature(mesh.positions, mesh.faces.astype(numpy.int64), 2, True)
        # MeshLab's maximum is the smaller one.
        found = {
            "umbilic": (jet.k1, jet.k2),
            "libigl": (k1, k2),
            "VCG": tuple(vcg_principal(mesh, "Quadric Fitting", f"{name} Curvature") for name in ("Min", "Max")),
        }
        print(f"ellipsoid, {len(mesh.positions)} vertices")
        for name, values in found.items():
            error = rms(numpy.stack(values) - [exact.k1, exact.k2]) / unit
            difference = rms(numpy.stack(values) - [jet.k1, jet.k2]) / unit
            errors.setdefault(name, []).append(error)
            differences[name] = difference
            print(f"  quadric of {name:8} error {error:.2%}, difference from umbilic {difference:.2%}")
        theirs = vcg_principal(mesh, "Taubin approximation", "Mean Curvature")
        print(
            f"  Taubin's mean: correlation {numpy.corrcoef(theirs, taubin)[0, 1]:.3f}, "
            f"median difference {numpy.median(abs(theirs - taubin)) / unit:.2%}"
        )
        ratio = float(numpy.median(vcg_principal(mesh, "Normal Cycles", "Mean Curvature") / cycle))
        judgements.append(judge(f"normal cycle: median ratio {ratio:.4f}", abs(ratio - 2) < 0.04))
    for name, (coarse, fine) in errors.items():
        text = f"quadric of {name}: {coarse / fine:.1f} times as good on the finer mesh"
        judgements.append(judge(text, fine < 0.03 and coarse > 1.5 * fine and differences[name] < 0.03))
    return sum(judgements), len(judgements) - sum(judgements)


def main(arguments):
    if not arguments:
        sys.exit("usage: curvature.py (MESH | DIRECTORY)...")
    versions = ", ".join(f"{package} {version(package)}" for package in ("libigl", "pymeshlab", "numpy"))
    print(f"{umbilic.build_info()}; {versions}\n")
    print(f"{'':59}{'largest':>9}  {'outliers by cause':30}")
    heads = "".join(f"{cause:>10}" for cause in CAUSES)
    print(f"{'mesh':26}{'#V':>7}{'#F':>7}  {'peer':7}{'quantity':10}{'agreeing':>9}{heads}{'unexplained':>12}")
    passed = failed = 0
    for path in (path for argument in arguments for path in mesh_files(Path(argument))):
        good, bad = compare(path.name, *read(path))
        passed, failed = passed + good, failed + bad
    print()
    good, bad = compare_smooth()
    passed, failed = passed + good, failed + bad
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
