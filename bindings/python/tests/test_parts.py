"""Segmentations, shape classes, lists of what is affected, and polylines."""

import numpy
import pytest
import trimesh

import umbilic
from umbilic import PolylineStatus, Shape


def cylinder():
    mesh = trimesh.creation.cylinder(radius=1, height=2, sections=64).subdivide_to_size(0.3)
    mesh.merge_vertices()
    return numpy.array(mesh.vertices), numpy.array(mesh.faces)


def test_features_are_the_faces_of_solids():
    positions, faces = cylinder()
    with umbilic.segment_features(positions, faces) as found:
        assert (len(found), found.count, found.face_count) == (3, 3, len(faces))
        assert numpy.allclose(sorted(found.areas(positions)), [3.1365, 3.1365, 12.56], atol=0.01)
        heights = found.means(positions, positions[:, 2])
        assert numpy.allclose(sorted(heights), [-1, 0, 1], atol=1e-9)
        assert numpy.allclose(found.means(positions, positions[faces].mean(1)[:, 2], at="faces"), heights)
        rims = numpy.abs(positions[found.boundary_edges][:, :, 2])
        assert len(rims) >= 2 * 64 and numpy.allclose(rims, 1)
        labels = found.labels
    assert labels.max() == 2 and found.closed and repr(found).endswith("closed)")
    with pytest.raises(ValueError, match="closed"):
        found.labels
    with pytest.raises(umbilic.Error):
        umbilic.segment_features(positions, faces).areas(positions[:-1])


def test_creases_may_be_marked():
    positions, faces = umbilic.examples.cube()
    assert len(umbilic.segment_features(positions, faces, angle=3)) == 1
    assert len(umbilic.segment_features(positions, faces, groups=[1, 1, 1, 1, 1, 2])) == 2
    ring = [[0, 1], [1, 3], [3, 2], [2, 0]]
    assert len(umbilic.segment_features(positions, faces, edges=ring)) == 2
    for edges in ([0, 1], [[0, 1, 2]], [[[0, 1]]], [[]], numpy.empty((10**6, 0), int)):
        with pytest.raises(ValueError, match="not \\(n, 2\\)"):
            umbilic.segment_features(positions, faces, edges=edges)
    with pytest.raises(ValueError, match="2 groups, but 6 faces"):
        umbilic.segment_features(positions, faces, groups=[1, 2])
    with pytest.raises(umbilic.IndexOutOfRange):
        umbilic.segment_features(positions, faces, edges=[[0, 8]])


def test_basins_of_a_height(torus):
    height = numpy.cos(4 * numpy.arctan2(torus.positions[:, 1], torus.positions[:, 0]))
    found = umbilic.segment_watershed(torus.positions, torus.quads, height=height, depth=0.5)
    assert len(found) == 4
    at_faces = height[torus.quads].mean(1)
    again = umbilic.segment_watershed(torus.positions, torus.quads, height=at_faces, at="faces", depth=0.5)
    assert numpy.array_equal(found.labels, again.labels)
    options = umbilic.CurvatureOptions("least-squares", normals=torus.normal)
    assert len(umbilic.segment_watershed(torus.positions, torus.quads, curvature=options)) >= 1
    with pytest.raises(umbilic.Error) as error:
        umbilic.segment_watershed(torus.positions, torus.triangles, height=height, at="faces")
    assert error.value.status == umbilic.Status.SIZE
    height[7] = numpy.nan
    with pytest.raises(umbilic.Error) as error:
        umbilic.segment_watershed(torus.positions, torus.quads, height=height)
    assert (error.value.status, error.value.element) == (umbilic.Status.NON_FINITE, 7)


def test_regions_of_one_shape():
    positions, faces = cylinder()
    found = umbilic.segment_regions(positions, faces, angle=numpy.pi)
    assert len(found) == 3
    classes = numpy.full(len(positions), Shape.FLAT, numpy.uint8)
    assert len(umbilic.segment_regions(positions, faces, classes=classes, angle=numpy.pi)) == 1
    assert len(umbilic.segment_regions(positions, faces, angle=numpy.pi, smallest_share=0.9)) == 1
    assert len(umbilic.segment_regions(positions, faces, angle=numpy.pi, smallest_faces=10**9)) == 1
    with pytest.raises(umbilic.Error):
        umbilic.segment_regions(positions, faces, smallest_share=2)
    with pytest.raises(umbilic.Error):
        umbilic.segment_regions(positions, faces, classes=classes + 100)
    with pytest.raises(TypeError, match="classes"):
        umbilic.segment_regions(positions, faces, classes=classes.astype(int))


def test_shapes(torus):
    k1, k2, status = umbilic.curvatures(torus.positions, torus.quads, outputs=("k1", "k2", "status"))
    classes = umbilic.shape_classes(k1, k2, positions=torus.positions, status=status)
    outside = torus.k2 > 0.05
    assert (classes[outside] == Shape.PEAK).all() and (classes[torus.k2 < -0.05] == Shape.SADDLE_RIDGE).all()
    assert (umbilic.shape_classes(k1, k2, tolerance=100.0) == Shape.FLAT).all()
    assert (umbilic.shape_classes([0, 1, -1], [0, 0, 0], tolerance=0) == [Shape.FLAT, Shape.RIDGE, Shape.VALLEY]).all()
    lost = numpy.full(len(k1), umbilic.VertexStatus.DEGENERATE, numpy.uint8)
    assert (umbilic.shape_classes(k1, k2, tolerance=1.0, status=lost) == Shape.UNDEFINED).all()
    with pytest.raises(TypeError, match="or a tolerance"):
        umbilic.shape_classes(k1, k2)
    with pytest.raises(umbilic.Error):
        umbilic.shape_classes(k1, k2[1:], tolerance=1)


@pytest.mark.parametrize("weight", ["conformal", "jet", "adaptive-jet"])
def test_lists_of_what_is_affected_are_enough(lump, weight):
    positions, faces = lump
    mesh = umbilic.Topology(faces, len(positions))
    model = umbilic.learn_model(positions, mesh) if weight == "adaptive-jet" else None
    normals, status = umbilic.vertex_normals(positions, mesh, weight=weight, model=model)
    positions[10] += 0.02
    vertices = umbilic.affected_normals(mesh, [10], weight=weight, model=model, status=status)
    assert vertices[0] == 10 and len(numpy.unique(vertices)) == len(vertices) < 200
    umbilic.vertex_normals(positions, mesh, weight=weight, model=model, vertices=vertices, out={"normal": normals})
    assert numpy.array_equal(normals, umbilic.vertex_normals(positions, mesh, weight=weight, model=model).normal)


def test_affected_curvatures(lump):
    positions, faces = lump
    mesh = umbilic.Topology(faces, len(positions))
    for options in (
        umbilic.CurvatureOptions("meyer"),
        umbilic.CurvatureOptions("jet", degree=4),
        umbilic.CurvatureOptions(model=umbilic.learn_model(positions, mesh)),
    ):
        named = {"method": options.method, "degree": options.degree, "model": options.model}
        k1, status = umbilic.curvatures(positions, mesh, outputs=("k1", "status"), **named)
        positions[10] += 0.02
        vertices = umbilic.affected_curvatures(mesh, [10], options, status=status)
        umbilic.curvatures(positions, mesh, outputs=(), out={"k1": k1}, vertices=vertices, **named)
        assert numpy.array_equal(k1, umbilic.curvatures(positions, mesh, outputs=["k1"], **named).k1)
    with pytest.raises(umbilic.Error, match="model"):
        umbilic.affected_curvatures(mesh, [0])
    with pytest.raises(umbilic.IndexOutOfRange):
        umbilic.affected_normals(mesh, [len(positions)])
    assert len(umbilic.affected_normals(mesh, [])) == 0


def test_polylines():
    angles = 2 * numpy.pi * numpy.arange(30) / 30
    circle = 2 * numpy.stack([numpy.cos(angles), numpy.sin(angles)], 1)
    for points in (circle, circle.astype("f4"), numpy.c_[circle, 0 * angles], numpy.c_[angles, circle][:, 1:]):
        found = umbilic.polyline_curvatures(points, closed=True)
        assert numpy.allclose(found.circle, 0.5) and not found.status.any() and found.circle.dtype == points.dtype
        assert numpy.allclose(found.symmetric_parabola, found.parabola, rtol=1e-4)
    assert (umbilic.polyline_curvatures(circle[::-1], closed=True).circle < 0).all()
    opened = umbilic.polyline_curvatures(circle, outputs=("length_parabola", "status"))
    assert opened.status[0] == PolylineStatus.END and opened.length_parabola[0] == 0 < opened.length_parabola[1]
    assert len(umbilic.polyline_curvatures(numpy.empty((0, 2))).circle) == 0
    with pytest.raises(ValueError, match=r"\(n, 2\) or \(n, 3\)"):
        umbilic.polyline_curvatures(numpy.zeros((4, 4)))
    circle[3, 1] = numpy.inf
    with pytest.raises(umbilic.Error) as error:
        umbilic.polyline_curvatures(circle)
    assert (error.value.status, error.value.element) == (umbilic.Status.NON_FINITE, 3)
