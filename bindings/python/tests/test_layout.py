"""The structs, functions and constants of umbilic._native against the header, as a C compiler reads it."""

import ctypes
import re
import shutil
import subprocess
import sys

import pytest
from conftest import REPOSITORY

import umbilic
from umbilic import _native, names
from umbilic.errors import Status

HEADER = REPOSITORY / "include" / "umbilic.h"
NAMES = {"ErrorStruct": "umb_error"}
# Calls for a mesh of which nothing else is wanted: the same bits as those with a topology, which this package makes.
LEFT_OUT = {"umb_vertex_normals_from_faces", "umb_corner_normals_from_faces"}
CONSTANTS = {
    "UMB_NO_SEGMENT": umbilic.NO_SEGMENT,
    "UMB_NO_ELEMENT": _native.NO_ELEMENT,
    "UMB_ABI_VERSION": _native.ABI_VERSION,
    "UMB_OK": Status.OK,
    "UMB_SCALAR_F32": 0,
    "UMB_SCALAR_F64": 1,
    "UMB_INDEX_U32": 0,
    "UMB_INDEX_I32": 1,
    "UMB_INDEX_U64": 2,
}
CONSTANTS.update({f"UMB_ERROR_{each.name}": each for each in Status if each})
for prefix, kind in (
    ("UMB_VERTEX_", umbilic.VertexStatus),
    ("UMB_SECTION_STATUS_", umbilic.SectionStatus),
    ("UMB_POLYLINE_", umbilic.PolylineStatus),
    ("UMB_SHAPE_", umbilic.Shape),
):
    CONSTANTS.update({prefix + name: int(value) for name, value in kind.__members__.items()})
for prefix, listed in (
    ("UMB_WEIGHT_", names.WEIGHTS),
    ("UMB_CURVATURE_", names.METHODS),
    ("UMB_SECTION_", names.SECTIONS),
    ("UMB_SIMD_", names.SIMD_LEVELS),
    ("UMB_COORDINATES_", names.COORDINATES),
    ("UMB_AT_", names.LOCATIONS),
):
    CONSTANTS.update({prefix + name.upper().replace("-", "_"): number for number, name in enumerate(listed)})


def structs():
    for name, kind in vars(_native).items():
        if isinstance(kind, type) and issubclass(kind, ctypes.Structure) and kind is not ctypes.Structure:
            yield NAMES.get(name, "umb" + re.sub(r"([A-Z])", lambda match: "_" + match[1].lower(), name)), kind


@pytest.fixture(scope="module")
def header(tmp_path_factory):
    """What the compiler says: offsets and sizes by struct and field, and the values of constants."""
    compiler = shutil.which("cc") or pytest.fail("there is no C compiler")
    lines = []
    for name, kind in structs():
        lines.append(f'printf("{name} %zu 0\\n", sizeof({name}));')
        for field, _ in kind._fields_:
            place = f"offsetof({name}, {field}), sizeof((({name} *)0)->{field})"
            lines.append(f'printf("{name}.{field} %zu %zu\\n", {place});')
    lines += [f'printf("{name} %llu 0\\n", (unsigned long long){name});' for name in CONSTANTS]
    folder = tmp_path_factory.mktemp("layout")
    source = '#include <stdio.h>\n#include "umbilic.h"\nint main(void) {\n' + "\n".join(lines) + "\nreturn 0; }\n"
    (folder / "layout.c").write_text(source)
    subprocess.run([compiler, "-std=c99", f"-I{HEADER.parent}", "layout.c", "-o", "layout"], cwd=folder, check=True)
    printed = subprocess.run([folder / "layout"], check=True, capture_output=True, text=True).stdout
    return {name: (int(a), int(b)) for name, a, b in (line.split() for line in printed.splitlines())}


def test_structs_have_the_layout_of_the_header(header):
    for name, kind in structs():
        assert header[name] == (ctypes.sizeof(kind), 0), name
        for field, _ in kind._fields_:
            place = getattr(kind, field)
            assert header[f"{name}.{field}"] == (place.offset, place.size), f"{name}.{field}"


def test_every_struct_and_field_of_the_header_is_there():
    text = re.sub(r"/\*.*?\*/", "", HEADER.read_text(), flags=re.S)
    known = dict(structs())
    found = re.findall(r"typedef struct (\w+) \{(.*?)\} \1;", text, flags=re.S)
    assert {name for name, _ in found} == set(known)
    for name, body in found:
        fields = re.findall(r"(\w+)(?:\[\d+\])?;", body)
        assert fields == [field for field, _ in known[name]._fields_], name


def test_constants_are_those_of_the_header(header):
    for name, value in CONSTANTS.items():
        assert header[name][0] == value, name


def test_every_constant_of_the_header_is_there():
    named = set(re.findall(r"#define (UMB_[A-Z0-9_]+) +(?:U?INT|\d)", HEADER.read_text()))
    assert named - set(CONSTANTS) == {"UMB_VERSION_MAJOR", "UMB_VERSION_MINOR", "UMB_VERSION_PATCH"}


def test_functions_are_those_of_the_header():
    text = re.sub(r"/\*.*?\*/", "", HEADER.read_text(), flags=re.S)
    found = {}
    for name, arguments in re.findall(r"^\S[^\n;{}#]*?(umb_\w+)\(([^;]*?)\);", text, flags=re.S | re.M):
        if "typedef" not in name:
            found[name] = 0 if arguments.strip() == "void" else arguments.count(",") + 1
    found.pop("umb_progress", None)
    ours = {name: len(taken) + 1 for name, taken in _native._FALLIBLE.items()}
    ours |= {name: len(taken) for name, (_, taken) in _native._PLAIN.items()}
    assert set(found) - set(ours) == LEFT_OUT
    assert {name: found[name] for name in ours} == ours


@pytest.mark.skipif(sys.platform != "linux", reason="a library of another kind")
def test_a_library_of_another_interface_is_refused(tmp_path):
    (tmp_path / "other.c").write_text("unsigned umb_abi_version(void) { return 7; }\n")
    subprocess.run(["cc", "-shared", "-fPIC", "other.c", "-o", "libother.so"], cwd=tmp_path, check=True)
    for path, says in ((tmp_path / "libother.so", "not the library"), (tmp_path / "none.so", "cannot be loaded")):
        ran = subprocess.run(
            [sys.executable, "-c", "import umbilic"],
            env={"UMBILIC_LIBRARY": str(path), "PYTHONPATH": ":".join(sys.path)},
            capture_output=True,
            text=True,
        )
        assert ran.returncode == 1 and "ImportError" in ran.stderr and says in ran.stderr
