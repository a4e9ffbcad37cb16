"""The pictures: rows of meshes, columns of estimators."""

import matplotlib
import style
from shading import MAP, Frame

WIDE = 400  # pixels of a frame
INCHES = 3.1  # of a column


def board(rows, titles, labels):
    """Pictures in a grid, whose rows are as high as their pictures are."""
    heights = [row[0].shape[0] / row[0].shape[1] for row in rows]
    drawing, axes = style.panels(
        len(rows),
        len(titles),
        INCHES * len(titles),
        INCHES * sum(heights) * 1.02,
        plain=True,
        gridspec_kw={"height_ratios": heights, "wspace": 0.03, "hspace": 0.03},
    )
    for line, row, label in zip(axes, rows, labels):
        for axis, picture in zip(line, row):
            axis.imshow(picture, interpolation="antialiased")
        line[0].text(-0.03, 0.5, label, rotation=90, ha="right", va="center", transform=line[0].transAxes, fontsize=12)
    for axis, title in zip(axes[0], titles):
        axis.set_title(title, fontsize=12, pad=8)
    return drawing


def bar(drawing, count):
    """The colours, in units of the limit that stands beside each row."""
    # Below the last row, whose axes end at the figure's bottom.
    axis = drawing.add_axes([0.3, -0.055, 0.4, 0.018])
    shades = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(-1, 1), MAP)
    scale = drawing.colorbar(shades, cax=axis, orientation="horizontal", ticks=[-1, 0, 1])
    scale.ax.set_xticklabels(["concave: − the row's limit", "H = 0", "convex: + the row's limit"], fontsize=11)
    scale.outline.set_linewidth(0.5)


def curvatures(frame, measured, count):
    limit = measured.limit(count)
    return [frame.curvature(found.mean, limit) for found in measured.found[:count]]


def normals(frame, measured, count):
    return [frame.lit(found.normals) for found in measured.found[:count]]


def range_of(measured, count):
    return f"{measured.mesh.name}: ±{measured.limit(count) * measured.mesh.edge:.2f} / edge"


def draw(measured, drawn, folder):
    count = len(drawn)
    *scans, creased = measured
    titles = [f"{column.title}\n{column.curvature}" for column in drawn]
    whole = [Frame(each.mesh, WIDE) for each in scans]
    close = [Frame(each.mesh, WIDE, closeup=True) for each in scans]
    labels = [range_of(each, count) for each in scans]
    for file, frames in {"scans_curvature.png": whole, "scans_closeups.png": close}.items():
        drawing = board([curvatures(*pair, count) for pair in zip(frames, scans)], titles, labels)
        bar(drawing, count)
        style.save(drawing, folder, file, colours=255)
    names = [each.mesh.name for each in scans]
    shaded = [normals(*pair, count) for pair in zip(close, scans)]
    drawing = board(shaded, [f"{column.title}\n{column.normal}" for column in drawn], names)
    style.save(drawing, folder, "scans_normals.png", colours=255)
    frame = Frame(creased.mesh, WIDE)
    row = [*curvatures(frame, creased, count - 1), frame.marked(creased.rims.marked)]
    heads = [*titles[: count - 1], "umbilic\nvertices marked as on a crease"]
    drawing = board([row], heads, [range_of(creased, count - 1)])
    bar(drawing, count)
    style.save(drawing, folder, "scans_creases.png", colours=255)
