"""Loads on restraints across all cases: what each support gets, and where it is largest."""

from collections.abc import Sequence

import numpy as np

from trunnion.arrays import F8, CaseResult
from trunnion.frozen import frozen
from trunnion.report.columns import Column, headings, numbers, plain, section, table, words, wrapped
from trunnion.report.units import ReportUnits
from trunnion.results.supports import (
    card_loads,
    card_nodes,
    card_states,
    envelope,
    solved,
    without_sign,
)

NOTE = "forces and moments ON THE RESTRAINT, global; movements of the pipe at the node"
COMPONENTS = ("FX", "FY", "FZ", "MX", "MY", "MZ")


def restraint_summary(
    cases: Sequence[CaseResult], units: ReportUnits, increments: Sequence[str] = ()
) -> str:
    """Print a block for every support: one row a case, then the envelope with its cases.

    `increments` are the names of cases about another, which are no totals.
    """
    if not cases or not cases[0].system.cards:
        return "\n  none\n"
    system = cases[0].system
    force = np.stack([card_loads(case) for case in cases], axis=1)  # (n_card, n_case, 6)
    node = card_nodes(system)
    move = np.stack([solved(case).u[node, :3] for case in cases], axis=1)
    text = section("LARGEST OF ALL") + _largest_of_all(cases, force, units)
    text += section("EVERY RESTRAINT", NOTE) + _signless(cases)
    if increments:
        text += wrapped(f"increments about another case, not totals: {', '.join(increments)}")
    text += _blocks(cases, force, move, units)
    return text + _hangers(cases, force, move, units)


def _signless(cases: Sequence[CaseResult]) -> str:
    """Name the cases whose numbers are sizes."""
    names = [case.name for case in cases if without_sign(case).any()]
    if not names:
        return ""
    return wrapped(f"sizes without sign, which MAX and MIN count both ways: {', '.join(names)}")


def _quantities(force: F8, move: F8, units: ReportUnits) -> list[Column]:
    """Columns of all rows together, so that they share decimals and width."""
    q = units.force.showing(float(np.abs(force[..., :3]).max()))
    m = units.moment.showing(float(np.abs(force[..., 3:]).max()))
    d = units.movement.showing(float(np.abs(move).max()))
    rows_f, rows_d = force.reshape(-1, 6), move.reshape(-1, 3)
    columns = [numbers(COMPONENTS[i], rows_f[:, i], m if i > 2 else q, 12) for i in range(6)]
    return columns + [numbers(f"D{'XYZ'[i]}", rows_d[:, i], d, 10) for i in range(3)]


def _blocks(cases: Sequence[CaseResult], force: F8, move: F8, units: ReportUnits) -> str:
    cards, n_case = cases[0].system.cards, len(cases)
    found = envelope(cases)  # on the pipe
    extreme = -np.stack([found.lowest, found.highest], axis=1)
    which = np.stack([found.lowest_case, found.highest_case], axis=1)
    several = n_case > 1
    if several:
        force = np.concatenate([force, extreme], axis=1)
        move = np.concatenate([move, np.zeros((len(cards), 2, 3))], axis=1)
    columns = _quantities(force, move, units)
    nothing = 1e-5 * np.repeat([np.abs(half).max() for half in np.split(force, 2, axis=2)], 3)
    which[np.abs(extreme) <= nothing] = -1
    rows = list(zip(*(c.cells for c in columns), strict=True))
    per = len(rows) // len(cards)
    states = list(zip(*(card_states(case) for case in cases), strict=True))
    names = [case.name for case in cases]
    governing = [*names, "-"]  # -1: none
    head = [words("CASE", names, least=12, most=12), words("STATE", ["engaged"], least=9)]
    row = "  " + "".join(c.form for c in head + columns) + "\n"
    top = "  " + head[0].form + head[1].form + "".join(c.form for c in columns[:6]) + "\n"
    where = "  " + head[0].form + head[1].form + "%12.11s" * 6 + "\n"
    out = [headings([*head, *columns])]
    for i, card in enumerate(cards):
        place = f"   line {card.line}" if card.line else ""
        out.append(f"  {card.name}{place}\n")
        own = rows[i * per : i * per + n_case]
        for name, state, values in zip(names, states[i], own, strict=True):
            out.append(row % (name, state or "", *values))
        for k, word in enumerate(("MAX", "MIN") if several and (which[i] >= 0).any() else ()):
            out.append(top % (word, "", *rows[i * per + n_case + k][:6]))
            out.append(where % ("", "", *(governing[j] for j in which[i, k].tolist())))
    return "".join(out)


def _largest_of_all(cases: Sequence[CaseResult], force: F8, units: ReportUnits) -> str:
    """Name support and case of the largest of each component."""
    cards = cases[0].system.cards
    flat = force.reshape(-1, 6)
    worst = np.abs(flat).argmax(axis=0).tolist()
    values = [float(flat[row, i]) for i, row in enumerate(worst)]
    small = [1e-5 * max(map(abs, half)) for half in (values[:3], values[3:])]
    there = [abs(value) > small[i // 3] for i, value in enumerate(values)]
    q = units.force.showing(max(map(abs, values[:3])))
    m = units.moment.showing(max(map(abs, values[3:])))
    shown = [v * (m if i > 2 else q).factor for i, v in enumerate(values)]
    columns = [
        words("", COMPONENTS, least=4),
        plain("LARGEST", shown, max(q.decimals, m.decimals), 14),
        words("  UNIT", [f"  {(m if i > 2 else q).unit}" for i in range(6)], least=9),
        words("CASE", _where([cases[row % len(cases)].name for row in worst], there), least=12),
        words(
            "RESTRAINT", _where([cards[row // len(cases)].name for row in worst], there), most=60
        ),
    ]
    return table(columns)


def _where(names: list[str], there: list[bool]) -> list[str]:
    """Leave out the place of what is nothing."""
    return [name if yes else "-" for name, yes in zip(names, there, strict=True)]


@frozen(eq=False)
class HangerLoads:
    """Spring hangers in every solved case, one row a hanger and case.

    cold, load : (n,) upward on the pipe [N].
    travel : (n,) upward [m].
    change : (n,) of the load from the cold load [%]; NaN where the case has none.
    """

    names: list[str]
    cases: list[str]
    cold: F8
    load: F8
    travel: F8
    change: F8


def hanger_loads(cases: Sequence[CaseResult], force: F8, move: F8) -> HangerLoads:
    """Gather the spring hangers.

    Parameters
    ----------
    force : (n_card, n_case, 6) on the restraints [N, N m].
    move : (n_card, n_case, 3) of the pipe [m].
    """
    cards, up = cases[0].system.cards, cases[0].system.up
    at = [i for i, card in enumerate(cards) if card.kind == "hanger"]
    rows = [(i, j, case) for i in at for j, case in enumerate(cases) if case.kind == "case"]
    load = np.array([-force[i, j, :3] @ up for i, j, _ in rows])
    cold = np.array([case.loads.preload[i] if case.loads else 0.0 for i, _, case in rows])
    return HangerLoads(
        names=[cards[i].name for i, _, _ in rows],
        cases=[case.name for _, _, case in rows],
        cold=cold,
        load=load,
        travel=np.array([move[i, j] @ up for i, j, _ in rows]),
        change=100.0
        * np.divide(load - cold, cold, out=np.full(len(cold), np.nan), where=cold != 0.0),
    )


def _hangers(cases: Sequence[CaseResult], force: F8, move: F8, units: ReportUnits) -> str:
    """Print load and travel of the spring hangers; CHANGE is that from the cold load, of it."""
    if all(card.kind != "hanger" for card in cases[0].system.cards):
        return ""
    found = hanger_loads(cases, force, move)
    columns = [
        words("HANGER", found.names),
        words("CASE", found.cases, least=12),
        numbers("COLD LOAD", found.cold, units.force, 12),
        numbers("LOAD", found.load, units.force, 12),
        numbers("TRAVEL UP", found.travel, units.movement, 12),
        plain("CHANGE", found.change, 1, 10, "[%]"),
    ]
    note = "upward on the pipe; change from the cold load"
    return section("SPRING HANGERS", note) + table(columns)
