"""Figure 11: the polygons of figure 3, by parabolas."""

from figure_03 import draw
from pages import figure


def make(library, folder):
    draw(library, folder, "figure11.svg", "P")
    return figure(
        "Figure 11: polygons with different P-curvature values",
        "figure11.svg",
        """
The polygons of figure 3 with κ_P at their vertices (table 1): the sharper the corner, the larger, and 1 in the limit.
""",
    )
