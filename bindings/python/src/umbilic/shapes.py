"""Shape classes by the signs of mean and Gaussian curvature."""

from __future__ import annotations

from ctypes import byref, c_double, pointer

import numpy
from numpy.typing import ArrayLike

from . import _arrays as arrays
from . import _native as native
from ._arrays import Outputs, StatusArray
from ._run import Progress, Run
from .names import Simd


def shape_tolerance(positions: ArrayLike) -> float:
    """A tolerance for `shape_classes` that goes with the size of a mesh, in 1/length.

    >>> import umbilic
    >>> positions, _ = umbilic.examples.sphere(2)
    >>> 0 < umbilic.shape_tolerance(positions) < 1
    True
    """
    xyz = arrays.vectors(positions, "positions")
    tolerance = c_double()
    native.call(native.library.umb_shape_tolerance, arrays.points(xyz), byref(tolerance))
    return tolerance.value


def shape_classes(
    k1: ArrayLike,
    k2: ArrayLike,
    *,
    positions: ArrayLike | None = None,
    tolerance: float | None = None,
    status: ArrayLike | None = None,
    threads: int = 0,
    simd: Simd = "best",
    progress: Progress | None = None,
) -> StatusArray:
    """The shape class of each vertex, or face: a number of `Shape`, `#V` of uint8.

    k1, k2
        The principal curvatures, `#V`, in either order.
    positions
        Of which the default tolerance is taken; may be left out if there is a tolerance.
    tolerance
        H counts as 0 up to this, and K up to its square; 1/length. None for `shape_tolerance(positions)`.
    status
        The status bytes of the curvatures: isolated and degenerate vertices are undefined.

    >>> import umbilic
    >>> positions, faces = umbilic.examples.sphere(2)
    >>> k1, k2 = umbilic.curvatures(positions, faces, outputs=["k1", "k2"])
    >>> umbilic.Shape(umbilic.shape_classes(k1, k2, positions=positions)[0])
    <Shape.PEAK: 1>
    """
    larger, smaller = arrays.numbers(k1, "k1"), arrays.numbers(k2, "k2")
    if positions is None and tolerance is None:
        raise TypeError("shape_classes takes positions, or a tolerance")
    xyz = None if positions is None else arrays.vectors(positions, "positions")
    known = arrays.bytes_of(status, "status")
    points = arrays.points(xyz)
    run = Run(threads, simd, progress)
    options = native.sized(
        native.ShapeOptions,
        tolerance=arrays.limit(tolerance),
        points=None if xyz is None else pointer(points),
        status=arrays.byte_view(known),
        run=run.struct,
    )
    classes = numpy.empty(len(larger), numpy.uint8)
    written = Outputs((), {"status": classes}, {"status": classes.shape}, None).fields()["status"]
    views = arrays.scalars(larger, "vertices"), arrays.scalars(smaller, "vertices")
    run.call(native.library.umb_shape_classes, *views, options, written)
    return classes
