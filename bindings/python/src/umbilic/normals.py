"""Normals of vertices and of faces."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from ctypes import pointer
from typing import Any, Literal

from numpy.typing import ArrayLike, NDArray

from . import _arrays as arrays
from . import _native as native
from ._arrays import FloatArray, Outputs, Result, StatusArray
from ._run import Progress, Run
from .faces import FaceArrays, Faces
from .model import AdaptiveModel, struct_of
from .names import Simd, Weight, number
from .topology import Topology, topology_of

NormalOutput = Literal["normal", "sum", "status"]
FaceOutput = Literal["normal", "area_vector", "status"]


class VertexNormals(Result):
    """What `vertex_normals` computes; has what was asked for."""

    normal: FloatArray  #: Unit normals, `#V × 3`; (0, 0, 0) where the status says isolated or degenerate.
    sum: FloatArray  #: The weighted sums before normalisation, `#V × 3`, in the weight's unit.
    status: StatusArray  #: `VertexStatus` bits, `#V`.


class FaceNormals(Result):
    """What `face_normals` computes; has what was asked for."""

    normal: FloatArray  #: Unit normals, `#F × 3`; (0, 0, 0) where a face has none.
    area_vector: FloatArray  #: Along the normal, as long as the area is large, `#F × 3`, length².
    status: StatusArray  #: 0 or `VertexStatus.DEGENERATE`, `#F`.


def normal_options(weight: str, degree: int, rings: int, model: Any, run: Run | None = None) -> Any:
    """The struct; `model` is one too, or None."""
    return native.sized(
        native.NormalOptions,
        weight=number("weight", weight),
        degree=arrays.unsigned(degree, "degree"),
        rings=arrays.unsigned(rings, "rings"),
        model=None if model is None else pointer(model),
        **({} if run is None else {"run": run.struct}),
    )


def vertex_normals(
    positions: ArrayLike,
    faces: Topology | Faces,
    *,
    weight: Weight = "conformal",
    degree: int = 0,
    rings: int = 0,
    model: AdaptiveModel | None = None,
    vertices: ArrayLike | None = None,
    outputs: Sequence[NormalOutput] = ("normal", "status"),
    out: Mapping[str, NDArray[Any]] | None = None,
    threads: int = 0,
    simd: Simd = "best",
    progress: Progress | None = None,
) -> VertexNormals:
    """Normals of the vertices of a mesh, on the side from which faces run counter-clockwise.

    Never NaN or infinite, and the same bits for any number of threads, any vectors and any list of vertices.

    positions
        `#V × 3`, finite. Arrays of float32 and float64 are read in place, whatever lies between their rows; other
        layouts and types are copied, to float64 if they are not float32.
    faces
        A `Topology`, or what makes one.
    weight
        How a normal weighs the faces around the vertex, or what it fits.
    degree
        Of the polynomial, for "jet" only: 1 to 4; 0 for 3.
    rings
        Rings of neighbours that a jet is fitted to, at most 8; 0 for as many as go with the weight.
    model
        What "adaptive-jet" knows of the mesh; None to learn it from all positions.
    vertices
        The vertices to compute; None for all. Elements of others are 0, or left alone in `out`.
    outputs
        What to compute: "normal", "sum", "status".
    out
        Arrays to write, by the name of the output; they count as asked for. float32 or float64 (uint8 for "status"),
        with rows that are contiguous: columns of a larger array will do, so long as no byte is shared with another
        array. Arrays that are not given are new, and of the positions' type.
    threads
        0 for as many as pay, 1 for the calling one alone.
    simd
        The widest vectors to use.
    progress
        Called now and then with the fraction done, on the calling thread. What it raises ends the call and is raised by
        it, as is a KeyboardInterrupt, with or without a callback; arrays in `out` are then written in part.

    >>> import numpy, umbilic
    >>> positions, faces = umbilic.examples.sphere(2)
    >>> normals, status = umbilic.vertex_normals(positions, faces, weight="max")
    >>> numpy.allclose(normals, positions, atol=1e-12)  # exact on spheres
    True
    """
    xyz = arrays.vectors(positions, "positions")
    listed = None if vertices is None else arrays.index_list(vertices, "vertices")
    topology = topology_of(faces, len(xyz), threads, simd)
    count = topology.vertex_count
    shapes = {"normal": (count, 3), "sum": (count, 3), "status": (count,)}
    results = Outputs(outputs, out, shapes, xyz.dtype, listed is not None, [xyz, listed])
    run, known = Run(threads, simd, progress, listed), struct_of(model)
    options = normal_options(weight, degree, rings, known, run)
    written = native.sized(native.NormalOutputs, **results.fields())
    run.call(native.library.umb_vertex_normals, topology.handle, arrays.points(xyz), options, written)
    return VertexNormals(results.arrays)


def face_normals(
    positions: ArrayLike,
    faces: Faces,
    *,
    outputs: Sequence[FaceOutput] = ("normal", "status"),
    out: Mapping[str, NDArray[Any]] | None = None,
    threads: int = 0,
    simd: Simd = "best",
    progress: Progress | None = None,
) -> FaceNormals:
    """Unit vectors along each face's area vector: right for triangles, concave and non-planar polygons, collinear and
    repeated corners. Double precision, rounded to the type of the output.

    Arguments as of `vertex_normals`; outputs are "normal", "area_vector" and "status".

    >>> import numpy, umbilic
    >>> positions, faces = umbilic.examples.cube()
    >>> vectors = umbilic.face_normals(positions, faces, outputs=["area_vector"]).area_vector
    >>> numpy.linalg.norm(vectors, axis=1)
    array([1., 1., 1., 1., 1., 1.])
    """
    xyz, given = arrays.vectors(positions, "positions"), FaceArrays(faces)
    shapes = {"normal": (given.count, 3), "area_vector": (given.count, 3), "status": (given.count,)}
    results = Outputs(outputs, out, shapes, xyz.dtype, inputs=[xyz, given.indices, given.offsets])
    run = Run(threads, simd, progress)
    options = native.sized(native.FaceOptions, run=run.struct)
    written = native.sized(native.FaceOutputs, **results.fields())
    with given.explained():
        run.call(native.library.umb_face_normals, given.view(), arrays.points(xyz), options, written)
    return FaceNormals(results.arrays)
