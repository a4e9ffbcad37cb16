"""Curvatures at the points of a polyline, in the plane or in space."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

from numpy.typing import ArrayLike, NDArray

from . import _arrays as arrays
from . import _native as native
from ._arrays import FloatArray, Outputs, Result, StatusArray
from ._run import Progress, Run
from .names import Simd

PolylineOutput = Literal["circle", "parabola", "length_parabola", "symmetric_parabola", "status"]
_OUTPUTS: tuple[PolylineOutput, ...] = PolylineOutput.__args__  # type: ignore[attr-defined]


class PolylineCurvatures(Result):
    """What `polyline_curvatures` computes; has what was asked for.

    a and c are the edges from a point to those before and after it, φ the angle between them, d = |c - a|.
    """

    circle: FloatArray  #: Of the circle through the three points: 2 sin φ / d.
    parabola: FloatArray  #: Of the parabola with the parameters 0, 1/2, 1: 8 |a| |c| sin φ / d³.
    length_parabola: FloatArray  #: With the parameter in proportion to lengths: 2 (|a| + |c|)² sin φ / d³.
    symmetric_parabola: FloatArray  #: Symmetric about the bisector: 4 cos(φ/2) / ((|a| + |c|) sin²(φ/2)).
    status: StatusArray  #: `PolylineStatus` bits, `#V`.


def polyline_curvatures(
    points: ArrayLike,
    *,
    closed: bool = False,
    outputs: Sequence[PolylineOutput] = _OUTPUTS,
    out: Mapping[str, NDArray[Any]] | None = None,
    threads: int = 0,
    simd: Simd = "best",
    progress: Progress | None = None,
) -> PolylineCurvatures:
    """Four curvatures at each point of a polyline, `#V`, 1/length, each from the point and its two neighbours.

    In the plane, positive where the polyline turns left; in space, at least 0. The ends of an open one have 0.

    points
        `#V × 2` or `#V × 3`, read in place as positions are: see `vertex_normals`, also for the other arguments.
    closed
        Whether the last point is joined to the first.

    >>> import numpy, umbilic
    >>> angles = numpy.linspace(0, 2 * numpy.pi, 12, endpoint=False)
    >>> circle = numpy.stack([numpy.cos(angles), numpy.sin(angles)], axis=1)
    >>> umbilic.polyline_curvatures(2 * circle, closed=True).circle.round(12)
    array([0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5])
    """
    given = arrays.vectors(points, "points", columns=(2, 3))
    view = arrays.points(given)
    polyline = native.Polyline(
        data=view.data,
        count=view.count,
        stride=view.stride,
        scalar=view.scalar,
        dimension=given.shape[1],
        closed=bool(closed),
    )
    results = Outputs(outputs, out, dict.fromkeys(_OUTPUTS, (len(given),)), given.dtype, inputs=[given])
    run = Run(threads, simd, progress)
    options = native.sized(native.PolylineOptions, run=run.struct)
    written = native.sized(native.PolylineOutputs, **results.fields())
    run.call(native.library.umb_polyline_curvatures, polyline, options, written)
    return PolylineCurvatures(results.arrays)
