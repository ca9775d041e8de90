"""Denominators of the certificate: the natural sizes of forces and movements in one answer."""

from dataclasses import dataclass

from trunnion.arrays import F8, Loads, State, System


@dataclass(frozen=True, slots=True)
class Scale:
    """Denominators: force [N], moment [N m], length [m], angle [rad]."""

    force: float
    moment: float
    length: float
    angle: float


def largest(*arrays: F8) -> float:
    """Largest absolute number of all arrays, 0 of nothing."""
    return max((max(float(a.max()), -float(a.min())) for a in arrays if a.size), default=0.0)


def floor(own: float, kin: float) -> float:
    """Denominator: the own size, a small part of what it is the round-off of, or one."""
    return max(own, kin) or 1.0


def measure(system: System, loads: Loads, state: State) -> Scale:
    """Natural sizes of one answer.

    Force: largest support force or non-thermal load, at least 1e-4 of the largest end force and
    of the largest moment over 1 m.  Moment: the largest one, or that force times 1 m.  Length
    and angle: the largest displacement and rotation, at least 1e-3 of each other over 1 m.
    """
    turning = system.contacts.rotational
    some = bool(turning.any())
    push = state.reaction[~turning] if some else state.reaction
    load = loads.dist * system.length[:, None]
    force = largest(push, state.friction, load, loads.nodal[:, :3])
    moment = largest(state.reaction[turning]) if some else 0.0
    moment = max(moment, largest(loads.nodal[:, 3:], state.end_force[:, :, 3:]))
    force = floor(force, 1e-4 * max(largest(state.end_force[:, :, :3]), moment))
    if force <= 1e-15 * largest(system.rigidity[:, 0] * loads.strain):
        force = 1.0  # nothing but the round-off of free expansion
    length, angle = largest(state.u[:, :3]), largest(state.u[:, 3:])
    return Scale(
        force, max(moment, force), floor(length, 1e-3 * angle), floor(angle, 1e-3 * length)
    )
