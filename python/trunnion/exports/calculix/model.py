"""Cards before the steps: nodes, beams of type U1, springs, equations."""

from collections.abc import Iterable, Iterator, Sequence
from math import sqrt

import numpy as np

from trunnion.arrays import STRAIGHT
from trunnion.exports.calculix.numbering import Deck

STIFF_SHEAR = 1e9  # shear coefficient of a beam that is rigid in shear


def model_cards(deck: Deck) -> Iterator[str]:
    """Write everything that stands before the steps."""
    s = deck.scene.system
    yield "*NODE, NSET=PIPES"
    yield from (f"{i}, {numbers(xyz)}" for i, xyz in enumerate(s.xyz.tolist(), 1))
    turns = [body for body in deck.bodies if body.turn != body.node]
    yield "*NODE, NSET=TURNS" if turns else "*NODE"
    yield from (f"{body.turn}, {numbers(body.xyz.tolist())}" for body in turns)
    yield "*NODE"
    yield from (f"{i}, {numbers(xyz)}" for i, xyz in deck.nodes)
    yield from _beams(deck)
    for i, (k, springs) in enumerate(deck.springs.items(), 1):
        for kind, count in (("SPRING1", 2), ("SPRING2", 3)):
            rows = [row for row in springs if len(row) == count]
            if rows:
                name = f"K{i}{'AB'[count - 2]}"
                yield f"*ELEMENT, TYPE={kind}, ELSET={name}"
                yield from (", ".join(map(str, row)) for row in rows)
                yield from (f"*SPRING, ELSET={name}", "1" if count == 2 else "1, 1", number(k))
    yield from _sets("HIDDEN", deck.hidden)
    yield from _sets("GROUNDS", [ground.node for ground in deck.grounds.values()])
    for terms in deck.equations:
        yield from ("*EQUATION", str(len(terms)))
        for at in range(0, len(terms), 4):
            row = terms[at : at + 4]
            yield ", ".join(f"{node}, {freedom}, {number(x)}" for node, freedom, x in row)


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
        yield from (f"*MATERIAL, NAME=M{i}", "*ELASTIC", numbers((young, nu)))
    for i, (which, half, second, factor, *way) in enumerate(sections, 1):
        yield f"*BEAM SECTION, ELSET=S{i}, MATERIAL=M{which:g}, SECTION=GENERAL"
        yield numbers((half, second, 0.0, 0.0, factor))
        yield numbers(way)


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


def _sets(name: str, nodes: Sequence[int]) -> Iterator[str]:
    if nodes:
        yield f"*NSET, NSET={name}"
        yield from (f"{node}," for node in nodes)


def numbers(values: Iterable[float]) -> str:
    """Numbers of one line."""
    return ", ".join(map(number, values))


def number(x: float) -> str:
    """A number in at most 20 characters, all that CalculiX reads."""
    return f"{x:.12e}"
