"""Runs estimators over the suite, in two processes."""

from multiprocessing import get_context

from contestants import Subject, Umbilic
from scores import Scores, errors_of


class Worker:
    """What a process needs; the library is opened in each."""

    def __init__(self, library, estimators):
        self.library, self.estimators, self.umbilic = library, estimators, None

    def __call__(self, case):
        if self.umbilic is None:
            self.umbilic = Umbilic(self.library)
        scores = Scores()
        for noise, sample in case.samples():
            with self.umbilic.mesh(sample.faces, len(sample.positions)) as topology:
                subject = Subject(sample, topology)
                for estimator in self.estimators:
                    scores.add(estimator, case, noise, errors_of(sample, estimator.run(subject)))
        return scores


WORKER = None


def start(worker):
    global WORKER
    WORKER = worker


def work(case):
    return WORKER(case)


def measure(library, estimators, cases, processes=2):
    scores = Scores()
    if estimators:
        # Forked: what the parent has imported need not be imported again.
        with get_context("fork").Pool(processes, start, (Worker(library, estimators),)) as pool:
            for found in pool.imap_unordered(work, cases, 4):
                scores.merge(found)
    return scores
