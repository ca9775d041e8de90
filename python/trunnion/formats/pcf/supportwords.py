"""What supports mean: SKEY and direction, or a name of the side table, to words of the deck.

Up is Z, east X, north Y.  The direction of a SKID is the one in which the pipe cannot move.
"""

from collections.abc import Iterable, Mapping
from fnmatch import fnmatchcase

from trunnion.deck.api import add
from trunnion.deck.units import scale_of
from trunnion.errors import DeckError, Problem
from trunnion.formats.pcf.parts import Part
from trunnion.formats.sidetable import SideTable
from trunnion.frozen import frozen
from trunnion.model import Model, Place

#: words of the trade for words of the deck; IGNORE leaves a support out
TRADE: dict[str, str] = {
    "REST": "+Z",
    "SHOE": "+Z",
    "HOLD-DOWN": "Z",
    "VERTICAL": "Z",
    "GUIDE": "GUIDE",
    "LINE-STOP": "LIMIT",
    "LINESTOP": "LIMIT",
    "AXIAL-STOP": "LIMIT",
    "ANCHOR": "ANCHOR",
    "REST-GUIDE": "+Z GUIDE",
    "SPRING": "SPRING",
    "HANGER": "SPRING",
    "ROD-HANGER": "+Z",
    "IGNORE": "IGNORE",
}

#: stops by the direction in which the pipe cannot move
_STOP = {"DOWN": "+Z", "UP": "-Z", "EAST": "-X", "WEST": "+X", "NORTH": "-Y", "SOUTH": "+Y"}
_AXIS = {"DOWN": "Z", "UP": "Z", "EAST": "X", "WEST": "X", "NORTH": "Y", "SOUTH": "Y"}
_NAMES = ("SUPPORT_NAME", "SUPPORT-NAME", "NAME", "SUPPORT", "ITEM-CODE", "DESCRIPTION",
          "ITEM-DESCRIPTION", "SUPPORT-TYPE", "TAG")  # fmt: skip
_PLAIN = (
    ("REST*", "REST"), ("SHOE*", "SHOE"), ("GUIDE*", "GUIDE"), ("LINE-STOP*", "LINE-STOP"),
    ("LINE STOP*", "LINE-STOP"), ("LINESTOP*", "LINE-STOP"), ("AXIAL*", "LINE-STOP"),
    ("ANCHOR*", "ANCHOR"), ("SPRING*", "SPRING"), ("HOLD*DOWN*", "HOLD-DOWN"),
)  # fmt: skip


@frozen
class Meaning:
    """Words of the deck for one SUPPORT record, why, and whether that is a guess to report."""

    words: str
    why: str
    guess: bool = False


def meaning_of(part: Part, table: SideTable) -> Meaning | None:
    """Find what one record means; None if nothing says it."""
    skey = (part.get("SKEY") or "").upper()
    direction = (part.get("SUPPORT-DIRECTION") or "").upper()
    names = [v for v in (part.get(n) for n in _NAMES) if v]
    asked = [*names, f"{skey} {direction}".strip(), skey or "NONE"]
    for text in asked:
        for pattern in sorted(table.supports, key=len, reverse=True):
            if fnmatchcase(text.upper(), pattern):
                return Meaning(table.supports[pattern], f"{text} by the side table")
    return _by_skey(skey, direction) or _by_name(names)


def _by_skey(skey: str, direction: str) -> Meaning | None:
    kind = skey[:4]
    if kind == "ANCH":
        return Meaning("ANCHOR", skey)
    if kind in ("SPRG", "01SP"):
        return Meaning("SPRING", f"{skey} {direction}".strip())
    if kind in ("SKID", "DUCK", "SHOE", "01SK"):
        if direction in _STOP:
            return Meaning(_STOP[direction], f"{skey} {direction}", guess=kind != "SKID")
        return Meaning("+Z", f"{skey} without direction: a rest", guess=True)
    if kind in ("GUID", "01GU"):
        if direction in _AXIS:
            return Meaning(_AXIS[direction], f"{skey} {direction}")
        return Meaning("GUIDE", f"{skey} without direction: sideways to the pipe", guess=True)
    if kind in ("HANG", "01HG"):
        return Meaning(
            "+Z", f"{skey}: a rod that carries weight and lets the pipe rise", guess=True
        )
    if not skey and direction in ("UP", "DOWN"):
        return Meaning("+Z", f"no SKEY, direction {direction}: a rest", guess=True)
    return None


def _by_name(names: Iterable[str]) -> Meaning | None:
    for text in names:
        for pattern, word in _PLAIN:
            if fnmatchcase(text.upper(), pattern):
                return Meaning(word, f"name {text}", guess=True)
    return None


def merged(words: Iterable[str]) -> list[str]:
    """Directions of one point: both sides of a line are one two-way restraint; no word twice."""
    found = list(dict.fromkeys(words))
    for axis in "XYZ":
        if {f"+{axis}", f"-{axis}"} <= set(found):
            found = [axis if w == f"+{axis}" else w for w in found if w != f"-{axis}"]
        if axis in found:
            found = [w for w in found if w.lstrip("+-") != axis or w == axis]
    return list(dict.fromkeys(found))


def add_words(
    model: Model, node: str, text: str, place: Place, along: str | None, name: str | None = None
) -> int:
    """Add the supports that the words of a side table mean; give their number.

    SPRING without LOAD= is a hanger that the program selects.  ANCHOR and words of TRADE stand
    for themselves, all else is the rest of a SUPPORT card:
    "+Z GUIDE GAP=3mm MU=0.3".

    Raises
    ------
    DeckError : with the words at fault.
    """
    words = text.upper().split()
    first = TRADE.get(words[0], words[0]) if words else ""
    if first == "IGNORE":
        return 0
    keys: dict[str, str] = {} if name is None else {"NAME": name}
    if first == "ANCHOR":
        keys |= dict(_pair(w, place) for w in words[1:])
        add(model, "ANCHOR", (node,), keys, place)
        return 1
    if first == "SPRING":
        keys |= dict(_pair(w, place) for w in words[1:])
        args = (node,) if "LOAD" in keys else (node, "DESIGN")
        add(model, "HANGER", args, _in_si(keys), place)
        return 1
    card: list[object] = [node]
    common: dict[str, str] = dict(keys)
    bound: list[tuple[str, dict[str, str]]] = []
    for word in words:
        if "=" in word:
            key, value = _pair(word, place)
            (bound[-1][1] if bound else common)[key] = value
        else:
            bound += [(w, {}) for w in TRADE.get(word, word).split()]
    for direction, own in bound:
        if along is not None and direction in ("GUIDE", "LIMIT"):
            own.setdefault("ALONG", along)
        card.append((direction, _in_si(own)))
    add(model, "SUPPORT", tuple(card), _in_si(common), place)
    return 1


def _pair(word: str, place: Place) -> tuple[str, str]:
    key, equals, value = word.partition("=")
    if not equals or not value:
        raise DeckError([Problem(place, f"{word} is not KEY=VALUE")])
    return key, value


def _in_si(keys: Mapping[str, str]) -> dict[str, object]:
    """Gaps without a unit are mm, stiffnesses N/mm, loads N: the units of a side table."""
    units = {"GAP": "mm", "K": "N/mm", "KF": "N/mm", "RATE": "N/mm"}
    found: dict[str, object] = {}
    for key, text in keys.items():
        plain = all(p.replace(".", "", 1).replace("-", "", 1).isdigit() for p in text.split(","))
        if key in units and plain:
            dimension = "length" if key == "GAP" else "stiffness"
            scaled = [scale_of(units[key], dimension)(float(p)) for p in text.split(",")]
            found[key] = scaled[0] if len(scaled) == 1 else tuple(scaled)
        else:
            found[key] = text
    return found
