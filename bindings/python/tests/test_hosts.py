"""Meshes of trimesh, pyvista, meshio and PyMeshLab: nothing copied that need not be, everything written back."""

import types

import meshio
import numpy
import pytest
import pyvista
import trimesh

import umbilic
from umbilic.faces import FaceArrays


def place(array):
    return array.__array_interface__["data"][0]


# trimesh


def test_trimesh(lump):
    mesh = trimesh.Trimesh(*lump, process=False)
    positions, triangles = place(mesh.vertices), place(mesh.faces)
    assert FaceArrays(umbilic.trimesh.faces(mesh)).view().indices == triangles
    normals = umbilic.trimesh.vertex_normals(mesh)
    assert mesh.vertex_normals is normals.normal
    found = umbilic.trimesh.curvatures(mesh, umbilic.trimesh.topology(mesh))
    assert list(mesh.vertex_attributes) == ["k1", "k2", "direction1", "direction2", "status"]
    assert mesh.vertex_attributes["k1"] is found.k1
    assert numpy.array_equal(found.k1, umbilic.curvatures(*lump).k1)
    parts = umbilic.trimesh.segment(mesh, "watershed", depth=0)
    assert numpy.array_equal(mesh.face_attributes["segment"], parts.labels) and len(parts) > 1
    assert (place(mesh.vertices), place(mesh.faces)) == (positions, triangles)


# pyvista


@pytest.fixture
def prism():
    """Hexagons, quads, and a line and a vertex beside them."""
    angles = numpy.pi / 3 * numpy.arange(6)
    ring = numpy.stack([numpy.cos(angles), numpy.sin(angles), 0 * angles], 1)
    points = numpy.concatenate([ring, ring + [0, 0, 1]]).astype("f4")
    sides = [[i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6] for i in range(6)]
    faces = [list(range(5, -1, -1)), list(range(6, 12)), *sides]
    cells = [number for face in faces for number in (len(face), *face)]
    return pyvista.PolyData(points, faces=cells, lines=[2, 0, 1], verts=[1, 4]), points, faces


def test_pyvista_polygons_stay_polygons(prism):
    mesh, points, faces = prism
    cells, memory = mesh.faces.copy(), place(mesh.points)
    found = umbilic.pyvista.vertex_normals(mesh)
    assert numpy.array_equal(found.normal, umbilic.vertex_normals(points, faces).normal)
    assert mesh.point_data.active_normals_name == "Normals"
    assert numpy.shares_memory(mesh.point_data["Normals"], found.normal) and found.normal.dtype == numpy.float32
    curved = umbilic.pyvista.curvatures(mesh, umbilic.pyvista.topology(mesh), outputs=("k1", "direction1"))
    assert numpy.shares_memory(mesh.point_data["k1"], curved.k1)
    assert numpy.shares_memory(mesh.point_data["direction1"], curved.direction1)
    parts = umbilic.pyvista.segment(mesh)
    assert len(parts) == 8
    assert list(mesh.cell_data["segment"]) == [umbilic.NO_SEGMENT] * 2 + list(range(8))
    assert numpy.array_equal(mesh.faces, cells) and place(mesh.points) == memory


def test_pyvistas_memory_is_read_in_place(prism):
    for mesh, size in ((pyvista.Sphere(), 3), (pyvista.Plane(), 4), (prism[0], 0)):
        faces = FaceArrays(umbilic.pyvista.faces(mesh))
        assert faces.arity == size
        again = FaceArrays(umbilic.pyvista.faces(mesh))
        assert numpy.shares_memory(faces.indices, again.indices)
        view = umbilic._arrays.points(umbilic._arrays.vectors(mesh.points, "points"))
        assert view.data == place(mesh.points)


def test_segments_are_safe_from_what_vtk_does_with_its_memory(prism):
    for mesh in (pyvista.Cube().clean(), prism[0]):
        parts = umbilic.pyvista.segment(mesh)
        labels, areas = parts.labels.copy(), parts.areas(mesh.points)
        mesh.cell_data["segment"][:] = 10**9  # pyvista's arrays can be written, whatever they were made of
        assert numpy.array_equal(parts.labels, labels)
        cells = mesh.GetPolys()
        for _ in range(10**4):  # until they move
            cells.InsertNextCell(3, [0, 1, 2])
        assert numpy.array_equal(parts.areas(mesh.points), areas)


def test_what_pyvista_has_beside_surfaces():
    with pytest.raises(TypeError, match="extract_surface"):
        umbilic.pyvista.vertex_normals(pyvista.ImageData(dimensions=(3, 3, 3)))
    strips = pyvista.Sphere().strip()
    with pytest.raises(ValueError, match="triangulate"):
        umbilic.pyvista.curvatures(strips)
    points = pyvista.PolyData(numpy.eye(3))  # vertices alone
    assert not umbilic.pyvista.vertex_normals(points).normal.any()
    assert (umbilic.pyvista.segment(points).count, list(points.cell_data["segment"])) == (0, [umbilic.NO_SEGMENT] * 3)


# meshio


def test_meshio(lump, tmp_path):
    positions, faces = lump
    mesh = meshio.Mesh(positions, [("triangle", faces)])
    assert FaceArrays(umbilic.meshio.faces(mesh)).view().indices == place(mesh.cells[0].data)
    normals = umbilic.meshio.vertex_normals(mesh)
    assert mesh.point_data["Normals"] is normals.normal
    found = umbilic.meshio.curvatures(mesh, umbilic.meshio.topology(mesh))
    assert mesh.point_data["k1"] is found.k1
    umbilic.meshio.segment(mesh, "features", angle=1.0)
    mesh.write(tmp_path / "mesh.vtu")
    again = meshio.read(tmp_path / "mesh.vtu")
    assert numpy.array_equal(again.point_data["k1"], found.k1)
    assert numpy.array_equal(again.cell_data["segment"][0], mesh.cell_data["segment"][0])


def test_meshio_blocks():
    positions, quads = umbilic.examples.cube()
    cells = [
        ("line", [[0, 1]]),
        ("quad", quads[:4]),
        ("vertex", [[0]]),
        ("triangle", [[0, 2, 6], [0, 6, 4]]),
        ("quad", quads[5:]),
    ]
    mesh = meshio.Mesh(positions, cells)
    assert isinstance(umbilic.meshio.faces(mesh), umbilic.Polygons)
    parts = umbilic.meshio.segment(mesh)
    none = umbilic.NO_SEGMENT
    assert [list(labels) for labels in mesh.cell_data["segment"]] == [[none], [0, 1, 2, 3], [none], [4, 4], [5]]
    assert len(parts) == 6
    same = umbilic.vertex_normals(positions, quads, weight="angle").normal
    assert numpy.allclose(umbilic.meshio.vertex_normals(mesh, weight="angle").normal, same)
    # Small types cannot count the corners, and no type holds all of two others.
    positions, faces = umbilic.examples.sphere(3)
    for kinds in (("u2", "u2"), ("i4", "i4"), ("u8", "i8")):
        blocks = [numpy.tile(faces, (20, 1)).astype(kinds[0]), [], numpy.array([[0, 1, 2, 3]], kinds[1])]
        mesh = meshio.Mesh(positions, list(zip(("triangle", "triangle", "quad"), blocks)))
        assert umbilic.meshio.topology(mesh).face_count == 20 * len(faces) + 1
        umbilic.meshio.segment(mesh)
        assert [len(labels) for labels in mesh.cell_data["segment"]] == [20 * len(faces), 0, 1]
    one = meshio.Mesh(positions, [("quad", []), ("triangle", faces)])
    assert FaceArrays(umbilic.meshio.faces(one)).view().indices == place(one.cells[1].data)
    assert umbilic.meshio.topology(meshio.Mesh(positions, [("quad", [])])).face_count == 0
    with pytest.raises(ValueError, match="'tetra' are no faces"):
        umbilic.meshio.faces(meshio.Mesh(positions, [("tetra", [[0, 1, 2, 4]])]))
    with pytest.raises(ValueError, match="no faces"):
        umbilic.meshio.faces(meshio.Mesh(positions, [("line", [[0, 1]])]))


# What is none of these.


@pytest.mark.parametrize("host", [umbilic.trimesh, umbilic.pyvista, umbilic.meshio])
def test_other_objects_are_refused(host):
    for other in (None, 3, types.SimpleNamespace()):
        for call in (host.vertex_normals, host.curvatures, host.segment, host.topology):
            with pytest.raises(TypeError, match="is no "):
                call(other)
    with pytest.raises(ValueError, match="by is 'colour', none of features, watershed, regions"):
        host.segment(None, "colour")


# PyMeshLab


def test_pymeshlab_keeps_what_is_given_back():
    pymeshlab = pytest.importorskip("pymeshlab")
    positions, quads = umbilic.examples.cube()
    mesh = pymeshlab.Mesh(vertex_matrix=positions, face_list_of_indices=quads.tolist())
    faces = mesh.polygonal_face_list()
    normals, _ = umbilic.vertex_normals(mesh.vertex_matrix(), faces)
    mean = umbilic.curvatures(mesh.vertex_matrix(), faces, outputs=["mean"]).mean
    again = pymeshlab.Mesh(
        mesh.vertex_matrix(), face_list_of_indices=faces, v_normals_matrix=normals, v_scalar_array=mean
    )
    again.add_vertex_custom_point_attribute(normals, "normal")
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.add_mesh(again)
    kept = meshes.current_mesh()
    # The polygons are whole, though they may start elsewhere.
    assert [sorted(face) for face in kept.polygonal_face_list()] == numpy.sort(quads, 1).tolist()
    assert numpy.array_equal(kept.vertex_custom_point_attribute_matrix("normal"), normals)
    assert numpy.allclose(kept.vertex_scalar_array(), mean, rtol=1e-6)  # in single precision
    # Why the README has normals go another way: of meshes with faces PyMeshLab makes its own.
    assert numpy.abs(kept.vertex_normal_matrix() - normals).max() > 0.1
