"""Times Open3D's wheel: its meshes in double precision, and its tensors in single precision. See peer.py."""

import peer


class Open3D:
    def __init__(self, program: peer.Program):
        import numpy
        import open3d

        self.open3d, self.program = open3d, program
        self.positions, self.triangles = program.positions(), program.triangles().astype(numpy.int32)

    def structure(self):
        utility = self.open3d.utility
        self.mesh = self.open3d.geometry.TriangleMesh(
            utility.Vector3dVector(self.program.positions_double()), utility.Vector3iVector(self.triangles)
        )

    def tensors(self):
        tensor = self.open3d.core.Tensor
        self.tensor_mesh = self.open3d.t.geometry.TriangleMesh(tensor(self.positions), tensor(self.triangles))

    def normals(self):
        self.mesh.compute_vertex_normals()

    def tensor_normals(self):
        if "normals" in self.tensor_mesh.triangle:  # they would be taken as they are
            del self.tensor_mesh.triangle.normals
        self.tensor_mesh.compute_vertex_normals()

    def add_tasks(self):
        self.tensors()
        add, ours = self.program.add, self.program.add_ours
        ours("topology", "f64")
        add("Open3D", "structure", "f64", self.structure)
        ours("area", "f64")
        add("Open3D", "compute_vertex_normals", "f64", self.normals)
        ours("area", "f32")
        add("Open3D", "compute_vertex_normals of tensors", "f32", self.tensor_normals)


peer.serve("open3d", Open3D)
