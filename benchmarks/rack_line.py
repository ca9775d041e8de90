"""A pipe rack line of any size (schema piperack-1), made from its description.

Straight runs on a rack, joined by U loops: a pipe of 1.5 m elements resting every 6 m with
mu 0.3, a guide with 3 mm to each side at every fourth rest of the runs, an axial stop with 25 mm
at every twentieth, anchored at both ends; 273.1 x 9.27 mm, full of water, +150 K.  The first run
has 6 bays, later ones 12, 10, 14, 11, 13 in turn; loops go to +Z and -Z in turn, with legs of 6, 9
and 7.5 m, widths of 6 and 9 m, raised by 3, 0 and 6 m.  Loops rest in the middle of each flat
side.  The line ends where its nodes are used up.
"""

from collections.abc import Iterator
from itertools import chain, count, cycle, repeat
from math import pi
from typing import Any, NamedTuple

Rack = dict[str, Any]

STEP, BAY = 1.5, 4  # element length [m], elements a bay
RUNS = (12, 10, 14, 11, 13)  # bays of the runs after the first
FIRST = 6
LEGS, WIDTHS, RISES = (4, 6, 5), (4, 6), (2, 0, 4)  # of the loops, in elements
GUIDES, STOPS = (4, 2), (20, 5)  # every fourth rest of the runs, from the second; ...
GUIDE_GAP, STOP_GAP, MU = 3e-3, 25e-3, 0.3
STIFF, STICK = 1e12, 1e8  # supports, friction [N/m]
PIPE = {
    "od": 0.2731, "t": 0.00927, "E": 203e9, "nu": 0.3, "alpha": 1.17e-5, "dT": 150.0,
    "rho_pipe": 7850.0, "rho_fluid": 1000.0, "g": 9.81,
}  # fmt: skip
X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


class Piece(NamedTuple):
    """A straight piece: direction, number of elements, where the pipe rests, on the rack or not."""

    axis: tuple[int, int, int]
    elements: int
    rests: frozenset[int] = frozenset()
    run: bool = False


def pieces() -> Iterator[Piece]:
    """The line without end, piece by piece."""
    bays = chain((FIRST,), cycle(RUNS))
    sides = cycle((1, -1))
    shapes = zip(bays, cycle(LEGS), cycle(WIDTHS), cycle(RISES), sides, strict=False)
    for n_bay, leg, width, rise, side in shapes:
        yield Piece(X, n_bay * BAY, frozenset(b * BAY + BAY // 2 for b in range(n_bay)), run=True)
        yield Piece(Y, rise)
        yield Piece((0, 0, side), leg, frozenset((leg // 2,)))
        yield Piece(X, width, frozenset((width // 2,)))
        yield Piece((0, 0, -side), leg, frozenset((leg - leg // 2,)))
        yield Piece((0, -1, 0), rise)


def rack_line(n: int) -> Rack:
    """Give the line of n nodes."""
    steps = [(0, 0, 0)]
    supports: list[Rack] = []
    turn = count(1)
    for piece, i in chain.from_iterable(
        zip(repeat(p), range(1, p.elements + 1), strict=False) for p in pieces()
    ):
        if len(steps) == n:
            break
        x, y, z = steps[-1]
        steps.append((x + piece.axis[0], y + piece.axis[1], z + piece.axis[2]))
        node = len(steps) - 1
        if i not in piece.rests or node == n - 1:
            continue
        supports.append(_support(node, "rest", Y, (0.0, None), MU))
        if piece.run:
            nth = next(turn)
            if nth % GUIDES[0] == GUIDES[1]:
                supports.append(_support(node, "guide", Z, (GUIDE_GAP, GUIDE_GAP)))
            if nth % STOPS[0] == STOPS[1]:
                supports.append(_support(node, "stop", X, (STOP_GAP, STOP_GAP)))
    return {
        "schema": "piperack-1",
        "name": f"rack_{n}",
        "pipe": dict(PIPE),
        "section": section(),
        "kn": STIFF,
        "kt": STICK,
        "gravity": [0, -PIPE["g"], 0],
        "nodes": [[STEP * x, STEP * y, STEP * z] for x, y, z in steps],
        "elements": [[i, i + 1] for i in range(n - 1)],
        "anchors": [0, n - 1],
        "supports": [{**s, "id": i} for i, s in enumerate(supports)],
    }


def section() -> dict[str, float]:
    """Section constants: A, I, J, G, weight [N/m] with water, thermal force [N]."""
    p = PIPE
    ro = p["od"] / 2
    ri = ro - p["t"]
    area, bore = pi * (ro**2 - ri**2), pi * ri**2
    inertia = pi / 4 * (ro**4 - ri**4)
    return {
        "A": area,
        "I": inertia,
        "J": 2 * inertia,
        "G": p["E"] / (2 * (1 + p["nu"])),
        "w": (area * p["rho_pipe"] + bore * p["rho_fluid"]) * p["g"],
        "Fth": p["E"] * area * p["alpha"] * p["dT"],
    }


def _support(
    node: int,
    kind: str,
    axis: tuple[int, int, int],
    sides: tuple[float, float | None],
    mu: float = 0,
) -> Rack:
    minus, plus = sides
    direction = [float(a) for a in axis]
    return {"node": node, "type": kind, "dir": direction, "minus": minus, "plus": plus, "mu": mu}
