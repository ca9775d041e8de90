"""trunnion batch: many decks, in processes or on a cluster."""

from pathlib import Path

import click

from trunnion.commands.shared import (
    FOLDER,
    INTERRUPTED,
    JOBS,
    PERMISSIVE,
    InputError,
    refuse_unwritable,
    say,
)


@click.command()
@click.argument("decks", nargs=-1, required=True, type=click.Path(path_type=Path))
@FOLDER
@JOBS
@PERMISSIVE
@click.option("--h5", is_flag=True, help="Write <stem>.h5 too.")
@click.option("--redo", is_flag=True, help="Solve finished decks again.")
@click.option("--scheduler", metavar="ADDRESS", help="Solve on the Dask cluster of this scheduler.")
def batch(
    decks: tuple[Path, ...],
    folder: Path,
    jobs: int | None,
    permissive: bool,
    h5: bool,
    redo: bool,
    scheduler: str | None,
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
    _need_extras(h5, scheduler)
    with progress("decks", len(decks)) as counter:

        def told(entry: Entry) -> None:
            counter.step(entry_line(entry))

        try:
            done = solve_batch(
                decks,
                folder,
                jobs=jobs,
                h5=h5,
                permissive=permissive,
                scheduler=scheduler,
                redo=redo,
                told=told,
                tick=counter.tick,
            )
        except KeyboardInterrupt:
            click.echo("interrupted: finished decks stay, the same command goes on", err=True)
            return INTERRUPTED
    say(summary_screen(done.entries))
    say(f"wrote {folder / SUMMARY}.json  {folder / SUMMARY}.csv")
    return done.code


def _need_extras(h5: bool, scheduler: str | None) -> None:
    """Refuse before any work what an optional package would be needed for."""
    from importlib.util import find_spec

    if h5 and find_spec("h5py") is None:
        raise InputError("--h5 needs the package h5py: pip install 'trunnion[hdf5]'")
    if scheduler and find_spec("distributed") is None:
        raise InputError("--scheduler needs the package distributed: pip install 'trunnion[dask]'")
