"""Every estimator that takes part: the fixed ones, references that know the exact normals, and candidates.

Fixed estimators are what a row's best is chosen from. A candidate says that it does well everywhere, and is compared
with that best.
"""

import re
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "peers"))
import bindings  # noqa: E402, F401
import umbilic  # noqa: E402
from umbilic import METHODS, WEIGHTS  # noqa: E402, F401

AVERAGES = {
    "N_CM": "conformal",
    "N_G": "uniform",
    "N_T": "angle",
    "area": "area",
    "Max": "max",
    "N_C": "centroid",
    "N_C printed": "centroid-area",
    "Jin": "inverse-root-edges",
    "sine": "sine",
    "angle-edges": "angle-edges",
}
SECTIONS = {"C": "circle", "SP": "symmetric-parabola"}
# Degree and rings.
JETS = [(degree, rings) for rings in (2, 3, 4, 5) for degree in (2, 3, 4)]
JETS.insert(0, (2, 1))
# Normals that curvatures are given: all of these to those that do well with good ones.
GIVEN_AVERAGES = ("N_CM", "Max")
GIVEN_JETS = ("jet 2-2", "jet 3-2", "jet 2-3", "jet 3-3", "jet 4-3")
QUANTITIES = ("normal", "k", "mean", "gaussian")


class Own:
    """An estimator of the library."""

    def seconds(self, subject):
        """CPU time, the topology being there; that of normals which it takes included."""
        subject = Subject(subject.sample, subject.topology)
        start = time.process_time()
        self.run(subject)
        return time.process_time() - start


class Normal(Own):
    """A vertex normal of the library."""

    gives = ("normal",)

    def __init__(self, name, weight, fixed=True, **options):
        self.name, self.options, self.fixed = name, {"weight": weight, **options}, fixed

    def run(self, subject):
        return {"normal": subject.normals(self.name, self.options)}


class Curvature(Own):
    """A curvature of the library, of the normals `given` if it takes any."""

    gives = ("k", "mean", "gaussian")

    def __init__(self, name, method, given=None, fixed=True, **options):
        self.name, self.method, self.given = name + (f", {given}" if given else ""), method, given
        self.options, self.fixed = options, fixed and given != "exact"
        self.wanted = ("gaussian",) if method == "angle-defect" else ("k1", "k2", "mean", "gaussian")

    def run(self, subject):
        options = dict(self.options)
        if self.given:
            options["normals"] = subject.given(self.given)
        options |= {"method": self.method, "outputs": self.wanted, "threads": 1}
        return vars(umbilic.curvatures(subject.sample.positions, subject.topology, **options))


class Subject:
    """A mesh to measure, with its topology and what peers have instead; normals that several take are computed once."""

    def __init__(self, sample, topology):
        self.sample, self.topology, self.known, self.handles = sample, topology, {"exact": sample.normal}, {}

    def normals(self, name, options):
        if name not in self.known:
            self.known[name], _ = umbilic.vertex_normals(self.sample.positions, self.topology, threads=1, **options)
        return self.known[name]

    def given(self, name):
        return self.known[name] if name in self.known else self.normals(name, options_of(name))


def jet(degree, rings):
    return f"jet {degree}-{rings}"


def options_of(name):
    """Of the normal of that name."""
    if name in AVERAGES:
        return {"weight": AVERAGES[name]}
    weight, *numbers = re.split("[ -](?=[0-9])", name)
    if weight == "jet":
        return {"weight": "jet", "degree": int(numbers[0]), "rings": int(numbers[1])}
    return {"weight": weight} | ({"rings": int(numbers[0])} if numbers else {})


def normals():
    names = [*AVERAGES, "jet 1-1", *(jet(*numbers) for numbers in JETS)]
    return [Normal(name, **options_of(name)) for name in names]


def curvatures():
    for degree, rings in JETS:
        yield Curvature(jet(degree, rings), "jet", degree=degree, rings=rings)
    for given in (*GIVEN_AVERAGES, *GIVEN_JETS, "exact"):
        for section in SECTIONS:
            yield Curvature(f"least-squares {section}", "least-squares", given, section=SECTIONS[section])
        for rings in (1, 2):
            yield Curvature(f"corrected-measure {rings}", "corrected-measure", given, rings=rings)
        for method in ("goldfeather", "rusinkiewicz"):
            yield Curvature(method, method, given)
    for given in ("N_T", "Jin"):
        for section in SECTIONS:
            yield Curvature(f"least-squares {section}", "least-squares", given, section=SECTIONS[section])
    for given in (*GIVEN_AVERAGES, "jet 3-2"):
        yield Curvature("quadric 1", "quadric", given, rings=1)
        yield Curvature("quadric 2", "quadric", given, rings=2)
    for given in ("Max", "jet 3-2"):
        yield Curvature("goldfeather 2", "goldfeather", given, rings=2)
    for method in ("taubin", "watanabe"):
        for section in SECTIONS:
            yield Curvature(f"{method} {section}", method, "N_CM", section=SECTIONS[section])
    for rings in (1, 2):
        yield Curvature(f"normal-cycle {rings}", "normal-cycle", "Max", rings=rings)
    yield Curvature("meyer", "meyer", "Max")
    yield Curvature("angle-defect", "angle-defect")


def fixed():
    """Normals, and curvatures; references among the latter, which are not fixed."""
    return [*normals(), *curvatures()]


CANDIDATES = ("adaptive-jet", "adaptive-jet 4", "adaptive-jet 3", "tilted-sections")


def candidate(name):
    """Estimators of that name, "method" or "method rings", as far as the library has the method."""
    options = options_of(name)
    method = options.pop("weight")
    found = []
    if method in WEIGHTS:
        found.append(Normal(name, method, fixed=False, **options))
    if method in METHODS:
        found.append(Curvature(name, method, fixed=False, **options))
    return found


def candidates(names=None):
    """The estimators of all `names`, of any method of the library, or all candidates."""
    return [estimator for name in names or CANDIDATES for estimator in candidate(name)]


def followers():
    """What published methods make of the candidates' normals."""
    if "adaptive-jet" not in WEIGHTS:
        return []
    given = "adaptive-jet 4"
    return [
        Curvature("corrected-measure 1", "corrected-measure", given, fixed=False, rings=1),
        *(
            Curvature(f"least-squares {section}", "least-squares", given, fixed=False, section=SECTIONS[section])
            for section in SECTIONS
        ),
    ]
