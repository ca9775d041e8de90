"""From a settled point to reported numbers: refinement, state, corrections, penalty effect."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import NamedTuple

import numpy as np

from trunnion import kernels
from trunnion.arrays import ENGAGED, F8, OPEN, SLIP, State
from trunnion.solver.convergence import judge
from trunnion.solver.coupled import coupled_step
from trunnion.solver.digits import Scattered, digits_left, farthest, scatter_input, travel
from trunnion.solver.members import expand
from trunnion.solver.newton import tangent_factor
from trunnion.solver.quantities import Forcing, Point, Response, Sliding
from trunnion.solver.structure import Structure

REFINEMENTS = 8
SHARP = 1e-13  # next correction that ends the refinement, relative
BALANCED = 1e-12  # out-of-balance force that does, too, of the largest support force
CHORD = 1e-4  # difference of slider tangents for which the factor at hand will do
NOTHING = 1e-6  # a displacement that the penalty effect does not speak of [m]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Terms:
    """What is linear in the loads where no contact can change: sums of answers sum it.

    u, rigid_u : (n_node, 6) displacements and how rigid supports would change them, at the nodes
        of the equations.
    reaction, rigid_r : (n_contact, 3) the same of the contacts, stand-ins included.
    scattered : what errors in the input would do.
    """

    u: F8
    rigid_u: F8
    reaction: F8
    rigid_r: F8
    scattered: Scattered

    def sizes(self, structure: Structure) -> "Sizes":
        """What changes are measured against."""
        return Sizes(travel(structure, self.u), *support_sizes(structure, self.reaction))

    def penalty_effect(
        self, structure: Structure, sizes: "Sizes", moves: tuple[float, float]
    ) -> dict[str, float]:
        """Relative change of displacements and reactions on rigid supports.

        Parameters
        ----------
        moves : of all nodes of the model: those of the equations may be supports alone.
        """
        moved = travel(structure, self.rigid_u) / max(farthest(structure, moves), NOTHING)
        pushed, turned = kernels.largest_forces(structure.at, self.rigid_r)
        return {"u": moved, "R": max(pushed / sizes.force, turned / sizes.moment)}


class Sizes(NamedTuple):
    """Largest displacement (or what the largest rotation moves), force and moment of supports."""

    travel: float
    force: float
    moment: float


@dataclass(slots=True, eq=False, repr=False)
class Reported:
    """Numbers of one case and what the certificate and the report need beside them."""

    state: State
    correction_u: float
    correction_r: float
    rigid: Callable[[], F8]
    penalty_r: F8
    moves: tuple[float, float]  # largest translation and rotation of all nodes [m, rad]
    penalty_effect: dict[str, float]
    digits: tuple[float, str]  # left of 16, and the freedom that lost most
    blind: bool  # the corrections were found with a factor that has no digits
    singular: bool  # the tangent at the answer needed a proximal term
    broken: str | None  # the convergence rule that the last two iterations do not meet
    terms: Terms


def report_numbers(
    structure: Structure, point: Point, sliding: Sliding, forcing: Forcing
) -> Reported:
    """Refine a settled point in double-double and measure what is left to correct."""
    law = replace(sliding, capacity=sliding.capacity.copy(), coupled=True)
    structure.ledger.refining = True
    try:
        bias = structure.unbiased()
        r, every, end, response = structure.exact(point, law, forcing, bias)
        before, best = None, (np.inf, np.inf, np.inf)
        for i in range(REFINEMENTS):
            shift = _factor(structure, response)
            p = coupled_step(structure, response, law, r)
            trial = point.copy()
            trial.move(p)
            then = structure.respond(trial, law, forcing, np.zeros_like(r))
            left = corrections(structure, p, point, response, then)
            off = unbalance(structure, r, response)
            # a reaction is a difference of displacements, it may lag behind them by one pass, and
            # forces of short stiff pieces settle last
            seen = *left, off
            if not any(new < old for new, old in zip(seen, best, strict=True)):
                if before is not None:
                    last, every, end, response, then, p, left = before
                    point.become(last)
                    shift = _factor(structure, response)  # what follows is asked of this point
                break
            if (max(left) <= SHARP and off <= BALANCED) or i == REFINEMENTS - 1:
                break
            before, best = (point.copy(), every, end, response, then, p, left), seen
            point.become(trial)
            r, every, end, response = structure.exact(point, law, forcing, bias)
        broken = judge(response, then, p, None, point.u).broken
        rigid = _penalty(structure, point, response)
        scattered = scatter_input(structure, point, law, forcing, response)
    finally:
        structure.ledger.refining = False
    state = _state(structure, every, law, response, end)
    terms = Terms(point.u, rigid[0], response.reaction, rigid[1], scattered)
    sizes = terms.sizes(structure)
    moves = kernels.largest_moves(state.u)
    reached, where, blind = digits_left(structure, sizes.travel, scattered, left[0])
    return Reported(
        state,
        *left,
        partial(expand, structure.members, structure.system, rigid[0]),
        rigid[1][: len(structure.system.contacts.node)],
        moves,
        terms.penalty_effect(structure, sizes, moves),
        (reached, where),
        blind,
        shift > 0.0,
        broken,
        terms,
    )


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
    u = travel(structure, point.u)
    du = travel(structure, p)
    rubbed = after.friction - before.friction
    force, moment = support_sizes(structure, before.reaction)
    push, turn = kernels.largest_forces(structure.at, after.reaction - before.reaction)
    return du / max(u, 1e-300), max(push / force, turn / moment, _largest(rubbed) / force)


def unbalance(structure: Structure, r: F8, response: Response) -> float:
    """Out-of-balance force relative to the largest support force; 0 without supports' forces."""
    force, moment = kernels.largest_forces(structure.at, response.reaction)
    lever = max(moment, 0.01 * force)
    if force == 0.0:
        return 0.0
    return max(_largest(r[:, :3]) / force, _largest(r[:, 3:]) / lever)


def support_sizes(structure: Structure, reaction: F8) -> tuple[float, float]:
    """Largest force and moment of the supports, at least 1 N and that force [N, N m]."""
    force, moment = kernels.largest_forces(structure.at, reaction)
    force = max(1.0, force)
    return force, max(force, moment)


def _largest(a: F8) -> float:
    return float(np.abs(a).max(initial=0.0))


def _penalty(structure: Structure, point: Point, response: Response) -> tuple[F8, F8]:
    """First-order corrections to rigid supports: displacements and reactions.

    One solve on the same factor with the reactions as loads on the closed contacts: a step of
    the method of multipliers (Hestenes 1969), after which the penetration is of second order.
    """
    c = structure.contacts
    closed = c.penalty & (np.abs(response.reaction).max(axis=1) > 0.0)
    load = np.zeros_like(point.u)
    pushed = np.where(closed[:, None], response.reaction, 0.0)
    structure.scatter(pushed, load)
    du = structure.solve(load)
    dw = structure.gather(du)
    return du, pushed - np.einsum("cij,cj->ci", response.tangent, dw)


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
