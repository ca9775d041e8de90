"""Snubbers that lock where a case left the pipe: what a case after it starts from."""

from dataclasses import replace

import numpy as np

from trunnion.arrays import F8, Loads, System
from trunnion.solver.answer import at_rest
from trunnion.solver.steps import Origin
from trunnion.solver.structure import Structure


def locked_at_rest(structure: Structure) -> Origin:
    """The undeformed start of a case that locks the snubbers."""
    return replace(at_rest(structure), lock=np.zeros((len(structure.system.cards), 6)))


def go_on(
    system: System, structure: Structure, origin: Origin, loads: Loads, *, locked: bool
) -> tuple[Loads, Origin]:
    """Loads and start of a case that goes on where another ended.

    Snubbers that were locked stay where they were; those that lock now hold the pipe where it is.

    Parameters
    ----------
    system : the system that keeps its snubbers apart.
    structure : that of the case, with the snubbers among its contacts where they are locked.
    loads : of the case.
    """
    begun = origin.loads
    if begun is None:
        return loads, origin
    if not len(system.snubbers.k):
        return loads, replace(origin, forcing=structure.forcing(begun))
    before = np.zeros_like(begun.base) if origin.lock is None else origin.lock
    now = np.zeros_like(before)
    if locked:
        now = _position(system, origin) if origin.lock is None else origin.lock
    start = replace(begun, base=begun.base - before + now)
    forcing = structure.forcing(start)
    lock = now if locked else None
    return (
        replace(loads, base=loads.base + now),
        Origin(forcing, origin.point, origin.datum, start, lock),
    )


def _position(system: System, origin: Origin) -> F8:
    """(n_card, 6) movement of each snubber against its ground or its other end."""
    assert origin.loads is not None
    u, s = origin.point.u + origin.point.low, system.snubbers
    out = np.zeros_like(origin.loads.base)
    other = np.where((s.cnode >= 0)[:, None], u[s.cnode], 0.0)
    out[s.card] = u[s.node] - other - origin.loads.base[s.card]
    return out
