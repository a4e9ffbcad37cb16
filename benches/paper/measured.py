"""The measurements that verdicts rest on, as tables and plots."""

import claims_curves
import claims_normals
import claims_sections
from irregular import SEEDS, SURFACES
from meshes import KINDS
from pages import paragraphs, short, table
from report import TITLES, decimal, order


def by_surface(errors, rows_of):
    heads = ["", *(surface.name for surface in SURFACES)]
    parts = []
    for kind in KINDS:
        parts += [f"On {TITLES[kind]}:", table(heads, rows_of(errors, kind))]
    return parts


def curves_table(curves):
    rows = []
    for (curve, spacing), errors in curves.items():
        for letter, values in errors.items():
            fitted = "exact" if max(values) < 1e-9 else decimal(order(values))
            rows.append([f"{curve}, {spacing}", f"κ_{letter}", *map(short, values), fitted])
    return table(["points", "formula", *map(str, claims_curves.COUNTS), "order"], rows)


def make(normals, rings, curves, sections, folder):
    claims_normals.plot_rings(rings, folder)
    claims_curves.plot(curves, folder)
    return "\n\n".join(
        [
            "## Measured",
            paragraphs(f"""
Surfaces and meshes are those of [benches/accuracy](../../benches/accuracy), and a sphere, and the cubic over a fifth
of its square, in triangles about five times as long as wide. Two sizes, of about 1000 and 4000 vertices; irregular
meshes and quads with {len(SEEDS)} seeds each. A *case* is one mesh. Tables have the mean over seeds on the finer
meshes.
"""),
            "### Normals on smooth surfaces",
            "Root mean square of the angle to the exact normal, in degrees.",
            *by_surface(normals, claims_normals.surface_table),
            "In how many cases N_CM has the smaller error:",
            table(["than", *(TITLES[kind] for kind in KINDS)], claims_normals.wins_table(normals)),
            "### Single rings",
            "![Single rings](rings.svg)",
            paragraphs(f"""
As Max did it in 1999: {claims_normals.RINGS} vertices for each number of neighbours, on cubic surfaces with random
coefficients, the neighbours at random distances and at random angles (no gap of 176° or more) or at even angles that
are moved by up to 30 % of their distance. His own figures were not at hand; this repeats the design, not the digits.
"""),
            "### Curves",
            "![Curves](curves.svg)",
            paragraphs(f"""
The clover r = 1 + 0.3 cos 3t, with even parameters and with parameters moved by up to {claims_curves.JITTER} of their
distance. Root mean square of the error, relative to that of the curvature, for points of three curves; uneven ones
over {len(claims_curves.SEEDS)} seeds:
"""),
            curves_table(curves),
            "### Curvature on smooth surfaces",
            "Root mean square of the error of k1 and k2, relative to that of the curvedness.",
            *by_surface(sections, claims_sections.surface_table),
        ]
    )
