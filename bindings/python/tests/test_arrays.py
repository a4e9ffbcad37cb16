"""Arrays go in and out where they are, whatever lies between their rows; others are copied or refused."""

import tracemalloc

import numpy
import pytest

import umbilic
from umbilic import _arrays, _native
from umbilic.faces import FaceArrays


def views_of(values, dtype):
    """The same rows in layouts that the library can read in place."""
    plain = numpy.ascontiguousarray(values, dtype)
    yield "packed", plain
    wide = numpy.full((len(values), 7), numpy.nan, dtype)
    wide[:, 2:5] = values
    yield "columns", wide[:, 2:5]
    record = numpy.zeros(len(values), [("id", dtype), ("xyz", dtype, 3), ("uv", dtype, 2)])
    record["xyz"] = values
    yield "field", record["xyz"]
    double = numpy.full((2 * len(values), 3), numpy.nan, dtype)
    double[::2] = values
    yield "every second", double[::2]
    frozen = plain.copy()
    frozen.flags.writeable = False
    yield "read-only", frozen


def copies_of(values, dtype):
    """The same rows in layouts that it cannot."""
    plain = numpy.ascontiguousarray(values, dtype)
    yield "columns first", numpy.asfortranarray(plain)
    yield "backwards", plain[::-1].copy()[::-1]
    yield "swapped", plain.astype(plain.dtype.newbyteorder())
    raw = numpy.zeros(plain.nbytes + 1, numpy.uint8)[1:]
    raw[:] = plain.view(numpy.uint8).ravel()
    yield "unaligned", raw.view(dtype).reshape(plain.shape)
    record = numpy.zeros(len(values), numpy.dtype([("c", "u1"), ("xyz", dtype, 3)]))  # strides of 13 or 25 bytes
    record["xyz"] = values
    yield "odd stride", record["xyz"]


@pytest.mark.parametrize("dtype", [numpy.float32, numpy.float64])
def test_any_row_stride_is_read_in_place(lump, dtype):
    positions, faces = lump
    expected = umbilic.vertex_normals(positions.astype(dtype), faces).normal
    for name, view in views_of(positions, dtype):
        taken = _arrays.vectors(view, "positions")
        assert taken.ctypes.data == view.ctypes.data and numpy.shares_memory(taken, view), name
        assert _arrays.points(taken).stride == view.strides[0], name
        found = umbilic.vertex_normals(view, faces).normal
        assert found.dtype == dtype and numpy.array_equal(found, expected), name


@pytest.mark.parametrize("dtype", [numpy.float32, numpy.float64])
def test_other_layouts_are_copied(lump, dtype):
    positions, faces = lump
    expected = umbilic.vertex_normals(positions.astype(dtype), faces).normal
    for name, view in copies_of(positions, dtype):
        assert not numpy.shares_memory(_arrays.vectors(view, "positions"), view), name
        found = umbilic.vertex_normals(view, faces).normal
        assert found.dtype == dtype and numpy.array_equal(found, expected), name
    contiguous = numpy.zeros(25, "u1")[1:].view("f8").reshape(1, 3)
    assert not numpy.shares_memory(_arrays.vectors(contiguous, "positions"), contiguous)
    overlapping = numpy.lib.stride_tricks.sliding_window_view(numpy.arange(9.0), 3)
    assert not numpy.shares_memory(_arrays.vectors(overlapping, "positions"), overlapping)
    empty = numpy.zeros(0, [("c", "u1"), ("xyz", dtype, 3)])["xyz"]
    assert umbilic.vertex_normals(empty, []).normal.shape == (0, 3)
    same = numpy.broadcast_to(numpy.ones(3), (5, 3))
    assert _arrays.vectors(same, "positions").strides == (24, 8)


@pytest.mark.parametrize("values", [numpy.arange(6).reshape(2, 3), [[0, 1, 2], [3, 4, 5]], numpy.ones((2, 3), "f2")])
def test_other_numbers_become_float64(values):
    assert _arrays.vectors(values, "positions").dtype == numpy.float64


@pytest.mark.parametrize("dtype", [numpy.uint32, numpy.int32, numpy.uint64, numpy.int64])
def test_indices_are_read_in_place(ball, dtype):
    positions, faces = ball
    faces = faces.astype(dtype)
    assert FaceArrays(faces).view().indices == faces.ctypes.data
    flat, offsets = faces.reshape(-1), numpy.arange(0, faces.size + 1, 3).astype(dtype)
    view = FaceArrays(umbilic.Polygons(flat, offsets)).view()
    assert (view.indices, view.offsets) == (flat.ctypes.data, offsets.ctypes.data)
    expected = umbilic.vertex_normals(*ball).normal
    assert numpy.array_equal(umbilic.vertex_normals(positions, faces).normal, expected)
    assert numpy.array_equal(umbilic.vertex_normals(positions, umbilic.Polygons(flat, offsets)).normal, expected)


def test_nothing_large_is_allocated_beside_what_is_asked_for():
    positions, faces = umbilic.examples.sphere(6)
    out = {"normal": numpy.empty_like(positions), "status": numpy.empty(len(positions), numpy.uint8)}
    more = {name: numpy.empty(len(positions)) for name in ("k1", "k2")} | {"direction1": numpy.empty_like(positions)}
    mesh = umbilic.Topology(faces, len(positions))
    tracemalloc.start()
    umbilic.Topology(faces, len(positions))
    umbilic.vertex_normals(positions, mesh, out=out)
    umbilic.curvatures(positions, mesh, outputs=(), out=more)
    mesh.ring_neighbours, mesh.flags
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 20_000 < positions.nbytes


def test_results_are_written_where_the_caller_wants_them(lump):
    positions, faces = lump
    expected = umbilic.vertex_normals(positions, faces, outputs=("normal", "sum", "status"))
    vertex = numpy.zeros(len(positions), [("xyz", "f8", 3), ("normal", "f8", 3), ("bits", "u1"), ("_", "u1", 7)])
    vertex["xyz"] = positions
    found = umbilic.vertex_normals(
        vertex["xyz"], faces, outputs=(), out={"normal": vertex["normal"], "status": vertex["bits"]}
    )
    assert numpy.array_equal(vertex["xyz"], positions) and not vertex["_"].any()
    assert numpy.array_equal(vertex["normal"], expected.normal)
    assert numpy.array_equal(vertex["bits"], expected.status)
    assert numpy.shares_memory(found.normal, vertex)
    double = umbilic.vertex_normals(positions.astype("f4"), faces, out={"normal": numpy.empty_like(positions)})
    assert double.normal.dtype == numpy.float64 and numpy.allclose(double.normal, expected.normal, atol=1e-5)


def test_of_a_list_the_rest_is_zero_or_left_alone(lump):
    positions, faces = lump
    every = umbilic.vertex_normals(positions, faces).normal
    rest = numpy.setdiff1d(numpy.arange(len(positions)), [3, 5])
    for listed in ([3, 5, 3], numpy.array([3, 5], numpy.uint32), numpy.array([5, 3], numpy.int8)):
        found = umbilic.vertex_normals(positions, faces, vertices=listed).normal
        assert numpy.array_equal(found[[3, 5]], every[[3, 5]]) and not found[rest].any()
    kept = numpy.full_like(positions, 7)
    umbilic.vertex_normals(positions, faces, vertices=[3, 5], out={"normal": kept})
    assert numpy.array_equal(kept[[3, 5]], every[[3, 5]]) and (kept[rest] == 7).all()
    assert not umbilic.vertex_normals(positions, faces, vertices=[]).normal.any()


def test_results_unpack_in_order_and_tell_what_is_missing(ball):
    found = umbilic.curvatures(*ball, outputs=["gaussian", "k1"])
    gaussian, k1 = found
    assert gaussian is found.gaussian and k1 is found.k1 and list(vars(found)) == ["gaussian", "k1"]
    assert repr(found) == "Curvatures(gaussian=float64[642], k1=float64[642])"
    with pytest.raises(AttributeError, match="'mean' was not computed, only gaussian, k1"):
        found.mean
    with pytest.raises(AttributeError, match="cannot be changed"):
        found.k1 = k1


def bad_outputs(positions):
    count = len(positions)
    yield numpy.empty((count, 3), "i4"), TypeError
    yield numpy.empty((count - 1, 3)), ValueError
    yield numpy.empty(count), ValueError
    yield numpy.empty((count, 3), order="F"), ValueError
    yield numpy.empty((count, 3))[::-1], ValueError
    yield numpy.empty((count, 3)).astype(">f8"), TypeError
    yield positions, ValueError
    yield positions.tolist(), TypeError
    frozen = numpy.empty((count, 3))
    frozen.flags.writeable = False
    yield frozen, ValueError
    yield numpy.broadcast_to(numpy.empty(3), (count, 3)), ValueError


def test_outputs_that_do_not_fit_are_refused(lump):
    positions, faces = lump
    before = positions.copy()
    for array, kind in bad_outputs(positions):
        with pytest.raises(kind, match="normal"):
            umbilic.vertex_normals(positions, faces, out={"normal": array})
    with pytest.raises(TypeError, match="status"):
        umbilic.vertex_normals(positions, faces, out={"status": numpy.empty(len(positions), "i1")})
    both = numpy.empty_like(positions)
    with pytest.raises(ValueError, match="two outputs|overlaps"):
        umbilic.vertex_normals(positions, faces, out={"normal": both, "sum": both})
    with pytest.raises(ValueError, match="overlaps"):
        umbilic.vertex_normals(positions, faces, out={"normal": both, "sum": both[:]})
    for wrong in ({"outputs": ["curl"]}, {"out": {"curl": both}}):
        with pytest.raises(ValueError, match="no output 'curl', only normal, sum, status"):
            umbilic.vertex_normals(positions, faces, **wrong)
    assert numpy.array_equal(positions, before)


def test_arrays_of_the_librarys_memory_keep_it(ball):
    positions, faces = ball
    mesh = umbilic.Topology(faces, len(positions))
    neighbours, flags, fan = mesh.ring_neighbours, mesh.flags, mesh.fans(0)[0].neighbours
    copies = neighbours.copy(), flags.copy(), fan.copy()
    mesh.close()
    del mesh
    for _ in range(20):  # something else for the memory, were it free
        umbilic.Topology(faces[::-1], len(positions))
    assert all(numpy.array_equal(a, b) for a, b in zip((neighbours, flags, fan), copies))
    with pytest.raises(ValueError, match="read-only"):
        neighbours[0] = 1


def test_handles_are_freed(ball, monkeypatch):
    freed = []
    destroy = _native.library.umb_topology_destroy
    monkeypatch.setattr(_native.library, "umb_topology_destroy", lambda handle: (freed.append(1), destroy(handle)))
    with umbilic.Topology(ball[1], len(ball[0])):
        pass
    assert len(freed) == 1
    umbilic.vertex_normals(*ball)
    assert len(freed) == 2
    mesh = umbilic.Topology(ball[1], len(ball[0]))
    ring = mesh.ring(0)
    del mesh
    assert len(freed) == 2
    del ring
    assert len(freed) == 3
