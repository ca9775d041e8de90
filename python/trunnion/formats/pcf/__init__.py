"""PCF, the piping component file of Isogen: components joined by their coordinates.

blocks (text) -> parts (components in metres) -> shapes (legs) -> joints and network (nodes)
-> assemble (model).  What a PCF does not hold comes from a side table (formats.sidetable).
"""

from collections.abc import Iterator, Sequence
from pathlib import Path

from trunnion.errors import DeckError
from trunnion.formats.findings import Findings
from trunnion.formats.imported import Imported
from trunnion.formats.pcf import openends
from trunnion.formats.pcf.assemble import assemble, body_weight
from trunnion.formats.pcf.attach import Attached, attach_masses, attach_olets, attach_supports
from trunnion.formats.pcf.blocks import blocks
from trunnion.formats.pcf.bores import Bores, decide
from trunnion.formats.pcf.network import MAX_PARTS, Network, Places, build
from trunnion.formats.pcf.operations import say_unread
from trunnion.formats.pcf.parts import Line, Part, read_line
from trunnion.formats.pcf.points import Point
from trunnion.formats.pcf.properties import Resolver
from trunnion.formats.pcf.shapes import Form, form_of
from trunnion.formats.pcf.supports import add_anchor, add_anchors, add_supports, report_ends
from trunnion.formats.pcf.words import LOOSE_ENDS
from trunnion.formats.sidetable import SideTable, read_table
from trunnion.formats.source import Source
from trunnion.model import Model, Place, Settings, Units

MOST_NAMED = 8  # separate parts of a file that are named
TOLERANCE = 1e-3  # largest distance of two ends that are joined, unless said otherwise [m]


def read(source: Source, findings: Findings) -> Imported:
    """Read a PCF.

    Raises
    ------
    DeckError : with every problem of the file and of the side table.
    """
    options = findings.options
    table = _table(options.table, findings)
    tolerance = options.tolerance or table.tolerance or TOLERANCE
    line = read_line(blocks(source, findings), findings)
    if not any(p.shape not in ("support", "anchor", "weld") for p in line.parts):
        findings.fault(1, "there is no component in the file")
    if len(line.parts) > MAX_PARTS:
        findings.fault(1, f"more than {MAX_PARTS} components")
        findings.stop()
    bores = decide(_bores(line), line.bore_unit)
    model = Model(
        title=_title(line, source),
        units=Units("mm", "N", "bar", "C"),
        settings=Settings(up="Z", mu=table.mu),
    )
    resolver = Resolver(model, line, bores, table, findings)
    parts, supports, anchors = _sorted_out(line, findings)
    say_unread(parts, table.attributes, findings)
    _halt(resolver, parts, findings)
    forms = [f for f in (form_of(p, tolerance, findings) for p in parts) if f is not None]
    _halt(resolver, parts, findings)
    forms, masses = _without_length(forms, tolerance, findings)
    net = build(forms, tolerance, findings)
    attached = Attached()
    openends.refuse_overlaps(net, tolerance, findings)
    _halt(resolver, parts, findings)
    olets = [(i, form) for i, form in enumerate(forms) if form.run is not None]
    attach_olets(net, olets, tolerance, resolver.outside, attached, findings)
    weights = attach_masses(net, masses, tolerance, attached, findings)
    openends.mark_cuts(net, _missing(line, parts))
    openends.join_to_surface(net, tolerance, resolver.outside, findings)
    attach_supports(net, supports, tolerance, resolver.outside, attached, findings)
    openends.report_gaps(net, resolver.outside, findings)
    openends.refuse_loose(net, sum(len(f.open_ends) for f in forms), findings)
    _report_bores(net, forms, bores, findings)
    circles = _circles(net, line, tolerance)
    first = _first(net, circles, attached)
    places = Places(net)
    made = assemble(model, net, resolver, attached, circles, weights, first, findings)
    _report_separate(model, findings)
    add_supports(made, attached.supports, table, findings)
    for part in anchors:
        point = part.at or part.ends[0]
        node = places.node(point.xyz, tolerance)
        if node < 0:
            findings.leave_out(part.line, part.name, "there is no end of the line at the anchor")
        add_anchor(made, node, f"line {part.line}: ANCHOR", findings)
    add_anchors(made, (*table.anchors, *options.anchors), line.length, findings)
    report_ends(made, line.ends, tolerance, findings)
    return findings.finish(
        model, "PCF (Isogen piping component file)", _header(line, net, tolerance)
    )


def _table(path: Path | None, findings: Findings) -> SideTable:
    """Read the side table; its problems are told together with those of the file."""
    try:
        return SideTable() if path is None else read_table(path)
    except DeckError as error:
        findings.problems += error.problems
        return SideTable(whole=False)


def _halt(resolver: Resolver, parts: Sequence[Part], findings: Findings) -> None:
    """Where the file cannot be read on, raise all problems, what the side table lacks too."""
    if not findings.broken:
        return
    for part in parts if resolver.table.whole else ():
        for bore in dict.fromkeys(point.bore for point in part.ports if point.bore):
            resolver.properties(part, bore)
        body_weight(part, resolver, findings)
    findings.stop()


def _missing(line: Line, parts: Sequence[Part]) -> Iterator[tuple[str, Point]]:
    """Points at which the line goes on in something that the model lacks, or ends for good."""
    for name, point in line.gone:
        yield f"{name} is left out", point
    for part in parts:
        for point in part.branches if part.shape == "teed" else ():
            yield f"the branch of {part.name} is left out", point
    for keyword, point, _ in line.ends:
        if keyword in LOOSE_ENDS:
            yield keyword, point


def _report_separate(model: Model, findings: Findings) -> None:
    """Name the parts of the model that do not hang together."""
    starts = {node.label for node in model.nodes}
    if len(starts) < 2:
        return
    lines: dict[str, int] = {}
    for pipe in model.pipes:
        if pipe.start in starts and isinstance(pipe.place, Place):
            lines.setdefault(pipe.start, pipe.place.line)
    said = [f"from node {label} (line {number})" for label, number in lines.items()]
    more = f" and {len(said) - MOST_NAMED} more" if len(said) > MOST_NAMED else ""
    text = f"{len(starts)} separate parts, not joined to each other: "
    findings.assume(text + ", ".join(said[:MOST_NAMED]) + more)


def _title(line: Line, source: Source) -> str:
    """Names of the pipelines."""
    names = [name for name in dict.fromkeys(line.pipelines) if name]
    text = ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")
    return "".join(c if c.isprintable() and c not in "!&" else " " for c in text).strip()[:100]


def _bores(line: Line) -> list[float]:
    return [p.bore for part in line.parts for p in part.ports if p.bore and part.shape != "support"]


def _sorted_out(line: Line, findings: Findings) -> tuple[list[Part], list[Part], list[Part]]:
    """Components, supports and anchors; each thing that the file says twice once."""
    kept: list[Part] = []
    seen: set[object] = set()
    twice = 0
    for part in line.parts:
        where = tuple(p.xyz for p in (*part.ports, part.centre, part.at) if p is not None)
        about = (part.get("SKEY"), part.get("SUPPORT-DIRECTION"))
        key = (part.keyword, where, about if part.shape == "support" else None)
        if key in seen:
            twice += 1
            continue
        seen.add(key)
        kept.append(part)
    if twice:
        one = "1 record that repeats another one was dropped"
        many = f"{twice} records that repeat another one were dropped"
        findings.assume(one if twice == 1 else many)
    if line.skipped:
        text = ", ".join(f"{n} {word}" for word, n in sorted(line.skipped.items()))
        findings.assume(f"symbols without structure were skipped: {text}")
    supports = [p for p in kept if p.shape == "support"]
    anchors = [p for p in kept if p.shape == "anchor" and (p.ends or p.at)]
    others = [p for p in kept if p.shape not in ("support", "anchor")]
    return others, supports, anchors


def _without_length(
    forms: Sequence[Form], tolerance: float, findings: Findings
) -> tuple[list[Form], list[Part]]:
    """Take out components without length; those that weigh something stay as masses."""
    kept, masses = [], []
    for form in forms:
        part = form.part
        if form.legs or form.run is not None or part.shape in ("tee", "ways"):
            kept.append(form)
        elif part.shape in ("rigid", "closed", "angle", "fitting"):
            masses.append(part)
        elif part.shape in ("pipe", "reducer"):
            findings.assume(f"{part.name}: no length; dropped", part.line)
    return kept, masses


def _report_bores(net: Network, forms: Sequence[Form], bores: Bores, findings: Findings) -> None:
    """Report bores that differ where ends meet, and sizes written in another way."""
    if bores.inches and bores.guessed:
        findings.assume(f"bores are written as {bores.way}")
    for bore, way in bores.others:
        findings.assume(f"bore {bore:g} is no {bores.way}; read as {way}")
    at: dict[int, tuple[float, Form]] = {}
    for (i, j), node in net.port_node.items():
        written = forms[i].ports[j].bore
        inches = bores.inches.get(written) if written else None
        if inches is None:
            continue
        known = at.setdefault(node, (inches, forms[i]))
        if known[0] != inches:
            text = f"{forms[i].part.name} of NPS {inches:g} meets {known[1].part.name} of NPS "
            findings.assume(f"{text}{known[0]:g} without a reducer", forms[i].part.line)


def _circles(net: Network, line: Line, tolerance: float) -> dict[int, str]:
    """Node numbers of the drawing that stand on a joint; a number that stands twice is none."""
    found: dict[int, str] = {}
    if not line.circles or not net.xyz:
        return found
    places = Places(net)
    used: dict[str, int] = {}
    for text, point in line.circles:
        node = places.node(point.xyz, tolerance)
        if 0 <= node < net.joints and int(text) > 0:
            used[text] = used.get(text, 0) + 1
            found.setdefault(node, text)
    return {node: text for node, text in found.items() if used[text] == 1}


def _first(net: Network, circles: dict[int, str], attached: Attached) -> list[int]:
    """Nodes to start from: the lowest number of the drawing at an end, then all ends."""
    count = {node: len(runs) for node, runs in net.at().items()}
    ends = [n for n, k in count.items() if k == 1 and n not in net.bends]
    ends = [n for n in ends if n not in attached.middles]
    numbered = sorted((int(circles[n]), n) for n in ends if n in circles)
    loose = [n for n in ends if n in net.open_ends and n not in circles]
    return [*(n for _, n in numbered), *loose, *(n for n in ends if n not in circles)]


def _header(line: Line, net: Network, tolerance: float) -> tuple[str, ...]:
    """Comments for the top of a deck."""
    names = ", ".join(dict.fromkeys(line.pipelines))
    return (
        f"Pipelines: {names or 'without name'}",
        f"{len(line.parts)} components; X is east, Y north, Z up, coordinates as in the file",
        f"Ends within {1000 * tolerance:g} mm were joined; the widest joint is "
        f"{1000 * net.widest:.3g} mm",
    )


__all__ = ["TOLERANCE", "read"]
