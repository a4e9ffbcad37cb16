"""Table 3: mean error of normals on spheres by longitude and latitude."""

import as_printed
import printed
from library import PAPER
from pages import paragraphs, scientific, table
from polyhedra import ring_sphere
from table_2 import error

SPHERES = {23: (7, 3), 50: (8, 6), 122: (15, 8), 262: (20, 13), 578: (36, 16)}  # segments and rings


def meshes():
    result = {count: ring_sphere(*size) for count, size in SPHERES.items()}
    assert all(len(positions) == count for count, (positions, _) in result.items())
    return result


def errors(library):
    found = meshes()
    return {
        name: {count: error(library, *mesh, weight) for count, mesh in found.items()}
        for name, weight in (PAPER | {"Max": "max"}).items()
    }


def make(library, folder):
    found = errors(library)
    rows, same, cells = [], 0, 0
    for name, theirs in printed.TABLE_3.items():
        mine = []
        for their, value in zip(theirs, found[name].values()):
            agrees = printed.six_decimals(value) == their
            same, cells = same + agrees, cells + 1
            mine.append(scientific(value) if agrees else f"**{scientific(value)}**")
        rows += [[f"{name}, printed", *theirs], [f"{name}, umbilic", *mine]]
    rows.append(["Max, umbilic", *map(scientific, found["Max"].values())])
    powers = ", ".join(
        f"{power:.2f}" if power else "none below 2"
        for power in (
            as_printed.area_power(*mesh, float(their)) for mesh, their in zip(meshes().values(), printed.TABLE_3["N_M"])
        )
    )
    sizes = ", ".join(f"{segments} x {rings}" for segments, rings in SPHERES.values())
    return "\n\n".join(
        [
            "### Table 3: mean error of normals, mesh by longitude and latitude",
            table(["vertices", *map(str, SPHERES)], rows),
            paragraphs(f"""
{same} of {cells} cells are the paper's to its printed digits (`benches/paper/check_digits.py` fails otherwise); the
others are bold. The paper prints three digits but holds six decimals: 5.73e-5 stands there as 5.70E-05, 2.16e-6 as
2.00E-06. Errors here are rounded to six decimals before they are compared.

The meshes are not described in the paper. These numbers of vertices have one natural reading: two poles and {sizes}
segments x rings at even latitudes, every quad cut along the same diagonal. N_C is the sum with the weight 1/g² of
Chen and Wu's own paper; the weight |f|/|g − v| that is printed gives none of its cells (see [errata](errata.md)).

Cells that do not reproduce:

- N_M, all five. The area weight that the paper prints gives the figures above. Of the weights |f|^p no one power
gives the column: from left to right it would take p = {powers}. The printed error grows from 122 to 262 vertices,
which no power of the area does, and has the digits of its right neighbour there: 6.30E-04 may stand for another
number. What formula or mesh the column was made with is not known.

- N_T and N_C at 262 vertices. The printed N_T is worse than N_G there, unlike in every other column of both tables,
and both figures are round, 60 and 50 units of the sixth decimal; an error of copying is likely, but not known.

- N_C at 578 vertices: one unit of the sixth decimal.
"""),
        ]
    )
