"""Coordinates: from NODE cards or the origin along the pipes and bends, then over springs."""

import re
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field

from trunnion.errors import Problem
from trunnion.model import Model
from trunnion.system.bends import Legs, bend_radius, corner, pipe_name, turn_at
from trunnion.system.vectors import Vec, sub

BEND_POINT = re.compile(r"(\d+)[NMF]")


@dataclass(slots=True)
class Net:
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
        if not self.edges:
            fresh.clear()
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


def locate(model: Model, legs: Mapping[str, Legs], problems: list[Problem]) -> Net:
    """Give every label coordinates; list those that nothing places."""
    net = Net()
    for node in model.nodes:
        if net.position.get(node.label, node.xyz) != node.xyz:
            text = f"NODE {node.label}: has other coordinates already"
            problems.append(Problem(node.place, text))
        net.put(node.label, node.xyz)
    if not model.nodes:
        net.put(_first(model, legs), (0.0, 0.0, 0.0))
    _follow(model, net)
    _spread_all(model, legs, net)
    _check_found(model, legs, net, problems)
    return net


def _first(model: Model, legs: Mapping[str, Legs]) -> str:
    """Return the label that stands at the origin if nothing else gives it coordinates."""
    firsts = [pipe.start for pipe in model.pipes[:1]]
    firsts += [spring.start for spring in model.springs[:1]]
    firsts += [support.node for support in model.supports[:1]]
    return firsts[0][:-1] if firsts[0][:-1] in legs else firsts[0]


def _follow(model: Model, net: Net) -> None:
    """Follow the pipes in the deck's order; what does not hang on anything yet becomes a graph.

    Most decks are written along their lines, and this is all they need.
    """
    position, parent, fresh = net.position, net.parent, net.fresh
    for pipe in model.pipes:
        if pipe.delta is None:
            continue
        start, end = pipe.start, pipe.end
        if start in position:
            if end not in position:
                x, y, z = position[start]
                dx, dy, dz = pipe.delta
                position[end], parent[end] = (x + dx, y + dy, z + dz), start  # as put does
                fresh.append(end)
        elif end in position:
            net.put(start, sub(position[end], pipe.delta), end)
        else:
            net.join(start, end, pipe.delta)


def _spread_all(model: Model, legs: Mapping[str, Legs], net: Net) -> None:
    """Place every label: pipes first, then springs, the origin, and what CNODE= alone names."""
    sprung = [(_vertex(s.start, legs), _vertex(s.end, legs)) for s in model.springs]
    held = {s.node for s in model.supports} | {d.node for d in model.displacements}
    tied = [(_vertex(s.node, legs), s.cnode) for s in model.supports if s.cnode in held]
    ends = {x for pair in (*sprung, *tied) for x in pair if x is not None}
    waiting = _carrying(model, legs, ends | {_first(model, legs)})
    _settle(model, waiting, net)
    _coincide(sprung, model, waiting, net)
    net.put(_first(model, legs), (0.0, 0.0, 0.0))
    _settle(model, waiting, net)
    _coincide(sprung, model, waiting, net)
    _coincide([(a, b) for a, b in tied if b is not None], model, waiting, net, one_way=True)


def _carrying(model: Model, legs: Mapping[str, Legs], others: set[str]) -> dict[str, Legs]:
    """Bends on whose points 30N 30M 30F a pipe or one of `others` hangs; the rest can wait.

    The points of all bends follow once every label has its place.
    """
    if not legs:
        return {}
    labels = others.union((p.start for p in model.pipes), (p.end for p in model.pipes))
    wanted = {label[:-1] for label in labels if label[-1] in "NMF"}
    return {label: leg for label, leg in legs.items() if label in wanted}


def _vertex(label: str, legs: Mapping[str, Legs]) -> str:
    """Return the point that a spring or support means: the far one of a bend."""
    return f"{label}F" if label in legs else label


def _check_found(model: Model, legs: Mapping[str, Legs], net: Net, problems: list[Problem]) -> None:
    position = net.position
    for pipe in model.pipes:
        if pipe.start in position and pipe.end in position:
            continue
        lost = [label for label in (pipe.start, pipe.end) if label not in position]
        if lost:
            name = f"{pipe.card} {pipe_name(pipe)}"
            text = f"{name}: nothing gives the coordinates of {' and '.join(lost)}"
            problems.append(Problem(pipe.place, f"{text}; write a NODE card or join it"))
    for spring in model.springs:
        ends = (spring.start, spring.end)
        lost = [label for label in ends if _vertex(label, legs) not in net.position]
        if lost:
            text = f"nothing gives the coordinates of {' and '.join(lost)}; write a NODE card"
            problems.append(Problem(spring.place, f"SPRING {spring.start}-{spring.end}: {text}"))


def _settle(model: Model, waiting: dict[str, Legs], net: Net) -> None:
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
    net: Net,
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


def _vector(model: Model, i: int, net: Net) -> Vec | None:
    """Start-to-end vector of a pipe, if known."""
    pipe = model.pipes[i]
    if pipe.delta is not None:
        return pipe.delta
    if pipe.start in net.position and pipe.end in net.position:
        return sub(net.position[pipe.end], net.position[pipe.start])
    return None
