"""Numbers of two results side by side: which differ, by what share of the largest of their kind.

A number differs where it moved by more than `tolerance` of the largest force, moment, displacement
or rotation of the case in either file: a support that carries next to nothing is not a change
of 300 %.
"""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from trunnion.compare.change import Change

Numbers = dict[tuple[str, str], tuple[str, float]]  # (where, component) -> kind, value
FORCES = (("FX", "force"), ("FY", "force"), ("FZ", "force"))
MOMENTS = (("MX", "moment"), ("MY", "moment"), ("MZ", "moment"))
MOVES = (
    ("DX", "displacement"), ("DY", "displacement"), ("DZ", "displacement"),
    ("RX", "rotation"), ("RY", "rotation"), ("RZ", "rotation"),
)  # fmt: skip
UNITS = {"force": "N", "moment": "N m", "displacement": "m", "rotation": "rad", "frequency": "Hz"}
KEPT = {"force": 1.0, "moment": 1.0, "displacement": 1e-6, "rotation": 1e-6}  # least scale


def came(where: str, what: str, is_new: bool) -> Change:
    """What only one of two files has; before all numbers."""
    return Change(where, what, *(("absent", "present") if is_new else ("present", "absent")), 2e9)


def changed_numbers(name: str, old: Numbers, new: Numbers, tolerance: float) -> Iterator[Change]:
    """Yield what moved by more than `tolerance` of the largest of its kind in either."""
    scale = dict(KEPT)
    for kind, value in (*old.values(), *new.values()):
        scale[kind] = max(scale[kind], abs(value))
    missing = dict.fromkeys(key[0] for key in [*old, *new] if (key in old) != (key in new))
    for where in missing:
        yield came(f"{name} {where}", "entry", not any(key[0] == where for key in old))
    for key, (kind, before) in old.items():
        if key not in new:
            continue
        after = new[key][1]
        weight = abs(after - before) / scale[kind]
        if not weight <= tolerance:
            # a support load counts more than the end force that it comes from
            first = 1.0 if key[0].startswith("support") else 0.5
            said = shown(before, kind, after), shown(after, kind, before)
            yield Change(f"{name} {key[0]}", key[1], *said, first * weight, share(before, after))


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


def shown(value: float, kind: str, other: float) -> str:
    """Print with five digits, or with all where five would not show the difference."""
    short = f"{value:.5g}"
    return f"{short if short != f'{other:.5g}' else repr(value)} {UNITS[kind]}"


def share(before: float, after: float) -> str:
    """Change in per cent of the value before: less is -, the other sign below -100."""
    if before == 0.0 or math.isclose(after, 0.0, abs_tol=0.0):
        return ""
    share = 100.0 * (after - before) / before
    return f"{share:+.3g} %" if abs(share) < 1000.0 else ""
