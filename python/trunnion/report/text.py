"""The text report `.out`: input, summary, restraints, the answers of every case, their proof."""

from trunnion.arrays import CaseResult, Results
from trunnion.cases.default_cases import with_cases
from trunnion.model import Case, Model
from trunnion.report.answers import displacement_table, element_tables
from trunnion.report.causes import told_cause
from trunnion.report.columns import PAGE, chapter, section, wrapped
from trunnion.report.dynamics import modes_text
from trunnion.report.echo import input_echo
from trunnion.report.frozen import frozen_table, frozen_warning
from trunnion.report.hangers import selection_table, table_source
from trunnion.report.loops import cycle_report, cycle_warnings
from trunnion.report.modes import mode_report, mode_warnings
from trunnion.report.origin import origin_text
from trunnion.report.points import middle_table, sag_table, stress_table
from trunnion.report.proof import balance_table, certificate_table, history_table, ledger_table
from trunnion.report.restraints import restraint_summary
from trunnion.report.states import state_table
from trunnion.report.summary import summary_table
from trunnion.report.units import ReportUnits, report_units
from trunnion.results.supports import is_good

CERTIFIED = (
    "Every case shows its certificate, computed from the reported numbers alone: every item is at "
    "most 1e-9, forces relative to the largest support force or non-thermal load, moments to the "
    "largest moment, lengths to the largest displacement, deformations to the largest deformation."
)


def text_report(results: Results, model: Model) -> bytes:
    """Write the whole report."""
    units = report_units(model.units)
    good = [case for case in results.cases.values() if is_good(case)]
    own = [case for case in with_cases(model).cases if isinstance(case, Case)]
    parts = ["TRUNNION   static analysis of piping with nonlinear supports\n"]
    parts.append(f"{results.title or '(no title)'}\n")
    parts.append(origin_text(model.origin))
    parts.append(chapter("1  SUMMARY"))
    parts.append(summary_table(results, units))
    bad = [case for case in results.cases.values() if not is_good(case)]
    parts += [wrapped(f"{case.name}: {told_cause(case, units)}") for case in bad]
    parts.append(warnings(results, units))
    parts.append(chapter("2  INPUT"))
    sums = {name: case.text for name, case in results.cases.items()}
    parts.append(input_echo(model, results.system, sums, units))
    parts.append(chapter("3  LOADS ON RESTRAINTS"))
    names = {c.name for c in own if c.about}
    increments = [case.name for case in good if case.name in names]
    if results.hangers:
        parts.append(selection_table(results.hangers, table_source(model), units))
    parts.append(restraint_summary(good, units, increments))
    parts.append(chapter("4  RESULTS BY CASE"))
    parts.append(wrapped(CERTIFIED, "") if results.cases else "\n  none\n")
    locked = {c.name for c in own if is_locked(c)}
    parts += [_case(case, units, case.name in locked) for case in results.cases.values()]
    more: dict[str, list[str]] = {}
    if results.modes is not None:
        asked = f"\n  {modes_text(model.modal)}\n" if model.modal else ""
        more["MODES"] = [asked, mode_report(results.modes, results.system, units)]
    if results.cycles:
        more["CYCLES"] = [cycle_report(cycle, units) for cycle in results.cycles.values()]
    if results.spreads:
        from trunnion.report.spread import spread_report

        more["OTHER ANSWERS"] = [spread_report(s, results, units) for s in results.spreads.values()]
    for number, (title, texts) in enumerate(more.items(), 5):
        parts += [chapter(f"{number}  {title}"), *texts]
    parts.append(chapter(f"{5 + len(more)}  WORK"))
    work = {name: case.work for name, case in results.cases.items()}
    parts.append(ledger_table(work | {"whole run": results.work}))
    parts.append(f"\n{'END OF REPORT':^{PAGE}}".rstrip() + "\n")
    return "".join(parts).encode(errors="replace")


def is_locked(case: Case) -> bool:
    """Tell whether a case stands on the frozen contact state of another."""
    return bool(case.about or case.on) and not case.nonlinear


def _case(case: CaseResult, units: ReportUnits, locked: bool) -> str:
    title = f"{case.name} = {case.text}"
    text = f"\n\n{title}\n{'=' * len(title)}\n"
    if not is_good(case):
        text += wrapped(f"NOT CONVERGED, no numbers: {told_cause(case, units)}")
        return text + certificate_table(case) + history_table(case)
    return text + "".join(
        (
            frozen_table(case, units) if locked else "",
            displacement_table(case, units),
            state_table(case, units),
            element_tables(case, units),
            middle_table(case, units),
            sag_table(case, units),
            stress_table(case, units),
            balance_table(case, units),
            certificate_table(case),
            history_table(case),
        )
    )


def warnings(results: Results, units: ReportUnits) -> str:
    """Print the warnings of the run and of every case."""
    text = section("WARNINGS")
    lines = [*results.warnings]
    for case in results.cases.values():
        lines += [f"{case.name}: {line}" for line in case.warnings]
        lines += frozen_warning(case, units)
    lines += mode_warnings(results) + cycle_warnings(results, units)
    return text + ("".join(wrapped(line) for line in lines) or "  none\n")
