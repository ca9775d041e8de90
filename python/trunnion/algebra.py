"""Expressions of results: + - n* ABS SRSS MAX MIN SIGNMAX SCALAR, number by number.

SRSS, MAX and MIN give sizes without sign.  SIGNMAX gives the number of largest size with its
sign, + where two are equal.  SCALAR adds with signs, as + does: in the trade it differs from the
algebraic sum in the stresses of piping codes only.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import reduce

import numpy as np

from trunnion.arrays import B1, F8
from trunnion.deformation import two_difference
from trunnion.model import Expression

_LINEAR = frozenset(("case", "+", "-", "*", "neg", "scalar"))


@dataclass(frozen=True, slots=True)
class Numbers:
    """All numbers of one result in a row, as unevaluated sums high + low."""

    high: F8
    low: F8

    @property
    def total(self) -> F8:
        """The sums, rounded."""
        total: F8 = self.high + self.low
        return total


def exact(values: F8) -> Numbers:
    """Numbers without a low part, in a row."""
    return Numbers(values.ravel(), np.zeros(values.size))


def _sum(a: Numbers, b: Numbers) -> Numbers:
    high, error = two_difference(a.high, -b.high)
    return Numbers(high, error + a.low + b.low)


def _times(n: float, a: Numbers) -> Numbers:
    return Numbers(n * a.high, n * a.low)


def _size(a: Numbers) -> Numbers:
    sign = np.where(np.signbit(a.total), -1.0, 1.0)
    return Numbers(sign * a.high, sign * a.low)


def _srss(*all_: Numbers) -> Numbers:
    if len(all_) == 1:
        return _size(all_[0])
    return exact(np.hypot.reduce([a.total for a in all_]))


def _chosen(second: B1, a: Numbers, b: Numbers) -> Numbers:
    return Numbers(np.where(second, b.high, a.high), np.where(second, b.low, a.low))


def _larger(a: Numbers, b: Numbers) -> Numbers:
    return _chosen(b.total > a.total, a, b)


def _smaller(a: Numbers, b: Numbers) -> Numbers:
    return _chosen(b.total < a.total, a, b)


def _farther(a: Numbers, b: Numbers) -> Numbers:
    x, y = np.abs(a.total), np.abs(b.total)
    return _chosen((y > x) | ((y == x) & (b.total > a.total)), a, b)


# What each word of an expression does with its evaluated operands
OPERATIONS: dict[str, Callable[..., Numbers]] = {
    "+": _sum,
    "-": lambda a, b: _sum(a, _times(-1.0, b)),
    "*": _times,
    "neg": lambda a: _times(-1.0, a),
    "abs": _size,
    "srss": _srss,
    "max": lambda *all_: reduce(_larger, map(_size, all_)),
    "min": lambda *all_: reduce(_smaller, map(_size, all_)),
    "signmax": lambda *all_: reduce(_farther, all_),
    "scalar": lambda *all_: reduce(_sum, all_),
}


def evaluate(expression: Expression, numbers: Mapping[str, Numbers]) -> Numbers:
    """Evaluate an expression of case names on the numbers of those cases."""
    word, *parts = expression
    if word == "case":
        return numbers[str(parts[0])]
    operands = [evaluate(p, numbers) if isinstance(p, tuple) else p for p in parts]
    return OPERATIONS[str(word)](*operands)


def parents(expression: Expression) -> list[str]:
    """Names of the cases in an expression, each once, in order."""
    if expression[0] == "case":
        return [str(expression[1])]
    inner = [name for part in expression[1:] if isinstance(part, tuple) for name in parents(part)]
    return list(dict.fromkeys(inner))


def is_linear(expression: Expression) -> bool:
    """Whether the expression is a weighted sum: then it has interior points as a case has."""
    if expression[0] == "case":
        return True
    inner = all(is_linear(part) for part in expression[1:] if isinstance(part, tuple))
    return expression[0] in _LINEAR and inner
