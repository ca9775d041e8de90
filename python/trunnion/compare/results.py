"""Two results: what changed, in shares of the largest of its kind in the case."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from trunnion.compare.change import Change, by_importance
from trunnion.compare.numbers import came, changed_numbers, numbers_of, share, shown
from trunnion.compare.overall import changed_cycles, changed_envelope
from trunnion.compare.stored import read_report

NEAR = 1e-9  # of the largest of its kind


def diff_reports(a: Path, b: Path, tolerance: float | None) -> list[Change]:
    """Read two JSON reports and compare them, to `NEAR` where nothing else is said."""
    return diff_results(read_report(a), read_report(b), NEAR if tolerance is None else tolerance)


def diff_results(a: Mapping[str, Any], b: Mapping[str, Any], tolerance: float) -> list[Change]:
    """List what differs between two stored results, most important first."""
    changes: list[Change] = []
    for name in dict.fromkeys([*a["cases"], *b["cases"]]):
        old, new = a["cases"].get(name), b["cases"].get(name)
        if old is None or new is None:
            changes.append(came(f"case {name}", "case", old is None))
            continue
        changes += _case(name, old, new, tolerance)
    if not changes:  # else it follows from them
        changes += changed_envelope(a, b, tolerance)
    changes += changed_cycles(a, b, tolerance)
    changes += _frequencies(a, b, tolerance)
    return by_importance(changes)


def _case(name: str, old: Any, new: Any, tolerance: float) -> Iterator[Change]:
    was, now = ("solved" if case["converged"] else "not converged" for case in (old, new))
    if was != now:
        cause = str(old.get("cause") or new.get("cause") or "")
        yield Change(name, "case", was, now, 3e9, cause)
        return
    if old.get("text") != new.get("text"):
        yield Change(name, "loads", str(old.get("text")), str(new.get("text")), 1e9)
    if not old["converged"]:
        return
    states = [{s["id"]: s for s in case["supports"]} for case in (old, new)]
    for key, support in states[0].items():
        other = states[1].get(key)
        if other is not None and support.get("state") != other.get("state"):
            said = str(support.get("state")), str(other.get("state"))
            yield Change(f"{name} support {key}", "state", *said, 1.0)
    yield from changed_numbers(name, numbers_of(old), numbers_of(new), tolerance)


def _frequencies(a: Any, b: Any, tolerance: float) -> Iterator[Change]:
    rows = [(report.get("modes") or {}).get("frequency_hz") or [] for report in (a, b)]
    if len(rows[0]) != len(rows[1]):
        yield Change("modes", "number", str(len(rows[0])), str(len(rows[1])), 1e9)
    top = max([abs(x) for row in rows for x in row], default=1.0) or 1.0
    for i, (before, after) in enumerate(zip(*rows, strict=False), 1):
        weight = abs(after - before) / top
        if not weight <= tolerance:
            said = shown(before, "frequency", after), shown(after, "frequency", before)
            yield Change(f"mode {i}", "frequency", *said, weight, share(before, after))
