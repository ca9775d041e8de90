"""Supports as small bodies: what stands where, of which type, and for which direction word.

Sizes are the same on paper whatever the model's size.  A rest is a cone under the pipe, a guide a
plate beside it, a limit stop a cone along it; an anchor is a block around it.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from trunnion.arrays import B1, F8, Contacts, System
from trunnion.frozen import frozen
from trunnion.report.plots.drawing import Frame
from trunnion.report.plots.paint import Paint
from trunnion.report.plots.palette import Look
from trunnion.report.plots.pipe import Course, half_widths
from trunnion.results.balance import end_axes
from trunnion.results.supports import card_nodes

SOFT = 1e11  # N/m: what is softer is drawn as a spring
PULLS = 0.5  # cosine to the restraint's body from which on a load pulls at it
LENGTHWISE = 0.85  # cosine to the pipe from which a direction is along it
MANY = 60  # supports from which on cones have fewer sides
SHARE = 0.45  # of the distance between supports: their size
CELL = 12.0  # of the paper in which supports are counted [pt]
LEAST, MOST = 4.0, 10.0  # sizes [pt]; where there is no room for the least they are dots


@dataclass(slots=True)
class Glyph:
    """One body or line of a support.

    kind : of palette.TYPES.  card : number of the support.  contact : of `System.contacts`, or -1
    where it stands for the whole card.  sides : (m, 3) of convex bodies.  wires : (m, 3) lines.
    """

    kind: str
    card: int
    contact: int = -1
    bodies: list[list[F8]] = field(default_factory=list)
    wires: list[F8] = field(default_factory=list)


@frozen(eq=False)
class Stand:
    """Where the supports stand and how they are drawn.

    at, radius, axis : (n_card, ...) places, half widths of the pipe there, its axes.  size : of a
    body [m].  sides : of a cone.  dots : without bodies.
    """

    at: F8
    radius: F8
    axis: F8
    size: float
    sides: int
    up: F8
    dots: bool


def stand(system: System, frame: Frame, found: Course) -> Stand:
    """Find the place of every support."""
    nodes = np.array(card_nodes(system), np.intp)
    radius, axis = np.zeros(len(system.labels)), np.zeros((len(system.labels), 3))
    half = half_widths(frame, found.radius)
    first, last = found.lines.first[:-1], found.lines.first[1:] - 1
    tangent = end_axes(system)[:, :, 0]
    widest = np.argsort(system.od, kind="stable")  # the last one at a node stands: the run
    for end, point in ((1, last), (0, first)):
        np.maximum.at(radius, system.ends[:, end], half[point])
    for e in widest.tolist():
        axis[system.ends[e]] = tangent[e]
    many = len(system.cards) > MANY
    at = system.xyz[nodes]
    room = SHARE * min(spacing(frame, at), crowding(frame, at))
    points = float(np.clip(room, LEAST, MOST))
    return Stand(
        at,
        np.maximum(radius, 0.5 * frame.scale)[nodes],
        axis[nodes],
        points * frame.scale,
        5 if many else 12,
        system.up,
        many and room < LEAST,
    )


def spacing(frame: Frame, at: F8) -> float:
    """Middle distance on paper between supports that follow each other in the deck [pt]."""
    points = frame.points(frame.flat(at))
    step = np.linalg.norm(np.diff(points, axis=0), axis=1)
    step = step[step > 1e-6]
    return float(np.median(step)) if len(step) else np.inf


def pulled(load: F8, lean: F8) -> B1:
    """(n,) whether loads (n, 3) pull at restraints whose bodies lean (n, 3) the other way."""
    size = np.linalg.norm(load, axis=1) * np.linalg.norm(lean, axis=1)
    found: B1 = np.einsum("ij,ij->i", load, lean) < -PULLS * size
    return found


def crowding(frame: Frame, at: F8) -> float:
    """Distance on paper that supports would have if they lay evenly where they lie [pt]."""
    cells = np.floor(frame.points(frame.flat(at)) / CELL)
    taken = len(np.unique(cells, axis=0))
    return CELL * float(np.sqrt(taken / len(at))) if 2 * taken < len(at) else np.inf


def glyphs(system: System, s: Stand, cards: Sequence[int] | None = None) -> list[Glyph]:
    """Give the bodies of all supports, or of some, in the order of the cards."""
    contacts, snubbers = _by_card(system, system.contacts), _by_card(system, system.snubbers)
    found: list[Glyph] = []
    for i in range(len(system.cards)) if cards is None else cards:
        card = system.cards[i]
        if s.dots:
            kinds = {"snubber": ["snubber"], "hanger": ["hanger"]}.get(card.kind)
            kinds = [card.kind] if card.kind in ("anchor", "displacement") else kinds
            own = [kind_of(system, c) for c in contacts[i]] if kinds is None else kinds
            found += [Glyph(kind, i) for kind in dict.fromkeys(own)]
        elif card.kind in ("anchor", "displacement"):
            found.append(_block(s, i, card.kind))
        elif card.kind == "hanger":
            found.append(_hanger(s, i))
        elif card.kind == "snubber":
            found += [_snubber(s, i, system.snubbers, c, -1) for c in snubbers[i]]
            found += [_snubber(s, i, system.contacts, c, c) for c in contacts[i]]
        else:
            found += [_direction(s, system, i, c) for c in contacts[i]]
    return found


def paint_glyphs(
    paint: Paint, frame: Frame, s: Stand, found: Sequence[Glyph], looks: Sequence[Look]
) -> None:
    """Add bodies, each in the colour of its look; what is not filled is white with a rim."""
    for glyph, look in zip(found, looks, strict=True):
        nearer = s.radius[glyph.card] + 0.5 * s.size
        for body in glyph.bodies:
            paint.solid(frame, body, look.colour, nearer=nearer, filled=look.filled)
        for wire in glyph.wires:
            paint.wire(frame.flat(wire), look.colour, 1.3 if s.sides > 5 else 0.8)


def _by_card(system: System, contacts: Contacts) -> list[list[int]]:
    rows: list[list[int]] = [[] for _ in system.cards]
    for i, card in enumerate(contacts.card.tolist()):
        rows[card].append(i)
    return rows


def leaning(s: Stand, found: Sequence[Glyph]) -> F8:
    """(n_card, 3) from each node to the middle of its bodies; zero where they stand all around."""
    total = np.zeros_like(s.at)
    for glyph in found:
        for body in glyph.bodies:
            total[glyph.card] += np.mean([side.mean(axis=0) for side in body], axis=0)
            total[glyph.card] -= s.at[glyph.card]
    total[np.linalg.norm(total, axis=1) < 0.5 * s.size] = 0.0
    return total


def kind_of(system: System, contact: int) -> str:
    """Type of one direction word, a key of palette.TYPES."""
    contacts = system.contacts
    if contacts.rotational[contact]:
        return "turn"
    if not contacts.penalty[contact] and contacts.k[contact] < SOFT:
        return "spring"
    word = contacts.word[contact].upper()
    if word in ("GUIDE", "LIMIT"):
        return word.lower()
    n, gap = contacts.normal[contact, 0], contacts.gap[contact]
    if contacts.dim[contact] == 1 and np.isfinite(gap).sum() == 1:
        held = float(n @ system.up) * (-1.0 if np.isfinite(gap[0]) else 1.0)
        if held < -0.99:
            return "rest"
    return "stop"


def _direction(s: Stand, system: System, card: int, contact: int) -> Glyph:
    """One direction word: a body at each side that holds."""
    contacts, kind = system.contacts, kind_of(system, contact)
    found = Glyph(kind, card, contact)
    at, r, g = s.at[card], s.radius[card], s.size
    normals = contacts.normal[contact, : contacts.dim[contact]]
    if kind == "turn":
        found.wires.append(_ring(at, normals[0], r + 0.45 * g))
        return found
    for normal in normals:
        for sign, gap in zip((-1.0, 1.0), contacts.gap[contact].tolist(), strict=True):
            if not np.isfinite(gap):
                continue
            out = sign * normal
            if kind == "spring":
                found.wires.append(_coil(at + r * out, out, 1.9 * g, 0.35 * g))
                found.bodies.append(_box(at + (r + 1.9 * g) * out, out, (0.1, 0.5, 0.5), g))
            elif kind not in ("rest", "guide") and abs(out @ s.axis[card]) > LENGTHWISE:
                below = at - (r + 0.42 * g) * _across(s.axis[card], s.up)
                found.bodies.append(_cone(below + 0.12 * g * out, out, g, 0.34 * g, s.sides))
            elif kind == "guide":
                middle = at + (r + 0.32 * g) * out
                found.bodies.append(_plate(middle, out, s.axis[card], g))
            else:
                off = r * float(np.sqrt(max(1.0 - (out @ s.axis[card]) ** 2, 0.0)))
                found.bodies.append(_cone(at + off * out, out, 1.15 * g, 0.55 * g, s.sides))
                if kind == "rest":
                    foot = at + (off + 1.2 * g) * out
                    found.bodies.append(_box(foot, out, (0.09, 0.85, 0.85), g))
    return found


def _block(s: Stand, card: int, kind: str) -> Glyph:
    """A block around the pipe, flat along it."""
    axis = s.axis[card] if np.linalg.norm(s.axis[card]) > 0.5 else s.up
    wide = s.radius[card] / s.size + 0.55
    return Glyph(kind, card, bodies=[_box(s.at[card], axis, (0.34, wide, wide), s.size, s.up)])


def _hanger(s: Stand, card: int) -> Glyph:
    """A rod, a spring and the plate that it hangs from."""
    at, g, up = s.at[card] + s.radius[card] * s.up, s.size, s.up
    return Glyph(
        "hanger",
        card,
        bodies=[_box(at + 3.1 * g * up, up, (0.1, 0.75, 0.75), g)],
        wires=[np.stack([at, at + 0.8 * g * up]), _coil(at + 0.8 * g * up, up, 2.3 * g, 0.42 * g)],
    )


def _snubber(s: Stand, card: int, contacts: Contacts, row: int, contact: int) -> Glyph:
    """A rod with a cylinder, held by a plate."""
    out, at, g = contacts.normal[row, 0], s.at[card], s.size
    start = at + s.radius[card] * out
    return Glyph(
        "snubber",
        card,
        contact,
        bodies=[
            _box(start + 1.3 * g * out, out, (0.6, 0.26, 0.26), g),
            _box(start + 2.4 * g * out, out, (0.1, 0.55, 0.55), g),
        ],
        wires=[np.stack([start, start + 2.4 * g * out])],
    )


def _aside(axis: F8, wish: F8 | None = None) -> F8:
    """Give a unit vector across an axis, as near to `wish` as can be."""
    rows = [np.eye(3)[int(np.argmin(np.abs(axis)))]]
    if wish is not None:
        rows.insert(0, wish)
    for row in rows:
        side: F8 = row - (row @ axis) / (axis @ axis) * axis
        if np.linalg.norm(side) > 0.1:
            return side / np.linalg.norm(side)
    raise ArithmeticError("an axis has no length")


def _across(axis: F8, up: F8) -> F8:
    """Up as seen from the pipe; aside where the pipe is vertical."""
    return _aside(axis, up) if np.linalg.norm(axis) > 0.5 else up


def _box(
    centre: F8, axis: F8, half: tuple[float, float, float], g: float, wish: F8 | None = None
) -> list[F8]:
    """Six sides of a box; half sizes in units of g, the first along `axis`."""
    side = _aside(axis, wish)
    edges = [axis * half[0] * g, side * half[1] * g, np.cross(axis, side) * half[2] * g]
    sides = []
    for i in range(3):
        a, b = edges[(i + 1) % 3], edges[(i + 2) % 3]
        for sign in (-1.0, 1.0):
            c = centre + sign * edges[i]
            sides.append(np.stack([c - a - b, c + a - b, c + a + b, c - a + b]))
    return sides


def _plate(centre: F8, out: F8, axis: F8, g: float) -> list[F8]:
    """A plate beside the pipe, longer along it."""
    wish = axis if np.linalg.norm(axis) > 0.5 else None
    return _box(centre, out, (0.12, 0.75, 0.5), g, wish)


def _cone(tip: F8, out: F8, length: float, wide: float, count: int) -> list[F8]:
    """Sides and foot of a cone whose tip touches the pipe."""
    side = _aside(out)
    other = np.cross(out, side)
    turn = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    ring = tip + length * out
    ring = ring + wide * (np.cos(turn)[:, None] * side + np.sin(turn)[:, None] * other)
    follow = np.roll(ring, -1, axis=0)
    return [np.stack([tip, a, b]) for a, b in zip(ring, follow, strict=True)] + [ring]


def _coil(start: F8, out: F8, length: float, wide: float) -> F8:
    """(10, 3) zigzag."""
    side, steps = _aside(out), 9
    way = np.linspace(0.0, length, steps + 1)[:, None] * out
    swing = wide * np.array([0, *(1 if k % 2 else -1 for k in range(1, steps)), 0])
    found: F8 = start + way + swing[:, None] * side
    return found


def _ring(centre: F8, axis: F8, radius: float) -> F8:
    """(25, 3) circle about an axis."""
    side = _aside(axis)
    turn = np.linspace(0.0, 2.0 * np.pi, 25)[:, None]
    found: F8 = centre + radius * (np.cos(turn) * side + np.sin(turn) * np.cross(axis, side))
    return found
