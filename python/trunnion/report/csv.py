"""The tables as CSV: one file a table, a row of heads with units, all digits of the numbers."""

import csv
from io import StringIO

from trunnion.arrays import Results
from trunnion.model import Model
from trunnion.report.sheets import Sheet, all_sheets


def files(results: Results, model: Model, stem: str) -> dict[str, bytes]:
    """Write every table, by the name of its file."""
    return {f"{stem}_csv/{sheet.name}.csv": _table(sheet) for sheet in all_sheets(results, model)}


def _table(sheet: Sheet) -> bytes:
    """Write one table in UTF-8."""
    stream = StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(f"{c.head} [{c.unit}]" if c.unit else c.head for c in sheet.columns)
    writer.writerows(zip(*(c.cells for c in sheet.columns), strict=True))
    return stream.getvalue().encode()
