"""The displaced shape of a case: how far every point moves, drawn larger by a stated factor."""

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from trunnion.arrays import F8, CaseResult
from trunnion.frozen import frozen
from trunnion.report.centreline import along
from trunnion.report.plots import legend
from trunnion.report.plots.drawing import Frame, length_bar, nice, triad
from trunnion.report.plots.glyphs import glyphs, stand
from trunnion.report.plots.labels import Space
from trunnion.report.plots.page import EDGE, FOOT, HEIGHT, NORMAL, TOP, WIDTH, area, certified, page
from trunnion.report.plots.palette import FIELD, INK, PAPER, Look
from trunnion.report.plots.pipe import half_widths
from trunnion.report.plots.scene import (
    Subject,
    block_pipes,
    draw_ghost,
    draw_model,
    frame_of,
    label_model,
    occupied,
)
from trunnion.report.units import ReportUnits
from trunnion.results.supports import solved

PANEL = 2.2
PLACE = EDGE, FOOT, WIDTH - 2 * EDGE - PANEL - 0.15, HEIGHT - TOP - FOOT
SHOWN = 0.08  # of the model's size: the largest displacement on paper
SPAN = 0.8  # and of a middle span at most
SUPPORT = Look("restraint", "#8a95a1")


@frozen(eq=False)
class Movement:
    """What moves and how it is drawn.

    move : (n, 3) of the points [m].  size : (n,) [m].  factor : 0 where there is no shape.
    """

    move: F8
    size: F8
    factor: float


def movement(found: Subject, case: CaseResult, *, has_shape: bool) -> Movement:
    """Displacements of a certified case at the points of the centre lines, and their factor."""
    _, move, _ = along(case, found.course.lines)
    move = move[:, :3]
    size = np.linalg.norm(move, axis=1)
    return Movement(move, size, magnification(found, size) if has_shape else 0.0)


def magnification(found: Subject, size: F8) -> float:
    """Give a round factor that shows the largest displacement, but not larger than a span."""
    most = float(size.max(initial=0.0))
    system = found.system
    whole = float(np.linalg.norm(np.ptp(system.xyz, axis=0))) if len(system.xyz) else 0.0
    spans = system.length[system.length > 0.0]
    bay = float(np.median(spans)) if len(spans) else whole
    if most <= 1e-12 * max(whole, 1e-3) or whole == 0.0:
        return 1.0
    return nice(min(SHOWN * whole, SPAN * bay) / most)


def displaced(
    found: Subject, case: CaseResult, units: ReportUnits, title: str, *, has_shape: bool = True
) -> Figure:
    """Draw the displaced pipes over the undeformed ones in grey, coloured by displacement."""
    course, system, q = found.course, case.system, units.movement
    m = movement(found, case, has_shape=has_shape)
    at = course.at + m.factor * m.move
    drawn = f"displacements drawn x {m.factor:.9g}"
    drawn = drawn if has_shape else "largest sizes, without a shape"
    note = found.noted(_note(case, has_shape=has_shape))
    figure = page(title, f"{case.name} = {case.text}:  {drawn}", note)
    frame = frame_of(figure, PLACE, found, at)
    if m.factor:
        draw_ghost(frame, found)
    standing = stand(found.system, frame, course)
    bodies = glyphs(found.system, standing)
    norm = Normalize(0.0, float(m.size.max(initial=0.0)) * q.factor or 1.0)
    value = 0.5 * (m.size[course.parts] + m.size[course.parts + 1]) * q.factor
    faces = colormaps[FIELD](norm(value))
    bodies = [] if standing.dots else bodies
    draw_model(frame, found, faces, [SUPPORT] * len(bodies), bodies, standing, at)
    triad(frame, system.up, found.north)
    length_bar(frame, units.length)
    x, y = WIDTH - EDGE - PANEL, HEIGHT - TOP - 0.1
    y = _bar(figure, x, y, norm, f"displacement [{q.unit}]")
    y = legend.heading(figure, x, y, "LARGEST")
    y = legend.lines(figure, x, y, PANEL, _largest(found, m, units))
    if m.factor:
        grey = ["grey: undeformed; restraints", "stand where they are"]
        legend.lines(figure, x, y - 0.12, PANEL, grey if bodies else ["grey: undeformed"])
    space = occupied(frame, found, at, bodies)
    block_pipes(space, frame, found, course.at)
    _mark_largest(frame, space, at, course.radius, m)
    state = solved(case)
    label_model(frame, space, system, system.xyz + m.factor * (state.u + state.u_low)[:, :3])
    return figure


def _note(case: CaseResult, *, has_shape: bool) -> str:
    text = certified(case)
    if not has_shape:
        text += "; root of the squares of a point's largest DX DY DZ, which need not occur together"
    return text


def _bar(figure: Figure, x: float, y: float, norm: Normalize, text: str) -> float:
    """Draw the bar of colours; gives where it ends [in]."""
    height = 2.6
    axes = area(figure, x, y - height - 0.22, 0.2, height)
    bar = figure.colorbar(ScalarMappable(norm, FIELD), cax=axes)
    bar.outline.set_visible(False)
    axes.tick_params(labelsize=NORMAL, length=3)
    axes.set_title(text, fontsize=NORMAL, loc="left", color=INK, pad=8)
    return y - height - 0.5


def _largest(found: Subject, m: Movement, units: ReportUnits) -> list[str]:
    """Tell the largest displacement, and of each direction, and where they are."""
    q = units.movement.showing(float(m.size.max(initial=0.0)))
    rows = [("", m.size), *((f"D{c}", m.move[:, k]) for k, c in enumerate("XYZ"))]
    texts = []
    for name, values in rows:
        if not len(values):
            return ["no pipes"]
        i = int(np.abs(values).argmax())
        text = f"{q.text(float(values[i]))} {q.unit} at {_where(found, i)}"
        texts.append(f"{name} {text}".strip())
    return texts


def _where(found: Subject, point: int) -> str:
    """Name a point: its node, or the element that it lies on."""
    lines, system = found.course.lines, found.system
    part, t = system.parts[int(lines.element[point])], float(lines.fraction[point])
    return part.start if t == 0.0 else part.end if t == 1.0 else f"{part.start}-{part.end}"


def _mark_largest(frame: Frame, space: Space, at: F8, radius: F8, m: Movement) -> None:
    """Put a ring around the point that moves most, wider than the pipe."""
    if not len(m.size) or m.size.max() == 0.0:
        return
    i = int(m.size.argmax())
    flat = frame.flat(at[i][None])
    wide = max(11.0, 2.0 * float(half_widths(frame, radius)[i]) / frame.scale + 6.0)
    for colour, thick in ((PAPER, 3.0), (INK, 1.3)):
        frame.axes.plot(
            *flat.T, "o", ms=wide, mfc="none", mec=colour, mew=thick, zorder=6,
            gid="largest" if colour == INK else None,
        )  # fmt: skip
    x, y = frame.points(flat)[0].tolist()
    space.box(x, y, wide + 3.0, wide + 3.0)
