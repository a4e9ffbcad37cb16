"""The names of weights, methods and the like, as the command line has them, and the bits of status bytes."""

from __future__ import annotations

from collections.abc import Mapping
from enum import IntEnum, IntFlag
from typing import Literal

Weight = Literal[
    "conformal",
    "uniform",
    "angle",
    "area",
    "max",
    "centroid-area",
    "centroid",
    "inverse-root-edges",
    "sine",
    "angle-edges",
    "jet",
    "adaptive-jet",
    "tilted-sections",
]
Method = Literal[
    "adaptive-jet",
    "jet",
    "quadric",
    "goldfeather",
    "tilted-sections",
    "least-squares",
    "taubin",
    "watanabe",
    "meyer",
    "angle-defect",
    "rusinkiewicz",
    "normal-cycle",
    "corrected-measure",
]
Section = Literal["symmetric-parabola", "circle", "parabola", "length-parabola"]
Simd = Literal["best", "portable", "sse2", "avx2", "avx512"]
Coordinates = Literal["height", "circle"]
Location = Literal["vertices", "faces"]

# The numbers are the order; `__args__` is what `typing.get_args` answers with.
WEIGHTS: tuple[Weight, ...] = Weight.__args__  # type: ignore[attr-defined]
METHODS: tuple[Method, ...] = Method.__args__  # type: ignore[attr-defined]
SECTIONS: tuple[Section, ...] = Section.__args__  # type: ignore[attr-defined]
SIMD_LEVELS: tuple[Simd, ...] = Simd.__args__  # type: ignore[attr-defined]
COORDINATES: tuple[Coordinates, ...] = Coordinates.__args__  # type: ignore[attr-defined]
LOCATIONS: tuple[Location, ...] = Location.__args__  # type: ignore[attr-defined]


def _numbers(names: tuple[str, ...]) -> Mapping[str, int]:
    return {name: number for number, name in enumerate(names)}


_NUMBERS = {
    "weight": _numbers(WEIGHTS),
    "method": _numbers(METHODS),
    "section": _numbers(SECTIONS),
    "simd": _numbers(SIMD_LEVELS),
    "coordinates": _numbers(COORDINATES),
    "at": _numbers(LOCATIONS),
}


def number(kind: str, name: str) -> int:
    """The library's number of a name."""
    try:
        return _NUMBERS[kind][name]
    except (KeyError, TypeError):
        raise ValueError(f"{kind} is {name!r}, none of {', '.join(_NUMBERS[kind])}") from None


class VertexStatus(IntFlag):
    """Bits of a vertex's status byte, and of `Topology.flags`; 0 is an ordinary interior vertex.

    >>> import numpy
    >>> status = numpy.array([0, 1, 144], numpy.uint8)
    >>> (status & VertexStatus.BOUNDARY) != 0
    array([False,  True, False])
    """

    BOUNDARY = 1  #: An edge at the vertex has only one face.
    NON_MANIFOLD = 2  #: The faces at the vertex do not form a single fan.
    WINDING = 4  #: The two faces of an edge at the vertex run through it in the same direction.
    ISOLATED = 8  #: No face uses the vertex; its results are zero.
    FALLBACK = 16  #: The estimator had nothing to work with, and a simpler one took its place.
    DEGENERATE = 32  #: Nothing at all could be computed; the results are zero. Also of a face without area.
    WIDENED = 64  #: The neighbourhood had too few vertices, or too few in general position, and was widened.
    CREASE = 128  #: Adaptive jets only: a crease, or a very coarse or noisy place.


class SectionStatus(IntFlag):
    """Bits of a section's status byte."""

    ONE_SIDED = 1  #: The plane meets the ring on one side only; its mirror image stands in for the other.
    NONE = 2  #: There is no section; its curvature is 0.


class PolylineStatus(IntFlag):
    """Bits of the status byte of a polyline's point."""

    END = 1  #: An end of an open polyline; its curvatures are 0.
    CUSP = 2  #: The next point lies exactly on the side of the previous one.
    COINCIDENT = 4  #: The point before or after coincides with it.


class Shape(IntEnum):
    """The shape classes of Besl & Jain, by the signs of H and K; H > 0 on a ball with outward normals."""

    UNDEFINED = 0  #: Nothing is known of the curvature.
    PEAK = 1  #: Convex in every direction, like a ball.
    RIDGE = 2  #: Convex in one direction and straight in the other, like a rod.
    SADDLE_RIDGE = 3  #: A saddle that is more convex than concave.
    FLAT = 4  #: Not curved.
    MINIMAL = 5  #: A saddle as convex as it is concave.
    PIT = 6  #: Concave in every direction, like a bowl.
    VALLEY = 7  #: Concave in one direction and straight in the other, like a gutter.
    SADDLE_VALLEY = 8  #: A saddle that is more concave than convex.


#: The label of faces that segmentations ignore: those of fewer than three distinct corners in a row.
NO_SEGMENT = 2**32 - 1
