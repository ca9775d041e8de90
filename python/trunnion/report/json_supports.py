"""The JSON's support entries: one a card, with its contacts and its sliders.

A card's force is its normal forces and its friction; `normal` is the size of the first.  A
contact's `side` is -1 or 1 where it is closed on one side, else 0; its `reaction` counts along
`dir`, and `vector` is that force (moment of a rotation) on the pipe.  `sliders` holds what else
the friction law needs to be judged again from the file: which contacts a slider rubs on (its
normal force, friction and slide stand at the first of them) and its datum.
"""

from collections.abc import Sequence

import numpy as np

from trunnion.arrays import F8, I4, MINUS, PLUS, CaseResult
from trunnion.report.encode import listing, numbers, records, rows, words
from trunnion.results.supports import (
    STATES,
    card_forces,
    card_friction,
    card_ids,
    card_normals,
    card_states,
    contact_levels,
    slider_of,
    solved,
)


def support_entries(case: CaseResult) -> str:
    """Write the list of supports of one case."""
    cards = case.system.cards
    force, friction = card_forces(case), card_friction(case)
    entries = records(
        {
            "id": words(card_ids(cards)),
            "line": [str(card.line) for card in cards],
            "node": words(card.label for card in cards),
            "cnode": words(card.cnode for card in cards),
            "name": words(card.name for card in cards),
            "kind": words(card.kind for card in cards),
            "state": words(card_states(case)),
            "force": rows(force[:, :3]),
            "moment": rows(force[:, 3:]),
            "normal": numbers(card_normals(case)),
            "friction": rows(friction),
            "contacts": _by_card(case.system.contacts.card, _contacts(case), len(cards)),
            "sliders": _by_card(case.system.sliders.card, _sliders(case), len(cards)),
        }
    )
    return listing(entries)


def _contacts(case: CaseResult) -> list[str]:
    """One entry a direction word; a combination has none."""
    contacts, state = case.system.contacts, solved(case)
    if case.gathered is not None:
        return []
    friction, slide, normal, mu = _first_of_slider(case)
    along = np.einsum("ci,ci->c", state.reaction, contacts.normal[:, 0])
    signed = np.where(contacts.dim == 1, along, np.linalg.norm(state.reaction, axis=1))
    side = np.where((state.side == MINUS) | (state.side == PLUS), state.side, 0)
    return records(
        {
            "dir": words(contacts.word),
            "side": [str(i) for i in side.tolist()],
            "state": words(STATES[i] for i in contact_levels(case.system, state)),
            "reaction": numbers(signed),
            "mu": numbers(mu),
            "normal": numbers(normal),
            "friction": rows(friction),
            "slide": rows(slide),
            "vector": rows(state.reaction),
        }
    )


def _first_of_slider(case: CaseResult) -> tuple[F8, F8, F8, F8]:
    """Friction, slide, normal force and mu by contact.

    A slider that rubs on several contacts (FRICTION=RESULTANT) stands on the first of them.
    """
    contacts, sliders, state = case.system.contacts, case.system.sliders, solved(case)
    friction, slide = np.zeros_like(state.reaction), np.zeros_like(state.reaction)
    normal = np.linalg.norm(state.reaction, axis=1)
    owner = slider_of(contacts, sliders)
    mux = case.loads.mux if case.loads is not None else 1.0
    mu: F8 = np.where(owner < 0, 0.0, np.append(sliders.mu, 0.0)[owner] * mux)
    if len(sliders.mu):
        first = sliders.contact[sliders.first[:-1]]
        friction[first], slide[first], normal[first] = state.friction, state.slide, state.normal
    return friction, slide, normal, mu


def _sliders(case: CaseResult) -> list[str]:
    """One entry a friction element, with the datum it slides from."""
    sliders, state = case.system.sliders, solved(case)
    if case.gathered is not None:
        return []
    local = _rank(case.system.contacts.card)
    return records(
        {
            "contacts": [
                str(local[sliders.contact[a:b]].tolist()).replace(" ", "")
                for a, b in zip(sliders.first[:-1], sliders.first[1:], strict=True)
            ],
            "state": words(STATES[i] for i in state.mode.tolist()),
            "kf": numbers(sliders.kf),
            "datum": rows(state.datum),
            "datum_end": rows(state.datum_end),
        }
    )


def _rank(card: I4) -> I4:
    """(n,) place of each item among those of its card."""
    seen: dict[int, int] = {}
    rank = np.zeros(len(card), np.int32)
    for i, owner in enumerate(card.tolist()):
        rank[i] = seen[owner] = seen.get(owner, -1) + 1
    return rank


def _by_card(card: I4, entries: Sequence[str], n_card: int) -> list[str]:
    """Gather entries into one list a card."""
    gathered: list[list[str]] = [[] for _ in range(n_card)]
    for owner, entry in zip(card.tolist() if entries else [], entries, strict=True):
        gathered[owner].append(entry)
    return [f"[{','.join(group)}]" for group in gathered]
