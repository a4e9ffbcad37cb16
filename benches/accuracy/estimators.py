"""What is measured: every weight of vertex normals, and every curvature method with the normals that matter to it."""

import sys
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "peers"))
import bindings  # noqa: E402, F401
import umbilic  # noqa: E402
from umbilic import METHODS, WEIGHTS  # noqa: E402

# Names, and the options of vertex_normals.
FITS = ("jet", "adaptive-jet", "tilted-sections")
AVERAGES = {weight: {"weight": weight} for weight in WEIGHTS if weight not in FITS}
NORMALS = AVERAGES | {f"jet {degree}": {"weight": "jet", "degree": degree} for degree in (1, 2, 3, 4)}
NORMALS |= {f"normal of {weight}": {"weight": weight} for weight in FITS if weight in WEIGHTS and weight != "jet"}

# Normals that curvatures are given: N_CM, jets of degree 3, and the exact ones.
GIVEN = {"N_CM": {"weight": "conformal"}, "jet": {"weight": "jet"}, "exact": {}}
SECTIONS = {"SP": "symmetric-parabola", "C": "circle"}
VALUES = ("k1", "k2", "mean", "gaussian")
OUTPUTS = {"angle-defect": ("gaussian",), "meyer": VALUES, "watanabe": VALUES}


class Curvature:
    """A method with its options, the normals that it is given, and the outputs that are wanted of it."""

    def __init__(self, method, given=None, section=None, balls=False, **options):
        self.given, self.balls, self.method = given, balls, method
        self.options = options | ({"section": SECTIONS[section]} if section else {})
        words = [method, section, f"degree {options['degree']}" if options else None, "in balls" if balls else None]
        self.name = " ".join(word for word in words if word) + (f", {given}" if given else "")
        self.wanted = OUTPUTS.get(method, (*VALUES, "direction1"))

    def run(self, topology, mesh):
        options = dict(self.options)
        if self.given:
            options |= {"normals": mesh.exact.normal} if self.given == "exact" else GIVEN[self.given]
        if self.balls:
            # Shrinks like the square root of an edge, so ever more edges are in it.
            diameter = numpy.linalg.norm(numpy.ptp(mesh.positions, axis=0))
            options["radius"] = 0.3 * diameter * len(mesh.positions) ** -0.25
        return vars(
            umbilic.curvatures(mesh.positions, topology, method=self.method, outputs=self.wanted, **options)
        )


def curvatures():
    for method in ("adaptive-jet", "tilted-sections"):
        if method in METHODS:
            yield Curvature(method)
    for degree in (2, 3, 4):
        yield Curvature("jet", degree=degree)
    for method in ("quadric", "goldfeather"):
        for given in GIVEN:
            yield Curvature(method, given)
    for section in SECTIONS:
        for given in GIVEN:
            yield Curvature("least-squares", given, section)
    for method in ("taubin", "watanabe"):
        for section in SECTIONS:
            for given in ("N_CM", "exact"):
                yield Curvature(method, given, section)
    yield Curvature("meyer")
    yield Curvature("angle-defect")
    yield Curvature("normal-cycle")
    yield Curvature("normal-cycle", balls=True)
    for method in ("rusinkiewicz", "corrected-measure"):
        for given in GIVEN:
            yield Curvature(method, given)


CURVATURES = {estimator.name: estimator for estimator in curvatures()}
