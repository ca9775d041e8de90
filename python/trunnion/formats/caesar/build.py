"""From a job to a model: pipes, rigids and bends, then what stands on them."""

from dataclasses import replace
from math import pi

from trunnion.formats.caesar.geometry import Labels, size
from trunnion.formats.caesar.job import Element, Job, Vec
from trunnion.formats.caesar.loads import Loads
from trunnion.formats.caesar.parts import Parts
from trunnion.formats.caesar.properties import Properties
from trunnion.formats.caesar.restraints import Restraints
from trunnion.formats.findings import Findings
from trunnion.formats.imported import Imported
from trunnion.model import Bend, Model, Operation, Pipe, Settings, Support

INSULATED = 1.75  # insulation of a rigid weighs as much as that of so much pipe


def build(job: Job, findings: Findings, name: str, header: tuple[str, ...] = ()) -> Imported:
    """Make the model of a job.

    Parameters
    ----------
    name : format and version, for the reports.
    """
    pressed = any(x for e in job.elements for x in e.p)
    bent = any(e.bend for e in job.elements)
    stiffen = "MAX" if pressed and bent else "OFF"
    model = Model(
        title=_title(job.titles),
        units=job.units,
        settings=replace(Settings(), up=job.up, stiffen=stiffen),
    )
    labels = Labels(job, findings)
    _Pipes(job, labels, model, findings).add()
    findings.stop()
    _add_bends(labels, model, findings)
    restraints = Restraints(job, labels, model, findings)
    for i in range(len(job.elements)):
        restraints.element(i)
    for hanger in job.hangers:
        restraints.hanger(hanger)
    _nozzles(job, labels, model, findings)
    loads = Loads(job, labels, model, findings)
    for e in job.elements:
        loads.element(e)
    loads.uniform()
    loads.wind()
    findings.stop()
    Parts(job, labels, model, findings).place()
    for records in (model.supports, model.displacements, model.forces):
        records.sort(key=lambda record: record.place.line)
    _assume(job, model, findings)
    return findings.finish(model, name, header)


def _title(titles: tuple[str, ...]) -> str:
    """First line of the title page that can be a TITLE card."""
    for title in titles:
        clean = "".join(c if c.isprintable() and c not in "!&" else " " for c in title)
        if clean.strip():
            return " ".join(clean.split())[:200]
    return ""


class _Pipes:
    """Adds the pipes and rigid bodies of all elements."""

    def __init__(self, job: Job, labels: Labels, model: Model, findings: Findings) -> None:
        self.job = job
        self.labels = labels
        self.model = model
        self.findings = findings
        self.properties = Properties(job, model, findings)

    def add(self) -> None:
        """Add all of them."""
        for i, e in enumerate(self.job.elements):
            name = f"element {e.start}-{e.end}"
            self._refuse(e, name)
            if e.start == e.end:
                self.findings.fault(e.line, f"{name} starts and ends at the same node")
            elif size(e.delta) == 0.0:
                self._tie(i, e)
            else:
                self._pipe(i, e)

    def _refuse(self, e: Element, name: str) -> None:
        """Tell what of an element has no counterpart."""
        leave = self.findings.leave_out
        if e.joint is not None:
            leave(e.joint.line, name, "expansion joint; taken as pipe")
        if e.reducer is not None:
            leave(e.reducer.line, name, "reducer; taken as pipe of the size at its FROM end")
        if e.offsets is not None and (any(e.offsets.start) or any(e.offsets.end)):
            leave(e.offsets.line, name, "offsets of its ends; taken without")
        strains = [n + 1 for n, x in enumerate(e.strain) if x is not None]
        if strains:
            text = f"T{strains[0]} is an expansion (length by length), not a temperature"
            leave(e.line, name, f"{text}; taken as ambient temperature")
        if e.bend is not None and e.bend.miters:
            leave(e.bend.line, name, f"mitre bend of {e.bend.miters} cuts; taken as smooth bend")
        fitting = e.bend.fitting_wall if e.bend is not None else 0.0
        if e.bend is not None and fitting > 0.0 and abs(fitting / e.wall - 1.0) > 5e-3:
            text = f"bend with a wall of {1e3 * fitting:.4g} mm; taken with the wall of the pipe"
            leave(e.bend.line, name, text)

    def _tie(self, i: int, e: Element) -> None:
        """Join the ends of an element without length rigidly."""
        start, end = self.labels.ends(i)
        made = Support(end, "anchor", (), start, place=self.findings.place(e.line))
        self.model.supports.append(made)
        text = f"element {e.start}-{e.end} has no length: its ends are joined rigidly"
        self.findings.assume(text, e.line)
        self.findings.note(made, f"element {i + 1} (line {e.line}) without length")

    def _pipe(self, i: int, e: Element) -> None:
        """Add one pipe or rigid; a rigid at a bend has a pipe for its tangent."""
        section, material = self.properties.section(e), self.properties.material(e)
        operation = self.properties.operation(e)
        if not section:
            return
        start, end = self.labels.ends(i)
        delta = e.delta
        corner = self.labels.corners.get(e.start)
        if e.rigid is not None and corner is not None and corner.after == i:
            rest = size(delta) - corner.tangent
            part = corner.tangent / size(delta)
            if rest <= 1e-9:
                text = "rigid element that is no longer than the tangent of a bend; taken as pipe"
                self.findings.leave_out(e.line, f"element {e.start}-{e.end}", text)
                e = replace(e, rigid=None)
            else:
                weld = f"{e.start}T"
                tangent = _times(part, delta)
                self._append(i, e, (start, weld), tangent, section, material, operation, None)
                start, delta = weld, _times(1.0 - part, delta)
        weight = None if e.rigid is None else self._weight(e, size(delta))
        self._append(i, e, (start, end), delta, section, material, operation, weight)

    def _append(
        self,
        i: int,
        e: Element,
        ends: tuple[str, str],
        delta: Vec,
        section: str,
        material: str,
        operation: Operation,
        weight: float | None,
    ) -> None:
        """Add one pipe, or rigid of a weight, with its comment."""
        made = Pipe(
            *ends,
            delta,
            section,
            material,
            operation,
            rigid=weight is not None,
            weight=weight or 0.0,
            place=self.findings.place(e.line),
        )
        self.model.pipes.append(made)
        names = [n for n in e.names if n]
        text = f"element {i + 1}, line {e.line}"
        text += f": {e.name}" if e.name else ""
        text += f" ({' - '.join(names)})" if names else ""
        if weight is not None and e.rigid is not None:
            kinds = {1: "valve", 2: "flange", 3: "flange pair", 4: "flanged valve"}
            kind = kinds.get(e.rigid.type, "rigid")
            text += f": {kind} of {e.rigid.weight:.6g} N"
            text += ", its contents and insulation added" if weight != e.rigid.weight else ""
        self.findings.note(made, text)

    def _weight(self, e: Element, length: float) -> float:
        """Weight of a rigid: its own, of the contents, and 1.75 times that of the insulation."""
        assert e.rigid is not None
        if e.rigid.weight <= 0.0:
            return 0.0  # a link without weight, contents and insulation
        g, bore = self.model.settings.g, e.od - 2.0 * e.wall
        fluid = 0.25 * pi * max(bore, 0.0) ** 2 * e.fluid_density * g
        cover = e.cover_weight
        if not cover:
            outside = e.od + 2.0 * e.insulation
            cover = 0.25 * pi * (outside**2 - e.od**2) * e.insulation_density * g
        return float(f"{e.rigid.weight + length * (fluid + INSULATED * cover):.7g}")


def _add_bends(labels: Labels, model: Model, findings: Findings) -> None:
    for node, corner in labels.corners.items():
        e = labels.job.elements[corner.before]
        bend = e.bend
        assert bend is not None
        k = bend.k if bend.k >= 1.0 else None
        place = findings.place(e.line)
        made = Bend(str(node), corner.radius, k=k, flanges=bend.flanges, place=place)
        model.bends.append(made)
        nodes = [f"{n} is {labels.arc[n]}" for _, n in bend.nodes if n in labels.arc]
        findings.note(made, f"bend of line {bend.line}" + "".join(f", node {n}" for n in nodes))
    model.bends.sort(key=lambda record: record.place.line)


def _nozzles(job: Job, labels: Labels, model: Model, findings: Findings) -> None:
    """Hold the nodes of flexible nozzles rigidly."""
    for nozzle in job.nozzles:
        label = labels.node(nozzle.node)
        name = f"node {nozzle.node}"
        if label is None:
            findings.leave_out(nozzle.line, name, "flexible nozzle at a node that no element has")
            continue
        findings.leave_out(nozzle.line, name, "flexible nozzle; taken as rigid")
        vessel = labels.node(nozzle.vessel) if nozzle.vessel else None
        line = job.elements[labels.at[nozzle.node][0]].line if nozzle.node in labels.at else 1
        made = Support(label, "anchor", (), vessel, place=findings.place(line))
        model.supports.append(made)
        findings.note(made, f"nozzle of line {nozzle.line}, held rigidly")


def _assume(job: Job, model: Model, findings: Findings) -> None:
    """Say what was chosen for the whole model."""
    text = "the file has no load cases: the default ones, SUS, OPE and EXP, are taken"
    findings.assume(text)
    if model.settings.stiffen != "OFF":
        text = "pressure stiffens bends by the largest pressure (STIFFEN=MAX), as in the program"
        findings.assume(text)
    if any(e.checks for e in job.elements):
        text = "allowables, SIFs, flange and equipment checks are of no effect here"
        findings.assume(f"{text}: stresses are nominal")


def _times(f: float, v: Vec) -> Vec:
    return f * v[0], f * v[1], f * v[2]
