"""Capacities that plain renewal cannot settle: a damped Newton iteration on c = mu N(c).

For capacities c held fixed the answer is unique wherever the structure is held, and N(c) is
continuous and bounded; so some c agrees with its own normal forces (Brouwer).  Plain renewal,
c := mu N(c), may cycle around it, typically between a support that sticks and one that slips.
Here each c is a point, its error is mu N(c) - c, and a step is taken only as far as the error
falls: towards the capacities that the consistent tangent at N(c) predicts, else towards mu N.
"""

from dataclasses import replace

import numpy as np

from trunnion.arrays import F8, SLIP
from trunnion.solver.coupled import coupled_step
from trunnion.solver.history import History
from trunnion.solver.newton import Outcome, relax, tangent_factor
from trunnion.solver.quantities import Forcing, Point, Response, Sliding
from trunnion.solver.structure import Structure

STEPS = 40
PARTS = (1.0, 0.5, 0.25, 0.1, 0.03, 0.01)  # of a step, tried in turn
FALL = 0.2  # of the part: how much of the error a step must take away
MEAN = 0.3  # part of a step that is taken blindly
SHARP = 1e-3  # out-of-balance force of an inner answer, of the error it is to show


def settle(
    structure: Structure,
    point: Point,
    sliding: Sliding,
    forcing: Forcing,
    history: History,
    response: Response,
) -> Response | None:
    """Move `point` and `sliding.capacity` one step towards agreement; None if no part of it helps.

    `response` is that of the answer at `sliding.capacity`.
    """
    error = sliding.mu * response.normal - sliding.capacity
    size = float(np.abs(error).max())
    for target in _targets(structure, point, sliding, forcing, response):
        for part in PARTS:
            law = replace(
                sliding,
                capacity=np.maximum(sliding.capacity + part * (target - sliding.capacity), 0.0),
            )
            trial = point.copy()
            outcome = _inner(structure, trial, law, forcing, history, size)
            left = law.mu * outcome.response.normal - law.capacity
            if outcome.settled and np.abs(left).max() <= (1.0 - FALL * part) * size:
                point.become(trial)
                sliding.capacity = law.capacity
                return outcome.response
    return None


def average(
    structure: Structure,
    point: Point,
    sliding: Sliding,
    forcing: Forcing,
    history: History,
    response: Response,
) -> Response:
    """Go a part of the way to mu N whatever the error does: out of a dead end of `settle`."""
    error = sliding.mu * response.normal - sliding.capacity
    sliding.capacity = np.maximum(sliding.capacity + MEAN * error, 0.0)
    size = float(np.abs(error).max())
    return _inner(structure, point, sliding, forcing, history, size).response


def _inner(
    structure: Structure,
    point: Point,
    sliding: Sliding,
    forcing: Forcing,
    history: History,
    size: float,
) -> Outcome:
    return relax(
        structure,
        point,
        sliding,
        forcing,
        tolerance=SHARP * max(size, 1e-6 * float(sliding.capacity.max(initial=0.0))),
        history=history,
        what="damped capacities",
    )


def _targets(
    structure: Structure, point: Point, sliding: Sliding, forcing: Forcing, response: Response
) -> tuple[F8, F8]:
    """Capacities that the consistent tangent predicts, and those of plain renewal."""
    plain = sliding.mu * response.normal
    error = plain - sliding.capacity
    r = structure.residual(point, sliding, forcing)[0]
    size = np.sqrt((response.friction**2).sum(axis=1))
    slips = (response.mode == SLIP) & (size > 0.0)
    along = np.where(slips, error / np.where(slips, size, 1.0), 0.0)
    force = along[:, None] * response.friction
    s = structure.sliders
    np.add.at(r[:, :3], s.node, force)
    paired = s.cnode >= 0
    np.subtract.at(r[:, :3], s.cnode[paired], force[paired])
    tangent_factor(structure, response)
    p = coupled_step(structure, response, sliding, r)
    return plain + sliding.mu * _normal_change(structure, response, p), plain


def _normal_change(structure: Structure, response: Response, p: F8) -> F8:
    """Change of every slider's normal force for a change p of the displacements."""
    s = structure.sliders
    change = -np.einsum("cij,cj->ci", response.tangent, structure.gather(p))
    owner = np.repeat(np.arange(len(s.mu)), np.diff(s.first))
    push, more = (
        np.stack([np.bincount(owner, a[s.contact[: len(owner)], i], len(s.mu)) for i in range(3)])
        for a in (response.reaction, change)
    )
    length = np.sqrt((push**2).sum(axis=0))
    out: F8 = (push * more).sum(axis=0) / np.where(length > 0.0, length, 1.0)
    return out
