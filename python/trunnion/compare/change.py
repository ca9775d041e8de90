"""One difference between two decks or two results, and how they are put in order."""

from collections.abc import Iterable

from trunnion.frozen import frozen


@frozen
class Change:
    """What differs: where, which quantity, before and after; `weight` orders, largest first."""

    where: str
    what: str
    before: str
    after: str
    weight: float
    note: str = ""

    def __str__(self) -> str:
        note = f" ({self.note})" if self.note else ""
        return f"{self.where}: {self.what} {self.before} -> {self.after}{note}"


def by_importance(changes: Iterable[Change]) -> list[Change]:
    """Most important first; equals stay in the order of the files."""
    return sorted(changes, key=lambda change: -change.weight)
