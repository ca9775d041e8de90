"""Two results: what they say over several cases, the envelope of support loads and the cycles."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from trunnion.compare.change import Change
from trunnion.compare.numbers import (
    FORCES,
    MOMENTS,
    Numbers,
    came,
    changed_numbers,
    numbers_of,
)
from trunnion.compare.stored import SHAPE
from trunnion.errors import ModelError, Problem

SIX = (*FORCES, *MOMENTS)
RANGES = ("range", "one_shot")  # ratio is theirs
Report = Mapping[str, Any]


# ------------------------------------------------------------------ envelope
def changed_envelope(a: Report, b: Report, tolerance: float) -> Iterator[Change]:
    """Yield extremes that moved, and other cases that they come from.

    Raises
    ------
    ModelError : a table is none of trunnion run.
    """
    try:
        old, new = (report.get("envelope") or [] for report in (a, b))
        yield from changed_numbers("envelope", _extremes(old), _extremes(new), tolerance)
        known = {row["id"]: row for row in new}
        for row in old:
            if row["id"] in known:
                yield from _named(b, row, known[row["id"]], tolerance)
    except SHAPE as error:
        raise _strange("envelope", error) from error


def _extremes(rows: Sequence[Mapping[str, Any]]) -> Numbers:
    return {
        (f"support {row['id']} {end}", word): (kind, float(value))
        for row in rows
        for end in ("max", "min")
        for (word, kind), value in zip(SIX, row[end], strict=True)
    }


def _named(
    report: Report, old: Mapping[str, Any], new: Mapping[str, Any], tolerance: float
) -> Iterator[Change]:
    """Yield cases named for an extreme that is not theirs; of cases that tie either may be."""
    for end in ("max", "min"):
        names = zip(old[f"{end}_case"], new[f"{end}_case"], strict=True)
        for i, (was, now) in enumerate(names):
            if was == now or _reaches(report, was, new, end, i, tolerance):
                continue
            where, what = f"envelope support {new['id']} {end}", f"case of {SIX[i][0]}"
            yield Change(where, what, was or "none", now or "none", 0.5)


def _reaches(
    report: Report, case: str | None, row: Mapping[str, Any], end: str, i: int, tolerance: float
) -> bool:
    """Tell whether a case has an extreme as well; a load without sign has both."""
    size = max(abs(x) for r in report["envelope"] for x in (*r["max"], *r["min"]))
    value, near = float(row[end][i]), tolerance * max(size, 1.0)
    supports = report["cases"].get(case, {}).get("supports", ())
    for support in supports:
        if support["id"] == row["id"]:
            own = float([*support["force"], *support["moment"]][i])
            return bool(min(abs(own - value), abs(own + value)) <= near)
    return case is None and abs(value) <= near


# ------------------------------------------------------------------ cycles
def changed_cycles(a: Report, b: Report, tolerance: float) -> Iterator[Change]:
    """Yield cycles that came or went, end otherwise, or have other numbers after a step.

    Raises
    ------
    ModelError : a table is none of trunnion run.
    """
    try:
        found: list[Mapping[str, Any]] = [report.get("cycles") or {} for report in (a, b)]
        for name in dict.fromkeys([*found[0], *found[1]]):
            old, new = (cycles.get(name) for cycles in found)
            if old is None or new is None:
                yield came(f"cycle {name}", "cycle", old is None)
            else:
                yield from _cycle(f"CYCLE {name}", old, new, tolerance)
    except SHAPE as error:
        raise _strange("cycles", error) from error


def _cycle(
    name: str, old: Mapping[str, Any], new: Mapping[str, Any], tolerance: float
) -> Iterator[Change]:
    for what, weight in (("cause", 3e9), ("cases", 2e9), ("loops", 1.0), ("repeats", 1.0)):
        if old[what] != new[what]:
            yield Change(name, what, str(old[what]), str(new[what]), weight)
    steps = [dict(zip(c["steps"], c.get("states") or (), strict=False)) for c in (old, new)]
    moved = False
    for step in [name for name in steps[0] if name in steps[1]]:
        place = f"{name} step {step}"
        for change in changed_numbers(
            place, numbers_of(steps[0][step]), numbers_of(steps[1][step]), tolerance
        ):
            moved = True
            yield change
    if not moved:  # else they follow from it
        yield from changed_numbers(name, _ranges(old), _ranges(new), tolerance)


def _ranges(cycle: Mapping[str, Any]) -> Numbers:
    """Loads after each step; ranges of these and of end forces, over the loop and in one shot."""
    found: Numbers = {}
    for table, ends in (("supports", ("",)), ("elements", ("_from", "_to"))):
        for row in cycle.get(table) or ():
            sixes = {f"{what}{end}": row[f"{what}{end}"] for what in RANGES for end in ends}
            sixes |= {f"step {i}": six for i, six in enumerate(row.get("path") or (), 1)}
            for name, six in sixes.items():
                said = f"{table.removesuffix('s')} {row['id']} {name.replace('_', ' ')}"
                for (word, kind), value in zip(SIX, six or (), strict=six is not None):
                    found[said, word] = kind, float(value)
    return found


def _strange(table: str, error: Exception) -> ModelError:
    return ModelError([Problem(table, f"no table of trunnion run ({error!r})")])
