"""A table of restraints on a page: as many rows as have room, the most loaded ones."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from trunnion.report.plots.legend import mark
from trunnion.report.plots.page import FOOT, SMALL, fitted, put, rule
from trunnion.report.plots.palette import GREY
from trunnion.report.plots.supportrows import Row

PITCH = 0.19  # from row to row [in]
MOST = 26  # rows
COLUMNS = (1.72, 0.78, 0.0)  # right ends, from the right end of the table [in]
WIDE = 0.72  # of a column [in]


def table(
    figure: Figure,
    x: float,
    y: float,
    width: float,
    rows: Sequence[Row],
    heads: Sequence[str],
) -> list[Row]:
    """Write rows in the deck's order; gives those that had room.

    Parameters
    ----------
    x, y : upper left corner [in]; width : of the table [in].
    heads : of three columns.
    """
    room = max(min(MOST, int((y - FOOT - 0.5) / PITCH)), 1)
    kept = list(range(len(rows)))
    if len(rows) > room:
        kept = sorted(sorted(kept, key=lambda i: (-rows[i].load, i))[: room - 1])
    ends = [x + width - column for column in COLUMNS]
    put(figure, x + 0.26, y, "RESTRAINT", size=SMALL, colour=GREY, bold=True, top=True)
    for end, head in zip(ends, heads, strict=True):
        put(figure, end, y, head, size=SMALL, colour=GREY, bold=True, top=True, right=True)
    rule(figure, y - 0.2, x, x + width)
    y -= 0.22 + 0.5 * PITCH
    for i in kept:
        row = rows[i]
        mark(figure, x + 0.1, y, row.look, 5.5)
        name = fitted(row.name, 72.0 * (ends[0] - WIDE - x - 0.26), SMALL)
        put(figure, x + 0.26, y, name, size=SMALL, middle=True)
        for end, cell in zip(ends, row.cells, strict=True):
            put(figure, end, y, cell, size=SMALL, middle=True, right=True)
        y -= PITCH
    if len(kept) < len(rows):
        text = f"the {len(kept)} most loaded of {len(rows)} rows; the text report has all"
        put(figure, x + 0.26, y, text, size=SMALL, colour=GREY, middle=True)
    return [rows[i] for i in kept]
