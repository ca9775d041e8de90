"""Tees of late versions: flexible by ASME B31J, their branch stiff inside the run.

Movements and loads that version 14 printed for a job of the default piping code follow from this
to 0.1 % of the largest: a link without weight leads from the axis of the run to its surface (the
program reports that point), and the branch starts there with the rotations that B31J-2017 Table
1-1 gives a welding tee, k M d / (E I), where the factor k is above 1.  Elbows of 90 degrees have
k = 1.3/h there (`bendfactors`).  A job of code 3 (B31.3 of an older edition) has neither.
"""

from dataclasses import replace
from math import pi

from trunnion.formats.caesar.geometry import size
from trunnion.formats.caesar.job import Element, Job, RigidData, Vec
from trunnion.formats.caesar.materials import FAMILIES
from trunnion.formats.findings import Findings
from trunnion.frozen import frozen

VERSION = 14.0  # from which the default code has it
CODES = (0, 53)  # default and a later one: seen with it; 3: seen without
INTERSECTIONS = range(1, 7)  # types of fittings with a branch
WELDING_TEE = 3
IN_LINE = 0.999


@frozen
class Hinge:
    """A rotation at the start of a branch, about the axis of the run [N m/rad]."""

    line: int
    surface: int  # node on the surface of the run
    start: int  # node where the branch starts
    stiffness: float
    axis: Vec


def uses_b31j(job: Job) -> bool:
    """Tell whether the job is of a version and code that have B31J."""
    code = next((e.code for e in job.elements if e.code is not None), CODES[0])
    return job.version >= VERSION and code in CODES


def flexible_tees(job: Job, findings: Findings) -> tuple[Job, tuple[Hinge, ...]]:
    """Give the job with links inside the runs of its tees, and the hinges of their branches."""
    if not uses_b31j(job):
        return job, ()
    kinds = {n: kind for e in job.elements for n, kind in e.sifs if kind in INTERSECTIONS}
    at: dict[int, list[int]] = {}
    for i, e in enumerate(job.elements):
        for node in (e.start, e.end):
            at.setdefault(node, []).append(i)
    used = set(at) | {n for e in job.elements if e.bend for _, n in e.bend.nodes}
    elements = list(job.elements)
    links: dict[int, list[Element]] = {}
    hinges: list[Hinge] = []
    for node, kind in kinds.items():
        found = _branch(node, at.get(node, []), elements)
        if found is None:
            continue
        i, run = found
        link = _split(node, i, run, elements, used)
        if link is None:
            continue
        links.setdefault(i, []).append(link)
        k = _out_of_plane(elements[i], run) if kind == WELDING_TEE else 0.0
        if k > 1.0:
            hinges.append(_hinge(link, i, run, k, elements, used))
    if links:
        text = "tees are flexible by ASME B31J and stiff inside their run, as in version 14 by its "
        text += "default piping code; only welding tees have a flexibility here"
        findings.assume(text)
    made = [x for i, e in enumerate(elements) for x in (*links.get(i, ()), e)]
    return replace(job, elements=tuple(made)), tuple(hinges)


def _branch(node: int, here: list[int], elements: list[Element]) -> tuple[int, Element] | None:
    """Find the branch at a node, and an element of the run: two of the three are in line."""
    ways = {i: _way(elements[i], node) for i in here if size(elements[i].delta) > 0.0}
    if len(ways) != 3:
        return None
    for i, way in ways.items():
        one, other = (j for j in ways if j != i)
        run = abs(_dot(ways[one], ways[other])) > IN_LINE
        if run and abs(_dot(way, ways[one])) < IN_LINE and elements[i].offsets is None:
            return i, elements[one]
    return None


def _split(
    node: int, i: int, run: Element, elements: list[Element], used: set[int]
) -> Element | None:
    """Shorten a branch by half the run's diameter; give the link that takes its place."""
    e = elements[i]
    length = size(e.delta)
    if e.rigid is not None or e.joint is not None or length <= 0.55 * run.od:
        return None
    surface = _free(node, used)
    part = 0.5 * run.od / length
    x, y, z = e.delta
    at_start = e.start == node
    delta = (part * x, part * y, part * z)
    rest = replace(e, delta=((1.0 - part) * x, (1.0 - part) * y, (1.0 - part) * z))
    elements[i] = replace(rest, start=surface) if at_start else replace(rest, end=surface)
    ends = (node, surface) if at_start else (surface, node)
    link = Element(e.line, *ends, delta, e.od, e.wall, e.material, t=e.t, p=e.p)
    return replace(link, e=e.e, nu=e.nu, density=e.density, rigid=RigidData(e.line, 0.0))


def _hinge(
    link: Element, i: int, run: Element, k: float, elements: list[Element], used: set[int]
) -> Hinge:
    """Let a branch start at a node of its own that a rotation joins to the surface."""
    e = elements[i]
    surface = e.start if e.start in (link.start, link.end) else e.end
    start = _free(surface, used)
    elements[i] = replace(e, start=start) if e.start == surface else replace(e, end=start)
    inside = e.od - 2.0 * e.wall
    second = pi / 64.0 * (e.od**4 - inside**4)
    modulus = e.e or FAMILIES.get(e.material, FAMILIES[1]).e
    stiffness = float(f"{modulus * second / (k * e.od):.7g}")
    return Hinge(e.line, surface, start, stiffness, _way(run, run.start))


def _out_of_plane(branch: Element, run: Element) -> float:
    """Flexibility factor of a welding tee's branch, out of plane (B31J-2017, Table 1-1).

    It is 0 where the sizes are none of pipes: `Properties` names those.
    """
    if not all(0.0 < 2.0 * e.wall < e.od for e in (branch, run)):
        return 0.0
    mean = run.od - run.wall
    q, t = (branch.od - branch.wall) / mean, branch.wall / run.wall
    shape = 0.34 * q - 0.49 * q**2 + 0.18 * q**3
    return float(shape * (0.5 * mean / run.wall) ** 1.46 * t)


def _free(node: int, used: set[int]) -> int:
    """Take the next number that no node has, as the program does for the surface of a run."""
    while node in used:
        node += 1
    used.add(node)
    return node


def _way(e: Element, node: int) -> Vec:
    """Direction of an element away from a node."""
    sign = (1.0 if e.start == node else -1.0) / size(e.delta)
    return sign * e.delta[0], sign * e.delta[1], sign * e.delta[2]


def _dot(a: Vec, b: Vec) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
