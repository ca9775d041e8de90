"""trunnion convert: a file of another program becomes a deck."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from trunnion.commands.shared import PERMISSIVE, SOLVED, InputError, beside, refuse_unwritable, say

if TYPE_CHECKING:
    from trunnion.formats.options import Options


@click.command()
@click.argument("source", type=click.Path(path_type=Path))
@click.argument("deck", type=click.Path(path_type=Path))
@click.option("--force", is_flag=True, help="Write over DECK if it is there.")
@PERMISSIVE
@beside
def convert(
    source: Path, deck: Path, force: bool, permissive: bool, options: "Options | None"
) -> int:
    """Read SOURCE, a file of another program, and write DECK with comments on what came whence.

    What a model cannot represent is an error that names it; --permissive leaves it out, and
    lists it at the top of the deck.
    """
    from trunnion.formats import is_foreign, read_any
    from trunnion.formats.options import NONE
    from trunnion.origin import origin_lines
    from trunnion.report.atomic import write_files
    from trunnion.report.progress import shown

    if deck.exists() and source.exists() and deck.samefile(source):
        raise InputError(f"{deck}: the deck would overwrite its own source")
    if is_foreign(deck):
        raise InputError(f"{deck}: a deck must not be called *{deck.suffix}; call it *.inp")
    if deck.is_dir():
        raise InputError(f"{deck} is a folder")
    if deck.exists() and not force:
        raise InputError(f"{deck} exists; --force writes over it")
    refuse_unwritable(deck.parent)
    with shown(f"reading {source.name}"):
        imported = read_any(source, permissive=permissive, options=options or NONE)
        write_files({deck: imported.deck().encode()})
    say("\n".join(origin_lines(imported.origin)))
    say(f"wrote {deck}")
    return SOLVED
