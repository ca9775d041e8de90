"""trunnion batch: many decks, in processes or on a cluster."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from trunnion.commands.shared import (
    FOLDER,
    INTERRUPTED,
    JOBS,
    PERMISSIVE,
    InputError,
    beside,
    further_options,
    is_foreign,
    not_foreign,
    refuse_missing,
    refuse_unwritable,
    room,
    say,
    wrote,
)

if TYPE_CHECKING:
    from trunnion.formats.options import Options


@click.command()
@click.argument("decks", nargs=-1, required=True, type=click.Path(path_type=Path))
@FOLDER
@JOBS
@PERMISSIVE
@beside
@further_options
@click.option("--redo", is_flag=True, help="Solve finished decks again.")
@click.option("--scheduler", metavar="ADDRESS", help="Solve on the Dask cluster of this scheduler.")
def batch(
    decks: tuple[Path, ...],
    folder: Path,
    jobs: int | None,
    permissive: bool,
    options: "Options | None",
    redo: bool,
    scheduler: str | None,
    **further: bool,
) -> int:
    """Solve many DECKS; finished ones are skipped, and a killed run resumes.

    Exit 0: all are certified.  1: a case failed.  2: a deck is bad.  3: an internal error or a
    worker that died.  The worst deck counts.  The summary is in batch-summary.json and .csv.
    """
    from trunnion.many.batch import SUMMARY
    from trunnion.many.batch import batch as solve_batch
    from trunnion.many.records import Entry
    from trunnion.report.batch import entry_line, summary_screen
    from trunnion.report.progress import progress

    if scheduler and jobs:
        raise InputError("-j is for processes of this machine, the cluster has its own")
    refuse_unwritable(folder)
    also = [name for name, wanted in further.items() if wanted]
    refuse_missing(also)
    _need_dask(scheduler)
    if (options is not None or permissive) and not any(map(is_foreign, decks)):
        given = [] if options is None else options.given()
        words = " and ".join([*given, *["--permissive"] * permissive])
        raise not_foreign(words)
    with progress("decks", len(decks)) as counter:

        def told(entry: Entry) -> None:
            counter.step(entry_line(entry))

        try:
            done = solve_batch(
                decks,
                folder,
                jobs=jobs,
                also=also,
                permissive=permissive,
                options=options,
                scheduler=scheduler,
                redo=redo,
                told=told,
                tick=counter.tick,
                warned=counter.say,
            )
        except KeyboardInterrupt:
            click.echo("interrupted: finished decks stay, the same command goes on", err=True)
            return INTERRUPTED
    say(summary_screen(done.entries, room(0)))
    say("\n".join(wrote([f"{folder / SUMMARY}.json", f"{folder / SUMMARY}.csv"])))
    return done.code


def _need_dask(scheduler: str | None) -> None:
    """Refuse before any work a cluster that could not be reached."""
    from importlib.util import find_spec

    if scheduler and find_spec("distributed") is None:
        raise InputError("--scheduler needs the package distributed: pip install 'trunnion[dask]'")
