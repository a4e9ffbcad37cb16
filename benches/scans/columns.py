"""The estimators that stand side by side: each library's own normals and mean curvature, its options left alone.

Mean curvature is positive where the surface is convex, seen from the side that faces run counter-clockwise on: a
sphere of radius r has 1/r. The peers are called so that theirs has this sign.
"""

import dataclasses
import time
from importlib.metadata import version

import igl
import numpy
import pymeshlab
import umbilic

ROUNDS = 3


class Found:
    """What an estimator makes of a mesh; `seconds` of CPU time, the best of some rounds, for curvature and normals."""

    def __init__(self, column, subject, rounds=1):
        calls = (column.mean, column.normals)
        runs = [[timed(call, subject) for call in calls] for _ in range(rounds)]
        (self.mean, _), (self.normals, _) = runs[0]
        self.seconds = [min(run[index][1] for run in runs) for index in range(len(calls))]


def timed(call, subject):
    start = time.process_time()
    result = call(subject)
    return result, time.process_time() - start


class AdaptiveJet:
    title, curvature, normal = "umbilic", "adaptive-jet (default)", "adaptive-jet"

    def __init__(self, quieter=1):
        """`quieter`: the noise that the model learned is divided by this."""
        self.version, self.quieter = umbilic.build_info().split(",")[0], quieter
        if quieter != 1:
            self.curvature = self.normal = f"adaptive-jet, noise / {quieter}"

    def mean(self, subject):
        return self.curvatures(subject, "mean").mean

    def normals(self, subject):
        with self.topology(subject) as mesh:
            options = self.model(mesh, subject)
            return umbilic.vertex_normals(
                subject.positions, mesh, weight="adaptive-jet", threads=1, **options
            ).normal

    def curvatures(self, subject, *wanted):
        with self.topology(subject) as mesh:
            options = self.model(mesh, subject)
            return umbilic.curvatures(subject.positions, mesh, outputs=wanted, threads=1, **options)

    def topology(self, subject):
        return umbilic.Topology(subject.faces, len(subject.positions))

    def model(self, mesh, subject):
        if self.quieter == 1:
            return {}
        model = umbilic.learn_model(subject.positions, mesh)
        return {"model": dataclasses.replace(model, noise=model.noise / self.quieter)}

    def noise(self, subject):
        """What it takes for noise, in units of its edge length."""
        with self.topology(subject) as mesh:
            model = umbilic.learn_model(subject.positions, mesh)
        return model.noise / model.edge_length


class Libigl:
    title, curvature, normal = "libigl", "principal_curvature (default: radius 5)", "per_vertex_normals (default)"

    def __init__(self, radius=None):
        self.version, self.radius = f"libigl {version('libigl')}", [radius] if radius else []
        if radius:
            self.curvature = f"principal_curvature (radius {radius})"

    def mean(self, subject):
        found = igl.principal_curvature(subject.positions, subject.faces, *self.radius)
        return (found[2] + found[3]) / 2

    def normals(self, subject):
        return igl.per_vertex_normals(subject.positions, subject.faces)


class Vcg:
    title, curvature, normal = "VCG (PyMeshLab)", "discrete curvature (default)", "simple average (default)"
    fitted = False

    def __init__(self, fitted=False):
        self.version = f"PyMeshLab {version('pymeshlab')}"
        if fitted:
            self.fitted, self.curvature = True, "principal directions (default: quadrics)"

    def mean(self, subject):
        meshes = self.meshes(subject)
        if self.fitted:
            meshes.compute_curvature_principal_directions_per_vertex()
        else:
            meshes.compute_scalar_by_discrete_curvature_per_vertex()
        return self.same(subject, meshes).vertex_scalar_array()

    def normals(self, subject):
        meshes = self.meshes(subject)
        meshes.compute_normal_per_vertex()
        return self.same(subject, meshes).vertex_normal_matrix()

    def meshes(self, subject):
        meshes = pymeshlab.MeshSet(verbose=False)
        meshes.add_mesh(pymeshlab.Mesh(subject.positions, subject.faces))
        return meshes

    def same(self, subject, meshes):
        """Filters may drop vertices."""
        if not numpy.array_equal(meshes.current_mesh().vertex_matrix(), subject.positions):
            raise RuntimeError("PyMeshLab changed the mesh")
        return meshes.current_mesh()
