"""Points between the ends of elements: exact displacement and internal force.

The part of an element before a point is an element itself, a cantilever from end 1, and statics
give the force on its section; so a point is as exact as a node, on straights and on arcs.
"""

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import ARC, F8, I4, SPRING, STRAIGHT, CaseResult, Loads, System
from trunnion.forms import OFFSET, forms, part_load, part_of
from trunnion.frozen import frozen

Index = NDArray[np.integer]


@frozen(eq=False)
class Points:
    """Answers at points along elements.

    element : (n,) element numbers.
    fraction : (n,) of the length of the axis, from end 1.
    xyz : (n, 3) position [m].
    axes : (n, 3, 3) rows: tangent, normal (towards the centre of an arc), binormal.
    displacement : (n, 6) global [m, rad].
    force : (n, 6) force and moment that the rest of the element exerts on the part before the
        point, global [N, N m].
    """

    element: I4
    fraction: F8
    xyz: F8
    axes: F8
    displacement: F8
    force: F8

    @property
    def section_force(self) -> F8:
        """(n, 6) N Vy Vz T My Mz in the section's axes; N > 0 is tension [N, N m]."""
        turned: F8 = np.einsum("nij,nkj->nki", self.axes, self.force.reshape(-1, 2, 3))
        return turned.reshape(-1, 6)


def section_axes(system: System, element: Index, fraction: F8) -> F8:
    """(n, 3, 3) rows ex ey ez of sections; ex is the tangent from end 1 to end 2."""
    axes = system.axes[element].copy()
    t = (system.angle[element] * (system.kind[element] == ARC) * fraction)[:, None]
    ex, ey = axes[:, 0].copy(), axes[:, 1].copy()
    axes[:, 0] = np.cos(t) * ex + np.sin(t) * ey
    axes[:, 1] = np.cos(t) * ey - np.sin(t) * ex
    return axes


def points(case: CaseResult, element: Index, fraction: F8) -> Points:
    """Answers of a solved case at `fraction` of the length of each `element` (no springs).

    Raises
    ------
    ValueError
        The case has no numbers, or is a combination with ABS: its elements are in no balance.
    """
    system, loads, state = case.system, case.loads, case.state
    if state is None or loads is None or not case.linear:
        raise ValueError(f"{case.name} has no interior points")
    if (system.kind[element] == SPRING).any():
        raise ValueError("a spring has no interior points")
    axes = system.axes[element]
    arm = _position(system, element, fraction)
    tip, v = _cantilever(system, loads, element, fraction, state.end_force[element, 0], arm)
    back = axes.transpose(0, 2, 1)
    start = system.ends[element, 0]
    u = state.u[start] + state.u_low[start]
    reach = _turn(back, arm)
    u[:, :3] += np.cross(u[:, 3:], reach) + _turn(back, v[:, :3])
    u[:, 3:] += _turn(back, v[:, 3:])
    return Points(
        element=np.asarray(element, np.int32),
        fraction=fraction,
        xyz=system.xyz[start] + reach,
        axes=section_axes(system, element, fraction),
        displacement=u,
        force=np.concatenate([_turn(back, tip[:, :3]), _turn(back, tip[:, 3:])], axis=1),
    )


def _cantilever(
    system: System, loads: Loads, element: Index, fraction: F8, end: F8, arm: F8
) -> tuple[F8, F8]:
    """Force on the section at the tip of a part, and the tip's deformation, in axes of end 1.

    Parameters
    ----------
    end : (n, 6) force and moment on the first end, global [N, N m].
    arm : (n, 3) from the first end to the tip, in the axes of end 1 [m].
    """
    from trunnion.kernels import tip_deformation, tip_flexibility, tip_resultant

    tip = np.zeros((len(element), 6))
    if len(element) == 0:
        return tip, tip
    kind, axes = system.kind[element], system.axes[element]
    form = part_of(forms(system)[element], 0.0, fraction)
    rigidity, flex = system.rigidity[element], system.flex[element]
    strain, curvature = loads.strain[element], loads.curvature[element]
    vary = loads.vary[element] if len(loads.vary) else loads.vary
    dist = part_load(loads.dist[element], vary, fraction)
    dist = np.ascontiguousarray(np.einsum("nij,npj->npi", axes, dist))
    load = tip_resultant(kind, form, dist)
    tip[:, :3] = -_turn(axes, end[:, :3]) - load[:, :3]
    tip[:, 3:] = -_turn(axes, end[:, 3:]) - load[:, 3:] - np.cross(arm, tip[:, :3])
    f = tip_flexibility(kind, form, rigidity, flex)
    v = tip_deformation(kind, form, rigidity, flex, dist, strain, curvature)
    v += np.einsum("nij,nj->ni", f, tip)
    return tip, v


def _turn(axes: F8, vector: F8) -> F8:
    """(n, 3) components of vectors along the rows of (n, 3, 3) axes."""
    turned: F8 = np.einsum("nij,nj->ni", axes, vector)
    return turned


def places(system: System, element: Index, fraction: F8) -> F8:
    """(n, 3) of points at `fraction` of the length of elements, global [m]."""
    back = system.axes[element].transpose(0, 2, 1)
    start = system.xyz[system.ends[element, 0]]
    found: F8 = start + _turn(back, _position(system, element, fraction))
    return found


def _position(system: System, element: Index, fraction: F8) -> F8:
    """(n, 3) of points in the axes of end 1."""
    arc = system.kind[element] == ARC
    radius, t = system.radius[element], system.angle[element] * fraction
    at = np.zeros((len(fraction), 3))
    at[:, 0] = np.where(arc, radius * np.sin(t), system.length[element] * fraction)
    offset = forms(system)[element, OFFSET] * fraction
    at[:, 1] = np.where(arc, 2.0 * radius * np.sin(0.5 * t) ** 2, offset)
    return at


def mid_of_bend(case: CaseResult) -> dict[str, F8]:
    """Displacement (6,) of the bends' middles that are no nodes, by label (30M).

    Empty where interior points have no meaning (see `points`).
    """
    middle = mid_points(case)
    if middle is None:
        return {}
    return dict(zip(case.system.mid, middle.displacement, strict=True))


def mid_points(case: CaseResult) -> Points | None:
    """Answers at the bends' middles in the order of `System.mid`; None where there are none."""
    if case.state is None or not case.linear or not case.system.mid:
        return None
    element = np.array(list(case.system.mid.values()), np.int32)
    return points(case, element, np.full(len(element), 0.5))


def stations(case: CaseResult, per_span: int) -> Points:
    """Answers at both ends of every pipe element and at the points between `per_span` parts."""
    pipes = np.flatnonzero(case.system.kind != SPRING)
    fraction = np.linspace(0.0, 1.0, per_span + 1)
    return points(case, np.repeat(pipes, per_span + 1), np.tile(fraction, len(pipes)))


@frozen(eq=False)
class Extremes:
    """Largest deflection of straight elements across their axis, from the chord of their ends.

    element : (n,) element numbers.
    fraction : (n,) of the length, from end 1, where it is largest.
    deflection : (n, 3) there, global [m]; its length is the sag.
    """

    element: I4
    fraction: F8
    deflection: F8

    @property
    def sag(self) -> F8:
        """(n,) size of the deflection [m]."""
        size: F8 = np.linalg.norm(self.deflection, axis=1)
        return size


_QUARTER = np.linspace(0.0, 1.0, 5)
_QUARTIC = np.linalg.inv(np.vander(_QUARTER, increasing=True))
_GRID = np.linspace(0.0, 1.0, 65)


def extreme_deflections(case: CaseResult) -> Extremes:
    """Find the largest deflection between the ends of every straight element.

    Deflection under uniform load is a quartic, so five points give it exactly; the stationary
    point of its size is bracketed on a grid and refined by Newton's method.
    """
    pipes = np.flatnonzero(case.system.kind == STRAIGHT)
    n = len(pipes)
    at = points(case, np.repeat(pipes, 5), np.tile(_QUARTER, n))
    u = at.displacement[:, :3].reshape(n, 5, 3)
    across = case.system.axes[pipes, 1:]
    w = np.einsum("nki,npi->npk", across, u)
    w = w - w[:, :1] - _QUARTER[:, None] * (w[:, -1:] - w[:, :1])
    c = np.einsum("cp,npk->cnk", _QUARTIC, w)  # coefficients of powers 0 to 4

    def value(t: F8, order: int) -> F8:
        """(n, ..., 2) derivative of the quartics at t."""
        powers, factor = range(order, 5), np.ones(5)
        for k in range(order):
            factor *= np.arange(5) - k
        total: F8 = sum(
            (factor[p] * c[p] * t[..., None] ** (p - order) for p in powers), 0.0 * c[0]
        )
        return total

    t = _best(c)
    low, high = np.maximum(t - _GRID[1], 0.0), np.minimum(t + _GRID[1], 1.0)
    for _ in range(6):
        first, second = value(t, 1), value(t, 2)
        slope = (value(t, 0) * first).sum(axis=1)
        bend = (first**2 + value(t, 0) * second).sum(axis=1)
        step = np.divide(slope, bend, out=np.zeros(n), where=bend < 0.0)
        t = np.clip(t - step, low, high)
    deflection = np.einsum("nk,nki->ni", value(t, 0), across)
    return Extremes(pipes.astype(np.int32), t, deflection)


def _best(c: F8) -> F8:
    """Point of the grid where the quartics are largest in size."""
    grid = np.einsum("cnk,gc->ngk", c, np.vander(_GRID, 5, increasing=True))
    best: F8 = _GRID[np.argmax((grid**2).sum(axis=2), axis=1)]
    return best
