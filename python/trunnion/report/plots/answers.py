"""Further answers of one case beside each other: the same loads, other states of the restraints."""

from math import ceil

import numpy as np
from matplotlib.figure import Figure

from trunnion.arrays import F8, CaseResult, Spread
from trunnion.report.plots.arrows import block_arrows, load_arrows
from trunnion.report.plots.drawing import lone_triad
from trunnion.report.plots.glyphs import glyphs, leaning, pulled, stand
from trunnion.report.plots.legend import mark
from trunnion.report.plots.page import EDGE, FOOT, NORMAL, SMALL, TOP, WIDTH, fitted, page, put
from trunnion.report.plots.palette import GREY
from trunnion.report.plots.pipe import plain_faces
from trunnion.report.plots.scene import Subject, draw_model, frame_of, label_nodes, occupied
from trunnion.report.plots.supportrows import Row, rows_of_states
from trunnion.report.plots.supportstates import glyph_looks
from trunnion.report.units import ReportUnits
from trunnion.results.supports import card_loads, card_nodes

NOTE = "loads are those of the pipe ON THE RESTRAINT"
MOST, ACROSS = 6, 3
PANEL = 5.0  # height of a row of panels [in]
CORNER = 1.15  # height of the strip with the triad [in]
LISTED = 5  # restraints below each
MARGIN = 48.0
PITCH = 0.185  # of the lists [in]


def answers(found: Subject, spread: Spread, units: ReportUnits, title: str) -> Figure:
    """Draw each certified answer that was found of a case."""
    every = spread.starts.answers
    shown = every[:MOST]
    rows = ceil(len(shown) / ACROSS)
    height = TOP + FOOT + rows * PANEL + CORNER
    more = f", the first {len(shown)} are drawn" if len(shown) < len(every) else ""
    what = (
        f"{spread.case} = {shown[0].text}:  {len(every)} certified answers to the same loads{more}"
    )
    figure = page(title, what, found.noted(NOTE), height=height)
    wide = (WIDTH - 2 * EDGE) / min(ACROSS, len(shown))
    most = max(float(np.linalg.norm(card_loads(c)[:, :3], axis=1).max(initial=0.0)) for c in shown)
    apart = _apart(shown)
    for i, case in enumerate(shown):
        x, y = EDGE + (i % ACROSS) * wide, height - TOP - (i // ACROSS + 1) * PANEL
        below = 0.3 + PITCH * (min(LISTED, len(apart)) + 1)
        place = x, y + below, wide - 0.15, PANEL - below - 0.35
        _panel(figure, place, found, case, most)
        put(figure, x + 0.05, y + PANEL - 0.2, f"answer {i + 1}", size=NORMAL, bold=True)
        _list(figure, x + 0.05, y + below - 0.1, wide - 0.35, case, apart, units)
    lone_triad(figure, EDGE, FOOT, found.view, found.system.up, found.north)
    return figure


def _panel(
    figure: Figure, place: tuple[float, float, float, float], found: Subject, case: CaseResult,
    most: float,
) -> None:  # fmt: skip
    frame = frame_of(figure, place, found, margin=MARGIN, corner=False)
    standing = stand(case.system, frame, found.course)
    bodies = glyphs(case.system, standing)
    looks = glyph_looks(case, bodies)
    draw_model(frame, found, plain_faces(found.system, found.course), looks, bodies, standing)
    load = card_loads(case)[:, :3]
    pulls = pulled(load, leaning(standing, bodies))
    arrows = load_arrows(
        frame, standing.at, standing.radius, load, [False] * len(load),
        pulls=pulls.tolist(), most=most,
    )  # fmt: skip
    space = occupied(frame, found, None, bodies, corner=False)
    block_arrows(space, frame, arrows)
    nodes = list(dict.fromkeys(card_nodes(case.system)))
    label_nodes(
        frame, space,
        [case.system.labels[i] for i in nodes], case.system.xyz[nodes], bold=[True] * len(nodes),
    )  # fmt: skip


def _apart(cases: tuple[CaseResult, ...]) -> list[int]:
    """Cards whose load differs between the answers, the widest first."""
    load: F8 = np.stack([card_loads(case)[:, :3] for case in cases])
    width = np.ptp(load, axis=0).max(axis=1)
    order = np.argsort(-width, kind="stable").tolist()
    return [i for i in order if width[i] > 0.0]


def _list(
    figure: Figure, x: float, y: float, width: float, case: CaseResult, apart: list[int],
    units: ReportUnits,
) -> None:  # fmt: skip
    """Write what the restraints do that differ most between the answers."""
    by_card: dict[int, list[Row]] = {}
    for card, row in rows_of_states(case, units):
        by_card.setdefault(card, []).append(row)
    unit = units.force.unit
    rows = [row for card in apart for row in by_card.get(card, [])][:LISTED]
    for head, at in (("RESTRAINT", 0.22), ("STATE", 0.52 * width)):
        put(figure, x + at, y, head, size=SMALL, colour=GREY, bold=True)
    put(figure, x + width, y, f"N [{unit}]", size=SMALL, colour=GREY, bold=True, right=True)
    for row in rows:
        y -= PITCH
        mark(figure, x + 0.08, y + 0.04, row.look, 5.5)
        put(figure, x + 0.22, y, fitted(row.name, 36.0 * width, SMALL), size=SMALL)
        put(figure, x + 0.52 * width, y, row.cells[0], size=SMALL)
        put(figure, x + width, y, row.cells[1] or "0", size=SMALL, right=True)
