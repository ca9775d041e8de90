"""Tables on disk: rows of plain values as CSV, and Markdown for people."""

import csv
from collections.abc import Iterable, Sequence
from pathlib import Path

from experiment import Row


def save(rows: Sequence[Row], path: Path) -> None:
    """Write rows; the columns are all that occur, in order of first sight."""
    names = list(dict.fromkeys(name for row in rows for name in row))
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, names, lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({name: _text(value) for name, value in row.items()})


def _text(value: object) -> object:
    return f"{value:.6g}" if isinstance(value, float) else value


def load(path: Path) -> list[Row]:
    """Read rows; numbers are numbers again, empty cells are left out; none where no file is."""
    if not path.exists():
        return []
    with path.open(newline="") as file:
        return [{k: _value(v) for k, v in row.items() if v} for row in csv.DictReader(file)]


def _value(text: str) -> object:
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text


def markdown(head: Sequence[str], body: Iterable[Sequence[object]]) -> str:
    """A Markdown table; cells are text already, or are made so."""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in body]
    return "\n".join(lines) + "\n"


def nodes(n: int) -> str:
    """A number of nodes with thin groups: 100 000."""
    return f"{n:,}".replace(",", " ")


def duration(seconds: float | None) -> str:
    """Time with a fitting unit, three digits."""
    if seconds is None:
        return ""
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("us", 1e-6)):
        if seconds >= size or unit == "us":
            return f"{_three(seconds / size)} {unit}"
    raise AssertionError


def length(metres: float | None) -> str:
    """A distance between answers: millimetres where they are visible, else a power of ten."""
    if metres is None:
        return ""
    if metres >= 1e-5:
        return f"{_three(1e3 * metres)} mm"
    return "0" if metres == 0.0 else f"{metres:.0e} m"


def times(ratio: float | None) -> str:
    """A ratio."""
    return "" if ratio is None else _three(ratio)


def _three(value: float) -> str:
    """Three digits without an exponent."""
    if value >= 100:
        return f"{value:.0f}"
    return f"{value:.1f}" if value >= 10 else f"{value:.2f}"
