"""trunnion verify: a stored result against its deck."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from trunnion.commands.shared import (
    FAILED,
    SOLVED,
    InputError,
    beside,
    read_model,
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
@click.option("--deck", type=click.Path(path_type=Path), help="The deck, if not beside RESULTS.")
@click.option("--certificate", is_flag=True, help="Judge the stored numbers; solve nothing.")
@click.option(
    "--allow",
    type=click.FloatRange(0.0, max=1.0),
    default=1e-9,
    show_default=True,
    help="Difference allowed, of the largest of its kind.",
)
@beside
def verify(
    results: Path, deck: Path | None, certificate: bool, allow: float, options: "Options | None"
) -> int:
    """Run the deck of RESULTS.json again and compare, or judge its numbers alone.

    Exit 0: it agrees.  1: it differs.  2: bad input, as a deck that was changed since.
    """
    from trunnion.compare.stored import read_report
    from trunnion.report.progress import shown

    with shown(f"reading {results.name}") as watch:
        report = read_report(results)
        model = _model(report, results, deck, options)
        if certificate:
            code, said = _judge(report, model, watch)
        else:
            code, said = _repeat(report, model, allow, watch)
    say(said)
    return code


def _model(
    report: dict[str, Any], results: Path, deck: Path | None, options: "Options | None"
) -> "Model":
    """Read the deck that the manifest names; refuse any other."""
    manifest = report.get("manifest")
    wanted = ("deck", "sha256", "version", "settings")
    if not isinstance(manifest, dict) or any(key not in manifest for key in wanted):
        raise InputError(f"{results.name}: no manifest; run its deck once with this version")
    name, settings = str(manifest["deck"]), manifest["settings"]
    if Path(name).name != name or not isinstance(settings, dict):
        raise InputError(f"{results.name}: the manifest is not one of trunnion run")
    place = deck or results.parent / name
    if not place.exists():
        raise InputError(f"{results.name}: its deck {name} is not beside it; say --deck PATH")
    model = read_model(place, permissive=bool(settings.get("permissive")), options=options)
    found = "" if model.file is None else model.file.sha256
    if found != manifest["sha256"]:
        raise InputError(
            f"{place}: not the deck of {results.name}, or changed since (with its includes): "
            f"SHA-256 is {found[:12]}..., in the manifest {str(manifest['sha256'])[:12]}..."
        )
    return model


def _repeat(
    report: dict[str, Any], model: "Model", allow: float, watch: "Watch | None"
) -> tuple[int, str]:
    """Solve the deck again and list what differs."""
    import json
    from importlib.metadata import version

    from trunnion.compare.results import diff_results
    from trunnion.report.json import json_report

    made, own = report["manifest"]["version"], version("trunnion")
    lines = [] if made == own else [f"made by version {made}, run again by {own}"]
    again = json.loads(json_report(solve_model(model, watch=watch), model))
    changes = diff_results(report, again, allow)
    lines += map(str, changes)
    if not changes:
        n, name = len(report["cases"]), report["manifest"]["deck"]
        lines.append(f"{n} case{'s agree' if n != 1 else ' agrees'} with a new run of {name}")
    return FAILED if changes else SOLVED, "\n".join(lines)


def _judge(report: dict[str, Any], model: "Model", watch: "Watch | None") -> tuple[int, str]:
    """Judge the stored numbers alone."""
    from trunnion.compare.rejudge import rejudge

    verdicts = rejudge(report, model, watch)
    said = "\n".join(f"{v.case}: {WORDS[v.passed]}: {v.text}" for v in verdicts)
    failed = any(verdict.passed is False for verdict in verdicts)
    if not failed and not any(verdict.passed for verdict in verdicts):
        raise InputError("no case could be judged")
    return FAILED if failed else SOLVED, said
