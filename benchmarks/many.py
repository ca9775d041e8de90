"""Many linear load cases on one model: what each case after the first costs."""

import time
from collections.abc import Callable
from dataclasses import replace
from statistics import median

from children import once
from experiment import Row, Scope
from floor import floor
from rack import rack_model
from rack_line import rack_line
from worker import Job, Reply

from trunnion.cases.analysis import Run
from trunnion.loads import load_sets
from trunnion.model import Case, Term
from trunnion.system import build_system

CASES = 40
REPEATS = 5


def measure(scope: Scope) -> list[Row]:
    """One row a size: one case, many cases, and what the target allows."""
    rows = []
    for n in (1000, 5000):
        if n > max(scope.sizes) and scope.name != "quick":
            continue
        reply = once({"task": "many", "n": n}, scope.patience)
        rows.append({"n": n, "cases": CASES, **reply})
    return rows


def task(job: Job) -> Callable[[], Reply]:
    """Time one case and many, loads and recovery included, in turn with the floor."""
    rack = rack_line(job["n"])
    model = rack_model(rack, "lin")
    system = build_system(model)  # arrays in memory: the clock starts behind it
    lowest = floor(rack, "lin")
    cases = [
        Case(f"C{i}", (Term(1.0 + 0.01 * i, "W"), Term(1.0 - 0.02 * i, "T1"))) for i in range(CASES)
    ]

    def seconds(some: list[Case]) -> tuple[float, dict[str, int]]:
        own = replace(model, cases=list(some))
        start = time.perf_counter()
        results = Run(own, {}, prepared=(system, load_sets(own, system))).results()
        taken = time.perf_counter() - start
        if not all(result.converged for result in results.cases.values()):
            raise ArithmeticError("a linear case has failed")
        return taken, results.work

    def run() -> Reply:
        one, many, solves, factors = [], [], [], []
        for _ in range(REPEATS):
            one.append(seconds(cases[:1])[0])
            taken, work = seconds(cases)
            many.append(taken)
            facts = lowest().facts
            solves.append(float(facts["solve_seconds"]))
            factors.append(float(facts["factor_seconds"]))
        allowed = median(one) + (CASES - 1) * 2 * median(solves)
        return {
            "one_case": median(one),
            "seconds": median(many),
            "each_more": (median(many) - median(one)) / (CASES - 1),
            "one_solve": median(solves),
            "one_factor": median(factors),
            "allowed": allowed,
            "analyse": work["analyse"],
            "factorise": work["factorise"],
            "solve": work["solve"],
            "refine": work["refine"],
        }

    return run
