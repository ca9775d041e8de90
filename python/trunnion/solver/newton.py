"""Semismooth Newton on the convex energy of supports whose friction capacities are held fixed.

Elements, contacts and sliders of fixed capacity are gradients of convex energies, so every step
of the consistent tangent with an exact line search goes down from anywhere.  Full steps settle
the open and closed contacts in far fewer passes than searched ones (they move like an active-set
method), but may cycle; so a bounded number of full steps is tried first where asked.  Searched
steps crawl along a round guide's gap, a stiff curved valley: there full steps come back.
"""

from dataclasses import dataclass

import numpy as np

from trunnion import kernels
from trunnion.arrays import F8
from trunnion.solver.history import History
from trunnion.solver.quantities import Forcing, Point, Response, Sliding
from trunnion.solver.structure import Structure

FULL_STEPS = 12  # tried before the line search takes over
CALM = 8  # searched steps without a change of state, after which full ones may return
TINY_PIVOT = 1e-14  # rcond below which the tangent counts as singular
PROXIMAL = 1e-9  # of the largest element stiffness, on the diagonal of a singular tangent
RUNAWAY = 1e3  # displacement over the size of the model that means a mechanism,
SOFT = 1e12  # and that of a soft pipe with a sound factor, before its supports hold it


@dataclass(slots=True, eq=False, repr=False)
class Outcome:
    """Where an inner iteration ended."""

    response: Response
    r: F8
    residual: float
    settled: bool
    runaway: bool = False


def relax(
    structure: Structure,
    point: Point,
    sliding: Sliding,
    forcing: Forcing,
    *,
    tolerance: float,
    history: History,
    what: str,
    full_steps: int = 0,
    limit: int = 200,
) -> Outcome:
    """Move `point` to the least energy of these capacities, to an out-of-balance force.

    Parameters
    ----------
    tolerance : largest force (moment) left at a node [N, N m].
    full_steps : number of first steps taken whole; a line search follows.
    limit : most iterations.
    """
    r, _, response = structure.residual(point, sliding, forcing)
    changing = np.zeros_like(r)
    structure.respond(point, sliding, forcing, changing, changing=True)
    calm = 0
    for i in range(limit):
        residual = float(np.abs(r).max())
        if i > 0 and residual <= tolerance:
            return Outcome(response, r, residual, True)
        shift = tangent_factor(structure, response)
        p = structure.solve(r)
        far = structure.size * (SOFT if structure.soft and not shift else RUNAWAY)
        if not np.abs(p).max() < far:
            return Outcome(response, r, residual, False, runaway=True)
        step = 1.0
        if i >= full_steps or shift:
            push = kernels.inner(r, p)
            stiff = push - shift * kernels.inner(p, p)
            step = structure.search(point, sliding, forcing, p, (push, stiff))
            if not step * np.abs(p).max() < far:
                return Outcome(response, r, residual, False, runaway=True)
        r -= step * (r - shift * p)
        kernel_part = np.zeros_like(r)
        structure.changing_product(response, p, kernel_part)
        r -= step * kernel_part + changing
        point.move(p, step)
        before, changing = response, np.zeros_like(r)
        response = structure.respond(point, sliding, forcing, changing, changing=True)
        r += changing
        if structure.extended is not None:  # its solution is rounded: not to be relied on
            r = structure.residual(point, sliding, forcing)[0]
        history.add(what, residual, step, before, response)
        same = np.array_equal(before.side, response.side)
        same = same and np.array_equal(before.mode, response.mode)
        calm = calm + 1 if same and i >= full_steps else 0
        if calm == CALM:
            full_steps, calm = i + 1 + FULL_STEPS, 0
    residual = float(np.abs(r).max())
    return Outcome(response, r, residual, residual <= tolerance)


def tangent_factor(structure: Structure, response: Response) -> float:
    """Factor the tangent of a response; returns the shift that a singular one needed."""
    sound = structure.factorise(response.tangent, response.slider_tangent)
    if sound and structure.rcond > TINY_PIVOT:
        return 0.0
    return proximal_factor(structure, response.tangent, response.slider_tangent)


def proximal_factor(structure: Structure, tangent: F8, slider_tangent: F8) -> float:
    """Factor singular tangents with a small term on the diagonal; returns that term."""
    shift = PROXIMAL * structure.scale
    for _ in range(8):
        if structure.factorise(tangent, slider_tangent, shift):
            return shift
        shift *= 100.0
    raise ArithmeticError("the stiffness cannot be factored even with a large proximal term")
