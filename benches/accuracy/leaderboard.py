#!/usr/bin/env python3
"""Measures every normal and curvature of umbilic on a suite of surfaces, and compares them with the best of each row.

    python3 benches/accuracy/leaderboard.py [--peers FOLDER] [--seed N ...]

writes docs/accuracy.md and docs/accuracy.png; with --again, from what it measured the last time.

    python3 benches/accuracy/leaderboard.py --half tuning [--only NAME,...] [--seed N ...] [--worst N] [--rows]

writes no documents, but prints how candidates (or any estimators, with --only: "adaptive-jet 4", "jet 3-2",
"tilted-sections") compare with the best fixed estimator of each row. The errors of the fixed ones are kept in
target/accuracy; --fresh measures them again.
"""

import argparse
import hashlib
import pickle
import sys
import time
from functools import partial
from pathlib import Path

from contestants import CANDIDATES, candidates, fixed
from figures import QUANTITIES
from measure import measure
from document import publish
from measurements import Measurements
from scores import Scores, Summary
from suite import HALVES, cases

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
CACHE = ROOT / "target" / "accuracy"
SEEDS = {None: [1, 2, 3], "tuning": [1], "verification": [1]}


def arguments(words):
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--half", choices=HALVES, help="print how estimators do on it, and write nothing")
    parser.add_argument("--seed", type=int, nargs="+", help="of the meshes; several make more rows")
    parser.add_argument("--peers", type=Path, help="where the programs of cpp/ are")
    parser.add_argument("--docs", type=Path, default=ROOT / "docs", help="where to write")
    parser.add_argument("--again", action="store_true", help="write the documents from the last measurements")
    parser.add_argument("--only", type=lambda names: names.split(","), help="candidates, separated by commas")
    parser.add_argument("--worst", type=int, default=0, metavar="N", help="list each candidate's N worst rows")
    parser.add_argument("--rows", action="store_true", help="list all rows of each candidate")
    parser.add_argument("--fresh", action="store_true", help="measure the fixed estimators again")
    parser.add_argument("--processes", type=int, default=2)
    options = parser.parse_args(words)
    options.seed = options.seed or SEEDS[options.half]
    return options


def cached_fixed(options, seed):
    """The fixed estimators' errors; measured if the suite, the scoring or the list of estimators is not what it was."""
    sources = ("shapes", "surfaces", "sample", "samplings", "bodies", "suite", "contestants", "scores")
    code = hashlib.sha256(b"".join((HERE / f"{name}.py").read_bytes() for name in sources)).hexdigest()[:12]
    file = CACHE / f"fixed-{options.half}-{seed}-{code}.pickle"
    if options.fresh or not file.exists():
        scores = measure(fixed, cases(HALVES[options.half], [seed]), options.processes)
        CACHE.mkdir(parents=True, exist_ok=True)
        file.write_bytes(pickle.dumps(scores))
    return pickle.loads(file.read_bytes())


def print_summary(scores, names):
    heads = "".join(f" | {title + ': mean':>13} {'90 %':>7} {'max':>7} {'<1.2':>5}" for title in QUANTITIES.values())
    print(f"{'ratio to the best of the row':32}{heads}")
    best = {quantity: scores.best(quantity) for quantity in QUANTITIES}
    for name in names:
        line = f"{name:32}"
        for quantity in QUANTITIES:
            ratios = scores.ratios(quantity, name, best[quantity])
            if ratios:
                found = Summary(ratios.values())
                line += f" | {found.mean:13.3f} {found.ninetieth:7.2f} {found.largest:7.1f} {found.close:5.0%}"
            else:
                line += f" | {'-':>13} {'':7} {'':7} {'':5}"
        print(line)


def print_rows(scores, name, count):
    for quantity, title in QUANTITIES.items():
        best = scores.best(quantity)
        ratios = scores.ratios(quantity, name, best)
        order = sorted(ratios, key=ratios.get, reverse=True)[:count]
        if order:
            print(f"\n{name}, {title}: ratio, error, error of the best, row, the best")
        for row in order:
            (winner, least), error = best[row], scores.errors[quantity][name][row]
            where = f"{row.surface}, {row.sampling}, {row.resolution}, {row.noise:.1%}, {row.location}, seed {row.seed}"
            print(f"{ratios[row]:8.2f} {error:10.5f} {least:10.5f}  {where:60} {winner}")


def main(words):
    options = arguments(words)
    if options.half:
        tune(options)
    else:
        write(options)


def write(options):
    file, start = CACHE / "last.pickle", time.time()
    if not options.again:
        CACHE.mkdir(parents=True, exist_ok=True)
        found = Measurements(options.peers, options.seed, options.processes)
        file.write_bytes(pickle.dumps(found))
    publish(pickle.loads(file.read_bytes()), options.docs)
    print(f"accuracy.md and accuracy.png written, in {time.time() - start:.0f} s")


def tune(options):
    start, scores = time.time(), Scores()
    for seed in options.seed:
        scores.merge(cached_fixed(options, seed))
    ready = time.time()
    known = [name for name in options.only or () if name in scores.fixed]
    names = known + compare(options, scores, [name for name in options.only or CANDIDATES if name not in known])
    counts = [len(scores.best(quantity)) for quantity in ("normal", "k")]
    print("{} half, seeds {}: {} rows of normals, {} of curvature".format(options.half, options.seed, *counts))
    print_summary(scores, names or sorted(scores.fixed))
    for name in names if options.rows or options.worst else ():
        print_rows(scores, name, None if options.rows else options.worst)
    print(f"\n{ready - start:.1f} s for the fixed estimators, {time.time() - ready:.1f} s for the candidates")


def compare(options, scores, wanted):
    """Measures candidates; answers with the names of those that the library has."""
    chosen = candidates(wanted) if wanted else []
    names = list(dict.fromkeys(estimator.name for estimator in chosen))
    for name in wanted:
        if name not in names:
            print(f"{name}: not in this library")
    if names:
        entrants = partial(candidates, wanted)
        scores.merge(measure(entrants, cases(HALVES[options.half], options.seed), options.processes))
    return names


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
