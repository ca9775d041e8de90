"""A cycle: support loads step by step, those of the widest range."""

from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from trunnion.arrays import F8, CycleResult
from trunnion.frozen import frozen
from trunnion.report.loops import HEADS, step_names, verdict
from trunnion.report.plots import legend
from trunnion.report.plots.page import (
    EDGE,
    FOOT,
    NORMAL,
    SMALL,
    TOP,
    WIDTH,
    area,
    fitted,
    page,
    put,
)  # fmt: skip
from trunnion.report.plots.palette import GREY, PALE, Look
from trunnion.report.plots.scene import Subject
from trunnion.report.units import ReportUnits
from trunnion.results.supports import card_loads, is_good

HEIGHT = 5.6
PANEL = 3.7
LINES = 6  # loads drawn
STEPS = 40  # names of steps that have room
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#5b2a86", "#e69f00")
MARKS = "osD^vP"


@frozen(eq=False)
class Trace:
    """One load over the cycle: (n_step,) values [N] of a component of a restraint.

    alike : further loads that take the same course.
    """

    card: int
    component: int
    values: F8
    alike: int = 0


def traces(cycle: CycleResult) -> list[Trace]:
    """Pick the forces on restraints that range most over all steps, each course of them once."""
    steps = [step for step in cycle.path if is_good(step)]
    if not steps:
        return []
    load = np.stack([card_loads(step)[:, :3] for step in steps])
    extent, flat = np.ptp(load, axis=0).ravel(), load.reshape(len(steps), -1)
    least = 1e-6 * float(np.abs(load).max(initial=0.0))
    found: list[Trace] = []
    for i in np.argsort(-extent, kind="stable").tolist():
        if extent[i] <= least:
            break
        same = next((k for k, t in enumerate(found) if _alike(t.values, flat[:, i], least)), None)
        if same is not None:
            found[same] = replace(found[same], alike=found[same].alike + 1)
        elif len(found) < LINES:
            found.append(Trace(i // 3, i % 3, flat[:, i]))
    return found


def _alike(a: F8, b: F8, least: float) -> bool:
    return bool(np.abs(a - b).max() <= least)


def cycle_loads(found: Subject, cycle: CycleResult, units: ReportUnits, title: str) -> Figure:
    """Draw the loads on restraints of widest range against the steps of a cycle."""
    what = f"CYCLE {cycle.name} = {', '.join(cycle.cases)}:  {verdict(cycle, units)}"
    note = found.noted("loads are those of the pipe ON THE RESTRAINT")
    figure = page(title, what, note, height=HEIGHT)
    courses, q = traces(cycle), units.force
    x, y = WIDTH - EDGE - PANEL, HEIGHT - TOP - 0.1
    if not courses:
        legend.lines(figure, EDGE, y, WIDTH - 2 * EDGE, ["no load changes over the cycle"])
        return figure
    axes = area(figure, EDGE + 0.85, FOOT + 0.95, WIDTH - 2 * EDGE - PANEL - 1.15, y - FOOT - 1.15)
    n = np.arange(len(courses[0].values))
    axes.axhline(0.0, color=PALE, lw=0.8, zorder=0)
    y = legend.heading(figure, x, y, "WIDEST RANGES OVER ALL STEPS")
    cards = cycle.path[0].system.cards
    for i, trace in enumerate(courses):
        look = Look("", COLOURS[i], MARKS[i], filled=i < len(COLOURS))
        shown = trace.values * q.factor
        axes.plot(n, shown, color=look.colour, marker=look.mark, ms=5, lw=1.4, mew=0)
        legend.mark(figure, x + 0.1, y - 0.08, look)
        name = f"{cards[trace.card].name} {HEADS[trace.component]}"
        name += f" and {trace.alike} more alike" if trace.alike else ""
        put(figure, x + 0.26, y - 0.08, fitted(name, 72.0 * (PANEL - 0.3), NORMAL), middle=True)
        y -= 0.2
        text = f"{q.text(float(np.ptp(trace.values)))} {q.unit}{_once(cycle, trace, units)}"
        put(figure, x + 0.26, y - 0.08, text, size=SMALL, colour=GREY, middle=True)
        y -= 0.27
    names = step_names(cycle)[: len(n)]
    step = max(1, len(names) // STEPS + 1)
    turned = 0 if len(names) <= 10 and max(map(len, names)) <= 8 else 60
    axes.set_xticks(n[::step], [fitted(s, 70.0, SMALL) for s in names[::step]], rotation=turned)
    axes.set_ylabel(f"load [{q.unit}]")
    axes.yaxis.set_major_locator(MaxNLocator(7))
    axes.tick_params(labelsize=SMALL, length=3)
    axes.grid(axis="y", color="#eef1f4", lw=0.8)
    axes.set_axisbelow(True)
    for loop in range(1, cycle.loops):
        axes.axvline(loop * len(cycle.cases) - 0.5, color=PALE, lw=0.9, ls=":", gid="loop")
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    return figure


def _once(cycle: CycleResult, trace: Trace, units: ReportUnits) -> str:
    """Tell the range between the same cases, each solved on its own."""
    if cycle.one_shot_supports is None:
        return ""
    alone = float(cycle.one_shot_supports[trace.card, trace.component])
    return f"; each case on its own {units.force.text(alone)} {units.force.unit}"
