"""trunnion show: tables of a stored result on the terminal."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from trunnion.commands.shared import SOLVED, InputError, room, say

if TYPE_CHECKING:
    from trunnion.report.stored import Look


@click.command()
@click.argument("results", type=click.Path(path_type=Path))
@click.option("--case", "name", help="Only this case.")
@click.option("--node", help="One node: displacements, supports, forces at its ends.")
@click.option(
    "--units", metavar='"LENGTH FORCE"', help='As on a UNITS card: "in lbf".  [mm N; moments N m]'
)
def show(results: Path, name: str | None, node: str | None, units: str | None) -> int:
    """Print a summary of RESULTS.json, one case, or one node."""
    from trunnion.compare.stored import read_report
    from trunnion.report.stored import case_text, node_text, summary_text

    look = _look(units)
    report = read_report(results)
    cases: dict[str, Any] = report["cases"]
    if name is not None:
        name = name.upper()
        if name not in cases:
            raise InputError(f"{results.name}: no case {name}; there are {' '.join(cases)}")
        cases = {name: cases[name]}
    if node is not None:
        node = node.upper()
        good = [case for case in cases.values() if case["converged"]]
        if good and not any(node in case["nodes"] for case in good):
            raise InputError(f"{results.name}: no node {node}")
        text = "\n".join(node_text(key, case, node, look) for key, case in cases.items())
    elif name is not None:
        text = case_text(name, cases[name], look)
    else:
        text = summary_text(report, look)
    say(text)
    return SOLVED


def _look(units: str | None) -> "Look":
    """Units as the user wants them, and the room of a terminal."""
    from trunnion.deck.units import FORCES, LENGTHS
    from trunnion.model import Units
    from trunnion.report.stored import Look
    from trunnion.report.units import report_units

    space = room(0)
    width = None if space.lines is None else space.columns
    if units is None:
        return Look(width=width)
    found = [
        next((name for name in table if name.lower() == word.lower()), None)
        for word, table in zip(units.split(), (LENGTHS, FORCES), strict=False)
    ]
    if len(units.split()) != 2 or None in found:
        said = f"one of {' '.join(LENGTHS)}, then one of {' '.join(FORCES)}"
        raise InputError(f"--units {units}: write a length and a force: {said}")
    length, force = (str(name) for name in found)
    return Look(report_units(Units(length, force)), width)
