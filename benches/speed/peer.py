"""What the programs that time libraries from Python wheels share.

    python3 bench_x.py BUILD MESH all ROUNDS THREADS     times tasks in turns with the scatter kernel and umbilic's
    python3 bench_x.py BUILD MESH peak:WHAT              what the process has had of memory when WHAT was run once

BUILD is the folder of the shared library of CMakeLists.txt, which has the kernel, umbilic's calls, and the memory. One
thread is the process kept on one CPU, before the library is loaded, so that no library has more; two are all CPUs. What
is printed is what rounds.h and program.h say.
"""

import ctypes
import json
import math
import os
import sys
import time
from collections.abc import Callable
from ctypes import POINTER, c_char_p, c_double, c_float, c_int, c_size_t, c_uint32, c_void_p
from pathlib import Path

LONG_ENOUGH = 0.003  # seconds


class Mesh(ctypes.Structure):
    """As in mesh.h."""

    _fields_ = [
        *((name, c_size_t) for name in ("vertex_count", "polygon_count", "corner_count", "triangle_count")),
        ("positions", POINTER(c_float)),
        ("positions_double", POINTER(c_double)),
        *((name, POINTER(c_uint32)) for name in ("corners", "offsets", "triangles")),
    ]


class Program:
    def __init__(self, name: str):
        folder, path, self.what, *rest = sys.argv[1:]
        self.name, self.rounds, self.threads = name, *map(int, rest or (1, 2))
        if self.threads == 1:
            os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
        self.library = ctypes.CDLL(str(Path(folder) / "libspeed.so"))
        self.library.read_mesh.restype, self.library.peak_memory.restype = Mesh, c_double
        self.library.ours_new.restype = c_void_p
        if not self.peak():
            self.library.set_memory(b"warm")
        self.mesh = self.library.read_mesh(c_char_p(path.encode()))
        self.mesh_name = Path(path).stem
        self.cut = cut(self.mesh)
        self.ours = c_void_p(self.library.ours_new(ctypes.byref(self.cut), 0))
        self.tasks: list[tuple[str, str, str, str, Callable[[], object]]] = []

    def peak(self) -> str | None:
        """What is to be run once, if that is what the program is to do."""
        return self.what.removeprefix("peak:") if self.what.startswith("peak:") else None

    def positions(self):
        """In single precision."""
        import numpy

        # Not all libraries take the type of ctypes' arrays for what it is.
        return numpy.ctypeslib.as_array(self.mesh.positions, (self.mesh.vertex_count, 3)).astype(numpy.float32)

    def positions_double(self):
        import numpy

        return numpy.ctypeslib.as_array(self.mesh.positions_double, (self.mesh.vertex_count, 3))

    def triangles(self):
        import numpy

        return numpy.ctypeslib.as_array(self.mesh.triangles, (self.mesh.triangle_count, 3))

    def small(self) -> bool:
        return self.mesh.triangle_count < 200000

    def add(self, library: str, name: str, scalar: str, run: Callable[[], object]):
        self.tasks.append((library, name, scalar, "as built", run))

    def add_ours(self, name: str, scalar: str):
        arguments = self.ours, name.encode(), c_uint32(scalar == "f64"), c_uint32(self.threads), c_uint32(0)
        self.tasks.append(("umbilic", name, scalar, "best", lambda: self.library.ours_run(*arguments)))

    def time(self):
        normals = (c_float * (3 * self.mesh.vertex_count))()
        reference = lambda: self.library.scatter_area(ctypes.byref(self.mesh), normals)
        scatter_repeats = repeats(reference)
        counts = [repeats(run) for *_, run in self.tasks]
        samples = [([], []) for _ in self.tasks]
        for _ in range(self.rounds):
            for (*_, run), count, (ns, scatter) in zip(self.tasks, counts, samples):
                scatter.append(seconds(reference, scatter_repeats))
                ns.append(seconds(run, count))
        for (library, name, scalar, level, _), (ns, scatter) in zip(self.tasks, samples):
            head = dict(program=self.name, mesh=self.mesh_name, memory="warm", library=library, name=name, scalar=scalar)
            tail = dict(level=level, threads=self.threads, triangles=self.mesh.triangle_count)
            print(json.dumps(head | tail | self.columns("ns", ns) | self.columns("scatter", scatter)))

    def columns(self, key: str, samples: list[tuple[float, float]]) -> dict[str, list[float]]:
        """Nanoseconds a triangle, by both clocks."""
        scaled = [[1e9 / self.mesh.triangle_count * value for value in clock] for clock in zip(*samples)]
        return dict(zip((key, f"cpu_{key}"), scaled))

    def print_peak(self):
        line = dict(program=self.name, mesh=self.mesh_name, triangles=self.mesh.triangle_count, peak=self.peak())
        print(json.dumps(line | dict(bytes=self.library.peak_memory())))


def cut(mesh: Mesh) -> Mesh:
    """Its triangles alone, without polygons."""
    fields = {name: getattr(mesh, name) for name, _ in Mesh._fields_}
    fields |= dict(polygon_count=mesh.triangle_count, corner_count=3 * mesh.triangle_count, corners=mesh.triangles)
    return Mesh(**fields | dict(offsets=None))


def seconds(run: Callable[[], object], count: int) -> tuple[float, float]:
    """Of one run, as the mean of so many: wall time, and CPU time of the process."""
    start = time.perf_counter(), time.process_time()
    for _ in range(count):
        run()
    end = time.perf_counter(), time.process_time()
    return (end[0] - start[0]) / count, (end[1] - start[1]) / count


def repeats(run: Callable[[], object]) -> int:
    """Warms something up, and tells how often it is to be run."""
    first = seconds(run, 1)[0]
    again = first if first >= 10 * LONG_ENOUGH else seconds(run, 1)[0]
    return min(1000, math.ceil(LONG_ENOUGH / max(again, 1e-9)))


def serve(name: str, load: Callable[[Program], object]):
    """`load` imports the library and answers with an object that has `structure()` and `add_tasks()`, and a method for
    each other thing that can be run once. What it holds of the mesh is there before `structure` is."""
    program = Program(name)
    peer = load(program)
    if program.peak():
        if program.peak() != "nothing":
            peer.structure()
        if program.peak() not in ("nothing", "structure"):
            getattr(peer, program.peak())()
        program.print_peak()
    else:
        peer.structure()
        peer.add_tasks()
        program.time()
