"""Bends: two pipes at a tangent intersection become tangent - arc - tangent.

The arc runs from the near point (30N) over the middle (30M) to the far point (30F), along the
deck's direction.  The node's own label means the far point.
"""

from math import atan2, cos, sin, tan

from trunnion.errors import Problem
from trunnion.frozen import frozen
from trunnion.model import Bend, Material, Model, Pipe, Section, Settings
from trunnion.system.vectors import Vec, add, cross, dot, scale, size, sub, unit

IN_LINE = 1e-6  # two pipes that turn by less than this make no bend [rad]
VANISHED = 1e-9  # tangents below this part of their pipe are left out

# Outside diameter [mm] -> nominal diameter [mm]: ASME B36.10M and B36.19M, NPS 1/8 to 12.
# From NPS 14 on the outside diameter is the nominal one.
_NOMINAL = (
    (10.3, 0.125), (13.7, 0.25), (17.1, 0.375), (21.3, 0.5), (26.7, 0.75), (33.4, 1.0),
    (42.2, 1.25), (48.3, 1.5), (60.3, 2.0), (73.0, 2.5), (88.9, 3.0), (101.6, 3.5), (114.3, 4.0),
    (141.3, 5.0), (168.3, 6.0), (219.1, 8.0), (273.1, 10.0), (323.9, 12.0),
)  # fmt: skip


@frozen
class Legs:
    """The two pipes (numbers in Model.pipes) that a bend joins, in the order of the path."""

    bend: Bend
    near: int
    far: int


@frozen
class Corner:
    """One placed bend.

    a, b : unit vectors along the path before and after the bend; c from 30N to the centre.
    radius, angle, tangent : [m, rad, m].
    n, m, f : coordinates of 30N 30M 30F [m].
    """

    legs: Legs
    a: Vec
    b: Vec
    c: Vec
    radius: float
    angle: float
    tangent: float
    n: Vec
    m: Vec
    f: Vec


def nominal_diameter(od: float) -> float:
    """Nominal diameter [m] of a pipe of outside diameter `od` [m]; `od` itself if not standard."""
    for outside, inches in _NOMINAL:
        if abs(1000.0 * od - outside) <= 0.005 * outside:
            return 0.0254 * inches
    return od


def find_legs(model: Model, problems: list[Problem]) -> dict[str, Legs]:
    """Give each bend its near and its far pipe."""
    at: dict[str, list[int]] = {bend.node: [] for bend in model.bends}
    for i, pipe in enumerate(model.pipes) if at else ():
        for label in (pipe.start, pipe.end):
            if label in at:
                at[label].append(i)
    legs: dict[str, Legs] = {}
    for bend in model.bends:
        name = f"BEND {bend.node}"
        pipes = at[bend.node]
        names = ", ".join(pipe_name(model.pipes[i]) for i in pipes) or "none"
        if bend.node in legs:
            problems.append(Problem(bend.place, f"{name}: there is a bend at this node already"))
        elif len(pipes) > 2:
            advice = f"let branches start at {bend.node}N, {bend.node}M or {bend.node}F"
            text = f"{name}: a bend joins two pipes, here are {names}; {advice}"
            problems.append(Problem(bend.place, text))
        elif len(pipes) < 2:
            text = f"{name}: a bend joins two pipes, here are: {names}"
            problems.append(Problem(bend.place, text))
        elif any(model.pipes[i].card != "PIPE" for i in pipes):
            card = next(c for i in pipes if (c := model.pipes[i].card) != "PIPE").lower()
            text = f"{name}: a {card} cannot be the tangent of a bend ({names}); put a pipe between"
            problems.append(Problem(bend.place, text))
        elif any(model.pipes[i].offsets != (None, None) for i in pipes):
            text = f"{name}: a pipe with an offset cannot be the tangent of a bend ({names})"
            problems.append(Problem(bend.place, text))
        elif bend.radius is not None and not bend.radius > 0.0:
            problems.append(Problem(bend.place, f"{name}: the radius must be positive"))
        else:
            near, far = pipes
            if model.pipes[near].start == bend.node and model.pipes[far].end == bend.node:
                near, far = far, near
            legs[bend.node] = Legs(bend, near, far)
    return legs


def pipe_name(pipe: Pipe) -> str:
    """Name a pipe as ALONG= does."""
    return f"{pipe.start}-{pipe.end}"


def turn_at(label: str, pipe: Pipe, vector: Vec, *, near: bool) -> Vec:
    """Return the unit vector of the path in a leg; `vector` is start to end."""
    along = (pipe.end == label) if near else (pipe.start == label)
    return unit(vector if along else scale(-1.0, vector))


def corner(legs: Legs, p: Vec, a: Vec, b: Vec, radius: float) -> Corner | None:
    """Place a bend whose tangents meet at `p`; None if its pipes are in line."""
    angle = atan2(size(cross(a, b)), dot(a, b))
    c = sub(b, scale(dot(a, b), a))
    if angle < IN_LINE or size(c) < IN_LINE:
        return None
    c = unit(c)
    tangent = radius * tan(0.5 * angle)
    n = sub(p, scale(tangent, a))
    half = 0.5 * angle
    middle = add(scale(sin(half), a), scale(1.0 - cos(half), c))
    m = add(n, scale(radius, middle))
    return Corner(legs, a, b, c, radius, angle, tangent, n, m, add(p, scale(tangent, b)))


def bend_radius(bend: Bend, section: Section) -> float:
    """Radius of the bend [m]; 1.5 nominal diameters unless given."""
    return 1.5 * nominal_diameter(section.od) if bend.radius is None else bend.radius


def flexibility(
    bend: Bend, radius: float, section: Section, material: Material, pressure: float
) -> float:
    """Flexibility factor of a bend.

    ASME B31.3 Appendix D: k = 1.65/h, h = T R/r^2, note on flanges c = h^(1/6) or h^(1/3) (never
    above 1) applied to k, and the note on pressure stiffening, which divides k by
    1 + 6 (P/E) (r/T)^(7/3) (R/r)^(1/3).  A user's own K is taken as it stands.
    """
    if bend.k is not None:
        return bend.k
    r = 0.5 * (section.od - section.wall)
    h = section.wall * radius / r**2
    k: float = 1.65 / h
    k = max(1.0, k * min(1.0, pow(h, bend.flanges / 6.0)))
    ratio: float = pow(r / section.wall, 7.0 / 3.0) * pow(radius / r, 1.0 / 3.0)
    return max(1.0, k / (1.0 + 6.0 * max(0.0, pressure) / material.e * ratio))


def stiffening_pressure(settings: Settings, pipe: Pipe) -> float:
    """Pressure that stiffens the bends of `pipe` [Pa]: DEFAULT STIFFEN=OFF, MAX or P1 ... P9."""
    choice, p = settings.stiffen, pipe.operation.p
    if choice == "OFF":
        return 0.0
    return max(p.values(), default=0.0) if choice == "MAX" else p.get(choice[1:], 0.0)
