"""Olets and supports find their place on the network; runs are split there, bends get a middle."""

from dataclasses import dataclass, field
from math import inf

from trunnion.formats.findings import Findings
from trunnion.formats.pcf.network import Hit, Network, Places, Run, split
from trunnion.formats.pcf.openends import Outside
from trunnion.formats.pcf.parts import Part
from trunnion.formats.pcf.shapes import Form
from trunnion.system.vectors import Vec, add, scale, size, sub, unit

SLACK = 0.05  # a support may stand off the surface of the pipe by this [m]
_ALL = ("pipe", "rigid", "reducer")


@dataclass(slots=True)
class Attached:
    """Nodes of supports by part, and middles of bends: node of the middle -> intersection."""

    supports: list[tuple[Part, int]] = field(default_factory=list)
    middles: dict[int, int] = field(default_factory=dict)


def attach_olets(
    net: Network,
    olets: list[tuple[int, Form]],
    tolerance: float,
    outside: Outside,
    attached: Attached,
    findings: Findings,
) -> None:
    """Join olets to the pipes on whose axis they stand: stiff inside the run, then their branch.

    Parameters
    ----------
    olets : number of the form and the form.
    """
    places = Places(net)
    hits: list[Hit] = []
    found: list[tuple[int, Form]] = []
    for i, form in olets:
        assert form.run is not None
        hit = places.on_runs(form.run, tolerance, tolerance, _ALL)
        if hit.node < 0 and hit.run < 0:
            text = f"{form.part.name}: its point on the run lies on no pipe (tolerance "
            findings.fault(form.part.line, f"{text}{1000 * tolerance:g} mm)")
            continue
        hits.append(_off_bends(net, hit, form.run, attached))
        found.append((i, form))
    host = [net.runs[h.run].part if h.run >= 0 else None for h in hits]
    for (i, form), run, node in zip(found, host, split(net, hits, tolerance), strict=True):
        branch = net.port_node[i, 0]
        net.open_ends.pop(node, None)  # an olet on the end of a pipe is its mate
        if run is None:
            run = next((r.part for r in net.runs if node in (r.a, r.b)), None)
        _branch(net, form, node, branch, 0.5 * outside(run) if run is not None else 0.0, tolerance)


def _branch(
    net: Network, form: Form, node: int, branch: int, inside: float, tolerance: float
) -> None:
    """Add the leg of an olet: stiff from the axis to the surface of the run, pipe from there."""
    start, end = net.xyz[node], net.xyz[branch]
    length = size(sub(end, start))
    bore = form.ports[0].bore
    if length == 0.0:
        branch_runs = [k for k, r in enumerate(net.runs) if branch in (r.a, r.b)]
        for k in branch_runs:
            r = net.runs[k]
            a, b = (node if n == branch else n for n in (r.a, r.b))
            net.runs[k] = Run(r.part, r.kind, a, b, r.share, r.ends)
        return
    if inside <= tolerance or length <= inside + tolerance:
        kind = "inside" if inside > tolerance else "pipe"
        net.runs.append(Run(form.part, kind, node, branch, 1.0, (bore, bore)))
        return
    surface = len(net.xyz)
    net.xyz.append(add(start, scale(inside, unit(sub(end, start)))))
    net.runs.append(Run(form.part, "inside", node, surface, 0.0, (bore, bore)))
    net.runs.append(Run(form.part, "pipe", surface, branch, 1.0, (bore, bore)))


def attach_masses(
    net: Network, parts: list[Part], tolerance: float, attached: Attached, findings: Findings
) -> list[tuple[Part, int]]:
    """Find the node of each component without length; a cap or blind flange closes its end."""
    places = Places(net)
    at = net.at()
    hits: list[Hit] = []
    placed: list[Part] = []
    for part in parts:
        point = part.ends[0].xyz
        hit = places.on_runs(point, tolerance, tolerance, _ALL)
        if hit.node >= 0 and hit.node not in at:  # made one with another
            node = min(at, key=lambda n: size(sub(net.xyz[n], point)), default=-1)
            far = size(sub(net.xyz[node], point)) if node >= 0 else inf
            hit = Hit(node if far <= tolerance else -1, -1, 0.0, far)
        if hit.node < 0 and hit.run < 0:
            findings.leave_out(part.line, part.name, "no length, and no component ends there")
            continue
        hits.append(_off_bends(net, hit, point, attached))
        placed.append(part)
    found = list(zip(placed, split(net, hits, tolerance), strict=True))
    for part, node in found:
        if part.shape == "closed" and net.open_ends.pop(node, None) is not None:
            net.closed.add(node)
    return found


def attach_supports(
    net: Network,
    parts: list[Part],
    tolerance: float,
    outside: Outside,
    attached: Attached,
    findings: Findings,
) -> None:
    """Find the node of each support; pipes are split under it."""
    places = Places(net)
    hits: list[Hit] = []
    placed: list[Part] = []
    for part in parts:
        point = part.at or part.centre or (part.ends[0] if part.ends else None)
        if point is None:
            findings.fault(part.line, f"{part.name}: a support has CO-ORDS")
            continue
        hit = places.on_runs(point.xyz, inf, tolerance, _ALL)
        reach = tolerance
        if hit.run >= 0:
            reach = 0.5 * outside(net.runs[hit.run].part) + SLACK
        if (hit.node < 0 and hit.run < 0) or hit.distance > reach:
            text = f"{part.name}: stands on no pipe"
            if hit.run >= 0:
                near = net.runs[hit.run].part
                text += f"; {near.name} is {1000 * hit.distance:.0f} mm away"
            findings.leave_out(part.line, "support", text)
            continue
        if hit.distance > tolerance and hit.run >= 0:
            text = f"{part.name}: {1000 * hit.distance:.0f} mm off the axis; moved to the axis"
            findings.assume(text, part.line)
        hits.append(_off_bends(net, hit, point.xyz, attached))
        placed.append(part)
    attached.supports += zip(placed, split(net, hits, tolerance), strict=True)


def _off_bends(net: Network, hit: Hit, point: Vec, attached: Attached) -> Hit:
    """Move a hit on the tangents of a bend to the nearest of its near, middle and far points.

    One on a reducer moves to its nearer end.
    """
    centre = hit.node if hit.node in net.bends else -1
    if hit.run >= 0:
        run = net.runs[hit.run]
        if run.kind == "reducer":  # whole it stays
            return Hit(run.a if hit.along < 0.5 else run.b, -1, 0.0, hit.distance)
        centre = next((n for n in (run.a, run.b) if n in net.bends), -1)
    if centre < 0:
        return hit
    ends = [n for r in net.runs if centre in (r.a, r.b) for n in (r.a, r.b) if n != centre]
    middle = _middle_of(net, centre, ends)
    nearest = min(ends, key=lambda n: size(sub(net.xyz[n], point)))
    if size(sub(middle, point)) <= size(sub(net.xyz[nearest], point)):
        node = next((m for m, c in attached.middles.items() if c == centre), -1)
        if node < 0:
            node = len(net.xyz)
            net.xyz.append(middle)
            attached.middles[node] = centre
    else:
        node = nearest
    return Hit(node, -1, 0.0, hit.distance)


def _middle_of(net: Network, centre: int, ends: list[int]) -> Vec:
    """Middle of the arc of a bend."""
    c, radius = net.xyz[centre], net.bends[centre].radius or 0.0
    arms = [sub(net.xyz[n], c) for n in ends[:2]]
    inward = unit(add(unit(arms[0]), unit(arms[1])))
    tangent = size(arms[0])
    away = (tangent**2 + radius**2) ** 0.5 - radius
    return add(c, scale(away, inward))
