"""What is run: which programs, on which meshes."""

from dataclasses import dataclass


@dataclass(frozen=True)
class MeshFile:
    name: str
    kind: str  # of generate_mesh.c
    size: int
    title: str = ""


@dataclass(frozen=True)
class Run:
    program: str
    mesh: str
    tasks: str
    memory: str = "warm"
    threads: int = 1
    rounds: int = 9


def meshes(quick: bool) -> list[MeshFile]:
    large, grid = (6, 100) if quick else (8, 400)
    return [
        MeshFile("natural", "sphere", large, "sphere" if quick else "1.3 M"),
        MeshFile("shuffled", "shuffled", large, "sphere, shuffled" if quick else "1.3 M, shuffled"),
        MeshFile("small", "sphere", large - 2, "small sphere" if quick else "82 k"),
        MeshFile("torus", "torus", grid, "irregular torus"),
        MeshFile("dominant", "quad-dominant", grid, "quad-dominant"),
        MeshFile("quads", "quads", 320 if quick else 1280, "quads" if quick else "quads 1.3 M"),
        MeshFile("quads-small", "quads", grid, "small quads" if quick else "quads 128 k"),
    ]


def scaling(quick: bool) -> list[MeshFile]:
    """From a thousand to twenty million triangles."""
    return [MeshFile(f"scaling-{size}", "sphere", size) for size in range(3, 7 if quick else 11)]


PROGRAMS = {"umbilic": "umbilic", "openmesh": "OpenMesh", "cgal": "CGAL"}  # of CMakeLists.txt
WHEELS = {"libigl": "libigl", "vcg": "VCG", "vtk": "VTK", "open3d": "Open3D", "meshlib": "MeshLib"}  # bench_x.py
TITLES = PROGRAMS | WHEELS
# Distributions that hold the wheels' versions.
PACKAGES = {"libigl": "libigl", "vcg": "pymeshlab", "vtk": "vtk", "open3d": "open3d", "meshlib": "meshlib"}


def umbilic_runs(names: list[str]) -> list[Run]:
    found = [Run("umbilic", name, "normals") for name in names]
    found += [Run("umbilic", name, "memory", "fresh") for name in names]
    found += [Run("umbilic", name, "threads") for name in names]
    found += [Run("umbilic", "natural", "levels")]
    found += [Run("umbilic", name, "curvatures") for name in ("natural", "shuffled", "quads")]
    found += [Run("umbilic", "natural", "adaptive")]
    found += [Run("umbilic", name, "methods") for name in ("small", "torus", "dominant", "quads-small")]
    return found


def peer_runs(names: list[str]) -> list[Run]:
    found = [Run("openmesh", name, "all") for name in names]
    # To the others, pure quadrilaterals are nothing that the quad-dominant mesh is not.
    names = [name for name in names if not name.startswith("quads")]
    found += [Run("cgal", name, "mesh") for name in names]
    found += [Run("cgal", name, "jets") for name in ("small", "torus")]
    for wheel in WHEELS:
        found += [Run(wheel, name, "all") for name in names]
        found += [Run(wheel, "natural", "all", threads=2)]
    return found


def peak_runs() -> list[Run]:
    umbilic = ["nothing", "topology", "N_CM", "N_CM from faces", "least squares", "adaptive jets, 4 rings"]
    peers = {
        "openmesh": ["structure", "normals"],
        "cgal": ["structure", "normals", "curvatures"],
        "libigl": ["normals", "curvatures"],
        "vcg": ["structure", "normals", "curvatures"],
        "vtk": ["structure", "normals", "curvatures"],
        "open3d": ["structure", "normals"],
        "meshlib": ["structure", "normals"],
    }
    found = [Run("umbilic", "natural", f"peak:{what}") for what in umbilic]
    return found + [Run(peer, "natural", f"peak:{what}") for peer, whats in peers.items() for what in ["nothing", *whats]]


def scaling_runs(quick: bool) -> list[Run]:
    peaks = ["nothing", "topology", "N_CM", "least squares"]
    return [
        run
        for mesh in scaling(quick)
        for run in [
            Run("umbilic", mesh.name, "scaling"),
            *(Run("umbilic", mesh.name, f"peak:{what}") for what in peaks),
        ]
    ]
