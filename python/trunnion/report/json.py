"""The JSON report: SI, support forces on the pipe, element forces on the element.

Every number is written with all its digits (stresses with 9), one node, support or element a
line; the same results give the same bytes.
"""

from collections.abc import Mapping

import numpy as np

from trunnion.arrays import F8, CaseResult, Certificate, Results, System
from trunnion.model import Model
from trunnion.report.encode import dump, finite, lines, listing, records, rows, short, words
from trunnion.report.hangers import selection_entries
from trunnion.report.json_modes import mode_entries
from trunnion.report.json_runs import cycle_entries, envelope_entries, frozen_entries
from trunnion.report.json_supports import support_entries
from trunnion.report.json_winds import wind_entries
from trunnion.report.manifest import manifest_entry
from trunnion.report.origin import origin_entry
from trunnion.results.balance import load_sum, local_end_forces, reaction_sum
from trunnion.results.interior import mid_of_bend
from trunnion.results.stresses import end_stresses
from trunnion.results.supports import cause_of, is_good, solved
from trunnion.results.tables import element_ids

STRESSES = (
    "axial", "pressure", "bending", "shear", "torsion", "longitudinal", "hoop_inner",
    "principal_max", "principal_min", "von_mises",
)  # fmt: skip


def json_report(results: Results, model: Model | None = None) -> bytes:
    """Write the whole file: schema, cases, warnings, work; with its model the winds, too."""
    parts = {
        "schema": "1",
        "title": dump(results.title),
        **({} if model is None or model.file is None else {"manifest": manifest_entry(model)}),
        **({} if model is None or model.origin is None else {"origin": origin_entry(model.origin)}),
        "cases": lines({name: _case(case) for name, case in results.cases.items()}),
        "envelope": envelope_entries(results),
    }
    if results.cycles:
        parts["cycles"] = cycle_entries(results, state_entry)
    if results.spreads:
        from trunnion.report.json_spread import spread_entries

        parts["spread"] = spread_entries(results)
    if model is not None and model.winds:
        parts["winds"] = wind_entries(model, results.system)
    if results.hangers:
        parts["hangers"] = selection_entries(results.hangers)
    parts["modes"] = dump({"frequency_hz": []})
    if results.modes is not None:
        parts["modes"] = mode_entries(results.modes, results.system)
    parts["warnings"] = dump(list(results.warnings))
    parts["work"] = dump(results.work)
    return (lines(parts) + "\n").encode()


def _case(case: CaseResult) -> str:
    good = is_good(case)
    parts = {
        "kind": dump(case.kind),
        "text": dump(case.text),
        "converged": dump(good),
        "cause": dump(None if good else cause_of(case)),
        "certificate": dump(_certificate(case.certificate)),
        "frozen": dump(list(case.frozen)),
        "frozen_check": frozen_entries(case),
        "warnings": dump(list(case.warnings)),
        "work": dump(case.work),
        "history": listing(dump(_finite(record)) for record in case.history),
    }
    return lines(parts | _numbers(case) if good else parts)


def _numbers(case: CaseResult) -> dict[str, str]:
    """Everything that only a certified case may show."""
    system, state = case.system, solved(case)
    effect = {name: finite(value) for name, value in case.penalty_effect.items()}
    parts = {"penalty_effect": dump(effect)}
    if case.digits is not None:
        parts["digits"] = dump({"left": round(case.digits[0], 1), "worst": case.digits[1]})
    if case.loads is not None and case.linear:
        parts["loads"] = _sum(load_sum(system, case.loads))
        parts["reactions"] = _sum(reaction_sum(case))
    parts["nodes"] = _by_node(system, state.u, mid_of_bend(case))
    if state.u_low.any():
        parts["nodes_low"] = _by_node(system, state.u_low, {})
    parts["supports"] = support_entries(case)
    parts["elements"] = _elements(case)
    parts["stresses"] = _stresses(case)
    if case.total is not None:
        parts["total"] = state_entry(case.total)
    return parts


def state_entry(case: CaseResult) -> str:
    """Write the numbers that a state stands on, and their certificate, without what follows."""
    state = solved(case)
    parts = {"name": dump(case.name), "certificate": dump(_certificate(case.certificate))}
    parts["nodes"] = _by_node(case.system, state.u, {})
    if state.u_low.any():
        parts["nodes_low"] = _by_node(case.system, state.u_low, {})
    parts["supports"], parts["elements"] = support_entries(case), _elements(case)
    return lines(parts | {"warnings": dump(list(case.warnings))})


def _finite(record: Mapping[str, object]) -> dict[str, object]:
    """Replace what a diverging iteration leaves in its history."""
    return {
        key: finite(value) if isinstance(value, float) else value for key, value in record.items()
    }


def _sum(total: F8) -> str:
    """Write a resultant; the moment is about the origin."""
    return dump({"force": total[:3].tolist(), "moment": total[3:].tolist()})


def _by_node(system: System, values: F8, middles: Mapping[str, F8]) -> str:
    """Write one line a node, then each further name of a node, then middles of bends."""
    pieces = rows(values)
    named = dict(zip(system.labels, pieces, strict=True))
    for label, node in system.alias.items():
        named.setdefault(label, pieces[node])
    named.update(zip(middles, rows(np.array(list(middles.values()))), strict=True))
    return lines(named)


def _elements(case: CaseResult) -> str:
    """Write one line an element; local axes have x along the pipe's tangent at that end."""
    parts, force = case.system.parts, solved(case).end_force
    local = local_end_forces(case)
    fields = {
        "id": words(element_ids(parts)),
        "from": words(part.start for part in parts),
        "to": words(part.end for part in parts),
        "type": words(part.type for part in parts),
        "force_from": rows(force[:, 0]),
        "force_to": rows(force[:, 1]),
        "local_from": rows(local[:, 0]),
        "local_to": rows(local[:, 1]),
    }
    return listing(records(fields))


def _stresses(case: CaseResult) -> str:
    """Write one line a pipe: each stress [Pa] at the two ends."""
    element, *ends = end_stresses(case)
    ids = element_ids(case.system.parts)
    fields = {"id": words(ids[i] for i in element.tolist())}
    for name in STRESSES:
        fields[name] = short(np.column_stack([getattr(end, name) for end in ends]))
    return listing(records(fields))


def _certificate(certificate: Certificate | None) -> Mapping[str, object] | None:
    if certificate is None:
        return None
    found: dict[str, object] = {
        "passed": certificate.passed,
        "worst": finite(certificate.worst),
        "where": certificate.where,
        "inherited": certificate.inherited,
    }
    for item in certificate.items:
        found.setdefault(item.name, finite(item.value))
    found["items"] = [
        {"name": item.name, "value": finite(item.value), "where": item.where}
        for item in certificate.items
    ]
    return found
