"""Locked cases: ABOUT= (increments, snubbers locked), ON= (totals, snubbers free), NONLINEAR."""

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from trunnion.arrays import CaseResult, Loads, State
from trunnion.casetext import case_text
from trunnion.combine import combine
from trunnion.model import Case, Comb
from trunnion.solver.answer import Question, answer, at_rest, forcing_of
from trunnion.solver.linear import solve_linear
from trunnion.solver.locked import frozen_breaks, frozen_system
from trunnion.solver.mechanism import motions_at
from trunnion.solver.newton import TINY_PIVOT
from trunnion.solver.steps import Origin
from trunnion.solver.structure import Structure

if TYPE_CHECKING:
    from trunnion.analysis import Run

Key = tuple[str, bool]


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
                groups.setdefault((about.name, case.about is not None), []).append(case)
        for key, group in groups.items():
            yield from self._group(key, group)

    def structure(self, about: CaseResult, *, snubbers: bool) -> tuple[Structure, np.ndarray]:
        """The structure frozen as `about` left it, and its contacts' numbers."""
        parent = self._parent(about)
        assert about.state is not None
        system, keep = frozen_system(about.system, about.state, snubbers=snubbers)
        return Structure(system, self.run.ledger, parent, keep), keep

    def _parent(self, about: CaseResult) -> Structure:
        return next(s for s in self.run.structures.values() if s.system is about.system)

    def _group(self, key: Key, cases: list[Case]) -> Iterator[CaseResult]:
        name, increment = key
        about = self.run.found[name]
        structure, keep = self.structure(about, snubbers=increment)
        questions = [self._question(case, structure) for case in cases]
        forcings = [forcing_of(structure, question) for question in questions]
        prepared = solve_linear(structure, forcings)
        held = structure.held
        if held is None or held[2] > 0.0 or structure.rcond <= TINY_PIVOT:
            response = prepared[0][1].response
            motions = motions_at(structure, response)
            if motions:
                cause = "frozen state: " + "; ".join(m.text for m in motions)
                yield from (self._refused(case, about, cause) for case in cases)
                return
            structure.factorise(response.tangent, response.slider_tangent)
        for question, ready in zip(questions, prepared, strict=True):
            result, _ = answer(structure, question, at_rest(structure), ready)
            if result.state is not None and about.state is not None and about.loads is not None:
                result.frozen_check = frozen_breaks(
                    about.system, about.state, about.loads, keep, result.state, increment=increment
                )
            yield result

    def _question(self, case: Case, structure: Structure) -> Question:
        """Loads of a locked case; movements and closed gaps of the frozen case stay out."""
        word = f"ABOUT={case.about}" if case.about else f"ON={case.on}"
        question = self.run.question(case, structure.system)
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
        assert about.state is not None
        assert about.loads is not None
        parent = self._parent(about)
        which = next(key[0] for key, s in self.run.structures.items() if s is parent)
        structure = self.run.structure_of(which, snubbed=True)
        question = self.run.question(case)
        loads = _together(about, question.loads)
        origin = self.run.ended[about.name]
        start = Origin(
            structure.forcing(_still_loads(about.loads, loads)), origin.point.copy(), origin.datum
        )
        whole = replace(question, name=f"{about.name} + {case.name}", loads=loads)
        total, _ = answer(structure, whole, start)
        if total.state is None:
            return self._refused(case, about, total.cause or "")
        before = _padded(about, total)
        comb = Comb(case.name, ("-", ("case", total.name), ("case", before.name)), "")
        result = combine(comb, {total.name: total, before.name: before})
        result.kind, result.text = "case", f"{case_text(case)} ABOUT={about.name} NONLINEAR"
        result.warnings += total.warnings
        return result


def _together(about: CaseResult, more: Loads) -> Loads:
    """Loads of both; snubbers hold the pipe where the operating case left it."""
    a = about.loads
    assert a is not None
    assert about.state is not None
    base = a.base + more.base
    u = about.state.u
    snubbers = about.system.snubbers
    for card, node, cnode in zip(snubbers.card, snubbers.node, snubbers.cnode, strict=True):
        base[card] = u[node] - (u[cnode] if cnode >= 0 else 0.0)
    return Loads(
        dist=a.dist + more.dist,
        strain=a.strain + more.strain,
        curvature=a.curvature + more.curvature,
        nodal=a.nodal + more.nodal,
        base=base,
        preload=a.preload + more.preload,
        pressure=a.pressure + more.pressure,
        mux=a.mux,
    )


def _still_loads(a: Loads, total: Loads) -> Loads:
    """The operating loads with the snubbers' bases already where they lock."""
    return replace(a, base=total.base)


def _padded(about: CaseResult, total: CaseResult) -> CaseResult:
    """The operating case on the system with engaged snubbers, which carry nothing."""
    assert about.state is not None
    more = len(total.system.contacts.k) - len(about.system.contacts.k)
    state: State = replace(
        about.state,
        side=np.concatenate((about.state.side, np.zeros(more, np.int32))),
        reaction=np.concatenate((about.state.reaction, np.zeros((more, 3)))),
    )
    return replace(about, system=total.system, state=state, penalty_u=None, penalty_r=None)
