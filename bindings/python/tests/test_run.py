"""Threads, vectors, progress and cancelling; many Python threads, forks, and what must not crash."""

import gc
import os
import signal
import subprocess
import sys
import threading
import time
import weakref
from concurrent.futures import ThreadPoolExecutor

import numpy
import pytest

import umbilic


def everything(positions, mesh, **run):
    normals = umbilic.vertex_normals(positions, mesh, outputs=("normal", "sum", "status"), **run)
    fitted = umbilic.curvatures(positions, mesh, **run)
    meyer = umbilic.curvatures(positions, mesh, method="meyer", outputs=("mean_normal", "area"), **run)
    edges = umbilic.edge_sections(positions, mesh, **run)
    return [array.tobytes() for result in (normals, fitted, meyer, edges) for array in result]


@pytest.mark.parametrize("dtype", ["f4", "f8"])
def test_the_same_bits_for_any_threads_and_vectors(dtype):
    positions, faces = umbilic.examples.sphere(5)
    positions = (positions * [1, 2, 3]).astype(dtype)
    mesh = umbilic.Topology(faces, len(positions))
    expected = everything(positions, mesh)
    for run in ({"threads": 1}, {"threads": 3}, {"simd": "portable", "threads": 2}, {"simd": "sse2"}, {"simd": "avx2"}):
        assert everything(positions, umbilic.Topology(faces, len(positions), **run), **run) == expected, run


def test_several_python_threads_at_once(lump):
    positions, faces = lump
    mesh = umbilic.Topology(faces, len(positions))
    expected = everything(positions, mesh)
    with ThreadPoolExecutor(6) as pool:
        for found in pool.map(lambda _: everything(positions, mesh, threads=1), range(24)):
            assert found == expected


def test_the_interpreters_lock_is_released():
    """While one thread is inside the library, in a call without callbacks, another goes on."""
    faces = numpy.tile(umbilic.examples.sphere(6)[1], (8, 1))
    ticks, during = [], []
    running = threading.Event()

    def tick():
        running.set()
        while not during:
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    other = threading.Thread(target=tick)
    other.start()
    running.wait()
    start = time.perf_counter()
    umbilic.Topology(faces, 40962, threads=1)
    end = time.perf_counter()
    during.append(True)
    other.join()
    assert sum(start < each < end for each in ticks) > 5


def test_progress_goes_up_to_one(lump):
    seen, thread = [], []

    def note(fraction):
        seen.append(fraction)
        thread.append(threading.get_ident())
        return True  # as the progress bars of some packages do: not a wish to cancel

    umbilic.curvatures(*lump, progress=note)
    assert seen == sorted(seen) and seen[-1] == 1 and set(thread) == {threading.get_ident()}


def calls(positions, faces):
    mesh = umbilic.Topology(faces, len(positions))
    yield lambda **run: umbilic.vertex_normals(positions, mesh, **run)
    yield lambda **run: umbilic.curvatures(positions, mesh, **run)
    yield lambda **run: umbilic.corner_normals(positions, faces, **run)
    yield lambda **run: umbilic.face_normals(positions, faces, **run)
    yield lambda **run: umbilic.edge_sections(positions, mesh, **run)
    yield lambda **run: umbilic.direction_sections(positions, mesh, positions, **run)
    yield lambda **run: umbilic.learn_model(positions, mesh, **run)
    yield lambda **run: umbilic.segment_features(positions, faces, **run)
    yield lambda **run: umbilic.segment_watershed(positions, faces, **run)
    yield lambda **run: umbilic.segment_regions(positions, faces, **run)
    yield lambda **run: umbilic.shape_classes(positions[:, 0], positions[:, 1], tolerance=1, **run)
    yield lambda **run: umbilic.polyline_curvatures(positions, **run)


class Mine(Exception):
    pass


@pytest.mark.parametrize("kind", [Mine, KeyboardInterrupt, SystemExit, umbilic.Error, umbilic.IndexOutOfRange])
def test_what_progress_raises_ends_the_call_and_comes_out(lump, kind):
    raised = kind("stop", umbilic.Status.INDEX_OUT_OF_RANGE, 0) if issubclass(kind, umbilic.Error) else kind("stop")

    for call in calls(*lump):
        seen = []
        call(progress=seen.append, threads=1)
        for last in (0, max(seen)):

            def stop(fraction, last=last):
                if fraction >= last:
                    raise raised

            with pytest.raises(kind) as error:
                call(progress=stop, threads=1)
            assert error.value is raised
        call()  # and leaves nothing behind


def test_what_progress_raises_keeps_its_cause_and_nothing_else(ball):
    positions, faces = ball[0].copy(), ball[1]
    alive, cause = weakref.ref(positions), KeyError("why")

    def stop(fraction):
        raise Mine from cause

    gc.disable()
    try:
        with pytest.raises(Mine) as error:
            umbilic.curvatures(positions, faces, progress=stop)
        assert error.value.__cause__ is cause and error.value.__context__ is None
        del positions, error
        assert alive() is None  # at once
    finally:
        gc.enable()


def test_progress_may_call_the_library(ball):
    inner = []
    umbilic.curvatures(*ball, progress=lambda fraction: inner.append(umbilic.vertex_normals(*ball).normal))
    assert inner and numpy.array_equal(inner[0], inner[-1])


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
@pytest.mark.parametrize("progress", [None, lambda fraction: None])
def test_ctrl_c_ends_long_calls(progress):
    # A shell has its jobs in the background ignore it.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    positions, faces = umbilic.examples.sphere(7)
    mesh = umbilic.Topology(faces, len(positions))
    timer = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT))
    start = time.perf_counter()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        while time.perf_counter() - start < 30:
            umbilic.curvatures(positions, mesh, threads=1, progress=progress)
    timer.join()
    assert time.perf_counter() - start < 20
    assert umbilic.vertex_normals(positions, mesh).normal.any()


def test_closing_what_another_thread_is_at_work_with():
    positions, faces = umbilic.examples.sphere(5)
    expected = umbilic.curvatures(positions, faces).k1
    for _ in range(3):
        mesh = umbilic.Topology(faces, len(positions))
        with ThreadPoolExecutor(1) as pool:
            begun = threading.Event()
            call = pool.submit(
                lambda mesh=mesh, begun=begun: umbilic.curvatures(
                    positions, mesh, threads=1, progress=lambda fraction: begun.set()
                )
            )
            begun.wait()
            mesh.close()
            assert numpy.array_equal(call.result().k1, expected)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
def test_fork_after_use(lump):
    code = """
import multiprocessing, numpy, umbilic
positions, faces = umbilic.examples.sphere(5)
mesh = umbilic.Topology(faces, len(positions))
def work(index):
    assert numpy.array_equal(umbilic.curvatures(positions, mesh, threads=2).k1, expected)
    return float(umbilic.vertex_normals(positions, faces, threads=2).normal[index, 0])
expected = umbilic.curvatures(positions, mesh, threads=2).k1
with multiprocessing.get_context("fork").Pool(2) as pool:
    assert len(pool.map(work, range(4))) == 4
assert numpy.array_equal(umbilic.curvatures(positions, mesh).k1, expected)
print("done")
"""
    assert run(code) == "done\n"


def run(code):
    """What a process prints that must end well."""
    finished = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120)
    assert finished.returncode == 0, finished.stderr
    assert not finished.stderr
    return finished.stdout


def test_nothing_crashes():
    """Hostile arguments to everything, in a process of its own: exceptions or results, but always an end."""
    code = """
import itertools, numpy, umbilic
random = numpy.random.RandomState(3)
done = refused = 0
positions = [numpy.zeros((0, 3)), numpy.ones((4, 3)), random.rand(4, 3).astype("f4"), random.rand(4, 3) * 1e308,
             numpy.full((4, 3), numpy.nan), random.rand(4, 3)[::-1], random.rand(4, 2), random.rand(3), [], None,
             [[0, 0, 0]] * 4, "abcd", random.rand(4, 4)[:, 1:], numpy.zeros((4, 3), "S1"), object()]
faces = [[], [[0, 1, 2]], [[0, 1, 2, 3]], [[0, 0, 0]], [[0, 1, -1]], [[0, 1, 4]], [[0], [1, 2, 3]], None, [[0.5, 1, 2]],
         numpy.array([[0, 1, 2**63]], "u8"), numpy.array([[-2**63, 1, 2]]), numpy.zeros((0, 3), "u4"), [[]],
         umbilic.Polygons(numpy.array([0, 1, 2]), numpy.array([0, 2**62])), umbilic.Polygons([0, 1, 2], [3, 0]),
         umbilic.Polygons(numpy.array([0, 1, 2]), numpy.array([-1, 3])), [[0, 1, 2]] * 50, [list(range(4)) * 99], {}, 7]
lists = [None, [], [0], [3, 3, 3], [4], [-1], [2**32], numpy.array([0], "f8"), [[0]], [1, 2**70]]
for xyz, polygons in itertools.product(positions, faces):
    calls = [lambda: umbilic.face_normals(xyz, polygons), lambda: umbilic.corner_normals(xyz, polygons),
             lambda: umbilic.segment_features(xyz, polygons, edges=[[0, 9]]),
             lambda: umbilic.segment_regions(xyz, polygons), lambda: umbilic.segment_watershed(xyz, polygons),
             lambda: umbilic.Cut(xyz, polygons, groups=[1]).topology.stats(),
             lambda: umbilic.polyline_curvatures(xyz), lambda: umbilic.learn_model(xyz, polygons)]
    calls += [lambda v=v, w=w: umbilic.vertex_normals(xyz, polygons, vertices=v, weight=w)
              for v in lists for w in ("conformal", "jet", "adaptive-jet")]
    calls += [lambda m=m: umbilic.curvatures(xyz, polygons, method=m) for m in umbilic.METHODS]
    for call in calls:
        try:
            call()
            done += 1
        except (TypeError, ValueError, OverflowError, umbilic.Error):
            refused += 1
print(done > 1000, refused > 1000)
"""
    assert run(code) == "True True\n"


def test_ends_of_processes_are_quiet():
    """With handles, arrays and generators alive."""
    code = """
import umbilic, threading
positions, faces = umbilic.examples.sphere(4)
mesh = umbilic.Topology(faces, len(positions))
cut, parts = umbilic.Cut(positions, faces), umbilic.segment_features(positions, faces)
kept = mesh.ring_neighbours, cut.topology, parts.labels
threading.Thread(target=lambda: [umbilic.curvatures(positions, mesh) for _ in range(5)]).start()
"""
    assert run(code) == ""


@pytest.mark.parametrize("progress", ["None", "print_nothing"])
def test_daemon_threads_at_work_as_the_process_ends(progress):
    code = f"""
import threading, time, umbilic
positions, faces = umbilic.examples.sphere(5)
mesh = umbilic.Topology(faces, len(positions))
def print_nothing(fraction):
    pass
def work():
    while True:
        umbilic.curvatures(positions, mesh, threads=1, progress={progress})
for _ in range(3):
    threading.Thread(target=work, daemon=True).start()
time.sleep(0.3)
print("done")
"""
    assert run(code) == "done\n"
