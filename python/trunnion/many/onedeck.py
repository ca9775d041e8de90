"""One deck of a batch: read, solved, reported; every end of it becomes an entry."""

import traceback
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from trunnion.arrays import Results
from trunnion.errors import DeckError, ModelError
from trunnion.many.records import (
    BAD_DECK,
    CERTIFIED,
    FAILED,
    INTERNAL,
    CaseLine,
    Entry,
    fingerprints,
    record,
    record_path,
)
from trunnion.model import Model, Place
from trunnion.origin import telling
from trunnion.results.supports import cause_of, is_good

if TYPE_CHECKING:
    from trunnion.formats.options import Options
    from trunnion.report.units import ReportUnits

Settings = Mapping[str, object]


def solve_deck(deck: Path, folder: Path, settings: Settings) -> Entry:
    """Solve one deck and write its reports and its record, all of them or none."""
    try:
        model, sources = read_deck(deck, settings)
        entry, reports = solve_model(model, deck, settings)
        write_deck(entry, reports, fingerprints(sources, deck), folder, settings)
        return entry
    except (DeckError, ModelError) as error:
        return refused(deck, error)
    except Exception as error:
        return broken(deck, folder, error)


def read_deck(deck: Path, settings: Settings) -> tuple[Model, tuple[str, ...]]:
    """Read a deck, or a file of another program; give the files it is made of as well.

    Options beside the file go to the formats that have a use for them.
    """
    from trunnion.formats import FORMATS, is_foreign, read_any
    from trunnion.formats.options import NONE

    if is_foreign(deck):
        form = FORMATS.get(deck.suffix.lower())
        options = _options(settings) if form is not None and form.options else NONE
        sources = (str(deck),) if options.table is None else (str(deck), str(options.table))
        found = read_any(deck, permissive=bool(settings["permissive"]), options=options)
        return found.model, sources
    from trunnion.deck.reader import read_sources

    return read_sources(deck)


def _options(settings: Settings) -> "Options":
    from trunnion.formats.options import Options

    given: Any = settings
    table = given.get("table")
    place = None if table is None else Path(table)
    return Options(place, given.get("tolerance"), tuple(given.get("anchors", ())))


def solve_model(model: Model, deck: Path, settings: Settings) -> tuple[Entry, dict[str, bytes]]:
    """Solve a model; give its entry and its reports by their names in the folder."""
    import trunnion
    from trunnion.report import report_files
    from trunnion.report.units import report_units

    with telling(model.origin):
        results = trunnion.solve(model)
    also: Any = settings["also"]
    files = report_files(results, model, Path(), deck.stem, also=also)
    reports = {path.as_posix(): content for path, content in files.items()}
    entry = entry_of(results, report_units(model.units), deck, tuple(reports))
    if model.origin is not None:
        entry = replace(entry, left_out=tuple(map(str, model.origin.left_out)))
    return entry, reports


def write_deck(
    entry: Entry,
    reports: Mapping[str, bytes],
    sources: Mapping[str, str],
    folder: Path,
    settings: Settings,
) -> None:
    """Write reports and record; the record comes last, so it never stands alone."""
    from trunnion.report.atomic import write_files

    files = {folder / name: content for name, content in reports.items()}
    own = {record_path(folder, entry.stem): record(entry, sources, settings, reports)}
    write_files(files | own)


def entry_of(results: Results, units: "ReportUnits", deck: Path, files: tuple[str, ...]) -> Entry:
    """Sum up a solved deck; `causes` have its units, those of the cases have newtons."""
    from trunnion.report.causes import in_units, told_cause

    cases = results.cases.values()
    causes = [f"{case.name}: {told_cause(case, units)}" for case in cases if not is_good(case)]
    cycles = [cycle for cycle in results.cycles.values() if cycle.cause]
    causes += [f"CYCLE {c.name}: {in_units(c.cause or '', units)}" for c in cycles]
    return Entry(
        stem=deck.stem,
        deck=deck.name,
        status=FAILED if causes else CERTIFIED,
        cases=tuple(
            CaseLine(
                case.name,
                case.kind,
                is_good(case),
                case.certificate.worst if case.certificate and is_good(case) else None,
                None if is_good(case) else cause_of(case),
            )
            for case in cases
        ),
        warnings=len(results.warnings) + sum(len(case.warnings) for case in cases),
        causes=tuple(causes),
        files=files,
    )


def refused(deck: Path, error: DeckError | ModelError) -> Entry:
    """Entry of a deck that is wrong: every problem is a cause, and so is what was left out."""
    notes = "\n".join(getattr(error, "__notes__", ())).split("\n")
    causes = tuple(f"{_spot(problem.place)}: {problem.text}" for problem in error.problems)
    causes += tuple(line for line in notes if line.startswith("LEFT OUT: "))
    return Entry(deck.stem, deck.name, BAD_DECK, causes=causes)


def _spot(place: object) -> str:
    """File and line without folders: the summary is the same wherever the decks stand."""
    return f"{Path(place.file).name}:{place.line}" if isinstance(place, Place) else str(place)


def broken(deck: Path, folder: Path, error: Exception) -> Entry:
    """Entry of a deck at which the program itself failed; a log file has the traceback."""
    from trunnion.report.atomic import write_files

    log = folder / f"{deck.stem}-error.log"
    cause = f"{type(error).__name__}: {error}"
    try:
        write_files({log: "".join(traceback.format_exception(error)).encode()})
        cause += f" (traceback in {log.name})"
    except OSError as full:
        cause += f" (no log file: {full.strerror})"
    return Entry(deck.stem, deck.name, INTERNAL, causes=(cause,))
