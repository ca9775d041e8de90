"""What git asks of a diff driver: the differences of two versions of a file, or a text to compare.

Git keeps versions in folders of their own.  A driver is told the path in the work tree, too, and
decks find their includes from there, as they are now; a text conversion is not, and gives what
is no whole deck as it stands.
"""

from collections.abc import Sequence
from difflib import unified_diff
from pathlib import Path
from typing import TYPE_CHECKING

from trunnion.compare.decks import canonical, diff_decks
from trunnion.deck.reader import read_text
from trunnion.errors import DeckError, ModelError

if TYPE_CHECKING:
    from trunnion.compare.change import Change
    from trunnion.model import Model

NOTHING = "/dev/null"  # stands for the version that is not there
UNREADABLE = (DeckError, ModelError)


def textconv(deck: Path) -> str:
    """Give a deck as the program writes it; what cannot be read as one deck as it stands.

    An error would end the whole `git diff`.
    """
    try:
        return canonical(_model(deck, deck)).rstrip("\n")
    except UNREADABLE as error:
        return f"! as it stands, {_first(error, deck)}\n{_text(deck)}".rstrip("\n")


def driver(files: Sequence[Path], tolerance: float | None) -> list[str]:
    """Give the lines for git.

    Parameters
    ----------
    files : path, old file, hash, mode, new file, hash, mode and, where the file was renamed, the
        new path and what git says of it; the path alone where a merge is not done.
    """
    path, *rest = files
    renamed = files[7] if len(files) == 9 else path
    title = f"trunnion diff {path}" + (f" -> {renamed}" if renamed != path else "")
    if not rest:
        return [title, "  not merged"]
    old, new = files[1], files[4]
    for version, said in ((old, "new file"), (new, "deleted file")):
        if str(version) == NOTHING:
            return [title, f"  {said}"]
    try:
        return [title, *(f"  {change}" for change in _changes(old, path, new, renamed, tolerance))]
    except UNREADABLE as error:
        lines = unified_diff(_text(old).splitlines(), _text(new).splitlines(), n=0, lineterm="")
        said = f"  line by line, {_first(error, old, new)}"
        return [title, said, *(f"  {line}" for line in list(lines)[2:])]


def _changes(
    old: Path, path: Path, new: Path, renamed: Path, tolerance: float | None
) -> "list[Change]":
    if path.suffix.lower() == ".json" and renamed.suffix.lower() == ".json":
        from trunnion.compare.results import diff_reports

        return diff_reports(old, new, tolerance)
    return diff_decks(_model(old, path), _model(new, renamed), tolerance or 0.0)


def _model(version: Path, path: Path) -> "Model":
    """Read a version of the file at `path`."""
    from trunnion.formats import is_foreign, read_any

    if is_foreign(path):
        return read_any(version).model
    return read_text(_text(version), str(path))


def _text(version: Path) -> str:
    return version.read_bytes().decode(errors="replace")


def _first(error: Exception, *versions: Path) -> str:
    """The first line of an error, without the folders that git keeps versions in."""
    text = str(error).splitlines()[0]
    for version in versions:
        text = text.replace(str(version), version.name)
    return text
