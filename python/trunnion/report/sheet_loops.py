"""Tables of cycles: what every restraint carries after each step, and ranges over the loop."""

from collections.abc import Sequence

import numpy as np

from trunnion.arrays import F8, CycleResult
from trunnion.report.loops import step_names
from trunnion.report.sheets import LOADS, Cell, Column, Sheet, six
from trunnion.report.units import ReportUnits
from trunnion.results import tables
from trunnion.results.supports import card_loads, range_ratio

LOOP, ONCE = "RANGE, LOOP", "RANGE, ONE SHOT"
RATIO = "RATIO is the first range over the second: 2 where friction turns round, 1 without it"


def cycles(found: Sequence[CycleResult], units: ReportUnits) -> Sheet:
    """Loads on every restraint after each step of all loops, then the ranges of the last."""
    keys: list[tuple[Cell, ...]] = []
    loads: list[F8] = []
    ratios: list[F8] = []
    for cycle in _followed(found):
        assert cycle.supports is not None
        after = np.stack([card_loads(step) for step in cycle.path], axis=1)
        once, ratio = _once(cycle.supports, cycle.one_shot_supports)
        loads.append(np.concatenate([after, cycle.supports[:, None], once[:, None]], axis=1))
        ratios.append(_beside(ratio, len(cycle.path), loads[-1].shape))
        names = [*step_names(cycle), LOOP, ONCE]
        cards = cycle.path[0].system.cards
        keys += [(cycle.name, c.name, c.label, name) for c in cards for name in names]
    heads = ("CYCLE", "RESTRAINT", "NODE", "AFTER")
    note = f"ON THE RESTRAINT, global; a step is a loop and its case; {RATIO}"
    return _sheet("cycles", "Cycles: restraints", note, heads, keys, loads, ratios, units)


def cycle_forces(found: Sequence[CycleResult], units: ReportUnits) -> Sheet:
    """Ranges of the end forces of every element over the last loop and in one shot."""
    keys: list[tuple[Cell, ...]] = []
    ranges: list[F8] = []
    ratios: list[F8] = []
    for cycle in _followed(found):
        assert cycle.elements is not None
        loop = cycle.elements.reshape(-1, 6)
        alone = cycle.one_shot_elements
        once, ratio = _once(loop, None if alone is None else alone.reshape(-1, 6))
        ranges.append(np.stack([loop, once], axis=1))
        ratios.append(_beside(ratio, 0, ranges[-1].shape))
        parts = cycle.path[0].system.parts
        for name, part in zip(tables.element_ids(parts), parts, strict=True):
            for end in (part.start, part.end):
                keys += [(cycle.name, name, end, what) for what in (LOOP, ONCE)]
    heads = ("CYCLE", "ELEMENT", "AT", "WHAT")
    note = f"of the forces ON THE ELEMENT at its ends, global; {RATIO}"
    title = "Cycles: ranges of element forces"
    return _sheet("cycle_forces", title, note, heads, keys, ranges, ratios, units)


def _followed(found: Sequence[CycleResult]) -> list[CycleResult]:
    """Cycles that have numbers; the warnings say why the others have none."""
    return [cycle for cycle in found if cycle.supports is not None and cycle.path]


def _once(loop: F8, alone: F8 | None) -> tuple[F8, F8]:
    """(n, 6) range in one shot and ratio of the two; NaN where there is none."""
    once = np.full(loop.shape, np.nan) if alone is None else alone
    return once, range_ratio(loop, once)


def _beside(ratio: F8, row: int, shape: tuple[int, ...]) -> F8:
    """Ratios in the row of the loop's range, nothing in the others."""
    found = np.full(shape, np.nan)
    found[:, row] = ratio
    return found


def _sheet(
    name: str,
    title: str,
    note: str,
    heads: tuple[str, ...],
    keys: list[tuple[Cell, ...]],
    loads: list[F8],
    ratios: list[F8],
    units: ReportUnits,
) -> Sheet:
    cells: list[Sequence[Cell]] = [*zip(*keys, strict=True)] or [()] * len(heads)
    load, ratio = (
        np.concatenate([part.reshape(-1, 6) for part in parts]) if parts else np.zeros((0, 6))
        for parts in (loads, ratios)
    )
    shown = [[x if np.isfinite(x) else None for x in ratio[:, i].tolist()] for i in range(6)]
    columns = [Column(head, cells[i]) for i, head in enumerate(heads)]
    columns += six(LOADS, load, units.force, units.moment)
    columns += [Column(f"RATIO {head}", shown[i], "", 3) for i, head in enumerate(LOADS)]
    return Sheet(name, title, note, columns, keys=len(heads))
