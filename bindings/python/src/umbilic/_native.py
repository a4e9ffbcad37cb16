"""The library as ctypes sees it: the structs and functions of include/umbilic.h, each once, and how it is found.

Fields have the header's names and order; tests/test_layout.py compares all of it with the header through a C compiler.
"""

from __future__ import annotations

import ctypes
import os
import sys
import types
from ctypes import (
    POINTER,
    Structure,
    byref,
    c_char,
    c_char_p,
    c_double,
    c_int,
    c_int32,
    c_int64,
    c_size_t,
    c_uint32,
    c_uint64,
    c_void_p,
    py_object,
    sizeof,
)
from pathlib import Path
from typing import Any

from .errors import Error, from_native

ABI_VERSION = 0
VARIABLE = "UMBILIC_LIBRARY"
FILE = {"win32": "umbilic.dll", "darwin": "libumbilic.dylib"}.get(sys.platform, "libumbilic.so")
NO_ELEMENT = 2**64 - 1

# `int (*)(void *user, double fraction)`; every callback is this one function, and `user` the generator that it resumes.
# So no Python code runs outside the generator's own `try`, not even where the interpreter looks for signals.
Progress = ctypes.CFUNCTYPE(c_int, py_object, c_double)
PROGRESS = Progress(types.GeneratorType.send)


class ErrorStruct(Structure):
    _fields_ = [("struct_size", c_uint32), ("status", c_int32), ("element", c_uint64), ("message", c_char * 240)]


class Faces(Structure):
    _fields_ = [
        ("indices", c_void_p),
        ("index_count", c_size_t),
        ("offsets", c_void_p),
        ("face_count", c_size_t),
        ("index", c_uint32),
        ("arity", c_uint32),
    ]


class Points(Structure):
    _fields_ = [
        ("data", c_void_p),
        ("count", c_size_t),
        ("stride", c_size_t),
        ("scalar", c_uint32),
        ("reserved", c_uint32),
    ]


class Scalars(Structure):
    _fields_ = [
        ("data", c_void_p),
        ("count", c_size_t),
        ("stride", c_size_t),
        ("scalar", c_uint32),
        ("location", c_uint32),
    ]


class Bytes(Structure):
    _fields_ = [("data", c_void_p), ("count", c_size_t), ("stride", c_size_t)]


class Output(Structure):
    _fields_ = [("data", c_void_p), ("stride", c_size_t), ("scalar", c_uint32), ("reserved", c_uint32)]


class StatusOutput(Structure):
    _fields_ = [("data", c_void_p), ("stride", c_size_t)]


class Run(Structure):
    _fields_ = [
        ("threads", c_uint32),
        ("simd", c_uint32),
        ("vertices", c_void_p),
        ("vertex_count", c_size_t),
        ("progress", Progress),
        ("user", py_object),
    ]


class TopologyOptions(Structure):
    _fields_ = [("struct_size", c_uint32), ("threads", c_uint32), ("simd", c_uint32), ("reserved", c_uint32)]


class TopologyStats(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("vertex_count", c_uint64),
        ("face_count", c_uint64),
        ("corner_count", c_uint64),
        ("edge_count", c_uint64),
        ("boundary_edges", c_uint64),
        ("non_manifold_edges", c_uint64),
        ("winding_edges", c_uint64),
        ("isolated_vertices", c_uint64),
        ("boundary_vertices", c_uint64),
        ("non_manifold_vertices", c_uint64),
        ("degenerate_faces", c_uint64),
        ("ignored_faces", c_uint64),
        ("duplicate_faces", c_uint64),
        ("component_count", c_uint64),
        ("boundary_loops", c_uint64),
        ("euler_characteristic", c_int64),
        ("max_valence", c_uint64),
        ("bytes", c_uint64),
    ]


class Fan(Structure):
    _fields_ = [
        ("neighbours", c_void_p),
        ("neighbour_count", c_size_t),
        ("corner_count", c_size_t),
        ("closed", c_uint32),
        ("reserved", c_uint32),
    ]


class AdaptiveModel(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("coordinates", c_uint32),
        ("edge_length", c_double),
        ("noise", c_double),
        ("sizes", c_double * 4),
        ("noise_exponent", c_uint32),
        ("size_exponent", c_uint32),
        ("evidence", c_double * 2),
        ("sample", c_uint32),
        ("reserved", c_uint32),
    ]


class NormalOptions(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("weight", c_uint32),
        ("run", Run),
        ("degree", c_uint32),
        ("rings", c_uint32),
        ("model", POINTER(AdaptiveModel)),
    ]


class NormalOutputs(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("normal", Output),
        ("sum", Output),
        ("status", StatusOutput),
    ]


class FaceOptions(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("run", Run)]


class FaceOutputs(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("normal", Output),
        ("area_vector", Output),
        ("status", StatusOutput),
    ]


class Creases(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("angle", c_double),
        ("edges", c_void_p),
        ("edge_count", c_size_t),
        ("groups", c_void_p),
        ("group_count", c_size_t),
    ]


class CornerOutputs(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("corner", Output),
        ("normal", Output),
        ("sum", Output),
        ("status", StatusOutput),
    ]


class Moved(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("vertices", c_void_p),
        ("vertex_count", c_size_t),
        ("status", Bytes),
    ]


class CurvatureOptions(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("method", c_uint32),
        ("section", c_uint32),
        ("weight", c_uint32),
        ("radius", c_double),
        ("degree", c_uint32),
        ("rings", c_uint32),
        ("normal_degree", c_uint32),
        ("normal_rings", c_uint32),
        ("model", POINTER(AdaptiveModel)),
        ("normals", Points),
        ("run", Run),
    ]


class CurvatureOutputs(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("k1", Output),
        ("k2", Output),
        ("direction1", Output),
        ("direction2", Output),
        ("mean", Output),
        ("gaussian", Output),
        ("mean_normal", Output),
        ("area", Output),
        ("integrated_mean", Output),
        ("integrated_gaussian", Output),
        ("shape_index", Output),
        ("curvedness", Output),
        ("residual", Output),
        ("condition", Output),
        ("degrees_of_freedom", Output),
        ("normal", Output),
        ("status", StatusOutput),
    ]


class SectionOptions(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("section", c_uint32),
        ("weight", c_uint32),
        ("shared", c_uint32),
        ("normals", Points),
        ("directions", Points),
        ("normal_degree", c_uint32),
        ("normal_rings", c_uint32),
        ("model", POINTER(AdaptiveModel)),
        ("run", Run),
    ]


class SectionOutputs(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("curvature", Output),
        ("status", StatusOutput),
        ("normal", Output),
    ]


class ShapeOptions(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("tolerance", c_double),
        ("points", POINTER(Points)),
        ("status", Bytes),
        ("run", Run),
    ]


class FeatureOptions(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("creases", POINTER(Creases)), ("run", Run)]


class WatershedOptions(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("depth", c_double),
        ("height", POINTER(Scalars)),
        ("curvature", POINTER(CurvatureOptions)),
        ("run", Run),
    ]


class RegionOptions(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("smallest_share", c_double),
        ("tolerance", c_double),
        ("smallest_faces", c_size_t),
        ("creases", POINTER(Creases)),
        ("classes", Bytes),
        ("curvature", POINTER(CurvatureOptions)),
        ("run", Run),
    ]


class Polyline(Structure):
    _fields_ = [
        ("data", c_void_p),
        ("count", c_size_t),
        ("stride", c_size_t),
        ("scalar", c_uint32),
        ("dimension", c_uint32),
        ("closed", c_uint32),
        ("reserved", c_uint32),
    ]


class PolylineOptions(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("run", Run)]


class PolylineOutputs(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("circle", Output),
        ("parabola", Output),
        ("length_parabola", Output),
        ("symmetric_parabola", Output),
        ("status", StatusOutput),
    ]


# Functions: what they answer, and what they take, but for the closing `umb_error *` of those that answer with a status.

_handle, _out = c_void_p, POINTER(c_void_p)
_FALLIBLE: dict[str, list[Any]] = {
    "umb_topology_create": [POINTER(Faces), c_size_t, POINTER(TopologyOptions), _out],
    "umb_topology_get_stats": [_handle, POINTER(TopologyStats)],
    "umb_topology_valence": [_handle, c_size_t, POINTER(c_size_t)],
    "umb_topology_fan_count": [_handle, c_size_t, POINTER(c_size_t)],
    "umb_topology_fan": [_handle, c_size_t, c_size_t, POINTER(Fan)],
    "umb_learn_model": [_handle, POINTER(Points), POINTER(NormalOptions), POINTER(AdaptiveModel)],
    "umb_vertex_normals": [_handle, POINTER(Points), POINTER(NormalOptions), POINTER(NormalOutputs)],
    "umb_face_normals": [POINTER(Faces), POINTER(Points), POINTER(FaceOptions), POINTER(FaceOutputs)],
    "umb_curvatures": [_handle, POINTER(Points), POINTER(CurvatureOptions), POINTER(CurvatureOutputs)],
    "umb_edge_sections": [_handle, POINTER(Points), POINTER(SectionOptions), POINTER(SectionOutputs)],
    "umb_direction_sections": [_handle, POINTER(Points), POINTER(SectionOptions), POINTER(SectionOutputs)],
    "umb_polyline_curvatures": [POINTER(Polyline), POINTER(PolylineOptions), POINTER(PolylineOutputs)],
    "umb_cut_create": [POINTER(Faces), POINTER(Points), POINTER(Creases), POINTER(TopologyOptions), _out],
    "umb_cut_points": [_handle, POINTER(Points), POINTER(Output)],
    "umb_corner_normals": [_handle, POINTER(Points), POINTER(NormalOptions), POINTER(CornerOutputs)],
    "umb_affected_normals": [_handle, POINTER(Moved), POINTER(NormalOptions), c_void_p, c_size_t, POINTER(c_size_t)],
    "umb_affected_curvatures": [
        _handle,
        POINTER(Moved),
        POINTER(CurvatureOptions),
        c_void_p,
        c_size_t,
        POINTER(c_size_t),
    ],
    "umb_shape_tolerance": [POINTER(Points), POINTER(c_double)],
    "umb_shape_classes": [POINTER(Scalars), POINTER(Scalars), POINTER(ShapeOptions), POINTER(StatusOutput)],
    "umb_segment_features": [POINTER(Faces), POINTER(Points), POINTER(FeatureOptions), _out],
    "umb_segment_watershed": [POINTER(Faces), POINTER(Points), POINTER(WatershedOptions), _out],
    "umb_segment_regions": [POINTER(Faces), POINTER(Points), POINTER(RegionOptions), _out],
    "umb_segmentation_areas": [_handle, POINTER(Faces), POINTER(Points), c_void_p, c_size_t],
    "umb_segmentation_means": [_handle, POINTER(Faces), POINTER(Points), POINTER(Scalars), c_void_p, c_size_t],
}
_PLAIN: dict[str, tuple[Any, list[Any]]] = {
    "umb_topology_destroy": (None, [_handle]),
    "umb_topology_vertex_count": (c_size_t, [_handle]),
    "umb_topology_face_count": (c_size_t, [_handle]),
    "umb_topology_flags": (c_void_p, [_handle]),
    "umb_topology_ring_offsets": (c_void_p, [_handle]),
    "umb_topology_ring_neighbours": (c_void_p, [_handle]),
    "umb_cut_destroy": (None, [_handle]),
    "umb_cut_topology": (c_void_p, [_handle]),
    "umb_cut_vertex_count": (c_size_t, [_handle]),
    "umb_cut_corner_count": (c_size_t, [_handle]),
    "umb_cut_corners": (c_void_p, [_handle]),
    "umb_cut_origins": (c_void_p, [_handle]),
    "umb_cut_starts": (c_void_p, [_handle]),
    "umb_segmentation_destroy": (None, [_handle]),
    "umb_segmentation_count": (c_size_t, [_handle]),
    "umb_segmentation_face_count": (c_size_t, [_handle]),
    "umb_segmentation_labels": (c_void_p, [_handle]),
    "umb_segmentation_boundary_edge_count": (c_size_t, [_handle]),
    "umb_segmentation_boundary_edges": (c_void_p, [_handle]),
    "umb_status_string": (c_char_p, [c_int32]),
    "umb_version": (c_char_p, []),
    "umb_abi_version": (c_uint32, []),
    "umb_build_info": (c_char_p, []),
}


def _load() -> ctypes.CDLL:
    path = os.environ.get(VARIABLE) or str(Path(__file__).with_name(FILE))
    try:
        loaded = ctypes.CDLL(path)
    except OSError as error:
        raise ImportError(f"the library of umbilic cannot be loaded: {error} ({VARIABLE} names another)") from None
    try:
        for name, arguments in _FALLIBLE.items():
            function = getattr(loaded, name)
            function.restype, function.argtypes = c_int32, [*arguments, POINTER(ErrorStruct)]
        for name, (result, arguments) in _PLAIN.items():
            function = getattr(loaded, name)
            function.restype, function.argtypes = result, arguments
    except AttributeError as error:
        raise ImportError(f"{path} is not the library that this package was made for: {error}") from None
    found = loaded.umb_abi_version()
    if found != ABI_VERSION:
        raise ImportError(f"{path} has version {found} of the binary interface; this package needs {ABI_VERSION}")
    return loaded


library = _load()


def sized(kind: Any, **fields: Any) -> Any:
    """A struct that starts with its size."""
    return kind(struct_size=sizeof(kind), **fields)


def call(function: Any, *arguments: Any) -> None:
    """Calls a function that answers with a status, without the interpreter's lock; structs go by reference."""
    error = sized(ErrorStruct)
    if function(*(byref(each) if isinstance(each, Structure) else each for each in arguments), byref(error)):
        raise error_of(error)


def error_of(error: ErrorStruct) -> Error:
    element = None if error.element == NO_ELEMENT else int(error.element)
    return from_native(error.message.decode(errors="replace"), error.status, element)


class Handle(c_void_p):
    """An object of the library's, freed when the last that refers to it is gone: a call, or an array of its memory.

    So closing something that another thread is at work with frees nothing too early. It cannot be copied or pickled,
    because pointers of ctypes cannot.
    """

    def __init__(self, pointer: Any, destroy: Any = None, owner: Any = None) -> None:
        """With `destroy`, the owner of the object; without, a part of `owner`."""
        super().__init__(pointer)
        self._destroy, self._owner = destroy, owner

    def __del__(self) -> None:
        if self._destroy is not None:
            self._destroy(self)
