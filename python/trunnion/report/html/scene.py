"""Model and answers as arrays for the picture: points of centre lines, supports, numbers by case.

Arrays travel as base64 of little-endian float32: a picture needs no more.  Big models get fewer
points a pipe, so that the page stays usable.
"""

from base64 import b64encode

import numpy as np
from numpy.typing import ArrayLike

from trunnion.arrays import F8, CaseResult, Contacts, Results, System
from trunnion.report.centreline import Lines, along, cut, shape
from trunnion.report.html.bodies import dressed
from trunnion.report.units import ReportUnits
from trunnion.results.stresses import pipe_elements, pipe_stresses
from trunnion.results.supports import (
    STATES,
    card_levels,
    card_loads,
    card_nodes,
    is_good,
    solved,
)

POINTS = 60_000  # of all cases together, about
DRAWN = 16_000  # of one case, about: a browser without a graphics card draws them in seconds
COARSE = 15.0  # degrees of a part of a bend
SPRINGY = 1e11  # N/m: what is softer is drawn as a spring


def scene(results: Results, units: ReportUnits) -> dict[str, object] | None:
    """Give everything that the picture shows; None where there is no structure."""
    good = [case for case in results.cases.values() if is_good(case)]
    if results.base is None and not results.cases:
        return None
    system = results.system
    dress = dressed(system, cut(system, _parts(system, len(good)), COARSE))
    lines = dress.lines
    where, tangent, radius = shape(system, lines)
    radius = np.where(np.isnan(dress.radius), radius, dress.radius)
    return {
        "up": system.up.tolist(),
        "at": packed(where),
        "tangent": packed(tangent),
        "radius": packed(radius),
        "first": lines.first.tolist(),
        "element": [f"{p.start}-{p.end}" for p in system.parts],
        "type": [part.type for part in system.parts],
        "ends": system.ends.tolist(),
        "labels": list(system.labels),
        "node_point": _node_points(system, lines),
        "spans": np.round(system.length, 6).tolist(),
        "nodes": packed(system.xyz),
        "cards": _cards(system),
        "states": list(STATES),
        "cases": [_case(case, lines) for case in good],
        "units": {
            name: {"unit": q.unit, "factor": q.factor}
            for name, q in (
                ("movement", units.movement),
                ("rotation", units.rotation),
                ("force", units.force),
                ("moment", units.moment),
                ("stress", units.stress),
                ("length", units.length),
            )
        },
    }


def packed(values: ArrayLike) -> str:
    """Numbers as base64 of float32."""
    return b64encode(np.ascontiguousarray(values, "<f4").tobytes()).decode("ascii")


def _parts(system: System, n_case: int) -> int:
    """Parts of a straight, so that a case has about DRAWN points and all together POINTS."""
    room = min(DRAWN, POINTS // max(n_case, 1)) // max(len(system.kind), 1) - 1
    return int(np.clip(room, 1, 8))


def _node_points(system: System, lines: Lines) -> list[int]:
    """Point of the lines at each node; 0 where no element ends."""
    at = np.zeros(len(system.labels), np.intp)
    at[system.ends[:, 1]] = lines.first[1:] - 1
    at[system.ends[:, 0]] = lines.first[:-1]
    found: list[int] = at.tolist()
    return found


def _case(case: CaseResult, lines: Lines) -> dict[str, object]:
    """Numbers of one case at the points, nodes and supports."""
    _, move, section = along(case, lines)
    state = solved(case)
    system = case.system
    levels = [-1] * len(system.cards) if case.gathered is not None else card_levels(case).tolist()
    return {
        "name": case.name,
        "text": case.text,
        "move": packed(move[:, :3]),
        "axial": packed(section[:, 0]),
        "shear": packed(np.hypot(section[:, 1], section[:, 2])),
        "torsion": packed(section[:, 3]),
        "bending": packed(np.hypot(section[:, 4], section[:, 5])),
        "stress": packed(_stress(case, lines, section)),
        "u": packed(state.u + state.u_low),
        "state": levels,
        "load": packed(card_loads(case)),
    }


def _stress(case: CaseResult, lines: Lines, section: F8) -> F8:
    """(n,) von Mises stress [Pa] of the points; NaN on rigid bodies and springs."""
    system, e = case.system, lines.element
    stress = np.full(len(e), np.nan)
    piped = np.isin(e, pipe_elements(system))
    pressure = np.zeros(len(system.kind)) if case.loads is None else case.loads.pressure
    own = e[piped]
    stress[piped] = pipe_stresses(
        system.od[own], system.wall[own], section[piped], pressure[own]
    ).von_mises
    return stress


def _cards(system: System) -> list[dict[str, object]]:
    """Supports: name, node, type and what each direction word holds."""
    radius = np.zeros(len(system.labels))
    for end in (0, 1):
        np.maximum.at(radius, system.ends[:, end], 0.5 * system.od)
    axis = np.zeros((len(system.labels), 3))
    axis[system.ends[:, 0]] = system.axes[:, 0]
    holds: list[list[dict[str, object]]] = [[] for _ in system.cards]
    for contacts in (system.contacts, system.snubbers):
        _hold(contacts, holds)
    return [
        {
            "name": card.name,
            "kind": card.kind,
            "line": card.line,
            "node": node,
            "radius": float(np.float32(radius[node])),
            "axis": axis[node].tolist(),
            "holds": holds[i],
        }
        for i, (card, node) in enumerate(zip(system.cards, card_nodes(system), strict=True))
    ]


def _hold(contacts: Contacts, holds: list[list[dict[str, object]]]) -> None:
    """Add the translations that contacts hold to their cards."""
    stiff = contacts.penalty | (contacts.k >= SPRINGY)
    for i in np.flatnonzero(~contacts.rotational).tolist():
        holds[contacts.card[i]].append(
            {
                "word": contacts.word[i],
                "normals": contacts.normal[i, : contacts.dim[i]].tolist(),
                "sides": [s for s, gap in ((-1, 0), (1, 1)) if np.isfinite(contacts.gap[i, gap])],
                "spring": not bool(stiff[i]),
            }
        )
