"""Extra nodes for natural modes, where elements are too long for the cut-off frequency.

A wave of bending has the length 2 pi (EI / m)^(1/4) / sqrt(w).  The rule of the trade puts masses
half a span of that frequency apart, a quarter of the wave (CAEPIPE Technical Manual, "Refine
nodal mesh"); here it is an eighth, because then frequencies are right to 0.03 % at the cut-off
with consistent masses.  With lumped ones they are so only between held ends: 1 % at a free one.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import ARC, F8, I4, SPRING, TAPER, Part, System
from trunnion.forms import BORE, BORE2, OD, OD2, OFFSET, forms, rigidity_at
from trunnion.forms import part_of as form_of_part

Index = NDArray[np.integer]

PARTS_OF_WAVE = 8.0
MOST_PARTS = 200  # of one element


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Mesh:
    """A system with longer elements cut.

    system : nodes and elements of the original keep their numbers; element e is the first part
        of the original e, and the further parts follow behind all elements.
    added : number of extra nodes.
    part_of : (n_elem of `system`,) original element of each part.
    last : (n_elem of the original,) the part at the second end of each original element.
    """

    system: System
    added: int
    part_of: I4
    last: I4


def whole_mesh(system: System) -> Mesh:
    """The system as it is."""
    every = np.arange(len(system.ends), dtype=np.int32)
    return Mesh(system, 0, every, every)


def longest(system: System, line: F8, fmax: float) -> F8:
    """Longest part (n_elem,) that follows the waves of bending up to fmax [m]; inf: any.

    Parameters
    ----------
    line : (n_elem,) mass per length [kg/m].
    fmax : cut-off frequency [Hz].
    """
    wave = np.full(len(line), np.inf)
    heavy = (line > 0.0) & (system.kind != SPRING)
    ei = system.rigidity[heavy, 2] / system.flex[heavy]
    wave[heavy] = 2.0 * np.pi * (ei / line[heavy]) ** 0.25 / np.sqrt(2.0 * np.pi * fmax)
    return wave / PARTS_OF_WAVE


def refine_system(system: System, line: F8, fmax: float) -> Mesh:
    """Cut elements that are too long for fmax into equal parts, arcs by angle."""
    parts = np.ceil(system.length / longest(system, line, fmax) - 1e-9)
    count = np.clip(parts, 1, MOST_PARTS).astype(np.int32)
    if not (count > 1).any():
        return whole_mesh(system)
    n = len(system.ends)
    behind = np.repeat(np.arange(n), count - 1)
    part_of = np.concatenate((np.arange(n), behind)).astype(np.int32)
    begin = np.concatenate(([0], np.cumsum(count - 1)))[:-1]  # of an element's further parts
    number = np.concatenate((np.zeros(n, np.int64), np.arange(len(behind)) - begin[behind] + 1))
    last = np.where(count > 1, n + begin + count - 2, np.arange(n)).astype(np.int32)
    return Mesh(_cut(system, part_of, number, count, begin), len(behind), part_of, last)


def _cut(system: System, part_of: I4, number: Index, count: I4, begin: Index) -> System:
    """Make the parts: part `number` of element `part_of` in `count` of them."""
    n, n_node = len(system.ends), len(system.labels)
    inner = n_node + np.arange(len(part_of) - n)  # node at the first end of each further part
    ends = system.ends[part_of].copy()
    cut = count[part_of] > 1
    ends[n:, 0] = inner
    more = cut & (number < count[part_of] - 1)
    ends[more, 1] = n_node + begin[part_of[more]] + number[more]
    fraction = number / count[part_of]
    xyz = np.concatenate((system.xyz, _points(system, part_of[n:], fraction[n:])))
    share = 1.0 / count[part_of]
    labels = list(system.labels)
    for e, i in zip(part_of[n:].tolist(), number[n:].tolist(), strict=True):
        a, b = (system.labels[k] for k in system.ends[e])
        labels.append(f"{a}-{b}/{e}.{i}")  # no label of a deck has a hyphen
    cut_system = replace(
        system,
        labels=tuple(labels),
        xyz=xyz,
        ends=ends.astype(np.int32),
        kind=system.kind[part_of],
        axes=_turned(system, part_of, fraction),
        length=system.length[part_of] * share,
        radius=system.radius[part_of],
        angle=system.angle[part_of] * share,
        rigidity=system.rigidity[part_of],
        flex=system.flex[part_of],
        spring=system.spring[part_of],
        od=system.od[part_of],
        wall=system.wall[part_of],
        parts=_names(system, part_of, ends, labels),
        source=system.source[part_of],
        mid={},
    )
    return _cut_tapers(cut_system, system, part_of, fraction, fraction + share)


def _cut_tapers(parts: System, whole: System, element: I4, start: F8, end: F8) -> System:
    """Give parts of reducers their own diameters, offsets and rigidities."""
    at = np.flatnonzero(parts.kind == TAPER)
    if not at.size:
        return replace(parts, taper=parts.taper[:0])
    form = forms(whole)[element[at]]
    part = form_of_part(form, start[at], end[at])
    taper, rigidity = np.zeros((len(element), 3)), parts.rigidity.copy()
    taper[at] = np.column_stack(
        (part[:, OD2], 0.5 * (part[:, OD2] - part[:, BORE2]), part[:, OFFSET])
    )
    rigidity[at] = rigidity_at(form, whole.rigidity[element[at]], start[at])
    od, wall = parts.od.copy(), parts.wall.copy()
    od[at], wall[at] = part[:, OD], 0.5 * (part[:, OD] - part[:, BORE])
    return replace(parts, taper=taper, rigidity=rigidity, od=od, wall=wall)


def _points(system: System, element: I4, fraction: F8) -> F8:
    """Points of elements at fractions of their axes (n, 3)."""
    axes, start = system.axes[element], system.xyz[system.ends[element, 0]]
    t = fraction * system.angle[element]
    arc = system.kind[element] == ARC
    along = np.where(arc, system.radius[element] * np.sin(t), 0.0)
    aside = np.where(arc, 2.0 * system.radius[element] * np.sin(0.5 * t) ** 2, 0.0)
    curved = along[:, None] * axes[:, 0] + aside[:, None] * axes[:, 1]
    run = system.xyz[system.ends[element, 1]] - start
    points: F8 = start + np.where(arc[:, None], curved, fraction[:, None] * run)
    return points


def _turned(system: System, element: I4, fraction: F8) -> F8:
    """Axes at the first end of parts; those of arcs turn with the tangent."""
    axes = system.axes[element].copy()
    t = np.where(system.kind[element] == ARC, fraction * system.angle[element], 0.0)[:, None]
    ex, ey = axes[:, 0].copy(), axes[:, 1].copy()
    axes[:, 0] = np.cos(t) * ex + np.sin(t) * ey
    axes[:, 1] = np.cos(t) * ey - np.sin(t) * ex
    return np.ascontiguousarray(axes)


def _names(system: System, part_of: I4, ends: Index, labels: list[str]) -> tuple[Part, ...]:
    return tuple(
        replace(system.parts[e], start=labels[a], end=labels[b])
        for e, (a, b) in zip(part_of.tolist(), ends.tolist(), strict=True)
    )
