"""Support cards become contacts (normals with two sides) and sliders (friction)."""

from dataclasses import dataclass, field
from math import cos, inf, radians
from typing import NamedTuple

import numpy as np

from trunnion.arrays import Card, Contacts, Part, Sliders
from trunnion.errors import Problem
from trunnion.frozen import frozen
from trunnion.model import Direction, Model, Settings, Support
from trunnion.system.checks import refuse
from trunnion.system.elements import Elements
from trunnion.system.tangents import PipeAxes
from trunnion.system.vectors import AXES, Vec, complement, cross, dot, forward, unit, upright

VERTICAL = cos(radians(5.0))  # a pipe within 5 degrees of vertical is guided all round
WORDS = ("X", "Y", "Z", "RX", "RY", "RZ")
ZERO: Vec = (0.0, 0.0, 0.0)


class Row(NamedTuple):
    """One contact, fields as in arrays.Contacts; mu and kf (0: none) belong to its friction.

    It does not say where it stands: supports that say the same share their rows.
    """

    rotational: bool
    normals: tuple[Vec, ...]
    gap: tuple[float, float]
    k: float
    penalty: bool
    word: str
    mu: float = 0.0
    kf: float = 0.0


class Slide(NamedTuple):
    """One slider, fields as in arrays.Sliders."""

    card: int
    basis: list[Vec]
    mu: float
    kf: float
    contacts: list[int]


@frozen
class Supports:
    """What stands on the nodes, in the deck's order."""

    contacts: Contacts
    sliders: Sliders
    cards: tuple[Card, ...]
    snubbers: Contacts


@dataclass(slots=True)
class _Rows:
    """Contacts in order: what they are, and the card of each."""

    rows: list[Row] = field(default_factory=list)
    card: list[int] = field(default_factory=list)

    def add(self, rows: list[Row], card: int) -> None:
        self.rows += rows
        self.card += [card] * len(rows)


@dataclass(slots=True)
class _Lists:
    node: list[int] = field(default_factory=list)  # of each card
    cnode: list[int] = field(default_factory=list)
    cards: list[Card] = field(default_factory=list)
    contacts: _Rows = field(default_factory=_Rows)
    snubbers: _Rows = field(default_factory=_Rows)
    slides: list[Slide] = field(default_factory=list)
    planes: dict[tuple[Vec, ...], list[Vec]] = field(default_factory=dict)
    words: dict[int, Row] = field(default_factory=dict)  # by identity of a Direction

    def card(self, card: Card, node: int, cnode: int) -> int:
        self.cards.append(card)
        self.node.append(node)
        self.cnode.append(cnode)
        return len(self.cards) - 1

    def plane(self, normals: tuple[Vec, ...]) -> list[Vec]:
        """Directions normal to all `normals`; most supports of a model share theirs."""
        if normals not in self.planes:
            self.planes[normals] = complement(list(normals))
        return self.planes[normals]


def build_contacts(
    model: Model, elements: Elements, parts: tuple[Part, ...], index: dict[str, int], up: Vec
) -> Supports:
    """Give the contacts and sliders of all supports; raise all problems at once."""
    lists = _Lists()
    problems: list[Problem] = []
    along = PipeAxes(model, elements, parts, index, up)
    for s in model.supports:
        cnode = -1 if s.cnode is None else index[s.cnode]
        card = lists.card(
            Card(s.node, s.cnode, s.name or card_name(s), s.kind, s.place.line),
            index[s.node],
            cnode,
        )
        if s.kind == "snubber":
            lists.snubbers.add(_snubber(s, model.settings), card)
        elif s.kind == "support":
            try:
                rows = _support(s, along, lists.words, model.settings)
            except ValueError as error:
                problems.append(Problem(s.place, f"SUPPORT {s.node}: {error}"))
                continue
            _add_slides(s, card, rows, model.settings, lists)
            lists.contacts.add(rows, card)
        else:
            lists.contacts.add(_fixed(s, model.settings, up), card)
    _held_nodes(model, index, lists)
    refuse(problems)
    return Supports(
        _contacts(lists, lists.contacts),
        _sliders(lists),
        tuple(lists.cards),
        _contacts(lists, lists.snubbers),
    )


def card_name(s: Support) -> str:
    """Name a card by its node and words: "20 +Y GUIDE", "10 ANCHOR"."""
    words = [d.word for d in s.directions] if s.kind == "support" else [s.kind.upper()]
    if s.kind == "snubber":
        words += [d.word for d in s.directions]
    return " ".join([s.node, *words])


def _support(s: Support, along: PipeAxes, words: dict[int, Row], settings: Settings) -> list[Row]:
    """Give the contacts of a SUPPORT card; raise ValueError for what cannot be."""
    rows: list[Row] = []
    for d in s.directions:
        row = words.get(id(d))
        if row is None:
            row = words[id(d)] = _word(d, settings)
        if not row.normals:
            try:
                normals = _pipe_normals(d.word, along.at(s.node, d.along), along.up)
            except ValueError as error:
                raise ValueError(f"{d.word}: {error}") from error
            if len(normals) == 2 and d.gap[0] != d.gap[1]:
                raise ValueError(f"{d.word}: round a vertical pipe there is one radial gap")
            row = row._replace(normals=normals)
        rows.append(row)
    return rows


def _snubber(s: Support, settings: Settings) -> list[Row]:
    """Two-way contacts that hold only where snubbers are locked."""
    rows = []
    for d in s.directions:
        normal = AXES[WORDS.index(d.word)] if d.vector is None else unit(d.vector)
        own = s.k if d.k is None else d.k
        k = settings.k if own is None else own
        rows.append(Row(False, (normal,), (0.0, 0.0), k, own is None, d.word))
    return rows


def _word(d: Direction, settings: Settings) -> Row:
    """Give the contact of a direction word, without normals where they depend on the pipe."""
    word = d.word
    bare = word[1:] if word[:1] in ("+", "-") else word
    rotational = bare in WORDS[3:]
    normals: tuple[Vec, ...] = ()
    if d.vector is not None:
        normals = (unit(d.vector),)
    elif bare in WORDS:
        normals = (AXES[WORDS.index(bare) % 3],)
    elif word not in ("GUIDE", "LIMIT"):
        raise ValueError(f"direction {word} is not one of X +X -X ... RX ... GUIDE LIMIT")
    gap = d.gap
    if word.startswith("+"):
        gap = (gap[0], inf)
    elif word.startswith("-"):
        gap = (inf, gap[1])
    k = (settings.kr if rotational else settings.k) if d.k is None else d.k
    mu = 0.0 if rotational else settings.mu if d.mu is None else d.mu
    kf = settings.kf if d.kf is None else d.kf
    return Row(rotational, normals, gap, k, d.k is None, word, mu, kf)


def _pipe_normals(word: str, axis: Vec, up: Vec) -> tuple[Vec, ...]:
    """Give the normals of a GUIDE or LIMIT on a pipe along `axis`."""
    if word == "LIMIT":
        return (forward(axis),)
    if abs(dot(axis, up)) >= VERTICAL:
        return tuple(e for e in AXES if dot(e, up) == 0.0)
    return (forward(unit(cross(up, axis))),)


def _fixed(s: Support, settings: Settings, up: Vec) -> list[Row]:
    """Two-way contacts without friction: anchors, hangers, springs to ground."""
    gap = (0.0, 0.0)
    if s.kind == "anchor":
        own = (s.k, s.kr)
        k = [
            given if x is None else x
            for x, given in zip(own, (settings.k, settings.kr), strict=True)
        ]
        return [
            Row(i >= 3, (AXES[i % 3],), gap, k[i // 3], own[i // 3] is None, WORDS[i])
            for i in range(6)
        ]
    if s.kind == "hanger":
        word = next(w for w, e in zip(WORDS, AXES, strict=False) if e == up)
        return [Row(False, (up,), gap, s.k or 0.0, False, word)]
    axes = AXES if s.axis is None else upright(unit(s.axis), up)
    return [
        Row(i >= 3, (axes[i % 3],), gap, k, False, "K" + WORDS[i])
        for i, k in enumerate(s.ks or ())
        if k > 0.0
    ]


def _add_slides(s: Support, card: int, rows: list[Row], settings: Settings, lists: _Lists) -> None:
    """Give a card its friction: a slider a contact, or one for the card (RESULTANT)."""
    first = len(lists.contacts.rows)
    law = settings.friction
    for d in s.directions:
        if d.friction is not None:
            law = d.friction
            break
    if law == "CONTACT":
        for i, row in enumerate(rows, start=first):
            if row.mu > 0.0:
                basis = lists.plane(row.normals)
                lists.slides.append(Slide(card, basis, row.mu, row.kf, [i]))
        return
    pressing = [i for i, row in enumerate(rows) if not row.rotational]
    if not pressing:
        return
    rough = max((rows[i] for i in pressing), key=lambda row: row.mu)
    touching = [i for i in pressing if 0.0 in rows[i].gap] or pressing
    basis = lists.plane(tuple(n for i in touching for n in rows[i].normals))
    if rough.mu > 0.0 and basis:
        contacts = [first + i for i in pressing]
        lists.slides.append(Slide(card, basis, rough.mu, rough.kf, contacts))


def _held_nodes(model: Model, index: dict[str, int], lists: _Lists) -> None:
    """Imposed displacements where no support stands on ground: the node itself is held."""
    stands = [
        c < 0 and card.kind != "snubber" for c, card in zip(lists.cnode, lists.cards, strict=True)
    ]
    grounded = {n for n, stand in zip(lists.node, stands, strict=True) if stand}
    given: dict[int, list[int]] = {}
    first: dict[int, Card] = {}
    for d in model.displacements:
        node = index[d.node]
        if node not in grounded:
            name = f"{d.node} DISPLACEMENT"
            first.setdefault(node, Card(d.node, None, name, "displacement", d.place.line))
            given.setdefault(node, []).extend(i for i, x in enumerate(d.d) if x is not None)
    k = (model.settings.k, model.settings.kr)
    for node, components in given.items():
        card = lists.card(first[node], node, -1)
        rows = [
            Row(i >= 3, (AXES[i % 3],), (0.0, 0.0), k[i // 3], True, WORDS[i])
            for i in sorted(set(components))
        ]
        lists.contacts.add(rows, card)


def _contacts(lists: _Lists, found: _Rows) -> Contacts:
    """Make the arrays of all rows from those of the different ones."""
    place: dict[int, int] = {}
    kinds: list[Row] = []
    for row in found.rows:
        if place.setdefault(id(row), len(kinds)) == len(kinds):
            kinds.append(row)
    which = np.array([place[id(row)] for row in found.rows], dtype=np.int32)
    card = np.array(found.card, dtype=np.int32)
    normal = np.array([(*r.normals, ZERO)[:2] for r in kinds], dtype=np.float64)
    gap = np.array([r.gap for r in kinds], dtype=np.float64).reshape(-1, 2)
    return Contacts(
        node=np.array(lists.node, dtype=np.int32)[card],
        cnode=np.array(lists.cnode, dtype=np.int32)[card],
        card=card,
        rotational=np.array([r.rotational for r in kinds], dtype=np.bool_)[which],
        dim=np.array([len(r.normals) for r in kinds], dtype=np.int32)[which],
        normal=normal.reshape(-1, 2, 3)[which],
        gap=gap[which],
        k=np.array([r.k for r in kinds], dtype=np.float64)[which],
        penalty=np.array([r.penalty for r in kinds], dtype=np.bool_)[which],
        two_way=(gap == 0.0).all(axis=1)[which],
        word=tuple(r.word for r in found.rows),
    )


def _sliders(lists: _Lists) -> Sliders:
    slides = lists.slides
    card = np.array([s.card for s in slides], dtype=np.int32)
    basis = [(*s.basis, ZERO)[:2] for s in slides]
    return Sliders(
        node=np.array(lists.node, dtype=np.int32)[card],
        cnode=np.array(lists.cnode, dtype=np.int32)[card],
        card=card,
        basis=np.array(basis, dtype=np.float64).reshape(-1, 2, 3),
        mu=np.array([s.mu for s in slides], dtype=np.float64),
        kf=np.array([s.kf for s in slides], dtype=np.float64),
        first=np.cumsum([0, *(len(s.contacts) for s in slides)], dtype=np.int32),
        contact=np.array([i for s in slides for i in s.contacts], dtype=np.int32),
    )
