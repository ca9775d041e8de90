"""Whether two programs agree on the cases of a job: movements, support loads and end forces.

Nothing but Python's own library is used here: an exported script carries a copy of this text.
Both sides have the layout of a JSON report: {"cases": {name: {"nodes": ..., "supports": ...}}}.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

TOLERANCE = 1e-6
LEVER = 1e-3  # m (1/m): a smaller moment or rotation, force or translation is round-off of its kin
LEAST = {"m": 1e-6, "rad": 1e-6, "N": 1.0, "N m": 1.0}  # a case has no smaller largest value
SIX = ("x", "y", "z", "rx", "ry", "rz")
KINDS = {  # kind -> its entries, their translations or forces, their rotations or moments
    "movement": ("nodes", "m", "rad"),
    "support load": ("supports", "N", "N m"),
    "end force": ("elements", "N", "N m"),
}


class Difference(NamedTuple):
    """The worst difference of one kind in one case; `share` is its part of the largest value."""

    case: str
    kind: str
    where: str
    unit: str
    own: float
    other: float
    share: float


def differences(own: Mapping[str, Any], other: Mapping[str, Any]) -> list[Difference]:
    """Compare every case that the other program has an answer to; one row a kind and a case."""
    found: list[Difference] = []
    for name, theirs in other["cases"].items():
        ours = own["cases"].get(name)
        if ours is None or not ours.get("converged") or not theirs.get("converged"):
            continue
        for kind, (member, *units) in KINDS.items():
            if member in theirs:
                both = _rows(ours[member]), _rows(theirs[member])
                found.append(_worst(name, kind, units, *both))
    return found


def unanswered(own: Mapping[str, Any], other: Mapping[str, Any]) -> dict[str, str]:
    """Cases of the other program that cannot be compared, and why."""
    found = {}
    for name, theirs in other["cases"].items():
        ours = own["cases"].get(name)
        if not theirs.get("converged"):
            found[name] = theirs.get("cause") or f"{other.get('program')} has no answer"
        elif ours is None:
            found[name] = "there is no such case in the results to compare with"
        elif not ours.get("converged"):
            found[name] = "Trunnion has no answer"
    return found


def _rows(entries: Any) -> dict[str, Sequence[float]]:
    """Give six numbers by node, support or end of an element."""
    if isinstance(entries, Mapping):
        return dict(entries)
    rows: dict[str, Sequence[float]] = {}
    for entry in entries:
        if "force" in entry:
            rows[entry["id"]] = [*entry["force"], *entry["moment"]]
        else:
            rows[f"{entry['id']} from"] = entry["force_from"]
            rows[f"{entry['id']} to"] = entry["force_to"]
    return rows


def _worst(
    case: str,
    kind: str,
    units: Sequence[str],
    ours: Mapping[str, Sequence[float]],
    theirs: Mapping[str, Sequence[float]],
) -> Difference:
    """Give the worst of the translations (forces) and of the rotations (moments)."""
    size = [
        max((abs(x) for row in ours.values() for x in row[half : half + 3]), default=0.0)
        for half in (0, 3)
    ]
    scale = max(size[0], LEVER * size[1]), max(size[1], LEVER * size[0])
    worst = Difference(case, kind, "", "", 0.0, 0.0, 0.0)
    for half, unit, kin in zip((0, 3), units, scale, strict=True):
        largest = max(kin, LEAST[unit])
        for label, row in theirs.items():
            mine = ours.get(label)
            for i in range(half, half + 3):
                a, b = (math.nan if mine is None else mine[i]), row[i]
                share = abs(a - b) / largest
                if share > worst.share or math.isnan(share) or not worst.where:
                    share = math.inf if math.isnan(share) else share
                    worst = Difference(case, kind, f"{label} {SIX[i]}", unit, a, b, share)
    return worst


def laws(other: Mapping[str, Any]) -> dict[str, tuple[float, str]]:
    """Give the worst violation of the laws that were held in each case, and where it is."""
    return {
        name: (case["law"], case["law_at"])
        for name, case in other["cases"].items()
        if case.get("law") is not None
    }


def tried(other: Mapping[str, Any], tolerance: float) -> dict[str, str]:
    """Say in each case what the other program's own friction elements make of the answer."""
    found = {}
    for name, case in other["cases"].items():
        friction = case.get("friction")
        if friction is None:
            continue
        if "not_tried" in friction:
            found[name] = f"not used ({friction['not_tried']})"
            continue
        rest, kept = friction["rest"], friction["kept"]
        if rest is not None and rest <= tolerance:
            found[name] = f"find the same answer from rest ({rest:.1e})"
            continue
        found[name] = "find no answer from rest" if rest is None else f"find another ({rest:.1e})"
        if kept is not None:
            found[name] += f", begun at this one keep it ({kept:.1e})"
    return found


def agrees(
    found: Sequence[Difference], held: Mapping[str, tuple[float, str]], tolerance: float
) -> bool:
    """Tell whether there is something to compare, and all of it is within the tolerance."""
    good = all(row.share <= tolerance for row in found)
    return bool(found) and good and all(value <= tolerance for value, _ in held.values())


def table(found: Sequence[Difference], program: str, tolerance: float) -> str:
    """Write the differences as a table, the worst of every kind in every case."""
    heads = ("case", "", "worst at", "Trunnion", program, "unit", "of largest", "")
    rows = [
        (
            row.case,
            row.kind,
            row.where,
            f"{row.own:.7g}",
            f"{row.other:.7g}",
            row.unit,
            f"{row.share:.1e}",
            "" if row.share <= tolerance else "DIFFERS",
        )
        for row in found
    ]
    widths = [max(map(len, column)) for column in zip(heads, *rows, strict=True)]
    left = (True, True, True, False, False, True, False, True)
    return "\n".join(
        "  ".join(
            cell.ljust(width) if to_left else cell.rjust(width)
            for cell, width, to_left in zip(row, widths, left, strict=True)
        ).rstrip()
        for row in (heads, *rows)
    )
