"""trunnion check: everything that can be found wrong without solving."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from trunnion.commands.shared import DECK, PERMISSIVE, SOLVED, beside, read_model, say

if TYPE_CHECKING:
    from trunnion.arrays import System
    from trunnion.formats.options import Options


@click.command()
@DECK
@PERMISSIVE
@beside
def check(deck: Path, permissive: bool, options: "Options | None") -> int:
    """Read DECK, look for mechanisms and missing loads; solve and write nothing."""
    from trunnion.cases.default_cases import may_be_free, with_cases
    from trunnion.loads import case_loads, load_sets
    from trunnion.model import Case
    from trunnion.origin import origin_lines, telling
    from trunnion.report.counts import counted
    from trunnion.report.progress import shown
    from trunnion.system import build_system

    with shown(f"checking {deck.name}"):
        read = read_model(deck, permissive=permissive, options=options)
        with telling(read.origin, deck.name):
            model = with_cases(read)
            system = build_system(model)
            sets = load_sets(model, system)
            for case in model.cases:
                if isinstance(case, Case):
                    case_loads(model, system, case, sets)
            if not may_be_free(read):
                _refuse_mechanisms(system)
    counts = (
        (len(system.labels), "node"),
        (len(system.parts), "element"),
        (len(system.cards), "support"),
        (len(model.cases), "case"),
    )
    if read.origin is not None:
        say("\n".join(origin_lines(read.origin)))
    say(f"{deck.name}: no errors; " + ", ".join(counted(n, what) for n, what in counts))
    return SOLVED


def _refuse_mechanisms(system: "System") -> None:
    """Refuse a structure that moves freely even with every contact closed."""
    from trunnion.errors import ModelError, Problem
    from trunnion.solver.ledger import Ledger
    from trunnion.solver.mechanism import structural_motions
    from trunnion.solver.structure import Structure

    motions = structural_motions(Structure(system, Ledger()))
    if motions:
        raise ModelError([Problem("structure", motion.text) for motion in motions])
