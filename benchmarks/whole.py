"""Whole processes: `trunnion run` of small decks, split into parts; the reading of a long one."""

import os
import re
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

from children import PINNED, once
from experiment import Row, Scope
from rack_line import rack_line
from reading import deck_of
from reading import measure as read_and_build
from worker import Job, Reply

MODELS = Path(__file__).parents[1] / "models"
DECKS = ("straight_pipe", "hot_header", "b313_s302", "rack_50", "rack_200")
SMALL = 30  # nodes of the target's deck
REPEATS = 7
MORE = "CASE SUS = W\nCOMB EXP = OPE - SUS\n"  # cases beside OPE
PARTS = re.compile(r"(read|solve|write) ([0-9.]+) s")


def rack_deck(n: int) -> str:
    """Deck of a rack line with a sustained, an operating and an expansion case."""
    return deck_of(rack_line(n)) + MORE


def measure(scope: Scope) -> tuple[list[Row], list[Row]]:
    """Rows of whole processes, and of reading alone."""
    with TemporaryDirectory() as folder:
        small = Path(folder) / f"rack_{SMALL}.inp"
        small.write_text(rack_deck(SMALL))
        paths = [small, *(MODELS / f"{name}.inp" for name in DECKS)]
        found: dict[Path, list[dict[str, float]]] = {path: [] for path in paths}
        bare: list[float] = []
        for _ in range(REPEATS if scope.name == "full" else 3):
            bare.append(_python("import numpy"))
            for path in paths:
                found[path].append(_run(path, folder))
    rows: list[Row] = [{"deck": "(python -c 'import numpy')", "whole": median(bare)}]
    for path, runs in found.items():
        parts = {name: median(run[name] for run in runs) for name in runs[0]}
        rows.append({"deck": path.stem, "cards": _cards(path), **parts})
    return rows, [_reading(scope.cards, scope), _reading(1000, scope)]


def _cards(path: Path) -> int | None:
    return path.read_text().count("\n") if path.exists() else None


def _python(code: str) -> float:
    start = time.perf_counter()
    subprocess.run([sys.executable, "-c", code], check=True, env={**os.environ, **PINNED})
    return time.perf_counter() - start


def _run(deck: Path, folder: str) -> dict[str, float]:
    """Seconds of one `trunnion run`: whole, start-up and end, read, solve, write."""
    command = [str(Path(sys.executable).with_name("trunnion")), "run", str(deck), "-o", folder]
    start = time.perf_counter()
    done = subprocess.run(
        [*command, "--timings"], capture_output=True, text=True, env={**os.environ, **PINNED}
    )
    whole = time.perf_counter() - start
    parts = {name: float(value) for name, value in PARTS.findall(done.stdout)}
    if done.returncode or len(parts) != 3:
        raise RuntimeError(f"trunnion run {deck.name} ends with {done.returncode}: {done.stderr}")
    return {"whole": whole, "start_up": whole - sum(parts.values()), **parts}


def _reading(n: int, scope: Scope) -> Row:
    return {"nodes": n, **once({"task": "cards", "n": n}, scope.patience)}


def task(job: Job) -> Callable[[], Reply]:
    """Read a deck and build its arrays; cards a second."""
    text = deck_of(rack_line(job["n"]))
    cards = sum(1 for line in text.splitlines() if line.strip())

    def run() -> Reply:
        read, build = read_and_build(text, REPEATS)
        return {
            "cards": cards,
            "read": read,
            "build": build,
            "cards_a_second": cards / (read + build),
        }

    return run
