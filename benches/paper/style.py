"""How plots look, and how they are written so that the same library writes the same bytes."""

import io

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from PIL import Image  # noqa: E402

pyplot.rcParams.update(
    {
        "svg.hashsalt": "umbilic",
        "font.size": 10,
        "axes.titlesize": 10.5,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "grid.color": "#e4e4e4",
        "grid.linewidth": 0.6,
        "axes.axisbelow": True,
        "legend.frameon": False,
        "lines.linewidth": 1.6,
        "figure.facecolor": "white",
        "mathtext.fontset": "dejavusans",
    }
)

# Colours that colour-blind readers can tell apart (Okabe and Ito).
BLACK, ORANGE, SKY, GREEN, BLUE, RED, PURPLE = "#222222 #e69f00 #56b4e9 #009e73 #0072b2 #d55e00 #cc79a7".split()
GREY, PALE = "#8a8a8a", "#eef2f6"
FORMULA = {"C": BLUE, "P": ORANGE, "PL": GREEN, "SP": RED}
WEIGHT = {"N_G": ORANGE, "N_T": GREEN, "N_M": GREY, "N_C": PURPLE, "N_CM": RED, "Max": BLUE}


def kappa(letter):
    return rf"$\kappa_{{{letter}}}$"


def name(weight):
    """N_CM with its subscript."""
    stem, _, below = weight.partition("_")
    return f"${stem}_{{{below}}}$" if below else weight


def panels(rows, columns, width, height, plain=False, **options):
    """A figure and its axes; `plain` for drawings, which have equal units and no axes."""
    figure, axes = pyplot.subplots(rows, columns, figsize=(width, height), squeeze=False, **options)
    if plain:
        figure.subplots_adjust(left=0, right=1, bottom=0, top=1)
        for axis in axes.flat:
            axis.set_aspect("equal")
            axis.axis("off")
    return figure, axes


def arrow(axis, start, end, colour, **options):
    style = {"arrowstyle": "-|>", "color": colour, "lw": 1.8, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 12}
    axis.annotate("", xy=end, xytext=start, arrowprops=style | options)


def save(figure, folder, file, colours=None):
    """An SVG or a PNG; a PNG of so many colours only, where few are enough, takes a third of the space."""
    options = {"dpi": 100, "bbox_inches": "tight", "pad_inches": 0.12}
    if file.endswith(".svg"):
        figure.savefig(folder / file, metadata={"Date": None, "Creator": None}, **options)
    else:
        pixels = io.BytesIO()
        figure.savefig(pixels, **options)
        picture = Image.open(pixels).convert("RGB")
        if colours:
            picture = picture.quantize(colours, dither=Image.Dither.NONE)
        picture.save(folder / file, optimize=True)
    pyplot.close(figure)
