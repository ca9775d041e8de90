"""Bends and reducers as chains of hinges, for programs whose elements are straight and uniform.

The flexibility of the pipe is gathered at n Gauss points of its axis; between them it is rigid.
Under forces at its ends and loads between them such a chain moves as the integral of the section
strains, taken by Gauss's rule, says: to round-off like the element itself from some n on, which
`hinge_count` finds.  Nothing is taken from the kernels: the sections' own rigidities make it.
"""

import numpy as np

from trunnion.arrays import ARC, F8, System
from trunnion.forms import forms, rigidity_at
from trunnion.frozen import frozen

FEWEST, MOST = 5, 25
ALIKE = 1e-10  # change of the flexibility, scaled to a unit diagonal, at which n is enough
STIFF_SHEAR = 2e3  # of EA, where SHEAR=OFF is taken back
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(20)


@frozen(eq=False)
class Chain:
    """An arc or a reducer as hinges.

    element : number of the element.
    xyz : (n, 3) places of the hinges [m].
    axes : (n, 3, 3) rows: tangent, normal, binormal.
    k : (n, 6) stiffness of each hinge in these axes [N/m, N m/rad].
    length : (n,) of pipe that each hinge stands for [m].
    free : (n, 3) movement of each hinge under a free strain of 1, in its axes [m].
    segment : (n + 1, shapes, 4) of each rigid part and each shape of load (1; on reducers also
        2 s - 1 and 6 s2 - 6 s + 1): its integral along the part [m], and that of the lever about
        the part's node [m2].
    """

    element: int
    xyz: F8
    axes: F8
    k: F8
    length: F8
    free: F8
    segment: F8


def chain(system: System, e: int) -> Chain:
    """Gather an arc or a reducer at as many points as its flexibility asks for."""
    n = hinge_count(system, e)
    s, weight = _rule(n)
    length = system.length[e] * weight
    axes = _axes(system, e, s)
    k = _stiffness(system, e, s, length)
    xyz = system.xyz[system.ends[e, 0]] + _reach(system, e, s)
    tip = _reach(system, e, np.ones(1)) / system.length[e]
    along = axes[:, 0] if system.kind[e] == ARC else tip
    free = np.einsum("nij,nj->ni", axes, np.broadcast_to(along, axes[:, 0].shape))
    return Chain(e, xyz, axes, k, length, free * length[:, None], _segments(system, e, s))


def hinge_count(system: System, e: int) -> int:
    """Smallest number of hinges that give the flexibility of an element."""
    best = flexibility(system, e, MOST)
    scale = np.sqrt(np.diag(best))
    for n in range(FEWEST, MOST, 1 if system.rigidity[e, 3] > 0.0 else 2):
        change = np.abs(flexibility(system, e, n) - best) / np.outer(scale, scale)
        if change.max() <= ALIKE:
            return n
    return MOST


def flexibility(system: System, e: int, n: int) -> F8:
    """(6, 6) tip flexibility of the chain of n hinges, global axes."""
    s, weight = _rule(n)
    axes = _axes(system, e, s)
    give = 1.0 / _stiffness(system, e, s, system.length[e] * weight)
    arm = _reach(system, e, np.ones(1)) - _reach(system, e, s)
    total = np.zeros((6, 6))
    for turn, c, d in zip(axes, give, arm, strict=True):
        lever = np.array([[0.0, -d[2], d[1]], [d[2], 0.0, -d[0]], [-d[1], d[0], 0.0]])
        section = np.zeros((6, 6))  # force and moment of the section under unit forces of the tip
        section[:3, :3], section[3:, 3:], section[3:, :3] = turn, turn, turn @ lever
        total += section.T @ (c[:, None] * section)
    return total


def _rule(n: int) -> tuple[F8, F8]:
    """Gauss points and weights on 0 < s < 1."""
    x, w = np.polynomial.legendre.leggauss(n)
    return 0.5 * (1.0 + x), 0.5 * w


def _reach(system: System, e: int, s: F8) -> F8:
    """(n, 3) from the first end to the points s of the axis, global [m]."""
    ex, ey = system.axes[e, :2]
    if system.kind[e] != ARC:
        return np.outer(s, system.length[e] * ex + system.taper[e, 2] * ey)
    turned = system.angle[e] * s
    along, inward = np.sin(turned), 2.0 * np.sin(0.5 * turned) ** 2
    reach: F8 = system.radius[e] * (np.outer(along, ex) + np.outer(inward, ey))
    return reach


def _axes(system: System, e: int, s: F8) -> F8:
    """(n, 3, 3) axes of the sections; those of a reducer are normal to the axis of its pipes."""
    axes = np.tile(system.axes[e], (len(s), 1, 1))
    if system.kind[e] == ARC:
        turned = (system.angle[e] * s)[:, None]
        ex, ey = system.axes[e, :2]
        axes[:, 0] = np.cos(turned) * ex + np.sin(turned) * ey
        axes[:, 1] = np.cos(turned) * ey - np.sin(turned) * ex
    return axes


def _stiffness(system: System, e: int, s: F8, length: F8) -> F8:
    """(n, 6) stiffness of hinges that stand for `length` of pipe each.

    Without shear flexibility (SHEAR=OFF; n is odd) hinges that are rigid across the pipe would
    spoil the equations.  All but the middle one give a little, and the middle one takes that back:
    where a chain gives way to a force at its end does not matter, only how much; so its stiffness
    there is negative.
    """
    rigidity = np.tile(system.rigidity[e], (len(s), 1))
    if system.kind[e] != ARC:
        form = forms(system)[[e]]
        rigidity = np.concatenate([rigidity_at(form, rigidity[:1], x) for x in s])
    ea, gj, ei, gas = rigidity.T
    bending = ei / system.flex[e]
    if system.rigidity[e, 3] > 0.0:
        return np.stack([ea, gas, gas, gj, bending, bending], axis=1) / length[:, None]
    across = STIFF_SHEAR * system.rigidity[e, 0] * np.ones_like(ea)
    k: F8 = np.stack([ea, across, across, gj, bending, bending], axis=1) / length[:, None]
    middle, axes = len(s) // 2, _axes(system, e, s)
    others = np.arange(len(s)) != middle
    turned = axes[others] @ axes[middle].T  # rows: axes of the others in those of the middle one
    given = (turned[:, 1:] ** 2).sum(axis=1)
    taken = (given / k[others, 1:2]).sum(axis=0)
    k[middle, :3] = 1.0 / (np.array([1.0 / k[middle, 0], 0.0, 0.0]) - taken)
    return k


def _segments(system: System, e: int, s: F8) -> F8:
    """(n + 1, shapes, 4) integrals of the loads' shapes and of their levers over the rigid parts.

    The first part hangs on the first end, the last on the second, the others on the hinge before.
    """
    bounds = np.concatenate(([0.0], s, [1.0]))
    at = np.concatenate(([0.0], s[:-1], [1.0]))  # first end, hinges but the last, second end
    found = []
    for a, b, node in zip(bounds[:-1], bounds[1:], at, strict=True):
        x = a + 0.5 * (1.0 + _NODES) * (b - a)
        w = 0.5 * _WEIGHTS * (b - a) * system.length[e]
        shapes = [np.ones_like(x)]
        if system.kind[e] != ARC:
            shapes += [2.0 * x - 1.0, 6.0 * x**2 - 6.0 * x + 1.0]
        lever = _reach(system, e, x) - _reach(system, e, np.array([node]))
        found.append([[(w * f).sum(), *((w * f) @ lever)] for f in shapes])
    return np.array(found)
