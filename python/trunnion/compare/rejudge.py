"""Stored numbers judged again: structure and loads from the deck, every number from the file.

The certificate of a solved case is computed from the numbers read; so are those of the steps of a
cycle and of both loads together of a NONLINEAR increment, which is formed again from them, as a
combination is from its cases.  What else the file says (supports' sums, local forces, stresses,
balance, ranges, the envelope) is written again from these numbers and must be the same to the
last digit.  The next correction of the iteration, which only a solver knows, is taken from the
file.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from trunnion.arrays import CaseResult, FrozenBreak, HangerChoice
from trunnion.compare.claims import false_claim, false_members
from trunnion.compare.judgement import Verdict, has_numbers, judged, start_of
from trunnion.compare.stored import SHAPE
from trunnion.compare.written import changed
from trunnion.model import Case, Comb, Model
from trunnion.results.combine import combine, parents
from trunnion.watch import Watch

if TYPE_CHECKING:
    from trunnion.cases.analysis import Run

Stored = Mapping[str, Any]


def rejudge(report: Stored, model: Model, watch: Watch | None = None) -> list[Verdict]:
    """Judge every case, cycle and table of a stored result; `model` is that of its deck."""
    from trunnion.cases.analysis import Run
    from trunnion.cases.casetext import in_order
    from trunnion.cases.default_cases import with_cases

    given = model
    choices: tuple[HangerChoice, ...] = ()
    if any(s.design is not None for s in model.supports):
        from trunnion.cases.hangers import designed

        model, choices = designed(model)
    whole = with_cases(model)
    names = [case.name for case in whole.cases]
    if list(report["cases"]) != names:
        said = f"the deck has {' '.join(names)}, the file {' '.join(report['cases'])}"
        return [Verdict("cases", False, said)]
    if watch is not None:
        watch.turn("judging")
    run = Run(whole, {}, watch=watch)
    cases = in_order(whole.cases)
    found: dict[str, Verdict] = {}
    for case in cases:
        if isinstance(case, Case) and not case.spectrum:
            found[case.name] = _guarded(run, case, report["cases"][case.name])
    behind: list[Verdict] = []
    spectra = [case for case in cases if isinstance(case, Case) and case.spectrum]
    if whole.modal is not None or spectra:
        from trunnion.compare.rejudge_modes import judge_dynamics

        modes, answers = judge_dynamics(run, report, spectra)
        found |= answers
        behind.append(modes)
    for case in cases:
        if isinstance(case, Comb):
            found[case.name] = _guarded(run, case, report["cases"][case.name])
    if whole.cycles:
        from trunnion.compare.rejudge_cycles import judge_cycle

        behind = [judge_cycle(run, c, report) for c in whole.cycles] + behind
    claims = [Verdict(name, False, said) for name, said in false_members(report, given)]
    return [found[name] for name in names] + behind + _tables(run, report, choices) + claims


def _guarded(run: "Run", case: Case | Comb, stored: Stored) -> Verdict:
    """Judge one case; a file whose tables do not fit the deck fails."""
    run.ledger.watch.begin(case.name)
    if not stored["converged"]:
        run.found[case.name] = _nothing(run, case)
        if "nodes" in stored:
            return Verdict(case.name, False, "it is not converged, but has numbers")
        return Verdict(case.name, None, f"no numbers: {stored.get('cause')}")
    missing = [name for name in _parents(case) if not has_numbers(run, name)]
    if missing:
        return Verdict(case.name, None, f"it stands on {' '.join(missing)}, not judged")
    try:
        if isinstance(case, Comb):
            return _comb(run, case, stored)
        return _nonlinear(run, case, stored) if case.nonlinear else _case(run, case, stored)
    except SHAPE as error:
        return Verdict(case.name, False, f"its tables do not fit the deck: {error!r}")


def _nothing(run: "Run", case: Case | Comb) -> CaseResult:
    """A case without numbers, as the cases that stand on it find it."""
    return CaseResult(case.name, "case", "", run.system, None, None, False, cause="no numbers")


def _parents(case: Case | Comb) -> list[str]:
    if isinstance(case, Comb):
        return list(dict.fromkeys(parents(case.expression)))
    return [name for name in (case.about, case.on, case.start) if name]


def _case(run: "Run", case: Case, stored: Stored) -> Verdict:
    """Compute the certificate of a solved case, free or on the frozen contacts of another."""
    name = case.about or case.on
    breaks: tuple[FrozenBreak, ...] = ()
    if name:
        from trunnion.cases.occasional import LockedPass
        from trunnion.solver.answer import at_rest

        locked, about = LockedPass(run), run.found[name]
        structure, keep = locked.structure(
            about, snubbers=case.about is not None, which=locked.hot(case)
        )
        it = judged(structure, locked.question(case, structure), at_rest(structure), stored)
        breaks = locked.breaks(about, keep, case, it.result)
    else:
        structure = run.structure(case)
        question = run.question_on(case, structure.system)
        origin = run.ended[case.start] if case.start else None
        it = judged(structure, *start_of(run, case, structure, question, origin), stored)
        run.ended[case.name] = it.end
    it.result.frozen_check = breaks
    run.found[case.name] = it.result
    fault = it.fault or changed(it.result, stored)
    return Verdict(case.name, not fault, fault or it.text)


def _nonlinear(run: "Run", case: Case, stored: Stored) -> Verdict:
    """Judge both loads together, and form the increment again."""
    from trunnion.cases.occasional import LockedPass

    about = run.found[case.about or ""]
    if "total" not in stored:
        return Verdict(case.name, None, "the file has no total of both loads: run the deck again")
    locked = LockedPass(run)
    structure, question, start = locked.together(case, about)
    it = judged(structure, question, start, stored["total"])
    result = locked.increment(case, about, it.result, start)
    run.found[case.name] = result
    fault = it.fault or changed(result, stored) or changed(it.result, stored["total"], STATE)
    fault = fault or false_claim(result.certificate, stored)
    return Verdict(case.name, not fault, fault or f"both loads together: {it.text}")


STATE = ("nodes_low", "supports", "elements")  # of states inside; their nodes lack bends' middles


def _comb(run: "Run", case: Comb, stored: Stored) -> Verdict:
    """Form a combination again from its cases."""
    result = combine(case, run.found)
    run.found[case.name] = result
    fault = changed(result, stored) or false_claim(result.certificate, stored)
    return Verdict(case.name, not fault, fault or "the same from its cases")


def _tables(run: "Run", report: Stored, choices: tuple[HangerChoice, ...]) -> list[Verdict]:
    """Judge what stands beside the cases: the envelope, hangers that were selected, winds."""
    import json

    from trunnion.arrays import Results
    from trunnion.compare.written import first
    from trunnion.report.hangers import selection_entries
    from trunnion.report.json_runs import envelope_entries
    from trunnion.report.json_winds import wind_entries

    again: dict[str, str] = {}
    verdicts = []
    missing = [name for name in report["cases"] if name not in run.found]
    if missing:
        verdicts.append(Verdict("envelope", None, f"it holds {' '.join(missing)}, not judged"))
    else:
        ordered = {name: run.found[name] for name in report["cases"]}
        again["envelope"] = envelope_entries(Results("", ordered, base=run.system))
    if choices:
        again["hangers"] = selection_entries(choices)
    if run.model.winds:
        again["winds"] = wind_entries(run.model, run.system)
    if report.get("spread"):
        said = "the file has their ranges, not their numbers: search again to confirm them"
        verdicts.append(Verdict("spread", None, said))
    for name, text in again.items():
        place = first(json.loads(text), report.get(name), name)
        fault = f"{place} is not what the other numbers give" if place else ""
        verdicts.append(Verdict(name, not fault, fault or "the same from its numbers"))
    return verdicts
