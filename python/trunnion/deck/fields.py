"""One card, or one call of the Python API, to a Record: words to values by the keyword table."""

from collections.abc import Callable
from functools import lru_cache, partial
from typing import Any, NamedTuple

from trunnion.deck import units as un
from trunnion.deck import values as va
from trunnion.deck.keywords import KEYWORDS, PRESSURE_SETS, TEMPERATURE_SETS, Key, Positional
from trunnion.deck.record import Mark, Record
from trunnion.deck.units import Scale
from trunnion.deck.values import Reader, WordError, nearest
from trunnion.model import Direction, Units

Complain = Callable[[str, Mark], None]


class Form(NamedTuple):
    """One keyword made ready for one UNITS card: what its words and keys are read by.

    positionals : a reader for each, and the key under which it is kept if it is a number.
    required : keys that must be there.
    least : positionals that must be there.
    """

    positionals: tuple[tuple[Reader, str], ...]
    readers: dict[str, Reader]
    required: tuple[str, ...]
    least: int


class Fields:
    """The keyword table made ready for one UNITS card: a reader for each key."""

    def __init__(self, units: Units) -> None:
        scales = un.scales(units)
        self.readers: dict[str, dict[str, Reader]] = {
            word.name: {
                key.name: va.reader_of(key, scales)
                for key in word.keys
                if key.dimension or (key.kind != "number" and key.kind != "gap")
            }
            for word in KEYWORDS.values()
        }
        self.forms = {
            word.name: Form(
                tuple(_positional(p, scales) for p in word.positionals),
                self.readers[word.name],
                tuple(key.name for key in word.keys if key.required),
                sum(not p.optional for p in word.positionals),
            )
            for word in KEYWORDS.values()
        }
        keys = {key.name: key for key in KEYWORDS["SUPPORT"].keys}
        moving = {"GAP": "length", "K": "stiffness"}
        turning = {"GAP": "angle", "K": "rotational stiffness"}
        common = self.readers["SUPPORT"]
        self.directions = (  # readers for translations and for rotations
            {**common, **{k: va.reader_of(keys[k], scales, d) for k, d in moving.items()}},
            {**common, **{k: va.reader_of(keys[k], scales, d) for k, d in turning.items()}},
        )
        self.supports: dict[tuple[Any, ...], tuple[dict[str, Any], tuple[Direction, ...]]] = {}


@lru_cache(maxsize=8)
def fields_of(units: Units) -> Fields:
    """Give the readers for one UNITS card, made once."""
    return Fields(units)


_FAMILIES = frozenset((*TEMPERATURE_SETS, *PRESSURE_SETS))


def read_fields(record: Record, items: list[Any], fields: Fields, complain: Complain) -> None:
    """Fill the positionals and keys of a record of form "fields".

    Parameters
    ----------
    items : words of the card after its keyword; a pair (key, value) or a positional.
    complain : takes each fault and the index of the word at fault.
    """
    wanted, readers, required, least = fields.forms[record.keyword]
    keys, args, most, at = record.keys, record.args, len(wanted), 0
    strange = False
    for i, item in enumerate(items, 1):
        if isinstance(item, tuple):
            name, value = item
            if name in readers and name not in keys:
                try:
                    keys[name] = readers[name](value)
                except WordError as fault:
                    keys[name] = None
                    complain(_named(name, fault), i)
            else:
                strange = True
                read_key(keys, i, item, record.keyword, readers, complain)
        elif at < most:
            reader, number = wanted[at]
            at += 1
            try:
                found = reader(item)
            except WordError as fault:
                found = None if number else str(item).upper()
                complain(str(fault), i)
            if number:
                keys[number] = found
            else:
                args.append(found)
        else:
            strange = True
            complain(_one_too_many(str(item), record.keyword, most), i)
    if strange:
        return  # a misspelling is told; what is missing may be what was meant
    if at < least:
        missing = [p for p in KEYWORDS[record.keyword].positionals[at:] if not p.optional]
        complain(f"{' and '.join(_described(p) for p in missing)} missing", None)
    for name in required:
        if name not in keys:
            complain(f"{name}= is missing", None)


def _named(name: str, fault: WordError) -> str:
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
    if not name.isidentifier():
        return f"{name} before = is no key"
    listed = " ".join(k for k in keys if k not in _FAMILIES)
    for first, last in (("T1", "T9"), ("P1", "P9")):
        listed += f" {first}-{last}" if first in keys else ""
    return f"{name} is no key of {keyword}{nearest(name, keys)} (keys: {listed})"


def _one_too_many(word: str, keyword: str, most: int) -> str:
    """Say that a positional is not wanted."""
    keys = tuple(key.name for key in KEYWORDS[keyword].keys)
    if word == "&":
        return "& continues a card only at the end of its line"
    if word.upper() in keys:
        return f"{word} needs a value: {word.upper()}=..."
    before = f"only {most} word{'s' * (most > 1)} before the keys" if most else "only KEY=VALUE"
    return f"word {word} is not expected; {keyword} takes {before}"


def _positional(wanted: Positional, scales: dict[str, Scale]) -> tuple[Reader, str]:
    """Give the reader of one positional, and the key that keeps it if it is a number."""
    if wanted.kind in ("number", "integer"):
        key = Key(wanted.name, "", wanted.dimension, wanted.kind, bounds=wanted.bounds)
        return va.reader_of(key, scales), wanted.name.upper()
    plain: dict[str, Reader] = {"node": va.label, "name": va.name, "direction": va.direction}
    return plain.get(wanted.kind) or partial(_one_of, wanted), ""


def _one_of(wanted: Positional, item: Any) -> str:
    """Read a positional that has choices."""
    found = str(item).strip().upper()
    if found not in wanted.choices:
        what = "load set" if wanted.kind == "set" else "word"
        raise WordError(f"{what} {item} is not one of {' '.join(wanted.choices)}")
    return found


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
        except WordError as fault:
            keys[name] = None
            complain(_named(name, fault), mark)
