"""Meshes of trimesh: results go to `vertex_normals`, `vertex_attributes` and `face_attributes`.

Positions, faces and results are not copied. trimesh is not imported: whatever has these attributes will do.
"""

from __future__ import annotations

from typing import Any

from numpy.typing import NDArray

from . import curvature as _curvature
from . import normals as _normals
from ._hosts import By, attribute, chosen, way
from .curvature import Curvatures
from .normals import VertexNormals
from .segmentation import Segmentation
from .topology import Topology


def faces(mesh: Any) -> NDArray[Any]:
    """The mesh's triangles, `#F × 3`, in place."""
    found: NDArray[Any] = attribute(mesh, "faces", "trimesh")
    return found


def topology(mesh: Any) -> Topology:
    """The one-rings of the mesh, for several calls; they serve as long as its faces stay."""
    return Topology(faces(mesh), len(mesh.vertices))


def vertex_normals(mesh: Any, topology: Topology | None = None, **options: Any) -> VertexNormals:
    """Computes normals, to `mesh.vertex_normals`; options as of `umbilic.vertex_normals`.

    >>> import trimesh, umbilic
    >>> mesh = trimesh.creation.icosphere(3)
    >>> found = umbilic.trimesh.vertex_normals(mesh, weight="angle")
    >>> mesh.vertex_normals is found.normal
    True
    """
    found = _normals.vertex_normals(attribute(mesh, "vertices", "trimesh"), chosen(topology, faces, mesh), **options)
    mesh.vertex_normals = found.normal
    return found


def curvatures(mesh: Any, topology: Topology | None = None, **options: Any) -> Curvatures:
    """Computes curvatures, to `mesh.vertex_attributes` by the names of outputs; options as of `umbilic.curvatures`.

    >>> import trimesh, umbilic
    >>> mesh = trimesh.creation.icosphere(3, radius=2)
    >>> found = umbilic.trimesh.curvatures(mesh, outputs=["mean", "gaussian"])
    >>> print(f"{mesh.vertex_attributes['gaussian'].mean():.3f}")
    0.250
    """
    found = _curvature.curvatures(attribute(mesh, "vertices", "trimesh"), chosen(topology, faces, mesh), **options)
    mesh.vertex_attributes.update(vars(found))
    return found


def segment(mesh: Any, by: By = "features", **options: Any) -> Segmentation:
    """Segments the faces, labels to `mesh.face_attributes["segment"]`; options as of `umbilic.segment_features`,
    `segment_watershed` or `segment_regions`.

    >>> import trimesh, umbilic
    >>> mesh = trimesh.creation.box()
    >>> umbilic.trimesh.segment(mesh)
    Segmentation(6 segments of 12 faces)
    """
    found = way(by)(attribute(mesh, "vertices", "trimesh"), faces(mesh), **options)
    mesh.face_attributes["segment"] = found.labels
    return found
