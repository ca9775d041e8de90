"""How many digits a factor and an answer are good for."""

from dataclasses import dataclass
from math import log10

import numpy as np

from trunnion import kernels
from trunnion.arrays import F8, SLIP
from trunnion.solver.coupled import coupled_step
from trunnion.solver.newton import TINY_PIVOT, tangent_factor
from trunnion.solver.quantities import Forcing, Point, Response, Sliding
from trunnion.solver.structure import Structure

FREEDOMS = ("X", "Y", "Z", "RX", "RY", "RZ")
DIGITS = 15.9  # of a double
BLIND = 1e-4  # the same, above which refinement cannot see what is left
POOR = 1e-6  # correction of a solution by its own residual: fewer than six digits a solve


def is_lossy(structure: Structure, response: Response, forcing: Forcing) -> bool:
    """Tell whether the factor of these tangents solves to fewer than six digits."""
    tangent_factor(structure, response)
    load = structure.residual(Point.zero(structure.n_node), structure.frictionless(), forcing)[0]
    load[structure.absent] = 0.0
    return not _loss(structure, load, structure.solve(load)) <= POOR


def _loss(structure: Structure, load: F8, p: F8) -> float:
    """Part of a solution p that its own residual, formed from deformations, takes back.

    What is corrected is what the factor got wrong (Wilkinson 1963, iterative refinement).
    """
    held = structure.held
    assert held is not None
    if held[2] > 0.0:  # it solves another matrix
        return 0.0 if _is_singular(structure) else np.inf
    correction = structure.solve(load - structure.product(held[0], held[1], p))
    return travel(structure, correction) / max(travel(structure, p), 1e-300)


def _is_singular(structure: Structure) -> bool:
    """Tell whether tangents that needed a shift have motions without stiffness in 32 digits, too.

    The factor is left as it was.
    """
    held = structure.held
    assert held is not None
    if structure.extended is not None:
        return True
    found = has_stiffness(structure, held[0], held[1])
    structure.factorise(*held)
    return found is not True


def has_stiffness(structure: Structure, tangent: F8, slider_tangent: F8) -> bool | None:
    """Tell whether tangents are positive definite in 32 digits; None where that takes too long.

    Doubles take very soft ways of a structure with very stiff ones for no stiffness at all.  The
    factor at hand is gone afterwards.
    """
    before = structure.extended is not None
    if not structure.extend(True):
        return None
    try:
        return structure.factorise(tangent, slider_tangent) and structure.rcond > TINY_PIVOT
    finally:
        structure.extend(before)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Scattered:
    """What errors of one part in the input do to the displacements of an answer.

    p : (n_node, 6) movements they cause, in parts; linear in the loads where nothing can change.
    loss : part of such a solution that the factor gets wrong.
    """

    p: F8
    loss: float


def scatter_input(
    structure: Structure, point: Point, law: Sliding, forcing: Forcing, response: Response
) -> Scattered:
    """Change what an answer stands on by up to one part, with scattered signs.

    Every member's end forces are changed as a change of its stiffness by one part would do (rigid
    motion makes no force, so none is made of it), and so are those that would hold back its free
    deformation, the moments of its forces about its base (as its direction is rounded), the
    forces of supports and the loads at nodes.  Where supports slide, their directions and gaps are
    changed, too: what that adds to a normal force, friction passes on to pipes of any softness.
    """
    members = structure.members
    load = _scattered(point.u.size, 2).reshape(-1, 6) * forcing.nodal
    for start, at in enumerate((point, Point.zero(structure.n_node))):
        end = structure.member_forces(at, forcing, np.zeros_like(load))
        if len(end):
            signs = _scattered(len(end), start)
            kernels.add_ends(members.ends, signs, members.d, at is point, end, load)
    pushed = _scattered(len(response.reaction), 3)[:, None] * response.reaction
    kernels.scatter(structure.at, pushed, load)
    load[structure.absent] = 0.0
    p = structure.solve(load)
    loss = _loss(structure, load, p)
    if (response.mode == SLIP).any():
        more = _misplaced(structure, point, response)
        kernels.scatter(structure.at, more, load)
        kernels.scatter(structure.slider_at, _rubbed(structure, response, pushed + more), load)
        load[structure.absent] = 0.0
        p = coupled_step(structure, response, law, load)
    return Scattered(p, loss)


def _misplaced(structure: Structure, point: Point, response: Response) -> F8:
    """Change of contact forces (n_contact, 3) as directions and gaps are rounded.

    A direction wrong by a part feels that part of any movement, also of one across it.  Where a
    gap is closed, or a movement is imposed, the movement is that size itself.
    """
    moved = kernels.gather(structure.at, point.u)
    moved *= _scattered(moved.size, 4).reshape(moved.shape)
    force: F8 = np.einsum("cij,cj->ci", response.tangent, moved)
    return force


def _rubbed(structure: Structure, response: Response, pushed: F8) -> F8:
    """Change of friction (n_slider, 3) where it slips and contact forces change by `pushed`."""
    s = structure.sliders
    owner = np.repeat(np.arange(len(s.mu)), np.diff(s.first))
    push, more = np.zeros((2, len(s.mu), 3))
    np.add.at(push, owner, response.reaction[s.contact])
    np.add.at(more, owner, pushed[s.contact])
    size = (push * push).sum(axis=1)
    slips = (response.mode == SLIP) & (size > 0.0)
    share = np.divide((push * more).sum(axis=1), size, out=np.zeros_like(size), where=slips)
    force: F8 = share[:, None] * response.friction
    return force


def digits_left(
    structure: Structure, size: float, scattered: Scattered, correction: float
) -> tuple[float, str, bool]:
    """Digits of the displacements that do not hang on the last bit of the input.

    What errors of one part in the input move, of the largest displacement, is the number of parts
    that they cost: a structured condition number in the sense of Skeel (1979).

    Parameters
    ----------
    size : of the displacements, see `travel` [m].
    correction : the next correction of the displacements, relative: digits not reached.

    Returns
    -------
    Digits left of the 16 that doubles have, the freedom that loses most ("node 40 RX"), and
    whether the factor solves so badly that no correction found with it can be trusted.
    """
    moved = np.abs(scattered.p) * structure.levers
    node, freedom = np.unravel_index(int(moved.argmax()), moved.shape)
    name = f"node {structure.system.labels[structure.kept[node]]} {FREEDOMS[freedom]}"
    lost = max(log10(max(float(moved[node, freedom]) / max(size, 1e-300), 1.0)), 0.0)
    reached = -log10(max(correction, 1e-300))
    return min(DIGITS - lost, reached), name, not scattered.loss <= BLIND


def _scattered(n: int, start: int) -> F8:
    """Signs and sizes from 0.5 to 1 without order (Weyl); numpy.random would be imported for it."""
    share = np.arange(1, n + 1) * (0.5 * (5.0**0.5 - 1.0)) + 0.37 * start
    share -= np.floor(share)
    signs: F8 = np.where(share < 0.5, -0.5 - share, share)
    return signs


def travel(structure: Structure, p: F8) -> float:
    """Largest movement [m]; a rotation counts with what it moves over the largest element."""
    return farthest(structure, kernels.largest_moves(p))


def farthest(structure: Structure, moves: tuple[float, float]) -> float:
    """Larger of a translation [m] and what a rotation [rad] moves over the largest element."""
    length, turned = moves[0], structure.reach * moves[1]
    return length if length >= turned or length != length else turned
