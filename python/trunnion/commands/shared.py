"""What several commands do: exit codes, reading, solving, saying, places that cannot be written."""

import os
import sys
from collections.abc import Callable, Sequence
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from trunnion.arrays import Results
    from trunnion.formats.options import Options
    from trunnion.model import Model
    from trunnion.report.screen import Room
    from trunnion.watch import Watch

SOLVED, FAILED, BAD_INPUT, INTERNAL, INTERRUPTED, TERMINATED = 0, 1, 2, 3, 130, 143

DECK = click.argument("deck", type=click.Path(path_type=Path))
FOLDER = click.option(
    "-o", "folder", type=click.Path(path_type=Path), default=Path(), help="Where the files go."
)
PERMISSIVE = click.option(
    "--permissive", is_flag=True, help="Leave out what a model cannot represent, and list it."
)
FOREIGN = (".cii", ".pcf", ".xml")  # suffixes of files that are no decks: formats.FORMATS
JOBS = click.option(
    "-j", "jobs", type=click.IntRange(1), help="Processes at a time; one a core if not given."
)


#: options that ask for further files, as in report.outputs, which needs numpy: help does not
FURTHER = {
    "h5": "Write <stem>.h5, too (extra hdf5).",
    "xlsx": "Write <stem>.xlsx, too: every table, a sheet each (extra excel).",
    "csv": "Write <stem>_csv/, too: the same tables, a file each.",
    "html": "Write <stem>.html, too: one page with the model in 3-D, for any browser (extra html).",
    "png": "Draw <stem>.*.png, too: isometric, displaced shapes, supports (extra plot).",
    "vtu": "Write <stem>.pvd and <stem>_vtu/, too, for ParaView (extra vtk).",
}


def further_options(command: Callable[..., int]) -> Callable[..., int]:
    """Give a command the options of FURTHER."""
    for name, text in reversed(FURTHER.items()):
        command = click.option(f"--{name}", name, is_flag=True, help=text)(command)
    return command


def is_foreign(deck: Path) -> bool:
    """Tell whether a file is one of another program; without numpy, unlike `formats.is_foreign`."""
    return deck.suffix.lower() in FOREIGN


class InputError(Exception):
    """The command cannot be done as it stands: exit 2."""


def say(text: str) -> None:
    """Print on stdout; a reader that has gone away (| head) changes nothing."""
    try:
        click.echo(text)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def beside(command: Callable[..., int]) -> Callable[..., int]:
    """Give a command the options --table, --tolerance and --anchor as one argument `options`."""

    @click.option("--table", type=click.Path(path_type=Path), help="Side table of a PCF.")
    @click.option("--tolerance", metavar="LENGTH", help="Join ends of a PCF so near: 2mm.")
    @click.option(
        "--anchor",
        "anchors",
        multiple=True,
        metavar="NODE",
        help="Anchor a node of a PCF: a label, E,N,Up in its units, or open-ends.",
    )
    @wraps(command)
    def with_options(
        *, table: Path | None, tolerance: str | None, anchors: tuple[str, ...], **rest: Any
    ) -> int:
        options = None
        if table is not None or tolerance is not None or anchors:
            from trunnion.formats.options import Options, length

            try:
                near = None if tolerance is None else length(tolerance)
            except ValueError as error:
                raise InputError(f"--tolerance: {error}") from None
            options = Options(table, near, anchors)
        return command(options=options, **rest)

    return with_options


def not_foreign(words: str) -> InputError:
    """Say that options are for files of other programs."""
    return InputError(f"{words} is for files of other programs ({' '.join(FOREIGN)})")


def read_model(
    deck: Path, *, permissive: bool = False, options: "Options | None" = None
) -> "Model":
    """Read the input file of a command: a deck, or a file of another program by its suffix."""
    if is_foreign(deck):
        from trunnion.formats import read_any
        from trunnion.formats.options import NONE

        return read_any(deck, permissive=permissive, options=options or NONE).model
    if options is not None:
        raise InputError("--table, --tolerance and --anchor are for files of other programs")
    if permissive:
        raise not_foreign("--permissive")
    from trunnion.deck.reader import read

    return read(deck)


def solve_model(model: "Model", spread: int = 0, watch: "Watch | None" = None) -> "Results":
    """Solve every case; with `spread` look for other answers from so many starts."""
    import trunnion
    from trunnion.origin import telling

    if watch is not None:
        from trunnion.deck.units import scale_of

        watch.force = model.units.force, scale_of(model.units.force, "force")(1.0)
    asked: dict[str, Any] = {"spread": spread, "watch": watch}
    with telling(model.origin, "" if model.file is None else model.file.name):
        results: Results = trunnion.solve(model, **{key: x for key, x in asked.items() if x})
    return results


def room(below: int) -> "Room":
    """What the summary may take: the terminal but for lines below it, or where it is piped, all."""
    from trunnion.report.screen import PIPE, Room

    if not sys.stdout.isatty():
        return PIPE
    from shutil import get_terminal_size

    columns, lines = get_terminal_size()
    return Room(columns, lines - below)


def wrote(names: Sequence[object]) -> list[str]:
    """Say what was written, in lines of a terminal that do not break a name."""
    columns, lines = room(0).columns, ["wrote"]
    for i, name in enumerate(map(str, names)):
        if i and room(0).lines is not None and len(lines[-1]) + len(name) + 2 > columns:
            lines.append("    ")
        lines[-1] += f"{' ' if i == 0 else '  '}{name}"
    return lines


def refuse_missing(also: Sequence[str]) -> None:
    """Refuse before any work formats whose packages are not installed."""
    from trunnion.report.outputs import missing

    lacking = [said for said in map(missing, also) if said]
    if lacking:
        raise InputError("\n".join(lacking))


def refuse_unwritable(folder: Path) -> None:
    """Refuse before any work a folder in which nothing could be written in the end."""
    place = folder
    while not place.exists() and place != place.parent:
        place = place.parent
    if not place.is_dir():
        raise InputError(f"-o {folder}: {place} is not a folder")
    if not os.access(place, os.W_OK | os.X_OK):
        raise InputError(f"-o {folder}: no permission to write in {place}")
