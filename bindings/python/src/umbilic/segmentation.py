"""The faces of a mesh in segments: by creases, by watershed, by regions of one shape."""

from __future__ import annotations

from ctypes import byref, c_void_p, pointer
from typing import Any

import numpy
from numpy.typing import ArrayLike, NDArray

from . import _arrays as arrays
from . import _native as native
from ._arrays import IndexArray
from ._owner import Owner
from ._run import Progress, Run
from .corners import CreaseArrays
from .curvature import CurvatureOptions, Prepared
from .faces import FaceArrays, Faces
from .names import Location, Simd


class Segmentation(Owner):
    """A label for each face. Labels are numbers from 0, in the order of the smallest face of each segment.

    It may be used by any number of threads at once, and is freed with the last reference, or by `close`. For `areas` and
    `means` it keeps the faces that it was made of, in place if they were read there: leave them as they are.
    """

    _name = "segmentation"

    def __init__(self, handle: native.Handle, faces: FaceArrays) -> None:
        self._held = handle
        self._faces = faces
        #: The number of segments.
        self.count: int = native.library.umb_segmentation_count(handle)
        #: The number of faces, ignored ones included.
        self.face_count: int = native.library.umb_segmentation_face_count(handle)

    def __len__(self) -> int:
        return self.count

    def __repr__(self) -> str:
        state = ", closed" if self.closed else ""
        return f"Segmentation({self.count} segments of {self.face_count} faces{state})"

    @property
    def labels(self) -> IndexArray:
        """The label of each face, `#F`: below `count`, or `NO_SEGMENT`; read-only."""
        handle = self.handle
        return arrays.memory(handle, native.library.umb_segmentation_labels(handle), self.face_count, numpy.uint32)

    @property
    def boundary_edges(self) -> IndexArray:
        """The edges between segments, `#E × 2`, each once, the lower vertex first, ascending; read-only."""
        handle = self.handle
        count = native.library.umb_segmentation_boundary_edge_count(handle)
        data = native.library.umb_segmentation_boundary_edges(handle)
        return arrays.memory(handle, data, 2 * count, numpy.uint32).reshape(-1, 2)

    def areas(self, positions: ArrayLike) -> NDArray[numpy.float64]:
        """The area of each segment, length²; `positions` of all vertices, those of then or others."""
        xyz = arrays.vectors(positions, "positions")
        areas = numpy.empty(self.count)
        native.call(
            native.library.umb_segmentation_areas,
            self.handle,
            self._faces.view(),
            arrays.points(xyz),
            arrays.address(areas),
            len(areas),
        )
        return areas

    def means(self, positions: ArrayLike, values: ArrayLike, at: Location = "vertices") -> NDArray[numpy.float64]:
        """The mean over each segment of numbers at vertices, `#V`, or at faces, `#F`, weighted by area."""
        xyz, given = arrays.vectors(positions, "positions"), arrays.numbers(values, "values")
        means = numpy.empty(self.count)
        native.call(
            native.library.umb_segmentation_means,
            self.handle,
            self._faces.view(),
            arrays.points(xyz),
            arrays.scalars(given, at),
            arrays.address(means),
            len(means),
        )
        return means


def segment_features(
    positions: ArrayLike,
    faces: Faces,
    *,
    angle: float | None = None,
    edges: ArrayLike | None = None,
    groups: ArrayLike | None = None,
    threads: int = 0,
    simd: Simd = "best",
    progress: Progress | None = None,
) -> Segmentation:
    """The parts that creases bound: faces that meet are in one segment unless the edge between them is a crease.

    `angle`, `edges` and `groups` say which edges are creases: see `Cut`; other arguments as of `vertex_normals`.

    >>> import umbilic
    >>> positions, faces = umbilic.examples.cube()
    >>> found = umbilic.segment_features(positions, faces)
    >>> found, found.labels, found.areas(positions)
    (Segmentation(6 segments of 6 faces), array([0, 1, 2, 3, 4, 5], dtype=uint32), array([1., 1., 1., 1., 1., 1.]))
    """
    xyz, given = arrays.vectors(positions, "positions"), FaceArrays(faces)
    creases = CreaseArrays(angle, edges, groups, given)
    run = Run(threads, simd, progress)
    options = native.sized(native.FeatureOptions, creases=pointer(creases.struct), run=run.struct)
    return _segment(native.library.umb_segment_features, given, arrays.points(xyz), options, run)


def segment_watershed(
    positions: ArrayLike,
    faces: Faces,
    *,
    height: ArrayLike | None = None,
    at: Location = "vertices",
    depth: float | None = None,
    curvature: CurvatureOptions | None = None,
    threads: int = 0,
    simd: Simd = "best",
    progress: Progress | None = None,
) -> Segmentation:
    """The basins of a height over the faces, merged by depth as they meet.

    height, at
        Low inside segments, high between them, at "vertices" (`#V`) or at "faces" (`#F`); None for curvedness.
    depth
        Basins less deep than this are merged with the neighbour over the lowest pass, in the unit of the height. None:
        of a given height none, of curvedness those of less than four times `shape_tolerance`. 0: none.
    curvature
        How curvedness is computed; None for adaptive jets.

    Other arguments as of `vertex_normals`.

    >>> import umbilic
    >>> positions, faces = umbilic.examples.sphere(3)
    >>> umbilic.segment_watershed(positions, faces, height=-abs(positions[:, 2]), depth=0.1)
    Segmentation(2 segments of 1280 faces)
    """
    xyz, given = arrays.vectors(positions, "positions"), FaceArrays(faces)
    heights = None if height is None else arrays.numbers(height, "height")
    view = None if heights is None else arrays.scalars(heights, at)
    prepared = Prepared(CurvatureOptions() if curvature is None else curvature)
    run = Run(threads, simd, progress)
    options = native.sized(
        native.WatershedOptions,
        depth=arrays.limit(depth),
        height=None if view is None else pointer(view),
        curvature=pointer(prepared.struct),
        run=run.struct,
    )
    return _segment(native.library.umb_segment_watershed, given, arrays.points(xyz), options, run)


def segment_regions(
    positions: ArrayLike,
    faces: Faces,
    *,
    smallest_share: float | None = None,
    smallest_faces: int = 0,
    tolerance: float | None = None,
    classes: ArrayLike | None = None,
    angle: float | None = None,
    edges: ArrayLike | None = None,
    groups: ArrayLike | None = None,
    curvature: CurvatureOptions | None = None,
    threads: int = 0,
    simd: Simd = "best",
    progress: Progress | None = None,
) -> Segmentation:
    """Regions of one shape: flat, cylindrical, spherical and saddle parts, whether creases bound them or not.

    smallest_share
        Regions of less than this share of the whole area become part of a neighbour, 0 to 1; None for 0.0005.
    smallest_faces
        As do regions of fewer faces.
    tolerance
        That of `shape_classes`, 1/length; None for twice `shape_tolerance(positions)`.
    classes
        A number of `Shape` for each vertex, `#V` of uint8; None to have them computed.
    angle, edges, groups
        Creases, which regions do not grow across: see `Cut`.
    curvature
        How curvatures are computed; None for adaptive jets.

    Other arguments as of `vertex_normals`.

    >>> import umbilic
    >>> positions, faces = umbilic.examples.sphere(3)
    >>> umbilic.segment_regions(positions, faces)
    Segmentation(1 segments of 1280 faces)
    """
    xyz, given = arrays.vectors(positions, "positions"), FaceArrays(faces)
    creases = CreaseArrays(angle, edges, groups, given)
    known = arrays.bytes_of(classes, "classes")
    prepared = Prepared(CurvatureOptions() if curvature is None else curvature)
    run = Run(threads, simd, progress)
    options = native.sized(
        native.RegionOptions,
        smallest_share=arrays.limit(smallest_share),
        tolerance=arrays.limit(tolerance),
        smallest_faces=arrays.unsigned(smallest_faces, "smallest_faces", 64),
        creases=pointer(creases.struct),
        classes=arrays.byte_view(known),
        curvature=pointer(prepared.struct),
        run=run.struct,
    )
    return _segment(native.library.umb_segment_regions, given, arrays.points(xyz), options, run)


def _segment(function: Any, faces: FaceArrays, points: Any, options: Any, run: Run) -> Segmentation:
    made = c_void_p()
    try:
        with faces.explained():
            run.call(function, faces.view(), points, options, byref(made))
    finally:  # a callback may have raised when all was done
        handle = native.Handle(made.value, native.library.umb_segmentation_destroy)
    return Segmentation(handle, faces)
