"""The tables as CSV: one file a table, a row of heads with units, all digits of the numbers.

A spreadsheet takes text that begins with one of `FORMULA` for a formula, and names come from
decks and files of strangers: an apostrophe before it makes it text.
"""

import csv
from collections.abc import Iterable, Sequence
from io import StringIO

from trunnion.arrays import Results
from trunnion.model import Model
from trunnion.report.sheets import Cell, Sheet, all_sheets

FORMULA = ("=", "+", "-", "@", "\t", "\r")


def files(results: Results, model: Model, stem: str) -> dict[str, bytes]:
    """Write every table, by the name of its file."""
    return {f"{stem}_csv/{sheet.name}.csv": _table(sheet) for sheet in all_sheets(results, model)}


def _table(sheet: Sheet) -> bytes:
    """Write one table."""
    heads = [f"{c.head} [{c.unit}]" if c.unit else c.head for c in sheet.columns]
    return csv_bytes([heads, *zip(*(c.cells for c in sheet.columns), strict=True)])


def csv_bytes(rows: Iterable[Sequence[Cell]]) -> bytes:
    """Write rows in UTF-8; text that would be a formula stays text, numbers are numbers."""
    stream = StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerows(map(_plain, row) for row in rows)
    return stream.getvalue().encode()


def _plain(cell: Cell) -> Cell:
    return f"'{cell}" if isinstance(cell, str) and cell.startswith(FORMULA) else cell
