"""What a file says beside what follows from other numbers: the first place at which they differ.

What is written again from the same numbers must be the same to the last digit.  What takes more
arithmetic, as modes that combine, must agree to 1e-9 of itself; below 1e-4 of the largest of its
kind to 1e-13 of that, which is round-off.
"""

import json
from collections.abc import Iterator, Mapping
from typing import Any

from trunnion.arrays import CaseResult, Results

WRITTEN = ("kind", "text", "loads", "reactions", "frozen_check", "nodes", "nodes_low",
           "supports", "elements", "stresses")  # fmt: skip
CLOSE, ROUND_OFF = 1e-9, 1e-13


def written(result: CaseResult) -> dict[str, Any]:
    """Give what the report says of one case."""
    from trunnion.report.json import json_report

    report = json.loads(json_report(Results("", {result.name: result})))
    again: dict[str, Any] = report["cases"][result.name]
    return again


def changed(
    result: CaseResult, stored: Mapping[str, Any], tables: tuple[str, ...] = WRITTEN
) -> str:
    """Say what the file holds that these numbers do not give; nothing if all is the same."""
    again = written(result)
    return differing(again, stored, tables)


def differing(again: Mapping[str, Any], stored: Mapping[str, Any], tables: tuple[str, ...]) -> str:
    """Name the first of some entries that is not the same to the last digit."""
    for table in tables:
        place = first(again.get(table), stored.get(table), table)
        if place:
            return f"{place} is not what the other numbers give"
    return ""


def first(a: Any, b: Any, place: str) -> str:
    """Name the first place at which two values of JSON differ."""
    if a == b:
        return ""
    pairs = _pairs(a, b)
    if pairs is None:
        return place
    found = (first(x, y, f"{place} {key}") for key, x, y in pairs)
    return next((said for said in found if said), place)


def far(
    a: Mapping[str, Any], b: Mapping[str, Any], tables: tuple[str, ...], close: float = CLOSE
) -> str:
    """Name the first place at which two entries are not close; of other values, not equal."""
    for table in tables:
        largest: dict[str, float] = {}
        _measure(a.get(table), table, largest)
        place = _far(a.get(table), b.get(table), table, table, largest, close)
        if place:
            return f"{place} is not what the other numbers give"
    return ""


def _measure(a: Any, kind: str, largest: dict[str, float]) -> None:
    """Largest number of each kind: the keys above it, and which half of six it is in."""
    if isinstance(a, dict):
        for key, x in a.items():
            _measure(x, _kind(kind, key), largest)
    elif isinstance(a, list):
        for i, x in enumerate(a):
            _measure(x, f"{kind}/{i // 3}" if len(a) == 6 else kind, largest)
    elif isinstance(a, float):
        largest[kind] = max(largest.get(kind, 0.0), abs(a))


def _kind(kind: str, key: str) -> str:
    """Entries by label are of one kind; those by name each of their own."""
    return kind if kind.startswith(("nodes", "shapes")) else f"{kind}.{key}"


def _far(a: Any, b: Any, place: str, kind: str, largest: Mapping[str, float], close: float) -> str:
    if a == b:
        return ""
    if isinstance(a, float) and isinstance(b, int | float) and not isinstance(b, bool):
        return "" if abs(a - b) <= close * abs(a) + ROUND_OFF * largest.get(kind, 0.0) else place
    pairs = _pairs(a, b)
    if pairs is None:
        return place
    for i, (key, x, y) in enumerate(pairs):
        own = _kind(kind, str(key)) if isinstance(a, dict) else kind
        if isinstance(a, list) and len(a) == 6:
            own = f"{kind}/{i // 3}"
        said = _far(x, y, f"{place} {key}", own, largest, close)
        if said:
            return said
    return ""


def _pairs(a: Any, b: Any) -> Iterator[tuple[object, Any, Any]] | None:
    """Entries of two values side by side; None where these have no shape in common."""
    if isinstance(a, dict) and isinstance(b, dict):
        return ((key, a.get(key), b.get(key)) for key in dict.fromkeys([*a, *b]))
    if isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        ids = [x.get("id", i) if isinstance(x, dict) else i for i, x in enumerate(a)]
        return iter(zip(ids, a, b, strict=True))
    return None
