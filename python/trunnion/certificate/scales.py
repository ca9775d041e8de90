"""Denominators of the certificate: the natural sizes of forces and movements in one answer."""

from dataclasses import dataclass

from trunnion.arrays import F8, Loads, State, System
from trunnion.certificate.deformation import columns


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
    """Denominator: the own size, or a small part of its kin where that is more; else one.

    Below 1e-18 m or rad and 1e-6 N or N m (`measure`) a size is round-off: it counts as zero.
    """
    return max(own, kin) or 1.0


def measure(system: System, loads: Loads, state: State) -> Scale:
    """Natural sizes of one answer.

    Force: largest support force or non-thermal load, at least 1e-4 of the largest end force and
    of the largest moment over 1 m, and 1e-6 of what would hold the largest free strain.  Moment:
    the largest one, at least that force times 1 cm.  Length and angle: the largest displacement and
    rotation, at least 1e-3 of each other over 1 m.
    """
    turning = system.contacts.rotational
    some = bool(turning.any())
    push = state.reaction[~turning] if some else state.reaction
    load = columns(loads.dist) * system.length
    nodal, end = columns(loads.nodal), columns(state.end_force.reshape(-1, 6))
    moment = largest(state.reaction[turning]) if some else 0.0
    moment = max(moment, largest(nodal[3:], end[3:]))
    stiff = system.rigidity[:, 0].copy()
    held = float(stiff.min(where=stiff > 0.0, initial=1e12)) * largest(loads.strain)
    kin = max(1e-4 * largest(end[:3]), 1e-4 * moment, 1e-6 * held)
    force = largest(push, state.friction, load, nodal[:3])
    force = floor(_real(force, 1e-6), _real(kin, 1e-6))
    u = columns(state.u)
    length, angle = _real(largest(u[:3]), 1e-18), _real(largest(u[3:]), 1e-18)
    return Scale(
        force, max(moment, 0.01 * force), floor(length, 1e-3 * angle), floor(angle, 1e-3 * length)
    )


def _real(size: float, round_off: float) -> float:
    return size if size > round_off else 0.0
