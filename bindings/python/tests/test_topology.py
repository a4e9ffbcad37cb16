"""Topologies: faces in every form, counts, rings and fans."""

import dataclasses

import numpy
import pytest

import umbilic
from umbilic import Polygons, Topology, VertexStatus


def same(a, b):
    return numpy.array_equal(a.ring_offsets, b.ring_offsets) and numpy.array_equal(a.ring_neighbours, b.ring_neighbours)


def test_faces_in_every_form(torus):
    count = len(torus.positions)
    expected = Topology(torus.quads, count)
    flat, offsets = torus.quads.reshape(-1), numpy.arange(0, torus.quads.size + 1, 4)
    forms = [torus.quads.astype(kind) for kind in ("u4", "i4", "u8", "i8", ">i4", ">u8", "u2", "i2")]
    forms += [torus.quads.tolist(), list(torus.quads), tuple(map(tuple, torus.quads))]
    forms += [numpy.asfortranarray(torus.quads), numpy.repeat(torus.quads, 2, 0)[::2], torus.quads[::-1][::-1]]
    forms += [Polygons(flat, offsets), Polygons(flat.astype("u4"), offsets), Polygons(flat.astype("u8"), offsets)]
    forms += [Polygons(flat.tolist(), offsets.tolist())]
    forms += [Polygons.from_cells(numpy.insert(torus.quads, 0, 4, axis=1).ravel())]

    class Frame:
        """A table of data, which runs over its columns."""

        def __array__(self, dtype=None, copy=None):
            return torus.quads

        def __iter__(self):
            return iter(torus.quads.T)

    forms.append(Frame())
    objects = numpy.empty(len(torus.quads), object)
    objects[:] = torus.quads.tolist()
    forms.append(objects)
    for faces in forms:
        assert same(Topology(faces, count), expected), faces


def test_polygons_of_any_size():
    pyramid = [[3, 2, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    for faces in (
        pyramid,
        [numpy.array(face) for face in pyramid],
        Polygons.from_cells([each for face in pyramid for each in (len(face), *face)]),
    ):
        mesh = Topology(faces, 5)
        assert [mesh.valence(vertex) for vertex in range(5)] == [3, 3, 3, 3, 4]
        assert mesh.face_count == 5 and mesh.stats().euler_characteristic == 2
    assert sorted(mesh.ring(4)) == [0, 1, 2, 3]


def test_meshes_without_faces_or_vertices():
    for faces in (
        [],
        numpy.empty((0, 3), int),
        numpy.empty((0, 4), "u4"),
        Polygons(numpy.empty(0, int), numpy.array([0])),
    ):
        mesh = Topology(faces, 2)
        assert mesh.vertex_count == 2 and mesh.stats().isolated_vertices == 2 and not len(mesh.ring_neighbours)
        assert (mesh.flags == VertexStatus.ISOLATED).all() and mesh.fans(1) == [] and not len(mesh.ring(1))
    empty = Topology([], 0)
    assert empty.stats().vertex_count == 0 and not len(empty.flags) and list(empty.ring_offsets) == [0]


def test_fans_flags_and_stats():
    bow_tie = Topology([[0, 1, 2], [0, 3, 4]], 6)
    assert bow_tie.fan_count(0) == 2 and bow_tie.valence(0) == 4
    first, second = bow_tie.fans(0)
    assert list(first.neighbours) == [1, 2] and list(second.neighbours) == [3, 4]
    assert not first.closed and first.corner_count == 1
    assert VertexStatus(int(bow_tie.flags[0])) == VertexStatus.BOUNDARY | VertexStatus.NON_MANIFOLD
    stats = bow_tie.stats()
    assert (stats.face_count, stats.edge_count, stats.boundary_edges, stats.isolated_vertices) == (2, 6, 6, 1)
    assert stats.non_manifold_vertices == 1 and stats.component_count == 1 and stats.max_valence == 4
    assert all(isinstance(value, int) for value in dataclasses.astuple(stats))
    folded = Topology([[0, 1, 2], [0, 1, 2], [0, 1, 1]], 3).stats()
    assert (folded.duplicate_faces, folded.winding_edges, folded.degenerate_faces, folded.ignored_faces) == (1, 3, 1, 1)
    closed = Topology(umbilic.examples.sphere(0)[1], 12).fans(0)
    assert len(closed) == 1 and closed[0].closed and len(closed[0].neighbours) == closed[0].corner_count == 5


def test_closing(ball):
    positions, faces = ball
    with Topology(faces, len(positions)) as mesh:
        umbilic.vertex_normals(positions, mesh)
        assert not mesh.closed and repr(mesh) == "Topology(642 vertices, 1280 faces)"
    mesh.close()
    assert mesh.closed and repr(mesh) == "Topology(642 vertices, 1280 faces, closed)"
    for use in (
        mesh.stats,
        lambda: mesh.flags,
        lambda: mesh.ring_offsets,
        lambda: mesh.ring_neighbours,
        lambda: mesh.ring(0),
        lambda: mesh.fans(0),
        lambda: mesh.valence(0),
        mesh.__enter__,
        lambda: umbilic.vertex_normals(positions, mesh),
        lambda: umbilic.curvatures(positions, mesh),
        lambda: umbilic.edge_sections(positions, mesh),
        lambda: umbilic.direction_sections(positions, mesh, positions),
        lambda: umbilic.learn_model(positions, mesh),
        lambda: umbilic.affected_normals(mesh, [0]),
    ):
        with pytest.raises(ValueError, match="the topology is closed"):
            use()


def test_cells_that_are_none():
    for cells, kind in (
        ([3, 0, 1], ValueError),
        ([-1, 0], ValueError),
        ([[3, 0, 1, 2]], TypeError),
        ([3.0], TypeError),
    ):
        with pytest.raises(kind):
            Polygons.from_cells(cells)
    assert len(Polygons.from_cells(numpy.empty(0, int)).offsets) == 1


@pytest.mark.parametrize("dtype", ["i1", "u1", "i2", "u2", "i4", "u8"])
def test_cells_of_small_types(dtype):
    _, faces = umbilic.examples.sphere(1)
    polygons = Polygons.from_cells(numpy.insert(faces, 0, 3, axis=1).ravel().astype(dtype))
    assert list(polygons.offsets) == list(range(0, 241, 3)) and polygons.offsets.dtype.kind in "iu"
    assert same(Topology(polygons, 42), Topology(faces, 42))
