"""docs/benchmarks.md."""

import textwrap

import tables
from samples import Samples
from targets import TARGETS


def page(samples: Samples) -> str:
    about = samples.about
    others = f"{100 * about['others']:.0f} %"
    clock = "CPU time (two threads, and one beside two: wall time)" if about["cpu"] else "wall time"
    lines = [
        "# Speed and memory",
        "",
        f"Written by `make bench` on {about['date']}.",
        "",
        f"- {about['processor']}",
        f"- {about['system']}",
        f"- {about['compiler']}, `-O3 -march=native`; wheels as their vendors built them",
        f"- {'; '.join(about['libraries'])}",
        f"- while it ran, other programs took {others} of the CPUs' time (two threads need a machine of their own)",
        *(f"- {line}" for line in about["missing"]),
        "",
        f"Times are {clock} in nanoseconds a triangle; a polygon counts as the triangles that it can be cut into. **×** is "
        "the ratio to a plain C loop, the *scatter kernel*, which adds each triangle's cross product to its three vertices "
        "and normalises (`float`, no checks, one thread, warm memory). Kernel, peer and umbilic take turns in one process, "
        f"and a ratio is the median over {about['rounds']} rounds of the ratios within a round. Cells of the large tables have "
        "the time, the ratio in bold, and half of the ratio's interquartile range; the first ones have quartiles.",
        "",
        "*Warm*: what is freed is kept by the process and used again, and results go to the same arrays in every round. "
        "*Fresh*: blocks of 1 MB and more, results included, come from the system page by page, and go back to it, in every "
        "call. Memory is warm where nothing else is said. *f32* and *f64* are the scalars of positions, given normals and all "
        "results.",
        "",
        *tables.kernel(samples),
        "## What must be reached, and aims",
        "",
        "As ratios to the scatter kernel, on the sphere of 1.3 M triangles in the order in which it is made, one thread, "
        "unless a row says something else. CGAL's: how many times as long CGAL takes for the same vertices, on the sphere of "
        "82 k triangles. Quads: a torus of 655 360 quadrilaterals, or of 64 000 where 128 k triangles' worth are said; the "
        "kernel takes two triangles for each.",
        "",
        "A corner by the sphere's: the time divided by the number of corners of all faces, as a ratio to the same of the "
        "sphere of 1.3 M triangles, which has as many vertices (four corners of quadrilaterals around a vertex, six of "
        "triangles). By the torus's, a corner or a vertex: the irregular torus, which is the same grid of 64 000 vertices with "
        "each cell cut along a diagonal drawn at random. These meshes are measured one after the other, not in turns. "
        "OpenMesh's by area: its time for `calc_vertex_normal_fast`, its default and the fastest of its normals, by that of "
        "umbilic's area weights.",
        "",
        *tables.aims(samples),
        "## Normals",
        "",
        "On a topology that is there, but for \"from faces\", which is one call without. Nanoseconds a triangle, and ×. "
        "\"Scatter over quads\" is the plain C loop over quadrilaterals as they are, one cross product of diagonals for each.",
        "",
        *tables.normals(samples, "f32"),
        *tables.normals(samples, "f64"),
        "## Vectors",
        "",
        "The option `simd` on the sphere of 1.3 M triangles (least squares: N_CM included).",
        "",
        *tables.levels(samples),
        "## Warm and fresh memory",
        "",
        *tables.memory(samples),
        "## Curvatures of large meshes",
        "",
        "k1, k2 and both directions. Normals (N_CM) are included unless they are given; adaptive jets include learning.",
        "",
        *tables.curvatures(samples),
        "## All methods",
        "",
        "Normals that cost more than one-ring averages first, then sections and curvatures. Methods write k1, k2 and both "
        "directions, or what they have of these, H and K.",
        "",
        *tables.methods(samples),
        "## Two threads",
        "",
        "Nanoseconds a triangle with two threads, and the speed-up from one.",
        "",
        *tables.threads(samples),
        "## Other libraries",
        "",
        "Nanoseconds a triangle of the other library, and how many times as long it takes as umbilic's method beside it, in "
        "the same process. Their structures are built once, like umbilic's topology, and are there for the rest. One thread "
        "means that the process is kept on one CPU; OpenMesh and CGAL have no more. They are given quadrilaterals "
        "as they are; the others know triangles best, and they and umbilic are given two for each.",
        "",
        *tables.peers(samples),
        *tables.agreements(samples),
        "## Peak memory",
        "",
        "What a process that does only this needs at most above one that reads the same mesh and does nothing, on the sphere "
        "of 1.3 M triangles: results and structure included; umbilic's in f32, the others' in their scalars as above.",
        "",
        *tables.peaks(samples),
        "## Scaling",
        "",
        "Spheres from a thousand to twenty million triangles: nanoseconds a triangle (f32, warm memory, one thread), and "
        "bytes a triangle.",
        "",
        *tables.scaling(samples),
        "![Nanoseconds and bytes a triangle against the number of triangles](scaling.png)",
    ]
    return "\n".join(map(wrapped, lines)) + "\n"


def wrapped(line: str) -> str:
    """Of the width of the other pages; tables stay as they are."""
    if line.startswith(("|", "!", "#")):
        return line
    return textwrap.fill(line, 120, subsequent_indent="  " if line.startswith("- ") else "", break_on_hyphens=False)


def summary(samples: Samples) -> str:
    """The targets, for the terminal."""
    lines = []
    for target in TARGETS:
        spread = target.measured(samples)
        if spread:
            sign = ">=" if target.larger else "<="
            limits = f"must {sign} {target.must:g}, aim {sign} {target.aim:g}"
            lines.append(f"  {target.title:66}{spread.median:8.2f}   {limits:26}{target.verdict(spread).strip('*')}")
    return "\n".join([*lines, *samples.about["missing"]])
