"""The summary on the terminal: what a screen holds, the bad cases first."""

from trunnion.arrays import Results
from trunnion.model import Model
from trunnion.report.frozen import frozen_warning
from trunnion.report.loops import cycle_lines, cycle_warnings
from trunnion.report.modes import mode_lines, mode_warnings
from trunnion.report.spread import spread_lines
from trunnion.report.summary import summary_table
from trunnion.report.units import report_units
from trunnion.results.supports import cause_of, is_good

CASES, CAUSES, WARNINGS = 10, 4, 4  # lines of each


def screen(results: Results, model: Model) -> tuple[bool, str]:
    """Tell whether every case is certified, and the text to print."""
    cases, units = results.cases, report_units(model.units)
    bad = [name for name, case in cases.items() if not is_good(case)]
    shown = (bad + [name for name in cases if name not in bad])[:CASES]
    lines = [results.title] if results.title else []
    lines.append(summary_table(results, units, only=shown).rstrip("\n"))
    if len(cases) > len(shown):
        lines.append(f"  ... and {len(cases) - len(shown)} more cases in the report")
    lines += mode_lines(results) + cycle_lines(results) + spread_lines(results, units)
    lines += _some([f"{name}: {cause_of(cases[name])}" for name in bad], CAUSES)
    warnings = list(results.warnings)
    warnings += [f"{c.name}: {text}" for c in cases.values() for text in c.warnings]
    warnings += [text for case in cases.values() for text in frozen_warning(case, units)]
    warnings += mode_warnings(results) + cycle_warnings(results)
    lines += _some([f"warning: {text}" for text in warnings], WARNINGS)
    broken = [name for name, cycle in results.cycles.items() if cycle.cause]
    return not bad and not broken, "\n".join(lines)


def _some(texts: list[str], most: int) -> list[str]:
    """Keep the first of many messages and count the others."""
    more = [f"  ... and {len(texts) - most} more"] if len(texts) > most else []
    return [f"  {text}" for text in texts[:most]] + more
