"""Laws of contact and friction, checked on reported numbers: the certificate's own formulas.

Both functions return relative errors by the name of the law, one entry a contact or a slider.
"""

import numpy as np

from trunnion.arrays import (
    BOTH,
    ENGAGED,
    F8,
    I4,
    MINUS,
    OPEN,
    PLUS,
    SLIP,
    STICK,
    Loads,
    State,
    System,
)
from trunnion.certificate.deformation import Index, cross, dot, two_difference
from trunnion.certificate.scales import Scale, floor, largest

WRONG = 1.0  # error of a state that contradicts itself
NOTHING = 1e-9  # of the largest normal force: a force without a direction


def contact_errors(system: System, loads: Loads, state: State, scale: Scale) -> dict[str, F8]:
    """Contact law in length, and sides, signs and directions of the reactions."""
    c, side = system.contacts, state.side
    u, low, base = state.u.T, state.u_low.T, loads.base[c.card].T
    travel = _travel(u[:3], low[:3], c.node, c.cnode, base[:3])
    length, force = np.full(c.k.size, scale.length), np.full(c.k.size, scale.force)
    if c.rotational.any():
        rotation = _travel(u[3:], low[3:], c.node, c.cnode, base[3:])
        travel = np.where(c.rotational, rotation, travel)
        length[c.rotational], force[c.rotational] = scale.angle, scale.moment
    push = state.reaction.T
    if loads.preload.any():
        hanger = np.array([card.kind == "hanger" for card in system.cards])
        push = push - system.up[:, None] * np.where(hanger, loads.preload, 0.0)[c.card]

    n, minus, plus = c.normal[:, 0].T, c.gap[:, 0], c.gap[:, 1]
    d, r = dot(n, travel), dot(n, push)
    excess = np.maximum(d - plus, 0.0) - np.maximum(-d - minus, 0.0)
    shift = np.where(side == PLUS, d - plus, np.where(side == MINUS, d + minus, 0.0))
    shift = np.where(side == BOTH, d, shift)
    elastic = c.k > 0.0
    yielded = np.divide(r, c.k, out=-shift, where=elastic)
    law = np.maximum(np.abs(shift + yielded), np.abs(shift - excess))
    wrong = np.abs(push - n * r).max(axis=0)
    wrong = np.maximum(wrong, np.where(side == PLUS, r, np.where(side == MINUS, -r, 0.0)))
    legal = np.where(c.two_way, side == BOTH, (side >= MINUS) & (side <= PLUS))
    radial = np.flatnonzero(c.dim == 2)
    if radial.size:
        law[radial], wrong[radial] = _radial(system, radial, travel, push, side)
        legal[radial] = (side[radial] == BOTH) | ((side[radial] == OPEN) & ~c.two_way[radial])
    loose = np.where((side == OPEN) | ~elastic, np.abs(push).max(axis=0), 0.0)
    wrong = np.where(legal, np.maximum(wrong, loose) / force, WRONG)
    return {"contact_law": law / length, "contact_state": wrong}


def _radial(system: System, at: Index, travel: F8, push: F8, side: I4) -> tuple[F8, F8]:
    """Errors in length and in force of contacts that act in a plane, at the same gap all round."""
    c = system.contacts
    a, b = c.normal[at, 0].T, c.normal[at, 1].T
    w = np.stack([dot(a, travel[:, at]), dot(b, travel[:, at])])
    r = np.stack([dot(a, push[:, at]), dot(b, push[:, at])])
    reach = np.hypot(*w)
    gap = np.where(c.two_way[at], 0.0, c.gap[at, 0])
    way = np.divide(w, reach, out=np.zeros_like(w), where=reach > 0.0)
    closed = side[at] == BOTH
    shift = np.where(closed, reach - gap, 0.0)
    law = np.hypot(*(shift * way + r / c.k[at]))
    law = np.maximum(
        law, np.abs(shift - np.where(c.two_way[at], reach, np.maximum(reach - gap, 0)))
    )
    wrong = _size(push[:, at] - a * r[0] - b * r[1])
    turned = np.maximum(np.abs(r[0] * way[1] - r[1] * way[0]), r[0] * way[0] + r[1] * way[1])
    return law, np.maximum(wrong, np.where(gap > 0.0, turned, 0.0))


def slider_errors(system: System, loads: Loads, state: State, scale: Scale) -> dict[str, F8]:
    """Coulomb's law, its direction, the stick law, travel and datum, and the modes."""
    s, mode = system.sliders, state.mode
    count = len(s.mu)
    if not count:
        return {}
    friction, slide, datum = state.friction.T, state.slide.T, state.datum.T
    travel = _travel(
        state.u[:, :3].T, state.u_low[:, :3].T, s.node, s.cnode, loads.base[s.card, :3].T
    )
    a, b = s.basis[:, 0].T, s.basis[:, 1].T

    owner = np.repeat(np.arange(count), np.diff(s.first))
    pressed = [np.bincount(owner, part, count) for part in state.reaction[s.contact].T]
    normal = _size(np.stack(pressed))
    shut = np.bincount(owner, state.side[s.contact] != OPEN, count) > 0
    load = floor(largest(normal), 1e-4 * scale.force)
    slip = floor(largest(slide), 1e-5 * scale.length)
    f, way, capacity = _size(friction), _size(slide), s.mu * loads.mux * normal

    sticks, slips = mode == STICK, mode == SLIP
    gone = np.where(mode == OPEN, f, np.where(slips, np.abs(f - capacity), f - capacity))
    off = _size(friction - a * dot(a, friction) - b * dot(b, friction))
    coulomb = np.maximum(np.maximum(gone, off), np.abs(state.normal - normal)) / load
    bond = np.where(sticks, _size(friction + s.kf * slide) / s.kf, 0.0)
    bond = np.where(slips, np.maximum(capacity / s.kf - way, 0.0), bond) / slip
    sine = _size(cross(friction, slide)) / np.where(f * way > 0.0, f * way, 1.0)
    sine = np.where(dot(friction, slide) < 0.0, sine, WRONG)
    sine = np.where(slips & (f > NOTHING * load), sine, 0.0)
    now = a * dot(a, travel) + b * dot(b, travel)
    kept = np.where(sticks, datum, now + friction / s.kf)
    moved = _size(slide - (now - datum)) / slip
    left = _size(state.datum_end.T - kept) / slip
    # open without contact, engaged without friction; with a trace of pressure open as well
    legal = np.where(s.mu * loads.mux == 0.0, mode == ENGAGED, sticks | slips)
    legal |= (normal <= NOTHING * load) & (mode == OPEN)
    legal = np.where(shut, legal, mode == OPEN)
    return {
        "friction": coulomb,
        "direction": sine,
        "stick_law": bond,
        "slide": moved,
        "datum": left,
        "mode": np.where(legal, 0.0, WRONG),
    }


def _travel(u: F8, low: F8, node: I4, cnode: I4, base: F8) -> F8:
    """(k, n) movement of nodes against their partner or base, formed in double-double."""
    move, error = two_difference(u[:, node], base)
    error += low[:, node]
    if (cnode >= 0).any():
        grounded = cnode < 0
        move, more = two_difference(move, np.where(grounded, 0.0, u[:, cnode]))
        error += more - np.where(grounded, 0.0, low[:, cnode])
    return move + error


def _size(a: F8) -> F8:
    """Length of (3, n) vectors."""
    length: F8 = np.sqrt(dot(a, a))
    return length
