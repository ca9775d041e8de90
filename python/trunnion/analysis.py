"""All cases of a model, in order: `trunnion.solve(model)`."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from trunnion.arrays import F8, CaseResult, Certificate, Loads, Results, System
from trunnion.certificate import certify
from trunnion.combine import combine
from trunnion.errors import ModelError, Problem
from trunnion.loads import LoadSets, case_loads, case_warnings, load_sets
from trunnion.model import Case, Comb, Model, Term
from trunnion.solver.causes import explain
from trunnion.solver.friction import Solved
from trunnion.solver.history import History
from trunnion.solver.ledger import Ledger
from trunnion.solver.linear import solve_linear
from trunnion.solver.mechanism import null_motions, structural_motions
from trunnion.solver.newton import TINY_PIVOT
from trunnion.solver.status import release
from trunnion.solver.steps import Origin, Plan, solve_case
from trunnion.solver.structure import Forcing, Point, Sliding, Structure
from trunnion.solver.verdict import Reported, report_numbers
from trunnion.system import build_system, hot_system

PENALTY_WARNING = 1e-3


@dataclass(frozen=True, slots=True)
class Start:
    """A start of the iterations of one case, for the search of other answers.

    capacity : (n_slider,) first friction capacities mu N [N].
    """

    capacity: F8


def solve(model: Model, *, starts: Mapping[str, Start] | None = None) -> Results:
    """Solve every case and combination of a model.

    Parameters
    ----------
    starts : other starts of the iterations by case name; the law solved is the same.

    Raises
    ------
    ModelError
        The structure is impossible, or moves freely even with every contact closed.
    """
    return Run(model, starts or {}).results()


def solve_system(
    system: System, cases: Mapping[str, Loads], plans: Mapping[str, Plan] | None = None
) -> Results:
    """Solve loads on a system of arrays: the way in for programs that need no deck."""
    run = Run.of_system(system)
    found = {}
    for name, loads in cases.items():
        plan = (plans or {}).get(name, Plan())
        found[name] = run.solved(Job(Case(name, ()), name, loads, plan))
    return Results("", found, (), run.ledger.snapshot())


@dataclass(slots=True)
class Job:
    """One case made ready: its loads and the way it is solved."""

    case: Case
    text: str
    loads: Loads
    plan: Plan


@dataclass(slots=True)
class Ended:
    """What a later case may start from (FROM=)."""

    forcing: Forcing
    point: Point
    datum: F8


class Run:
    """One run over a model: structures by modulus set, answers by case."""

    def __init__(self, model: Model, starts: Mapping[str, Start]) -> None:
        self.model, self.starts = model, starts
        self.ledger = Ledger()
        self.system = build_system(model)
        self.sets: LoadSets = load_sets(model, self.system)
        self.structures: dict[str, Structure] = {}
        self.ended: dict[str, Ended] = {}
        self.answered: dict[str, tuple[Point, Solved]] = {}
        self.counted = self.ledger.snapshot()  # work that stands on a case already

    @classmethod
    def of_system(cls, system: System) -> "Run":
        """A run on a numbered system, without model."""
        run = cls.__new__(cls)
        run.model, run.starts, run.ledger, run.system = Model(), {}, Ledger(), system
        run.structures, run.ended, run.answered = {}, {}, {}
        run.counted = run.ledger.snapshot()
        return run

    def results(self) -> Results:
        """Solve all, in an order in which every case finds what it starts from."""
        found: dict[str, CaseResult] = {}
        jobs = {c.name: self._job(c) for c in self.model.cases if isinstance(c, Case)}
        self._solve_linear(jobs)
        for case in _ordered(self.model.cases):
            if isinstance(case, Comb):
                found[case.name] = combine(case, found)
            else:
                found[case.name] = self.solved(jobs[case.name])
        inorder = {case.name: found[case.name] for case in self.model.cases}
        return Results(self.model.title, inorder, (), self.ledger.snapshot())

    # ------------------------------------------------------------------ preparation
    def _job(self, case: Case) -> Job:
        system = self._structure(case).system
        settings = self.model.settings
        start = self.starts.get(case.name)
        plan = Plan(
            steps=case.steps,
            events=settings.events if case.events is None else case.events,
            iteration=case.iteration or settings.iteration,
            capacity=None if start is None else start.capacity,
        )
        return Job(case, case_text(case), case_loads(self.model, system, case, self.sets), plan)

    def _structure(self, case: Case) -> Structure:
        """Structure for the modulus of a case; E=HOT takes that of its temperature set."""
        which = next((t.name[1:] for t in case.terms if t.name[0] == "T"), "") if case.hot else ""
        if which not in self.structures:
            system = hot_system(self.model, self.system, which) if which else self.system
            self.structures[which] = Structure(system, self.ledger)
        return self.structures[which]

    def _solve_linear(self, jobs: Mapping[str, Job]) -> None:
        """Where nothing can change, all cases of one modulus take one solve."""
        groups: dict[int, list[Job]] = {}
        for job in jobs.values():
            structure = self._structure(job.case)
            if not structure.changes:
                groups.setdefault(id(structure), []).append(job)
        for group in groups.values():
            structure = self._structure(group[0].case)
            forcings = [self._forcing(structure, job) for job in group]
            answers = solve_linear(structure, forcings)
            self._refuse_mechanisms(structure)
            self.answered.update(
                (job.case.name, answer) for job, answer in zip(group, answers, strict=True)
            )

    def _forcing(self, structure: Structure, job: Job) -> Forcing:
        forcing = structure.forcing(job.loads)
        loose = structure.absent & (forcing.nodal != 0.0)
        if loose.any():
            problems = [
                Problem(
                    job.case.place,
                    f"CASE {job.case.name}: node {structure.system.labels[i]} is loaded in "
                    f"{('X', 'Y', 'Z', 'RX', 'RY', 'RZ')[j]}, where nothing resists",
                )
                for i, j in np.argwhere(loose)
            ]
            raise ModelError(problems)
        return forcing

    def _refuse_mechanisms(self, structure: Structure) -> None:
        """A structure that moves freely with every contact closed is an error of the input."""
        held = structure.held
        if held is None or (held[2] == 0.0 and structure.rcond > TINY_PIVOT):
            return
        motions = structural_motions(structure)
        if motions:
            raise ModelError([Problem("structure", motion.text) for motion in motions])

    # ------------------------------------------------------------------ one case
    def solved(self, job: Job) -> CaseResult:
        """Solve one case, judge it, and keep what later cases start from."""
        structure = self._structure(job.case)
        result = CaseResult(
            name=job.case.name,
            kind="case",
            text=job.text,
            system=structure.system,
            loads=job.loads,
            state=None,
            converged=False,
            warnings=case_warnings(self.sets, job.case) if self.model.cases else (),
        )
        if job.case.start and job.case.start not in self.ended:
            result.cause = f"it starts from {job.case.start}, which has no answer"
            return result
        history = History(structure.system, self.ledger)
        forcing = self._forcing(structure, job)
        try:
            self._answer(structure, job, forcing, history, result)
        finally:
            release(structure)
        result.history = history.records
        result.frozen = tuple(history.frozen)
        result.work = self._work() | {"aitken": history.jumps}
        return result

    def _work(self) -> dict[str, int]:
        """Counts since the last case; what cases share stands on the first of them."""
        work, self.counted = self.ledger.since(self.counted), self.ledger.snapshot()
        return work

    def _answer(
        self,
        structure: Structure,
        job: Job,
        forcing: Forcing,
        history: History,
        result: CaseResult,
    ) -> None:
        origin = self._origin(structure, job.case)
        if job.case.name in self.answered:
            point, solved = self.answered[job.case.name]
        else:
            point, solved = solve_case(structure, forcing, origin, job.plan, history)
            self._refuse_mechanisms_if_shifted(structure)
        if not solved.settled:
            law = Sliding(
                solved.sliding.capacity,
                structure.sliders.kf,
                structure.sliders.mu * forcing.mux,
                origin.datum,
            )
            result.cause = explain(structure, law, forcing, solved, history)
            return
        reported = report_numbers(structure, point, solved.sliding, forcing)
        certificate = certify(
            structure.system,
            job.loads,
            reported.state,
            correction_u=reported.correction_u,
            correction_r=reported.correction_r,
        )
        self._accept(structure, job, forcing, point, reported, certificate, history, result)

    def _accept(
        self,
        structure: Structure,
        job: Job,
        forcing: Forcing,
        point: Point,
        reported: Reported,
        certificate: Certificate,
        history: History,
        result: CaseResult,
    ) -> None:
        result.certificate = certificate
        if not certificate.passed:
            result.cause = (
                f"certificate: {certificate.where} is {certificate.worst:.3g}, above 1e-9"
            )
            return
        state = reported.state
        result.state, result.converged = state, True
        result.penalty_u, result.penalty_r = reported.penalty_u, reported.penalty_r
        result.penalty_effect = reported.penalty_effect
        result.warnings += tuple(history.notes) + self._remarks(structure, reported)
        datum = np.zeros((len(structure.sliders.mu), 3))
        datum[: len(state.datum_end)] = state.datum_end
        self.ended[job.case.name] = Ended(forcing, point, datum)

    def _origin(self, structure: Structure, case: Case) -> Origin:
        if case.start:
            end = self.ended[case.start]
            return Origin(end.forcing, end.point, end.datum)
        datum = np.zeros((len(structure.sliders.mu), 3))
        return Origin(structure.still, Point.zero(structure.n_node), datum)

    def _refuse_mechanisms_if_shifted(self, structure: Structure) -> None:
        if not structure.checked and structure.shifted:
            structure.checked = True
            motions = structural_motions(structure)
            if motions:
                raise ModelError([Problem("structure", m.text) for m in motions])

    def _remarks(self, structure: Structure, reported: Reported) -> tuple[str, ...]:
        remarks = []
        effect = max(reported.penalty_effect.values(), default=0.0)
        if effect > PENALTY_WARNING:
            remarks.append(
                f"rigid supports would change the answer by {100 * effect:.2g} % (penalty effect)"
            )
        if reported.singular:
            held = structure.held
            assert held is not None
            motions = null_motions(structure, held[0], held[1])
            remarks += [f"undetermined: {m.text.split(':')[0]}" for m in motions]
        return tuple(remarks) + hanger_remarks(structure.system, reported)


def hanger_remarks(system: System, reported: Reported) -> tuple[str, ...]:
    """Hangers that would have to push."""
    c = system.contacts
    return tuple(
        f"HANGER {card.name} pushes down: a hanger can only pull"
        for i, card in enumerate(system.cards)
        if card.kind == "hanger"
        and float((reported.state.reaction[c.card == i] @ system.up).sum()) < 0.0
    )


def case_text(case: Case) -> str:
    """The sum of a case as on its card: "W + P1 + 0.5*T1"."""
    text = ""
    for term in case.terms:
        sign = "-" if term.factor < 0 else "+"
        lead = f" {sign} " if text else ("-" if sign == "-" else "")
        text += lead + _term_text(term)
    return text


def _term_text(term: Term) -> str:
    size = abs(term.factor)
    name = term.name
    if term.vector is not None:
        name += "({:g},{:g},{:g})".format(*term.vector)
    return name if size == 1.0 else f"{size:g}*{name}"


def _ordered(cases: list[Case | Comb]) -> list[Case | Comb]:
    """Deck order, but every case after the one it starts from and a COMB after its parents."""
    from trunnion.combine import parents

    by_name = {case.name: case for case in cases}
    done: dict[str, Case | Comb] = {}

    def visit(name: str, path: tuple[str, ...]) -> None:
        if name in done:
            return
        case = by_name.get(name)
        if case is None or name in path:
            what = "is not defined" if case is None else "refers to itself"
            raise ModelError([Problem("cases", f"CASE {name} {what}")])
        needs = parents(case.expression) if isinstance(case, Comb) else [case.start or ""]
        for need in filter(None, needs):
            visit(need, (*path, name))
        done[name] = case

    for case in cases:
        visit(case.name, ())
    return list(done.values())
