"""trunnion show: tables of a stored result on the terminal."""

from pathlib import Path
from typing import Any

import click

from trunnion.commands.shared import SOLVED, InputError, say


@click.command()
@click.argument("results", type=click.Path(path_type=Path))
@click.option("--case", "name", help="Only this case.")
@click.option("--node", help="One node: displacements, supports, forces at its ends.")
def show(results: Path, name: str | None, node: str | None) -> int:
    """Print a summary of RESULTS.json, one case, or one node. Units are SI."""
    from trunnion.compare.stored import read_report
    from trunnion.report.stored import case_text, node_text, summary_text

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
        text = "\n".join(node_text(key, case, node) for key, case in cases.items())
    elif name is not None:
        text = case_text(name, cases[name])
    else:
        text = summary_text(report)
    say(text)
    return SOLVED
