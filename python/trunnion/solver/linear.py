"""Cases of a structure whose contacts cannot change: one factor, all right-hand sides at once."""

from dataclasses import dataclass

import numpy as np

from trunnion.solver.friction import Solved
from trunnion.solver.newton import tangent_factor
from trunnion.solver.quantities import Forcing, Point
from trunnion.solver.structure import Structure


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Prepared:
    """A linear case that was solved together with others."""

    forcing: Forcing
    point: Point
    solved: Solved


def solve_linear(structure: Structure, forcings: list[Forcing]) -> list[Prepared]:
    """Solve every case in one call of the solver; an answer each."""
    if not forcings:
        return []
    law = structure.frictionless()
    points = [Point.zero(structure.n_node) for _ in forcings]
    starts = [
        structure.residual(point, law, forcing)
        for point, forcing in zip(points, forcings, strict=True)
    ]
    response = starts[0][2]
    tangent_factor(structure, response)
    moves = structure.solve(np.stack([r for r, _, _ in starts]))
    for point, move in zip(points, moves, strict=True):
        point.move(np.ascontiguousarray(move))
    return [
        Prepared(forcing, point, Solved(True, start[2], law))
        for forcing, point, start in zip(forcings, points, starts, strict=True)
    ]
