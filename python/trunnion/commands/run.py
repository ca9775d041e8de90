"""trunnion run: solve a deck, write its reports."""

from pathlib import Path
from time import perf_counter

import click

from trunnion.commands.shared import (
    DECK,
    FAILED,
    FOLDER,
    SOLVED,
    InputError,
    read_model,
    refuse_unwritable,
    say,
    solve_model,
)


@click.command()
@DECK
@FOLDER
@click.option(
    "--spread",
    type=click.IntRange(0),
    default=0,
    metavar="N",
    help="Look for other answers of every case from N other starts and load orders.",
)
@click.option("--h5", is_flag=True, help="Write <stem>.h5 too.")
@click.option("--timings", is_flag=True, help="Print how long each part took.")
def run(deck: Path, folder: Path, spread: int, h5: bool, timings: bool) -> int:
    """Solve DECK; write <stem>.out and <stem>.json."""
    from trunnion.report.screen import screen

    _check_names(deck, h5)
    refuse_unwritable(folder)
    start = perf_counter()
    model = read_model(deck)
    read = perf_counter()
    results = solve_model(model, spread)
    solved = perf_counter()
    from trunnion.report import write_reports

    files = write_reports(results, model, folder, deck.stem, h5=h5)
    written = perf_counter()
    good, text = screen(results, model)
    say(text)
    say("wrote " + "  ".join(str(file) for file in files))
    if timings:
        parts = {"read": read - start, "solve": solved - read, "write": written - solved}
        say(", ".join(f"{name} {seconds:.3f} s" for name, seconds in parts.items()))
    return SOLVED if good else FAILED


def _check_names(deck: Path, h5: bool) -> None:
    """Refuse before any work what would overwrite the deck or could not be written."""
    if deck.suffix.lower() in (".out", ".json", ".h5"):
        raise InputError(f"{deck}: a deck must not be called *{deck.suffix}, as the reports are")
    if h5:
        from importlib.util import find_spec

        if find_spec("h5py") is None:
            raise InputError("--h5 needs the package h5py: pip install 'trunnion[hdf5]'")
