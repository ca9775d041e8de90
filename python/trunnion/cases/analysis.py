"""All cases of a model, in order: `trunnion.solve(model)`."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property

import numpy as np

from trunnion.arrays import (
    F8,
    CaseResult,
    CycleResult,
    HangerChoice,
    Loads,
    ModeSet,
    Results,
    System,
)
from trunnion.cases.casetext import case_text, in_order
from trunnion.cases.default_cases import may_be_free, with_cases
from trunnion.cases.session import Session, same_pipe
from trunnion.cases.snubbed import go_on, locked_at_rest
from trunnion.errors import ModelError
from trunnion.frozen import frozen
from trunnion.loads import LoadSets, case_loads, case_warnings, load_sets
from trunnion.model import Case, Comb, Model
from trunnion.results.combine import combine
from trunnion.solver.answer import Question, answer, forcing_of, refuse_mechanisms
from trunnion.solver.ledger import Ledger
from trunnion.solver.linear import Prepared, solve_linear
from trunnion.solver.steps import Origin, Plan
from trunnion.solver.structure import Structure
from trunnion.system import build_system, hot_system, shares_pattern
from trunnion.watch import Watch


@frozen(eq=False)
class Start:
    """A start of the iterations of one case, for the search of other answers.

    capacity : (n_slider,) first friction capacities mu N [N]; None: the usual search for them.
    u : (n_node, 6) first displacements [m, rad]; None: those of the undeformed pipe.
    """

    capacity: F8 | None = None
    u: F8 | None = None


def solve(
    model: Model,
    *,
    starts: Mapping[str, Start] | None = None,
    session: Session | None = None,
    spread: int = 0,
    watch: Watch | None = None,
) -> Results:
    """Solve every case and combination of a model; one without cases takes default ones.

    Parameters
    ----------
    starts : other starts of the iterations by case name; the law solved is the same.
    session : what earlier solves left; see `Session`.
    spread : number of other starts of every case in a search for further answers; see `Spread`.
    watch : is told what is being done, for whoever wants to show it.

    Raises
    ------
    DeckError
        Words of the model that do not fit together.
    ModelError
        The structure is impossible, or moves freely even with every contact closed.
    """
    model.check()
    watch = watch or Watch()
    watch.turn("solving")
    choices: tuple[HangerChoice, ...] = ()
    if any(s.design is not None for s in model.supports):
        from trunnion.cases.hangers import designed

        model, choices = designed(model)
    try:
        run = Run(with_cases(model), starts or {}, session, watch=watch)
        results = run.results()
        results.hangers = choices
    except ModelError as error:
        free = _free_modes(model)
        if free is None:
            raise
        free.warnings += (f"no default cases: {error.problems[0].text}",)
        return free
    if spread:
        from trunnion.cases.spread import spreads

        watch.turn("looking for other answers:")
        results.spreads = spreads(run, spread)
        for name, found in results.spreads.items():
            if (n := len(found.starts.answers)) > 1:
                said = f"{n} certified answers were found from {spread} other starts"
                results.cases[name].warnings += (said,)
    return results


def _own(array: F8 | None) -> F8 | None:
    return None if array is None else np.array(array, np.float64)


def _free_modes(model: Model) -> Results | None:
    """Modes alone, where a deck that names no case asks for those of a structure that is free."""
    if not may_be_free(model):
        return None
    found = Run(model, {}).results()
    return found if found.modes is not None and found.modes.rigid else None


def solve_system(
    system: System, cases: Mapping[str, Loads], plans: Mapping[str, Plan] | None = None
) -> Results:
    """Solve loads on a system of arrays: the way in for programs that need no deck."""
    ledger = Ledger()
    structure = Structure(system, ledger)
    questions = [
        Question(name, name, loads, (plans or {}).get(name, Plan()))
        for name, loads in cases.items()
    ]
    prepared: dict[str, Prepared] = {}
    if not structure.changes:
        prepared = _prepare(structure, questions)
    found: dict[str, CaseResult] = {}
    for question in questions:
        before = ledger.snapshot() if found else dict.fromkeys(ledger.NAMES, 0)
        found[question.name], _ = answer(structure, question, None, prepared.get(question.name))
        found[question.name].work |= ledger.since(before)
    return Results("", found, (), ledger.snapshot())


def _prepare(structure: Structure, questions: list[Question]) -> dict[str, Prepared]:
    """Solve all cases of a structure on which nothing can change at once."""
    forcings = [forcing_of(structure, question) for question in questions]
    answers = solve_linear(structure, forcings)
    if answers:
        refuse_mechanisms(structure)
    return {question.name: own for question, own in zip(questions, answers, strict=True)}


class Run:
    """One run over a model: structures by modulus set, answers by case.

    A run that is `like` another has the same nodes, elements and supports with other numbers: it
    shares ledger and symbolic analysis, and the elements' stiffness where that is the same.
    """

    def __init__(
        self,
        model: Model,
        starts: Mapping[str, Start],
        session: Session | None = None,
        *,
        like: "Run | None" = None,
        prepared: tuple[System, LoadSets] | None = None,
        watch: Watch | None = None,
    ) -> None:
        self.model, self.starts, self.like = model, starts, like
        self.session = session or Session()
        self.ledger: Ledger = Ledger(watch) if like is None else like.ledger
        if prepared is None:
            self.system = build_system(model)
            self.sets = load_sets(model, self.system)
        else:
            self.system, self.sets = prepared
        self.structures: dict[tuple[str, bool], Structure] = {}
        self.questions: dict[str, Question] = {}
        self.found: dict[str, CaseResult] = {}
        self.ended: dict[str, Origin] = {}
        self.refused_modes: str | None = None
        self.counted = self.ledger.snapshot()  # work that stands on a case already

    def results(self) -> Results:
        """Solve all, in an order in which every case finds what it starts from."""
        cases = in_order(self.model.cases)
        plain = [c for c in cases if isinstance(c, Case) and not (c.about or c.on or c.spectrum)]
        self.ledger.watch.total = sum(isinstance(c, Case) for c in cases)
        prepared, sums = self._solve_linear(plain)
        for own in plain:
            ready = sums.get(own.name)
            self._keep(ready or self.solve_case(own, prepared.get(own.name)))
        locked = [c for c in cases if isinstance(c, Case) and (c.about or c.on)]
        if locked:
            from trunnion.cases.occasional import LockedPass

            for result in LockedPass(self).solve(locked):
                self._keep(result)
        modes = self._dynamics([c for c in cases if isinstance(c, Case) and c.spectrum])
        cycles = self._cycles()
        for case in cases:
            if isinstance(case, Comb):
                self.found[case.name] = combine(case, self.found)
        inorder = {case.name: self.found[case.name] for case in self.model.cases}
        work = self.ledger.snapshot()
        warnings = (self.refused_modes,) if self.refused_modes else ()
        return Results(
            self.model.title, inorder, warnings, work, cycles, modes=modes, base=self.system
        )

    def _dynamics(self, spectra: list[Case]) -> ModeSet | None:
        """Find the modes and solve the spectrum cases, where a deck asks for them."""
        if self.model.modal is None and not spectra:
            return None
        from trunnion.cases.dynamics import Dynamics

        self.ledger.watch.begin("natural modes")
        dynamics = Dynamics(self)
        self.refused_modes = dynamics.cause
        for result in dynamics.spectra(spectra):
            self._keep(result)
        return dynamics.modes

    def _cycles(self) -> dict[str, CycleResult]:
        """Follow the loops of cases, where there are any."""
        if not self.model.cycles:
            return {}
        from trunnion.cases.cycles import follow

        return {cycle.name: follow(self, cycle) for cycle in self.model.cycles}

    def _keep(self, result: CaseResult) -> None:
        """Store an answer with the work done since the last; shared work stands on the first."""
        result.work = self.ledger.since(self.counted) | result.work
        self.counted = self.ledger.snapshot()
        self.found[result.name] = result
        self.ledger.watch.done += 1

    # ------------------------------------------------------------------ preparation
    def question(self, case: Case) -> Question:
        """A case with its loads and its plan; made once."""
        if case.name not in self.questions:
            self.questions[case.name] = self.question_on(case, self.structure(case).system)
        return self.questions[case.name]

    def question_on(self, case: Case, system: System) -> Question:
        """A case with its loads on a given system, and its plan."""
        settings = self.model.settings
        start = self.starts.get(case.name)
        plan = Plan(
            steps=case.steps,
            events=settings.events if case.events is None else case.events,
            iteration=case.iteration or settings.iteration,
            capacity=None if start is None else _own(start.capacity),
            u=None if start is None else _own(start.u),
        )
        return Question(
            case.name,
            case_text(case),
            case_loads(self.model, system, case, self.sets),
            plan,
            case.place,
            case_warnings(self.sets, case),
        )

    @staticmethod
    def hot_set(case: Case) -> str:
        """Temperature set of a case, "" where it has none."""
        return next((t.name[1:] for t in case.terms if t.name[0] == "T"), "")

    def structure(self, case: Case) -> Structure:
        """Structure for a case: the modulus of its E=, snubbers engaged where it locks them."""
        which = self.hot_set(case) if case.hot else ""
        return self.structure_of(which, snubbed=case.snubbers == "LOCKED")

    def structure_of(self, which: str, *, snubbed: bool = False) -> Structure:
        """Structure of a modulus set ("" is cold), with or without engaged snubbers."""
        snubbed = snubbed and len(self.system.snubbers.k) > 0
        key = (which, snubbed)
        if key not in self.structures:
            if snubbed:
                from trunnion.solver.locked import snubbed_system

                parent = self.structure_of(which)
                system, keep = snubbed_system(parent.system)
                self.structures[key] = Structure(system, self.ledger, parent, keep)
            else:
                system = hot_system(self.model, self.system, which) if which else self.system
                self.structures[key] = self._structure(system, key)
        return self.structures[key]

    def _structure(self, system: System, key: tuple[str, bool]) -> Structure:
        if self.like is None:
            return self.session.structure(key, system, self.ledger)
        base = self.like.structure_of(key[0])
        if not shares_pattern(base.system, system):
            return Structure(system, self.ledger)
        if same_pipe(base.system, system):
            return Structure(system, self.ledger, base)
        return Structure(system, self.ledger, like=base)

    def _solve_linear(self, cases: list[Case]) -> tuple[dict[str, Prepared], dict[str, CaseResult]]:
        """Where nothing can change, all cases of one modulus take one solve, or are sums."""
        groups: dict[int, list[Case]] = {}
        for case in cases:
            structure = self.structure(case)
            if not structure.changes:
                groups.setdefault(id(structure), []).append(case)
        prepared: dict[str, Prepared] = {}
        sums: dict[str, CaseResult] = {}
        for asked in groups.values():
            structure = self.structure(asked[0])
            group = [c for c in asked if not self._is_answered(c)]
            sums |= self._superpose(structure, group)
            rest = [self.question(case) for case in group if case.name not in sums]
            prepared |= _prepare(structure, rest)
        return prepared, sums

    def _superpose(self, structure: Structure, group: list[Case]) -> dict[str, CaseResult]:
        """Answers to cases as sums of load sets, where there are many cases of few sets."""
        if len(group) < 2:
            return {}
        from trunnion.cases.superposed import as_sums

        sums = as_sums(self, structure, group)
        for case in group:
            if case.name in sums:
                question = self.question(case)
                self.session.keep(structure, question, None, (sums[case.name], None))
        return sums

    def _is_answered(self, case: Case) -> bool:
        """Tell whether an earlier solve has the answer from rest."""
        known = self.session.knows(case.name)
        return known and self._recalled(case, self.question(case), None) is not None

    def _recalled(
        self, case: Case, question: Question, origin: Origin | None
    ) -> tuple[CaseResult, Origin | None] | None:
        """The answer of an earlier solve, unless others go on from it and it cannot tell where."""
        found = self.session.recall(self.structure(case), question, origin)
        if found is not None and found[1] is None and case.name in self.leads:
            return None
        return found

    @cached_property
    def leads(self) -> frozenset[str]:
        """Names of the cases that others go on from."""
        plain = [case for case in self.model.cases if isinstance(case, Case)]
        loops = self.model.cycles
        names = [n for case in plain for n in (case.start, case.about, case.on)]
        names += [n for loop in loops for n in (loop.start, *loop.cases)]
        return frozenset(name for name in names if name)

    # ------------------------------------------------------------------ one case
    def solve_case(self, case: Case, prepared: Prepared | None = None) -> CaseResult:
        """Solve one case from rest or from the case that FROM names."""
        question = self.question(case)
        structure = self.structure(case)
        if case.start and case.start not in self.ended:
            return CaseResult(
                name=case.name,
                kind="case",
                text=question.text,
                system=structure.system,
                loads=question.loads,
                state=None,
                converged=False,
                cause=f"it starts from {case.start}, which has no answer",
            )
        origin = self.ended[case.start] if case.start else None
        result, end = self.go_on(case, question, origin, prepared)
        if end is not None:
            self.ended[case.name] = end
        return result

    def go_on(
        self,
        case: Case,
        question: Question,
        origin: Origin | None,
        prepared: Prepared | None = None,
    ) -> tuple[CaseResult, Origin | None]:
        """Solve one case from where another ended, or from rest."""
        structure = self.structure(case)
        found = self._recalled(case, question, origin)
        if found is not None:
            return found
        found = self.ask(case, question, origin, prepared)
        self.session.keep(structure, question, origin, found)
        return found

    def ask(
        self,
        case: Case,
        question: Question,
        origin: Origin | None,
        prepared: Prepared | None = None,
    ) -> tuple[CaseResult, Origin | None]:
        """Solve one case, whatever was answered before."""
        structure, locked = self.structure(case), case.snubbers == "LOCKED"
        if origin is not None:
            loads, origin = go_on(self.system, structure, origin, question.loads, locked=locked)
            if loads is not question.loads and prepared is not None:
                prepared = replace(prepared, forcing=structure.forcing(loads))
            question = replace(question, loads=loads)
        elif locked:
            origin = locked_at_rest(structure)
        return answer(structure, question, origin, prepared)
