"""Placed labels: coordinates of nodes and bend points, loops and tangents checked."""

from collections.abc import Mapping
from math import hypot

from trunnion.deck.units import in_unit, small_length
from trunnion.errors import Problem
from trunnion.frozen import frozen
from trunnion.model import Model, Pipe, Spring
from trunnion.system.bends import Corner, Legs, bend_radius, corner, find_legs, pipe_name, turn_at
from trunnion.system.checks import refuse
from trunnion.system.coordinates import BEND_POINT, Net, locate
from trunnion.system.vectors import Vec, size, sub

LOOP_RELATIVE = 1e-6  # a loop may miss by this part of the extent ...
LOOP_ABSOLUTE = 1e-9  # ... plus this [m]


@frozen
class Geometry:
    """Placed labels: `points` holds every node and bend point, `corners` every bend by label."""

    points: dict[str, Vec]
    corners: dict[str, Corner]


def place(model: Model, problems: list[Problem]) -> Geometry:
    """Give every label its coordinates; raise all problems of this phase at once.

    `problems` holds what is known already, and receives what is found here.
    """
    legs = find_legs(model, problems)
    _check_bend_points(model, legs, problems)
    refuse(problems)
    net = locate(model, legs, problems)
    refuse(problems)
    _check_loops(model, net, problems)
    corners = {label: _corner(model, leg, net, problems) for label, leg in legs.items()}
    placed = {label: c for label, c in corners.items() if c is not None}
    if not problems:
        _check_tangents(model, placed, net, problems)
    refuse(problems)
    points = dict(net.position)
    for label, c in placed.items():
        points |= {label + "N": c.n, label + "M": c.m, label + "F": c.f}
        points[label] = c.f
    return Geometry(points, placed)


def _check_bend_points(model: Model, legs: Mapping[str, Legs], problems: list[Problem]) -> None:
    """Labels such as 30N belong to bends: they must have one, and no coordinates of their own."""
    bends = {bend.node for bend in model.bends}
    records: list[Pipe | Spring] = [*model.pipes, *model.springs]
    for record in records:
        if record.start[-1:] not in "NMF" and record.end[-1:] not in "NMF":
            continue
        for label in (record.start, record.end):
            match = BEND_POINT.fullmatch(label)
            if match and match[1] not in bends:
                card = "PIPE" if isinstance(record, Pipe) else "SPRING"
                text = f"{card} {record.start}-{record.end}: {label} is a point of a bend at"
                text = f"{text} {match[1]}, and there is no bend"
                problems.append(Problem(record.place, text))
    for node in model.nodes:
        if BEND_POINT.fullmatch(node.label):
            text = (
                f"NODE {node.label}: points of bends follow from the bend; place {node.label[:-1]}"
            )
            problems.append(Problem(node.place, text))


def _corner(model: Model, legs: Legs, net: Net, problems: list[Problem]) -> Corner | None:
    label = legs.bend.node
    near, far = model.pipes[legs.near], model.pipes[legs.far]
    vectors = [sub(net.position[p.end], net.position[p.start]) for p in (near, far)]
    a = turn_at(label, near, vectors[0], near=True)
    b = turn_at(label, far, vectors[1], near=False)
    radius = bend_radius(legs.bend, model.sections[near.section])
    made = corner(legs, net.position[label], a, b, radius)
    if made is None:
        text = f"BEND {label}: pipes {pipe_name(near)} and {pipe_name(far)} are in line"
        problems.append(Problem(legs.bend.place, text))
    return made


def _check_loops(model: Model, net: Net, problems: list[Problem]) -> None:
    """Check that pipes have a length and that loops end where they began."""
    position = net.position
    extent = max(max(span) - min(span) for span in zip(*position.values(), strict=True))
    tolerance = LOOP_RELATIVE * extent + LOOP_ABSOLUTE
    for pipe in model.pipes:
        start, end = position[pipe.start], position[pipe.end]
        if pipe.delta is None:
            if size(sub(end, start)) <= LOOP_ABSOLUTE and pipe.joint is None:
                text = f"PIPE {pipe_name(pipe)}: both ends have the same coordinates"
                problems.append(Problem(pipe.place, text))
            continue
        dx, dy, dz = pipe.delta
        dx, dy, dz = end[0] - start[0] - dx, end[1] - start[1] - dy, end[2] - start[2] - dz
        if abs(dx) + abs(dy) + abs(dz) <= tolerance:
            continue  # nearly all; the sum is at least the distance
        miss = hypot(dx, dy, dz)
        if not miss <= tolerance:
            one, other = net.path(pipe.end), [*net.path(pipe.start), pipe.end]
            common = 0
            while common < min(len(one), len(other)) and one[common] == other[common]:
                common += 1
            keep = max(0, common - 1)
            way = _ways(pipe.end, one[keep:], other[keep:], closed=common > 0)
            apart = small_length(model.units, miss)
            text = f"PIPE {pipe_name(pipe)}: {way}, {apart} apart"
            problems.append(Problem(pipe.place, text))


def _ways(end: str, one: list[str], other: list[str], *, closed: bool) -> str:
    """Say by which two paths `end` gets two places."""
    if len(one) > 1:
        return f"the loop does not close: {_way(one)} and {_way(other)} reach {end}"
    if closed:
        return f"the loop does not close: {_way(other)} leaves from and comes back to {end}"
    return f"the NODE card of {end} and the path {_way(other)} reach {end}"


def _way(labels: list[str]) -> str:
    """Join the labels of a path, the middle of a long one left out."""
    return "-".join(labels if len(labels) <= 7 else [*labels[:3], "...", *labels[-3:]])


def _check_tangents(
    model: Model, corners: Mapping[str, Corner], net: Net, problems: list[Problem]
) -> None:
    """Check that no bend uses up more than its tangents."""
    for label, c in corners.items():
        for i in (c.legs.near, c.legs.far):
            pipe = model.pipes[i]
            length = size(sub(net.position[pipe.end], net.position[pipe.start]))
            other = pipe.start if pipe.end == label else pipe.end
            shared = _tangent_of(corners.get(other), i)
            if shared and label != pipe.start:
                continue  # said once, at the bend where the pipe starts
            if c.tangent + shared > length * (1.0 + 1e-9):
                bends = f"the bends at {pipe.start} and {pipe.end} need" if shared else "it needs"
                need, there = (in_unit(model.units.length, x) for x in (c.tangent + shared, length))
                text = (
                    f"BEND {label}: {bends} {need} of pipe {pipe_name(pipe)}, which is {there} long"
                )
                problems.append(Problem(c.legs.bend.place, text))


def _tangent_of(c: Corner | None, pipe: int) -> float:
    """Length that the bend takes from the pipe; 0 if the pipe is none of its legs."""
    return c.tangent if c is not None and pipe in (c.legs.near, c.legs.far) else 0.0
