"""What each support card carries: the contacts and sliders of a case, gathered by card."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import (
    ENGAGED,
    F8,
    I4,
    OPEN,
    Card,
    CaseResult,
    Contacts,
    Sliders,
    State,
    System,
)

STATES = ("open", "engaged", "stick", "slip")


def card_ids(cards: Sequence[Card]) -> tuple[str, ...]:
    """One name a card: its node's label, and from the second card of a node on 20#2, 20#3."""
    seen: dict[str, int] = {}
    ids = []
    for card in cards:
        seen[card.label] = count = seen.get(card.label, 0) + 1
        ids.append(card.label if count == 1 else f"{card.label}#{count}")
    return tuple(ids)


def card_forces(case: CaseResult) -> F8:
    """(n_card, 6) force and moment of each card on the pipe, global [N, N m]."""
    s, state = case.system, solved(case)
    if case.envelope is not None:
        return case.envelope.card_force
    total = contact_sums(s, state.reaction)
    np.add.at(total[:, :3], s.sliders.card, state.friction)
    return total


def contact_sums(s: System, reaction: F8) -> F8:
    """(n_card, 6) forces and moments of contacts (n_contact, 3), added up for each card."""
    total = np.zeros((len(s.cards), 6))
    turning = s.contacts.rotational
    pushes = np.where(turning[:, None], 0.0, reaction)
    np.add.at(total[:, :3], s.contacts.card, pushes)
    np.add.at(total[:, 3:], s.contacts.card[turning], reaction[turning])
    return total


def card_friction(case: CaseResult) -> F8:
    """(n_card, 3) friction of each card on the pipe [N]."""
    total = np.zeros((len(case.system.cards), 3))
    np.add.at(total, case.system.sliders.card, solved(case).friction)
    return total


def card_levels(case: CaseResult) -> I4:
    """(n_card,) index into STATES: the liveliest of the card's contacts and sliders."""
    s, state = case.system, solved(case)
    level = np.zeros(len(s.cards), np.int32)
    closed = (state.side != OPEN).astype(np.int32) * ENGAGED
    np.maximum.at(level, s.contacts.card, closed)
    np.maximum.at(level, s.sliders.card, state.mode)
    without = np.ones(len(s.cards), bool)
    without[s.contacts.card] = False
    level[without] = ENGAGED  # a hanger without rate always carries
    return level


def card_states(case: CaseResult) -> list[str | None]:
    """State of each card in words; None in a combination, which has no state."""
    if case.kind == "comb":
        return [None] * len(case.system.cards)
    return [STATES[i] for i in card_levels(case)]


def contact_levels(contacts: Contacts, sliders: Sliders, state: State) -> I4:
    """(n_contact,) index into STATES."""
    owner = slider_of(contacts, sliders)
    mode = np.append(state.mode, ENGAGED)[owner]  # owner -1 takes the appended one
    level = np.where(state.side == OPEN, OPEN, np.maximum(mode, ENGAGED))
    return level.astype(np.int32)


def slider_of(contacts: Contacts, sliders: Sliders) -> NDArray[np.intp]:
    """(n_contact,) slider that rubs on each contact, -1 where none does."""
    owner = np.full(len(contacts.node), -1, np.intp)
    owner[sliders.contact] = np.repeat(np.arange(len(sliders.mu)), np.diff(sliders.first))
    return owner


def solved(case: CaseResult) -> State:
    """Return the numbers of a certified case; of any other refuse to, and say why."""
    if case.state is None or not is_good(case):
        raise ValueError(f"case {case.name} has no numbers: {cause_of(case)}")
    return case.state


def is_good(case: CaseResult) -> bool:
    """Tell whether a case is converged and certified: only then are its numbers shown."""
    certified = case.certificate is not None and case.certificate.passed
    return case.converged and certified and case.state is not None


def cause_of(case: CaseResult) -> str:
    """Say why a case is not good."""
    if case.cause:
        return case.cause
    if case.certificate is None:
        return "no certificate was computed"
    return f"certificate failed: {case.certificate.worst:.1e} at {case.certificate.where}"
