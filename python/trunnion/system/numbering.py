"""Numbers of nodes and the rows of elements, in the deck's order."""

from dataclasses import dataclass, field
from typing import NamedTuple

from trunnion.arrays import ARC, SPRING, STRAIGHT, TAPER, Part
from trunnion.model import Model, Pipe
from trunnion.system.bends import VANISHED, Corner
from trunnion.system.checks import standing
from trunnion.system.coordinates import BEND_POINT
from trunnion.system.geometry import Geometry
from trunnion.system.vectors import add, size, sub


class Share(NamedTuple):
    """An arc's part of its bend: label of the bend, first and last part of the angle."""

    bend: str
    first: float
    last: float


@dataclass(slots=True)
class Rows:
    """Elements in the deck's order, column by column; source -1 is a spring."""

    start: list[int] = field(default_factory=list)  # node numbers
    end: list[int] = field(default_factory=list)
    kind: list[int] = field(default_factory=list)
    source: list[int] = field(default_factory=list)  # numbers of pipes
    names: list[Part] = field(default_factory=list)
    arcs: dict[int, Share] = field(default_factory=dict)  # by number of the element

    def add(self, start: int, end: int, kind: int, source: int, names: Part) -> None:
        """Append one element."""
        self.start.append(start)
        self.end.append(end)
        self.kind.append(kind)
        self.source.append(source)
        self.names.append(names)


@dataclass(slots=True)
class Numbering:
    """Node labels in order, and the number of every label that means a node."""

    labels: list[str] = field(default_factory=list)
    index: dict[str, int] = field(default_factory=dict)
    alias: dict[str, int] = field(default_factory=dict)
    mid: dict[str, int] = field(default_factory=dict)
    rows: Rows = field(default_factory=Rows)
    same: dict[str, str] = field(default_factory=dict)  # labels that fell together

    def node(self, label: str) -> int:
        """Return the number of a label; a new one if it has none yet."""
        got = self.index.get(label)
        if got is None:
            head = self.head(label)
            got = self.index.setdefault(head, len(self.labels))
            if got == len(self.labels):
                self.labels.append(head)
            if head != label:
                self.index[label] = self.alias[label] = got
        return got

    def head(self, label: str) -> str:
        """Return the label that stands for all that fell together with `label`."""
        while label in self.same:
            label = self.same[label]
        return label

    def merge(self, a: str, b: str) -> None:
        """Make one node of two labels; a plain label leads, else the first."""
        a, b = self.head(a), self.head(b)
        if a != b:
            if BEND_POINT.fullmatch(a) and not BEND_POINT.fullmatch(b):
                a, b = b, a
            self.same[b] = a


def number(model: Model, geometry: Geometry) -> Numbering:
    """Give nodes their numbers; list elements: each pipe, then the bend that it leads into."""
    numbering = Numbering()
    corners, index, node, put = (
        geometry.corners,
        numbering.index,
        numbering.node,
        numbering.rows.add,
    )
    vanished = _vanished(model, geometry, numbering)
    users = [label for label, _, _ in standing(model)]
    used = _used(model, users) if corners else frozenset()
    bends_of: dict[int, list[str]] = {}
    for label, c in corners.items():
        bends_of.setdefault(c.legs.near, []).append(label)
    for i, pipe in enumerate(model.pipes):
        if i not in vanished:
            a, b = pipe.start, pipe.end
            if a in corners or b in corners:
                a, b = _point(a, i, corners), _point(b, i, corners)
            kind = pipe.card.lower()
            part = Part(a, b, kind, pipe.section, pipe.material, pipe.place.line)
            start = index[a] if a in index else node(a)
            law = SPRING if pipe.joint else TAPER if pipe.reducer else STRAIGHT
            end = index[b] if b in index else node(b)
            if pipe.offsets != (None, None):
                start, end = _arms(numbering, geometry, i, pipe, (start, end))
            put(start, end, law, i, part)
        if i in bends_of:
            for label in bends_of[i]:
                _bend(label, corners[label], model, label + "M" in used, numbering)
    for spring in model.springs:
        a, b = (label + "F" if label in corners else label for label in (spring.start, spring.end))
        part = Part(a, b, "spring", None, None, spring.place.line)
        put(node(a), node(b), SPRING, -1, part)
    for label in corners:
        numbering.index[label] = numbering.alias[label] = numbering.node(label + "F")
    for label in users:
        if label not in index:
            node(label)
    return numbering


def _arms(
    numbering: Numbering, geometry: Geometry, i: int, pipe: Pipe, ends: tuple[int, int]
) -> tuple[int, int]:
    """Add the rigid arms of a pipe that starts or ends off its nodes; returns its own ends."""
    own = list(ends)
    for k, (label, arm) in enumerate(zip((pipe.start, pipe.end), pipe.offsets, strict=True)):
        if arm is None:
            continue
        tip = f"{pipe.start}-{pipe.end}/{i}.{'AB'[k]}"  # no label of a deck has a hyphen
        geometry.points[tip] = add(geometry.points[label], arm)
        part = Part(label, tip, "arm", None, None, pipe.place.line)
        own[k] = numbering.node(tip)
        numbering.rows.add(ends[k], own[k], SPRING, i, part)
    return own[0], own[1]


def _used(model: Model, users: list[str]) -> set[str]:
    """Labels that a card names."""
    return {
        *users,
        *(x for p in model.pipes for x in (p.start, p.end)),
        *(x for s in model.springs for x in (s.start, s.end)),
    }


def _bend(label: str, c: Corner, model: Model, has_mid: bool, numbering: Numbering) -> None:
    """Add the arc of a bend, in two halves if its middle is a node."""
    i, rows = c.legs.near, numbering.rows
    pipe = model.pipes[i]
    n, m, f = (label + point for point in "NMF")
    halves = [(n, m, 0.0, 0.5), (m, f, 0.5, 1.0)] if has_mid else [(n, f, 0.0, 1.0)]
    if not has_mid:
        numbering.mid[m] = len(rows.names)
    for a, b, first, last in halves:
        part = Part(a, b, "bend", pipe.section, pipe.material, c.legs.bend.place.line)
        rows.arcs[len(rows.names)] = Share(label, first, last)
        rows.add(numbering.node(a), numbering.node(b), ARC, i, part)


def _point(label: str, pipe: int, corners: dict[str, Corner]) -> str:
    """End of a pipe's straight part: its label, or the near or far point of a bend there."""
    c = corners.get(label)
    if c is None:
        return label
    return label + ("N" if c.legs.near == pipe else "F")


def _vanished(model: Model, geometry: Geometry, numbering: Numbering) -> set[int]:
    """Pipes that bends use up exactly: their ends become one node."""
    gone: set[int] = set()
    for c in geometry.corners.values():
        for i in (c.legs.near, c.legs.far):
            pipe = model.pipes[i]
            a, b = (_point(label, i, geometry.corners) for label in (pipe.start, pipe.end))
            left = size(sub(geometry.points[b], geometry.points[a]))
            taken = sum(geometry.corners[x].tangent for x in _bent(pipe.start, pipe.end, geometry))
            if i not in gone and left <= VANISHED * (left + taken):
                gone.add(i)
                numbering.merge(a, b)
    return gone


def _bent(start: str, end: str, geometry: Geometry) -> list[str]:
    return [label for label in (start, end) if label in geometry.corners]
