"""Tasks of the worker: solve a rack with one program, make a reference."""

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import references
from rack_line import rack_line
from worker import Job, Reply, peak_mb

PROGRAMS = {  # name -> module and function
    "floor": ("floor", "floor"),
    "newton": ("programs.own", "newton"),
    "status": ("programs.own", "status"),
    "opensees": ("programs.opensees", "opensees"),
    "opensees_norm": ("programs.opensees", "opensees_norm"),
    "pynite": ("programs.pynite", "pynite"),
    "calculix": ("programs.calculix", "calculix"),
}


def solve(job: Job) -> Callable[[], Reply]:
    """One program on one rack."""
    module, function = PROGRAMS[job["program"]]
    run = getattr(import_module(module), function)(rack_line(job["n"]), job["case"])
    path = job.get("reference")
    want = np.load(path)[:, :3] if path else None

    def once() -> Reply:
        outcome = run()
        reply: Reply = {"seconds": outcome.seconds, **outcome.facts}
        reply["peak_mb"] = max(peak_mb(), float(outcome.facts.get("peak_mb", 0.0)))
        if outcome.failure:
            reply["failure"] = outcome.failure
        elif outcome.u is not None and want is not None:
            reply["error"] = _distance(outcome.u[:, :3], want)
        return reply

    return once


def _distance(u: np.ndarray, want: np.ndarray) -> float:
    distance = float(np.abs(u - want).max())
    return distance if np.isfinite(distance) else 1e300


def reference(job: Job) -> Callable[[], dict[str, Any]]:
    """Reference answer of one rack and case."""
    return lambda: references.reference(rack_line(job["n"]), job["case"], Path(job["folder"]))
