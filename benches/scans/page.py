"""docs/scans.md. What the text says follows from figures."""

import numpy
from pages import paragraphs, percent, significant, table
from rims import DROP, SHARP
from stability import degrees, rms
from subjects import NOISE, SEEDS

LOST = 0.8  # adaptive jets that keep less of what they find with less noise smooth too much


def introduction(measured, drawn):
    versions = ", ".join(dict.fromkeys(column.version for column in drawn))
    return paragraphs(f"""
Written by `make pictures` ({versions}; meshes of Debian's `libcgal-demo`). The same meshes in the same view, each
column computed by that library:

- **umbilic**: normals and curvatures `adaptive-jet`, which is the default of curvatures.

- **libigl**: `principal_curvature` with its default radius 5, H = (k1 + k2) / 2; `per_vertex_normals`, default
weights.

- **VCG** through PyMeshLab: `compute_scalar_by_discrete_curvature_per_vertex`, which is H if nothing else is said
(cotangents over one ring); `compute_normal_per_vertex`, default weights (simple average).

- **adaptive-jet, noise / {drawn[-1].quieter}**: with the model that `umb_learn_model` learns, its `noise` divided by
{drawn[-1].quieter} (`model` of the options).

Mean curvature H is positive where the surface is convex: a sphere of radius r with faces counter-clockwise seen from
outside has 1/r. Red is positive, blue negative, white 0; colours end at the same limit in all columns of a row, the
median over the columns of what 95 % of |H| stay below. Limits and figures of H are in units of 1 / mean edge.
""")


def seen(measured, count):
    """What the pictures show, mesh by mesh."""
    *scans, _ = measured
    return "\n\n".join(paragraphs(f"**{each.mesh.name.capitalize()}.** {verdict(each, count - 1).strip()}") for each in scans)


def verdict(each, quiet):
    text = f"""
H of libigl's default has {percent(each.kept(1))} of the root mean square of adaptive-jet's, correlation
{each.correlation(1):.2f}; with radius 2 {percent(each.kept(4))}, {each.correlation(4):.2f}; VCG's
{percent(each.kept(2))}, {each.correlation(2):.2f}.
"""
    if each.kept(1) < LOST:
        text += " Radius 5 flattens what adaptive-jet keeps."
    noise, part = each.noise[0], each.size(0) / each.size(quiet)
    taken = f" Adaptive-jet takes {percent_of(noise)} of an edge for noise"
    if part >= LOST:
        return text + taken + f" and keeps {percent(part)} of what it finds with a tenth of that."
    off = rms(degrees(each.found[0].normals, each.found[quiet].normals))
    closer = each.correlation(quiet, 2)
    return f"""
{text.strip()}{taken}: too much. The fine relief goes, in normals too, which become {off:.0f} degrees (root mean square) other than
with a tenth of that noise, and the root mean square of H is {percent(part)} of what it is then. With a tenth it comes
back: correlation with VCG's H, which smooths nothing, {closer:.2f} instead of {each.correlation(0, 2):.2f}. Relief a
few edges wide looks like noise to the default; whoever knows that a mesh is clean hands in less.
"""


def percent_of(noise):
    return f"{100 * noise:.1f} %"


def figures(each):
    rows = []
    for index, (column, found, changes) in enumerate(zip(each.columns, each.found, each.changes)):
        rows.append(
            [
                f"{column.title}: {column.curvature}",
                f"{found.seconds[0] / len(each.mesh.positions) * 1e6:.1f}",
                f"{each.size(index):.3f}",
                f"{each.correlation(index):.2f}",
                percent(changes.mean),
                percent(changes.mean_scatter),
                f"{changes.normal:.2f}°",
                f"{changes.normal_scatter:.2f}°",
            ]
        )
    heads = ["", "µs a vertex", "RMS of H", "correlation", "change of H", "scatter", "of normals", "scatter"]
    count = f"{each.mesh.name.capitalize()}, {len(each.mesh.positions)} vertices"
    learned = ", ".join(percent_of(noise) for noise in each.noise[1])
    note = f"{count}; noise learned {percent_of(each.noise[0])} of an edge, with the noise added {learned}:"
    return "\n\n".join([note, table(heads, rows)])


def creases(each):
    rims = each.rims
    rows = []
    for kind in rims.kinds:
        values, differences = rims.of(kind)
        rows.append(
            [
                kind,
                str(len(values)),
                *(f"{value:.2f}" for value in numpy.quantile(values, (0.1, 0.5, 0.9))),
                *(f"{value:.3f}" for value in numpy.quantile(differences, (0.5, 0.9))),
                f"{differences.max():.2f}",
            ]
        )
    heads = ["rim", "vertices", "10 %", "median", "90 %", "neighbours differ: median", "90 %", "most"]
    (switched, pairs), (ends, end_pairs) = rims.switches(True), rims.switches(False)
    unmarked = rims.on & ~rims.marked
    smooth = numpy.abs(rims.value[unmarked])
    rest = f"""; the other {len(smooth)}, where adaptive jets fit a smooth surface instead, have |H| times edge
{smooth.min():.2f} to {smooth.max():.2f}""" if len(smooth) else ""
    return "\n\n".join(
        [
            paragraphs(f"""
Of {int(rims.on.sum())} vertices on edges of more than {SHARP} degrees {int((rims.on & rims.marked).sum())} are marked
(`UMB_VERTEX_CREASE` and `UMB_VERTEX_FALLBACK`), and {int((rims.marked & ~rims.on).sum())} others{rest}. H of
adaptive-jet times the mean length of the vertex's edges, along rims, corners left out:
"""),
            table(heads, rows),
            paragraphs(f"""
Neighbours along a rim of which one has {DROP} times the other's H or the other sign: {switched} of {pairs}; of pairs
with a corner, or with a vertex where a convex rim meets a concave one, {ends} of {end_pairs}. Libigl's default has
{percent(each.kept(1))} of the root mean square of adaptive-jet's H, VCG {percent(each.kept(2))}.
"""),
        ]
    )


def make(measured, drawn):
    return "\n\n".join(
        [
            "# Curvature of scans, side by side",
            introduction(measured, drawn),
            "![Mean curvature of bunny and armadillo](scans_curvature.png)",
            "![The same close up](scans_closeups.png)",
            seen(measured, len(drawn)),
            "## Normals",
            "![Bunny and armadillo shaded with vertex normals](scans_normals.png)",
            "Phong's shading with each library's own vertex normals.",
            "## Creases",
            "![Mean curvature of a machine part, and its crease vertices](scans_creases.png)",
            creases(measured[-1]),
            "## Figures",
            paragraphs(f"""
Times are CPU time in one thread from arrays to arrays, each library's own structure of the mesh built on the way, best
of three. *Correlation* is that with adaptive-jet. *Change*: normal noise of {significant(100 * NOISE)} % of the mean edge
added to every coordinate, {len(SEEDS)} seeds; root mean square of the difference of H, as a part of the root mean
square of H itself, and of the angle between the normals. *Scatter*: the same between noisy copies, by √2. A change
above the scatter is what the estimator smooths more, or bends more, because there is noise.
"""),
            *(figures(each) for each in measured),
        ]
    )
