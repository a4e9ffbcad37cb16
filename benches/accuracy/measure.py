"""Runs estimators over the suite, in processes of their own."""

from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

from contestants import Subject, umbilic
from scores import Scores, errors_of


class Worker:
    """What a process measures with. `entrants` makes the estimators: peers must not be loaded before a fork."""

    def __init__(self, entrants):
        self.estimators = entrants()

    def scores(self, case):
        scores = Scores()
        for noise, sample in case.samples():
            with umbilic.Topology(sample.faces, len(sample.positions)) as topology:
                subject = Subject(sample, topology)
                for estimator in self.estimators:
                    scores.add(estimator, case, noise, errors_of(sample, estimator.run(subject)))
        return scores


WORKER = None


def start(entrants):
    global WORKER
    WORKER = Worker(entrants)


def work(case):
    return WORKER.scores(case)


def measure(entrants, cases, processes=2):
    scores = Scores()
    with ProcessPoolExecutor(processes, get_context("fork"), start, (entrants,)) as pool:
        for found in pool.map(work, cases, chunksize=4):
            scores.merge(found)
    return scores


def elsewhere(function, *arguments):
    """The result of a function that is called in a process of its own."""
    with ProcessPoolExecutor(1, get_context("fork")) as pool:
        return pool.submit(function, *arguments).result()
