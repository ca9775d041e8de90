"""The summary of a batch: a table for the screen, JSON and CSV for programs."""

from collections.abc import Sequence

from trunnion.many.records import Entry, summary_of
from trunnion.report.columns import integers, table, without, words
from trunnion.report.counts import counted
from trunnion.report.csv import csv_bytes
from trunnion.report.encode import dump
from trunnion.report.screen import PIPE, Room, messages
from trunnion.report.sheets import Cell

CAUSES = 6  # of a deck on the screen
DROPPED = ("WARNINGS", "WORST", "NOTE", "GOOD", "CASES")  # a narrow terminal goes without
LEAST = 16  # characters of DECK and STATUS there


def summary_json(entries: Sequence[Entry]) -> bytes:
    """Write the summary file: a deck a line; the same however the batch was run."""
    counts = {status: sum(e.status == status for e in entries) for status in _statuses(entries)}
    head = f'{{"schema":1,"decks":{len(entries)},"status":{dump(counts)},"entries":[\n'
    return (head + ",\n".join(dump(summary_of(e)) for e in entries) + "\n]}\n").encode()


def summary_csv(entries: Sequence[Entry]) -> bytes:
    """Write one row a case; a deck without cases has one of its own."""
    rows: list[list[Cell]] = [
        ["deck", "status", "case", "kind", "converged", "certificate", "cause"]
    ]
    for e in entries:
        if not e.cases:
            rows.append([e.deck, e.status, "", "", "", "", "; ".join(e.causes)])
        for c in e.cases:
            worst = "" if c.worst is None else f"{c.worst:.3g}"
            rows.append([e.deck, e.status, c.name, c.kind, int(c.converged), worst, c.cause or ""])
    return csv_bytes(rows)


def summary_screen(entries: Sequence[Entry], room: Room = PIPE) -> str:
    """Print the table of all decks, then every failure with its causes, then the counts.

    A narrow terminal goes without columns; messages are broken at its width.
    """
    worst = [max((c.worst for c in e.cases if c.worst is not None), default=None) for e in entries]
    good = [sum(c.converged for c in e.cases) for e in entries]
    told = [_note(e) for e in entries]
    columns = without(
        [
            words("DECK", [e.deck for e in entries], least=10, most=48),
            words("STATUS", [e.status for e in entries], least=14),
            integers("CASES", [len(e.cases) for e in entries]),
            integers("GOOD", good),
            words("  WORST", ["" if w is None else f"  {w:.1e}" for w in worst], least=10),
            integers("WARNINGS", [e.warnings for e in entries], 9),
            *([words("  NOTE", [f"  {note}" for note in told])] if any(told) else []),
        ],
        room.columns,
        DROPPED,
        LEAST,
    )
    text = table(columns, none="no decks", width=room.columns)
    notes = [f"{e.deck}: {note}" for e in entries for note in e.notes]
    if notes:
        text += "\nNOTES\n" + _lines(notes, room)
    lacking = [_lacks(e) for e in entries if e.left_out]
    if lacking:
        text += "\nLEFT OUT, the first of each; all of it is on top of the reports\n" + _lines(
            lacking, room
        )
    failures = [e for e in entries if e.code]
    if failures:
        text += "\nFAILURES\n" + "".join(_failure(entry, room) for entry in failures)
    counts = [f"{sum(e.status == s for e in entries)} {s}" for s in _statuses(entries)]
    skipped = sum(e.skipped for e in entries)
    counts += [f"{skipped} of them finished before"] * bool(skipped)
    return f"{text}\n{counted(len(entries), 'deck')}: {', '.join(counts)}"


def entry_line(entry: Entry) -> str:
    """Sum up one deck in a line, for progress without a bar."""
    more = f": {entry.causes[0]}" if entry.causes else ""
    return f"{entry.deck} {entry.status}{more}"


def _statuses(entries: Sequence[Entry]) -> list[str]:
    """Statuses that occur, the best first."""
    return [status for _, status in sorted({(e.code, e.status) for e in entries})]


def _note(entry: Entry) -> str:
    return "finished before" if entry.skipped else "see below" if entry.notes else ""


def _lacks(entry: Entry) -> str:
    more = f" ... and {len(entry.left_out) - 1} more" if len(entry.left_out) > 1 else ""
    return f"{entry.deck}: {entry.left_out[0]}{more}"


def _failure(entry: Entry, room: Room) -> str:
    lines = [f"{entry.deck}: {entry.status}"]
    lines += [f"  {cause}" for cause in entry.causes[:CAUSES]]
    if len(entry.causes) > CAUSES:
        lines.append(f"  ... and {len(entry.causes) - CAUSES} more")
    return _lines(lines, room)


def _lines(texts: Sequence[str], room: Room) -> str:
    return "".join(f"{line}\n" for entry in messages(texts, room) for line in entry)
