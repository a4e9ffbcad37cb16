"""Markdown: tables and paragraphs as benches/accuracy writes them, numbers, and headings with a picture."""

import math

import places  # noqa: F401
from report import number, paragraphs, table

__all__ = ["claim", "figure", "paragraphs", "percent", "scientific", "short", "significant", "table", "under"]


def figure(title, file, caption, *rest):
    """A section with a picture: what follows the caption is Markdown already."""
    return "\n\n".join([f"### {title}", f"![{title}]({file})", paragraphs(caption), *rest])


def scientific(value):
    """Three digits, as in the paper's tables; below rounding 0."""
    return "0" if abs(value) < 1e-14 else f"{value:.2e}"


def under(error):
    """A power of ten that an error is not above, where its digits are rounding and say nothing."""
    return f"1e{max(-15, math.ceil(math.log10(max(error, 1e-99))))}"


def percent(part):
    return f"{part:.0%}".replace("%", " %")


def short(error):
    """An error in a table: two digits; 0 below rounding."""
    return number(error) if error > 1e-9 else "0"


def significant(value, digits=3):
    """So many digits, without an exponent where it reads better."""
    text = f"{value:.{digits}g}"
    return f"{value:.{digits - 1}e}" if "e" in text else text


def claim(title, says, *found):
    """A claim, where the paper makes it, and what was found: pairs of "For", "Against" or "Verdict" and a text."""
    return "\n\n".join([f"### {title}", paragraphs(says), *(paragraphs(f"**{kind}.** {text}") for kind, text in found)])
