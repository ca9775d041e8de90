"""Stand-ins for what a model lacks: f2py refuses arrays without items."""

import numpy as np

from trunnion.arrays import Contacts, Sliders


def contacts_of(contacts: Contacts) -> Contacts:
    """The model's contacts, or one that never closes."""
    if len(contacts.node):
        return contacts
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


def sliders_of(sliders: Sliders) -> Sliders:
    """The model's sliders, or one without friction."""
    if len(sliders.node):
        return sliders
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
