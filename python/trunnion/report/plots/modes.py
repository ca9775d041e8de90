"""Shapes of the lowest natural modes, a panel each."""

from math import ceil

import numpy as np
from matplotlib import colormaps
from matplotlib.figure import Figure

from trunnion.arrays import F8, SPRING, ModeSet
from trunnion.report.counts import counted
from trunnion.report.plots.convergence import across
from trunnion.report.plots.drawing import lone_triad
from trunnion.report.plots.page import EDGE, FOOT, NORMAL, SMALL, TOP, WIDTH, page, put
from trunnion.report.plots.paint import Paint, draw
from trunnion.report.plots.palette import FIELD
from trunnion.report.plots.pipe import Course, paint_pipes
from trunnion.report.plots.scene import Subject, draw_ghost, frame_of, subject
from trunnion.results.interior import section_axes
from trunnion.results.tables import mass_percent

MOST = 6  # modes
PANEL = 3.15  # height of a row of panels [in]
SHOWN = 0.09  # of the model's size: the largest movement on paper
CORNER = 1.15  # height of the strip with the triad [in]
MARGIN = 22.0  # around the model [pt]


def mode_shapes(found: Subject, modes: ModeSet, title: str) -> Figure:
    """Draw the lowest modes, their largest translation as long in each panel."""
    own = subject(modes.system)
    own = Subject(own.system, own.course, found.view, found.north, found.caution)
    count = min(len(modes.frequency), MOST)
    row = across(count)
    rows = ceil(count / row)
    height = TOP + FOOT + rows * PANEL + CORNER
    more = (
        f"the lowest {count} of {len(modes.frequency)}" if count < len(modes.frequency) else count
    )
    what = f"Natural modes: {more}; the largest translation is as long in each panel"
    if count == 0:
        what = "Natural modes: none below the cut-off frequency"
    figure = page(title, what, found.noted(_note(modes)), height=height)
    wide = (WIDTH - 2 * EDGE) / row
    share = mass_percent(modes)
    for i in range(count):
        x, y = EDGE + (i % row) * wide, height - TOP - (i // row + 1) * PANEL
        _panel(figure, (x, y, wide - 0.1, PANEL - 0.55), own, modes, i)
        text = f"mode {i + 1}:  {modes.frequency[i]:.4g} Hz"
        put(figure, x + 0.05, y + PANEL - 0.28, text, size=NORMAL, bold=True)
        text = "   ".join(f"{c} {share[i, k]:.1f} %" for k, c in enumerate("XYZ"))
        put(figure, x + 0.05, y + PANEL - 0.46, f"effective mass  {text}", size=SMALL)
    lone_triad(figure, EDGE, FOOT, own.view, own.system.up, own.north)
    return figure


def _note(modes: ModeSet) -> str:
    text = "grey: at rest; dark: moves most"
    if modes.rigid:
        rigid = counted(modes.rigid, "mode")
        text += f"; {rigid} of 0 Hz: the structure, or a part of it, moves freely"
    return text


def _panel(
    figure: Figure,
    place: tuple[float, float, float, float],
    own: Subject,
    modes: ModeSet,
    mode: int,
) -> None:
    course = own.course
    move = shape_at(course, own, modes.shape[mode] + modes.shape_low[mode])
    size = np.linalg.norm(move, axis=1)
    whole = float(np.linalg.norm(np.ptp(own.system.xyz, axis=0)))
    most = float(size.max(initial=0.0)) or 1.0
    at = course.at + SHOWN * whole / most * move
    frame = frame_of(figure, place, own, at, margin=MARGIN, corner=False)
    draw_ghost(frame, own)
    value = 0.5 * (size[course.parts] + size[course.parts + 1]) / most
    paint = Paint()
    paint_pipes(paint, frame, own.system, course, at, colormaps[FIELD](value))
    draw(frame, paint)


def shape_at(course: Course, own: Subject, u: F8) -> F8:
    """(n, 3) movement along the lines: cubic between nodes, with the slopes of their rotations.

    Parameters
    ----------
    u : (n_node, 6) of the nodes.
    """
    system, e, t = own.system, course.lines.element, course.lines.fraction[:, None]
    a, b = u[system.ends[e, 0]], u[system.ends[e, 1]]
    length = np.where(system.kind[e] == SPRING, 0.0, system.length[e])[:, None]
    first = section_axes(system, e, np.zeros(len(e)))[:, 0]
    last = section_axes(system, e, np.ones(len(e)))[:, 0]
    start, end = length * np.cross(a[:, 3:], first), length * np.cross(b[:, 3:], last)
    smooth = (1 + 2 * t) * (1 - t) ** 2 * a[:, :3] + t**2 * (3 - 2 * t) * b[:, :3]
    smooth += t * (1 - t) ** 2 * start - t**2 * (1 - t) * end
    straight = (1 - t) * a[:, :3] + t * b[:, :3]
    found: F8 = np.where(length > 0.0, smooth, straight)
    return found
