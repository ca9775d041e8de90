"""How far the answers of a case lie apart: `trunnion.solve(model, spread=20)`.

With friction a case need not have one answer.  Each is solved again from other starts; every
certified end counts.  Other load orders are another question, because friction remembers the path:
they are followed apart.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import permutations

import numpy as np

from trunnion.arrays import F8, CaseResult, Spread, Spreading, Tried
from trunnion.cases.analysis import Run, Start
from trunnion.cases.casetext import needed
from trunnion.cases.default_cases import with_cases
from trunnion.cases.starts import between, known_forces, starts
from trunnion.deck.values import nearest
from trunnion.errors import ModelError, Problem
from trunnion.model import Case, Model, Term
from trunnion.results.supports import card_forces, cause_of, is_good
from trunnion.solver.answer import Question

SAME = 1e-6  # loads that differ by less, of the largest, belong to one answer
STEPS = (2, 4, 8)  # load steps that are tried beside the case's own
PARTS = (0.5, 0.25, 0.75, 0.125, 0.375)  # of the way between two answers

CONVEX = (
    "the answer is unique: no support of this case rubs, so pipe and contacts have one convex "
    "energy, whose gradient is zero for one set of loads only"
)
LINEAR = "the answer is unique: no support of this case can change its state, the case is linear"
NONLINEAR = "the case is the difference of two others (NONLINEAR)"
ABOUT = "the answer is unique: the contacts are frozen, the case is linear"


def spread(model: Model, case: str, n: int = 20) -> Spread:
    """Look for further answers of one case of a model from n other starts.

    Raises
    ------
    ModelError
        There is no such case, or it is a combination, whose answer follows from its parents'.
    DeckError, ModelError
        As `trunnion.solve`.
    """
    model.check()
    whole = with_cases(model)
    names = [c.name for c in whole.cases if isinstance(c, Case)]
    if case not in names:
        text = f"CASE {case} is not defined{nearest(case, names)}"
        raise ModelError([Problem("cases", text)])
    run = Run(replace(whole, cases=needed(whole, [case]), cycles=[]), {})
    run.results()
    own = next(c for c in run.model.cases if isinstance(c, Case) and c.name == case)
    return spread_of(run, own, n)


def spreads(run: Run, n: int) -> dict[str, Spread]:
    """Look for further answers of every case of a run from n starts each."""
    cases = [case for case in run.model.cases if isinstance(case, Case)]
    return {case.name: spread_of(run, case, n) for case in cases}


def spread_of(run: Run, case: Case, n: int) -> Spread:
    """Look for further answers of one case, which the run has tried already."""
    own = run.found[case.name]
    certain = _certain(run, case)
    if certain:
        return Spread(case.name, certain, _Answers(own).spreading(), None)
    cause = NONLINEAR if case.nonlinear else None
    if case.start and case.start not in run.ended:
        cause = cause_of(own)
    if cause:
        return Spread(case.name, None, _Answers(own).spreading(), None, cause)
    restarts = _restart(run, case, own, n)
    return Spread(case.name, None, restarts, _follow(run, case, own, n))


def _certain(run: Run, case: Case) -> str | None:
    """Why a case cannot have a second answer; None where it may."""
    if case.spectrum or ((case.about or case.on) and not case.nonlinear):
        return ABOUT
    structure = run.structure(case)
    if case.nonlinear or (structure.system.sliders.mu * case.mux > 0.0).any():
        return None
    return CONVEX if structure.changes else LINEAR


# ------------------------------------------------------------------ what was found
@dataclass(slots=True)
class _Answers:
    """Certified answers so far; the first is the case's own where it has one."""

    own: CaseResult
    found: list[CaseResult] = field(default_factory=list)
    tried: list[Tried] = field(default_factory=list)
    low: list[F8] = field(default_factory=list)
    high: list[F8] = field(default_factory=list)

    def __post_init__(self) -> None:
        if is_good(self.own):
            self._widen(self.own)
            self.found.append(self.own)

    def add(self, what: str, result: CaseResult) -> None:
        """Count one try."""
        if not is_good(result):
            self.tried.append(Tried(what, None, cause_of(result)))
            return
        self._widen(result)
        for i, known in enumerate(self.found):
            if _alike(known, result):
                self.tried.append(Tried(what, i, None))
                return
        self.found.append(result)
        self.tried.append(Tried(what, len(self.found) - 1, None))

    def _widen(self, result: CaseResult) -> None:
        assert result.state is not None
        values = [card_forces(result), result.state.end_force, result.state.u]
        if not self.low:
            self.low, self.high = list(values), list(values)
            return
        self.low = [np.minimum(a, b) for a, b in zip(self.low, values, strict=True)]
        self.high = [np.maximum(a, b) for a, b in zip(self.high, values, strict=True)]

    def spreading(self) -> Spreading:
        """Largest less smallest of everything."""
        apart = [high - low for high, low in zip(self.high, self.low, strict=True)]
        supports, elements, moves = apart or (None, None, None)
        return Spreading(tuple(self.tried), tuple(self.found), supports, elements, moves)


def _alike(a: CaseResult, b: CaseResult) -> bool:
    """Tell whether two answers carry the same loads."""
    assert a.state is not None
    assert b.state is not None
    pairs = ((card_forces(a), card_forces(b)), (a.state.end_force, b.state.end_force))
    for x, y in pairs:
        for half in (slice(0, 3), slice(3, 6)):
            size = max(1.0, float(np.abs(x[..., half]).max(initial=0.0)))
            if np.abs(x[..., half] - y[..., half]).max(initial=0.0) > SAME * size:
                return False
    return True


# ------------------------------------------------------------------ restarts
def _restart(run: Run, case: Case, own: CaseResult, n: int) -> Spreading:
    question = run.question(case)
    origin = run.ended[case.start] if case.start else None
    sliders = run.structure(case).system.sliders
    mux = question.loads.mux

    def ask(factor: float, capacity: F8 | None) -> CaseResult:
        loads = replace(question.loads, mux=factor * mux)
        return run.ask(case, _from(replace(question, loads=loads), Start(capacity)), origin)[0]

    known = known_forces(own, sliders.mu * mux, question.loads, ask)
    supply = starts(known, displaced=not question.plan.events)
    answers = _Answers(own)
    gaps = _between(answers, sliders.mu * mux)
    for i in range(n):
        middle = next(gaps, None) if i % 3 == 2 else None
        what, start = middle or next(supply)
        answers.add(what, run.ask(case, _from(question, start), origin)[0])
    return answers.spreading()


def _from(question: Question, start: Start) -> Question:
    """The question with another start of its iterations, and no other way out."""
    plan = replace(
        question.plan, capacity=start.capacity, u=start.u, ramp=False, iteration="NEWTON"
    )
    return replace(question, plan=plan)


def _between(answers: _Answers, mu: F8) -> Iterator[tuple[str, Start] | None]:
    """Starts between any two answers, as they become known; None while there is no pair."""
    done: set[tuple[int, int, float]] = set()
    while True:
        new = None
        for part in PARTS:
            for j in range(len(answers.found)):
                for i in range(j):
                    if new is None and (i, j, part) not in done:
                        new = i, j, part
        if new is None:
            yield None
            continue
        done.add(new)
        i, j, part = new
        first, second = (answers.found[k].state for k in (i, j))
        assert first is not None
        assert second is not None
        what = f"{100 * part:g} % between answers {i + 1} and {j + 1}"
        yield what, between(mu * first.normal, mu * second.normal, part)


# ------------------------------------------------------------------ load orders
def _follow(run: Run, case: Case, own: CaseResult, n: int) -> Spreading:
    """Ends of the case on other paths: more load steps, its load sets one after another."""
    answers = _Answers(own)
    for what, result in _paths(run, case, n):
        answers.add(what, result)
    return answers.spreading()


def _paths(run: Run, case: Case, n: int) -> Iterator[tuple[str, CaseResult]]:
    question = run.question(case)
    origin = run.ended[case.start] if case.start else None
    counts = [1, *STEPS] if case.steps != 1 else list(STEPS)
    for steps in [s for s in counts if s != case.steps][:n]:
        asked = replace(question, plan=replace(question.plan, steps=steps))
        what = "one step" if steps == 1 else f"{steps} steps"
        yield what, run.ask(case, asked, origin)[0]
    if case.start or len(case.terms) < 2:
        return
    for i, order in enumerate(permutations(case.terms)):
        if i >= n:
            return
        yield f"{', '.join(_word(term) for term in order)}", _one_by_one(run, case, order)


def _word(term: Term) -> str:
    size = "" if term.factor == 1.0 else f"{term.factor:g}*"
    return f"{size}{term.name}"


def _one_by_one(run: Run, case: Case, order: tuple[Term, ...]) -> CaseResult:
    """Put load sets on one after another, datums committed after each."""
    origin, structure = None, run.structure(case)
    for i in range(1, len(order) + 1):
        part = replace(case, terms=order[:i], steps=1)
        question = replace(run.question_on(part, structure.system), name=case.name)
        result, origin = run.ask(case, question, origin)
        if origin is None:
            words = " + ".join(_word(term) for term in order[:i])
            result.cause = f"under {words}: {cause_of(result)}"
            return result
    return result
