"""The tables of the workbook as data for the page, cut where a browser would choke."""

from trunnion.arrays import Results
from trunnion.model import Model
from trunnion.report.sheets import Sheet, all_sheets

MOST_CELLS = 250_000  # of one table
SKIPPED = ("warnings",)  # the page shows them on top


def tables(results: Results, model: Model) -> list[dict[str, object]]:
    """Give every table: heads, units, decimals and columns of cells with all their digits."""
    return [_table(s) for s in all_sheets(results, model) if s.name not in SKIPPED]


def _table(sheet: Sheet) -> dict[str, object]:
    rows = min(len(sheet), max(MOST_CELLS // len(sheet.columns), 1))
    note = sheet.note
    if rows < len(sheet):
        note += f"; the first {rows} of {len(sheet)} rows (all of them: --csv or --xlsx)"
    return {
        "name": sheet.name,
        "title": sheet.title,
        "note": note,
        "keys": sheet.keys,
        "columns": [
            {
                "head": c.head,
                "unit": c.unit,
                "decimals": c.decimals,
                "exponent": c.exponent,
                "cells": list(c.cells[:rows]),
            }
            for c in sheet.columns
        ],
    }
