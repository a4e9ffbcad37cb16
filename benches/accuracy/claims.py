"""What the suite says of the paper's claims about N_CM and symmetric parabolas."""

from contestants import AVERAGES
from figures import situation
from markdown import listed, paragraphs, percent, table
from report import verdict

SITUATIONS = {
    "regular": situation("regular", 0.0),
    "irregular": situation("irregular", 0.0),
    "stretched": situation("stretched", 0.0),
    "quads": situation("quads", 0.0),
    "0.5 % noise": situation(None, 0.005),
    "2 % noise": situation(None, 0.02),
    "10 % noise": situation(None, 0.1),
    "creases": situation("creased", 0.0),
    "boundary": situation(None, 0.0, "boundary"),
}
PAPERS = ("N_G", "N_T", "area", "N_C")
GIVEN = ("N_T", "Jin", "N_CM", "Max", "jet 2-2", "jet 3-2", "jet 2-3", "jet 3-3", "jet 4-3", "exact")
RIVALS = (
    "meyer, Max",
    "quadric 1, N_CM",
    "taubin SP, N_CM",
    "watanabe SP, N_CM",
    "normal-cycle 1, Max",
    "goldfeather, N_CM",
    "rusinkiewicz, N_CM",
    "corrected-measure 1, N_CM",
    "jet 2-1",
)

AGAINST_AVERAGES = paragraphs("""
N_CM against each average: in which part of the rows its error is the smaller one, and the geometric mean of the ratio
of the errors (below 1, N_CM is better).
""")


def duels(figures, quantity, pairs):
    """Lines of a table: in which part of the rows the first is better, and the ratio of its error to the other's."""
    rows = []
    for label, name, other in pairs:
        cells = [figures.duel(quantity, name, other, where) for where in SITUATIONS.values()]
        rows.append([label, *(f"{percent(won)}, {ratio:.2f}" for won, ratio in cells)])
    return rows


def wins(figures, quantity, name, others, where):
    """In how many rows, of how many, the first has the smaller error."""
    scores = figures.scores.errors[quantity]
    pairs = [(error, scores[other][row]) for other in others for row, error in scores[name].items() if where(row)]
    return sum(mine < theirs for mine, theirs in pairs), len(pairs)


def clean(row):
    return row.location == "interior" and not row.noise


def noisy(row):
    return row.location == "interior" and row.noise > 0


def claims(figures):
    told = [
        f"on *{title}* it {verdict(wins(figures, 'normal', 'N_CM', PAPERS, where))}"
        for title, where in SITUATIONS.items()
    ]
    best = {}
    for title, where in SITUATIONS.items():
        best.setdefault(min(AVERAGES, key=lambda name: figures.error("normal", name, where)), []).append(title)
    winners = "; ".join(f"`{name}`: {', '.join(titles)}" for name, titles in best.items())
    pairs = {given: (f"least-squares SP, {given}", f"least-squares C, {given}") for given in GIVEN}
    sections = listed(
        f"{verdict(wins(figures, 'k', parabolas, [circles], clean))} with {given}"
        for given, (parabolas, circles) in pairs.items()
    )
    alike = [figures.duel("k", *pair, clean)[1] for pair in pairs.values()]
    spread = [figures.duel("k", *pair, noisy)[1] for pair in pairs.values()]
    text = paragraphs(f"""
A claim holds where the error is the smaller one in nine of ten rows, mostly holds from six of ten on, is undecided
above four of ten, and does not hold below. All surfaces, both halves; the interior, but for the last column.

- *N_CM is the best of the normals.* Against the four that the paper compares it with ({", ".join(PAPERS)}):
{"; ".join(told)}. The smallest mean error of all one-ring averages is that of {winners}.

- *Symmetric parabolas are better than circles* as sections, put together by least squares, on clean meshes:
{sections} normals. The geometric mean of the ratio of their errors, SP to C, is {min(alike):.2f} to {max(alike):.2f}
on clean meshes and {min(spread):.2f} to {max(spread):.2f} on noisy ones, depending on the normals: which normals are
given matters far more than which section.

- *Curvatures from sections are better than earlier ones*: the last table has the paper's way (`least-squares SP,
N_CM`) against the others, on one ring and the same normals where they take any.
""")
    heads = ["", *SITUATIONS]
    normals = duels(figures, "normal", [(name, "N_CM", name) for name in AVERAGES if name != "N_CM"])
    parabolas = duels(figures, "k", [(given, *pair) for given, pair in pairs.items()])
    rivals = duels(figures, "k", [(name, "least-squares SP, N_CM", name) for name in RIVALS])
    return "\n\n".join(
        [
            text,
            AGAINST_AVERAGES,
            table(heads, normals),
            "Symmetric parabolas against circles, by the normals given, likewise:",
            table(heads, parabolas),
            "`least-squares SP, N_CM` against other methods, likewise:",
            table(heads, rivals),
        ]
    )
