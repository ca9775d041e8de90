"""What a run ran on: machine, versions, commit."""

import ctypes
import json
import os
import platform
import re
import shutil
import subprocess
from ctypes.util import find_library
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

ROOT = Path(__file__).parents[1]
PACKAGES = ("numpy", "scipy", "matplotlib", "openseespy", "PyNiteFEA")


def note(scope: str) -> dict[str, str]:
    """Everything, in words."""
    found = {
        "run": scope,
        "commit": commit(),
        "processor": processor(),
        "cores": str(os.cpu_count()),
        "memory": memory(),
        "system": platform.platform(terse=True),
        "load average at the end": f"{os.getloadavg()[2]:.1f}",
        "threads": "1 for every program",
        "python": platform.python_version(),
        "CHOLMOD": cholmod(),
    }
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "not installed"
    return {**found, "CalculiX": calculix()}


def commit() -> str:
    """Commit of the tree, and whether sources were changed since."""

    def git(*words: str) -> str:
        done = subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True)
        return done.stdout.strip()

    name = git("rev-parse", "--short", "HEAD") or "unknown"
    changed = git("status", "--porcelain", "--", "python", "fortran", "benchmarks", "meson.build")
    return f"{name} with changes" if changed else name


def processor() -> str:
    """Name of the processor."""
    info = Path("/proc/cpuinfo")
    if info.exists():
        for line in info.read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.processor() or platform.machine()


def memory() -> str:
    """Memory of the machine."""
    info = Path("/proc/meminfo")
    if info.exists():
        return f"{int(info.read_text().split()[1]) / 2**20:.0f} GB"
    return "unknown"


def cholmod() -> str:
    """Version of the CHOLMOD that is linked."""
    name = find_library("cholmod")
    if name is None:
        return "unknown"
    number = (ctypes.c_int * 3)()
    try:
        ctypes.CDLL(name).cholmod_version(number)
    except (OSError, AttributeError):
        return "unknown"
    return ".".join(str(part) for part in number)


def calculix() -> str:
    """Version of CalculiX."""
    program = shutil.which("ccx")
    if program is None:
        return "not installed"
    done = subprocess.run([program, "-v"], capture_output=True, text=True)
    found = re.search(r"Version\s+(\S+)", done.stdout)
    return found.group(1) if found else "unknown"


def save(found: dict[str, str], folder: Path) -> None:
    """Keep the note."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "machine.json").write_text(json.dumps(found, indent=1) + "\n")


def load(folder: Path) -> dict[str, str]:
    """Read the note."""
    path = folder / "machine.json"
    found: dict[str, str] = json.loads(path.read_text()) if path.exists() else {}
    return found
