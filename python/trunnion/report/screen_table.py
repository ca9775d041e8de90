"""The cases on the terminal, a line each, in as many columns as its width allows."""

from collections.abc import Callable, Sequence

import click
import numpy as np

from trunnion.arrays import OPEN, SLIP, CaseResult
from trunnion.frozen import frozen
from trunnion.report.summary import Largest, largest_of
from trunnion.report.units import ReportUnits
from trunnion.results.supports import card_levels, is_good, lifted_rests

LUXURY = 6  # rank from which a column goes before any name is cut
LEAST = 6  # characters that a name keeps where room is short
PAINT = {"certified": "green", "NOT CONVERGED": "red"}


@frozen
class Field:
    """One column: its head, how a case is shown, whether words or numbers stand in it.

    The higher the rank, the sooner a narrow terminal goes without it.
    """

    head: str
    shown: Callable[[CaseResult, Largest], str]
    number: bool = False
    rank: int = 0


def case_table(
    cases: Sequence[CaseResult], units: ReportUnits, width: int
) -> tuple[str, list[str]]:
    """Give the head and a line a case."""
    if not cases:
        return "  no cases", []
    most = [largest_of(case) if is_good(case) else Largest() for case in cases]
    fields = _fields(units)
    cells = {
        f.head: [f.shown(case, m) for case, m in zip(cases, most, strict=True)] for f in fields
    }
    fields = [f for f in fields if any(cells[f.head])]
    while True:
        wide = {f.head: max(len(f.head), *map(len, cells[f.head])) for f in fields}
        excess = 2 + sum(wide.values()) + 2 * (len(fields) - 1) - width
        last = max(fields, key=lambda f: f.rank)
        if excess > 0 and last.rank < LUXURY:
            excess = _narrow(fields, wide, excess)
        if excess <= 0 or last.rank == 0:
            break
        fields = [f for f in fields if f is not last]
    rows = [[cells[f.head][i] for f in fields] for i in range(len(cases))]
    head = click.style(_line([f.head for f in fields], fields, wide), bold=True)
    return head, [_line(row, fields, wide) for row in rows]


def _fields(units: ReportUnits) -> list[Field]:
    move, force = units.movement, units.force

    def amount(quantity: str, value: float) -> str:
        if np.isnan(value):
            return ""
        own = getattr(units, quantity).showing(value)
        return str(own.text(value))

    return [
        Field("CASE", lambda c, _: c.name),
        Field("STATUS", lambda c, _: "certified" if is_good(c) else "NOT CONVERGED"),
        Field("WORST", _worst, True, 4),
        Field(f"MOVE [{move.unit}]", lambda _, m: amount("movement", m.move), True, 3),
        Field("AT", lambda _, m: m.node or "", rank=5),
        Field(f"LOAD [{force.unit}]", lambda _, m: amount("force", m.load), True, 1),
        Field("ON RESTRAINT", lambda _, m: m.support or "", rank=2),
        Field("OPEN", lambda c, _: _count(c, OPEN), True, 6),
        Field("SLIP", lambda c, _: _count(c, SLIP), True, 7),
    ]


def _worst(case: CaseResult, _: Largest) -> str:
    return "" if case.certificate is None else f"{case.certificate.worst:.1e}"


def _count(case: CaseResult, level: int) -> str:
    """Count the supports in one state; nothing where there are no states.

    A support whose rest has lifted off is open, whatever its guides do.
    """
    if not is_good(case) or case.gathered is not None:
        return ""
    counted = card_levels(case) == level
    if level == OPEN:
        counted[case.system.contacts.card[lifted_rests(case)]] = True
    return str(int(counted.sum()))


def _narrow(fields: Sequence[Field], wide: dict[str, int], excess: int) -> int:
    """Take width from names, the widest first; what is still too much comes back."""
    names = [f.head for f in fields if not f.number and f.head != "STATUS"]
    while excess > 0:
        widest = max(names, key=lambda name: wide[name])
        if wide[widest] <= max(LEAST, len(widest)):
            break
        wide[widest] -= 1
        excess -= 1
    return excess


def _line(cells: Sequence[str], fields: Sequence[Field], wide: dict[str, int]) -> str:
    pieces = []
    for cell, field in zip(cells, fields, strict=True):
        width = wide[field.head]
        text = cell if len(cell) <= width else cell[: width - 1] + "~"
        text = text.rjust(width) if field.number else text.ljust(width)
        pieces.append(click.style(text, fg=PAINT[cell]) if cell in PAINT else text)
    return ("  " + "  ".join(pieces)).rstrip()
