"""The summary on the terminal: what a screen holds, the bad cases first."""

from trunnion.arrays import Results
from trunnion.model import Model
from trunnion.report.frozen import frozen_warning
from trunnion.report.loops import cycle_lines, cycle_warnings
from trunnion.report.modes import mode_lines, mode_warnings
from trunnion.report.origin import origin_lines
from trunnion.report.summary import summary_table
from trunnion.report.units import ReportUnits, report_units
from trunnion.results.supports import cause_of, is_good

CASES, CAUSES, WARNINGS, LEFT_OUT = 10, 4, 4, 8  # lines of each


def screen(results: Results, model: Model) -> tuple[bool, str]:
    """Tell whether every case is certified, and the text to print."""
    cases, units = results.cases, report_units(model.units)
    bad = [name for name, case in cases.items() if not is_good(case)]
    shown = (bad + [name for name in cases if name not in bad])[:CASES]
    lines = [results.title] if results.title else []
    if model.origin is not None:
        lines += _some(origin_lines(model.origin), LEFT_OUT)
    lines.append(summary_table(results, units, only=shown).rstrip("\n"))
    if len(cases) > len(shown):
        lines.append(f"  ... and {len(cases) - len(shown)} more cases in the report")
    lines += mode_lines(results) + cycle_lines(results)
    if results.spreads:
        from trunnion.report.spread import spread_lines

        lines += spread_lines(results, units)
    lines += _some([f"{name}: {cause_of(cases[name])}" for name in bad], CAUSES)
    lines += _some([f"warning: {text}" for text in all_warnings(results, units)], WARNINGS)
    broken = [name for name, cycle in results.cycles.items() if cycle.cause]
    return not bad and not broken, "\n".join(lines)


def all_warnings(results: Results, units: ReportUnits) -> list[str]:
    """Every warning of a run and of its cases, modes and cycles."""
    warnings = list(results.warnings)
    cases = results.cases.values()
    warnings += [f"{case.name}: {text}" for case in cases for text in case.warnings]
    warnings += [text for case in cases for text in frozen_warning(case, units)]
    return warnings + mode_warnings(results) + cycle_warnings(results)


def _some(texts: list[str], most: int) -> list[str]:
    """Keep the first of many messages and count the others."""
    more = [f"  ... and {len(texts) - most} more"] if len(texts) > most else []
    return [f"  {text}" for text in texts[:most]] + more
