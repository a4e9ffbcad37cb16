"""All that docs/accuracy.md is made of."""

import contestants
from cost import costs
from libraries import peers
from measure import elsewhere, measure
from suite import TUNING, VERIFICATION, cases
from valences import experiment


class Everyone:
    """All estimators: made anew in every process."""

    def __init__(self, programs):
        self.programs = programs

    def __call__(self):
        return own() + peers(self.programs)[0]

    def told(self):
        return peers(self.programs)[1:]


def own():
    return [*contestants.fixed(), *contestants.candidates(), *contestants.followers()]


class Measurements:
    def __init__(self, programs, seeds, processes):
        everyone = Everyone(programs)
        self.build = contestants.umbilic.build_info()
        self.seeds = seeds
        self.peers, self.missing = elsewhere(everyone.told)
        self.scores = measure(everyone, cases([*TUNING, *VERIFICATION], seeds), processes)
        self.costs, self.cost_vertices = elsewhere(costs, everyone)
        self.valences = experiment()
