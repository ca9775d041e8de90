"""The network of a line becomes a model: pipes, bends, bodies, reducers, masses."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from trunnion.formats.findings import Findings
from trunnion.formats.pcf.attach import Attached
from trunnion.formats.pcf.bends import merge_tangents, settle
from trunnion.formats.pcf.network import Network, Run
from trunnion.formats.pcf.operations import one_operation
from trunnion.formats.pcf.parts import Part
from trunnion.formats.pcf.properties import Properties, Resolver
from trunnion.formats.pcf.walk import Walk, walk
from trunnion.formats.sidetable import G
from trunnion.model import Bend, Mass, Model, Node, Pipe, Reducer
from trunnion.system.vectors import Vec, cross, dot, scale, size, sub, unit

COLLINEAR = 1e-3  # as system.tangents: pipes that turn by less count as one line [rad]
DIGITS = 12  # of lengths [m]: a bend must still fit its tangents to 1e-9
STEEPEST = 0.5  # cosine between the axis of an eccentric reducer and its run, as system.checks
_NAMED = ("FLANGE", "VALVE")
_BODIES = ("rigid", "angle", "ways", "closed")


@dataclass(slots=True)
class Line:
    """A model with the labels of the network's nodes.

    `labels` holds every node, near, middle and far points of bends too; `pipes_at` the pipes at
    each node with their direction away from it.
    """

    model: Model
    labels: dict[int, str]
    net: Network
    pipes_at: dict[int, list[tuple[Pipe, Vec]]] = field(default_factory=dict)

    def along(self, node: int) -> str | None:
        """Pipe "30-40" that GUIDE and LIMIT follow where the pipes at a node turn; else None."""
        pipes = self.pipes_at.get(node, [])
        ways = [way for _, way in pipes]
        if all(size(cross(ways[0], way)) <= COLLINEAR for way in ways[1:]):
            return None
        run = next(
            (
                p
                for i, (p, way) in enumerate(pipes)
                if any(
                    i != j and size(cross(way, other)) <= COLLINEAR for j, other in enumerate(ways)
                )
            ),
            pipes[0][0],
        )
        return f"{run.start}-{run.end}"


def assemble(
    model: Model,
    net: Network,
    resolver: Resolver,
    attached: Attached,
    circles: Mapping[int, str],
    masses: list[tuple[Part, int]],
    first: list[int],
    findings: Findings,
) -> Line:
    """Put nodes, pipes, bends and masses into a model.

    Parameters
    ----------
    circles : node numbers of the drawing by node.
    masses : components without length and the node that carries them.
    first : nodes to start the walk from.
    """
    made: list[tuple[Run, Properties]] = []
    for run in net.runs:
        made.append((run, resolver.properties(run.part, run.ends[0])))
    keep = {node for _, node in masses} | {*net.open_ends, *first}
    runs, gone = merge_tangents(net, one_operation(made, findings), keep)
    radii = settle(net, runs)
    way = walk(net, runs, gone, attached.middles, circles, first)
    _add_pipes(model, net, way, attached, resolver, findings)
    line = Line(model, {}, net)
    line.labels = _labels(model, net, way, gone, attached)
    for centre, form in net.bends.items():
        if centre in way.labels and centre in radii:
            bend = Bend(
                way.labels[centre],
                round(radii[centre], DIGITS),
                place=findings.place(form.part.line),
            )
            model.bends.append(bend)
            findings.note(bend, _says(form.part))
    for part, node in masses:
        weight = body_weight(part, resolver, findings)
        if weight > 0.0 and node in line.labels:
            mass = Mass(line.labels[node], weight / G, findings.place(part.line))
            model.masses.append(mass)
            findings.note(mass, f"{_says(part)}: no length, its weight at the node")
        elif part.shape == "closed" and node in line.labels:
            text = f"closes node {line.labels[node]}; without length or weight it is nothing else"
            findings.assume(f"{part.name}: {text}", part.line)
    _index(line, way, gone)
    return line


def _add_pipes(
    model: Model,
    net: Network,
    way: Walk,
    attached: Attached,
    resolver: Resolver,
    findings: Findings,
) -> None:
    """Add a NODE for the start of each part, then every run in walking order."""
    name = _Namer(way, attached)
    for start in way.starts:
        model.nodes.append(Node(way.labels[start], net.xyz[start]))
    weights: dict[int, float] = {}
    near: dict[int, list[Run]] = {}
    for run, _ in way.runs:
        near.setdefault(run.a, []).append(run)
        near.setdefault(run.b, []).append(run)
    for run, what in way.runs:
        part = run.part
        body = run.kind == "rigid" and part.shape in (*_BODIES, "gasket", "fitting")
        if body and part.line not in weights:
            weights[part.line] = body_weight(part, resolver, findings)
        stiff = run.kind == "inside" or (body and not _weighs_as_pipe(part, resolver))
        section, reducer = what.section, None
        if run.kind == "reducer":
            section, reducer = _taper(net, run, near, resolver, findings)
        pipe = Pipe(
            name(run.a),
            name(run.b),
            _delta(net, run),
            section,
            what.material,
            what.operation,
            rigid=stiff,
            body=next((b for b in _NAMED if stiff and body and part.keyword.startswith(b)), ""),
            reducer=reducer,
            weight=round(weights.get(part.line, 0.0) * run.share, 9) if stiff and body else 0.0,
            place=findings.place(part.line),
        )
        model.pipes.append(pipe)
        findings.note(pipe, _says(part))


def _delta(net: Network, run: Run) -> Vec:
    """Vector of a run, without the noise that large coordinates leave in the last digits [m]."""
    x, y, z = sub(net.xyz[run.b], net.xyz[run.a])
    return round(x, DIGITS) + 0.0, round(y, DIGITS) + 0.0, round(z, DIGITS) + 0.0


def _taper(
    net: Network, run: Run, near: Mapping[int, list[Run]], resolver: Resolver, findings: Findings
) -> tuple[str, Reducer | None]:
    """Section at the start of a reducer, and what makes it one; none if both bores are equal."""
    one, other = (resolver.properties(run.part, bore).section for bore in run.ends)
    if one == other:
        findings.assume(f"{run.part.name}: both bores are equal; taken as pipe", run.part.line)
        return one, None
    axis = None
    along = unit(net.delta(run))
    for pipe in (p for node in (run.a, run.b) for p in near.get(node, ()) if p.part != run.part):
        way = unit(net.delta(pipe))
        cosine = dot(way, along)
        if STEEPEST < abs(cosine) < 1.0 - 1e-9:
            x, y, z = scale(1.0 if cosine > 0.0 else -1.0, way)
            axis = (round(x, DIGITS) + 0.0, round(y, DIGITS) + 0.0, round(z, DIGITS) + 0.0)
            break
    return one, Reducer(other, axis if run.part.keyword == "REDUCER-ECCENTRIC" else None)


def _weighs_as_pipe(part: Part, resolver: Resolver) -> bool:
    """Tell whether a body is modelled as pipe: a coupling or cap without a weight of its own."""
    light = part.shape == "fitting" or part.keyword in ("CAP", "PLUG")
    return light and resolver.weight(part) is None


def body_weight(part: Part, resolver: Resolver, findings: Findings) -> float:
    """Weight [N] of a stiff body; one that nothing gives is an error, for it would count as 0."""
    weight = resolver.weight(part)
    if weight is not None:
        return weight
    if part.shape in _BODIES and not _weighs_as_pipe(part, resolver):
        text = "its weight is not in the file (give WEIGHT in the side table, 0 if it has none)"
        findings.leave_out(part.line, part.name, f"{text}; taken as 0")
    return 0.0


def _says(part: Part) -> str:
    """Comment that says what a card came from."""
    tag = part.get("ITEM-CODE") or ""
    text = part.description or part.get("DESCRIPTION") or ""
    words = " ".join(x for x in (tag, text[:60]) if x)
    return f"line {part.line}: {part.keyword}{' ' + words if words else ''}"


class _Namer:
    """Labels of nodes while pipes are made; the middle of a bend is 30M."""

    def __init__(self, way: Walk, attached: Attached) -> None:
        self.way = way
        self.attached = attached

    def __call__(self, node: int) -> str:
        centre = self.attached.middles.get(node)
        return self.way.labels[node] if centre is None else f"{self.way.labels[centre]}M"


def _labels(
    model: Model, net: Network, way: Walk, gone: Mapping[int, int], attached: Attached
) -> dict[int, str]:
    """Labels of all nodes; near and far as system.bends decides: by the order of the pipes."""
    labels = dict(way.labels)
    labels |= {m: f"{way.labels[c]}M" for m, c in attached.middles.items() if c in way.labels}
    entry: dict[str, Vec] = {}
    centres = {way.labels[c]: c for c in net.bends if c in way.labels}
    for pipe in model.pipes:
        for end in (pipe.start, pipe.end):
            if end in centres and end not in entry and pipe.delta is not None:
                x, y, z = pipe.delta
                entry[end] = (x, y, z) if pipe.start == end else (-x, -y, -z)
    for joint, centre in gone.items():
        if centre in way.labels:
            label = way.labels[centre]
            to = unit(sub(net.xyz[joint], net.xyz[centre]))
            near = size(sub(to, unit(entry[label]))) < 1e-2
            labels[joint] = f"{label}{'N' if near else 'F'}"
    return labels


def _index(line: Line, way: Walk, gone: Mapping[int, int]) -> None:
    """Note which pipes meet at each node, and that bend points lie on one line."""
    for (run, _), pipe in zip(way.runs, line.model.pipes, strict=True):
        if pipe.delta is None:
            continue
        to = unit(pipe.delta)
        line.pipes_at.setdefault(run.a, []).append((pipe, to))
        line.pipes_at.setdefault(run.b, []).append((pipe, (-to[0], -to[1], -to[2])))
