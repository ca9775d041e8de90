"""One state judged: certificate from stored numbers, and whether its friction began where it said.

Loads and starts come from the deck and from states that were judged before.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from trunnion.arrays import CaseResult
from trunnion.cases.snubbed import go_on, locked_at_rest
from trunnion.certificate import certify
from trunnion.compare.claims import false_claim
from trunnion.compare.restored import stored_state
from trunnion.frozen import frozen
from trunnion.model import Case
from trunnion.solver.answer import Question, at_rest
from trunnion.solver.quantities import Point
from trunnion.solver.steps import SUB_STEPS, Origin
from trunnion.solver.structure import Structure

if TYPE_CHECKING:
    from trunnion.cases.analysis import Run


@frozen
class Verdict:
    """One case: `passed` is None where stored numbers alone cannot be judged; `text` says why."""

    case: str
    passed: bool | None
    text: str


@frozen(eq=False)
class Judged:
    """One state: the answer with its certificate, where later cases start, what is wrong."""

    result: CaseResult
    end: Origin
    fault: str = ""

    @property
    def text(self) -> str:
        """The worst item of the certificate."""
        found = self.result.certificate
        assert found is not None
        return f"worst {found.worst:.1e}, {found.where}"


def has_numbers(run: "Run", name: str) -> bool:
    """Whether a case was judged, and has numbers."""
    return name in run.found and run.found[name].state is not None


def start_of(
    run: "Run", case: Case, structure: Structure, question: Question, origin: Origin | None
) -> tuple[Question, Origin]:
    """Loads and start of a case that goes on from `origin`, or from rest; as `Run.ask`."""
    locked = case.snubbers == "LOCKED"
    if origin is not None:
        loads, start = go_on(run.system, structure, origin, question.loads, locked=locked)
        return replace(question, loads=loads), start
    return question, locked_at_rest(structure) if locked else at_rest(structure)


def judged(
    structure: Structure, question: Question, start: Origin, stored: Mapping[str, Any]
) -> Judged:
    """Certify the numbers of a stored state under the loads of a question.

    Raises
    ------
    KeyError, IndexError, TypeError, ValueError : the tables are not those of this structure.
    """
    state, claimed = stored_state(stored, structure.system), stored["certificate"]
    found = certify(
        structure.system,
        question.loads,
        state,
        correction_u=_number(claimed["correction_u"]),
        correction_r=_number(claimed["correction_r"]),
    )
    result = CaseResult(
        question.name, "case", question.text, structure.system,
        question.loads, state, True, certificate=found,
    )  # fmt: skip
    datum = np.zeros((len(structure.sliders.mu), 3))
    datum[: len(state.datum_end)] = state.datum_end
    whole = Point(state.u, state.u_low)
    end = Origin(structure.still, whole, datum, question.loads, start.lock)
    if not found.passed:
        return Judged(result, end, f"worst {found.worst:.1e}, {found.where}")
    if one_step(question, stored) and not np.array_equal(
        state.datum, start.datum[: len(state.datum)]
    ):
        return Judged(result, end, "its sliders do not start where the pipe was")
    return Judged(result, end, false_claim(found, stored))


def one_step(question: Question, stored: Mapping[str, Any]) -> bool:
    """Whether the datum at the beginning of the last step is that of the whole case."""
    plan = question.plan
    noted = any(SUB_STEPS in str(text) for text in stored.get("warnings", ()))
    return plan.steps == 1 and not plan.events and not noted


def _number(value: float | None) -> float:
    return np.inf if value is None else float(value)
