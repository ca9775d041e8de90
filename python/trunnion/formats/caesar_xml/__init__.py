"""CAESAR II input XML, versions 7, 11 and 14 (and those between): tags to a `Job`.

The XML is an export, not a save format: reducers, rates of springs, load cases and the vertical
axis are not in it (docs/caesar.md).  `formats.caesar.build` makes the model.
"""

from math import isfinite

from trunnion.formats.caesar.build import build
from trunnion.formats.caesar.job import Element, Job
from trunnion.formats.caesar_xml.elements import Elements
from trunnion.formats.caesar_xml.restrainttypes import written_by_guide
from trunnion.formats.caesar_xml.tags import Numbers, Tag, read_tags
from trunnion.formats.caesar_xml.xmlunits import read_units
from trunnion.formats.findings import Findings
from trunnion.formats.imported import Imported
from trunnion.formats.source import Source

VERSIONS = (7.0, 15.99)
AMBIENT = 21.11  # C, 70 F
SAME = 2e-3  # sizes that differ by less are one size
_COUNTS = {
    "NUMBEND": "BEND",
    "NUMRIGID": "RIGID",
    "NUMEXPJNT": "EXPANSIONJOINT",
    "NUMREST": "RESTRAINT",
    "NUMFORCMNT": "FORCESMOMENTS",
}


def read(source: Source, findings: Findings) -> Imported:
    """Read an input XML.

    Raises
    ------
    DeckError : with every problem of the file, its line and the words at fault.
    """
    numbers = Numbers(findings)
    root = read_tags(findings)
    findings.stop()
    assert root is not None
    version, model = _model(root, numbers)
    findings.stop()
    job = read_job(model, numbers, version)
    findings.stop()
    header = [f"{len(job.elements)} elements"]
    if source.encoding != "utf-8":
        header.append(f"text read as {source.encoding}")
    return build(job, findings, f"CAESAR II input XML, version {version:.2f}", tuple(header))


def _model(root: Tag, numbers: Numbers) -> tuple[float, Tag]:
    """Check the root, and find the model in it."""
    if root.name != "CAESARII":
        numbers.fault(root, "the root is not CAESARII")
        return 0.0, root
    kind = root.attributes.get("XML_TYPE", "")
    if kind.upper() != "INPUT":
        what = "results" if kind.upper() == "OUTPUT" else "no input"
        numbers.fault(root, f'XML_TYPE="{kind[:20]}": a file of {what}; export the input')
    text = root.attributes.get("VERSION", "")
    try:
        version = float(text)
    except ValueError:
        version = float("nan")
    if not (isfinite(version) and VERSIONS[0] <= version <= VERSIONS[1]):
        numbers.fault(root, f"version {text[:20]!r}; 7 to 15 are read")
    models = root.all("PIPINGMODEL")
    if len(models) != 1:
        numbers.fault(root, f"{len(models)} PIPINGMODEL; there must be one")
        return version, root
    return version, models[0]


def read_job(model: Tag, numbers: Numbers, version: float) -> Job:
    """Read the elements and all that hangs on them, in SI."""
    findings = numbers.findings
    tags = model.all("PIPINGELEMENT")
    units = read_units(next(iter(model.all("UNITS")), None), model, numbers)
    for tag in model.inside:
        if tag.name not in ("PIPINGELEMENT", "UNITS") and (tag.attributes or tag.inside):
            findings.leave_out(tag.line, "model", f"{tag.name[:40]}, which is not known here")
    if not tags:
        numbers.fault(model, "there is no PIPINGELEMENT")
    _check_counts(model, tags, numbers)
    findings.stop()
    reader = Elements(numbers, units, guide=written_by_guide(tags, numbers))
    elements = tuple(reader.element(tag) for tag in tags)
    _report_sizes(elements, findings)
    findings.assume(f"the XML has no ambient temperature: {AMBIENT:g} C (70 F)")
    return Job(
        elements,
        tuple(reader.hangers),
        tuple(reader.nozzles),
        up=_up(model, numbers),
        ambient=AMBIENT,
        units=units.names,
        titles=_titles(model),
        version=version,
    )


def _check_counts(model: Tag, tags: list[Tag], numbers: Numbers) -> None:
    """Compare what the head counts with what is there; that of elements must be right."""
    count = numbers.get(model, "NUMELT")
    if count is not None and count != len(tags):
        numbers.fault(model, f"NUMELT is {count:g}, there are {len(tags)} PIPINGELEMENT")
    for name, kind in _COUNTS.items():
        count = numbers.get(model, name)
        owners = sum(any(child.name == kind for child in tag.inside) for tag in tags)
        if count is not None and count != owners:
            text = f"{name} is {count:g}, {owners} elements have a {kind}"
            numbers.findings.leave_out(model.line, "PIPINGMODEL", text)


def _up(model: Tag, numbers: Numbers) -> str:
    """Vertical axis: not stored; a north along Y leaves Z, else Y is the program's own."""
    north = [abs(numbers.of(model, f"NORTH_{axis}")) for axis in "XYZ"]
    if north[1] > 0.9:
        numbers.findings.assume("Z is vertical, because north is along Y")
        return "Z"
    if north[2] <= 0.9:
        numbers.findings.assume("the XML does not say which axis is vertical: Y is taken")
    return "Y"


def _report_sizes(elements: tuple[Element, ...], findings: Findings) -> None:
    """Report sizes that change along the line: the XML does not hold reducers."""
    at: dict[int, list[Element]] = {}
    for e in elements:
        at.setdefault(e.start, []).append(e)
        at.setdefault(e.end, []).append(e)
    for node, here in at.items():
        if len(here) != 2 or here[0].reducer or here[1].reducer:
            continue
        one, other = here[0].od, here[1].od
        if abs(one - other) > SAME * max(one, other):
            text = (
                f"node {node}: the OD changes from {1e3 * one:.4g} to {1e3 * other:.4g} mm; a "
                "reducer there is not in the XML, and is not in the model"
            )
            findings.assume(text, here[1].line)


def _titles(model: Tag) -> tuple[str, ...]:
    """Name of the job, without the folders of the machine it came from."""
    name = model.attributes.get("JOBNAME", "").replace("\\", "/").rpartition("/")[2]
    return (name.strip(),)
