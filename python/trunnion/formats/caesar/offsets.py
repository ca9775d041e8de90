"""Offsets of elements that no pipe with offsets can be: a stiff link of its own leads to them.

A pipe of the model with offsets can neither be the tangent of a bend nor a rigid, a reducer or a
joint, so the arm becomes an element.
"""

from dataclasses import replace

from trunnion.formats.caesar.job import Element, Job, RigidData, Vec
from trunnion.formats.findings import Findings

NONE: Vec = (0.0, 0.0, 0.0)


def links_for_offsets(job: Job, findings: Findings) -> Job:
    """Give the job with the offsets of bodies and of elements at bends as weightless elements."""
    bends = {e.end for e in job.elements if e.bend is not None}
    number = max(max(e.start, e.end) for e in job.elements) + 1
    made: list[Element] = []
    for e in job.elements:
        body = (e.rigid, e.joint, e.reducer) != (None, None, None)
        if e.offsets is None or not (body or {e.start, e.end} & bends):
            made.append(e)
            continue
        first = _kept(e, e.start, e.offsets.start, bends, findings)
        last = _kept(e, e.end, e.offsets.end, bends, findings)
        x, y, z = (d - a + b for d, a, b in zip(e.delta, first, last, strict=True))
        pipe = replace(e, offsets=None, delta=(x, y, z))
        if any(first):
            made.append(_link(e, e.start, number, first))
            pipe = replace(pipe, start=number)
            number += 1
        if any(last):
            pipe = replace(pipe, end=number)
        made.append(pipe)
        if any(last):
            made.append(_link(e, number, e.end, (-last[0], -last[1], -last[2])))
            number += 1
    return replace(job, elements=tuple(made))


def _kept(e: Element, node: int, arm: Vec, bends: set[int], findings: Findings) -> Vec:
    """Give the arm at an end, none where the bend itself is."""
    if node not in bends or not any(arm):
        return arm
    assert e.offsets is not None
    text = f"offset at the bend at {node}; taken without"
    findings.leave_out(e.offsets.line, f"element {e.start}-{e.end}", text)
    return NONE


def _link(e: Element, start: int, end: int, arm: Vec) -> Element:
    """Make the element of an arm: stiff, without weight, of the section of its pipe."""
    kept = Element(e.line, start, end, arm, e.od, e.wall, e.material, t=e.t, p=e.p)
    constants = replace(kept, strain=e.strain, e=e.e, nu=e.nu, density=e.density)
    return replace(constants, rigid=RigidData(e.line, 0.0))
