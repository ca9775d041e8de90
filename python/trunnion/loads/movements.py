"""Imposed movements: of the ground under supports, or of nodes without any."""

import numpy as np

from trunnion.arrays import F8, System
from trunnion.model import Model


def node_numbers(system: System) -> dict[str, int]:
    """Return the node number of every label."""
    return {label: i for i, label in enumerate(system.labels)} | system.alias


def bases(model: Model, system: System) -> dict[str, F8]:
    """Movement of the ground under the cards of a node; a card on a CNODE follows that node."""
    node = node_numbers(system)
    cards: dict[int, list[int]] = {}
    for i, card in enumerate(system.cards):
        if card.cnode is None:
            cards.setdefault(node[card.label], []).append(i)
    base: dict[str, F8] = {}
    for d in model.displacements:
        moved = base.setdefault(d.set, np.zeros((len(system.cards), 6)))
        moved[cards[node[d.node]]] += [x or 0.0 for x in d.d]
    return base


def idle(model: Model, system: System) -> dict[str, tuple[str, ...]]:
    """Name imposed movements in directions that no support of the node holds."""
    if not model.displacements:
        return {}
    contacts, node = system.contacts, node_numbers(system)
    held = np.abs(contacts.normal).max(axis=1) > 1e-9
    idle: dict[str, tuple[str, ...]] = {}
    for d in model.displacements:
        own = (contacts.node == node[d.node]) & (contacts.cnode < 0)
        for i, word in enumerate(("DX", "DY", "DZ", "RX", "RY", "RZ")):
            turns = contacts.rotational if i >= 3 else ~contacts.rotational
            if d.d[i] and not held[own & turns, i % 3].any():
                text = f"D{d.set} {word} at {d.node} moves nothing: no support there holds it"
                idle[d.set] = (*idle.get(d.set, ()), text)
    return idle
