"""One case solved by OpenSees, and what came out."""

from collections.abc import Mapping
from itertools import product
from typing import Any

from trunnion.exports.opensees.parts.frame import Frame
from trunnion.exports.opensees.parts.friction import places, try_friction
from trunnion.exports.opensees.parts.laws import judge
from trunnion.exports.opensees.parts.loads import (
    add_loads,
    segment_load,
    strain_pairs,
    support_pushes,
)
from trunnion.exports.opensees.parts.structure import add_elements, add_supports
from trunnion.exports.opensees.parts.vectors import Vector, add, cross

TRIES = (("Newton", 1), ("NewtonLineSearch", 1), ("Newton", 10), ("NewtonLineSearch", 25))
BALANCE = 1e-9  # norm of what is out of balance, of the largest load [N, N m]
LEAST_BALANCE = 2e-5  # N: springs of 1e12 N/m know their force to no less
LOOSER = 1e3  # where that cannot be had: long lines, large movements
ITERATIONS = 60


def solve(job: Mapping[str, Any], name: str) -> dict[str, Any]:
    """Solve one case; where Newton's method cycles between contacts, try with more steps.

    Contact without friction has one answer, whatever the steps on the way to it.
    """
    cause = ""
    for (algorithm, steps), looser in product(TRIES, (1.0, LOOSER)):
        frame = Frame(job, job["cases"][name])
        add_elements(frame)
        add_supports(frame)
        add_loads(frame)
        balance = looser * max(BALANCE * frame.largest, LEAST_BALANCE)
        code = frame.analyse(algorithm, steps, balance, ITERATIONS)
        if code == 0:
            found = answer(frame)
            if frame.case["rubs"]:
                held = {key: frame.ops.nodeDisp(tag) for key, tag in places(frame).items()}
                found["friction"] = try_friction(job, name, held)
            return found
        cause = f"OpenSees: analyze returns {code}"
    return {"converged": False, "cause": cause}


def answer(frame: Frame) -> dict[str, Any]:
    """Movements, support forces on the pipe, end forces on elements, and the laws held."""
    ops, job = frame.ops, frame.job
    moved = {label: ops.nodeDisp(tag) for label, tag in frame.node.items()}
    force = [[0.0] * 6 for _ in job["cards"]]
    for card, six in support_pushes(frame):
        force[card] = add(force[card], six)
    pushes: list[list[float]] = []
    for card, tag in frame.held:
        push = [-x for x in ops.eleForce(tag)[6:12]]
        force[card] = add(force[card], push)
        pushes.append(push)
    law, where = judge(job, frame.case, moved, pushes)
    return {
        "converged": True,
        "nodes": moved,
        "supports": [
            {"id": card[0], "name": card[1], "force": six[:3], "moment": six[3:]}
            for card, six in zip(job["cards"], force, strict=True)
        ],
        "elements": end_forces(frame),
        "law": law if frame.case["rubs"] or frame.case["rings"] else None,
        "law_at": where,
    }


def end_forces(frame: Frame) -> list[dict[str, Any]]:
    """Forces and moments on the elements at their two ends."""
    pairs: dict[tuple[str, int], list[float]] = {}
    for name, node, six in strain_pairs(frame):
        pairs[name, node] = add(pairs.get((name, node), [0.0] * 6), six)
    found = {}
    for name, tag in frame.straight.items():
        both, ends = frame.ops.eleForce(tag), frame.ops.eleNodes(tag)
        found[name] = [
            add(both[at : at + 6], [-x for x in pairs.get((name, node), [0.0] * 6)])
            for at, node in ((0, ends[0]), (6, ends[1]))
        ]
    for name, start, end, _, segments in frame.job["chains"]:
        tags, case = frame.hinges[name], frame.case
        ends = []
        first, last = (start, tags[0], 0, segments[0]), (end, tags[-1], 1, segments[-1])
        for label, tag, half, part in (first, last):
            node = frame.ops.eleNodes(tag)[half]
            six = frame.ops.eleForce(tag)[6 * half : 6 * half + 6]
            six = add(six, [-x for x in pairs.get((name, node), [0.0] * 6)])
            six = carried(frame, six, node, frame.node[label])
            ends.append(add(six, [-x for x in segment_load(case, name, part)]))
        found[name] = ends
    for name, start, end, *_ in frame.job["springs"]:
        tag, ends = frame.link[name], []
        for half, label in enumerate((start, end)):
            node = frame.ops.eleNodes(tag)[half]
            six = frame.ops.eleForce(tag)[6 * half : 6 * half + 6]
            six = add(six, [-x for x in pairs.get((name, node), [0.0] * 6)])
            ends.append(carried(frame, six, node, frame.node[label]))
        found[name] = ends
    return [
        {"id": name, "force_from": found[name][0], "force_to": found[name][1]}
        for name in frame.job["elements"]
    ]


def carried(frame: Frame, six: Vector, here: int, there: int) -> list[float]:
    """A force and a moment at one node, about another."""
    a, b = (frame.ops.nodeCoord(tag) for tag in (here, there))
    arm = [x - y for x, y in zip(a, b, strict=True)]
    return [*six[:3], *add(six[3:], cross(arm, six[:3]))]
