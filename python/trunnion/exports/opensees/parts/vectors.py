"""Vectors of three as lists."""

from collections.abc import Sequence

Vector = Sequence[float]


def dot(a: Vector, b: Vector) -> float:
    """Scalar product."""
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a: Vector, b: Vector) -> list[float]:
    """Vector product."""
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def add(a: Vector, b: Vector) -> list[float]:
    """Sum."""
    return [x + y for x, y in zip(a, b, strict=True)]
