"""Times MeshLib's wheel, in single precision: see peer.py."""

import peer


class MeshLib:
    def __init__(self, program: peer.Program):
        import meshlib.mrmeshnumpy as arrays
        import meshlib.mrmeshpy as meshes
        import numpy

        self.arrays, self.meshes, self.program = arrays, meshes, program
        self.mesh_arrays = program.triangles().astype(numpy.int32), program.positions()

    def structure(self):
        self.mesh = self.arrays.meshFromFacesVerts(*self.mesh_arrays)

    def normals(self):
        self.meshes.computePerVertNormals(self.mesh)

    def add_tasks(self):
        add, ours = self.program.add, self.program.add_ours
        ours("topology", "f32")
        add("MeshLib", "structure", "f32", self.structure)
        ours("area", "f32")
        add("MeshLib", "computePerVertNormals", "f32", self.normals)
        ours("angle", "f32")
        add("MeshLib", "computePerVertPseudoNormals", "f32", lambda: self.meshes.computePerVertPseudoNormals(self.mesh))
        if self.program.small():
            ours("angle defect", "f32")
            add("MeshLib", "getNumpyGaussianCurvature", "f32", lambda: self.arrays.getNumpyGaussianCurvature(self.mesh))


peer.serve("meshlib", MeshLib)
