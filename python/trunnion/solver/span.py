"""One load step: from where to where, under which law, and how it is solved."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from trunnion.solver.friction import Solved
from trunnion.solver.history import History
from trunnion.solver.quantities import Forcing, Point, Sliding
from trunnion.solver.structure import Structure
from trunnion.solver.verdict import commit

Step = Callable[[Structure, Point, Sliding, Forcing, History], Solved]


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Span:
    """A load step.

    law : friction with the datum committed at its start.
    start, target : loads; before : the point at its start.
    solve : the iteration.
    """

    structure: Structure
    law: Sliding
    start: Forcing
    target: Forcing
    before: Point
    solve: Step
    history: History

    def load(self, t: float) -> Forcing:
        """Loads a fraction t of the way."""
        return self.start.toward(self.target, t)

    def part(self, point: Point, t: float) -> Solved:
        """Solve for the loads a fraction t of the way, from where `point` stands."""
        return self.solve(self.structure, point, self.law, self.load(t), self.history)

    def whole(self, point: Point) -> Solved:
        """Solve for the target from the start."""
        point.become(self.before)
        return self.part(point, 1.0)

    def committed(self, solved: Solved) -> Sliding:
        """The law of what follows a converged part."""
        law = self.law
        datum = commit(law.datum, law.kf, solved.response)
        return replace(law, datum=datum, capacity=np.zeros_like(law.mu), coupled=False)
