"""Other answers in the JSON report; SI, largest less smallest."""

from trunnion.arrays import Results, Spread, Spreading
from trunnion.report.encode import dump, finite, lines, listing, records, rows, words
from trunnion.results.supports import STATES, card_ids, card_levels
from trunnion.results.tables import element_ids


def spread_entries(results: Results) -> str:
    """Write what was found of every case."""
    return lines({name: _case(spread) for name, spread in results.spreads.items()})


def _case(spread: Spread) -> str:
    parts = {
        "unique": dump(spread.unique),
        "cause": dump(spread.cause),
        "starts": _spreading(spread.starts),
        "orders": "null" if spread.orders is None else _spreading(spread.orders),
    }
    return lines(parts)


def _spreading(s: Spreading) -> str:
    tried = (
        dump(
            {
                "tried": t.what,
                "answer": None if t.answer is None else t.answer + 1,
                "cause": t.cause,
            }
        )
        for t in s.tried
    )
    parts = {"tried": listing(tried), "answers": listing(dump(a) for a in _answers(s))}
    if s.supports is not None and s.elements is not None and s.moves is not None:
        system = s.answers[0].system
        supports = {
            "id": words(card_ids(system.cards)),
            "name": words(card.name for card in system.cards),
            "spread": rows(s.supports),
        }
        elements = {
            "id": words(element_ids(system.parts)),
            "spread_from": rows(s.elements[:, 0]),
            "spread_to": rows(s.elements[:, 1]),
        }
        parts["supports"] = listing(records(supports))
        parts["elements"] = listing(records(elements))
        parts["nodes"] = lines(dict(zip(system.labels, rows(s.moves), strict=True)))
    return lines(parts)


def _answers(s: Spreading) -> list[dict[str, object]]:
    return [
        {
            "answer": i + 1,
            "found": sum(t.answer == i for t in s.tried),
            "certificate": finite(a.certificate.worst) if a.certificate else None,
            "states": [STATES[level] for level in card_levels(a)],
        }
        for i, a in enumerate(s.answers)
    ]
