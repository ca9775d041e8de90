"""trunnion export: a job for another program."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from trunnion.commands.shared import (
    DECK,
    FOLDER,
    SOLVED,
    InputError,
    beside,
    is_foreign,
    read_model,
    refuse_unwritable,
    say,
    solve_model,
    wrote,
)

if TYPE_CHECKING:
    from trunnion.arrays import Results
    from trunnion.exports import Job
    from trunnion.formats.options import Options
    from trunnion.model import Model
    from trunnion.watch import Watch

PROGRAMS = ("opensees", "calculix")
CASES = click.option(
    "--case", "cases", multiple=True, metavar="NAME", help="Only this case; may be repeated."
)
LEAVE_OUT = click.option(
    "--permissive", is_flag=True, help="Leave out what cannot be represented, and list it."
)


@click.command()
@DECK
@click.option("--to", "program", type=click.Choice(PROGRAMS), default="opensees", show_default=True)
@CASES
@FOLDER
@LEAVE_OUT
@beside
def export(
    deck: Path,
    program: str,
    cases: tuple[str, ...],
    folder: Path,
    permissive: bool,
    options: "Options | None",
) -> int:
    """Solve DECK and write it as a job for another program."""
    from trunnion.exports import files
    from trunnion.report.atomic import write_files
    from trunnion.report.progress import shown

    refuse_unwritable(folder)
    with shown(f"reading {deck.name}") as watch:
        _, _, job = exported(
            deck,
            program,
            cases,
            permissive=permissive,
            leave_out=permissive,
            hint="; --permissive leaves these cases out, --case chooses others",
            options=options,
            watch=watch,
        )
        made = files(job, program, deck.stem)
    write_files({folder / name: content for name, content in made.items()})
    for line in said(job):
        say(line)
    say("\n".join(wrote([folder / name for name in made])))
    return SOLVED


def exported(
    deck: Path,
    program: str,
    cases: tuple[str, ...],
    *,
    permissive: bool,
    leave_out: bool,
    hint: str,
    options: "Options | None",
    watch: "Watch | None",
) -> "tuple[Model, Results, Job]":
    """Read and solve a deck, and take it apart for another program.

    `permissive` is for what a file has and a model cannot, `leave_out` for cases that the other
    program cannot be given.
    """
    from trunnion.exports import build_job
    from trunnion.exports.refusals import ExportError

    model = read_model(deck, permissive=permissive and is_foreign(deck), options=options)
    results = solve_model(model, watch=watch)
    try:
        job = build_job(model, results, cases, program=program, permissive=leave_out)
    except ExportError as error:
        raise InputError(f"{error}{hint}") from None
    return model, results, job


def said(job: "Job") -> list[str]:
    """What a reader must know of a job."""
    return [*job.notes, *(f"LEFT OUT: {problem}" for problem in job.left_out)]
