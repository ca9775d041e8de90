"""A record: one card or one call of the Python API, with its values in SI."""

from dataclasses import dataclass, field
from typing import Any

from trunnion.frozen import frozen
from trunnion.model import Direction, Place


@dataclass(slots=True)
class Record:
    """What the deck and the Python API both produce; the interpreter makes the Model of it.

    args : positionals, upper case.
    keys : values in SI (temperatures in C): float, str, int or tuple by the kind of key;
        positionals that are numbers, and flags, stand here too.
    words : directions of a SUPPORT, each with its keys.
    items : names of a list, on GROUP and CYCLE.
    expression : of CASE and COMB, parsed.
    """

    keyword: str
    place: Place
    args: list[str] = field(default_factory=list)
    keys: dict[str, Any] = field(default_factory=dict)
    words: tuple[Direction, ...] = ()
    items: list[str] = field(default_factory=list)
    expression: Any = None

    @property
    def head(self) -> str:
        """Keyword and name or labels, for errors."""
        return " ".join([self.keyword, *self.args])


# What an error points at: index of a word of the card, its text, or "KEY="
Mark = int | str | tuple[int, int] | None


@frozen
class Fault:
    """One fault before its place on the card is looked up."""

    place: Place
    head: str
    message: str
    mark: Mark = None

    @property
    def text(self) -> str:
        """Card and message, as errors show them."""
        return f"{self.head}: {self.message}" if self.head else self.message
