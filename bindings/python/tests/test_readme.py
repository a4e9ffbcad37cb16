"""The README's Python runs, block after block."""

import re
from pathlib import Path

import pytest

README = Path(__file__).resolve().parents[1] / "README.md"


def test_the_readmes_python_runs(capsys):
    blocks = re.findall(r"```python\n(.*?)```", README.read_text(), flags=re.S)
    assert len(blocks) == 7
    for package in ("pymeshlab", "pyvista", "trimesh"):
        pytest.importorskip(package)
    names = {}
    for block in blocks:
        exec(compile(block, str(README), "exec"), names)
    printed = capsys.readouterr().out
    assert "Topology(2562 vertices, 5120 faces)" in printed and "INDEX_OUT_OF_RANGE 2" in printed
    assert names["curved"].vertex_custom_point_attribute_matrix("normal").shape == (2562, 3)
    assert names["split"].vertices.shape == (24, 3) and names["mesh"].n_points > 0
