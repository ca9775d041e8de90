"""Run an exported job in its program, and hold its answer against Trunnion's."""

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

from trunnion.exports.agreement import TOLERANCE

if TYPE_CHECKING:
    from trunnion.exports import Job


NAMES = {"opensees": "OpenSees", "calculix": "CalculiX"}
TOLERANCES = {"opensees": TOLERANCE, "calculix": 2e-6}  # CalculiX prints seven digits


class ProgramError(RuntimeError):
    """The other program ended without an answer."""


def missing(program: str) -> str:
    """Say what is not installed for a program; nothing if all is there."""
    if program == "opensees" and find_spec("openseespy") is None:
        return "OpenSees needs the package openseespy: pip install 'trunnion[opensees]'"
    if program == "calculix" and shutil.which("ccx") is None:
        return "CalculiX needs the program ccx: apt-get install calculix-ccx"
    return ""


def answer(job: "Job", program: str, folder: Path, stem: str) -> dict[str, Any]:
    """Run the job whose files stand in `folder`; its answer has the layout of a JSON report.

    Raises
    ------
    ProgramError
        The program failed.
    """
    if program == "opensees":
        return _opensees(folder, stem)
    from trunnion.exports.calculix.answer import read_answer

    return read_answer(job, folder, stem, _calculix)


def _opensees(folder: Path, stem: str) -> dict[str, Any]:
    script, place = folder / f"{stem}_opensees.py", folder / f"{stem}_opensees.json"
    place.unlink(missing_ok=True)
    done = _run([sys.executable, script.name], folder)
    if not place.exists():
        raise ProgramError(f"OpenSees: {_last(done.stderr) or f'exit code {done.returncode}'}")
    found: dict[str, Any] = json.loads(place.read_text())
    return found


def _calculix(folder: Path, name: str) -> None:
    done = _run(["ccx", name], folder)
    if done.returncode or "*ERROR" in done.stdout:
        said = [line for line in done.stdout.splitlines() if "*ERROR" in line]
        raise ProgramError(f"CalculiX: {said[0].strip() if said else _last(done.stdout)}")


def _run(words: list[str], folder: Path) -> subprocess.CompletedProcess[str]:
    alone: Mapping[str, str] = {**os.environ, "OMP_NUM_THREADS": "1"}
    return subprocess.run(words, cwd=folder, capture_output=True, text=True, env=alone)


def _last(text: str) -> str:
    lines = text.strip().splitlines()
    return lines[-1].strip() if lines else ""
