"""Curvatures and sections, against known surfaces and libigl."""

import dataclasses

import igl
import numpy
import pytest
import trimesh

import umbilic
from umbilic.curvature import _OUTPUTS, _VECTORS


@pytest.mark.parametrize("method", umbilic.METHODS)
def test_every_method_on_a_torus(torus, method):
    found = umbilic.curvatures(torus.positions, torus.triangles, method=method)
    unit = numpy.sqrt((torus.k1**2 + torus.k2**2) / 2).mean()
    if method == "angle-defect":
        errors = [found.gaussian - torus.k1 * torus.k2]
    else:
        errors = [found.k1 - torus.k1, found.k2 - torus.k2]
    # Both are known not to converge, but where edges stand at even angles.
    allowed = 0.25 if method in ("taubin", "watanabe") else 0.06
    assert numpy.sqrt(numpy.mean(numpy.square(errors))) < allowed * unit
    assert found.status.dtype == numpy.uint8


def test_principal_directions_and_normals(torus):
    found = umbilic.curvatures(
        torus.positions, torus.quads, outputs=("k1", "k2", "direction1", "direction2", "normal", "mean", "gaussian")
    )
    assert numpy.abs(found.k1 - torus.k1).max() < 2e-3 and numpy.abs(found.k2 - torus.k2).max() < 2e-3
    assert (numpy.abs((found.direction2 * torus.around).sum(1)) > 0.9999).all()
    assert numpy.allclose(numpy.cross(found.normal, found.direction1), found.direction2)
    assert numpy.allclose(found.mean, (found.k1 + found.k2) / 2)
    assert numpy.allclose(found.gaussian, found.k1 * found.k2)


def test_every_output_comes_from_some_method(ball):
    positions, faces = ball
    missing = set(_OUTPUTS)
    for method in umbilic.METHODS:
        for name in _OUTPUTS:
            try:
                found = getattr(umbilic.curvatures(positions, faces, method=method, outputs=[name]), name)
            except umbilic.Error as error:
                assert error.status == umbilic.Status.NOT_APPLICABLE
                continue
            assert found.shape == ((len(positions), 3) if name in _VECTORS else (len(positions),))
            assert numpy.isfinite(found).all()
            missing.discard(name)
    assert not missing


def test_integrals_and_shapes(ball):
    positions, faces = ball
    found = umbilic.curvatures(positions, faces, method="meyer", outputs=_integrals())
    assert numpy.isclose(found.integrated_gaussian.sum(), 4 * numpy.pi)
    assert numpy.isclose(found.area.sum(), umbilic.segment_features(positions, faces).areas(positions).sum())
    assert numpy.allclose(found.mean_normal, found.mean[:, None] * positions, atol=2e-2)
    shape = umbilic.curvatures(positions, faces, outputs=("shape_index", "curvedness"))
    assert (shape.shape_index > 0.95).all() and numpy.allclose(shape.curvedness, 1, atol=1e-3)


def _integrals():
    return ("mean", "mean_normal", "area", "integrated_mean", "integrated_gaussian")


def test_angle_defects_are_those_of_libigl_and_trimesh(lump):
    positions, faces = lump
    found = umbilic.curvatures(positions, faces, method="angle-defect").integrated_gaussian
    assert numpy.abs(found - igl.gaussian_curvature(positions, faces)).max() < 1e-12
    assert numpy.abs(found - trimesh.Trimesh(positions, faces, process=False).vertex_defects).max() < 1e-7


def test_mean_curvature_normals_are_those_of_libigl(lump):
    positions, faces = lump
    found = umbilic.curvatures(positions, faces, method="meyer", outputs=("mean_normal", "area"))
    theirs = -(igl.cotmatrix(positions, faces) @ positions) / 2
    assert numpy.abs(found.mean_normal * found.area[:, None] - theirs).max() < 1e-10
    assert (
        numpy.abs(found.area - igl.massmatrix(positions, faces, igl.MASSMATRIX_TYPE_VORONOI).diagonal()).max() < 1e-12
    )


def test_principal_curvatures_are_near_those_of_libigl(torus):
    _, _, k1, k2, _ = igl.principal_curvature(torus.positions, torus.triangles, 2, True)
    jets = umbilic.curvatures(torus.positions, torus.triangles, method="jet", degree=2)
    assert numpy.sqrt(numpy.mean((jets.k1 - k1) ** 2)) < 0.03 * torus.k1.mean()
    assert numpy.sqrt(numpy.mean((jets.k2 - k2) ** 2)) < 0.03 * torus.k1.mean()


def test_options_reach_the_library(torus):
    def k1(**options):
        return umbilic.curvatures(torus.positions, torus.triangles, outputs=["k1"], **options).k1

    seen = [k1(method="least-squares")]
    for options in (
        {"section": "circle"},
        {"weight": "max"},
        {"weight": "jet"},
        {"weight": "jet", "normal_degree": 2},
        {"weight": "jet", "normal_rings": 3},
        {"normals": torus.normal},
    ):
        found = k1(method="least-squares", **options)
        assert numpy.allclose(found, seen[0], rtol=0.2), options
        assert not any(numpy.array_equal(found, other) for other in seen), options
        seen.append(found)
    assert not numpy.array_equal(k1(method="jet", degree=2), k1(method="jet", degree=2, rings=3))
    ball, rings = (k1(method="normal-cycle", **options) for options in ({"radius": 0.4}, {"rings": 2}))
    assert not numpy.array_equal(ball, rings) and numpy.allclose(ball, rings, rtol=0.2)
    wide = numpy.zeros((len(torus.normal), 5))
    wide[:, 1:4] = 3 * torus.normal
    given = k1(method="least-squares", normals=wide[:, 1:4])
    assert numpy.allclose(given, k1(method="least-squares", normals=torus.normal), rtol=1e-12)


def test_a_model_is_learned_changed_and_handed_in(lump):
    positions, faces = lump
    mesh = umbilic.Topology(faces, len(positions))
    model = umbilic.learn_model(positions, mesh)
    assert model.sample > 100 and 0 < model.noise < model.edge_length and len(model.sizes) == 4
    plain = umbilic.curvatures(positions, mesh).k1
    assert numpy.array_equal(plain, umbilic.curvatures(positions, mesh, model=model).k1)
    louder = dataclasses.replace(model, noise=3 * model.noise)
    assert not numpy.array_equal(plain, umbilic.curvatures(positions, mesh, model=louder).k1)
    some = umbilic.curvatures(positions, mesh, model=model, vertices=[5]).k1
    assert some[5] == plain[5] and not some[6]
    quiet = umbilic.vertex_normals(positions, mesh, weight="adaptive-jet", model=louder)
    assert not numpy.array_equal(quiet.normal, umbilic.vertex_normals(positions, mesh, weight="adaptive-jet").normal)
    with pytest.raises(umbilic.Error, match="noise"):
        umbilic.curvatures(positions, mesh, model=dataclasses.replace(model, noise=-1.0))
    with pytest.raises(TypeError, match="not an AdaptiveModel"):
        umbilic.curvatures(positions, mesh, model={"noise": 1})
    with pytest.raises(ValueError, match="3 numbers, not 4"):
        umbilic.curvatures(positions, mesh, model=dataclasses.replace(model, sizes=(1, 1, 1)))


def test_sections_along_edges_and_directions(torus):
    mesh = umbilic.Topology(torus.quads, len(torus.positions))
    found = umbilic.edge_sections(
        torus.positions, mesh, section="circle", normals=torus.normal, outputs=("curvature", "status", "normal")
    )
    vertex = numpy.repeat(numpy.arange(mesh.vertex_count), numpy.diff(mesh.ring_offsets))
    edge = torus.positions[mesh.ring_neighbours] - torus.positions[vertex]
    assert numpy.allclose(found.normal, torus.normal)
    expected = -2 * (torus.normal[vertex] * edge).sum(1) / (edge * edge).sum(1)
    assert numpy.allclose(found.curvature, expected)
    fitted = umbilic.edge_sections(torus.positions, mesh, weight="jet", outputs=["normal"]).normal
    for options in ({"normal_degree": 2}, {"normal_rings": 3}, {"weight": "max"}):
        options = {"weight": "jet", "outputs": ["normal"]} | options
        assert not numpy.array_equal(umbilic.edge_sections(torus.positions, mesh, **options).normal, fitted)
    along = umbilic.direction_sections(torus.positions, mesh, torus.around, normals=torus.normal)
    assert numpy.abs(along.curvature - torus.k2).max() < 0.05 and not along.status.any()
    axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]
    out = {"curvature": numpy.empty((mesh.vertex_count, 4))}
    shared = umbilic.direction_sections(torus.positions, mesh, axes, shared=True, out=out)
    assert shared.curvature.shape == shared.status.shape == (mesh.vertex_count, 4)
    assert numpy.shares_memory(shared.curvature, out["curvature"])
    each = umbilic.direction_sections(torus.positions, mesh, numpy.tile(axes[3], (mesh.vertex_count, 1)))
    assert numpy.array_equal(shared.curvature[:, 3], each.curvature)
    with pytest.raises(ValueError, match="contiguous"):
        umbilic.direction_sections(
            torus.positions, mesh, axes, shared=True, out={"curvature": numpy.empty((mesh.vertex_count, 8))[:, ::2]}
        )
    with pytest.raises(umbilic.Error) as error:
        umbilic.direction_sections(torus.positions, mesh, axes)
    assert error.value.status == umbilic.Status.SIZE
    with pytest.raises(TypeError, match="takes no faces"):
        umbilic.edge_sections(torus.positions, torus.quads)
