"""The isometric view: where points of the model fall on paper, and how near they are."""

import numpy as np

from trunnion.arrays import F8
from trunnion.frozen import frozen

SAMPLE = 300  # nodes that decide from where to look
NEAR = 0.02  # of the model's size: nodes so near on paper cover each other


@frozen(eq=False)
class View:
    """Unit vectors (3,): to the right and up on paper, and toward the reader."""

    right: F8
    rise: F8
    toward: F8

    def flat(self, xyz: F8) -> F8:
        """(n, 2) places on paper [m]."""
        found: F8 = np.stack([xyz @ self.right, xyz @ self.rise], axis=-1)
        return found

    def depth(self, xyz: F8) -> F8:
        """(n,) nearness to the reader [m]."""
        found: F8 = xyz @ self.toward
        return found


def looking(toward: F8, up: F8) -> View:
    """Look against `toward`; `up` is vertical on paper."""
    toward = toward / np.linalg.norm(toward)
    right = np.cross(up, toward)
    right /= np.linalg.norm(right)
    return View(right, np.cross(toward, right), toward)


def isometric(xyz: F8, up: F8) -> View:
    """Choose among the four isometric views the first that covers fewest nodes.

    All axes are shortened alike (by the root of 2/3), so one scale holds along each of them.
    """
    views = [looking(corner, up) for corner in _corners(up)]
    step = max(len(xyz) // SAMPLE, 1)
    nodes = xyz[::step]
    size = float(np.ptp(nodes, axis=0).max(initial=0.0)) if len(nodes) else 0.0
    if size == 0.0:
        return views[0]
    return min(views, key=lambda view: _covered(view, nodes, NEAR * size))


def _corners(up: F8) -> list[F8]:
    """Directions to the reader: X to the right first."""
    level = [np.eye(3)[i] for i in range(3) if abs(up[i]) < 0.5]
    first, second = level
    if np.dot(np.cross(first, second), up) > 0.0:  # Z up: the reader stands at -Y
        second = -second
    return [a * first + b * second + up for a, b in ((1, 1), (-1, 1), (1, -1), (-1, -1))]


def _covered(view: View, nodes: F8, near: float) -> int:
    """Pairs of nodes that lie apart in space and together on paper."""
    flat = view.flat(nodes)
    paper = np.linalg.norm(flat[:, None] - flat[None], axis=2)
    space = np.linalg.norm(nodes[:, None] - nodes[None], axis=2)
    return int(((paper < near) & (space > 2.0 * near)).sum())
