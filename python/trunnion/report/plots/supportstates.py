"""What the restraints of a case do: their states, loads as arrows, N and F/(mu N) in a table."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from trunnion.arrays import F8, CaseResult
from trunnion.report.plots import legend
from trunnion.report.plots.arrows import Arrows, arrow, block_arrows, load_arrows
from trunnion.report.plots.drawing import Frame, length_bar, nice, triad
from trunnion.report.plots.glyphs import Glyph, Stand, glyphs, leaning, pulled, stand
from trunnion.report.plots.page import EDGE, FOOT, HEIGHT, SMALL, TOP, WIDTH, certified, page, put
from trunnion.report.plots.palette import ARROW, NO_STATE, STATES, Look
from trunnion.report.plots.pipe import plain_faces
from trunnion.report.plots.scene import Subject, draw_model, frame_of, label_nodes, occupied
from trunnion.report.plots.supportrows import rows_of_loads, rows_of_states
from trunnion.report.plots.table import table
from trunnion.report.units import ReportUnits
from trunnion.results.supports import (
    FREE,
    card_levels,
    card_loads,
    card_nodes,
    contact_levels,
    solved,
    without_sign,
)
from trunnion.results.supports import STATES as WORDS

PANEL = 4.15
PLACE = EDGE, FOOT, WIDTH - 2 * EDGE - PANEL - 0.2, HEIGHT - TOP - FOOT
SEEN = 0.05  # of the largest: smaller sizes without sign get no arrow


def support_states(found: Subject, case: CaseResult, units: ReportUnits, title: str) -> Figure:
    """Draw the restraints in the colours of their states with their loads."""
    mixed = case.gathered is not None
    system, course = found.system if mixed else case.system, found.course
    what = "loads on restraints" if mixed else "states of restraints and loads on them"
    figure = page(title, f"{case.name} = {case.text}:  {what}", found.noted(_note(case)))
    frame = frame_of(figure, PLACE, found)
    standing = stand(system, frame, course)
    bodies = glyphs(system, standing)
    looks = [NO_STATE] * len(bodies) if mixed else glyph_looks(case, bodies)
    draw_model(frame, found, plain_faces(found.system, course), looks, bodies, standing)
    if not mixed:
        _badges(frame, case, standing, small=standing.dots)
    arrows = _arrows(frame, case, standing, bodies)
    triad(frame, system.up, found.north)
    length_bar(frame, units.length)
    _labels(frame, found, case, bodies, arrows)
    _panel(figure, case, units, arrows)
    return figure


def _note(case: CaseResult) -> str:
    return f"{certified(case)}; loads are those of the pipe ON THE RESTRAINT"


def glyph_looks(case: CaseResult, bodies: Sequence[Glyph]) -> list[Look]:
    """Look of each body: the state of its own direction word, or that of its card."""
    levels, cards = contact_levels(case.system, solved(case)), card_levels(case)
    found = []
    for glyph in bodies:
        level = levels[glyph.contact] if glyph.contact >= 0 else cards[glyph.card]
        if glyph.kind == "snubber" and glyph.contact < 0:
            level = FREE
        found.append(STATES[WORDS[int(level)]])
    return found


def _badges(frame: Frame, case: CaseResult, standing: Stand, *, small: bool) -> None:
    """Mark the liveliest state of every card on the pipe, which does not hang on colours."""
    levels = card_levels(case)
    for level in sorted(set(levels.tolist())):
        look = STATES[WORDS[level]]
        x, y = frame.flat(standing.at[levels == level]).T
        frame.axes.plot(
            x, y, ls="", marker=look.mark, ms=3.0 if small else 6.0, mew=0.6 if small else 1.1,
            mec=look.colour if not look.filled else "#ffffff",
            mfc=look.colour if look.filled else "#ffffff", zorder=6, gid=f"state {WORDS[level]}",
        )  # fmt: skip


def signed_loads(case: CaseResult) -> tuple[F8, F8, list[bool]]:
    """Give rows of cards, loads (n, 3) and whether they are sizes: then an arrow a component."""
    load, signless = card_loads(case)[:, :3], without_sign(case)[:, :3]
    cards, rows, both = [], [], []
    largest = float(np.abs(load).max(initial=0.0))
    for i, (own, sizes) in enumerate(zip(load, signless, strict=True)):
        if case.kind == "spectrum" or sizes.any():
            for k in range(3):
                if abs(own[k]) > SEEN * largest:
                    cards.append(i)
                    rows.append(own[k] * np.eye(3)[k])
                    both.append(case.kind == "spectrum" or bool(sizes[k]))
        else:
            cards.append(i)
            rows.append(own)
            both.append(False)
    return np.array(cards, np.intp), np.array(rows).reshape(-1, 3), both


def _arrows(frame: Frame, case: CaseResult, standing: Stand, bodies: Sequence[Glyph]) -> Arrows:
    cards, load, both = signed_loads(case)
    pulls = pulled(load, leaning(standing, bodies)[cards])
    return load_arrows(
        frame, standing.at[cards], standing.radius[cards], load, both, pulls=pulls.tolist()
    )


def _labels(
    frame: Frame, found: Subject, case: CaseResult, bodies: Sequence[Glyph], arrows: Arrows
) -> None:
    """Label the nodes of restraints, the most loaded first."""
    system = case.system
    space = occupied(frame, found, None, bodies)
    block_arrows(space, frame, arrows)
    size = np.linalg.norm(card_loads(case)[:, :3], axis=1)
    nodes = np.array(card_nodes(system), np.intp)
    order = list(dict.fromkeys(nodes[np.argsort(-size, kind="stable")].tolist()))
    label_nodes(
        frame, space, [system.labels[i] for i in order], system.xyz[order],
        bold=[True] * len(order),
    )  # fmt: skip


def _panel(figure: Figure, case: CaseResult, units: ReportUnits, arrows: Arrows) -> None:
    """Explain states and arrows, and list the restraints."""
    x, y = WIDTH - EDGE - PANEL, HEIGHT - TOP - 0.05
    if case.gathered is None:
        levels = card_levels(case)
        counts = [(STATES[w], int((levels == i).sum())) for i, w in enumerate(WORDS)]
        y = legend.heading(figure, x, y, "STATES (number of restraints)")
        y = legend.states(figure, x, y, PANEL, [(look, n) for look, n in counts if n]) - 0.08
    if arrows.collection is not None:
        y = _key(figure, x, y, units, arrows)
    if not case.system.cards:
        legend.lines(figure, x, y, PANEL, ["no restraints"])
        return
    unit = f"[{units.force.unit}]"
    if case.gathered is None:
        rows = [row for _, row in rows_of_states(case, units)]
        heads = ("STATE", f"N {unit}", "F/(μN)")
    else:
        rows = rows_of_loads(case, units)
        heads = (f"FX {unit}", f"FY {unit}", f"FZ {unit}")
    table(figure, x, y - 0.05, PANEL, rows, heads)


def _key(figure: Figure, x: float, y: float, units: ReportUnits, arrows: Arrows) -> float:
    """Show how long an arrow of a round load is along the axes."""
    from matplotlib.patches import Polygon

    q = units.force
    value = nice(60.0 / arrows.points_per_load * q.factor)
    length = value / q.factor * arrows.points_per_load
    width, height = figure.get_size_inches()
    start = np.array([72.0 * (x + 0.05), 72.0 * (y - 0.1)])
    shape = arrow(start, start + np.array([length, 0.0])) / 72.0 / np.array([width, height])
    figure.add_artist(
        Polygon(shape, closed=True, fc=ARROW, ec="none", transform=figure.transFigure)
    )
    text = f"{value:.9g} {q.unit} along an axis"
    if arrows.least > 0.0:
        text += f"; no arrow below {float(f'{arrows.least * q.factor:.2g}'):.9g} {q.unit}"
    put(figure, x + 0.15 + length / 72.0, y - 0.1, text, size=SMALL, middle=True)
    return y - 0.3
