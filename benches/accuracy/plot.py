"""docs/accuracy.png: error against cost."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot  # noqa: E402
from advice import one_ring  # noqa: E402
from contestants import CANDIDATES  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator  # noqa: E402
from tables import SUSPECTS  # noqa: E402

PANELS = {"normal": "Vertex normals", "k": "Principal curvatures"}
STYLES = {  # colour, marker, area
    "umbilic, one ring": ("#3b7dd8", "o", 45),
    "umbilic, several rings": ("#2a9d5c", "s", 36),
    "umbilic, adaptive jets": ("#d1352b", "*", 240),
    "OpenMesh": ("#8c6d31", "v", 40),
    "CGAL": ("#7a4fa3", "D", 34),
    "libigl": ("#e08214", "^", 44),
    "VCG": ("#444444", "X", 44),
    "VTK": ("#d87ab0", "P", 48),
    "MeshLib": ("#9aa0a6", "<", 44),
}
FRONT, AXIS = "#d1352b", "#444444"
# Where labels are tried, in directions and points of distance.
DIRECTIONS = ((1, 0), (1, 0.8), (1, -0.8), (-1, 0), (-1, 0.8), (-1, -0.8), (0, 1.2), (0, -1.2))
DISTANCES = (8, 15, 25, 40)


def family(name, own):
    if name not in own:
        return name.split(" ")[0]
    if name.startswith("adaptive-jet"):
        return "umbilic, adaptive jets"
    return "umbilic, one ring" if one_ring(name) else "umbilic, several rings"


def labelled(figures, quantity):
    """What gets a label, and whether it must: candidates and the front, then usual suspects and the best of peers."""
    names = figures.names(quantity)
    others = [name for name in names if name not in figures.own]
    best = {name.split(" ")[0]: name for name in reversed(others)}
    adaptive = [name for name in names if not figures.scores.fixed[name]]
    must = dict.fromkeys([*CANDIDATES, *figures.front(quantity)])
    chosen = dict.fromkeys([*must, *adaptive, *SUSPECTS[quantity], *best.values()])
    return [(name, name in must) for name in chosen if name in figures.costs[quantity]]


def place(axes, points, labels):
    """Labels beside their points where they cover nothing; those that have no such place only if they must."""
    renderer, frame = axes.figure.canvas.get_renderer(), axes.get_window_extent()
    marks = [axes.transData.transform(point) for point in points.values()]
    boxes = []
    for name, must in labels:
        tried = []
        for distance in DISTANCES:
            for dx, dy in DIRECTIONS:
                label = axes.annotate(
                    name,
                    points[name],
                    (dx * distance, dy * distance),
                    textcoords="offset points",
                    fontsize=8.5,
                    ha={1: "left", -1: "right", 0: "center"}[dx],
                    va="center",
                    arrowprops={"arrowstyle": "-", "color": "#999999", "lw": 0.5, "shrinkA": 0, "shrinkB": 3},
                )
                box = label.get_window_extent(renderer).expanded(1.03, 1.2)
                inside = frame.x0 < box.x0 and box.x1 < frame.x1 and frame.y0 < box.y0 and box.y1 < frame.y1
                covered = sum(box.contains(*mark) for mark in marks) + 3 * sum(box.overlaps(other) for other in boxes)
                tried.append((covered + 10 * (not inside), len(tried), label, box))
                label.set_visible(False)
        covered, _, label, box = min(tried, key=lambda attempt: attempt[:2])
        if covered == 0 or must:
            label.set_visible(True)
            boxes.append(box)
        for _, _, other, _ in tried:
            if not other.get_visible():
                other.remove()


def draw(figures, file):
    figure, panels = pyplot.subplots(1, 2, figsize=(16, 8.5), dpi=100, layout="constrained")
    handles = {}
    for axes, (quantity, title) in zip(panels, PANELS.items()):
        costs = figures.costs[quantity]
        fastest = min(costs.values())
        names = [name for name in figures.names(quantity) if name in costs]
        points = {name: (costs[name] / fastest, figures.summary(quantity, name).mean) for name in names}
        for kind, (colour, marker, area) in STYLES.items():
            here = [points[name] for name in names if family(name, figures.own) == kind]
            if here:
                handles[kind] = axes.scatter(*zip(*here), area, colour, marker, zorder=3, linewidths=0)
        axes.plot(*zip(*(points[name] for name in figures.front(quantity))), color=FRONT, lw=1, alpha=0.5, zorder=2)
        axes.axhline(1, color=AXIS, lw=1, ls=":", zorder=1)
        for axis, scale, steps in ((axes.xaxis, axes.set_xscale, (1,)), (axes.yaxis, axes.set_yscale, (1, 2, 5))):
            scale("log")
            axis.set_major_locator(LogLocator(subs=steps))
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g} ×"))
            axis.set_minor_formatter(FuncFormatter(lambda *_: ""))
        axes.grid(True, color="#eeeeee", zorder=0)
        axes.margins(0.1, 0.06)
        axes.set_title(title)
        axes.set_xlabel("time, to the fastest (one thread, double precision)")
        axes.set_ylabel("error, to the best fixed estimator of each row (geometric mean)")
        figure.canvas.draw()
        place(axes, points, labelled(figures, quantity))
    panels[0].legend(handles.values(), handles.keys(), loc="lower left", fontsize=9.5)
    figure.savefig(file, metadata={"Software": None})
    pyplot.close(figure)
