"""Directions of a support that opened or closed while the support as a whole kept its state."""

from itertools import pairwise

import numpy as np

from trunnion.arrays import OPEN, CaseResult

TOLD = 6  # turns of one support, the last ones


def turns(case: CaseResult) -> dict[int, list[str]]:
    """Say by support card which of its directions opened or closed, and at which iteration."""
    contacts = case.system.contacts
    found: dict[int, list[str]] = {}
    for i, (old, new) in enumerate(pairwise(case.passes), 1):
        for j in np.flatnonzero(old.side != new.side).tolist():
            what = "opened" if new.side[j] == OPEN else "closed"
            if old.side[j] != OPEN and new.side[j] != OPEN:
                what = "went to its other side"
            told = found.setdefault(int(contacts.card[j]), [])
            told.append(f"{contacts.word[j]} {what} at iteration {i}")
    return found


def words(state: str, told: list[str]) -> str:
    """Tell what the directions of a support did that was in one state throughout."""
    left = len(told) - TOLD
    before = f"{left} turns of its directions, then " if left > 0 else ""
    return f"{state.capitalize()} throughout: {before}{', '.join(told[-TOLD:])}."
