"""Elements of the job as pipes, rigid bodies, reducers and expansion joints of the model."""

from dataclasses import replace

from trunnion.formats.caesar.bendfactors import factor_of
from trunnion.formats.caesar.bodies import Bodies
from trunnion.formats.caesar.geometry import Labels, size
from trunnion.formats.caesar.job import Element, Job, Vec
from trunnion.formats.caesar.properties import Properties, coefficient
from trunnion.formats.caesar.tees import uses_b31j
from trunnion.formats.findings import Findings
from trunnion.model import Bend, Model, Pipe, Support

_KINDS = {1: "valve", 2: "flange", 3: "flange pair", 4: "flanged valve"}


class Pipes:
    """Adds the pipes of all elements, and the bends."""

    def __init__(self, job: Job, labels: Labels, model: Model, findings: Findings) -> None:
        self.job = job
        self.labels = labels
        self.model = model
        self.findings = findings
        self.properties = Properties(job, model, findings)
        self.bodies = Bodies(job, model, findings, self.properties)

    def add(self) -> None:
        """Add all of them."""
        for i, e in enumerate(self.job.elements):
            self._refuse(e, f"element {e.start}-{e.end}")
            if e.start == e.end:
                text = f"element {e.start}-{e.end} starts and ends at the same node"
                self.findings.fault(e.line, text)
            elif size(e.delta) == 0.0 and e.joint is None:
                self._tie(i, e)
            else:
                self._pipe(i, e)

    def add_bends(self) -> None:
        """Add the bends, in the order of their elements."""
        for node, corner in self.labels.corners.items():
            e = self.job.elements[corner.before]
            bend = e.bend
            assert bend is not None
            modulus = self.model.materials[self.properties.material(e)].e
            factor = factor_of(bend, e, corner, modulus, b31j=uses_b31j(self.job))
            if factor.text and factor.k != bend.k and "B31J" not in factor.text:
                text = f"bend at {node}: {factor.text}"
                self.findings.assume(text, bend.line)
            place = self.findings.place(e.line)
            made = Bend(str(node), corner.radius, k=factor.k, flanges=bend.flanges, place=place)
            self.model.bends.append(made)
            arc = self.labels.arc
            nodes = [f", node {n} is {arc[n]}" for _, n in bend.nodes if n in arc]
            text = f"bend of line {bend.line}" + "".join(nodes)
            self.findings.note(made, f"{text}: {factor.text}" if factor.text else text)
        self.model.bends.sort(key=lambda record: record.place.line)

    def _refuse(self, e: Element, name: str) -> None:
        """Tell what of an element has no counterpart."""
        leave = self.findings.leave_out
        strains = [n + 1 for n, x in enumerate(e.strain) if x is not None]
        if strains and coefficient(e) is None:
            text = f"T{strains[0]} is an expansion (length by length), others are temperatures"
            leave(e.line, name, f"{text}; taken as ambient temperature")

    def _tie(self, i: int, e: Element) -> None:
        """Join the ends of an element without length rigidly."""
        start, end = self.labels.ends(i)
        made = Support(end, "anchor", (), start, place=self.findings.place(e.line))
        self.model.supports.append(made)
        text = f"element {e.start}-{e.end} has no length: its ends are joined rigidly"
        self.findings.assume(text, e.line)
        self.findings.note(made, f"element {i + 1} (line {e.line}) without length")

    def _pipe(self, i: int, e: Element) -> None:
        """Add one pipe or body; a body that leaves a bend has a pipe for its tangent."""
        section, material = self.properties.section(e), self.properties.material(e)
        operation = self.properties.operation(e)
        if not section:
            return
        start, end = self.labels.ends(i)
        place = self.findings.place(e.line)
        made = Pipe(start, end, e.delta, section, material, operation, place=place)
        if e.offsets is not None:
            arms = e.offsets.start, e.offsets.end
            made = replace(made, offsets=tuple(arm if any(arm) else None for arm in arms))
        weld = self.labels.weld(i)
        if weld is not None:
            part = self.labels.corners[e.start].tangent / size(e.delta)
            tangent = replace(made, end=weld, delta=_times(part, e.delta))
            tangent = replace(tangent, uniform=self.bodies.uniforms[i])
            self._append(i, e, tangent, "tangent of the bend before the body")
            e = replace(e, delta=_times(1.0 - part, e.delta))
            made = replace(made, start=weld, delta=e.delta)
        else:
            e = self._without_body(i, e)
        self._append(i, e, self.bodies.dressed(i, e, made))

    def _without_body(self, i: int, e: Element) -> Element:
        """Give an element that is nothing but the tangent of a bend as plain pipe, and say so."""
        bends = self.labels.tangent_at(i)
        if e.start in bends or e.end in bends:
            bodies = {"rigid": e.rigid, "reducer": e.reducer, "expansion joint": e.joint}
            for what in (name for name, body in bodies.items() if body is not None):
                where = "ends in" if e.end in bends else "is no longer than the tangent of"
                text = f"{what} that {where} a bend; taken as pipe of the size at its FROM end"
                self.findings.leave_out(e.line, f"element {e.start}-{e.end}", text)
            e = replace(e, rigid=None, reducer=None, joint=None)
        return e

    def _append(self, i: int, e: Element, made: Pipe, more: str = "") -> None:
        """Add one pipe with its comment."""
        self.model.pipes.append(made)
        names = [n for n in e.names if n]
        text = f"element {i + 1}, line {e.line}"
        text += f": {e.name}" if e.name else ""
        text += f" ({' - '.join(names)})" if names else ""
        if e.rigid is not None and made.rigid:
            more = _KINDS.get(e.rigid.type, "rigid element")
        self.findings.note(made, f"{text}: {more}" if more else text)


def _times(f: float, v: Vec) -> Vec:
    return f * v[0], f * v[1], f * v[2]
