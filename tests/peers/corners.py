#!/usr/bin/env python3
"""Compares the corner normals of umbilic with libigl's per_corner_normals on real meshes.

    pip install -r tests/peers/requirements.txt
    python3 tests/peers/corners.py "$(tests/peers/meshes.sh target/meshes)"

The definitions differ. libigl adds up, by area, all faces at the vertex whose normal is within the angle of the corner's own face, wherever
they are; umbilic those that can be reached around the vertex over edges within the angle. Corners at which both add up the same
faces are compared: there the results must agree within 1e-12, or within the rounding error of a sum that cancels.
"""

import sys
from pathlib import Path

import bindings  # noqa: F401
import igl
import numpy
import umbilic
from peers import Corners, divide, length, mesh_files, read

ANGLE = 30.0  # degrees
TOLERANCE = 1e-12


def pairs_at_vertices(triangles):
    """All pairs of different corners at the same vertex, each in both orders."""
    vertices = triangles.ravel()
    order = numpy.argsort(vertices, kind="stable")
    for step in range(1, len(vertices)):
        first, second = order[:-step], order[step:]
        same = vertices[first] == vertices[second]
        if not same.any():
            return
        yield first[same], second[same]
        yield second[same], first[same]


def compare(name, positions, triangles):
    """Prints a line; answers with whether the comparison passed."""
    corners = Corners(positions, triangles)
    normals = corners.normal[:, 0].astype(float)
    areas = corners.double_area[:, 0].astype(float)
    mesh = umbilic.Cut(positions, triangles, angle=numpy.radians(ANGLE))
    ours = umbilic.corner_normals(positions, mesh, weight="area").corner.reshape(-1, 3, 3)
    cut = mesh.corners.reshape(-1, 3)
    theirs = igl.per_corner_normals(positions, triangles.astype(numpy.int64), ANGLE).reshape(-1, 3, 3)
    face_of = numpy.arange(3 * len(triangles)) // 3
    repeated = (triangles == numpy.roll(triangles, 1, axis=1)).any(axis=1)
    comparable = ~repeated[face_of] & (areas[face_of] > 0)
    for first, second in pairs_at_vertices(triangles):
        cosines = (normals[face_of[first]] * normals[face_of[second]]).sum(axis=1)
        near = cosines > numpy.cos(numpy.radians(ANGLE))
        together = cut.ravel()[first] == cut.ravel()[second]
        # At the angle itself rounding decides; a face without area has no normal to compare.
        open_question = (abs(cosines - numpy.cos(numpy.radians(ANGLE))) < 1e-12) | (areas[face_of[second]] == 0)
        numpy.logical_and.at(comparable, first, (near == together) & ~open_question)
    comparable = comparable.reshape(-1, 3)
    differences = length(ours - theirs)
    # What the cross products of slivers have lost, in a sum that may be much shorter than its terms.
    lost, sums = numpy.zeros(cut.max() + 1), numpy.zeros((cut.max() + 1, 3))
    numpy.add.at(lost, cut.ravel(), numpy.broadcast_to(corners.rounding("area"), cut.shape).astype(float).ravel())
    numpy.add.at(sums, cut.ravel(), (areas[:, None] * normals)[face_of])
    allowed = TOLERANCE + divide(lost, length(sums), 2)[cut]
    bad = comparable & ~(differences <= allowed)
    split = len(numpy.unique(cut)) - len(numpy.unique(triangles))
    agreeing = differences[comparable & (differences <= TOLERANCE)].max(initial=0.0)
    print(
        f"{name:26}{len(triangles):8}{split:8}{100 * comparable.mean():9.2f} %{agreeing:10.1e}"
        f"{int((comparable & (differences > TOLERANCE) & ~bad).sum()):10}{int(bad.sum()):6}"
    )
    for face, corner in numpy.argwhere(bad)[:5]:
        print(f"    face {face}, corner {corner}: umbilic {ours[face, corner]}, libigl {theirs[face, corner]}")
    return not bad.any() and comparable.any()


def main(arguments):
    if not arguments:
        sys.exit("usage: corners.py (MESH | DIRECTORY)...")
    print(f"{'mesh':26}{'#F':>8}{'split':>8}{'compared':>11}{'largest':>10}{'rounding':>10}{'bad':>6}")
    results = [
        compare(path.name, *read(path))
        for argument in arguments
        for path in mesh_files(Path(argument))
    ]
    print(f"{sum(results)} passed, {len(results) - sum(results)} failed")
    return 0 if results and all(results) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
