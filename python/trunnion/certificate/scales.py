"""Denominators of the certificate: the natural sizes of forces and movements in one answer."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

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


class Peaks(NamedTuple):
    """Largest numbers of one answer: forces [N], moments [N m], strain, displacements [m, rad]."""

    push: float
    torque: float
    friction: float
    load: float  # distributed, of an element
    nodal_force: float
    nodal_moment: float
    end_force: float
    end_moment: float
    strain: float
    move: float
    turn: float


def measure(system: System, loads: Loads, state: State) -> Scale:
    """Natural sizes of one answer.

    Force: largest support force or non-thermal load, at least 1e-4 of the largest end force and
    of the largest moment over 1 m, and 1e-6 of what would hold the largest free strain.  Moment:
    the largest one, at least that force times 1 cm.  Length and angle: the largest displacement and
    rotation, at least 1e-3 of each other over 1 m.
    """
    turning = system.contacts.rotational
    some = bool(turning.any())
    nodal, end = columns(loads.nodal), columns(state.end_force.reshape(-1, 6))
    u = columns(state.u)
    return _scale(
        softest(system),
        Peaks(
            largest(state.reaction[~turning] if some else state.reaction),
            largest(state.reaction[turning]) if some else 0.0,
            largest(state.friction),
            largest(columns(loads.dist) * system.length),
            largest(nodal[:3]),
            largest(nodal[3:]),
            largest(end[:3]),
            largest(end[3:]),
            largest(loads.strain),
            largest(u[:3]),
            largest(u[3:]),
        ),
    )


def measure_each(
    system: System, loads: Sequence[Loads], states: Sequence[State]
) -> tuple[Scale, ...]:
    """Natural sizes of several answers of one system without sliders, in one go."""
    turning = system.contacts.rotational
    reaction = np.abs(np.stack([s.reaction for s in states])).max(axis=2, initial=0.0)
    load = np.abs(np.stack([own.dist for own in loads])).max(axis=2) * system.length
    nodal, end, u = (
        np.abs(np.stack(a)).reshape(len(states), -1, 2, 3).max(axis=(1, 3), initial=0.0)
        for a in (
            [own.nodal for own in loads],
            [s.end_force for s in states],
            [s.u for s in states],
        )
    )
    rows = (
        (reaction * ~turning).max(axis=1, initial=0.0),
        (reaction * turning).max(axis=1, initial=0.0),
        np.zeros(len(states)),
        load.max(axis=1, initial=0.0),
        *nodal.T,
        *end.T,
        np.abs(np.stack([own.strain for own in loads])).max(axis=1, initial=0.0),
        *u.T,
    )
    soft = softest(system)
    return tuple(_scale(soft, Peaks(*own)) for own in np.stack(rows, axis=1).tolist())


def softest(system: System) -> float:
    """Smallest axial rigidity EA of the elements that have one, at most 1e12 [N]."""
    stiff = system.rigidity[:, 0].copy()
    return float(stiff.min(where=stiff > 0.0, initial=1e12))


def _scale(soft: float, peaks: Peaks) -> Scale:
    moment = max(peaks.torque, peaks.nodal_moment, peaks.end_moment)
    kin = max(1e-4 * peaks.end_force, 1e-4 * moment, 1e-6 * soft * peaks.strain)
    force = max(peaks.push, peaks.friction, peaks.load, peaks.nodal_force)
    force = floor(_real(force, 1e-6), _real(kin, 1e-6))
    length, angle = _real(peaks.move, 1e-18), _real(peaks.turn, 1e-18)
    return Scale(
        force, max(moment, 0.01 * force), floor(length, 1e-3 * angle), floor(angle, 1e-3 * length)
    )


def _real(size: float, round_off: float) -> float:
    return size if size > round_off else 0.0
