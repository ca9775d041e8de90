"""Arrows of loads: as long as the loads are large, their heads at the restraints."""

from collections.abc import Sequence

import numpy as np
from matplotlib.collections import PolyCollection

from trunnion.arrays import F8
from trunnion.frozen import frozen
from trunnion.report.plots.drawing import SHORTER, Frame
from trunnion.report.plots.glyphs import spacing
from trunnion.report.plots.labels import Space
from trunnion.report.plots.palette import ARROW, PAPER

LONGEST, SHORTEST = 66.0, 24.0  # of the largest load [pt]
SEEN = 5.0  # shorter ones are not drawn [pt]
TIP = 2  # number of the point of `arrow` that touches the restraint
SHAFT, HEAD, WIDE = 1.9, 9.0, 7.5  # width of the shaft, length and width of the head [pt]


@frozen(eq=False)
class Arrows:
    """What was drawn.

    rows : of the loads that have an arrow.  points_per_load : along an axis [pt/N].  least : loads
    below it have none [N]; 0 where all have one.
    """

    rows: Sequence[int]
    collection: PolyCollection | None
    points_per_load: float
    least: float = 0.0


def load_arrows(
    frame: Frame,
    at: F8,
    radius: F8,
    load: F8,
    both: Sequence[bool],
    *,
    pulls: Sequence[bool] | None = None,
    most: float | None = None,
) -> Arrows:
    """Draw loads (n, 3) on restraints at places (n, 3); all axes are shortened alike.

    Parameters
    ----------
    radius : (n,) half width of the pipe there [m].
    both : loads without sign, which have a head at either end and their middle at the place.
    pulls : loads that begin at the place, because the restraint stands where they come from.
    most : load of the longest arrow [N]; None: the largest of all.
    """
    size = np.linalg.norm(load, axis=1)
    most = float(size.max(initial=0.0)) if most is None else most
    if most == 0.0:
        return Arrows((), None, 0.0)
    per_load = reach(frame, at) / most
    shapes, rows = [], []
    for i in np.argsort(-size, kind="stable").tolist():
        length = per_load * float(size[i])
        if length < SEEN:
            break
        axis = load[i] / size[i]
        step = frame.view.flat(axis) / SHORTER
        seen = length * float(np.linalg.norm(step))
        if seen < SEEN:
            continue
        step = step / float(np.linalg.norm(step))
        point = frame.points(frame.flat(at[i]))
        if both[i]:
            start, end = point - 0.5 * seen * step, point + 0.5 * seen * step
        elif pulls is not None and pulls[i]:
            start = point + (radius[i] / frame.scale + 1.0) * step
            end = start + seen * step
        else:
            end = point - (radius[i] / frame.scale + 1.0) * step
            start = end - seen * step
        shapes.append(frame.metres(arrow(start, end, both=both[i])))
        rows.append(i)
    collection = PolyCollection(
        shapes, facecolors=ARROW, edgecolors=PAPER, linewidths=0.7, zorder=5, joinstyle="miter"
    )
    frame.axes.add_collection(collection, autolim=False)
    dropped = bool(((size > 0.0) & (per_load * size < SEEN)).any())
    return Arrows(rows, collection, per_load, SEEN / per_load if dropped else 0.0)


def block_arrows(space: Space, frame: Frame, arrows: Arrows) -> None:
    """Take what arrows cover."""
    if arrows.collection is None:
        return
    for path in arrows.collection.get_paths():
        ends = frame.points(np.asarray(path.vertices))
        far = np.argmax(np.linalg.norm(ends - ends[TIP], axis=1))
        space.lines(np.stack([ends[TIP], ends[far]])[None], np.full(1, 3.0))


def reach(frame: Frame, at: F8) -> float:
    """Length of the longest arrow [pt]: less where restraints stand close on paper."""
    return float(np.clip(1.6 * spacing(frame, at), SHORTEST, LONGEST))


def arrow(start: F8, end: F8, *, both: bool = False) -> F8:
    """(n, 2) outline of an arrow [pt]; the head shrinks with a short one."""
    way = end - start
    length = float(np.linalg.norm(way))
    along = way / length
    across = np.array([-along[1], along[0]])
    head = min(HEAD, (0.45 if both else 0.6) * length)
    wide, shaft = 0.5 * WIDE * head / HEAD, 0.5 * SHAFT * max(head / HEAD, 0.6)
    tip = [(length - head, shaft), (length - head, wide), (length, 0.0)]
    tip += [(x, -y) for x, y in reversed(tip[:2])]
    foot = [(length - x, -y) for x, y in tip] if both else [(0.0, -shaft), (0.0, shaft)]
    found: F8 = np.array([start + x * along + y * across for x, y in [*tip, *foot]])
    return found
