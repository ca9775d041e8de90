"""Deformation of elements from their reported end forces: the certificate's own element law.

Nothing here is shared with the solver, and no formula is: straights are written with vectors in
global axes (a round pipe has no preferred bending axis), arcs and reducers as Gauss-Legendre
integrals of their section strains, which to round-off are the closed forms without their
cancellation.
Arrays are component-first, (3, n) or (6, n): rows of one component are contiguous.
"""

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import ARC, F8, SPRING, STRAIGHT, TAPER, Loads, System

Index = NDArray[np.intp]

# Section strains hold sines and cosines of at most twice the angle: 20 points are exact to
# round-off up to a full circle.
_POINT, _WEIGHT = np.polynomial.legendre.leggauss(20)
_FINE, _FINE_WEIGHT = np.polynomial.legendre.leggauss(40)  # of reducers: rational integrands


def columns(a: F8) -> F8:
    """(k, n) copy of (n, k): numpy is several times slower along rows of other memory order."""
    return np.array(a.T, order="C")


def cross(a: F8, b: F8) -> F8:
    """Vector product of (3, ...) arrays."""
    out = np.empty(np.broadcast_shapes(a.shape, b.shape))
    out[0] = a[1] * b[2] - a[2] * b[1]
    out[1] = a[2] * b[0] - a[0] * b[2]
    out[2] = a[0] * b[1] - a[1] * b[0]
    return out


def dot(a: F8, b: F8) -> F8:
    """Scalar product of (3, ...) arrays."""
    product: F8 = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    return product


def two_difference(a: F8, b: F8) -> tuple[F8, F8]:
    """Return a - b as rounded difference and its exact error (Knuth)."""
    s = a - b
    back = s - a
    return s, (a - (s - back)) - (b + back)


def members(system: System, kind: int) -> Index | slice:
    """Index of the elements of one kind; a slice when all of them are."""
    which = np.flatnonzero(system.kind == kind)
    return slice(None) if which.size == system.kind.size else which


def tip_vector(system: System) -> F8:
    """(3, n_elem) from the first to the second end [m]."""
    d = system.length * columns(system.axes[:, 0])
    arc = np.flatnonzero(system.kind == ARC)
    if arc.size:
        phi, radius, axes = system.angle[arc], system.radius[arc], system.axes[arc]
        along, inward = radius * np.sin(phi), radius * 2.0 * np.sin(0.5 * phi) ** 2
        d[:, arc] = along * axes[:, 0].T + inward * axes[:, 1].T
    taper = np.flatnonzero(system.kind == TAPER)
    if taper.size:
        d[:, taper] += system.taper[taper, 2] * system.axes[taper, 1].T
    spring = np.flatnonzero(system.kind == SPRING)
    if spring.size:
        ends = system.ends[spring]
        d[:, spring] = (system.xyz[ends[:, 1]] - system.xyz[ends[:, 0]]).T
    return d


def load_moment(system: System, dist: F8, vary: F8 | None = None) -> F8:
    """(3, n_elem) moment of the load about the first end [N m]; `dist` is (3, n)."""
    moment = cross(columns(system.axes[:, 0]), dist) * (0.5 * system.length**2)
    arc = np.flatnonzero(system.kind == ARC)
    if arc.size:
        axes = system.axes[arc]
        first = _first_moment(system.angle[arc]) * system.radius[arc] ** 2
        arm = first[0] * axes[:, 0].T + first[1] * axes[:, 1].T
        moment[:, arc] = cross(arm, dist[:, arc])
    taper = np.flatnonzero(system.kind == TAPER)
    if taper.size:
        lever = dist[:, taper] / 2.0
        if vary is not None and len(vary):
            lever = lever + vary[taper, 0].T / 6.0
        moment[:, taper] = cross(tip_vector(system)[:, taper], system.length[taper] * lever)
    return moment


def expected(system: System, loads: Loads, tip: F8) -> F8:
    """(6, n_elem) deformation of the tip against the first end, global; springs are left zero.

    Parameters
    ----------
    tip : (6, n_elem) force and moment on the element at its second end, global [N, N m].
    """
    v = np.zeros_like(tip)
    straight = members(system, STRAIGHT)
    v[:, straight] = _straight(system, loads, tip, straight)
    arc = np.flatnonzero(system.kind == ARC)
    if arc.size:
        v[:, arc] = _arc(system, loads, tip[:, arc], arc)
    taper = np.flatnonzero(system.kind == TAPER)
    if taper.size:
        v[:, taper] = _taper(system, loads, tip[:, taper], taper)
    return v


def _straight(system: System, loads: Loads, tip: F8, at: Index | slice) -> F8:
    """Timoshenko cantilever, e.g. Przemieniecki, Theory of Matrix Structural Analysis, ch. 5."""
    e, length = columns(system.axes[at, 0]), system.length[at]
    f, m, q = tip[:3, at], tip[3:, at], columns(loads.dist[at])
    ea, gj, ei, gas = columns(system.rigidity[at])
    bend = length * system.flex[at] / ei
    shear = np.divide(length, gas, out=np.zeros_like(length), where=gas > 0.0)
    v = np.empty_like(tip[:, at])
    load = q * length  # whole load; its sway is that of the end force with other factors
    f_e, load_e, m_e = dot(f, e), dot(load, e), dot(m, e)
    sway = f * (bend * length**2 / 3.0 + shear) + load * (bend * length**2 / 8.0 + shear / 2.0)
    stretch = (f_e + 0.5 * load_e) * length / ea + loads.strain[at] * length
    v[:3] = sway + e * (stretch - dot(sway, e)) + cross(m, e) * (0.5 * bend * length)
    turn = cross(e, f * (0.5 * bend * length) + load * (bend * length / 6.0))
    v[3:] = turn + m * bend + e * (m_e * (length / gj - bend))
    return v


def _first_moment(b: F8) -> F8:
    """Integral of (sin a, 1 - cos a) over 0 < a < b, without cancellation."""
    series = b**3 / 6 * (1 - b**2 / 20 * (1 - b**2 / 42 * (1 - b**2 / 72 * (1 - b**2 / 110))))
    return np.stack([2.0 * np.sin(0.5 * b) ** 2, np.where(b < 0.3, series, b - np.sin(b))])


def _arc(system: System, loads: Loads, tip: F8, at: Index) -> F8:
    """Section strains integrated along the axis; (3, points, n) in the first end's axes.

    The section at angle t carries the tip's force and the load beyond t; it turns by kappa and
    stretches by epsilon, which moves the tip by kappa x (tip - section) + epsilon.
    """
    axes, radius, phi = system.axes[at], system.radius[at], system.angle[at]
    ea, gj, ei, gas = system.rigidity[at].T
    f, m, q = (np.einsum("nij,jn->in", axes, x) for x in (tip[:3], tip[3:], loads.dist[at].T))
    t = 0.5 * phi * (1.0 + _POINT[:, None])
    rest = phi - t
    zero, one = np.zeros_like(t), np.ones_like(t)
    tangent = np.stack([np.cos(t), np.sin(t), zero])
    inward = np.stack([-np.sin(t), np.cos(t), zero])
    out = np.stack([zero, zero, one])
    arm = radius * (np.sin(rest) * tangent + 2.0 * np.sin(0.5 * rest) ** 2 * inward)
    first = radius**2 * _first_moment(rest)
    force = f[:, None] + q[:, None] * (radius * rest)
    moment = m[:, None] + cross(arm, np.broadcast_to(f[:, None], arm.shape))
    moment += cross(first[0] * tangent + first[1] * inward, q[:, None] * one)
    shear = np.divide(1.0, gas, out=np.zeros_like(gas), where=gas > 0.0)
    bend = system.flex[at] / ei
    epsilon = (dot(force, tangent) / ea + loads.strain[at]) * tangent
    epsilon += shear * (dot(force, inward) * inward + force[2] * out)
    kappa = dot(moment, tangent) / gj * tangent + bend * dot(moment, inward) * inward
    kappa += (bend * moment[2] + loads.curvature[at]) * out
    weight = 0.5 * radius * phi * _WEIGHT[:, None]
    local = ((cross(kappa, arm) + epsilon) * weight).sum(axis=1), (kappa * weight).sum(axis=1)
    return np.concatenate([np.einsum("nji,jn->in", axes, x) for x in local])


def _taper(system: System, loads: Loads, tip: F8, at: Index) -> F8:
    """Section strains of a reducer integrated along its axis, global; (3, points, n).

    Sections are normal to the axis e of the pipes and their centres on the straight line from end
    to end.  E and G follow from the rigidities at the first end.
    """
    e, length = system.axes[at, 0].T[:, None], system.length[at]
    d, q = tip_vector(system)[:, at], loads.dist[at].T[:, None]
    linear, square = loads.vary[at].transpose(1, 2, 0)[:, :, None]
    s = 0.5 * (1.0 + _FINE[:, None])
    outside, inside = (
        a + s * (b - a)
        for a, b in (
            (system.od[at], system.taper[at, 0]),
            (
                system.od[at] - 2.0 * system.wall[at],
                system.taper[at, 0] - 2.0 * system.taper[at, 1],
            ),
        )
    )
    area, second = outside**2 - inside**2, outside**4 - inside**4
    first_bore = system.od[at] - 2.0 * system.wall[at]
    first_area = system.od[at] ** 2 - first_bore**2
    first_second = system.od[at] ** 4 - first_bore**4
    ea, gj, ei, gas = system.rigidity[at].T
    # the load beyond s: integrals of Legendre's polynomials, once for force, twice for moment
    left = 1.0 - s
    force = tip[:3, None] + length * left * (q + s * (linear + (2.0 * s - 1.0) * square))
    lever = 0.5 * left**2 * (q + linear * (1.0 + 2.0 * s) / 3.0 + square * s**2)
    moment = tip[3:, None] + cross(d[:, None], left * tip[:3, None] + length * lever)
    shear = np.divide(first_area, gas, out=np.zeros_like(gas), where=gas > 0.0) / area
    along, twist = dot(force, e), dot(moment, e)
    epsilon = along * (first_area / ea) / area * e + shear * (force - along * e)
    bend = first_second * system.flex[at] / ei / second
    kappa = twist * (first_second / gj) / second * e + bend * (moment - twist * e)
    weight = 0.5 * length * _FINE_WEIGHT[:, None]
    v = np.empty_like(tip)
    v[:3] = ((cross(kappa, left * d[:, None]) + epsilon) * weight).sum(axis=1)
    v[:3] += loads.strain[at] * d
    v[3:] = (kappa * weight).sum(axis=1)
    return v
