"""Other starts of the iterations of one case: where a search for further answers begins.

The law, its loads and its committed datum stay as they are: a start is only a first guess of
displacements and friction capacities, so every certified answer from it is one of the case.
"""

from collections.abc import Callable, Iterator

import numpy as np

from trunnion.arrays import F8, CaseResult, Loads
from trunnion.cases.analysis import Start
from trunnion.frozen import frozen

SEED = 20_260_731  # of the random starts: the same in every run
STICKS = 1e6  # factor on mu with which everything that presses sticks
LIFT = 1.0  # of the pipe at the start with all supports open [m]
WIDE = 1.5  # random capacities go that far beyond the largest known

NEVER = 1e9  # a friction capacity that is never reached [N]

Ask = Callable[[float, F8 | None], CaseResult]  # friction times a factor, first capacities


@frozen(eq=False)
class Known:
    """Normal forces (n_slider,) of the case and of its two extremes, None where there is none."""

    mu: F8
    own: F8 | None
    free: F8 | None
    stuck: F8 | None
    u_own: F8 | None
    u_free: F8 | None
    up: F8
    shape: tuple[int, int]  # of displacements
    load: float  # all loads added up: a size where no normal force is known [N]

    @property
    def largest(self) -> F8:
        """Largest normal force known of each slider [N]; of no force the mean of the others."""
        known = [n for n in (self.own, self.free, self.stuck) if n is not None]
        largest: F8 = np.max(known, axis=0) if known else np.zeros_like(self.mu)
        mean = float(largest.mean()) or self.load
        return np.where(largest > 0.0, largest, mean)


def known_forces(own: CaseResult, mu: F8, loads: Loads, ask: Ask) -> Known:
    """Solve the case without friction, and with everything that presses stuck from the start."""
    line = loads.dist * own.system.length[:, None]
    free, stuck = ask(0.0, None), ask(STICKS, np.where(mu > 0.0, NEVER, 0.0))
    return Known(
        mu=mu,
        own=_normal(own),
        free=_normal(free),
        stuck=_normal(stuck),
        u_own=None if own.state is None else own.state.u,
        u_free=None if free.state is None else free.state.u,
        up=own.system.up,
        shape=(len(own.system.labels), 6),
        load=float(np.abs(loads.nodal[:, :3]).sum() + np.abs(line).sum()) or 1.0,
    )


def _normal(case: CaseResult) -> F8 | None:
    return None if case.state is None else case.state.normal


def starts(known: Known, *, displaced: bool) -> Iterator[tuple[str, Start]]:
    """Named starts without end: the extremes, then random ones of three kinds in turn.

    `displaced` tells whether first displacements may differ: events are found from them.
    """
    rng = np.random.default_rng(SEED)
    yield from _extremes(known, displaced)
    number = 0
    while True:
        number += 1
        yield f"random capacities {number}", Start(_capacities(known, rng))
        yield f"random states {number}", Start(_states(known, rng))
        if displaced:
            yield f"random displacements {number}", _displacements(known, rng)


def _extremes(known: Known, displaced: bool) -> Iterator[tuple[str, Start]]:
    lifted = np.zeros(known.shape)
    lifted[:, :3] = LIFT * known.up
    yield "all open", Start(np.zeros_like(known.mu), lifted if displaced else None)
    if known.stuck is not None:
        yield "all stuck", Start(known.mu * known.stuck)
    normal = known.largest if known.free is None else known.free
    yield "all sliding", Start(known.mu * normal, known.u_free if displaced else None)


def _capacities(known: Known, rng: np.random.Generator) -> F8:
    """Independent capacities, evenly over all orders of two decades."""
    part: F8 = WIDE * 10.0 ** rng.uniform(-2.0, 0.0, len(known.mu))
    return known.mu * known.largest * part


def _states(known: Known, rng: np.random.Generator) -> F8:
    """Every slider open, sliding or stuck by chance."""
    n = len(known.mu)
    state = rng.integers(0, 3, n)
    free = np.zeros(n) if known.free is None else known.free
    stuck = known.largest if known.stuck is None else known.stuck
    return known.mu * np.choose(state, (np.zeros(n), free, stuck))


def _displacements(known: Known, rng: np.random.Generator) -> Start:
    """Displacements up to three times the case's own, with its capacities."""
    size = 0.01 if known.u_own is None else max(float(np.abs(known.u_own).max()), 1e-6)
    capacity = None if known.own is None else known.mu * known.own
    return Start(capacity, rng.uniform(-3.0 * size, 3.0 * size, known.shape))


def between(first: F8, second: F8, part: float) -> Start:
    """Capacities between those of two answers: what divides them is often a third one."""
    return Start(first + part * (second - first))
