"""The skeleton of a neutral file: sections, counts of CONTROL, lines of each record."""

import re

from trunnion.formats.caesar.text import Columns
from trunnion.formats.findings import Findings
from trunnion.frozen import frozen

SECTIONS = (
    *("VERSION", "CONTROL", "ELEMENTS", "AUX_DATA", "NODENAME", "BEND", "RIGID", "EXPJT"),
    *("RESTRANT", "DISPLMNT", "FORCMNT", "UNIFORM", "WIND", "OFFSETS", "ALLOWBLS", "SIF&TEES"),
    *("REDUCERS", "FLANGES", "EQUIPMNT", "MISCEL_1", "UNITS", "COORDS"),
)
NEEDED = ("VERSION", "CONTROL", "ELEMENTS", "MISCEL_1", "UNITS")
# the 19 integers of CONTROL; sections by their name, the rest in small letters
COUNTS = (
    *("ELEMENTS", "nozzles", "hangers", "NODENAME", "REDUCERS", "FLANGES"),
    *("BEND", "RIGID", "EXPJT", "RESTRANT", "DISPLMNT", "FORCMNT"),
    *("UNIFORM", "WIND", "OFFSETS", "ALLOWBLS", "SIF&TEES", "z_up", "EQUIPMNT"),
)
# lines of one record, by version: all widths that are known
WIDTHS: dict[str, tuple[int, ...]] = {
    "ELEMENTS": (12, 15),
    "NODENAME": (1,),
    "BEND": (3,),
    "RIGID": (1,),
    "EXPJT": (1,),
    "RESTRANT": (8, 12, 24),
    "DISPLMNT": (20,),
    "FORCMNT": (20,),
    "UNIFORM": (6,),
    "WIND": (1,),
    "OFFSETS": (1,),
    "ALLOWBLS": (26, 28),
    "SIF&TEES": (10, 14),
    "REDUCERS": (1, 2),
    "FLANGES": (12,),
    "EQUIPMNT": (6,),
}
CHECKS_ONLY = ("ALLOWBLS", "SIF&TEES", "FLANGES", "EQUIPMNT")  # no part of a model

_HEADER = re.compile(r"#\$\s*(\S*)")


@frozen
class Section:
    """Lines of one section: the header's number, and the first and last line below it."""

    name: str
    header: int
    last: int

    @property
    def n_line(self) -> int:
        """Number of lines below the header."""
        return self.last - self.header


@frozen
class Records:
    """Where the records of one section start, and how many lines each has."""

    starts: tuple[int, ...] = ()
    width: int = 0


@frozen
class Skeleton:
    """Sections by name, the integers of CONTROL by name, the program's version."""

    sections: dict[str, Section]
    counts: dict[str, int]
    version: float
    titles: tuple[str, ...]


def skeleton(findings: Findings) -> Skeleton:
    """Split the file and read VERSION and CONTROL; raise at once what makes the rest senseless."""
    sections = _split(findings)
    findings.stop()
    columns = Columns(findings)
    version, titles = _version(columns, sections["VERSION"])
    findings.stop()
    counts = _control(columns, sections["CONTROL"])
    findings.stop()
    return Skeleton(sections, counts, version, titles)


def records(findings: Findings, frame: Skeleton, name: str) -> Records:
    """Divide a section into its records by its count; the lines decide on the width."""
    count, section = frame.counts[name], frame.sections.get(name)
    if section is None:
        if count:
            findings.fault(0, f"CONTROL counts {count} in {name}, and there is no such section")
        return Records()
    n_line = section.n_line
    if count == 0 or n_line % count:
        n_line -= _blank_lines(findings, section)
    if count == 0:
        if n_line:
            text = f"{name} has {n_line} lines, but CONTROL counts none of it"
            findings.fault(section.header, text)
        return Records()
    width, rest = divmod(n_line, count)
    if rest or not width:
        text = (
            f"{name} has {n_line} lines, which are no whole number for each of its {count} records"
        )
        findings.fault(section.header, f"{text} (CONTROL)")
        return Records()
    known = WIDTHS[name]
    if width not in known:
        text = f"{name} has {width} lines a record in this version {frame.version:g}"
        if name not in CHECKS_ONLY:
            findings.fault(section.header, f"{text}; known are {' or '.join(map(str, known))}")
            return Records()
        findings.assume(f"{text}, a layout that is not known; it was passed over", section.header)
    first = section.header + 1
    return Records(tuple(range(first, first + n_line, width)), width)


def _split(findings: Findings) -> dict[str, Section]:
    """Find the headers."""
    found: list[tuple[str, int]] = []
    lines = findings.source.lines
    for number, line in enumerate(lines, 1):
        if line.startswith("#$"):
            match = _HEADER.match(line)
            found.append((match[1].upper() if match else "", number))
        elif not found and line.strip():
            findings.fault(number, "text before the first section")
            return {}
    if not found:
        findings.fault(1, "there is no section in the file; is it cut off?")
        return {}
    sections: dict[str, Section] = {}
    ends = [number - 1 for _, number in found[1:]] + [len(lines)]
    for (name, number), end in zip(found, ends, strict=True):
        if name not in SECTIONS:
            findings.leave_out(number, "file", f"section {name or 'without a name'} is not known")
        elif name in sections:
            findings.fault(
                number, f"there is a section {name} in line {sections[name].header} already"
            )
        else:
            sections[name] = Section(name, number, end)
    for name in NEEDED:
        if name not in sections:
            findings.fault(0, f"section {name} is missing; is the file cut off?")
    return sections


def _blank_lines(findings: Findings, section: Section) -> int:
    """Count blank lines at the end of a section."""
    lines, n = findings.source.lines, 0
    while n < section.n_line and not lines[section.last - 1 - n].strip():
        n += 1
    return n


def _version(columns: Columns, section: Section) -> tuple[float, tuple[str, ...]]:
    """Read the program's version and the title page."""
    line = section.header + 1
    first = columns.text(line)
    interface = first[2:15].strip()
    words = first.split()
    try:
        version = float(words[1])
    except (IndexError, ValueError):
        columns.findings.fault(line, "the version of the program is expected here")
        return 0.0, ()
    if not 5.0 <= version < 100.0:
        text = f"this is the layout of version {version:g}"
        text += f" (interface {interface[:8]}); versions 7 to 15 are read"
        columns.findings.fault(line, text)
    elif not 7.0 <= version < 16.0:
        text = f"version {version:g} is not one of 7 to 15; it was read by the lines of its records"
        columns.findings.assume(text, line)
    titles = [
        columns.text(n)[2:].strip() for n in range(line + 1, min(section.last, line + 60) + 1)
    ]
    while titles and not titles[-1]:
        titles.pop()
    return version, tuple(titles)


def _control(columns: Columns, section: Section) -> dict[str, int]:
    """Read the counts."""
    values: list[int] = []
    for k, n in enumerate((6, 6, 6, 1)):
        line = section.header + 1 + k
        if line > section.last:
            text = f"CONTROL has {section.n_line} lines; 4 are needed"
            columns.findings.fault(section.header, text)
            return dict.fromkeys(COUNTS, 0)
        values += columns.integers(line, n)
    counts = dict(zip(COUNTS, values, strict=True))
    most = len(columns.lines)
    for k, (name, value) in enumerate(counts.items()):
        if not 0 <= value <= most:
            text = f"{value} {name} cannot be: the file has {most} lines"
            columns.findings.fault(section.header + 1 + k // 6, text, _field(k % 6))
    if counts["z_up"] not in (0, 1):
        columns.findings.fault(section.header + 3, "the vertical axis is 0 (Y) or 1 (Z)", _field(5))
    if counts["ELEMENTS"] == 0:
        columns.findings.fault(section.header + 1, "the file has no elements", _field(0))
    return counts


def _field(k: int) -> tuple[int, int]:
    return 2 + 13 * k, 15 + 13 * k
