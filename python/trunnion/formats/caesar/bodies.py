"""What makes a pipe more than a pipe: rigid, reducer, expansion joint, cold spring, own loads."""

from dataclasses import replace
from math import pi

from trunnion.formats.caesar import materials as mt
from trunnion.formats.caesar.geometry import size
from trunnion.formats.caesar.job import Element, Job, JointData, Vec
from trunnion.formats.caesar.properties import Properties
from trunnion.formats.findings import Findings
from trunnion.model import SETS, Joint, Model, Pipe, Reducer, Uniform

_BODIES = {1: "VALVE", 2: "FLANGE", 3: "FLANGE", 4: "VALVE"}


class Bodies:
    """Dresses the plain pipe of an element in what the element is."""

    def __init__(self, job: Job, model: Model, findings: Findings, properties: Properties) -> None:
        self.job = job
        self.model = model
        self.findings = findings
        self.properties = properties
        self.uniforms = uniform_loads(job)
        self._leaving: dict[int, list[int]] = {}
        self._long: dict[int, Element] = {}
        for i, e in enumerate(job.elements):
            self._leaving.setdefault(e.start, []).append(i)
            if size(e.delta) > 0.0:
                self._long.setdefault(e.start, e)
                self._long.setdefault(e.end, e)

    def dressed(self, i: int, e: Element, pipe: Pipe) -> Pipe:
        """Give the pipe of element `i` as the body that it is."""
        name = f"element {e.start}-{e.end}"
        if self.uniforms[i]:
            pipe = replace(pipe, uniform=self.uniforms[i])
            text = "uniform loads are the sets Q1 to Q9: the default cases have none of them"
            self.findings.assume(text, e.line)
        if e.joint is not None:
            return self._joint(i, e, e.joint, pipe)
        if e.rigid is not None:
            if e.reducer is not None:
                text = "reducer that is a rigid element; taken as rigid of the size at its FROM end"
                self.findings.leave_out(e.reducer.line, name, text)
            # contents and insulation are added to a weight by the model itself, as by the program
            body = _BODIES.get(e.rigid.type, "")
            return replace(pipe, rigid=True, weight=max(0.0, e.rigid.weight), body=body)
        if e.reducer is not None:
            return self._reducer(i, e, pipe)
        if e.material in (mt.CUT_SHORT, mt.CUT_LONG):
            cut = size(e.delta) if e.material == mt.CUT_SHORT else -size(e.delta)
            text = "cold spring is the set CS: the default cases have none of it"
            self.findings.assume(text, e.line)
            return replace(pipe, cut=cut)
        return pipe

    def _reducer(self, i: int, e: Element, pipe: Pipe) -> Pipe:
        """Make a reducer; a blank size at the TO end is that of the element that leaves it."""
        data = e.reducer
        assert data is not None
        here = [j for j in self._leaving.get(e.end, ())[:9] if j != i]
        leaving = self.job.elements[here[0]] if here else None
        od = data.od or (leaving.od if leaving else 0.0)
        wall = data.wall or (leaving.wall if leaving else 0.0)
        if not (od > 0.0 and 0.0 < wall <= 0.5 * od):
            text = "reducer without a size at its TO end; taken as pipe of the size at its FROM end"
            self.findings.leave_out(data.line, f"element {e.start}-{e.end}", text)
            return pipe
        to = self.properties.section(replace(e, od=od, wall=wall, rigid=None))
        if to == pipe.section or not to:
            return pipe
        return replace(pipe, reducer=Reducer(to))

    def _joint(self, i: int, e: Element, data: JointData, pipe: Pipe) -> Pipe:
        """Make an expansion joint; blank rates follow from the others or are rigid."""
        rates = (data.axial, data.transverse, data.bending, data.torsional)
        if min(rates) < 0.0 or data.diameter < 0.0:
            text = f"element {e.start}-{e.end}: the joint has a negative rate or diameter"
            self.findings.fault(data.line, text)
            return pipe
        long = size(e.delta) > 0.0
        if not all(rates):
            text = f"element {e.start}-{e.end}: blank rates of the expansion joint are rigid"
            text += ", or follow from the other of lateral and bending rate" if long else ""
            self.findings.assume(text, data.line)
        axis = None if long else self._axis(e)
        joint = Joint(
            data.axial or self.model.settings.k,
            data.transverse or None,
            data.bending or None,
            data.torsional or None,
            0.25 * pi * data.diameter**2,
            axis,
        )
        if long and not (data.transverse or data.bending):
            joint = replace(joint, lateral=self.model.settings.k)
        return replace(pipe, joint=joint, weight=self._metal(e))

    def _axis(self, e: Element) -> Vec:
        """Direction of a joint without length: that of the next pipe at its ends."""
        near = self._long.get(e.start) or self._long.get(e.end)
        if near is None:
            text = f"element {e.start}-{e.end}: nothing gives the direction of this joint"
            self.findings.fault(e.line, text)
            return 1.0, 0.0, 0.0
        x, y, z = near.delta
        length = size(near.delta)
        return x / length, y / length, z / length

    def _metal(self, e: Element) -> float:
        """Weight of the joint as of pipe of its length [N], metal and covering."""
        if size(e.delta) == 0.0:
            return 0.0
        family = mt.FAMILIES.get(e.material, mt.FAMILIES[1])
        bore, outside = e.od - 2.0 * e.wall, e.od + 2.0 * e.insulation
        metal = (e.od**2 - bore**2) * (e.density or family.density)
        cover = (outside**2 - e.od**2) * e.insulation_density
        g = self.model.settings.g
        weight = size(e.delta) * (0.25 * pi * (metal + cover) * g + e.cover_weight)
        text = "expansion joints weigh as pipe of their length, diameter and wall does"
        self.findings.assume(text, e.line)
        return float(f"{weight:.7g}")


def uniform_loads(job: Job) -> list[tuple[Uniform, ...]]:
    """Uniform loads of every element; a pointer holds until the next one.

    What is in g and the same everywhere is left to `loads`: it is an acceleration.
    """
    held: tuple[tuple[Vec, bool], ...] = ()
    rows = []
    for e in job.elements:
        held = e.uniform.loads if e.uniform is not None else held
        rows.append(held)
    everywhere = accelerations(job)
    found = []
    for row in rows:
        loads = [
            Uniform(SETS[n], vector, in_g)
            for n, (vector, in_g) in enumerate(row)
            if any(vector) and n not in everywhere
        ]
        found.append(tuple(loads))
    return found


def accelerations(job: Job) -> dict[int, Vec]:
    """Sets (from 0) of uniform loads that are in g and the same for all elements."""
    first = job.elements[0].uniform
    if first is None:
        return {}
    others = [e.uniform for e in job.elements[1:] if e.uniform is not None]
    return {
        n: vector
        for n, (vector, in_g) in enumerate(first.loads)
        if in_g and any(vector) and all(u.loads[n] == (vector, True) for u in others)
    }
