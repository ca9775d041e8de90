"""trunnion study: variants of one deck on one symbolic analysis."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from trunnion.commands.shared import (
    DECK,
    FAILED,
    FOLDER,
    JOBS,
    PERMISSIVE,
    SOLVED,
    beside,
    read_model,
    refuse_unwritable,
    room,
    say,
    wrote,
)

if TYPE_CHECKING:
    from trunnion.formats.options import Options


@click.command()
@DECK
@click.option(
    "--vary",
    multiple=True,
    metavar="KEY[@label]=VALUES",
    help="MU=0.1:0.5:9 or GAP@60=0,3mm; several make all combinations.",
)
@click.option("--case", "cases", multiple=True, help="Case to report; all if not given.")
@FOLDER
@JOBS
@PERMISSIVE
@beside
@click.option("--warm", is_flag=True, help="Start variants from the answer of the deck as it is.")
def study(
    deck: Path,
    vary: tuple[str, ...],
    cases: tuple[str, ...],
    folder: Path,
    jobs: int | None,
    permissive: bool,
    options: "Options | None",
    warm: bool,
) -> int:
    """Solve variants of DECK; write <stem>-study.out, .json, .csv and <stem>-variants.csv.

    What can vary, and how: docs/many.md.  Exit 0: every variant is certified.  1: one failed, it
    has its cause.  2: bad input.
    """
    from trunnion.cases.default_cases import with_cases
    from trunnion.many.axes import count, read_axes
    from trunnion.many.study import study as solve_study
    from trunnion.origin import telling
    from trunnion.report.atomic import write_files
    from trunnion.report.progress import progress, shown
    from trunnion.report.study import study_report, study_screen
    from trunnion.report.study_data import envelope_csv, study_json, variants_csv

    refuse_unwritable(folder)
    with shown(f"reading {deck.name}"):
        model = read_model(deck, permissive=permissive, options=options)
    with telling(model.origin, deck.name):
        total = count(read_axes(with_cases(model), vary))
    with telling(model.origin, deck.name), progress("variants", total) as counter:
        done = solve_study(
            model,
            vary,
            cases=cases,
            jobs=jobs,
            warm=warm,
            told=lambda n: counter.step("variants", n),
            tick=counter.tick,
        )
    files = {
        folder / f"{deck.stem}-study.out": study_report(done, model),
        folder / f"{deck.stem}-study.json": study_json(done, model.origin),
        folder / f"{deck.stem}-study.csv": envelope_csv(done),
        folder / f"{deck.stem}-variants.csv": variants_csv(done),
    }
    write_files(files)
    say(study_screen(done, model, room(0)))
    say("\n".join(wrote(list(files))))
    return FAILED if done.failures else SOLVED
