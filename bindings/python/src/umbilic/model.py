"""What adaptive jets learn of a mesh."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike

from . import _arrays as arrays
from . import _native as native
from ._run import Progress, Run
from .faces import Faces
from .names import COORDINATES, Coordinates, Simd, number
from .topology import Topology, topology_of


@dataclass(frozen=True)
class AdaptiveModel:
    """What adaptive jets know of a mesh before they look at a vertex: how noisy its positions are and how smooth its
    surface.

    `learn_model` makes one, and the argument `model` of normals, curvatures and sections takes it: for a list of
    vertices, a part of the mesh or a later frame. `dataclasses.replace(model, noise=model.noise / 2)` makes one for
    less noise."""

    edge_length: float  #: The median over the vertices of the mean length of their edges, in the mesh's unit.
    noise: float  #: The standard deviation of positions along the normal, in the mesh's unit.
    sizes: tuple[float, float, float, float]  #: Of Taylor coefficients of degree 2, 3, 4 and beyond, by `edge_length`.
    coordinates: Coordinates = "height"  #: Those in which the surface is written.
    noise_exponent: int = 0  #: A vertex's noise grows with its own edge length to this power, 0 to 2.
    size_exponent: int = 0  #: 1 if `sizes` go by the vertex's own edge length.
    evidence: tuple[float, float] = (0.0, 0.0)  #: Of heights and of circles; not read.
    sample: int = 0  #: How many vertices it was learned from; not read.

    def native(self) -> Any:
        """As the library's struct."""
        if len(self.sizes) != 4:
            raise ValueError(f"sizes has {len(self.sizes)} numbers, not 4")
        return native.sized(
            native.AdaptiveModel,
            coordinates=number("coordinates", self.coordinates),
            edge_length=self.edge_length,
            noise=self.noise,
            sizes=tuple(self.sizes),
            noise_exponent=arrays.unsigned(self.noise_exponent, "noise_exponent"),
            size_exponent=arrays.unsigned(self.size_exponent, "size_exponent"),
            evidence=tuple(self.evidence),
            sample=arrays.unsigned(self.sample, "sample"),
        )


def struct_of(model: AdaptiveModel | None) -> Any:
    """The struct of a model, or none; the caller holds it while the library reads it."""
    if model is None:
        return None
    if not isinstance(model, AdaptiveModel):
        raise TypeError(f"model is a {type(model).__name__}, not an AdaptiveModel")
    return model.native()


def learn_model(
    positions: ArrayLike,
    faces: Topology | Faces,
    *,
    threads: int = 0,
    simd: Simd = "best",
    progress: Progress | None = None,
) -> AdaptiveModel:
    """Learns what adaptive jets use of a mesh, from a sample of all its vertices.

    Arguments as of `vertex_normals`.

    >>> import dataclasses, numpy, umbilic
    >>> positions, faces = umbilic.examples.sphere(3)
    >>> model = umbilic.learn_model(positions, faces)
    >>> quieter = dataclasses.replace(model, noise=model.noise / 10)
    >>> normals, status = umbilic.vertex_normals(positions, faces, weight="adaptive-jet", model=quieter)
    >>> numpy.allclose(normals, positions, atol=1e-5)
    True
    """
    xyz = arrays.vectors(positions, "positions")
    topology = topology_of(faces, len(xyz), threads, simd)
    run = Run(threads, simd, progress)
    options = native.sized(native.NormalOptions, run=run.struct)
    found = native.sized(native.AdaptiveModel)
    run.call(native.library.umb_learn_model, topology.handle, arrays.points(xyz), options, found)
    return AdaptiveModel(
        edge_length=found.edge_length,
        noise=found.noise,
        sizes=tuple(found.sizes),
        coordinates=COORDINATES[found.coordinates],
        noise_exponent=found.noise_exponent,
        size_exponent=found.size_exponent,
        evidence=tuple(found.evidence),
        sample=found.sample,
    )
