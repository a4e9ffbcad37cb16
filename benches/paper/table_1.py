"""Table 1: curvature by parabolas at the vertices of regular polygons."""

import printed
from pages import paragraphs, table
from polyhedra import regular_polygon


def curvatures(library):
    """All four curvatures by number of vertices, each the same at all vertices of the polygon."""
    return {
        count: {letter: float(found[0]) for letter, found in library.polyline(regular_polygon(count)).items()}
        for count in printed.TABLE_1
    }


def digits(curvature):
    """Curvature and radius as the paper prints them."""
    return f"{curvature:.2f}", f"{1 / curvature:.2f}"


def make(library, folder):
    found = curvatures(library)
    mine = [digits(found[count]["P"]) for count in found]
    theirs = list(printed.TABLE_1.values())
    rows = [
        ["curvature, printed", *(curvature for curvature, _ in theirs)],
        ["curvature, umbilic", *(curvature for curvature, _ in mine)],
        ["radius, printed", *(radius for _, radius in theirs)],
        ["radius, umbilic", *(radius for _, radius in mine)],
        ["κ_SP", *(f"{each['SP']:.2f}" for each in found.values())],
        ["κ_C", *(f"{each['C']:.2f}" for each in found.values())],
    ]
    same = sum(map(str.__eq__, sum(mine, ()), sum(theirs, ())))
    return "\n\n".join(
        [
            "### Table 1: curvature by parabolas on the unit circle",
            table(["n", *map(str, found)], rows),
            paragraphs(f"""
{same} of {2 * len(found)} figures are the printed ones. Edges of a regular polygon are equally long, and then κ_SP is
κ_P = 2 / (1 + cos(2π/n)); κ_C is 1 throughout, which is what the paper holds against it.
"""),
        ]
    )
