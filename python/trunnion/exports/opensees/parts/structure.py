"""Pipe and supports in OpenSees.

Straight pipe is one `ElasticTimoshenkoBeam` an element; bends and reducers are rigid pieces between
`zeroLength` hinges; supports are `zeroLength` springs, those with one side or a gap of a material
that carries nothing in the gap, so that OpenSees finds their states.
"""

from collections.abc import Mapping, Sequence
from math import inf
from typing import Any

from trunnion.exports.opensees.parts.frame import Frame
from trunnion.exports.opensees.parts.vectors import Vector


def add_elements(frame: Frame) -> None:
    """Add pipe: straights, bends and reducers, joints and springs."""
    job, node, modulus = frame.job, frame.node, frame.case["modulus"]
    for name, start, end, e, g, area, polar, second, shear, z in job["straights"]:
        ratio = modulus.get(name, 1.0)
        where = node[start], node[end]
        if shear:
            what, form = "ElasticTimoshenkoBeam", [ratio * e, ratio * g, area]
            form += [polar, second, second, shear, shear]
        else:
            what, form = "elasticBeamColumn", [area, ratio * e, ratio * g, polar, second, second]
        frame.straight[name] = frame.new_element(what, *where, *form, frame.transform(z))
    for name, start, end, hinges, _ in job["chains"]:
        add_chain(frame, name, node[start], node[end], hinges)
    for name, start, end, axes, k in job["springs"]:
        add_link(frame, name, node[start], node[end], axes, k)


def add_chain(frame: Frame, name: str, start: int, end: int, hinges: Sequence[Any]) -> None:
    """Add rigid parts and the hinges between them; the last part hangs on the second end."""
    ratio, before = frame.case["modulus"].get(name, 1.0), start
    frame.hinges[name], frame.hung[name] = [], [start]
    for i, (xyz, axes, k, _) in enumerate(hinges):
        near, far = frame.new_node(xyz), frame.new_node(xyz)
        frame.ops.rigidLink("beam", before, near)
        if i + 1 == len(hinges):
            frame.ops.rigidLink("beam", end, far)
        frame.hinges[name].append(six_springs(frame, near, far, axes, [ratio * x for x in k]))
        before = far
        frame.hung[name].append(end if i + 1 == len(hinges) else far)


def add_link(frame: Frame, name: str, start: int, end: int, axes: Any, k: Vector) -> None:
    """Add six springs half way between two nodes, rigid to both."""
    a, b = (frame.ops.nodeCoord(tag) for tag in (start, end))
    if max(abs(x - y) for x, y in zip(a, b, strict=True)) > 0.0:
        middle = [0.5 * (x + y) for x, y in zip(a, b, strict=True)]
        near, far = frame.new_node(middle), frame.new_node(middle)
        frame.ops.rigidLink("beam", start, near)
        frame.ops.rigidLink("beam", end, far)
        start, end = near, far
    frame.link[name] = six_springs(frame, start, end, axes, k)


def six_springs(frame: Frame, near: int, far: int, axes: Any, k: Vector) -> int:
    """Add a zeroLength element with a spring in every direction that has a stiffness."""
    directions = [i for i in range(6) if k[i]]
    materials = [frame.spring(k[i]) for i in directions]
    way = "-dir", *(i + 1 for i in directions), "-orient", *axes[0], *axes[1]
    return frame.new_element("zeroLength", near, far, "-mat", *materials, *way)


def add_supports(frame: Frame, rough: Mapping[int, Any] | None = None) -> None:
    """Add the springs of all supports, each on the ground of its card or on its other node.

    Those that are `rough` become friction elements.
    """
    job, case = frame.job, frame.case
    for i, row in enumerate(job["supports"][case["supports"]]):
        if rough and i in rough:
            add_friction(frame, row, rough[i])
            continue
        card, turns, normal, k, minus, plus = row
        base, node = both_nodes(frame, card)
        if (minus, plus) == (inf, 0.0):  # ENT is for compression: turn it round
            normal, minus, plus = [-x for x in normal], plus, minus
        way = "-dir", 4 if turns else 1, "-orient", *normal, *aside(normal)
        law = frame.spring(k, minus, plus)
        frame.held.append((card, frame.new_element("zeroLength", base, node, "-mat", law, *way)))
    for rub in case["rubs"]:
        if rub["mode"] == "stick":
            base, node = both_nodes(frame, rub["card"])
            for way in rub["basis"]:
                words = "-mat", frame.spring(rub["kf"]), "-dir", 1, "-orient", *way, *aside(way)
                tag = frame.new_element("zeroLength", base, node, *words)
                frame.held.append((rub["card"], tag))


def add_friction(frame: Frame, row: Any, rub: Mapping[str, Any]) -> None:
    """Add the contact elements of one direction; a gap is a ground that stands back."""
    card, _, normal, k, minus, plus = row
    base, node = both_nodes(frame, card)
    for sign, gap in ((1.0, minus), (-1.0, plus)):
        if gap == inf:
            continue
        way = [sign * x for x in normal]
        if gap:
            at = frame.case["base"].get(card, [0.0] * 6)
            back = [x - gap * y for x, y in zip(at, [*way, 0.0, 0.0, 0.0], strict=True)]
            base = frame.new_ground(frame.job["cards"][card][2], back)
        law = k, rub["kf"], rub["mu"], "-orient", *way, "-intType", 0
        frame.new_element("zeroLengthContactASDimplex", base, node, *law)


def both_nodes(frame: Frame, card: int) -> tuple[int, int]:
    """Node that a support stands on, and its node; ground is fixed, or moved by the case."""
    _, _, label, other = frame.job["cards"][card]
    if other is not None:
        return frame.node[other], frame.node[label]
    if card not in frame.ground:
        moved = frame.case["base"].get(card, [0.0] * 6)
        frame.ground[card] = frame.new_ground(label, moved)
    return frame.ground[card], frame.node[label]


def aside(x: Vector) -> list[float]:
    """Any vector that is not along x."""
    least = min(range(3), key=lambda i: abs(x[i]))
    return [float(i == least) for i in range(3)]
