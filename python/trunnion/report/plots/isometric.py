"""The isometric: pipes, supports by their types, node labels, axes, sizes."""

import numpy as np
from matplotlib.figure import Figure

from trunnion.arrays import F8
from trunnion.report.counts import counted
from trunnion.report.plots import legend
from trunnion.report.plots.drawing import Frame, length_bar, triad
from trunnion.report.plots.glyphs import glyphs, stand
from trunnion.report.plots.page import EDGE, FOOT, HEIGHT, TOP, WIDTH, page
from trunnion.report.plots.palette import TYPES
from trunnion.report.plots.pipe import plain_faces
from trunnion.report.plots.scene import (
    Subject,
    draw_model,
    frame_of,
    label_model,
    occupied,
)
from trunnion.report.units import ReportUnits

PANEL = 2.75  # width of the panel at the right [in]
PLACE = EDGE, FOOT, WIDTH - 2 * EDGE - PANEL - 0.15, HEIGHT - TOP - FOOT
NOTE = "one scale along X, Y and Z; restraints are drawn larger than they are"
SECTIONS = 8  # listed
LINKED = 1e-9  # m: nodes at one place need no line between them


def isometric(found: Subject, units: ReportUnits, title: str) -> Figure:
    """Draw the model with its supports."""
    system, course = found.system, found.course
    sizes = ((system.labels, "node"), (system.kind, "element"), (system.cards, "restraint"))
    count = ", ".join(counted(len(items), what) for items, what in sizes)
    figure = page(title, f"Isometric with supports: {count}", found.noted(NOTE))
    frame = frame_of(figure, PLACE, found)
    standing = stand(system, frame, course)
    bodies = glyphs(system, standing)
    looks = [TYPES[glyph.kind] for glyph in bodies]
    draw_model(frame, found, plain_faces(system, course), looks, bodies, standing)
    linked = _links(found, frame)
    triad(frame, system.up, found.north)
    length_bar(frame, units.length)
    labelled = label_model(frame, occupied(frame, found, None, bodies), system, system.xyz)
    x, y = WIDTH - EDGE - PANEL, HEIGHT - TOP - 0.05
    if bodies:
        y = legend.heading(figure, x, y, "RESTRAINTS")
        y = legend.types(figure, x, y, PANEL, found, frame, standing, bodies, looks)
        if linked:
            y = legend.lines(figure, x, y - 0.12, PANEL, ["dashed: held to another node"])
        y -= 0.15
    else:
        y = legend.lines(figure, x, y, PANEL, ["no restraints"]) - 0.1
    y = _facts(figure, x, y, found, units)
    if labelled < len(system.labels):
        text = f"{labelled} of {counted(len(system.labels), 'node')} have room for a label"
        legend.lines(figure, x, y - 0.1, PANEL, [text])
    return figure


def _facts(figure: Figure, x: float, y: float, found: Subject, units: ReportUnits) -> float:
    """List sections and sizes; gives where the list ends [in]."""
    y = legend.heading(figure, x, y, "PIPES (outside diameter x wall)")
    y = legend.lines(figure, x, y, PANEL, _sections(found, units)) - 0.1
    if any(part.type not in ("pipe", "bend", "reducer") for part in found.system.parts):
        y = legend.lines(figure, x, y, PANEL, ["darker: stiff body, joint, spring"]) - 0.1
    y = legend.heading(figure, x, y, "SIZE")
    return legend.lines(figure, x, y, PANEL, _sizes(found, units))


def _links(found: Subject, frame: Frame) -> int:
    """Draw a dashed line from each support that stands on another node to that node."""
    system, count = found.system, 0
    number = {label: i for i, label in enumerate(system.labels)} | system.alias
    for card in system.cards:
        if card.cnode is None:
            continue
        both = system.xyz[[number[card.label], number[card.cnode]]]
        if np.linalg.norm(both[1] - both[0]) > LINKED:
            x, y = frame.flat(both).T
            frame.axes.plot(x, y, ls=(0, (3, 2)), lw=1.2, color=TYPES["link"].colour, zorder=3)
            count += 1
    return count


def _sections(found: Subject, units: ReportUnits) -> list[str]:
    """Name every pipe that is drawn, the longest run first."""
    system, wall = found.system, units.wall
    length: dict[tuple[str, float, float], float] = {}
    for i, part in enumerate(system.parts):
        if part.type in ("pipe", "bend") and system.od[i] > 0.0:
            key = (part.section or part.type, float(system.od[i]), float(system.wall[i]))
            length[key] = length.get(key, 0.0) + float(system.length[i])
    names = sorted(length, key=lambda key: (-length[key], key))
    k, digits = wall.factor, 3 if wall.unit == "in" else 1
    size = 2 if wall.unit == "mm" else 4
    texts = [
        f"{name}  {round(od * k, digits):g} x {round(t * k, size):g} {wall.unit}"
        for name, od, t in names
    ]
    more = len(texts) - SECTIONS
    return (texts if more <= 0 else [*texts[:SECTIONS], f"and {more} more"]) or ["none"]


def _sizes(found: Subject, units: ReportUnits) -> list[str]:
    """Extent along the axes and the length of the centre lines."""
    q = units.length
    low, high = _extent(found.course.at, found.system.xyz)
    texts = [
        f"{name}  {_short((b - a) * q.factor)} {q.unit}"
        for name, a, b in zip("XYZ", low, high, strict=True)
    ]
    total = float(found.system.length.sum())
    return [*texts, f"pipe  {_short(total * q.factor)} {q.unit}"]


def _short(value: float) -> str:
    """Write six digits without a power of ten."""
    return f"{float(f'{value:.6g}'):.12g}"


def _extent(*points: F8) -> tuple[F8, F8]:
    every = np.concatenate(points)
    return every.min(axis=0), every.max(axis=0)
