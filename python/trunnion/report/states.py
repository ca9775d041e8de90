"""What every support does in one case: state, normal force, friction, slide, gap used."""

import numpy as np

from trunnion.arrays import BOTH, F8, MINUS, OPEN, PLUS, CaseResult
from trunnion.report.answers import largest
from trunnion.report.columns import numbers, plain, section, table, words
from trunnion.report.units import ReportUnits
from trunnion.supports import STATES, contact_levels, slider_of, solved

SIDES = {OPEN: "", MINUS: "-", PLUS: "+", BOTH: "both"}


def state_table(case: CaseResult, units: ReportUnits) -> str:
    """Print one row a direction word; anchors and springs are always engaged and left out."""
    system, state = case.system, solved(case)
    contacts, sliders = system.contacts, system.sliders
    cards = [system.cards[i] for i in contacts.card.tolist()]
    at = np.array([c.kind in ("support", "hanger") for c in cards], bool).nonzero()[0]
    if not at.size or case.kind == "comb":
        return ""
    owner = slider_of(contacts, sliders)
    rubs = owner >= 0
    own = np.linalg.norm(state.reaction, axis=1)
    normal = np.where(rubs, np.append(state.normal, 0.0)[owner], own)
    friction = np.vstack([state.friction, np.zeros(3)])[owner]
    slide = np.linalg.norm(np.vstack([state.slide, np.zeros(3)])[owner], axis=1)
    mux = case.loads.mux if case.loads is not None else 1.0
    capacity = np.append(sliders.mu, 0.0)[owner] * mux * normal
    size = np.linalg.norm(friction, axis=1)
    used = np.divide(size, capacity, out=np.full(len(size), np.nan), where=capacity > 0)
    along = _along(case)
    level = contact_levels(contacts, sliders, state)
    turning = contacts.rotational
    q = units.force.showing(largest(np.where(turning, 0.0, normal)))
    d = units.movement.showing(largest(state.u[:, :3]))
    factor = np.where(turning, units.moment.factor / q.factor, 1.0)
    turned = np.where(turning, units.rotation.factor / d.factor, 1.0)
    columns = [
        words("NODE", [cards[i].label for i in at]),
        words("WORD", [contacts.word[i] for i in at]),
        words("STATE", [STATES[level[i]] for i in at], least=8),
        words("SIDE", [SIDES[int(state.side[i])] for i in at], least=5),
        numbers("MOVED", (along * turned)[at], d, 11),
        numbers("CLEAR", (_clear(case, along) * turned)[at], d, 10),
        numbers("N", (normal * factor)[at], q, 12),
        numbers("F", size[at], q, 12),
        plain("F/(mu N)", used[at], 4, 10),
        numbers("SLIDE", np.where(rubs & (level > OPEN), slide, np.nan)[at], d, 11),
        *(numbers(f"F{'XYZ'[k]}", -friction[at, k], q, 11) for k in range(3)),
    ]
    note = (
        "friction ON THE RESTRAINT; MOVED along the word, CLEAR to the nearer stop "
        "(rotations: deg, moment)"
    )
    return section(f"{case.name}: SUPPORT STATES", note) + table(columns)


def _along(case: CaseResult) -> F8:
    """(n_contact,) movement along each normal less that of the base [m, rad]."""
    contacts, u = case.system.contacts, solved(case).u
    base = case.loads.base if case.loads is not None else np.zeros((len(case.system.cards), 6))
    move = u[contacts.node] - base[contacts.card]
    move[contacts.cnode >= 0] -= u[contacts.cnode[contacts.cnode >= 0]]
    part = np.where(contacts.rotational[:, None], move[:, 3:], move[:, :3])
    components = np.einsum("cij,cj->ci", contacts.normal, part)
    radial = np.linalg.norm(components, axis=1)
    along: F8 = np.where(contacts.dim == 2, radial, components[:, 0])
    return along


def _clear(case: CaseResult, along: F8) -> F8:
    """(n_contact,) way left to the nearer stop of an open contact [m, rad]; NaN where closed."""
    gap = case.system.contacts.gap
    one_way = np.minimum(gap[:, 0] + along, gap[:, 1] - along)
    radial = gap[:, 1] - along
    left: F8 = np.where(case.system.contacts.dim == 2, radial, one_way)
    return np.where(solved(case).side == OPEN, left, np.nan)
