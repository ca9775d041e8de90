"""Tables of restraints: loads of all cases in rows, extremes with their cases, spring hangers."""

from collections.abc import Sequence

import numpy as np

from trunnion.arrays import F8, CaseResult
from trunnion.report.restraints import NOTE, hanger_loads
from trunnion.report.sheets import DIRECTIONS, LOADS, Cell, Column, Sheet, amounts, six
from trunnion.report.units import ReportUnits
from trunnion.results.supports import (
    card_forces,
    card_friction,
    card_loads,
    card_nodes,
    card_normals,
    card_states,
    direction_states,
    solved,
)
from trunnion.results.supports import envelope as extremes


def restraints(cases: Sequence[CaseResult], units: ReportUnits) -> Sheet:
    """Loads on every restraint, one row a case, with the movement of the pipe there."""
    cards, n = cases[0].system.cards, len(cases)
    node = card_nodes(cases[0].system)
    load = _by_card([card_loads(case) for case in cases])
    move = _by_card([solved(case).u[node, :3] for case in cases])
    normal = _by_card([card_normals(case) for case in cases])
    rubbing = _by_card([np.linalg.norm(card_friction(case), axis=1) for case in cases])
    states = [state for row in zip(*map(card_states, cases), strict=True) for state in row]
    apart = [text for row in zip(*map(direction_states, cases), strict=True) for text in row]
    force = units.force.showing(float(np.abs(load[:, :3]).max(initial=0.0)))
    d = units.movement.showing(float(np.abs(move).max(initial=0.0)))
    columns = [
        Column("RESTRAINT", [card.name for card in cards for _ in cases]),
        Column("NODE", [card.label for card in cards for _ in cases]),
        Column("CASE", [case.name for case in cases] * len(cards)),
        Column("STATE", states),
        *six(LOADS, load, units.force, units.moment),
        amounts("NORMAL", normal, force),
        amounts("FRICTION", rubbing, force),
        *(amounts(f"D{axis}", move[:, i], d) for i, axis in enumerate(DIRECTIONS)),
        Column("DIRECTIONS", apart),
    ]
    note = f"{NOTE}; DIRECTIONS where their states differ; NORMAL is the size without friction"
    return Sheet("restraints", "Restraint loads", note, columns, keys=3, groups=n > 1)


def _by_card(values: Sequence[F8]) -> F8:
    """Rows of (n_card, ...) of each case: the cases of the first card, of the second ..."""
    both = np.stack(values, axis=1)
    return both.reshape(-1, *both.shape[2:])


def envelope(cases: Sequence[CaseResult], units: ReportUnits) -> Sheet:
    """Largest and smallest of each load on every restraint, and the cases they come from."""
    cards, found = cases[0].system.cards, extremes(cases)  # on the pipe
    values = _by_card([-found.lowest, -found.highest])
    which = np.stack([found.lowest_case, found.highest_case], axis=1).reshape(-1, 6)
    names: list[Cell] = [*(case.name for case in cases), None]  # -1: no case
    columns = [
        Column("RESTRAINT", [card.name for card in cards for _ in range(2)]),
        Column("NODE", [card.label for card in cards for _ in range(2)]),
        Column("EXTREME", ["MAX", "MIN"] * len(cards)),
        *six(LOADS, values, units.force, units.moment),
        *(
            Column(f"CASE {head}", [names[j] for j in which[:, i].tolist()])
            for i, head in enumerate(LOADS)
        ),
    ]
    note = "forces and moments ON THE RESTRAINT, global; the case that each comes from"
    return Sheet("envelope", "Extremes of restraint loads", note, columns, keys=3, groups=True)


def hangers(cases: Sequence[CaseResult], units: ReportUnits) -> Sheet:
    """Load and travel of the spring hangers."""
    node = card_nodes(cases[0].system)
    force = np.stack([card_forces(case) for case in cases], axis=1)
    move = np.stack([solved(case).u[node, :3] for case in cases], axis=1)
    found = hanger_loads(cases, -force, move)
    q = units.force.showing(float(np.abs(found.load).max(initial=0.0)))
    columns = [
        Column("HANGER", found.names),
        Column("CASE", found.cases),
        amounts("COLD LOAD", found.cold, q),
        amounts("LOAD", found.load, q),
        amounts("TRAVEL UP", found.travel, units.movement),
        Column("CHANGE", [None if np.isnan(x) else x for x in found.change.tolist()], "%", 1),
    ]
    note = "upward on the pipe; change from the cold load"
    return Sheet("hangers", "Spring hangers", note, columns, keys=2, groups=True)
