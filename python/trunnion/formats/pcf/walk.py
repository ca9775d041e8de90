"""Order and names: the line is walked from an end, nodes are numbered 10, 20 ... on the way.

Numbers in circles on the drawing (the node numbers of the stress model that wrote the file) are
kept where they stand on a joint.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from trunnion.formats.pcf.network import Network, Run
from trunnion.formats.pcf.properties import Properties
from trunnion.system.vectors import dot, sub, unit

STEP = 10
Made = tuple[Run, Properties]


@dataclass(slots=True)
class Walk:
    """Runs in walking order, turned so that each starts where it was reached; labels of nodes."""

    runs: list[Made] = field(default_factory=list)
    labels: dict[int, str] = field(default_factory=dict)
    starts: list[int] = field(default_factory=list)  # first node of each part that is on its own


def walk(
    net: Network,
    runs: Sequence[Made],
    gone: Mapping[int, int],
    middles: Mapping[int, int],
    circles: Mapping[int, str],
    first: Sequence[int],
) -> Walk:
    """Walk all runs, straight on where lines meet, then along the branches.

    Parameters
    ----------
    gone : joints that are points of a bend.
    middles : middles of bends: node -> intersection.
    circles : numbers of the drawing by node.
    first : nodes to start from, best first.
    """
    made = Walk()
    near: dict[int, list[int]] = {}
    for i, (run, _) in enumerate(runs):
        near.setdefault(run.a, []).append(i)
        near.setdefault(run.b, []).append(i)
    sides: dict[int, list[int]] = {}
    for middle, centre in middles.items():
        sides.setdefault(centre, []).append(middle)
    points: dict[int, list[int]] = {}
    for joint, centre in gone.items():
        points.setdefault(centre, []).append(joint)
    names = _Names(circles)
    used: set[int] = set()
    seen: set[int] = set()
    order = [*first, *(n for n in near if n not in net.bends), *near]
    for start in order:
        if start in seen or start not in near or start in middles:
            continue
        made.starts.append(start)
        stack: list[tuple[int, int]] = [(start, -1)]
        while stack:
            node, came = stack.pop()
            if came >= 0:
                if came in used:
                    continue
                used.add(came)
                made.runs.append(_turned(runs[came], node))
            if node in seen:
                continue
            seen.add(node)
            if node not in middles:
                far = _far_joint(node, came, runs, points.get(node, ()), net)
                made.labels[node] = names.label(node, far)
            ways = [i for i in near.get(node, ()) if i not in used]
            ahead = sorted(ways, key=lambda i: _turn(net, runs, node, came, i), reverse=True)
            beside = [(n, -1) for n in (*sides.get(node, ()), middles.get(node, -1)) if n >= 0]
            stack[:0] = beside
            stack += [(_other(runs[i][0], node), i) for i in ahead]
    return made


class _Names:
    """Labels: the number of the drawing, else the next multiple of ten that is free."""

    def __init__(self, circles: Mapping[int, str]) -> None:
        self.circles = circles
        self.taken: set[str] = set()
        reserved = {int(x) for x in circles.values()}
        top = max(reserved, default=0)
        self.next = (top // STEP + 1) * STEP

    def label(self, node: int, other: int) -> str:
        """Label of a node; `other` is the joint at the far end of a bend."""
        for candidate in (node, other):
            text = self.circles.get(candidate)
            if text is not None and str(int(text)) not in self.taken:
                self.taken.add(str(int(text)))
                return str(int(text))
        text = str(self.next)
        self.next += STEP
        self.taken.add(text)
        return text


def _far_joint(
    node: int, came: int, runs: Sequence[Made], points: Sequence[int], net: Network
) -> int:
    """Joint at the far end of a bend that was reached along run `came`; -1 if there is none."""
    if node not in net.bends or came < 0:
        return -1
    c = net.xyz[node]
    back = unit(sub(net.xyz[_other(runs[came][0], node)], c))
    return next((j for j in points if dot(unit(sub(net.xyz[j], c)), back) < 0.999), -1)


def _turned(made: Made, end: int) -> Made:
    """Let a run end at a node."""
    run, what = made
    if run.b == end:
        return made
    return Run(run.part, run.kind, run.b, run.a, run.share, (run.ends[1], run.ends[0])), what


def _turn(net: Network, runs: Sequence[Made], node: int, came: int, i: int) -> float:
    """How much the line turns: 0 straight on, 2 back."""
    if came < 0:
        return 0.0
    back = unit(sub(net.xyz[_other(runs[came][0], node)], net.xyz[node]))
    way = unit(sub(net.xyz[_other(runs[i][0], node)], net.xyz[node]))
    return 1.0 + dot(back, way)


def _other(run: Run, node: int) -> int:
    return run.b if run.a == node else run.a
