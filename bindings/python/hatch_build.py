"""Puts the compiled library into the wheel: the one that UMBILIC_LIBRARY names, else what cargo makes here.

The wheel serves any Python 3 of its platform, because the library is called through ctypes.
"""

import os
import subprocess
import sys
import sysconfig
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

FILE = {"win32": "umbilic.dll", "darwin": "libumbilic.dylib"}.get(sys.platform, "libumbilic.so")


class LibraryHook(BuildHookInterface):
    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        if version == "editable":
            # An editable install finds the library by UMBILIC_LIBRARY, as the sources do.
            return
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
        build_data["force_include"][str(self.library())] = f"umbilic/{FILE}"

    def library(self) -> Path:
        named = os.environ.get("UMBILIC_LIBRARY")
        if named:
            return Path(named).resolve(strict=True)
        repository = Path(self.root).resolve().parents[1]
        try:
            subprocess.run(["cargo", "build", "--release", "--locked", "--lib"], cwd=repository, check=True)
        except FileNotFoundError:
            raise RuntimeError("no cargo here to build the library; UMBILIC_LIBRARY names one that is built") from None
        target = Path(os.environ.get("CARGO_TARGET_DIR") or "target")
        return (repository / target / "release" / FILE).resolve(strict=True)
