"""The text of a foreign file: ordinary files only, bounded in size, in whatever encoding."""

import hashlib
import os
import re
import stat
from typing import NoReturn

from trunnion.errors import DeckError, Problem
from trunnion.frozen import frozen
from trunnion.model import Place

MAX_BYTES = 100_000_000
MAX_LINE = 10_000_000  # characters: input XML stands on one line
MAX_LINES = 5_000_000

_CONTROL = re.compile(r"[\x00-\x08\x0e-\x19\x1b-\x1f\x7f]")
_SHOWN = 120  # characters of a line in a marker


@frozen
class Source:
    """A file as lines without their ends; `file` as the user named it.

    `encoding` is utf-8 (also for plain ASCII) or cp1252, which almost every byte fits.
    """

    file: str
    lines: tuple[str, ...]
    encoding: str = "utf-8"
    sha256: str = ""

    def marker(self, line: int, columns: tuple[int, int] | None = None) -> str:
        """Show a line (from 1) with carets under `columns` (first, last+1, from 0)."""
        if not 1 <= line <= len(self.lines):
            return ""
        text = self.lines[line - 1]
        first, last = columns or (0, 0)
        start = max(0, first - _SHOWN // 2) if last > _SHOWN else 0
        shown = "".join(c if c.isprintable() else "?" for c in text[start : start + _SHOWN])
        row = f"{line:>6} |  {shown.rstrip()}"
        if columns is None or last <= first:
            return row
        carets = "^" * min(last - first, _SHOWN - (first - start))
        return f"{row}\n{'':>7}|  {'':{first - start}}{carets}"


def read_source(path: str | os.PathLike[str]) -> Source:
    """Read a text file.

    Raises
    ------
    DeckError : no ordinary file, too large, no text.
    """
    return source_of(_bytes(path), str(path))


def source_of(data: bytes, file: str) -> Source:
    """Make the text of bytes: UTF-8, UTF-16 with a mark, else the Windows code page 1252.

    Raises
    ------
    DeckError : control characters, or lines too long or too many.
    """
    text, encoding = _decode(data)
    text = text.replace("\r\r\n", "\n").replace("\r\n", "\n").replace("\r", "\n").rstrip("\x1a\n")
    bad = _CONTROL.search(text)
    if bad is not None:
        line = text.count("\n", 0, bad.start()) + 1
        what = "NUL byte" if bad[0] == "\0" else f"control character 0x{ord(bad[0]):02X}"
        _refuse(file, line, f"{what} in the text; is this a text file?")
    if text.count("\n") >= MAX_LINES:
        _refuse(file, MAX_LINES, f"more than {MAX_LINES} lines")
    lines = tuple(text.split("\n")) if text else ()
    for number, line_text in enumerate(lines, 1):
        if len(line_text) > MAX_LINE:
            _refuse(file, number, f"line of {len(line_text)} characters; {MAX_LINE} are the limit")
    return Source(file, lines, encoding, hashlib.sha256(data).hexdigest())


def _decode(data: bytes) -> tuple[str, str]:
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", errors="replace"), "utf-16"
    try:
        return data.decode("utf-8-sig"), "utf-8"
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace"), "cp1252"


def _bytes(path: str | os.PathLike[str]) -> bytes:
    """Read an ordinary file whole, if it is not too large; never wait for a pipe."""
    file = str(path)
    try:
        number = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0))
        with os.fdopen(number, "rb") as stream:
            facts = os.fstat(stream.fileno())
            if not stat.S_ISREG(facts.st_mode):
                _refuse(file, 1, "this is no ordinary file")
            if facts.st_size <= MAX_BYTES:
                data = stream.read(MAX_BYTES + 1)
                if len(data) <= MAX_BYTES:
                    return data
    except (OSError, ValueError) as error:
        if isinstance(error, DeckError):
            raise
        reason = getattr(error, "strerror", None) or "not a path"
        _refuse(file, 1, f"cannot read the file: {reason}")
    _refuse(file, 1, f"the file is over {MAX_BYTES // 10**6} MB")


def _refuse(file: str, line: int, text: str) -> NoReturn:
    raise DeckError([Problem(Place(file, line), text)])
