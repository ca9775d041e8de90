"""The summary on the terminal: cases, certificate, worst support, warnings, on one screen.

What does not fit is counted and stands in the report.  Colours are for terminals: click takes
them out of what is piped.
"""

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass

import click

from trunnion.arrays import OPEN, CaseResult, Results
from trunnion.frozen import frozen
from trunnion.model import Model
from trunnion.origin import origin_lines
from trunnion.report.causes import told_cause
from trunnion.report.columns import PAGE
from trunnion.report.counts import counted
from trunnion.report.frozen import frozen_warning
from trunnion.report.loops import cycle_lines, cycle_warnings
from trunnion.report.modes import mode_lines, mode_warnings
from trunnion.report.screen_table import case_table
from trunnion.report.summary import Largest, largest_of
from trunnion.report.units import ReportUnits, report_units
from trunnion.results.supports import card_ids, card_levels, is_good, lifted_rests

MOST, LOW = 2, 20  # lines of a message on a terminal; one where this has fewer than LOW
LABEL = 15  # characters before a verdict
NAMED = 40  # supports named in a line, before it is cut to its width


@frozen
class Room:
    """What the summary may take; without `lines` it has no end and messages are not broken."""

    columns: int
    lines: int | None = None

    @property
    def most(self) -> int:
        """Lines of a message."""
        return MOST if self.lines is None or self.lines >= LOW else 1


SCREEN, PIPE = Room(80, 24), Room(PAGE)
FEWEST = 8  # lines that a summary has on any terminal


@dataclass(slots=True)
class Block:
    """Entries of one kind, a list of lines each; at least so many of them are shown."""

    entries: list[list[str]]
    least: int = 1
    more: str = ""  # what the entries are, where some are left out
    shown: int = 0

    def lines(self) -> list[str]:
        """Give the lines of the entries that are shown, and count the others."""
        left = len(self.entries) - self.shown
        kept = [line for entry in self.entries[: self.shown] for line in entry]
        return [*kept, f"  ... and {left} more {self.more} in the report"] if left else kept


def screen(results: Results, model: Model, room: Room = SCREEN) -> tuple[bool, str]:
    """Tell whether every case is certified, and the text to print."""
    cases, units = results.cases, report_units(model.units)
    bad = [name for name, case in cases.items() if not is_good(case)]
    broken = [name for name, cycle in results.cycles.items() if cycle.cause]
    order = bad + [name for name in cases if name not in bad]
    head, rows = case_table([cases[name] for name in order], units, room.columns)
    lines = [mode.strip() for mode in mode_lines(results) + cycle_lines(results, units)]
    if results.spreads:
        from trunnion.report.spread import spread_lines

        lines += [line.strip() for line in spread_lines(results, units)]
    causes = [f"{name}: {told_cause(cases[name], units)}" for name in bad]
    warnings = [f"warning: {text}" for text in all_warnings(results, units)]
    source = [] if model.origin is None else origin_lines(model.origin)
    blocks = [
        Block([[_title(results, room)]] if results.title else []),
        Block(messages(source, room), 2, "of these"),
        Block([[head]]),
        Block([[row] for row in rows], 3, "cases"),
        Block(_verdicts(results, bad, units, room), 3, "lines"),
        Block(messages(lines, room), 1, "lines"),
        Block(messages(causes, room, fg="red"), 2, "causes"),
        Block(messages(warnings, room, fg="yellow"), 2, "warnings"),
    ]
    _fit(blocks, room)
    return not bad and not broken, "\n".join(line for block in blocks for line in block.lines())


def _fit(blocks: Sequence[Block], room: Room) -> None:
    """Leave entries out, of the longest block first, until all fit the room."""
    for block in blocks:
        block.shown = len(block.entries)
    if room.lines is None:
        return
    space = max(room.lines, FEWEST)
    while sum(len(block.lines()) for block in blocks) > space:
        spare = [block.shown - block.least for block in blocks]
        i = max(range(len(blocks)), key=lambda i: spare[i])
        if spare[i] <= 0:
            return
        blocks[i].shown -= 2 if blocks[i].shown == len(blocks[i].entries) and spare[i] > 1 else 1


def _title(results: Results, room: Room) -> str:
    text = results.title
    if room.lines is not None and len(text) > room.columns:
        text = text[: room.columns - 1] + "~"
    return click.style(text, bold=True)


def messages(texts: Sequence[str], room: Room, fg: str | None = None) -> list[list[str]]:
    """Break messages at the width of a terminal, in one line or two; a pipe gets them whole.

    A message keeps what it is indented by.
    """
    found = []
    for text in texts:
        lines = [f"  {text}"]
        if room.lines is not None:
            own = " " * (len(text) - len(text.lstrip()) + 2)
            lines = textwrap.wrap(
                text.lstrip(),
                max(room.columns, 20),
                initial_indent=own,
                subsequent_indent=f"{own}  ",
                max_lines=room.most,
                placeholder=" ...",
            )
        found.append([click.style(line, fg=fg) if fg else line for line in lines])
    return found


# ------------------------------------------------------------------ verdicts
def _verdicts(results: Results, bad: list[str], units: ReportUnits, room: Room) -> list[list[str]]:
    """Certificate, worst support and supports that carry nothing, an entry each."""
    cases = list(results.cases.values())
    good = [case for case in cases if is_good(case)]
    entries = [_labelled("certificate", _certificate(cases, bad), room, "red" if bad else "green")]
    found = {"worst support": _worst_support(good, units), "lifted off": _lifted(good)}
    for label, text in (found | {"open": _open(good)}).items():
        if text:
            entries.append(_labelled(label, text, room))
    return entries


def _labelled(label: str, text: str, room: Room, fg: str | None = None) -> list[str]:
    """Set a text behind its label, in one line of a terminal or two."""
    lines = [text]
    if room.lines is not None:
        wide = max(room.columns - LABEL - 2, 20)
        lines = textwrap.wrap(text, wide, max_lines=room.most, placeholder=" ...")
    labels = [click.style(label.ljust(LABEL), bold=True), *[" " * LABEL] * (len(lines) - 1)]
    return [f"  {a}{click.style(b, fg=fg)}" for a, b in zip(labels, lines, strict=True)]


def _certificate(cases: Sequence[CaseResult], bad: list[str]) -> str:
    """Say how many cases are certified, and the worst item of all certificates."""
    n = len(cases)
    if not n:
        return "no cases"
    if bad:
        return f"{len(bad)} of {counted(n, 'case')} NOT certified: no numbers, causes below"
    worst, where, name = max(
        (c.certificate.worst, c.certificate.where, c.name) for c in cases if c.certificate
    )
    all_ = {1: "the case is", 2: "both cases are"}.get(n, f"all {n} cases are")
    return f"{all_} certified, worst {worst:.1e} of 1e-9 ({where} in {name})"


def _worst_support(cases: Sequence[CaseResult], units: ReportUnits) -> str:
    """Name the restraint with the largest force of all cases."""
    found: list[tuple[Largest, str]] = [(largest_of(case), case.name) for case in cases]
    found = [(most, name) for most, name in found if most.support is not None]
    if not found:
        return ""
    most, name = max(found, key=lambda pair: pair[0].load)
    amount = units.force.showing(most.load).text(most.load)
    return f"{most.support} carries {amount} {units.force.unit} in {name}"


def _open(cases: Sequence[CaseResult]) -> str:
    """Name the supports that are open in the case that has most of them."""
    opened: list[tuple[CaseResult, list[int]]] = []
    for case in cases:
        if case.gathered is None and case.kind == "case":
            levels = card_levels(case).tolist()
            opened.append((case, [i for i, level in enumerate(levels) if level == OPEN]))
    if not any(at for _, at in opened):
        return ""
    case, at = max(opened, key=lambda entry: len(entry[1]))
    ids = card_ids(case.system.cards)
    named = " ".join(ids[i] for i in at[:NAMED]) + (" ..." if len(at) > NAMED else "")
    return f"{len(at)} of {counted(len(ids), 'support')} in {case.name}: {named}"


def _lifted(cases: Sequence[CaseResult]) -> str:
    """Name the rests that the pipe has lifted off in every case, most of them first."""
    lifted: dict[tuple[str, ...], list[str]] = {}
    for case in cases:
        if case.gathered is None and case.kind == "case":
            ids, contacts = card_ids(case.system.cards), case.system.contacts
            at = lifted_rests(case)
            rests = tuple(f"{ids[contacts.card[i]]} {contacts.word[i]}" for i in at)
            if rests:
                lifted.setdefault(rests, []).append(case.name)
    entries = sorted(lifted.items(), key=lambda entry: -len(entry[0]))
    return "; ".join(
        f"in {', '.join(names)}: {', '.join(rests[:NAMED])}{' ...' * (len(rests) > NAMED)}"
        for rests, names in entries
    )


def all_warnings(results: Results, units: ReportUnits) -> list[str]:
    """Every warning of a run and of its cases, modes and cycles."""
    warnings = list(results.warnings)
    cases = results.cases.values()
    warnings += [f"{case.name}: {text}" for case in cases for text in case.warnings]
    warnings += [text for case in cases for text in frozen_warning(case, units)]
    return warnings + mode_warnings(results) + cycle_warnings(results, units)
