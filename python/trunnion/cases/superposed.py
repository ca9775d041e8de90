"""Which linear cases of a run are solved as sums of load sets: where there are many of few."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from trunnion.arrays import CaseResult
from trunnion.loads import case_loads
from trunnion.model import Case, Term

if TYPE_CHECKING:
    from trunnion.cases.analysis import Run
    from trunnion.solver.structure import Structure

WORTH = 2  # cases for each load set, from which on sums are quicker

Set = tuple[str, tuple[float, float, float] | None]


def as_sums(run: "Run", structure: "Structure", cases: Sequence[Case]) -> dict[str, CaseResult]:
    """Answers to cases as sums of the load sets in them; of none where they are too few.

    What does not come out as well as it would on its own is left out.
    """
    alone = run.leads | {case.name for case in cases if case.start or case.snubbers}
    cases = [case for case in cases if case.name not in alone]
    sets: dict[Set, int] = {}
    for case in cases:
        for term in case.terms:
            sets.setdefault(_key(term), len(sets))
    few = not cases or len(cases) < WORTH * len(sets)
    if few or run.starts or not len(structure.system.kind):
        return {}
    from trunnion.solver.superpose import solve_bases, superpose

    units = [Case(name, (Term(1.0, name, vector),)) for name, vector in sets]
    bases = solve_bases(
        structure, [case_loads(run.model, structure.system, unit, run.sets) for unit in units]
    )
    if bases is None:
        return {}
    weights = np.zeros((len(cases), len(sets)))
    for row, case in zip(weights, cases, strict=True):
        for term in case.terms:
            row[sets[_key(term)]] += term.factor
    found = superpose(structure, [run.question(case) for case in cases], bases, weights)
    return {case.name: own for case, own in zip(cases, found, strict=True) if own is not None}


def _key(term: Term) -> Set:
    return term.name, term.vector
