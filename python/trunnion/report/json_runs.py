"""What the JSON report says about all cases together: the envelope of supports, the cycles."""

from collections.abc import Callable

import numpy as np

from trunnion.arrays import F8, CaseResult, CycleResult, FrozenBreak, Results
from trunnion.report.encode import dump, finite, lines, listing, records, rows, words
from trunnion.report.frozen import si_unit
from trunnion.report.loops import step_names
from trunnion.results.supports import card_forces, card_ids, envelope, is_good, range_ratio
from trunnion.results.tables import element_ids


def frozen_entries(case: CaseResult) -> str:
    """List what breaks the frozen contact state of a locked case."""
    ids = card_ids(case.system.cards) if case.frozen_check else ()

    def entry(found: FrozenBreak) -> str:
        return dump(
            {
                "id": ids[found.card],
                "name": case.system.cards[found.card].name,
                "dir": found.word,
                "what": found.what,
                "amount": found.amount,
                "unit": si_unit(found),
            }
        )

    return listing(entry(found) for found in case.frozen_check)


def envelope_entries(results: Results) -> str:
    """Write the largest and smallest load of every support and the cases they come from."""
    cases = [case for case in results.cases.values() if is_good(case)]
    cards = results.system.cards
    if not cases:
        return "[]"
    found = envelope(cases)
    names = np.array([*words(case.name for case in cases), "null"])  # -1: no case

    def of(which: np.ndarray) -> list[str]:
        return [f"[{','.join(row)}]" for row in names[which].tolist()]

    return listing(
        records(
            {
                "id": words(card_ids(cards)),
                "name": words(card.name for card in cards),
                "max": rows(found.highest),
                "max_case": of(found.highest_case),
                "min": rows(found.lowest),
                "min_case": of(found.lowest_case),
            }
        )
    )


def cycle_entries(results: Results, state_entry: Callable[[CaseResult], str]) -> str:
    """Write every cycle; `state_entry` writes the numbers of one step."""
    return lines({name: _cycle(cycle, state_entry) for name, cycle in results.cycles.items()})


def _cycle(cycle: CycleResult, state_entry: Callable[[CaseResult], str]) -> str:
    parts = {
        "cases": dump(list(cycle.cases)),
        "cause": dump(cycle.cause),
        "loops": dump(cycle.loops),
        "repeats": dump(cycle.repeats),
        "change": dump(finite(cycle.change)),
        "steps": dump(step_names(cycle)),
    }
    if cycle.supports is None or cycle.elements is None:
        return lines(parts)
    system = cycle.path[0].system
    force = np.stack([card_forces(step) for step in cycle.path], axis=1)
    supports = {
        "id": words(card_ids(system.cards)),
        "name": words(card.name for card in system.cards),
        **_ranges(cycle.supports, cycle.one_shot_supports, ""),
        "path": [f"[{','.join(rows(steps))}]" for steps in force],
    }
    elements = {"id": words(element_ids(system.parts))}
    for i, end in enumerate(("_from", "_to")):
        alone = None if cycle.one_shot_elements is None else cycle.one_shot_elements[:, i]
        elements |= _ranges(cycle.elements[:, i], alone, end)
    parts["supports"] = listing(records(supports))
    parts["elements"] = listing(records(elements))
    parts["states"] = listing(state_entry(step) for step in cycle.path)
    return lines(parts)


def _ranges(loop: F8, alone: F8 | None, end: str) -> dict[str, list[str]]:
    """Ranges over the loop and in one shot and their ratio; null where there is none."""
    if alone is None:
        nothing = ["null"] * len(loop)
        return {f"range{end}": rows(loop), f"one_shot{end}": nothing, f"ratio{end}": nothing}
    ratio = [dump([finite(x) for x in row]) for row in range_ratio(loop, alone).tolist()]
    return {f"range{end}": rows(loop), f"one_shot{end}": rows(alone), f"ratio{end}": ratio}
