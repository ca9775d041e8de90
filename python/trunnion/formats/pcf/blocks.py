"""Text of a PCF to blocks: a keyword in column 1 with the indented attributes that follow it.

One keyword a line, values apart by blanks; columns mean nothing but the first.  Some writers
indent nothing: then a block opens at a known component, header or message keyword, and all else
is an attribute of the open block.
"""

import re
from collections.abc import Iterator
from dataclasses import replace

from trunnion.formats.findings import Findings
from trunnion.formats.pcf.words import (
    ATTRIBUTE_ONLY,
    COMPONENTS,
    HEADERS,
    OPENERS,
    PIPELINE_WORDS,
)
from trunnion.formats.source import Source
from trunnion.frozen import frozen

MAX_BLOCKS = 100_000


@frozen
class Attribute:
    """One line inside a block: keyword in capitals without <>, the rest of the line, its number."""

    name: str
    value: str
    line: int


@frozen
class Block:
    """A keyword with its attributes."""

    keyword: str
    value: str
    line: int
    attributes: tuple[Attribute, ...] = ()

    def get(self, name: str) -> str | None:
        """Value of the first attribute of a name; None if it is not there."""
        return next((a.value for a in self.attributes if a.name == name), None)


def blocks(source: Source, findings: Findings) -> list[Block]:
    """Split a file into blocks; a line that belongs to none is a fault."""
    rows = _decimals(list(_rows(source)), findings)
    indented = any(deep and row.name in ("END-POINT", "CO-ORDS") for deep, row in rows)
    found: list[tuple[Attribute, list[Attribute]]] = []
    for deep, row in rows:
        if len(found) >= MAX_BLOCKS:
            findings.fault(row.line, f"more than {MAX_BLOCKS} components and headers")
            break
        if _opens(row, deep, found[-1] if found else None, indented=indented):
            found.append((row, []))
        elif found:
            found[-1][1].append(row)
        else:
            text = f"{row.name or 'this line'} stands before any component or header"
            findings.fault(row.line, text)
    return [Block(head.name, head.value, head.line, tuple(rest)) for head, rest in found]


def _rows(source: Source) -> Iterator[tuple[bool, Attribute]]:
    """Yield each line that is not blank, and whether it is indented.

    A CONTINUATION goes on with the text of the line before it, wherever it stands.
    """
    last: tuple[bool, Attribute] | None = None
    for number, line in enumerate(source.lines, 1):
        word, _, value = line.strip().replace("\t", " ").partition(" ")
        name = word.upper().strip("<>")
        if name == "CONTINUATION" and last is not None:
            deep, row = last
            last = deep, replace(row, value=f"{row.value} {value.strip()}".strip())
        elif word:
            if last is not None:
                yield last
            last = line[0] in " \t", Attribute(name, value.strip(), number)
    if last is not None:
        yield last


def _decimals(
    rows: list[tuple[bool, Attribute]], findings: Findings
) -> list[tuple[bool, Attribute]]:
    """Read 123,4 as 123.4 in a file whose coordinates have commas and no points."""
    points = [row.value for _, row in rows if row.name in _POINTS]
    if any("." in value for value in points) or not any(map(_COMMA.search, points)):
        return rows
    findings.assume(
        "numbers have decimal commas", next(r.line for _, r in rows if r.name in _POINTS)
    )
    return [
        (deep, replace(row, value=_COMMA.sub(".", row.value)) if row.name in _NUMBERS else row)
        for deep, row in rows
    ]


def _opens(
    row: Attribute, deep: bool, last: tuple[Attribute, list[Attribute]] | None, *, indented: bool
) -> bool:
    """Tell whether a line opens a block."""
    if not deep and indented:
        head = last is not None and last[0].name in HEADERS
        return not (head and row.name.startswith(PIPELINE_WORDS) and row.name not in OPENERS)
    if indented or deep:
        # an indented component of a writer that indents everything: it has no value, and the
        # open block has its points already
        alone = row.name in COMPONENTS and not row.value
        full = last is not None and any(a.name in _POINTS for a in last[1])
        return (alone and (full or last is None or last[0].name not in COMPONENTS)) or (
            row.name.startswith("UNITS-") and (last is None or last[0].name.startswith("UNITS-"))
        )
    if row.name in ATTRIBUTE_ONLY:
        return False
    inside_pipe = last is not None and last[0].name in COMPONENTS
    if row.name in ("PIPELINE-REFERENCE", "SUPPORT") and inside_pipe and row.value:
        return False  # a reference inside a component, not a new block
    return row.name in OPENERS


_POINTS = ("END-POINT", "CO-ORDS", "CENTRE-POINT", "BRANCH1-POINT")
_NUMBERS = (*_POINTS, "BRANCH2-POINT", "WEIGHT", "START-CO-ORDS", "BEND-RADIUS", "ANGLE")
_COMMA = re.compile(r"(?<=\d),(?=\d)")
