"""The part of a page that shows the model: equal scales, triad of axes, bar of length."""

from math import floor, log10, sqrt

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from trunnion.arrays import F8
from trunnion.frozen import frozen
from trunnion.report.plots.page import SMALL, area
from trunnion.report.plots.palette import GREY, INK
from trunnion.report.plots.view import View
from trunnion.report.units import Quantity

MARGIN = 46.0  # of paper around the model for supports, arrows and labels [pt]
TRIAD = 26.0  # length of its arrows [pt]
SHORTER = sqrt(2.0 / 3.0)  # isometric: of lengths along the axes
BOX = 108.0, 84.0  # corner kept for triad and bar: width, height [pt]


@frozen(eq=False)
class Frame:
    """Axes with the model fitted in.

    scale : metres on paper a point.  size : (2,) of the axes [pt].  low : (2,) their lower left
    corner in metres on paper.
    """

    axes: Axes
    view: View
    scale: float
    size: F8
    low: F8

    def flat(self, xyz: F8) -> F8:
        """(n, 2) metres on paper."""
        return self.view.flat(xyz)

    def points(self, flat: F8) -> F8:
        """(n, 2) points from the lower left corner of the axes."""
        found: F8 = (flat - self.low) / self.scale
        return found

    def metres(self, points: F8) -> F8:
        """(n, 2) metres on paper of points from the lower left corner."""
        found: F8 = self.low + self.scale * points
        return found


def fit(
    figure: Figure,
    place: tuple[float, float, float, float],
    view: View,
    xyz: F8,
    *,
    margin: float = MARGIN,
    corner: bool = True,
) -> Frame:
    """Fit points (n, 3) into a place of the page (left, low, width, height) [in].

    `corner` leaves the lower left corner to triad and bar.
    """
    axes = area(figure, *place)
    axes.set_axis_off()
    size = 72.0 * np.array(place[2:])
    flat = view.flat(xyz) if len(xyz) else np.zeros((1, 2))
    low, high = flat.min(axis=0), flat.max(axis=0)
    room = size - 2.0 * margin
    scale = float(((high - low) / room).max())
    if scale == 0.0:
        scale = 1.0 / room.min()  # a point: one metre fills the sheet
    middle = 0.5 * (low + high)
    frame = Frame(axes, view, scale, size, middle - 0.5 * scale * size)
    if corner and _crowds(frame, flat):  # move and shrink the model out of the corner
        free = np.array([0.0, BOX[1] - margin])
        room = room - free
        scale = float(max(((high - low) / room).max(), scale if (high == low).all() else 0.0))
        frame = Frame(axes, view, scale, size, middle - 0.5 * scale * (size + free))
    axes.set_xlim(frame.low[0], frame.low[0] + frame.scale * size[0])
    axes.set_ylim(frame.low[1], frame.low[1] + frame.scale * size[1])
    axes.set_aspect("equal", adjustable="box")
    return frame


def _crowds(frame: Frame, flat: F8) -> bool:
    """Tell whether points lie in the corner of triad and bar, with room for their supports."""
    at = frame.points(flat)
    return bool(((at[:, 0] < BOX[0] + 20.0) & (at[:, 1] < BOX[1] + 20.0)).any())


def triad(frame: Frame, up: F8, north: F8 | None) -> None:
    """Draw the global axes, the one against gravity marked, and north where it is known."""
    foot = np.array([40.0, 46.0])
    for name, axis in zip("XYZ", np.eye(3), strict=True):
        shift = frame.view.flat(axis) / SHORTER
        vertical = abs(float(axis @ up)) > 0.5
        _arrow(frame, foot, foot + TRIAD * shift, INK if vertical else GREY)
        text = f"{name} up" if vertical else name
        if north is not None and float(axis @ north) > 0.5:
            text += " north"
        _text(frame, foot + (TRIAD + 7.0) * shift, text, INK if vertical else GREY)


def lone_triad(figure: Figure, x: float, y: float, view: View, up: F8, north: F8 | None) -> None:
    """Draw the triad in a corner of the page that several models share [in]."""
    size = np.array(BOX)
    axes = area(figure, x, y, *(size / 72.0))
    axes.set_axis_off()
    axes.set_xlim(0.0, size[0])
    axes.set_ylim(0.0, size[1])
    triad(Frame(axes, view, 1.0, size, np.zeros(2)), up, north)


def _arrow(frame: Frame, start: F8, end: F8, colour: str) -> None:
    a, b = frame.metres(start), frame.metres(end)
    frame.axes.annotate(
        "",
        (b[0], b[1]),
        (a[0], a[1]),
        arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 1.3, "shrinkA": 0, "shrinkB": 0},
    )


def _text(frame: Frame, at: F8, text: str, colour: str) -> None:
    x, y = frame.metres(at)
    ahead = "left" if " " in text and abs(at[0] - 40.0) < 8.0 else "center"
    shift = -4.0 * frame.scale if ahead == "left" else 0.0
    frame.axes.text(
        x + shift, y, text, fontsize=SMALL, color=colour, ha=ahead, va="center", fontweight="bold"
    )


def length_bar(frame: Frame, length: Quantity) -> None:
    """Draw a round length along the axes of the model in the deck's unit."""
    most = 80.0 * frame.scale / SHORTER * length.factor
    value = nice(most)
    points = value / length.factor * SHORTER / frame.scale
    at = np.array([[14.0, 12.0], [14.0, 8.0], [14.0 + points, 8.0], [14.0 + points, 12.0]])
    x, y = frame.metres(at).T
    frame.axes.plot(x, y, color=INK, lw=1.1, solid_joinstyle="miter", zorder=6)
    x0, y0 = frame.metres(np.array([20.0 + points, 10.0]))
    frame.axes.text(
        x0, y0, f"{value:.9g} {length.unit} along the axes", fontsize=SMALL, color=INK, va="center"
    )


def nice(value: float) -> float:
    """Give the largest of 1, 2, 5 times a power of ten that is not more than a value above 0."""
    power = 10.0 ** floor(log10(value))
    found = max(f for f in (1.0, 2.0, 5.0) if f * power <= value * (1.0 + 1e-12))
    return found * power if power >= 1.0 else found / 10.0 ** -floor(log10(value))
