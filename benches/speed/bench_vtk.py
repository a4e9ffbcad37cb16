"""Times VTK's wheel, on positions in single precision: see peer.py. With two threads, its backend is STDThread."""

import peer


class Vtk:
    def __init__(self, program: peer.Program):
        import numpy
        import vtk
        from vtk.util import numpy_support

        self.vtk, self.support, self.program = vtk, numpy_support, program
        vtk.vtkObject.GlobalWarningDisplayOff()
        vtk.vtkSMPTools.SetBackend("STDThread" if program.threads > 1 else "Sequential")
        vtk.vtkSMPTools.Initialize(program.threads)
        corners = program.triangles().astype(numpy.int64).ravel()
        self.mesh = program.positions(), numpy.arange(0, len(corners) + 1, 3), corners

    def structure(self):
        positions, offsets, corners = self.mesh
        points, cells, self.data = self.vtk.vtkPoints(), self.vtk.vtkCellArray(), self.vtk.vtkPolyData()
        points.SetData(self.support.numpy_to_vtk(positions, deep=True))
        cells.SetData(*(self.support.numpy_to_vtkIdTypeArray(each, deep=True) for each in (offsets, corners)))
        self.data.SetPoints(points)
        self.data.SetPolys(cells)

    def run(self, filter):
        filter.SetInputData(self.data)
        filter.Update()

    def normals(self):
        self.run(self.vtk.vtkTriangleMeshPointNormals())

    def polygon_normals(self):
        filter = self.vtk.vtkPolyDataNormals()
        filter.SplittingOff()
        filter.ConsistencyOff()
        self.run(filter)

    def curvatures(self, kind: str = "Mean"):
        filter = self.vtk.vtkCurvatures()
        getattr(filter, f"SetCurvatureTypeTo{kind}")()
        self.run(filter)

    def add_tasks(self):
        add, ours = self.program.add, self.program.add_ours
        ours("topology", "f32")
        add("VTK", "structure", "f32", self.structure)
        ours("area", "f32")
        add("VTK", "vtkTriangleMeshPointNormals", "f32", self.normals)
        ours("uniform", "f32")
        add("VTK", "vtkPolyDataNormals, no splitting", "f32", self.polygon_normals)
        ours("angle defect", "f32")
        add("VTK", "vtkCurvatures, Gauss", "f32", lambda: self.curvatures("Gaussian"))
        if self.program.small():
            ours("normal cycle, on given normals", "f32")
            add("VTK", "vtkCurvatures, mean", "f32", self.curvatures)


peer.serve("vtk", Vtk)
