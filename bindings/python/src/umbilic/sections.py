"""Curvatures of normal sections: along every edge, and in given directions."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from ctypes import pointer
from dataclasses import dataclass
from typing import Any, Literal

import numpy
from numpy.typing import ArrayLike, NDArray

from . import _arrays as arrays
from . import _native as native
from ._arrays import FloatArray, Outputs, Result, StatusArray
from ._run import Progress, Run
from .faces import Faces
from .model import AdaptiveModel, struct_of
from .names import Section, Simd, Weight, number
from .topology import Topology, topology_of

SectionOutput = Literal["curvature", "status", "normal"]


class Sections(Result):
    """What `edge_sections` and `direction_sections` compute; has what was asked for."""

    curvature: FloatArray  #: 1/length; positive where the surface bends away from the normal.
    status: StatusArray  #: `SectionStatus` bits, one byte for each section.
    normal: FloatArray  #: The unit vertex normals that were used, `#V × 3`.


def edge_sections(
    positions: ArrayLike,
    topology: Topology,
    *,
    section: Section = "symmetric-parabola",
    weight: Weight = "conformal",
    normals: ArrayLike | None = None,
    normal_degree: int = 0,
    normal_rings: int = 0,
    model: AdaptiveModel | None = None,
    vertices: ArrayLike | None = None,
    outputs: Sequence[SectionOutput] = ("curvature", "status"),
    out: Mapping[str, NDArray[Any]] | None = None,
    threads: int = 0,
    simd: Simd = "best",
    progress: Progress | None = None,
) -> Sections:
    """The curvature of the section along every edge of every vertex's ring, with the vertex normal.

    Results are parallel to `topology.ring_neighbours`: those of vertex v are `[offsets[v]:offsets[v + 1]]`, by
    `topology.ring_offsets`. Arguments as of `curvatures`.

    >>> import numpy, umbilic
    >>> positions, faces = umbilic.examples.sphere(2)
    >>> mesh = umbilic.Topology(faces, len(positions))
    >>> curvature, status = umbilic.edge_sections(positions, mesh, section="circle", normals=positions)
    >>> numpy.allclose(curvature, 1, atol=1e-12)  # exact on spheres with exact normals
    True
    """
    if not isinstance(topology, Topology):
        raise TypeError("the rings of a Topology tell the sections apart: edge_sections takes no faces")
    count = int(topology.ring_offsets[-1])
    common = _Common(section, weight, normals, normal_degree, normal_rings, model, vertices)
    run = (threads, simd, progress)
    return common.compute(native.library.umb_edge_sections, positions, topology, (count,), outputs, out, run)


def direction_sections(
    positions: ArrayLike,
    faces: Topology | Faces,
    directions: ArrayLike,
    *,
    shared: bool = False,
    section: Section = "symmetric-parabola",
    weight: Weight = "conformal",
    normals: ArrayLike | None = None,
    normal_degree: int = 0,
    normal_rings: int = 0,
    model: AdaptiveModel | None = None,
    vertices: ArrayLike | None = None,
    outputs: Sequence[SectionOutput] = ("curvature", "status"),
    out: Mapping[str, NDArray[Any]] | None = None,
    threads: int = 0,
    simd: Simd = "best",
    progress: Progress | None = None,
) -> Sections:
    """Curvatures of normal sections in given directions of any length, each projected onto the tangent plane.

    directions
        `#V × 3`, one for each vertex, and results are `#V`; or, if `shared`, `#D × 3` for all vertices, and results are
        `#V × #D`.

    Other arguments as of `curvatures`.

    >>> import umbilic
    >>> positions, faces = umbilic.examples.sphere(3)
    >>> found = umbilic.direction_sections(positions, faces, [[1, 0, 0], [0, 1, 0]], shared=True)
    >>> found.curvature.shape
    (642, 2)
    """
    along = arrays.vectors(directions, "directions")
    xyz = arrays.vectors(positions, "positions")
    mesh = topology_of(faces, len(xyz), threads, simd)
    shape = (mesh.vertex_count, len(along)) if shared else (mesh.vertex_count,)
    common = _Common(section, weight, normals, normal_degree, normal_rings, model, vertices)
    run = (threads, simd, progress)
    return common.compute(native.library.umb_direction_sections, xyz, mesh, shape, outputs, out, run, along, shared)


@dataclass(frozen=True, eq=False)
class _Common:
    """What both kinds of sections are computed with."""

    section: Section
    weight: Weight
    normals: ArrayLike | None
    normal_degree: int
    normal_rings: int
    model: AdaptiveModel | None
    vertices: ArrayLike | None

    def compute(
        self,
        function: Any,
        positions: ArrayLike,
        topology: Topology,
        shape: tuple[int, ...],
        outputs: Sequence[SectionOutput],
        out: Mapping[str, NDArray[Any]] | None,
        run_options: tuple[int, Simd, Progress | None],
        directions: FloatArray | None = None,
        shared: bool = False,
    ) -> Sections:
        xyz = arrays.vectors(positions, "positions")
        normals = None if self.normals is None else arrays.vectors(self.normals, "normals")
        listed = None if self.vertices is None else arrays.index_list(self.vertices, "vertices")
        # Sections of a vertex lie next to each other, so to the library they are one row of numbers.
        shapes = dict.fromkeys(("curvature", "status"), (math.prod(shape),)) | {"normal": (topology.vertex_count, 3)}
        flat = {name: array if name == "normal" else _flat(array, name, shape) for name, array in (out or {}).items()}
        inputs = [xyz, normals, listed, directions]
        results = Outputs(outputs, flat, shapes, xyz.dtype, listed is not None, inputs)
        run, known = Run(*run_options, listed), struct_of(self.model)
        options = native.sized(
            native.SectionOptions,
            section=number("section", self.section),
            weight=number("weight", self.weight),
            shared=bool(shared),
            normals=arrays.points(normals),
            directions=arrays.points(directions),
            normal_degree=arrays.unsigned(self.normal_degree, "normal_degree"),
            normal_rings=arrays.unsigned(self.normal_rings, "normal_rings"),
            model=None if known is None else pointer(known),
            run=run.struct,
        )
        written = native.sized(native.SectionOutputs, **results.fields())
        run.call(function, topology.handle, arrays.points(xyz), options, written)
        return Sections(
            {name: array if name == "normal" else array.reshape(shape) for name, array in results.arrays.items()}
        )


def _flat(array: NDArray[Any], name: str, shape: tuple[int, ...]) -> NDArray[Any]:
    if len(shape) == 1 or not isinstance(array, numpy.ndarray):
        return array
    if array.shape != shape or not array.flags.c_contiguous:
        raise ValueError(
            f"out[{name!r}] has the shape {array.shape} and strides {array.strides}, not {shape}, contiguous"
        )
    return array.reshape(-1)
