"""The rules that every accepted solution meets between its last two iterations."""

from dataclasses import dataclass
from math import cos, radians

import numpy as np

from trunnion.arrays import F8, SLIP
from trunnion.solver.quantities import Response

NORMAL = 0.01  # change of a normal force, of itself
TURN = cos(radians(15.0))  # turn of a sliding direction
CHANGE = 1e-3  # change of the displacements, and the change that remains
RESOLUTION = 1e-9  # of the largest normal force: below it a force has no direction


@dataclass(frozen=True, slots=True)
class Verdict:
    """Whether two successive responses agree; `broken` says which rule does not hold."""

    broken: str | None
    remaining: float  # extrapolated change of displacement that remains, relative

    @property
    def holds(self) -> bool:
        """All rules hold."""
        return self.broken is None


def judge(before: Response, after: Response, change: F8, earlier: F8 | None, u: F8) -> Verdict:
    """Compare the last two iterations.

    A change of state that changes no force is an exact tie (contact at just the gap, force at
    just mu N) and breaks no rule.

    Parameters
    ----------
    change, earlier : (n_node, 6) last change of the displacements and the one before it.
    u : (n_node, 6) displacements now.
    """
    remaining = remaining_change(change, earlier, u)
    force = RESOLUTION * max(1.0, float(after.normal.max(initial=0.0)))
    broken = None
    pushed = _lengths(after.reaction - before.reaction)
    rubbed = _lengths(after.friction - before.friction)
    if ((before.side != after.side) & (pushed > RESOLUTION * _largest(after.reaction))).any():
        broken = "a contact still opens or closes"
    elif ((before.mode != after.mode) & (rubbed > force)).any():
        broken = "a support still changes between stick and slip"
    elif (np.abs(after.normal - before.normal) > NORMAL * after.normal + force).any():
        broken = "a normal force still changes by more than 1 %"
    elif (rubbed > NORMAL * after.capacity + force).any():
        broken = "a friction force still changes"
    elif _turned(before, after, force):
        broken = "a sliding direction still turns by more than 15 degrees"
    elif not remaining <= CHANGE:
        broken = "the displacements still change by more than 0.1 %"
    return Verdict(broken, remaining)


def remaining_change(change: F8, earlier: F8 | None, u: F8) -> float:
    """Last change, or the geometric sum that follows it (Richardson), relative to the largest.

    A rotation counts as the movement it makes over one metre.
    """
    size = max(float(np.abs(u).max(initial=0.0)), 1e-300)
    last = float(np.abs(change).max(initial=0.0))
    if earlier is None:
        return last / size
    before = float(np.abs(earlier).max(initial=0.0))
    ratio = last / before if before > 0.0 else 0.0
    if ratio >= 1.0:
        return np.inf if last > 1e-12 * size else last / size
    return max(last, last * ratio / (1.0 - ratio)) / size


def _turned(before: Response, after: Response, force: float) -> bool:
    slip = (after.mode == SLIP) & (after.capacity > force)
    a, b = before.friction[slip], after.friction[slip]
    product = (a * b).sum(axis=1)
    return bool((product < TURN * _lengths(a) * _lengths(b)).any())


def _largest(v: F8) -> float:
    return max(1.0, float(np.abs(v).max(initial=0.0)))


def _lengths(v: F8) -> F8:
    out: F8 = np.sqrt((v * v).sum(axis=1))
    return out
