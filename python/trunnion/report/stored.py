"""Tables of a stored result for the terminal: SI units, supports' forces on the pipe.

click strips the colours where the output is no terminal.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import click

from trunnion.origin import Assumption, LeftOut, Origin, origin_lines
from trunnion.results.supports import by_state

Case = Mapping[str, Any]
FORCES = ("FX [N]", "FY [N]", "FZ [N]", "MX [N m]", "MY [N m]", "MZ [N m]")
MOVES = ("DX [mm]", "DY [mm]", "DZ [mm]", "RX [deg]", "RY [deg]", "RZ [deg]")
SCALE = (1e3, 1e3, 1e3, 57.29577951308232, 57.29577951308232, 57.29577951308232)
COLOURS = {"open": "blue", "slip": "yellow", "stick": "green", "not converged": "red"}


def summary_text(report: Mapping[str, Any]) -> str:
    """Print the cases, their largest support load and certificate, and warnings."""
    lines = [click.style(_clean(str(report.get("title") or "no title")), bold=True)]
    lines += [_clean(line) for line in _origin(report.get("origin"))]
    rows = [_summary(name, case) for name, case in report["cases"].items()]
    lines.append(table(("CASE", "ANSWER", "WORST OF CERTIFICATE", "LARGEST SUPPORT LOAD"), rows))
    for name, case in report["cases"].items():
        if case.get("cause"):
            lines.append(click.style(_clean(f"{name}: {case['cause']}"), fg="red"))
        lines += [f"warning: {name}: {_clean(str(text))}" for text in case.get("warnings", [])]
    lines += [f"warning: {_clean(str(text))}" for text in report.get("warnings", [])]
    return "\n".join(lines)


def _origin(stored: Any) -> list[str]:
    """What of a foreign file is not in the numbers, as the run said it."""
    if not stored:
        return []
    try:
        left_out = [LeftOut(x["element"], x["feature"], x["where"]) for x in stored["left_out"]]
        assumed = [Assumption(x["text"], x["where"]) for x in stored["assumed"]]
        origin = Origin(stored["file"], stored["format"], tuple(left_out), tuple(assumed))
    except (KeyError, TypeError):
        return ['its "origin" is not one of trunnion run']
    return origin_lines(origin)


def _summary(name: str, case: Case) -> list[str]:
    worst = (case.get("certificate") or {}).get("worst")
    shown = "-" if worst is None else f"{worst:.1e}"
    if not case["converged"]:
        return [name, "not converged", shown, "-"]
    size, where = max(
        ((sum(x * x for x in s["force"]) ** 0.5, s["id"]) for s in case["supports"]),
        default=(0.0, "no support"),
    )
    return [name, "certified", shown, f"{size:.1f} N at {where}"]


def case_text(name: str, case: Case) -> str:
    """Print one case: supports and displacements."""
    if not case["converged"]:
        return _refused(name, case)
    moved = [[label, *_moves(row)] for label, row in case["nodes"].items()]
    return "\n".join(
        [
            _heading(f"{name} = {case.get('text', '')}: supports, forces on the pipe"),
            _supports(case["supports"]),
            _heading(f"{name}: displacements"),
            table(("NODE", *MOVES), moved),
        ]
    )


def node_text(name: str, case: Case, node: str) -> str:
    """Print what a case says of one node."""
    if not case["converged"]:
        return _refused(name, case)
    # the far end of a bend at 30 is 30F, which 30 means, too
    names = {node, f"{node}F" if f"{node}F" in case["nodes"] else node, node.removesuffix("F")}
    names = {name for name in names if case["nodes"].get(name) == case["nodes"][node]}
    supports = [s for s in case["supports"] if names & {s.get("node"), s.get("cnode")}]
    ends = [
        [f"{element['id']} {side}", *_forces(element[f"force_{side}"])]
        for element in case["elements"]
        for side in ("from", "to")
        if element.get(side) in names
    ]
    lines = [
        _heading(f"{name} = {case.get('text', '')}: node {node}"),
        table(("NODE", *MOVES), [[node, *_moves(case["nodes"][node])]]),
    ]
    if supports:
        lines += [_heading("supports, forces on the pipe"), _supports(supports)]
    if ends:
        lines += [_heading("end forces on the elements"), table(("ELEMENT", *FORCES), ends)]
    return "\n".join(lines)


def _refused(name: str, case: Case) -> str:
    return click.style(_clean(f"{name}: not converged: {case.get('cause')}"), fg="red")


def _heading(text: str) -> str:
    return click.style(_clean(text), bold=True)


def _supports(supports: Iterable[Case]) -> str:
    rows = [
        [
            s["id"],
            str(s.get("name") or s.get("kind") or ""),
            _state(s),
            *_forces(s["force"] + s["moment"]),
        ]
        for s in supports
    ]
    return table(("ID", "SUPPORT", "STATE", *FORCES), rows)


def _state(support: Case) -> str:
    """State of a support, or of its directions where they differ."""
    pairs = [(str(c.get("dir")), str(c.get("state"))) for c in support.get("contacts") or ()]
    return by_state(pairs) or str(support.get("state") or "-")


def _forces(row: Sequence[float]) -> list[str]:
    return [_fixed(x, 1) for x in row]


def _moves(row: Sequence[float]) -> list[str]:
    return [_fixed(x * s, 4) for x, s in zip(row, SCALE, strict=True)]


def _fixed(value: float, digits: int) -> str:
    text = f"{value:.{digits}f}"
    return text[1:] if text.startswith("-") and not float(text) else text


def table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Set columns as wide as they need; words left, numbers right; states in colour."""
    cells = [[_clean(cell) for cell in row] for row in rows]
    wide = [max(map(len, column)) for column in zip(heads, *cells, strict=True)]
    right = [head.endswith("]") for head in heads]

    def line(row: Sequence[str], *, colour: bool) -> str:
        pieces = []
        for cell, width, to_right in zip(row, wide, right, strict=True):
            piece = cell.rjust(width) if to_right else cell.ljust(width)
            paint = COLOURS.get(cell) if colour else None
            pieces.append(click.style(piece, fg=paint) if paint else piece)
        return ("  " + "  ".join(pieces)).rstrip()

    return "\n".join([line(heads, colour=False), *(line(row, colour=True) for row in cells)])


def _clean(text: str) -> str:
    """Keep what a file says from steering the terminal."""
    return "".join(c if c.isprintable() else "?" for c in text)
