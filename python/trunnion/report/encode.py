"""Pieces of JSON: compact, without NaN, whole arrays at a time."""

import json
import math
from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import NDArray


def dump(value: object) -> str:
    """Write one value on one line."""
    return json.dumps(value, allow_nan=False, separators=(",", ":"), default=_plain)


def rows(values: NDArray[np.float64]) -> list[str]:
    """Write an (n, m) array as n pieces "[a,b,c]", each number with all its digits."""
    if not len(values):
        return []
    text = dump((values + 0.0).tolist())  # + 0.0: no negative zeros
    return [f"[{row}]" for row in text[2:-2].split("],[")]


def numbers(values: NDArray[np.float64]) -> list[str]:
    """Write an (n,) array as n pieces."""
    return dump((values + 0.0).tolist())[1:-1].split(",") if len(values) else []


def words(values: Iterable[str | None]) -> list[str]:
    """Write n strings as n pieces."""
    return [dump(value) for value in values]


def finite(value: float) -> float | None:
    """Only a failed test can be infinite or undefined; JSON has neither."""
    return float(value) if math.isfinite(value) else None


def lines(parts: Mapping[str, str]) -> str:
    """Write an object, one member a line."""
    return "{\n" + ",\n".join(f"{dump(key)}:{value}" for key, value in parts.items()) + "\n}"


def listing(entries: Iterable[str]) -> str:
    """Write a list, one entry a line."""
    return "[\n" + ",\n".join(entries) + "\n]"


def records(columns: Mapping[str, list[str]]) -> list[str]:
    """Turn columns of pieces into one object a row."""
    form = "{" + ",".join(f'"{key}":%s' for key in columns) + "}"
    return [form % row for row in zip(*columns.values(), strict=True)]


def _plain(value: object) -> object:
    """Accept numpy's scalars."""
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"{type(value).__name__} has no place in the report")
