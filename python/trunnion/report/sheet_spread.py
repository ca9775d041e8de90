"""Tables of the search for other answers: what was tried, how far the answers lie apart."""

from collections.abc import Iterator, Sequence

import numpy as np

from trunnion.arrays import F8, Spread, Spreading, Tried
from trunnion.report.causes import in_units
from trunnion.report.sheets import LOADS, Cell, Column, Sheet, six
from trunnion.report.units import ReportUnits
from trunnion.results import tables

APART = "largest less smallest over all answers; STARTS: same question, ORDERS: other load paths"


def spread_tries(found: Sequence[Spread], units: ReportUnits) -> Sheet:
    """One row a try: which answer it came to, or why to none; or why a case has but one."""
    rows: list[tuple[Cell, ...]] = []
    for spread in found:
        why = f"unique: {spread.unique}" if spread.unique else in_units(spread.cause or "", units)
        if why:
            rows.append((spread.case, None, None, None, why))
        for kind, s in _both(spread):
            rows += [(spread.case, kind, t.what, *_found(t, units)) for t in s.tried]
    cells: list[Sequence[Cell]] = [*zip(*rows, strict=True)] or [()] * 5
    columns = [
        Column("CASE", cells[0]),
        Column("OTHER", cells[1]),
        Column("TRIED", cells[2]),
        Column("ANSWER", cells[3], "", 0),
        Column("WHY", cells[4]),
    ]
    note = "answers are numbered a case and kind; none: no certified one, and why"
    return Sheet("spread_tries", "Other answers: tries", note, columns, groups=True)


def _found(t: Tried, units: ReportUnits) -> tuple[Cell, Cell]:
    """Number of the answer, or none and why."""
    if t.answer is None:
        return None, in_units(t.cause or "", units) or None
    return t.answer + 1, t.cause


def spread_loads(found: Sequence[Spread], units: ReportUnits) -> Sheet:
    """Spread of the load on every restraint."""
    keys: list[tuple[Cell, ...]] = []
    apart: list[F8] = []
    for spread in found:
        for kind, s in _both(spread):
            if s.supports is None or not s.answers:
                continue
            apart.append(s.supports)
            cards = s.answers[0].system.cards
            keys += [(spread.case, kind, card.name, card.label) for card in cards]
    heads = ("CASE", "OTHER", "RESTRAINT", "NODE")
    return _sheet("spread", "Other answers: restraint loads", heads, keys, apart, units)


def spread_forces(found: Sequence[Spread], units: ReportUnits) -> Sheet:
    """Spread of the end forces of every element."""
    keys: list[tuple[Cell, ...]] = []
    apart: list[F8] = []
    for spread in found:
        for kind, s in _both(spread):
            if s.elements is None or not s.answers:
                continue
            apart.append(s.elements.reshape(-1, 6))
            parts = s.answers[0].system.parts
            for name, part in zip(tables.element_ids(parts), parts, strict=True):
                keys += [(spread.case, kind, name, end) for end in (part.start, part.end)]
    heads = ("CASE", "OTHER", "ELEMENT", "AT")
    return _sheet("spread_forces", "Other answers: element forces", heads, keys, apart, units)


def _both(spread: Spread) -> Iterator[tuple[str, Spreading]]:
    """Give what was tried by kind; nothing where the answer is unique."""
    if spread.unique or spread.cause:
        return
    yield "STARTS", spread.starts
    if spread.orders is not None:
        yield "ORDERS", spread.orders


def _sheet(
    name: str,
    title: str,
    heads: tuple[str, ...],
    keys: list[tuple[Cell, ...]],
    apart: list[F8],
    units: ReportUnits,
) -> Sheet:
    cells: list[Sequence[Cell]] = [*zip(*keys, strict=True)] or [()] * len(heads)
    values = np.concatenate(apart) if apart else np.zeros((0, 6))
    columns = [Column(head, cells[i]) for i, head in enumerate(heads)]
    columns += six(LOADS, values, units.force, units.moment)
    return Sheet(name, title, APART, columns, keys=len(heads))
