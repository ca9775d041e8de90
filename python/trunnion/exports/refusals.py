"""What other programs cannot be told: named with its place, so that nothing is lost in silence."""

from collections.abc import Iterator, Sequence

import numpy as np

from trunnion.arrays import CaseResult, Results
from trunnion.errors import Problem
from trunnion.model import Case, Comb, Model


class ExportError(ValueError):
    """A job that cannot be written for another program: all its problems at once."""

    def __init__(self, problems: Sequence[Problem]) -> None:
        count = "1 error" if len(problems) == 1 else f"{len(problems)} errors"
        super().__init__("\n".join([*map(str, problems), f"{count}, nothing was written"]))
        self.problems = tuple(problems)


def chosen_cases(
    model: Model, results: Results, names: Sequence[str], *, finds: bool
) -> tuple[list[CaseResult], list[Problem]]:
    """Give the cases to be written, and what keeps others from being written.

    Combinations are sums that Trunnion makes of cases; they are passed over unless named.

    Parameters
    ----------
    finds : the other program finds which contacts are closed, without an answer to hold them by.
    """
    cards = {case.name: case for case in model.cases}
    unknown = [name for name in names if name not in results.cases]
    known = ", ".join(results.cases)
    problems = [Problem("--case", f"{name} is not a case; there are {known}") for name in unknown]
    wanted = [case for case in results.cases.values() if not names or case.name in names]
    cases = []
    for case in wanted:
        card = cards.get(case.name)
        place = "cases" if card is None else card.place
        if isinstance(card, Comb) or (card is None and case.kind == "comb"):
            if names:
                text = f"COMB {case.name}: no case; export those that it is made of"
                problems.append(Problem(place, text))
            continue
        found = list(_faults(card, case, finds))
        problems += [Problem(place, f"CASE {case.name}: {text}") for text in found]
        if not found:
            cases.append(case)
    return cases, problems


def _faults(card: Case | None, case: CaseResult, finds: bool) -> Iterator[str]:
    """Yield what keeps one case from being written."""
    if card is not None and card.spectrum is not None:
        yield "a response spectrum combines modes; there is no static job to write"
        return
    if card is not None and card.nonlinear:
        yield "ABOUT= with NONLINEAR is the difference of two answers; export those two"
        return
    if case.loads is None:
        yield f"it has no loads: {case.cause}"
        return
    contacts, sliders = case.system.contacts, case.system.sliders
    cards = case.system.cards
    if case.state is None:
        rough = list(dict.fromkeys(cards[i].name for i in sliders.card))
        ring = (contacts.dim == 2) & ~contacts.two_way
        round_ = list(dict.fromkeys(cards[i].name for i in contacts.card[ring]))
        ways = list(dict.fromkeys(cards[i].name for i in contacts.card[~contacts.two_way]))
        if ways and not finds:
            yield f"there is no answer whose contacts could be held at {_some(ways)}"
            return
        if rough:
            yield f"there is no answer whose friction could be held at {_some(rough)}"
        if round_:
            yield f"there is no answer whose gap all round could be held at {_some(round_)}"
    moved = np.any(case.loads.base, axis=1).tolist()
    paired = np.unique(contacts.card[contacts.cnode >= 0])
    locked = [cards[i].name for i in paired.tolist() if moved[i]]
    if locked:
        yield f"a snubber between two nodes that locked on the way, at {_some(locked)}"


def _some(names: Sequence[str]) -> str:
    shown = ", ".join(names[:8])
    return shown if len(names) <= 8 else f"{shown} and {len(names) - 8} more"
