"""The convergence story of each support: what it did in every iteration, and in words why."""

from collections import Counter
from math import atan2, degrees

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import F8, OPEN, SLIP, STICK, CaseResult, Results, System
from trunnion.certificate import LIMIT
from trunnion.frozen import frozen
from trunnion.report.balance import Balance, balance
from trunnion.report.causes import told_cause
from trunnion.report.counts import counted
from trunnion.report.html import directions
from trunnion.report.units import ReportUnits
from trunnion.results.supports import STATES, is_good

SUPPORTS = 40  # told of one case, the most restless
ROWS = 200  # iterations of one support
TURNS = 3  # returns to the state before the last, from which a support goes to and fro
MOSTLY = 0.8  # of the common changes: states that two supports take at once
SHARE = 0.05  # of the normal force: a smaller exchange explains nothing


@frozen(eq=False)
class Course:
    """What all supports did: rows are the start and the iterations, columns support cards.

    level : index into STATES.  normal : [N].  used : F / (mu N), NaN without friction.
    angle : of sliding in the support's plane [deg]; NaN where nothing rubs.
    """

    level: NDArray[np.int8]
    normal: F8
    used: F8
    angle: F8


def stories(results: Results, units: ReportUnits) -> list[dict[str, object]]:
    """Give the story of every case that was iterated."""
    return [_story(case, units) for case in results.cases.values() if case.history]


def course(case: CaseResult) -> Course:
    """Gather the iterations by support card: its contacts, or its most loaded slider."""
    system, n_card, n = case.system, len(case.system.cards), len(case.passes)
    contacts, sliders = system.contacts, system.sliders
    level = np.zeros((n, n_card), np.int8)
    normal, used, angle = (np.zeros((n, n_card)) for _ in range(3))
    used[:], angle[:] = np.nan, np.nan
    mu = sliders.mu * (case.loads.mux if case.loads is not None else 1.0)
    pushes = ~contacts.rotational
    for i, at in enumerate(case.passes):
        np.maximum.at(level[i], contacts.card, (at.side != OPEN).astype(np.int8))
        np.maximum.at(level[i], sliders.card, at.mode)
        total = np.zeros((n_card, 3))
        np.add.at(total, contacts.card[pushes], at.reaction[pushes])
        normal[i] = np.linalg.norm(total, axis=1)
        rising = np.argsort(at.normal, kind="stable")  # the last one of a card stands
        normal[i, sliders.card[rising]] = at.normal[rising]
        size, capacity = np.linalg.norm(at.friction, axis=1), mu * at.normal
        rubs = rising[capacity[rising] > 0.0]
        used[i, sliders.card[rubs]] = size[rubs] / capacity[rubs]
        part = -np.einsum("nij,nj->ni", sliders.basis, at.friction)
        moving = rubs[size[rubs] > 1e-6 * capacity[rubs]]
        turned = [degrees(atan2(y, x)) for x, y in part[moving].tolist()]
        angle[i, sliders.card[moving]] = turned
    return Course(level, normal, used, angle)


def _story(case: CaseResult, units: ReportUnits) -> dict[str, object]:
    kept = max(len(case.passes) - 1, 0)
    found = course(case)
    changes = {i: _changes(found.level[:, i]) for i in range(found.level.shape[1])}
    restless = sorted((i for i in changes if changes[i]), key=lambda i: (-len(changes[i]), i))
    turned = directions.turns(case)
    restless += sorted(set(turned) - set(restless))  # only directions of theirs changed
    note = f"{len(restless)} of {counted(len(case.system.cards), 'support')} changed state"
    if kept < len(case.history):
        note += (
            f"; supports are told of the first {kept} of {counted(len(case.history), 'iteration')}"
        )
    if len(restless) > SUPPORTS:
        note += f"; the {SUPPORTS} that did so most often are told"
    return {
        "case": case.name,
        "note": note,
        "force": units.force.unit,
        **_verdict(case, units),
        **_passes(case, balance(case), units),
        "supports": [
            {
                "name": case.system.cards[i].name,
                "axis": _axis(case.system, i),
                "words": words(case.system, found, changes, i, units)
                if changes[i]
                else directions.words(STATES[found.level[0, i]], turned[i]),
                "rows": _rows(found, i, units),
            }
            for i in restless[:SUPPORTS]
        ],
    }


def _verdict(case: CaseResult, units: ReportUnits) -> dict[str, object]:
    """Say whether the case converged: the worst item of its certificate and what is allowed."""
    good, found = is_good(case), case.certificate
    text = f"NOT CONVERGED: {told_cause(case, units)}"
    if good and found is not None:
        text = f"Converged and certified: worst item {found.worst:.1e} ({found.where}), "
        text += f"allowed {LIMIT:.1e}."
    worst = None if found is None else _plain(found.worst)
    return {"good": good, "verdict": text, "worst": worst, "limit": LIMIT}


def _passes(case: CaseResult, found: Balance, units: ReportUnits) -> dict[str, object]:
    """Give the chart of the iterations: relative numbers, and relative to what."""
    kinds = (("out of balance", units.force, found.force), ("change", units.movement, found.length))
    used = [kinds[int(k)] for k in dict.fromkeys(found.by_length.tolist())]
    said = []
    for raw, by_length in zip(found.raw.tolist(), found.by_length.tolist(), strict=True):
        q = kinds[int(by_length)][1]
        said.append(f"{raw * q.factor:.2e} {q.unit}")
    return {
        "measured": " or ".join(name for name, _, _ in used),
        "axis": "<br>".join(f"{name} / {one * q.factor:.3g} {q.unit}" for name, q, one in used),
        "passes": [
            {
                "what": record.get("what"),
                "residual": _plain(value),
                "said": text,
                "n_changed": record.get("n_changed"),
            }
            for record, value, text in zip(case.history, found.value.tolist(), said, strict=True)
        ],
    }


def _changes(level: NDArray[np.int8]) -> list[int]:
    """Iterations whose state is not that of the one before; 0 is the start."""
    return [i + 1 for i in np.flatnonzero(np.diff(level)).tolist()]


def _axis(system: System, card: int) -> str:
    """Direction from which angles of sliding count, as far as the card has a slider."""
    own = np.flatnonzero(system.sliders.card == card)
    if not len(own):
        return ""
    return "({:.2g}, {:.2g}, {:.2g})".format(*(system.sliders.basis[own[-1], 0] + 0.0).tolist())


def _rows(found: Course, card: int, units: ReportUnits) -> list[list[object]]:
    """Iteration, state, N, F / (mu N) and angle; the middle of a long story is left out."""
    n = len(found.level)
    shown = list(range(n)) if n <= ROWS else [*range(ROWS // 2), *range(n - ROWS // 2, n)]
    return [
        [
            i,
            STATES[found.level[i, card]],
            _plain(round(float(found.normal[i, card]) * units.force.factor, 6)),
            _plain(round(float(found.used[i, card]), 4)),
            _plain(round(float(found.angle[i, card]), 2)),
        ]
        for i in shown
    ]


def words(
    system: System, found: Course, changes: dict[int, list[int]], card: int, units: ReportUnits
) -> str:
    """Tell in words what a support did, with whom it alternates, and why."""
    own, level = changes[card], found.level[:, card]
    first, last = STATES[level[0]], STATES[level[-1]]
    if len(own) <= 2 * TURNS:
        path = [f"{STATES[level[i]]} at iteration {i}" for i in own[:-1]]
        text = ", ".join([f"{first} at first", *path, f"{last} from iteration {own[-1]} on."])
    else:
        text = f"{first} at first, changed {len(own)} times, {last} from iteration {own[-1]} on."
    text = text[0].upper() + text[1:]
    if not _to_and_fro(found, own, card):
        return text
    text += f" It went to and fro{_because(level, own)}."
    partner = _partner(found, changes, card)
    if partner is not None:
        return f"{text} {_shared(system, found, own, card, partner, units)}"
    near = found.used[own, card]
    if np.isfinite(near).all() and near.min() > 0.9:
        text += f" Each time its friction was at {100 * near.min():.0f} % of mu N or more."
    return text


def _to_and_fro(found: Course, own: list[int], card: int) -> bool:
    """Tell whether a support came back TURNS times to the state that it had left just before."""
    states = [int(found.level[0, card]), *found.level[own, card].tolist()]
    returns = [a for a, b in zip(states, states[2:], strict=False) if a == b]
    return len(returns) >= TURNS


def _because(level: NDArray[np.int8], own: list[int]) -> str:
    """Say what the two states between which a support went mean: why it left each again."""
    lift = sum((level[i] == OPEN) != (level[i - 1] == OPEN) for i in own)
    rub = sum({int(level[i]), int(level[i - 1])} == {STICK, SLIP} for i in own)
    if 2 * lift > len(own):
        return ": held there, the pipe comes off again; let go, it moves past its stop"
    if 2 * rub > len(own):
        return ": stuck, it needs more friction than mu N; sliding, less"
    return ""


def _partner(found: Course, changes: dict[int, list[int]], card: int) -> int | None:
    """Find the other restless support that changes in most of the same iterations."""
    own = set(changes[card])
    common = {
        i: len(own & set(at))
        for i, at in changes.items()
        if i != card and _to_and_fro(found, at, i)
    }
    best = max(common, key=lambda i: (common[i], -i), default=None)
    if best is None or common[best] < max(TURNS, len(own) // 2 + 1):
        return None
    return best


def _shared(
    system: System, found: Course, own: list[int], card: int, partner: int, units: ReportUnits
) -> str:
    """Say how two supports change together, and why as far as their normal forces show it.

    They share a load if, in most of the changes, one takes what the other loses, and if that is
    more than SHARE of the largest normal force of both.
    """
    at = np.array(own)
    mine, other = (found.normal[at, i] - found.normal[at - 1, i] for i in (card, partner))
    name, q = system.cards[partner].name, units.force
    text = f"This one and {name} mostly change in the same iterations"
    floor = SHARE * np.array([found.normal[:, i].max() for i in (card, partner)])
    exchange = (mine * other < 0.0) & (np.abs(mine) > floor[0]) & (np.abs(other) > floor[1])
    if 2 * exchange.sum() <= len(own):
        return f"{text}{_together(found, own, card, partner)}."
    most = [float(np.abs(x[exchange]).max()) for x in (mine, other)]
    shown = " and ".join(q.showing(x).text(x) for x in most)
    return (
        f"{text}: these two alternate because they share a load, and what the normal force of one "
        f"loses the other takes (up to {shown} {q.unit})."
    )


def _together(found: Course, own: list[int], card: int, partner: int) -> str:
    """Say which states two supports take at once, where that is so in `MOSTLY` of the changes."""
    both = Counter(
        (int(found.level[i, card]), int(found.level[i, partner]))
        for i in own
        if found.level[i, partner] != found.level[i - 1, partner]
    )
    (first, n), *rest = both.most_common(2)
    if not rest or first[0] == rest[0][0][0] or first[1] == rest[0][0][1]:
        return ""
    second, m = rest[0]
    if n + m < MOSTLY * both.total() or m < 2:
        return ""
    states = [(STATES[a], STATES[b]) for a, b in (first, second)]
    if all(a == b for a, b in states):
        return f": both {states[0][0]}, or both {states[1][0]}"
    return ": " + " and ".join(f"{a} while that one is {b}" for a, b in states)


def _plain(value: object) -> object:
    """A number that JSON has; None for what is not finite."""
    if isinstance(value, float | np.floating):
        return float(value) if np.isfinite(value) else None
    return value
