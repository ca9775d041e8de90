"""What every picture of a model is made of: the view, the pipes, the supports, the node labels."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from trunnion.arrays import F8, System
from trunnion.frozen import frozen
from trunnion.report.plots.drawing import BOX, Frame, fit
from trunnion.report.plots.glyphs import Glyph, Stand, paint_glyphs
from trunnion.report.plots.labels import Label, Space, foot, place
from trunnion.report.plots.page import SMALL, extent, fitted, shown
from trunnion.report.plots.paint import Paint, draw
from trunnion.report.plots.palette import GHOST, GREY, INK, PALE, Look
from trunnion.report.plots.pipe import Course, course, half_widths, paint_pipes, plain_faces
from trunnion.report.plots.view import View, isometric
from trunnion.results.supports import card_nodes

DOT = 2.2  # size of a support that has no room for its body [pt]
LONGEST = 90.0  # of a node label [pt]
CROWD, FEW = 150, 48  # nodes from which on their labels are thinned, to so many
CLOSE = 21.0  # distance of a label from its node then [pt]


@frozen(eq=False)
class Subject:
    """A model made ready for its pictures.

    north : unit vector, where the model's file says which way it is.  caution : what a reader of
    every picture has to know.
    """

    system: System
    course: Course
    view: View
    north: F8 | None = None
    caution: str = ""

    def noted(self, text: str) -> str:
        """Give the foot line of a picture: what is left out of the model comes first."""
        return f"{self.caution}; {text}" if self.caution else text


def subject(system: System, north: F8 | None = None, caution: str = "") -> Subject:
    """Choose parts and view of a model."""
    return Subject(system, course(system), isometric(system.xyz, system.up), north, caution)


def outline(found: Subject, at: F8 | None = None) -> F8:
    """(n, 3) points that a picture has to hold: the pipes with their width, and all nodes."""
    where, radius = found.course.at if at is None else at, found.course.radius[:, None]
    right, rise = found.view.right, found.view.rise
    around = [where + radius * a for a in (right, -right, rise, -rise)]
    return np.concatenate([*around, found.system.xyz])


def frame_of(
    figure: Figure,
    place: tuple[float, float, float, float],
    found: Subject,
    displaced: F8 | None = None,
    **choice: float,
) -> Frame:
    """Fit a model, and the displaced one where it is shown, into a place of the page [in]."""
    points = outline(found)
    if displaced is not None:
        points = np.concatenate([points, outline(found, displaced)])
    return fit(figure, place, found.view, points, **choice)  # type: ignore[arg-type]


def draw_model(
    frame: Frame,
    found: Subject,
    faces: F8,
    looks: Sequence[Look],
    bodies: Sequence[Glyph],
    standing: Stand,
    at: F8 | None = None,
) -> None:
    """Draw pipes and supports in depth order; supports that stand very close as dots."""
    paint = Paint()
    where = found.course.at if at is None else at
    paint_pipes(paint, frame, found.system, found.course, where, faces)
    paint_glyphs(paint, frame, standing, bodies, looks)
    draw(frame, paint)
    if standing.dots:
        for look in dict.fromkeys(looks):
            cards = sorted({g.card for g, own in zip(bodies, looks, strict=True) if own == look})
            x, y = frame.flat(standing.at[cards]).T
            frame.axes.plot(
                x, y, ls="", marker=look.mark, ms=DOT, mew=0.5, mec=look.colour,
                mfc=look.colour if look.filled else "#ffffff", zorder=4,
            )  # fmt: skip


def draw_ghost(frame: Frame, found: Subject) -> None:
    """Draw the undeformed pipes in grey, beneath everything."""
    ghost, system = Paint(), found.system
    grey = plain_faces(system, found.course, GHOST, GHOST)
    paint_pipes(ghost, frame, system, found.course, found.course.at, grey, rim=PALE)
    draw(frame, ghost, zorder=1.0)


def occupied(
    frame: Frame,
    found: Subject,
    at: F8 | None = None,
    bodies: Sequence[Glyph] = (),
    *,
    corner: bool = True,
) -> Space:
    """Map what pipes and supports cover, and the corner of triad and bar."""
    space = Space(frame.size)
    block_pipes(space, frame, found, found.course.at if at is None else at)
    for glyph in bodies:
        for body in glyph.bodies:
            _box(space, frame, np.concatenate(body))
        for wire in glyph.wires:
            _box(space, frame, wire)
    if corner:
        space.box(0.5 * BOX[0], 0.5 * BOX[1], *BOX)
        space.box(95.0, 10.0, 190.0, 20.0)
    return space


def block_pipes(space: Space, frame: Frame, found: Subject, at: F8) -> None:
    """Take what pipes cover whose points are at (n, 3)."""
    flat, parts = frame.points(frame.flat(at)), found.course.parts
    half = half_widths(frame, found.course.radius) / frame.scale + 1.0
    space.lines(np.stack([flat[parts], flat[parts + 1]], axis=1), half[parts])


def _box(space: Space, frame: Frame, xyz: F8) -> None:
    points = frame.points(frame.flat(xyz))
    low, high = points.min(axis=0), points.max(axis=0)
    middle, size = 0.5 * (low + high), high - low
    space.body(*middle.tolist(), *size.tolist())


def label_order(system: System, supports: Sequence[int]) -> list[int]:
    """Nodes by importance: supports, then ends and branches, then the others spread evenly."""
    n = len(system.labels)
    count = np.bincount(system.ends.ravel(), minlength=n)
    rank = np.where(count == 2, 2, 1)
    rank[list(supports)] = 0
    spread = _spread(n)
    return sorted(range(n), key=lambda i: (rank[i], spread[i]))


def _spread(n: int) -> list[int]:
    """Ranks of 0 ... n-1 such that any first few of them lie evenly: their bits turned round."""
    bits = max(n - 1, 1).bit_length()
    return [int(f"{i:0{bits}b}"[::-1], 2) for i in range(n)]


def label_model(frame: Frame, space: Space, system: System, xyz: F8) -> int:
    """Label the nodes of a model at places (n_node, 3), those of supports in bold; count them."""
    held = set(card_nodes(system))
    order = label_order(system, sorted(held))
    found = label_nodes(
        frame, space, [system.labels[i] for i in order], xyz[order],
        bold=[i in held for i in order],
    )  # fmt: skip
    return len(found)


def label_nodes(
    frame: Frame,
    space: Space,
    texts: Sequence[str],
    at: F8,
    *,
    bold: Sequence[bool] | None = None,
    size: float = SMALL,
) -> list[Label]:
    """Write labels at points (n, 3), the important ones first, as many as have room.

    Returns
    -------
    The labels that have a place; `index` counts in `texts`.
    """
    heavy = [False] * len(texts) if bold is None else list(bold)
    known: dict[int, str] = {}

    def box(i: int) -> tuple[float, float]:
        known[i] = fitted(texts[i], LONGEST, size, bold=heavy[i])
        width, height = extent(known[i], size, heavy[i])
        return width + 2.0, height + 2.0

    points = frame.points(frame.flat(at)) if len(at) else np.zeros((0, 2))
    crowd = len(texts) > CROWD
    found = place(space, points, box, most=FEW if crowd else CROWD, far=CLOSE if crowd else np.inf)
    for label in found:
        text, bold_one = known[label.index], heavy[label.index]
        write(frame, label, points[label.index], text, bold=bold_one, size=size)
    return found


def write(
    frame: Frame, label: Label, point: F8, text: str, *, bold: bool = False, size: float = SMALL
) -> None:
    """Draw one label, with a line to its point where it is far from it."""
    x, y = frame.metres(np.array([label.x, label.y]))
    if label.leader:
        line = frame.metres(np.stack([point, foot(label, point)]))
        frame.axes.plot(*line.T, color=GREY, lw=0.6, zorder=4)
    frame.axes.text(
        x, y, shown(text), fontsize=size, color=INK if bold else "#3d4854", ha="center",
        va="center_baseline", fontweight="bold" if bold else "normal", zorder=7,
    )  # fmt: skip
