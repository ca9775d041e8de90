"""trunnion diff: what changed between two decks or two results."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from trunnion.commands.shared import FAILED, SOLVED, InputError, read_model, say

if TYPE_CHECKING:
    from trunnion.compare.change import Change

RELATIVE = click.FloatRange(0.0, max=1.0)


@click.command()
@click.argument("files", type=click.Path(path_type=Path), nargs=-1, required=True)
@click.option(
    "--tolerance",
    type=RELATIVE,
    help="Results: of the largest of its kind (1e-9); decks: of each number (0).",
)
@click.option("--most", type=click.IntRange(1), help="Print so many differences at most.")
@click.option(
    "--git", is_flag=True, help="Take the seven arguments of a diff driver of git; exit 0."
)
@click.option("--canonical", is_flag=True, help="Print one deck as git's textconv wants it.")
def diff(
    files: tuple[Path, ...], tolerance: float | None, most: int | None, git: bool, canonical: bool
) -> int:
    """Compare two decks or two results (.json), most important first.

    Exit 0: the same.  1: they differ.  2: bad input.
    """
    if canonical:
        if len(files) != 1:
            raise InputError("--canonical takes one deck")
        from trunnion.compare.gitdriver import textconv

        say(textconv(files[0]))
        return SOLVED
    if git:
        from trunnion.compare.gitdriver import driver

        if len(files) not in (1, 7, 9):
            raise InputError("--git is for git, which gives seven arguments (GIT_EXTERNAL_DIFF)")
        say("\n".join(driver(files, tolerance)))
        return SOLVED
    if len(files) != 2:
        raise InputError(f"diff takes two files, not {len(files)}")
    from trunnion.report.progress import shown

    with shown(f"comparing {files[0].name} and {files[1].name}"):
        changes = _compare(*files, tolerance)
    for change in changes[:most]:
        say(str(change))
    if most is not None and len(changes) > most:
        from trunnion.report.counts import counted

        say(f"... and {counted(len(changes) - most, 'more difference')}")
    return FAILED if changes else SOLVED


def _compare(a: Path, b: Path, tolerance: float | None) -> "list[Change]":
    """Compare two files of one kind."""
    kinds = [path.suffix.lower() == ".json" for path in (a, b)]
    if kinds[0] != kinds[1]:
        raise InputError("a deck and a result cannot be compared: give two of a kind")
    if kinds[0]:
        from trunnion.compare.results import diff_reports

        return diff_reports(a, b, tolerance)
    from trunnion.compare.decks import diff_decks

    return diff_decks(read_model(a), read_model(b), tolerance or 0.0)
