"""Normals, curvatures and segments of polygon meshes, and curvatures of polylines, on numpy's arrays.

>>> import numpy, umbilic
>>> positions, triangles = umbilic.examples.sphere(3)
>>> mesh = umbilic.Topology(triangles, len(positions))  # once: faces alone; positions may move
>>> normals, status = umbilic.vertex_normals(positions, mesh)
>>> k1, k2, direction1, direction2, status = umbilic.curvatures(positions, mesh)

Functions take faces, too, in place of the topology. Arrays are read and written where they are if their layouts allow;
results are the same bits for any number of threads; the interpreter's lock is released during calls. `umbilic.trimesh`,
`umbilic.pyvista` and `umbilic.meshio` take meshes of these packages and write results into them.
"""

from . import examples, meshio, pyvista, trimesh
from ._native import library as _library
from .affected import affected_curvatures, affected_normals
from .corners import CornerNormals, Cut, corner_normals
from .curvature import CurvatureOptions, Curvatures, curvatures
from .errors import Error, IndexOutOfRange, InvalidArgument, OutOfMemory, Status
from .faces import Faces, Polygons
from .model import AdaptiveModel, learn_model
from .names import (
    METHODS,
    NO_SEGMENT,
    SECTIONS,
    WEIGHTS,
    Coordinates,
    Location,
    Method,
    PolylineStatus,
    Section,
    SectionStatus,
    Shape,
    Simd,
    VertexStatus,
    Weight,
)
from .normals import FaceNormals, VertexNormals, face_normals, vertex_normals
from .polyline import PolylineCurvatures, polyline_curvatures
from .sections import Sections, direction_sections, edge_sections
from .segmentation import Segmentation, segment_features, segment_regions, segment_watershed
from .shapes import shape_classes, shape_tolerance
from .topology import Fan, Topology, TopologyStats

#: The version of the library.
__version__: str = _library.umb_version().decode()


def build_info() -> str:
    """Name and version of the library and the vectors that calls use by default, in one line for logs.

    >>> build_info().startswith("umbilic")
    True
    """
    info: bytes = _library.umb_build_info()
    return info.decode()


__all__ = [
    "METHODS",
    "NO_SEGMENT",
    "SECTIONS",
    "WEIGHTS",
    "AdaptiveModel",
    "Coordinates",
    "CornerNormals",
    "CurvatureOptions",
    "Curvatures",
    "Cut",
    "Error",
    "FaceNormals",
    "Faces",
    "Fan",
    "IndexOutOfRange",
    "InvalidArgument",
    "Location",
    "Method",
    "OutOfMemory",
    "Polygons",
    "PolylineCurvatures",
    "PolylineStatus",
    "Section",
    "SectionStatus",
    "Sections",
    "Segmentation",
    "Shape",
    "Simd",
    "Status",
    "Topology",
    "TopologyStats",
    "VertexNormals",
    "VertexStatus",
    "Weight",
    "affected_curvatures",
    "affected_normals",
    "build_info",
    "corner_normals",
    "curvatures",
    "direction_sections",
    "edge_sections",
    "examples",
    "face_normals",
    "learn_model",
    "meshio",
    "polyline_curvatures",
    "pyvista",
    "segment_features",
    "segment_regions",
    "segment_watershed",
    "shape_classes",
    "shape_tolerance",
    "trimesh",
    "vertex_normals",
]
