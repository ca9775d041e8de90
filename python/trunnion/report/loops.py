"""CYCLE in the text report: the loop followed, and the ranges over it beside the one-shot ones."""

from collections.abc import Sequence

import numpy as np

from trunnion.arrays import F8, CycleResult, Results
from trunnion.report.answers import largest
from trunnion.report.causes import in_units
from trunnion.report.columns import Column, headings, numbers, section, words, wrapped
from trunnion.report.counts import counted
from trunnion.report.units import ReportUnits
from trunnion.results.supports import card_loads, range_ratio

HEADS = ("FX", "FY", "FZ", "MX", "MY", "MZ")


def cycle_report(cycle: CycleResult, units: ReportUnits) -> str:
    """Print what became of one cycle."""
    title = f"{cycle.name} = {', '.join(cycle.cases)}"
    text = f"\n\n{title}\n{'=' * len(title)}\n{wrapped(verdict(cycle, units))}"
    if cycle.supports is None or cycle.elements is None:
        return text
    return text + _supports(cycle, cycle.supports, units) + _elements(cycle, cycle.elements, units)


def verdict(cycle: CycleResult, units: ReportUnits) -> str:
    """Say whether the loop repeats."""
    if cycle.cause:
        return f"not followed to its end: {in_units(cycle.cause, units)}"
    loops = f"{counted(cycle.loops, 'loop')} followed"
    if not np.isfinite(cycle.change):
        return f"{loops}: only from the second on can a loop be seen to repeat"
    word = "the loop repeats" if cycle.repeats else "the loop does not repeat"
    return f"{loops}, {word}: loads and movements changed by {cycle.change:.1e} of the largest"


def cycle_warnings(results: Results, units: ReportUnits) -> list[str]:
    """Name the cycles that were not followed to their end or do not repeat."""
    return [
        f"CYCLE {cycle.name}: {verdict(cycle, units)}"
        for cycle in results.cycles.values()
        if cycle.cause or not cycle.repeats
    ]


def cycle_lines(results: Results, units: ReportUnits) -> list[str]:
    """Say in a line each which cycles repeat."""
    found = results.cycles.values()
    return [f"  CYCLE {c.name}: {verdict(c, units)}" for c in found if c.repeats and not c.cause]


def step_names(cycle: CycleResult) -> list[str]:
    """Name the steps: "1 OPE", "1 SUS", "2 OPE" ..."""
    n = len(cycle.cases)
    return [f"{i // n + 1} {cycle.cases[i % n]}" for i in range(len(cycle.path))]


def _supports(cycle: CycleResult, loop: F8, units: ReportUnits) -> str:
    """Print a block a card: its load after every step of the first and last loop, the ranges."""
    cards, n, steps = cycle.path[0].system.cards, len(cycle.cases), step_names(cycle)
    shown = sorted({*range(n), *range(len(steps) - n, len(steps))})
    force = np.stack([card_loads(cycle.path[i]) for i in shown], axis=1)
    rows = np.concatenate([force, _both(loop, cycle.one_shot_supports)], axis=1)
    names = [*(steps[i] for i in shown), "RANGE, LOOP", "RANGE, ONE SHOT"]
    note = "forces and moments ON THE RESTRAINT, global, after a step; ranges of the last loop"
    ratio = range_ratio(loop, _once(loop, cycle.one_shot_supports))
    text = section(f"{cycle.name}: RESTRAINTS", note)
    return text + _blocks([card.name for card in cards], names, rows, ratio, units)


def _elements(cycle: CycleResult, loop: F8, units: ReportUnits) -> str:
    """Print a block an element end: the ranges of its end forces."""
    parts = cycle.path[0].system.parts
    titles = [f"{p.start}-{p.end} at {label}" for p in parts for label in (p.start, p.end)]
    flat = loop.reshape(-1, 6)
    alone = None if cycle.one_shot_elements is None else cycle.one_shot_elements.reshape(-1, 6)
    ratio, rows = range_ratio(flat, _once(flat, alone)), _both(flat, alone)
    text = section(f"{cycle.name}: RANGES OF ELEMENT END FORCES", "global")
    return text + _blocks(titles, ["RANGE, LOOP", "RANGE, ONE SHOT"], rows, ratio, units)


def _once(loop: F8, alone: F8 | None) -> F8:
    return np.full(loop.shape, np.nan) if alone is None else alone


def _both(loop: F8, alone: F8 | None) -> F8:
    """(n, 2, 6) range over the loop and in one shot."""
    return np.stack([loop, _once(loop, alone)], axis=1)


def _blocks(
    titles: Sequence[str], names: Sequence[str], values: F8, ratio: F8, units: ReportUnits
) -> str:
    """Print blocks of rows under their titles; values are (n, row, 6), ratio is (n, 6)."""
    known = np.nan_to_num(values)
    force, moment = largest(known[..., :3]), largest(known[..., 3:])
    q = units.force.showing(max(force, 1e-6 * moment))  # less is round-off
    m = units.moment.showing(max(moment, 1e-6 * force))
    flat = values.reshape(-1, 6)
    columns: list[Column] = [
        numbers(head, flat[:, i], m if i > 2 else q, 15) for i, head in enumerate(HEADS)
    ]
    lead = words("", ["RANGE, ONE SHOT", *names], most=24)
    row = "  " + lead.form + "".join(c.form for c in columns) + "\n"
    last = "  " + lead.form + "%15s" * 6 + "\n"
    cells = list(zip(*(c.cells for c in columns), strict=True))
    out, per = [headings([lead, *columns])], len(names)
    for i, title in enumerate(titles):
        if not known[i].any():
            continue
        out.append(f"  {title}\n")
        out += [row % (name, *cells[i * per + j]) for j, name in enumerate(names)]
        shown = ["-" if np.isnan(x) else f"{x:.4f}" for x in ratio[i].tolist()]
        out.append(last % ("RATIO", *shown))
    return "".join(out)
