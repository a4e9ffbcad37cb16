"""The README's Python runs, block after block."""

import re
from pathlib import Path

import mypy.api
import pytest

README = Path(__file__).resolve().parents[1] / "README.md"


def blocks():
    found = re.findall(r"```python\n(.*?)```", README.read_text(), flags=re.S)
    assert len(found) == 7
    return found


def test_the_readmes_python_runs(capsys):
    for package in ("pymeshlab", "pyvista", "trimesh"):
        pytest.importorskip(package)
    names = {}
    for block in blocks():
        exec(compile(block, str(README), "exec"), names)
    printed = capsys.readouterr().out
    assert "Topology(2562 vertices, 5120 faces)" in printed and "INDEX_OUT_OF_RANGE 2" in printed
    assert names["curved"].vertex_custom_point_attribute_matrix("normal").shape == (2562, 3)
    assert names["split"].vertices.shape == (24, 3) and names["mesh"].n_points > 0


def test_the_readmes_python_has_types_that_fit(tmp_path):
    more = """
umbilic.vertex_normals(positions, [numpy.array([0, 1, 2]), numpy.array([0, 2, 3, 4])])
umbilic.vertex_normals(positions.tolist(), [(0, 1, 2), [0, 2, 3, 4]])
umbilic.Topology(cut.faces, cut.vertex_count)
"""
    (tmp_path / "user.py").write_text("\n".join([*blocks(), more]))
    options = ["--strict", "--config-file=", "--ignore-missing-imports", f"--cache-dir={tmp_path}"]
    printed, _, status = mypy.api.run([*options, str(tmp_path / "user.py")])
    assert status == 0, printed
