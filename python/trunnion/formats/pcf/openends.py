"""Ends without a mate: gaps in the line, branches that end on a pipe, true ends."""

from collections.abc import Callable, Iterable, Mapping

import numpy as np

from trunnion.formats.findings import Findings
from trunnion.formats.pcf.network import Hit, Network, Places, Run, overlaps, split
from trunnion.formats.pcf.parts import Part
from trunnion.formats.pcf.points import Point
from trunnion.system.vectors import dot, size, sub, unit

GAP = 0.1  # [m]; or two bores
NEAR = 0.05  # [m]: ends nearer than this miss each other; others must also face each other
FACING = 0.8  # cosine between the outward direction of an end and the way to the other
MOST_OPEN = 0.5  # of all ends; more are a list of parts
FEW = 4  # open ends that a short line with branches may have

Outside = Callable[[Part], float]  # outside diameter of a component [m], 0 if not known


def where(net: Network, node: int, unit_length: float = 1e-3) -> str:
    """Write coordinates as in the file: "E 1000.00 N 0.00 U 500.00 mm"."""
    return "E {:.2f} N {:.2f} U {:.2f} mm".format(*(x / unit_length for x in net.xyz[node]))


def refuse_overlaps(net: Network, tolerance: float, findings: Findings) -> None:
    """Refuse runs that lie on each other; join open ends on the axis of a pipe to it."""
    pairs, branches = overlaps(net, tolerance)
    told = set()
    for a, b in pairs:
        lines = (min(a.part.line, b.part.line), max(a.part.line, b.part.line))
        if lines not in told:
            told.add(lines)
            text = f"{a.part.name} overlaps {b.part.name}: an end of one lies inside the other"
            findings.fault(lines[1], text)
    nodes = split(net, [hit for _, hit in branches], tolerance)
    for (node, _), on in zip(branches, nodes, strict=True):
        part = net.open_ends.pop(node)
        text = "branch without a fitting, joined to the axis of the pipe on which it ends"
        findings.assume(f"{part.name}: {text}", part.line)
        _merge(net, node, on)


def _merge(net: Network, old: int, new: int) -> None:
    """Make two nodes one."""
    for i, run in enumerate(net.runs):
        if old in (run.a, run.b):
            a, b = (new if n == old else n for n in (run.a, run.b))
            net.runs[i] = Run(run.part, run.kind, a, b, run.share, run.ends)
    net.port_node = {key: new if n == old else n for key, n in net.port_node.items()}


def join_to_surface(net: Network, tolerance: float, outside: Outside, findings: Findings) -> None:
    """Join open ends that end on the surface of a pipe: stiff from its axis to the end."""
    places = Places(net)
    at = net.at()
    found: list[tuple[int, Hit]] = []
    for node, part in net.open_ends.items():
        far, along = places.distances(net.xyz[node])
        for number in np.argsort(far)[:8].tolist():
            run = net.runs[number]
            reach = 0.5 * outside(run.part) + tolerance
            inside = min(along[number], 1.0 - along[number]) * size(net.delta(run)) > tolerance
            if run.part is part or far[number] > reach or not inside or run.kind != "pipe":
                continue
            way = unit(net.delta(run))
            if any(abs(dot(unit(net.delta(net.runs[i])), way)) > 0.9 for i in at.get(node, ())):
                continue
            found.append((node, Hit(-1, number, float(along[number]), float(far[number]))))
            break
    for (node, _), on in zip(found, split(net, [hit for _, hit in found], tolerance), strict=True):
        part = net.open_ends.pop(node)
        net.runs.append(Run(part, "inside", on, node, 0.0, (part.bore, part.bore)))
        text = (
            "branch without a fitting, ends on the surface of a pipe: stiff from there to its axis"
        )
        findings.assume(f"{part.name}: {text}", part.line)


def mark_cuts(net: Network, points: Iterable[tuple[str, Point]]) -> None:
    """Note which open ends are none of the line: something that the model lacks stands there.

    Parameters
    ----------
    points : what stands there, and where.
    """
    nodes = sorted(net.open_ends)
    xyz = np.array([net.xyz[n] for n in nodes]).reshape(-1, 3)
    for name, point in points if nodes else ():
        far = np.linalg.norm(xyz - np.array(point.xyz), axis=1)
        best = int(far.argmin())
        if far[best] <= NEAR:
            net.cuts.setdefault(nodes[best], name)


def report_gaps(net: Network, outside: Outside, findings: Findings) -> None:
    """Report pairs of open ends that are near each other: a gap in the line, with both ends."""
    nodes = sorted(n for n in net.open_ends if n not in net.cuts)
    if len(nodes) < 2:
        return
    xyz = np.array([net.xyz[n] for n in nodes])
    at = net.at()
    told: set[int] = set()
    for i, node in enumerate(nodes):
        if node in told:
            continue
        part = net.open_ends[node]
        far = np.linalg.norm(xyz - xyz[i], axis=1)
        for j in np.argsort(far).tolist():
            other = net.open_ends[nodes[j]]
            if j == i or other is part:
                continue
            if far[j] > max(GAP, 2.0 * outside(part)):
                break
            if far[j] > NEAR and not _facing(net, node, nodes[j], at):
                continue  # two ends of their own, each of which is reported as free
            told |= {node, nodes[j]}
            for n in (node, nodes[j]):
                net.cuts.setdefault(n, f"gap of {1000 * far[j]:.2f} mm in the line")
            text = (
                f"gap of {1000 * far[j]:.2f} mm in the line: {part.name} ends at "
                f"{where(net, node)}, {other.name} at {where(net, nodes[j])}; not joined "
                "(a larger --tolerance joins them)"
            )
            findings.leave_out(max(part.line, other.line), "line", text)
            break


def _facing(net: Network, a: int, b: int, at: Mapping[int, list[int]]) -> bool:
    """Tell whether two open ends point at each other."""
    way = unit(sub(net.xyz[b], net.xyz[a]))
    for node, sign in ((a, 1.0), (b, -1.0)):
        for number in at.get(node, ()):
            run = net.runs[number]
            out = unit(sub(net.xyz[node], net.xyz[run.b if run.a == node else run.a]))
            if sign * dot(out, way) < FACING:
                return False
    return True


def refuse_loose(net: Network, ports: int, findings: Findings) -> None:
    """Refuse a list of fittings that is no line."""
    loose = len(net.open_ends)
    if loose > max(FEW, MOST_OPEN * ports):
        text = f"{loose} of {ports} ends have no mate: this is a list of parts, not a line"
        first = min(part.line for part in net.open_ends.values())
        findings.leave_out(first, "file", text)
