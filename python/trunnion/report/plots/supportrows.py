"""Rows of the table beside the restraints: each direction word, or each card, with its numbers."""

from dataclasses import replace
from math import floor, log10

import numpy as np

from trunnion.arrays import CaseResult
from trunnion.frozen import frozen
from trunnion.report.plots.palette import NO_STATE, STATES, Look
from trunnion.report.states import SHOWN, state_rows
from trunnion.report.units import Quantity, ReportUnits
from trunnion.results.supports import STATES as WORDS
from trunnion.results.supports import card_levels, card_loads, card_normals, without_sign

ROUND_OFF = 1e-9  # of the largest moment or force: no row for less


@frozen(eq=False)
class Row:
    """One line: its name, its look, its cells as they are written, its size for the choice [N]."""

    name: str
    look: Look
    cells: tuple[str, ...]
    load: float


def rows_of_states(case: CaseResult, units: ReportUnits) -> list[tuple[int, Row]]:
    """Direction words as in the text report; anchors and springs, always engaged, as cards.

    These have a row for the size of their force and one for that of their moment.

    Each row comes with the number of its card.
    """
    rows, system = state_rows(case), case.system
    levels, normals = card_levels(case), card_normals(case)
    moments = np.linalg.norm(card_loads(case)[:, 3:], axis=1)
    m = showing(units.moment, float(moments.max(initial=0.0)))
    known = np.nan_to_num(np.where(rows.turning > 0.0, 0.0, rows.normal))
    q = showing(units.force, float(max(known.max(initial=0.0), normals.max(initial=0.0))))
    found: list[tuple[int, Row]] = []
    for i in rows.order.tolist():
        card = system.cards[int(rows.card[i])]
        if card.kind not in SHOWN:
            continue
        normal, used = float(rows.normal[i]), float(rows.used[i])
        look = STATES[WORDS[int(rows.level[i])]]
        if rows.turning[i]:
            force, load = f"{units.moment.text(normal)} {units.moment.unit}", 0.0
        else:
            force, load = q.text(normal), float(np.nan_to_num(normal))
        cells = (
            look.text.removeprefix("snubber "),
            force if normal > 0.0 else "",
            "" if np.isnan(used) else f"{used:.3f}",
        )
        name = f"{card.label} {rows.word[i]}" if card.kind != "hanger" else card.name
        name = f"{name} snubber" if card.kind == "snubber" else name
        found.append((int(rows.card[i]), Row(name, look, cells, load)))
    for i, card in enumerate(system.cards):
        if card.kind not in SHOWN:
            look, normal = STATES[WORDS[int(levels[i])]], float(normals[i])
            name = named(card.name, card.kind)
            found.append((i, Row(name, look, (look.text, q.text(normal), ""), normal)))
            if moments[i] > ROUND_OFF * (moments.max() + normals.max()):
                text = f"{m.text(float(moments[i]))} {m.unit}"
                found.append((i, Row(f"{card.label} moment", look, ("", text, ""), 0.0)))
    return sorted(found, key=lambda pair: pair[0])


def showing(q: Quantity, largest: float) -> Quantity:
    """Give a quantity the decimals of four digits of the largest value [SI]."""
    size = abs(largest) * q.factor
    return replace(q, decimals=min(max(3 - floor(log10(size)), 0), 9)) if size > 0.0 else q


def named(name: str, kind: str) -> str:
    """Add the kind to the name of a card that does not tell it."""
    return name if kind in name.lower() else f"{name} {kind}"


def rows_of_loads(case: CaseResult, units: ReportUnits) -> list[Row]:
    """Loads of cards in a result without states; sizes have a sign of both."""
    load, signless = card_loads(case)[:, :3], without_sign(case)[:, :3]
    q = showing(units.force, float(np.abs(load).max(initial=0.0)))
    found = []
    for card, own, sizes in zip(case.system.cards, load, signless, strict=True):
        cells = []
        for x, size in zip(own.tolist(), sizes.tolist(), strict=True):
            text = q.text(x)
            nothing = float(text) == 0.0
            cells.append(text.lstrip("-") if nothing else f"±{text}" if size else text)
        name = named(card.name, card.kind) if card.kind not in SHOWN else card.name
        found.append(Row(name, NO_STATE, tuple(cells), float(np.linalg.norm(own))))
    return found
