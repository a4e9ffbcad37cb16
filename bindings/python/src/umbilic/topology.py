"""The one-rings of a mesh, built once from its faces and reused while positions move."""

from __future__ import annotations

import dataclasses
from ctypes import byref, c_size_t, c_void_p
from typing import NamedTuple

import numpy

from . import _arrays as arrays
from . import _native as native
from ._arrays import IndexArray, StatusArray
from ._owner import Owner
from ._run import topology_options
from .faces import FaceArrays, Faces
from .names import Simd


@dataclasses.dataclass(frozen=True)
class TopologyStats:
    """What a mesh is made of, and what is wrong with it."""

    vertex_count: int
    face_count: int  #: Ignored ones included.
    corner_count: int  #: Of the faces that are not ignored.
    edge_count: int  #: Each once, however many faces it has.
    boundary_edges: int  #: Edges with one face.
    non_manifold_edges: int  #: Edges with more than two faces.
    winding_edges: int  #: Edges whose two faces run through them in the same direction.
    isolated_vertices: int
    boundary_vertices: int
    non_manifold_vertices: int  #: Vertices whose faces do not form a single fan.
    degenerate_faces: int  #: Faces that name a vertex twice in a row, or that have fewer than three corners.
    ignored_faces: int  #: Degenerate faces of which fewer than three corners remain.
    duplicate_faces: int  #: Faces that run through the same vertices in the same order as an earlier one.
    component_count: int  #: Pieces, connected through shared vertices, isolated ones aside.
    boundary_loops: int  #: Closed loops of edges with one face.
    euler_characteristic: int
    max_valence: int
    bytes: int  #: Memory that the topology holds.


class Fan(NamedTuple):
    """A run of faces around a vertex in which each shares an edge with the next."""

    neighbours: IndexArray  #: Counter-clockwise; the library's memory, read-only.
    corner_count: int  #: The number of faces.
    closed: bool  #: Whether the last face meets the first.


class Topology(Owner):
    """The one-rings of a mesh.

    Built from faces alone, so it serves however positions move: functions of vertices take it in place of faces. It may
    be used by any number of threads at once, and is freed with the last reference, or by `close`.

    Faces are joined across an edge only where it has exactly two and they run through it in opposite directions. No
    mesh is refused for its shape.

    faces
        An array `#F × n` (triangles, quads …), `Polygons`, or a sequence of sequences of vertices, counter-clockwise
        seen from outside. Contiguous arrays of uint32, int32, uint64 and int64 are read in place.
    vertex_count
        The number of vertices, isolated ones included.
    threads, simd
        See `vertex_normals`.

    >>> import umbilic
    >>> with umbilic.Topology([[0, 1, 2], [0, 2, 3]], vertex_count=4) as mesh:
    ...     print(mesh, mesh.valence(0), mesh.ring(0), mesh.stats().boundary_loops)
    Topology(4 vertices, 2 faces) 3 [1 2 3] 1
    """

    _name = "topology"

    def __init__(self, faces: Faces, vertex_count: int, *, threads: int = 0, simd: Simd = "best") -> None:
        given = FaceArrays(faces)
        pointer = c_void_p()
        options = topology_options(threads, simd)
        count = arrays.unsigned(vertex_count, "vertex_count", 64)
        with given.explained():
            native.call(native.library.umb_topology_create, given.view(), count, options, byref(pointer))
        self._take(native.Handle(pointer.value, native.library.umb_topology_destroy))

    @classmethod
    def _of(cls, handle: native.Handle) -> Topology:
        self = cls.__new__(cls)
        self._take(handle)
        return self

    def _take(self, handle: native.Handle) -> None:
        self._held = handle
        #: The number of vertices.
        self.vertex_count: int = native.library.umb_topology_vertex_count(handle)
        #: The number of faces, ignored ones included.
        self.face_count: int = native.library.umb_topology_face_count(handle)

    def __repr__(self) -> str:
        state = ", closed" if self.closed else ""
        return f"Topology({self.vertex_count} vertices, {self.face_count} faces{state})"

    @property
    def flags(self) -> StatusArray:
        """The `VertexStatus` bits of each vertex that follow from the faces alone, `#V`; read-only."""
        handle = self.handle
        data = native.library.umb_topology_flags(handle)
        return arrays.memory(handle, data, self.vertex_count, numpy.uint8)

    @property
    def ring_offsets(self) -> IndexArray:
        """Where each vertex's ring starts in `ring_neighbours`, and the end of the last: `#V + 1`; read-only."""
        handle = self.handle
        data = native.library.umb_topology_ring_offsets(handle)
        return arrays.memory(handle, data, self.vertex_count + 1, numpy.uint32)

    @property
    def ring_neighbours(self) -> IndexArray:
        """The neighbours of all vertices, fan after fan, each counter-clockwise; read-only."""
        handle = self.handle
        data = native.library.umb_topology_ring_neighbours(handle)
        return arrays.memory(handle, data, int(self.ring_offsets[-1]), numpy.uint32)

    def ring(self, vertex: int) -> IndexArray:
        """The neighbours of a vertex, fan after fan, each counter-clockwise; read-only."""
        self.fan_count(vertex)  # refuses what is no vertex
        offsets = self.ring_offsets
        return self.ring_neighbours[offsets[vertex] : offsets[vertex + 1]]

    def valence(self, vertex: int) -> int:
        """The number of edges at a vertex."""
        return self._count(native.library.umb_topology_valence, vertex)

    def fan_count(self, vertex: int) -> int:
        """The number of fans of a vertex: 1 at a manifold vertex, 0 at an isolated one."""
        return self._count(native.library.umb_topology_fan_count, vertex)

    def _count(self, function: object, vertex: int) -> int:
        handle = self.handle
        count = c_size_t()
        native.call(function, handle, arrays.unsigned(vertex, "vertex", 64), byref(count))
        return count.value

    def fans(self, vertex: int) -> list[Fan]:
        """The fans of a vertex."""
        handle = self.handle
        found = []
        for index in range(self.fan_count(vertex)):
            fan = native.Fan()
            native.call(native.library.umb_topology_fan, handle, vertex, index, byref(fan))
            neighbours = arrays.memory(handle, fan.neighbours, fan.neighbour_count, numpy.uint32)
            found.append(Fan(neighbours, fan.corner_count, bool(fan.closed)))
        return found

    def stats(self) -> TopologyStats:
        """Counts elements, defects, components and boundary loops: linear in the size of the mesh."""
        handle = self.handle
        stats = native.sized(native.TopologyStats)
        native.call(native.library.umb_topology_get_stats, handle, stats)
        return TopologyStats(**{field.name: getattr(stats, field.name) for field in dataclasses.fields(TopologyStats)})


def topology_of(faces: Topology | Faces, vertex_count: int, threads: int, simd: Simd) -> Topology:
    """The topology given, or one for the call."""
    if isinstance(faces, Topology):
        return faces
    return Topology(faces, vertex_count, threads=threads, simd=simd)
