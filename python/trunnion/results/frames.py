"""All tables of a run as pandas frames, the cases below each other."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from trunnion.arrays import Results
from trunnion.results import tables
from trunnion.results.supports import cause_of, is_good
from trunnion.results.tables import Table, pandas_module

if TYPE_CHECKING:
    from pandas import DataFrame

BY_CASE: Mapping[str, Callable[..., Table]] = {
    "displacements": tables.displacements,
    "supports": tables.supports,
    "elements": tables.elements,
    "stresses": tables.stresses,
}
BY_CYCLE: Mapping[str, Callable[..., Table]] = {
    "cycle_supports": tables.support_ranges,
    "cycle_elements": tables.element_ranges,
}


def frames(results: Results) -> "dict[str, DataFrame]":
    """Give every table by its name; SI, on the pipe.

    `cases` has a row a case, certified or not, with the cause; `displacements`, `supports`,
    `elements` and `stresses` have the certified ones, `cycle_supports` and `cycle_elements` the
    cycles, with the index (case, label); `envelope` and `modes` have their own labels.  Tables
    without rows are not there.  `attrs["units"]` has the unit of each column of numbers.

    Raises
    ------
    ImportError : pandas is not installed (extra pandas).
    """
    good = {name: case for name, case in results.cases.items() if is_good(case)}
    loops = {name: c for name, c in results.cycles.items() if c.supports is not None}
    found = {"cases": _cases(results)}
    for name, make in BY_CASE.items():
        found[name] = _below({key: make(case) for key, case in good.items()}, "case")
    if good:
        found["envelope"] = results.envelope.to_pandas()
    if results.modes is not None:
        found["modes"] = results.modes.table.to_pandas()
    for name, make in BY_CYCLE.items():
        found[name] = _below({key: make(cycle) for key, cycle in loops.items()}, "cycle")
    return {name: frame for name, frame in found.items() if len(frame)}


def _cases(results: Results) -> "DataFrame":
    """One row a case: what it is, whether it is certified, the worst item, or the cause."""
    rows = [
        {
            "text": case.text,
            "kind": case.kind,
            "certified": is_good(case),
            "worst": case.certificate.worst if case.certificate else float("nan"),
            "where": case.certificate.where if case.certificate else None,
            "cause": None if is_good(case) else cause_of(case),
        }
        for case in results.cases.values()
    ]
    pandas = pandas_module()
    frame: DataFrame = pandas.DataFrame(rows, index=pandas.Index(results.cases, name="case"))
    frame.attrs["units"] = {"worst": ""}
    return frame


def _below(found: Mapping[str, Table], name: str) -> "DataFrame":
    """Put tables of the same columns below each other; their key leads the index."""
    pandas = pandas_module()
    if not found:
        return pandas.DataFrame()
    parts = {key: table.to_pandas() for key, table in found.items()}
    units = next(iter(parts.values())).attrs["units"]
    for part in parts.values():
        part.attrs = {}  # concat would compare them
    frame: DataFrame = pandas.concat(parts, names=[name])
    frame.attrs["units"] = units
    return frame
