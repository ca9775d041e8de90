"""Trunnion itself, both iterations; the clock runs from arrays in memory to certified answers."""

import time
from collections.abc import Callable

from rack import node_displacements, rack_model
from rack_line import Rack

from programs.outcome import Outcome
from trunnion.arrays import Loads, System
from trunnion.cases.analysis import solve_system
from trunnion.loads import case_loads
from trunnion.model import Case
from trunnion.solver.steps import Plan
from trunnion.system import build_system

COUNTS = ("analyse", "factorise", "solve", "refine", "iterations", "elements")


def newton(rack: Rack, case: str) -> Callable[[], Outcome]:
    """The default iteration."""
    return prepared(rack, case, "NEWTON")


def status(rack: Rack, case: str) -> Callable[[], Outcome]:
    """The elastic status iteration of the trade."""
    return prepared(rack, case, "STATUS")


def arrays(rack: Rack, case: str) -> tuple[System, Loads, int]:
    """System, loads and number of steps of a case."""
    model = rack_model(rack, case)
    system = build_system(model)
    one = model.cases[0]
    assert isinstance(one, Case)
    return system, case_loads(model, system, one), one.steps


def prepared(rack: Rack, case: str, iteration: str) -> Callable[[], Outcome]:
    """Build the arrays; what is returned solves, certifies and times both."""
    system, loads, steps = arrays(rack, case)
    # a failed status iteration would ramp, and end by its own rules as another method
    plan = Plan(steps=steps, iteration=iteration, ramp=iteration == "NEWTON")

    def run() -> Outcome:
        start = time.perf_counter()
        results = solve_system(system, {case: loads}, {case: plan})
        seconds = time.perf_counter() - start
        result = results[case]
        facts: dict[str, float | str] = {name: results.work.get(name, 0) for name in COUNTS}
        if result.certificate is not None:
            facts |= {"worst": result.certificate.worst, "where": result.certificate.where}
        if not result.converged:
            return Outcome(seconds, None, f"says so: {result.cause}", facts)
        return Outcome(seconds, node_displacements(result), None, facts)

    return run
