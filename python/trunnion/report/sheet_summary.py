"""Tables of cases: summary, certificates, warnings."""

import numpy as np

from trunnion.arrays import CaseResult, Results
from trunnion.model import Model
from trunnion.origin import origin_lines
from trunnion.report.causes import told_cause
from trunnion.report.counts import counted
from trunnion.report.screen import all_warnings
from trunnion.report.sheets import Cell, Column, Sheet, amounts
from trunnion.report.summary import Largest, largest_of
from trunnion.report.units import ReportUnits
from trunnion.results.stresses import end_stresses
from trunnion.results.supports import is_good


def summary(results: Results, units: ReportUnits) -> Sheet:
    """One row a case: converged, certified, and its largest numbers."""
    cases = list(results.cases.values())
    good = [is_good(case) for case in cases]
    most = [largest_of(c) if fine else Largest() for c, fine in zip(cases, good, strict=True)]
    peaks = [_peak(c) if fine else (np.nan, None) for c, fine in zip(cases, good, strict=True)]
    worst = [None if c.certificate is None else _finite(c.certificate.worst) for c in cases]
    moves, loads = np.array([m.move for m in most]), np.array([m.load for m in most])
    columns = [
        Column("CASE", [case.name for case in cases]),
        Column("LOADS", [case.text for case in cases]),
        Column("STATUS", ["certified" if fine else "NOT CONVERGED" for fine in good]),
        Column("WORST ITEM", worst, "", 1, exponent=True),
        amounts("LARGEST MOVE", moves, units.movement.showing(_most(moves))),
        Column("AT NODE", [m.node for m in most]),
        amounts("LARGEST LOAD", loads, units.force.showing(_most(loads))),
        Column("ON RESTRAINT", [m.support for m in most]),
        amounts("VON MISES", [value for value, _ in peaks], units.stress),
        Column("AT END", [at for _, at in peaks]),
    ]
    if not all(good):
        causes = [None if f else told_cause(c, units) for c, f in zip(cases, good, strict=True)]
        columns.append(Column("CAUSE", causes))
    counts = "no cases"
    if cases or results.base is not None:
        system = results.system
        counts = (
            f"{counted(len(system.labels), 'node')}, {counted(len(system.parts), 'element')}, "
            f"{counted(len(system.cards), 'restraint')}; every certificate item is at most 1e-9"
        )
    return Sheet("summary", "Summary of cases", counts, columns)


def _most(values: np.ndarray) -> float:
    return float(np.nan_to_num(values).max(initial=0.0))


def _finite(value: float) -> float | None:
    return value if np.isfinite(value) else None


def _peak(case: CaseResult) -> tuple[float, str | None]:
    """Highest von Mises stress [Pa] and the end where it is."""
    element, first, second = end_stresses(case)
    if not element.size:
        return float("nan"), None
    ends = np.column_stack([first.von_mises, second.von_mises])
    row, end = divmod(int(ends.argmax()), 2)
    part = case.system.parts[int(element[row])]
    return float(ends[row, end]), f"{(part.start, part.end)[end]} of {part.start}-{part.end}"


def certificates(results: Results) -> Sheet:
    """One row an item of each case's certificate."""
    rows: list[tuple[Cell, ...]] = []
    for case in results.cases.values():
        found = case.certificate
        if found is None:
            continue
        verdict = "passed" if found.passed else "FAILED"
        verdict += ", inherited" if found.inherited else ""
        rows += [(case.name, verdict, i.name, _finite(i.value), i.where) for i in found.items]
        if not found.items:
            rows.append((case.name, verdict, "worst", _finite(found.worst), found.where))
    cells = list(zip(*rows, strict=True)) or [()] * 5
    return Sheet(
        "certificate",
        "Certificates",
        "each item is relative to a stated quantity and at most 1e-9",
        [
            Column("CASE", cells[0]),
            Column("VERDICT", cells[1]),
            Column("ITEM", cells[2]),
            Column("VALUE", cells[3], "", 1, exponent=True),
            Column("WORST AT", cells[4]),
        ],
        groups=True,
    )


def warnings(results: Results, model: Model, units: ReportUnits) -> Sheet:
    """Everything that a reader must know, one row a warning; first what a file left out."""
    cases = results.cases.values()
    texts = [] if model.origin is None else origin_lines(model.origin)
    texts += [f"{case.name}: {told_cause(case, units)}" for case in cases if not is_good(case)]
    texts += all_warnings(results, units)
    return Sheet(
        "warnings",
        "Warnings",
        f"{len(texts)} in all" if texts else "none",
        [Column("NO.", range(1, len(texts) + 1), "", 0), Column("WARNING", texts)],
    )
