"""The panel beside a picture: what its signs mean, drawn as the model draws them."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure

from trunnion.arrays import F8
from trunnion.report.plots.drawing import Frame
from trunnion.report.plots.glyphs import Glyph, Stand, glyphs, paint_glyphs
from trunnion.report.plots.page import NORMAL, SMALL, area, extent, fitted, put
from trunnion.report.plots.paint import Paint, draw
from trunnion.report.plots.palette import GREY, PIPE, RIM, Look
from trunnion.report.plots.pipe import OUTLINE
from trunnion.report.plots.scene import Subject

ICON = 0.62, 0.42  # width and height [in]
STEP = 0.47  # from one entry to the next [in]
BODY = 5.6  # size of a support in the legend [pt]
PIECE = 15.0  # half of the bit of pipe [pt]


def types(
    figure: Figure,
    x: float,
    y: float,
    room: float,
    found: Subject,
    frame: Frame,
    standing: Stand,
    bodies: Sequence[Glyph],
    looks: Sequence[Look],
) -> float:
    """List the types of supports in a picture, each with one of them and how many there are.

    Parameters
    ----------
    x, y : upper left corner of the list [in]; room : its width [in].

    Returns
    -------
    Where the list ends [in].
    """
    cards: dict[str, dict[int, int]] = {}
    for i, glyph in enumerate(bodies):
        cards.setdefault(glyph.kind, {}).setdefault(glyph.card, i)
    for own in cards.values():
        first = next(iter(own.values()))
        _icon(figure, (x, y - ICON[1], *ICON), found, frame, standing, bodies[first], looks[first])
        text = looks[first].text
        size = NORMAL if len(text) < 24 else SMALL
        line = fitted(f"{text}  ({len(own)})", 72.0 * (room - ICON[0] - 0.1), size)
        put(figure, x + ICON[0] + 0.1, y - 0.5 * ICON[1], line, size=size, middle=True)
        y -= STEP
    return y


def _icon(
    figure: Figure,
    place: tuple[float, float, float, float],
    found: Subject,
    frame: Frame,
    standing: Stand,
    glyph: Glyph,
    look: Look,
) -> None:
    """Draw one of the model's supports on a bit of its pipe."""
    size = 72.0 * np.array(place[2:])
    card, kind, view, scale = glyph.card, glyph.kind, frame.view, frame.scale
    thin = replace(
        standing,
        radius=np.minimum(standing.radius, 2.4 * scale),
        size=BODY * scale,
        sides=12,
        dots=False,
    )
    own = [g for g in glyphs(found.system, thin, [card]) if g.kind == kind]
    points = np.concatenate([p for g in own for p in [*g.wires, *(s for b in g.bodies for s in b)]])
    flat = view.flat(points)
    middle = 0.5 * (flat.min(axis=0) + flat.max(axis=0))
    axes = area(figure, *place)
    axes.set_axis_off()
    small = Frame(axes, view, scale, size, middle - 0.5 * scale * size)
    axes.set_xlim(small.low[0], small.low[0] + scale * size[0])
    axes.set_ylim(small.low[1], small.low[1] + scale * size[1])
    paint = Paint()
    _piece(paint, small, thin.at[card], thin.axis[card], float(thin.radius[card]))
    paint_glyphs(paint, small, thin, own, [look] * len(own))
    draw(small, paint, clip=False)


def _piece(paint: Paint, frame: Frame, at: F8, axis: F8, radius: float) -> None:
    """Add a bit of pipe."""
    step = frame.view.flat(axis)
    length = float(np.linalg.norm(step))
    if length < 0.05:
        return
    step = step / length
    normal, middle = np.array([-step[1], step[0]]), frame.flat(at)
    depth = np.array([float(frame.view.depth(at))])
    for grow, colour in ((OUTLINE * frame.scale, RIM), (0.0, PIPE)):
        a, b = PIECE * frame.scale * step, (radius + grow) * normal
        quad = np.stack([middle - a - b, middle + a - b, middle + a + b, middle - a + b])
        shade = np.array([to_rgba(colour)])
        paint.add([quad], shade, depth, shade, 0.35)


def states(
    figure: Figure, x: float, y: float, room: float, looks: Sequence[tuple[Look, int]]
) -> float:
    """List states with their marks and how many restraints are in each, as many in a row as fit."""
    at = x
    for look, count in looks:
        text = f"{look.text} ({count})"
        width = 0.26 + extent(text, NORMAL)[0] / 72.0
        if at > x and at + width > x + room:
            at, y = x, y - 0.24
        mark(figure, at + 0.1, y - 0.1, look)
        put(figure, at + 0.26, y - 0.1, text, middle=True)
        at += width + 0.25
    return y - 0.24


def mark(figure: Figure, x: float, y: float, look: Look, size: float = 7.0) -> None:
    """Draw the mark of a look at a place of the page [in]."""
    from matplotlib.lines import Line2D

    width, height = figure.get_size_inches()
    figure.add_artist(
        Line2D(
            [x / width], [y / height], marker=look.mark, ls="", ms=size, mew=1.3, mec=look.colour,
            mfc=look.colour if look.filled else "#ffffff",
        )
    )  # fmt: skip


def heading(figure: Figure, x: float, y: float, text: str) -> float:
    """Begin a list; gives where it goes on [in]."""
    put(figure, x, y, text, size=SMALL, colour=GREY, bold=True, top=True)
    return y - 0.24


def lines(figure: Figure, x: float, y: float, room: float, texts: Sequence[str]) -> float:
    """Write lines of text, each cut to `room` [in]."""
    for text in texts:
        put(figure, x, y, fitted(text, 72.0 * room, NORMAL), top=True)
        y -= 0.205
    return y
