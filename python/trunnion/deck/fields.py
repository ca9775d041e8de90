"""One card, or one call of the Python API, to a Record: words to values by the keyword table."""

import re
from collections.abc import Callable, Iterable
from functools import lru_cache
from typing import Any

from trunnion.deck import expressions as ex
from trunnion.deck import units as un
from trunnion.deck import values as va
from trunnion.deck.keywords import DIRECTIONS, KEYWORDS, PIPE_DIRECTIONS, Key, Keyword, Positional
from trunnion.deck.record import Mark, Record, Word
from trunnion.deck.values import Reader, ValueFault, nearest
from trunnion.model import Units

Complain = Callable[[str, Mark], None]
_KEYS_AFTER = re.compile(r"(?:^|\s)([A-Z_]+)=", re.I)


class Fields:
    """The keyword table made ready for one UNITS card: a reader for each key."""

    def __init__(self, units: Units) -> None:
        scales = un.scales(units)
        self.readers: dict[str, dict[str, Reader]] = {
            word.name: {
                key.name: va.reader_of(key, scales)
                for key in word.keys
                if key.dimension or key.kind != "number" and key.kind != "gap"
            }
            for word in KEYWORDS.values()
        }
        self.turning = {"GAP": "angle", "K": "rotational stiffness"}
        self.moving = {"GAP": "length", "K": "stiffness"}
        keys = {key.name: key for key in KEYWORDS["SUPPORT"].keys}
        common = self.readers["SUPPORT"]
        self.directions = (
            {**common, **{k: va.reader_of(keys[k], scales, d) for k, d in self.moving.items()}},
            {**common, **{k: va.reader_of(keys[k], scales, d) for k, d in self.turning.items()}},
        )


@lru_cache(maxsize=8)
def fields_of(units: Units) -> Fields:
    """Give the readers for one UNITS card, made once."""
    return Fields(units)


_CARD_WIDE = frozenset(key.name for key in KEYWORDS["SUPPORT"].keys if key.card_wide)
_POSITIONALS: dict[str, tuple[Positional, ...]] = {k: w.positionals for k, w in KEYWORDS.items()}
_LABELS: dict[str, str] = {}


def read_label(value: object) -> str:
    """Read a node label; labels seen before are looked up."""
    found = _LABELS.get(value)  # type: ignore[call-overload]
    if found is None:
        found = va.label(value)
        if len(_LABELS) > 500_000:
            _LABELS.clear()
        _LABELS[str(value)] = found
    return str(found)


def read_fields(record: Record, items: Iterable[Any], fields: Fields, complain: Complain) -> None:
    """Fill the positionals and keys of a record of form "fields".

    Parameters
    ----------
    items : words of the card after its keyword; a pair (key, value) or a positional.
    complain : takes each fault and the index of the word at fault.
    """
    readers = fields.readers[record.keyword]
    wanted = _POSITIONALS[record.keyword]
    keys, args = record.keys, record.args
    for i, item in enumerate(items, 1):
        if isinstance(item, tuple):
            read_key(keys, i, item, record.keyword, readers, complain)
        elif len(args) < len(wanted):
            try:
                args.append(_positional(item, wanted[len(args)]))
            except ValueFault as fault:
                args.append(str(item).upper())
                complain(str(fault), i)
        else:
            complain(_one_too_many(str(item), record.keyword, len(wanted)), i)
    missing = [p for p in wanted[len(args) :] if not p.optional]
    if missing:
        complain(f"{' and '.join(_described(p) for p in missing)} missing", None)


def _named(name: str, fault: ValueFault) -> str:
    """Put the key before the fault unless it is there."""
    return str(fault) if str(fault).startswith(name) else f"{name}: {fault}"


def _described(positional: Positional) -> str:
    """Words for a positional that is missing."""
    return (
        positional.meaning
        if positional.name in positional.meaning
        else (f"{positional.meaning} ({positional.name})")
    )


def _no_key(name: str, keyword: str) -> str:
    """Say that a key does not exist, and which do."""
    keys = tuple(key.name for key in KEYWORDS[keyword].keys)
    if not name:
        return "= without a key on its left"
    if not keys:
        return f"{name} is no key of {keyword}, which has none"
    return f"{name} is no key of {keyword}{nearest(name, keys)} (keys: {' '.join(keys)})"


def _one_too_many(word: str, keyword: str, most: int) -> str:
    """Say that a positional is not wanted."""
    keys = tuple(key.name for key in KEYWORDS[keyword].keys)
    if word == "&":
        return "& continues a card only at the end of its line"
    if word.upper() in keys:
        return f"{word} needs a value: {word.upper()}=..."
    before = f"only {most} word{'s' * (most > 1)} before the keys" if most else "only KEY=VALUE"
    return f"word {word} is not expected; {keyword} takes {before}"


def _positional(item: Any, wanted: Positional) -> str:
    """Read one positional."""
    if wanted.kind == "node":
        return read_label(item)
    if wanted.kind == "name":
        return va.name(item)
    found = str(item).strip().upper()
    if found not in wanted.choices:
        what = "load set" if wanted.kind == "set" else "word"
        raise ValueFault(f"{what} {item} is not one of {' '.join(wanted.choices)}")
    return found


def read_directions(
    record: Record, items: Iterable[Any], fields: Fields, complain: Complain
) -> None:
    """Fill a SUPPORT: the node, then direction words with the keys bound to them."""
    common: list[tuple[int, str, Any]] = []
    bound: list[tuple[Word, int, list[tuple[int, str, Any]]]] = []
    wrong = False
    for i, item in enumerate(items, 1):
        if isinstance(item, tuple):
            if item[0] in _CARD_WIDE:
                read_key(record.keys, i, item, "SUPPORT", fields.readers["SUPPORT"], complain)
            else:
                (bound[-1][2] if bound else common).append((i, item[0], item[1]))
        elif not record.args:
            try:
                record.args.append(read_label(item))
            except ValueFault as fault:
                record.args.append(str(item).upper())
                complain(str(fault), i)
        else:
            word = _direction(item, i, complain)
            wrong |= word is None
            if word is not None:
                bound.append((word, i, []))
    if not record.args:
        complain("node label missing", None)
    elif not bound and not wrong:
        complain(f"no direction; write one of {' '.join((*DIRECTIONS, *PIPE_DIRECTIONS))}", None)
    for word, _, keys in bound:
        turning = _is_rotation(word.text)
        readers = fields.directions[turning]
        for i, name, value in keys:
            if turning and name in ("MU", "KF"):
                complain(f"{name} on {word.text}: friction acts on translations only", i)
            else:
                read_key(word.keys, i, (name, value), "SUPPORT", readers, complain)
        for i, name, value in common:
            if name in word.keys or (turning and name in ("MU", "KF")):
                continue
            if name == "ALONG" and word.text not in PIPE_DIRECTIONS:
                continue
            # a fault of a common key is told once
            read_key(word.keys, i, (name, value), "SUPPORT", readers, complain)
        record.words.append(word)
    _check_along(record, bound, common, complain)


def _is_rotation(word: str) -> bool:
    """Tell whether a direction word is RX +RY ..."""
    return word.lstrip("+-").startswith("R")


def _check_along(record: Record, bound: Any, common: Any, complain: Complain) -> None:
    """ALONG goes with GUIDE and LIMIT; one-way words have one gap."""
    for word, i, keys in bound:
        if "ALONG" in word.keys and word.text not in PIPE_DIRECTIONS:
            at = next(k for k, name, _ in keys if name == "ALONG")
            complain(f"ALONG goes with GUIDE or LIMIT, not with {word.text}", at)
        both = word.keys.get("GAP")
        if both and word.text[0] in "+-" and both[0] != both[1]:
            complain(f"{word.text} has one side; write GAP=a with one value", i)
    if not any(word.text in PIPE_DIRECTIONS for word, *_ in bound):
        for i, name, _ in common:
            if name == "ALONG" and bound:
                complain("ALONG without GUIDE or LIMIT on the card", i)


def missing_keys(record: Record, complain: Complain) -> None:
    """Complain of keys that must be given."""
    for key in KEYWORDS[record.keyword].keys:
        if key.required and key.name not in record.keys:
            complain(f"{key.name}= is missing", None)


def read_key(
    keys: dict[str, Any],
    mark: Mark,
    item: tuple[str, Any],
    keyword: str,
    readers: dict[str, Reader],
    complain: Complain,
) -> None:
    """Read one key into `keys`."""
    name, value = item
    reader = readers.get(name)
    if reader is None:
        complain(_no_key(name, keyword), mark)
    elif name in keys:
        complain(f"{name} is given twice", mark)
    else:
        try:
            keys[name] = reader(value)
        except ValueFault as fault:
            keys[name] = None
            complain(_named(name, fault), mark)


def _skewed(sign: str, found: va.Vector) -> str:
    """Give the name of a skewed direction."""
    return f"{sign}({','.join(f'{x:g}' for x in found)})"


def _direction(item: Any, i: int, complain: Complain) -> Word | None:
    """Read a direction word: X +Y GUIDE (a,b,c)."""
    if not isinstance(item, str):
        try:
            found = va.vector(item)
            return Word(_skewed("", found), found, {})
        except ValueFault as fault:
            complain(str(fault), i)
            return None
    text = item.strip().upper()
    if text in DIRECTIONS or text in PIPE_DIRECTIONS:
        return Word(text, None, {})
    sign = text[:1] if text[:1] in ("+", "-") else ""
    if text[len(sign) :].startswith("("):
        try:
            found = va.vector(text[len(sign) :])
        except ValueFault as fault:
            complain(str(fault), i)
            return None
        return Word(_skewed(sign, found), found, {})
    if text in {key.name for key in KEYWORDS["SUPPORT"].keys}:
        complain(f"{text} needs a value: {text}=...", i)
        return None
    words = " ".join((*DIRECTIONS[:9], *PIPE_DIRECTIONS, "RX", "..."))
    hint = nearest(text, (*DIRECTIONS, *PIPE_DIRECTIONS))
    complain(f"direction {item} is not one of {words} or (a,b,c){hint}", i)
    return None


def read_equation(
    record: Record, text: str, at: int, fields: Fields, complain: Complain
) -> list[tuple[str, int, int]]:
    """Fill a CASE or COMB from "name = expression KEY=VALUE ...", which starts at `at`.

    Gives the names in the expression with their places on the card.
    """
    name, equals, rest = text.partition("=")
    form = f"write {record.keyword} name = ..."
    name = name.strip()
    if name.split() and (not equals or len(name.split()) > 1):
        record.args.append(name.split()[0].upper())
        complain(f"= missing after the name; {form}", (at, at + len(name)))
        return []
    if not name:
        complain(f"name missing; {form}", None)
        return []
    record.args.append(name.upper())
    check_case_name(record, (at, at + len(name)), complain)
    start = at + text.index("=") + 1
    keys_from = len(rest)
    spaced = re.sub(r"(\s*)=(\s*)", lambda m: "=" + " " * (len(m[0]) - 1), rest)
    found = list(_KEYS_AFTER.finditer(spaced))
    if found:
        keys_from = found[0].start()
        readers = fields.readers[record.keyword]
        for i, match in enumerate(found):
            stop = found[i + 1].start() if i + 1 < len(found) else len(spaced)
            key = match[1].upper()
            value = spaced[match.end() : stop].strip()
            span = (start + match.start(1), start + stop)
            read_key(record.keys, span, (key, value), record.keyword, readers, complain)
    return read_expression(record, rest[:keys_from], start, complain)


def check_case_name(record: Record, mark: Mark, complain: Complain) -> None:
    """Complain of a name that no case may have."""
    name = record.args[0]
    if not re.fullmatch(r"[A-Z_][A-Z0-9_.]{0,31}", name):
        complain(f"{name} is no name of a case (a letter, then letters, digits, _ or .)", mark)
    elif name in ex.RESERVED:
        complain(f"{name} is the name of a load set or function, not of a case", mark)


def read_expression(
    record: Record, text: str, at: int, complain: Complain
) -> list[tuple[str, int, int]]:
    """Parse the expression of a CASE or COMB into the record."""
    if not text.strip():
        complain(
            f"nothing stands after =; write for instance {KEYWORDS[record.keyword].example}", None
        )
        return []
    try:
        record.expression, names = ex.parse(text)
    except ex.ExpressionFault as fault:
        complain(str(fault), (at + fault.start, at + fault.stop))
        return []
    return [(name, at + start, at + stop) for name, start, stop in names]
