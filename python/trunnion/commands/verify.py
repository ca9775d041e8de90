"""trunnion verify: a stored result against its deck."""

import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from trunnion.commands.shared import (
    FAILED,
    SOLVED,
    InputError,
    beside,
    say,
    solve_model,
)

if TYPE_CHECKING:
    from trunnion.formats.options import Options
    from trunnion.model import Model
    from trunnion.watch import Watch

WORDS = {True: "holds", False: "FAILS", None: "not judged"}


@click.command()
@click.argument("results", type=click.Path(path_type=Path))
@click.option("--deck", type=click.Path(path_type=Path), help="The deck, if it is not found.")
@click.option("--certificate", is_flag=True, help="Judge the stored numbers; solve nothing.")
@click.option(
    "--allow",
    type=click.FloatRange(0.0, max=1.0),
    default=1e-9,
    show_default=True,
    help="Difference allowed, of the largest of its kind.",
)
@click.option(
    "--most",
    type=click.IntRange(1),
    default=20,
    show_default=True,
    help="Print so many differences at most.",
)
@beside
def verify(
    results: Path,
    deck: Path | None,
    certificate: bool,
    allow: float,
    most: int,
    options: "Options | None",
) -> int:
    """Run the deck of RESULTS.json again and compare, or judge its numbers alone.

    The deck is looked for beside RESULTS.json, in the folder above, in the current one and in
    folders models there.

    Exit 0: it agrees.  1: it differs.  2: bad input, as a deck that was changed since.
    """
    from trunnion.commands.stored_source import Asked, read_source
    from trunnion.compare.stored import read_report
    from trunnion.origin import origin_lines
    from trunnion.report.progress import shown

    typed = ["trunnion", "verify", *["--certificate"] * certificate, str(results)]
    asked = Asked(results, deck, options, shlex.join(typed))
    with shown(f"reading {results.name}") as watch:
        report = read_report(results)
        place, model = read_source(report, asked)
        if certificate:
            code, said = _judge(report, model, watch)
        else:
            code, said = _repeat(report, model, place, allow, most, watch)
    if model.origin is not None:
        said = "\n".join([*origin_lines(model.origin), said])
    say(said)
    return code


def _repeat(
    report: dict[str, Any],
    model: "Model",
    place: Path,
    allow: float,
    most: int,
    watch: "Watch | None",
) -> tuple[int, str]:
    """Solve the deck again and list what differs."""
    import json

    from trunnion.compare.results import diff_results
    from trunnion.report.counts import counted
    from trunnion.report.json import json_report

    lines = _versions(report, "run again")
    again = json.loads(json_report(solve_model(model, watch=watch), model))
    changes = diff_results(report, again, allow)
    lines += map(str, changes[:most])
    if len(changes) > most:
        lines.append(f"... and {counted(len(changes) - most, 'more difference')}")
    if not changes:
        n = len(report["cases"])
        lines.append(f"{n} case{'s agree' if n != 1 else ' agrees'} with a new run of {place}")
    return FAILED if changes else SOLVED, "\n".join(lines)


def _versions(report: dict[str, Any], word: str) -> list[str]:
    """Say where the file names another version than this one."""
    from importlib.metadata import version

    made, own = report["manifest"]["version"], version("trunnion")
    return [] if made == own else [f"made by version {made}, {word} by {own}"]


def _judge(report: dict[str, Any], model: "Model", watch: "Watch | None") -> tuple[int, str]:
    """Judge the stored numbers alone."""
    from trunnion.compare.rejudge import rejudge

    verdicts = rejudge(report, model, watch)
    lines = [f"{v.case}: {WORDS[v.passed]}: {v.text}" for v in verdicts]
    said = "\n".join([*_versions(report, "judged"), *lines])
    failed = any(verdict.passed is False for verdict in verdicts)
    if not failed and not any(verdict.passed for verdict in verdicts):
        raise InputError("no case could be judged")
    return FAILED if failed else SOLVED, said
