"""Two decks: what changed card by card, whatever their units, spelling, order of keys or comments.

Both models are written by the one writer in the units of the first, and the cards compared.
"""

import math
from collections.abc import Iterator
from dataclasses import replace

from trunnion.compare.change import Change, by_importance
from trunnion.model import Model

#: labels that say which card it is; keywords not here are known by their first word
LABELS = {"PIPE": 2, "RIGID": 2, "VALVE": 2, "FLANGE": 2, "REDUCER": 2, "JOINT": 2, "SPRING": 1,
          "TITLE": 0, "UNITS": 0, "DEFAULT": 0, "OPERATE": 0, "UNIFORM": 0, "MODES": 0,
          "CASE": 1, "COMB": 1, "DISPLACEMENT": 2, "FORCE": 2, "PROPERTY": 1}  # fmt: skip
#: importance of a changed card; a card that came or went counts double
WEIGHT = {"PIPE": 90.0, "BEND": 90.0, "ANCHOR": 85.0, "SUPPORT": 80.0, "SNUBBER": 80.0,
          "HANGER": 80.0, "SECTION": 70.0, "MATERIAL": 70.0, "OPERATE": 65.0, "DEFAULT": 60.0,
          "CASE": 30.0, "COMB": 30.0, "TITLE": 1.0, "UNITS": 2.0}  # fmt: skip
TEXT = ("TITLE", "CASE", "COMB", "CYCLE", "GROUP")  # compared as a line, not by keys
OTHER = 50.0
Key = tuple[str, int]  # card and how many of that name stood before


def diff_decks(a: Model, b: Model, tolerance: float = 0.0) -> list[Change]:
    """List what differs between two models, most important first."""
    if a == b:
        return []
    old, new = _cards(a.deck()), _cards(replace(b, units=a.units).deck())
    changes = list(_units(a, b))
    for key in dict.fromkeys([*old, *new]):
        word = key[0].split()[0]
        weight = WEIGHT.get(word, OTHER)
        if key not in old:
            changes.append(Change(_place(key), "card", "absent", new[key] or "present", 2 * weight))
        elif key not in new:
            changes.append(Change(_place(key), "card", old[key] or "present", "absent", 2 * weight))
        else:
            changes += _card(key, old[key], new[key], weight, tolerance)
    return by_importance(changes)


def canonical(model: Model) -> str:
    """The deck in the one writing that two equal models share, a card a line (textconv of git)."""
    return "\n".join(_lines(model.deck())) + "\n"


def _units(a: Model, b: Model) -> Iterator[Change]:
    if a.units != b.units:
        was, now = (
            " ".join((u.length, u.force, u.pressure, u.temperature)) for u in (a.units, b.units)
        )
        yield Change("UNITS", "units", was, now, WEIGHT["UNITS"])


def _lines(deck: str) -> list[str]:
    joined = deck.replace(" &\n", " ")
    lines = (line if line.startswith("TITLE") else " ".join(line.split())
             for line in joined.splitlines())  # fmt: skip
    return [line for line in lines if line and not line.startswith("!")]


def _cards(deck: str) -> dict[Key, str]:
    """Cards by keyword and labels; what follows them."""
    found: dict[Key, str] = {}
    count: dict[str, int] = {}
    for line in _lines(deck):
        words = line.split()
        if words[0] == "UNITS":
            continue
        labels = [w for w in words[1 : 1 + LABELS.get(words[0], 1)] if "=" not in w]
        name = " ".join([words[0], *labels])
        number = count[name] = count.get(name, 0) + 1
        found[name, number] = " ".join(words[1 + len(labels) :])
    return found


def _place(key: Key) -> str:
    name, number = key
    keyword, _, rest = name.partition(" ")
    shown = f"{keyword.lower()} {rest}".rstrip()
    return shown if number == 1 else f"{shown} (card {number})"


def _card(key: Key, old: str, new: str, weight: float, tolerance: float) -> Iterator[Change]:
    if old == new:
        return
    if key[0].split()[0] in TEXT:
        yield Change(_place(key), "text", old, new, weight)
        return
    before, after = _values(old), _values(new)
    for name in dict.fromkeys([*before, *after]):
        x, y = before.get(name), after.get(name)
        if x == y or (x and y and _near(x, y, tolerance)):
            continue
        yield Change(_place(key), name, x or "absent", y or "absent", weight)


def _values(text: str) -> dict[str, str]:
    """Values by key, of a support by direction and key; words without one are present."""
    found: dict[str, str] = {}
    owner = ""
    for word in text.split():
        name, sign, value = word.partition("=")
        if sign:
            found[f"{owner} {name}".strip()] = value
        else:
            owner = word
            found[word] = "present"
    return found


def _near(x: str, y: str, tolerance: float) -> bool:
    try:
        pairs = list(zip(x.split(","), y.split(","), strict=True))
        return all(math.isclose(float(p), float(q), rel_tol=tolerance) for p, q in pairs)
    except ValueError:
        return False
