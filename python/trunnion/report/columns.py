"""Columns of the text report: aligned, no wider than the page, whole arrays at a time."""

import re
from collections.abc import Sequence
from itertools import chain
from math import floor, log10

import numpy as np
from numpy.typing import ArrayLike

from trunnion.frozen import frozen
from trunnion.report.units import Quantity

PAGE = 132
CUT = 8  # characters, with the space behind, to which words are cut where room is short
Words = Sequence[str | None]


@frozen
class Column:
    """One column ready to print: two lines of heading, a % form, the cells."""

    head: str
    unit: str
    form: str
    width: int
    cells: Sequence[object]
    left: bool = False

    def heading(self, text: str) -> str:
        """Set a heading as the cells are set."""
        text = text[: self.width - (0 if self.left else 1)]
        return text.ljust(self.width) if self.left else text.rjust(self.width)


def words(head: str, cells: Words, *, least: int = 6, most: int = 64) -> Column:
    """Set words flush left, as wide as the longest, with a space after them."""
    known: Sequence[str] = [cell or "" for cell in cells]
    longest = max(map(len, known), default=0)
    width = min(max(longest, len(head), least), most) + 1
    if longest >= width:
        known = [_cut(cell, width - 1) for cell in known]
    return Column(head, "", f"%-{width}s", width, known, left=True)


def _cut(text: str, width: int) -> str:
    """Shorten what is too long, with a mark; the JSON has all of it."""
    return text if len(text) <= width else f"{text[: width - 1]}~"


def fitted(columns: Sequence[Column], width: int = PAGE) -> list[Column]:
    """Narrow the widest words until the columns fit the page."""
    columns = list(columns)
    while (excess := 2 + sum(c.width for c in columns) - width) > 0:
        i = max((i for i, c in enumerate(columns) if c.left), key=lambda i: columns[i].width)
        c = columns[i]
        if c.width <= CUT:
            break
        narrow = max(c.width - excess, CUT, *(d.width for d in columns if d.left and d is not c))
        narrow = min(narrow, c.width - 1)
        columns[i] = words(c.head, [str(cell) for cell in c.cells], least=1, most=narrow - 1)
    return columns


def without(
    columns: Sequence[Column], width: int, heads: Sequence[str], least: int = CUT
) -> list[Column]:
    """Leave columns out, in the order of `heads`, until words can be cut to fit the others.

    least : characters to which words may be cut.
    """
    kept = list(columns)
    for head in heads:
        if 2 + sum(min(c.width, least) if c.left else c.width for c in kept) <= width:
            break
        kept = [c for c in kept if c.head.strip() != head]
    return kept


def numbers(head: str, values: ArrayLike, quantity: Quantity, width: int = 11) -> Column:
    """Set numbers in the unit of a quantity; what would not fit loses decimals, then goes to E."""
    cells = np.asarray(values, dtype=np.float64) * quantity.factor
    return plain(head, cells, quantity.decimals, width, f"[{quantity.unit}]")


def plain(head: str, values: ArrayLike, decimals: int, width: int = 11, unit: str = "") -> Column:
    """Set numbers as they are; NaN, a number that was not given, is a dash."""
    cells = np.array(values, dtype=np.float64)
    largest = float(np.abs(cells[np.isfinite(cells)]).max(initial=0.0))
    whole = floor(log10(largest)) + 1 if largest >= 1.0 else 1
    room = width - 3 - whole  # a space, a sign, the point
    if room < 0:
        return Column(head, unit, f"%{width}.{max(width - 8, 0)}e", width, cells.tolist())
    decimals = min(decimals, room)
    cells[np.abs(cells) < 0.5 * 10.0**-decimals] = 0.0  # no "-0.000"
    if np.isnan(cells).any():
        shown = ["-" if np.isnan(x) else f"{x:.{decimals}f}" for x in cells.tolist()]
        return Column(head, unit, f"%{width}s", width, shown)
    return Column(head, unit, f"%{width}.{decimals}f", width, cells.tolist())


def integers(head: str, values: Sequence[int], width: int = 7) -> Column:
    """Set whole numbers."""
    return Column(head, "", f"%{width}d", width, values)


def table(columns: Sequence[Column], *, none: str = "none", width: int = PAGE) -> str:
    """Print columns under their headings, or a word when there are no rows."""
    count = len(columns[0].cells)
    if not count:
        return f"  {none}\n"
    columns = fitted(columns, width)
    form = "  " + "".join(c.form for c in columns) + "\n"
    cells = chain.from_iterable(zip(*(c.cells for c in columns), strict=True))
    rows = (form * count) % tuple(cells)
    if columns[-1].form.endswith("s"):
        rows = re.sub(" +$", "", rows, flags=re.MULTILINE)
    return headings(columns) + rows


def headings(columns: Sequence[Column]) -> str:
    """Print the heads of columns, their units and a rule."""
    head = "".join(c.heading(c.head) for c in columns).rstrip()
    units = "".join(c.heading(c.unit) for c in columns).rstrip()
    rule = "-" * sum(c.width for c in columns)
    return "".join(f"  {line}\n" for line in (head, units, rule) if line)


def chapter(title: str) -> str:
    """Begin a part of the report."""
    return f"\n\n{'=' * PAGE}\n{title}\n{'=' * PAGE}\n"


def section(title: str, note: str = "") -> str:
    """Begin a table."""
    return f"\n{title}{'   ' if note else ''}{note}\n{'-' * len(title)}\n"


def wrapped(text: str, indent: str = "  ") -> str:
    """Break a long sentence at the page's width."""
    import textwrap

    return textwrap.fill(text, PAGE, initial_indent=indent, subsequent_indent=indent + "  ") + "\n"
