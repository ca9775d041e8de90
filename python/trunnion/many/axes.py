"""What a study varies: `KEY[@label[,part]]=list` or `=lo:hi:n`, read by the deck's own table.

A value means what the key means on its card, in the units of the deck, with the same bounds.
"""

from collections.abc import Sequence
from itertools import product

import numpy as np

from trunnion.deck.fields import fields_of
from trunnion.deck.values import Reader, WordError, nearest, number
from trunnion.errors import BatchError
from trunnion.frozen import frozen
from trunnion.many.edits import Edit, Quantity
from trunnion.many.quantities import QUANTITIES
from trunnion.model import Model

MOST = 1_000_000  # variants of one study


@frozen(eq=False)
class Axis:
    """One quantity that varies.

    name : "MU", "GAP@60,Z", as in reports.
    values : in SI (degrees Celsius).  texts : as they were given, for reports.
    level : what has to be made anew: "cases", "loads", "supports" or "members".
    edit : gives the model with a value.
    """

    name: str
    values: tuple[float, ...]
    texts: tuple[str, ...]
    level: str
    edit: Edit


def read_axes(model: Model, texts: Sequence[str]) -> tuple[Axis, ...]:
    """Read what `--vary` says of a model.

    Raises
    ------
    BatchError
        All faults of all texts, with the nearest valid words.
    """
    axes: list[Axis] = []
    faults: list[str] = []
    for text in texts:
        try:
            axes.append(_axis(model, text))
        except WordError as fault:
            faults.append(f"--vary {text}: {fault}")
    names = [axis.name for axis in axes]
    faults += [f"--vary {n}: given twice" for n in dict.fromkeys(names) if names.count(n) > 1]
    if not texts:
        faults.append("nothing to vary: give --vary KEY[@label]=values")
    if not faults and (n := count(axes)) > MOST:
        faults.append(f"{n} variants; {MOST} are the limit")
    if faults:
        raise BatchError("\n".join([*faults, "nothing was solved"]))
    return tuple(axes)


def count(axes: Sequence[Axis]) -> int:
    """Number of combinations."""
    n = 1
    for axis in axes:
        n *= len(axis.values)
    return n


def combinations(axes: Sequence[Axis]) -> list[tuple[int, ...]]:
    """All combinations as numbers of the values, the last axis fastest."""
    return list(product(*(range(len(axis.values)) for axis in axes)))


def _axis(model: Model, text: str) -> Axis:
    left, equals, right = text.partition("=")
    if not equals:
        raise WordError("write KEY[@label]=values, e.g. MU=0.1:0.5:9 or GAP@60=0,3mm")
    key, _, place = (word.strip() for word in left.upper().partition("@"))
    label, _, part = (word.strip() for word in place.partition(","))
    if key not in QUANTITIES:
        raise WordError(f"{key or 'nothing'} is no quantity of a study{nearest(key, QUANTITIES)}")
    quantity = QUANTITIES[key]
    if quantity.labels and not label:
        raise WordError(f"{key} needs a place: {key}@{quantity.labels}")
    edit = quantity.find(model, label, part)
    values, texts = _values(right.strip(), _reader(model, quantity, part))
    name = f"{key}{'@' * bool(label)}{label}{',' * bool(part)}{part}"
    return Axis(name, values, texts, quantity.level(model), edit)


def _reader(model: Model, quantity: Quantity, part: str) -> Reader:
    """Reader of the card's key under the deck's units; a component has its own."""
    if quantity.card == "CASE" and quantity.key == "FACTOR":
        return lambda text: number(text, float, "number")
    fields = fields_of(model.units)
    if quantity.card in ("DISPLACEMENT", "FORCE"):
        return fields.readers[quantity.card][part]
    if quantity.card == "SUPPORT":
        reader = fields.directions[0][quantity.key]
        return (lambda text: reader(text)[0]) if quantity.key == "GAP" else reader
    return fields.readers[quantity.card][quantity.key]


def _values(text: str, reader: Reader) -> tuple[tuple[float, ...], tuple[str, ...]]:
    """Values of "a,b,c" or of "lo:hi:n", equally spaced, both ends included."""
    if ":" not in text:
        words = [word.strip() for word in text.split(",")]
        return _distinct([float(reader(word)) for word in words], words)
    ends = text.split(":")
    if len(ends) != 3:
        raise WordError(f"{text} is no range; write lo:hi:n")
    low, high = float(reader(ends[0])), float(reader(ends[1]))
    if not ends[2].strip().isdecimal() or not 2 <= int(ends[2]) <= MOST:
        raise WordError(f"{ends[2] or 'nothing'} in {text} is no number of values from 2 on")
    values = np.linspace(low, high, int(ends[2])).tolist()
    values[-1] = high
    return _distinct(values, _between(ends[0].strip(), ends[1].strip(), values))


def _between(low: str, high: str, values: list[float]) -> list[str]:
    """Name the values of a range in the unit of its ends where both have the same."""
    units = {_unit(low), _unit(high)}
    unit = units.pop()
    if units or values[0] == values[-1]:
        return [f"{value:.10g}" for value in values]
    a, b = (float(text.removesuffix(unit)) for text in (low, high))
    n = len(values) - 1
    return [f"{a + (b - a) * i / n:.10g}{unit}" for i in range(n + 1)]


def _unit(text: str) -> str:
    return text[len(text.rstrip("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ/.^*")) :]


def _distinct(values: list[float], texts: list[str]) -> tuple[tuple[float, ...], tuple[str, ...]]:
    if len(set(values)) < len(values):
        raise WordError("a value is given twice")
    return tuple(values), tuple(texts)
