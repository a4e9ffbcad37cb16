"""Which results to compute anew when vertices have moved."""

from __future__ import annotations

from ctypes import byref, c_size_t
from typing import Any

import numpy
from numpy.typing import ArrayLike

from . import _arrays as arrays
from . import _native as native
from ._arrays import IndexArray
from .curvature import CurvatureOptions, Prepared
from .model import AdaptiveModel, struct_of
from .names import Weight
from .normals import normal_options
from .topology import Topology


def affected_normals(
    topology: Topology,
    moved: ArrayLike,
    *,
    weight: Weight = "conformal",
    degree: int = 0,
    rings: int = 0,
    model: AdaptiveModel | None = None,
    status: ArrayLike | None = None,
) -> IndexArray:
    """The vertices whose normals may change as others move, each once: `vertices` of a call that brings them up to
    date. With the results that it leaves alone it gives the same bits as a call for all.

    moved
        The vertices that moved.
    weight, degree, rings, model
        Those of the call for the normals; adaptive jets need a model.
    status
        The status bytes of the normals as they were, `#V`, for shorter lists of jets.

    >>> import numpy, umbilic
    >>> positions, faces = umbilic.examples.sphere(3)
    >>> mesh = umbilic.Topology(faces, len(positions))
    >>> normals, status = umbilic.vertex_normals(positions, mesh)
    >>> positions[7] *= 1.1
    >>> vertices = umbilic.affected_normals(mesh, [7])
    >>> len(vertices)
    6
    >>> anew = umbilic.vertex_normals(positions, mesh, vertices=vertices, out={"normal": normals, "status": status})
    >>> numpy.array_equal(normals, umbilic.vertex_normals(positions, mesh).normal)
    True
    """
    known = struct_of(model)
    options = normal_options(weight, degree, rings, known)
    return _affected(native.library.umb_affected_normals, topology, moved, status, options)


def affected_curvatures(
    topology: Topology,
    moved: ArrayLike,
    options: CurvatureOptions | None = None,
    *,
    status: ArrayLike | None = None,
) -> IndexArray:
    """The vertices whose curvatures may change as others move, or as normals do that are given for them.

    options
        Those of the call for the curvatures, adaptive jets if None, which need a model. Not by `radius`.
    moved, status
        See `affected_normals`.

    >>> import umbilic
    >>> positions, faces = umbilic.examples.sphere(3)
    >>> mesh = umbilic.Topology(faces, len(positions))
    >>> len(umbilic.affected_curvatures(mesh, [7], umbilic.CurvatureOptions("meyer")))
    6
    """
    prepared = Prepared(CurvatureOptions() if options is None else options)
    return _affected(native.library.umb_affected_curvatures, topology, moved, status, prepared.struct)


def _affected(
    function: Any, topology: Topology, moved: ArrayLike, status: ArrayLike | None, options: Any
) -> IndexArray:
    if not isinstance(topology, Topology):
        raise TypeError(f"topology is a {type(topology).__name__}, not a Topology")
    vertices, known = arrays.index_list(moved, "moved"), arrays.bytes_of(status, "status")
    view = native.sized(
        native.Moved,
        vertices=arrays.address(vertices),
        vertex_count=len(vertices),
        status=arrays.byte_view(known),
    )
    # Room for any list; what is not written costs no memory.
    room: IndexArray = numpy.empty(topology.vertex_count, numpy.uint32)
    count = c_size_t()
    native.call(function, topology.handle, view, options, arrays.address(room), len(room), byref(count))
    found: IndexArray = room[: count.value].copy()
    return found
