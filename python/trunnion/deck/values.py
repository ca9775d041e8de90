"""Texts to values: numbers with suffixes, vectors, gaps, labels, choices."""

import re
from collections.abc import Callable, Collection
from functools import lru_cache
from typing import Any

from trunnion.deck.keywords import ANY, Key
from trunnion.deck.units import Scale, SuffixError, scale_of

Vector = tuple[float, float, float]

_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_LABEL = re.compile(r"[A-Z0-9][A-Z0-9_.]{0,31}")
_NAME = re.compile(r"[^\s=!&(),\"']{1,64}")


class WordError(ValueError):
    """A value that cannot be read, with what would be right."""


def nearest(word: str, words: Collection[str]) -> str:
    """Hint at the valid word nearest to `word`: "; nearest: GAP", or nothing."""
    from difflib import get_close_matches

    if len(words) > 20000:  # a search would take longer than reading the deck
        words = {w for w in words if w[:2] == word[:2] and abs(len(w) - len(word)) < 3}
    found = get_close_matches(word, words, n=1, cutoff=0.5)
    return f"; nearest: {found[0]}" if found else ""


def number(text: object, scale: Scale, dimension: str) -> float:
    """Value in SI of a number with or without suffix."""
    if isinstance(text, str):
        try:
            if "_" in text:
                raise ValueError
            value = scale(float(text))
        except ValueError:
            value = _suffixed(text, dimension)
    else:
        try:
            if isinstance(text, bool):
                raise TypeError
            value = scale(float(text))  # type: ignore[arg-type] # numbers of numpy, too
        except (TypeError, ValueError, OverflowError):
            raise WordError(f"{text!r} is not a number") from None
    if value - value != 0.0:
        raise WordError(f"{text} is not a finite number")
    return value


def _suffixed(text: str, dimension: str) -> float:
    """Value in SI of "12bar"."""
    text = text.strip()
    found = _NUMBER.match(text)
    if found is None:
        raise WordError(f"{text or 'nothing'} is not a number")
    suffix = text[found.end() :].strip()
    try:
        return scale_of(suffix, dimension)(float(found[0]))
    except SuffixError as error:
        raise WordError(str(error)) from None


def vector(value: object) -> Vector:
    """Three numbers of "(a,b,c)" or of a sequence; not all zero."""
    parts = (
        value.strip().removeprefix("(").removesuffix(")").split(",")
        if isinstance(value, str)
        else value
    )
    try:
        x, y, z = (number(p, float, "number") for p in parts)  # type: ignore[attr-defined]
    except (TypeError, ValueError):
        raise WordError(f"{value} is not a direction (a,b,c) of three numbers") from None
    if x == y == z == 0.0:
        raise WordError(f"direction {value} has no length")
    return x, y, z


def lengths(value: object, scale: Scale) -> Vector:
    """Three lengths of "(a,b,c)" or of a sequence; not all zero."""
    parts = value.strip().strip("()").split(",") if isinstance(value, str) else value
    if not isinstance(parts, (list, tuple)) or len(parts) != 3:
        raise WordError(f"{value} is not (x,y,z) of three lengths")
    x, y, z = (number(p, scale, "length") for p in parts)
    if x == y == z == 0.0:
        raise WordError(f"{value} has no length")
    return x, y, z


def gap(value: object, scale: Scale, dimension: str) -> tuple[float, float]:
    """Clearances minus and plus of "a" or "a,b"."""
    parts = value.split(",") if isinstance(value, str) else value
    if not isinstance(parts, (list, tuple)):
        parts = (parts,)
    if len(parts) not in (1, 2):
        raise WordError(f"{value} has {len(parts)} values; GAP=a is both sides, GAP=a,b minus,plus")
    both = [number(p, scale, dimension) for p in parts]
    if min(both) < 0.0:
        raise WordError(f"gap {parts[0] if both[0] < 0.0 else parts[-1]} is negative")
    return both[0], both[-1]


@lru_cache(maxsize=2**18)  # a label stands on many cards
def label(value: str) -> str:
    """Node label: letters, digits, "_" and ".", upper case."""
    text = value.strip().upper()
    plain = text.isdigit() and text.isascii() and len(text) <= 32  # most labels are numbers
    if not plain and _LABEL.fullmatch(text) is None:
        raise WordError(f"{value} is no node label (letters, digits, _ and . , up to 32)")
    return text


def name(value: object) -> str:
    """Name of a material, section or case, upper case."""
    text = str(value).strip().upper()
    if _NAME.fullmatch(text) is None:
        raise WordError(f"{value} is no name (no spaces, quotes, commas, = ! & or parentheses)")
    return text


def text(value: object) -> str:
    """Word kept as written."""
    found = str(value).strip()
    if _NAME.fullmatch(found) is None:
        raise WordError(f"{value} is no name (no spaces, quotes, commas, = ! & or parentheses)")
    return found


def choice(value: object, choices: tuple[str, ...]) -> str:
    """One of some words."""
    found = ("OFF", "ON")[value] if isinstance(value, bool) else str(value).strip().upper()
    if found not in choices:
        raise WordError(f"{value} is not one of {' '.join(choices)}")
    return found


def integer(value: object) -> int:
    """Whole number."""
    found = number(value, float, "number")
    if found != int(found):
        raise WordError(f"{value} is not a whole number")
    return int(found)


def pairs(
    value: object, scales: tuple[Scale, Scale], dimensions: tuple[str, str]
) -> tuple[tuple[float, float], ...]:
    """Points of "(x,y),(x,y)" or of a sequence of pairs."""
    rows = value
    if isinstance(value, str):
        text = "".join(value.split())
        if not (text.startswith("(") and text.endswith(")")):
            raise WordError(f"{_short(text)} is no table; write (x,y),(x,y)")
        rows = [part.split(",") for part in text[1:-1].split("),(")]
    found = []
    try:
        for i, row in enumerate(rows, 1):  # type: ignore[arg-type,var-annotated]
            if len(row) != 2:
                raise WordError(f"point {i} of the table has {len(row)} numbers; write (x,y),(x,y)")
            x, y = (number(p, s, d) for p, s, d in zip(row, scales, dimensions, strict=True))
            found.append((x, y))
    except TypeError:
        raise WordError(f"{_short(str(value))} is no table of points (x,y)") from None
    return tuple(found)


def _short(text: str) -> str:
    """Cut a long text for a message."""
    return text if len(text) <= 40 else f"{text[:40]} ..."


def direction(value: object) -> str:
    """X, Y, Z, or "(a,b,c)", given as text or as three numbers."""
    text = str(value).strip().upper()
    if text in ("X", "Y", "Z"):
        return text
    if isinstance(value, str) and not text.startswith("("):
        raise WordError(f"direction {value} is not one of X Y Z or (a,b,c)")
    return f"({','.join(repr(x) for x in vector(value))})"


def along(value: object) -> str:
    """Pipe of ALONG=30-40, given as text or as two labels."""
    ends = value.split("-") if isinstance(value, str) else value
    if not isinstance(ends, (list, tuple)) or len(ends) != 2:
        raise WordError(f"{value} is no pipe; write ALONG=30-40")
    return f"{label(str(ends[0]))}-{label(str(ends[1]))}"


Reader = Callable[[Any], Any]


def reader_of(key: Key, scales: dict[str, Scale], dimension: str = "") -> Reader:
    """Build the function that reads the value of one key under one UNITS card."""
    dimension = key.dimension or dimension
    bounds = key.bounds
    match key.kind:
        case "number":
            return _number_reader(key, scales[dimension], dimension)
        case "integer":
            return lambda value: _within(integer(value), value, key)
        case "choice":
            return lambda value: choice(value, key.choices)
        case "pairs":
            x, y = dimension.split(", ")
            return lambda value: pairs(value, (scales[x], scales[y]), (x, y))
        case "lengths":
            return lambda value: lengths(value, scales["length"])
        case "gap":
            return lambda value: gap(value, scales[dimension], dimension)
    if bounds is not ANY:
        raise ValueError(f"bounds on {key.name}")
    return {
        "node": lambda value: label(str(value)),
        "name": name,
        "text": text,
        "vector": vector,
        "along": along,
    }[key.kind]


def _number_reader(key: Key, scale: Scale, dimension: str) -> Reader:
    """Build the reader of a number; the common case, without suffix and bounds, is short."""
    if dimension == "temperature":
        return lambda value: _possible(number(value, scale, dimension), value)
    if key.bounds is ANY:
        return lambda value: number(value, scale, dimension)
    return lambda value: _within(number(value, scale, dimension), value, key)


def _possible(celsius: float, value: object) -> float:
    """Refuse temperatures that do not exist."""
    if celsius < -273.15:
        raise WordError(f"{value} is below absolute zero")
    return celsius


def _within(found: float, value: object, key: Key) -> Any:
    """Check the bounds of a key."""
    low, high, open_low = key.bounds
    if found < low or found > high or (open_low and found == low):
        raise WordError(f"{key.name}={value} must be {key.bounds}")
    return found
