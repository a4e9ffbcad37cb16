#!/usr/bin/env python3
"""Builds and runs the programs of bindings/, and holds them against a C program and against mistakes.

    python3 tests/ffi/test.py LIBRARY MESHES [LANGUAGE…]           every test; meshes are those of tests/peers/meshes.txt
    python3 tests/ffi/test.py LIBRARY --time MESH [LANGUAGE…]      times: host, quantity, copies, ms of the library, ms of the host

Run it at the root of the repository. What it builds goes to target/ffi.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BINDINGS = ROOT / "bindings"
CHECKS = ROOT / "tests/ffi/check"
BUILT = ROOT / "target/ffi"
JNA = "/usr/share/java/jna.jar"
STRUCTS = (
    "error faces topology_options points output status_output run normal_options normal_outputs curvature_options curvature_outputs"
).split()
TIMEOUT = 300  # seconds, for one program


def run(command, cwd=ROOT, **options):
    return subprocess.run([str(word) for word in command], cwd=cwd, text=True, errors="replace", timeout=TIMEOUT, **options)


def build(command, **options):
    """A compiler's run, which must succeed."""
    done = run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}")


# ---- the languages: each builds its two programs, and answers with the commands that run them ----


def node(folder, library):
    for file in ("package.json", "package-lock.json", "umbilic.js", "curvature.js"):
        shutil.copy(BINDINGS / "node" / file, folder)
    shutil.copy(CHECKS / "check.js", folder)
    build(["npm", "ci", "--prefix", folder, "--no-audit", "--no-fund", "--ignore-scripts"])
    return ["node", folder / "curvature.js"], ["node", "--expose-gc", folder / "check.js"]


def go(folder, library):
    environment = dict(os.environ, CGO_LDFLAGS=f"-L{library.parent}", GOFLAGS="-p=1", GOPROXY="off", GOCACHE=str(folder / "cache"))
    for module, package, program in (BINDINGS / "go", "./curvature", "curvature"), (CHECKS / "go", ".", "check"):
        build(["go", "build", "-o", folder / program, package], cwd=module, env=environment)
    return [folder / "curvature"], [folder / "check"]


def java(folder, library):
    sources = [*(BINDINGS / "java/umbilic").glob("*.java"), BINDINGS / "java/Curvature.java", CHECKS / "Check.java"]
    build(["javac", "-Xlint:all", "-Werror", "-cp", JNA, "-d", folder, *sources])
    return ["java", "-cp", f"{folder}:{JNA}", "Curvature"], ["java", "-cp", f"{folder}:{JNA}", "umbilic.Check"]


def csharp(folder, library):
    for program, source in ("Curvature", BINDINGS / "csharp/Curvature.cs"), ("Check", CHECKS / "Check.cs"):
        build(["mcs", "-unsafe", "-warnaserror", f"-out:{folder / program}.exe", BINDINGS / "csharp/Umbilic.cs", source])
    return ["mono", folder / "Curvature.exe"], ["mono", folder / "Check.exe"]


def lua(folder, library):
    return ["luajit", BINDINGS / "lua/curvature.lua"], ["luajit", CHECKS / "check.lua"]


def fortran(folder, library):
    module = [BINDINGS / "fortran/umbilic_c.f90", BINDINGS / "fortran/umbilic.f90"]
    # Its warnings of unused arguments have no exception for a procedure that is there to refuse.
    flags = ["-std=f2018", "-O2", "-Wall", "-Wextra", "-Wno-unused-dummy-argument", "-Werror", f"-J{folder}"]
    for program, source in ("curvature", BINDINGS / "fortran/curvature.f90"), ("check", CHECKS / "check.f90"):
        build(["gfortran", *flags, "-o", folder / program, *module, source, f"-L{library.parent}", "-lumbilic"])
    return [folder / "curvature"], [folder / "check"]


LANGUAGES = {"node": node, "go": go, "java": java, "csharp": csharp, "lua": lua, "fortran": fortran}

# ---- what is expected ----

# What each language calls an error of the library's.
KINDS = {
    "node": "UmbilicError: ",
    "go": "umbilic: ",
    "java": "umbilic.UmbilicException: ",
    "csharp": "UmbilicException: ",
    "lua": "umbilic: ",
    "fortran": "umbilic: ",
}

# The status and the element of each mistake.
MISTAKES = {
    "index": (9, 4),
    "offsets": (8, 1),
    "no-offsets": (7, None),
    "indices-size": (7, None),
    "count": (11, None),
    "positions-size": (7, None),
    "ragged": (7, None),
    "type": (7, None),
    "missing": (7, None),
    "nan-normals": (10, 2),
    "nan-curvatures": (10, 2),
    "closed-normals": (1, None),
    "closed-curvatures": (1, None),
}

# Where a language has an error of its own for it, or rules it out by its types (None); and mistakes of one language alone.
OTHERWISE = {
    ("node", "type"): "TypeError: positions must be a Float64Array",
    ("node", "missing"): "TypeError: positions must be a Float64Array",
    ("node", "count"): "RangeError: vertexCount must be an integer from 0",
    ("node", "threads-of-topology"): "RangeError: threads must be an integer from 0",
    ("node", "threads-of-normals"): "RangeError: threads must be an integer from 0",
    ("node", "threads-of-curvatures"): "RangeError: threads must be an integer from 0",
    ("lua", "threads-of-topology"): "cannot convert 'string'",
    ("lua", "threads-of-normals"): "cannot convert 'string'",
    ("lua", "threads-of-curvatures"): "cannot convert 'table'",
    ("go", "ragged"): None,
    ("go", "type"): None,
    ("java", "type"): None,
    ("java", "missing"): "NullPointerException",
    ("csharp", "type"): None,
    ("csharp", "missing"): "ArgumentNullException",
    ("csharp", "ragged"): "ArgumentException",
    ("csharp", "count"): "ArgumentOutOfRangeException",
    ("csharp", "no-offsets"): "ArgumentException",
    ("csharp", "closed-normals"): "ObjectDisposedException",
    ("csharp", "closed-curvatures"): "ObjectDisposedException",
    ("fortran", "type"): None,
    ("fortran", "missing"): None,
    ("fortran", "error-stop"): r"ERROR STOP umbilic: topology is null \(status 1\)",
    ("fortran", "error-stop-at"): r"ERROR STOP umbilic: faces.indices\[5] is 3, but there are 3 vertices \(status 9, element 5\)",
    ("fortran", "assigned"): "ERROR STOP umbilic: a topology cannot be assigned",
    ("fortran", "assigned-arrays"): "ERROR STOP umbilic: a topology cannot be assigned",
}

# What is no mistake, or is checked inside; with the languages that have it.
FINE = {
    "twice": LANGUAGES,
    "empty": LANGUAGES,
    "threads": LANGUAGES,
    "forgotten": LANGUAGES,
    "views": ["java"],
    "moving": ["java"],
    "written": ["java"],
    "inside": ["go"],
    "concurrent": ["go", "java", "csharp"],
}

# Files that the programs read, beside real meshes: faces of two sizes with comments, blank lines and colours; and nothing.
GOOD_FILES = {
    "prism.off": """OFF 6 5 0 # a prism
0 0 0 1.0 0.5 0.25
1 0 0
0 1e0 0\r

  0 0 +1.5
\t1 0 1.5
0 1 1.5
# its faces
3 0 2 1
3 3 4 5 255 0 0 # red
4 0 1 4 3 0.5 0.5 0.5
4 1 2 5 4 3
4 2 0 3 5
""",
    "empty.off": "OFF\n0 0 0\n",
    # Lines longer than any buffer: of a polygon, and of a comment.
    "polygon.off": "OFF 600 1 0\n"
    + "".join(f"{vertex} {vertex * vertex} 0 # {'long ' * 20000 if vertex == 7 else ''}\n" for vertex in range(600))
    + " ".join(map(str, [600, *range(600)])),
}

# Files that they refuse, with status and element, or the words of a language's own error.
TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
# What each says of a line that has too little, or no numbers.
WRONG_LINE = "cannot read|EOF|ParseUint|ParseFloat|ArrayIndexOutOfBounds|IndexOutOfRange|(Number)?FormatException|OverflowException"
BAD_FILES = {
    "index.off": (TETRAHEDRON.replace("3 0 1 3", "3 0 4 3"), (9, 4)),
    "nan.off": (TETRAHEDRON.replace("0 1 0\n", "0 NaN 0\n"), (10, 2)),
    "short.off": (TETRAHEDRON[:-8], "ends early|EOF"),
    "counts.off": ("OFF\n", "ends early|EOF"),
    "face.off": (TETRAHEDRON.replace("3 0 1 3", "3 0 1"), WRONG_LINE),
    "corners.off": (TETRAHEDRON.replace("3 0 1 3", "2000000000 0 1 3"), WRONG_LINE),
    "no-corners.off": (TETRAHEDRON.replace("3 0 1 3", "-3 0 1 3"), WRONG_LINE),
    "word.off": (TETRAHEDRON.replace("3 0 1 3", "3 0 one 3"), WRONG_LINE),
    "large.off": (TETRAHEDRON.replace("3 0 1 3", f"3 0 {2**32 + 1} 3"), WRONG_LINE),
    "position.off": (TETRAHEDRON.replace("1 0 0", "1 0"), WRONG_LINE + "|\\(status 7\\)"),
    "word-position.off": (TETRAHEDRON.replace("1 0 0", "one 0 0"), WRONG_LINE + "|\\(status 10, element 1\\)"),
    "nothing.off": ("", "ends early|EOF|no OFF file"),
    "picture.off": ("P6\n", "no OFF file"),
    "missing.off": (None, "(?i)no such file|could not find|NoSuchFile"),
}

# ---- tests ----


class Tests:
    def __init__(self, library, language, programs):
        self.library, self.language = library, language
        self.curvature, self.check = programs
        self.failures = self.passed = 0

    def expect(self, good, what, detail=""):
        if good:
            self.passed += 1
        else:
            self.failures += 1
            print(f"{self.language}: {what}: FAILED\n{detail}")

    def fails_with(self, what, done, expected):
        """The program ended by itself, with exit code 1 and this on its standard error."""
        if not isinstance(expected, str):
            status, element = expected
            place = "" if element is None else f", element {element}"
            expected = f"{KINDS[self.language]}.+ \\(status {status}{place}\\)"
        good = done.returncode == 1 and re.search(expected, done.stderr) is not None
        self.expect(good, what, f"exit code {done.returncode}, {done.stderr[:400]!r} is not {expected!r}")

    def meshes(self, paths):
        for path in paths:
            expected, found = BUILT / "expected", BUILT / self.language / "results"
            found.unlink(missing_ok=True)
            build([BUILT / "reference", path, expected])
            done = run([*self.curvature, path, found], env=environment(self.library), capture_output=True)
            good = done.returncode == 0 and found.read_bytes() == expected.read_bytes()
            self.expect(good, path, f"exit code {done.returncode} {done.stderr}, or other bits than C")

    def bad_files(self):
        for name, (text, expected) in BAD_FILES.items():
            path = BUILT / name
            path.unlink(missing_ok=True)
            if text is not None:
                path.write_text(text)
            done = run([*self.curvature, path, BUILT / self.language / "results"], env=environment(self.library), capture_output=True)
            self.fails_with(name, done, expected)

    def layout(self):
        """The structs of the language against tests/c/layout.c, which the C compiler holds against the header."""
        if self.language == "go":
            return  # has none of its own
        known = {}
        for struct, field, number in re.findall(r"(?:SIZE|OFFSET)\((\w+), (?:(\w+), )?(\d+)\)", (ROOT / "tests/c/layout.c").read_text()):
            known[f"{struct}.{field}".rstrip(".")] = number
        expected = {name: number for name, number in known.items() if name.split(".")[0][4:] in STRUCTS}
        done = run([*self.check, "layout"], env=environment(self.library), input="\n".join(expected), capture_output=True)
        found = dict(line.split() for line in done.stdout.splitlines())
        wrong = {name: (found.get(name), expected.get(name)) for name in {*found, *expected} if found.get(name) != expected.get(name)}
        self.expect(done.returncode == 0 and not wrong, "layout", f"{done.stderr} (found, expected): {wrong}")

    def mistakes(self):
        own = {mistake: expected for (language, mistake), expected in OTHERWISE.items() if language == self.language}
        for mistake, expected in {**MISTAKES, **own}.items():
            if expected is not None:
                self.fails_with(mistake, run([*self.check, mistake], env=environment(self.library), capture_output=True), expected)

    def fine(self):
        for action, languages in FINE.items():
            if self.language not in languages:
                continue
            more = {"UMBILIC_SLOW": "1"} if action == "concurrent" else {}
            done, calls = recorded([*self.check, action], self.library, **more)
            self.expect(done.returncode == 0, action, f"exit code {done.returncode} {done.stderr}")
            created = [handle for call, handle, *_ in calls if call == "create"]
            destroyed = [handle for call, handle, *_ in calls if call == "destroy" and handle != "(nil)"]
            self.expect(sorted(created) == sorted(destroyed) and created, f"{action}: handles", f"{created} created, {destroyed} freed")
            if action == "threads":
                asked = sorted((call, int(threads)) for call, _, threads, *_ in calls if call != "destroy")
                calls = [(call, threads) for call in ("create", "curvature", "normals") for threads in (1, 3)]
                self.expect([a for a in asked if a[1] > 0] == calls, "threads that arrived", asked)


def environment(library, **more):
    """With a comma for the decimal point, as many users have it."""
    variables = {name: value for name, value in os.environ.items() if name != "LC_ALL"}
    return {**variables, "LOCPATH": str(BUILT / "locale"), "LC_NUMERIC": "de_DE.UTF-8", "LD_LIBRARY_PATH": str(library.parent), **more}


def recorded(command, library, **more):
    """Runs a program with the recorder as its library, and answers with the calls that it made, as words."""
    record = BUILT / "record"
    record.unlink(missing_ok=True)
    variables = environment(BUILT / "recorder/libumbilic.so", UMBILIC_REAL=str(library), UMBILIC_RECORD=str(record), **more)
    done = run(command, env=variables, capture_output=True)
    lines = record.read_text().splitlines() if record.exists() else []
    return done, [re.fullmatch(r"(\w+) (\S+) threads (\d+) status (\d+) ns (\d+) (\d+)", line).groups() for line in lines]


# ---- times ----

HOSTS = {"csharp": "c#", "lua": "luajit"}  # where these are not the names of the languages
QUANTITIES = {"create": "topology", "normals": "vertex normals", "curvature": "curvature"}
COPIES = 0  # of positions, faces and results


def times(library, language, curvature, mesh):
    """The best of the rounds of one process, on one thread. In each round the recorder makes every call a second time, on the same arrays,
    which are warm then: that is the library's own time. The program's is what it took beyond both calls, and what the first takes
    longer, on arrays that the program has just made."""
    done, calls = recorded([*curvature, "--time", mesh], library, UMBILIC_REPEAT="1")
    if done.returncode != 0:
        sys.exit(done.stderr)
    rounds = [[float(number) for number in line.split()] for line in done.stdout.splitlines()]
    for place, (call, quantity) in enumerate(QUANTITIES.items()):
        first, again = zip(*((int(first) / 1e6, int(again) / 1e6) for name, *_, first, again in calls if name == call))
        outside = min(whole[place] - a - b for whole, a, b in zip(rounds, first, again, strict=True))
        library_alone = min(*first, *again)
        adapter = outside + min(first) - library_alone
        print(HOSTS.get(language, language), quantity, COPIES, f"{library_alone:.3f}", f"{adapter:.3f}", sep="\t")


def main(library, what, *rest):
    library = Path(library).resolve()
    names = rest[1:] if what == "--time" else rest
    unknown = set(names) - set(LANGUAGES)
    if unknown:
        sys.exit(f"no such language: {', '.join(unknown)}; there are {', '.join(LANGUAGES)}")
    for folder in ("recorder", *LANGUAGES):
        (BUILT / folder).mkdir(parents=True, exist_ok=True)
    strict = ["-std=c11", "-O1", "-Wall", "-Wextra", "-Wconversion", "-Werror", "-Iinclude"]
    compiler = os.environ.get("CC", "cc")
    build([compiler, *strict, "-c", "tests/c/layout.c", "-o", BUILT / "layout.o"])
    build([compiler, *strict, "tests/ffi/reference.c", "-o", BUILT / "reference", library, f"-Wl,-rpath,{library.parent}"])
    build([compiler, *strict, "-shared", "-fPIC", "tests/ffi/recorder.c", "-o", BUILT / "recorder/libumbilic.so.0"])
    (BUILT / "locale").mkdir(exist_ok=True)
    build(["localedef", "-i", "de_DE", "-f", "UTF-8", BUILT / "locale/de_DE.UTF-8"])
    for name, text in GOOD_FILES.items():
        (BUILT / name).write_text(text)
    failures = 0
    for name in names or LANGUAGES:
        programs = LANGUAGES[name](BUILT / name, library)
        if what == "--time":
            times(library, name, programs[0], rest[0])
            continue
        tests = Tests(library, name, programs)
        tests.meshes([*run(["tests/peers/list.sh", what], stdout=subprocess.PIPE).stdout.split(), *(BUILT / name for name in GOOD_FILES)])
        tests.bad_files()
        tests.layout()
        tests.mistakes()
        tests.fine()
        print(f"{name}: {tests.passed} passed, {tests.failures} failed", flush=True)
        failures += tests.failures
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main(*sys.argv[1:])
