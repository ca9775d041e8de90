"""The pipe of a job in CalculiX's numbers: nodes, auxiliary freedoms, springs.

What a beam does not have is written with *EQUATION: a spring acts on an auxiliary freedom that is
a linear form of the nodes' own, so it may have any direction, hold a rotation, or stand half way
between two nodes.  Rotations are those of U1 where one ends at the node, else freedoms 1 to 3 of an
auxiliary node.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from trunnion.arrays import F8, SPRING, STRAIGHT, CaseResult
from trunnion.exports.hinges import Chain, chain
from trunnion.exports.scene import Hold, Scene, Stand, modulus_ratio

Key = tuple[object, ...]  # of a spring under a support
Term = tuple[int, int, float]  # node, freedom, coefficient


@dataclass(slots=True)
class Body:
    """Something that moves as a rigid body: a pipe's node, or a rigid part of a bend."""

    xyz: F8
    node: int  # freedoms 1 to 3 are its translation
    turn: int  # node and first freedom of its rotation
    first: int


@dataclass(slots=True)
class Ground:
    """Spring of a support: from `moving` over `middle` to `node`, which is fixed where it carries.

    Its zero is moved by two opposite forces on `moving` and `middle`: prescribed movements do not
    reach springs in CalculiX 2.20, and the force of one spring that takes both would be printed
    as a small difference of large numbers.
    """

    node: int
    middle: int
    moving: int
    k: float


@dataclass(slots=True)
class Deck:
    """Numbers given so far, and cards that stand before the steps."""

    scene: Scene
    ratio: F8
    bodies: list[Body]
    cards: list[tuple[int, int]]  # node and other node (-1: ground) of every support card
    nodes: list[tuple[int, F8]] = field(default_factory=list)
    last: int = 0
    elements: int = 0
    equations: list[list[Term]] = field(default_factory=list)
    springs: dict[float, list[tuple[int, ...]]] = field(default_factory=dict)
    hidden: list[int] = field(default_factory=list)  # auxiliary nodes of which one freedom is used
    chains: dict[int, Chain] = field(default_factory=dict)
    parts: dict[int, list[Body]] = field(default_factory=dict)  # of each chain
    hinges: dict[int, list[list[int]]] = field(default_factory=dict)  # springs of each
    links: dict[int, list[int]] = field(default_factory=dict)
    grounds: dict[Key, Ground] = field(default_factory=dict)

    def node(self, xyz: F8) -> int:
        """Add an auxiliary node."""
        self.last += 1
        self.nodes.append((self.last, xyz))
        return self.last

    def spring(self, k: float, *ends: int) -> None:
        """Add a spring on freedom 1 of one auxiliary node, or between those of two."""
        self.elements += 1
        self.springs.setdefault(k, []).append((self.elements, *ends))


def build(scene: Scene, case: CaseResult) -> Deck:
    """Number the pipe: its nodes, the rigid parts and hinges of bends, springs."""
    s, n = scene.system, len(scene.system.labels)
    beams = np.flatnonzero(s.kind == STRAIGHT)
    has_beam = np.zeros(n, bool)
    has_beam[s.ends[beams].ravel()] = True
    bodies = [
        Body(s.xyz[i], i + 1, i + 1 if has_beam[i] else n + i + 1, 4 if has_beam[i] else 1)
        for i in range(n)
    ]
    index = {label: i for i, label in enumerate(s.labels)} | s.alias
    cards = [(index[c.label], -1 if c.cnode is None else index[c.cnode]) for c in s.cards]
    ratio = modulus_ratio(scene, case)
    deck = Deck(scene, ratio, bodies, cards, last=2 * n, elements=2 * len(beams))
    for e in np.flatnonzero((s.kind != STRAIGHT) & (s.kind != SPRING)).tolist():
        _chain(deck, e)
    for e in np.flatnonzero(s.kind == SPRING).tolist():
        a, b = (bodies[i] for i in s.ends[e].tolist())
        deck.links[e] = _six(deck, a, b, 0.5 * (a.xyz + b.xyz), s.axes[e], s.spring[e])
    return deck


def _chain(deck: Deck, e: int) -> None:
    found = deck.chains[e] = chain(deck.scene.system, e)
    first, last = (deck.bodies[i] for i in deck.scene.system.ends[e].tolist())
    between = [Body(xyz, deck.node(xyz), deck.node(xyz), 1) for xyz in found.xyz[:-1]]
    parts = deck.parts[e] = [first, *between, last]
    deck.hinges[e] = [
        _six(deck, a, b, xyz, axes, deck.ratio[e] * k)
        for a, b, xyz, axes, k in zip(
            parts[:-1], parts[1:], found.xyz, found.axes, found.k, strict=True
        )
    ]


def _six(deck: Deck, a: Body, b: Body, at: F8, axes: F8, k: F8) -> list[int]:
    """Springs between two bodies at a point; their auxiliary nodes, 0 where there is none."""
    nodes = []
    for i, stiffness in enumerate(k.tolist()):
        if stiffness == 0.0:
            nodes.append(0)
            continue
        nodes.append(_along(deck, a, b, at, axes[i % 3], turns=i >= 3))
        deck.spring(stiffness, nodes[-1])
    return nodes


def _along(deck: Deck, a: Body | None, b: Body, at: F8, way: F8, *, turns: bool) -> int:
    """Auxiliary node whose freedom 1 is the movement of b against a (or ground) along `way`."""
    node = deck.node(at)
    deck.hidden.append(node)
    terms: list[Term] = [(node, 1, -1.0)]
    for body, sign in ((b, 1.0), (a, -1.0)):
        if body is None:
            continue
        if turns:
            terms += _terms(body.turn, body.first, sign * way)
        else:
            terms += _terms(body.node, 1, sign * way)
            terms += _terms(body.turn, body.first, sign * np.cross(at - body.xyz, way))
    deck.equations.append(terms)
    return node


def _terms(node: int, first: int, factors: F8) -> Iterator[Term]:
    for i, x in enumerate(factors.tolist()):
        if abs(x) > 1e-15:
            yield node, first + i, x


def add_supports(deck: Deck, found: Stand) -> None:
    """Add the springs of a case's supports that no case before had."""
    for key, hold in zip(hold_keys(found.holds), found.holds, strict=True):
        if key not in deck.grounds:
            deck.grounds[key] = _grounded(deck, hold.card, hold.normal, hold.k, turns=hold.turns)
    for rub in found.rubs:
        for way in rub.basis:
            if (rub.slider, way) not in deck.grounds:
                deck.grounds[rub.slider, way] = _grounded(deck, rub.card, way, rub.kf)


def hold_keys(holds: Sequence[Hold]) -> list[Key]:
    """Tell which springs of supports are the same in all cases; equal ones are counted."""
    seen: Counter[Key] = Counter()
    keys: list[Key] = []
    for hold in holds:
        form = hold.card, hold.turns, hold.normal, hold.k
        keys.append((*form, seen[form]))
        seen[form] += 1
    return keys


def _grounded(
    deck: Deck, card: int, way: Sequence[float], k: float, *, turns: bool = False
) -> Ground:
    """Springs of twice the stiffness, one after the other, at the node of a card."""
    node, other = deck.cards[card]
    body = deck.bodies[node]
    pair = None if other < 0 else deck.bodies[other]
    if pair is not None:  # contact is between the nodes, without a lever
        pair = Body(body.xyz, pair.node, pair.turn, pair.first)
    moving = _along(deck, pair, body, body.xyz, np.array(way), turns=turns)
    ground = Ground(deck.node(body.xyz), deck.node(body.xyz), moving, 2.0 * k)
    deck.hidden += [ground.node, ground.middle]
    deck.spring(ground.k, moving, ground.middle)
    deck.spring(ground.k, ground.middle, ground.node)
    return ground
