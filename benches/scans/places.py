"""Makes the modules of benches/paper, benches/accuracy and tests/peers importable, and the Python package; imported for that
alone."""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
for folder in ("benches/paper", "benches/accuracy", "tests/peers"):
    if str(ROOT / folder) not in sys.path:
        sys.path.append(str(ROOT / folder))

import bindings  # noqa: E402, F401
