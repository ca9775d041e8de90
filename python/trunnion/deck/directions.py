"""SUPPORT cards: a node, then direction words with the keys bound to them."""

from dataclasses import replace
from typing import Any

from trunnion.deck import values as va
from trunnion.deck.fields import Complain, Fields, read_key
from trunnion.deck.keywords import DIRECTIONS, KEYWORDS, PIPE_DIRECTIONS
from trunnion.deck.record import Record
from trunnion.deck.values import WordError, nearest
from trunnion.model import Direction

_KEYS = {key.name: key for key in KEYWORDS["SUPPORT"].keys}
_WORDS = frozenset((*DIRECTIONS, *PIPE_DIRECTIONS))
_MEMORY = 10_000

Numbered = tuple[int, str, Any]  # index of the word on the card, key, value


def read_directions(record: Record, items: list[Any], fields: Fields, complain: Complain) -> None:
    """Fill a SUPPORT.

    Most supports of a line say the same: what follows the node is read once and remembered.
    """
    at = next((i for i, item in enumerate(items) if not isinstance(item, tuple)), None)
    if at is None:
        complain("node label missing", None)
        return
    try:
        record.args.append(va.label(items[at]))
    except WordError as fault:
        record.args.append(str(items[at]).upper())
        complain(str(fault), at + 1)
    items[at] = None
    said = tuple(items)
    known = fields.supports.get(said)
    if known is None:
        heard: list[str] = []

        def listen(message: str, mark: Any) -> None:
            heard.append(message)
            complain(message, mark)

        known = _read(said, fields, listen)
        if not heard:
            if len(fields.supports) > _MEMORY:
                fields.supports.clear()
            fields.supports[said] = known
    record.keys, record.words = known


def _read(
    items: tuple[Any, ...], fields: Fields, complain: Complain
) -> tuple[dict[str, Any], tuple[Direction, ...]]:
    """Read the keys of the whole card and the directions."""
    card: dict[str, Any] = {}
    common: list[Numbered] = []
    bound: list[tuple[Direction, int, list[Numbered]]] = []
    wrong = False
    for i, item in enumerate(items, 1):
        if item is None:
            continue
        if not isinstance(item, tuple):
            direction = _direction(item, i, complain)
            wrong |= direction is None
            if direction is not None:
                bound.append((direction, i, []))
        elif item[0] in _KEYS and _KEYS[item[0]].card_wide:
            read_key(card, i, item, "SUPPORT", fields.readers["SUPPORT"], complain)
        else:
            (bound[-1][2] if bound else common).append((i, item[0], item[1]))
    if not bound and not wrong:
        complain(f"no direction; write one of {' '.join((*DIRECTIONS, *PIPE_DIRECTIONS))}", None)
    if bound and not any(direction.word in PIPE_DIRECTIONS for direction, *_ in bound):
        for i, name, _ in common:
            if name == "ALONG":
                complain("ALONG without GUIDE or LIMIT on the card", i)
    made = []
    for direction, i, own in bound:
        keys = _bound_keys(direction.word, own, common, fields, complain)
        both = keys.get("GAP")
        if both and direction.word[0] in "+-" and both[0] != both[1]:
            complain(f"{direction.word} has one side; write GAP=a with one value", i)
        given = {name.lower(): value for name, value in keys.items() if name in _KEYS}
        made.append(replace(direction, friction=card.get("FRICTION"), **given))
    return card, tuple(made)


def is_rotation(word: str) -> bool:
    """Tell whether a direction word is RX +RY ..."""
    return word.lstrip("+-").startswith("R")


def _bound_keys(
    word: str, own: list[Numbered], common: list[Numbered], fields: Fields, complain: Complain
) -> dict[str, Any]:
    """Read the keys of one direction: its own, then the common ones that fit it."""
    turning = is_rotation(word)
    readers = fields.directions[turning]
    keys: dict[str, Any] = {}
    for i, name, value in own:
        if turning and name in ("MU", "KF"):
            complain(f"{name} on {word}: friction acts on translations only", i)
        elif name == "ALONG" and word not in PIPE_DIRECTIONS:
            complain(f"ALONG goes with GUIDE or LIMIT, not with {word}", i)
        else:
            read_key(keys, i, (name, value), "SUPPORT", readers, complain)
    unfit = () if word in PIPE_DIRECTIONS else ("ALONG", "MU", "KF") if turning else ("ALONG",)
    seen: set[str] = set()
    for i, name, value in common:
        if name in seen:
            complain(f"{name} is given twice", i)
        seen.add(name)
        if name not in keys and name not in unfit:
            read_key(keys, i, (name, value), "SUPPORT", readers, complain)
    return keys


def _direction(item: Any, i: int, complain: Complain) -> Direction | None:
    """Read a direction word: X +Y GUIDE (a,b,c)."""
    text = str(item).strip().upper()
    if text in _WORDS:
        return Direction(text)
    sign = text[:1] if text[:1] in ("+", "-") else ""
    if text[len(sign) :].startswith("("):
        try:
            found = va.vector(text[len(sign) :])
        except WordError as fault:
            complain(str(fault), i)
            return None
        return Direction(f"{sign}({','.join(f'{x:g}' for x in found)})", found)
    if text in _KEYS:
        complain(f"{text} needs a value: {text}=...", i)
        return None
    words = " ".join((*DIRECTIONS[:9], *PIPE_DIRECTIONS, "RX", "..."))
    hint = nearest(text, _WORDS)
    complain(f"direction {item} is not one of {words} or (a,b,c){hint}", i)
    return None
