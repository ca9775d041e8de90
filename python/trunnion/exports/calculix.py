"""The CalculiX input of a job: beams of type U1, springs on equations, one step a case.

CalculiX makes solids of its ordinary beams, which are another model of the pipe; its element U1
is a beam.  What U1 does not have is written with *EQUATION: a spring acts on an auxiliary freedom
that is a linear form of the nodes' own, so it may have any direction, hold a rotation, or stand
half way between two nodes.  Rotations are those of U1 where one ends at the node, else freedoms 1
to 3 of an auxiliary node.  Contacts are held as Trunnion found them: the ground of a closed
support is fixed, that of an open one is free.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import sqrt
from typing import TYPE_CHECKING

import numpy as np

from trunnion.arrays import F8, SPRING, STRAIGHT, CaseResult, System
from trunnion.exports.hinges import chain
from trunnion.exports.scene import Hold, Scene, Stand, absent, modulus_ratio, stand

if TYPE_CHECKING:
    from trunnion.exports import Job

Term = tuple[int, int, float]  # node, freedom, coefficient
STIFF_SHEAR = 1e9  # shear coefficient of a beam that is rigid in shear


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
    nodes: list[tuple[int, F8]] = field(default_factory=list)
    last: int = 0
    elements: int = 0
    equations: list[list[Term]] = field(default_factory=list)
    springs: dict[float, list[tuple[int, ...]]] = field(default_factory=dict)
    hidden: list[int] = field(default_factory=list)  # auxiliary nodes of which one freedom is used
    parts: dict[int, list[Body]] = field(default_factory=dict)  # chain -> its rigid parts
    hinges: dict[int, list[list[int]]] = field(default_factory=dict)  # and the springs of each
    links: dict[int, list[int]] = field(default_factory=dict)
    grounds: dict[tuple[object, ...], Ground] = field(default_factory=dict)

    def node(self, xyz: F8) -> int:
        """Add an auxiliary node."""
        self.last += 1
        self.nodes.append((self.last, xyz))
        return self.last

    def spring(self, k: float, *ends: int) -> None:
        """Add a spring on freedom 1 of one auxiliary node, or between those of two."""
        self.elements += 1
        self.springs.setdefault(k, []).append((self.elements, *ends))


def files(job: "Job", stem: str) -> dict[str, bytes]:
    """Write one input file for all cases of a modulus."""
    made = {}
    for name, cases in groups(job.scene, stem).items():
        lines = [*_header(job, cases), *_model(job.scene, cases)]
        made[f"{name}.inp"] = ("\n".join(lines) + "\n").encode("ascii")
    return made


def groups(scene: Scene, stem: str) -> dict[str, list[CaseResult]]:
    """Cases by the file they go to: those with the same moduli share one."""
    found: dict[bytes, list[CaseResult]] = {}
    for case in scene.cases:
        found.setdefault(modulus_ratio(scene, case).tobytes(), []).append(case)
    names = [f"{stem}_calculix{'' if i == 0 else f'_{i + 1}'}" for i in range(len(found))]
    return dict(zip(names, found.values(), strict=True))


def _header(job: "Job", cases: Sequence[CaseResult]) -> Iterator[str]:
    from trunnion._version import VERSION

    yield f"** {_plain(job.title or job.source)}: a piping job for CalculiX."
    yield f"** Written by Trunnion {VERSION} from {_plain(job.source)}."
    yield "** From Trunnion are geometry, section properties, flexibility factors of bends, loads,"
    yield "** free strains as forces, and which supports are open, closed, stick or slide."
    yield "** From CalculiX are the stiffness of the beams, the equations and their solution."
    yield "** The shear coefficients make the stiffness of U1 that of Timoshenko's beam, from which"
    yield "** the element departs: it has (1 + f)/(1 - f)^2 where 1/(1 + f) belongs."
    for text in (*job.notes, *(f"LEFT OUT: {problem.text}" for problem in job.left_out)):
        yield f"** {_plain(text)}"
    for i, case in enumerate(cases, 1):
        yield f"** step {i}: {_plain(case.name)} = {_plain(case.text)}"


def _plain(text: str) -> str:
    """One printable line; a comment ends with it."""
    return ascii(text)[1:-1]


# ------------------------------------------------------------------ the model
def _model(scene: Scene, cases: Sequence[CaseResult]) -> Iterator[str]:
    deck = build(scene, cases[0])
    stands = [stand(case) for case in cases]
    for found in stands:
        supports(deck, found)
    steps = [list(_step(deck, case, found)) for case, found in zip(cases, stands, strict=True)]
    s = scene.system
    yield "*NODE, NSET=PIPES"
    yield from (f"{i}, {_numbers(xyz)}" for i, xyz in enumerate(s.xyz.tolist(), 1))
    turns = [body for body in deck.bodies if body.turn != body.node]
    yield "*NODE, NSET=TURNS" if turns else "*NODE"
    yield from (f"{body.turn}, {_numbers(body.xyz.tolist())}" for body in turns)
    yield "*NODE"
    yield from (f"{i}, {_numbers(xyz)}" for i, xyz in deck.nodes)
    yield from _beams(deck)
    for i, (k, springs) in enumerate(deck.springs.items(), 1):
        for kind, count in (("SPRING1", 2), ("SPRING2", 3)):
            rows = [row for row in springs if len(row) == count]
            if rows:
                name = f"K{i}{'AB'[count - 2]}"
                yield f"*ELEMENT, TYPE={kind}, ELSET={name}"
                yield from (", ".join(map(str, row)) for row in rows)
                yield from (f"*SPRING, ELSET={name}", "1" if count == 2 else "1, 1", _number(k))
    yield from _sets("HIDDEN", deck.hidden)
    yield from _sets("GROUNDS", [ground.node for ground in deck.grounds.values()])
    for terms in deck.equations:
        yield from ("*EQUATION", str(len(terms)))
        for at in range(0, len(terms), 4):
            row = terms[at : at + 4]
            yield ", ".join(f"{node}, {freedom}, {_number(x)}" for node, freedom, x in row)
    for step in steps:
        yield from step


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
    deck = Deck(scene, modulus_ratio(scene, case), bodies, last=2 * n, elements=2 * len(beams))
    for e in np.flatnonzero((s.kind != STRAIGHT) & (s.kind != SPRING)).tolist():
        _chain(deck, e)
    for e in np.flatnonzero(s.kind == SPRING).tolist():
        a, b = (bodies[i] for i in s.ends[e].tolist())
        deck.links[e] = _six(deck, a, b, 0.5 * (a.xyz + b.xyz), s.axes[e], s.spring[e])
    return deck


def _chain(deck: Deck, e: int) -> None:
    s, found = deck.scene.system, chain(deck.scene.system, e)
    first, last = (deck.bodies[i] for i in s.ends[e].tolist())
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


def supports(deck: Deck, found: Stand) -> None:
    """Add the springs of a case's supports that no case before had."""
    for hold in found.holds:
        key = hold_key(hold)
        if key not in deck.grounds:
            deck.grounds[key] = _grounded(deck, hold.card, hold.normal, hold.k, turns=hold.turns)
    for rub in found.rubs:
        for way in rub.basis:
            if (rub.card, way, rub.kf) not in deck.grounds:
                deck.grounds[rub.card, way, rub.kf] = _grounded(deck, rub.card, way, rub.kf)


def hold_key(hold: Hold) -> tuple[object, ...]:
    """What makes two springs of supports the same in all cases."""
    return hold.card, hold.turns, hold.normal, hold.k


def _grounded(
    deck: Deck, card: int, way: Sequence[float], k: float, *, turns: bool = False
) -> Ground:
    """Springs of twice the stiffness, one after the other, at the node of a card."""
    node, other = card_nodes(deck.scene.system, card)
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


def card_nodes(s: System, card: int) -> tuple[int, int]:
    """Give node and other node (-1: ground) of a support card."""
    index = {label: i for i, label in enumerate(s.labels)} | s.alias
    found = s.cards[card]
    return index[found.label], -1 if found.cnode is None else index[found.cnode]


def _beams(deck: Deck) -> Iterator[str]:
    """U1 elements, two a pipe: each has half the area and bends in one plane only.

    In the other plane U1 has a wrong sign (CalculiX 2.20: the force at the first end under a
    rotation of the second), here multiplied by zero; its twist is that of half a round pipe.
    """
    s, scene = deck.scene.system, deck.scene
    yield "*USER ELEMENT, TYPE=U1, NODES=2, INTEGRATION POINTS=2, MAXDOF=6"
    sections: dict[tuple[float, ...], list[tuple[int, int, int]]] = {}
    materials: dict[tuple[float, float], int] = {}
    tag = 0
    for e in np.flatnonzero(s.kind == STRAIGHT).tolist():
        young, shear = (float(m[e]) * float(deck.ratio[e]) for m in scene.moduli)
        material = materials.setdefault((young, 0.5 * young / shear - 1.0), len(materials) + 1)
        ea, _, ei, gas = (deck.ratio[e] * s.rigidity[e]).tolist()
        half, second, length = 0.5 * ea / young, ei / young, float(s.length[e])
        factor = shear_coefficient(ei, shear * half, gas, length)
        a, b = (s.ends[e] + 1).tolist()
        for way in s.axes[e, 1:].tolist():
            tag += 1
            form = (float(material), half, second, factor, *way)
            sections.setdefault(form, []).append((tag, a, b))
    for i, elements in enumerate(sections.values(), 1):
        yield f"*ELEMENT, TYPE=U1, ELSET=S{i}"
        yield from (", ".join(map(str, row)) for row in elements)
    for (young, nu), i in materials.items():
        yield from (f"*MATERIAL, NAME=M{i}", "*ELASTIC", _numbers((young, nu)))
    for i, (which, half, second, factor, *way) in enumerate(sections, 1):
        yield f"*BEAM SECTION, ELSET=S{i}, MATERIAL=M{which:g}, SECTION=GENERAL"
        yield _numbers((half, second, 0.0, 0.0, factor))
        yield _numbers(way)


def shear_coefficient(ei: float, ga: float, gas: float, length: float) -> float:
    """Coefficient with which U1 is Timoshenko's beam.

    U1 (Luo, Adv. Theor. Appl. Mech. 1, 2008, as coded in CalculiX) multiplies 12 EI/L3 by
    (1 + f)/(1 - f)^2, f = 12 EI/(kappa G A L2), and its other terms agree with that; Timoshenko's
    factor is 1/(1 + F), F = 12 EI/(GAs L2).  They are the same for the smaller root of
    f^2 - (3 + F) f - F = 0, which is negative.
    """
    if not gas > 0.0:
        return STIFF_SHEAR
    true = 12.0 * ei / (gas * length**2)
    f = -2.0 * true / (3.0 + true + sqrt((3.0 + true) ** 2 + 4.0 * true))
    return 12.0 * ei / (f * ga * length**2)


# ------------------------------------------------------------------ the steps
def _step(deck: Deck, case: CaseResult, found: Stand) -> Iterator[str]:
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
    yield from (f"{node}, {freedom}, {_number(x)}" for (node, freedom), x in total.items())
    yield from ("*NODE PRINT, NSET=PIPES", "U")
    if any(body.turn != body.node for body in deck.bodies):
        yield from ("*NODE PRINT, NSET=TURNS", "U")
    yield from ("*NODE PRINT, NSET=GROUNDS", "RF", "*END STEP")


def _offsets(deck: Deck, moved: Mapping[tuple[object, ...], float]) -> Iterator[Term]:
    """Pairs of forces that move the zeros of springs."""
    for key, x in moved.items():
        ground = deck.grounds[key]
        if x:
            yield from ((ground.moving, 1, ground.k * x), (ground.middle, 1, -ground.k * x))


def _moved(case: CaseResult, found: Stand) -> dict[tuple[object, ...], float]:
    """Zero of every spring that carries; the grounds of the others are free."""
    assert case.loads is not None
    base = case.loads.base
    moved: dict[tuple[object, ...], float] = {}
    for hold in found.holds:
        own = base[hold.card, 3:] if hold.turns else base[hold.card, :3]
        at = float(np.dot(hold.normal, own))
        gap = {-1: -hold.minus, 1: hold.plus, 2: 0.0}
        if hold.closed:
            moved[hold_key(hold)] = at + gap[hold.closed]
    for rub in found.rubs:
        for way in rub.basis if rub.mode == "stick" else ():
            at = float(np.dot(way, base[rub.card, :3] + np.array(rub.datum)))
            moved[rub.card, way, rub.kf] = at
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
        node, other = card_nodes(s, card)
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
    for e, parts in deck.parts.items():
        found_chain = chain(s, e)
        shapes = [loads.dist[e], *(loads.vary[e] if len(loads.vary) else ())]
        for body, segment in zip(parts, found_chain.segment, strict=True):
            for q, (length, *lever) in zip(shapes, segment, strict=False):
                yield from _on(body, np.concatenate((length * q, np.cross(lever, q))))
        give = np.zeros((len(found_chain.k), 6))
        give[:, :3] = loads.strain[e] * found_chain.free
        give[:, 5] = loads.curvature[e] * found_chain.length
        pushes = deck.ratio[e] * found_chain.k * give
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


def _sets(name: str, nodes: Sequence[int]) -> Iterator[str]:
    if nodes:
        yield f"*NSET, NSET={name}"
        yield from (f"{node}," for node in nodes)


def _numbers(values: Iterable[float]) -> str:
    return ", ".join(map(_number, values))


def _number(x: float) -> str:
    """A number in at most 20 characters, all that CalculiX reads."""
    return f"{x:.12e}"
