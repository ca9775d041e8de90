"""Input echo of supports: anchors, direction words with gaps and friction, springs, hangers."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from trunnion.arrays import Card, System
from trunnion.model import HangerDesign, Model, Support
from trunnion.report.columns import Column, integers, numbers, plain, section, table, words
from trunnion.report.units import Quantity, ReportUnits


def support_echo(model: Model, system: System, units: ReportUnits) -> str:
    """Print every support card."""
    kinds = {kind: [s for s in model.supports if s.kind == kind] for kind in ("anchor", "spring")}
    text = ""
    if kinds["anchor"]:
        text += section("ANCHORS", "- K: rigid") + _anchors(kinds["anchor"], units)
    text += section(
        "SUPPORTS", "n along the word, round a vertical pipe (GUIDE) along the pipe; - K: rigid"
    )
    text += _directions(system, units)
    if kinds["spring"]:
        text += section("SPRINGS TO GROUND", "in their own axes") + _springs(kinds["spring"], units)
    if len(system.snubbers.k):
        text += section("SNUBBERS", "free but in cases with ABOUT and in modes; - K: rigid")
        text += _snubbers(system, units)
    if asked := [s for s in model.supports if s.design is not None]:
        text += section("HANGERS TO BE SELECTED") + _asked(asked, units)
    if hangers := [s for s in model.supports if s.kind == "hanger" and s.design is None]:
        text += section("SPRING HANGERS") + _hangers(hangers, units)
    return text


def _anchors(cards: Sequence[Support], units: ReportUnits) -> str:
    columns = [
        words("NODE", [s.node for s in cards]),
        words("CNODE", [s.cnode for s in cards]),
        _given("K", [s.k for s in cards], units.stiffness, 14),
        _given("K ROTATION", [s.kr for s in cards], units.rotational_stiffness, 18),
        integers("LINE", [s.place.line for s in cards]),
        words("  NAME", [f"  {s.name or ''}" for s in cards]),
    ]
    return table(columns)


def _directions(system: System, units: ReportUnits) -> str:
    """One row a direction word of a SUPPORT card."""
    contacts, sliders = system.contacts, system.sliders
    card_of = [system.cards[i] for i in contacts.card.tolist()]
    at = np.flatnonzero([card.kind in ("support", "displacement") for card in card_of])
    cards = [card_of[i] for i in at]
    n_contact, per = len(card_of), np.diff(sliders.first)
    mu, kf = np.full(n_contact, np.nan), np.full(n_contact, np.nan)
    mu[sliders.contact] = np.repeat(sliders.mu, per)
    kf[sliders.contact] = np.repeat(sliders.kf, per)
    first, second = contacts.normal[:, 0], contacts.normal[:, 1]
    normal = np.where((contacts.dim == 2)[:, None], np.cross(first, second), first)[at]
    turning = contacts.rotational[at]
    factor = units.rotational_stiffness.factor / units.stiffness.factor
    k = np.where(contacts.penalty, np.nan, contacts.k)[at] * np.where(turning, factor, 1.0)
    free = (
        contacts.gap[at] * np.where(turning, units.rotation.factor, units.movement.factor)[:, None]
    )
    columns = [
        words("NODE", [card.label for card in cards]),
        words("WORD", [contacts.word[i] for i in at]),
        words("CNODE", [card.cnode for card in cards]),
        *(plain(f"n{'xyz'[i]}", normal[:, i], 4, 9) for i in range(3)),
        *(_gap(f"GAP {'-+'[i]}", free[:, i], units) for i in range(2)),
        _given("K", k.tolist(), units.stiffness, 13),
        plain("MU", mu[at], 3, 8),
        _given("KF", kf[at].tolist(), units.stiffness, 13),
        integers("LINE", [card.line for card in cards]),
        words("  NAME", [f"  {_own_name(card)}" for card in cards]),
    ]
    return table(columns)


def _own_name(card: Card) -> str:
    """Give the NAME= of a card; without one it is called by its node and words."""
    return "" if card.name.startswith(f"{card.label} ") else card.name


def _gap(head: str, gaps: ArrayLike, units: ReportUnits) -> Column:
    """Set clearances; a side without any stop is free."""
    cells = ["free" if np.isinf(g) else f"{g:.3f}" for g in np.asarray(gaps).tolist()]
    return Column(head, f"[{units.movement.unit}]", "%10s", 10, cells)


def _springs(cards: Sequence[Support], units: ReportUnits) -> str:
    k = [s.ks or (0.0,) * 6 for s in cards]
    columns = [words("NODE", [s.node for s in cards])]
    for i, head in enumerate(("KX", "KY", "KZ", "KRX", "KRY", "KRZ")):
        quantity = units.rotational_stiffness if i > 2 else units.stiffness
        columns.append(_given(head, [row[i] for row in k], quantity, 16))
    return table([*columns, integers("LINE", [s.place.line for s in cards])])


def _hangers(cards: Sequence[Support], units: ReportUnits) -> str:
    columns = [
        words("NODE", [s.node for s in cards]),
        words("CNODE", [s.cnode for s in cards]),
        _given("RATE", [s.k for s in cards], units.stiffness, 14),
        numbers("COLD LOAD", [s.load for s in cards], units.force, 12),
        integers("LINE", [s.place.line for s in cards]),
        words("  NAME", [f"  {s.name or ''}" for s in cards]),
    ]
    return table(columns)


def _asked(cards: Sequence[Support], units: ReportUnits) -> str:
    wanted = [s.design for s in cards if s.design is not None]
    columns = [
        words("NODE", [s.node for s in cards]),
        words("CNODE", [s.cnode for s in cards]),
        plain("VARIATION", [100.0 * d.variation for d in wanted], 1, 11, "[%]"),
        numbers("ROD TO", [d.rod for d in wanted], units.movement, 10),
        numbers("CONSTANT FROM", [d.most or np.nan for d in wanted], units.movement, 15),
        integers("NUMBER", [d.number for d in wanted]),
        words("METHOD", [d.method for d in wanted]),
        words("SERIES", [_series(d) for d in wanted]),
        words("OPERATING", [d.operating or "first" for d in wanted]),
        integers("LINE", [s.place.line for s in cards]),
        words("  NAME", [f"  {s.name or ''}" for s in cards]),
    ]
    return table(columns)


def _series(design: HangerDesign) -> str:
    series = design.series or "all"
    return series if design.table == "GENERIC" else f"{design.table}-{series}"


def _snubbers(system: System, units: ReportUnits) -> str:
    found = system.snubbers
    cards = [system.cards[i] for i in found.card.tolist()]
    k = np.where(found.penalty, np.nan, found.k)
    columns = [
        words("NODE", [card.label for card in cards]),
        words("WORD", found.word),
        words("CNODE", [card.cnode for card in cards]),
        *(plain(f"n{'xyz'[i]}", found.normal[:, 0, i], 4, 9) for i in range(3)),
        _given("K", k.tolist(), units.stiffness, 14),
        integers("LINE", [card.line for card in cards]),
        words("  NAME", [f"  {_own_name(card)}" for card in cards]),
    ]
    return table(columns)


def _given(head: str, values: Sequence[float | None], quantity: Quantity, width: int) -> Column:
    """Set numbers of which some were not given, with the decimals that the smallest needs."""
    known = np.array([np.nan if v is None else v for v in values], np.float64)
    sizes = np.abs(known[np.isfinite(known) & (known != 0.0)])
    return numbers(head, known, quantity.showing(sizes.min(initial=np.inf)), width)
