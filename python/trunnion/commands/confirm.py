"""trunnion confirm: the answers of a deck held against those of another program."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from trunnion.commands.export import CASES, LEAVE_OUT, PROGRAMS, exported
from trunnion.commands.shared import (
    DECK,
    FAILED,
    SOLVED,
    InputError,
    beside,
    refuse_unwritable,
    say,
)

if TYPE_CHECKING:
    from trunnion.arrays import Results
    from trunnion.exports import Job
    from trunnion.formats.options import Options
    from trunnion.model import Model


@click.command()
@DECK
@click.option(
    "--with", "program", type=click.Choice(PROGRAMS), default="opensees", show_default=True
)
@CASES
@click.option(
    "--allow",
    type=click.FloatRange(0.0, 1.0),
    help="Largest difference, of the largest value of its kind.  [1e-6; CalculiX: 2e-6]",
)
@click.option(
    "-o", "folder", type=click.Path(path_type=Path), help="Keep the other program's files here."
)
@LEAVE_OUT
@beside
def confirm(
    deck: Path,
    program: str,
    cases: tuple[str, ...],
    allow: float | None,
    folder: Path | None,
    permissive: bool,
    options: "Options | None",
) -> int:
    """Solve DECK, solve it again with another program, compare the two.

    Exit 0: they agree.  1: they differ, or one of them has no answer.  2: bad input.
    """
    from tempfile import TemporaryDirectory

    from trunnion.exports.confirm import missing

    lacking = missing(program)
    if lacking:
        raise InputError(lacking)
    if folder is not None:
        refuse_unwritable(folder)
    model, results, job = exported(deck, cases, permissive=permissive, options=options)
    with TemporaryDirectory() as scratch:
        place = folder or Path(scratch)
        return _compare(model, results, job, program, place, deck.stem, allow)


def _compare(
    model: "Model",
    results: "Results",
    job: "Job",
    program: str,
    place: Path,
    stem: str,
    allow: float | None,
) -> int:
    """Run the other program and print how far it is away."""
    import json

    from trunnion.exports import files
    from trunnion.exports.confirm import NAMES, TOLERANCES, ProgramError, answer
    from trunnion.report.atomic import write_files
    from trunnion.report.json import json_report

    allowed = TOLERANCES[program] if allow is None else allow
    made = files(job, program, stem)
    write_files({place / name: content for name, content in made.items()})
    own: dict[str, Any] = json.loads(json_report(results, model))
    for text in (*job.notes, *(f"LEFT OUT: {problem}" for problem in job.left_out)):
        say(text)
    try:
        found = answer(job, program, place, stem)
    except ProgramError as error:
        say(str(error))
        return FAILED
    good = _judge(own, found, NAMES[program], allowed)
    for case in () if good else job.scene.cases:
        for warning in case.warnings:
            say(f"{case.name}: {warning}")
    return SOLVED if good else FAILED


def _judge(own: dict[str, Any], found: dict[str, Any], name: str, allowed: float) -> bool:
    from trunnion.exports.agreement import agrees, differences, laws, table, unanswered

    rows, held, without = differences(own, found), laws(found), unanswered(own, found)
    if rows:
        say(table(rows, name, allowed))
    for case, (value, where) in held.items():
        say(f"{case}: laws of the held contacts hold to {value:.1e}" + f" ({where})" * bool(where))
    for case, why in without.items():
        say(f"{case}: not confirmed: {why}")
    good = agrees(rows, held, allowed) and not without
    count = len({row.case for row in rows})
    verdict = f"{count} case{'s' * (count > 1)} confirmed" if good else "NOT confirmed"
    say(f"{verdict} by {found['program']}, to {allowed:g} of the largest value of each kind")
    return good
