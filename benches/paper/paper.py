#!/usr/bin/env python3
"""Makes the tables and figures of "New Computation of Normal Vector and Curvature" anew, and measures its claims.

python3 benches/paper/paper.py [FOLDER]

Writes README.md, errata.md and pictures to the folder, docs/paper if nothing is said. Everything is seeded: the same
library and versions of numpy and matplotlib write the same bytes.
"""

import importlib
import sys
from pathlib import Path

import claims_curves
import claims_normals
import claims_sections
import errata
import measured
import umbilic
import verdicts_curvature
import verdicts_normals
from library import Library
from pages import paragraphs
from places import ROOT

TABLES = [f"table_{number}" for number in range(1, 5)]
FIGURES = [f"figure_{number:02}" for number in range(1, 16)]


def readme(library, folder):
    tables, figures = (
        "\n\n".join(importlib.import_module(name).make(library, folder) for name in names)
        for names in (TABLES, FIGURES)
    )
    return "\n\n".join(
        [
            "# The paper's tables and figures",
            paragraphs("""
"New Computation of Normal Vector and Curvature" (N_CM, and curvature by symmetric parabolas), made anew with umbilic
through its C interface. `make paper` writes this page, its pictures and [errata and verdicts](errata.md), and fails
if the printed digits of tables 1 and 3 do not come out. Printed figures stand beside ours; everything else is ours.

The paper's pictures were not at hand: figures follow its captions and what the text says of them. Where it does not
say enough, the page says what was chosen.
"""),
            "## Tables",
            tables,
            "## Figures",
            figures,
        ]
    )


def verdicts(library, folder):
    normals, rings = claims_normals.on_surfaces(library), claims_normals.on_rings(library)
    curves, sections = claims_curves.errors(library), claims_sections.on_surfaces(library)
    return "\n\n".join(
        [
            "# Errata and verdicts",
            paragraphs("""
What is misprinted in "New Computation of Normal Vector and Curvature", and what became of its claims when they were
measured. Written by `make paper`; [tables and figures](README.md) are on a page of their own.
"""),
            errata.make(),
            "## Claims on normals",
            verdicts_normals.make(library, normals, rings),
            "## Claims on curvature",
            verdicts_curvature.make(library, curves, sections),
            measured.make(normals, rings, curves, sections, folder),
        ]
    )


def main(arguments):
    if len(arguments) > 1:
        sys.exit("usage: paper.py [FOLDER]")
    library = Library()
    folder = Path(arguments[0]) if arguments else ROOT / "docs" / "paper"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "README.md").write_text(readme(library, folder) + "\n")
    (folder / "errata.md").write_text(verdicts(library, folder) + "\n")
    print(f"{umbilic.build_info()}: the paper's tables and figures written")


if __name__ == "__main__":
    main(sys.argv[1:])
