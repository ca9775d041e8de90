"""The elastic status iteration of the trade: the documented reference, independent of `newton`.

Supports that press keep their stick spring in the matrix while they slide; a pass solves, returns
every slider to the cone mu N from the committed datum, and moves its trial datum so that the
spring carries just that.  The matrix changes only when a contact opens or closes.  One support
creeps with the ratio k_f / (K + k_f), 0.9996 and slower for a pipe; so when the whole system
creeps geometrically with a stable ratio, a synchronised Aitken jump moves all trial data by the
geometric sum that remains.  Its end is tested by the change extrapolated from the ratio
(Richardson), never by the change alone.
"""

from dataclasses import dataclass, replace

import numpy as np

from trunnion import kernels
from trunnion.arrays import F8, I4
from trunnion.solver.convergence import judge
from trunnion.solver.friction import STICKY, Solved
from trunnion.solver.history import History
from trunnion.solver.newton import RUNAWAY, tangent_factor
from trunnion.solver.quantities import Forcing, Point, Response, Sliding
from trunnion.solver.structure import Structure

PASSES = 10_000
TIGHT = 1e-13  # remaining change of displacements that ends the iteration, relative
REVERSALS = 5  # a contact that turns more often without a calm stretch is frozen engaged
CHATTER = 2  # turns of one contact after which passes are searched, not taken whole
CALM = 50  # passes without any turn that clear the counts
QUIET = 3  # passes without a change of state before a jump
ALIGNED = 1e-6  # how nearly parallel two creeping steps are: 1 - cosine
STEADY = 0.05  # how nearly equal two ratios are, of 1 - ratio


@dataclass(slots=True, eq=False, repr=False)
class Creep:
    """The last steps of the trial data, for the ratio of the geometric creep."""

    step: F8 | None = None
    ratio: float | None = None
    quiet: int = 0
    jumps: int = 0

    def reset(self) -> None:
        """Forget: a state has changed or a jump has been made."""
        self.step, self.ratio, self.quiet = None, None, 0

    def jump(self, step: F8) -> F8 | None:
        """Geometric sum that remains after `step`, once the creep is stable."""
        last, self.step = self.step, step.copy()
        self.quiet += 1
        if last is None:
            return None
        product, square = kernels.inner(step, last), kernels.inner(last, last)
        if square == 0.0 or product <= 0.0:
            self.ratio = None
            return None
        cosine = product / np.sqrt(square * kernels.inner(step, step))
        ratio, before = product / square, self.ratio
        self.ratio = ratio
        if before is None or not 0.0 < ratio < 1.0 or self.quiet < QUIET:
            return None
        if abs(ratio - before) > STEADY * (1.0 - ratio) or 1.0 - cosine > ALIGNED:
            return None
        self.reset()
        self.jumps += 1
        return step * (ratio / (1.0 - ratio))


def solve_status(
    structure: Structure,
    point: Point,
    sliding: Sliding,
    forcing: Forcing,
    history: History,
    *,
    freeze: bool = True,
    passes: int = PASSES,
) -> Solved:
    """Solve one load step by the status iteration; freezes what reverses too often."""
    trial = replace(sliding, datum=sliding.datum.copy(), coupled=False)
    free = replace(sliding, capacity=np.zeros_like(sliding.mu), coupled=False)
    law = replace(free, coupled=True, capacity=np.zeros_like(sliding.mu))
    scratch = np.zeros_like(point.u)
    true = structure.respond(point, law, forcing, scratch)
    turns = np.zeros(len(structure.at), np.int32)
    creep, earlier, calm = Creep(), None, 0
    for i in range(passes):
        p = _pass(structure, point, trial, forcing, true, careful=bool((turns >= CHATTER).any()))
        if not np.abs(p).max() < RUNAWAY * structure.size:
            return Solved(False, true, law, "the pipe moves away without bound", unbounded=True)
        before, true = true, structure.respond(point, law, forcing, scratch)
        history.add("status", float(np.abs(p).max()), 1.0, before, true)
        opened = (before.side == 0) != (true.side == 0)
        turns += opened
        calm = 0 if opened.any() else calm + 1
        if calm >= CALM:
            turns[:] = 0
        if opened.any():
            creep.reset()
            if freeze and (turns > REVERSALS).any():
                _freeze(structure, turns, before.side, true.side, history)
        moved = _target(sliding, true) - trial.datum
        verdict = judge(before, true, p, earlier, point.u)
        earlier = p
        left = _creep_left(moved, creep.ratio)
        size = max(float(np.abs(point.u).max()), 1e-300)
        if i > 1 and verdict.holds and max(left / size, verdict.remaining) <= TIGHT:
            history.jumps += creep.jumps
            return Solved(True, true, law)
        trial.datum += moved
        jump = None if opened.any() else creep.jump(moved)
        if jump is not None:
            trial.datum += jump
            turns[:] = 0  # a jump may turn contacts that a pass would not
            earlier = None
    history.jumps += creep.jumps
    return Solved(False, true, law, verdict.broken or "the status iteration still creeps")


def _pass(
    structure: Structure,
    point: Point,
    trial: Sliding,
    forcing: Forcing,
    true: Response,
    *,
    careful: bool,
) -> F8:
    """One linear solve with the stick springs of all supports that press; moves the point.

    A `careful` pass goes only as far as the energy of these springs falls.
    """
    trial.capacity = np.where((true.normal > 0.0) & (trial.mu > 0.0), STICKY, 0.0)
    r, _, response = structure.residual(point, trial, forcing)
    tangent_factor(structure, response)
    p = structure.solve(r)
    if careful:
        push = kernels.inner(r, p)
        p *= structure.search(point, trial, forcing, p, (push, push))
    point.move(p)
    return p


def _target(sliding: Sliding, true: Response) -> F8:
    """Trial data for which the springs carry the returned forces at the present position."""
    stiff = np.where(sliding.kf > 0.0, sliding.kf, 1.0)[:, None]
    out: F8 = sliding.datum + true.slide + true.friction / stiff
    return out


def _creep_left(moved: F8, ratio: float | None) -> float:
    last = float(np.abs(moved).max(initial=0.0))
    if ratio is None or not 0.0 < ratio < 1.0:
        return last
    return last * max(1.0, ratio / (1.0 - ratio))


def _freeze(structure: Structure, turns: I4, before: I4, after: I4, history: History) -> None:
    """Hold closed, from now on, the contacts that turned too often."""
    for i in np.flatnonzero((turns > REVERSALS) & (structure.at[:, 5] == 0)):
        side = before[i] or after[i]
        structure.at[i, 5] = 3 if side == -1 else 2
        history.freeze(int(structure.contacts.card[i]))


def release(structure: Structure) -> None:
    """Let frozen contacts open again."""
    free = structure.at[:, 5] > 1
    structure.at[free, 5] = 0
