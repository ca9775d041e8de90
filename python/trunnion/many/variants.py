"""One variant of a study: the model with other numbers, solved on the analysis of the first.

Made anew is only what the varied quantities change: supports from their cards, load sets, and
elements with their stiffness.  Every variant starts from rest, as `trunnion run` does, or (warm)
from the answer of the deck as it is; never from another variant, so its numbers depend on nothing
but itself.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import F8, CaseResult, System
from trunnion.cases.analysis import Run, Start
from trunnion.cases.casetext import needed
from trunnion.collector import paused
from trunnion.deck.values import nearest
from trunnion.errors import BatchError, DeckError, ModelError, Problem
from trunnion.loads import LoadSets, load_sets
from trunnion.many.axes import Axis
from trunnion.model import Case, Model
from trunnion.results.supports import (
    STATES,
    card_forces,
    card_levels,
    card_nodes,
    cause_of,
    is_good,
    without_sign,
)
from trunnion.system import with_supports

I1 = NDArray[np.int8]
Combination = tuple[int, ...]  # number of the value on each axis


@dataclass(slots=True, eq=False, repr=False)
class Prepared:
    """What all variants share: the model, its axes, a run with its symbolic analysis.

    cases : names of those reported.
    warm : starts from the deck's own answer by case, as normal forces and displacements.
    """

    model: Model
    axes: tuple[Axis, ...]
    run: Run
    cases: tuple[str, ...]
    node: list[int]  # of each card
    warm: dict[str, tuple[F8, F8]] = field(default_factory=dict)


@dataclass(slots=True, eq=False, repr=False)
class Answers:
    """Numbers of n variants; NaN where there is no certified answer.

    force : (n, n_case, n_card, 6) on the pipe [N, N m].
    both : (n_case, n_card, 6) above zero where that is a size, which acts both ways.
    move : (n, n_case, n_card, 3) of the pipe at the support [m].
    level : (n, n_case, n_card) index into STATES, -1 where there is no state.
    worst : (n, n_case) certificate.
    where, cause : by variant and case.
    work : of all of them.
    refused : variants that cannot be built, or move freely with every contact closed.
    """

    force: F8
    both: F8
    move: F8
    level: I1
    worst: F8
    where: list[list[str]]
    cause: list[list[str | None]]
    work: dict[str, int]
    refused: int = 0

    @property
    def count(self) -> NDArray[np.int64]:
        """(n, n_case, n_state) supports in each of STATES."""
        return np.stack([(self.level == k).sum(axis=2) for k in range(len(STATES))], axis=2)


def prepare(model: Model, axes: tuple[Axis, ...], names: Sequence[str], *, warm: bool) -> Prepared:
    """Number and analyse the deck as it is; with `warm` solve it, too.

    Raises
    ------
    BatchError
        A case that is not there.
    DeckError, ModelError
        The deck itself is wrong.
    """
    model.check()
    known = [case.name for case in model.cases]
    missing = [
        f"--case {n}: there is no such case{nearest(n, known)}" for n in names if n not in known
    ]
    if missing:
        raise BatchError("\n".join([*missing, "nothing was solved"]))
    wanted = tuple(n for n in known if n in names or not names)
    chosen = replace(model, cases=needed(model, wanted), cycles=[])
    if not any(isinstance(case, Case) and case.spectrum for case in chosen.cases):
        chosen = replace(chosen, modal=None)
    run = Run(chosen, {})
    for case in chosen.cases:
        if isinstance(case, Case) and not case.spectrum:
            run.structure(case).analyse()
    prepared = Prepared(chosen, axes, run, wanted, card_nodes(run.system))
    if warm:
        prepared.warm = _starts(run)
    return prepared


def _starts(run: Run) -> dict[str, tuple[F8, F8]]:
    results = run.results()
    kinds = {c.name for c in run.model.cases if isinstance(c, Case) and not (c.about or c.on)}
    return {
        name: (case.state.normal, case.state.u)
        for name, case in results.cases.items()
        if name in kinds and case.state is not None and case.gathered is None
    }


# ------------------------------------------------------------------ one block
def solve_block(base: Prepared, block: Sequence[Combination]) -> Answers:
    """Solve some variants."""
    n, n_case, n_card = len(block), len(base.cases), len(base.run.system.cards)
    out = Answers(
        force=np.full((n, n_case, n_card, 6), np.nan),
        both=np.zeros((n_case, n_card, 6)),
        move=np.full((n, n_case, n_card, 3), np.nan),
        level=np.full((n, n_case, n_card), -1, np.int8),
        worst=np.full((n, n_case), np.nan),
        where=[[""] * n_case for _ in block],
        cause=[[None] * n_case for _ in block],
        work={},
    )
    before, cache = base.run.ledger.snapshot(), _Cache()
    with paused():
        for i, combination in enumerate(block):
            _fill(base, combination, cache, out, i)
    out.work = base.run.ledger.since(before)
    return out


def _fill(base: Prepared, combination: Combination, cache: "_Cache", out: Answers, i: int) -> None:
    """Solve one variant into row i."""
    try:
        found = _solve(base, combination, cache)
    except (DeckError, ModelError) as error:
        text = "; ".join(problem.text for problem in error.problems)
        out.cause[i] = [text] * len(base.cases)
        out.refused += 1
        return
    for j, name in enumerate(base.cases):
        _read_out(base, found[name], out, i, j)


@dataclass(slots=True, eq=False, repr=False)
class _Cache:
    """What the variants of a block share, by the values that it depends on."""

    runs: dict[Combination, Run] = field(default_factory=dict)
    systems: dict[tuple[Combination, Combination], System] = field(default_factory=dict)
    sets: dict[tuple[Combination, Combination], LoadSets] = field(default_factory=dict)


def _solve(base: Prepared, combination: Combination, cache: _Cache) -> dict[str, CaseResult]:
    model = base.model
    for axis, i in zip(base.axes, combination, strict=True):
        model = axis.edit(model, axis.values[i])
    like, system, sets = _made_anew(base, model, combination, cache)
    run = Run(model, _warm(base, model, system), like=like, prepared=(system, sets))
    return run.results().cases


def _made_anew(
    base: Prepared, model: Model, combination: Combination, cache: _Cache
) -> tuple[Run, System, LoadSets]:
    """System and load sets of a variant, and the run that has its elements; each made once."""
    members, supports, loads = (
        tuple(i for axis, i in zip(base.axes, combination, strict=True) if axis.level == level)
        for level in ("members", "supports", "loads")
    )
    home = base.run
    if members:
        if members not in cache.runs:
            _check(model)
            cache.runs[members] = Run(model, {}, like=base.run)
        home = cache.runs[members]
    system, sets = home.system, home.sets
    if supports:
        if (members, supports) not in cache.systems:
            cache.systems[members, supports] = with_supports(model, home.system)
        system = cache.systems[members, supports]
    if loads:
        if (members, loads) not in cache.sets:
            _check(model)
            cache.sets[members, loads] = load_sets(model, system)
        sets = cache.sets[members, loads]
    return home, system, sets


def _check(model: Model) -> None:
    """Check what a card checks of the values that it gives together, and the whole model."""
    model.check()
    problems = []
    for s in model.sections.values():
        if s.wall > 0.5 * s.od * (1.0 + 1e-5):  # as on the card
            problems.append(Problem(s.place, f"SECTION {s.name}: WALL is more than half of OD"))
        elif s.lining > 0.5 * s.od - s.wall:
            problems.append(
                Problem(s.place, f"SECTION {s.name}: LINING is more than half the bore")
            )
    if problems:
        raise ModelError(problems)


def _warm(base: Prepared, model: Model, system: System) -> dict[str, Start]:
    """Starts from the deck's own answer, with the variant's coefficients of friction."""
    starts = {}
    for case in model.cases:
        if case.name in base.warm and isinstance(case, Case):
            normal, u = base.warm[case.name]
            fits = len(normal) == len(system.sliders.mu)
            capacity = system.sliders.mu * case.mux * normal if fits else None
            starts[case.name] = Start(capacity, u)
    return starts


def _read_out(base: Prepared, case: CaseResult, out: Answers, i: int, j: int) -> None:
    if case.certificate is not None:
        out.where[i][j] = case.certificate.where
    if not is_good(case):
        out.cause[i][j] = cause_of(case)
        return
    assert case.certificate is not None
    assert case.state is not None
    out.worst[i, j] = case.certificate.worst
    out.force[i, j] = card_forces(case)
    out.move[i, j] = case.state.u[base.node, :3]
    out.both[j] = without_sign(case)
    if case.gathered is None:
        out.level[i, j] = card_levels(case)
