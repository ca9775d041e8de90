"""CYCLE: heat-up and cool-down followed with committed datums until the loop repeats.

A support that slides one way while heating has to be pushed back while cooling, so its friction
turns round: over the loop its load ranges from -mu N to +mu N, twice what one shot shows.
"""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from trunnion.arrays import F8, CaseResult, CycleResult
from trunnion.model import Case, Cycle
from trunnion.results.supports import card_forces
from trunnion.solver.steps import Origin

if TYPE_CHECKING:
    from trunnion.cases.analysis import Run

REPEATED = 1e-6  # change of support loads and displacements between two loops, of the largest


def follow(run: "Run", cycle: Cycle) -> CycleResult:
    """Follow a cycle loop by loop; stop when it repeats or after its TIMES."""
    cases = {c.name: c for c in run.model.cases if isinstance(c, Case)}
    result = CycleResult(cycle.name, cycle.cases, 0, False, np.inf)
    origin = run.ended.get(cycle.start) if cycle.start else None
    if cycle.start and origin is None:
        result.cause = f"it starts from {cycle.start}, which has no answer"
        return result
    before: list[CaseResult] = []
    for loop in range(cycle.times):
        steps: list[CaseResult] = []
        for name in cycle.cases:
            step, origin = _one(run, cases[name], origin, f"{cycle.name} {loop + 1} {name}")
            if origin is None:
                result.cause = f"loop {loop + 1}, {name}: {step.cause}"
                return result
            steps.append(step)
        result.path += steps
        result.loops = loop + 1
        if before:
            result.change = change_between(before, steps)
            result.repeats = result.change <= REPEATED
        before = steps
        if result.repeats:
            break
    set_ranges(run, cycle, before, result)
    return result


def _one(
    run: "Run", case: Case, origin: Origin | None, name: str
) -> tuple[CaseResult, Origin | None]:
    return run.go_on(case, replace(run.question(case), name=name), origin)


def change_between(before: list[CaseResult], after: list[CaseResult]) -> float:
    """Largest change of a support load or of a displacement, each of the largest."""
    loads = _relative(_loads(before), _loads(after), 1.0)
    return max(loads, _relative(_moves(before), _moves(after), 1e-9))


def _loads(steps: list[CaseResult]) -> F8:
    return np.stack([card_forces(step) for step in steps])


def _moves(steps: list[CaseResult]) -> F8:
    return np.stack([step.state.u for step in steps if step.state is not None])


def _relative(old: F8, new: F8, least: float) -> float:
    size = max(least, float(np.abs(new).max(initial=0.0)))
    return float(np.abs(new - old).max(initial=0.0)) / size


def set_ranges(run: "Run", cycle: Cycle, steps: list[CaseResult], result: CycleResult) -> None:
    """Largest less smallest value over the last loop, and between the cases on their own."""
    result.supports = _range([card_forces(c) for c in steps])
    result.elements = _range([c.state.end_force for c in steps if c.state is not None])
    alone = [run.found[name] for name in cycle.cases]
    if all(c.state is not None for c in alone):
        result.one_shot_supports = _range([card_forces(c) for c in alone])
        result.one_shot_elements = _range([c.state.end_force for c in alone if c.state is not None])


def _range(values: list[F8]) -> F8:
    stack = np.stack(values)
    out: F8 = stack.max(axis=0) - stack.min(axis=0)
    return out
