"""What the modules for meshes of other packages share."""

from __future__ import annotations

from typing import Any, Callable, Literal

import numpy
from numpy.typing import NDArray

from .faces import Faces, Polygons
from .segmentation import Segmentation, segment_features, segment_regions, segment_watershed
from .topology import Topology

By = Literal["features", "watershed", "regions"]
_WAYS: dict[str, Callable[..., Segmentation]] = {
    "features": segment_features,
    "watershed": segment_watershed,
    "regions": segment_regions,
}


def way(by: str) -> Callable[..., Segmentation]:
    """The function that segments in a way."""
    if by not in _WAYS:
        raise ValueError(f"by is {by!r}, none of {', '.join(_WAYS)}")
    return _WAYS[by]


def attribute(mesh: Any, name: str, package: str) -> Any:
    """An attribute that a mesh of the package has."""
    try:
        return getattr(mesh, name)
    except AttributeError:
        raise TypeError(f"{type(mesh).__name__} is no mesh of {package} with faces") from None


def regular(indices: NDArray[Any], offsets: NDArray[Any]) -> NDArray[Any] | Polygons:
    """An array of faces if all have as many corners, without a copy."""
    count = len(offsets) - 1
    if count > 0 and len(indices) % count == 0 and (numpy.diff(offsets) == len(indices) // count).all():
        return indices.reshape(count, -1)
    return Polygons(indices, offsets)


def chosen(topology: Topology | None, faces: Callable[[Any], Faces], mesh: Any) -> Topology | Faces:
    """The topology given, or the mesh's faces."""
    return faces(mesh) if topology is None else topology
