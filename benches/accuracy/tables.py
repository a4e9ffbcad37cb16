"""The tables of docs/accuracy.md."""

from contestants import CANDIDATES
from figures import COLUMNS, QUANTITIES, half
from markdown import percent, table

# Told in the tables of ratios, beside candidates and the best.
SUSPECTS = {
    "normal": ("N_CM", "Max", "N_T", "area", "jet 3-2", "jet 3-3", "jet 4-3"),
    "k": (
        "jet 2-2",
        "jet 3-2",
        "jet 3-3",
        "jet 4-3",
        "corrected-measure 2, Max",
        "rusinkiewicz, Max",
        "goldfeather, Max",
        "least-squares C, N_CM",
        "least-squares SP, N_CM",
        "meyer, Max",
    ),
}
SUSPECTS |= {"mean": SUSPECTS["k"], "gaussian": (*SUSPECTS["k"], "angle-defect")}
BEST = 5  # fixed estimators that are told in any case
NEAR = 1.05  # bold


def digits(quantity, value):
    return "–" if value is None else f"{value:.{3 if quantity == 'normal' else 4}f}"


def leaderboard(figures, quantity):
    """Means of errors in each column; estimators with the same figures in one line, references last."""
    costs = {name: f"{cost:.0f}" for name, cost in figures.costs[quantity].items()}
    groups = figures.alike(quantity, figures.names(quantity))
    cells = {name: [figures.error(quantity, name, where) for where in COLUMNS.values()] for name in groups}
    least = [min(column) for column in zip(*cells.values()) if None not in column]
    rows = []
    for name, values in cells.items():
        marked = [
            f"**{digits(quantity, value)}**" if value <= NEAR * best else digits(quantity, value)
            for value, best in zip(values, least)
        ]
        cost = ", ".join(costs.get(each, "") for each in groups[name])
        rows.append([" = ".join(groups[name]), cost, f"{figures.summary(quantity, name).mean:.2f}", *marked])
    for name in figures.references(quantity):
        values = [digits(quantity, figures.error(quantity, name, where)) for where in COLUMNS.values()]
        rows.append([f"*{name}*", costs.get(name, ""), "", *(f"*{value}*" for value in values)])
    return table(["estimator", "ns", "ratio", *COLUMNS], rows)


def ratios(figures, quantity, of_half):
    names = figures.names(quantity)
    told = {name for name in names if name in SUSPECTS[quantity] or not figures.scores.fixed[name]}
    told |= set(figures.fixed(quantity)[:BEST])
    rows = []
    for name in sorted(told, key=lambda name: figures.summary(quantity, name, half(of_half)).mean):
        found = figures.summary(quantity, name, half(of_half))
        shown = f"**{name}**" if name in CANDIDATES else name
        rows.append(
            [shown, f"{found.mean:.2f}", f"{found.ninetieth:.2f}", f"{found.largest:.1f}", percent(found.close)]
        )
    count = max(figures.summary(quantity, name, half(of_half)).count for name in told)
    title = f"{QUANTITIES[quantity]}: {count} rows"
    return table([title, "geometric mean", "90th percentile", "largest", "within 1.2"], rows)


def front(figures, quantity):
    """From the cheapest on, every estimator that is better than all that cost less."""
    costs = figures.costs[quantity]
    rows = []
    for name in figures.front(quantity):
        found = figures.summary(quantity, name)
        cost = costs[name]
        rows.append(
            [name, f"{cost:.0f}", f"{cost / min(costs.values()):.1f}", f"{found.mean:.2f}", f"{found.ninetieth:.1f}"]
        )
    heads = [QUANTITIES[quantity], "ns a vertex", "to the fastest", "error: geometric mean", "90th percentile"]
    return table(heads, rows)


def valences(found):
    rows = []
    best = [min(column) for column in zip(*found.values())]
    for name, errors in sorted(found.items(), key=lambda item: sum(item[1])):
        marked = [f"**{error:.3f}**" if error <= least * NEAR else f"{error:.3f}" for error, least in zip(errors, best)]
        rows.append([name, *marked])
    return table(["weight", *map(str, range(3, 10))], rows)
