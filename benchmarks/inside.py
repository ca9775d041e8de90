"""What a benchmark sees of an iteration while it runs: its points, pass by pass.

The solver is watched from outside, by putting wrappers around a few of its functions for the time
of one run.  Nothing of the product knows of it.  Two things are taken:

- the points that the iteration passes through, with the clock (`watched`), for error against time;
- the tolerance at which the status iteration accepts its point (`accepting`): a constant of
  `trunnion.solver.status`, replaced for this run only.  The product has no such knob.

Points hold the nodes of the equations (supports, branches, ends): errors are measured there.
"""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trunnion.solver import answer, status
from trunnion.solver.history import History
from trunnion.solver.structure import Structure

F8 = NDArray[np.float64]


@dataclass(slots=True, eq=False, repr=False)
class Passes:
    """Points of one run.

    nodes : numbers of the equations' nodes in the model.
    seconds : clock at each pass, without the time the watching took.
    what, factorised : name of the stage and factorisations so far, a pass.
    points : displacements (n, 6) after each pass.
    accepted : the point the iteration handed over as its answer; None: it handed over none.
    """

    nodes: NDArray[np.int32] | None = None
    seconds: list[float] = field(default_factory=list)
    what: list[str] = field(default_factory=list)
    factorised: list[int] = field(default_factory=list)
    points: list[F8] = field(default_factory=list)
    accepted: F8 | None = None
    accepted_after: float = float("nan")


@contextmanager
def watched(every: int = 1) -> Iterator[Passes]:
    """Keep the points of what is solved inside; of long iterations every so many-th pass."""
    seen, asked = Passes(), Asked()
    residual, respond, add = Structure.residual, Structure.respond, History.add
    report = getattr(answer, "report_numbers")  # noqa: B009  (a name it imports)
    start = time.perf_counter()

    def see_residual(self, point, *args, **kwargs):  # type: ignore[no-untyped-def]
        asked.point, asked.structure = point, self
        return residual(self, point, *args, **kwargs)

    def see_respond(self, point, *args, **kwargs):  # type: ignore[no-untyped-def]
        asked.point, asked.structure = point, self
        return respond(self, point, *args, **kwargs)

    def see_add(self, what, *args, **kwargs):  # type: ignore[no-untyped-def]
        now = time.perf_counter()
        add(self, what, *args, **kwargs)
        asked.passes += 1
        if asked.point is not None and asked.passes % every == 0:
            seen.seconds.append(now - start - asked.lost)
            seen.what.append(what)
            seen.factorised.append(self.ledger.count["factorise"])
            seen.points.append(asked.point.u.copy())
        asked.lost += time.perf_counter() - now

    def see_report(structure, point, *args, **kwargs):  # type: ignore[no-untyped-def]
        now = time.perf_counter()
        seen.nodes = structure.kept
        seen.accepted, seen.accepted_after = point.u.copy(), now - start - asked.lost
        return report(structure, point, *args, **kwargs)

    try:
        _put(see_residual, see_respond, see_add, see_report)
        yield seen
    finally:
        _put(residual, respond, add, report)
        if seen.nodes is None and asked.structure is not None:
            seen.nodes = asked.structure.kept


@dataclass(slots=True)
class Asked:
    """The point of the last call, passes so far and seconds lost by watching."""

    point: Any = None
    structure: Any = None
    passes: int = 0
    lost: float = 0.0


def _put(residual, respond, add, report) -> None:  # type: ignore[no-untyped-def]
    for owner, name, function in (
        (Structure, "residual", residual),
        (Structure, "respond", respond),
        (History, "add", add),
        (answer, "report_numbers", report),
    ):
        setattr(owner, name, function)


@contextmanager
def accepting(tolerance: float) -> Iterator[None]:
    """Let the status iteration accept a point whose remaining change is below `tolerance`."""
    tight, status.TIGHT = status.TIGHT, tolerance
    try:
        yield
    finally:
        status.TIGHT = tight
