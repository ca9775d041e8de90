"""Files of other programs in, `Imported` out: a model, what is missing in it, what came from where.

Each format is a package of its own below this one.  `read_any` finds the format by the contents
of the file and by its suffix.  Decks never come this way (`deck.reader` reads them).
"""

import os
import re
from collections.abc import Callable
from importlib import import_module

from trunnion.errors import DeckError, Problem
from trunnion.formats.findings import Findings
from trunnion.formats.imported import Imported, Note
from trunnion.formats.options import NONE, Options
from trunnion.formats.source import Source, read_source
from trunnion.frozen import frozen
from trunnion.model import Place
from trunnion.origin import Beside, InputFile

__all__ = ["FORMATS", "Findings", "Imported", "Note", "Options", "Source", "is_foreign", "read_any"]


@frozen
class Format:
    """One format: its name, the module with `read(source, findings)`, what a file begins with."""

    name: str
    module: str
    opening: str  # pattern of the first line that is not blank
    options: tuple[str, ...] = ()  # of formats.options that it has a use for


#: by suffix; commands.shared.FOREIGN lists the same suffixes
FORMATS: dict[str, Format] = {
    ".cii": Format("CAESAR II neutral file", "trunnion.formats.caesar", r"#\$"),
    ".xml": Format(
        "CAESAR II input XML",
        "trunnion.formats.caesar_xml",
        r"(?i)<(\?xml|!--|!DOCTYPE|CAESARII)",
    ),
    ".pcf": Format(
        "PCF (Isogen piping component file)",
        "trunnion.formats.pcf",
        r"(?i)<?(ISOGEN-FILES|UNITS-|PIPELINE-REFERENCE|MESSAGE-|END-|MATERIALS|PIPE|ELBOW|BEND|TEE"
        r"|OLET|WELDOLET|FLANGE|VALVE|REDUCER|SUPPORT|WELD|GASKET|CAP|INSTRUMENT|COUPLING|ANCHOR)",
        ("--table", "--tolerance", "--anchor"),
    ),
}


def is_foreign(path: str | os.PathLike[str]) -> bool:
    """Tell by its suffix whether a file is one of another program."""
    return os.path.splitext(path)[1].lower() in FORMATS


def read_any(
    path: str | os.PathLike[str], *, permissive: bool = False, options: Options = NONE
) -> Imported:
    """Read a file of another program.

    Parameters
    ----------
    permissive : leave out what a model cannot represent, and list it; else that is an error.
    options : what the user says beside the file: a side table, a tolerance, anchors.

    Raises
    ------
    DeckError : with every problem of the file, its line and the words at fault.
    """
    source = read_source(path)
    form = FORMATS[_suffix_of(source)]
    useless = [name for name in options.given() if name not in form.options]
    if useless:
        verb = "means" if len(useless) == 1 else "mean"
        text = f"{' and '.join(useless)} {verb} nothing for a {form.name}"
        raise DeckError([Problem(Place(source.file, 1), text)])
    read: Callable[[Source, Findings], Imported] = import_module(form.module).read
    found = read(source, Findings(source, permissive=permissive, options=options))
    name = os.path.basename(source.file)
    found.model.file = InputFile(name, source.sha256, _beside(options))
    return found


def _beside(options: Options) -> Beside | None:
    """Name what the user said beside the file, without folders; None if nothing."""
    if not options.given():
        return None
    table = options.table
    return Beside(
        None if table is None else os.path.basename(table),
        None if table is None else read_source(table).sha256,
        options.tolerance,
        tuple(options.anchors),
    )


def _suffix_of(source: Source) -> str:
    """Find the format by the contents; the suffix must not contradict."""
    suffix = os.path.splitext(source.file)[1].lower()
    number, first = next(((i, x) for i, x in enumerate(source.lines, 1) if x.strip()), (1, ""))
    found = next((s for s, form in FORMATS.items() if re.match(form.opening, first.strip())), None)
    if found is not None and (found == suffix or suffix not in FORMATS):
        return found
    if found is not None:
        text = f"the name ends in {suffix}, but this is a {FORMATS[found].name}; call it *{found}"
    elif suffix in FORMATS:
        text = f"this is no {FORMATS[suffix].name}"
    else:
        known = ", ".join(f"{form.name} ({end})" for end, form in FORMATS.items())
        text = f"this is no file of a known format: {known}"
    raise DeckError([Problem(Place(source.file, number), text, source.marker(number))])
