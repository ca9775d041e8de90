"""Coordinates: from NODE cards or the origin along the pipes, round closed loops and bends."""

import re
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import hypot

from trunnion.bends import Corner, Legs, bend_radius, corner, find_legs, pipe_name, turn_at
from trunnion.checks import refuse
from trunnion.errors import Problem
from trunnion.model import Model
from trunnion.vectors import Vec, add, size, sub

BEND_POINT = re.compile(r"(\d+)[NMF]")
LOOP_RELATIVE = 1e-6  # a loop may miss by this part of the extent ...
LOOP_ABSOLUTE = 1e-9  # ... plus this [m]


@dataclass(frozen=True, slots=True)
class Geometry:
    """Placed labels: `points` holds every node and bend point, `corners` every bend by label."""

    points: dict[str, Vec]
    corners: dict[str, Corner]


@dataclass(slots=True)
class _Net:
    """Labels as a graph; `edges` lead from a label to (label, offset), `parent` back to a root.

    A bend's own label is its tangent intersection here.
    """

    position: dict[str, Vec] = field(default_factory=dict)
    parent: dict[str, str | None] = field(default_factory=dict)
    edges: dict[str, list[tuple[str, Vec]]] = field(default_factory=dict)
    fresh: deque[str] = field(default_factory=deque)

    def join(self, a: str, b: str, offset: Vec) -> None:
        """Say that b lies at a + offset."""
        x, y, z = offset
        self.edges.setdefault(a, []).append((b, offset))
        self.edges.setdefault(b, []).append((a, (-x, -y, -z)))
        if a in self.position:
            self.fresh.append(a)
        if b in self.position:
            self.fresh.append(b)

    def put(self, label: str, xyz: Vec, parent: str | None = None) -> None:
        """Place a label that has no coordinates yet."""
        if label not in self.position:
            self.position[label] = xyz
            self.parent[label] = parent
            self.fresh.append(label)

    def spread(self) -> None:
        """Place all that hangs on labels with coordinates."""
        position, fresh = self.position, self.fresh
        while fresh:
            a = fresh.popleft()
            x, y, z = position[a]
            for b, (dx, dy, dz) in self.edges.get(a, ()):
                if b not in position:
                    position[b] = (x + dx, y + dy, z + dz)
                    self.parent[b] = a
                    fresh.append(b)

    def path(self, label: str) -> list[str]:
        """Labels from the root to `label`."""
        way: list[str] = []
        at: str | None = label
        while at is not None:
            way.append(at)
            at = self.parent[at]
        return way[::-1]


def place(model: Model, problems: list[Problem]) -> Geometry:
    """Give every label its coordinates; raise all problems of this phase at once.

    `problems` holds what is known already, and receives what is found here.
    """
    legs = find_legs(model, problems)
    _check_bend_points(model, legs, problems)
    refuse(problems)
    net = _Net()
    for node in model.nodes:
        if net.position.get(node.label, node.xyz) != node.xyz:
            text = f"NODE {node.label}: has other coordinates already"
            problems.append(Problem(node.place, text))
        net.put(node.label, node.xyz)
    if not model.nodes:
        net.put(_first(model, legs), (0.0, 0.0, 0.0))
    _follow(model, net)
    _spread_all(model, legs, net, problems)
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
    labels = [(x, p.place, f"PIPE {pipe_name(p)}") for p in model.pipes for x in (p.start, p.end)]
    for s in model.springs:
        labels += [(x, s.place, f"SPRING {s.start}-{s.end}") for x in (s.start, s.end)]
    for label, where, name in labels:
        match = BEND_POINT.fullmatch(label)
        if match and match[1] not in bends:
            text = f"{name}: {label} is a point of a bend at {match[1]}, and there is no bend"
            problems.append(Problem(where, text))
    for node in model.nodes:
        if BEND_POINT.fullmatch(node.label):
            text = (
                f"NODE {node.label}: points of bends follow from the bend; place {node.label[:-1]}"
            )
            problems.append(Problem(node.place, text))


def _first(model: Model, legs: Mapping[str, Legs]) -> str:
    """Return the label that stands at the origin if nothing else gives it coordinates."""
    firsts = [pipe.start for pipe in model.pipes[:1]]
    firsts += [spring.start for spring in model.springs[:1]]
    firsts += [support.node for support in model.supports[:1]]
    return firsts[0][:-1] if firsts[0][:-1] in legs else firsts[0]


def _follow(model: Model, net: _Net) -> None:
    """Follow the pipes in the deck's order; what does not hang on anything yet becomes a graph.

    Most decks are written along their lines, and this is all they need.
    """
    position = net.position
    for pipe in model.pipes:
        if pipe.delta is None:
            continue
        start, end = pipe.start, pipe.end
        if start in position:
            if end not in position:
                net.put(end, add(position[start], pipe.delta), start)
        elif end in position:
            net.put(start, sub(position[end], pipe.delta), end)
        else:
            net.join(start, end, pipe.delta)


def _spread_all(model: Model, legs: Mapping[str, Legs], net: _Net, problems: list[Problem]) -> None:
    """Place every label: pipes first, then springs, the origin, and what CNODE= alone names."""

    def vertex(label: str) -> str:
        return f"{label}F" if label in legs else label

    waiting = dict(legs)
    sprung = [(vertex(s.start), vertex(s.end)) for s in model.springs]
    held = {s.node for s in model.supports} | {d.node for d in model.displacements}
    tied = [(vertex(s.node), s.cnode) for s in model.supports if s.cnode in held]
    _settle(model, waiting, net)
    _coincide(sprung, model, waiting, net)
    net.put(_first(model, legs), (0.0, 0.0, 0.0))
    _settle(model, waiting, net)
    _coincide(sprung, model, waiting, net)
    _coincide([(a, b) for a, b in tied if b is not None], model, waiting, net, one_way=True)
    for pipe in model.pipes:
        lost = [label for label in (pipe.start, pipe.end) if label not in net.position]
        if lost:
            name = f"{'RIGID' if pipe.rigid else 'PIPE'} {pipe_name(pipe)}"
            text = f"{name}: nothing gives the coordinates of {' and '.join(lost)}"
            problems.append(Problem(pipe.place, f"{text}; write a NODE card or join it"))
    for spring in model.springs:
        ends = (spring.start, spring.end)
        lost = [label for label in ends if vertex(label) not in net.position]
        if lost:
            text = f"nothing gives the coordinates of {' and '.join(lost)}; write a NODE card"
            problems.append(Problem(spring.place, f"SPRING {spring.start}-{spring.end}: {text}"))


def _settle(model: Model, waiting: dict[str, Legs], net: _Net) -> None:
    """Spread along pipes; as soon as both legs of a bend have a direction, place its points."""
    progress = True
    while progress:
        net.spread()
        progress = False
        for label, legs in list(waiting.items()):
            a, b = (_vector(model, i, net) for i in (legs.near, legs.far))
            if a is None or b is None:
                continue
            pipe = model.pipes[legs.near]
            a = turn_at(label, pipe, a, near=True)
            b = turn_at(label, model.pipes[legs.far], b, near=False)
            radius = bend_radius(legs.bend, model.sections[pipe.section])
            made = corner(legs, (0.0, 0.0, 0.0), a, b, radius)
            del waiting[label]
            if made is not None:
                for point, offset in zip("NMF", (made.n, made.m, made.f), strict=True):
                    net.join(label, label + point, offset)
            progress = True


def _coincide(
    pairs: list[tuple[str, str]],
    model: Model,
    waiting: dict[str, Legs],
    net: _Net,
    *,
    one_way: bool = False,
) -> None:
    """Place labels joined by springs (or CNODE=) at their partner if they have no coordinates."""
    progress = True
    while progress:
        progress = False
        for a, b in pairs:
            if (a in net.position) != (b in net.position):
                known, other = (a, b) if a in net.position else (b, a)
                if one_way and known == b:
                    continue
                net.put(other, net.position[known], known)
                _settle(model, waiting, net)
                progress = True


def _vector(model: Model, i: int, net: _Net) -> Vec | None:
    """Start-to-end vector of a pipe, if known."""
    pipe = model.pipes[i]
    if pipe.delta is not None:
        return pipe.delta
    if pipe.start in net.position and pipe.end in net.position:
        return sub(net.position[pipe.end], net.position[pipe.start])
    return None


def _corner(model: Model, legs: Legs, net: _Net, problems: list[Problem]) -> Corner | None:
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


def _check_loops(model: Model, net: _Net, problems: list[Problem]) -> None:
    """Check that pipes have a length and that loops end where they began."""
    spans = [[xyz[i] for xyz in net.position.values()] for i in range(3)]
    extent = max(max(span) - min(span) for span in spans)
    tolerance = LOOP_RELATIVE * extent + LOOP_ABSOLUTE
    for pipe in model.pipes:
        start, end = net.position[pipe.start], net.position[pipe.end]
        if pipe.delta is None:
            if size(sub(end, start)) <= LOOP_ABSOLUTE:
                text = f"PIPE {pipe_name(pipe)}: both ends have the same coordinates"
                problems.append(Problem(pipe.place, text))
            continue
        dx, dy, dz = pipe.delta
        miss = hypot(end[0] - start[0] - dx, end[1] - start[1] - dy, end[2] - start[2] - dz)
        if not miss <= tolerance:
            one, other = net.path(pipe.end), [*net.path(pipe.start), pipe.end]
            common = 0
            while common < min(len(one), len(other)) and one[common] == other[common]:
                common += 1
            keep = max(0, common - 1)
            way = _ways(pipe.end, one[keep:], other[keep:], closed=common > 0)
            text = f"PIPE {pipe_name(pipe)}: {way}, {1e3 * miss:.6g} mm apart"
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
    model: Model, corners: Mapping[str, Corner], net: _Net, problems: list[Problem]
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
                text = (
                    f"BEND {label}: {bends} {c.tangent + shared:.6g} m of pipe "
                    f"{pipe_name(pipe)}, which is {length:.6g} m long"
                )
                problems.append(Problem(c.legs.bend.place, text))


def _tangent_of(c: Corner | None, pipe: int) -> float:
    """Length that the bend takes from the pipe; 0 if the pipe is none of its legs."""
    return c.tangent if c is not None and pipe in (c.legs.near, c.legs.far) else 0.0
