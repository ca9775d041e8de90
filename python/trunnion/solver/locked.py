"""The locked pass: linear cases on the frozen contact state of a nonlinear one.

Every fixed direction and every one-way or gapped direction closed in that case is a two-way
spring about zero; open gaps stay open; friction is left out; gap offsets are dropped.  Snubbers
hold in occasional cases and in modal analysis (ABOUT=), and are free in hot sustained ones (ON=).
"""

from dataclasses import replace

import numpy as np

from trunnion.arrays import (
    F8,
    I4,
    OPEN,
    Contacts,
    FrozenBreak,
    State,
    System,
    no_contacts,
    no_sliders,
)


def frozen_system(system: System, state: State, *, snubbers: bool) -> tuple[System, I4]:
    """The system on the contact state of `state`: two-way springs only, no friction.

    Returns the system and, for each of its contacts, its number among the contacts and then the
    snubbers of the original.
    """
    c, s = system.contacts, system.snubbers
    n = len(c.k)
    free = [not snubbers and system.cards[i].kind == "snubber" for i in c.card]
    closed = (state.side != OPEN) & ~np.array(free, np.bool_)
    radial = closed & (c.dim == 2) & ~c.two_way
    size = np.sqrt((state.reaction**2).sum(axis=1))
    normal = c.normal.copy()
    normal[radial] = 0.0
    pressed = radial & (size > 0.0)
    normal[pressed, 0] = state.reaction[pressed] / size[pressed, None]
    whole = joined(replace(c, normal=normal, dim=np.where(radial, 1, c.dim).astype(np.int32)), s)
    keep = np.flatnonzero(closed & ~(radial & ~pressed)).astype(np.int32)
    if snubbers:
        keep = np.concatenate((keep, n + np.arange(len(s.k), dtype=np.int32)))
    held = chosen(whole, keep)
    still = replace(held, gap=np.zeros_like(held.gap), two_way=np.ones(len(keep), np.bool_))
    frozen = replace(system, contacts=still, sliders=no_sliders(), snubbers=no_contacts())
    return frozen, keep


def snubbed_system(system: System) -> tuple[System, I4]:
    """The nonlinear system with its snubbers engaged beside the other supports."""
    both = joined(system.contacts, system.snubbers)
    whole = np.arange(len(both.k), dtype=np.int32)
    return replace(system, contacts=both, snubbers=no_contacts()), whole


def joined(a: Contacts, b: Contacts) -> Contacts:
    """Contacts of both, those of b last."""
    if not len(b.k):
        return a
    arrays = {
        name: np.concatenate((getattr(a, name), getattr(b, name)))
        for name in Contacts.__dataclass_fields__
        if name != "word"
    }
    return Contacts(**arrays, word=a.word + b.word)


def chosen(a: Contacts, keep: I4) -> Contacts:
    """Some contacts, in the order given."""
    arrays = {
        name: np.ascontiguousarray(getattr(a, name)[keep])
        for name in Contacts.__dataclass_fields__
        if name != "word"
    }
    return Contacts(**arrays, word=tuple(a.word[i] for i in keep))


def frozen_breaks(
    system: System, about: State, base: F8, keep: I4, locked: State, *, increment: bool
) -> tuple[FrozenBreak, ...]:
    """What a locked case does to the assumption that the contact state stays.

    Parameters
    ----------
    system : the nonlinear system, whose contacts have gaps.
    about : the case whose contact state was frozen.
    base : (n_card, 6) movements of the supports' bases, of both cases together.
    keep : numbers of the locked case's contacts among those of `system`.
    increment : the locked case comes on top of `about`; otherwise it stands alone (ON=).
    """
    c = system.contacts
    total = about.reaction.copy() if increment else np.zeros_like(about.reaction)
    own = keep < len(c.k)
    total[keep[own]] += locked.reaction[own]
    u = locked.u + locked.u_low
    if increment:
        u = u + about.u + about.u_low
    noise = 1e-9 * max(1.0, float(np.abs(total).max(initial=0.0)))
    found = []
    for i in np.flatnonzero(~c.two_way):
        card, word = int(c.card[i]), c.word[i]
        if about.side[i] != OPEN:
            pull = -_push(c, about, int(i), total[i])
            if pull > noise:
                found.append(FrozenBreak(card, word, "pulls", pull))
        elif increment:
            beyond = _beyond(c, base, int(i), u)
            if beyond > 1e-9 * float(np.abs(u).max()):
                found.append(FrozenBreak(card, word, "closes", beyond))
    return tuple(found)


def _push(c: Contacts, about: State, i: int, force: F8) -> float:
    """Force of a closed one-way contact in the sense in which it pushed in `about`."""
    if c.dim[i] == 2:
        r = about.reaction[i]
        return float(force @ r / max(float(np.linalg.norm(r)), 1e-300))
    return float(-about.side[i] * (force @ c.normal[i, 0]))


def _beyond(c: Contacts, base: F8, i: int, u: F8) -> float:
    """How far an open contact is moved beyond its gap."""
    part = slice(3, 6) if c.rotational[i] else slice(0, 3)
    w = u[c.node[i], part] - base[c.card[i], part]
    if c.cnode[i] >= 0:
        w = w - u[c.cnode[i], part]
    d = c.normal[i] @ w
    if c.dim[i] == 2:
        return float(np.hypot(*d) - c.gap[i, 0])
    return float(max(d[0] - c.gap[i, 1], -d[0] - c.gap[i, 0]))
