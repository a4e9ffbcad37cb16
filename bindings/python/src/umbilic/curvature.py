"""Curvatures at the vertices of a mesh."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from ctypes import pointer
from dataclasses import dataclass
from typing import Any, Literal

from numpy.typing import ArrayLike, NDArray

from . import _arrays as arrays
from . import _native as native
from ._arrays import FloatArray, Outputs, Result, StatusArray
from ._run import Progress, Run
from .faces import Faces
from .model import AdaptiveModel, struct_of
from .names import Method, Section, Simd, Weight, number
from .topology import Topology, topology_of

CurvatureOutput = Literal[
    "k1",
    "k2",
    "direction1",
    "direction2",
    "mean",
    "gaussian",
    "mean_normal",
    "area",
    "integrated_mean",
    "integrated_gaussian",
    "shape_index",
    "curvedness",
    "residual",
    "condition",
    "degrees_of_freedom",
    "normal",
    "status",
]
_OUTPUTS: tuple[str, ...] = CurvatureOutput.__args__  # type: ignore[attr-defined]
_VECTORS = ("direction1", "direction2", "mean_normal", "normal")
_PRINCIPAL: tuple[CurvatureOutput, ...] = ("k1", "k2", "direction1", "direction2", "status")
# Of methods without directions.
_DEFAULTS: dict[str, tuple[CurvatureOutput, ...]] = {
    "watanabe": ("k1", "k2", "status"),
    "meyer": ("k1", "k2", "status"),
    "angle-defect": ("gaussian", "integrated_gaussian", "status"),
}


class Curvatures(Result):
    """What `curvatures` computes; has what was asked for. Pointwise unless the name says integrated."""

    k1: FloatArray  #: The larger principal curvature, `#V`, 1/length.
    k2: FloatArray  #: The smaller principal curvature, `#V`, 1/length.
    direction1: (
        FloatArray  #: The unit tangent direction of k1, `#V × 3`; the first of its largest components is positive.
    )
    direction2: FloatArray  #: The unit tangent direction of k2, `#V × 3`: normal × direction1.
    mean: FloatArray  #: H = (k1 + k2) / 2, `#V`, 1/length.
    gaussian: FloatArray  #: K = k1 k2, `#V`, 1/length².
    mean_normal: FloatArray  #: H N, `#V × 3`, 1/length: along the outward normals of a sphere.
    area: FloatArray  #: The area that the vertex stands for, `#V`, length².
    integrated_mean: FloatArray  #: H integrated over that area, `#V`, length.
    integrated_gaussian: FloatArray  #: K integrated over that area, `#V`, without unit.
    shape_index: FloatArray  #: Koenderink's, `#V`: 1 at a cap, 0.5 on a ridge, 0 at a symmetric saddle, -1 in a cup.
    curvedness: FloatArray  #: Koenderink's √((k1² + k2²) / 2), `#V`, 1/length.
    residual: FloatArray  #: The root mean square of what a fit left over, `#V`: length, or 1/length of curvatures.
    condition: FloatArray  #: The condition number of a fit, `#V`.
    degrees_of_freedom: FloatArray  #: Adaptive jets: how many of the 15 coefficients the data decide, `#V`.
    normal: FloatArray  #: The unit normals that all this belongs to, `#V × 3`.
    status: StatusArray  #: `VertexStatus` bits, `#V`.


@dataclass(frozen=True, eq=False)
class CurvatureOptions:
    """A method and its options, as arguments of `curvatures`, for functions that need curvatures on the way."""

    method: Method = "adaptive-jet"
    section: Section = "symmetric-parabola"
    weight: Weight = "conformal"
    radius: float = 0.0
    degree: int = 0
    rings: int = 0
    normal_degree: int = 0
    normal_rings: int = 0
    model: AdaptiveModel | None = None
    normals: ArrayLike | None = None


class Prepared:
    """The struct of such options, with what it points into: held while the library reads it."""

    def __init__(self, options: CurvatureOptions, run: Run | None = None) -> None:
        if not isinstance(options, CurvatureOptions):
            raise TypeError(f"options of curvatures are a {type(options).__name__}, not CurvatureOptions")
        self.normals = None if options.normals is None else arrays.vectors(options.normals, "normals")
        self.model = struct_of(options.model)
        self.struct = native.sized(
            native.CurvatureOptions,
            method=number("method", options.method),
            section=number("section", options.section),
            weight=number("weight", options.weight),
            radius=options.radius,
            degree=arrays.unsigned(options.degree, "degree"),
            rings=arrays.unsigned(options.rings, "rings"),
            normal_degree=arrays.unsigned(options.normal_degree, "normal_degree"),
            normal_rings=arrays.unsigned(options.normal_rings, "normal_rings"),
            model=None if self.model is None else pointer(self.model),
            normals=arrays.points(self.normals),
            **({} if run is None else {"run": run.struct}),
        )


def curvatures(
    positions: ArrayLike,
    faces: Topology | Faces,
    *,
    method: Method = "adaptive-jet",
    section: Section = "symmetric-parabola",
    weight: Weight = "conformal",
    normals: ArrayLike | None = None,
    radius: float = 0.0,
    degree: int = 0,
    rings: int = 0,
    normal_degree: int = 0,
    normal_rings: int = 0,
    model: AdaptiveModel | None = None,
    vertices: ArrayLike | None = None,
    outputs: Sequence[CurvatureOutput] | None = None,
    out: Mapping[str, NDArray[Any]] | None = None,
    threads: int = 0,
    simd: Simd = "best",
    progress: Progress | None = None,
) -> Curvatures:
    """Curvatures at the vertices of a mesh.

    A sphere of radius r whose faces run counter-clockwise seen from outside has k1 = k2 = H = 1/r, K = 1/r²; k1 ≥ k2.
    Never NaN or infinite; the same bits for any number of threads, any vectors and any list of vertices.

    positions, faces, vertices, out, threads, simd, progress
        See `vertex_normals`.
    method
        How curvatures are estimated. What each has to give stands in the header, at `umb_curvature_method`; what it has
        not is refused with the status `NOT_APPLICABLE`.
    section
        The formula of sections, for "least-squares", "taubin" and "watanabe".
    weight, normal_degree, normal_rings
        Which vertex normals a method starts from: see `weight`, `degree` and `rings` of `vertex_normals`.
    normals
        Vertex normals of yours instead, `#V × 3`, of any length, on the side from which faces run counter-clockwise.
    radius
        For "normal-cycle" and "corrected-measure", that of a ball around the vertex instead of rings, in the mesh's
        unit.
    degree
        Of jets, 2 to 4; 0 for 3.
    rings
        How many rings count, at most 8; 0 for the method's default.
    model
        What "adaptive-jet", as method or as weight, knows of the mesh; None to learn it from all positions.
    outputs
        What to compute; None for k1, k2, directions and status, as far as the method has them ("angle-defect":
        gaussian, integrated_gaussian and status).

    >>> import umbilic
    >>> positions, faces = umbilic.examples.sphere(3, radius=2)
    >>> k1, k2, direction1, direction2, status = umbilic.curvatures(positions, faces)
    >>> print(f"{k1.mean():.4f} {k2.mean():.4f}")
    0.5000 0.5000
    >>> umbilic.curvatures(positions, faces, method="angle-defect", outputs=["integrated_gaussian"])
    Curvatures(integrated_gaussian=float64[642])
    """
    xyz = arrays.vectors(positions, "positions")
    listed = None if vertices is None else arrays.index_list(vertices, "vertices")
    topology = topology_of(faces, len(xyz), threads, simd)
    count = topology.vertex_count
    run = Run(threads, simd, progress, listed)
    options = Prepared(
        CurvatureOptions(method, section, weight, radius, degree, rings, normal_degree, normal_rings, model, normals),
        run,
    )
    shapes = {name: (count, 3) if name in _VECTORS else (count,) for name in _OUTPUTS}
    wanted = _DEFAULTS.get(method, _PRINCIPAL) if outputs is None else outputs
    results = Outputs(wanted, out, shapes, xyz.dtype, listed is not None, [xyz, listed, options.normals])
    written = native.sized(native.CurvatureOutputs, **results.fields())
    run.call(native.library.umb_curvatures, topology.handle, arrays.points(xyz), options.struct, written)
    return Curvatures(results.arrays)
