"""The tables of docs/benchmarks.md, as lines of markdown."""

from collections.abc import Iterable

from counterparts import COUNTERPARTS, NOTES
from runs import PROGRAMS, TITLES
from samples import Sample, Samples, Spread, spread
from targets import TARGETS

METHOD_SETS = ("small", "torus", "dominant", "quads-small")


def table(head: list[str], rows: Iterable[list[str]]) -> list[str]:
    lines = [head, ["---"] + ["---:"] * (len(head) - 1), *rows]
    return [f"| {' | '.join(line)} |" for line in lines] + [""]


def digits(value: float) -> str:
    """Three significant digits, but no more than two behind the point."""
    if abs(value) >= 99.95:
        return f"{value:.0f}"
    return f"{value:.1f}" if abs(value) >= 9.995 else f"{value:.2f}"


def show(spread: Spread | None, unit: str = " ×") -> str:
    """The median, with the quartiles."""
    if spread is None:
        return "—"
    if spread.low == spread.high:
        return digits(spread.median) + unit
    return f"{digits(spread.median)}{unit} ({digits(spread.low)}–{digits(spread.high)})"


def short(time: Spread, ratio: Spread) -> str:
    """A time, and a ratio with half of its interquartile range."""
    return f"{digits(time.median)}: **{digits(ratio.median)}** ± {digits((ratio.high - ratio.low) / 2)}"


def both(sample: Sample | None) -> str:
    """The time, and its ratio to the scatter kernel."""
    return short(sample.time(), sample.ratio()) if sample else "—"


def names(samples: list[Sample]) -> list[str]:
    """In the order in which they were run."""
    return list(dict.fromkeys(sample.line["name"] for sample in samples))


def keys(samples: list[Sample]) -> list[tuple[str, str]]:
    """Names with scalars, likewise."""
    return list(dict.fromkeys((sample.line["name"], sample.line["scalar"]) for sample in samples))


def label(name: str, scalar: str) -> str:
    return name if name == "topology" else f"{name}, {scalar}"


def aims(samples: Samples) -> list[str]:
    rows = []
    for target in TARGETS:
        spread = target.measured(samples)
        verdict = target.verdict(spread) if spread else "not measured"
        sign = "≥" if target.larger else "≤"
        limits = [f"{sign} {limit:g}" for limit in (target.must, target.aim)]
        rows.append([target.title, show(spread, target.unit), *limits, verdict])
    return table(["", "measured", "must", "aim", ""], rows)


def kernel(samples: Samples) -> list[str]:
    rows = []
    for name, title in samples.about["meshes"].items():
        found = samples.all(program="umbilic", set="normals", mesh=name)
        if found:
            times = spread([time for sample in found for time in sample.scatter])
            rows.append([title, str(found[0].line["triangles"]), show(times, "")])
    return table(["mesh", "triangles", "scatter kernel, ns a triangle"], rows)


def normals(samples: Samples, scalar: str) -> list[str]:
    meshes = samples.about["meshes"]
    wanted = dict(set="normals", scalar=scalar)
    # The loop over quadrilaterals is a row like the others.
    find = lambda mesh, name: samples.find(mesh=mesh, name=name, **wanted) or samples.find(
        mesh=mesh, name=name, library="C", level="as built", **wanted
    )
    rows = [
        [name, *(both(find(mesh, name)) for mesh in meshes)]
        for name in names(samples.all(program="umbilic", **wanted))
        if name != "topology"
    ]
    return table([scalar, *meshes.values()], rows)


def levels(samples: Samples) -> list[str]:
    found = samples.all(program="umbilic", set="levels")
    kinds = samples.levels()
    rows = [
        [label(name, scalar), *(both(samples.find(set="levels", name=name, scalar=scalar, level=kind)) for kind in kinds)]
        for name, scalar in keys(found)
    ]
    return table(["", *kinds], rows)


def memory(samples: Samples) -> list[str]:
    rows = []
    for name, scalar in keys(samples.all(program="umbilic", set="memory")):
        for kind, sets in (("warm", ("normals", "threads")), ("fresh", ("memory",))):
            cells = []
            for mesh in samples.about["meshes"]:
                wanted = dict(mesh=mesh, name=name, scalar=scalar, memory=kind)
                found = [sample for tasks in sets if (sample := samples.find(set=tasks, **wanted))]
                cells.append(both(found[0] if found else None))
            rows.append([f"{label(name, scalar)}: {kind}", *cells])
    return table(["", *samples.about["meshes"].values()], rows)


def curvatures(samples: Samples) -> list[str]:
    rows, columns = [], ("natural", "shuffled", "quads")
    for tasks in ("curvatures", "adaptive"):
        for name, scalar in keys(samples.all(program="umbilic", set=tasks)):
            found = (samples.find(set=tasks, mesh=mesh, name=name, scalar=scalar) for mesh in columns)
            rows.append([label(name, scalar), *map(both, found)])
    return table(["", *(samples.about["meshes"][mesh] for mesh in columns)], rows)


def methods(samples: Samples) -> list[str]:
    columns = [(mesh, scalar) for mesh in METHOD_SETS for scalar in ("f32", "f64")]
    rows = [
        [name, *(both(samples.find(set="methods", mesh=mesh, name=name, scalar=scalar)) for mesh, scalar in columns)]
        for name in names(samples.all(program="umbilic", set="methods"))
    ]
    return table(["", *(f"{samples.about['meshes'][mesh]}, {scalar}" for mesh, scalar in columns)], rows)


def threads(samples: Samples) -> list[str]:
    meshes = samples.about["meshes"]
    rows = []
    for name, scalar in keys(samples.all(program="umbilic", set="threads")):
        cells = []
        for mesh in meshes:
            one, two = (
                samples.find(set="threads", mesh=mesh, name=name, scalar=scalar, threads=count) for count in (1, 2)
            )
            cells.append(short(two.time(), one.times(two)) if one and two else "—")
        rows.append([label(name, scalar), *cells])
    return table(["", *meshes.values()], rows)


def peers(samples: Samples) -> list[str]:
    lines = []
    for program, pairs in COUNTERPARTS.items():
        found = samples.all(program=program, level="as built")
        if found:
            lines += [f"### {TITLES[program]}", "", *([NOTES[program], ""] if NOTES[program] else [])]
            counts = (1,) if program in PROGRAMS else (1, 2)
            for count in counts:
                words = ["one thread", "two threads"][count - 1]
                lines += peer(samples, program, pairs, count, words)
    return lines


def peer(samples: Samples, program: str, pairs: dict, count: int, words: str) -> list[str]:
    meshes = {
        mesh: title
        for mesh, title in samples.about["meshes"].items()
        if samples.all(program=program, mesh=mesh, threads=count)
    }
    rows = []
    for theirs, (ours, scalar) in pairs.items():
        cells = []
        for mesh in meshes:
            wanted = dict(program=program, mesh=mesh, threads=count)
            a = samples.find(library=TITLES[program], name=theirs, level="as built", **wanted)
            b = samples.find(name=ours, scalar=scalar, **wanted)
            cells.append(short(a.time(), a.times(b)) if a and b else "—")
        if set(cells) != {"—"}:
            rows.append([f"`{theirs}`" if theirs != "structure" else theirs, f"{ours}, {scalar}", *cells])
    return table([words, "umbilic's", *meshes.values()], rows)


def agreements(samples: Samples) -> list[str]:
    worst = max((line["difference"] for line in samples.agreements), default=None)
    return [f"CGAL's k1 and umbilic's agree within {worst:.0e} of the largest.", ""] if worst is not None else []


def peaks(samples: Samples) -> list[str]:
    rows = []
    for line in samples.peaks:
        if line["mesh"] == "natural" and line["peak"] != "nothing":
            value = samples.peak(line["program"], "natural", line["peak"])
            if value is not None:
                rows.append([f"{TITLES[line['program']]}: {line['peak']}", digits(value)])
    return table(["", "bytes a triangle"], rows)


def scaling(samples: Samples) -> list[str]:
    found = samples.all(program="umbilic", set="scaling")
    sizes = dict.fromkeys((sample.line["mesh"], sample.line["triangles"]) for sample in found)
    times = names(found)
    rows = []
    for mesh, triangles in sizes:
        every = [samples.find(set="scaling", mesh=mesh, name=name) for name in times]
        kernel = spread([ns for each in every if each for ns in each.scatter])
        peak = [samples.peak("umbilic", mesh, what) for what in ("topology", "least squares")]
        held = samples.handle(mesh)
        rows.append(
            [f"{triangles:,}".replace(",", " "), digits(kernel.median)]
            + [digits(each.time().median) if each else "—" for each in every]
            + [digits(held) if held is not None else "—"]
            + [digits(each) if each is not None else "—" for each in peak]
        )
    head = ["triangles", "scatter", *times, "handle, bytes", "peak: topology", "peak: with least squares"]
    return table(head, rows)
