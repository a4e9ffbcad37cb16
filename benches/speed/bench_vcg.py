"""Times VCG through PyMeshLab's wheel, in double precision: see peer.py."""

import peer

WEIGHTS = {"average": "Simple Average", "angle": "By Angle", "area": "By Area", "max": "As defined by N. Max"}
OURS = {"average": "uniform", "angle": "angle", "area": "area", "max": "Max"}


class Vcg:
    def __init__(self, program: peer.Program):
        import numpy
        import pymeshlab

        self.pymeshlab, self.program = pymeshlab, program
        self.mesh = program.positions_double(), program.triangles().astype(numpy.int32)

    def structure(self):
        self.meshes = self.pymeshlab.MeshSet(verbose=False)
        self.meshes.add_mesh(self.pymeshlab.Mesh(*self.mesh))

    def normals(self, weight: str = "area"):
        self.meshes.compute_normal_per_vertex(weightmode=WEIGHTS[weight])

    def curvatures(self, method: str = "Taubin approximation"):
        self.meshes.compute_curvature_principal_directions_per_vertex(
            method=method, curvcolormethod="Mean Curvature", autoclean=False
        )

    def discrete(self):
        self.meshes.compute_scalar_by_discrete_curvature_per_vertex(curvaturetype="Mean Curvature")

    def add_tasks(self):
        self.program.add_ours("topology", "f64")
        self.program.add("VCG", "structure", "f64", self.structure)
        for weight, ours in OURS.items():
            self.program.add_ours(ours, "f64")
            self.program.add("VCG", f"normals {weight}", "f64", lambda weight=weight: self.normals(weight))
        if self.program.small():
            self.program.add_ours("Meyer, on given normals", "f64")
            self.program.add("VCG", "discrete mean curvature", "f64", self.discrete)
            self.program.add_ours("Taubin", "f64")
            self.program.add("VCG", "principal directions, Taubin", "f64", self.curvatures)
            self.program.add_ours("quadric", "f64")
            fit = lambda: self.curvatures("Quadric Fitting")
            self.program.add("VCG", "principal directions, quadric fitting", "f64", fit)


peer.serve("vcg", Vcg)
