"""trunnion run: solve a deck, write its reports."""

from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

import click

from trunnion.commands.shared import (
    DECK,
    FAILED,
    FOLDER,
    PERMISSIVE,
    SOLVED,
    InputError,
    beside,
    further_options,
    read_model,
    refuse_missing,
    refuse_unwritable,
    room,
    say,
    solve_model,
    wrote,
)

if TYPE_CHECKING:
    from trunnion.formats.options import Options


@click.command()
@DECK
@FOLDER
@further_options
@click.option(
    "--spread",
    type=click.IntRange(0),
    default=0,
    metavar="N",
    help="Look for other answers of every case from N other starts and load orders.",
)
@PERMISSIVE
@click.option("--timings", is_flag=True, help="Print how long each part took.")
@beside
def run(
    deck: Path,
    folder: Path,
    spread: int,
    permissive: bool,
    options: "Options | None",
    timings: bool,
    **further: bool,
) -> int:
    """Solve DECK; write <stem>.out and <stem>.json."""
    from trunnion.report.progress import shown
    from trunnion.report.screen import screen

    also = [name for name, wanted in further.items() if wanted]
    _check_names(deck, also)
    refuse_unwritable(folder)
    start = perf_counter()
    with shown(f"reading {deck.name}") as watch:
        model = read_model(deck, permissive=permissive, options=options)
        read = perf_counter()
        results = solve_model(model, spread, watch)
        solved = perf_counter()
        from trunnion.report import write_reports

        files = write_reports(results, model, folder, deck.stem, also=also, watch=watch)
    written = perf_counter()
    below = wrote(_shown(files, folder))
    if timings:
        parts = {"read": read - start, "solve": solved - read, "write": written - solved}
        below.append(", ".join(f"{name} {seconds:.3f} s" for name, seconds in parts.items()))
    good, text = screen(results, model, room(len(below) + 1))  # one for the prompt
    say("\n".join([text, *below]))
    return SOLVED if good else FAILED


def _shown(files: list[Path], folder: Path) -> list[str]:
    """Name the files; those in a folder of their own by that folder, pictures together."""
    from trunnion.report.counts import counted

    inner = [file.parent for file in files if file.parent != folder]
    pictures = [file for file in files if file.suffix == ".png"]
    alone = [str(file) for file in files if file.parent == folder and file not in pictures]
    if pictures:
        alone.append(f"{folder / files[0].stem}.*.png ({counted(len(pictures), 'picture')})")
    return alone + [
        f"{place}/ ({counted(inner.count(place), 'file')})" for place in dict.fromkeys(inner)
    ]


def _check_names(deck: Path, also: list[str]) -> None:
    """Refuse before any work what would overwrite the deck or could not be written."""
    from trunnion.report.outputs import SUFFIXES

    if deck.suffix.lower() in SUFFIXES:
        raise InputError(f"{deck}: a deck must not be called *{deck.suffix}, as the reports are")
    refuse_missing(also)
