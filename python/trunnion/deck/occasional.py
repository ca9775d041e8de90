"""Cards of wind and snow to the model."""

from itertools import pairwise
from typing import Any

from trunnion.deck.context import Context
from trunnion.deck.record import Record
from trunnion.loads.wind import pressure_of
from trunnion.model import Snow, Wind

_SOURCES = ("PRESSURE", "VELOCITY", "ASCE7")
_ASCE7 = ("EXPOSURE", "KZT", "KD", "GUST")


def wind(run: Context, record: Record) -> None:
    """WIND: a table of pressures or velocities, or ASCE 7; each set once."""
    keys, name = record.keys, record.args[0]
    for known in run.model.winds:
        if known.set == name[4:]:
            run.complain(record, f"set {name} is already given at {known.place}", name)
            return
    given = [key for key in _SOURCES if key in keys]
    if len(given) != 1:
        what = f"{given[0]} and {given[1]}: " if given else ""
        mark = f"{given[1]}=" if given else None
        run.complain(record, f"{what}give one of PRESSURE= VELOCITY= ASCE7=", mark)
        return
    table: tuple[tuple[float, float], ...] = ()
    if given[0] == "ASCE7":
        pass
    elif not _is_table(run, record, given[0]):
        return
    else:
        table = keys[given[0]]
    if given[0] == "VELOCITY":
        table = tuple((z, pressure_of(v)) for z, v in table)
    own: dict[str, Any] = {
        key.lower(): keys[key] for key in ("SHAPE", "GROUND", *_ASCE7) if key in keys
    }
    made = Wind(name[4:], keys["DIR"], table, keys.get("ASCE7"), place=record.place, **own)
    run.keep(run.model.winds, made)


def _is_table(run: Context, record: Record, key: str) -> bool:
    """Check elevations and values of a table, and that no key of ASCE 7 stands beside it."""
    points = record.keys[key]
    for other in _ASCE7:
        if other in record.keys:
            run.complain(record, f"{other} goes with ASCE7=, not with {key}=", f"{other}=")
            return False
    for i, (low, high) in enumerate(pairwise(points), 2):
        if not high[0] > low[0]:
            message = f"elevations must rise; point {i} of {key} is not above point {i - 1}"
            run.complain(record, message, f"{key}=")
            return False
    if any(value < 0.0 for _, value in points):
        run.complain(record, f"a {key.lower()} of the table is negative", f"{key}=")
        return False
    return True


def snow(run: Context, record: Record) -> None:
    """SNOW: weight per length of pipe."""
    run.keep(run.model.snows, Snow(record.keys["WEIGHT"], record.place))
