"""One system for results whose supports are not all engaged alike.

Locked cases stand on systems that have only the closed contacts, and the snubbers; all other
cases have every contact and no snubber.  Elements, nodes and support cards are the same.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from trunnion.arrays import F8, Contacts, System
from trunnion.solver.locked import chosen, joined

Key = tuple[int, str, int]  # card, direction word, and which of that word


@dataclass(frozen=True, slots=True)
class Frame:
    """A system with the contacts of all, and the places of their contacts in it.

    alike : the elements are equal, too: no modulus is another.
    keys : place of every contact; empty where all systems have the same contacts.
    """

    system: System
    alike: bool
    keys: dict[Key, int]

    def spread(self, system: System, values: F8) -> F8:
        """(n_contact, 3) values of a system's contacts on those of the frame, 0 elsewhere."""
        if not self.keys:
            return values
        spread = np.zeros((len(self.system.contacts.k), 3))
        spread[[self.keys[key] for key in _keys(system.contacts)]] = values
        return spread


def common_frame(systems: Sequence[System]) -> Frame:
    """Find the system that has every contact of all of them."""
    base = max(systems, key=lambda s: (len(s.sliders.mu), len(s.contacts.k)))
    alike = all(s.rigidity is base.rigidity for s in systems)
    if all(s.contacts is base.contacts for s in systems):
        return Frame(base, alike, {})
    contacts = base.contacts
    keys = {key: i for i, key in enumerate(_keys(contacts))}
    for system in systems:
        if system.contacts is base.contacts:
            continue
        more = {key: i for i, key in enumerate(_keys(system.contacts)) if key not in keys}
        keys |= {key: i for i, key in enumerate(more, len(keys))}
        own = np.array(list(more.values()), np.int32)
        contacts = joined(contacts, chosen(system.contacts, own))
    return Frame(replace(base, contacts=contacts), alike, keys)


def _keys(contacts: Contacts) -> list[Key]:
    seen: dict[tuple[int, str], int] = {}
    keys = []
    for card, word in zip(contacts.card.tolist(), contacts.word, strict=True):
        seen[card, word] = count = seen.get((card, word), -1) + 1
        keys.append((card, word, count))
    return keys
