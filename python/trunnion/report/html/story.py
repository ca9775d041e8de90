"""The convergence story of each support: what it did in every iteration, and in words why."""

from math import atan2, degrees

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import F8, OPEN, CaseResult, Results, System
from trunnion.frozen import frozen
from trunnion.report.units import ReportUnits
from trunnion.results.supports import STATES

SUPPORTS = 40  # told of one case, the most restless
ROWS = 200  # iterations of one support
TURNS = 3  # changes in a row from which two states alternate


@frozen(eq=False)
class Course:
    """What all supports did: rows are iterations, columns support cards.

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
    """Gather the iterations by support card: the contacts together, the busiest slider."""
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
        normal[i, sliders.card] = at.normal
        size, capacity = np.linalg.norm(at.friction, axis=1), mu * at.normal
        rubs = capacity > 0.0
        used[i, sliders.card[rubs]] = size[rubs] / capacity[rubs]
        part = -np.einsum("nij,nj->ni", sliders.basis, at.friction)
        moving = rubs & (size > 1e-6 * capacity)
        turned = [degrees(atan2(y, x)) for x, y in part[moving].tolist()]
        angle[i, sliders.card[moving]] = turned
    return Course(level, normal, used, angle)


def _story(case: CaseResult, units: ReportUnits) -> dict[str, object]:
    kept = len(case.passes)
    found = course(case)
    changes = {i: _changes(found.level[:, i]) for i in range(found.level.shape[1])}
    restless = sorted((i for i in changes if changes[i]), key=lambda i: (-len(changes[i]), i))
    note = f"{len(restless)} of {len(case.system.cards)} supports changed state"
    if kept < len(case.history):
        note += f"; supports are told of the first {kept} of {len(case.history)} iterations"
    if len(restless) > SUPPORTS:
        note += f"; the {SUPPORTS} that did so most often are told"
    return {
        "case": case.name,
        "note": note,
        "force": units.force.unit,
        "passes": [
            {key: _plain(record.get(key)) for key in ("what", "residual", "step", "n_changed")}
            for record in case.history
        ],
        "supports": [
            {
                "name": case.system.cards[i].name,
                "axis": _axis(case.system, i),
                "words": words(case.system, found, changes, i, units),
                "rows": _rows(found, i, units),
            }
            for i in restless[:SUPPORTS]
        ],
    }


def _changes(level: NDArray[np.int8]) -> list[int]:
    """Iterations (from 0) whose state is not that of the one before."""
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
            i + 1,
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
    if len(own) == 1:
        return f"{first} at first, {last} from iteration {own[0] + 1} on."
    text = f"Changed {len(own)} times: {first} at first, {last} from iteration {own[-1] + 1} on."
    if len(own) < TURNS:
        return text
    pair = sorted({int(level[i]) for i in own} | {int(level[own[0] - 1])})
    if len(pair) == 2:
        text += f" It went to and fro between {STATES[pair[0]]} and {STATES[pair[1]]}."
    partner = _partner(changes, card)
    if partner is not None:
        return f"{text} {_shared(system, found, own, card, partner, units)}"
    near = found.used[own, card]
    if np.isfinite(near).all() and near.min() > 0.9:
        text += f" Its friction is at {100 * near.min():.0f} % of mu N or more: it is about to slide."
    return text


def _partner(changes: dict[int, list[int]], card: int) -> int | None:
    """Find the other support that changes most often in the same iterations."""
    own = set(changes[card])
    common = {i: len(own & set(at)) for i, at in changes.items() if i != card}
    best = max(common, key=lambda i: (common[i], -i), default=None)
    if best is None or common[best] < max(TURNS, len(own) // 2 + 1):
        return None
    return best


def _shared(
    system: System, found: Course, own: list[int], card: int, partner: int, units: ReportUnits
) -> str:
    """Say why two supports change together: by what their normal forces do."""
    mine, other = (found.normal[own, i] - found.normal[np.array(own) - 1, i] for i in (card, partner))
    name, q = system.cards[partner].name, units.force
    most = [q.showing(float(np.abs(x).max())).text(float(np.abs(x).max())) for x in (mine, other)]
    opposite = float((mine * other).sum()) < 0.0
    if opposite:
        return (
            f"These two alternate: this one and {name} change in the same iterations, because they "
            f"share a load; when the normal force of one falls, that of the other rises (by up to "
            f"{most[0]} and {most[1]} {q.unit})."
        )
    return (
        f"It changes in the same iterations as {name}, and their normal forces rise and fall "
        f"together (by up to {most[0]} and {most[1]} {q.unit})."
    )


def _plain(value: object) -> object:
    """A number that JSON has; None for what is not finite."""
    if isinstance(value, float | np.floating):
        return float(value) if np.isfinite(value) else None
    return value
