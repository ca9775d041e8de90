"""Sweeps: what the stiffness of rigid supports, of sticking, and the number of load steps cost.

Two errors are told apart, each against an answer of `exact`:

- round-off: distance to the exact answer of the *same* stiffness;
- penalty: distance of that exact answer to the one of truly rigid supports (or of sticking without
  any give), where 1 / k is zero in the equations.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from statistics import median
from typing import Any

import numpy as np
from children import once
from exact import Exact, solve_exactly
from experiment import Row, Scope
from frame import build_frame
from programs.own import arrays
from rack import node_displacements, support_forces
from rack_line import Rack, rack_line
from references import guess, laws
from worker import Job, Reply

from trunnion.arrays import CaseResult, Loads, System
from trunnion.cases.analysis import solve_system
from trunnion.solver.steps import Plan

KP = tuple(10.0**i for i in range(8, 17))
KF = tuple(10.0**i for i in range(4, 13))
STEPS = (1, 2, 4, 8, 16, 32, 64)
LIMIT = 256  # steps that stand for the ramp's own limit
REPEATS = 5
SWEEPS = (("kp", "gap"), ("kp", "fric1"), ("kf", "fric1"), ("steps", "fric"))


def measure(scope: Scope) -> dict[str, list[Row]]:
    """Rows by kind of sweep."""
    rows: dict[str, list[Row]] = {}
    for kind, case in SWEEPS:
        job = {"task": "sweep", "kind": kind, "n": scope.small, "case": case}
        reply = once(job, scope.patience)
        found = reply.get("rows", [{"outcome": reply.get("failure", "nothing came back")}])
        rows.setdefault(f"sweep_{kind}", []).extend(
            {"n": scope.small, "case": case, **row} for row in found
        )
    return rows


def task(job: Job) -> Callable[[], Reply]:
    """One sweep."""
    rack = rack_line(job["n"])
    if job["kind"] == "steps":
        return lambda: {"rows": by_steps(rack)}
    return lambda: {"rows": by_stiffness(rack, job["case"], job["kind"])}


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Run:
    """A case that can be solved again and again."""

    rack: Rack
    case: str
    system: System
    loads: Loads
    steps: int

    def solve(self) -> CaseResult:
        """Solve and certify."""
        plan = Plan(steps=self.steps)
        return solve_system(self.system, {self.case: self.loads}, {self.case: plan})[self.case]


def prepared(rack: Rack, case: str) -> Run:
    """Arrays of a case."""
    return Run(rack, case, *arrays(rack, case))


def timed(runs: dict[Any, Run]) -> dict[Any, tuple[float, CaseResult]]:
    """Median time and answer of each; in turn, so that the machine's drift meets all."""
    seconds: dict[Any, list[float]] = {key: [] for key in runs}
    results: dict[Any, CaseResult] = {}
    for _ in range(REPEATS):
        for key, run in runs.items():
            start = time.perf_counter()
            results[key] = run.solve()
            seconds[key].append(time.perf_counter() - start)
    return {key: (median(seconds[key]), results[key]) for key in runs}


def by_stiffness(rack: Rack, case: str, kind: str) -> list[Row]:
    """Rows of k_p or of k_f."""
    name, values = ("kn", KP) if kind == "kp" else ("kt", KF)
    found = timed({k: prepared({**rack, name: k}, case) for k in values})
    default = solved(found[rack[name]][1])
    rigid = exactly(rack, case, default, kind, np.inf)
    rows = []
    for k, (seconds, result) in found.items():
        row: Row = {name_of(kind): k, "seconds": seconds, **told(result)}
        if result.state is not None:
            row |= compared({**rack, name: k}, case, result, kind, k, rigid)
        rows.append(row)
    return rows


def name_of(kind: str) -> str:
    """Column of the stiffness."""
    return {"kp": "k_p", "kf": "k_f"}[kind]


def told(result: CaseResult) -> Row:
    """What the run says of itself."""
    row: Row = {"factorise": result.work["factorise"], "solve": result.work["solve"]}
    if result.certificate is not None:
        row["worst"] = result.certificate.worst
    if result.penalty_effect:
        row["penalty_effect"] = max(result.penalty_effect.values())
    row["outcome"] = "certified" if result.converged else f"refused: {result.cause}"
    return row


def solved(result: CaseResult) -> CaseResult:
    """The answer of the default, which has to be there."""
    if result.state is None:
        raise ArithmeticError(f"the default does not converge: {result.cause}")
    return result


def exactly(rack: Rack, case: str, result: CaseResult, kind: str, k: float) -> Exact:
    """Exact answer for one stiffness."""
    kp, kf = (k, rack["kt"]) if kind == "kp" else (rack["kn"], k)
    return solve_exactly(
        build_frame(rack), rack, laws(rack, case, result, kp, kf), guess(rack, result)
    )


def compared(rack: Rack, case: str, result: CaseResult, kind: str, k: float, rigid: Exact) -> Row:
    """Round-off and penalty error of displacements [m] and of normal forces (relative)."""
    try:
        same = exactly(rack, case, result, kind, k)
    except ArithmeticError as reason:
        return {"reference": str(reason)}
    u = node_displacements(result)
    normal, _ = support_forces(result, rack)
    largest = partial(_largest, scale=float(np.abs(rigid.normal).max()))
    return {
        "round_off": _largest((u - same.u)[:, :3]),
        "penalty": _largest((same.u - rigid.u)[:, :3]),
        "round_off_force": largest(normal - same.normal),
        "penalty_force": largest(same.normal - rigid.normal),
        "largest_u": _largest(u[:, :3]),
    }


def _largest(a: Any, scale: float = 1.0) -> float:
    return float(np.abs(a).max(initial=0.0)) / scale


def by_steps(rack: Rack) -> list[Row]:
    """Rows of the number of equal load steps."""
    found = timed({k: prepared(rack, f"fric{k}") for k in STEPS})
    one = solved(found[1][1])
    limit = solved(prepared(rack, f"fric{LIMIT}").solve())
    rows = []
    for k, (seconds, result) in found.items():
        row: Row = {"steps": k, "seconds": seconds, **told(result)}
        if result.state is not None:
            u, force = node_displacements(result), support_forces(result, rack)
            for name, other in (("one_step", one), ("limit", limit)):
                normal, friction = support_forces(other, rack)
                row[f"u_to_{name}"] = _largest((u - node_displacements(other))[:, :3])
                row[f"normal_to_{name}"] = _largest(force[0] - normal)
                row[f"friction_to_{name}"] = _largest(force[1] - friction)
        rows.append(row)
    return rows
