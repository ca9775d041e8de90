"""Error against time inside one run, and what a tolerance is worth.

For each iteration: the points it passes through with clock and error; the error at the point it
accepts by its own rule (change extrapolated from the ratio, and all states at rest) for a sweep of
acceptance tolerances; and where a plain test of the last change would have stopped it.
"""

from collections.abc import Callable

import numpy as np
from children import once
from experiment import Row, Scope
from inside import Passes, accepting, watched
from programs.own import arrays
from rack_line import rack_line
from racks import reference
from worker import Job, Reply

from trunnion.arrays import CaseResult
from trunnion.cases.analysis import solve_system
from trunnion.solver.steps import Plan

TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10, 1e-13)
POINTS = 80  # of a curve, at most
REPEATS = 3


def measure(scope: Scope) -> tuple[list[Row], list[Row]]:
    """Rows of tolerances and rows of curves."""
    sizes = [n for n in (50, 200, 1000) if n in scope.sizes]
    tolerances: list[Row] = []
    curves: list[Row] = []
    for n in sizes:
        path = reference(scope, n, "fric1").get("path")
        for iteration in ("newton", "status"):
            job: Job = {"task": "passes", "n": n, "case": "fric1", "iteration": iteration}
            job["reference"] = path
            # the status iteration may take its 10 000 passes at every tolerance
            reply = once(job, 8 * scope.limit)
            if "failure" in reply:
                tolerances.append({"n": n, "iteration": iteration, "outcome": reply["failure"]})
                continue
            tolerances += [{"n": n, "iteration": iteration, **row} for row in reply["tolerances"]]
            curves += [{"n": n, "iteration": iteration, **row} for row in reply["curve"]]
    return tolerances, curves


def task(job: Job) -> Callable[[], Reply]:
    """Everything about one iteration on one rack."""
    system, loads, steps = arrays(rack_line(job["n"]), job["case"])
    want = np.load(job["reference"])[np.argsort([int(label) for label in system.labels])]
    iteration = job["iteration"].upper()
    plan = Plan(steps=steps, iteration=iteration, ramp=False)

    def solved() -> CaseResult:
        return solve_system(system, {"A": loads}, {"A": plan})["A"]

    def once() -> Reply:
        solved()
        with watched() as seen:
            result = solved()
        error = errors(seen, want)
        tolerances = plain_tests(seen, error)
        if iteration == "NEWTON":
            tolerances.append({"rule": "its own", **outcome(seen, want, result)})
        else:
            tolerances += [own_rule(tolerance, solved, want) for tolerance in TOLERANCES]
        return {"tolerances": tolerances, "curve": curve(seen, error)}

    return once


def own_rule(tolerance: float, solved: Callable[[], CaseResult], want: np.ndarray) -> Row:
    """Where the status iteration stops by its own rule at a tolerance; fastest of several runs."""
    found = []
    for _ in range(REPEATS):
        with accepting(tolerance), watched(every=10**9) as seen:
            result = solved()
        found.append({"rule": "its own", "tolerance": tolerance, **outcome(seen, want, result)})
        if found[-1]["seconds"] is None or found[-1]["seconds"] > 1.0:
            break
    return sorted(found, key=lambda row: row["seconds"] or np.inf)[len(found) // 2]


def outcome(seen: Passes, want: np.ndarray, result: CaseResult) -> Row:
    """The accepted point, and what the certificate says after refinement from it."""
    row: Row = {
        "passes": len(result.history),
        "factorise": result.work["factorise"],
        "seconds": None,
        "error": None,
        "outcome": "certified" if result.converged else f"refused: {result.cause}",
    }
    if seen.accepted is not None and seen.nodes is not None:
        row["seconds"] = seen.accepted_after
        row["error"] = _distance(seen.accepted, want[seen.nodes])
    else:
        row["outcome"] = f"accepts nothing: {result.cause}"
    return row


def errors(seen: Passes, want: np.ndarray) -> np.ndarray:
    """Distance of each point to the reference [m]."""
    assert seen.nodes is not None
    at = want[seen.nodes]
    return np.array([_distance(point, at) for point in seen.points])


def _distance(u: np.ndarray, want: np.ndarray) -> float:
    return float(np.abs(u[:, :3] - want[:, :3]).max())


def plain_tests(seen: Passes, error: np.ndarray) -> list[Row]:
    """Where "the displacements change by less than the tolerance" stops for the first time."""
    move = [_distance(b, a) for a, b in zip(seen.points, seen.points[1:], strict=False)]
    size = [max(float(np.abs(p[:, :3]).max()), 1e-300) for p in seen.points[1:]]
    change = np.array(move) / np.array(size)
    rows = []
    for tolerance in TOLERANCES:
        below = np.flatnonzero(change <= tolerance)
        row: Row = {"rule": "last change", "tolerance": tolerance, "outcome": "never"}
        if len(below):
            i = int(below[0]) + 1
            row |= {
                "passes": i + 1,
                "factorise": seen.factorised[i],
                "seconds": seen.seconds[i],
                "error": float(error[i]),
                "outcome": "stops",
            }
        rows.append(row)
    return rows


def curve(seen: Passes, error: np.ndarray) -> list[Row]:
    """Points of the run, thinned evenly in the logarithm of their number."""
    n = len(error)
    if n == 0:
        return []
    at = np.unique(np.round(np.geomspace(1, n, min(n, POINTS))).astype(int) - 1)
    return [
        {
            "pass": int(i) + 1,
            "what": seen.what[i],
            "seconds": seen.seconds[i],
            "factorise": seen.factorised[i],
            "error": float(error[i]),
        }
        for i in at
    ]
