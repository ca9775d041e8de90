"""Cards of one case: what is fixed, every force, what is printed.

Contacts are held as Trunnion found them: the ground of a closed support is fixed, that of an open
one is free.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from trunnion.arrays import F8, STRAIGHT, CaseResult
from trunnion.exports.calculix.model import number
from trunnion.exports.calculix.numbering import Body, Deck, Key, Term, hold_keys
from trunnion.exports.scene import Stand, absent


def step_cards(deck: Deck, case: CaseResult, found: Stand) -> Iterator[str]:
    """Cards of one case."""
    yield from ("*STEP", "*STATIC", "*BOUNDARY, OP=NEW", "HIDDEN, 2, 3")
    for node, freedom in absent(deck.scene, found.holds):
        body = deck.bodies[node]
        at = freedom + 1 if freedom < 3 else body.first + freedom - 3
        yield f"{body.node if freedom < 3 else body.turn}, {at}, {at}"
    moved = _moved(case, found)
    yield from (f"{ground.node}, 1, 1" for key, ground in deck.grounds.items() if key in moved)
    yield "*CLOAD, OP=NEW"
    total: dict[tuple[int, int], float] = {(1, 1): 0.0}
    for node, freedom, x in (*_loads(deck, case, found), *_offsets(deck, moved)):
        total[node, freedom] = total.get((node, freedom), 0.0) + x
    yield from (f"{node}, {freedom}, {number(x)}" for (node, freedom), x in total.items())
    yield from ("*NODE PRINT, NSET=PIPES", "U")
    if any(body.turn != body.node for body in deck.bodies):
        yield from ("*NODE PRINT, NSET=TURNS", "U")
    yield from ("*NODE PRINT, NSET=GROUNDS", "RF", "*END STEP")


def _offsets(deck: Deck, moved: Mapping[Key, float]) -> Iterator[Term]:
    """Pairs of forces that move the zeros of springs."""
    for key, x in moved.items():
        ground = deck.grounds[key]
        if x:
            yield from ((ground.moving, 1, ground.k * x), (ground.middle, 1, -ground.k * x))


def _moved(case: CaseResult, found: Stand) -> dict[Key, float]:
    """Zero of every spring that carries; the grounds of the others are free."""
    assert case.loads is not None
    base = case.loads.base
    moved: dict[Key, float] = {}
    for key, hold in zip(hold_keys(found.holds), found.holds, strict=True):
        own = base[hold.card, 3:] if hold.turns else base[hold.card, :3]
        at = float(np.dot(hold.normal, own))
        gap = {-1: -hold.minus, 1: hold.plus, 2: 0.0}
        if hold.closed:
            moved[key] = at + gap[hold.closed]
    for rub in found.rubs:
        for way in rub.basis if rub.mode == "stick" else ():
            at = float(np.dot(way, base[rub.card, :3] + np.array(rub.datum)))
            moved[rub.slider, way] = at
    return moved


def _loads(deck: Deck, case: CaseResult, found: Stand) -> Iterator[Term]:
    """Every force and moment of a case."""
    s, loads = deck.scene.system, case.loads
    assert loads is not None
    for body, six in zip(deck.bodies, loads.nodal, strict=True):
        yield from _on(body, six)
    for card, push in [
        *((i, x * s.up) for i, x in enumerate(loads.preload.tolist()) if x),
        *((rub.card, np.array(rub.force)) for rub in found.rubs if rub.mode == "slip"),
    ]:
        node, other = deck.cards[card]
        yield from _on(deck.bodies[node], np.concatenate((push, np.zeros(3))))
        if other >= 0:
            yield from _on(deck.bodies[other], np.concatenate((-push, np.zeros(3))))
    for e in np.flatnonzero(s.kind == STRAIGHT).tolist():
        a, b = (deck.bodies[i] for i in s.ends[e].tolist())
        half = 0.5 * s.length[e] * loads.dist[e]
        lever = np.cross(s.axes[e, 0], half) * s.length[e] / 6.0
        pull = deck.ratio[e] * s.rigidity[e, 0] * loads.strain[e] * s.axes[e, 0]
        yield from _on(a, np.concatenate((half - pull, lever)))
        yield from _on(b, np.concatenate((half + pull, -lever)))
    for e, chain in deck.chains.items():
        shapes = [loads.dist[e], *(loads.vary[e] if len(loads.vary) else ())]
        for body, segment in zip(deck.parts[e], chain.segment, strict=True):
            for q, (length, *lever) in zip(shapes, segment, strict=False):
                yield from _on(body, np.concatenate((length * q, np.cross(lever, q))))
        give = np.zeros((len(chain.k), 6))
        give[:, :3] = loads.strain[e] * chain.free
        give[:, 5] = loads.curvature[e] * chain.length
        pushes = deck.ratio[e] * chain.k * give
        for nodes, six in zip(deck.hinges[e], pushes.tolist(), strict=True):
            yield from ((node, 1, x) for node, x in zip(nodes, six, strict=True) if x)
    for e, nodes in deck.links.items():
        growth = float(s.spring[e, 0] * loads.strain[e] * s.length[e])
        if growth:
            yield nodes[0], 1, growth


def _on(body: Body, six: F8) -> Iterator[Term]:
    for i, x in enumerate(six.tolist()):
        if x:
            yield (body.node, i + 1, x) if i < 3 else (body.turn, body.first + i - 3, x)
