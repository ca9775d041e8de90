"""What records leave behind for the records that follow, and where their faults go."""

from dataclasses import dataclass, field
from typing import Any

from trunnion.deck.record import Fault, Mark, Record
from trunnion.model import Model, Operation, Uniform


@dataclass(slots=True)
class Carried:
    """What cards leave behind for the cards that follow."""

    section: str | None = None
    material: str | None = None
    operation: Operation = field(default_factory=Operation)
    uniform: tuple[Uniform, ...] = ()
    defaults: dict[str, Any] = field(default_factory=dict)
    displacements: dict[tuple[str, str], int] = field(default_factory=dict)
    broken: set[str] = field(default_factory=set)  # words of faulty cards: no further errors


class Context:
    """One model in the making; faults are collected, never raised."""

    def __init__(
        self, model: Model, carried: Carried, faults: list[Fault], whole: bool = True
    ) -> None:
        self.model = model
        self.carried = carried
        self.faults = faults
        self.whole = whole  # no card is missing because its file could not be read
        self.before = 0  # faults before the present record

    def keep(self, items: list[Any], item: Any) -> None:
        """Add an item to a list of the model when its record has no fault."""
        if len(self.faults) == self.before:
            items.append(item)

    def complain(self, record: Record, message: str, mark: Mark = None) -> None:
        """Note a fault of a record."""
        self.faults.append(Fault(record.place, record.head, message, mark))

    def miss(self, record: Record, message: str, mark: Mark = None) -> None:
        """Note that something is not defined, unless the card that does may be missing."""
        if self.whole:
            self.complain(record, message, mark)

    def give_up(self, record: Record) -> None:
        """Take note of a faulty record so that its names cause no further errors."""
        carried = self.carried
        carried.broken.update(record.args)
        carried.broken.update(record.keys)
        carried.broken.update(v for v in record.keys.values() if isinstance(v, str))
        if record.keyword in ("SPECTRUM", "GROUP", "MODES"):
            carried.broken.add(record.keyword)
        if record.keyword == "MATERIAL" and record.args:
            carried.material = record.args[0]
        if record.keyword == "SECTION" and record.args:
            carried.section = record.args[0]
