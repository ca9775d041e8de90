"""Two results: what changed, in shares of the largest of its kind in the case.

A number differs where it moved by more than `tolerance` of the largest force, moment, displacement
or rotation of the case in either file: a support that carries next to nothing is not a change
of 300 %.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from trunnion.compare.change import Change, by_importance

Numbers = dict[tuple[str, str], tuple[str, float]]  # (where, component) -> kind, value
FORCES = (("FX", "force"), ("FY", "force"), ("FZ", "force"))
MOMENTS = (("MX", "moment"), ("MY", "moment"), ("MZ", "moment"))
MOVES = (
    ("DX", "displacement"), ("DY", "displacement"), ("DZ", "displacement"),
    ("RX", "rotation"), ("RY", "rotation"), ("RZ", "rotation"),
)  # fmt: skip
UNITS = {"force": "N", "moment": "N m", "displacement": "m", "rotation": "rad", "frequency": "Hz"}
KEPT = {"force": 1.0, "moment": 1.0, "displacement": 1e-6, "rotation": 1e-6}  # least scale


def diff_results(a: Mapping[str, Any], b: Mapping[str, Any], tolerance: float) -> list[Change]:
    """List what differs between two stored results, most important first."""
    changes: list[Change] = []
    for name in dict.fromkeys([*a["cases"], *b["cases"]]):
        old, new = a["cases"].get(name), b["cases"].get(name)
        if old is None or new is None:
            changes.append(_came(f"case {name}", "case", old is None))
            continue
        changes += _case(name, old, new, tolerance)
    changes += _frequencies(a, b, tolerance)
    return by_importance(changes)


def _came(where: str, what: str, is_new: bool) -> Change:
    return Change(where, what, *(("absent", "present") if is_new else ("present", "absent")), 2e9)


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
    yield from _numbers(name, numbers_of(old), numbers_of(new), tolerance)


def _numbers(name: str, old: Numbers, new: Numbers, tolerance: float) -> Iterator[Change]:
    scale = dict(KEPT)
    for kind, value in (*old.values(), *new.values()):
        scale[kind] = max(scale[kind], abs(value))
    missing = dict.fromkeys(key[0] for key in [*old, *new] if (key in old) != (key in new))
    for where in missing:
        yield _came(f"{name} {where}", "entry", not any(key[0] == where for key in old))
    for key, (kind, before) in old.items():
        if key not in new:
            continue
        after = new[key][1]
        weight = abs(after - before) / scale[kind]
        if not weight <= tolerance:
            # a support load counts more than the end force that it comes from
            first = 1.0 if key[0].startswith("support") else 0.5
            said = _number(before, kind, after), _number(after, kind, before)
            yield Change(f"{name} {key[0]}", key[1], *said, first * weight, _share(before, after))


def numbers_of(case: Mapping[str, Any]) -> Numbers:
    """Every displacement, support load and end force of a case, by place and component."""
    found: Numbers = {}
    for support in case["supports"]:
        rows = zip((*FORCES, *MOMENTS), support["force"] + support["moment"], strict=True)
        for (word, kind), value in rows:
            found[f"support {support['id']}", word] = kind, value
    for label, row in case["nodes"].items():
        for (word, kind), value in zip(MOVES, row, strict=True):
            found[f"node {label}", word] = kind, value
    count: dict[str, int] = {}
    for element in case["elements"]:
        count[element["id"]] = number = count.get(element["id"], 0) + 1
        name = f"element {element['id']}" + (f"#{number}" if number > 1 else "")
        for end in ("from", "to"):
            rows = zip((*FORCES, *MOMENTS), element[f"force_{end}"], strict=True)
            for (word, kind), value in rows:
                found[f"{name} {end}", word] = kind, value
    return found


def _frequencies(a: Any, b: Any, tolerance: float) -> Iterator[Change]:
    rows = [(report.get("modes") or {}).get("frequency_hz") or [] for report in (a, b)]
    if len(rows[0]) != len(rows[1]):
        yield Change("modes", "number", str(len(rows[0])), str(len(rows[1])), 1e9)
    top = max([abs(x) for row in rows for x in row], default=1.0) or 1.0
    for i, (before, after) in enumerate(zip(*rows, strict=False), 1):
        weight = abs(after - before) / top
        if not weight <= tolerance:
            said = _number(before, "frequency", after), _number(after, "frequency", before)
            yield Change(f"mode {i}", "frequency", *said, weight, _share(before, after))


def _number(value: float, kind: str, other: float) -> str:
    """Print with five digits, or with all where five would not show the difference."""
    short = f"{value:.5g}"
    return f"{short if short != f'{other:.5g}' else repr(value)} {UNITS[kind]}"


def _share(before: float, after: float) -> str:
    """Change in per cent, where there is something to take it of."""
    if before == 0.0 or math.isclose(after, 0.0, abs_tol=0.0):
        return ""
    share = 100.0 * (after - before) / abs(before)
    return f"{share:+.3g} %" if abs(share) < 1000.0 else ""
