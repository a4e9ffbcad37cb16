"""Table 4: one edge with a given normal, by circle and by symmetric parabola."""

import numpy
import places  # noqa: F401
import umbilic
from pages import paragraphs, scientific, table, under
from polyhedra import fans

FANS, VALENCE = 12500, 8
UP = numpy.array([0.0, 0.0, 1.0])


def sections(library, edges):
    """Both curvatures along edges, `#fans x m x 3`, of vertices whose normal is the z axis."""
    positions, faces = fans(edges)
    count = len(edges)
    normals = numpy.broadcast_to(UP, positions.shape)
    mesh = umbilic.Topology(faces, len(positions))
    end = mesh.ring_offsets[count]
    found = {
        letter: umbilic.edge_sections(positions, mesh, section=section, normals=normals).curvature[:end]
        for letter, section in (("C", "circle"), ("SP", "symmetric-parabola"))
    }
    return found, positions[mesh.ring_neighbours[:end]]


def around(radial, height):
    """Fans whose edges have these horizontal lengths and heights."""
    angles = 2 * numpy.pi * numpy.arange(VALENCE) / VALENCE
    return numpy.stack([radial * numpy.cos(angles), radial * numpy.sin(angles), height], -1)


def make(library, folder):
    random = numpy.random.RandomState(1)
    shape = (FANS, VALENCE)
    # Any edges that go down, from nearly flat to nearly upright.
    found, edges = sections(library, around(10 ** random.uniform(-3, 1, shape), -(10 ** random.uniform(-3, 1, shape))))
    lengths = numpy.linalg.norm(edges, axis=1)
    below = int((found["C"] <= found["SP"]).sum())
    # The circle of curvature 2, by its angle from the vertex, and the parabola of curvature 2.
    turn = random.uniform(0.1, 3.0, shape)
    circle, _ = sections(library, around(0.5 * numpy.sin(turn), 0.5 * (numpy.cos(turn) - 1)))
    across = random.uniform(0.1, 3.0, shape)
    parabola, _ = sections(library, around(across, -across * across))
    rows = [
        ["Formula", "2 N·BA / ‖AB‖²", "2 N·BA / ‖BA − (N·BA) N‖²"],
        ["Parameter", "Distance", "Horizontal distance"],
        ["Range, printed", "≤ 2 if ‖AB‖ ≥ 1", "< ∞"],
        [
            "Range, umbilic",
            f"κ ‖AB‖ at most {(found['C'] * lengths).max():.6f}",
            f"κ ‖AB‖ up to {scientific((found['SP'] * lengths).max())}, without bound",
        ],
        ["Trajectory, printed", "circle", "parabola"],
        [
            "Trajectory, umbilic",
            f"within {under(numpy.abs(circle['C'] - 2).max())} on circles of curvature 2",
            f"within {under(numpy.abs(parabola['SP'] - 2).max())} on parabolas of curvature 2",
        ],
        [
            "on the other's",
            f"from {parabola['C'].min():.2f} to {parabola['C'].max():.2f}",
            f"from {circle['SP'].min():.2f} to {circle['SP'].max():.0f}",
        ],
        ["Magnitude, printed", "κ_C ≤ κ_SP", ""],
        ["Magnitude, umbilic", f"κ_C ≤ κ_SP on {below} of {len(lengths)} edges", ""],
    ]
    return "\n\n".join(
        [
            "### Table 4: C and SP curvature of one edge with a given normal",
            table(["", "C-discrete curvature", "SP-discrete curvature"], rows),
            paragraphs(f"""
`umb_edge_sections` on {len(lengths)} random edges of vertices whose normal is given. The paper's B is the vertex, A
its neighbour, and N points to the inner side; the library's normals point outwards, which is a sign. All of the table
holds. "≤ 2 if ‖AB‖ ≥ 1" is the scale-free 2/‖AB‖ at one length.
"""),
        ]
    )
