"""The first half of docs/paper/errata.md: what is misprinted, and how it was decided what was meant."""

import as_printed
import printed
from pages import paragraphs, scientific, table
from polyhedra import regular_polygon
from table_3 import meshes


def readings():
    """Table 3 by every reading of a formula: rows, and how many cells of the paper each reading gives."""
    rings = [as_printed.Rings(*mesh) for mesh in meshes().values()]
    rows = []
    for name, each in as_printed.READINGS.items():
        theirs = printed.TABLE_3[name]
        rows.append([f"**{name}** in the paper", *theirs, ""])
        for title, estimate in each.items():
            found = [as_printed.error(ring, estimate) for ring in rings]
            same = sum(printed.six_decimals(mine) == their for mine, their in zip(found, theirs))
            # A bar would end the cell.
            rows.append([title.replace("|", "\\|"), *map(scientific, found), f"{same} of {len(theirs)}"])
    return rows


def squared():
    """Table 1's curvatures by the formula that is printed with ‖C − A‖² instead of ‖C − A‖³."""
    found = []
    for count in printed.TABLE_1:
        a, b, c = regular_polygon(count)[[-1, 0, 1]]
        bent, chord = 4 * (a - 2 * b + c), c - a
        found.append(abs(bent[0] * chord[1] - bent[1] * chord[0]) / (chord @ chord))
    return ", ".join(f"{value:.2f}" for value in found)


def make():
    misprints = [
        ["2.1, N_T", "Σ Nf_i / ‖Σ Nf_i‖", "Σ θ_i Nf_i / ‖Σ θ_i Nf_i‖", "printed it is N_G; table 3"],
        ["2.1, N_G", "(1/n) Σ Nf_i", "the same, normalised", "table 3"],
        ["2.1, N_C", "ω_i = ‖f_i‖ / ‖g_i − v‖", "ω_i = 1 / ‖g_i − v‖², as Chen and Wu have it", "table 3"],
        ["3.2, α_i", "2π / Σ θ_j", "2π θ_i / Σ θ_j", "table 3; the printed angles do not sum to 2π"],
        ["3.2, Ne_i", "of f_i and f_{i+1}", "of f_{i−1} and f_i", "table 3; f_i is between V_i and V_{i+1}"],
        ["3.1, λ_i", "ω_j / Σ ω_k", "ω_i / Σ ω_k", "an index"],
        ["4.1", "2y / (x² + y²)", "−2y / (x² + y²)", "the line before; the sign of N = (0, −1)"],
        ["4.1", "p_i is on the radius of the circle", "on the circle", "the equation before"],
        ["4.2, κ_P", "/ ‖C − A‖²", "/ ‖C − A‖³", f"table 1, which would be {squared()}; the line before"],
        ["4.2", "v, h of sin and cos (2π i)/n", "(2π/n), that is i = 1", "table 1"],
        ["4.3", "headed 4.1", "4.3 goes on", "the numbers around it"],
        ["4.3", "triangles AA'B and C'C'B", "AA'B and CC'B", "figure 13's text"],
        ["3.1", "as shown in Figure 3", "Figure 4", "the captions"],
        ["5.1", "Figure 14(a) is the wire-frame of a cube", "Figure 15(a)", "the captions"],
        ["tables 2, 3", "N_G [2], N_T [3], N_M [4], N_C [6]", "[6], [7], [8, 9], [10]", "section 2.1"],
        ["2.1, N_M", "Taubin and Max [9] weight by area", "Max 1999 has sin θ / (a b)", "Max's paper; tables 2, 3"],
        ["table 3, N_M", "6.30E-04 at 262 vertices", "not known", "more than at 122 vertices, digits as at 578"],
    ]
    heads = ["reading", *map(str, printed.TABLE_3_VERTICES), "cells as printed"]
    return "\n\n".join(
        [
            "## Errata",
            paragraphs("""
What is printed wrongly, or so that it cannot have been computed. Where "table 3" decides, the next table shows how.
"""),
            table(["where", "printed", "meant", "decided by"], misprints),
            "### Table 3 by every reading",
            paragraphs("""
Mean errors on the spheres of table 3, by formulas evaluated as they read, in numpy (the library has only the right
ones). The last reading of each normal is the library's.
"""),
            table(heads, readings()),
            paragraphs("""
With the printed angles, all alike, N_CM would be better on two of these spheres and worse on three; that is not what
the paper computed. The map that it calls conformal keeps lengths and scales angles, which is not conformal; the
conformal map of a cone would also raise lengths to the power 2π/Σθ. The sphere with 23 vertices tells the two apart.

Section 2.1 says that the coordinates are taken with respect to the middle points of the mapped edges, section 3.2
with respect to their ends. That is the same: they do not depend on the polygon's size.

On what the paper says nothing about, the library decides: boundaries, α_i of π and more, opposite faces, edges
without length, several fans at a vertex, cusps. See the header.
"""),
        ]
    )
