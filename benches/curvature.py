#!/usr/bin/env python3
"""Times the curvatures of libigl and of umbilic on the same mesh, in one process.

    python3 benches/curvature.py target/release/libumbilic.so [--rounds N] [--subdivide N]

The two take turns; times are CPU time of the process, ratios those of the same round. libigl is given a mesh and builds
its adjacency in every call, so umbilic's topology build is timed as well, and in the ratio added to its time. Both
compute in double precision, umbilic on one thread.
"""

import argparse
import ctypes
import sys
import time

try:
    import igl
    import numpy
except ImportError as error:
    print(f"libigl is not compared: {error}")
    sys.exit(0)

u32, size, pointer = ctypes.c_uint32, ctypes.c_size_t, ctypes.c_void_p
F64 = 1  # UMB_SCALAR_F64


def struct(name, **fields):
    return type(name, (ctypes.Structure,), {"_fields_": list(fields.items())})


# See include/umbilic.h for what the fields mean.
Faces = struct("Faces", indices=pointer, index_count=size, offsets=pointer, face_count=size, index=u32, arity=u32)
Points = struct("Points", data=pointer, count=size, stride=size, scalar=u32, reserved=u32)
Run = struct("Run", threads=u32, simd=u32, vertices=pointer, vertex_count=size, progress=pointer, user=pointer)
Options = struct(
    "Options",
    **dict(struct_size=u32, method=u32, section=u32, weight=u32, radius=ctypes.c_double, degree=u32, rings=u32),
    **dict(normal_degree=u32, normal_rings=u32, normals=Points, run=Run),
)
Output = struct("Output", data=pointer, stride=size, scalar=u32, reserved=u32)
StatusOutput = struct("StatusOutput", data=pointer, stride=size)
OUTPUTS = (
    "k1 k2 direction1 direction2 mean gaussian mean_normal area integrated_mean integrated_gaussian shape_index "
    "curvedness residual condition normal"
).split()
Outputs = struct(
    "Outputs", struct_size=u32, reserved=u32, **{name: Output for name in OUTPUTS}, status=StatusOutput
)
Error = struct("Error", struct_size=u32, status=ctypes.c_int32, element=ctypes.c_uint64, message=ctypes.c_char * 240)
JET, ANGLE_DEFECT = 0, 7  # UMB_CURVATURE_


class Umbilic:
    def __init__(self, path, positions, triangles):
        self.library = ctypes.CDLL(path)
        self.library.umb_build_info.restype = ctypes.c_char_p
        self.library.umb_topology_destroy.argtypes = [pointer]
        self.library.umb_topology_destroy.restype = None
        self.positions = numpy.ascontiguousarray(positions)
        self.indices = numpy.ascontiguousarray(triangles, numpy.uint32)
        self.topology = self.build()

    def call(self, function, *arguments):
        error = Error(struct_size=ctypes.sizeof(Error))
        if getattr(self.library, function)(*arguments, ctypes.byref(error)) != 0:
            raise RuntimeError(f"{function}: {error.message.decode()}")

    def build(self):
        topology = pointer()
        faces = Faces(indices=self.indices.ctypes.data, index_count=self.indices.size)
        self.call("umb_topology_create", ctypes.byref(faces), size(len(self.positions)), None, ctypes.byref(topology))
        return topology

    def build_and_destroy(self):
        self.library.umb_topology_destroy(self.build())

    def curvatures(self, method, names, degree=0, rings=0):
        """The outputs named, as arrays."""
        widths = {"direction1": 3, "direction2": 3}
        arrays = [numpy.empty((len(self.positions), widths.get(name, 1))) for name in names]
        outputs = {name: Output(data=array.ctypes.data, scalar=F64) for name, array in zip(names, arrays)}
        points = Points(data=self.positions.ctypes.data, count=len(self.positions), scalar=F64)
        options = Options(struct_size=ctypes.sizeof(Options), method=method, degree=degree, rings=rings)
        options.run.threads = 1
        structs = (points, options, Outputs(struct_size=ctypes.sizeof(Outputs), **outputs))
        self.call("umb_curvatures", self.topology, *(ctypes.byref(struct) for struct in structs))
        return [array.squeeze() for array in arrays]


def bumpy_sphere(subdivisions):
    """The mesh of common.h: an icosphere with bumps."""
    g = (1 + 5**0.5) / 2
    positions = numpy.array(
        [[-1, g, 0], [1, g, 0], [-1, -g, 0], [1, -g, 0], [0, -1, g], [0, 1, g], [0, -1, -g], [0, 1, -g]]
        + [[g, 0, -1], [g, 0, 1], [-g, 0, -1], [-g, 0, 1]]
    )
    positions /= numpy.linalg.norm(positions[0])
    triangles = numpy.array(
        [[0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6]]
        + [[7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10]]
        + [[8, 6, 7], [9, 8, 1]]
    )
    for _ in range(subdivisions):
        edges = numpy.sort(numpy.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]))
        edges, places = numpy.unique(edges, axis=0, return_inverse=True)
        middles = positions[edges].sum(1)
        middles /= numpy.linalg.norm(middles, axis=1, keepdims=True)
        ab, bc, ca = len(positions) + places.reshape(3, -1)
        a, b, c = triangles.T
        positions = numpy.concatenate([positions, middles])
        parts = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        triangles = numpy.stack([numpy.stack(part, 1) for part in parts], 1).reshape(-1, 3)
    x, y, z = positions.T
    return positions * (1 + 0.08 * numpy.sin(5 * x) * numpy.sin(4 * y + 1) * numpy.sin(6 * z))[:, None], triangles


def seconds(function):
    start = time.process_time_ns()
    function()
    return (time.process_time_ns() - start) * 1e-9


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("library")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--subdivide", type=int, default=6)
    arguments, _ = parser.parse_known_args()  # the other benchmarks have more
    positions, triangles = bumpy_sphere(arguments.subdivide)
    umbilic = Umbilic(arguments.library, positions, triangles)
    principal = ["k1", "k2", "direction1", "direction2"]
    integers = triangles.astype(numpy.int64)
    rows = [
        (
            "angle defect",
            lambda: umbilic.curvatures(ANGLE_DEFECT, ["integrated_gaussian"]),
            "gaussian_curvature",
            lambda: igl.gaussian_curvature(positions, integers),
        ),
        (
            "jets 2, 2 rings",
            lambda: umbilic.curvatures(JET, principal, 2, 2),
            "principal_curvature, radius 2",
            lambda: igl.principal_curvature(positions, integers, 2),
        ),
        (
            "jets 2, 5 rings",
            lambda: umbilic.curvatures(JET, principal, 2, 5),
            "principal_curvature, radius 5 (default)",
            lambda: igl.principal_curvature(positions, integers, 5),
        ),
    ]
    # The same quantity, so that no call is timed for something else: the defects are to agree.
    difference = abs(rows[0][1]()[0] - rows[0][3]()).max()
    print(f"\n{umbilic.library.umb_build_info().decode()}; libigl, CPU time, {arguments.rounds} rounds, medians")
    print(f"bumpy sphere: {len(triangles)} triangles; angle defects within {difference:.0e}\n")
    print(f"  {'ns/triangle':28}{'umbilic':>9}{'topology':>10}   {'libigl':40}{'':>9}{'ratio':>8}{'(quartiles)':>18}")
    for ours, umbilics, theirs, igls in rows:
        umbilics(), igls()
        times = numpy.array(
            [[seconds(umbilics), seconds(umbilic.build_and_destroy), seconds(igls)] for _ in range(arguments.rounds)]
        )
        ratios = times[:, 2] / (times[:, 0] + times[:, 1])
        low, ratio, high = numpy.quantile(ratios, [0.25, 0.5, 0.75])
        run, build, peer = numpy.median(times, 0) / len(triangles) * 1e9
        print(f"  {ours:28}{run:9.1f}{build:10.1f}   {theirs:40}{peer:9.1f}{ratio:8.1f}{low:10.1f}{high:8.1f}")


if __name__ == "__main__":
    main()
