"""EVENTS=ON: a load step split where a gapped contact with friction closes."""

from dataclasses import replace

import numpy as np

from trunnion.arrays import B1, F8
from trunnion.solver.friction import Solved
from trunnion.solver.quantities import Forcing, Point
from trunnion.solver.span import Span
from trunnion.solver.structure import Structure

EVENTS = 200  # closings located in one step, at most
LOCATED = 1e-12  # of the size of the model: an opening at which a closing counts as found


def split_at_closings(span: Span, point: Point, solved: Solved) -> Solved:
    """Commit the datum where a contact closes, and go on to the target.

    `solved` is the whole step as it ended, with `point`.
    """
    structure = span.structure
    watched = _watched(structure)
    if not watched.any():
        return solved
    was_open = _opening(structure, span.before, span.start) > 0.0
    for _ in range(EVENTS):
        closed = watched & was_open & (solved.response.side != 0)
        if not closed.any():
            return solved
        t = _closing(span, closed)
        if t is None or t >= 1.0:
            return solved
        point.become(span.before)
        solved = span.part(point, t)
        if not solved.settled:
            return solved
        part = span.load(t)
        touching = watched & (_opening(structure, point, part) <= 1e-9 * structure.size)
        _note(span, touching & was_open, t)
        law = span.committed(solved)
        span = replace(span, law=law, start=part, before=point.copy())
        was_open = was_open & ~touching
        solved = span.whole(point)
        if not solved.settled:
            return solved
    return solved


def _note(span: Span, which: B1, t: float) -> None:
    structure = span.structure
    names = {structure.system.cards[i].name for i in structure.contacts.card[which]}
    span.history.notes.append(f"EVENT: {', '.join(sorted(names))} closes at {t:.6g} of the step")


def _watched(structure: Structure) -> B1:
    """Contacts with a gap on which friction acts."""
    c, s = structure.contacts, structure.sliders
    owner = np.repeat(np.arange(len(s.mu)), np.diff(s.first))
    rubbed = np.zeros(len(c.k), bool)
    rubbed[s.contact[: len(owner)][s.mu[owner] > 0.0]] = True
    gap = np.where(np.isfinite(c.gap), c.gap, 0.0).max(axis=1)
    watched: B1 = rubbed & (gap > 0.0)
    return watched


def _opening(structure: Structure, point: Point, forcing: Forcing) -> F8:
    """Distance of each contact from its nearer closing; negative when closed [m]."""
    c = structure.contacts
    w = structure.gather(point.u) - forcing.base
    d = np.einsum("cai,ci->ca", c.normal, w)
    radial = np.hypot(d[:, 0], d[:, 1])
    line = np.minimum(c.gap[:, 1] - d[:, 0], d[:, 0] + c.gap[:, 0])
    out: F8 = np.where(c.dim == 2, c.gap[:, 0] - radial, line)
    return out


def _closing(span: Span, closed: B1) -> float | None:
    """Smallest load fraction at which one of the contacts closes.

    By bisection, and by the line through the last two open points; a closed contact tells
    nothing but its penetration, so the line aims at an opening just above zero.
    """
    structure = span.structure
    near = LOCATED * structure.size
    open_at = [(0.0, _least(structure, span.before, span.start, closed))]
    b = 1.0
    for _ in range(60):
        a, fa = open_at[-1]
        t = 0.5 * (a + b)
        if len(open_at) > 1:
            a0, f0 = open_at[-2]
            slope = fa - f0
            aim = a + (0.5 * near - fa) * (a - a0) / slope if slope < 0.0 else t
            t = aim if a < aim < b else t
        point = span.before.copy()
        if not span.part(point, t).settled:
            return None
        f = _least(structure, point, span.load(t), closed)
        if 0.0 < f <= near:
            return t
        if f > 0.0:
            open_at.append((t, f))
        else:
            b = t
        if b - open_at[-1][0] <= 1e-14:
            return b
    return b


def _least(structure: Structure, point: Point, forcing: Forcing, which: B1) -> float:
    return float(_opening(structure, point, forcing)[which].min())
