"""Other answers in the reports: what was tried, what was found, how far the loads lie apart."""

from collections.abc import Sequence

import numpy as np

from trunnion.arrays import F8, CaseResult, Results, Spread, Spreading
from trunnion.report.causes import in_units
from trunnion.report.columns import Column, integers, numbers, section, table, words, wrapped
from trunnion.report.counts import counted
from trunnion.report.units import ReportUnits
from trunnion.results.supports import STATES, card_forces, card_levels

HEADS = ("FX", "FY", "FZ", "MX", "MY", "MZ")
ROUND_OFF = 1e-8  # of the largest load of its kind, ten certificates: less is no spread
SHOWN = 40  # supports, and elements, with the largest spread; the JSON has all


def spread_report(spread: Spread, results: Results, units: ReportUnits) -> str:
    """Print what was found of one case."""
    own = results.cases[spread.case]
    title = f"{own.name} = {own.text}"
    text = f"\n\n{title}\n{'=' * len(title)}\n{wrapped(_whole_verdict(spread, units))}"
    if spread.unique or spread.cause:
        return text
    text += _spreading(spread.starts, "OTHER STARTS, SAME QUESTION", units)
    if spread.orders is not None and spread.orders.tried:
        text += wrapped(
            "Below, another question: friction remembers the path, so other load steps and load "
            "sets put on one after another may end elsewhere. The case's own answer is among them."
        )
        text += _spreading(spread.orders, "OTHER LOAD ORDERS", units)
    return text


def spread_lines(results: Results, units: ReportUnits) -> list[str]:
    """Say in a line each for the screen what was found."""
    return [f"  SPREAD {s.case}: {verdict(s, units)}" for s in results.spreads.values()]


def _whole_verdict(spread: Spread, units: ReportUnits) -> str:
    text = verdict(spread, units)
    return text[:1].upper() + text[1:] + "."


def verdict(spread: Spread, units: ReportUnits) -> str:
    """Sum up one case in a sentence."""
    if spread.unique:
        return f"{spread.unique}; spread 0"
    if spread.cause:
        return f"nothing was tried: {in_units(spread.cause, units)}"
    s = spread.starts
    good = sum(tried.answer is not None for tried in s.tried)
    many, starts = counted(len(s.answers), "answer"), counted(len(s.tried), "start")
    text = f"{many}, certified from {good} of {starts}"
    text += f"; {_largest(s, units)}"
    if spread.orders is not None and spread.orders.tried:
        text += f"; over {len(spread.orders.tried)} load orders {_largest(spread.orders, units)}"
    return text


def _largest(s: Spreading, units: ReportUnits) -> str:
    """Name the largest spread of a support force and of an end force."""
    if s.supports is None or s.elements is None or not s.answers:
        return "nothing is certified"
    system = s.answers[0].system
    apart = [_shown(a, s.answers, kind) for kind, a in enumerate((s.supports, s.elements))]
    if not any(a.any() for a in apart):
        return "support loads and end forces differ by nothing"
    ends = [f"{p.start}-{p.end} at {label}" for p in system.parts for label in (p.start, p.end)]
    names = [card.name for card in system.cards], ends
    found = []
    for what, a, places in zip(("support loads", "end forces"), apart, names, strict=True):
        flat = a.reshape(-1, 6)
        if not flat.size:
            continue
        i, j = np.unravel_index(int(flat[:, :3].argmax()), (len(flat), 3))
        size = f"{float(flat[i, j]) * units.force.factor:.5g} {units.force.unit}"
        found.append(f"{what} differ by up to {size} ({places[i]} {HEADS[j]})")
    return ", ".join(found)


def _shown(apart: F8, answers: Sequence[CaseResult], kind: int) -> F8:
    """Spread without what is round-off of the loads of its kind; kind 0 supports, 1 elements."""
    out = apart.copy()
    known = [card_forces(a) if kind == 0 else a.state.end_force for a in answers if a.state]
    force, moment = (
        max((float(np.abs(k[..., half]).max(initial=0.0)) for k in known), default=0.0)
        for half in (slice(0, 3), slice(3, 6))
    )
    out[..., :3][out[..., :3] <= ROUND_OFF * max(force, 1e-3 * moment, 1.0)] = 0.0
    out[..., 3:][out[..., 3:] <= ROUND_OFF * max(moment, 1e-3 * force, 1.0)] = 0.0
    return out


# ------------------------------------------------------------------ tables
def _spreading(s: Spreading, title: str, units: ReportUnits) -> str:
    text = section(title) + _tried(s, units) + _answers(s, units)
    if s.supports is None or s.elements is None or not s.answers:
        return text
    system = s.answers[0].system
    ends = [f"{p.start}-{p.end} at {label}" for p in system.parts for label in (p.start, p.end)]
    cards = [card.name for card in system.cards]
    supports, elements = (
        _shown(a, s.answers, kind).reshape(-1, 6) for kind, a in enumerate((s.supports, s.elements))
    )
    text += _apart("SPREAD OF SUPPORT LOADS", "SUPPORT", cards, supports, units)
    return text + _apart("SPREAD OF END FORCES", "ELEMENT", ends, elements, units)


def _tried(s: Spreading, units: ReportUnits) -> str:
    found = [str(t.answer + 1) if t.answer is not None else "none" for t in s.tried]
    why = [in_units(t.cause or "", units) for t in s.tried]
    return table(
        [
            words("TRIED", [t.what for t in s.tried], least=28),
            words("ANSWER", found),
            words("NO CERTIFIED ANSWER BECAUSE", why, most=90),
        ]
    )


def _answers(s: Spreading, units: ReportUnits) -> str:
    """Print one row an answer: how often it was found, states of the supports, movement."""
    if not s.answers:
        return ""
    n = len(s.answers)
    often = [sum(t.answer == i for t in s.tried) for i in range(n)]
    states = np.array([np.bincount(card_levels(a), minlength=len(STATES)) for a in s.answers])
    move = [float(np.abs(a.state.u[:, :3]).max(initial=0.0)) if a.state else 0.0 for a in s.answers]
    worst = [a.certificate.worst if a.certificate else 0.0 for a in s.answers]
    columns: list[Column] = [
        integers("ANSWER", list(range(1, n + 1)), 8),
        integers("FOUND", often, 7),
        Column("WORST", "", "%9s", 9, [f"{w:.1e}" for w in worst]),
        *(
            integers(word.upper(), states[:, k].tolist(), 9)
            for k, word in enumerate(STATES)
            if states[:, k].any()
        ),
        numbers("LARGEST MOVE", move, units.movement.showing(max(move)), 15),
    ]
    return "\n" + table(columns)


def _apart(title: str, head: str, names: list[str], apart: F8, units: ReportUnits) -> str:
    """Print the spread of the rows that have any, the largest first."""
    size = np.maximum(apart[:, :3].max(axis=1, initial=0.0), apart[:, 3:].max(axis=1, initial=0.0))
    order = np.argsort(-size, kind="stable")
    order = order[size[order] > 0.0]
    note = "largest less smallest" + (f"; {SHOWN} of {len(order)}" if len(order) > SHOWN else "")
    order = order[:SHOWN]
    text = section(title, note)
    if not len(order):
        return text + "  none: the same in all answers\n"
    chosen = apart[order]
    q = units.force.showing(float(chosen[:, :3].max()))
    m = units.moment.showing(float(chosen[:, 3:].max()))
    columns = [words(head, [names[i] for i in order.tolist()], least=12)]
    columns += [numbers(h, chosen[:, i], m if i > 2 else q, 13) for i, h in enumerate(HEADS)]
    return text + table(columns)
