"""Published numbers beside ours: one comparison asserts and goes into the verification record.

`agrees` is met within its tolerance, `differs` is a number that does not come out: the test holds
our number and says what is known of the gap.  docs/verification.md is made of the rows of all
tests (`make verification-record`), and test_verification_record.py compares it.
"""

from dataclasses import dataclass, field

import pytest

PUBLISHED = "Published problems"
PROGRAMS = "Answers of independent programs"
CLOSED = "Closed forms and designs checked by hand"
KINDS = (PUBLISHED, PROGRAMS, CLOSED)


@dataclass(frozen=True)
class Source:
    """Where numbers come from: `deck` of models/, `text` says who printed them and on what page."""

    kind: str
    title: str
    deck: str
    text: str = field(compare=False)


@dataclass(frozen=True)
class Row:
    """One comparison: texts as they stand in the record; `remark` of what does not come out."""

    what: str
    printed: str
    ours: str
    allowed: str
    remark: str = ""


ROWS: dict[Source, dict[str, Row]] = {}


def digits(printed: str) -> int:
    """Significant digits of a printed number; zeros at the end of a whole number count."""
    mantissa = printed.lower().partition("e")[0].lstrip("+-")
    return len(mantissa.replace(".", "").lstrip("0")) or 1


def half_unit(printed: str) -> float:
    """Half a unit of the last digit of a printed number."""
    mantissa, _, power = printed.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 0.5 * 10.0 ** (int(power or 0) - decimals)


def shown(ours: float, printed: str, allowed: float, more: int = 1) -> str:
    """Our number with more digits than the print; a print of zero has no digits to follow."""
    if float(printed) == 0.0:
        return "0" if abs(ours) < 1e-3 * allowed else f"{ours:.2g}"
    count = digits(printed) + more
    if "e" in printed.lower():
        return f"{ours:.{count - 1}e}"
    return f"{ours:#.{count}g}".rstrip(".")


def _text(printed: float | str) -> str:
    """A number as the source prints it; Python's own zero behind a large one is not its print."""
    text = str(printed)
    return text.removesuffix(".0") if len(text) > len("999.0") else text


def agrees(
    source: Source,
    what: str,
    printed: float | str,
    ours: float,
    unit: str = "",
    *,
    abs: float | None = None,
    rel: float | None = None,
) -> None:
    """Assert that a number is met; without a tolerance to half a unit of its last digit."""
    text = _text(printed)
    if abs is None and rel is None:
        abs, said = 1.001 * half_unit(text), "last digit"  # 1.001: the print is rounded, too
    elif abs is None:
        said = f"{100 * rel:g} %"
    else:
        said = f"{abs:g} {unit}".strip()
    allowed = max(abs or 0.0, (rel or 0.0) * _size(text))
    _keep(source, Row(_named(what, unit), text, shown(float(ours), text, allowed), said))
    assert ours == pytest.approx(float(text), abs=abs or 0.0, rel=rel or 0.0), what


def differs(
    source: Source,
    what: str,
    printed: float | str,
    ours: float,
    unit: str = "",
    *,
    found: float,
    abs: float | None = None,
    rel: float | None = None,
    why: str,
) -> None:
    """Assert the number that is found where the printed one does not come out, and the gap."""
    text = _text(printed)
    row = Row(_named(what, unit), text, shown(float(ours), text, 0.0, 2), "not met", why)
    _keep(source, row)
    assert ours == pytest.approx(found, abs=abs, rel=rel), what
    assert ours != pytest.approx(float(text), abs=half_unit(text), rel=0.0), f"{what} comes out"


def refused(source: Source, what: str, printed: str, said: str, why: str) -> None:
    """Record that there is no number beside the printed one, and what is said instead."""
    _keep(source, Row(what, printed, said, "not met", why))


def _size(text: str) -> float:
    return max(float(text), -float(text))


def _named(what: str, unit: str) -> str:
    return f"{what} [{unit}]" if unit else what


def _keep(source: Source, row: Row) -> None:
    rows = ROWS.setdefault(source, {})
    assert row.what not in rows or rows[row.what] == row, f"{row.what} is recorded twice"
    rows[row.what] = row
