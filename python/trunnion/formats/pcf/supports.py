"""Supports and anchors of a line: records at one node are one support."""

from collections.abc import Mapping, Sequence

from trunnion.errors import DeckError
from trunnion.formats.findings import Findings
from trunnion.formats.pcf.assemble import Line
from trunnion.formats.pcf.network import Places
from trunnion.formats.pcf.openends import where
from trunnion.formats.pcf.parts import Part
from trunnion.formats.pcf.points import Point, plain
from trunnion.formats.pcf.supportwords import Meaning, add_words, meaning_of, merged
from trunnion.formats.sidetable import SideTable
from trunnion.model import Support
from trunnion.system.vectors import Vec

OPEN_ENDS = "open-ends"


def _names(placed: Sequence[tuple[Part, int]]) -> dict[int, str]:
    """Names of supports by the line of their record; the mark of a type stands at many."""
    said = {part.line: name for part, _ in placed if (name := _name(part))}
    nodes: dict[str, set[int]] = {}
    for part, node in placed:
        if part.line in said:
            nodes.setdefault(said[part.line], set()).add(node)
    return {line: name for line, name in said.items() if len(nodes[name]) == 1}


def add_supports(
    line: Line, placed: Sequence[tuple[Part, int]], table: SideTable, findings: Findings
) -> None:
    """Add the supports; the file's repeated records of one point are one card."""
    at: dict[int, list[tuple[Part, Meaning]]] = {}
    unknown: dict[str, list[Part]] = {}
    for part, node in placed:
        meaning = meaning_of(part, table)
        if meaning is None:
            said = part.get("SUPPORT_NAME") or part.get("NAME") or part.get("SKEY") or "no name"
            unknown.setdefault(said, []).append(part)
            continue
        if meaning.guess:
            findings.assume(f"supports {meaning.why}: taken as {meaning.words}", part.line)
        at.setdefault(node, []).append((part, meaning))
    for said, parts in unknown.items():
        text = f"{said}: nothing says what it holds; name it under [supports] of the side table"
        for part in parts:
            findings.leave_out(part.line, f"support at line {part.line}", text)
    names = _names(placed)
    for node, records in at.items():
        _add_at(line, node, records, names, findings)
    if any(s.kind == "support" for s in line.model.supports) and not line.model.settings.mu:
        findings.assume(
            "supports have neither friction nor gap: a PCF does not hold them (mu in the side "
            "table, MU= and GAP= under [supports])"
        )


def _add_at(
    line: Line,
    node: int,
    records: Sequence[tuple[Part, Meaning]],
    names: dict[int, str],
    findings: Findings,
) -> None:
    """Add the supports of one node: plain directions together, others a card each."""
    label = line.labels.get(node)
    if label is None:
        return
    words = dict.fromkeys(m.words for _, m in records)
    first = {m.words: part for part, m in reversed(records)}
    why = {m.words: m.why for _, m in records}
    if "ANCHOR" in words:
        add_anchor(line, node, f"line {first['ANCHOR'].line}: SUPPORT {why['ANCHOR']}", findings)
        words.pop("ANCHOR")
    plain_words = [w for w in words if "=" not in w and w not in ("IGNORE",) and w in _SIMPLE]
    cards = [*([" ".join(merged(plain_words))] if plain_words else [])]
    cards += [w for w in words if w not in plain_words]
    for number, card in enumerate(cards):
        source = [p for p, m in records if m.words == card or m.words in plain_words]
        part = source[0] if source else records[0][0]
        if card == "SPRING" and not any(pipe.operation.t for pipe in line.model.pipes):
            text = "a spring to be selected, and no temperature: give T1, or LOAD= and RATE= under "
            text += "[supports], in the side table; taken as a rest"
            findings.leave_out(part.line, part.name, text)
            card = "+Z"
        elif card == "SPRING":
            text = "springs without rate and load are selected by the program (HANGER DESIGN)"
            findings.assume(text, part.line)
        before = len(line.model.supports)
        try:
            name = None if number else names.get(part.line)
            add_words(line.model, label, card, findings.place(part.line), line.along(node), name)
        except DeckError as error:
            for problem in error.problems:
                findings.fault(part.line, f"{part.name}: {problem.text}")
        for support in line.model.supports[before:]:
            reasons = ", ".join(dict.fromkeys(why.get(w, w) for w in words))
            said = _name(part) if support.name is None else None
            mark = f", {said}" if said and said not in reasons else ""
            findings.note(support, f"line {part.line}: SUPPORT {reasons}{mark}")


_SIMPLE = frozenset(("+X", "-X", "X", "+Y", "-Y", "Y", "+Z", "-Z", "Z", "GUIDE", "LIMIT"))


def _name(part: Part) -> str | None:
    """Name of a support for the reports."""
    said = part.get("SUPPORT_NAME") or part.get("NAME") or part.get("COMPONENT-IDENTIFIER") or ""
    clean = "".join(c if c.isalnum() or c in "-_./+" else "-" for c in said)[:40].strip("-")
    return clean or None


def add_anchor(line: Line, node: int, why: str, findings: Findings) -> bool:
    """Anchor a node, once; tell whether it was not yet."""
    label = line.labels.get(node)
    if label is None or any(s.kind == "anchor" and s.node == label for s in line.model.supports):
        return False
    anchor = Support(label, "anchor")
    line.model.supports.append(anchor)
    findings.note(anchor, why)
    return True


def add_anchors(line: Line, asked: Sequence[str], unit: float, findings: Findings) -> None:
    """Anchor what options and table ask for: labels, "E,N,Up" in the file's unit, open ends."""
    nodes = {label: node for node, label in line.labels.items()}
    for text in asked:
        where_ = _coordinates(text, unit)
        if text.strip().lower() == OPEN_ENDS:
            _anchor_open_ends(line, findings)
        elif where_ is not None:
            node = Places(line.net).node(where_, 0.01)
            if node < 0 or node not in line.labels:
                findings.fault(0, f"--anchor {text}: no node within 10 mm of these coordinates")
            else:
                add_anchor(line, node, f"anchored: --anchor {text}", findings)
        elif text.strip().upper() in nodes:
            add_anchor(line, nodes[text.strip().upper()], f"anchored: --anchor {text}", findings)
        else:
            ends = ", ".join(line.labels[n] for n in line.net.open_ends if n in line.labels)
            findings.fault(
                0, f"--anchor {text}: there is no such node; open ends are {ends or 'none'}"
            )


def _anchor_open_ends(line: Line, findings: Findings) -> None:
    """Anchor the true ends of the line and list each; those at a cut are left free."""
    for node, part in line.net.open_ends.items():
        if node in line.net.cuts or part.shape == "closed":
            continue
        if add_anchor(line, node, "anchored: open end (--anchor open-ends)", findings):
            text = f"open end of {part.name} at {where(line.net, node)} anchored (open-ends)"
            findings.assume(f"node {line.labels[node]}: {text}", part.line)


def _coordinates(text: str, unit: float) -> Vec | None:
    numbers = [plain(word.strip()) for word in text.split(",")]
    if len(numbers) != 3:
        return None
    x, y, z = (float("nan") if n is None else n * unit for n in numbers)
    return (x, y, z) if x + y + z - (x + y + z) == 0.0 else None


def report_ends(
    line: Line,
    ends: Sequence[tuple[str, Point, str]],
    tolerance: float,
    findings: Findings,
) -> None:
    """Anchor ends at equipment, and say of all other open ends that they are free."""
    places = Places(line.net)
    anchored = {s.node for s in line.model.supports if s.kind == "anchor"}
    for keyword, point, reference in ends:
        if keyword == "END-CONNECTION-EQUIPMENT":
            node = places.node(point.xyz, tolerance)
            what = f"{keyword} {reference}".strip()
            if node < 0 or node not in line.labels:
                findings.leave_out(point.line, what, "no end of the line is there")
            elif line.labels[node] not in anchored:
                add_anchor(line, node, f"line {point.line}: {what}", findings)
                anchored.add(line.labels[node])
                findings.assume(f"node {line.labels[node]}: {what} taken as an anchor", point.line)
    held: Mapping[str, object] = {s.node: s for s in line.model.supports}
    for node, part in line.net.open_ends.items():
        label = line.labels.get(node)
        if label is not None and label not in anchored and label not in held:
            cut = line.net.cuts.get(node)
            if cut is None and part.shape == "closed":
                cut = "it closes nothing"
            kind = "open end" if cut is None else "end"
            text = f"node {label}: {kind} of {part.name} at {where(line.net, node)} is free"
            findings.assume(text + (f"; not for open-ends: {cut}" if cut else ""), part.line)
