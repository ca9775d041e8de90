"""Tables of nodes and elements: displacements, end forces, stresses, modes."""

from collections.abc import Sequence

import numpy as np

from trunnion.arrays import CaseResult, ModeSet
from trunnion.report.sheets import LOADS, LOCAL, MOVES, Cell, Column, Sheet, amounts, six
from trunnion.report.units import ReportUnits
from trunnion.results import tables
from trunnion.results.balance import local_end_forces
from trunnion.results.stresses import Stresses, end_stresses, mid_stresses
from trunnion.results.supports import solved

STRESSES = {
    "axial": "AXIAL", "pressure": "PRESSURE", "bending": "BENDING", "shear": "SHEAR",
    "torsion": "TORSION", "longitudinal": "LONGITUDINAL", "hoop_inner": "HOOP",
    "principal_max": "S1", "principal_min": "S3", "von_mises": "VON MISES",
}  # fmt: skip


def displacements(cases: Sequence[CaseResult], units: ReportUnits) -> Sheet:
    """Displacements of every node and of the bends' middles, case by case."""
    found = [tables.displacements(case) for case in cases]
    values = np.concatenate([table.values for table in found])
    columns = [
        Column("CASE", [c.name for c, t in zip(cases, found, strict=True) for _ in t.labels]),
        Column("NODE", [label for table in found for label in table.labels]),
        *six(MOVES, values, units.movement, units.rotation),
    ]
    return Sheet("displacements", "Displacements", "of the pipe, global", columns, keys=2)


def forces(cases: Sequence[CaseResult], units: ReportUnits) -> Sheet:
    """Forces on the ends of every element, global and along the pipe, two rows an element."""
    parts = cases[0].system.parts
    ids = [name for name in tables.element_ids(parts) for _ in range(2)]
    force = np.concatenate([solved(case).end_force.reshape(-1, 6) for case in cases])
    local = np.concatenate([local_end_forces(case).reshape(-1, 6) for case in cases])
    columns = [
        Column("CASE", [case.name for case in cases for _ in ids]),
        Column("ELEMENT", ids * len(cases)),
        Column("AT", [end for p in parts for end in (p.start, p.end)] * len(cases)),
        Column("TYPE", [p.type for p in parts for _ in range(2)] * len(cases)),
        *six(LOADS, force, units.force, units.moment),
        *six(LOCAL, local, units.force, units.moment),
    ]
    note = "ON THE ELEMENT at its ends: global, then with x along the pipe (AXIAL > 0 at the "
    note += "second end: tension)"
    return Sheet("forces", "Element forces", note, columns, keys=3)


def stresses(cases: Sequence[CaseResult], units: ReportUnits) -> Sheet:
    """Nominal stresses at both ends of every pipe and at the bends' middles, case by case."""
    rows: list[tuple[Cell, Cell, Cell]] = []
    values: dict[str, list[float]] = {name: [] for name in STRESSES}
    for case in cases:
        element, first, second = end_stresses(case)
        labels, middle = mid_stresses(case)
        ids, parts = tables.element_ids(case.system.parts), case.system.parts
        for e in element.tolist():
            rows += [(case.name, ids[e], end) for end in (parts[e].start, parts[e].end)]
        rows += [(case.name, ids[case.system.mid[m]], m) for m in labels]
        for name, column in values.items():
            column += _ends(first, second, name) + getattr(middle, name).tolist()
    cells = list(zip(*rows, strict=True)) or [()] * 3
    columns = [Column(head, cells[i]) for i, head in enumerate(("CASE", "ELEMENT", "AT"))]
    columns += [amounts(head, values[name], units.stress) for name, head in STRESSES.items()]
    note = "nominal, intensification 1; AXIAL without the pressure's own; HOOP at the inner wall"
    return Sheet("stresses", "Stresses", note, columns, keys=3)


def _ends(first: Stresses, second: Stresses, name: str) -> list[float]:
    """One stress at the two ends of each pipe, one after the other."""
    ends = np.column_stack([getattr(first, name), getattr(second, name)])
    both: list[float] = ends.ravel().tolist()
    return both


def modes(found: ModeSet) -> Sheet:
    """Natural modes: frequency, participation, effective mass."""
    table = tables.modes(found)
    columns = [Column("MODE", range(1, len(table) + 1), "", 0)]
    decimals = {"Hz": 4, "s": 5, "kg^0.5": 3, "kg": 2, "%": 2}
    for i, (name, unit) in enumerate(zip(table.columns, table.units, strict=True)):
        cells = [x if np.isfinite(x) else None for x in table.values[:, i].tolist()]
        head = name.upper().replace("_", " ")
        columns.append(Column(head, cells, unit, decimals.get(unit, 1), exponent=not unit))
    return Sheet("modes", "Natural modes", "about the frozen contact state", columns)
