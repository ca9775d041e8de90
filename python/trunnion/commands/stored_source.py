"""The input file of a stored result: looked for by its name, known by its hash."""

import shlex
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from trunnion.commands.shared import InputError, read_model
from trunnion.errors import DeckError, ModelError
from trunnion.frozen import frozen

if TYPE_CHECKING:
    from trunnion.formats.options import Options
    from trunnion.model import Model

WANTED = ("deck", "sha256", "version", "settings")
LOOKED = "beside it, in the folder above, in this one or in models there"


@frozen
class Asked:
    """What the user said: the result, the deck if given, the command that was typed."""

    results: Path
    deck: Path | None
    options: "Options | None"
    command: str

    def again(self, option: str, name: str) -> str:
        """Give the command that says where a file is."""
        return f"{self.command} {option} PATH/{shlex.quote(name)}"


def read_source(report: Mapping[str, Any], asked: Asked) -> tuple[Path, "Model"]:
    """Read the input file that the manifest names; refuse any other.

    Raises
    ------
    InputError : no manifest, not found, or changed since.
    DeckError, ModelError : the only file of that name has errors.
    """
    manifest = _manifest(report, asked.results)
    name, settings = manifest["deck"], manifest["settings"]
    found = [asked.deck] if asked.deck is not None else places(asked.results.parent, name)
    if not found:
        said = f"{asked.results.name}: its deck {name} is not {LOOKED}; say where it is:"
        raise InputError(f"{said}\n  {asked.again('--deck', name)}")
    first: Exception | None = None
    for place in found:
        try:
            options = _options(manifest, asked, place)
            model = read_model(place, permissive=bool(settings.get("permissive")), options=options)
        except (DeckError, ModelError, InputError) as error:
            first = first or error
            continue
        own = "" if model.file is None else model.file.sha256
        if own == manifest["sha256"]:
            return place, model
        first = first or InputError(
            f"{place}: not the deck of {asked.results.name}, or changed since (with its "
            f"includes): {_differ(own, manifest['sha256'])}"
        )
    assert first is not None
    raise first


def places(home: Path, name: str) -> list[Path]:
    """Files of a name beside a result, in the folder above and the current one, in their models."""
    above = home.parent if home.name not in ("", "..") else home / ".."
    folders = (home, above, Path(), home / "models", above / "models", Path("models"))
    found: dict[Path, Path] = {}
    for place in (folder / name for folder in folders):
        if place.is_file():
            found.setdefault(place.resolve(), place)
    return list(found.values())


def _manifest(report: Mapping[str, Any], results: Path) -> Mapping[str, Any]:
    """Give the manifest; refuse one that the program did not write."""
    manifest = report.get("manifest")
    if not isinstance(manifest, dict) or any(key not in manifest for key in WANTED):
        raise InputError(f"{results.name}: no manifest; run its deck once with this version")
    options = manifest.get("options", {})
    fits = isinstance(manifest["settings"], dict) and isinstance(options, dict)
    names = [manifest["deck"], *([options["table"]] if fits and options.get("table") else [])]
    if not fits or not all(isinstance(x, str) and x and Path(x).name == x for x in names):
        raise InputError(f"{results.name}: the manifest is not one of trunnion run")
    return manifest


def _options(manifest: Mapping[str, Any], asked: Asked, deck: Path) -> "Options | None":
    """Side table, tolerance and anchors of the run; what the user gives again comes first."""
    stored = manifest.get("options")
    if not stored:
        return asked.options
    from trunnion.formats.options import NONE, Options

    given = asked.options or NONE
    tolerance, anchors = stored.get("tolerance"), stored.get("anchors") or []
    if not isinstance(tolerance, float | None) or not isinstance(anchors, list):
        raise InputError(f"{asked.results.name}: the manifest is not one of trunnion run")
    return Options(
        _table(stored, asked, deck) if stored.get("table") else given.table,
        tolerance if given.tolerance is None else given.tolerance,
        given.anchors or tuple(map(str, anchors)),
    )


def _table(stored: Mapping[str, Any], asked: Asked, deck: Path) -> Path:
    """Find the side table of the run as its deck is found, or beside the deck."""
    from hashlib import sha256

    name, wanted = str(stored["table"]), stored.get("table_sha256")
    if asked.options is not None and asked.options.table is not None:
        found = [asked.options.table]
    else:
        beside = [deck.parent / name] if (deck.parent / name).is_file() else []
        found = [*beside, *places(asked.results.parent, name)]
    if not found:
        said = f"{asked.results.name}: its side table {name} is not beside the deck; say where:"
        raise InputError(f"{said} {asked.again('--table', name)}")
    marks = []
    for table in found:
        try:
            marks.append(sha256(table.read_bytes()).hexdigest())
        except OSError as error:
            raise InputError(f"{table}: {error.strerror}") from None
        if marks[-1] == wanted:
            return table
    raise InputError(
        f"{found[0]}: the table changed since {asked.results.name} was written: "
        f"{_differ(marks[0], wanted)}"
    )


def _differ(own: str, wanted: object) -> str:
    return f"SHA-256 is {own[:12]}..., in the manifest {str(wanted)[:12]}..."
