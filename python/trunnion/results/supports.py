"""What each support card carries: the contacts and sliders of a case, gathered by card."""

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import (
    B1,
    ENGAGED,
    F8,
    I4,
    OPEN,
    Card,
    CaseResult,
    Contacts,
    Gathered,
    Sliders,
    State,
    System,
)
from trunnion.frozen import frozen

STATES = ("open", "engaged", "stick", "slip", "free", "locked")
FREE, LOCKED = 4, 5  # of snubbers
STEEP = 0.7  # cosine to the vertical of what is a rest, not a stop
ALIKE = 1e-9  # loads that differ by less are the same: the first case is named


def card_ids(cards: Sequence[Card]) -> tuple[str, ...]:
    """One name a card: its node's label, and from the second card of a node on 20#2, 20#3."""
    seen: dict[str, int] = {}
    ids = []
    for card in cards:
        seen[card.label] = count = seen.get(card.label, 0) + 1
        ids.append(card.label if count == 1 else f"{card.label}#{count}")
    return tuple(ids)


def gathered(case: CaseResult) -> Gathered:
    """Forces by card, global [N, N m]: a result's own, or the sums over its contacts."""
    if case.gathered is not None:
        return case.gathered
    s, state = case.system, case.state
    if state is None:
        raise ValueError(f"case {case.name} has no numbers")
    total, friction = contact_sums(s, state.reaction), np.zeros((len(s.cards), 3))
    normal = total[:, :3].copy()
    np.add.at(total[:, :3], s.sliders.card, state.friction)
    np.add.at(friction, s.sliders.card, state.friction)
    return Gathered(total, normal, friction)


def contact_sums(s: System, reaction: F8) -> F8:
    """(n_card, 6) forces and moments of contacts (n_contact, 3), added up for each card."""
    total = np.zeros((len(s.cards), 6))
    turning = s.contacts.rotational
    pushes = np.where(turning[:, None], 0.0, reaction)
    np.add.at(total[:, :3], s.contacts.card, pushes)
    np.add.at(total[:, 3:], s.contacts.card[turning], reaction[turning])
    return total


def card_forces(case: CaseResult) -> F8:
    """(n_card, 6) force and moment of each card on the pipe, global [N, N m]."""
    solved(case)
    return gathered(case).card_force


def card_loads(case: CaseResult) -> F8:
    """(n_card, 6) load of the pipe on each restraint [N, N m]; a size stays a size."""
    solved(case)
    found = gathered(case)
    return -found.card_force if found.card_load is None else found.card_load


def card_friction(case: CaseResult) -> F8:
    """(n_card, 3) friction of each card on the pipe [N]."""
    solved(case)
    return gathered(case).card_friction


def card_normals(case: CaseResult) -> F8:
    """(n_card,) size of each card's force on the pipe without its friction [N]."""
    solved(case)
    size: F8 = np.linalg.norm(gathered(case).card_normal, axis=1)
    return size


def card_levels(case: CaseResult) -> I4:
    """(n_card,) index into STATES: the liveliest of the card's contacts and sliders.

    A card without contacts carries (a hanger without rate), unless it is a free snubber or was
    open when the contacts were frozen.
    """
    s, state = case.system, solved(case)
    level = np.zeros(len(s.cards), np.int32)
    closed = (state.side != OPEN).astype(np.int32) * ENGAGED
    np.maximum.at(level, s.contacts.card, closed)
    np.maximum.at(level, s.sliders.card, state.mode)
    has = np.zeros(len(s.cards), bool)
    has[s.contacts.card] = True
    for i, card in enumerate(s.cards):
        if card.kind == "snubber":
            level[i] = LOCKED if has[i] else FREE
        elif not has[i] and card.kind != "support":
            level[i] = ENGAGED
    return level


def card_states(case: CaseResult) -> list[str | None]:
    """State of each card in words; None in a combination or spectrum, which has no state."""
    if case.gathered is not None:
        return [None] * len(case.system.cards)
    return [STATES[i] for i in card_levels(case)]


def direction_states(case: CaseResult) -> list[str | None]:
    """States of the directions of each card where they differ: "open +Y, slip LIMIT".

    The card's own state is that of the liveliest: slip, though its rest may have lifted off.
    """
    found: list[str | None] = [None] * len(case.system.cards)
    if case.gathered is not None:
        return found
    contacts = case.system.contacts
    of: dict[int, list[tuple[str, str]]] = {}
    levels = contact_levels(case.system, solved(case)).tolist()
    for card, word, level in zip(contacts.card.tolist(), contacts.word, levels, strict=True):
        of.setdefault(card, []).append((word, STATES[level]))
    for card, pairs in of.items():
        found[card] = by_state(pairs)
    return found


def by_state(pairs: Iterable[tuple[str, str]]) -> str | None:
    """Name directions (word, state) by their states; None where all have the same."""
    of: dict[str, list[str]] = {}
    for word, state in pairs:
        of.setdefault(state, []).append(word)
    if len(of) < 2:
        return None
    return ", ".join(f"{state} {' '.join(words)}" for state, words in of.items())


def lifted_rests(case: CaseResult) -> list[int]:
    """Contacts that are rests which the pipe has lifted off: upward, one-way and open.

    Their card may still guide and slide, so that its own state says nothing of it.
    """
    s, state = case.system, solved(case)
    rise = s.contacts.normal[:, 0] @ s.up
    below, above = s.contacts.gap.T
    under, over = np.where(rise > 0.0, below, above), np.where(rise > 0.0, above, below)
    rests = (np.abs(rise) > STEEP) & ~s.contacts.rotational & (s.contacts.dim == 1)
    rests &= np.isfinite(under) & np.isinf(over)
    found: list[int] = np.flatnonzero(rests & (state.side == OPEN)).tolist()
    return found


def contact_levels(system: System, state: State) -> I4:
    """(n_contact,) index into STATES."""
    contacts, sliders = system.contacts, system.sliders
    owner = slider_of(contacts, sliders)
    mode = np.append(state.mode, ENGAGED)[owner]  # owner -1 takes the appended one
    level = np.where(state.side == OPEN, OPEN, np.maximum(mode, ENGAGED))
    snubber = np.array([card.kind == "snubber" for card in system.cards], bool)
    level = np.where(snubber[contacts.card], LOCKED, level)
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


def card_nodes(system: System) -> list[int]:
    """Give the node number of each card."""
    number = {label: i for i, label in enumerate(system.labels)} | system.alias
    return [number[card.label] for card in system.cards]


def without_sign(case: CaseResult) -> B1:
    """(n_card, 6) where a load is a size: the same on the pipe and on the restraint."""
    found = gathered(case)
    if found.card_load is None:
        return np.zeros(found.card_force.shape, np.bool_)
    alike: B1 = (found.card_load == found.card_force) & (found.card_force != 0.0)
    return alike


@frozen(eq=False)
class Envelope:
    """Extremes over cases, each (n_card, 6), on the pipe; the cases as numbers.

    The number is -1 where no case has a load worth naming.  A size acts both ways.
    """

    highest: F8
    lowest: F8
    highest_case: I4
    lowest_case: I4


def envelope(cases: Sequence[CaseResult]) -> Envelope:
    """Find the largest and the smallest of each component of every support's load."""
    force, sizes = np.stack([card_forces(c) for c in cases]), [without_sign(c) for c in cases]
    return extremes(force, np.stack(sizes))


def extremes(force: F8, both: B1) -> Envelope:
    """Extremes over the first index of (n, n_card, 6); `both` tells what acts both ways.

    Where several come within `ALIKE` of the size of the extreme, the first of them is named.
    """
    size = np.abs(force).max(axis=0)
    halves = [size[:, :3].max(initial=0.0), size[:, 3:].max(initial=0.0)]
    nothing = size <= 1e-9 * np.repeat(halves, 3)
    upper, lower = np.where(both, np.abs(force), force), np.where(both, -np.abs(force), force)
    near = ALIKE * size
    high = (upper >= upper.max(axis=0) - near).argmax(axis=0)
    low = (lower <= lower.min(axis=0) + near).argmax(axis=0)
    return Envelope(
        np.take_along_axis(upper, high[None], axis=0)[0],
        np.take_along_axis(lower, low[None], axis=0)[0],
        np.where(nothing, -1, high).astype(np.int32),
        np.where(nothing, -1, low).astype(np.int32),
    )


def range_ratio(loop: F8, alone: F8) -> F8:
    """Ratio of ranges (..., 6); NaN where the one-shot range is next to nothing of its kind.

    Moments that are 1e-6 of the forces at 1 m are round-off, and the other way round.
    """
    ratio = np.full(loop.shape, np.nan)
    known = np.nan_to_num(alone)
    floor = 1e-6 * max(loop.max(initial=0.0), known.max(initial=0.0))
    for half in (slice(0, 3), slice(3, 6)):
        a, b = loop[..., half], known[..., half]
        size = max(a.max(initial=0.0), b.max(initial=0.0), floor)
        there = b > 1e-6 * size
        ratio[..., half] = np.divide(a, b, out=np.full(a.shape, np.nan), where=there)
    return ratio
