"""Surfaces of pyvista, `PolyData` of any polygons: results go to point data and cell data.

Points, connectivity, offsets and results are not copied, but for a segmentation's faces and labels: it keeps the faces,
which VTK may move, and pyvista may write into labels. Polygons stay polygons. pyvista is not imported.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy
from numpy.typing import NDArray

from . import curvature as _curvature
from . import normals as _normals
from ._hosts import By, attribute, chosen, regular, way
from .curvature import Curvatures
from .faces import Polygons
from .names import NO_SEGMENT
from .normals import VertexNormals
from .segmentation import Segmentation
from .topology import Topology


def faces(mesh: Any) -> NDArray[Any] | Polygons:
    """The mesh's polygons, in VTK's memory: an array if all have as many corners."""
    if not hasattr(mesh, "GetPolys"):
        raise TypeError(f"{type(mesh).__name__} is no PolyData: extract_surface() makes one")
    if mesh.n_strips:
        raise ValueError("the mesh has strips of triangles: triangulate() makes faces of them")
    in_numpy: Any = import_module("vtkmodules.util.numpy_support").vtk_to_numpy  # there wherever a PolyData is
    cells = mesh.GetPolys()
    return regular(in_numpy(cells.GetConnectivityArray()), in_numpy(cells.GetOffsetsArray()))


def topology(mesh: Any) -> Topology:
    """The one-rings of the mesh, for several calls; they serve as long as its faces stay."""
    return Topology(faces(mesh), mesh.n_points)


def vertex_normals(mesh: Any, topology: Topology | None = None, **options: Any) -> VertexNormals:
    """Computes normals, to the active normals of the point data; options as of `umbilic.vertex_normals`.

    >>> import pyvista, umbilic
    >>> mesh = pyvista.Cube()
    >>> mesh = mesh.clean()  # corners that faces share
    >>> found = umbilic.pyvista.vertex_normals(mesh)
    >>> mesh.point_data.active_normals_name
    'Normals'
    """
    found = _normals.vertex_normals(attribute(mesh, "points", "pyvista"), chosen(topology, faces, mesh), **options)
    mesh.point_data.active_normals = found.normal
    return found


def curvatures(mesh: Any, topology: Topology | None = None, **options: Any) -> Curvatures:
    """Computes curvatures, to the point data by the names of outputs; options as of `umbilic.curvatures`.

    >>> import pyvista, umbilic
    >>> mesh = pyvista.Icosphere(radius=2, nsub=3)
    >>> found = umbilic.pyvista.curvatures(mesh, outputs=["mean"])
    >>> print(f"{mesh['mean'].mean():.3f}")
    0.500
    """
    found = _curvature.curvatures(attribute(mesh, "points", "pyvista"), chosen(topology, faces, mesh), **options)
    for name, array in vars(found).items():
        mesh.point_data[name] = array
    return found


def segment(mesh: Any, by: By = "features", **options: Any) -> Segmentation:
    """Segments the faces, labels to the cell data "segment" (`NO_SEGMENT` for vertices and lines); options as of
    `umbilic.segment_features`, `segment_watershed` or `segment_regions`.

    >>> import pyvista, umbilic
    >>> umbilic.pyvista.segment(pyvista.Cube().clean())
    Segmentation(6 segments of 6 faces)
    """
    segmented = way(by)
    polygons = faces(mesh)
    kept = Polygons(*map(numpy.copy, polygons)) if isinstance(polygons, Polygons) else numpy.copy(polygons)
    found = segmented(attribute(mesh, "points", "pyvista"), kept, **options)
    # Faces are the last cells.
    labels = numpy.full(mesh.n_cells, NO_SEGMENT, numpy.uint32)
    labels[mesh.n_cells - found.face_count :] = found.labels
    mesh.cell_data["segment"] = labels
    return found
