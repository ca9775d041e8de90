"""What every support does in one case: state, normal force, friction, slide, gap used."""

import numpy as np

from trunnion.arrays import BOTH, F8, I4, MINUS, OPEN, PLUS, CaseResult, Contacts
from trunnion.frozen import frozen
from trunnion.report.answers import largest
from trunnion.report.columns import numbers, plain, section, table, words
from trunnion.report.units import ReportUnits
from trunnion.results.supports import FREE, STATES, contact_levels, slider_of, solved

SIDES = {OPEN: "", MINUS: "-", PLUS: "+", BOTH: "both"}
SHOWN = ("support", "hanger", "snubber")  # anchors and springs are always engaged
NOTE = (
    "friction ON THE RESTRAINT; MOVED along the word, CLEAR to the nearer stop (rotations: deg, "
    "moment)"
)
TOGETHER = "  ALL: friction of all words of the card together (FRICTION=RESULTANT)\n"


@frozen(eq=False)
class StateRows:
    """Rows of the table: contacts, sliders that rub on several of them, free snubbers.

    order : the rows in the order of their cards.  level : index into STATES.  turning : of
    rotations.  normal, friction, used, slide : NaN where the row has none of its own.
    """

    order: I4
    card: I4
    word: list[str]
    level: I4
    side: list[str]
    turning: F8
    moved: F8
    clear: F8
    normal: F8
    friction: F8
    used: F8
    slide: F8


def state_table(case: CaseResult, units: ReportUnits) -> str:
    """Print one row a direction word, and one a friction element that rubs on several."""
    if case.gathered is not None:
        return ""
    rows, system, u = state_rows(case), case.system, solved(case).u
    shown = [system.cards[i].kind in SHOWN for i in rows.card.tolist()]
    at = rows.order[np.array(shown, bool)[rows.order]]
    if not at.size:
        return ""
    turning = rows.turning > 0.0
    q = units.force.showing(largest(np.where(turning | np.isnan(rows.normal), 0.0, rows.normal)))
    d = units.movement.showing(largest(u[:, :3]))
    factor = np.where(turning, units.moment.factor / q.factor, 1.0)
    turned = np.where(turning, units.rotation.factor / d.factor, 1.0)
    columns = [
        words("NODE", [system.cards[rows.card[i]].label for i in at]),
        words("WORD", [rows.word[i] for i in at]),
        words("STATE", [STATES[rows.level[i]] for i in at], least=8),
        words("SIDE", [rows.side[i] for i in at], least=5),
        numbers("MOVED", (rows.moved * turned)[at], d, 11),
        numbers("CLEAR", (rows.clear * turned)[at], d, 10),
        numbers("N", (rows.normal * factor)[at], q, 12),
        numbers("F", np.linalg.norm(rows.friction[at], axis=1), q, 12),
        plain("F/(mu N)", rows.used[at], 4, 10),
        numbers("SLIDE", rows.slide[at], d, 11),
        *(numbers(f"F{'XYZ'[k]}", -rows.friction[at, k], q, 11) for k in range(3)),
    ]
    text = section(f"{case.name}: SUPPORT STATES", NOTE) + table(columns)
    return text + (TOGETHER if "ALL" in rows.word else "")


def state_rows(case: CaseResult) -> StateRows:
    """Gather what the supports of a case that has states do."""
    system, state = case.system, solved(case)
    contacts, sliders, snubbers = system.contacts, system.sliders, system.snubbers
    owner, level = slider_of(contacts, sliders), contact_levels(system, state)
    several = np.flatnonzero(np.diff(sliders.first) > 1)
    last = sliders.contact[sliders.first[several + 1] - 1]
    single = (owner >= 0) & ~np.isin(owner, several)
    own = np.where(single, owner, -1)
    more, free = len(several), len(snubbers.k)

    mux = case.loads.mux if case.loads is not None else 1.0
    capacity = sliders.mu * mux * state.normal
    size = np.linalg.norm(state.friction, axis=1)
    used = np.divide(size, capacity, out=np.full(len(size), np.nan), where=capacity > 0)
    slide = np.where(state.mode > OPEN, np.linalg.norm(state.slide, axis=1), np.nan)
    friction, nothing = np.vstack([state.friction, np.zeros(3)]), np.full(free, np.nan)
    still = np.where((owner >= 0)[:, None] & ~single[:, None], np.nan, friction[own])
    moved = _along(case, contacts)
    blank = np.full(more, np.nan)
    return StateRows(
        order=np.argsort(
            np.concatenate([contacts.card, contacts.card[last] + 0.5, snubbers.card]),
            kind="stable",
        ).astype(np.int32),
        card=np.concatenate([contacts.card, contacts.card[last], snubbers.card]),
        word=[*contacts.word, *["ALL"] * more, *snubbers.word],
        level=np.concatenate([level, state.mode[several], np.full(free, FREE)]).astype(np.int32),
        side=[*(SIDES[int(i)] for i in state.side), *[""] * (more + free)],
        turning=np.concatenate([contacts.rotational, blank > 0, nothing > 0]).astype(np.float64),
        moved=np.concatenate([moved, blank, _along(case, snubbers)]),
        clear=np.concatenate([_clear(case, moved), blank, nothing]),
        normal=np.concatenate(
            [
                np.where(single, np.append(state.normal, 0.0)[own], _size(state.reaction)),
                state.normal[several],
                nothing,
            ]
        ),
        friction=np.concatenate([still, state.friction[several], np.zeros((free, 3))]),
        used=np.concatenate([np.append(used, np.nan)[own], used[several], nothing]),
        slide=np.concatenate([np.append(slide, np.nan)[own], slide[several], nothing]),
    )


def _size(vectors: F8) -> F8:
    size: F8 = np.linalg.norm(vectors, axis=1)
    return size


def _along(case: CaseResult, contacts: Contacts) -> F8:
    """(n_contact,) movement along each normal less that of the base [m, rad]."""
    u = solved(case).u
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
