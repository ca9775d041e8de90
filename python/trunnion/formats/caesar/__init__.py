"""CAESAR II neutral files, versions 7 to 15.

text -> sections -> units, elements with their auxiliary arrays, miscellaneous data -> `Job`
(in SI) -> `build` -> model.  What is known of the format stands in docs/caesar.md.
"""

from trunnion.formats.caesar.auxiliary import Auxiliary
from trunnion.formats.caesar.build import build
from trunnion.formats.caesar.elements import Elements
from trunnion.formats.caesar.job import Job
from trunnion.formats.caesar.misc import USUAL_AMBIENT, read_coordinates, read_misc
from trunnion.formats.caesar.sections import WIDTHS, Skeleton, records, skeleton
from trunnion.formats.caesar.text import Columns
from trunnion.formats.caesar.units import read_units
from trunnion.formats.findings import Findings
from trunnion.formats.imported import Imported
from trunnion.formats.source import Source

__all__ = ["build", "read", "read_job"]


def read(source: Source, findings: Findings) -> Imported:
    """Read a neutral file.

    Raises
    ------
    DeckError : with every problem of the file, its line and the words at fault.
    """
    frame = skeleton(findings)
    job = read_job(findings, frame)
    name = f"CAESAR II neutral file, version {frame.version:g}"
    return build(job, findings, name, _header(source, frame))


def read_job(findings: Findings, frame: Skeleton) -> Job:
    """Read the elements and all that hangs on them, in SI."""
    columns = Columns(findings)
    arrays = {name: records(findings, frame, name) for name in WIDTHS}
    findings.stop()
    units = read_units(columns, frame.sections["UNITS"])
    misc = read_misc(columns, frame, units)
    auxiliary = Auxiliary(columns, units, arrays)
    elements = Elements(columns, units, auxiliary, misc.materials).read(arrays["ELEMENTS"])
    coordinates = read_coordinates(columns, frame.sections.get("COORDS"), units)
    findings.stop()
    if misc.options.ambient is None:
        text = f"the file has no ambient temperature: {USUAL_AMBIENT:g} C (70 F)"
        findings.assume(text, frame.sections["MISCEL_1"].header)
    return Job(
        elements,
        misc.hangers,
        misc.nozzles,
        coordinates,
        up="Z" if frame.counts["z_up"] else "Y",
        ambient=misc.options.ambient if misc.options.ambient is not None else USUAL_AMBIENT,
        units=units.names,
        titles=frame.titles,
        version=frame.version,
        bourdon=misc.options.bourdon,
    )


def _header(source: Source, frame: Skeleton) -> tuple[str, ...]:
    """Comment lines for the top of a deck: title page, size, encoding."""
    lines = [line for line in frame.titles if line]
    lines.append(f"{frame.counts['ELEMENTS']} elements")
    if source.encoding != "utf-8":
        lines.append(f"text read as {source.encoding}")
    return tuple(lines)
