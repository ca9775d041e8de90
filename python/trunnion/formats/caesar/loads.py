"""Displacements, forces, uniform loads and wind of the job."""

from trunnion.formats.caesar.bodies import accelerations
from trunnion.formats.caesar.geometry import Labels
from trunnion.formats.caesar.job import Element, Job, Sets, Six
from trunnion.formats.findings import Findings
from trunnion.model import SETS, Acceleration, Displacement, Force, Model, Support


class Loads:
    """Adds what the elements carry; each record of the file once."""

    def __init__(self, job: Job, labels: Labels, model: Model, findings: Findings) -> None:
        self.job = job
        self.labels = labels
        self.model = model
        self.findings = findings
        self._done: set[int] = set()  # identities: all records of an XML may stand on one line
        self._anchored = {s.node for s in model.supports if s.kind == "anchor"}

    def element(self, e: Element) -> None:
        """Add displacements and forces of one element."""
        for record in e.displacements:
            label = self._label(record, "displacements")
            if label is not None:
                self._displacements(e, record, label)
        for record in e.forces:
            label = self._label(record, "forces")
            if label is not None:
                self._forces(e, record, label)

    def uniform(self) -> None:
        """Add uniform loads in g that hold for all elements as accelerations."""
        first = self.job.elements[0]
        for n, vector in accelerations(self.job).items():
            made = Acceleration(SETS[n], vector, self.findings.place(first.line))
            self.model.accelerations.append(made)
            assert first.uniform is not None
            line = first.uniform.line
            self.findings.note(made, f"uniform load {SETS[n]} in g (line {line})")
            text = "uniform loads in g are occasional loads, linear about the operating case"
            self.findings.assume(text, line)

    def wind(self) -> None:
        """Say that wind is not in the file."""
        winds = [e.wind for e in self.job.elements if e.wind is not None and e.wind.kind != 2]
        if not winds:
            return
        kinds = {"wave" if w.kind == 1 else "wind" for w in winds}
        shapes = ", ".join(f"{x:g}" for x in sorted({w.shape for w in winds}))
        text = (
            f"{' and '.join(sorted(kinds))} with shape factor {shapes}: the file has no pressure "
        )
        self.findings.assume(f"{text}or waves, so the model has none", winds[0].line)

    def _label(self, record: Sets, what: str) -> str | None:
        """Label of the node; None for a record that was read already or stands nowhere."""
        if id(record) in self._done:
            return None
        self._done.add(id(record))
        label = self.labels.standing(record.node)
        if label is None:
            text = f"{what} at node {record.node}, which no element has"
            self.findings.leave_out(record.line, f"node {record.node}", text)
        return label

    def _displacements(self, e: Element, record: Sets, label: str) -> None:
        """Add imposed displacements; six zeros alone are an anchor."""
        held = [row for row in record.values if any(x is not None for x in row)]
        place = self.findings.place(e.line)
        if held and all(row == (0.0,) * 6 for row in held):
            if label in self._anchored:
                return
            self._anchored.add(label)
            made = Support(label, "anchor", place=place)
            self.model.supports.append(made)
            text = f"held by displacements of 0 (line {record.line})"
            self.findings.note(made, text)
            return
        rows = list(enumerate(record.values))
        kept = [(n, row) for n, row in rows if any(row)]
        if not kept:  # some freedoms are held, none is moved
            kept = [(n, row) for n, row in rows if row in held][:1]
        missing = _held(held) - _held([row for _, row in kept])
        for n, row in rows:
            more = {i for i in missing if row[i] is not None}
            if more and (n, row) not in kept:
                kept.append((n, row))
                missing -= more
        for n, row in sorted(kept):
            moved = Displacement(label, SETS[n], row, place)
            self.model.displacements.append(moved)
            self.findings.note(moved, f"displacements of line {record.line}")

    def _forces(self, e: Element, record: Sets, label: str) -> None:
        for n, row in enumerate(record.values):
            if any(row):
                f = tuple(x or 0.0 for x in row)
                made = Force(
                    label,
                    SETS[n],
                    (f[0], f[1], f[2], f[3], f[4], f[5]),
                    self.findings.place(e.line),
                )
                self.model.forces.append(made)
                self.findings.note(made, f"forces of line {record.line}")


def _held(rows: list[Six]) -> set[int]:
    """Freedoms that any of some rows holds."""
    return {i for row in rows for i, x in enumerate(row) if x is not None}
