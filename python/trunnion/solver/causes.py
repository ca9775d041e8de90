"""Why a case has no answer, in words that name the support: what it needs and what it has."""

import numpy as np

from trunnion.solver.friction import Solved, all_stuck
from trunnion.solver.history import History
from trunnion.solver.mechanism import motions_at
from trunnion.solver.quantities import Forcing, Point, Sliding
from trunnion.solver.structure import Structure


def explain(
    structure: Structure, sliding: Sliding, forcing: Forcing, solved: Solved, history: History
) -> str:
    """Cause of a step that did not settle.

    Where the load can be carried with every pressing support stuck, the friction this needs is
    compared with mu N; where it cannot, the motions that nothing resists are named.
    """
    cause = solved.cause or "the iteration did not settle"
    if not solved.unbounded:
        return cause
    needs = _needs(structure, sliding, forcing, history)
    if needs:
        return f"{'; '.join(needs)}: {cause}"
    motions = motions_at(structure, solved.response)
    return f"{'; '.join(m.text for m in motions)}: {cause}" if motions else cause


def _needs(structure: Structure, sliding: Sliding, forcing: Forcing, history: History) -> list[str]:
    """Supports whose friction would have to exceed mu N for the pipe to stay."""
    point = Point.zero(structure.n_node)
    outcome = all_stuck(structure, point, sliding, forcing, history)
    if not outcome.settled:
        return []
    response = outcome.response
    need = np.sqrt((response.friction**2).sum(axis=1))
    have = sliding.mu * response.normal
    over = np.flatnonzero(need > have)
    names = structure.system.cards
    return [
        f"{_what(names[structure.sliders.card[i]].name)} needs a friction force of "
        f"{need[i]:.7g} N to hold, its capacity mu N is {have[i]:.7g} N"
        for i in over[np.argsort(have[over] - need[over])][:3]
    ]


def _what(name: str) -> str:
    return f"support {name}"
