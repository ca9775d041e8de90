"""A stored cycle judged again: every step from where the last one left the supports."""

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from trunnion.arrays import CaseResult, CycleResult, Results
from trunnion.cases.cycles import REPEATED, change_between, set_ranges
from trunnion.compare.judgement import Verdict, judged, start_of
from trunnion.compare.stored import SHAPE
from trunnion.compare.written import differing
from trunnion.model import Case, Cycle
from trunnion.report.counts import counted
from trunnion.solver.steps import Origin

if TYPE_CHECKING:
    from trunnion.cases.analysis import Run

STEP = ("nodes", "nodes_low", "supports", "elements")
WHOLE = ("cases", "loops", "repeats", "change", "steps", "supports", "elements")


def judge_cycle(run: "Run", cycle: Cycle, report: Mapping[str, Any]) -> Verdict:
    """Certify every step, then form the ranges of the last loop again."""
    name = f"CYCLE {cycle.name}"
    run.ledger.watch.begin(name)
    try:
        stored = report["cycles"][cycle.name]
        if stored["cause"]:
            return Verdict(name, None, f"not followed to its end: {stored['cause']}")
        if "states" not in stored:
            return Verdict(name, None, "the file has no states of its steps: run the deck again")
        names = [name for name in (*cycle.cases, cycle.start) if name]
        missing = [name for name in names if name not in run.found]
        if missing:
            return Verdict(name, None, f"it stands on {' '.join(missing)}, not judged")
        return _judge(run, cycle, name, stored)
    except SHAPE as error:
        return Verdict(name, False, f"its tables do not fit the deck: {error!r}")


def _judge(run: "Run", cycle: Cycle, name: str, stored: Mapping[str, Any]) -> Verdict:
    from trunnion.report.json import state_entry
    from trunnion.report.json_runs import cycle_entries

    result = CycleResult(cycle.name, cycle.cases, 0, False, np.inf)
    origin = run.ended[cycle.start] if cycle.start else None
    worst = 0.0
    for i, step in enumerate(stored["states"]):
        word = stored["steps"][i]
        found, origin, fault = _step(run, cycle.cases[i % len(cycle.cases)], origin, step)
        fault = fault or differing(json.loads(state_entry(found)), step, STEP)
        if fault:
            return Verdict(name, False, f"step {word}: {fault}")
        assert found.certificate is not None
        worst = max(worst, found.certificate.worst)
        result.path.append(found)
    n = len(cycle.cases)
    result.loops = len(result.path) // n
    last, before = result.path[-n:], result.path[-2 * n : -n]
    if before:
        result.change = change_between(before, last)
        result.repeats = result.change <= REPEATED
    set_ranges(run, cycle, last, result)
    whole = Results("", {}, cycles={cycle.name: result})
    again = json.loads(cycle_entries(whole, state_entry))[cycle.name]
    fault = differing(again, stored, WHOLE)
    text = f"{counted(len(result.path), 'step')}, worst {worst:.1e}; ranges the same from them"
    return Verdict(name, not fault, fault or text)


def _step(
    run: "Run", name: str, origin: Origin | None, stored: Mapping[str, Any]
) -> tuple[CaseResult, Origin, str]:
    """Judge one step: its answer, where it ends, what is wrong."""
    case = next(c for c in run.model.cases if isinstance(c, Case) and c.name == name)
    structure = run.structure(case)
    question, start = start_of(
        run, case, structure, run.question_on(case, structure.system), origin
    )
    it = judged(structure, question, start, stored)
    return it.result, it.end, it.fault
