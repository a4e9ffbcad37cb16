#!/usr/bin/env python3
"""What the Python package adds to the library's own time, with numpy, trimesh and pyvista as hosts.

    UMBILIC_LIBRARY=target/release/libumbilic.so PYTHONPATH=bindings/python/src python3 benches/hosts/python.py MESH

MESH is a file that trimesh reads. Prints lines `host, quantity, copies, library_ms, adapter_ms`, by tabs: how many
times positions, faces or results are copied; milliseconds of the C interface alone on the same arrays, and what a whole
call in the host's own terms takes beyond that. Both the best of several rounds in turn, one thread, in the host's own
precision (pyvista: float32).
"""

import sys
import time
from ctypes import byref, c_void_p

import numpy
import pyvista
import trimesh

import umbilic
from umbilic import _arrays as arrays
from umbilic import _native as native
from umbilic.faces import FaceArrays

ROUNDS = 25
CURVATURES = ("k1", "k2", "direction1", "direction2")


class Numpy:
    name = "numpy"

    def __init__(self, mesh):
        self.positions, self.triangles = numpy.array(mesh.vertices), numpy.array(mesh.faces)
        self.points, self.faces = self.positions, self.triangles
        self.mesh = self.topology()

    def topology(self):
        return umbilic.Topology(self.triangles, len(self.positions), threads=1)

    def normals(self):
        # begin: user code, numpy
        normals, status = umbilic.vertex_normals(self.positions, self.mesh, threads=1)
        # end: user code
        return [normals]

    def curvature(self):
        # begin: user code, numpy
        k1, k2, direction1, direction2, status = umbilic.curvatures(self.positions, self.mesh, threads=1)
        # end: user code
        return [k1, k2, direction1, direction2]

    def stored(self, quantity):
        return self.normals() if quantity == "vertex normals" else self.curvature()


class Trimesh:
    name = "trimesh"

    def __init__(self, mesh):
        self.host = mesh
        self.points, self.faces = mesh.vertices, umbilic.trimesh.faces(mesh)
        self.mesh = self.topology()

    def topology(self):
        return umbilic.Topology(umbilic.trimesh.faces(self.host), len(self.host.vertices), threads=1)

    def normals(self):
        # begin: user code, trimesh
        found = umbilic.trimesh.vertex_normals(self.host, self.mesh, threads=1)
        # end: user code
        return [found.normal]

    def curvature(self):
        # begin: user code, trimesh
        found = umbilic.trimesh.curvatures(self.host, self.mesh, threads=1)
        # end: user code
        return [getattr(found, name) for name in CURVATURES]

    def stored(self, quantity):
        if quantity == "vertex normals":
            return [self.host.vertex_normals]
        return [self.host.vertex_attributes[name] for name in CURVATURES]


class Pyvista:
    name = "pyvista"

    def __init__(self, mesh):
        cells = numpy.insert(mesh.faces, 0, 3, axis=1).ravel()
        self.host = pyvista.PolyData(numpy.asarray(mesh.vertices, numpy.float32), faces=cells)
        self.points, self.faces = self.host.points, umbilic.pyvista.faces(self.host)
        self.mesh = self.topology()

    def topology(self):
        return umbilic.Topology(umbilic.pyvista.faces(self.host), self.host.n_points, threads=1)

    def normals(self):
        # begin: user code, pyvista
        found = umbilic.pyvista.vertex_normals(self.host, self.mesh, threads=1)
        # end: user code
        return [found.normal]

    def curvature(self):
        # begin: user code, pyvista
        found = umbilic.pyvista.curvatures(self.host, self.mesh, threads=1)
        # end: user code
        return [getattr(found, name) for name in CURVATURES]

    def stored(self, quantity):
        data = self.host.point_data
        return [data["Normals"]] if quantity == "vertex normals" else [data[name] for name in CURVATURES]


class Library:
    """The C interface alone, with everything but the call itself prepared."""

    def __init__(self, host):
        self.host, self.arrays = host, FaceArrays(host.faces)
        self.points = numpy.asarray(host.points)
        self.faces, self.view = self.arrays.view(), arrays.points(self.points)
        self.handle = host.mesh.handle
        count, dtype = len(self.points), self.points.dtype
        self.topology_options = native.sized(native.TopologyOptions, threads=1)
        run = native.Run(threads=1)
        # The topology is there, and the memory of results is new in every round, as that of the adapters is.
        self.normal_options = native.sized(native.NormalOptions, run=run)
        self.curvature_options = native.sized(native.CurvatureOptions, run=run)
        self.normal_shapes = {"normal": (count, 3), "status": (count,)}
        self.curvature_shapes = {
            name: (count, 3) if name.startswith("direction") else (count,) for name in (*CURVATURES, "status")
        }
        self.dtype = dtype

    def topology(self):
        made = c_void_p()
        start = time.perf_counter()
        native.call(
            native.library.umb_topology_create, self.faces, len(self.points), self.topology_options, byref(made)
        )
        taken = time.perf_counter() - start
        native.library.umb_topology_destroy(made)
        return taken

    def normals(self):
        outputs = arrays.Outputs(self.normal_shapes, None, self.normal_shapes, self.dtype)
        written = native.sized(native.NormalOutputs, **outputs.fields())
        start = time.perf_counter()
        native.call(native.library.umb_vertex_normals, self.handle, self.view, self.normal_options, written)
        return time.perf_counter() - start

    def curvature(self):
        outputs = arrays.Outputs(self.curvature_shapes, None, self.curvature_shapes, self.dtype)
        written = native.sized(native.CurvatureOutputs, **outputs.fields())
        start = time.perf_counter()
        native.call(native.library.umb_curvatures, self.handle, self.view, self.curvature_options, written)
        return time.perf_counter() - start


def timed(call):
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def copies(host, quantity, call):
    """How many of the arrays of a call are not where the host or the caller has them."""
    if quantity == "topology":
        ours = FaceArrays(host.faces).indices
        return int(not numpy.shares_memory(ours, numpy.asarray(host.faces)))
    read = arrays.vectors(host.points, "positions")
    found = call()
    unlike = sum(not numpy.shares_memory(a, b) for a, b in zip(found, host.stored(quantity)))
    if isinstance(host, Numpy):
        unlike = 0  # the results are the caller's own
    return int(not numpy.shares_memory(read, numpy.asarray(host.points))) + unlike


def measure(host):
    library = Library(host)
    for quantity, name in (("topology", "topology"), ("vertex normals", "normals"), ("curvature", "curvature")):
        alone, whole = [], []
        for _ in range(ROUNDS):
            alone.append(getattr(library, name)())
            whole.append(timed(getattr(host, name)))
        beyond = 1e3 * (min(whole) - min(alone))
        columns = (
            host.name,
            quantity,
            copies(host, quantity, getattr(host, name)),
            f"{1e3 * min(alone):.3f}",
            f"{beyond:.3f}",
        )
        print(*columns, sep="\t", flush=True)


def main(arguments):
    if len(arguments) != 1:
        sys.exit("usage: python.py MESH")
    mesh = trimesh.load_mesh(arguments[0], process=False)
    for host in (Numpy, Trimesh, Pyvista):
        measure(host(mesh.copy()))


if __name__ == "__main__":
    main(sys.argv[1:])
