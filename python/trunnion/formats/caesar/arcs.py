"""Bends with nodes at any angle of their arc: cut there into bends of the same radius.

A bend of the model has a near, a middle and a far point.  Where something stands at another angle
the arc is cut into two, each with a tangent intersection of its own; both keep the flexibility of
the whole.
"""

from dataclasses import replace
from math import cos, degrees, radians, sin, tan

from trunnion.formats.caesar.geometry import SAME_ANGLE, SNAP, nodes_used, outgoing, turn_of
from trunnion.formats.caesar.job import MIDDLE, Element, Job, Vec
from trunnion.formats.caesar.materials import CUT_LONG, CUT_SHORT
from trunnion.system.vectors import add, dot, scale, size, sub, unit


def cut_bends(job: Job) -> Job:
    """Give the job with every bend cut where something stands between its three points."""
    used = nodes_used(job)
    arcs = {node for e in job.elements if e.bend for _, node in e.bend.nodes}
    number = max(used | arcs) + 1
    elements = list(job.elements)
    i = 0
    while i < len(elements):
        if _cut(elements, i, used, number):
            number += 1
        else:
            i += 1
    return replace(job, elements=tuple(elements))


def _cut(elements: list[Element], i: int, used: set[int], number: int) -> bool:
    """Cut the bend of element `i` at one node, if it must be; `number` is the new bend's."""
    e = elements[i]
    after = outgoing(elements, i)
    plain = (e.rigid, e.reducer, e.joint) == (None, None, None)
    if e.bend is None or after is None or not plain or e.material in (CUT_SHORT, CUT_LONG):
        return False
    turned = elements[after].start == e.end
    out = scale(1.0 if turned else -1.0, elements[after].delta)
    turn, radius = turn_of(e.delta, out), e.bend.radius
    nodes = tuple(
        (0.5 * degrees(turn) if abs(a - MIDDLE) < 1e-3 else a, node) for a, node in e.bend.nodes
    )
    angle = next((a for a, node in nodes if node in used and _between(a, degrees(turn))), None)
    tangent = radius * tan(0.5 * turn)
    if angle is None or tangent > min(size(e.delta), size(out)) + SNAP:
        return False
    first, last = radius * tan(0.5 * radians(angle)), radius * tan(0.5 * (turn - radians(angle)))
    u, v = unit(e.delta), unit(out)
    inward = unit(sub(v, scale(dot(u, v), u)))
    way = add(scale(cos(radians(angle)), u), scale(sin(radians(angle)), inward))
    whole = e.bend.whole or turn
    before = tuple((a, node) for a, node in nodes if a <= angle + SAME_ANGLE)
    behind = tuple((a - angle, node) for a, node in nodes if a > angle + SAME_ANGLE)
    kept: Vec = sub(e.delta, scale(tangent - first, u))
    start = replace(e, end=number, delta=kept, bend=replace(e.bend, nodes=before, whole=whole))
    rest = replace(e.bend, nodes=behind, whole=whole)
    bare = replace(e, restraints=(), displacements=(), forces=(), sifs=(), offsets=None)
    end = replace(bare, start=number, delta=scale(first + last, way), bend=rest)
    shorter = scale(1.0 if turned else -1.0, sub(out, scale(tangent - last, v)))
    elements[after] = replace(elements[after], delta=shorter)
    elements[i : i + 1] = [start, end]
    return True


def _between(angle: float, turn: float) -> bool:
    """Tell whether an angle [deg] is none of the three points of a bend, but on its arc."""
    points = (0.0, 0.5 * turn, turn)
    return 0.0 < angle < turn and min(abs(angle - point) for point in points) > SAME_ANGLE
