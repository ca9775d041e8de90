"""Where a model came from that was no deck: what of the foreign file is not in it, and guesses.

The reports print this on top: a reader must see at once what the numbers do not contain.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from trunnion.errors import DeckError, ModelError, Problem
from trunnion.frozen import frozen

STRUCTURE = "structure"
WHOLE = (STRUCTURE, "cases", "model", "every variant")  # places that are no line of a deck


@frozen
class LeftOut:
    """Something of the file that the model does not have.

    `element` is the user's name of it ("element 30-40", "node 50"), `feature` what is missing
    there and what the model does instead, `where` the line of the file ("line.cii:210").
    """

    element: str
    feature: str
    where: str

    def __str__(self) -> str:
        return f"{self.element}: {self.feature} ({self.where})"


@frozen
class Assumption:
    """A choice made where the file is silent or ambiguous; it holds also without leaving out."""

    text: str
    where: str = ""

    def __str__(self) -> str:
        return f"{self.text} ({self.where})" if self.where else self.text


@frozen
class Origin:
    """The foreign file of a model: name without folder, format with version, what is missing."""

    file: str
    format: str  # "CAESAR II neutral file, version 11.0"
    left_out: tuple[LeftOut, ...] = ()
    assumed: tuple[Assumption, ...] = ()


def origin_lines(origin: Origin) -> list[str]:
    """Lines for the screen: source, then everything left out, then everything assumed."""
    lines = [f"from {origin.file}" + (f", {origin.format}" if origin.format else "")]
    lines += [f"LEFT OUT: {entry}" for entry in origin.left_out]
    lines += [f"assumed: {entry}" for entry in origin.assumed]
    return lines


@contextmanager
def telling(origin: Origin | None, deck: str = "") -> Iterator[None]:
    """Add what is missing in a model to the errors that it makes, as a note of the exception.

    A line that is cut at a gap moves freely: the mechanism alone would not say why.  Errors of
    the model as a whole, which have no line, get the name of the deck.
    """
    try:
        yield
    except (DeckError, ModelError) as error:
        told = type(error)(_named(error.problems, deck))
        for note in getattr(error, "__notes__", ()):
            told.add_note(note)
        if origin is not None:
            told.add_note("\n".join(origin_lines(origin)))
        raise told from error


def _named(problems: Sequence[Problem], deck: str) -> list[Problem]:
    """Put the name of a deck before what has no line of it; say a motion of one name once.

    Motions that differ only in the point that they turn about have the same name.
    """
    count = Counter(problem.text for problem in problems if problem.place == STRUCTURE)
    found = []
    for problem in problems:
        place, text = problem.place, problem.text
        if place == STRUCTURE:
            n = count.pop(text, 0)
            if not n:
                continue
            if n > 1:
                motion, colon, why = text.partition(": ")
                text = f"{motion} ({n} ways, about different points){colon}{why}"
        if deck and place in WHOLE:
            place = f"{deck}: {place}"
        found.append(Problem(place, text, problem.marker))
    return found


@frozen
class Beside:
    """What the user said beside a foreign file (`formats.options`).

    The side table by its name without folder and its SHA-256, tolerance [m], anchors as given.
    """

    table: str | None
    table_sha256: str | None
    tolerance: float | None
    anchors: tuple[str, ...]


@frozen
class InputFile:
    """The file a model was read from: name without folder, SHA-256 of it with its includes."""

    name: str
    sha256: str
    beside: Beside | None = None
