#!/usr/bin/env python3
"""Measures umbilic and other libraries against the plain C scatter kernel, and writes docs/benchmarks.md.

    make bench                          everything: some ten minutes
    make bench BENCH="--quick"          smaller meshes, fewer rounds; writes target/bench/benchmarks.md
    make bench BENCH="--only umbilic"   without the other libraries, or with one of them alone; likewise
    make bench BENCH="--cpu-time"       on a machine that is busy with other things: one thread by CPU time, not wall time
    make bench BENCH="--page"           the page anew, from what was measured last

Every library has a process for each mesh, in which its tasks, umbilic's and the kernel take turns (rounds.h, peer.py).
Libraries that are not there are left out with a line that says so. All samples are kept in target/bench/samples.jsonl.
"""

import argparse
import datetime
import json
import subprocess
import sys
from pathlib import Path

import machine
import page
import plot
import runs
from samples import Samples

ROOT = Path(__file__).resolve().parents[2]
TARGET = ROOT / "target" / "bench"
BUILD = TARGET / "build"
LONGEST = 900  # seconds that one program may take


class Bench:
    def __init__(self, rounds: int):
        self.rounds, self.lines, self.missing = rounds, [], {}

    def make_mesh(self, mesh: runs.MeshFile):
        path = TARGET / "meshes" / f"{mesh.name}.mesh"
        path.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run([BUILD / "generate_mesh", mesh.kind, str(mesh.size), path], check=True)
        return path

    def command(self, run: runs.Run) -> list:
        mesh = TARGET / "meshes" / f"{run.mesh}.mesh"
        if run.program in runs.WHEELS:
            script = Path(__file__).with_name(f"bench_{run.program}.py")
            command = [sys.executable, "-B", script, BUILD, mesh, run.tasks]
            return command if run.tasks.startswith("peak:") else [*command, str(self.rounds), str(run.threads)]
        command = [BUILD / f"bench_{run.program}", mesh, run.tasks]
        return command if run.tasks.startswith("peak:") else [*command, run.memory, str(self.rounds)]

    def run(self, run: runs.Run):
        if run.program in self.missing:
            return
        print(f"{runs.TITLES[run.program]}: {run.mesh}, {run.tasks}, {run.memory}, {run.threads}", flush=True)
        try:
            done = subprocess.run(self.command(run), capture_output=True, text=True, timeout=LONGEST)
        except (OSError, subprocess.TimeoutExpired) as error:
            reason = "it took too long" if isinstance(error, subprocess.TimeoutExpired) else "it is not installed"
            return self.leave_out(run, reason)
        if done.returncode != 0:
            return self.leave_out(run, (done.stderr.strip().splitlines() or ["no message"])[-1])
        # Libraries print what they like.
        lines = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
        self.lines += [line | {"set": run.tasks} for line in lines]

    def leave_out(self, run: runs.Run, reason: str):
        if run.program == "umbilic":
            sys.exit(f"umbilic's own benchmark failed ({run}): {reason}")
        line = f"{runs.TITLES[run.program]} is not compared with: {reason.replace(str(ROOT), '')}"
        print(line, flush=True)
        self.missing[run.program] = line


def versions(missing: dict[str, str]) -> tuple[list[str], list[str]]:
    """Of the libraries, and what they say about themselves."""
    found, notes = [], []
    for program in runs.PROGRAMS:
        if program not in missing:
            try:
                lines = subprocess.run([BUILD / f"bench_{program}", "--version"], capture_output=True, text=True)
            except OSError:
                continue
            found.append(lines.stdout.splitlines()[0])
            notes += lines.stdout.splitlines()[1:]
    for wheel, package in runs.PACKAGES.items():
        if wheel not in missing and machine.package(package):
            name = "" if runs.WHEELS[wheel].lower() == package else f" ({package})"
            found.append(f"{runs.WHEELS[wheel]}{name} {machine.package(package)}")
    return found, notes


def measure(arguments: argparse.Namespace) -> list[dict]:
    bench, load = Bench(arguments.rounds or (3 if arguments.quick else 9)), machine.Load()
    wanted = lambda run: arguments.only in (None, run.program)
    meshes = runs.meshes(arguments.quick)
    names = [mesh.name for mesh in meshes]
    for mesh in meshes:
        bench.make_mesh(mesh)
    for run in filter(wanted, runs.umbilic_runs(names) + runs.peer_runs(names) + runs.peak_runs()):
        bench.run(run)
    for mesh in runs.scaling(arguments.quick):
        if arguments.only in (None, "umbilic"):
            path = bench.make_mesh(mesh)
            for run in runs.scaling_runs(arguments.quick):
                if run.mesh == mesh.name:
                    bench.run(run)
            path.unlink()
    libraries, notes = versions(bench.missing)
    about = {
        "date": datetime.date.today().isoformat(),
        "processor": machine.processor(),
        "system": machine.system(),
        "compiler": machine.first_line("cc", "--version"),
        "libraries": libraries,
        "vectors": libraries[0].rsplit(" ", 1)[-1],
        "missing": [*bench.missing.values(), *notes],
        "meshes": {mesh.name: mesh.title for mesh in meshes},
        "rounds": bench.rounds,
        "cpu": arguments.cpu_time,
        "others": load.others(),
    }
    return [{"about": about}, *bench.lines]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", choices=runs.TITLES)
    parser.add_argument("--rounds", type=int)
    parser.add_argument("--cpu-time", action="store_true")
    parser.add_argument("--page", action="store_true")
    arguments = parser.parse_args()
    part = arguments.quick or arguments.only is not None
    path = TARGET / ("part.jsonl" if part else "samples.jsonl")
    if not arguments.page:
        lines = measure(arguments)
        path.write_text("".join(f"{json.dumps(line)}\n" for line in lines))
    folder = TARGET if part else ROOT / "docs"
    samples = Samples(path)
    plot.scaling(samples, folder / "scaling.png")
    (folder / "benchmarks.md").write_text(page.page(samples))
    print(page.summary(samples))
    print(f"Written: {(folder / 'benchmarks.md').relative_to(ROOT)} and scaling.png beside it")


if __name__ == "__main__":
    main()
