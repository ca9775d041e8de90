"""Labels and bends: which label of the model each node of the job is."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import cached_property
from math import acos, degrees, tan

from trunnion.formats.caesar.job import MIDDLE, Element, Job, Vec
from trunnion.formats.caesar.units import clean
from trunnion.formats.findings import Findings
from trunnion.frozen import frozen

STRAIGHT = 1e-5  # two elements that turn by less make no bend [rad]
SAME_ANGLE = 0.1  # [deg]: a node this near to 0, the middle or the end of an arc is there
SNAP = 1e-5  # a tangent that uses up its element to this length uses it up exactly [m]
EVEN = 1e-9  # a body this little longer than the tangent of its bend is no longer [m]
SHORT = 0.01  # of its length: an element may be so much too short for its bends


@frozen
class Corner:
    """A bend: element before and after (from 0), turn [rad], tangent length, radius [m]."""

    before: int
    after: int
    turn: float
    tangent: float
    radius: float


class Labels:
    """Labels of the model for nodes of the job."""

    def __init__(self, job: Job, findings: Findings) -> None:
        self.job = job
        self.findings = findings
        self.at: dict[int, list[int]] = {}
        for i, e in enumerate(job.elements):
            for node in (e.start, e.end):
                self.at.setdefault(node, []).append(i)
        self.corners: dict[int, Corner] = {}
        self.arc: dict[int, str] = {}  # node on an arc -> its label
        for i, e in enumerate(job.elements):
            if e.bend is not None:
                self._corner(i, e)
        self._use_up()
        for node, corner in self.corners.items():
            self._arc(node, corner)

    def end(self, i: int, node: int) -> str:
        """Label of an end of element `i`."""
        corner = self.corners.get(node)
        if corner is not None:
            return str(node) if i in (corner.before, corner.after) else f"{node}F"
        return self.arc.get(node, str(node))

    def node(self, node: int) -> str | None:
        """Label of a node that something stands on; None: there is no such node."""
        if node in self.arc:
            return self.arc[node]
        return str(node) if node in self.at else None

    def standing(self, node: int) -> str | None:
        """Label of a node that supports or loads stand on; one that is only a CNODE has one too."""
        return self.node(node) or (str(node) if node in self.connecting else None)

    def cnode(self, node: int, line: int, what: str) -> str | None:
        """Label of a CNODE, None for the ground: 0, or a node that nothing at all holds."""
        label = self.node(node) if node else None
        if not node or label is not None:
            return label
        if node in self.used:
            return str(node)
        text = f"{what} with CNODE {node}, which no element has and nothing holds; taken to ground"
        self.findings.leave_out(line, f"node {node}", text)
        return None

    @cached_property
    def connecting(self) -> set[int]:
        """Nodes that supports, hangers and nozzles are connected to."""
        job = self.job
        found = {r.cnode for e in job.elements for r in e.restraints}
        return found | {h.cnode for h in job.hangers} | {z.vessel for z in job.nozzles}

    def ends(self, i: int) -> tuple[str, str]:
        """Labels of both ends of element `i`."""
        e = self.job.elements[i]
        return self.end(i, e.start), self.end(i, e.end)

    def weld(self, i: int) -> str | None:
        """Label where the tangent of a bend ends and element `i`, a body that leaves it, begins.

        None: it is no body, leaves no bend, ends in one, or is no longer than the tangent.
        """
        e = self.job.elements[i]
        corner = self.corners.get(e.start)
        body = (e.rigid, e.reducer, e.joint) != (None, None, None)
        if not body or corner is None or self.tangent_at(i) != [e.start] or corner.after != i:
            return None
        return f"{e.start}T" if size(e.delta) - corner.tangent > EVEN else None

    def pipe_at(self, i: int, node: int) -> str:
        """Name the pipe of the model by which element `i` reaches one of its nodes: "30-40"."""
        start, end = self.ends(i)
        weld = self.weld(i)
        if weld is None:
            return f"{start}-{end}"
        return f"{start}-{weld}" if node == self.job.elements[i].start else f"{weld}-{end}"

    def _corner(self, i: int, e: Element) -> None:
        """Find the element that leaves a bend, and its turn."""
        bend = e.bend
        assert bend is not None
        name = f"element {e.start}-{e.end}"
        if e.end in self.corners:
            self.findings.fault(bend.line, f"{name}: node {e.end} has a bend already")
            return
        after = outgoing(self.job.elements, i, self.at[e.end])
        if after is None:
            text = f"{name}: the bend at {e.end} has no element that leaves it"
            self.findings.fault(bend.line, text)
            return
        other = self.job.elements[after]
        out = other.delta if other.start == e.end else _minus(other.delta)
        if e.rigid is not None:
            text = "bend on a rigid element; taken as a corner without bend"
            self.findings.leave_out(bend.line, name, text)
            return
        turn = turn_of(e.delta, out)
        if turn < STRAIGHT:
            self.findings.assume(
                f"the bend at {e.end} does not turn: it is straight pipe", bend.line
            )
            return
        if turn > 3.1:
            self.findings.fault(bend.line, f"{name}: the pipe turns back on itself at {e.end}")
            return
        tangent = bend.radius * tan(0.5 * turn)
        self.corners[e.end] = Corner(i, after, turn, tangent, bend.radius)

    def _use_up(self) -> None:
        """Let tangents that use up an element use it up exactly.

        Rounding leaves or lacks a hair; what lacks more, up to 1 % as in the program, is reported.
        """
        radii = {node: c.radius for node, c in self.corners.items()}
        for _ in range(3):
            for i, e in enumerate(self.job.elements):
                mine = self.tangent_at(i)
                used, length = sum(self.corners[n].tangent for n in mine), size(e.delta)
                if mine and used != length and length - SNAP <= used <= length * (1.0 + SHORT):
                    for n in mine:
                        self._scale(n, length / used)
        for i, e in enumerate(self.job.elements):
            used, length = sum(self.corners[n].tangent for n in self.tangent_at(i)), size(e.delta)
            if used > length + SNAP:
                text = f"element {e.start}-{e.end} is {1e3 * length:.6g} mm long; its bends need "
                self.findings.fault(e.line, f"{text}{1e3 * used:.6g} mm")
        for node, radius in radii.items():
            corner = self.corners[node]
            if corner.radius < radius - SNAP:
                e = self.job.elements[corner.before]
                text = f"the bend at {node} does not fit into its pipes by a hair: its radius is "
                text += f"{1e3 * corner.radius:.6g} mm, not {1e3 * radius:.6g}"
                self.findings.assume(text, e.bend.line if e.bend else e.line)

    def tangent_at(self, i: int) -> list[int]:
        """Nodes of the bends that element `i` is a tangent of."""
        e = self.job.elements[i]
        ends = [n for n in (e.start, e.end) if n in self.corners]
        return [n for n in ends if i in (self.corners[n].before, self.corners[n].after)]

    def _scale(self, node: int, factor: float) -> None:
        c = self.corners[node]
        radius = clean(c.radius * factor)
        self.corners[node] = replace(c, tangent=c.tangent * factor, radius=radius)

    def _arc(self, node: int, corner: Corner) -> None:
        """Give the nodes on an arc their labels."""
        e = self.job.elements[corner.before]
        assert e.bend is not None
        turn = degrees(corner.turn)
        places = {"N": 0.0, "M": 0.5 * turn, "F": turn}
        for angle, label in e.bend.nodes:
            if abs(angle - MIDDLE) < 1e-3:
                angle = places["M"]
            point = min(places, key=lambda p: abs(places[p] - angle))
            if abs(places[point] - angle) > SAME_ANGLE and label in self.used:
                text = f"node {label} at {angle:g} degrees of the bend at {node}"
                text += f"; taken to the point at {places[point]:g} degrees"
                self.findings.leave_out(e.bend.line, f"element {e.start}-{e.end}", text)
            if label != node and label not in self.corners:
                self.arc[label] = f"{node}{point}"

    @cached_property
    def used(self) -> set[int]:
        """Nodes that anything stands on, or that an element has."""
        return nodes_used(self.job)


def nodes_used(job: Job) -> set[int]:
    """Nodes that anything stands on, or that an element has."""
    used = {r.node for e in job.elements for r in e.restraints}
    used |= {s.node for e in job.elements for s in (*e.displacements, *e.forces)}
    used |= {n for e in job.elements for n in (e.start, e.end)}
    return used | {h.node for h in job.hangers}


def outgoing(elements: Sequence[Element], i: int, here: Iterable[int] | None = None) -> int | None:
    """Element that leaves the bend of element `i`: the next of the file, else the first other one.

    Parameters
    ----------
    here : elements at the node of the bend, if that is known.
    """
    node = elements[i].end
    following = elements[i + 1] if i + 1 < len(elements) else None
    if following is not None and following.start == node and size(following.delta) > 0.0:
        return i + 1
    if here is None:
        here = (j for j, e in enumerate(elements) if node in (e.start, e.end))
    return next((j for j in here if j != i and size(elements[j].delta) > 0.0), None)


def turn_of(before: Vec, after: Vec) -> float:
    """Angle by which the pipe turns from one direction to the next [rad]."""
    cosine = _dot(before, after) / (size(before) * size(after)) if size(before) else 1.0
    return acos(min(1.0, max(-1.0, cosine)))


def size(v: Vec) -> float:
    """Length of a vector."""
    return float((v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) ** 0.5)


def _dot(a: Vec, b: Vec) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _minus(a: Vec) -> Vec:
    return -a[0], -a[1], -a[2]
