"""Shapes of what is no plain pipe: valves of two cones, flanges as discs, joints with bellows.

A shape is a row of rings along the element's own line, so that it moves and bends with it and has
its colours; two rings at one place make a sharp edge.
"""

from collections.abc import Mapping

import numpy as np

from trunnion.arrays import F8, System
from trunnion.frozen import frozen
from trunnion.report.centreline import Lines

RIGID_WALL = 10.0  # walls of a body that is no pipe, see system.elements
WAVES = 6  # of a bellows
STOUT = 1.6  # radius of discs, of the pipe's
BELLOWS = 1.35
NECK = 0.35  # of a valve, in its middle

#: fraction of the length, radius as a part of the pipe's
Profile = tuple[tuple[float, float], ...]


def _edges(*corners: tuple[float, float]) -> Profile:
    """Rings at corners, doubled: no light runs round an edge."""
    return tuple(corner for corner in corners for _ in range(2))


def _bellows() -> Profile:
    crests = [(k + 1) / (4.0 * WAVES + 2.0) for k in range(4 * WAVES + 1)]
    rings = [(t, 1.0 if k % 4 == 0 else BELLOWS if k % 4 == 2 else 0.5 * (1.0 + BELLOWS))
             for k, t in enumerate(crests)]  # fmt: skip
    return ((0.0, 1.0), *rings, (1.0, 1.0))


SHAPES: Mapping[str, Profile] = {
    "valve": _edges(
        (0.0, 1.0), (0.02, 1.0), (0.02, STOUT), (0.12, STOUT), (0.12, 1.35), (0.5, NECK),
        (0.88, 1.35), (0.88, STOUT), (0.98, STOUT), (0.98, 1.0), (1.0, 1.0)),
    "flange": _edges(  # a groove shows where two meet
        (0.0, 1.0), (0.08, 1.0), (0.08, STOUT), (0.92, STOUT), (0.92, 1.0), (1.0, 1.0)),
    "joint": _bellows(),
}  # fmt: skip


@frozen(eq=False)
class Dressed:
    """Lines with the rings of bodies among them.

    radius : (n,) [m]; NaN where the element has its own.
    body : (n_elem,) whether the element is drawn as one.
    """

    lines: Lines
    radius: F8
    body: np.ndarray


def dressed(system: System, lines: Lines) -> Dressed:
    """Put rings in the place of the points of valves, flanges and joints."""
    shapes = {e: SHAPES[p.type] for e, p in enumerate(system.parts) if p.type in SHAPES}
    body = np.zeros(len(system.parts), bool)
    body[list(shapes)] = True
    if not shapes:
        return Dressed(lines, np.full(len(lines.element), np.nan), body)
    pipe = _pipe_radius(system)
    count = np.diff(lines.first)
    fractions = np.split(lines.fraction, lines.first[1:-1])
    radii = [np.full(n, np.nan) for n in count.tolist()]
    for e, profile in shapes.items():
        t, r = np.array(profile).T
        fractions[e], radii[e] = t, r * pipe[e]
        count[e] = len(t)
    first = np.concatenate([[0], np.cumsum(count)])
    element = np.repeat(np.arange(len(count)), count)
    whole = Lines(first, element, np.concatenate(fractions))
    return Dressed(whole, np.concatenate(radii), body)


def _pipe_radius(system: System) -> F8:
    """(n_elem,) outside radius of the pipe that each element stands in [m]."""
    thick = np.array([p.type in ("valve", "flange", "rigid") for p in system.parts], bool)
    own = 0.5 * system.od - np.where(thick, system.wall * (1.0 - 1.0 / RIGID_WALL), 0.0)
    at = np.zeros(len(system.labels))
    for end in (0, 1):
        np.maximum.at(at, system.ends[:, end], np.where(thick, 0.0, own))
    beside = at[system.ends].max(axis=1)
    found: F8 = np.where(own > 0.0, own, beside)
    return found
