"""Places: disconnected parts get their coordinates, loops that do not quite close are closed."""

from collections.abc import Mapping
from dataclasses import replace
from math import cos

from trunnion.formats.caesar.geometry import Labels, size
from trunnion.formats.caesar.job import Job, Vec
from trunnion.formats.findings import Findings
from trunnion.model import Model, Node

LOOP = 0.0254  # gap of a loop that is closed, as the program's own tolerance of 1 inch [m]
EXACT = 1e-9  # [m]
RELATIVE = 5e-7  # of the extent: gaps that Trunnion itself bears

Edge = tuple[str, str, Vec, int]  # from, to, offset, number of the pipe or -1


class Parts:
    """Follows the pipes from node to node."""

    def __init__(self, job: Job, labels: Labels, model: Model, findings: Findings) -> None:
        self.job = job
        self.labels = labels
        self.model = model
        self.findings = findings
        self.position: dict[str, Vec] = {}

    def place(self) -> None:
        """Write NODE cards where they are needed; mend the gaps of loops."""
        edges = self._edges()
        near: dict[str, list[int]] = {}
        for k, (a, b, *_) in enumerate(edges):
            near.setdefault(a, []).append(k)
            near.setdefault(b, []).append(k)
        given = self._given()
        roots: list[tuple[str, Vec]] = []
        closing: list[int] = []
        ties = self._ties()
        tied: list[tuple[str, Vec]] = []  # parts that a CNODE joins to what is placed
        waiting = [*given, *(pipe.start for pipe in self.model.pipes)]
        for first in waiting:
            if first in self.position or first not in near:
                continue
            tied.append((first, self._start(first, given)))
            while tied:
                label, place = tied.pop()
                if label in self.position:
                    continue
                roots.append((label, place))
                for new in self._follow(label, place, edges, near, closing):
                    here = self.position[new]
                    tied += [(b, here) for b in ties.get(new, ()) if b in near and b not in given]
        if len(roots) > 1 or (roots and any(roots[0][1])):
            for label, place in roots:
                made = Node(label, place, self.findings.place(self._line(label)))
                self.model.nodes.append(made)
        self.model.nodes.sort(key=lambda node: node.place.line)
        self._close(edges, closing)

    def _ties(self) -> dict[str, list[str]]:
        """Labels that supports and springs join to each other."""
        found: dict[str, list[str]] = {}
        ties = [(s.node, s.cnode) for s in self.model.supports if s.cnode is not None]
        for one, other in [*ties, *((s.start, s.end) for s in self.model.springs)]:
            found.setdefault(one, []).append(other)
            found.setdefault(other, []).append(one)
        return found

    def _edges(self) -> list[Edge]:
        """Pipes and the points of bends."""
        edges: list[Edge] = []
        for number, pipe in enumerate(self.model.pipes):
            if pipe.delta is not None:
                edges.append((pipe.start, pipe.end, pipe.delta, number))
        for node, c in self.labels.corners.items():
            before, after = self.job.elements[c.before], self.job.elements[c.after]
            a = _unit(before.delta)
            b = _unit(after.delta) if after.start == node else _unit(_times(-1.0, after.delta))
            middle = _times(c.radius * (1.0 / cos(0.5 * c.turn) - 1.0), _unit(_minus(b, a)))
            tip = str(node)
            edges += [
                (tip, f"{tip}N", _times(-c.tangent, a), -1),
                (tip, f"{tip}M", middle, -1),
                (tip, f"{tip}F", _times(c.tangent, b), -1),
            ]
        return edges

    def _given(self) -> Mapping[str, Vec]:
        """Coordinates of the file by label."""
        found: dict[str, Vec] = {}
        for line, node, xyz in self.job.coordinates:
            label = self.labels.node(node)
            if label is None:
                text = f"coordinates of node {node}, which no element has"
                self.findings.leave_out(line, f"node {node}", text)
            else:
                found[label] = xyz
        return found

    def _start(self, label: str, given: Mapping[str, Vec]) -> Vec:
        """Choose where a part starts that nothing joins to what is placed."""
        if label in given:
            return given[label]
        if self.position:
            text = f"the part that starts at node {label} has no coordinates: it starts at 0 0 0"
            self.findings.assume(text, self._line(label))
        return 0.0, 0.0, 0.0

    def _follow(
        self,
        root: str,
        place: Vec,
        edges: list[Edge],
        near: Mapping[str, list[int]],
        closing: list[int],
    ) -> list[str]:
        """Place all that hangs on a root, and list it; edges between placed labels close loops."""
        self.position[root] = place
        used: set[int] = set()
        queue = [root]
        for label in queue:
            for k in near.get(label, ()):
                if k in used:
                    continue
                used.add(k)
                a, b, offset, _ = edges[k]
                other, step = (b, offset) if a == label else (a, _times(-1.0, offset))
                if other in self.position:
                    closing.append(k)
                    continue
                x, y, z = self.position[label]
                self.position[other] = (x + step[0], y + step[1], z + step[2])
                queue.append(other)
        return queue

    def _close(self, edges: list[Edge], closing: list[int]) -> None:
        """Give pipes that end a small way beside their node the length that they need."""
        spans = [max(row) - min(row) for row in zip(*self.position.values(), strict=True)]
        bear = RELATIVE * max(spans, default=0.0) + EXACT
        for k in closing:
            a, b, offset, number = edges[k]
            need = _minus(self.position[b], self.position[a])
            gap = size(_minus(need, offset))
            if gap <= bear or number < 0:
                continue
            pipe = self.model.pipes[number]
            text = f"the loop at element {pipe.start}-{pipe.end} is open by {1e3 * gap:.4g} mm"
            if gap > LOOP:
                more = f"{text}; it is given the missing length"
                self.findings.leave_out(pipe.place.line, "loop", more)
            new = replace(pipe, delta=need)
            self.model.pipes[number] = new
            self.findings.renote(pipe, new)
            if gap <= LOOP:
                self.findings.assume(
                    f"{text}: this element was given the missing length", pipe.place.line
                )

    def _line(self, label: str) -> int:
        """Line of the first element at a label."""
        digits = label.rstrip("NMF")
        here = self.labels.at.get(int(digits)) if digits.isdigit() else None
        return self.job.elements[here[0]].line if here else self.job.elements[0].line


def _times(f: float, v: Vec) -> Vec:
    return f * v[0], f * v[1], f * v[2]


def _minus(a: Vec, b: Vec) -> Vec:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _unit(v: Vec) -> Vec:
    return _times(1.0 / size(v), v)
