"""From a settled point to reported numbers: refinement, state, corrections, penalty effect."""

from dataclasses import dataclass, replace

import numpy as np

from trunnion.arrays import ENGAGED, F8, OPEN, SLIP, State
from trunnion.solver.convergence import judge
from trunnion.solver.coupled import coupled_step
from trunnion.solver.digits import digits_left
from trunnion.solver.newton import tangent_factor
from trunnion.solver.quantities import Forcing, Point, Response, Sliding
from trunnion.solver.structure import Structure

REFINEMENTS = 8
SHARP = 1e-13  # next correction that ends the refinement, relative
CHORD = 1e-4  # difference of slider tangents for which the factor at hand will do
NOTHING = 1e-6  # a displacement that the penalty effect does not speak of [m]


@dataclass(slots=True, eq=False, repr=False)
class Reported:
    """Numbers of one case and what the certificate and the report need beside them."""

    state: State
    correction_u: float
    correction_r: float
    penalty_u: F8
    penalty_r: F8
    penalty_effect: dict[str, float]
    digits: tuple[float, str]  # left of 16, and the freedom that lost most
    blind: bool  # the corrections were found with a factor that has no digits
    singular: bool  # the tangent at the answer needed a proximal term
    broken: str | None  # the convergence rule that the last two iterations do not meet


def report_numbers(
    structure: Structure, point: Point, sliding: Sliding, forcing: Forcing
) -> Reported:
    """Refine a settled point in double-double and measure what is left to correct."""
    law = replace(sliding, capacity=sliding.capacity.copy(), coupled=True)
    structure.ledger.refining = True
    try:
        bias = structure.unbiased()
        r, every, end, response = structure.exact(point, law, forcing, bias)
        best = (np.inf, np.inf)
        shift = 0.0
        for i in range(REFINEMENTS):
            shift = max(shift, _factor(structure, response))
            p = coupled_step(structure, response, law, r)
            trial = point.copy()
            trial.move(p)
            after = structure.exact(trial, law, forcing, bias)
            left = corrections(structure, p, point, response, after[3])
            # a reaction is a difference of displacements: it may lag behind them by one pass
            better = any(new < old for new, old in zip(left, best, strict=True))
            if not better or max(left) <= SHARP or i == REFINEMENTS - 1:
                break
            best = left
            point.become(trial)
            r, every, end, response = after
        broken = judge(response, after[3], p, None, point.u).broken
        penalty_u, penalty_r, effect = _penalty(structure, point, response)
        left_over, where, blind = digits_left(structure, point, law, forcing, response, left[0])
        digits = left_over, where
    finally:
        structure.ledger.refining = False
    state = _state(structure, every, law, response, end)
    return Reported(state, *left, penalty_u, penalty_r, effect, digits, blind, shift > 0.0, broken)


def _factor(structure: Structure, response: Response) -> float:
    """Renew the factor unless the one at hand differs by a small turn of sliding only."""
    held = structure.held
    if held is not None and np.array_equal(held[0], response.tangent) and held[2] == 0.0:
        stiff = float(structure.sliders.kf.max(initial=0.0))
        if np.abs(held[1] - response.slider_tangent).max(initial=0.0) <= CHORD * stiff:
            return 0.0
    return tangent_factor(structure, response)


def corrections(
    structure: Structure, p: F8, point: Point, before: Response, after: Response
) -> tuple[float, float]:
    """Size of a correction p relative to the largest displacement and reaction."""
    u = _travel(structure, point.u)
    du = _travel(structure, p)
    rubbed = after.friction - before.friction
    pushed = after.reaction - before.reaction
    return du / max(u, 1e-300), _relative(structure, pushed, before, rubbed)


def _relative(
    structure: Structure, change: F8, response: Response, rubbed: F8 | None = None
) -> float:
    """Change of reactions (and friction) relative to the largest force and moment."""
    rotational = structure.contacts.rotational
    force = max(1.0, _largest(response.reaction[~rotational]))
    moment = max(force, _largest(response.reaction[rotational]))
    slide = 0.0 if rubbed is None else _largest(rubbed) / force
    return max(_largest(change[~rotational]) / force, _largest(change[rotational]) / moment, slide)


def _travel(structure: Structure, u: F8) -> float:
    """Largest displacement, or what the largest rotation moves over the largest element [m]."""
    move, turn = _largest(u[:, :3]), _largest(u[:, 3:])
    return max(move, turn * structure.reach)


def _largest(a: F8) -> float:
    return float(np.abs(a).max(initial=0.0))


def _penalty(
    structure: Structure, point: Point, response: Response
) -> tuple[F8, F8, dict[str, float]]:
    """First-order corrections to rigid supports.

    One solve on the same factor with the reactions as loads on the closed contacts: a step of
    the method of multipliers (Hestenes 1969), after which the penetration is of second order.
    """
    c = structure.contacts
    n = len(structure.system.contacts.node)
    closed = c.penalty & (np.abs(response.reaction).max(axis=1) > 0.0)
    load = np.zeros_like(point.u)
    pushed = np.where(closed[:, None], response.reaction, 0.0)
    structure.scatter(pushed, load)
    du = structure.solve(load)
    dw = structure.gather(du)
    dr = pushed - np.einsum("cij,cj->ci", response.tangent, dw)
    effect = {
        "u": _travel(structure, du) / max(_travel(structure, point.u), NOTHING),
        "R": _relative(structure, dr, response),
    }
    return structure.expand(du), dr[:n], effect


def _state(structure: Structure, point: Point, law: Sliding, response: Response, end: F8) -> State:
    n = len(structure.system.contacts.node)
    m = len(structure.system.sliders.node)
    smooth = (response.mode == OPEN) & (response.normal > 0.0)  # pressed, but mu is 0 here
    return State(
        u=point.u,
        u_low=point.low,
        end_force=end,
        side=response.side[:n],
        reaction=response.reaction[:n],
        friction=response.friction[:m],
        mode=np.where(smooth, ENGAGED, response.mode)[:m].astype(np.int32),
        normal=response.normal[:m],
        slide=response.slide[:m],
        datum=law.datum[:m].copy(),
        datum_end=commit(law.datum, law.kf, response)[:m],
    )


def commit(datum: F8, kf: F8, response: Response) -> F8:
    """The datum after a converged step: moved by what slipped, following the pipe where open."""
    stiff = np.where(kf > 0.0, kf, 1.0)[:, None]
    slipped = response.slide + response.friction / stiff
    move = np.where((response.mode == SLIP)[:, None], slipped, 0.0)
    out: F8 = datum + np.where((response.mode == OPEN)[:, None], response.slide, move)
    return out
