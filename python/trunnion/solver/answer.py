"""One case on one structure: solved, reported, certified, and accepted or refused."""

from dataclasses import dataclass

import numpy as np

from trunnion.arrays import F8, CaseResult, Certificate, Loads
from trunnion.certificate import certify
from trunnion.errors import ModelError, Problem
from trunnion.solver.causes import explain
from trunnion.solver.digits import FREEDOMS, has_stiffness, is_lossy
from trunnion.solver.friction import Solved
from trunnion.solver.history import History
from trunnion.solver.linear import Prepared
from trunnion.solver.mechanism import null_motions, structural_motions
from trunnion.solver.newton import TINY_PIVOT
from trunnion.solver.quantities import Forcing, Point, Sliding
from trunnion.solver.status import release
from trunnion.solver.steps import Origin, Plan, solve_case
from trunnion.solver.structure import Structure
from trunnion.solver.verdict import Reported, report_numbers

PENALTY_WARNING = 1e-3
FEW_DIGITS = 6.0
LARGE_TURN = 0.1  # rad; beyond it small-rotation theory is off by about half a per cent


@dataclass(slots=True)
class Question:
    """A case made ready.  `place` is where its card stands, for errors."""

    name: str
    text: str
    loads: Loads
    plan: Plan
    place: object = "cases"
    warnings: tuple[str, ...] = ()


def answer(
    structure: Structure,
    question: Question,
    origin: Origin | None = None,
    prepared: Prepared | None = None,
) -> tuple[CaseResult, Origin | None]:
    """Solve a case and judge it; also give what later cases may start from.

    Parameters
    ----------
    origin : where the case starts; None is the undeformed, unloaded pipe.
    prepared : a linear case with the same loads that was solved together with others.

    Raises
    ------
    ModelError
        The structure moves freely with every contact closed, or a load acts where nothing
        resists.
    """
    structure.ledger.watch.begin(question.name)
    forcing = prepared.forcing if prepared else forcing_of(structure, question)
    history = History(structure.system, structure.ledger)
    result = unanswered(structure, question)
    result.history, result.passes = history.records, history.passes
    start = origin or at_rest(structure)
    try:
        end = _solve(structure, question, forcing, start, history, result, prepared)
    finally:
        release(structure)
    result.frozen = tuple(history.frozen)
    result.work = {"aitken": history.jumps}
    return result, end


def unanswered(structure: Structure, question: Question) -> CaseResult:
    """What is known of a case before it is solved."""
    return CaseResult(
        name=question.name,
        kind="case",
        text=question.text,
        system=structure.system,
        loads=question.loads,
        state=None,
        converged=False,
        warnings=question.warnings,
    )


def at_rest(structure: Structure) -> Origin:
    """The undeformed, unloaded start."""
    datum = np.zeros((len(structure.sliders.mu), 3))
    return Origin(structure.still, Point.zero(len(structure.system.labels)), datum)


def forcing_of(structure: Structure, question: Question) -> Forcing:
    """Kernel loads of a case; an error where a load acts on a freedom that does not exist."""
    forcing = structure.forcing(question.loads)
    labels = structure.system.labels
    loose = np.argwhere(structure.absent & (forcing.nodal != 0.0))
    if len(loose):
        raise ModelError(
            [
                Problem(
                    question.place,
                    f"CASE {question.name}: node {labels[structure.kept[i]]} is loaded in "
                    f"{FREEDOMS[j]}, where nothing resists",
                )
                for i, j in loose
            ]
        )
    return forcing


def refuse_mechanisms(structure: Structure) -> None:
    """Raise for a structure that moves freely even with every contact closed."""
    held = structure.held
    poor = held is not None and not (held[2] == 0.0 and structure.rcond > TINY_PIVOT)
    if structure.checked or not (structure.shifted or poor):
        return
    motions = structural_motions(structure)
    every = structure.closed_tangent, structure.stuck_tangent
    if motions and not has_stiffness(structure, *every):
        raise ModelError([Problem("structure", motion.text) for motion in motions])
    structure.checked = True  # a session may ask a refused structure again


def _solve(
    structure: Structure,
    question: Question,
    forcing: Forcing,
    start: Origin,
    history: History,
    result: CaseResult,
    prepared: Prepared | None,
) -> Origin | None:
    """Answer a case by the first attempt that is certified."""
    job = Job(structure, question, forcing, start, history, result)
    end = _attempt(job, prepared)
    if end is None and job.doubtful() and structure.extend(True):
        history.notes.append("solved in extended precision: the stiffness is too ill-conditioned")
        try:
            end = _attempt(job)
        finally:
            structure.extend(False)
    if end is None:
        result.cause = job.explain()
    return end


@dataclass(slots=True, eq=False, repr=False)
class Job:
    """One case on its way to an answer, and how its last attempt ended."""

    structure: Structure
    question: Question
    forcing: Forcing
    start: Origin
    history: History
    result: CaseResult
    solved: Solved | None = None
    blind: bool = False  # the last attempt could not see what was left to correct

    def doubtful(self) -> bool:
        """The factor may be to blame that there is no answer."""
        if self.solved is None:
            return False
        if self.blind:
            return True
        return is_lossy(self.structure, self.solved.response, self.forcing)

    def explain(self) -> str:
        """Why there is no answer."""
        solved, s = self.solved, self.structure.sliders
        assert solved is not None
        if solved.settled:
            return self.result.cause or ""
        mu = s.mu * self.forcing.mux
        law = Sliding(solved.sliding.capacity, s.kf, mu, self.start.datum)
        return explain(self.structure, law, self.forcing, solved, self.history)


def _attempt(job: Job, prepared: Prepared | None = None) -> Origin | None:
    """Solve, refine and judge; None, and a cause, where that gives no certified answer."""
    structure, forcing, result = job.structure, job.forcing, job.result
    if prepared is None:
        point, solved = solve_case(structure, forcing, job.start, job.question.plan, job.history)
        refuse_mechanisms(structure)
    else:
        point, solved = prepared.point, prepared.solved
    job.solved = solved
    if not solved.settled:
        return None
    structure.ledger.watch.part = "certificate"
    reported = report_numbers(structure, point, solved.sliding, forcing)
    result.certificate = certify(
        structure.system,
        job.question.loads,
        reported.state,
        correction_u=reported.correction_u,
        correction_r=reported.correction_r,
    )
    job.blind = reported.blind
    if reported.broken or not result.certificate.passed or reported.blind:
        result.cause = reported.broken or refusal(result.certificate, blind=reported.blind)
        return None
    result.warnings += tuple(job.history.notes)
    accept(structure, result, reported)
    datum = _all_sliders(structure, reported.state.datum_end)
    whole = Point(reported.state.u, reported.state.u_low)
    return Origin(forcing, whole, datum, job.question.loads, job.start.lock)


def accept(structure: Structure, result: CaseResult, reported: Reported) -> None:
    """Give a case its certified numbers and what is to be said of them."""
    result.cause = None
    result.state, result.converged = reported.state, True
    result.rigid, result.penalty_r = reported.rigid, reported.penalty_r
    result.penalty_effect = reported.penalty_effect
    result.digits = reported.digits
    result.warnings += _remarks(structure, reported)


def refusal(certificate: Certificate, *, blind: bool = False) -> str:
    """Why a certificate did not pass, or may not be believed."""
    if certificate.passed and blind:
        return "the stiffness is too ill-conditioned: no correction of the answer can be trusted"
    return f"certificate: {certificate.where} is {certificate.worst:.3g}, above 1e-9"


def _all_sliders(structure: Structure, datum: F8) -> F8:
    out = np.zeros((len(structure.sliders.mu), 3))
    out[: len(datum)] = datum
    return out


def _remarks(structure: Structure, reported: Reported) -> tuple[str, ...]:
    remarks = []
    effect = max(reported.penalty_effect.values(), default=0.0)
    if effect > PENALTY_WARNING:
        remarks.append(
            f"rigid supports would change the answer by {100 * effect:.2g} % (penalty effect)"
        )
    left, where = reported.digits
    if left < FEW_DIGITS:
        remarks.append(f"only {max(left, 0.0):.1f} digits are left, fewest at {where}")
    turn = reported.moves[1]
    if turn > LARGE_TURN:
        row = int(np.abs(reported.state.u[:, 3:]).max(axis=1).argmax())
        remarks.append(
            f"node {structure.system.labels[row]} turns by {turn:.3g} rad: "
            "beyond the theory of small rotations"
        )
    held = structure.held
    if reported.singular and held is not None:
        motions = null_motions(structure, held[0], held[1])
        remarks += [f"undetermined: {motion.text.split(':')[0]}" for motion in motions]
    return tuple(remarks) + _pushing_hangers(structure, reported)


def _pushing_hangers(structure: Structure, reported: Reported) -> tuple[str, ...]:
    system, c = structure.system, structure.system.contacts
    return tuple(
        f"{system.cards[i].name} pushes down: a hanger can only pull"
        for i in structure.hangers
        if float((reported.state.reaction[c.card == i] @ system.up).sum()) < 0.0
    )
