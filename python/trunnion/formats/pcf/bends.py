"""Bends made exact, and their tangents merged with the pipes that go on in line.

The file's decimals leave the two tangents of a bend unequal by hundredths of a millimetre; a
model must not have a pipe of that length.  The ends of bends move by so little instead.
"""

from dataclasses import replace
from math import acos, tan

from trunnion.formats.pcf.network import Network, Run
from trunnion.formats.pcf.properties import Properties
from trunnion.formats.pcf.shapes import UNEQUAL
from trunnion.system.vectors import add, cross, dot, scale, size, sub, unit

Made = tuple[Run, Properties]
OFF_LINE = 2e-4  # a tangent and a pipe that miss one line by less are one [m]


def settle(net: Network, runs: list[Made]) -> dict[int, float]:
    """Make both tangents of each bend equal; give the radii [m].

    A joint that stands at the end of a bend moves along the tangent.  Two bends that meet share
    the way between them: the second takes what the first has left.
    """
    ways: dict[int, list[int]] = {}
    for run, _ in runs:
        for node, other in ((run.a, run.b), (run.b, run.a)):
            if node in net.bends:
                ways.setdefault(node, []).append(other)
    fixed: set[int] = set()
    tangents: dict[int, float] = {}
    radii: dict[int, float] = {}
    for centre, form in net.bends.items():
        others = ways.get(centre, ())
        if len(others) != 2:
            continue
        c = net.xyz[centre]
        tangent = min(size(sub(port.xyz, c)) for port in form.ports)
        for n in others:
            length = size(sub(net.xyz[n], c))
            left = length - tangents.get(n, 0.0)
            if (n in fixed or n in tangents) and abs(left - tangent) <= 2.0 * UNEQUAL:
                tangent = left
        tangents[centre] = tangent
        for n in others:
            to = sub(net.xyz[n], c)
            if n not in fixed and n not in net.bends and size(to) <= tangent + 2.0 * UNEQUAL:
                net.xyz[n] = add(c, scale(tangent, unit(to)))
                fixed.add(n)
        turn = acos(max(-1.0, min(1.0, -dot(*(unit(sub(net.xyz[n], c)) for n in others)))))
        radii[centre] = tangent / tan(0.5 * turn)
    return radii


def merge_tangents(
    net: Network, runs: list[Made], keep: set[int]
) -> tuple[list[Made], dict[int, int]]:
    """Let pipes run to the intersection of the tangents, as a deck has them.

    Parameters
    ----------
    runs : with what each is made of.
    keep : nodes that must stay.

    Returns
    -------
    The runs that are left, and of each joint that is gone the bend whose near or far point it is.
    """
    kept: list[Made | None] = list(runs)
    at: dict[int, set[int]] = {}
    for i, (run, _) in enumerate(runs):
        at.setdefault(run.a, set()).add(i)
        at.setdefault(run.b, set()).add(i)
    gone: dict[int, int] = {}
    for centre in net.bends:
        for i in sorted(at.get(centre, ())):
            arm = kept[i]
            if arm is None:
                continue
            joint = _other(arm[0], centre)
            others = at[joint] - {i}
            if joint in keep or joint in net.bends or len(others) != 1:
                continue
            (j,) = others
            pipe = kept[j]
            if pipe is None or pipe[0].kind != "pipe" or pipe[1] != arm[1]:
                continue
            far = _other(pipe[0], joint)
            if not _in_line(net, centre, joint, far):
                continue
            a, b = (centre if n == joint else n for n in (pipe[0].a, pipe[0].b))
            main = pipe[0] if far not in net.bends or pipe[0].part.shape == "pipe" else arm[0]
            kept[j] = (replace(main, kind="pipe", a=a, b=b), pipe[1])
            kept[i] = None
            at[centre] = (at[centre] - {i}) | {j}
            gone[joint] = centre
    return [pair for pair in kept if pair is not None], gone


def _in_line(net: Network, centre: int, joint: int, far: int) -> bool:
    """Tell whether a joint lies on the straight from a far end to an intersection."""
    start, way = net.xyz[far], sub(net.xyz[centre], net.xyz[far])
    length = size(way)
    to = sub(net.xyz[joint], start)
    if length == 0.0 or not 0.0 < dot(to, way) < length**2:
        return False
    return size(cross(to, way)) / length <= OFF_LINE


def _other(run: Run, node: int) -> int:
    return run.b if run.a == node else run.a
