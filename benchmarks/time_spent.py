"""Where the time goes: how often each part of the solver is called, and what one call costs.

Functions of the solver are wrapped for one run; the time of a part is its own, without that of
parts called from it, so that the parts add up to the whole.  The wrappers cost about a microsecond
a call, which small models show; the median of several runs is kept.
"""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from importlib import import_module
from statistics import median
from typing import Any

from children import once
from experiment import Row, Scope
from programs.own import arrays
from rack_line import rack_line
from worker import Job, Reply

from trunnion.cases.analysis import solve_system
from trunnion.solver.steps import Plan

PARTS: dict[str, tuple[tuple[str, str], ...]] = {
    "members, pattern, assembly": (("trunnion.solver.structure", "Structure.__init__"),),
    "symbolic analysis": (("trunnion.kernels", "SpdFactor.__init__"),),
    "values of the matrix": (("trunnion.solver.structure", "Structure.factorise"),),
    "numeric factorisation": (("trunnion.kernels", "SpdFactor.factorise"),),
    "solves": (("trunnion.kernels", "SpdFactor.solve"),),
    "loads": (("trunnion.solver.structure", "Structure.forcing"),),
    "contact and friction pass": (("trunnion.solver.structure", "Structure.respond"),),
    "balance by members": (("trunnion.solver.structure", "Structure.residual"),),
    "line search": (("trunnion.solver.structure", "Structure.search"),),
    "coupled step (GMRES)": (("trunnion.solver.coupled", "gmres"),),
    "recovery of every element": (("trunnion.solver.structure", "Structure.exact"),),
    "refinement, penalty effect": (("trunnion.solver.answer", "report_numbers"),),
    "certificate": (("trunnion.solver.answer", "certify"),),
    "convergence story": (("trunnion.solver.history", "History.add"),),
}
DRIVER = "driver: the rest"
CASES = ("lin", "gap", "fric1")
REPEATS = 5


@dataclass(slots=True)
class Spent:
    """Own seconds and calls by part; `inside` are the parts that are running."""

    seconds: dict[str, float] = field(default_factory=dict)
    calls: dict[str, int] = field(default_factory=dict)
    inside: list[float] = field(default_factory=list)

    def wrap(self, part: str, function: Callable[..., Any]) -> Callable[..., Any]:
        """The function with a clock around it."""

        def clocked(*args: Any, **kwargs: Any) -> Any:
            self.inside.append(0.0)
            start = time.perf_counter()
            try:
                return function(*args, **kwargs)
            finally:
                taken = time.perf_counter() - start
                others = self.inside.pop()
                if self.inside:
                    self.inside[-1] += taken
                self.seconds[part] = self.seconds.get(part, 0.0) + taken - others
                self.calls[part] = self.calls.get(part, 0) + 1

        return clocked


def place(module: str, name: str) -> tuple[Any, str]:
    """Object and attribute that a name of `PARTS` stands for."""
    owner: Any = import_module(module)
    *path, last = name.split(".")
    for step in path:
        owner = getattr(owner, step)
    return owner, last


@contextmanager
def clocks() -> Iterator[Spent]:
    """Put clocks around every part."""
    spent, kept = Spent(), []
    for part, names in PARTS.items():
        for module, name in names:
            owner, last = place(module, name)
            function = getattr(owner, last)
            kept.append((owner, last, function))
            setattr(owner, last, spent.wrap(part, function))
    try:
        yield spent
    finally:
        for owner, last, function in kept:
            setattr(owner, last, function)


def measure(scope: Scope) -> list[Row]:
    """A row for every part of every case and size."""
    rows: list[Row] = []
    for n in scope.spent:
        for case in CASES:
            reply = once({"task": "story", "n": n, "case": case}, scope.patience)
            found = reply.get("rows", [{"part": reply.get("failure", "nothing came back")}])
            rows += [{"n": n, "case": case, **row} for row in found]
    return rows


def task(job: Job) -> Callable[[], Reply]:
    """Profile one case of one rack."""
    system, loads, steps = arrays(rack_line(job["n"]), job["case"])

    def solve() -> None:
        solve_system(system, {"A": loads}, {"A": Plan(steps=steps)})

    def run() -> Reply:
        solve()
        plain, watched, spents = [], [], []
        for _ in range(REPEATS):
            start = time.perf_counter()
            solve()
            plain.append(time.perf_counter() - start)
            with clocks() as spent:
                start = time.perf_counter()
                solve()
                watched.append(time.perf_counter() - start)
            rest = watched[-1] - sum(spent.seconds.values())
            spent.seconds[DRIVER], spent.calls[DRIVER] = rest, 1
            spents.append(spent)
        whole = median(watched)
        rows = []
        for part in (*PARTS, DRIVER):
            calls = spents[-1].calls.get(part, 0)
            seconds = median(spent.seconds.get(part, 0.0) for spent in spents)
            if calls:
                each = seconds / calls
                share = seconds / whole
                row = {"part": part, "calls": calls, "each": each, "seconds": seconds}
                rows.append({**row, "share": share})
        rows.append({"part": "all, with clocks", "calls": 1, "seconds": whole})
        rows.append({"part": "all, without", "calls": 1, "seconds": median(plain)})
        return {"rows": rows}

    return run


if __name__ == "__main__":
    import sys

    for size, one in zip(sys.argv[1::2], sys.argv[2::2], strict=True):
        for line in task({"n": int(size), "case": one})()["rows"]:
            print(
                "  ".join(
                    f"{value:.4g}" if isinstance(value, float) else str(value)
                    for value in line.values()
                )
            )
