"""Meshes of meshio: results go to point data and cell data.

Points and results are not copied, nor is a block of faces that is the only one; several blocks are joined. Faces are
the blocks of triangles, quads and polygons; vertices and lines are left alone. meshio is not imported.
"""

from __future__ import annotations

from typing import Any

import numpy

from . import curvature as _curvature
from . import normals as _normals
from ._hosts import By, attribute, chosen, regular, way
from .curvature import Curvatures
from .faces import Faces
from .names import NO_SEGMENT
from .normals import VertexNormals
from .segmentation import Segmentation
from .topology import Topology

_ELSE = ("vertex", "line")


def _blocks(mesh: Any) -> list[Any]:
    found = []
    for block in attribute(mesh, "cells", "meshio"):
        if block.type in ("triangle", "quad", "polygon"):
            found.append(block)
        elif block.type not in _ELSE:
            raise ValueError(f"cells of the type {block.type!r} are no faces of a surface")
    if not found:
        raise ValueError("the mesh has no faces")
    return found


def faces(mesh: Any) -> Faces:
    """The mesh's faces, block after block: an array if all have as many corners."""
    blocks = [numpy.asarray(block.data) for block in _blocks(mesh) if len(block.data)]
    if not blocks:
        return numpy.empty((0, 3), numpy.int64)
    if len(blocks) == 1:
        return blocks[0]
    sizes = numpy.concatenate([numpy.full(len(block), block.shape[1]) for block in blocks])
    indices = numpy.concatenate([block.reshape(-1) for block in blocks], dtype=numpy.int64, casting="same_kind")
    return regular(indices, numpy.concatenate([[0], numpy.cumsum(sizes)]))


def topology(mesh: Any) -> Topology:
    """The one-rings of the mesh, for several calls; they serve as long as its faces stay."""
    return Topology(faces(mesh), len(mesh.points))


def vertex_normals(mesh: Any, topology: Topology | None = None, **options: Any) -> VertexNormals:
    """Computes normals, to the point data "Normals"; options as of `umbilic.vertex_normals`.

    >>> import meshio, umbilic
    >>> positions, quads = umbilic.examples.cube()
    >>> mesh = meshio.Mesh(positions, [("quad", quads)])
    >>> found = umbilic.meshio.vertex_normals(mesh)
    >>> mesh.point_data["Normals"] is found.normal
    True
    """
    found = _normals.vertex_normals(attribute(mesh, "points", "meshio"), chosen(topology, faces, mesh), **options)
    mesh.point_data["Normals"] = found.normal
    return found


def curvatures(mesh: Any, topology: Topology | None = None, **options: Any) -> Curvatures:
    """Computes curvatures, to the point data by the names of outputs; options as of `umbilic.curvatures`.

    >>> import meshio, umbilic
    >>> positions, triangles = umbilic.examples.sphere(3)
    >>> mesh = meshio.Mesh(positions, [("triangle", triangles)])
    >>> found = umbilic.meshio.curvatures(mesh, outputs=["mean"])
    >>> print(f"{mesh.point_data['mean'].mean():.3f}")
    1.000
    """
    found = _curvature.curvatures(attribute(mesh, "points", "meshio"), chosen(topology, faces, mesh), **options)
    mesh.point_data.update(vars(found))
    return found


def segment(mesh: Any, by: By = "features", **options: Any) -> Segmentation:
    """Segments the faces, labels to the cell data "segment" (`NO_SEGMENT` for vertices and lines); options as of
    `umbilic.segment_features`, `segment_watershed` or `segment_regions`.

    >>> import meshio, umbilic
    >>> positions, quads = umbilic.examples.cube()
    >>> mesh = meshio.Mesh(positions, [("quad", quads)])
    >>> umbilic.meshio.segment(mesh)
    Segmentation(6 segments of 6 faces)
    """
    found = way(by)(attribute(mesh, "points", "meshio"), faces(mesh), **options)
    labels, place = [], 0
    for block in mesh.cells:
        if block.type in _ELSE:
            labels.append(numpy.full(len(block.data), NO_SEGMENT, numpy.uint32))
        else:
            labels.append(found.labels[place : place + len(block.data)])
            place += len(block.data)
    mesh.cell_data["segment"] = labels
    return found
