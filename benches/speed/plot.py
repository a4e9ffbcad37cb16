"""docs/scaling.png."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

from samples import Samples


def scaling(samples: Samples, path: Path):
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 4.2), layout="constrained")
    curves, bytes_held, bytes_peak = {}, [], []
    for sample in samples.all(program="umbilic", set="scaling"):
        triangles = sample.line["triangles"]
        curves.setdefault(sample.line["name"], []).append((triangles, sample.time().median))
        if sample.line["name"] == "topology":
            curves.setdefault("scatter kernel", []).append((triangles, sorted(sample.scatter)[len(sample.scatter) // 2]))
            held = samples.handle(sample.line["mesh"])
            peak = samples.peak("umbilic", sample.line["mesh"], "topology")
            if held is not None:
                bytes_held.append((triangles, held))
            if peak is not None and triangles > 50000:  # below, a process needs more than the mesh
                bytes_peak.append((triangles, peak))
    for name, points in curves.items():
        left.plot(*zip(*points), marker="o", markersize=3, color="black" if name == "scatter kernel" else None, label=name)
    left.set(xscale="log", yscale="log", xlabel="triangles", ylabel="nanoseconds a triangle")
    for name, points in (("held by the topology", bytes_held), ("peak while it is built", bytes_peak)):
        if points:
            right.plot(*zip(*points), marker="o", markersize=3, label=name)
    right.set(xscale="log", ylim=(0, None), xlabel="triangles", ylabel="bytes a triangle")
    for axes in (left, right):
        axes.grid(alpha=0.3)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(fontsize="small")
    figure.savefig(path, dpi=110)
    pyplot.close(figure)
