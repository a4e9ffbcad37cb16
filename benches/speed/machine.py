"""What it ran on: processor, system, versions; and how busy other programs were meanwhile."""

import os
import platform
import resource
import subprocess
import time
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path


def first_line(*command: str) -> str:
    try:
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[0]
    except (OSError, subprocess.CalledProcessError, IndexError):
        return "unknown"


def processor() -> str:
    try:
        lines = subprocess.run(["lscpu"], capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"}).stdout
    except OSError:
        return platform.machine()
    found = dict(line.split(":", 1) for line in lines.splitlines() if ":" in line)
    cache = ", ".join(f"{level} {found[f'{level} cache'].strip()}" for level in ("L2", "L3") if f"{level} cache" in found)
    model = f"{found.get('Model name', '?').strip()} (family {found.get('CPU family', '?').strip()}"
    model += f", model {found.get('Model', '?').strip()})"
    virtual = ", virtual" if "Hypervisor vendor" in found else ""
    return f"{found['CPU(s)'].strip()} CPUs{virtual}: {model}; {cache}"


def system() -> str:
    release = Path("/etc/os-release")
    lines = release.read_text().splitlines() if release.exists() else []
    names = [line.split("=", 1)[1].strip('"') for line in lines if line.startswith("PRETTY_NAME=")]
    huge = Path("/sys/kernel/mm/transparent_hugepage/enabled")
    pages = huge.read_text().split("[")[1].split("]")[0] if huge.exists() else "none"
    libc = os.confstr("CS_GNU_LIBC_VERSION")
    return f"{names[0] if names else platform.system()}, Linux {'.'.join(platform.release().split('.')[:2])}, {libc}; transparent huge pages: {pages}"


def package(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None


class Load:
    """The share of the CPUs' time that other programs take, from here on."""

    def __init__(self):
        self.start, self.busy, self.ours = time.monotonic(), busy(), own()

    def others(self) -> float:
        elapsed = (time.monotonic() - self.start) * (os.cpu_count() or 1)
        return max(0.0, busy() - self.busy - (own() - self.ours)) / elapsed


def busy() -> float:
    """Seconds that CPUs have worked."""
    fields = Path("/proc/stat").read_text().splitlines()[0].split()[1:]
    return sum(int(fields[place]) for place in (0, 1, 2, 5, 6, 7)) / os.sysconf("SC_CLK_TCK")


def own() -> float:
    usages = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(usage.ru_utime + usage.ru_stime for usage in usages)
