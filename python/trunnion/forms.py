"""The form of elements as the kernels see it, and parts of elements.

A form is length, radius and angle of an arc, and of a reducer (TAPER) the offset of the second
end and outside and inside diameter at both ends; what a kind has not is 0.
"""

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import ARC, F8, SPRING, TAPER, System

Index = NDArray[np.integer]
N_FORM = 8
LENGTH, RADIUS, ANGLE, OFFSET, OD, BORE, OD2, BORE2 = range(N_FORM)


def forms(system: System) -> F8:
    """(n_elem, 8) forms of all elements [m, m, rad, m, m, m, m, m]."""
    form = np.zeros((len(system.kind), N_FORM))
    form[:, LENGTH], form[:, RADIUS] = system.length, system.radius
    form[:, ANGLE] = system.angle
    at = np.flatnonzero(system.kind == TAPER)
    if at.size:
        od, wall = system.od[at], system.wall[at]
        od2, wall2, offset = system.taper[at].T
        form[at, OFFSET:] = np.column_stack((offset, od, od - 2 * wall, od2, od2 - 2 * wall2))
    return form


def part_of(form: F8, start: F8 | float, end: F8 | float) -> F8:
    """Forms of the parts of elements from the fraction `start` to `end` of their length."""
    part, share = form.copy(), np.asarray(end) - np.asarray(start)
    for column in (LENGTH, ANGLE, OFFSET):
        part[:, column] = form[:, column] * share
    for first, second in ((OD, OD2), (BORE, BORE2)):
        change = form[:, second] - form[:, first]
        part[:, first] = form[:, first] + start * change
        part[:, second] = form[:, first] + end * change
    return part


def tip_vectors(system: System, form: F8) -> F8:
    """(n_elem, 3) from the first to the second end; large coordinates would cost digits [m]."""
    d: F8 = form[:, LENGTH, None] * system.axes[:, 0]
    bent = np.flatnonzero((system.kind == ARC) | (system.kind == TAPER))
    if bent.size:
        angle, radius, axes = form[bent, ANGLE], form[bent, RADIUS], system.axes[bent]
        along = np.where(system.kind[bent] == ARC, radius * np.sin(angle), form[bent, LENGTH])
        inward = radius * 2.0 * np.sin(0.5 * angle) ** 2 + form[bent, OFFSET]
        d[bent] = along[:, None] * axes[:, 0] + inward[:, None] * axes[:, 1]
    at = np.flatnonzero(system.kind == SPRING)
    if at.size:
        d[at] = system.xyz[system.ends[at, 1]] - system.xyz[system.ends[at, 0]]
    return d


def rigidity_at(form: F8, rigidity: F8, fraction: F8 | float) -> F8:
    """(n, 4) rigidities at a fraction of the length of reducers; those of the first end given."""
    at = part_of(form, 0.0, fraction)
    size = [at[:, o] ** 2 - at[:, i] ** 2 for o, i in ((OD2, BORE2), (OD, BORE))]
    area = size[0] / size[1]
    second = area * (at[:, OD2] ** 2 + at[:, BORE2] ** 2) / (at[:, OD] ** 2 + at[:, BORE] ** 2)
    return rigidity * np.column_stack((area, second, second, area))


def part_load(dist: F8, vary: F8, fraction: F8) -> F8:
    """(n, 3, 3) load of the parts of elements before `fraction` in the kernels' three columns.

    Parameters
    ----------
    dist : (n, 3), vary : (n, 2, 3) load of the whole elements, see `arrays.Loads`.
    fraction : (n,) of the length, from the first end.
    """
    load = np.zeros((len(dist), 3, 3))
    load[:, 0] = dist
    if not vary.any():
        return load
    t = fraction[:, None]
    linear, square = vary[:, 0], vary[:, 1]
    one, two = t * (2.0 * linear - 6.0 * square), t**2 * 6.0 * square  # factors of powers of s
    load[:, 2] = two / 6.0
    load[:, 1] = 0.5 * one + 0.5 * two
    load[:, 0] = dist - linear + square + 0.5 * one + two / 3.0
    return load
