"""From a job to a model: pipes, rigids and bends, then what stands on them."""

from dataclasses import replace

from trunnion.formats.caesar.geometry import Labels
from trunnion.formats.caesar.job import Job
from trunnion.formats.caesar.loads import Loads
from trunnion.formats.caesar.offsets import links_for_offsets
from trunnion.formats.caesar.parts import Parts
from trunnion.formats.caesar.pipes import Pipes
from trunnion.formats.caesar.restraints import Restraints
from trunnion.formats.caesar.tees import Hinge, flexible_tees, uses_b31j
from trunnion.formats.findings import Findings
from trunnion.formats.imported import Imported
from trunnion.model import Model, Settings, Spring, Support


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
    job = links_for_offsets(job, findings)
    job, hinges = flexible_tees(job, findings)
    labels = Labels(job, findings)
    pipes = Pipes(job, labels, model, findings)
    pipes.add()
    findings.stop()
    pipes.add_bends()
    restraints = Restraints(job, labels, model, findings)
    for i in range(len(job.elements)):
        restraints.element(i)
    for hanger in job.hangers:
        restraints.hanger(hanger)
    _hinges(hinges, labels, model, findings)
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


def _hinges(hinges: tuple[Hinge, ...], labels: Labels, model: Model, findings: Findings) -> None:
    """Add the rotations of branches: a spring that is stiff but about the axis of the run."""
    k, kr = model.settings.k, model.settings.kr
    for hinge in hinges:
        ends = labels.node(hinge.surface), labels.node(hinge.start)
        if ends[0] is None or ends[1] is None:
            continue
        x, y, z = (round(x, 12) + 0.0 for x in hinge.axis)
        stiff = (k, k, k, hinge.stiffness, kr, kr)
        made = Spring(ends[0], ends[1], stiff, (x, y, z), findings.place(hinge.line))
        model.springs.append(made)
        findings.note(made, f"flexibility of the tee at {hinge.surface}, out of plane (B31J)")


def _nozzles(job: Job, labels: Labels, model: Model, findings: Findings) -> None:
    """Hold the nodes of flexible nozzles rigidly, on their vessel where that has movements."""
    moved = {s.node for e in job.elements for s in e.displacements}
    for nozzle in job.nozzles:
        label = labels.node(nozzle.node)
        name = f"node {nozzle.node}"
        if label is None:
            findings.leave_out(nozzle.line, name, "flexible nozzle at a node that no element has")
            continue
        findings.leave_out(nozzle.line, name, "flexible nozzle; taken as rigid")
        vessel = labels.node(nozzle.vessel) if nozzle.vessel else None
        if vessel is None and nozzle.vessel in moved:
            vessel = str(nozzle.vessel)
        line = job.elements[labels.at[nozzle.node][0]].line if nozzle.node in labels.at else 1
        made = Support(label, "anchor", (), vessel, place=findings.place(line))
        model.supports.append(made)
        findings.note(made, f"nozzle of line {nozzle.line}, held rigidly")


def _assume(job: Job, model: Model, findings: Findings) -> None:
    """Say what was chosen for the whole model."""
    bent = any(e.bend for e in job.elements)
    text = "the file has no load cases: the default ones, SUS, OPE and EXP, are taken"
    findings.assume(text)
    if model.settings.stiffen != "OFF":
        text = "pressure stiffens bends by the largest pressure (STIFFEN=MAX), as in the program"
        findings.assume(text)
    if bent and uses_b31j(job):
        findings.assume(
            "elbows of 90 degrees have k = 1.3/h (ASME B31J), as in version 14 by its "
            "default piping code; code 3 has 1.65/h"
        )
    if any(e.checks for e in job.elements):
        text = "allowables, SIFs, flange and equipment checks are of no effect here"
        findings.assume(f"{text}: stresses are nominal")
