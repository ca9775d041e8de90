"""Loads in OpenSees.

They stand on nodes and on lengths of pipe, free strains are pairs of forces, grounds may move.
"""

from collections.abc import Iterator, Mapping
from math import sqrt
from typing import Any

from trunnion.exports.opensees.parts.frame import Frame
from trunnion.exports.opensees.parts.vectors import add, cross, dot


def add_loads(frame: Frame) -> None:
    """Add the loads of the case: on nodes, on lengths of pipe, free strains, moved grounds."""
    ops, job, case = frame.ops, frame.job, frame.case
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for label, six in case["nodal"].items():
        frame.load(frame.node[label], six)
    for tag, moved in frame.moved.items():
        for i, shift in enumerate(moved, 1):
            ops.sp(tag, i, shift)
    for card, six in support_pushes(frame):
        _, _, label, other = job["cards"][card]
        frame.load(frame.node[label], six)
        if other is not None:
            frame.load(frame.node[other], [-x for x in six])
    for name, start, end, *_, z in job["straights"]:
        tag, x = frame.straight[name], axis(frame, start, end)
        if name in case["line"]:
            q = case["line"][name]
            y = cross(z, x)
            w = [dot(q, y), dot(q, z), dot(q, x)]
            frame.largest = max(frame.largest, *map(abs, w))
            ops.eleLoad("-ele", tag, "-type", "-beamUniform", *w)
    for _, node, six in strain_pairs(frame):
        frame.load(node, six)
    for name, _, _, _, segments in job["chains"]:
        for tag, segment in zip(frame.hung[name], segments, strict=True):
            frame.load(tag, segment_load(case, name, segment))


def support_pushes(frame: Frame) -> Iterator[tuple[int, list[float]]]:
    """Yield forces on the pipe that are given: cold loads of hangers, friction, stuck datums."""
    for card, push in frame.case["preload"].items():
        yield card, [*push, 0.0, 0.0, 0.0]
    for rub in frame.case["rubs"]:
        if rub["mode"] == "slip":
            yield rub["card"], [*rub["force"], 0.0, 0.0, 0.0]
        elif rub["mode"] == "stick" and any(rub["datum"]):
            yield rub["card"], [*(rub["kf"] * x for x in rub["datum"]), 0.0, 0.0, 0.0]


def strain_pairs(frame: Frame) -> Iterator[tuple[str, int, list[float]]]:
    """Yield element, node and load of the pairs that stretch elements as free strains do."""
    job, case = frame.job, frame.case
    for name, start, end, e, _, area, *_ in job["straights"]:
        if name in case["strain"]:
            pull = case["modulus"].get(name, 1.0) * e * area * case["strain"][name]
            along = [pull * x for x in axis(frame, start, end)]
            yield name, frame.node[start], [*(-x for x in along), 0.0, 0.0, 0.0]
            yield name, frame.node[end], [*along, 0.0, 0.0, 0.0]
    for name, _, _, hinges, _ in job["chains"]:
        strain, curvature = case["strain"].get(name, 0.0), case["curvature"].get(name, 0.0)
        if strain or curvature:
            ratio = case["modulus"].get(name, 1.0)
            for hinge, tag in zip(hinges, frame.hinges[name], strict=True):
                six = [ratio * x for x in hinge_load(hinge, strain, curvature)]
                near, far = frame.ops.eleNodes(tag)
                yield name, near, [-x for x in six]
                yield name, far, six
    for name, _, _, axes, k in job["springs"]:
        if name in case["growth"]:
            six = [*(k[0] * case["growth"][name] * x for x in axes[0]), 0.0, 0.0, 0.0]
            near, far = frame.ops.eleNodes(frame.link[name])
            yield name, near, [-x for x in six]
            yield name, far, six


def hinge_load(hinge: Any, strain: float, curvature: float) -> list[float]:
    """Force and moment, global, that move a hinge as its free strain would."""
    _, axes, k, (*along, length) = hinge
    push = [k[i] * along[i] * strain for i in range(3)]
    turn = k[5] * curvature * length
    force = [sum(push[i] * axes[i][j] for i in range(3)) for j in range(3)]
    return [*force, *(turn * x for x in axes[2])]


def segment_load(case: Mapping[str, Any], name: str, segment: Any) -> list[float]:
    """Force and moment of the load on a rigid part about its node."""
    loads = [case["line"].get(name, (0.0,) * 3), *case["vary"].get(name, ())]
    total = [0.0] * 6
    for q, (length, *lever) in zip(loads, segment, strict=False):
        total = add(total, [*(length * x for x in q), *cross(lever, q)])
    return total


def axis(frame: Frame, start: str, end: str) -> list[float]:
    """Unit vector from node to node."""
    d = [b - a for a, b in zip(frame.job["nodes"][start], frame.job["nodes"][end], strict=True)]
    size = sqrt(dot(d, d))
    return [x / size for x in d]
