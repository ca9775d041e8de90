"""Fixed columns: reals (2X,6G13.6), integers (2X,6I13), strings (7X,I5,1X,A)."""

import re
from collections.abc import Callable

from trunnion.formats.findings import Findings

WIDTH = 13
LARGEST = 1e24  # a number beyond has no meaning in any field
_MARGIN = 2
_REAL = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+))(?:[EeDd]([+-]?\d+)|([+-]\d+))?")
Read = Callable[[str], float | None]
_INTEGER = re.compile(r"[+-]?\d{1,12}(?:\.0*)?")


class Columns:
    """Reads fields of lines (from 1); what is wrong goes to the findings, and reads as 0."""

    def __init__(self, findings: Findings) -> None:
        self.findings = findings
        self.lines = findings.source.lines

    def text(self, line: int) -> str:
        """Give a line; past the end of the file an empty one."""
        return self.lines[line - 1] if 1 <= line <= len(self.lines) else ""

    def reals(self, line: int, n: int) -> list[float]:
        """Read `n` reals of one line; a blank field is 0."""
        return [_real(cell) or 0.0 for cell in self._cells(line, n, _real, "number")]

    def integers(self, line: int, n: int) -> list[int]:
        """Read `n` integers of one line; a blank field is 0."""
        cells = self._cells(line, n, _integer, "whole number")
        return [int(_integer(cell) or 0) for cell in cells]

    def many(self, line: int, n: int) -> list[float]:
        """Read `n` reals, six a line, from `line` on."""
        found: list[float] = []
        for k in range(0, n, 6):
            found += self.reals(line + k // 6, min(6, n - k))
        return found

    def string(self, line: int) -> str:
        """Read a string: its length in columns 8-12, its text from column 14."""
        text = self.text(line)
        length = text[7:12].strip()
        if not length:
            return ""
        if not length.isdigit() or not length.isascii():
            self.findings.fault(line, f"{length!r} is no length of a text", (7, 12))
            return ""
        return text[13 : 13 + int(length)].strip()

    def _cells(self, line: int, n: int, read: Read, what: str) -> list[str]:
        """Cut a line into fields; words apart by blanks are taken where columns do not fit."""
        text = self.text(line)
        cells = [text[_start(k) : _start(k + 1)].strip() for k in range(n)]
        rest = text[_start(n) :].strip()
        fits = not text[:_MARGIN].strip() and all(not c or read(c) is not None for c in cells)
        if fits and not rest:
            return cells
        words = text.split()
        if fits and all(read(word) is not None for word in rest.split()):
            message = "numbers beyond the known ones of a line are passed over"
            self.findings.assume(message, line)
            return cells
        if len(words) == n and all(read(word) is not None for word in words):
            self.findings.assume(
                "numbers do not stand in the columns of the format; they were read as words apart "
                "by blanks",
                line,
            )
            return words
        self._complain(line, n, read, what)
        return [c if read(c) is not None else "" for c in cells]

    def _complain(self, line: int, n: int, read: Read, what: str) -> None:
        """Name the first field at fault."""
        text = self.text(line)
        for k in range(n):
            cell = text[_start(k) : _start(k + 1)]
            if cell.strip() and read(cell.strip()) is None:
                word = cell.strip()
                first = _start(k) + len(cell) - len(cell.lstrip())
                message = f"{word[:40]!r} is not a {what}"
                self.findings.fault(line, message, (first, first + len(word)))
                return
        if text[:_MARGIN].strip():
            message = "columns 1 and 2 must be blank"
            self.findings.fault(line, message, (0, _MARGIN))
            return
        message = f"more text than {n} fields of {WIDTH} columns"
        self.findings.fault(line, message, (_start(n), len(text.rstrip())))


def _start(k: int) -> int:
    return _MARGIN + WIDTH * k


def _real(cell: str) -> float | None:
    """Read a real as Fortran does: 1.5, 1.5E+03, 1.5D3, 1.5+103; None: it is none."""
    match = _REAL.fullmatch(cell)
    if match is None or not cell.isascii():
        return None
    exponent = match[2] or match[3] or "0"
    value = float(f"{match[1]}e{exponent}") if len(exponent) < 6 else float("inf")
    return value if abs(value) <= LARGEST else None


def _integer(cell: str) -> float | None:
    """Read a whole number, also one written as 10.0000."""
    return float(cell) if cell.isascii() and _INTEGER.fullmatch(cell) else None
