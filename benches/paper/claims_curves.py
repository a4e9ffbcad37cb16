"""What the paper claims of the curvature of polygons, measured on points of smooth curves."""

import numpy
import style
from library import FORMULAS

COUNTS = (32, 64, 128, 256, 512, 1024)
SEEDS = range(20)
JITTER = 0.35  # of the distance between parameters


def ellipse(t):
    """Half axes 2 and 1: points and exact curvatures."""
    points = numpy.stack([2 * numpy.cos(t), numpy.sin(t)], 1)
    return points, 2 / (4 * numpy.sin(t) ** 2 + numpy.cos(t) ** 2) ** 1.5


def clover(t):
    """r = 1 + 0.3 cos 3t, which turns both ways."""
    r, first, second = 1 + 0.3 * numpy.cos(3 * t), -0.9 * numpy.sin(3 * t), -2.7 * numpy.cos(3 * t)
    points = r[:, None] * numpy.stack([numpy.cos(t), numpy.sin(t)], 1)
    return points, (r * r + 2 * first**2 - r * second) / (r * r + first**2) ** 1.5


def circle(t):
    return numpy.stack([numpy.cos(t), numpy.sin(t)], 1), numpy.ones(len(t))


CURVES = {"ellipse": ellipse, "clover": clover, "circle": circle}
SPACINGS = {"even": 0.0, "uneven": JITTER}


def errors(library):
    """Root mean squares relative to the curve's: [curve, spacing][formula], one for each number of points."""
    found = {}
    for curve, place in CURVES.items():
        for spacing, jitter in SPACINGS.items():
            for count in COUNTS:
                squares = {letter: [] for letter in FORMULAS}
                for seed in SEEDS if jitter else SEEDS[:1]:
                    noise = numpy.random.RandomState(seed).uniform(-1, 1, count)
                    points, exact = place(2 * numpy.pi * (numpy.arange(count) + jitter * noise) / count)
                    for letter, values in library.polyline(points).items():
                        squares[letter].append(((values - exact) ** 2).mean() / (exact**2).mean())
                for letter, each in squares.items():
                    cell = found.setdefault((curve, spacing), {}).setdefault(letter, [])
                    cell.append(float(numpy.sqrt(numpy.mean(each))))
    return found


def plot(found, folder):
    drawing, axes = style.panels(1, 2, 9.4, 3.9, gridspec_kw={"wspace": 0.12}, sharey=True)
    marks = {"C": "o", "P": "s", "PL": "^", "SP": "D"}
    for axis, spacing in zip(axes.flat, SPACINGS):
        for letter in ("P", "PL", "SP", "C"):
            axis.loglog(
                COUNTS,
                found["clover", spacing][letter],
                marker=marks[letter],
                markersize=5,
                color=style.FORMULA[letter],
                label=style.kappa(letter),
            )
        axis.set(title=f"{spacing} parameters", xlabel="points")
        axis.set_xticks(COUNTS, COUNTS)
        axis.minorticks_off()
    axes[0, 0].set_ylabel("RMS error, relative")
    axes[0, 0].legend()
    style.save(drawing, folder, "curves.svg")
