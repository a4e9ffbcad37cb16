"""Whatever is wrong comes out as an exception, with the library's message and the offending element."""

import pickle

import numpy
import pytest

import umbilic
from umbilic import Error, IndexOutOfRange, InvalidArgument, Polygons, Status, Topology


def wrong_indices():
    """Types of faces, and indices that can be said in them and are none of four vertices."""
    for dtype in ("i1", "i2", "u2", "i4", "u4", "i8", "u8", ">i8"):
        limits = numpy.iinfo(dtype)
        yield from ((dtype, bad) for bad in (-1, -(2**31), 4, 2**31 - 1, -(2**63)) if limits.min <= bad <= limits.max)
    yield from ((kind, bad) for kind in ("object", "list") for bad in (-1, 4))


@pytest.mark.parametrize(("dtype", "bad"), list(wrong_indices()))
def test_indices_out_of_range(dtype, bad):
    faces = [[0, 1, 2], [1, 2, bad]]
    if dtype == "object":
        faces = numpy.array(faces, object)
    elif dtype != "list":
        faces = numpy.array(faces, dtype)
    with pytest.raises(IndexOutOfRange, match=rf"faces\.indices\[5\] is {bad}, but there are 4 vertices") as error:
        Topology(faces, 4)
    assert (error.value.status, error.value.element) == (Status.INDEX_OUT_OF_RANGE, 5)
    assert isinstance(error.value, (InvalidArgument, Error, ValueError, IndexError))
    for call in (umbilic.vertex_normals, umbilic.face_normals, umbilic.Cut, umbilic.segment_features):
        with pytest.raises(IndexOutOfRange, match=rf"is {bad}, but there are 4 vertices"):
            call(numpy.eye(4, 3), faces)


@pytest.mark.parametrize("dtype", ["i4", "u4", "i8", "u8"])
def test_offsets_that_do_not_run_upwards(dtype):
    for offsets in ([0, 4, 3, 6], [1, 3, 6], [0, 3, 7], [0, 3, 5], [3]):
        polygons = Polygons(numpy.array([0, 1, 2, 0, 2, 3], dtype), numpy.array(offsets, dtype))
        with pytest.raises(InvalidArgument) as error:
            Topology(polygons, 4)
        assert error.value.status in (Status.OFFSETS, Status.SIZE)
    if dtype[0] == "i":
        with pytest.raises(InvalidArgument):
            Topology(Polygons(numpy.array([0, 1, 2], dtype), numpy.array([0, -3, 3], dtype)), 4)
    for offsets in ([], [[0, 3]]):
        with pytest.raises(ValueError, match="offsets are empty|not \\(n,\\)"):
            Topology(Polygons(numpy.array([0, 1, 2], dtype), numpy.array(offsets, dtype)), 4)


@pytest.mark.parametrize("value", [numpy.nan, numpy.inf, -numpy.inf])
@pytest.mark.parametrize("dtype", ["f4", "f8"])
def test_positions_that_are_not_finite(ball, value, dtype):
    positions, faces = ball[0].astype(dtype), ball[1]
    positions[7, 1] = value
    for call in (
        umbilic.vertex_normals,
        umbilic.curvatures,
        umbilic.face_normals,
        umbilic.learn_model,
        umbilic.corner_normals,
        umbilic.segment_features,
        umbilic.segment_regions,
    ):
        with pytest.raises(InvalidArgument) as error:
            call(positions, faces)
        assert (error.value.status, error.value.element) == (Status.NON_FINITE, 7)
    # What no listed vertex needs is not looked at.
    far = numpy.setdiff1d(numpy.arange(len(positions)), umbilic.affected_normals(Topology(faces, len(positions)), [7]))
    assert numpy.isfinite(umbilic.vertex_normals(positions, faces, vertices=far).normal).all()


def wrong_arguments(positions, faces):
    vertex_normals, curvatures = umbilic.vertex_normals, umbilic.curvatures
    mesh = Topology(faces, len(positions))
    yield ValueError, "weight is 'angel', none of conformal", lambda: vertex_normals(positions, faces, weight="angel")
    yield ValueError, "weight is 3, none of", lambda: vertex_normals(positions, faces, weight=3)
    yield ValueError, "weight is None, none of", lambda: curvatures(positions, faces, weight=None)
    yield ValueError, "method is \\['jet'\\], none of", lambda: curvatures(positions, faces, method=["jet"])
    yield ValueError, "section is 'arc', none of", lambda: curvatures(positions, faces, section="arc")
    yield ValueError, "simd is 'mmx', none of", lambda: vertex_normals(positions, faces, simd="mmx")
    yield ValueError, "threads is -1, not", lambda: vertex_normals(positions, faces, threads=-1)
    yield ValueError, "rings is 4294967296", lambda: vertex_normals(positions, faces, rings=2**32)
    yield TypeError, "integer", lambda: vertex_normals(positions, faces, threads=1.5)
    yield TypeError, "integer", lambda: curvatures(positions, faces, degree="3")
    yield TypeError, "real number|float", lambda: curvatures(positions, faces, radius="wide")
    yield TypeError, "not callable", lambda: vertex_normals(positions, faces, progress=3)
    yield ValueError, "shape \\(642, 2\\), not \\(n, 3\\)", lambda: vertex_normals(positions[:, :2], faces)
    yield ValueError, "shape \\(1926,\\), not", lambda: vertex_normals(positions.ravel(), faces)
    yield TypeError, "type complex128", lambda: vertex_normals(positions.astype(complex), faces)
    yield TypeError, "type <U", lambda: vertex_normals(positions.astype(str), faces)
    yield TypeError, "type object", lambda: vertex_normals(positions.astype(object), faces)
    yield TypeError, "type bool", lambda: vertex_normals(positions > 0, faces)
    yield TypeError, "faces have elements of type float64", lambda: vertex_normals(faces, positions)
    yield TypeError, "faces have elements of type bool", lambda: vertex_normals(positions, faces > 3)
    yield ValueError, "faces have the shape \\(3840,\\)", lambda: vertex_normals(positions, faces.ravel())
    yield ValueError, "no corners", lambda: vertex_normals(positions, faces[:, :0])
    yield TypeError, "Topology does not stand for faces", lambda: umbilic.segment_features(positions, mesh)
    yield TypeError, "Cut does not stand for faces", lambda: vertex_normals(positions, umbilic.Cut(positions, faces))
    yield TypeError, "topology is a ndarray, not a Topology", lambda: umbilic.affected_normals(faces, [0])
    for wrong in ("meyer", {"method": "meyer"}):
        says = f"{type(wrong).__name__}, not CurvatureOptions"
        yield TypeError, says, lambda: umbilic.affected_curvatures(mesh, [0], wrong)
        yield TypeError, says, lambda: umbilic.segment_regions(positions, faces, curvature=wrong)
        yield TypeError, says, lambda: umbilic.segment_watershed(positions, faces, curvature=wrong)
    yield TypeError, "", lambda: vertex_normals(positions, None)
    yield TypeError, "", lambda: vertex_normals(positions, 3)
    yield (TypeError, ValueError), "", lambda: vertex_normals(positions, "faces")
    yield (TypeError, ValueError), "", lambda: vertex_normals(positions, [[0, 1, [2]]])
    yield TypeError, "vertices has elements of type bool", lambda: vertex_normals(positions, faces, vertices=[True])
    yield TypeError, "vertices has elements of type float64", lambda: vertex_normals(positions, faces, vertices=[1.0])
    yield ValueError, "vertices has the shape", lambda: vertex_normals(positions, faces, vertices=[[1, 2]])
    yield IndexError, "element 1 is -3, no index", lambda: vertex_normals(positions, faces, vertices=[1, -3])
    yield IndexError, "element 0 is 4294967296", lambda: vertex_normals(positions, faces, vertices=[2**32])
    yield IndexOutOfRange, "642", lambda: vertex_normals(positions, faces, vertices=[0, 642])
    yield InvalidArgument, "", lambda: vertex_normals(positions[1:], mesh)
    yield InvalidArgument, "", lambda: vertex_normals(positions, faces, weight="jet", degree=5)
    yield InvalidArgument, "", lambda: vertex_normals(positions, faces, weight="jet", rings=9)
    yield InvalidArgument, "", lambda: curvatures(positions, faces, method="meyer", outputs=["direction1"])
    yield InvalidArgument, "", lambda: curvatures(positions, faces, method="meyer", rings=3)
    yield InvalidArgument, "", lambda: curvatures(positions, faces, method="normal-cycle", radius=-1)
    yield InvalidArgument, "", lambda: curvatures(positions, faces, method="normal-cycle", radius=float("nan"))
    yield InvalidArgument, "", lambda: curvatures(positions, faces, method="meyer", normals=positions[1:])
    yield ValueError, "normals has the shape", lambda: curvatures(positions, faces, normals=positions[:, 0])
    yield InvalidArgument, "", lambda: umbilic.Cut(positions, faces, angle=-1)
    yield InvalidArgument, "", lambda: umbilic.Cut(positions, faces, angle=float("nan"))
    yield (
        TypeError,
        "angle, edges and groups go without",
        lambda: umbilic.corner_normals(positions, umbilic.Cut(positions, faces), angle=1),
    )
    yield InvalidArgument, "", lambda: umbilic.affected_normals(mesh, [0], status=numpy.zeros(3, "u1"))
    yield ValueError, "vertex is -1", lambda: mesh.valence(-1)
    yield IndexError, "", lambda: mesh.valence(642)
    yield IndexError, "", lambda: mesh.ring(642)
    yield IndexError, "", lambda: mesh.fans(10**12)
    yield TypeError, "", lambda: mesh.valence(1.0)
    yield InvalidArgument, "", lambda: Topology(faces, 2**40)
    yield ValueError, "vertex_count is -1", lambda: Topology(faces, -1)
    yield (InvalidArgument, umbilic.OutOfMemory), "", lambda: Topology([], 2**63)


def test_mistakes_are_refused(ball):
    for kind, says, call in wrong_arguments(*ball):
        with pytest.raises(kind, match=says or None) as error:
            call()
        if isinstance(error.value, Error):
            assert 0 < error.value.status < 100 and str(error.value)


def test_errors_can_be_pickled():
    with pytest.raises(Error) as error:
        Topology([[0, 1, 9]], 3)
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        again = pickle.loads(pickle.dumps(error.value, protocol))
        assert type(again) is IndexOutOfRange and str(again) == str(error.value)
        assert (again.status, again.element) == (Status.INDEX_OUT_OF_RANGE, 2)


def test_statuses_have_errors_of_their_own():
    from umbilic.errors import from_native

    assert type(from_native("", 100, None)) is umbilic.OutOfMemory and issubclass(umbilic.OutOfMemory, MemoryError)
    assert type(from_native("", 900, None)) is Error and from_native("", 900, None).status is Status.INTERNAL
    later = pickle.loads(pickle.dumps(from_native("later", 14, None)))
    assert (later.status, later.status.name) == (14, "STATUS_14") and type(later) is InvalidArgument
    with pytest.raises(ValueError, match="'OK' is not a valid Status"):
        Status("OK")
    assert from_native("", 900, None).element is None


def test_handles_cannot_be_pickled_or_copied(ball):
    import copy

    mesh = Topology(ball[1], len(ball[0]))
    with pytest.raises(ValueError, match="cannot be pickled"):
        pickle.dumps(mesh)
    with pytest.raises(ValueError, match="cannot be pickled"):
        copy.deepcopy(mesh)
    same = copy.copy(mesh)
    mesh.close()
    assert same.stats().vertex_count == 642
