"""Makes the package of bindings/python importable, over the library that UMBILIC_LIBRARY names, else that of target/release;
imported for that alone."""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
os.environ.setdefault("UMBILIC_LIBRARY", str(ROOT / "target" / "release" / "libumbilic.so"))
SOURCES = str(ROOT / "bindings" / "python" / "src")
if SOURCES not in sys.path:
    sys.path.insert(0, SOURCES)
