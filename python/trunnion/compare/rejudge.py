"""Stored numbers judged again: structure and loads from the deck, every number from the file.

The certificate of a solved case is computed from the numbers read; a combination is formed again
from its cases.  What else the file says of a case (supports' sums, local forces, stresses, balance)
is written again from these numbers and must be the same to the last digit.  The next correction of
the iteration, which only a solver knows, is taken from the file.
"""

import json
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from trunnion.arrays import (
    BOTH,
    ENGAGED,
    I4,
    OPEN,
    SLIP,
    STICK,
    CaseResult,
    Results,
    State,
    System,
)
from trunnion.certificate import certify
from trunnion.frozen import frozen
from trunnion.model import Case, Comb, Model
from trunnion.results.combine import combine, parents

if TYPE_CHECKING:
    from trunnion.cases.analysis import Run

MODES = {"open": OPEN, "engaged": ENGAGED, "stick": STICK, "slip": SLIP}
WRITTEN = ("loads", "reactions", "nodes", "nodes_low", "supports", "elements", "stresses")


@frozen
class Verdict:
    """One case: `passed` is None where stored numbers alone cannot be judged; `text` says why."""

    case: str
    passed: bool | None
    text: str


def rejudge(report: Mapping[str, Any], model: Model) -> list[Verdict]:
    """Judge every case of a stored result; `model` is that of its deck."""
    from trunnion.cases.analysis import Run
    from trunnion.cases.casetext import in_order
    from trunnion.cases.default_cases import with_cases

    if any(s.design is not None for s in model.supports):
        from trunnion.cases.hangers import designed

        model = designed(model)[0]
    whole = with_cases(model)
    names = [case.name for case in whole.cases]
    if list(report["cases"]) != names:
        said = f"the deck has {' '.join(names)}, the file {' '.join(report['cases'])}"
        return [Verdict("cases", False, said)]
    run = Run(whole, {})
    verdicts: dict[str, Verdict] = {}
    for case in in_order(whole.cases):
        verdicts[case.name] = _guarded(run, case, report["cases"][case.name])
    return [verdicts[name] for name in names]


def _guarded(run: "Run", case: Case | Comb, stored: Mapping[str, Any]) -> Verdict:
    """Judge one case; a file whose tables do not fit the deck fails."""
    if not stored["converged"]:
        return Verdict(case.name, None, f"no numbers: {stored.get('cause')}")
    if isinstance(case, Case) and (case.spectrum or case.nonlinear):
        what = "a spectrum" if case.spectrum else "a difference of two answers"
        return Verdict(case.name, None, f"{what}: run the deck again to confirm it")
    missing = [name for name in _parents(case) if name not in run.found]
    if missing:
        return Verdict(case.name, None, f"it stands on {' '.join(missing)}, not judged")
    try:
        return _comb(run, case, stored) if isinstance(case, Comb) else _case(run, case, stored)
    except (KeyError, IndexError, TypeError, ValueError, AttributeError) as error:
        return Verdict(case.name, False, f"its tables do not fit the deck: {error!r}")


def _parents(case: Case | Comb) -> list[str]:
    if isinstance(case, Comb):
        return list(dict.fromkeys(parents(case.expression)))
    return [name for name in (case.about, case.on) if name]


def _case(run: "Run", case: Case, stored: Mapping[str, Any]) -> Verdict:
    """Compute the certificate of a solved case."""
    if case.about or case.on:
        from trunnion.cases.occasional import LockedPass

        locked = LockedPass(run)
        about = run.found[case.about or case.on or ""]
        structure, _ = locked.structure(
            about, snubbers=case.about is not None, which=locked.hot(case)
        )
    else:
        structure = run.structure(case)
    system = structure.system
    loads = run.question_on(case, system).loads
    if case.start and case.snubbers == "LOCKED" and len(run.system.snubbers.k):
        return Verdict(case.name, None, "snubbers locked from another case: run the deck again")
    state = stored_state(stored, system)
    claimed = stored["certificate"]
    found = certify(
        system,
        loads,
        state,
        correction_u=_number(claimed["correction_u"]),
        correction_r=_number(claimed["correction_r"]),
    )
    result = CaseResult(
        case.name, "case", stored["text"], system, loads, state, True, certificate=found
    )
    run.found[case.name] = result
    text = f"worst {found.worst:.1e}, {found.where}"
    if not found.passed:
        return Verdict(case.name, False, text)
    changed = _changed(result, stored)
    return Verdict(case.name, not changed, changed or text)


def _comb(run: "Run", case: Comb, stored: Mapping[str, Any]) -> Verdict:
    """Form a combination again from its cases."""
    result = combine(case, run.found)
    run.found[case.name] = result
    changed = _changed(result, stored)
    return Verdict(case.name, not changed, changed or "the same from its cases")


def _changed(result: CaseResult, stored: Mapping[str, Any]) -> str:
    """Say what the file holds that these numbers do not give; nothing if all is the same."""
    from trunnion.report.json import json_report

    again = json.loads(json_report(Results("", {result.name: result})))["cases"][result.name]
    for table in WRITTEN:
        place = _first(again.get(table), stored.get(table), table)
        if place:
            return f"{place} is not what the other numbers give"
    return ""


def _first(a: Any, b: Any, place: str) -> str:
    """Name the first place at which two values of JSON differ."""
    if a == b:
        return ""
    if isinstance(a, dict) and isinstance(b, dict):
        pairs: Iterator[tuple[object, Any, Any]] = (
            (key, a.get(key), b.get(key)) for key in dict.fromkeys([*a, *b])
        )
    elif isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        ids = [x.get("id", i) if isinstance(x, dict) else i for i, x in enumerate(a)]
        pairs = zip(ids, a, b, strict=True)
    else:
        return place
    found = (_first(x, y, f"{place} {key}") for key, x, y in pairs)
    return next((said for said in found if said), place)


def _number(value: float | None) -> float:
    return np.inf if value is None else float(value)


def stored_state(case: Mapping[str, Any], system: System) -> State:
    """Read the numbers of a case back; `system` is that of the case.

    Raises
    ------
    KeyError, IndexError, TypeError, ValueError : the tables are not those of this system.
    """
    zero = [0.0] * 6
    low = case.get("nodes_low", {})
    contacts = [c for s in case["supports"] for c in s["contacts"]]
    sliders = [(s["contacts"][x["contacts"][0]], x) for s in case["supports"] for x in s["sliders"]]
    # the file has them by card, the system in its own order
    contacts = _ordered(contacts, system.contacts.card)
    sliders = _ordered(sliders, system.sliders.card)
    side = [BOTH if c["side"] == 0 and c["state"] != "open" else c["side"] for c in contacts]
    ends = [[e["force_from"], e["force_to"]] for e in case["elements"]]
    if len(ends) != len(system.parts):
        raise ValueError(f"{len(ends)} elements, the deck has {len(system.parts)}")
    return State(
        u=np.array([case["nodes"][label] for label in system.labels], np.float64),
        u_low=np.array([low.get(label, zero) for label in system.labels], np.float64),
        end_force=np.array(ends, np.float64).reshape(-1, 2, 6),
        side=np.array(side, np.int32),
        reaction=_rows([c["vector"] for c in contacts]),
        friction=_rows([c["friction"] for c, _ in sliders]),
        mode=np.array([MODES[x["state"]] for _, x in sliders], np.int32),
        normal=np.array([c["normal"] for c, _ in sliders], np.float64),
        slide=_rows([c["slide"] for c, _ in sliders]),
        datum=_rows([x["datum"] for _, x in sliders]),
        datum_end=_rows([x["datum_end"] for _, x in sliders]),
    )


def _rows(rows: list[Any]) -> np.ndarray:
    return np.array(rows, np.float64).reshape(-1, 3)


def _ordered(entries: list[Any], card: I4) -> list[Any]:
    """Put entries that stand by card into the order of the system."""
    order = np.argsort(card, kind="stable")
    if len(entries) != len(order):
        raise ValueError(f"{len(entries)} contacts or sliders, the deck has {len(order)}")
    placed: list[Any] = [None] * len(entries)
    for entry, i in zip(entries, order.tolist(), strict=True):
        placed[i] = entry
    return placed
