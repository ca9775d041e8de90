"""What a batch remembers of a finished deck: a small file beside the reports, written with them.

A deck is finished when the record says so of the same content of deck and includes, the same
version and settings, and when the reports are still what they were.
"""

import hashlib
import json
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from trunnion.frozen import frozen

if TYPE_CHECKING:
    from trunnion.formats.options import Options

FOLDER = ".trunnion-batch"
SCHEMA = 3
CERTIFIED, FAILED, BAD_DECK, INTERNAL = "certified", "failed", "bad deck", "internal error"
CODES = {CERTIFIED: 0, FAILED: 1, BAD_DECK: 2, INTERNAL: 3}


@frozen
class CaseLine:
    """One case of a deck in the summary; `worst` is None without a certificate."""

    name: str
    kind: str
    converged: bool
    worst: float | None
    cause: str | None


@frozen
class Entry:
    """One deck of a batch.

    status : certified, failed (a case), bad deck (nothing written) or internal error.
    causes : of what is not certified, a sentence each.
    left_out : of a foreign file and not in the model, a sentence each.
    files : names of the reports; of those in a folder of their own with that folder.
    skipped, notes : taken from the record of an earlier run; what happened on the way.  They are
        of one run, so the summary file has neither.
    """

    stem: str
    deck: str
    status: str
    cases: tuple[CaseLine, ...] = ()
    warnings: int = 0
    causes: tuple[str, ...] = ()
    files: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()
    skipped: bool = False
    notes: tuple[str, ...] = ()

    @property
    def code(self) -> int:
        """Exit code of this deck alone."""
        return CODES[self.status]


def summary_of(entry: Entry) -> dict[str, object]:
    """Give what does not depend on how this run went."""
    values = asdict(entry)
    del values["skipped"], values["notes"]
    return values


def settings_of(
    *, also: Sequence[str] = (), permissive: bool = False, options: "Options | None" = None
) -> dict[str, object]:
    """Everything but the deck on which the reports depend, as JSON gives it back."""
    own: dict[str, object] = {"schema": SCHEMA, "version": version("trunnion")}
    own |= {"also": sorted(also), "permissive": permissive}
    if options is not None:
        table = None if options.table is None else str(options.table)
        own |= {"table": table, "tolerance": options.tolerance, "anchors": list(options.anchors)}
    return own


def digest(content: bytes) -> str:
    """Fingerprint of a file's content."""
    return hashlib.sha256(content).hexdigest()


def fingerprints(sources: Iterable[str], deck: Path) -> dict[str, str]:
    """Fingerprints of a deck and its includes; names count from the deck's folder."""
    return {
        os.path.relpath(source, deck.parent): digest(Path(source).read_bytes())
        for source in sources
    }


def record_path(folder: Path, stem: str) -> Path:
    """Where the record of a deck is."""
    return folder / FOLDER / f"{stem}.json"


def record(
    entry: Entry,
    sources: Mapping[str, str],
    settings: Mapping[str, object],
    reports: Mapping[str, bytes],
) -> bytes:
    """Write the record of a finished deck; reports are named from the folder they go to."""
    return json.dumps(
        {
            "settings": dict(settings),
            "sources": dict(sources),
            "reports": {name: digest(content) for name, content in reports.items()},
            "entry": summary_of(entry),
        },
        indent=1,
    ).encode()


def finished(folder: Path, deck: Path, settings: Mapping[str, object]) -> Entry | None:
    """Give the entry of a deck that needs no work; None if anything differs or is missing."""
    try:
        found = json.loads(record_path(folder, deck.stem).read_bytes())
        sources = {deck.parent / name: mark for name, mark in found["sources"].items()}
        reports = {folder / name: mark for name, mark in found["reports"].items()}
        if found["settings"] != dict(settings) or deck not in sources:
            return None
        return _entry(found["entry"]) if _unchanged(sources | reports) else None
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None


def _unchanged(marks: Mapping[Path, str]) -> bool:
    return all(digest(path.read_bytes()) == mark for path, mark in marks.items())


def _entry(data: Mapping[str, Any]) -> Entry:
    return Entry(
        **{
            **data,
            "cases": tuple(CaseLine(**line) for line in data["cases"]),
            "causes": tuple(data["causes"]),
            "files": tuple(data["files"]),
            "left_out": tuple(data["left_out"]),
            "skipped": True,
        }
    )
