"""What several commands do: exit codes, reading, solving, saying, places that cannot be written."""

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from trunnion.arrays import Results
    from trunnion.model import Model

SOLVED, FAILED, BAD_INPUT, INTERNAL, INTERRUPTED, TERMINATED = 0, 1, 2, 3, 130, 143

DECK = click.argument("deck", type=click.Path(path_type=Path))
FOLDER = click.option(
    "-o", "folder", type=click.Path(path_type=Path), default=Path(), help="Where the files go."
)
JOBS = click.option(
    "-j", "jobs", type=click.IntRange(1), help="Processes at a time; one a core if not given."
)


class InputError(Exception):
    """The command cannot be done as it stands: exit 2."""


def say(text: str) -> None:
    """Print on stdout; a reader that has gone away (| head) changes nothing."""
    try:
        click.echo(text)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def read_model(deck: Path) -> "Model":
    """Read the input file of a command."""
    from trunnion.deck.reader import read

    return read(deck)


def solve_model(model: "Model", spread: int = 0) -> "Results":
    """Solve every case; with `spread` look for other answers from so many starts."""
    import trunnion

    results: Results = trunnion.solve(model, spread=spread) if spread else trunnion.solve(model)
    return results


def refuse_unwritable(folder: Path) -> None:
    """Refuse before any work a folder in which nothing could be written in the end."""
    place = folder
    while not place.exists() and place != place.parent:
        place = place.parent
    if not place.is_dir():
        raise InputError(f"-o {folder}: {place} is not a folder")
    if not os.access(place, os.W_OK | os.X_OK):
        raise InputError(f"-o {folder}: no permission to write in {place}")
