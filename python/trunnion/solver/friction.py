"""Friction by convex steps: capacities from normal forces, renewed until they agree.

1.  Without friction, by full steps: normal forces, and how far each support would slide.
2.  With the capacities mu N and stick stiffnesses first softened to about capacity over slide,
    then stiffened tenfold a stage to their own (smoothing continuation of the Huber energy, as
    in total-variation solvers); capacities are renewed at every stage.
3.  Renewals at full stiffness until the change is small, then the coupled consistent step.
"""

from dataclasses import dataclass, replace

import numpy as np

from trunnion import kernels
from trunnion.arrays import F8
from trunnion.solver.capacities import STEPS, average, settle
from trunnion.solver.coupled import coupled_step
from trunnion.solver.history import History
from trunnion.solver.newton import FULL_STEPS, Outcome, relax, tangent_factor
from trunnion.solver.quantities import Forcing, Point, Response, Sliding
from trunnion.solver.structure import Structure

STIFFEN = 10.0  # factor of the stick stiffness from stage to stage
LOOSE, CLOSE = 0.3, 3e-3  # out-of-balance force of a stage and of a renewal, of the capacity
RENEWALS = 40
PROGRESS, STALLED = 0.8, 4  # a renewal that gains less stalls; so many in a row end the plain way
BLIND = 6  # averaged steps where no part of a damped one helps
COUPLED = 12  # consistent steps in a row
STICKY = 1e300  # a capacity that is never reached


@dataclass(slots=True)
class Solved:
    """How a step ended; `point` was moved to it."""

    settled: bool
    response: Response
    sliding: Sliding
    cause: str | None = None
    unbounded: bool = False  # nothing holds the pipe: it moves away


def solve_step(
    structure: Structure,
    point: Point,
    sliding: Sliding,
    forcing: Forcing,
    history: History,
    capacity: F8 | None = None,
) -> Solved:
    """Solve one load step from its committed datum; `capacity` skips the search for a start.

    What moves away without bound is tried once more with room for a pipe that is only very soft.
    """
    start = point.copy()
    solved = _solve_step(structure, point, sliding, forcing, history, capacity)
    if not solved.unbounded:
        return solved
    structure.soft = True
    try:
        again = _solve_step(structure, start, sliding, forcing, history, capacity)
    finally:
        structure.soft = False
    if not again.settled:
        return solved
    point.become(start)
    return again


def _solve_step(
    structure: Structure,
    point: Point,
    sliding: Sliding,
    forcing: Forcing,
    history: History,
    capacity: F8 | None,
) -> Solved:
    has_friction = bool((sliding.mu > 0.0).any())
    free = replace(sliding, capacity=np.zeros_like(sliding.mu), coupled=False)
    start = point.copy()
    if capacity is None:
        outcome = without_friction(structure, point, free, forcing, history)
        if not has_friction:
            if outcome.settled:
                return Solved(True, outcome.response, free)
            return _unsettled(outcome, free)
        if outcome.settled:
            capacity = sliding.mu * outcome.response.normal
            outcome = smooth(structure, point, sliding, forcing, history, outcome, capacity)
            capacity = sliding.mu * outcome.response.normal
    solved = None
    if capacity is not None:
        solved = renew(structure, point, _fixed(sliding, capacity), forcing, history)
        if solved.settled or solved.unbounded:
            return solved
    point.become(start)
    outcome = all_stuck(structure, point, sliding, forcing, history)
    capacity = sliding.mu * outcome.response.normal
    again = renew(structure, point, _fixed(sliding, capacity), forcing, history)
    return again if again.settled or solved is None else solved


def _fixed(sliding: Sliding, capacity: F8) -> Sliding:
    return replace(sliding, capacity=capacity.copy(), coupled=False)


def without_friction(
    structure: Structure, point: Point, free: Sliding, forcing: Forcing, history: History
) -> Outcome:
    """Contacts alone: convex, so the displacements are unique wherever the structure is held."""
    return relax(
        structure,
        point,
        free,
        forcing,
        tolerance=1e-9 * force_scale(structure, forcing),
        history=history,
        what="no friction",
        full_steps=FULL_STEPS,
    )


def all_stuck(
    structure: Structure, point: Point, sliding: Sliding, forcing: Forcing, history: History
) -> Outcome:
    """Every support stuck: the start where the pipe moves away without friction."""
    capacity = np.where(sliding.mu > 0.0, STICKY, 0.0)
    return relax(
        structure,
        point,
        replace(sliding, capacity=capacity, coupled=False),
        forcing,
        tolerance=1e-9 * force_scale(structure, forcing),
        history=history,
        what="all stuck",
    )


def smooth(
    structure: Structure,
    point: Point,
    sliding: Sliding,
    forcing: Forcing,
    history: History,
    outcome: Outcome,
    capacity: F8,
) -> Outcome:
    """Stages of stiffening stick springs from a frictionless answer to the last softened one."""
    travel = np.linalg.norm(outcome.response.slide, axis=1)
    slid = float((travel * (capacity > 0.0)).sum())
    if slid <= 0.0 or outcome.runaway:
        return outcome
    soft = float(capacity.sum()) / slid
    full = float(sliding.kf.max())
    first = True
    while soft * STIFFEN**0.5 < full:
        stage = replace(sliding, capacity=capacity, kf=np.minimum(sliding.kf, soft), coupled=False)
        outcome = relax(
            structure,
            point,
            stage,
            forcing,
            tolerance=LOOSE * max(1e-3, float(capacity.max())),
            history=history,
            what=f"stick spring {soft:.0e}",
            full_steps=FULL_STEPS if first else 0,
        )
        if outcome.runaway:
            return outcome
        capacity = sliding.mu * outcome.response.normal
        soft, first = soft * STIFFEN, False
    return outcome


def renew(
    structure: Structure, point: Point, sliding: Sliding, forcing: Forcing, history: History
) -> Solved:
    """Renew the capacities from the normal forces until they agree, then couple them."""
    change, best, stalled = np.inf, np.inf, 0
    error = np.zeros_like(sliding.capacity)
    for i in range(RENEWALS):
        size = max(1e-3, float(sliding.capacity.max(initial=0.0)))
        outcome = relax(
            structure,
            point,
            sliding,
            forcing,
            tolerance=min(CLOSE * size, 0.1 * change) if i else CLOSE * size,
            history=history,
            what="capacities",
        )
        if not outcome.settled:
            return _unsettled(outcome, sliding)
        new = sliding.mu * outcome.response.normal
        last, error = error, new - sliding.capacity
        change = float(np.abs(error).max(initial=0.0))
        grows = change > best and kernels.inner(error, last) > 0.0  # as a self-locking one does
        stalled = 0 if change < PROGRESS * best else stalled + (not grows)
        best = min(best, change)
        if stalled >= STALLED or i == RENEWALS - 1:
            break
        sliding.capacity = new
        coupled = finish(structure, point, sliding, forcing, history)
        if coupled is not None:
            return coupled
    return damped(structure, point, sliding, forcing, history, outcome.response)


def damped(
    structure: Structure,
    point: Point,
    sliding: Sliding,
    forcing: Forcing,
    history: History,
    response: Response,
) -> Solved:
    """Renew by damped steps, each followed by a try of the coupled law."""
    blind = 0
    for _ in range(STEPS):
        better = None if blind else settle(structure, point, sliding, forcing, history, response)
        if better is None:
            blind = (blind + 1) % BLIND
            better = average(structure, point, sliding, forcing, history, response)
        response = better
        coupled = finish(structure, point, sliding, forcing, history)
        if coupled is not None:
            return coupled
    return Solved(False, response, sliding, "the normal forces do not settle")


def finish(
    structure: Structure, point: Point, sliding: Sliding, forcing: Forcing, history: History
) -> Solved | None:
    """Consistent steps of the coupled law; None, and `point` as it was, when they do not pull."""
    law = replace(sliding, capacity=sliding.capacity.copy(), coupled=True)
    trial = point.copy()
    r, _, response = structure.residual(trial, law, forcing)
    scale = force_scale(structure, forcing)
    residual = float(np.abs(r).max())
    for _ in range(COUPLED):
        tangent_factor(structure, response)
        p = coupled_step(structure, response, law, r)
        trial.move(p)
        before = response
        r, _, response = structure.residual(trial, law, forcing)
        history.add("coupled", residual, 1.0, before, response)
        last, residual = residual, float(np.abs(r).max())
        if residual <= 1e-11 * scale:
            point.become(trial)
            return Solved(True, response, law)
        if residual > 0.5 * last:
            return None
    return None


def force_scale(structure: Structure, forcing: Forcing) -> float:
    """A force that round-off is measured against: loads, and strains times stiffness [N]."""
    scale = max(1.0, float(np.abs(forcing.nodal).max(initial=0.0)))
    scale = max(scale, float(np.abs(forcing.resultant).max(initial=0.0)))
    if len(structure.members.k):
        thermal = np.einsum("eij,ej->ei", structure.members.k, forcing.free)
        scale = max(scale, float(np.abs(thermal).max()))
    moved = np.abs(forcing.base).max(axis=1, initial=0.0) * structure.contacts.k
    return max(
        scale, float(moved.max(initial=0.0)), float(np.abs(forcing.preload).max(initial=0.0))
    )


def _unsettled(outcome: Outcome, law: Sliding) -> Solved:
    cause = f"the iteration stopped with {outcome.residual:.3g} N out of balance"
    if outcome.runaway:
        cause = "the pipe moves away without bound: a mechanism under this load"
    return Solved(False, outcome.response, law, cause, outcome.runaway)
