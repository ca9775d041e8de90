"""The tables that spreadsheets and other tools get: the same for the workbook and for CSV.

Numbers are in the deck's units with all their digits; `decimals` says how many a reader needs.
A case that is not certified has its line in the summary and no numbers.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from trunnion.arrays import F8, Results
from trunnion.frozen import frozen
from trunnion.model import Model
from trunnion.report.units import Quantity

Cell = str | float | int | None

DIRECTIONS = ("X", "Y", "Z")
LOADS = ("FX", "FY", "FZ", "MX", "MY", "MZ")
MOVES = ("DX", "DY", "DZ", "RX", "RY", "RZ")
LOCAL = ("AXIAL", "SHEAR y", "SHEAR z", "TORSION", "BENDING y", "BENDING z")


@frozen(eq=False)
class Column:
    """One column: words if `decimals` is None, else numbers; `exponent`: 1.2E-15."""

    head: str
    cells: Sequence[Cell]
    unit: str = ""
    decimals: int | None = None
    exponent: bool = False


@frozen(eq=False)
class Sheet:
    """One table.

    name : of the file and of the sheet, a word.
    keys : columns at the left that stay in view.
    groups : rows with the same first cell belong together.
    """

    name: str
    title: str
    note: str
    columns: Sequence[Column]
    keys: int = 1
    groups: bool = False

    def __len__(self) -> int:
        return len(self.columns[0].cells)


def amounts(head: str, values: ArrayLike, quantity: Quantity) -> Column:
    """Give numbers [SI] in the unit of a quantity; NaN, a number that was not given, is empty."""
    shown = np.asarray(values, np.float64) * quantity.factor + 0.0  # no -0
    cells: Sequence[Cell] = shown.tolist()
    if not np.isfinite(shown).all():
        cells = [x if np.isfinite(x) else None for x in shown.tolist()]
    return Column(head, cells, quantity.unit, quantity.decimals)


def six(heads: Sequence[str], values: F8, first: Quantity, second: Quantity) -> list[Column]:
    """Give (n, 6) numbers: three of one quantity and three of another, each to 5 digits."""
    both = [
        quantity.showing(float(np.abs(np.nan_to_num(half)).max(initial=0.0)))
        for quantity, half in ((first, values[:, :3]), (second, values[:, 3:]))
    ]
    return [amounts(head, values[:, i], both[i // 3]) for i, head in enumerate(heads)]


def all_sheets(results: Results, model: Model) -> list[Sheet]:
    """Give every table that has something to say; the summary is the first."""
    from trunnion.report.sheet_answers import displacements, forces, modes, stresses
    from trunnion.report.sheet_restraints import envelope, hangers, restraints
    from trunnion.report.sheet_summary import certificates, summary, warnings
    from trunnion.report.units import report_units
    from trunnion.results.supports import is_good

    units = report_units(model.units)
    good = [case for case in results.cases.values() if is_good(case)]
    found: list[Sheet] = [summary(results, units)]
    if good:
        found += [restraints(good, units), envelope(good, units), hangers(good, units)]
        found += [displacements(good, units), forces(good, units), stresses(good, units)]
    if results.modes is not None:
        found.append(modes(results.modes))
    if results.cycles:
        from trunnion.report.sheet_loops import cycle_forces, cycles

        loops = list(results.cycles.values())
        found += [cycles(loops, units), cycle_forces(loops, units)]
    if results.spreads:
        from trunnion.report.sheet_spread import spread_forces, spread_loads, spread_tries

        others = list(results.spreads.values())
        found += [make(others, units) for make in (spread_tries, spread_loads, spread_forces)]
    found += [certificates(results), warnings(results, model, units)]
    return [sheet for sheet in found if len(sheet) or sheet.name in ("summary", "warnings")]
