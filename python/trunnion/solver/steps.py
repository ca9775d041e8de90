"""One case: load steps, events and fallbacks, with the datum committed after each step."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from trunnion.arrays import B1, F8, Loads
from trunnion.solver.friction import Solved, solve_step
from trunnion.solver.history import History
from trunnion.solver.quantities import Forcing, Point, Sliding
from trunnion.solver.status import release, solve_status
from trunnion.solver.structure import Structure
from trunnion.solver.verdict import commit

RAMPS = (2, 4, 8, 16, 32, 64)
EVENTS = 200  # closings located in one step, at most
LAST_PASSES = 1500  # of the status iteration where one step has failed
LOCATED = 1e-12  # of the size of the model: an opening at which a closing counts as found

Step = Callable[[Structure, Point, Sliding, Forcing, History], Solved]


@dataclass(slots=True, eq=False, repr=False)
class Plan:
    """How a case is to be solved."""

    steps: int = 1
    events: bool = False
    iteration: str = "NEWTON"
    capacity: F8 | None = None  # start of the capacities of the first step
    ramp: bool = True  # whether ramping and freezing may be tried


@dataclass(slots=True, eq=False, repr=False)
class Origin:
    """Where a case starts: loads, displacements and committed data of the case FROM names.

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
    solve = _iteration(plan)
    capacity = plan.capacity
    start, point = origin.forcing, origin.point.copy()
    solved = None
    for i in range(plan.steps):
        target = origin.forcing.toward(forcing, (i + 1) / plan.steps)
        solved = _step(structure, point, law, start, target, solve, plan, history, capacity)
        if not solved.settled:
            break
        datum = commit(solved.sliding.datum, law.kf, solved.response)  # of the last sub-step
        law = replace(solved.sliding, datum=datum)
        capacity = law.mu * solved.response.normal
        start = target
    assert solved is not None
    return point, solved


def _iteration(plan: Plan) -> Step:
    return solve_status if plan.iteration == "STATUS" else solve_step


def _step(
    structure: Structure,
    point: Point,
    law: Sliding,
    start: Forcing,
    target: Forcing,
    solve: Step,
    plan: Plan,
    history: History,
    capacity: F8 | None,
) -> Solved:
    """One load step with its events and, where it does not settle, its fallbacks in order."""
    before = point.copy()
    if capacity is not None and solve is solve_step:
        solved = solve_step(structure, point, law, target, history, capacity.copy())
    else:
        solved = solve(structure, point, law, target, history)
    if not solved.settled and capacity is not None:
        _return(point, before)
        solved = solve(structure, point, law, target, history)
    if solved.settled:
        if plan.events:
            return _events(structure, point, law, start, target, solve, history, before, solved)
        return solved
    if not plan.ramp:
        return solved
    return _fallbacks(structure, point, law, start, target, solve, history, before, solved)


def _fallbacks(
    structure: Structure,
    point: Point,
    law: Sliding,
    start: Forcing,
    target: Forcing,
    solve: Step,
    history: History,
    before: Point,
    first: Solved,
) -> Solved:
    """Ramping, then the status iteration with freezing; the first cause stands if all fail."""
    if "without bound" in (first.cause or ""):
        return first
    is_status = solve is solve_status
    if is_status:
        solve = partial(solve_status, passes=LAST_PASSES)
    for n in RAMPS:
        if not (law.mu > 0.0).any():
            break  # without history a ramp ends where one step does
        _return(point, before)
        solved = _ramp(structure, point, law, start, target, solve, history, n)
        if solved.settled:
            history.notes.append(
                f"solved in {n} sub-steps because one step did not settle: "
                "with friction this is the answer of a ramped load"
            )
            return solved
        if "without bound" in (solved.cause or ""):
            return first
    if not is_status:
        _return(point, before)
        solved = solve_status(structure, point, law, target, history, passes=LAST_PASSES)
        if solved.settled:
            history.notes.append("solved by the status iteration because newton did not settle")
            return solved
        release(structure)
    return first


def _ramp(
    structure: Structure,
    point: Point,
    law: Sliding,
    start: Forcing,
    target: Forcing,
    solve: Step,
    history: History,
    n: int,
) -> Solved:
    law = replace(law, datum=law.datum.copy())
    for i in range(n):
        part = start.toward(target, (i + 1) / n)
        solved = solve(structure, point, law, part, history)
        if not solved.settled:
            return solved
        if i < n - 1:
            datum = commit(law.datum, law.kf, solved.response)
            law = replace(law, datum=datum, capacity=np.zeros_like(law.mu), coupled=False)
    return solved


def _events(
    structure: Structure,
    point: Point,
    law: Sliding,
    start: Forcing,
    target: Forcing,
    solve: Step,
    history: History,
    before: Point,
    solved: Solved,
) -> Solved:
    """Split the step where a gapped contact with friction closes; commit there and go on."""
    watched = _watched(structure)
    if not watched.any():
        return solved
    was_open = _opening(structure, before, start) > 0.0
    for _ in range(EVENTS):
        closed = watched & was_open & (solved.response.side != 0)
        if not closed.any():
            return solved
        t = _closing(structure, law, start, target, solve, before, closed, history)
        if t is None or t >= 1.0:
            return solved
        part = start.toward(target, t)
        _return(point, before)
        solved = solve(structure, point, law, part, history)
        if not solved.settled:
            return solved
        touching = watched & (_opening(structure, point, part) <= 1e-9 * structure.size)
        names = {
            structure.system.cards[i].name for i in structure.contacts.card[touching & was_open]
        }
        history.notes.append(f"EVENT: {', '.join(sorted(names))} closes at {t:.6g} of the step")
        law = replace(
            law,
            datum=commit(law.datum, law.kf, solved.response),
            capacity=np.zeros_like(law.mu),
            coupled=False,
        )
        start, before, was_open = part, point.copy(), was_open & ~touching
        solved = solve(structure, point, law, target, history)
        if not solved.settled:
            return solved
    return solved


def _watched(structure: Structure) -> B1:
    """Contacts with a gap on which friction acts."""
    c, s = structure.contacts, structure.sliders
    owner = np.repeat(np.arange(len(s.mu)), np.diff(s.first))
    rubbed = np.zeros(len(c.k), bool)
    rubbed[s.contact[: len(owner)][s.mu[owner] > 0.0]] = True
    gap = np.where(np.isfinite(c.gap), c.gap, 0.0).max(axis=1)
    watched: B1 = rubbed & (gap > 0.0)
    return watched


def _opening(structure: Structure, point: Point, forcing: Forcing) -> F8:
    """Distance of each contact from its nearer closing; negative when closed [m]."""
    c = structure.contacts
    w = structure.gather(point.u) - forcing.base
    d = np.einsum("cai,ci->ca", c.normal, w)
    radial = np.hypot(d[:, 0], d[:, 1])
    line = np.minimum(c.gap[:, 1] - d[:, 0], d[:, 0] + c.gap[:, 0])
    out: F8 = np.where(c.dim == 2, c.gap[:, 0] - radial, line)
    return out


def _closing(
    structure: Structure,
    law: Sliding,
    start: Forcing,
    target: Forcing,
    solve: Step,
    before: Point,
    closed: B1,
    history: History,
) -> float | None:
    """Smallest load fraction at which one of the contacts closes.

    By bisection, and by the line through the last two open points; a closed contact tells
    nothing but its penetration, so the line aims at an opening just above zero.
    """
    near = LOCATED * structure.size
    open_at: list[tuple[float, float]] = [(0.0, _least(structure, before, start, closed))]
    b = 1.0
    for _ in range(60):
        a, fa = open_at[-1]
        t = 0.5 * (a + b)
        if len(open_at) > 1:
            a0, f0 = open_at[-2]
            slope = fa - f0
            aim = a + (0.5 * near - fa) * (a - a0) / slope if slope < 0.0 else t
            t = aim if a < aim < b else t
        point = before.copy()
        part = start.toward(target, t)
        if not solve(structure, point, law, part, history).settled:
            return None
        f = _least(structure, point, part, closed)
        if 0.0 < f <= near:
            return t
        if f > 0.0:
            open_at.append((t, f))
        else:
            b = t
        if b - open_at[-1][0] <= 1e-14:
            return b
    return b


def _least(structure: Structure, point: Point, forcing: Forcing, which: B1) -> float:
    return float(_opening(structure, point, forcing)[which].min())


def _return(point: Point, to: Point) -> None:
    point.u[:], point.low[:] = to.u, to.low
