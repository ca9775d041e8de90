"""trunnion confirm: the answers of a deck held against those of another program."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from trunnion.commands.export import CASES, PROGRAMS, exported
from trunnion.commands.shared import (
    DECK,
    FAILED,
    PERMISSIVE,
    SOLVED,
    InputError,
    beside,
    is_foreign,
    not_foreign,
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
@PERMISSIVE
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

    Cases that the other program cannot be given (SPECTRUM, NONLINEAR) are named, with why, and
    left out; one that --case asks for is an error.

    Exit 0: they agree in all others.  1: they differ, or one of them has no answer.  2: bad
    input, or no case is left.
    """
    from tempfile import TemporaryDirectory

    from trunnion.exports.confirm import NAMES, TOLERANCES, ProgramError, missing
    from trunnion.report.progress import shown

    lacking = missing(program)
    if lacking:
        raise InputError(lacking)
    if folder is not None:
        refuse_unwritable(folder)
    if permissive and not is_foreign(deck):
        raise not_foreign("--permissive")
    with shown(f"reading {deck.name}") as watch, TemporaryDirectory() as scratch:
        model, results, job = exported(
            deck,
            program,
            cases,
            permissive=permissive,
            leave_out=not cases,
            hint="; without --case it would be left out" if cases else "",
            options=options,
            watch=watch,
        )
        if watch is not None:
            watch.turn(f"{NAMES[program]} is solving")
        both: tuple[dict[str, Any], dict[str, Any]] | str
        try:
            both = _both(model, results, job, program, folder or Path(scratch), deck.stem)
        except ProgramError as error:
            both = str(error)
    for line in job.notes:
        say(line)
    if isinstance(both, str):
        say(both)
        return FAILED
    allowed = TOLERANCES[program] if allow is None else allow
    good = _judge(*both, NAMES[program], allowed)
    for problem in job.left_out:
        say(f"not confirmed: {problem}")
    if good and (cases or not _unsolved(job, results)):
        return SOLVED
    for case in job.scene.cases:
        for warning in case.warnings:
            say(f"{case.name}: {warning}")
    return FAILED


def _unsolved(job: "Job", results: "Results") -> bool:
    """Tell whether a case was left out because it has no answer: that is no agreement."""
    from trunnion.results.supports import is_good

    told = {case.name for case in job.scene.cases}
    return any(not is_good(c) for name, c in results.cases.items() if name not in told)


def _both(
    model: "Model", results: "Results", job: "Job", program: str, place: Path, stem: str
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Answers of Trunnion and of the other program, whose files go to `place`."""
    import json

    from trunnion.exports import files
    from trunnion.exports.confirm import answer
    from trunnion.report.atomic import write_files
    from trunnion.report.json import json_report

    made = files(job, program, stem)
    write_files({place / name: content for name, content in made.items()})
    own: dict[str, Any] = json.loads(json_report(results, model))
    return own, answer(job, program, place, stem)


def _judge(own: dict[str, Any], found: dict[str, Any], name: str, allowed: float) -> bool:
    """Print how far the other program is away; tell whether that is near enough."""
    from trunnion.exports.agreement import agrees, differences, laws, table, tried, unanswered
    from trunnion.report.counts import counted

    rows, held, without = differences(own, found), laws(found), unanswered(own, found)
    if rows:
        say(table(rows, name, allowed))
    for case, (value, where) in held.items():
        place = f" ({where})" if value else ""
        say(f"{case}: laws of the held contacts hold to {value:.1e}{place}")
    for case, what in tried(found, allowed).items():
        say(f"{case}: friction elements of {name} {what}")
    for case, why in without.items():
        say(f"{case}: not confirmed: {why}")
    good = agrees(rows, held, allowed) and not without
    count = len({row.case for row in rows})
    verdict = f"{counted(count, 'case')} confirmed" if good else "NOT confirmed"
    say(f"{verdict} by {found['program']}, to {allowed:g} of the largest value of each kind")
    return good
