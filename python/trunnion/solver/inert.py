"""Stand-ins for what a model lacks: f2py refuses arrays without items."""

import numpy as np

from trunnion.arrays import Contacts, Sliders, System


def contacts_of(system: System) -> Contacts:
    """The model's contacts, or one that never closes."""
    if len(system.contacts.node):
        return system.contacts
    return Contacts(
        node=np.zeros(1, np.int32),
        cnode=np.full(1, -1, np.int32),
        card=np.zeros(1, np.int32),
        rotational=np.zeros(1, bool),
        dim=np.ones(1, np.int32),
        normal=np.zeros((1, 2, 3)),
        gap=np.full((1, 2), np.inf),
        k=np.zeros(1),
        penalty=np.zeros(1, bool),
        two_way=np.zeros(1, bool),
        word=("",),
    )


def sliders_of(system: System) -> Sliders:
    """The model's sliders, or one without friction."""
    if len(system.sliders.node):
        return system.sliders
    return Sliders(
        node=np.zeros(1, np.int32),
        cnode=np.full(1, -1, np.int32),
        card=np.zeros(1, np.int32),
        basis=np.zeros((1, 2, 3)),
        mu=np.zeros(1),
        kf=np.zeros(1),
        first=np.zeros(2, np.int32),
        contact=np.zeros(1, np.int32),
    )
