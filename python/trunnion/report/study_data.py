"""A study for programs: JSON and CSV, in SI, support forces on the pipe."""

from collections.abc import Iterator

import numpy as np

from trunnion.arrays import I4
from trunnion.many.study import Study
from trunnion.origin import Origin
from trunnion.report.csv import csv_bytes
from trunnion.report.encode import dump, finite, lines, listing, records, rows, words
from trunnion.report.origin import origin_entry
from trunnion.report.sheets import Cell
from trunnion.results.supports import STATES, card_ids

COMPONENTS = ("FX", "FY", "FZ", "MX", "MY", "MZ")


def study_json(study: Study, origin: Origin | None = None) -> bytes:
    """Write the whole file: axes, variants with states and certificates, envelopes.

    origin : the foreign file that the model came from, and what of it is not in the numbers.
    """
    axes = (
        dump({"name": a.name, "values": list(a.values), "texts": list(a.texts)}) for a in study.axes
    )
    parts = {
        "schema": "1",
        "title": dump(study.title),
        "axes": listing(axes),
        "cases": dump(list(study.cases)),
        "variants": listing(_variants(study)),
        "envelope": lines({name: _envelope(study, name) for name in study.cases}),
        "work": dump(study.work),
    }
    if origin is not None:
        parts["origin"] = origin_entry(origin)
    return (lines(parts) + "\n").encode()


def _variants(study: Study) -> Iterator[str]:
    a, count = study.answers, study.answers.count
    for i, name in enumerate(study.names):
        cases = {
            case: {
                "converged": a.cause[i][j] is None,
                "cause": a.cause[i][j],
                "certificate": {"worst": finite(float(a.worst[i, j])), "where": a.where[i][j]},
                "states": {w: int(n) for w, n in zip(STATES, count[i, j], strict=True) if n},
            }
            for j, case in enumerate(study.cases)
        }
        values = study.values[i].tolist()
        yield dump({"variant": i + 1, "name": name, "values": values, "cases": cases})


def _envelope(study: Study, name: str) -> str:
    found = study.envelope(name)
    if found is None:
        return "[]"
    extremes, good = found
    cards, states = study.system.cards, study.states(name)

    def variants(which: I4) -> list[str]:
        chosen = np.where(which < 0, 0, good[which] + 1)
        return [dump([v or None for v in row]) for row in chosen.tolist()]

    return listing(
        records(
            {
                "id": words(card_ids(cards)),
                "name": words(card.name for card in cards),
                "states": [
                    dump({w: n for w, n in zip(STATES, row, strict=True) if n})
                    for row in states.tolist()
                ],
                "max": rows(extremes.highest),
                "max_variant": variants(extremes.highest_case),
                "min": rows(extremes.lowest),
                "min_variant": variants(extremes.lowest_case),
            }
        )
    )


def envelope_csv(study: Study) -> bytes:
    """Write one row a case, support and component; loads on the pipe in N and N m."""
    head = ["case", "support", "name", "component", "unit", "max", "max_variant", "min"]
    rows: list[list[Cell]] = [[*head, "min_variant", "max_values", "min_values"]]
    ids = card_ids(study.system.cards)
    for name in study.cases:
        found = study.envelope(name)
        if found is None:
            continue
        e, good = found
        for i, card in enumerate(study.system.cards):
            for k, component in enumerate(COMPONENTS):
                ends = [
                    ("", "") if which < 0 else (int(good[which]) + 1, study.names[good[which]])
                    for which in (e.highest_case[i, k], e.lowest_case[i, k])
                ]
                rows.append(
                    [
                        name, ids[i], card.name, component, "N" if k < 3 else "N m",
                        float(e.highest[i, k]) + 0.0, ends[0][0],
                        float(e.lowest[i, k]) + 0.0, ends[1][0], ends[0][1], ends[1][1],
                    ]
                )  # fmt: skip
    return csv_bytes(rows)


def variants_csv(study: Study) -> bytes:
    """Write one row a variant and case: values in SI, states, certificate, cause."""
    names = [axis.name for axis in study.axes]
    rows: list[list[Cell]] = [
        ["variant", *names, "case", "converged", "certificate", *STATES, "cause"]
    ]
    a, count = study.answers, study.answers.count
    for i in range(len(study.names)):
        for j, name in enumerate(study.cases):
            good = a.cause[i][j] is None
            worst = float(a.worst[i, j]) if good else ""
            row = [i + 1, *study.values[i].tolist(), name, int(good), worst, *count[i, j].tolist()]
            rows.append([*row, a.cause[i][j] or ""])
    return csv_bytes(rows)
