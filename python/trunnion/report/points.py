"""The inside of elements: stresses at their ends, bend middles, deflection between supports."""

import numpy as np

from trunnion.arrays import F8, STRAIGHT, CaseResult
from trunnion.report.answers import largest
from trunnion.report.columns import Column, numbers, plain, section, table, words
from trunnion.report.units import ReportUnits
from trunnion.results.interior import extreme_deflections, mid_points
from trunnion.results.stresses import Stresses, end_stresses, mid_stresses

SAGS = 20  # spans printed, the deepest first
HEADS = {
    "axial": "AXIAL", "pressure": "PRESSURE", "bending": "BENDING", "shear": "SHEAR",
    "torsion": "TORSION", "longitudinal": "LONGIT.", "hoop_inner": "HOOP IN",
    "principal_max": "S1", "principal_min": "S3", "von_mises": "VON MISES",
}  # fmt: skip


def stress_table(case: CaseResult, units: ReportUnits) -> str:
    """Print nominal stresses at both ends of every pipe and at the bends' middles."""
    element, first, second = end_stresses(case)
    if not element.size:
        return ""
    labels, middle = mid_stresses(case)
    parts = [case.system.parts[i] for i in element.tolist()]
    names = [name for p in parts for name in (f"{p.start}-{p.end}", "")]
    at = [label for p in parts for label in (p.start, p.end)]
    columns = [
        words("ELEMENT", names + ["middle"] * len(labels)),
        words("AT", at + list(labels)),
    ]
    for name, head in HEADS.items():
        ends = np.column_stack([getattr(first, name), getattr(second, name)]).ravel()
        values = np.concatenate([ends, getattr(middle, name)])
        columns.append(numbers(head, values, units.stress, 10))
    note = "nominal, intensification 1; axial without the pressure's own"
    text = section(f"{case.name}: STRESSES", note) + table(columns)
    return text + _highest(first, second, at, units)


def _highest(first: Stresses, second: Stresses, at: list[str], units: ReportUnits) -> str:
    """Name the node of the highest von Mises stress."""
    ends = np.column_stack([first.von_mises, second.von_mises]).ravel()
    if not ends.size:
        return ""
    i = int(ends.argmax())
    value = units.stress.text(float(ends[i]))
    return f"  highest von Mises stress {value} {units.stress.unit} at {at[i]}\n"


def middle_table(case: CaseResult, units: ReportUnits) -> str:
    """Print displacement and section forces at the bends' middles that are no nodes."""
    middle = mid_points(case)
    if middle is None:
        return ""
    labels, u, force = list(case.system.mid), middle.displacement, middle.section_force
    text = section(f"{case.name}: BEND MIDDLES", "displacements global")
    text += table(_six(labels, u, ("DX", "DY", "DZ", "RX", "RY", "RZ"), units, "DR"))
    heads = ("AXIAL", "SHEAR y", "SHEAR z", "TORSION", "BENDING y", "BENDING z")
    text += section(f"{case.name}: BEND MIDDLES, SECTION FORCES", "axial force: tension positive")
    return text + table(_six(labels, force, heads, units, "FM"))


def _six(
    labels: list[str], values: F8, heads: tuple[str, ...], units: ReportUnits, kind: str
) -> list[Column]:
    both = {"F": units.force, "M": units.moment, "D": units.movement, "R": units.rotation}
    first = both[kind[0]].showing(largest(values[:, :3]))
    second = both[kind[1]].showing(largest(values[:, 3:]))
    columns = [words("AT", labels)]
    for i, head in enumerate(heads):
        columns.append(numbers(head, values[:, i], second if i > 2 else first, 14))
    return columns


def sag_table(case: CaseResult, units: ReportUnits) -> str:
    """Print the spans that bend most away from the chord of their ends."""
    if not case.linear or not (case.system.kind == STRAIGHT).any():
        return ""
    found = extreme_deflections(case)
    order = np.argsort(-found.sag, kind="stable")[:SAGS]
    order = order[found.sag[order] > 1e-9 * largest(found.sag)]
    parts = [case.system.parts[i] for i in found.element[order].tolist()]
    d = units.movement.showing(largest(found.sag))
    columns = [
        words("ELEMENT", [f"{p.start}-{p.end}" for p in parts]),
        numbers("SAG", found.sag[order], d, 14),
        plain("AT FRACTION", found.fraction[order], 4, 14),
        *(numbers(f"D{'XYZ'[i]}", found.deflection[order, i], d, 14) for i in range(3)),
    ]
    note = f"from the chord of an element's ends; the {SAGS} deepest"
    return section(f"{case.name}: DEFLECTION BETWEEN ENDS", note) + table(columns)
