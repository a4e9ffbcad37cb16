"""Faces: arrays of triangles, quads or larger polygons, lists of polygons, and polygons by offsets."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import chain
from typing import Any, NamedTuple, Union

import numpy
from numpy.typing import ArrayLike, NDArray

from . import _native as native
from ._arrays import address
from ._owner import Owner
from .errors import InvalidArgument, Status


class Polygons(NamedTuple):
    """Faces of any number of corners: face f has `indices[offsets[f]:offsets[f + 1]]`.

    Arrays of uint32, int32, uint64 and int64 are read where they are if both are of one type.

    >>> Polygons.from_cells([3, 0, 1, 2, 4, 0, 2, 3, 4])
    Polygons(indices=array([0, 1, 2, 0, 2, 3, 4]), offsets=array([0, 3, 7]))
    """

    indices: NDArray[Any]  #: `#C`, the corners of one face after the other.
    offsets: NDArray[Any]  #: `#F + 1`, from 0 to `#C`.

    @classmethod
    def from_cells(cls, cells: ArrayLike) -> Polygons:
        """Of an array as VTK used to have them: the number of corners of a face, the corners, the next number …"""
        array = numpy.asarray(cells)
        if array.ndim != 1 or array.dtype.kind not in "iu":
            raise TypeError(f"cells have the type {array.dtype} and the shape {array.shape}, not integers and (n,)")
        starts = []
        place = 0
        while place < len(array):
            starts.append(place)
            if array[place] < 0:
                raise ValueError(f"cells[{place}] is {array[place]}, no number of corners")
            place += 1 + int(array[place])
        if place > len(array):
            raise ValueError(f"cells end within the face that starts at {starts[-1]}")
        corners = numpy.ones(len(array), bool)
        corners[starts] = False
        offsets = numpy.array([*starts, place]) - numpy.arange(len(starts) + 1)
        # Of 4 bytes, a type counts all corners; smaller ones may not.
        return cls(array[corners], offsets.astype(array.dtype) if array.itemsize >= 4 else offsets)


#: An array `#F × n` of indices, `Polygons`, or a sequence of sequences of vertices.
Faces = Union[NDArray[Any], Polygons, Sequence[Union[Sequence[int], NDArray[Any]]]]

_KINDS = {"uint32": 0, "int32": 1, "uint64": 2, "int64": 2}  # UMB_INDEX_


class FaceArrays:
    """Faces in arrays that the library can read.

    Signed indices of 64 bits are read as unsigned ones: those that are negative are then out of range.
    """

    def __init__(self, faces: Any) -> None:
        self.indices: NDArray[Any]
        self.offsets: NDArray[Any] | None = None
        self.arity = 0
        if isinstance(faces, Polygons):
            self.indices, self.offsets = _alike(_integers(faces.indices, 1), _integers(faces.offsets, 1))
            return
        if isinstance(faces, Owner):
            raise TypeError(f"a {type(faces).__name__} does not stand for faces here")
        if hasattr(faces, "__array__"):  # tables of data, too, some of which run over their columns
            faces = numpy.asarray(faces)
        if isinstance(faces, numpy.ndarray) and faces.dtype != object:
            self.indices = _integers(faces, 2)
            self.arity = faces.shape[1]
            if self.arity == 0:
                raise ValueError("faces have no corners")
        else:
            self._take(faces)

    def _take(self, faces: Any) -> None:
        """A sequence of sequences: an array if all are of one length."""
        faces = [face if isinstance(face, numpy.ndarray) and face.dtype != object else list(face) for face in faces]
        lengths = [len(face) for face in faces]
        if len(set(lengths)) == 1 and lengths[0]:
            self.indices, self.arity = _integers(numpy.asarray(faces), 2), lengths[0]
        elif not faces:
            self.indices, self.arity = numpy.empty((0, 3), numpy.uint32), 3
        else:
            indices = numpy.asarray(list(chain.from_iterable(faces)))
            if not len(indices):
                indices = indices.astype(numpy.int64)
            self.indices = _integers(indices, 1)
            self.offsets = numpy.concatenate([[0], numpy.cumsum(lengths)]).astype(self.indices.dtype)

    @property
    def count(self) -> int:
        return len(self.indices) if self.offsets is None else len(self.offsets) - 1

    def shaped(self, corners: NDArray[Any]) -> NDArray[Any] | Polygons:
        """Faces like these with other corners."""
        if self.offsets is None:
            return corners.reshape(-1, self.arity)
        return Polygons(corners, self.offsets.astype(corners.dtype))

    def view(self) -> native.Faces:
        return native.Faces(
            indices=address(self.indices),
            index_count=self.indices.size,
            offsets=None if self.offsets is None else address(self.offsets),
            face_count=self.count,
            index=_KINDS[self.indices.dtype.name],
            arity=self.arity,
        )

    @contextmanager
    def explained(self) -> Iterator[None]:
        """Errors in here tell a negative index of 64 bits as what it is."""
        try:
            yield
        except InvalidArgument as error:
            place = error.element
            signed = self.indices.dtype == numpy.int64
            if place is None or error.status != Status.INDEX_OUT_OF_RANGE or not signed or place >= self.indices.size:
                raise
            value = int(self.indices.flat[place])
            if value >= 0:  # an error of a callback's, say
                raise
            message = str(error).replace(str(value % 2**64), str(value))
            raise type(error)(message, error.status, place) from None


def _integers(values: Any, dimensions: int) -> NDArray[Any]:
    """A contiguous array of a type that the library reads, in place if it is one."""
    array = numpy.asarray(values)
    if array.dtype.kind not in "iu":
        raise TypeError(f"faces have elements of type {array.dtype}, not integers")
    if array.ndim != dimensions:
        shape = "(m, n)" if dimensions == 2 else "(n,)"
        raise ValueError(f"faces have the shape {array.shape}, not {shape}")
    if array.dtype.itemsize < 4:
        array = array.astype(numpy.int32)
    if not (array.dtype.isnative and array.flags.aligned and array.flags.c_contiguous):
        array = array.astype(array.dtype.newbyteorder("="), order="C")
    return array


def _alike(indices: NDArray[Any], offsets: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    if indices.dtype != offsets.dtype:
        # Signed, so that nothing negative is lost; what does not fit is out of range anyway.
        indices, offsets = indices.astype(numpy.int64), offsets.astype(numpy.int64)
    if not len(offsets):
        raise ValueError("offsets are empty, not one more than there are faces")
    return indices, offsets
