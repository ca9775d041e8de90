"""Locked cases: ABOUT= (increments, snubbers locked), ON= (totals, snubbers free), NONLINEAR."""

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from trunnion.arrays import F8, CaseResult, FrozenBreak, Loads
from trunnion.cases.casetext import case_text
from trunnion.cases.snubbed import go_on
from trunnion.model import Case, Comb
from trunnion.results.combine import combine
from trunnion.solver.answer import Question, answer, at_rest, forcing_of
from trunnion.solver.linear import solve_linear
from trunnion.solver.locked import frozen_breaks, frozen_system
from trunnion.solver.mechanism import motions_at
from trunnion.solver.newton import TINY_PIVOT
from trunnion.solver.steps import Origin
from trunnion.solver.structure import Structure

if TYPE_CHECKING:
    from trunnion.cases.analysis import Run

Key = tuple[str, str, bool]  # frozen case, modulus set, snubbers locked


class LockedPass:
    """The linear cases of a run; those about one case share one factorisation and one solve."""

    def __init__(self, run: "Run") -> None:
        self.run = run

    def solve(self, cases: list[Case]) -> Iterator[CaseResult]:
        """Solve all locked cases, one frozen structure after the other."""
        groups: dict[Key, list[Case]] = {}
        for case in cases:
            about = self.run.found[case.about or case.on or ""]
            if about.state is None:
                yield self._refused(case, about, f"{about.name} has no answer")
            elif case.nonlinear:
                yield self._nonlinear(case, about)
            else:
                which = self.hot(case)
                own, _ = self._key(about)
                key = (about.name, own if which is None else which, case.about is not None)
                groups.setdefault(key, []).append(case)
        for key, group in groups.items():
            yield from self._group(key, group)

    def structure(
        self, about: CaseResult, *, snubbers: bool, which: str | None = None
    ) -> tuple[Structure, np.ndarray]:
        """The structure frozen as `about` left it, and its contacts' numbers.

        `which` is the modulus set; None takes that of `about`.
        """
        own, snubbed = self._key(about)
        parent = self.run.structure_of(own if which is None else which, snubbed=snubbed)
        assert about.state is not None
        system, keep = frozen_system(parent.system, about.state, snubbers=snubbers)
        return Structure(system, self.run.ledger, parent, keep), keep

    def hot(self, case: Case) -> str | None:
        """Modulus set that E=HOT of a locked case asks for: its own, else of the frozen case."""
        if not case.hot:
            return None
        name = case.about or case.on
        frozen = next(c for c in self.run.model.cases if isinstance(c, Case) and c.name == name)
        return self.run.hot_set(case) or self.run.hot_set(frozen)

    def _key(self, about: CaseResult) -> tuple[str, bool]:
        """Modulus set of a solved case, and whether its snubbers were locked."""
        return next(key for key, s in self.run.structures.items() if s.system is about.system)

    def _group(self, key: Key, cases: list[Case]) -> Iterator[CaseResult]:
        name, which, locks = key
        about = self.run.found[name]
        structure, keep = self.structure(about, snubbers=locks, which=which)
        questions = [self.question(case, structure) for case in cases]
        forcings = [forcing_of(structure, question) for question in questions]
        prepared = solve_linear(structure, forcings)
        held = structure.held
        if held is None or held[2] > 0.0 or structure.rcond <= TINY_PIVOT:
            response = prepared[0].solved.response
            motions = motions_at(structure, response)
            if motions:
                cause = "frozen state: " + "; ".join(m.text for m in motions)
                yield from (self._refused(case, about, cause) for case in cases)
                return
            structure.factorise(response.tangent, response.slider_tangent)
        for case, question, ready in zip(cases, questions, prepared, strict=True):
            result, _ = answer(structure, question, at_rest(structure), ready)
            if result.state is not None:
                result.frozen_check = self.breaks(about, keep, case, result)
            yield result

    def breaks(
        self, about: CaseResult, keep: np.ndarray, case: Case, result: CaseResult
    ) -> tuple[FrozenBreak, ...]:
        """What a locked case does to the frozen contact state that it stands on."""
        assert about.state is not None
        assert about.loads is not None
        assert result.state is not None
        assert result.loads is not None
        base = about.loads.base + result.loads.base
        increment = case.about is not None
        return frozen_breaks(
            about.system, about.state, base, keep, result.state, increment=increment
        )

    def question(self, case: Case, structure: Structure) -> Question:
        """Loads of a locked case; movements and closed gaps of the frozen case stay out."""
        word = f"ABOUT={case.about}" if case.about else f"ON={case.on}"
        question = self.run.question_on(case, structure.system)
        return replace(question, text=f"{case_text(case)} {word}")

    def _refused(self, case: Case, about: CaseResult, cause: str) -> CaseResult:
        return CaseResult(
            name=case.name,
            kind="case",
            text=case_text(case),
            system=about.system,
            loads=None,
            state=None,
            converged=False,
            cause=cause,
        )

    # ------------------------------------------------------------------ NONLINEAR
    def _nonlinear(self, case: Case, about: CaseResult) -> CaseResult:
        """Operating and occasional loads together, snubbers locked where they are, less OPE."""
        own, _ = self._key(about)
        if (self.hot(case) or own) != own:
            return self._refused(case, about, f"E=HOT with NONLINEAR, but {about.name} is not hot")
        structure, question, start = self.together(case, about)
        total, _ = answer(structure, question, start)
        if total.state is None:
            return self._refused(case, about, total.cause or "")
        result = self.increment(case, about, total, start)
        result.warnings += total.warnings
        return result

    def together(self, case: Case, about: CaseResult) -> tuple[Structure, Question, Origin]:
        """Both loads as one case, its structure, and where it starts."""
        structure = self.run.structure_of(self._key(about)[0], snubbed=True)
        question = self.run.question_on(case, structure.system)
        origin = self.run.ended[about.name]
        assert origin.loads is not None
        both = _together(origin.loads, origin.lock, question.loads)
        loads, start = go_on(self.run.system, structure, origin, both, locked=True)
        return structure, replace(question, name=f"{about.name} + {case.name}", loads=loads), start

    def increment(
        self, case: Case, about: CaseResult, total: CaseResult, start: Origin
    ) -> CaseResult:
        """What both loads together do, less the operating case."""
        before = _padded(about, total, start)
        comb = Comb(case.name, ("-", ("case", total.name), ("case", before.name)), "")
        result = combine(comb, {total.name: total, before.name: before})
        result.text = f"{case_text(case)} ABOUT={about.name} NONLINEAR"
        result.total = total
        return result


def _together(a: Loads, lock: F8 | None, more: Loads) -> Loads:
    """Loads of both; where snubbers are locked is left to the start."""
    return Loads(
        dist=a.dist + more.dist,
        strain=a.strain + more.strain,
        curvature=a.curvature + more.curvature,
        nodal=a.nodal + more.nodal,
        base=a.base + more.base - (0.0 if lock is None else lock),
        preload=a.preload + more.preload,
        pressure=a.pressure + more.pressure,
        mux=a.mux,
        vary=a.vary + more.vary,
    )


def _padded(about: CaseResult, total: CaseResult, start: Origin) -> CaseResult:
    """The operating case on the contacts of `total`: snubbers that lock in it carry nothing."""
    assert about.state is not None
    more = len(total.system.contacts.k) - len(about.state.side)
    state = replace(
        about.state,
        side=np.concatenate((about.state.side, np.zeros(more, np.int32))),
        reaction=np.concatenate((about.state.reaction, np.zeros((more, 3)))),
    )
    system, loads = total.system, start.loads
    return replace(about, system=system, state=state, loads=loads, rigid=None, penalty_r=None)
