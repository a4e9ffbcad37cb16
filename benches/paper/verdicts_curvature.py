"""What the paper claims of curvature, each with what was measured for and against it."""

import figure_08
from claims_curves import COUNTS
from claims_sections import NORMALS, RIVALS, SECTIONS, compared
from irregular import SURFACES
from meshes import KINDS
from pages import claim, percent, short
from report import TITLES, decimal, order, verdict


def orders(curves, letter, spacing):
    found = [order(curves[curve, spacing][letter]) for curve in ("ellipse", "clover")]
    return " and ".join(map(decimal, found))


def fatal(library, curves):
    sharp = library.corner(*figure_08.corner(1))
    few = {letter: curves["circle", "uneven"][letter][0] for letter in ("C", "SP")}
    return claim(
        "The C-discrete curvature has a fatal error",
        "2.2, 4.1, figures 3, 8, 9: corners of all polygons in a circle have the same curvature, and it is bounded.",
        (
            "For",
            f"""The description holds (figures 3, 7, 8, 9; table 4): κ_C of points on a circle of radius 1 is 1
whatever their angle, and a corner of 1° between edges of length 1 has {sharp["C"]:.4f}, where κ_SP has
{sharp["SP"]:.0f}. Whoever means the sharpness of the polygon itself is not served by κ_C.""",
        ),
        (
            "Against",
            f"""Points of a circle of radius 1 are points of a curve of curvature 1. Where a polygon stands for a
smooth curve that it samples, κ_C alone of the four formulas is right on circles, at any spacing: with {COUNTS[0]}
uneven points its error is {short(few["C"])}, that of κ_SP {short(few["SP"])}. The bound is 2/|AB|; it rises as edges
shrink, and κ_C follows any smooth curve: on an ellipse and a clover with uneven points its error falls with order
{orders(curves, "C", "uneven")}, that of κ_SP with {orders(curves, "SP", "uneven")} ("Curves").""",
        ),
        ("Verdict", "What is described is so; an error it is not. The two formulas answer different questions."),
    )


def parabola(curves):
    stuck = curves["clover", "uneven"]["P"]
    return claim(
        "The parabola through three points resembles the local shape best",
        '4.2: "the best method to resemble the local shape … is to use the quadratic curve".',
        (
            "For",
            f"""Regular polygons: table 1, and the limit 1/r. With even parameters its error falls with order
{orders(curves, "P", "even")}.""",
        ),
        (
            "Against",
            f"""On unevenly spaced points κ_P does not converge: {stuck[0]:.2f} relative with {COUNTS[0]} points of a
clover, {stuck[-1]:.2f} with {COUNTS[-1]}. It tends to 4|a||c|/(|a|+|c|)² times the curvature, a and c being the
edges. The paper's own objection is figure 12.""",
        ),
        ("Verdict", "Holds for evenly spaced points only."),
    )


def lengths(curves):
    close = max(
        abs(a / b - 1)
        for curve in ("ellipse", "clover")
        for a, b in zip(curves[curve, "uneven"]["PL"], curves[curve, "uneven"]["SP"])
    )
    return claim(
        "The parabola by lengths resembles the local shape well, but has a more complex formula",
        "4.2, where it is left at that.",
        (
            "For",
            f"""On uneven points its error falls with order {orders(curves, "PL", "uneven")}, and is that of κ_SP to
within {100 * close:.1f} %.""",
        ),
        ("Against", "Carried out, the formula is 2 (|a| + |c|)² sin φ / |a − c|³, no more complex than κ_SP."),
        ("Verdict", "The first half holds. It would have repaired κ_P."),
    )


def better(curves, sections):
    told = "; ".join(
        "with {} normals parabolas are better by more than 2 % in {} cases, circles in {}, and neither in {}".format(
            "exact" if normals == "exact" else normals, *compared(sections, normals)
        )
        for normals in NORMALS
    )
    circle, even = (
        {letter: short(curves[curve, "even"][letter][0]) for letter in SECTIONS} for curve in ("circle", "clover")
    )
    return claim(
        "Symmetric parabolas are better than circles",
        "2.2, 4.3, 5.2.",
        (
            "For",
            f"""They tell sharp corners from blunt ones (figures 8, 9, 12). On a clover with {COUNTS[0]} even
parameters κ_SP has an error of {even["SP"]}, κ_C of {even["C"]}.""",
        ),
        (
            "Against",
            f"""On a circle it is {circle["SP"]} against {circle["C"]}, and on uneven points the two are alike
("Curves"). On surfaces, put together by least squares: {told}. On spheres circles are exact with exact normals, as
with Max's.""",
        ),
        (
            "Verdict",
            "Holds for corners. On smooth surfaces it does not: mostly the two are alike, else circles are better.",
        ),
    )


def previous(sections):
    duels = "; ".join(
        f"against {rival} it "
        + ", ".join(f"{verdict(sections.wins(('SP', 'N_CM'), rival, [kind]))} on {TITLES[kind]}" for kind in KINDS)
        for rival in ("Meyer et al.", "quadric, N_CM", "Goldfeather and Interrante, N_CM")
    )
    fits = [name for name in RIVALS if name in sections.found][-1]
    least = min(
        sections.finest(("SP", "N_CM"), "irregular", surface.name)
        / max(sections.finest(fits, "irregular", surface.name), 1e-9)
        for surface in SURFACES
    )
    return claim(
        "The curvature is more accurate than that of the previous methods",
        'Abstract: "it is confirmed by experiment that the normal vector and the curvature … are more accurate".',
        ("For", f"The paper's way, sections by symmetric parabolas with N_CM, put together by least squares: {duels}."),
        (
            "Against",
            f"""The paper has no experiment with the curvature of a surface: table 1 is about polygons, table 4 about
formulas. The figures just given are against it where they say so; and its error is at least {least:.0f} times that of
the {fits} on irregular meshes.""",
        ),
        ("Verdict", "Not confirmed in the paper; against Meyer et al. it holds on triangles, else it mostly does not."),
    )


def normals_matter(sections):
    surfaces = [surface.name for surface in SURFACES if surface.name != "sphere"]
    change, switch, shrink = [], [], []
    for surface in surfaces:
        values = {key: sections.finest(key, "irregular", surface) for key in sections.found}
        change.append(abs(values["SP", "N_CM"] / values["C", "N_CM"] - 1))
        switch.append(values["SP", "N_CM"] / values["SP", "exact"])
        coarse = sum(sections.found["SP", "N_CM"]["irregular", surface, 0])
        shrink.append(coarse / sum(sections.found["SP", "N_CM"]["irregular", surface, 1]))
    return claim(
        "Better normals make better curvature",
        '6: "by exploiting the more exact computation of normal vectors, we are able to compute the right … curvature"',
        (
            "For",
            f"""Normals matter far more than the formula of sections: on irregular meshes (not spheres) exact normals
in place of N_CM divide the error by {min(switch):.1f} to {max(switch):.0f}, circles in place of parabolas change it
by at most {percent(max(change))}.""",
        ),
        (
            "Against",
            f"""N_CM is not exact enough: twice as fine irregular meshes divide the error of curvature by
{min(shrink):.1f} to {max(shrink):.1f} only (2 would be first order). Normals of first order, and all averages of one
ring are that, give curvature that does not converge on irregular meshes; see [accuracy](../../README.md#accuracy).""",
        ),
        ("Verdict", "The first half holds; the second only on regular meshes."),
    )


def make(library, curves, sections):
    return "\n\n".join(
        [
            fatal(library, curves),
            parabola(curves),
            lengths(curves),
            better(curves, sections),
            previous(sections),
            normals_matter(sections),
        ]
    )
