"""One line a case: converged, certified, largest movement and largest restraint load."""

import numpy as np

from trunnion.arrays import CaseResult, Results
from trunnion.frozen import frozen
from trunnion.report.columns import Column, table, words
from trunnion.report.units import ReportUnits
from trunnion.results.interior import mid_points
from trunnion.results.supports import card_forces, is_good, solved


def summary_table(results: Results, units: ReportUnits, *, only: list[str] | None = None) -> str:
    """Print the cases, or those in `only`."""
    cases = [c for c in results.cases.values() if only is None or c.name in only]
    if not cases:
        return "  no cases\n"
    move, where, force, restraint = zip(*(_extremes(c, units) for c in cases), strict=True)
    worst = [f"{c.certificate.worst:.1e}" if c.certificate else "-" for c in cases]
    return table(
        [
            words("CASE", [c.name for c in cases], least=10, most=16),
            words("STATUS", ["certified" if is_good(c) else "NOT CONVERGED" for c in cases]),
            Column("WORST", "", "%9s", 9, worst),
            Column("LARGEST MOVE", f"[{units.movement.unit}]", "%14s", 14, move),
            words("  AT", where, most=14),
            Column("LARGEST LOAD", f"[{units.force.unit}]", "%14s", 14, force),
            words("  ON RESTRAINT", restraint),
        ]
    )


@frozen
class Largest:
    """Largest movement [m] and restraint load [N] of a case, and where; NaN where none is."""

    move: float = float("nan")
    node: str | None = None
    load: float = float("nan")
    support: str | None = None


def largest_of(case: CaseResult) -> Largest:
    """Find the largest movement and restraint load of a certified case."""
    move, label = _farthest(case)
    if not case.system.cards:
        return Largest(move, label)
    load = np.linalg.norm(card_forces(case)[:, :3], axis=1)
    card = int(load.argmax())
    return Largest(move, label, float(load[card]), case.system.cards[card].name)


def _farthest(case: CaseResult) -> tuple[float, str]:
    """Largest movement of nodes and of bends' middles [m], and where."""
    u, labels = solved(case).u[:, :3], case.system.labels
    middle = mid_points(case)
    if middle is not None:
        u, labels = np.vstack((u, middle.displacement[:, :3])), (*labels, *case.system.mid)
    size = np.linalg.norm(u, axis=1)
    most = int(size.argmax())
    return float(size[most]), labels[most]


def _extremes(case: CaseResult, units: ReportUnits) -> tuple[str, str, str, str]:
    """Largest movement with its node, largest restraint force with its support."""
    if not is_good(case):
        return "-", "", "-", ""
    most = largest_of(case)
    move = units.movement.showing(most.move).text(most.move)
    if most.support is None:
        return move, f"  {most.node}", "-", ""
    load = units.force.showing(most.load).text(most.load)
    return move, f"  {most.node}", load, f"  {most.support}"
