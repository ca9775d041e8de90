"""What an importer gives back: the model, and comments on its records."""

from collections.abc import Mapping

from trunnion.frozen import frozen
from trunnion.model import Model
from trunnion.origin import Assumption, LeftOut, Origin


@frozen(eq=False)
class Note:
    """What came from where: a comment for the deck, above the card of `record`.

    `record` is a material, section, pipe, bend, support ... of the model, the very object.
    """

    record: object
    text: str


@frozen(eq=False)
class Imported:
    """A model made of a foreign file; `model.origin` says what is missing in it.

    `header` holds comment lines for the top of a deck: titles, units, what the file says.
    """

    model: Model
    notes: tuple[Note, ...] = ()
    header: tuple[str, ...] = ()

    @property
    def origin(self) -> Origin:
        """File, format, what was left out, what was assumed."""
        origin = self.model.origin
        assert origin is not None
        return origin

    @property
    def left_out(self) -> tuple[LeftOut, ...]:
        """What the model does not have of the file."""
        return self.origin.left_out

    @property
    def assumed(self) -> tuple[Assumption, ...]:
        """What was chosen where the file is silent."""
        return self.origin.assumed

    def deck(self) -> str:
        """Write the deck, with comments that say what came from where.

        Raises
        ------
        ModelError : the model holds something that no card can say.
        """
        from trunnion.deck.writer import write

        return write(self.model, comments=self._comments(), header=self._top())

    def _comments(self) -> Mapping[int, list[str]]:
        """Comments by the identity of their record."""
        found: dict[int, list[str]] = {}
        for note in self.notes:
            found.setdefault(id(note.record), []).append(note.text)
        return found

    def _top(self) -> list[str]:
        """Lines of the top: source, header, what was left out, what was assumed."""
        origin = self.origin
        lines = [f"Made from {origin.file}: {origin.format}", *self.header]
        if origin.left_out:
            lines += ["", "LEFT OUT, not in this deck:", *(f"- {x}" for x in origin.left_out)]
        if origin.assumed:
            lines += ["", "ASSUMED:", *(f"- {x}" for x in origin.assumed)]
        return lines
