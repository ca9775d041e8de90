"""The targets of the project, each computed from the tables: reached, or by how much not."""

from collections.abc import Iterator
from typing import Any

from experiment import Row
from store import duration, times

LIMIT = 1e-9  # distance to the reference [m], and worst certificate item
Tables = dict[str, list[Row]]
SPEED = (  # case, nodes, seconds, floors
    ("lin", 1000, 5e-3, None),
    ("lin", 100_000, 0.5, None),
    ("gap", 1000, 8e-3, None),
    ("gap", 100_000, 1.2, None),
    ("fric1", 1000, 20e-3, 60.0),
    ("fric1", 5000, 0.23, 120.0),
    ("fric1", 100_000, 7.5, 120.0),
)
DECK, DECK_SECONDS, CARDS = "rack_30", 0.30, 50_000
VARIANTS, STUDY_SECONDS = 1000, 5.0
MEMORY, MILLION_MEMORY, MILLION_RATIO = 2048.0, 16384.0, 1.5  # MB, MB, ratio of ratios


def targets(tables: Tables) -> list[Row]:
    """A row a target: what, wanted, measured, verdict."""
    return [
        dict(zip(("target", "wanted", "measured", "verdict"), row, strict=True))
        for row in (
            *_speed(tables["racks"]),
            *_peers(tables["racks"]),
            *_right(tables["racks"]),
            *_large(tables["racks"], tables["million"]),
            *_rest(tables),
        )
    ]


def find(rows: list[Row], **want: Any) -> Row:
    """The first row with these values, or an empty one."""
    return next((r for r in rows if all(r.get(k) == v for k, v in want.items())), {})


def _verdict(measured: float | None, wanted: float) -> str:
    if measured is None:
        return "not measured"
    return "reached" if measured <= wanted else f"missed, {times(measured / wanted)} times"


def _speed(racks: list[Row]) -> Iterator[tuple[str, str, str, str]]:
    for case, n, seconds, floors in SPEED:
        row = find(racks, case=case, n=n, program="newton")
        taken, ratio = row.get("seconds"), row.get("floors")
        name = f"rack_{n} `{case}`"
        if floors is None:
            yield name, duration(seconds), duration(taken), _verdict(taken, seconds)
            continue
        yield f"{name}, in floors", times(floors), times(ratio), _verdict(ratio, floors)
        yield f"{name}, a guide", duration(seconds), duration(taken), _verdict(taken, seconds)
        if n > 1000:
            yield f"{name}, stretch, in floors", "60", times(ratio), _verdict(ratio, 60.0)


def _peers(racks: list[Row]) -> Iterator[tuple[str, str, str, str]]:
    for case in ("lin", "gap"):
        for n in (1000, 100_000):
            own = find(racks, case=case, n=n, program="newton").get("seconds")
            best = min(
                (
                    row["seconds"]
                    for row in racks
                    if (row["case"], row["n"]) == (case, n)
                    and str(row["program"]).startswith("opensees")
                    and row["verdict"] == "right"
                ),
                default=None,
            )
            name = f"rack_{n} `{case}`, faster than OpenSees"
            verdict = "not measured" if best is None else _verdict(own, best)
            yield name, duration(best), duration(own), verdict


def _right(racks: list[Row]) -> Iterator[tuple[str, str, str, str]]:
    own = [row for row in racks if row["program"] == "newton"]
    for column, what, unit in (
        ("error", "distance to the reference", " m"),
        ("worst", "worst certificate item", ""),
    ):
        worst = max((row[column] for row in own if column in row), default=None)
        if any(row["verdict"] != "right" for row in own):
            yield f"every rack: {what}", f"1e-9{unit}", "an answer is missing", "missed"
            continue
        shown = "" if worst is None else f"{worst:.1g}{unit}"
        yield f"every rack: {what}", f"1e-9{unit}", shown, _verdict(worst, LIMIT)


def _large(racks: list[Row], million: list[Row]) -> Iterator[tuple[str, str, str, str]]:
    peak = find(racks, case="fric1", n=100_000, program="newton").get("peak_mb")
    shown = "" if peak is None else f"{peak:.0f} MB"
    yield "rack_100000 `fric1`, memory", f"{MEMORY:.0f} MB", shown, _verdict(peak, MEMORY)
    row = find(million, program="newton", n=1_000_000)
    peak, name = row.get("peak_mb"), "rack_1000000 `fric1`"
    shown = "" if peak is None else f"{peak:.0f} MB, {row['verdict']}"
    sound = row.get("verdict") in (None, "right")
    verdict = _verdict(peak, MILLION_MEMORY) if sound else "missed: " + str(row["remark"])
    yield f"{name}, certified, memory", f"{MILLION_MEMORY:.0f} MB", shown, verdict
    small = find(million, program="newton", n=1000).get("floors")
    large = find(million, program="newton", n=1_000_000).get("floors")
    ratio = large / small if small and large else None
    yield (
        f"{name}, floors over those of rack_1000", times(MILLION_RATIO), times(ratio),
        _verdict(ratio, MILLION_RATIO),
    )  # fmt: skip


def _rest(tables: Tables) -> Iterator[tuple[str, str, str, str]]:
    many = find(tables["many"], n=5000)
    taken, allowed = many.get("seconds"), many.get("allowed")
    verdict = "not measured" if allowed is None else _verdict(taken, allowed)
    name = "40 linear cases on rack_5000: one case and 39 times two solves"
    yield name, duration(allowed), duration(taken), verdict
    row = find(tables["variants"], jobs=2, variants=VARIANTS)
    taken, sound = row.get("seconds"), row.get("certified") == VARIANTS
    verdict = _verdict(taken, STUDY_SECONDS) if sound or not row else "missed: not all certified"
    name = "1000 variants of rack_200 `fric1` on 2 cores"
    yield name, duration(STUDY_SECONDS), duration(taken), verdict
    whole = find(tables["whole"], deck=DECK).get("whole")
    name = "`trunnion run` of a 30-node deck, whole process"
    yield name, duration(DECK_SECONDS), duration(whole), _verdict(whole, DECK_SECONDS)
    rate = max((row.get("cards_a_second", 0.0) for row in tables["reading"][:1]), default=0.0)
    verdict = _verdict(CARDS / rate, 1.0) if rate else "not measured"
    name = "deck reading and model building, cards a second"
    yield name, str(CARDS), f"{rate:.0f}" if rate else "", verdict
