"""The workbook: one sheet a table, made to be read, filtered and printed as it is.

Each sheet has its title and a note, heads and units that stay in view, filters on the units row
(so that units never move with the rows), and a rule where a new restraint or case begins.  Text
is written as text: a name that begins with "=" is no formula.
"""

from collections.abc import Iterator, Sequence
from datetime import datetime
from io import BytesIO
from typing import TYPE_CHECKING, Any

from trunnion.arrays import Results
from trunnion.frozen import frozen
from trunnion.model import Model
from trunnion.report.sheets import Column, Sheet, all_sheets

if TYPE_CHECKING:
    from xlsxwriter import Workbook
    from xlsxwriter.format import Format
    from xlsxwriter.worksheet import Worksheet

HEADS, UNITS, FIRST = 3, 4, 5  # rows of heads and units, first row of numbers, counted from 0
MOST_ROWS = 1_048_576 - FIRST  # of Excel
WIDEST = 60  # characters of a column
BIG = 500_000  # cells from which rows leave the memory as they are written
_NAVY, _PALE, _RULE, _GREY = "#1F3864", "#E7ECF5", "#9AA5B8", "#7F7F7F"
_GREEN, _RED, _PINK, _AMBER = "#1E7B34", "#B00020", "#FDE7E9", "#9C5700"
_WORDS: dict[str, dict[str, Any]] = {  # states and verdicts that a reader looks for
    "open": {"font_color": _GREY, "italic": True},
    "slip": {"font_color": _AMBER, "bold": True},
    "NOT CONVERGED": {"font_color": _RED, "bg_color": _PINK, "bold": True},
    "certified": {"font_color": _GREEN},
    "FAILED": {"font_color": _RED, "bg_color": _PINK, "bold": True},
}
_FONT: dict[str, Any] = {"font_name": "Calibri", "font_size": 10, "valign": "top"}
# no time of writing: the same results give the same bytes
_CREATED = datetime(2000, 1, 1)


@frozen(eq=False)
class _Styles:
    """Formats that all sheets share; heads and units stand as the cells below them."""

    title: "Format"
    note: "Format"
    head: "dict[bool, Format]"  # of numbers: True
    unit: "dict[bool, Format]"
    text: "Format"
    long: "Format"
    rule: "Format"
    nothing: "Format"
    words: "dict[str, Format]"


def files(results: Results, model: Model, stem: str) -> dict[str, bytes]:
    """Write the workbook."""
    import xlsxwriter

    sheets = all_sheets(results, model)
    big = sum(len(sheet) * len(sheet.columns) for sheet in sheets) > BIG
    stream = BytesIO()
    options = {"constant_memory": True} if big else {"in_memory": True}
    with xlsxwriter.Workbook(stream, options) as book:
        book.set_properties({"title": results.title, "created": _CREATED, "author": "Trunnion"})
        book.set_size(2600, 1600)
        styles = _styles(book)
        letter = model.units.length in ("in", "ft")
        for sheet in sheets:
            for name, part in _pieces(sheet):
                _sheet(book, book.add_worksheet(name), part, results.title, styles)
                book.worksheets()[-1].set_paper(1 if letter else 9)
    return {f"{stem}.xlsx": stream.getvalue()}


def _styles(book: "Workbook") -> _Styles:
    """Make the formats."""

    def of(**keys: Any) -> "Format":
        return book.add_format({**_FONT, **keys})

    def left(**keys: Any) -> "Format":
        return of(align="left", indent=1, **keys)

    def both(space: int, **keys: Any) -> "dict[bool, Format]":
        return {True: of(align="right", indent=space, **keys), False: left(**keys)}

    return _Styles(
        title=of(bold=True, font_size=14, font_color=_NAVY),
        note=of(italic=True, font_color=_GREY),
        head=both(0, bg_color=_NAVY, font_color="white", bold=True, valign="vcenter"),
        unit=both(2, bg_color=_PALE, font_color=_NAVY, bottom=1, bottom_color=_RULE),
        text=left(),
        long=left(text_wrap=True),
        rule=book.add_format({"top": 1, "top_color": _RULE}),
        nothing=of(num_format="0", font_color=_GREY),
        words={word: left(**keys) for word, keys in _WORDS.items()},
    )


def _pieces(sheet: Sheet) -> Iterator[tuple[str, Sheet]]:
    """Cut what is longer than Excel's sheets."""
    name = sheet.name.replace("_", " ").capitalize()
    if len(sheet) <= MOST_ROWS:
        yield name, sheet
        return
    for part, start in enumerate(range(0, len(sheet), MOST_ROWS), 1):
        rows = slice(start, start + MOST_ROWS)
        columns = [
            Column(c.head, c.cells[rows], c.unit, c.decimals, c.exponent) for c in sheet.columns
        ]
        title = f"{sheet.title}, part {part}"
        yield f"{name} {part}", Sheet(sheet.name, title, sheet.note, columns, sheet.keys, False)


def _sheet(book: "Workbook", page: "Worksheet", sheet: Sheet, title: str, styles: _Styles) -> None:
    """Write one sheet, row by row."""
    forms = [_number_format(book, column) for column in sheet.columns]
    wide = [_width(column) for column in sheet.columns]
    for i, width in enumerate(wide):
        page.set_column(i, i, width)
    page.set_row(0, 21)  # before any cell: in a large book rows leave the memory when written
    page.set_row(HEADS, 18)
    page.write_string(0, 0, f"{title}: {sheet.title}" if title else sheet.title, styles.title)
    page.write_string(1, 0, sheet.note, styles.note)
    for i, column in enumerate(sheet.columns):
        page.write_string(HEADS, i, column.head, styles.head[column.decimals is not None])
    for i, column in enumerate(sheet.columns):
        page.write_string(UNITS, i, column.unit, styles.unit[column.decimals is not None])
    texts = [styles.long if width >= WIDEST else styles.text for width in wide]
    least = [_nothing(column) for column in sheet.columns]
    for r, row in enumerate(zip(*(c.cells for c in sheet.columns), strict=True), FIRST):
        for i, cell in enumerate(row):
            if isinstance(cell, str):
                page.write_string(r, i, cell, styles.words.get(cell, texts[i]))
            elif cell is not None:
                form = styles.nothing if abs(cell) <= least[i] else forms[i]
                page.write_number(r, i, cell, form)
    _look(page, sheet, styles)


def _look(page: "Worksheet", sheet: Sheet, styles: _Styles) -> None:
    """What makes a sheet easy to read, to filter and to print."""
    last, right = FIRST + max(len(sheet), 1) - 1, len(sheet.columns) - 1
    page.hide_gridlines(2)
    page.freeze_panes(FIRST, sheet.keys)
    page.autofilter(UNITS, 0, last, right)
    if sheet.groups:
        criteria = f"=$A{FIRST + 1}<>$A{FIRST}"
        rule = {"type": "formula", "criteria": criteria, "format": styles.rule}
        page.conditional_format(FIRST, 0, last, right, rule)
    page.set_landscape()
    page.fit_to_pages(1, 0)
    page.repeat_rows(HEADS, UNITS)
    page.set_margins(left=0.4, right=0.4, top=0.5, bottom=0.6)
    page.set_footer("&L&8Trunnion&C&8&A&R&8&P / &N")


def _number_format(book: "Workbook", column: Column) -> "Format":
    """Format the numbers of a column."""
    form = f"#,##0.{'0' * column.decimals}" if column.decimals else "#,##0"
    return book.add_format({**_FONT, "num_format": "0.0E+00" if column.exponent else form})


def _nothing(column: Column) -> float:
    """Give the largest number that is shown as a plain 0, and never as -0.000."""
    return 0.0 if column.exponent else 0.5 * 10.0 ** -(column.decimals or 0)


def _width(column: Column) -> float:
    """Characters that head, unit with its filter, and cells need."""
    least = max(1.15 * len(column.head) + 2, len(column.unit) + 4, 7)
    return min(max(least, _longest(column) + 2), WIDEST)


def _longest(column: Column) -> int:
    cells: Sequence[Any] = [cell for cell in column.cells if cell is not None]
    if column.decimals is None or not cells:
        return max((len(cell) for cell in cells if isinstance(cell, str)), default=0)
    if column.exponent:
        return 9
    return max(len(f"{x:,.{column.decimals}f}") for x in (min(cells), max(cells)))
