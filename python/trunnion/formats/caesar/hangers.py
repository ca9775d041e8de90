"""Spring hangers of the job: given ones, and those that the program designs."""

from collections.abc import Callable
from dataclasses import replace

from trunnion.formats.caesar.geometry import Labels
from trunnion.formats.caesar.job import HangerData, Job, Sets
from trunnion.formats.findings import Findings
from trunnion.model import Direction, HangerDesign, Model, Place, Support

ANVIL = (0, 1)  # numbers of hanger tables: the default, which is the maker's of number 1


class Hangers:
    """Adds the hangers; `names` gives a support its name by a tag."""

    def __init__(
        self,
        job: Job,
        labels: Labels,
        model: Model,
        findings: Findings,
        names: Callable[[str], str | None],
    ) -> None:
        self.job = job
        self.labels = labels
        self.model = model
        self.findings = findings
        self.names = names
        heated = any(x is not None for e in job.elements for x in (*e.t, *e.strain))
        self.travels = heated or any(_moves(s) for e in job.elements for s in e.displacements)

    def add(self, h: HangerData) -> None:
        """Add a spring hanger; one without rate and load waits for its design."""
        label = self.labels.node(h.node)
        name = f"node {h.node}"
        if label is None:
            self.findings.leave_out(h.line, name, "hanger at a node that no element has")
            return
        cnode = self.labels.cnode(h.cnode, h.line, "hanger")
        n = max(1, h.number)  # the program multiplies rate and load by the number of hangers
        load = n * (h.constant or h.cold_load)
        line = self.job.elements[self.labels.at[h.node][0]].line if h.node in self.labels.at else 0
        place = self.findings.place(line or h.line)
        if not load:
            self._designed(h, label, cnode, n, place)
            return
        if not (h.rate or h.constant):
            text = f"the hanger at {h.node} has a load, but no rate: it is a constant support"
            self.findings.assume(text, h.line)
        rate = 0.0 if h.constant else n * h.rate
        made = Support(label, "hanger", (), cnode, self.names(h.tag), rate, load=load, place=place)
        self.model.supports.append(made)
        self.findings.note(made, f"hanger of line {h.line}" + f", {n} of them" * (n > 1))

    def _designed(self, h: HangerData, label: str, cnode: str | None, n: int, place: Place) -> None:
        """Add a hanger that the program selects."""
        if h.rate or h.hot_load:
            given = "a rate" if h.rate else f"an operating load of {h.hot_load:.6g} N"
            text = f"hanger with {given}, but no cold load; designed anew, for the weight found"
            self.findings.leave_out(h.line, f"node {h.node}", text)
        if h.space:
            text = "springs are selected without regard to the space available for hangers"
            self.findings.assume(text, h.line)
        if not self.travels:
            text = (
                "hanger to be designed in a job without temperatures or movements; taken as a rest"
            )
            self.findings.leave_out(h.line, f"node {h.node}", text)
            rest = (Direction(f"+{self.job.up}"),)
            made = Support(label, "support", rest, cnode, self.names(h.tag), place=place)
            self.model.supports.append(made)
            self.findings.note(made, f"hanger of line {h.line}, that nothing moves")
            return
        method = "COLD" if h.cold_design else "HOT"
        variation = h.variation / 100.0
        known = h.table in ANVIL
        design = HangerDesign(variation, h.rod, h.most, min(n, 100), method)
        design = replace(design, table="ANVIL") if known else design
        free = [*self._freed(h), None, None]
        design = replace(design, free=free[0], free2=free[1])
        name = self.names(h.tag)
        made = Support(label, "hanger", (), cnode, name, 0.0, place=place, design=design)
        self.model.supports.append(made)
        self.findings.note(made, f"hanger of line {h.line}, to be designed; table {h.table}")
        text = f"hanger table {h.table} is not here: springs are of a generic table, of no maker"
        if known:
            text = "springs of hangers are selected from the program's default table (ANVIL)"
        self.findings.assume(text, h.line)

    def _freed(self, h: HangerData) -> list[str]:
        """Labels of the anchors that the design of a hanger frees."""
        found = []
        for node, code in h.free:
            label = self.labels.node(node)
            if label is None:
                text = f"hanger that frees node {node}, which no element has"
                self.findings.leave_out(h.line, f"node {h.node}", text)
                continue
            found.append(label)
            if code > 1:
                text = f"the hanger at {h.node} frees more than the vertical of {node}: that alone"
                self.findings.assume(f"{text} is freed while the weight is balanced", h.line)
        return found


def _moves(record: Sets) -> bool:
    """Tell whether imposed displacements move their node."""
    return any(any(row) for row in record.values)
