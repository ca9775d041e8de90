"""What an importer finds while it reads: problems, omissions, assumptions, comments."""

from pathlib import Path

from trunnion.errors import DeckError, Problem
from trunnion.formats.imported import Imported, Note
from trunnion.formats.options import NONE, Options
from trunnion.formats.source import Source
from trunnion.model import Model, Place
from trunnion.origin import Assumption, LeftOut, Origin, telling

MOST = 10_000  # problems, omissions, assumptions or comments of each kind that are kept


class Findings:
    """Collects everything that an import has to say; raises all problems at once.

    Parameters
    ----------
    permissive : what cannot be represented is listed and left out, else it is a problem.
    options : what the user says beside the file.
    """

    def __init__(
        self, source: Source, *, permissive: bool = False, options: Options = NONE
    ) -> None:
        self.source = source
        self.options = options
        self.permissive = permissive
        self.problems: list[Problem] = []
        self.left_out: list[LeftOut] = []
        self.assumed: list[Assumption] = []
        self.notes: list[Note] = []
        self._passable = 0  # problems that --permissive would go past
        self._said: set[str] = set()
        self._noted: dict[int, list[int]] = {}  # identity of a record -> its notes

    def place(self, line: int) -> Place:
        """Place of a line of the file (from 1), for records of the model."""
        return Place(self.source.file, line)

    def fault(self, line: int, text: str, columns: tuple[int, int] | None = None) -> None:
        """Note an error; `columns` (first, last+1, from 0) are underlined in the line."""
        if len(self.problems) < MOST:
            marker = self.source.marker(line, columns) if line else ""
            self.problems.append(
                Problem(self.place(line) if line else self.source.file, text, marker)
            )

    def leave_out(self, line: int, element: str, feature: str, *, vital: bool = False) -> None:
        """Note something that a model cannot represent: an error unless permissive.

        Parameters
        ----------
        element : "element 30-40", "node 50".
        feature : what it is, and what the model does instead: "expansion joint; taken as pipe".
        vital : unless permissive, nothing after it means anything: `halt` raises.
        """
        if not self.permissive:
            self._passable += not vital and len(self.problems) < MOST
            self.fault(line, f"{element}: {feature}; --permissive goes on without it")
        elif len(self.left_out) < MOST:
            self.left_out.append(LeftOut(element, feature, self._where(line)))

    def assume(self, text: str, line: int = 0) -> None:
        """Note a choice where the file is silent; the same text is kept once."""
        if len(self.assumed) < MOST and text not in self._said:
            self._said.add(text)
            self.assumed.append(Assumption(text, self._where(line) if line else ""))

    def note(self, record: object, text: str) -> None:
        """Put a comment above the card of a record of the model."""
        self._noted.setdefault(id(record), []).append(len(self.notes))
        self.notes.append(Note(record, text))

    def renote(self, old: object, new: object) -> None:
        """Move the comments of a record to the one that takes its place."""
        for k in self._noted.pop(id(old), ()):
            self.notes[k] = Note(new, self.notes[k].text)
            self._noted.setdefault(id(new), []).append(k)

    @property
    def broken(self) -> bool:
        """Tell whether there is a problem past which the file cannot be read."""
        return len(self.problems) > self._passable

    def stop(self) -> None:
        """Raise all problems, if there are any, with what was left out before."""
        if self.problems:
            origin = Origin(Path(self.source.file).name, "", tuple(self.left_out))
            with telling(origin if self.left_out else None):
                raise DeckError(sorted(self.problems, key=_line))

    def finish(self, model: Model, name: str, header: tuple[str, ...] = ()) -> Imported:
        """Give the result, or raise all problems.

        Parameters
        ----------
        name : the format and its version: "CAESAR II neutral file, version 11.0".
        """
        self.stop()
        file = Path(self.source.file).name
        model.origin = Origin(file, name, tuple(self.left_out), tuple(self.assumed))
        with telling(model.origin):
            model.check()
        return Imported(model, tuple(self.notes), header)

    def _where(self, line: int) -> str:
        """File without its folder, and line: reports hold nothing of the machine."""
        return f"{Path(self.source.file).name}:{line}"


def _line(problem: Problem) -> int:
    return getattr(problem.place, "line", 0)
