"""The certificate: whether reported numbers are an answer, checked from the numbers alone.

Imports no kernel and nothing of the solver.  Every item is the largest relative error of one law;
at most `LIMIT` passes, NaN counts as inf.  Relative to what (`scales`): forces to the largest
support force or non-thermal load, moments to the largest moment (or that force times 1 cm),
displacements to the largest displacement, deformations to the largest deformation, rotations
apart.  A quantity that is only the round-off of a larger kin is measured against a small part of
the kin (`floor`), and one that has no kin at all against 1 N, 1 N m, 1 m, 1 rad.
"""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from trunnion.arrays import F8, SPRING, Certificate, Item, Loads, State, System
from trunnion.certificate import contactlaw, deformation
from trunnion.certificate.deformation import cross, two_difference
from trunnion.certificate.scales import Scale, floor, largest, measure

LIMIT = 1e-9
BLOCK = 4096  # elements at a time
_ALONG = ("dist", "strain", "curvature", "vary")  # what Loads says of elements

Where = Callable[[int], str]


def certify(
    system: System, loads: Loads, state: State, *, correction_u: float, correction_r: float
) -> Certificate:
    """Check the numbers of one case.

    Parameters
    ----------
    correction_u, correction_r : next consistent correction of displacements and of reactions,
        relative to the largest, as the solver found it.
    """
    with np.errstate(all="ignore"):  # numbers that are none show in the items
        scale = measure(system, loads, state)
        contact, slider = _contact(system), _slider(system)
        contacts = contactlaw.contact_errors(system, loads, state, scale)
        sliders = contactlaw.slider_errors(system, loads, state, scale)
        items = [
            _finite(system, state),
            _equilibrium(system, loads, state, scale),
            *_elements(system, loads, state, scale),
            *(_item(name, error, contact) for name, error in contacts.items()),
            *(_item(name, error, slider) for name, error in sliders.items()),
            Item("correction_u", _number(correction_u), ""),
            Item("correction_r", _number(correction_r), ""),
        ]
    worst = max(items, key=lambda item: item.value)
    where = f"{worst.name} at {worst.where}" if worst.where else worst.name
    return Certificate(worst.value <= LIMIT, worst.value, where, tuple(items))


def _number(value: float) -> float:
    return abs(float(value)) if math.isfinite(value) else math.inf


def _item(name: str, relative: F8, where: Where) -> Item:
    """Worst entry of (n,) relative errors; argmax finds a NaN first."""
    if relative.size == 0:
        return Item(name, 0.0, "")
    worst = int(np.argmax(relative))
    return Item(name, _number(relative[worst]), where(worst))


def _finite(system: System, state: State) -> Item:
    """Nothing reported may be NaN or infinite."""
    node, element = _node(system), _element(system)
    contact, slider = _contact(system), _slider(system)
    for name, array, where in (
        ("u", state.u, node),
        ("u_low", state.u_low, node),
        ("end_force", state.end_force, element),
        ("reaction", state.reaction, contact),
        ("friction", state.friction, slider),
        ("normal", state.normal, slider),
        ("slide", state.slide, slider),
        ("datum", state.datum, slider),
        ("datum_end", state.datum_end, slider),
    ):
        if not math.isfinite(float(array.sum())):
            rows = ~np.isfinite(array.reshape(len(array), -1)).all(axis=1)
            return Item("finite", math.inf, f"{where(int(np.argmax(rows)))} ({name})")
    return Item("finite", 0.0, "")


def _equilibrium(system: System, loads: Loads, state: State, scale: Scale) -> Item:
    """Support forces and nodal loads less reported end forces are zero at every node."""
    contacts, sliders = system.contacts, system.sliders
    push, moment = state.reaction, np.zeros_like(state.reaction)
    if contacts.rotational.any():
        turning = contacts.rotational[:, None]
        push, moment = np.where(turning, 0.0, push), np.where(turning, push, 0.0)
    nodes = [system.ends.ravel(), contacts.node, sliders.node]
    end = state.end_force.reshape(-1, 6)
    forces = [-end[:, :3], push, state.friction]
    moments = [-end[:, 3:], moment]
    for cnode, force, torque in (
        (contacts.cnode, push, moment),
        (sliders.cnode, state.friction, np.zeros_like(state.friction)),
    ):
        on = np.flatnonzero(cnode >= 0)
        if on.size:
            nodes.append(cnode[on])
            forces.append(-force[on])
            moments.append(-torque[on])
    at = np.concatenate(nodes)
    if len(sliders.mu):
        moments.insert(2, np.zeros_like(state.friction))
    residual = loads.nodal.T.copy()
    for i, part in enumerate((*np.concatenate(forces).T, *np.concatenate(moments).T)):
        residual[i] += np.bincount(at, part, len(system.labels))
    return _item("equilibrium", _six(residual, scale.force, scale.moment), _node(system))


def _six(error: F8, translational: float, rotational: float) -> F8:
    """Larger relative error of the two halves of (6, n)."""
    error = np.abs(error)
    half = np.maximum(error[:3] / translational, error[3:] / rotational)
    relative: F8 = half.max(axis=0)
    return relative


def _elements(system: System, loads: Loads, state: State, scale: Scale) -> list[Item]:
    """Balance of every element with its load, and deformations against end forces.

    In blocks that stay in the processor's cache.
    """
    count = len(system.kind)
    parts = [
        _block(*_cut(system, loads, state, slice(at, at + BLOCK)), scale)
        for at in range(0, count, BLOCK)
    ]
    if not parts:
        return []
    balances, wrong, across, sizes = zip(*parts, strict=True)
    own, swing, move, turn, free = np.max(sizes, axis=0)
    length = floor(own, max(1e-4 * move, 1e-4 * free, 1e-3 * swing))
    angle = floor(swing, max(1e-4 * turn, 1e-3 * own))
    error, bent = np.concatenate(wrong, axis=1), 1e-5 * np.concatenate(across, axis=1)
    law = np.maximum(error[0] / np.maximum(length, bent[0]), error[1] / np.maximum(angle, bent[1]))
    law = np.maximum(law, error[2])
    name = _element(system)
    balance = np.concatenate(balances)
    return [_item("element_balance", balance, name), _item("element_law", law, name)]


def _cut(system: System, loads: Loads, state: State, b: slice) -> tuple[System, Loads, State]:
    """Give the elements of one block; nodes are shared."""
    if len(system.kind) <= BLOCK:
        return system, loads, state
    shape = ("ends", "kind", "axes", "length", "radius", "angle", "rigidity", "flex", "spring")
    names = (*shape, "od", "wall", "taper")
    return (
        replace(system, **{name: getattr(system, name)[b] for name in names}),
        replace(loads, **{name: getattr(loads, name)[b] for name in _ALONG}),
        replace(state, end_force=state.end_force[b]),
    )


def _block(
    system: System, loads: Loads, state: State, scale: Scale
) -> tuple[F8, F8, F8, list[float]]:
    """Errors of some elements.

    Returns
    -------
    (n,) relative error of the balance.
    (3, n) errors of the element law: translation [m], rotation [rad], and force of a spring
        where it has no stiffness, relative.
    (2, n) deformation by the element's own end force if it were all across [m, rad].  That force
        is reported to 1e-16 of itself; where it lies along the pipe, this is what the rounding of
        its direction amounts to.
    (5,) largest deformations, relative movements and free expansion [m, rad, m, rad, m].
    """
    tip = np.array(state.end_force[:, 1].T, order="C")
    d, dist = deformation.tip_vector(system), np.array(loads.dist.T, order="C")
    sums = tip + state.end_force[:, 0].T
    sums[:3] += dist * system.length
    sums[3:] += cross(d, tip[:3]) + deformation.load_moment(system, dist, loads.vary)
    balance = _six(sums, scale.force, scale.moment)

    i, j = system.ends.T
    here = np.take(state.u, i, axis=0)
    rows, rest = two_difference(np.take(state.u, j, axis=0), here)
    rest += np.take(state.u_low, j, axis=0) - np.take(state.u_low, i, axis=0)
    move, turn = np.array(rows.T, order="C"), np.array(here[:, 3:].T, order="C")
    law = deformation.expected(system, loads, tip)
    spring = np.flatnonzero(system.kind == SPRING)
    if spring.size:
        turn[:, spring] += 0.5 * move[3:, spring]
    v = move.copy()
    v[:3] -= cross(turn, d)
    v += rest.T
    wrong, reach, ei = np.zeros((3, len(i))), system.length, system.rigidity[:, 2]
    if spring.size:
        growth = loads.strain[spring] * system.length[spring]
        v[:, spring], law[:, spring], stray = _spring(system, v, tip, d, spring)
        v[0, spring] -= growth  # of an expansion joint
        wrong[2, spring] = stray / scale.force
    error = np.abs(v - law)
    wrong[0], wrong[1] = error[:3].max(axis=0), error[3:].max(axis=0)
    soft = np.divide(reach * system.flex, ei, out=np.zeros_like(reach), where=ei > 0.0)
    bent = soft * (reach * np.abs(tip[:3]).max(axis=0) + np.abs(tip[3:]).max(axis=0))
    sizes = [largest(a[h]) for a in (v, move) for h in (slice(0, 3), slice(3, 6))]
    sizes[0], sizes[1] = max(sizes[0], largest(law[:3])), max(sizes[1], largest(law[3:]))
    return balance, wrong, np.stack([reach * bent, bent]), [*sizes, largest(loads.strain * reach)]


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


def _node(system: System) -> Where:
    return lambda i: f"node {system.labels[i]}"


def _element(system: System) -> Where:
    return lambda i: f"element {system.parts[i].start}-{system.parts[i].end}"


def _contact(system: System) -> Where:
    def where(i: int) -> str:
        card = system.cards[system.contacts.card[i]]
        return f"{card.kind} {card.label} {system.contacts.word[i]}"

    return where


def _slider(system: System) -> Where:
    def where(i: int) -> str:
        card, s = system.cards[system.sliders.card[i]], system.sliders
        words = [system.contacts.word[j] for j in s.contact[s.first[i] : s.first[i + 1]]]
        return " ".join([card.kind, card.label, *words])

    return where
