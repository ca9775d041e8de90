"""Components joined to a network of nodes and straight runs; runs split where something stands."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from trunnion.formats.findings import Findings
from trunnion.formats.pcf.joints import CrowdedError, join
from trunnion.formats.pcf.parts import Part
from trunnion.formats.pcf.shapes import CENTRE, Form
from trunnion.frozen import frozen
from trunnion.system.vectors import Vec, add, dot, scale, size, sub, unit

PARALLEL = 0.999
MAX_PARTS = 20_000


@frozen
class Run:
    """A straight between two nodes, part of a component; `share` of its length and weight."""

    part: Part
    kind: str  # as in shapes.Leg
    a: int
    b: int
    share: float = 1.0
    ends: tuple[float | None, float | None] = (None, None)  # bores at a and b, as written


@dataclass(slots=True)
class Network:
    """Nodes by number with coordinates [m], runs, bends by the node of their intersection."""

    xyz: list[Vec]
    runs: list[Run]
    bends: dict[int, Form] = field(default_factory=dict)
    open_ends: dict[int, Part] = field(default_factory=dict)  # node: the only component there
    closed: set[int] = field(default_factory=set)
    cuts: dict[int, str] = field(default_factory=dict)  # open end that is no true end: why
    joints: int = 0  # nodes below are joints of ports
    port_node: dict[tuple[int, int], int] = field(default_factory=dict)  # (form, port): node
    widest: float = 0.0

    def delta(self, run: Run) -> Vec:
        """Vector of a run [m]."""
        return sub(self.xyz[run.b], self.xyz[run.a])

    def at(self) -> dict[int, list[int]]:
        """Numbers of the runs at each node."""
        found: dict[int, list[int]] = {}
        for i, run in enumerate(self.runs):
            found.setdefault(run.a, []).append(i)
            found.setdefault(run.b, []).append(i)
        return found


def build(forms: Sequence[Form], tolerance: float, findings: Findings) -> Network:
    """Join the ports and make nodes and runs.

    Parameters
    ----------
    tolerance : largest distance of two ports that are joined [m].
    """
    points, owners, keys = [], [], []
    for i, form in enumerate(forms):
        for j, port in enumerate(form.ports):
            points.append(port.xyz)
            owners.append(i)
            keys.append((i, j))
    try:
        joints = join(points, owners, tolerance)
    except CrowdedError:
        text = f"too many different points within {1000 * tolerance:g} mm of each other to join"
        findings.fault(forms[0].part.line if forms else 1, text)
        findings.stop()
        raise
    net = Network(list(joints.xyz), [], joints=len(joints.xyz), widest=joints.widest)
    net.port_node = dict(zip(keys, joints.of_port, strict=True))
    for i, form in enumerate(forms):
        _add(net, i, form)
    _find_open_ends(net, forms)
    return net


def _add(net: Network, i: int, form: Form) -> None:
    """Add the legs of one component."""
    centre = CENTRE
    if form.centre is not None:
        centre = len(net.xyz)
        net.xyz.append(form.centre)
        if form.radius is not None:
            net.bends[centre] = form
    lengths = []
    for leg in form.legs:
        p, q = (form.centre if n == CENTRE else form.ports[n].xyz for n in (leg.a, leg.b))
        lengths.append(size(sub(q, p)) if p is not None and q is not None else 0.0)
    total = sum(lengths) or 1.0
    for leg, length in zip(form.legs, lengths, strict=True):
        a, b = (centre if n == CENTRE else net.port_node[i, n] for n in (leg.a, leg.b))
        bores = [None if n == CENTRE else form.ports[n].bore for n in (leg.a, leg.b)]
        one = bores[0] or bores[1] or form.part.bore
        ends = (bores[0] or one, bores[1] or one)
        if a != b:
            net.runs.append(Run(form.part, leg.kind, a, b, length / total, ends))


def _find_open_ends(net: Network, forms: Sequence[Form]) -> None:
    """Note joints with a single component: those that want a mate, and caps at either end."""
    users: dict[int, set[int]] = {}
    for (i, _), node in net.port_node.items():
        users.setdefault(node, set()).add(i)
    mated = {i for (i, _), node in net.port_node.items() if len(users[node]) > 1}
    for (i, j), node in net.port_node.items():
        if len(users[node]) == 1:
            closes = forms[i].part.shape == "closed"
            if closes and (i in mated or j not in forms[i].open_ends):
                net.closed.add(node)
            elif j in forms[i].open_ends:
                net.open_ends[node] = forms[i].part


@frozen
class Hit:
    """Where a point lies: at a node, or on a run at a part of its length (then `node` is -1)."""

    node: int
    run: int
    along: float
    distance: float


class Places:
    """Nearest nodes and runs of points; for one state of a network."""

    def __init__(self, net: Network) -> None:
        self.net = net
        self.xyz: NDArray[np.float64] = np.array(net.xyz or [(0.0, 0.0, 0.0)], dtype=np.float64)
        ends = np.array([(r.a, r.b) for r in net.runs] or [(0, 0)], dtype=np.int64)
        self.ends = ends
        self.start = self.xyz[ends[:, 0]]
        self.way = self.xyz[ends[:, 1]] - self.start
        self.square = np.maximum(np.einsum("ij,ij->i", self.way, self.way), 1e-30)

    def node(self, point: Vec, tolerance: float) -> int:
        """Nearest node within the tolerance, or -1."""
        if not self.net.xyz:
            return -1
        far = np.linalg.norm(self.xyz - np.array(point), axis=1)
        best = int(far.argmin())
        return best if far[best] <= tolerance else -1

    def distances(self, point: Vec) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Distance of a point to the axis of every run [m], and the part of its length."""
        to = np.array(point) - self.start
        along = np.clip(np.einsum("ij,ij->i", to, self.way) / self.square, 0.0, 1.0)
        far = np.linalg.norm(to - along[:, None] * self.way, axis=1)
        return far, along

    def on_runs(self, point: Vec, reach: float, tolerance: float, kinds: Iterable[str]) -> Hit:
        """Where a point lies, a node first; distance is infinite where nothing is in reach."""
        node = self.node(point, tolerance)
        if node >= 0:
            return Hit(node, -1, 0.0, size(sub(self.net.xyz[node], point)))
        if not self.net.runs:
            return Hit(-1, -1, 0.0, float("inf"))
        far, along = self.distances(point)
        fit = np.array([run.kind in kinds for run in self.net.runs])
        far = np.where(fit, far, np.inf)
        best = int(far.argmin())
        if not far[best] <= reach:
            return Hit(-1, -1, 0.0, float("inf"))
        return Hit(-1, best, float(along[best]), float(far[best]))


def split(net: Network, hits: Sequence[Hit], tolerance: float) -> list[int]:
    """Split runs at all hits on them at once; give the node of each hit.

    A hit within the tolerance of an end of its run, or of another hit, shares that node.
    """
    nodes = [hit.node for hit in hits]
    on: dict[int, list[tuple[float, int]]] = {}
    for i, hit in enumerate(hits):
        if hit.node < 0 and hit.run >= 0:
            on.setdefault(hit.run, []).append((hit.along, i))
    for number, entries in on.items():
        run = net.runs[number]
        start, way = net.xyz[run.a], net.delta(run)
        length = size(way)
        cuts: list[tuple[float, int]] = [(0.0, run.a)]
        for along, i in sorted(entries):
            if (along - cuts[-1][0]) * length <= tolerance:
                nodes[i] = cuts[-1][1]
            elif (1.0 - along) * length <= tolerance:
                nodes[i] = run.b
            else:
                nodes[i] = len(net.xyz)
                net.xyz.append(add(start, scale(along, way)))
                cuts.append((along, nodes[i]))
        cuts.append((1.0, run.b))
        if len(cuts) == 2:
            continue
        pieces = [
            Run(run.part, run.kind, a, b, run.share * (t - s), run.ends)
            for (s, a), (t, b) in pairwise(cuts)
        ]
        net.runs[number] = pieces[0]
        net.runs += pieces[1:]
    return nodes


def overlaps(net: Network, tolerance: float) -> tuple[list[tuple[Run, Run]], list[tuple[int, Hit]]]:
    """Find ends of runs inside other runs.

    Returns
    -------
    Pairs of runs along the same axis that overlap; and open ends that lie on the axis of a run
    that goes another way (a branch without a fitting) with their hits.
    """
    places = Places(net)
    at = net.at()
    pairs: list[tuple[Run, Run]] = []
    branches: list[tuple[int, Hit]] = []
    lengths = np.sqrt(places.square)
    for node in range(net.joints):
        far, along = places.distances(net.xyz[node])
        inside = (far <= tolerance) & (np.minimum(along, 1.0 - along) * lengths > tolerance)
        own = at.get(node, [])
        for number in np.flatnonzero(inside).tolist():
            other = net.runs[number]
            mine = [net.runs[i] for i in own if net.runs[i].part is not other.part]
            if not mine or node in (other.a, other.b):
                continue
            way = unit(net.delta(other))
            same = next((r for r in mine if abs(dot(unit(net.delta(r)), way)) > PARALLEL), None)
            if same is not None:
                pairs.append((same, other))
            elif node in net.open_ends and not any(node == n for n, _ in branches[-1:]):
                hit = Hit(-1, number, float(along[number]), float(far[number]))
                branches.append((node, hit))
    return pairs, branches
