"""What one solve leaves for the next: assembled structures with their factors, and answers.

Nothing is kept behind the user's back: who wants it holds a `Session`.  Arrays are compared, not
models, so a model that was changed, or read again, is found out.
"""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from trunnion.arrays import CaseResult, Results, System
from trunnion.solver.answer import Question
from trunnion.solver.ledger import Ledger
from trunnion.solver.steps import Origin
from trunnion.solver.structure import Structure

if TYPE_CHECKING:
    from trunnion.cases.analysis import Start
    from trunnion.model import Model

PIPE = ("ends", "kind", "axes", "length", "radius", "angle", "rigidity", "flex", "spring", "xyz",
        "taper", "up")  # fmt: skip
PLACES = ("node", "cnode")  # of supports: what the pattern of the stiffness stands on
SUPPORTS = ("contacts", "sliders", "snubbers")


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Kept:
    """One answered case: what was asked on which structure, and what came out."""

    structure: Structure
    question: Question
    origin: Origin | None
    result: CaseResult
    end: Origin | None


class Session:
    """Solves models one after another and does not repeat what has not changed.

    - The same pipe with supports at the same places keeps the assembled stiffness and its
      analysis, whatever gaps, friction or stiffnesses the supports have now.
    - The same structure keeps its factor: a new load takes solves, no factorisation, where
      no contact can change.
    - The same case on the same structure keeps its answer; a model that says the same in
      every word (as its deck shows) keeps all of them, modes and spectra included.

    >>> session = trunnion.Session()
    >>> first = session.solve(model)
    >>> again = session.solve(model)  # no factorisation
    """

    def __init__(self) -> None:
        self.structures: dict[tuple[str, bool], Structure] = {}
        self.answers: dict[str, Kept] = {}
        self.last: tuple[str, Results] | None = None  # deck and answers of the last model

    def solve(self, model: "Model", *, starts: "Mapping[str, Start] | None" = None) -> Results:
        """Solve every case and combination of a model; like `trunnion.solve`."""
        from trunnion.cases.analysis import solve

        deck = model.deck()
        if starts is None and self.last is not None and self.last[0] == deck:
            return _no_work(self.last[1])
        self.last = None
        results = solve(model, starts=starts, session=self)
        if starts is None:
            self.last = deck, results
        return results

    def structure(self, key: tuple[str, bool], system: System, ledger: Ledger) -> Structure:
        """The structure of a system, on what is left of the last one of this kind."""
        last = self.structures.get(key)
        if last is not None and same_pipe(last.system, system):
            if same_supports(last.system, system):
                last.turn_to(system, ledger)
                return last
            if same_places(last.system, system):
                first = last.parent or last  # not a line of parents that grows with every solve
                first.turn_to(first.system, ledger)
                last = self.structures[key] = Structure(system, ledger, parent=first)
                return last
        self.structures[key] = Structure(system, ledger)
        return self.structures[key]

    def knows(self, name: str) -> bool:
        """Tell whether a case of this name was answered before."""
        return name in self.answers

    def recall(
        self, structure: Structure, question: Question, origin: Origin | None
    ) -> tuple[CaseResult, Origin | None] | None:
        """The answer to a question that was asked before, with no work."""
        kept = self.answers.get(question.name)
        if kept is None or kept.structure is not structure or kept.origin is not origin:
            return None
        if not _same_question(kept.question, question):
            return None
        result = replace(
            kept.result,
            text=question.text,
            system=structure.system,
            loads=question.loads,
            work=dict.fromkeys(kept.result.work, 0),
        )
        return result, kept.end

    def keep(
        self,
        structure: Structure,
        question: Question,
        origin: Origin | None,
        answer: tuple[CaseResult, Origin | None],
    ) -> None:
        """Remember an answer."""
        self.answers[question.name] = Kept(structure, question, origin, *answer)


def _no_work(results: Results) -> Results:
    """The same answers, which took no work this time."""
    cases = {
        name: replace(case, work=dict.fromkeys(case.work, 0))
        for name, case in results.cases.items()
    }
    return replace(results, cases=cases, work=dict.fromkeys(results.work, 0))


def same_pipe(a: System, b: System) -> bool:
    """Elements with the same ends, shapes and stiffnesses."""
    return len(a.labels) == len(b.labels) and _same(a, b, PIPE)


def same_places(a: System, b: System) -> bool:
    """Supports between the same nodes."""
    return all(_same(getattr(a, s), getattr(b, s), PLACES) for s in SUPPORTS)


def same_supports(a: System, b: System) -> bool:
    """Supports, and nodes, that are the same in every number and word."""
    return (
        a.labels == b.labels
        and a.cards == b.cards
        and all(
            _same(x, y, tuple(field.name for field in fields(x)))
            for x, y in ((getattr(a, s), getattr(b, s)) for s in SUPPORTS)
        )
    )


def _same_question(a: Question, b: Question) -> bool:
    names = tuple(field.name for field in fields(a.loads))
    plans = ("steps", "events", "iteration", "capacity", "u", "ramp")
    same = _same(a.loads, b.loads, names) and _same(a.plan, b.plan, plans)
    return same and a.warnings == b.warnings


def _same(a: Any, b: Any, names: tuple[str, ...]) -> bool:
    """Equal fields; NaN, which no number of a model is, equals nothing."""
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for name in names)
