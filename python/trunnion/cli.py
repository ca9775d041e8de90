"""The command line: trunnion run DECK, trunnion check DECK.

Exit 0: solved and certified.  1: a case did not converge or failed its certificate; the files
hold the good cases.  2: bad input, nothing written.  3: internal error, a log file tells.
130: interrupted, nothing half written.
"""

import os
import signal
import sys
from collections.abc import Sequence
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, NoReturn

import click

if TYPE_CHECKING:
    from trunnion.arrays import Results, System
    from trunnion.model import Model

SOLVED, FAILED, BAD_INPUT, INTERNAL, INTERRUPTED, TERMINATED = 0, 1, 2, 3, 130, 143

DECK = click.argument("deck", type=click.Path(path_type=Path))


class InputError(Exception):
    """The command cannot be done as it stands: exit 2."""


@click.group(context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="trunnion")
def cli() -> None:
    """Solve piping whose supports lift off, close gaps and slide with friction."""


@cli.command()
@DECK
@click.option(
    "-o", "folder", type=click.Path(path_type=Path), default=Path(), help="Where the files go."
)
@click.option("--h5", is_flag=True, help="Write <stem>.h5 too.")
@click.option("--timings", is_flag=True, help="Print how long each part took.")
def run(deck: Path, folder: Path, h5: bool, timings: bool) -> int:
    """Solve DECK; write <stem>.out and <stem>.json."""
    from trunnion.report.screen import screen

    _check_places(deck, folder, h5)
    start = perf_counter()
    model = _read(deck)
    read = perf_counter()
    results = _solve(model)
    solved = perf_counter()
    from trunnion.report import write_reports

    files = write_reports(results, model, folder, deck.stem, h5=h5)
    written = perf_counter()
    good, text = screen(results, model)
    _say(text)
    _say("wrote " + "  ".join(str(file) for file in files))
    if timings:
        parts = {"read": read - start, "solve": solved - read, "write": written - solved}
        _say(", ".join(f"{name} {seconds:.3f} s" for name, seconds in parts.items()))
    return SOLVED if good else FAILED


@cli.command()
@DECK
def check(deck: Path) -> int:
    """Read DECK, look for mechanisms and missing loads; solve and write nothing."""
    from trunnion.cases.default_cases import may_be_free, with_cases
    from trunnion.loads import case_loads, load_sets
    from trunnion.model import Case
    from trunnion.system import build_system

    read = _read(deck)
    model = with_cases(read)
    system = build_system(model)
    sets = load_sets(model, system)
    for case in model.cases:
        if isinstance(case, Case):
            case_loads(model, system, case, sets)
    if not may_be_free(read):
        _refuse_mechanisms(system)
    counts = (
        (len(system.labels), "nodes"),
        (len(system.parts), "elements"),
        (len(system.cards), "supports"),
        (len(model.cases), "cases"),
    )
    _say(f"{deck.name}: no errors; " + ", ".join(f"{n} {what}" for n, what in counts))
    return SOLVED


def _say(text: str) -> None:
    """Print on stdout; a reader that has gone away (| head) changes nothing."""
    try:
        click.echo(text)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _read(deck: Path) -> "Model":
    from trunnion.deck.reader import read

    return read(deck)


def _solve(model: "Model") -> "Results":
    import trunnion

    results: Results = trunnion.solve(model)
    return results


def _refuse_mechanisms(system: "System") -> None:
    """Refuse a structure that moves freely even with every contact closed."""
    from trunnion.errors import ModelError, Problem
    from trunnion.solver.ledger import Ledger
    from trunnion.solver.mechanism import structural_motions
    from trunnion.solver.structure import Structure

    motions = structural_motions(Structure(system, Ledger()))
    if motions:
        raise ModelError([Problem("structure", motion.text) for motion in motions])


def _check_places(deck: Path, folder: Path, h5: bool) -> None:
    """Refuse before any work what could not be written in the end."""
    if deck.suffix.lower() in (".out", ".json", ".h5"):
        raise InputError(f"{deck}: a deck must not be called *{deck.suffix}, as the reports are")
    if h5:
        from importlib.util import find_spec

        if find_spec("h5py") is None:
            raise InputError("--h5 needs the package h5py: pip install 'trunnion[hdf5]'")
    place = folder
    while not place.exists() and place != place.parent:
        place = place.parent
    if not place.is_dir():
        raise InputError(f"-o {folder}: {place} is not a folder")
    if not os.access(place, os.W_OK | os.X_OK):
        raise InputError(f"-o {folder}: no permission to write in {place}")


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run one command and leave with its exit code."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(TERMINATED))
    sys.exit(_guarded(arguments))


def _guarded(arguments: Sequence[str] | None) -> int:
    """Turn every end of a command into an exit code and a message without a traceback."""
    from trunnion.errors import DeckError, ModelError

    try:
        code = cli.main(arguments, prog_name="trunnion", standalone_mode=False)
        return int(code or 0)
    except click.ClickException as error:
        error.show()
        return BAD_INPUT
    except (DeckError, ModelError, InputError) as error:
        click.echo(str(error), err=True)
        return BAD_INPUT
    except (click.Abort, KeyboardInterrupt):
        click.echo("interrupted, nothing was written", err=True)
        return INTERRUPTED
    except OSError as error:
        name = f"{error.filename}: " if error.filename else ""
        click.echo(f"{name}{error.strerror or error}", err=True)
        return INTERNAL
    except Exception as error:
        click.echo(_internal(error), err=True)
        return INTERNAL


def _internal(error: Exception) -> str:
    """Keep the traceback of an internal error in a file and say where."""
    import tempfile
    import traceback

    said = f"internal error, nothing was written: {type(error).__name__}: {error}"
    text = "".join([f"{sys.argv}\n", *traceback.format_exception(error)])
    for folder in (Path(), Path(tempfile.gettempdir())):
        log = folder / f"trunnion-error-{os.getpid()}.log"
        try:
            log.write_text(text)
        except OSError:
            continue
        return f"{said}\nPlease report it with the deck and {log.resolve()}"
    return said
