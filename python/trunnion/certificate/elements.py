"""Balance of every element with its load, and its deformation against its end forces."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from trunnion.arrays import F8, SPRING, Loads, State, System
from trunnion.certificate import deformation
from trunnion.certificate.deformation import columns, cross, two_difference
from trunnion.certificate.items import six
from trunnion.certificate.scales import Scale, floor, largest

BLOCK = 4096  # elements at a time
SHAPE = ("ends", "kind", "axes", "length", "radius", "angle", "rigidity", "flex", "spring",
         "od", "wall", "taper")  # fmt: skip
ALONG = ("dist", "strain", "curvature", "vary")  # what Loads says of elements


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ElementErrors:
    """Relative errors (n_elem,) of balance and law, and what the law is measured against.

    own : (2, n_elem) largest deformation, by the displacements or by the forces [m, rad].
    across : (2,) the largest if the end forces were all across [m, rad].
    length, angle : largest denominators of the law [m, rad].
    """

    balance: F8
    law: F8
    own: F8
    across: F8
    length: float
    angle: float


def element_errors(system: System, loads: Loads, state: State, scale: Scale) -> ElementErrors:
    """Check every element, in blocks that stay in the processor's cache."""
    count = len(system.kind)
    if not count:
        return ElementErrors(np.zeros(0), np.zeros(0), np.zeros((2, 0)), np.zeros(2), 1.0, 1.0)
    parts = [
        _block(*_cut(system, loads, state, slice(at, at + BLOCK)), scale)
        for at in range(0, count, BLOCK)
    ]
    balances, wrongs, acrosses, owns, kin = zip(*parts, strict=True)
    own, wrong, across = (np.concatenate(a, axis=1) for a in (owns, wrongs, acrosses))
    deform, swing = own.max(axis=1)
    move, turn, free = np.max(kin, axis=0)
    length = floor(deform, max(1e-4 * move, 1e-4 * free, 1e-3 * swing))
    angle = floor(swing, max(1e-4 * turn, 1e-3 * deform))
    bent = 1e-5 * across
    law = np.maximum(wrong[0] / np.maximum(length, bent[0]), wrong[1] / np.maximum(angle, bent[1]))
    law = np.maximum(law, wrong[2])
    most = across.max(axis=1)
    length, angle = max(length, 1e-5 * float(most[0])), max(angle, 1e-5 * float(most[1]))
    return ElementErrors(np.concatenate(balances), law, own, most, length, angle)


def _cut(system: System, loads: Loads, state: State, b: slice) -> tuple[System, Loads, State]:
    """Give the elements of one block; nodes are shared."""
    if len(system.kind) <= BLOCK:
        return system, loads, state
    return (
        replace(system, **rows(system, SHAPE, b)),
        replace(loads, **rows(loads, ALONG, b)),
        replace(state, end_force=state.end_force[b]),
    )


def rows(
    record: System | Loads, names: Sequence[str], which: deformation.Index | slice
) -> dict[str, Any]:
    """Arrays of some elements by name; what a model has nothing of has no rows."""
    every = {name: getattr(record, name) for name in names}
    return {name: a[which] if len(a) else a for name, a in every.items()}


def _block(
    system: System, loads: Loads, state: State, scale: Scale
) -> tuple[F8, F8, F8, F8, tuple[float, float, float]]:
    """Errors of some elements.

    Returns
    -------
    (n,) relative error of the balance.
    (3, n) errors of the element law: translation [m], rotation [rad], and force of a spring
        where it has no stiffness, relative.
    (2, n) deformation by the element's own end force if it were all across [m, rad].  That force
        is reported to 1e-16 of itself; where it lies along the pipe, this is what the rounding of
        its direction amounts to.
    (2, n) largest deformation [m, rad].
    Largest relative movement, rotation and free expansion [m, rad, m].
    """
    start, tip = columns(state.end_force[:, 0]), columns(state.end_force[:, 1])
    d, dist = deformation.tip_vector(system), columns(loads.dist)
    sums = tip + start
    sums[:3] += dist * system.length
    sums[3:] += cross(d, tip[:3]) + deformation.load_moment(system, dist, loads.vary)
    v, law, stray, move = _deformed(system, loads, state, tip, d)
    error, size = np.abs(v - law), np.maximum(np.abs(v), np.abs(law))
    wrong = np.stack([error[:3].max(axis=0), error[3:].max(axis=0), stray / scale.force])
    own = np.stack([size[:3].max(axis=0), size[3:].max(axis=0)])
    reach, ei = system.length, system.rigidity[:, 2].copy()
    soft = np.divide(reach * system.flex, ei, out=np.zeros_like(reach), where=ei > 0.0)
    bent = soft * (reach * np.abs(tip[:3]).max(axis=0) + np.abs(tip[3:]).max(axis=0))
    kin = largest(move[:3]), largest(move[3:]), largest(loads.strain * reach)
    balance = six(sums, scale.force, scale.moment)
    return balance, wrong, np.stack([reach * bent, bent]), own, kin


def own_deformations(system: System, loads: Loads, state: State) -> F8:
    """(2, n) largest deformation of every element, by its displacements or its forces [m, rad]."""
    tip = columns(state.end_force[:, 1])
    v, law, _, _ = _deformed(system, loads, state, tip, deformation.tip_vector(system))
    size = np.maximum(np.abs(v), np.abs(law))
    return np.stack([size[:3].max(axis=0), size[3:].max(axis=0)])


def _deformed(system: System, loads: Loads, state: State, tip: F8, d: F8) -> tuple[F8, F8, F8, F8]:
    """Deformations (6, n) by the displacements and by the forces at the tip, global.

    Also (n,) forces of springs where they have no stiffness [N], and (6, n) relative movements.
    """
    i, j = system.ends.T
    here = np.take(state.u, i, axis=0)
    rows, rest = two_difference(np.take(state.u, j, axis=0), here)
    rest += np.take(state.u_low, j, axis=0) - np.take(state.u_low, i, axis=0)
    move, turn = columns(rows), columns(here[:, 3:])
    law, stray = deformation.expected(system, loads, tip), np.zeros(len(i))
    spring = np.flatnonzero(system.kind == SPRING)
    if spring.size:
        turn[:, spring] += 0.5 * move[3:, spring]
    v = move.copy()
    v[:3] -= cross(turn, d)
    v += columns(rest)
    if spring.size:
        growth = loads.strain[spring] * system.length[spring]
        v[:, spring], law[:, spring], stray[spring] = _spring(system, v, tip, d, spring)
        v[0, spring] -= growth  # of an expansion joint
    return v, law, stray, move


def _spring(system: System, v: F8, tip: F8, d: F8, at: deformation.Index) -> tuple[F8, F8, F8]:
    """Deformation at mid-distance, force over stiffness, and force where there is none."""
    k = system.spring[at].T
    middle = tip[3:, at] + 0.5 * cross(d[:, at], tip[:3, at])
    own = [
        np.concatenate([np.einsum("nij,jn->in", system.axes[at], x) for x in pair])
        for pair in ((v[:3, at], v[3:, at]), (tip[:3, at], middle))
    ]
    held = k > 0.0
    law = np.divide(own[1], k, out=np.array(own[0]), where=held)
    return own[0], law, np.where(held, 0.0, np.abs(own[1])).max(axis=0)
