"""Normals and curvatures of other libraries, each computed by that library.

Those that take triangles only are given quads as two triangles, cut from the first corner. What is missing is skipped.
Curvatures are positive where the surface bends away from the side of the normals, as those of a sphere.
"""

import subprocess
import time
from importlib.metadata import version

import numpy


def principal(mean, gaussian):
    """k1, k2 of H and K; equal where rounding or the estimator made H^2 less than K."""
    root = numpy.sqrt(numpy.maximum(mean**2 - gaussian, 0))
    return {"k1": mean + root, "k2": mean - root, "mean": mean, "gaussian": gaussian}


def of_principal(k1, k2):
    return {"k1": k1, "k2": k2, "mean": (k1 + k2) / 2, "gaussian": k1 * k2}


class PeerEstimator:
    """A method of a peer. It works on what the peer makes of a mesh."""

    fixed, gives = True, ("normal", "k", "mean", "gaussian")

    def __init__(self, peer, name, function):
        self.peer, self.name, self.function = peer, f"{peer.name} {name}", function

    def run(self, subject):
        return self.function(self.handle(subject))

    def handle(self, subject):
        if self.peer.name not in subject.handles:
            subject.handles[self.peer.name] = self.peer.prepare(subject.sample)
        return subject.handles[self.peer.name]

    def seconds(self, subject):
        """CPU time of the method alone, the peer's mesh being there."""
        handle = self.handle(subject)
        start = time.process_time()
        self.function(handle)
        return (time.process_time() - start) / getattr(self.function, "passes", 1)


class Libigl:
    name, package = "libigl", "libigl"

    def __init__(self):
        import igl

        self.igl, self.title = igl, f"libigl {version('libigl')}"
        kinds = {"uniform": "UNIFORM", "area": "AREA", "angle": "ANGLE"}
        self.methods = {f"per_vertex_normals {name}": self.normals(kind) for name, kind in kinds.items()}
        self.methods |= {f"principal_curvature {rings}": self.quadric(rings) for rings in (2, 5)}
        self.methods |= {"cotmatrix, gaussian_curvature": self.discrete}

    def prepare(self, sample):
        return sample.positions, sample.fans.astype(numpy.int64)

    def normals(self, kind):
        kind = getattr(self.igl, f"PER_VERTEX_NORMALS_WEIGHTING_TYPE_{kind}")
        return lambda mesh: {"normal": self.igl.per_vertex_normals(*mesh, kind)}

    def quadric(self, rings):
        return lambda mesh: of_principal(*self.igl.principal_curvature(*mesh, rings)[2:4])

    def discrete(self, mesh):
        """As in the library's tutorial, H with a sign."""
        positions, triangles = mesh
        area = self.igl.massmatrix(positions, triangles, self.igl.MASSMATRIX_TYPE_VORONOI).diagonal()
        vector = -(self.igl.cotmatrix(positions, triangles) @ positions) / (2 * area[:, None])
        normals = self.igl.per_vertex_normals(positions, triangles)
        mean = numpy.copysign(numpy.linalg.norm(vector, axis=1), (vector * normals).sum(1))
        return principal(mean, self.igl.gaussian_curvature(positions, triangles) / area)


class Vcg:
    name, package = "VCG", "pymeshlab"
    weights = {"average": "Simple Average", "angle": "By Angle", "area": "By Area", "max": "As defined by N. Max"}
    fits = {"quadric": "Quadric Fitting", "Taubin": "Taubin approximation"}

    def __init__(self):
        import pymeshlab

        self.pymeshlab, self.title = pymeshlab, f"VCG (PyMeshLab {version('pymeshlab')})"
        self.methods = {f"normals {name}": self.normals(mode) for name, mode in self.weights.items()}
        self.methods |= {f"principal directions, {name}": self.fit(method) for name, method in self.fits.items()}
        self.methods |= {"discrete curvature": self.discrete}

    def prepare(self, sample):
        meshes = self.pymeshlab.MeshSet(verbose=False)
        meshes.add_mesh(self.pymeshlab.Mesh(sample.positions, sample.fans))
        if not numpy.array_equal(meshes.current_mesh().vertex_matrix(), sample.positions):
            raise RuntimeError("PyMeshLab changed the mesh")
        return meshes

    def normals(self, mode):
        def run(meshes):
            meshes.compute_normal_per_vertex(weightmode=mode)
            return {"normal": meshes.current_mesh().vertex_normal_matrix()}

        return run

    def fit(self, method):
        def run(meshes):
            values = []
            for quantity in ("Min Curvature", "Max Curvature"):  # the filter gives one at a time
                meshes.compute_curvature_principal_directions_per_vertex(
                    method=method, curvcolormethod=quantity, autoclean=False
                )
                values.append(meshes.current_mesh().vertex_scalar_array())
            return of_principal(numpy.maximum(*values), numpy.minimum(*values))

        run.passes = 2
        return run

    def discrete(self, meshes):
        values = []
        for kind in ("Mean Curvature", "Gaussian Curvature"):
            meshes.compute_scalar_by_discrete_curvature_per_vertex(curvaturetype=kind)
            values.append(meshes.current_mesh().vertex_scalar_array())
        return principal(*values)


class Vtk:
    name, package = "VTK", "vtk"

    def __init__(self):
        import vtk
        from vtk.util import numpy_support

        self.vtk, self.support, self.title = vtk, numpy_support, f"VTK {version('vtk')}"
        # It warns at every vertex whose H^2 is less than K.
        vtk.vtkObject.GlobalWarningDisplayOff()
        self.methods = {
            "vtkPolyDataNormals": self.polygon_normals,
            "vtkTriangleMeshPointNormals": self.triangle_normals,
            "vtkCurvatures": self.curvatures,
        }

    def prepare(self, sample):
        whole = [sample.triangles, sample.quads] if len(sample.quads) else [sample.triangles]
        return self.data(sample.positions, whole), self.data(sample.positions, [sample.fans])

    def data(self, positions, faces):
        data, points, cells = self.vtk.vtkPolyData(), self.vtk.vtkPoints(), self.vtk.vtkCellArray()
        points.SetDataTypeToDouble()
        points.SetData(self.support.numpy_to_vtk(positions, deep=True))
        sizes = numpy.concatenate([[0], *(numpy.full(len(each), each.shape[1]) for each in faces)])
        corners = numpy.concatenate([each.ravel() for each in faces])
        offsets, corners = (self.support.numpy_to_vtkIdTypeArray(each, deep=True) for each in (sizes.cumsum(), corners))
        cells.SetData(offsets, corners)
        data.SetPoints(points)
        data.SetPolys(cells)
        return data

    def outputs(self, filter, data):
        filter.SetInputData(data)
        filter.Update()
        found = filter.GetOutput().GetPointData()
        arrays = [found.GetArray(index) for index in range(found.GetNumberOfArrays())]
        return {array.GetName(): self.support.vtk_to_numpy(array).astype(float) for array in arrays}

    def polygon_normals(self, meshes):
        filter = self.vtk.vtkPolyDataNormals()
        filter.SplittingOff()
        filter.ConsistencyOff()
        return {"normal": self.outputs(filter, meshes[0])["Normals"]}

    def triangle_normals(self, meshes):
        return {"normal": self.outputs(self.vtk.vtkTriangleMeshPointNormals(), meshes[1])["Normals"]}

    def curvatures(self, meshes):
        found = {}
        for kind in ("Minimum", "Maximum"):
            filter = self.vtk.vtkCurvatures()
            getattr(filter, f"SetCurvatureTypeTo{kind}")()
            found |= self.outputs(filter, meshes[1])
        names = {"k1": "Maximum", "k2": "Minimum", "mean": "Mean", "gaussian": "Gauss"}
        return {name: found[f"{kind}_Curvature"] for name, kind in names.items()}


class MeshLib:
    name, package = "MeshLib", "meshlib"

    def __init__(self):
        import meshlib.mrmeshnumpy as arrays
        import meshlib.mrmeshpy as meshes

        self.arrays, self.meshes, self.title = arrays, meshes, f"MeshLib {version('meshlib')}"
        self.methods = {
            "computePerVertNormals": self.normals(meshes.computePerVertNormals),
            "computePerVertPseudoNormals": self.normals(meshes.computePerVertPseudoNormals),
            "discrete curvatures": self.discrete,
        }

    def prepare(self, sample):
        """The mesh, and a third of the area of all triangles at each vertex."""
        a, b, c = sample.positions[sample.fans].swapaxes(0, 1)
        thirds = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1) / 6
        area = numpy.bincount(sample.fans.ravel(), numpy.repeat(thirds, 3))
        return self.arrays.meshFromFacesVerts(sample.fans.astype(numpy.int32), sample.positions), area

    def normals(self, function):
        return lambda mesh: {"normal": self.arrays.toNumpyArray(function(mesh[0]))}

    def discrete(self, mesh):
        """Its Gaussian curvature is an integral."""
        gaussian = self.arrays.getNumpyGaussianCurvature(mesh[0]) / mesh[1]
        return principal(self.arrays.getNumpyMeanCurvature(mesh[0]), gaussian)


class Program:
    """A library in C++: see cpp/peer.h. All its methods run at once, unless they are timed."""

    def __init__(self, path):
        self.path, self.process = path, None
        listed = subprocess.run([path, "--list"], capture_output=True, text=True, check=True).stdout
        self.title, *lines = listed.splitlines()
        self.name = self.title.split()[0]
        self.results = dict(reversed(line.split("\t")) for line in lines)
        self.methods = {name: self.method(name) for name in self.results}

    def method(self, name):
        return lambda found: found[name][1]

    def prepare(self, sample):
        return self.ask(sample, self.results)

    def ask(self, sample, wanted):
        """Of each method wanted, the seconds that it took and what it found."""
        if self.process is None:
            self.process = subprocess.Popen([self.path], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        bits = sum((name in wanted) << bit for bit, name in enumerate(self.results))
        head = numpy.array([bits, *map(len, (sample.positions, sample.triangles, sample.quads))])
        faces = [numpy.ascontiguousarray(each, numpy.int32) for each in (sample.triangles, sample.quads)]
        for array in (head, numpy.ascontiguousarray(sample.positions), *faces):
            self.process.stdin.write(array.tobytes())
        self.process.stdin.flush()
        return {name: self.read(len(sample.positions), self.results[name]) for name in self.results if name in wanted}

    def read(self, count, results):
        seconds = float(self.numbers(1)[0])
        found = self.numbers(count * {"normal": 3, "curvature": 2, "both": 5}[results]).reshape(count, -1)
        values = {"normal": found[:, :3]} if results != "curvature" else {}
        return seconds, values | (of_principal(*found[:, -2:].T) if results != "normal" else {})

    def numbers(self, count):
        read = self.process.stdout.read(8 * count)
        if len(read) != 8 * count:
            raise RuntimeError(f"{self.name} ended")
        return numpy.frombuffer(read)


class ProgramEstimator(PeerEstimator):
    def seconds(self, subject):
        """As the program says."""
        name = self.name.removeprefix(f"{self.peer.name} ")
        return self.peer.ask(subject.sample, [name])[name][0]


PROGRAMS = {"OpenMesh": "openmesh", "CGAL": "cgal"}


def peers(folder):
    """Estimators of all peers that are there, the names and versions of these, and a line for each that is not."""
    found, missing = [], []
    for name, file in PROGRAMS.items():
        if folder and (folder / file).exists():
            found.append((Program(folder / file), ProgramEstimator))
        else:
            missing.append(f"{name} was not there to compare with.")
    for kind in (Libigl, Vcg, Vtk, MeshLib):
        try:
            found.append((kind(), PeerEstimator))
        except ImportError:
            missing.append(f"{kind.name} was not there to compare with (Python package {kind.package}).")
    estimators = [Kind(peer, name, function) for peer, Kind in found for name, function in peer.methods.items()]
    return estimators, [peer.title for peer, _ in found], missing
