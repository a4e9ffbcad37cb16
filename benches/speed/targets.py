"""What is to be reached: a figure that must be, and one to aim at."""

from collections.abc import Callable
from dataclasses import dataclass

from samples import Samples, Spread

OTHER_WEIGHTS = "uniform angle area Max centroid-area centroid inverse-root-edges sine angle-edges".split()


@dataclass(frozen=True)
class Target:
    title: str
    must: float
    aim: float
    measured: Callable[[Samples], Spread | None]
    larger: bool = False  # is better
    unit: str = " ×"

    def verdict(self, spread: Spread) -> str:
        median = round(spread.median, 2)
        for limit, words in ((self.aim, "reaches the aim"), (self.must, "reaches what it must")):
            if (median >= limit) if self.larger else (median <= limit):
                return words
        return "**misses**"


def scatter(tasks: str, name: str, scalar: str = "f32", **wanted) -> Callable[[Samples], Spread | None]:
    """Time as a ratio to the scatter kernel."""
    wanted = dict(mesh="natural") | wanted

    def measured(samples: Samples) -> Spread | None:
        found = samples.find(set=tasks, name=name, scalar=scalar, **wanted)
        return found and found.ratio()

    return measured


def slowest_other(samples: Samples) -> Spread | None:
    found = [samples.find(set="normals", mesh="shuffled", name=name, scalar="f32") for name in OTHER_WEIGHTS]
    ratios = [each.ratio() for each in found if each]
    return max(ratios, key=lambda ratio: ratio.median, default=None)


def handle(samples: Samples) -> Spread | None:
    value = samples.handle("natural")
    return value and Spread(value, value, value)


def cgal(theirs: str, ours: str, scalar: str) -> Callable[[Samples], Spread | None]:
    """How many times as long CGAL takes, a vertex, on the small mesh."""

    def measured(samples: Samples) -> Spread | None:
        wanted = dict(program="cgal", set="jets", mesh="small")
        theirs_found = samples.find(library="CGAL", name=theirs, level="as built", **wanted)
        ours_found = samples.find(name=ours, scalar=scalar, **wanted)
        return theirs_found.times(ours_found) if theirs_found and ours_found else None

    return measured


def speed_up(name: str, scalar: str = "f32") -> Callable[[Samples], Spread | None]:
    def measured(samples: Samples) -> Spread | None:
        one, two = (
            samples.find(set="threads", mesh="natural", name=name, scalar=scalar, threads=count) for count in (1, 2)
        )
        return one.times(two) if one and two else None

    return measured


def openmesh(mesh: str) -> Callable[[Samples], Spread | None]:
    """How many times as long OpenMesh takes for the fastest of its normals as umbilic for those of area weights."""

    def measured(samples: Samples) -> Spread | None:
        wanted = dict(program="openmesh", set="all", mesh=mesh)
        theirs = samples.find(library="OpenMesh", name="calc_vertex_normal_fast", level="as built", **wanted)
        ours = samples.find(name="area", scalar="f32", **wanted)
        return theirs.times(ours) if theirs and ours else None

    return measured


def per_corner(tasks: str, name: str, quads: str, triangles: str) -> Callable[[Samples], Spread | None]:
    """The time of a corner of quadrilaterals as a ratio to that of a corner of triangles."""

    def measured(samples: Samples) -> Spread | None:
        mine, theirs = (samples.find(set=tasks, name=name, scalar="f32", mesh=mesh) for mesh in (quads, triangles))
        return mine.per_corner(theirs, 4, 3) if mine and theirs else None

    return measured


def per_vertex(name: str, mesh: str, other: str) -> Callable[[Samples], Spread | None]:
    """The time of a vertex as a ratio to that of one of another mesh, which has as many vertices and triangles."""

    def measured(samples: Samples) -> Spread | None:
        mine, theirs = (samples.find(set="methods", name=name, scalar="f64", mesh=of) for of in (mesh, other))
        return mine.per_triangle(theirs) if mine and theirs else None

    return measured


def jets(degree: int, rings: int, must: float, aim: float) -> list[Target]:
    theirs, ours = f"Monge_via_jet_fitting {degree}, {rings} rings", f"jets {degree}, {rings} rings"
    return [
        Target(f"jets of degree {degree}, {rings} rings, {scalar}: CGAL's", must, aim, cgal(theirs, ours, scalar), True)
        for scalar in ("f64", "f32")
    ]


def level(name: str, width: str, must: float, aim: float, scalar: str = "f32") -> Target:
    kind = width.lower().replace("-", "")
    of_level = scatter("levels", name, scalar, level=kind)
    measured = lambda samples: of_level(samples) if kind in samples.levels() else None
    return Target(f"{name}, {scalar}, {width}", must, aim, measured)


def quads(name: str, must: float, aim: float, scalar: str = "f32", tasks: str = "normals") -> Target:
    return Target(f"quads: {name}, {scalar}", must, aim, scatter(tasks, name, scalar, mesh="quads"))


CORNERS = "Meyer", "Rusinkiewicz", "corrected measure"

QUADS = [
    quads("area", 1.1, 0.9),
    quads("uniform", 1.1, 0.9),
    quads("Max", 1.3, 1.0),
    quads("angle", 1.5, 1.2),
    quads("N_CM", 1.7, 1.4),
    quads("N_CM", 2.7, 2.2, "f64"),
    quads("least squares, on given normals", 3.2, 2.3, tasks="curvatures"),
    quads("least squares", 5.5, 3.5, tasks="curvatures"),
    *(
        Target(
            f"quads, a corner: {method}, normals given, f32, {title}",
            2,
            1.5,
            per_corner(tasks, f"{method}, on given normals", mesh, triangles),
        )
        for tasks, mesh, triangles, title in (
            ("curvatures", "quads", "natural", "by the sphere's"),
            ("methods", "quads-small", "torus", "128 k, by the torus's"),
        )
        for method in CORNERS
    ),
    *(
        Target(f"quads, a vertex: adaptive jets, {rings} rings, f64, 128 k, by the torus's", 1.6, 1.2, measured)
        for rings in (3, 4)
        for measured in [per_vertex(f"adaptive jets, {rings} rings", "quads-small", "torus")]
    ),
    Target("quads: OpenMesh's fastest normals by area, f32", 3, 5, openmesh("quads"), True),
    Target("quads: OpenMesh's fastest normals by area, f32, 128 k", 3, 5, openmesh("quads-small"), True),
]

BEST = "Monge_via_jet_fitting 4, 3 rings"

TARGETS = [
    Target("topology, warm memory", 3.0, 2.0, scatter("normals", "topology")),
    Target("topology, fresh memory", 4.5, 3.0, scatter("memory", "topology", memory="fresh")),
    Target("topology, shuffled", 1.5, 0.9, scatter("normals", "topology", mesh="shuffled")),
    Target("bytes a triangle that the handle holds", 20, 16, handle, unit=""),
    level("area", "AVX-512", 0.9, 0.6),
    level("uniform", "AVX-512", 0.95, 0.7),
    level("Max", "AVX-512", 0.9, 0.65),
    Target("angle, f32", 1.25, 1.1, scatter("normals", "angle")),
    level("N_CM", "AVX-512", 1.55, 1.4),
    level("N_CM", "AVX2", 1.9, 1.7),
    level("N_CM", "portable", 4.5, 3.6),
    level("N_CM", "AVX-512", 3.8, 3.0, "f64"),
    Target("N_CM, f32, shuffled", 0.6, 0.45, scatter("normals", "N_CM", mesh="shuffled")),
    Target("the slowest of the other weights, f32, shuffled", 0.5, 0.35, slowest_other),
    Target("N_CM and least squares (k1, k2, directions), f32", 2.8, 2.3, scatter("curvatures", "least squares")),
    Target("least squares, normals given, f32", 1.9, 1.6, scatter("curvatures", "least squares, on given normals")),
    Target("Rusinkiewicz, normals given, f32", 4.5, 3, scatter("curvatures", "Rusinkiewicz, on given normals")),
    Target(
        "corrected measure, one ring, normals given, f32",
        4,
        2.5,
        scatter("curvatures", "corrected measure, on given normals"),
    ),
    *(
        Target(
            f"adaptive jets, 4 rings, {scalar}: CGAL's jets of degree 4, 3 rings",
            52,
            80,
            cgal(BEST, "adaptive jets, 4 rings", scalar),
            True,
        )
        for scalar in ("f64", "f32")
    ),
    *jets(2, 2, 50, 80),
    *jets(3, 2, 60, 120),
    *jets(4, 3, 40, 80),
    Target("two threads, N_CM, f32: speed-up", 1.7, 1.9, speed_up("N_CM"), True),
    Target("two threads, topology: speed-up", 1.6, 1.9, speed_up("topology"), True),
    Target("two threads, N_CM and least squares, f32: speed-up", 1.7, 1.9, speed_up("least squares"), True),
    *QUADS,
]
