"""What the paper claims of normals, each with what was measured for and against it."""

import as_printed
import coordinates
import figure_02
import figure_05
import figure_15
import numpy
import printed
import table_2
import table_3
from claims_normals import FITS
from irregular import SURFACES
from library import PAPER
from meshes import KINDS
from pages import claim, scientific, significant, under
from report import TITLES, sum_of, verdict
from polyhedra import CUTS, tetrahedron_sphere, unit

BEFORE = [name for name in PAPER if name != "N_CM"]


def span(values):
    return f"{min(values):.1f} to {max(values):.1f}"


def best(errors, surfaces, rings):
    against = {kind: sum_of(errors.wins("N_CM", name, [kind]) for name in BEFORE) for kind in KINDS}
    four = "; ".join(f"on {TITLES[kind]} it {verdict(each)}" for kind, each in against.items())
    by_max = "; ".join(
        f"on {TITLES[kind]} N_CM is the better one in {{}} of {{}}".format(*errors.wins("N_CM", "Max", [kind]))
        for kind in KINDS
    )
    fit = [name for name in FITS if name in errors.found][-1]
    gain = min(
        errors.finest("N_CM", "irregular", name) / max(errors.finest(fit, "irregular", name), 1e-9) for name in surfaces
    )
    narrow = {name: errors.finest(name, "irregular", "stretched cubic") for name in ("sine", "Max", "N_CM")}
    other = rings["random angles"]
    worse = [ours / theirs for ours, theirs in zip(other["N_CM"], other["Max"])]
    uniform = sum(ours > theirs for ours, theirs in zip(other["N_CM"], other["N_G"]))
    return claim(
        "N_CM is the most accurate normal",
        'Abstract, 5.1, 6: "we argue that our method is the best of all".',
        (
            "For",
            f"""In every column of tables 2 and 3 N_CM has the smallest error of the five normals that the paper
compares, and all its figures of table 3 reproduce. Against these four on other surfaces, with the smaller error
counted: {four}.""",
        ),
        (
            "Against",
            f"""Max's weight of 1999, which the paper cites as an area weight and does not compare, is exact on every
sphere, so it wins both tables with 0. On the surfaces measured here: {by_max}. On single rings with random angles,
Max's own experiment, N_CM has {span(worse)} times the error of Max's weight, and more than N_G at {uniform} of
{len(worse)} numbers of neighbours. In narrow triangles (the stretched cubic, irregular) the sines of the angles have
{narrow["sine"]:.2f}°, Max's weight {narrow["Max"]:.2f}°, N_CM {narrow["N_CM"]:.2f}°. Fits to two rings and more are
another matter than averages of one ring: N_CM has at least {gain:.0f} times the error of the {fit} on irregular
meshes.""",
        ),
        (
            "Verdict",
            """True of the five normals compared, on spheres and on meshes of smooth surfaces, but not on rings with
random angles. Not true of all that was known: on triangles Max's weight is mostly better, on quads N_CM.""",
        ),
    )


def twice():
    ratios = [
        float(chen) / float(ours)
        for which in (printed.TABLE_2, printed.TABLE_3)
        for chen, ours in zip(which["N_C"], which["N_CM"])
        if float(ours)
    ]
    roots = [ratio**0.5 for ratio in ratios]
    return claim(
        "The exactness of N_CM is twice that of N_C",
        '5.1: "the exactness of our method is two times than that of Chen".',
        ("For", f"The printed errors of N_C are {span(ratios)} times those of N_CM."),
        (
            "Against",
            f"E is the square of the angle, halved; as angles the factor is its root, {span(roots)}.",
        ),
        ("Verdict", "Holds as a mean of E; of angles it does not."),
    )


def chen(errors):
    others = [name for name in BEFORE if name != "N_C"]
    beaten = []
    for column, count in enumerate(printed.TABLE_3_VERTICES):
        value = {name: float(printed.TABLE_3[name][column]) for name in BEFORE}
        rival = min(others, key=value.get)
        if value[rival] <= value["N_C"]:
            beaten.append(f"at {count} vertices {rival} has {value[rival]:.2e}, N_C {value['N_C']:.2e}")
    wins = {name: sum_of([errors.wins("N_C", name)]) for name in others}
    return claim(
        "Of the previous normals Chen's is the best",
        '5.1: "the normal vector computation proposed by Chen is better than the other previous methods".',
        ("For", "Table 2, and the right half of table 3."),
        (
            "Against",
            f"""Table 3 itself: {"; ".join(beaten)}. On other surfaces N_C has the smaller error """
            + ", ".join(f"than {name} in {{}} of {{}} cases".format(*each) for name, each in wins.items())
            + ".",
        ),
        ("Verdict", "Does not hold, but on the paper's subdivided tetrahedra."),
    )


def rendering(library):
    off = {name: each for (name, cut), each in figure_15.off_by_cut(library).items() if cut == CUTS[0]}
    order = ", ".join(f"{name} {off[name][0]:.1f}°" for name in sorted(off, key=lambda name: off[name][0]))
    return claim(
        "N_CM gives more realistic renderings",
        '5.1, figure 15: "the highlighted area of our method looks more realistic than the others".',
        ("For", f"At the cube's corner the normals are off by: {order} (figure 15)."),
        (
            "Against",
            """N_T is exact there, however the faces are cut, and is older; the paper does not show it. N_CM does
depend on the cut (figures 1 and 15).""",
        ),
        ("Verdict", "Holds against N_G and N_C, which are shown. It does not against N_T."),
    )


def faults(library):
    ratios = {name: figure_02.ratio(library, weight) for name, weight in figure_02.LISTED.items()}
    return claim(
        "N_G sees how a face is cut up, N_C sees vertices that are no neighbours, N_T sees angles only",
        "2.1, figures 1 and 2, against the previous normals.",
        (
            "For",
            f"""All three hold (figures 1 and 2): a flat face cut in four counts four times in N_G, and a larger face
behind the same corner has {significant(ratios["N_C as printed"])} times the weight in N_C as printed,
{significant(ratios["N_C"])} times with the weight 1/g².""",
        ),
        (
            "Against",
            """That N_T sees angles only is what makes it independent of how a flat face is cut, which N_CM is not.""",
        ),
        ("Verdict", "Holds; in N_T it is as much a merit."),
    )


def polygons(errors, surfaces):
    quads = sum_of(errors.wins("N_CM", name, ["quads"]) for name in [*BEFORE, "Max"])
    worst = max(errors.finest("N_CM", "quads", name) for name in surfaces)
    return claim(
        "N_CM works on meshes of any topology",
        "Abstract, 6.",
        (
            "For",
            f"""A corner of a polygon has an angle, two edges and a normal, and no more is needed. On meshes mostly of
quads that are not flat N_CM has the smallest error of the averages (smaller than each of the other four and Max's in
{quads[0]} of {quads[1]} comparisons), at most {worst:.2f}° on the finer ones.""",
        ),
        (
            "Against",
            """The paper has no experiment with polygons, and does not say what happens at boundaries, at corners that
take half the flattened ring or more (where tan(α/2) has a pole and then changes sign), and at vertices with several
fans. At vertices of three faces N_CM is poor ("Single rings").""",
        ),
        ("Verdict", "Holds, once these cases are decided; the library does."),
    )


def reasons(library):
    pairs = []
    for mesh in table_3.meshes().values():
        rings = as_printed.Rings(*mesh)
        faces = as_printed.weighted(lambda ring: numpy.ones(len(ring.edges)))
        pairs.append((as_printed.error(rings, faces), as_printed.error(rings, mean_of_edges)))
    told = ", ".join(f"{scientific(a)} and {scientific(b)}" for a, b in pairs)
    return claim(
        "Why it is better: edges are nearer to the surface than faces, and conformal maps keep local properties",
        "3.2.",
        (
            "For",
            """Nothing is measured in the paper. The map matters: with all α alike three of the five spheres of table
3 are worse ("Table 3 by every reading").""",
        ),
        (
            "Against",
            f"""Normals of edges alone change little: the mean of the faces' normals and that of the edges' normals
have on the spheres of table 3 errors of {told}. And the map is not conformal (see above).""",
        ),
        ("Verdict", "Not shown. It is the weights that make the difference, not edges in the place of faces."),
    )


def mean_of_edges(ring):
    return unit(unit(ring.faces + numpy.roll(ring.faces, 1, 0)).sum(0))


def continuity():
    points, around = figure_05.grid(figure_05.SAMPLES), {}
    for name, polygon in figure_05.POLYGONS.items():
        values, within = coordinates.mean_value(polygon, points).min(-1), figure_05.inside(polygon, points)
        assert values[within].min() > 0
        around[name] = values[~within].min()
    return claim(
        "Mean value coordinates are continuous for any polygon and point, barycentric ones are not",
        "3.1, figure 5; equation (1) asks that they be non-negative.",
        ("For", "Holds (figure 5): mean value coordinates have no pole anywhere in the picture, the two others have."),
        (
            "Against",
            f"""Inside a convex polygon the others are as continuous. And outside a polygon mean value coordinates are
not all non-negative: the least around the 7-gon is {around["convex"]:.2f}, around the concave polygon
{around["concave"]:.2f}; inside both they are positive. To N_CM none of this matters: it takes the coordinates of one
point that the flattened ring goes around once, where they are positive unless an angle is π or more.""",
        ),
        ("Verdict", "Continuity holds; equation (1) holds inside only."),
    )


def coordinate_system(library):
    positions, faces = tetrahedron_sphere(3)
    positions = positions * [1, 0.7, 1.4]
    turn, _ = numpy.linalg.qr(numpy.random.RandomState(1).normal(size=(3, 3)))
    turn *= numpy.sign(numpy.linalg.det(turn))
    off = {
        name: numpy.abs(
            library.normals(positions @ turn, faces, weight) - library.normals(positions, faces, weight) @ turn
        ).max()
        for name, weight in PAPER.items()
    }
    return claim(
        "N_CM does not depend on the coordinate system of world space",
        '2.1: "we may resolve the problem of Phong shading that the intensity … is dependent on … coordinate system".',
        ("For", f"Normals of a turned mesh are the turned normals, within {under(off['N_CM'])}."),
        (
            "Against",
            f"""So they are with every other weight of the paper (within {under(max(off.values()))}): faces' normals,
angles, lengths and areas do not know the axes. Where shading depends on them it is because polygons are interpolated
along scan lines, which no vertex normal changes.""",
        ),
        ("Verdict", "True, and no merit of N_CM."),
    )


def irregularity(library):
    found = table_2.errors(library), table_3.errors(library)
    recursive, parametric = found[0]["N_CM"][2], found[1]["N_CM"][122]
    return claim(
        "Errors on subdivided tetrahedra are larger, because these are more irregular",
        "5.1.",
        (
            "For",
            f"""The printed errors of N_CM: 1.41E-04 at 130 vertices, 5.70E-05 at 122 by longitude and latitude. Here
{scientific(recursive)} and {scientific(parametric)}.""",
        ),
        ("Verdict", "Holds where sizes are alike."),
    )


def make(library, errors, rings):
    surfaces = [surface.name for surface in SURFACES]
    return "\n\n".join(
        [
            best(errors, surfaces, rings),
            twice(),
            chen(errors),
            rendering(library),
            faults(library),
            continuity(),
            polygons(errors, surfaces),
            reasons(library),
            coordinate_system(library),
            irregularity(library),
        ]
    )
