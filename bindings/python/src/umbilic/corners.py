"""Meshes cut along their creases, and normals of corners, which are those of the cut mesh."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from ctypes import byref, c_void_p
from typing import Any, Literal

import numpy
from numpy.typing import ArrayLike, NDArray

from . import _arrays as arrays
from . import _native as native
from ._arrays import FloatArray, IndexArray, Outputs, Result, StatusArray
from ._owner import Owner
from ._run import Progress, Run, topology_options
from .faces import FaceArrays, Faces, Polygons
from .model import AdaptiveModel, struct_of
from .names import Simd, Weight
from .normals import normal_options
from .topology import Topology

CornerOutput = Literal["corner", "normal", "sum", "status"]


class CreaseArrays:
    """Which edges are creases, as a struct, with what it points into."""

    def __init__(
        self, angle: float | None, edges: ArrayLike | None, groups: ArrayLike | None, faces: FaceArrays
    ) -> None:
        self.edges = None if edges is None else arrays.indices(edges, "edges")
        if self.edges is not None and self.edges.shape != (0,) and (self.edges.ndim != 2 or self.edges.shape[1] != 2):
            raise ValueError(f"edges have the shape {self.edges.shape}, not (n, 2)")
        self.groups = None if groups is None else arrays.index_list(groups, "groups")
        if self.groups is not None and len(self.groups) != faces.count:
            raise ValueError(f"there are {len(self.groups)} groups, but {faces.count} faces")
        self.struct = native.sized(
            native.Creases,
            angle=arrays.limit(angle),
            edges=None if self.edges is None else arrays.address(self.edges),
            edge_count=0 if self.edges is None else len(self.edges),
            groups=None if self.groups is None else arrays.address(self.groups),
            group_count=0 if self.groups is None else len(self.groups),
        )


class Cut(Owner):
    """A mesh cut open along its creases: a vertex for each run of faces around a vertex that no crease divides.

    Whatever is computed over its `topology` stops at creases: normals become corner normals, and fits and curvatures of
    one side take nothing from the other. It may be used by any number of threads at once, and is freed with the last
    reference, or by `close`. As positions move, the cut stays.

    positions, faces, threads, simd
        See `vertex_normals`.
    angle
        An edge is a crease if the normals of its two faces differ by more, in radians. None for 30 degrees, or if
        `edges` or `groups` are given for none.
    edges
        Edges that are creases, `#E × 2` vertices.
    groups
        The smoothing group of each face, `#F`: an edge is a crease where they differ or are 0.

    >>> import umbilic
    >>> positions, faces = umbilic.examples.cube()
    >>> cut = umbilic.Cut(positions, faces)
    >>> cut
    Cut(24 vertices, 24 corners)
    >>> result = umbilic.curvatures(cut.points(positions), cut.topology, outputs=["mean"])
    >>> float(abs(result.mean).max())
    0.0
    """

    _name = "cut mesh"

    def __init__(
        self,
        positions: ArrayLike,
        faces: Faces,
        *,
        angle: float | None = None,
        edges: ArrayLike | None = None,
        groups: ArrayLike | None = None,
        threads: int = 0,
        simd: Simd = "best",
    ) -> None:
        xyz, given = arrays.vectors(positions, "positions"), FaceArrays(faces)
        creases = CreaseArrays(angle, edges, groups, given)
        pointer = c_void_p()
        options = topology_options(threads, simd)
        with given.explained():
            native.call(
                native.library.umb_cut_create, given.view(), arrays.points(xyz), creases.struct, options, byref(pointer)
            )
        self._held = native.Handle(pointer.value, native.library.umb_cut_destroy)
        self._faces = given
        self._original_count = len(xyz)
        #: The number of vertices of the cut mesh.
        self.vertex_count: int = native.library.umb_cut_vertex_count(self._held)
        #: The number of corners, those of ignored faces included.
        self.corner_count: int = native.library.umb_cut_corner_count(self._held)

    def __repr__(self) -> str:
        return f"Cut({self.vertex_count} vertices, {self.corner_count} corners{', closed' if self.closed else ''})"

    @property
    def topology(self) -> Topology:
        """The topology of the cut mesh."""
        handle = self.handle
        return Topology._of(native.Handle(native.library.umb_cut_topology(handle), owner=handle))

    @property
    def corners(self) -> IndexArray:
        """The vertex of the cut mesh at each corner, `#C`, in the order of the indices of the faces; read-only."""
        handle = self.handle
        return arrays.memory(handle, native.library.umb_cut_corners(handle), self.corner_count, numpy.uint32)

    @property
    def faces(self) -> IndexArray | Polygons:
        """The faces of the cut mesh: its corners, in the form of the faces that were cut."""
        return self._faces.shaped(self.corners)

    @property
    def origins(self) -> IndexArray:
        """The original vertex of each vertex of the cut mesh, ascending; read-only."""
        handle = self.handle
        return arrays.memory(handle, native.library.umb_cut_origins(handle), self.vertex_count, numpy.uint32)

    @property
    def starts(self) -> IndexArray:
        """From vertex v come the vertices of the cut mesh from `starts[v]` up to `starts[v + 1]`; read-only."""
        handle = self.handle
        return arrays.memory(handle, native.library.umb_cut_starts(handle), self._original_count + 1, numpy.uint32)

    def points(self, positions: ArrayLike) -> FloatArray:
        """Positions, or other vectors of the original vertices, for each vertex of the cut mesh."""
        xyz = arrays.vectors(positions, "positions")
        found = numpy.empty((self.vertex_count, 3), xyz.dtype)
        native.call(native.library.umb_cut_points, self.handle, arrays.points(xyz), arrays.output(found))
        return found


class CornerNormals(Result):
    """What `corner_normals` computes; has what was asked for."""

    corner: FloatArray  #: A unit normal for each corner, `#C × 3`, in the order of the indices of the faces.
    normal: FloatArray  #: The same normals, each once, by vertex of the cut mesh: `Cut.corners` are the index.
    sum: FloatArray  #: By vertex of the cut mesh: see `VertexNormals.sum`.
    status: StatusArray  #: `VertexStatus` bits by vertex of the cut mesh, on which a crease is a boundary.


def corner_normals(
    positions: ArrayLike,
    faces: Cut | Faces,
    *,
    angle: float | None = None,
    edges: ArrayLike | None = None,
    groups: ArrayLike | None = None,
    weight: Weight = "conformal",
    degree: int = 0,
    rings: int = 0,
    model: AdaptiveModel | None = None,
    vertices: ArrayLike | None = None,
    outputs: Sequence[CornerOutput] = ("corner",),
    out: Mapping[str, NDArray[Any]] | None = None,
    threads: int = 0,
    simd: Simd = "best",
    progress: Progress | None = None,
) -> CornerNormals:
    """A unit normal for each corner of each face: smooth where faces go on, split at creases.

    `weight="angle"` is what Blender takes, and what those expect who bake with MikkTSpace. Of triangles `#F × 3`, the
    normals are `corner.reshape(-1, 3, 3)`.

    faces
        What is cut, or a `Cut`, for normals as positions move.
    vertices
        Those of the cut mesh to compute, for all outputs but "corner".
    angle, edges, groups
        Which edges are creases: see `Cut`. Not beside a `Cut`.

    Other arguments as of `vertex_normals`.

    >>> import umbilic
    >>> positions, faces = umbilic.examples.cube()
    >>> normals = umbilic.corner_normals(positions, faces).corner.reshape(6, 4, 3)
    >>> normals[0]
    array([[-1.,  0.,  0.],
           [-1.,  0.,  0.],
           [-1.,  0.,  0.],
           [-1.,  0.,  0.]])
    """
    xyz = arrays.vectors(positions, "positions")
    if isinstance(faces, Cut):
        if any(each is not None for each in (angle, edges, groups)):
            raise TypeError("creases are those of the Cut: angle, edges and groups go without")
        cut = faces
    else:
        cut = Cut(xyz, faces, angle=angle, edges=edges, groups=groups, threads=threads, simd=simd)
    listed = None if vertices is None else arrays.index_list(vertices, "vertices")
    count = cut.vertex_count
    shapes = {"corner": (cut.corner_count, 3), "normal": (count, 3), "sum": (count, 3), "status": (count,)}
    results = Outputs(outputs, out, shapes, xyz.dtype, listed is not None, [xyz, listed])
    run, known = Run(threads, simd, progress, listed), struct_of(model)
    options = normal_options(weight, degree, rings, known, run)
    written = native.sized(native.CornerOutputs, **results.fields())
    run.call(native.library.umb_corner_normals, cut.handle, arrays.points(xyz), options, written)
    return CornerNormals(results.arrays)
