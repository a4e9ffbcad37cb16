"""What every estimator costs: CPU time on one mesh, one thread, all side by side in one run."""

import os

import numpy
from contestants import Subject, umbilic
from samplings import grid
from shapes import SHAPES

ROWS = 179  # of the torus: some 80 000 vertices
ROUNDS = 5
ENOUGH = 2.0  # seconds, after which an estimator is not run again


def threads():
    """Peers that start threads of their own are told not to."""
    for variable in ("OMP_NUM_THREADS", "IGL_NUM_THREADS"):
        os.environ[variable] = "1"


def costs(entrants):
    """Names, quantities and nanoseconds a vertex, and the number of vertices. Estimators take turns in rounds."""
    threads()
    shape = next(shape for shape in SHAPES if shape.name == "torus")
    sample = grid(shape, "irregular", ROWS, numpy.random.RandomState(1))
    estimators, found = entrants(), {}
    with umbilic.Topology(sample.faces, len(sample.positions)) as topology:
        subject = Subject(sample, topology)
        for _ in range(ROUNDS):
            for estimator in estimators:
                times = found.setdefault(id(estimator), [])
                if sum(times) < ENOUGH:
                    times.append(estimator.seconds(subject))
    count = len(sample.positions)
    result = []
    for estimator in estimators:
        result.append((estimator.name, estimator.gives, float(numpy.median(found[id(estimator)])) / count * 1e9))
    return result, count
