"""The numbers of one case: displacements and element forces."""

import numpy as np

from trunnion.arrays import F8, CaseResult
from trunnion.report.columns import Column, numbers, section, table, words
from trunnion.report.units import ReportUnits
from trunnion.results.balance import local_end_forces
from trunnion.results.supports import solved


def displacement_table(case: CaseResult, units: ReportUnits) -> str:
    """Print the displacements of every node."""
    system, u = case.system, solved(case).u
    d = units.movement.showing(largest(u[:, :3]))
    r = units.rotation.showing(largest(u[:, 3:]))
    columns = [words("NODE", system.labels)]
    for i, head in enumerate(("DX", "DY", "DZ", "RX", "RY", "RZ")):
        columns.append(numbers(head, u[:, i], r if i > 2 else d, 14))
    return section(f"{case.name}: DISPLACEMENTS", "global") + table(columns)


def element_tables(case: CaseResult, units: ReportUnits) -> str:
    """Print the end forces on every element, global and in the axes of its ends."""
    force = solved(case).end_force
    if not len(force):
        return ""
    local = local_end_forces(case)
    name = case.name
    text = section(f"{name}: ELEMENT FORCES", "ON THE ELEMENT at its ends, global")
    text += table(_ends(case, force, units, ("FX", "FY", "FZ", "MX", "MY", "MZ")))
    note = "ON THE ELEMENT at its ends; x along the pipe there; "
    note += "AXIAL > 0 at the second: tension" if case.linear else "combined in these axes"
    text += section(f"{name}: ELEMENT FORCES, LOCAL", note)
    heads = ("AXIAL", "SHEAR y", "SHEAR z", "TORSION", "BENDING y", "BENDING z")
    return text + table(_ends(case, local, units, heads))


def _ends(case: CaseResult, force: F8, units: ReportUnits, heads: tuple[str, ...]) -> list[Column]:
    """Two rows an element; its name stands in the first."""
    parts = case.system.parts
    names = [name for p in parts for name in (f"{p.start}-{p.end}", "")]
    at = [label for p in parts for label in (p.start, p.end)]
    rows = force.reshape(-1, 6)
    q = units.force.showing(largest(rows[:, :3]))
    m = units.moment.showing(largest(rows[:, 3:]))
    columns = [words("ELEMENT", names), words("AT", at)]
    for i, head in enumerate(heads):
        columns.append(numbers(head, rows[:, i], m if i > 2 else q, 14))
    return columns


def largest(values: F8) -> float:
    """Largest absolute number, 0 of nothing."""
    return float(np.abs(values).max(initial=0.0))
