"""The words of the deck as calls of the Python API: the same table, the same interpreter."""

from collections.abc import Mapping
from typing import Any

from trunnion.deck.checks import check
from trunnion.deck.context import Carried, Context
from trunnion.deck.directions import read_directions
from trunnion.deck.equations import check_case_name, read_expression, read_list, require_keys
from trunnion.deck.fields import fields_of, read_fields, read_key
from trunnion.deck.interpreter import apply
from trunnion.deck.keywords import KEYWORDS
from trunnion.deck.record import Fault, Mark, Record
from trunnion.errors import DeckError, ModelError, Problem
from trunnion.model import Model, Place, Units

_SI = Units()


def add(
    model: Model, keyword: str, args: tuple[Any, ...], keys: Mapping[str, Any], place: Place
) -> None:
    """Add one record to a model; plain numbers are SI, texts may carry a unit.

    Parameters
    ----------
    args : positionals; a pair (word, keys) is a direction of a support with its keys.
    keys : KEY=VALUE; None stands for a key that is not given.

    Raises
    ------
    DeckError : with every problem of the call; the model is as before.
    """
    heard: list[tuple[str, Mark]] = []
    record = Record(keyword, place)

    def complain(message: str, mark: Mark) -> None:
        heard.append((message, mark))

    fields = fields_of(_SI)
    given = [(k.upper(), _plain(v)) for k, v in keys.items() if v is not None]
    form = KEYWORDS[keyword].form
    if form in ("equation", "list"):
        flags = {flag for flag, _ in KEYWORDS[keyword].flags}
        for item in given:
            if item[0] in flags:
                record.keys.update({item[0]: True} if item[1] is True else {})
            else:
                read_key(record.keys, None, item, keyword, fields.readers[keyword], complain)
        record.args.append(str(args[0]).strip().upper())
        if keyword != "GROUP":
            check_case_name(record, None, complain)
        if form == "equation":
            read_expression(record, str(args[1]), 0, complain)
        else:
            read_list(record, ",".join(map(str, args[1:])), (0, 0), complain)
            require_keys(record, complain)
    elif form == "directions":
        read_directions(record, [str(args[0]), *given, *_flat(args[1:])], fields, complain)
    else:
        read_fields(record, [*map(_word, args), *given], fields, complain)
    faults = [Fault(place, record.head, message, mark) for message, mark in heard]
    carried = model.carried or Carried()
    kept = carried.section, carried.material, carried.operation
    if not faults:
        apply(Context(model, carried, faults), record)
    if faults:
        carried.section, carried.material, carried.operation = kept
        raise DeckError(_problems(faults))
    model.carried = carried


def _flat(words: tuple[Any, ...]) -> list[Any]:
    """Put directions and their keys in one row, as on a card."""
    items: list[Any] = []
    for word in words:
        direction: Any = word
        keys: Mapping[str, Any] = {}
        if isinstance(word, tuple) and len(word) == 2 and isinstance(word[1], Mapping):
            direction, keys = word
        items.append(_word(direction))
        items += [(str(k).upper(), _plain(v)) for k, v in keys.items() if v is not None]
    return items


def _word(value: Any) -> str:
    """Write a positional as on a card; three numbers are a direction."""
    if isinstance(value, str) or not hasattr(value, "__iter__"):
        return str(value)
    return f"({','.join(str(float(x)) for x in value)})"


def _plain(value: Any) -> Any:
    """Make lists and arrays tuples of numbers; all else stays."""
    if isinstance(value, (str, int, float)) or not hasattr(value, "__iter__"):
        return value
    return tuple(map(_plain, value))


def check_model(model: Model) -> None:
    """Raise all faults of a model that show without geometry.

    Raises
    ------
    ModelError : with every problem, by the place of its record.
    """
    faults = check(model)
    if faults:
        raise ModelError(_problems(faults))


def _problems(faults: list[Fault]) -> list[Problem]:
    """Faults as problems; a fault of the whole model has no place of its own."""
    return [
        Problem(
            fault.place if fault.place.file else "model",
            fault.text,
        )
        for fault in faults
    ]
