"""How many digits of the displacements hold: what rounding can have done to an answer.

Refinement takes the error of the factor away, not that of the numbers it starts from: element
stiffness, directions and free expansions are rounded to doubles, each by itself.  That moves the
forces of every element by about the rounding unit of their parts, and the displacements by what
the tangent makes of it.  One solve with such forces in fixed, mixed signs is a sample of that
movement (statistical condition estimation: Kenney and Laub, 1994; a sample of the componentwise
bound of Skeel, 1979).  Friction is taken at fixed capacity.
"""

from dataclasses import dataclass

import numpy as np

from trunnion.arrays import F8
from trunnion.solver.quantities import Forcing, Point, Response
from trunnion.solver.structure import Structure

UNIT = 2.0**-53
SAFETY = 300.0  # of one sample; tests/stress measures it against exact solutions
MOST = 15.9  # digits of a double
FEW = 6.0  # digits below which the report warns
FREEDOMS = ("X", "Y", "Z", "RX", "RY", "RZ")


@dataclass(frozen=True, slots=True)
class Digits:
    """Decimal digits of the largest displacement that hold, and where most are lost."""

    left: float
    at: str  # "node 40 RX"; empty where nothing moves


def remaining_digits(
    structure: Structure, point: Point, response: Response, forcing: Forcing, correction: float
) -> Digits:
    """Estimate the digits of an answer; one solve on the factor at hand.

    Parameters
    ----------
    correction : what the last refinement left, relative to the largest displacement.
    """
    turning = np.array([1.0, 1.0, 1.0, *[structure.reach] * 3])
    size = float((np.abs(point.u) * turning).max(initial=0.0))
    if size == 0.0 or not structure.n_node:
        return Digits(MOST, "")
    moved = np.abs(structure.solve(sample_forces(structure, point, response, forcing))) * turning
    node, freedom = np.unravel_index(int(moved.argmax()), moved.shape)
    error = max(SAFETY * UNIT * float(moved[node, freedom]) / size, correction)
    left = MOST if error <= 0.0 else min(MOST, -np.log10(error))
    where = structure.system.labels[structure.kept[node]]
    # a tenth of a digit down: no more is known of it
    return Digits(
        max(0.0, float(np.floor(10.0 * left)) / 10.0), f"node {where} {FREEDOMS[freedom]}"
    )


def _signs(shape: tuple[int, ...]) -> F8:
    """+1 and -1 without a pattern, the same in every process (Knuth's multiplicative hash)."""
    n = np.arange(int(np.prod(shape)), dtype=np.uint64)
    bit = (n * np.uint64(2654435761) >> np.uint64(15)) & np.uint64(1)
    out: F8 = np.where(bit == 1, 1.0, -1.0).reshape(shape)
    return out


def sample_forces(structure: Structure, point: Point, response: Response, forcing: Forcing) -> F8:
    """Forces (n_node, 6) that rounding may leave at the nodes, in rounding units, mixed signs."""
    out = np.zeros((structure.n_node, 6))
    _members(structure, point, forcing, out)
    _supports(structure, point, response, forcing, out)
    return out


def _members(structure: Structure, point: Point, forcing: Forcing, out: F8) -> None:
    """Stiffness times deformation and free deformation, part by part, in a member's own axes.

    Rounded axes and tip vectors turn the parts of a deformation into each other.
    """
    m = structure.members
    if not len(m.ends):
        return
    i, j = m.ends[:, 0], m.ends[:, 1]
    v = (point.u[j] - point.u[i]) + (point.low[j] - point.low[i])
    v[:, :3] -= np.cross(point.u[i, 3:], m.d)
    size = np.abs(m.axes)
    local = np.concatenate([_turn(size, np.abs(v[:, :3])), _turn(size, np.abs(v[:, 3:]))], axis=1)
    local += np.abs(forcing.free)
    tip = np.matmul(np.abs(m.k), local[:, :, None])[:, :, 0]
    tip *= _signs(tip.shape)
    back = m.axes.transpose(0, 2, 1)
    force, moment = _turn(back, tip[:, :3]), _turn(back, tip[:, 3:])
    base = np.concatenate([-force, -moment - np.cross(m.d, force)], axis=1)
    for at, part in ((i, base), (j, np.concatenate([force, moment], axis=1))):
        for column in range(6):
            out[:, column] += np.bincount(at, part[:, column], len(out))


def _turn(axes: F8, v: F8) -> F8:
    out: F8 = np.matmul(axes, v[:, :, None])[:, :, 0]
    return out


def _supports(
    structure: Structure, point: Point, response: Response, forcing: Forcing, out: F8
) -> None:
    """Reactions, what rounded directions of closed contacts make of a movement, friction."""
    c = structure.contacts
    travel = np.abs(structure.gather(point.u)) + np.abs(forcing.base)
    n = np.abs(c.normal)
    rounded = np.where(n == 1.0, 0.0, n)  # unit vectors of the axes are exact
    stray = np.einsum("cai,ci->ca", rounded, travel)
    closed = np.abs(response.reaction).max(axis=1) > 0.0
    stray *= np.where(closed, c.k, 0.0)[:, None] * _signs(stray.shape)
    push = np.einsum("ca,cai->ci", stray, c.normal)
    push += np.abs(response.reaction) * _signs(push.shape)
    rub = np.abs(response.friction) * _signs(response.friction.shape)
    for at, force in ((structure.at, push), (structure.slider_at, rub)):
        columns = at[:, 3:4] + np.arange(3)
        np.add.at(out, (at[:, 0:1], columns), force)
        paired = at[:, 1] >= 0
        np.subtract.at(out, (at[paired, 1:2], columns[paired]), force[paired])
