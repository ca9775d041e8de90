"""Vectors of three as plain tuples: for records, where one numpy call an item would be slow."""

from math import sqrt

Vec = tuple[float, float, float]

AXES: tuple[Vec, Vec, Vec] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def add(a: Vec, b: Vec) -> Vec:
    """Return a + b."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a: Vec, b: Vec) -> Vec:
    """Return a - b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(f: float, a: Vec) -> Vec:
    """Return f a."""
    return (f * a[0], f * a[1], f * a[2])


def dot(a: Vec, b: Vec) -> float:
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vec, b: Vec) -> Vec:
    """Return a x b."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def size(a: Vec) -> float:
    """Return |a|."""
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])


def unit(a: Vec) -> Vec:
    """Return a / |a|; the zero vector stays."""
    length = size(a)
    return a if length == 0.0 else (a[0] / length, a[1] / length, a[2] / length)


def forward(a: Vec) -> Vec:
    """Return a or -a, so that the largest global component is positive.

    Of components that are equal to 1e-9 the first one decides: round-off cannot turn the sense.
    """
    limit = (1.0 - 1e-9) * max(abs(a[0]), abs(a[1]), abs(a[2]))
    leading = next(x for x in a if abs(x) >= limit)
    return a if leading > 0.0 else scale(-1.0, a)


def upright(ex: Vec, up: Vec) -> tuple[Vec, Vec, Vec]:
    """Axes of a member along the unit vector `ex`: ey leans upwards, ez = ex x ey.

    A vertical member (to 1e-6 rad) has no upward side: there ey is global X.
    """
    side = cross(ex, up)
    ez = unit(cross(ex, AXES[0]) if size(side) < 1e-6 else side)
    return ex, cross(ez, ex), ez


def complement(normals: list[Vec]) -> list[Vec]:
    """Orthonormal directions normal to all `normals`; the nearest global axes lead the choice."""
    span: list[Vec] = []
    for normal in normals:
        rest = _without(normal, span)
        if size(rest) > 1e-6:
            span.append(unit(rest))
    free: list[Vec] = []
    for _ in range(3 - len(span)):
        rests = [_without(axis, span + free) for axis in AXES]
        largest = max(size(rest) for rest in rests)
        pick = next(rest for rest in rests if size(rest) >= (1.0 - 1e-9) * largest)
        free.append(unit(_without(unit(pick), span + free)))
    return free


def _without(a: Vec, span: list[Vec]) -> Vec:
    """Return a less its parts along the orthonormal `span`."""
    for e in span:
        a = sub(a, scale(dot(a, e), e))
    return a
