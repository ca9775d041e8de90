"""Centre lines for pictures: points along elements with what they do, for HTML, PNG and VTU."""

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import ARC, F8, SPRING, TAPER, CaseResult, System
from trunnion.frozen import frozen
from trunnion.results.balance import section_forces
from trunnion.results.interior import places, points, section_axes
from trunnion.results.supports import solved

PARTS = 8  # of a straight pipe
DEGREES = 5.0  # most angle of one part of a bend


@frozen(eq=False)
class Lines:
    """Points of the elements one after the other.

    first : (n_elem + 1,) the points of element i are first[i]:first[i + 1].
    element, fraction : (n,) where each point is, from end 1.
    """

    first: NDArray[np.intp]
    element: NDArray[np.intp]
    fraction: F8


def cut(system: System, parts: int = PARTS, degrees: float = DEGREES) -> Lines:
    """Cut straights into `parts`, bends by `degrees`, springs not at all."""
    count = np.where(system.kind == SPRING, 1, parts)
    turns = np.ceil(np.degrees(system.angle) / degrees - 1e-9).astype(int)
    count = np.where(system.kind == ARC, np.maximum(turns, 2), count)
    first = np.concatenate([[0], np.cumsum(count + 1)])
    element = np.repeat(np.arange(len(count)), count + 1)
    fraction = (np.arange(first[-1]) - first[element]) / count[element]
    return Lines(first, element, fraction)


def along(case: CaseResult, lines: Lines) -> tuple[F8, F8, F8]:
    """Place (n, 3), movement (n, 6) and section forces (n, 6) of the points.

    Where a case has no interior points (sizes without sign, springs) the ends are what they are
    and the points between them lie on the straight line of numbers from one to the other.
    """
    system, state = case.system, solved(case)
    e, t = lines.element, lines.fraction
    start, end = system.ends[e, 0], system.ends[e, 1]
    s = t[:, None]
    where = (1.0 - s) * system.xyz[start] + s * system.xyz[end]
    u = state.u + state.u_low
    move = (1.0 - s) * u[start] + s * u[end]
    force = section_forces(case)
    section = (1.0 - s) * force[e, 0] + s * force[e, 1]
    inner = system.kind[e] != SPRING
    if case.linear and case.loads is not None and inner.any():
        found = points(case, e[inner], t[inner])
        where[inner], move[inner], section[inner] = (
            found.xyz,
            found.displacement,
            found.section_force,
        )
    elif inner.any():
        where[inner] = places(system, e[inner], t[inner])
    return where, move, section


def shape(system: System, lines: Lines) -> tuple[F8, F8, F8]:
    """Place (n, 3) [m], unit tangent (n, 3) and outside radius (n,) [m] of the points.

    Springs, which have no pipe, have the straight line between their ends and radius 0.
    """
    e, t = lines.element, lines.fraction
    start, end = (system.xyz[system.ends[e, i]] for i in (0, 1))
    where = start + t[:, None] * (end - start)
    tangent = section_axes(system, e, t)[:, 0]
    inner = system.kind[e] != SPRING
    where[inner] = places(system, e[inner], t[inner])
    od = system.od[e].copy()
    if len(system.taper):
        cone = system.kind[e] == TAPER
        od[cone] += t[cone] * (system.taper[e[cone], 0] - od[cone])
    return where, tangent, np.where(inner, 0.5 * od, 0.0)
