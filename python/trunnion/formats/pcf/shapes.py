"""Points of a component checked and made into legs: which point is joined to which.

A bend is two legs that meet at the intersection of its tangents, a tee three that meet at its
centre.  Of a tee the run is what is in line, not what is called END-POINT.
"""

from math import acos, degrees, tan

from trunnion.formats.findings import Findings
from trunnion.formats.pcf.parts import Part
from trunnion.formats.pcf.points import Point
from trunnion.frozen import frozen
from trunnion.system.vectors import Vec, add, dot, scale, size, sub, unit

CENTRE = -1  # number of the centre in a leg; others are ports
STRAIGHT = 2e-3  # lines that turn by less run through [rad]
UNEQUAL = 1e-3  # difference of the tangents of a bend that is still round-off [m]


@frozen
class Leg:
    """A straight from a port (or CENTRE) to another.

    kind : "pipe", "rigid", "reducer", "inside" (of the run, at a branch).
    """

    a: int
    b: int
    kind: str


@frozen
class Form:
    """A component as legs; `centre` is where they meet, `radius` that of a bend there [m].

    `open_ends` are the ports that want a mate; `masses` the port that carries a component
    without length.
    """

    part: Part
    ports: tuple[Point, ...]
    legs: tuple[Leg, ...]
    centre: Vec | None = None
    radius: float | None = None
    open_ends: tuple[int, ...] = ()
    run: Vec | None = None  # of an olet: the point on the axis of the run


def form_of(part: Part, tolerance: float, findings: Findings) -> Form | None:
    """Make legs of a component; None if it has none, or if it is faulty."""
    shape = part.shape
    if shape == "teed":
        findings.leave_out(part.line, part.name, "a fitting with a branch of its own")
        shape = "bend" if part.keyword.startswith(("BEND", "ELBOW")) else "reducer"
        if part.keyword == "ELBOW-REDUCING":
            shape = "bend"
    set_on = shape == "tee" and part.centre is not None and not part.ends
    if shape == "olet" or (set_on and len(part.branches) == 1):  # on a run that goes through
        return _olet(part, findings)
    if shape in ("tee", "ways"):
        return _tee(part, tolerance, findings)
    if shape == "bend":
        return _bend(part, tolerance, findings)
    return _straight(part, shape, tolerance, findings)


def _straight(part: Part, shape: str, tolerance: float, findings: Findings) -> Form | None:
    """Two ends; caps may have one and a centre or CO-ORDS; angle valves turn at their centre."""
    ends = list(part.ends)
    if shape == "closed" and len(ends) == 1:
        ends += [point for point in (part.centre, part.at) if point is not None][:1]
    if shape == "closed" and len(ends) == 1:
        return Form(part, tuple(ends), (), open_ends=(0,))
    if len(ends) == 3 and shape in ("rigid", "fitting", "gasket"):
        return _tee(part, tolerance, findings)
    if len(ends) != 2:
        text = f"{part.name}: {len(ends)} END-POINT; a {part.keyword} has 2"
        findings.fault(part.line, text)
        return None
    a, b = ends[0].xyz, ends[1].xyz
    if size(sub(b, a)) <= tolerance and not (shape == "reducer" and size(sub(b, a)) > 0.0):
        return Form(part, tuple(ends[:1]), ())
    free = (0,) if shape == "closed" else (0, 1)
    kind = {"pipe": "pipe", "reducer": "reducer", "weld": "pipe"}.get(shape, "rigid")
    c = part.centre
    if shape == "angle" and c is not None and min(_far(c.xyz, a), _far(c.xyz, b)) > tolerance:
        legs = (Leg(0, CENTRE, kind), Leg(CENTRE, 1, kind))
        return Form(part, tuple(ends), legs, c.xyz, open_ends=free)
    return Form(part, tuple(ends), (Leg(0, 1, kind),), open_ends=free)


def _far(a: Vec, b: Vec) -> float:
    return size(sub(a, b))


def _bend(part: Part, tolerance: float, findings: Findings) -> Form | None:
    """Check a bend: the turn is taken from its points; ANGLE has three meanings, none is used."""
    if len(part.ends) != 2 or part.centre is None:
        has = f"{len(part.ends)} END-POINT and {'a' if part.centre else 'no'} CENTRE-POINT"
        findings.fault(part.line, f"{part.name}: {has}; a bend has 2 and 1")
        return None
    a, b, c = part.ends[0].xyz, part.ends[1].xyz, part.centre.xyz
    near, far = _far(a, c), _far(b, c)
    if min(near, far) <= tolerance:
        text = f"{part.name}: CENTRE-POINT lies on an END-POINT; it is where the tangents meet"
        findings.fault(part.line, text)
        return None
    turn = acos(max(-1.0, min(1.0, dot(unit(sub(c, a)), unit(sub(b, c))))))
    if turn < STRAIGHT:
        return Form(part, part.ends, (Leg(0, 1, "pipe"),), open_ends=(0, 1))
    if turn > 3.0:
        findings.fault(part.line, f"{part.name}: turns by {degrees(turn):.1f} degrees")
        return None
    if abs(near - far) > max(UNEQUAL, 1e-3 * near):
        text = (
            f"{part.name}: its tangents are {1000 * near:.2f} and {1000 * far:.2f} mm long; "
            "those of a bend are equal"
        )
        findings.fault(part.line, text)
        return None
    legs = (Leg(0, CENTRE, "pipe"), Leg(CENTRE, 1, "pipe"))
    return Form(part, part.ends, legs, c, min(near, far) / tan(0.5 * turn), (0, 1))


def _tee(part: Part, tolerance: float, findings: Findings) -> Form | None:
    """Legs from each port to the centre; without one it is the foot of the branch on the run."""
    ports = part.ports
    kind = "rigid" if part.shape in ("ways", "rigid") else "pipe"
    if len(ports) < 3:
        text = f"{part.name}: {len(ports)} END-POINT and BRANCH-POINT together; it has 3 or more"
        findings.fault(part.line, text)
        return None
    if all(_far(p.xyz, ports[0].xyz) <= tolerance for p in ports):
        return Form(part, ports[:1], ())  # an olet in disguise: no length, the pipes meet here
    centre = part.centre.xyz if part.centre is not None else _foot(ports)
    if centre is None:
        findings.fault(part.line, f"{part.name}: no CENTRE-POINT, and no two ends are in line")
        return None
    if not _has_run(ports, centre):
        findings.assume(f"{part.name}: no two of its ends are in line through its centre")
    legs = tuple(Leg(i, CENTRE, kind) for i, p in enumerate(ports) if _far(p.xyz, centre) > 0.0)
    return Form(part, ports, legs, centre, open_ends=tuple(range(len(ports))))


def _has_run(ports: tuple[Point, ...], centre: Vec) -> bool:
    arms = [unit(sub(p.xyz, centre)) for p in ports]
    return any(
        dot(arms[i], arms[j]) < -0.999 for i in range(len(arms)) for j in range(i + 1, len(arms))
    )


def _foot(ports: tuple[Point, ...]) -> Vec | None:
    """Foot of the port that is off the line of two others; the two furthest apart are the run."""
    pairs = [(i, j) for i in range(len(ports)) for j in range(i + 1, len(ports))]
    i, j = max(pairs, key=lambda p: _far(ports[p[0]].xyz, ports[p[1]].xyz))
    a = ports[i].xyz
    along = unit(sub(ports[j].xyz, a))
    others = [p.xyz for n, p in enumerate(ports) if n not in (i, j)]
    reach = dot(sub(others[0], a), along)
    if not 0.0 < reach < _far(ports[j].xyz, a):
        return None
    return add(a, scale(reach, along))


def _olet(part: Part, findings: Findings) -> Form | None:
    """An olet: a point on the axis of the run, and the end of its branch."""
    rest = list(part.ends)
    run = part.centre or (rest.pop(0) if rest else None)
    branch = part.branches[0] if part.branches else (rest.pop() if rest else None)
    if run is None or branch is None:
        text = f"{part.name}: an olet has a CENTRE-POINT on the run and a BRANCH1-POINT"
        findings.fault(part.line, text)
        return None
    if branch.bore is None:
        bore = part.bore
        branch = Point(branch.xyz, bore, branch.line)
    return Form(part, (branch,), (), run=run.xyz, open_ends=(0,))
