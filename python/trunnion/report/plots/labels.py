"""Labels that cover nothing: each takes the first free place around its point, or is left out."""

from collections.abc import Callable
from math import ceil, floor

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import F8
from trunnion.frozen import frozen

CELL = 1.5  # of the map of what is taken [pt]
AROUND = (45.0, 135.0, 315.0, 225.0, 90.0, 270.0, 0.0, 180.0)  # directions tried [degrees]
AWAY = (5.0, 9.0, 14.0, 21.0, 30.0, 42.0)  # distances tried [pt]
LEADER = 12.0  # from this distance on a line leads to the label [pt]
OWN = 14.0  # around a node: the support there is its own [pt]
FAILURES = 250  # labels without a place after which no more are tried


@frozen
class Label:
    """A label that has a place: which one, centre and size [pt], far enough for a line to it."""

    index: int
    x: float
    y: float
    width: float
    height: float
    leader: bool


class Space:
    """A map of the paper that knows what is taken, and where text and supports stand."""

    def __init__(self, size: F8) -> None:
        self.count = np.ceil(size / CELL).astype(int)
        self.taken: NDArray[np.bool_] = np.zeros(self.count, bool)
        self.written: NDArray[np.bool_] = np.zeros(self.count, bool)
        self.bodies: NDArray[np.bool_] = np.zeros(self.count, bool)

    def box(self, x: float, y: float, width: float, height: float) -> None:
        """Take a box about its centre [pt]."""
        self.taken[self._inside(x, y, width, height)] = True

    def body(self, x: float, y: float, width: float, height: float) -> None:
        """Take the box of a support, which lines to labels of other nodes do not cross."""
        self.box(x, y, width, height)
        self.bodies[self._inside(x, y, width, height)] = True

    def write(self, label: Label, point: F8) -> None:
        """Take the place of a label and of the line to its point."""
        self.box(label.x, label.y, label.width + 2.0, label.height + 1.0)
        self.written[self._inside(label.x, label.y, label.width, label.height)] = True
        if label.leader:
            self.lines(np.stack([point, foot(label, point)])[None], np.zeros(1))

    def lines(self, parts: F8, half: F8) -> None:
        """Take straight parts (n, 2, 2) with a half width each [pt]."""
        reach = np.ceil(half / CELL).astype(int)
        for k in np.unique(reach).tolist():
            own = parts[reach == k]
            step = own[:, 1] - own[:, 0]
            count = (np.abs(step).max(axis=1) / (CELL * max(k, 1))).astype(int) + 2
            which = np.repeat(np.arange(len(own)), count)
            order = np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)
            t = order / (count - 1)[which]
            cell = ((own[which, 0] + t[:, None] * step[which]) / CELL).astype(int)
            for i in range(-k, k + 1):
                for j in range(-k, k + 1):
                    at = cell + np.array([i, j])
                    at = at[((at >= 0) & (at < self.count)).all(axis=1)]
                    self.taken[at[:, 0], at[:, 1]] = True

    def free(self, x: float, y: float, width: float, height: float) -> bool:
        """Tell whether a box is inside the paper and takes nothing that is taken."""
        (a, c), (b, d) = self._cells(x, y, width, height)
        if a < 0 or c < 0 or b > self.count[0] or d > self.count[1]:
            return False
        return not self.taken[a:b, c:d].any()

    def crosses(self, start: F8, end: F8) -> bool:
        """Tell whether a line would cross text, or a support other than that at its start."""
        n = int(np.abs(end - start).max() / CELL) + 2
        at = ((start + np.linspace(0.0, 1.0, n)[:, None] * (end - start)) / CELL).astype(int)
        at = np.clip(at, 0, self.count - 1)
        far = np.abs((at - start / CELL) * CELL).max(axis=1) > OWN
        body = self.bodies[at[:, 0], at[:, 1]] & far
        return bool((self.written[at[:, 0], at[:, 1]] | body).any())

    def _inside(self, x: float, y: float, width: float, height: float) -> tuple[slice, slice]:
        (a, c), (b, d) = self._cells(x, y, width, height)
        return slice(max(a, 0), max(b, 0)), slice(max(c, 0), max(d, 0))

    def _cells(
        self, x: float, y: float, width: float, height: float
    ) -> tuple[tuple[int, int], tuple[int, int]]:
        low = floor((x - 0.5 * width) / CELL), floor((y - 0.5 * height) / CELL)
        high = ceil((x + 0.5 * width) / CELL), ceil((y + 0.5 * height) / CELL)
        return low, high


def foot(label: Label, point: F8) -> F8:
    """End of the line from a point to its label: the nearest place of the label's box [pt]."""
    middle = np.array([label.x, label.y])
    reach = 0.5 * np.array([label.width, label.height])
    found: F8 = middle + np.clip(point - middle, -reach, reach)
    return found


def place(
    space: Space,
    points: F8,
    size: Callable[[int], tuple[float, float]],
    *,
    most: int,
    far: float = AWAY[-1],
) -> list[Label]:
    """Place labels one after the other, the first with the first choice.

    Parameters
    ----------
    points : (n, 2) what they belong to [pt].
    size : width and height of the label of a point [pt].
    most : labels at most; far : distance of a label from its point at most [pt].
    """
    found: list[Label] = []
    failures = 0
    for i, point in enumerate(points):
        if len(found) >= most or failures >= FAILURES:
            break
        label = _spot(space, i, point, size(i), far)
        if label is None:
            failures += 1
            continue
        found.append(label)
        space.write(label, point)
    return found


_TURNS = np.radians(AROUND)
_DIRECTIONS = np.stack([np.cos(_TURNS), np.sin(_TURNS)], axis=1).round(12).tolist()


def _spot(
    space: Space, index: int, point: F8, size: tuple[float, float], far: float
) -> Label | None:
    """Find the first free place of one label."""
    x, y = point.tolist()
    width, height = size
    for away in AWAY:
        if away > far:
            break
        for dx, dy in _DIRECTIONS:
            at = x + dx * (away + 0.5 * width), y + dy * (away + 0.5 * height)
            if not space.free(*at, width, height):
                continue
            label = Label(index, *at, width, height, away > LEADER)
            if label.leader and space.crosses(point, foot(label, point)):
                continue
            return label
    return None
