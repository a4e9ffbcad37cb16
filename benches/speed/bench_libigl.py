"""Times libigl's Python wheel, in double precision: see peer.py. It takes arrays, and keeps no structure."""

import peer


class Libigl:
    def __init__(self, program: peer.Program):
        import igl
        import numpy

        self.igl, self.program = igl, program
        self.mesh = program.positions_double(), program.triangles().astype(numpy.int64)

    def structure(self):
        pass

    def normals(self, kind: str = "AREA"):
        return self.igl.per_vertex_normals(*self.mesh, getattr(self.igl, f"PER_VERTEX_NORMALS_WEIGHTING_TYPE_{kind}"))

    def curvatures(self):
        return self.igl.principal_curvature(*self.mesh, 2)

    def add_tasks(self):
        for kind in ("uniform", "area", "angle"):
            self.program.add_ours(kind, "f64")
            self.program.add("libigl", f"per_vertex_normals {kind}", "f64", lambda kind=kind: self.normals(kind.upper()))
        self.program.add_ours("angle defect", "f64")
        self.program.add("libigl", "gaussian_curvature", "f64", lambda: self.igl.gaussian_curvature(*self.mesh))
        if self.program.small():
            self.program.add_ours("jets 2, 2 rings", "f64")
            self.program.add("libigl", "principal_curvature, radius 2", "f64", self.curvatures)
            self.program.add_ours("jets 2, 5 rings", "f64")
            radius5 = lambda: self.igl.principal_curvature(*self.mesh, 5)
            self.program.add("libigl", "principal_curvature, radius 5", "f64", radius5)
        self.program.add_ours("topology", "f64")


peer.serve("libigl", Libigl)
