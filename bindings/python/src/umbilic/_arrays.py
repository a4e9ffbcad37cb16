"""numpy's arrays as the library's views: in place wherever its layouts allow, else copied.

Functions here answer with an array that the library can read or write, or with the view of one. Callers hold the arrays
in local variables for as long as the call runs; views hold nothing.
"""

from __future__ import annotations

import operator
import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy
from numpy.typing import ArrayLike, NDArray

from . import _native as native
from .errors import IndexOutOfRange, Status
from .names import number

FloatArray = NDArray[Any]  # of float32 or float64
StatusArray = NDArray[numpy.uint8]
IndexArray = NDArray[numpy.uint32]

_SCALARS = {numpy.dtype(numpy.float32): 0, numpy.dtype(numpy.float64): 1}


# What goes in.


def vectors(values: ArrayLike, name: str, columns: tuple[int, ...] = (3,)) -> FloatArray:
    """An array `#V x 3` of float32 or float64 whose rows are contiguous, and any number of scalars apart."""
    array = _floats(values, name)
    if array.ndim != 2 or array.shape[1] not in columns:
        shape = " or ".join(f"(n, {count})" for count in columns)
        raise ValueError(f"{name} has the shape {array.shape}, not {shape}")
    return _readable(array)


def numbers(values: ArrayLike, name: str) -> FloatArray:
    """An array `#V` of float32 or float64, any number of scalars apart."""
    array = _floats(values, name)
    if array.ndim != 1:
        raise ValueError(f"{name} has the shape {array.shape}, not (n,)")
    return _readable(array)


def _readable(array: NDArray[Any]) -> NDArray[Any]:
    return array if in_place(array) else array.astype(array.dtype.newbyteorder("="), order="C")


def _floats(values: ArrayLike, name: str) -> FloatArray:
    array = numpy.asarray(values)
    if array.dtype.newbyteorder("=") in _SCALARS:
        return array
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} has elements of type {array.dtype}, not float32 or float64")
    return array.astype(numpy.float64)


def in_place(array: NDArray[Any]) -> bool:
    """Whether the library can use the array where it is."""
    if not (array.flags.aligned and array.dtype.isnative):
        return False
    if array.size == 0 or len(array) == 1:
        # Of no elements, numpy says that they are aligned wherever they are not.
        return array.flags.c_contiguous and address(array) % array.dtype.alignment == 0
    size = array.itemsize
    row = size * array.shape[1] if array.ndim == 2 else size
    within = array.ndim == 1 or array.shape[1] == 1 or array.strides[1] == size
    return within and array.strides[0] >= row and array.strides[0] % size == 0


def indices(values: ArrayLike, name: str) -> IndexArray:
    """A contiguous array of uint32, as lists of vertices, edges and groups have to be."""
    array = numpy.asarray(values)
    if array.size == 0 and array.dtype.kind == "f":  # an empty list
        array = array.astype(numpy.uint32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} has elements of type {array.dtype}, not integers")
    if array.dtype != numpy.uint32 and array.size:
        bad = numpy.flatnonzero((array < 0) | (array > 2**32 - 1))
        if len(bad):
            message = f"{name}: element {bad[0]} is {array.flat[bad[0]]}, no index of 32 bits"
            raise IndexOutOfRange(message, Status.INDEX_OUT_OF_RANGE, int(bad[0]))
    found: IndexArray = numpy.require(array, numpy.uint32, ["C", "A"])
    return found


def index_list(values: ArrayLike, name: str) -> IndexArray:
    array = indices(values, name)
    if array.ndim != 1:
        raise ValueError(f"{name} has the shape {array.shape}, not (n,)")
    return array


def bytes_of(values: ArrayLike | None, name: str) -> StatusArray | None:
    """An array `#V` of bytes, or none."""
    if values is None:
        return None
    array = numpy.asarray(values)
    if array.dtype != numpy.uint8 or array.ndim != 1:
        raise TypeError(f"{name} has the type {array.dtype} and the shape {array.shape}, not uint8 and (n,)")
    return _readable(array)


def unsigned(value: Any, name: str, bits: int = 32) -> int:
    """An integer that the field of a struct can hold: ctypes would cut off what is too large."""
    integer = operator.index(value)
    if not 0 <= integer < 2**bits:
        raise ValueError(f"{name} is {integer}, not 0 to 2**{bits} - 1")
    return integer


def limit(value: float | None) -> float:
    """A limit for the library, for which 0 stands for its default and a tiny number for none."""
    if value is None:
        return 0.0
    return value or sys.float_info.min


# Views.


def address(array: NDArray[Any]) -> int:
    return int(array.ctypes.data)


def _stride(array: NDArray[Any]) -> int:
    return array.strides[0] if len(array) > 1 else 0


def points(array: FloatArray | None) -> native.Points:
    if array is None:
        return native.Points()
    return native.Points(data=address(array), count=len(array), stride=_stride(array), scalar=_SCALARS[array.dtype])


def scalars(array: FloatArray, at: str) -> native.Scalars:
    return native.Scalars(
        data=address(array),
        count=len(array),
        stride=_stride(array),
        scalar=_SCALARS[array.dtype],
        location=number("at", at),
    )


def byte_view(array: StatusArray | None) -> native.Bytes:
    if array is None:
        return native.Bytes()
    return native.Bytes(data=address(array), count=len(array), stride=_stride(array))


def memory(handle: native.Handle, pointer: int | None, count: int, dtype: Any) -> NDArray[Any]:
    """An array of the library's memory, read-only, that keeps the object it is part of."""
    if not count or not pointer:
        empty = numpy.empty(0, dtype)
        empty.flags.writeable = False
        return empty
    return numpy.asarray(_Memory(handle, pointer, count, dtype))


class _Memory:
    def __init__(self, handle: native.Handle, pointer: int, count: int, dtype: Any) -> None:
        self.handle = handle
        self.__array_interface__ = {
            "data": (pointer, True),
            "shape": (count,),
            "typestr": numpy.dtype(dtype).str,
            "version": 3,
        }


# What comes out.


class Outputs:
    """The arrays that a call writes: the caller's, or new ones; and the fields of a struct that name them."""

    def __init__(
        self,
        names: Sequence[str],
        out: Mapping[str, NDArray[Any]] | None,
        shapes: Mapping[str, tuple[int, ...]],
        dtype: Any,
        partial: bool = False,
        inputs: Iterable[NDArray[Any] | None] = (),
    ) -> None:
        """`shapes` of all outputs that there are; `partial` if not all elements will be written."""
        given = dict(out or {})
        if isinstance(names, str):
            names = (names,)
        self.arrays: dict[str, NDArray[Any]] = {}
        for name in dict.fromkeys([*names, *given]):
            if name not in shapes:
                raise ValueError(f"there is no output {name!r}, only {', '.join(shapes)}")
            if name in given:
                _check_output(given[name], name, shapes[name])
                self.arrays[name] = given[name]
            else:
                kind = numpy.uint8 if name == "status" else dtype
                # What is not written must not be what memory held before.
                self.arrays[name] = (numpy.zeros if partial else numpy.empty)(shapes[name], kind)
        _check_overlaps(given, inputs)

    def fields(self) -> dict[str, Any]:
        return {
            name: _status_output(array) if name == "status" else output(array) for name, array in self.arrays.items()
        }


def output(array: NDArray[Any]) -> native.Output:
    return native.Output(data=address(array), stride=_stride(array), scalar=_SCALARS[array.dtype])


def _status_output(array: NDArray[Any]) -> native.StatusOutput:
    return native.StatusOutput(data=address(array), stride=_stride(array))


def _check_output(array: Any, name: str, shape: tuple[int, ...]) -> None:
    if not isinstance(array, numpy.ndarray):
        raise TypeError(f"out[{name!r}] is no numpy array")
    if array.shape != shape:
        raise ValueError(f"out[{name!r}] has the shape {array.shape}, not {shape}")
    if name == "status":
        if array.dtype != numpy.uint8:
            raise TypeError(f"out['status'] has elements of type {array.dtype}, not uint8")
    elif array.dtype not in _SCALARS:
        raise TypeError(f"out[{name!r}] has elements of type {array.dtype}, not float32 or float64")
    if not array.flags.writeable:
        raise ValueError(f"out[{name!r}] is read-only")
    if not in_place(array):
        raise ValueError(
            f"out[{name!r}] has the strides {array.strides}: its rows have to be aligned, contiguous and in order"
        )


def _check_overlaps(given: Mapping[str, NDArray[Any]], inputs: Iterable[NDArray[Any] | None]) -> None:
    """Arrays of the caller's must not share a byte with any other of the call; they may be interleaved."""
    others = [("an input", array) for array in inputs if array is not None]
    for name, array in given.items():
        for other_name, other in others:
            if numpy.shares_memory(array, other):
                raise ValueError(f"out[{name!r}] overlaps {other_name}")
        others.append((f"out[{name!r}]", array))


class Result:
    """What a call has computed: an attribute for each output that was asked for.

    Unpacks in the order in which they were asked for; `vars(result)` is a dictionary of them.
    """

    def __init__(self, arrays: Mapping[str, NDArray[Any]]) -> None:
        self.__dict__.update(arrays)

    def __iter__(self) -> Any:
        return iter(self.__dict__.values())

    def __getattr__(self, name: str) -> Any:
        found = ", ".join(self.__dict__) or "nothing"
        raise AttributeError(f"{name!r} was not computed, only {found}: outputs=(..., {name!r})")

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"{type(self).__name__} cannot be changed, though its arrays can")

    def __repr__(self) -> str:
        fields = (f"{name}={array.dtype}{list(array.shape)}" for name, array in self.__dict__.items())
        return f"{type(self).__name__}({', '.join(fields)})"
