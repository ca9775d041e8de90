"""How every case converged: out of balance by iteration, changes of state, the certificate."""

from collections.abc import Sequence
from math import ceil

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullLocator

from trunnion.arrays import F8, CaseResult, Results
from trunnion.certificate import LIMIT
from trunnion.frozen import frozen
from trunnion.report.balance import balance
from trunnion.report.causes import told_cause
from trunnion.report.counts import counted
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
from trunnion.report.plots.palette import GREY, INK, PALE, STATES
from trunnion.report.plots.scene import Subject
from trunnion.report.units import ReportUnits
from trunnion.results.supports import is_good

PANELS = 9  # cases drawn on their own
PANEL = 2.55  # height of a row of panels [in]
LEAST = 1e-17  # what is exact is drawn here
ROW = 0.22  # height of a case in the chart of certificates [in]
ROWS = 24  # cases in it
WORST = 3.7  # room for the words beside it [in]
PHASES = {
    "no friction": ("contacts without friction", "#56b4e9", "o"),
    "all stuck": ("every support stuck", "#cc79a7", "v"),
    "stick spring": ("stick springs stiffen", "#e69f00", "s"),
    "capacities": ("friction of given capacities", "#009e73", "^"),
    "coupled": ("friction coupled to N", "#0072b2", "D"),
    "status": ("status iteration", "#5b2a86", "o"),
}
OTHER = ("other", "#5d6875", "o")


@frozen(eq=False)
class Story:
    """The iterations of one case.

    value : (n,) before each: out of balance relative to `force`, or of the status iteration the
        last change relative to the largest displacement.  changed : supports that changed.
    """

    case: CaseResult
    value: F8
    phase: list[str]
    changed: F8


def story(case: CaseResult) -> Story:
    """Make the iterations of a case numbers without unit."""
    kinds = [phase_of(str(record.get("what", ""))) for record in case.history]
    changed = [record.get("n_changed", 0) for record in case.history]
    return Story(case, balance(case).value, kinds, np.array(changed, np.float64))


def phase_of(what: str) -> str:
    """Key of PHASES for what a record calls its iteration."""
    return next((key for key in PHASES if what.startswith(key)), what)


def convergence(found: Subject, results: Results, units: ReportUnits, title: str) -> Figure:
    """Draw a panel a case that was iterated, and the certificates of all."""
    cases = list(results.cases.values())
    iterated = [case for case in cases if case.history]
    chosen = _chosen(iterated)
    rows = ceil(len(chosen) / across(len(chosen)))
    listed = cases[:ROWS]
    below = 1.0 + ROW * max(len(listed), 2)
    height = TOP + rows * PANEL + (0.35 if rows else 0.0) + below + FOOT
    figure = page(title, _headline(cases, iterated, chosen), found.noted(_note()), height=height)
    top = height - TOP
    if chosen:
        top = _panels(figure, chosen, top)
    _certificates(figure, listed, len(cases), units, top - 0.05, below)
    return figure


def across(n: int) -> int:
    """Panels in a row."""
    return {0: 1, 1: 1, 2: 2, 4: 2}.get(n, 3)


def _chosen(iterated: Sequence[CaseResult]) -> list[CaseResult]:
    """Keep those that failed and those of most iterations, in the deck's order."""
    order = sorted(
        range(len(iterated)), key=lambda i: (is_good(iterated[i]), -len(iterated[i].history), i)
    )
    return [iterated[i] for i in sorted(order[:PANELS])]


def _headline(
    cases: Sequence[CaseResult], iterated: Sequence[CaseResult], chosen: Sequence[CaseResult]
) -> str:
    bad = [case.name for case in cases if not is_good(case)]
    text = f"Convergence: {len(iterated)} of {counted(len(cases), 'case')} iterated"
    if len(chosen) < len(iterated):
        text += f", the {len(chosen)} of most iterations are drawn"
    return text + (f"; NOT CONVERGED: {', '.join(bad)}" if bad else "; all cases are certified")


def _note() -> str:
    return (
        "out of balance before each iteration, relative to the largest force; dashed: limit of "
        f"the certificate, {power(LIMIT)}; less than 1e-17 is drawn there"
    )


def _panels(figure: Figure, chosen: Sequence[CaseResult], top: float) -> float:
    stories = [story(case) for case in chosen]
    n = across(len(chosen))
    wide = (WIDTH - 2 * EDGE) / n
    values = np.concatenate([s.value for s in stories])
    worst = [c.certificate.worst for c in chosen if c.certificate is not None]
    every = [v for v in [*values.tolist(), *worst] if np.isfinite(v) and v > 0.0]
    low = max(min([*every, LIMIT]) / 10.0, LEAST / 3.0)
    high = max([*every, 1.0]) * 10.0
    for i, one in enumerate(stories):
        x = EDGE + 0.62 + (i % n) * wide
        y = top - (i // n + 1) * PANEL + 0.5
        axes = area(figure, x, y, wide - 0.75, PANEL - 0.95)
        _panel(axes, one, (low, high))
        if i % n == 0:
            axes.set_ylabel("out of balance", fontsize=SMALL)
        if i + n >= len(stories):
            axes.set_xlabel("iteration", fontsize=SMALL)
    y = top - ceil(len(stories) / n) * PANEL - 0.05
    used = list(dict.fromkeys(phase for s in stories for phase in s.phase))
    _phases(figure, used, y - 0.02)
    return y - 0.3


def _panel(axes: Axes, one: Story, limits: tuple[float, float]) -> None:
    """Draw the iterations of one case, coloured by their phase."""
    n = np.arange(1, len(one.value) + 1)
    shown = np.maximum(one.value, LEAST)
    _dress(axes, limits, len(n))
    axes.plot(n, shown, color=PALE, lw=1.0, zorder=1)
    small = 4.5 if len(n) < 60 else 2.5
    for phase in dict.fromkeys(one.phase):
        _, colour, mark = PHASES.get(phase, OTHER)
        at = np.array([p == phase for p in one.phase])
        axes.plot(n[at], shown[at], mark, color=colour, ms=small, mew=0, zorder=3, gid=phase)
    axes.axhline(LIMIT, color=GREY, lw=0.9, ls="--", zorder=2, gid="limit")
    good, found = is_good(one.case), one.case.certificate
    name = fitted(f"{one.case.name}: {counted(len(n), 'iteration')}", 150.0, NORMAL, bold=True)
    axes.set_title(name, loc="left", fontsize=NORMAL, fontweight="bold", pad=5)
    if good and found is not None:
        end = len(n) + max(1.0, 0.03 * len(n))
        axes.plot(
            end, max(found.worst, LEAST), "*", color=INK, ms=9, mew=0, zorder=4, clip_on=False,
            gid="certificate",
        )  # fmt: skip
    else:
        axes.text(
            0.97, 0.93, "NOT CONVERGED", transform=axes.transAxes, ha="right", va="top",
            color=STATES["slip"].colour, fontweight="bold", fontsize=NORMAL,
        )  # fmt: skip
    changes = axes.twinx()
    changes.set_ylim(0, 3.0 * max(float(one.changed.max(initial=0.0)), 1.0))
    changes.bar(n, one.changed, width=0.8, color="#e3e7ec", zorder=0, gid="changes")
    changes.yaxis.set_major_locator(NullLocator())
    for side in ("top", "right", "left"):
        changes.spines[side].set_visible(False)
    axes.set_zorder(changes.get_zorder() + 1)
    axes.patch.set_visible(False)


def _dress(axes: Axes, limits: tuple[float, float], n: int) -> None:
    axes.set(yscale="log", ylim=limits, xlim=(0.3, n + max(1.7, 0.06 * n)))
    axes.yaxis.set_major_locator(LogLocator(numticks=7))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(power))
    axes.xaxis.set_major_locator(MaxNLocator(6, integer=True))
    axes.tick_params(labelsize=SMALL, length=3)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def power(value: float, position: int | None = None) -> str:
    """Write a power of ten as one is typed."""
    del position
    return f"{value:.0e}".replace("e-0", "e-").replace("e+0", "e") if value != 1.0 else "1"


def _phases(figure: Figure, used: Sequence[str], y: float) -> None:
    """Explain marks in one line below the panels."""
    from matplotlib.lines import Line2D

    width, height = figure.get_size_inches()
    entries = [PHASES.get(phase, (phase, *OTHER[1:])) for phase in used]
    entries = list(dict.fromkeys([*entries, ("certificate", INK, "*")]))
    x = EDGE + 0.1
    for text, colour, mark in entries:
        size = 9.0 if mark == "*" else 5.0
        figure.add_artist(
            Line2D([x / width], [y / height], marker=mark, ls="", ms=size, mew=0, color=colour)
        )
        label = put(figure, x + 0.12, y, text, size=SMALL, middle=True)
        x += 0.12 + label.get_window_extent().width / figure.dpi + 0.22
    figure.add_artist(
        Line2D([x / width], [y / height], marker="s", ls="", ms=7, mew=0, color="#e3e7ec")
    )
    put(figure, x + 0.12, y, "restraints that changed state", size=SMALL, middle=True)


def _certificates(
    figure: Figure,
    cases: Sequence[CaseResult],
    total: int,
    units: ReportUnits,
    top: float,
    height: float,
) -> None:
    """Draw every item of every certificate as a dot in the row of its case."""
    left = EDGE + 1.5
    axes = area(figure, left, top - height + 0.5, WIDTH - left - EDGE - WORST, height - 0.85)
    more = f" (the first {len(cases)} of {total} cases)" if len(cases) < total else ""
    axes.set_title(f"Certificates{more}", loc="left", fontsize=NORMAL, fontweight="bold", pad=6)
    axes.set(xscale="log", xlim=(LEAST / 3.0, 1e-8), ylim=(max(len(cases), 1) - 0.5, -0.5))
    for i, case in enumerate(cases):
        axes.axhline(i, color="#eef1f4", lw=0.8, zorder=0)
        found = case.certificate
        if not is_good(case) or found is None:
            text = fitted(f"NOT CONVERGED: {told_cause(case, units)}", 72.0 * WORST - 12.0, SMALL)
            axes.text(
                1.015, i, text, transform=axes.get_yaxis_transform(), fontsize=SMALL,
                va="center", color=STATES["slip"].colour,
            )  # fmt: skip
            continue
        values = [max(item.value, LEAST) for item in found.items] or [max(found.worst, LEAST)]
        fill = "#ffffff" if found.inherited else "#0072b2"
        axes.plot(values, [i] * len(values), "o", color="#0072b2", ms=4.5, mfc=fill, gid=case.name)
        text = fitted(f"worst {found.worst:.1e}, {found.where}", 72.0 * WORST - 12.0, SMALL)
        axes.text(1.015, i, text, transform=axes.get_yaxis_transform(), fontsize=SMALL, va="center")
    axes.axvline(LIMIT, color=GREY, lw=0.9, ls="--", gid="limit")
    names = [fitted(case.name, 72.0 * 1.35, SMALL) for case in cases]
    axes.set_yticks(range(len(cases)), names, fontsize=SMALL)
    axes.xaxis.set_major_locator(LogLocator(numticks=6))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(power))
    axes.tick_params(labelsize=SMALL, length=3)
    axes.tick_params(axis="y", length=0)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)
    if any(case.certificate is not None and case.certificate.inherited for case in cases):
        axes.set_xlabel(
            "items of each certificate; hollow: inherited from the cases combined", fontsize=SMALL
        )
    else:
        axes.set_xlabel("items of each certificate", fontsize=SMALL)
