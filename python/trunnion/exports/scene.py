"""A solved job as other programs need it: plain rows of elements, supports and loads, in SI.

Contact states stay open to be found wherever the other program has a law for them.  Friction, and
gaps all round a vertical pipe, are held as the answer left them.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from trunnion.arrays import BOTH, ENGAGED, F8, OPEN, SLIP, SPRING, STICK, CaseResult, System
from trunnion.frozen import frozen
from trunnion.results.supports import card_ids
from trunnion.results.tables import element_ids

MODES = {OPEN: "open", STICK: "stick", SLIP: "slip"}


class Hold(NamedTuple):
    """One spring of a support: it carries where normal . movement is below -minus or above plus.

    `closed` is what the answer says: the side that carries, 0 open, 2 both.
    """

    card: int
    turns: bool
    normal: tuple[float, float, float]
    k: float
    minus: float
    plus: float
    closed: int


class Rub(NamedTuple):
    """Friction of a support as it was found; `holds` are the rows of `Hold` that press on it."""

    slider: int
    card: int
    mode: str
    mu: float
    kf: float
    basis: tuple[tuple[float, ...], ...]
    datum: tuple[float, ...]
    force: tuple[float, ...]
    holds: tuple[int, ...]


class Ring(NamedTuple):
    """A gap all round a pipe, and whether it is closed."""

    card: int
    normals: tuple[tuple[float, ...], ...]
    gap: float
    closed: bool


@frozen(eq=False)
class Stand:
    """The supports of one case."""

    holds: tuple[Hold, ...]
    rubs: tuple[Rub, ...]
    rings: tuple[Ring, ...]

    @property
    def held(self) -> int:
        """Number of states taken from the answer."""
        return len(self.rubs) + len(self.rings)


@frozen(eq=False)
class Scene:
    """A job: its pipe, and the cases that are carried over.

    moduli : (n_elem,) E and G [Pa] of the material of every element, cold; 1 for springs.
    steps : in how many each case loads the pipe where it lies; 0: it begins after another.
    """

    system: System
    moduli: tuple[F8, F8]
    cases: tuple[CaseResult, ...]
    steps: Mapping[str, int]
    elements: tuple[str, ...]
    cards: tuple[str, ...]


def build_scene(
    system: System,
    moduli: tuple[F8, F8],
    cases: Sequence[CaseResult],
    steps: Mapping[str, int],
) -> Scene:
    """Name what a job consists of."""
    names = element_ids(system.parts), card_ids(system.cards)
    return Scene(system, moduli, tuple(cases), steps, *names)


def modulus_ratio(scene: Scene, case: CaseResult) -> F8:
    """(n_elem,) modulus in a case over the cold one; 1 for springs."""
    cold, own = scene.system.rigidity[:, 0], case.system.rigidity[:, 0]
    ratio: F8 = np.divide(own, cold, out=np.ones_like(cold), where=cold > 0.0)
    return ratio


def stand(case: CaseResult) -> Stand:
    """Give the supports of a case; friction and round gaps as its answer has them."""
    c = case.system.contacts
    holds: list[Hold] = []
    rings: list[Ring] = []
    rows: list[list[int]] = []  # of each contact
    for i, k in enumerate(c.k.tolist()):
        rows.append([])
        if k == 0.0:
            continue
        card, turns = int(c.card[i]), bool(c.rotational[i])
        minus, plus = c.gap[i].tolist()
        closed = 2 if c.two_way[i] or case.state is None else int(case.state.side[i])
        if c.dim[i] == 2 and not c.two_way[i]:
            ring, found = _ring(case, i)
            rings.append(ring)
        else:
            found = [
                Hold(card, turns, _vector(n), k, minus, plus, closed)
                for n in c.normal[i, : c.dim[i]]
            ]
        rows[i] = list(range(len(holds), len(holds) + len(found)))
        holds += found
    return Stand(tuple(holds), tuple(_rubs(case, rows)), tuple(rings))


def _ring(case: CaseResult, i: int) -> tuple[Ring, list[Hold]]:
    """A gap all round: a spring in the direction in which the answer has it closed."""
    c, state = case.system.contacts, case.state
    assert state is not None
    card, gap = int(c.card[i]), float(c.gap[i, 0])
    size = float(np.linalg.norm(state.reaction[i]))
    closed = int(state.side[i]) == BOTH and size > 0.0
    ring = Ring(card, tuple(_vector(n) for n in c.normal[i]), gap, closed)
    if not closed:
        return ring, []
    outwards = _vector(-state.reaction[i] / size)
    return ring, [Hold(card, False, outwards, float(c.k[i]), np.inf, gap, 1)]


def _rubs(case: CaseResult, rows: Sequence[Sequence[int]]) -> list[Rub]:
    s, state = case.system.sliders, case.state
    if not len(s.mu):
        return []
    assert state is not None
    assert case.loads is not None
    found = []
    for i, mode in enumerate(state.mode.tolist()):
        mu = float(s.mu[i]) * case.loads.mux
        if mode == ENGAGED or mu == 0.0:
            continue
        pressing = s.contact[s.first[i] : s.first[i + 1]].tolist()
        basis = tuple(_vector(way) for way in s.basis[i] if way.any())
        found.append(
            Rub(
                i,
                int(s.card[i]),
                MODES[mode],
                mu,
                float(s.kf[i]),
                basis,
                _vector(state.datum[i]),
                _vector(state.friction[i]),
                tuple(row for contact in pressing for row in rows[contact]),
            )
        )
    return found


def _vector(x: F8) -> tuple[float, float, float]:
    a, b, c = x.tolist()
    return a, b, c


def absent(scene: Scene, holds: Sequence[Hold]) -> list[tuple[int, int]]:
    """Freedoms (node, 0 to 5) that nothing resists: of nodes where only springs stand."""
    s = scene.system
    pipes = s.kind != SPRING
    bare = np.ones(len(s.labels), bool)
    bare[s.ends[pipes].ravel()] = False
    stiff = np.zeros((len(s.labels), 6))
    for e in np.flatnonzero(~pipes).tolist():
        arm = 0.5 * (s.xyz[s.ends[e, 1]] - s.xyz[s.ends[e, 0]])
        for node, d in zip(s.ends[e].tolist(), (arm, -arm), strict=True):
            lever = np.array([[0, d[2], -d[1]], [-d[2], 0, d[0]], [d[1], -d[0], 0]])
            turn = s.axes[e]
            reach = np.block([[turn, turn @ lever], [np.zeros((3, 3)), turn]])
            stiff[node] += s.spring[e] @ reach**2
    node = {card: int(n) for card, n in zip(s.contacts.card, s.contacts.node, strict=True)}
    other = {card: int(n) for card, n in zip(s.contacts.card, s.contacts.cnode, strict=True)}
    for hold in holds:
        part = slice(3, 6) if hold.turns else slice(0, 3)
        for at in (node.get(hold.card, -1), other.get(hold.card, -1)):
            if at >= 0:
                stiff[at, part] += hold.k * np.array(hold.normal) ** 2
    return [(int(n), int(i)) for n, i in np.argwhere((stiff == 0.0) & bare[:, None])]
