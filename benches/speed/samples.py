"""What was measured: one line of JSON for each task, as the programs print it, with the name of the set of tasks."""

import json
from dataclasses import dataclass
from pathlib import Path
from statistics import quantiles


@dataclass(frozen=True)
class Spread:
    """Quartiles."""

    low: float
    median: float
    high: float


def spread(values: list[float]) -> Spread:
    return Spread(*quantiles(values, n=4, method="inclusive")) if len(values) > 1 else Spread(*values * 3)


class Sample:
    def __init__(self, line: dict, cpu: bool = False):
        """By the clock on the wall, or by CPU time."""
        self.line = line
        self.ns, self.scatter = (line[f"cpu_{key}" if cpu else key] for key in ("ns", "scatter"))

    def time(self) -> Spread:
        """Nanoseconds a triangle."""
        return spread(self.ns)

    def ratio(self) -> Spread:
        """To the scatter kernel, of the same round."""
        return spread([mine / reference for mine, reference in zip(self.ns, self.scatter)])

    def per_triangle(self, other: "Sample") -> Spread:
        """How many times as long a triangle takes as one of another mesh. The two ran in processes of their own, so their
        rounds have nothing in common."""
        mine, theirs = self.time(), other.time()
        return Spread(mine.low / theirs.high, mine.median / theirs.median, mine.high / theirs.low)

    def per_corner(self, other: "Sample", corners: int, others: int) -> Spread:
        """The same of corners, where polygons here have `corners` of them and those of the other mesh `others`."""
        a_triangle = lambda polygon: polygon / (polygon - 2)
        scale, ratio = a_triangle(others) / a_triangle(corners), self.per_triangle(other)
        return Spread(ratio.low * scale, ratio.median * scale, ratio.high * scale)

    def times(self, other: "Sample") -> Spread:
        """How many times as long as the other, of the same program, in the same round."""
        return spread([mine / theirs for mine, theirs in zip(self.ns, other.ns)])


class Samples:
    def __init__(self, path: Path):
        lines = [json.loads(line) for line in path.read_text().splitlines()]
        self.about = next(line["about"] for line in lines if "about" in line)
        # On two threads there is no other way to tell; nor is there to compare one thread with two.
        cpu = lambda line: self.about["cpu"] and line["threads"] == 1 and line["set"] != "threads"
        self.tasks = [Sample(line, cpu(line)) for line in lines if "ns" in line]
        self.peaks = [line for line in lines if "peak" in line]
        self.agreements = [line for line in lines if "agreement" in line]

    def find(self, **wanted) -> Sample | None:
        """The task whose line has these values; umbilic's at its best level on one thread in warm memory unless they say
        something else."""
        wanted = dict(program="umbilic", library="umbilic", level="best", threads=1, memory="warm") | wanted
        matches = (task for task in self.tasks if wanted.items() <= task.line.items())
        return next(matches, None)

    def levels(self) -> list[str]:
        """Those of the option `simd` that the CPU has."""
        known = ["portable", "avx2", "avx512"]
        best = self.about["vectors"]
        return known[: known.index(best) + 1] if best in known else known[:1]

    def all(self, **wanted) -> list[Sample]:
        return [task for task in self.tasks if wanted.items() <= task.line.items()]

    def peak(self, program: str, mesh: str, what: str) -> float | None:
        """Bytes a triangle above those of the program with the mesh."""
        found = {line["peak"]: line for line in self.peaks if (line["program"], line["mesh"]) == (program, mesh)}
        if not {what, "nothing"} <= found.keys():
            return None
        return (found[what]["bytes"] - found["nothing"]["bytes"]) / found[what]["triangles"]

    def handle(self, mesh: str) -> float | None:
        """Bytes a triangle that the topology holds."""
        lines = [line for line in self.peaks if line["mesh"] == mesh and "handle" in line]
        return lines[0]["handle"] / lines[0]["triangles"] if lines else None
