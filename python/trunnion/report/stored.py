"""Tables of a stored result for the terminal: supports' forces on the pipe, in N or as asked for.

click strips the colours where the output is no terminal.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import click

from trunnion.frozen import frozen
from trunnion.model import Units
from trunnion.origin import Assumption, LeftOut, Origin, origin_lines
from trunnion.report.units import Quantity, ReportUnits, report_units
from trunnion.results.supports import by_state

Case = Mapping[str, Any]
SI = report_units(Units())
COLOURS = {"open": "blue", "slip": "yellow", "stick": "green", "not converged": "red"}


@frozen
class Look:
    """Units of the tables, and columns of a terminal; a pipe has room for all."""

    units: ReportUnits = SI
    width: int | None = None

    @property
    def forces(self) -> list[str]:
        """Heads of forces and moments."""
        u = self.units
        return [f"{c} [{q.unit}]" for q, of in ((u.force, "F"), (u.moment, "M")) for c in _xyz(of)]

    @property
    def moves(self) -> list[str]:
        """Heads of movements and rotations."""
        u = self.units
        return [
            f"{c} [{q.unit}]" for q, of in ((u.movement, "D"), (u.rotation, "R")) for c in _xyz(of)
        ]


def _xyz(of: str) -> list[str]:
    return [f"{of}{axis}" for axis in "XYZ"]


def summary_text(report: Mapping[str, Any], look: Look) -> str:
    """Print the cases, their largest support load and certificate, and warnings."""
    lines = [click.style(_clean(str(report.get("title") or "no title")), bold=True)]
    lines += [_clean(line) for line in _origin(report.get("origin"))]
    rows = [_summary(name, case, look) for name, case in report["cases"].items()]
    lines.append(
        table(("CASE", "ANSWER", "WORST OF CERTIFICATE", "LARGEST SUPPORT LOAD"), rows, look)
    )
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


def _summary(name: str, case: Case, look: Look) -> list[str]:
    worst = (case.get("certificate") or {}).get("worst")
    shown = "-" if worst is None else f"{worst:.1e}"
    if not case["converged"]:
        return [name, "not converged", shown, "-"]
    size, where = max(
        ((sum(x * x for x in s["force"]) ** 0.5, s["id"]) for s in case["supports"]),
        default=(0.0, "no support"),
    )
    force = look.units.force
    load = f"{_fixed(size * force.factor, _decimals(force))} {force.unit} at {where}"
    return [name, "certified", shown, load]


def case_text(name: str, case: Case, look: Look) -> str:
    """Print one case: supports and displacements."""
    if not case["converged"]:
        return _refused(name, case)
    moved = [[label, *_moves(row, look)] for label, row in case["nodes"].items()]
    return "\n".join(
        [
            _heading(f"{name} = {case.get('text', '')}: supports, forces on the pipe"),
            _supports(case["supports"], look),
            _heading(f"{name}: displacements"),
            table(("NODE", *look.moves), moved, look),
        ]
    )


def node_text(name: str, case: Case, node: str, look: Look) -> str:
    """Print what a case says of one node."""
    if not case["converged"]:
        return _refused(name, case)
    # the far end of a bend at 30 is 30F, which 30 means, too
    names = {node, f"{node}F" if f"{node}F" in case["nodes"] else node, node.removesuffix("F")}
    names = {name for name in names if case["nodes"].get(name) == case["nodes"][node]}
    supports = [s for s in case["supports"] if names & {s.get("node"), s.get("cnode")}]
    ends = [
        [f"{element['id']} {side}", *_forces(element[f"force_{side}"], look)]
        for element in case["elements"]
        for side in ("from", "to")
        if element.get(side) in names
    ]
    lines = [
        _heading(f"{name} = {case.get('text', '')}: node {node}"),
        table(("NODE", *look.moves), [[node, *_moves(case["nodes"][node], look)]], look),
    ]
    if supports:
        lines += [_heading("supports, forces on the pipe"), _supports(supports, look)]
    if ends:
        lines += [
            _heading("end forces on the elements"),
            table(("ELEMENT", *look.forces), ends, look),
        ]
    return "\n".join(lines)


def _refused(name: str, case: Case) -> str:
    return click.style(_clean(f"{name}: not converged: {case.get('cause')}"), fg="red")


def _heading(text: str) -> str:
    return click.style(_clean(text), bold=True)


def _supports(supports: Iterable[Case], look: Look) -> str:
    rows = [
        [
            s["id"],
            str(s.get("name") or s.get("kind") or ""),
            _state(s),
            *_forces(s["force"] + s["moment"], look),
        ]
        for s in supports
    ]
    return table(("ID", "SUPPORT", "STATE", *look.forces), rows, look)


def _state(support: Case) -> str:
    """State of a support, or of its directions where they differ."""
    pairs = [(str(c.get("dir")), str(c.get("state"))) for c in support.get("contacts") or ()]
    return by_state(pairs) or str(support.get("state") or "-")


def _forces(row: Sequence[float], look: Look) -> list[str]:
    """Write forces and moments."""
    units = [look.units.force] * 3 + [look.units.moment] * 3
    return [_fixed(x * q.factor, _decimals(q)) for x, q in zip(row, units, strict=True)]


def _decimals(force: Quantity) -> int:
    """Decimals of a force: as many digits in kN as in N."""
    return 1 if force.factor > 0.01 else 4


def _moves(row: Sequence[float], look: Look) -> list[str]:
    units = [look.units.movement] * 3 + [look.units.rotation] * 3
    return [
        _fixed(x * q.factor, 4 if q.unit != "in" else 5) for x, q in zip(row, units, strict=True)
    ]


def _fixed(value: float, digits: int) -> str:
    text = f"{value:.{digits}f}"
    return text[1:] if text.startswith("-") and not float(text) else text


def table(heads: Sequence[str], rows: Sequence[Sequence[str]], look: Look) -> str:
    """Set columns as wide as they need; words left, numbers right; states in colour.

    What a terminal has no room for goes below, behind the first column once more.
    """
    cells = [[_clean(cell) for cell in row] for row in rows]
    wide = [max(map(len, column)) for column in zip(heads, *cells, strict=True)]
    kept = list(range(len(heads)))
    more: list[int] = []
    while look.width is not None and len(kept) > 2 and sum(wide[i] + 2 for i in kept) > look.width:
        more.insert(0, kept.pop())
    if more:
        parts = (kept, [0, *more])
        return "\n".join(
            table([heads[i] for i in part], [[row[i] for i in part] for row in rows], look)
            for part in parts
        )
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
