"""Normals of vertices, faces and corners, against known surfaces, libigl and trimesh."""

import igl
import numpy
import pytest
import trimesh

import umbilic
from umbilic import VertexStatus


def degrees(a, b):
    return numpy.degrees(2 * numpy.arcsin(numpy.clip(numpy.linalg.norm(a - b, axis=1) / 2, 0, 1)))


@pytest.mark.parametrize("weight", umbilic.WEIGHTS)
def test_every_weight_on_a_torus(torus, weight):
    for faces in (torus.quads, torus.triangles, torus.quads.tolist(), [*torus.quads[:9].tolist(), *torus.quads[9:]]):
        found = umbilic.vertex_normals(torus.positions, faces, weight=weight)
        assert degrees(found.normal, torus.normal).max() < 2
        assert not (found.status & ~numpy.uint8(VertexStatus.WIDENED)).any()


def test_jets_take_degree_and_rings(torus):
    def error(**options):
        found = umbilic.vertex_normals(torus.positions, torus.triangles, weight="jet", **options)
        return degrees(found.normal, torus.normal).mean()

    assert error(degree=4, rings=3) < error(degree=2) / 3
    assert error(degree=1) != error(degree=1, rings=2)


@pytest.mark.parametrize("weight", ["uniform", "angle", "area"])
def test_libigl_weighs_alike(lump, weight):
    positions, faces = lump
    kind = getattr(igl, f"PER_VERTEX_NORMALS_WEIGHTING_TYPE_{weight.upper()}")
    theirs = igl.per_vertex_normals(positions, faces, kind)
    assert numpy.abs(umbilic.vertex_normals(positions, faces, weight=weight).normal - theirs).max() < 1e-13


def test_trimesh_weighs_alike(lump):
    mesh = trimesh.Trimesh(*lump, process=False)
    found = umbilic.vertex_normals(*lump, weight="angle").normal
    assert numpy.abs(found - mesh.vertex_normals).max() < 1e-12
    uniform = trimesh.geometry.mean_vertex_normals(len(mesh.vertices), mesh.faces, mesh.face_normals)
    assert numpy.abs(umbilic.vertex_normals(*lump, weight="uniform").normal - uniform).max() < 1e-12


def test_sums_are_those_of_areas(lump):
    positions, faces = lump
    vectors = umbilic.face_normals(positions, faces, outputs=["area_vector"]).area_vector
    sums = numpy.zeros_like(positions)
    numpy.add.at(sums, faces, vectors[:, None])
    found = umbilic.vertex_normals(positions, faces, weight="area", outputs=["sum"]).sum
    # The unit of the weight is length²; its factor is not said.
    ratio = (found * sums).sum(1) / (sums * sums).sum(1)
    assert numpy.allclose(ratio, ratio[0]) and numpy.allclose(found, ratio[0] * sums)


def test_face_normals(lump, torus):
    positions, faces = lump
    mesh = trimesh.Trimesh(*lump, process=False)
    found = umbilic.face_normals(positions, faces, outputs=["normal", "area_vector", "status"])
    assert numpy.abs(found.normal - mesh.face_normals).max() < 1e-12
    assert numpy.allclose(numpy.linalg.norm(found.area_vector, axis=1), mesh.area_faces)
    assert umbilic.face_normals(torus.positions, torus.quads.tolist()).normal.shape == (len(torus.quads), 3)
    thin = umbilic.face_normals([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]])
    assert thin.status[0] == VertexStatus.DEGENERATE and not thin.normal.any()


def test_statuses_tell_what_is_wrong():
    positions = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 5, 5]], float)
    normals, status = umbilic.vertex_normals(positions, [[0, 1, 2]])
    assert VertexStatus(int(status[0])) == VertexStatus.BOUNDARY
    assert VertexStatus(int(status[3])) == VertexStatus.ISOLATED and not normals[3].any()


def test_corner_normals_split_at_creases():
    positions, faces = umbilic.examples.cube()
    flat = umbilic.face_normals(positions, faces).normal
    split = umbilic.corner_normals(positions, faces).corner.reshape(6, 4, 3)
    assert numpy.array_equal(split, numpy.repeat(flat[:, None], 4, 1))
    smooth = umbilic.corner_normals(positions, faces, angle=numpy.pi).corner
    assert numpy.array_equal(smooth, umbilic.vertex_normals(positions, faces).normal[faces.ravel()])
    assert numpy.array_equal(umbilic.corner_normals(positions, faces, angle=0).corner, split.reshape(-1, 3))
    tops = umbilic.Cut(positions, faces, groups=[1, 2, 1, 1, 1, 1])
    assert tops.vertex_count == 12
    marked = umbilic.Cut(positions, faces, edges=[[0, 1], [1, 3], [3, 2], [2, 0]])
    assert marked.vertex_count == 12 and marked.topology.stats().component_count == 2


def test_libigl_splits_corners_alike():
    mesh = trimesh.creation.cylinder(radius=1, height=2, sections=40)
    positions, faces = numpy.array(mesh.vertices), numpy.array(mesh.faces)
    theirs = igl.per_corner_normals(positions, faces, 30.0).reshape(-1, 3)
    ours = umbilic.corner_normals(positions, faces, angle=numpy.radians(30), weight="area").corner
    assert numpy.abs(ours - theirs).max() < 1e-12


def test_a_cut_has_positions_faces_and_normals_of_its_own(torus):
    positions, faces = umbilic.examples.cube()
    cut = umbilic.Cut(positions, faces)
    assert numpy.array_equal(cut.points(positions)[cut.faces], positions[faces])
    assert numpy.array_equal(cut.points(positions), positions[cut.origins])
    assert numpy.array_equal(numpy.diff(cut.starts), numpy.bincount(cut.origins))
    every = umbilic.corner_normals(positions, cut, outputs=("corner", "normal", "sum", "status"))
    assert numpy.array_equal(every.normal[cut.corners], every.corner)
    assert numpy.array_equal(umbilic.vertex_normals(cut.points(positions), cut.topology).normal, every.normal)
    ragged = umbilic.Cut(torus.positions, umbilic.Polygons.from_cells(numpy.insert(torus.quads, 0, 4, 1).ravel()))
    assert isinstance(ragged.faces, umbilic.Polygons) and len(ragged.faces.offsets) == len(torus.quads) + 1
    with pytest.raises(umbilic.Error) as error:
        umbilic.corner_normals(positions, cut, vertices=[0])
    assert error.value.status == umbilic.Status.NOT_APPLICABLE
    topology = cut.topology
    cut.close()
    assert topology.stats().component_count == 6  # it keeps the cut's memory
    with pytest.raises(ValueError, match="closed"):
        cut.topology
