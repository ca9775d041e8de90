"""One case: load steps and fallbacks, with the datum committed after each step."""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from trunnion.arrays import F8, Loads
from trunnion.solver.digits import is_lossy
from trunnion.solver.events import split_at_closings
from trunnion.solver.friction import Solved, solve_step
from trunnion.solver.history import History
from trunnion.solver.quantities import Forcing, Point, Sliding
from trunnion.solver.span import Span
from trunnion.solver.status import release, solve_status
from trunnion.solver.structure import Structure
from trunnion.solver.verdict import commit

SUB_STEPS = "sub-steps"  # word of the warnings of cases whose path is another than asked
RAMPS = (2, 4, 8, 16, 32, 64)
LAST_PASSES = 1500  # of the status iteration where one step has failed


@dataclass(slots=True, eq=False, repr=False)
class Plan:
    """How a case is to be solved."""

    steps: int = 1
    events: bool = False
    iteration: str = "NEWTON"
    capacity: F8 | None = None  # start of the capacities of the first step
    u: F8 | None = None  # (n_node, 6) of the model: start of the displacements, not of the datum
    ramp: bool = True  # whether ramping and freezing may be tried


@dataclass(slots=True, eq=False, repr=False)
class Origin:
    """Where a case starts: loads, displacements and committed data of the case FROM names.

    forcing : the loads as the structure of the case that starts sees them: with its moduli.
    point : of all nodes of the model.
    lock : (n_card, 6) where snubbers locked, against their ground; None where they are free.
    """

    forcing: Forcing
    point: Point
    datum: F8
    loads: Loads | None = None
    lock: F8 | None = None


def solve_case(
    structure: Structure, forcing: Forcing, origin: Origin, plan: Plan, history: History
) -> tuple[Point, Solved]:
    """Follow a case from its origin to its loads."""
    s = structure.sliders
    law = Sliding(np.zeros(len(s.mu)), s.kf, s.mu * forcing.mux, origin.datum.copy())
    solve = solve_status if plan.iteration == "STATUS" else solve_step
    capacity = plan.capacity
    kept = structure.kept
    start, point = origin.forcing, Point(origin.point.u[kept], origin.point.low[kept])
    if plan.u is not None:
        point = Point(plan.u[kept], np.zeros_like(point.low))
    solved = None
    for i in range(plan.steps):
        target = origin.forcing.toward(forcing, (i + 1) / plan.steps)
        span = Span(structure, law, start, target, point.copy(), solve, history)
        solved = _step(span, point, plan, capacity)
        if not solved.settled:
            break
        datum = commit(solved.sliding.datum, law.kf, solved.response)  # of the last sub-step
        law = replace(solved.sliding, datum=datum)
        capacity = law.mu * solved.response.normal
        start = target
    assert solved is not None
    return point, solved


def _step(span: Span, point: Point, plan: Plan, capacity: F8 | None) -> Solved:
    """One load step with its events and, where it does not settle, its fallbacks in order."""
    if capacity is not None and span.solve is solve_step:
        span = replace(span, solve=partial(solve_step, capacity=capacity.copy()))
        solved = span.whole(point)
        span = replace(span, solve=solve_step)
        if not solved.settled:
            solved = span.whole(point)
    else:
        solved = span.whole(point)
    if solved.settled:
        return split_at_closings(span, point, solved) if plan.events else solved
    if not plan.ramp or _needs_digits(span, solved):
        return solved
    return _fallbacks(span, point, solved)


def _needs_digits(span: Span, solved: Solved) -> bool:
    """A factor with more digits is to be tried first: a ramp changes the answer."""
    structure = span.structure
    if structure.extended is not None or solved.unbounded:
        return False
    return is_lossy(structure, solved.response, span.target)


def _fallbacks(span: Span, point: Point, first: Solved) -> Solved:
    """Ramping, then the status iteration with freezing; the first cause stands if all fail."""
    if first.unbounded:
        return first
    is_status = span.solve is solve_status
    short = partial(solve_status, passes=LAST_PASSES)
    if is_status:
        span = replace(span, solve=short)
    for n in RAMPS:
        if not (span.law.mu > 0.0).any():
            break  # without history a ramp ends where one step does
        solved = _ramp(span, point, n)
        if solved.settled:
            span.history.notes.append(
                f"solved in {n} {SUB_STEPS} because one step did not settle: "
                "with friction this is the answer of a ramped load"
            )
            return solved
        if solved.unbounded:
            return first
    if not is_status:
        solved = replace(span, solve=short).whole(point)
        if solved.settled:
            note = "solved by the status iteration because newton did not settle"
            span.history.notes.append(note)
            return solved
        release(span.structure)
    return first


def _ramp(span: Span, point: Point, n: int) -> Solved:
    """Go to the target in n equal sub-steps, datums committed at each."""
    point.become(span.before)
    for i in range(n):
        solved = span.part(point, (i + 1) / n)
        if not solved.settled:
            return solved
        if i < n - 1:
            span = replace(span, law=span.committed(solved))
    return solved
