"""Variants of one deck: `trunnion.study(model, ["MU=0.1:0.5:9", "GAP@60=0,3mm"])`."""

import os
import traceback
from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import B1, F8, I4, System
from trunnion.cases.default_cases import with_cases
from trunnion.cases.hangers import designed
from trunnion.errors import ModelError, Problem
from trunnion.many.axes import Axis, combinations, read_axes
from trunnion.many.forked import run_forked
from trunnion.many.variants import Answers, Combination, Prepared, prepare, solve_block
from trunnion.model import Model
from trunnion.results.supports import STATES, Envelope, extremes

BLOCK = 25  # variants at a time; never a matter of the number of processes


@dataclass(slots=True, eq=False, repr=False)
class Study:
    """All variants of a study in the order of the axes, the last one fastest.

    names : of the variants, "MU=0.3 GAP@60=3mm".
    values : (n_variant, n_axis) in SI.
    cases : names.
    answers : loads, movements, states and certificates; see `Answers`.
    system : of the deck as it is.
    """

    title: str
    axes: tuple[Axis, ...]
    names: tuple[str, ...]
    values: F8
    cases: tuple[str, ...]
    answers: Answers
    system: System
    work: dict[str, int]

    @property
    def good(self) -> B1:
        """(n_variant, n_case) certified."""
        found: B1 = np.isfinite(self.answers.worst)
        return found

    @property
    def failures(self) -> list[tuple[int, int, str]]:
        """Variant, case and cause of all that failed."""
        return [
            (i, j, cause)
            for i, row in enumerate(self.answers.cause)
            for j, cause in enumerate(row)
            if cause is not None
        ]

    def forces(self, case: str) -> F8:
        """(n_variant, n_card, 6) loads of the supports on the pipe [N, N m]; NaN: no answer."""
        found: F8 = self.answers.force[:, self.cases.index(case)]
        return found

    def states(self, case: str) -> NDArray[np.int64]:
        """(n_card, n_state) number of good variants in which a support is in each of STATES."""
        level = self.answers.level[:, self.cases.index(case)]
        return np.stack([(level == k).sum(axis=0) for k in range(len(STATES))], axis=1)

    def envelope(self, case: str) -> tuple[Envelope, I4] | None:
        """Extremes of every support's load over the good variants, and these variants' numbers.

        The numbers in `Envelope` count among the good variants; None where there is none.
        """
        j = self.cases.index(case)
        good = np.flatnonzero(self.good[:, j]).astype(np.int32)
        if not len(good):
            return None
        force = self.answers.force[good, j]
        both = np.broadcast_to(self.answers.both[j] > 0.0, force.shape)
        return extremes(force, both), good


def study(
    model: Model,
    vary: Sequence[str],
    *,
    cases: Sequence[str] = (),
    jobs: int | None = None,
    warm: bool = False,
    told: Callable[[int], None] | None = None,
    tick: Callable[[], None] | None = None,
) -> Study:
    """Solve all combinations of varied quantities on one symbolic analysis.

    Parameters
    ----------
    vary : texts `KEY[@label[,part]]=list` or `=lo:hi:n`, in the units of the deck.
    cases : names of the cases to report; none are all of them.
    jobs : processes at a time; None is one a core.
    warm : start from the answer of the deck as it is, which is faster; with friction, whose
        answer need not be unique, a variant may then find another certified one than from rest.
    told : called with the number of variants just done; tick : called now and then.

    Raises
    ------
    BatchError
        What is asked for cannot be varied, or a case is not there.
    DeckError, ModelError
        The deck itself is wrong, or no variant of it can be built.
    """
    model = designed(with_cases(model))[0]
    axes = read_axes(model, vary)
    base = prepare(model, axes, [name.upper() for name in cases], warm=warm)
    every = combinations(axes)
    blocks = [every[i : i + BLOCK] for i in range(0, len(every), BLOCK)]
    began = base.run.ledger.snapshot()
    parts = _solve_all(base, blocks, jobs, told, tick)
    work = {
        name: began.get(name, 0) + sum(part.work.get(name, 0) for part in parts)
        for name in dict.fromkeys([*began, *(name for part in parts for name in part.work)])
    }
    answers = _joined(parts, work)
    if answers.refused == len(every):
        raise ModelError([Problem("every variant", answers.cause[0][0] or "")])
    return Study(
        title=model.title,
        axes=axes,
        names=tuple(_name(axes, combination) for combination in every),
        values=np.array([[a.values[i] for a, i in zip(axes, c, strict=True)] for c in every]),
        cases=base.cases,
        answers=answers,
        system=base.run.system,
        work=work,
    )


def _solve_all(
    base: Prepared,
    blocks: list[list[Combination]],
    jobs: int | None,
    told: Callable[[int], None] | None,
    tick: Callable[[], None] | None,
) -> list[Answers]:
    """Solve the blocks here or in forked processes, which inherit the analysed factor."""
    jobs = min(jobs or len(os.sched_getaffinity(0)), len(blocks))
    found: dict[int, Answers] = {}
    if jobs == 1:
        for i, block in enumerate(blocks):
            found[i] = solve_block(base, block)
            if told is not None:
                told(len(block))
        return list(found.values())

    def work(block: list[Combination]) -> Answers | str:
        try:
            return solve_block(base, block)
        except Exception as error:
            return "".join(traceback.format_exception(error))

    with closing(run_forked(blocks, work, jobs, tick=tick)) as ends:
        for end in ends:
            if end.result is None:
                raise RuntimeError("; ".join(end.deaths))
            if isinstance(end.result, str):
                raise RuntimeError(end.result)
            found[end.index] = end.result
            if told is not None:
                told(len(blocks[end.index]))
    return [found[i] for i in range(len(blocks))]


def _name(axes: tuple[Axis, ...], combination: Combination) -> str:
    words = (f"{a.name}={a.texts[i]}" for a, i in zip(axes, combination, strict=True))
    return " ".join(words)


def _joined(parts: list[Answers], work: dict[str, int]) -> Answers:
    return Answers(
        force=np.concatenate([part.force for part in parts]),
        both=np.max([part.both for part in parts], axis=0),
        move=np.concatenate([part.move for part in parts]),
        level=np.concatenate([part.level for part in parts]),
        worst=np.concatenate([part.worst for part in parts]),
        where=[row for part in parts for row in part.where],
        cause=[row for part in parts for row in part.cause],
        work=work,
        refused=sum(part.refused for part in parts),
    )
