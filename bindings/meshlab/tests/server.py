# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin in an unmodified meshlabserver: what its PLY files have against what the library computes of the same positions and faces.

    server.py PROGRAM MESHES SERVER DIRECTORY

PROGRAM is the command line, MESHES a directory of meshes, SERVER a meshlabserver that finds the plugin, DIRECTORY for what is written. Needs a display.
"""

import pathlib
import re
import subprocess
import sys

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/peers"))
import bindings  # noqa: E402, F401
import umbilic  # noqa: E402

EXAMPLES = ROOT / "bindings/meshlab/examples"
FILTERS = ("Umbilic: vertex normals", "Umbilic: curvature", "Umbilic: segmentation")
QUALITIES = ("mean", "gaussian", "k2", "k1", "shape_index", "curvedness")  # the list "quality"

program, meshes, server, directory = sys.argv[1:]
meshes, directory = pathlib.Path(meshes), pathlib.Path(directory)
checks = 0


def check(condition, *what):
    global checks
    checks += 1
    if not condition:
        sys.exit("meshlabserver: " + " ".join(map(str, what)))


# ---- meshlabserver ----


def script(example, **values):
    """A copy of an example with other values; a value that is a pair has a type as well."""
    text = (EXAMPLES / f"{example}.mlx").read_text()
    for name, value in values.items():
        kind, value = value if isinstance(value, tuple) else (None, value)
        line = re.search(f'<Param name="{name}" type="(.*)" value=.*/>', text)
        text = text.replace(line[0], f'<Param name="{name}" type="{kind or line[1]}" value="{value}"/>')
    path = directory / "script.mlx"
    path.write_text(text)
    return path


def run(*arguments):
    """The exit status and all that is said."""
    done = subprocess.run([server, *map(str, arguments)], capture_output=True, text=True, timeout=300)
    return done.returncode, done.stdout + done.stderr


def apply(mesh, path, *mask):
    """The mesh that comes of a script."""
    out = directory / "out.ply"
    out.unlink(missing_ok=True)
    status, said = run("-i", mesh, "-o", out, "-m", *mask, "-s", path)
    check(status == 0 and out.exists(), mesh, said)
    check("ms in the library" in said, "no times in", said)
    return read_ply(out)


TYPES = {"float": "<f4", "double": "<f8", "uchar": "u1", "int": "<i4", "uint": "<u4", "char": "i1"}


def read_ply(path):
    """Vertices and triangles of a binary PLY file as arrays with a field for each property."""
    data = path.read_bytes()
    header, body = data.split(b"end_header\n", 1)
    elements = []
    for words in map(str.split, header.decode().splitlines()):
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property" and words[1] == "list":
            elements[-1][2].extend([("count", TYPES[words[2]]), (words[4], TYPES[words[3]], 3)])
        elif words[0] == "property":
            elements[-1][2].append((words[2], TYPES[words[1]]))
    found = {}
    for name, count, fields in elements:
        found[name] = numpy.frombuffer(body, fields, count)
        body = body[found[name].nbytes :]
    check("count" not in found["face"].dtype.names or (found["face"]["count"] == 3).all(), path, "has polygons")
    return found


def columns(array, *names):
    return numpy.stack([array[name] for name in names], 1)


def positions_of(found):
    return columns(found["vertex"], "x", "y", "z")


def triangles_of(found):
    return found["face"]["vertex_indices"].astype(numpy.uint32)


def same_bits(found, expected):
    return numpy.array_equal(found.view(numpy.uint32), expected.astype(numpy.float32).view(numpy.uint32))


# ---- meshes ----


def read_off(path):
    """Positions and faces."""
    words = (word for line in path.read_text().splitlines() for word in line.split("#")[0].split())
    check(next(words) == "OFF", path)
    vertices, faces, _ = (int(next(words)) for _ in range(3))
    positions = [[float(next(words)) for _ in range(3)] for _ in range(vertices)]
    return numpy.array(positions), [[int(next(words)) for _ in range(int(next(words)))] for _ in range(faces)]


def torus(around=24, across=16):
    """Hexagons of two quads, quads, and triangles."""
    u, v = numpy.meshgrid(numpy.arange(around) * 2 * numpy.pi / around, numpy.arange(across) * 2 * numpy.pi / across, indexing="ij")
    r = 0.4 + 0.05 * numpy.sin(5 * u) * numpy.cos(3 * v) + 0.02 * numpy.sin(u + 0.5) * numpy.cos(v + 1)
    positions = numpy.stack([(1 + r * numpy.cos(v)) * numpy.cos(u), (1 + r * numpy.cos(v)) * numpy.sin(u), r * numpy.sin(v)], 2)

    def at(i, j):
        return i % around * across + j % across

    faces = []
    for i in range(0, around, 2):
        for j in range(across):
            ring = [at(i, j), at(i + 1, j), at(i + 2, j), at(i + 2, j + 1), at(i + 1, j + 1), at(i, j + 1)]
            if j % 3 == 0:
                faces.append(ring)
            elif j % 3 == 1:
                faces += [[ring[0], ring[1], ring[4], ring[5]], [ring[1], ring[2], ring[3], ring[4]]]
            else:
                faces += [[ring[0], ring[1], ring[4]], [ring[0], ring[4], ring[5]], [ring[1], ring[2], ring[3], ring[4]]]
    return positions.reshape(-1, 3).astype(numpy.float32), faces


def write(path, positions, faces):
    rows = [" ".join(map(repr, map(float, position))) for position in positions]
    loops = [" ".join(map(str, [len(face), *face])) for face in faces]
    if path.suffix == ".off":
        lines = ["OFF", f"{len(rows)} {len(loops)} 0", *rows, *loops]
    else:
        lines = ["ply", "format ascii 1.0", f"element vertex {len(rows)}", *(f"property float {axis}" for axis in "xyz")]
        lines += [f"element face {len(loops)}", "property list uchar int vertex_indices", "end_header", *rows, *loops]
    path.write_text("\n".join(lines) + "\n")
    return path


# ---- checks ----


def filters_are_listed():
    dump = directory / "filters.txt"
    dump.unlink(missing_ok=True)
    status, said = run("-d", dump)
    check(status == 0, said)
    for name in FILTERS:
        check(re.search(r"\\section f\d+ " + name, dump.read_text()), name, "is not listed")


def triangles(name):
    """The same bits, since MeshLab writes the single precision that it has."""
    mesh = meshes / name
    for weight in ("conformal", "angle", "max", "tilted-sections"):
        found = apply(mesh, script("normals", weight=umbilic.WEIGHTS.index(weight)), "vn")
        positions, faces = positions_of(found), triangles_of(found)
        expected = umbilic.vertex_normals(positions, faces, weight=weight).normal
        check(same_bits(columns(found["vertex"], "nx", "ny", "nz"), expected), name, "normals by", weight)
    methods = ("adaptive-jet", 0), ("adaptive-jet", 4), ("jet", 1), ("jet", 3), ("quadric", 2), ("goldfeather", 5), ("taubin", 3), ("meyer", 1)
    for method, quality in methods:
        found = apply(mesh, script("curvature", method=umbilic.METHODS.index(method), quality=quality), "vq", "vc")
        # As the filter asks: what is asked for besides can change the last bit.
        outputs = dict.fromkeys([QUALITIES[quality], "k1", "k2"])
        expected, *_ = umbilic.curvatures(positions, faces, method=method, outputs=[*outputs])
        check(same_bits(found["vertex"]["quality"], expected), name, QUALITIES[quality], "by", method)
        if method in ("taubin", "meyer"):
            continue  # which the command line, all in double precision, has a little different
        subject = QUALITIES[quality].replace("_", "-")
        colors = command_line("curvature", "vertex", "--method", method, "--color", subject)
        check(numpy.abs(columns(found["vertex"], "red", "green", "blue").astype(int) - colors).max() <= 1, name, "colors of", subject, "by", method)
    for by, way in enumerate(("features", "watershed", "regions")):
        found = apply(mesh, script("segmentation", by=by), "fq", "fc")
        colors, labels = command_line("segment", "face", "--by", way, label=True)
        check(numpy.array_equal(found["face"]["quality"], labels), name, "labels by", way)
        check(numpy.array_equal(columns(found["face"], "red", "green", "blue"), colors), name, "colors by", way)


def command_line(command, element, *options, label=False):
    """Colors, and labels, that the command line has for the mesh that meshlabserver wrote last."""
    out = directory / "command_line.ply"
    subprocess.run([program, command, directory / "out.ply", "-o", out, *options], check=True, capture_output=True)
    found = read_ply(out)[element]
    colors = columns(found, "red", "green", "blue").astype(int)
    return (colors, found["label"]) if label else colors


def polygons(path, positions, faces):
    """MeshLab starts its polygons at another corner, which may cost the last bit."""
    topology = umbilic.Topology(faces, len(positions))
    for weight in ("conformal", "area", "centroid", "adaptive-jet"):
        found = apply(path, script("normals", weight=umbilic.WEIGHTS.index(weight)), "vn")
        check(same_bits(positions_of(found), positions), path, "positions")
        expected = umbilic.vertex_normals(positions, topology, weight=weight).normal
        difference = numpy.abs(columns(found["vertex"], "nx", "ny", "nz") - expected).max()
        check(difference <= 2**-23, path, "normals by", weight, difference)
    for method in ("adaptive-jet", "meyer", "rusinkiewicz", "angle-defect"):
        quality = 1 if method == "angle-defect" else 0
        found = apply(path, script("curvature", method=umbilic.METHODS.index(method), quality=quality), "vq")
        (expected,) = umbilic.curvatures(positions, topology, method=method, outputs=[QUALITIES[quality]])
        difference = (numpy.abs(found["vertex"]["quality"] - expected) / (1 + numpy.abs(expected))).max()
        check(difference <= 2**-21, path, QUALITIES[quality], "by", method, difference)
    said = run("-i", path, "-s", EXAMPLES / "normals.mlx")[1]
    check(f" {len(faces)} faces of " in said, path, len(faces), "faces, but", said)


def labels_of_polygons(path, faces):
    """MeshLab cuts a polygon into triangles that follow each other: each has the polygon's label."""
    for by, options in enumerate([("features", "--crease-angle", "10"), ("watershed", "--depth", "0.125"), ("regions", "--crease-angle", "10")]):
        found = apply(path, script("segmentation", by=by, creaseAngle=10, depth=0.125), "fq")
        out = directory / "labels.ply"
        subprocess.run([program, "segment", path, "-o", out, "--ascii", "--by", *options], check=True, capture_output=True)
        rows = [line.split() for line in out.read_text().splitlines()[-len(faces) :]]
        expected = [int(row[-1]) for row, face in zip(rows, faces) for _ in face[2:]]
        check(len(set(expected)) > 1 and numpy.array_equal(found["face"]["quality"], expected), path, "labels by", options[0])


def deleted_elements():
    """Filters before may leave gaps, which files do not have."""
    positions, faces = torus()
    apart = numpy.concatenate([[[9, 9, 9], [9, 8, 9], [8, 9, 9]], positions]).astype(numpy.float32)
    path = write(directory / "apart.ply", apart, [[0, 1, 2]] + [[v + 3 for v in face] for face in faces])
    example = (EXAMPLES / "normals.mlx").read_text()
    before = '<filter name="Remove Isolated pieces (wrt Face Num.)"><Param name="MinComponentSize" type="RichInt" value="25"/>'
    before += '<Param name="removeUnref" type="RichBool" value="true"/></filter>'
    two = directory / "two.mlx"
    two.write_text(example.replace("<FilterScript>\n", "<FilterScript>\n" + before, 1))
    found = apply(path, two, "vn")
    check(len(found["vertex"]) == len(positions), "the small piece is still there")
    expected = umbilic.vertex_normals(positions, faces).normal
    places = {tuple(position): normal for position, normal in zip(positions.tolist(), expected)}
    for position, normal in zip(positions_of(found).tolist(), columns(found["vertex"], "nx", "ny", "nz")):
        check(numpy.abs(places[tuple(position)] - normal).max() <= 2**-23, "normal after deleting at", position)


def mistakes():
    positions, faces = torus()
    good = write(directory / "good.ply", positions, faces)
    broken = positions.copy()
    broken[17, 1] = numpy.nan
    nowhere = write(directory / "nowhere.ply", broken, faces)
    cloud = write(directory / "cloud.ply", positions, [])
    one = write(directory / "one.ply", positions, [[0, 0, 0]])
    for mesh, example, values, words in [
        (good, "normals", {"weight": 99}, "options.weight is 99, which is no known constant"),
        (good, "normals", {"weight": -1}, 'the parameter "weight" is -1, expected 0 or more'),
        (good, "normals", {"weight": ("RichString", "angle")}, 'the parameter "weight" is of type String'),
        (good, "curvature", {"method": umbilic.METHODS.index("angle-defect")}, "outputs.mean is nothing that the method has"),
        (good, "curvature", {"method": umbilic.METHODS.index("taubin"), "rings": 3}, "options.rings"),
        *((nowhere, example, {}, "the position of vertex 17 is not finite") for example in ("normals", "curvature", "segmentation")),
        *((cloud, example, {}, "the mesh has no faces") for example in ("normals", "curvature", "segmentation")),
    ]:
        status, said = run("-i", mesh, "-s", script(example, **values))
        check(status == 255 and words in said and "Problem with filter" in said, mesh, f'"{words}", but {status}:', said)
    status, said = run("-s", EXAMPLES / "normals.mlx")
    check(status == 255 and "there is no mesh" in said, status, said)
    for example in ("normals", "curvature", "segmentation"):
        status, said = run("-i", one, "-s", EXAMPLES / f"{example}.mlx")
        check(status in (0, 255), one, status, said)


filters_are_listed()
for name in ("bunny00.off", "fandisk.off", "mesh_with_border.off", "cube-ouvert.off"):
    triangles(name)
# Not OBJ: Debian's meshlabserver ends itself at many such files, whatever plugins it has.
for suffix in (".ply", ".off"):
    path = write((directory / "torus").with_suffix(suffix), *torus())
    polygons(path, *torus())
    labels_of_polygons(path, torus()[1])
for name in ("mpi.off", "double-torus-example.off"):
    positions, faces = read_off(meshes / name)
    polygons(meshes / name, positions.astype(numpy.float32), faces)
deleted_elements()
mistakes()
print(f"meshlabserver: {checks} checks")
