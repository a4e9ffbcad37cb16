"""Pieces of Markdown."""

import re
import textwrap


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def paragraphs(text):
    """Lines of at most 120, blank lines and list items kept apart."""
    wrap = textwrap.TextWrapper(120, break_long_words=False, break_on_hyphens=False)
    result = []
    for paragraph in text.strip().split("\n\n"):
        for item in re.split(r"\n(?=- )", paragraph):
            wrap.subsequent_indent = "  " if item.startswith("- ") else ""
            result.append(wrap.fill(" ".join(item.split())))
        result.append("")
    return "\n".join(result).strip()


def percent(part):
    return f"{100 * part:.0f} %"


def listed(items, last="and"):
    """In a sentence."""
    items = list(items)
    return f" {last} ".join(filter(None, [", ".join(items[:-1]), items[-1]])) if items else "none"
