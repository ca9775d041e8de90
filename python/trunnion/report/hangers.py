"""The selection of program-designed hangers, in text and JSON."""

import numpy as np

from trunnion.arrays import HangerChoice
from trunnion.model import Model
from trunnion.report.columns import integers, numbers, plain, section, table, words, wrapped
from trunnion.report.encode import dump, lines
from trunnion.report.units import ReportUnits

KINDS = {"spring": "spring", "rod": "rigid rod", "constant": "constant", "none": "none"}


def table_source(model: Model) -> str:
    """Say where the springs of a model's hangers come from."""
    if model.spring_sizes:
        return "SPRINGSIZE cards"
    said = {"GENERIC": "generic table, no maker's: see SPRINGSIZE"}
    tables = sorted({s.design.table for s in model.supports if s.design is not None})
    return "; ".join(said.get(name, f"{name} table of the library") for name in tables)


def selection_table(choices: tuple[HangerChoice, ...], source: str, units: ReportUnits) -> str:
    """Print hanger, size, cold and hot load, rate, travel and variation."""
    columns = [
        words("NODE", [c.node for c in choices]),
        words("NAME", [c.name for c in choices]),
        words("TYPE", [KINDS[c.kind] for c in choices]),
        words("SIZE", [c.size for c in choices], least=10),
        integers("NUMBER", [c.number for c in choices]),
        numbers("COLD LOAD", [c.cold for c in choices], units.force, 12),
        numbers("HOT LOAD", [c.hot for c in choices], units.force, 12),
        numbers("RATE", [c.rate for c in choices], units.stiffness, 12),
        numbers("TRAVEL", [c.travel for c in choices], units.movement, 10),
        plain("VARIATION", [100.0 * c.variation for c in choices], 1, 11, "[%]"),
    ]
    text = section("HANGER SELECTION", source) + table(columns)
    text += wrapped(
        "Loads and rate of all springs of a hanger together. Travel is upwards from the cold to "
        "the operating position, variation rate x travel / hot load."
    )
    said = [f"{c.node}: {KINDS[c.kind]}: {c.reason}" for c in choices if c.reason]
    return text + "".join(wrapped(line) for line in said)


def selection_entries(choices: tuple[HangerChoice, ...]) -> str:
    """Write one object a hanger, by its node and number; SI."""
    rows: dict[str, str] = {}
    for i, c in enumerate(choices):
        rows[f"{c.node}" if f"{c.node}" not in rows else f"{c.node}#{i + 1}"] = dump(
            {
                "name": c.name,
                "type": c.kind,
                "series": c.series,
                "size": c.size,
                "number": c.number,
                "cold_load": c.cold,
                "hot_load": c.hot,
                "rate": c.rate,
                "travel": c.travel,
                "variation": c.variation if np.isfinite(c.variation) else None,
                "reason": c.reason,
            }
        )
    return lines(rows)
