"""Numbers of a stored case as arrays of its system again."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from trunnion.arrays import BOTH, ENGAGED, F8, I4, OPEN, SLIP, STICK, State, System

MODES = {"open": OPEN, "engaged": ENGAGED, "stick": STICK, "slip": SLIP}


def stored_state(case: Mapping[str, Any], system: System) -> State:
    """Read the numbers of a case back; `system` is that of the case.

    Raises
    ------
    KeyError, IndexError, TypeError, ValueError : the tables are not those of this system.
    """
    contacts = [c for s in case["supports"] for c in s["contacts"]]
    sliders = [(s["contacts"][x["contacts"][0]], x) for s in case["supports"] for x in s["sliders"]]
    # the file has them by card, the system in its own order
    contacts = _ordered(contacts, system.contacts.card)
    sliders = _ordered(sliders, system.sliders.card)
    side = [BOTH if c["side"] == 0 and c["state"] != "open" else c["side"] for c in contacts]
    u, low, ends = moved(case, system)
    return State(
        u=u,
        u_low=low,
        end_force=ends,
        side=np.array(side, np.int32),
        reaction=_rows([c["vector"] for c in contacts]),
        friction=_rows([c["friction"] for c, _ in sliders]),
        mode=np.array([MODES[x["state"]] for _, x in sliders], np.int32),
        normal=np.array([c["normal"] for c, _ in sliders], np.float64),
        slide=_rows([c["slide"] for c, _ in sliders]),
        datum=_rows([x["datum"] for _, x in sliders]),
        datum_end=_rows([x["datum_end"] for _, x in sliders]),
    )


def moved(case: Mapping[str, Any], system: System) -> tuple[F8, F8, F8]:
    """Displacements, their low parts (n_node, 6), and end forces (n_elem, 2, 6)."""
    zero = [0.0] * 6
    low = case.get("nodes_low", {})
    ends = [[e["force_from"], e["force_to"]] for e in case["elements"]]
    if len(ends) != len(system.parts):
        raise ValueError(f"{len(ends)} elements, the deck has {len(system.parts)}")
    return (
        np.array([case["nodes"][label] for label in system.labels], np.float64),
        np.array([low.get(label, zero) for label in system.labels], np.float64),
        np.array(ends, np.float64).reshape(-1, 2, 6),
    )


def _rows(rows: list[Any]) -> F8:
    return np.array(rows, np.float64).reshape(-1, 3)


def _ordered(entries: list[Any], card: I4) -> list[Any]:
    """Put entries that stand by card into the order of the system."""
    order = np.argsort(card, kind="stable")
    if len(entries) != len(order):
        raise ValueError(f"{len(entries)} contacts or sliders, the deck has {len(order)}")
    placed: list[Any] = [None] * len(entries)
    for entry, i in zip(entries, order.tolist(), strict=True):
        placed[i] = entry
    return placed
