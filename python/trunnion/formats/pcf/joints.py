"""Ports of components joined by their coordinates, nearest first, within a tolerance.

Two ports of one component are never joined, and no joint is wider than the tolerance, so that a
chain of near points does not run together.
"""

from collections.abc import Iterator, Sequence
from itertools import product
from math import floor

from trunnion.frozen import frozen
from trunnion.system.vectors import Vec, size, sub

MOST_PAIRS = 40  # candidate pairs a point, on average, before a file is called a heap of points


class CrowdedError(ValueError):
    """So many different points lie within the tolerance that joining them means nothing."""


@frozen
class Joints:
    """Joint number of each port, coordinates of each joint, the largest distance joined [m]."""

    of_port: tuple[int, ...]
    xyz: tuple[Vec, ...]
    widest: float


def join(points: Sequence[Vec], owners: Sequence[int], tolerance: float) -> Joints:
    """Join ports.

    Parameters
    ----------
    points : coordinates of each port [m].
    owners : component of each port.
    tolerance : largest distance of two ports of one joint [m].

    Raises
    ------
    CrowdedError : too many different points within the tolerance.
    """
    group: list[int] = []
    at: dict[Vec, int] = {}
    seen: set[tuple[int, int]] = set()
    members: list[list[int]] = []  # ports of each group
    places: list[Vec] = []
    for port, (xyz, owner) in enumerate(zip(points, owners, strict=True)):
        known = at.get(xyz)
        if known is None or (known, owner) in seen:  # twice in a component: two joints
            known = len(members)
            members.append([])
            places.append(xyz)
            at.setdefault(xyz, known)
        seen.add((known, owner))
        members[known].append(port)
        group.append(known)
    root = list(range(len(members)))

    def find(x: int) -> int:
        while root[x] != x:
            root[x] = root[root[x]]
            x = root[x]
        return x

    who = [{owners[p] for p in ports} for ports in members]
    spots = [[xyz] for xyz in places]
    widest = 0.0
    for distance, i, j in sorted(_near(places, tolerance)):
        a, b = find(i), find(j)
        if a == b or who[a] & who[b]:
            continue
        if any(size(sub(p, q)) > tolerance for p in spots[a] for q in spots[b]):
            continue
        a, b = min(a, b), max(a, b)
        root[b] = a
        who[a] |= who[b]
        spots[a] += spots[b]
        widest = max(widest, distance)
    number: dict[int, int] = {}
    of_port = [number.setdefault(find(g), len(number)) for g in group]
    return Joints(tuple(of_port), tuple(places[g] for g in number), widest)


def _near(places: Sequence[Vec], tolerance: float) -> Iterator[tuple[float, int, int]]:
    """Yield distances and pairs of points within the tolerance, by cells of that width."""
    cells: dict[tuple[int, ...], list[int]] = {}
    shifts = list(product((-1, 0, 1), repeat=3))
    budget = MOST_PAIRS * len(places) + 1000
    for i, xyz in enumerate(places):
        cell = tuple(floor(x / tolerance) for x in xyz)
        for shift in shifts:
            for j in cells.get(tuple(c + s for c, s in zip(cell, shift, strict=True)), ()):
                budget -= 1
                if budget < 0:
                    raise CrowdedError
                distance = size(sub(xyz, places[j]))
                if distance <= tolerance:
                    yield distance, j, i
        cells.setdefault(cell, []).append(i)
